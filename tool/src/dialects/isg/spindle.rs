//! Threads (G33) and taps (G63): motions in step with the spindle, until one of G0 to G3.
//!
//! G63 goes along with the spindle, so that no chuck has to give way: the pitch is F over S, the spindle
//! stands before, and S below 0 turns it to the left, which is the way out of a right-hand thread. (ISG and
//! Beckhoff TF5200, Programming Manual, "Thread cutting with endlessly rotating spindle (G33)",
//! "Tapping (G63)".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::At;
use crate::program::{FeedMode, Spindle};
use crate::source::Span;

/// Places of the axis of a tap that differ by less, in units of the program, are the same.
const SAME_PLACE: f64 = 1e-6;

/// Pitches that differ by less, relatively, are the same: F and S are rounded.
const SAME_PITCH: f64 = 1e-3;

/// G33 or G63.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleMotion {
    /// G33.
    Thread,
    /// G63.
    Tap,
}

/// What stays in force of threads and taps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpindleModes {
    /// The modal motion, where it is one of these.
    pub active: Option<SpindleMotion>,
    /// The pitch of threads, along one of X Y Z, machine units.
    pitch: Option<(usize, f64)>,
    /// Whether S was below 0.
    left: bool,
    /// A tap that has gone in and must come out.
    tapping: Option<Tapping>,
}

/// The way in of a tap; units of the program, which stays the same until the tap is out, revolutions per minute.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tapping {
    start: f64,
    bottom: f64,
    /// Below 0 for a thread that turns left.
    pitch: f64,
    /// The unit: lengths times this are machine units.
    length_factor: f64,
    speed: f64,
    span: Span,
}

impl Interpreter<'_> {
    /// S; below 0 it turns a tap to the left.
    pub(super) fn spindle_speed(&mut self, speed: At<f64>) -> Done {
        if self.spindle.active != Some(SpindleMotion::Tap) {
            return self.control.speed(speed);
        }
        self.spindle.left = speed.value < 0.0;
        self.control.speed(At {
            value: speed.value.abs(),
            ..speed
        })
    }

    /// The motion of a block under G33 or G63; `false` where neither is in force.
    pub(super) fn spindle_motion(
        &mut self,
        words: &BlockWords,
        block: Span,
    ) -> Result<bool, Diagnostic> {
        let Some(active) = self.spindle.active else {
            return Ok(false);
        };
        for (axis, word) in words.motion.centre.iter().enumerate() {
            if let (Some(pitch), SpindleMotion::Thread) = (word, active) {
                let pitch = pitch.value.0 * self.control.modal.length_factor;
                self.spindle.pitch = Some((axis, pitch));
            }
        }
        if !words.motion.names_an_axis() {
            return Ok(true);
        }
        if self.offset_free.active {
            return Err(
                Diagnostic::error(block, "a thread while the zero offset is off (G53)")
                    .help("select one before: G54"),
            );
        }
        match active {
            SpindleMotion::Thread => self.thread(words, block)?,
            SpindleMotion::Tap => self.tap(words, block)?,
        }
        Ok(true)
    }

    /// `G33 Z-20 K2`: I, J or K is the pitch along X, Y or Z.
    fn thread(&mut self, words: &BlockWords, block: Span) -> Done {
        let Some((axis, pitch)) = self.spindle.pitch else {
            return Err(Diagnostic::error(block, "a thread needs its pitch").help(
                "write G33 Z-20 K2 for a pitch of 2 along Z; I is that along X, J that along Y",
            ));
        };
        let mut motion = words.motion;
        motion.centre = [None; 3];
        let pitch = pitch / self.control.modal.length_factor;
        self.control.thread(&motion, pitch, axis, block)
    }

    /// `G63 Z-20 F300 S200`, and back `Z5 S-200`: the tap that LinuxCNC makes goes in and out in one.
    fn tap(&mut self, words: &BlockWords, block: Span) -> Done {
        let modal = &self.control.modal;
        let (Some(feed), Some(speed), FeedMode::PerMinute) = (
            modal.feed,
            modal.spindle_speed.filter(|speed| *speed > 0.0),
            modal.feed_mode,
        ) else {
            return Err(Diagnostic::error(
                block,
                "a tap needs F in mm/min (G94) and S: they give its pitch",
            )
            .help("write G63 Z-20 F300 S200 for a pitch of 1.5"));
        };
        let length_factor = modal.length_factor;
        let pitch = feed / length_factor / speed;
        let pitch = if self.spindle.left { -pitch } else { pitch };
        let [_, _, normal] = modal.plane.axes();
        let incremental = modal.incremental;
        let place = self.control.tap_place(&words.motion, normal, block)?;
        let value = words.motion.axes[normal].map_or(0.0, |word| word.value.0);
        let Some(tapping) = self.spindle.tapping.take() else {
            let turns = |spindle| spindle != Spindle::Stop;
            if self.control.modal.spindle.is_some_and(turns) {
                return Err(
                    Diagnostic::error(block, "the spindle turns before this tap")
                        .help("stop it before G63: M5"),
                );
            }
            let bottom = if incremental { place + value } else { value };
            self.spindle.tapping = Some(Tapping {
                start: place,
                bottom,
                pitch,
                length_factor,
                speed,
                span: block,
            });
            return Ok(());
        };
        let end = match incremental {
            true => tapping.bottom + value,
            false => value,
        };
        let same_pitch = (pitch + tapping.pitch).abs() <= SAME_PITCH * tapping.pitch.abs();
        if (end - tapping.start).abs() > SAME_PLACE || !same_pitch {
            return Err(Diagnostic::error(
                    block,
                    "this tap does not come back to where it began with the pitch with which it went in",
                )
                .help(
                    "end the way out where G63 began, with S of the other sign and F over S as on the way \
                     in, and move on with G0",
                ));
        }
        let tap = Tap {
            bottom: tapping.bottom,
            pitch: tapping.pitch,
            back: speed / tapping.speed,
        };
        // The way in has its own speed.
        let back = speed;
        self.control.speed(At {
            value: tapping.speed,
            span: block,
        })?;
        self.control.tap(&tap, block)?;
        self.control.speed(At {
            value: back,
            span: block,
        })
    }

    /// Refuses what may not stand between the way in of a tap and its way out.
    pub(super) fn check_tap(&mut self, words: &BlockWords) -> Done {
        let Some(tapping) = self.spindle.tapping else {
            return Ok(());
        };
        let goes_on = self.spindle.active == Some(SpindleMotion::Tap)
            && words.m.is_empty()
            && tapping.length_factor == self.control.modal.length_factor;
        match goes_on {
            true => Ok(()),
            false => self.tap_stays(tapping.span),
        }
    }

    /// The same at the end of a program.
    pub(super) fn check_tap_at_end(&mut self) {
        if let Some(tapping) = self.spindle.tapping
            && let Err(diagnostic) = self.tap_stays(tapping.span)
        {
            self.control.diagnostics.push(diagnostic);
        }
    }

    fn tap_stays(&mut self, span: Span) -> Done {
        self.spindle.tapping = None;
        Err(
            Diagnostic::error(span, "the tap that goes in here does not come out next")
                .help("write Z5 S-200 in the next block with an axis, back to where G63 began"),
        )
    }
}
