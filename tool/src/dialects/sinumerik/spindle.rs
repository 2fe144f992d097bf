//! Threads and taps; diameters and ways of rotary axes.

use super::block_words::BlockWords;
use super::evaluate_words::OneShot;
use super::interpreter::Interpreter;
use super::syntax::Way;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::spindle_motion::{Tap, no_speed};
use crate::dialects::control::words::{AXES, At, Dimension};
use crate::program::Action;
use crate::source::Span;

/// Places of the spindle axis that differ by less, in units of the program, are the same.
const SAME_PLACE: f64 = 1e-6;

/// Degrees.
const TURN: f64 = 360.0;

/// Whether X is programmed as a diameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Diameter {
    /// DIAMOF.
    #[default]
    Never,
    /// DIAM90: absolute coordinates only.
    Absolute,
    /// DIAMON.
    Always,
}

/// The motions in step with the spindle that hold until another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleMotion {
    /// G33.
    Thread,
    /// G331.
    TapIn,
    /// G332.
    TapOut,
}

impl SpindleMotion {
    /// That of a G number times ten.
    pub fn of(code: u32) -> Option<SpindleMotion> {
        match code {
            330 => Some(SpindleMotion::Thread),
            3310 => Some(SpindleMotion::TapIn),
            3320 => Some(SpindleMotion::TapOut),
            _ => None,
        }
    }
}

/// A tap that has gone in with G331 and must come out with G332.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tapping {
    start: f64,
    tap: Tap,
    /// The speed in the block of G331.
    speed: Option<f64>,
    span: Span,
}

impl Interpreter<'_> {
    /// The motion of a block with G33, G63, G331 or G332, or under one of them; `false` where it moves
    /// otherwise or not at all.
    pub(super) fn move_with_spindle(
        &mut self,
        words: &BlockWords,
        once: &OneShot,
        block: Span,
    ) -> Result<bool, Diagnostic> {
        let code = words
            .g
            .iter()
            .find(|g| matches!(g.value, 330 | 630 | 3310 | 3320));
        if let (Some(tapping), false) = (self.tapping, code.is_some_and(|g| g.value == 3320))
            && (words.is_motion() || !words.m.is_empty())
        {
            self.tapping = None;
            return Err(Diagnostic::error(
                tapping.span,
                "the tap that goes in here does not come out next",
            )
            .help("write G332 in the next block with an axis, back to where G331 began"));
        }
        if once.takes_axes() {
            return Ok(false);
        }
        self.check_beside_spindle(words, code.map(|code| code.value))?;
        let named = code.map(|code| code.span);
        let span = named.or(words.motion.first_axis()).unwrap_or(block);
        match (code.map(|code| code.value), self.spindle_motion) {
            (Some(630), _) => self.floating_tap(words, block)?,
            (_, Some(SpindleMotion::Thread)) if words.is_motion() => self.thread(words, span)?,
            (Some(3310), _) => self.tap_in(words, span)?,
            (Some(3320), _) => self.tap_out(words, span)?,
            (None, Some(_)) if words.is_motion() => return Err(taps_on(span)),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Refuses what neither threads nor taps use.
    fn check_beside_spindle(&self, words: &BlockWords, code: Option<u32>) -> Done {
        match (code, self.spindle_motion) {
            (Some(630), _) => words.check_beside(630, &[]),
            (Some(code), _) => words.check_beside(code, &["I", "J", "K"]),
            (None, Some(SpindleMotion::Thread)) if words.is_motion() => {
                words.check_beside(330, &["I", "J", "K"])
            }
            (None, _) => Ok(()),
        }
    }

    /// `G33 Z-20 K2`: I, J or K is the pitch along X, Y or Z. It is that of its block, G33 holds.
    fn thread(&mut self, words: &BlockWords, span: Span) -> Done {
        let (axis, pitch) = pitch(words, span)?;
        if !words.motion.names_an_axis() {
            return Err(
                Diagnostic::error(span, "the pitch of a thread, and no axis moves")
                    .help("write it beside the end of the thread: G33 Z-20 K2"),
            );
        }
        let mut motion = words.motion;
        motion.centre = [None; 3];
        self.control.thread(&motion, pitch, axis, span)
    }

    /// `G63 Z-20 F300`: the chuck gives way for what feed and speed do not agree.
    fn floating_tap(&mut self, words: &BlockWords, block: Span) -> Done {
        if !words.motion.names_an_axis() {
            return Err(
                Diagnostic::error(block, "G63 needs the axis of the tap in its block")
                    .help("write G63 Z-20 F300"),
            );
        }
        self.control.refuse_compensation(block, "a tap")?;
        let motion = self.control.modal.motion.replace(Motion::Line);
        self.control.begin_cycle();
        self.control.begin_tap_without_overrides();
        let done = self
            .control
            .motion(&words.motion, block, words.feed.is_some(), false);
        self.control.end_tap_without_overrides();
        self.control.end_cycle();
        self.control.modal.motion = motion;
        done
    }

    /// `G331 Z-20 K1.5 S500`.
    fn tap_in(&mut self, words: &BlockWords, span: Span) -> Done {
        let (axis, pitch) = pitch(words, span)?;
        let start = self.control.tap_place(&words.motion, axis, span)?;
        let (value, dimension) =
            words.motion.axes[axis].map_or((start, Dimension::Absolute), |at| at.value);
        let bottom = match self.is_incremental(dimension) {
            true => start + value,
            false => value,
        };
        self.tapping = Some(Tapping {
            start,
            tap: Tap {
                bottom,
                pitch,
                back: 1.0,
            },
            speed: self.control.modal.spindle_speed,
            span,
        });
        Ok(())
    }

    /// `G332 Z5 K1.5`: the tap that LinuxCNC makes goes in and out in one.
    fn tap_out(&mut self, words: &BlockWords, span: Span) -> Done {
        let Some(tapping) = self.tapping.take() else {
            return Err(Diagnostic::error(span, "G332 without a G331 before it")
                .help("G331 Z-20 K1.5 taps, G332 Z5 K1.5 comes back"));
        };
        let Tapping { start, tap, .. } = tapping;
        let (axis, pitch) = pitch(words, span)?;
        let value = words.motion.axes[axis].map(|at| at.value);
        let end = match value {
            Some((value, dimension)) if self.is_incremental(dimension) => tap.bottom + value,
            Some((value, _)) => value,
            None => tap.bottom,
        };
        let beyond = (end - start) * (start - tap.bottom).signum();
        if beyond < -SAME_PLACE || pitch != tap.pitch {
            return Err(Diagnostic::error(
                    span,
                    "this tap does not come back to where it began with the pitch with which it went in",
                )
                .help("LinuxCNC taps back to the start: end G332 where G331 began, and move on with G0"));
        }
        self.tap_at_both_speeds(&tapping, span)?;
        // The tool is out of the hole there: the rest of the way needs no spindle.
        if beyond > SAME_PLACE {
            self.control.move_axis(axis, end, true, span)?;
        }
        Ok(())
    }

    /// S of G331 is the speed of the way in, S behind it that of the way out, which stays in force.
    fn tap_at_both_speeds(&mut self, tapping: &Tapping, span: Span) -> Done {
        let into = tapping.speed.filter(|speed| *speed > 0.0);
        let into = into.ok_or_else(|| no_speed(tapping.span))?;
        let out = self.control.modal.spindle_speed;
        let Some(out) = out.filter(|out| *out > 0.0 && *out != into) else {
            return self.control.tap(&tapping.tap, span);
        };
        // S beside G332 waits until the tap is out.
        let actions = &mut self.control.actions;
        actions.retain(|action| !matches!(action, Action::SpindleSpeed(_)));
        self.control.speed(At { value: into, span })?;
        let back = out / into;
        self.control.tap(
            &Tap {
                back,
                ..tapping.tap
            },
            span,
        )?;
        self.control.speed(At { value: out, span })
    }

    pub(super) fn is_incremental(&self, dimension: Dimension) -> bool {
        self.control.modal.is_incremental(dimension)
    }

    /// Diameters become radii, and ways of rotary axes coordinates.
    pub(super) fn resolve_axes(&mut self, words: &mut BlockWords) -> Done {
        if let Some(diameter) = words.diameter {
            self.diameter = diameter;
        }
        if let Some(x) = &mut words.motion.axes[0] {
            let incremental = self.is_incremental(x.value.1);
            let halves = match self.diameter {
                Diameter::Never => false,
                Diameter::Absolute => !incremental,
                Diameter::Always => true,
            };
            if halves {
                x.value.0 /= 2.0;
            }
        }
        self.resolve_centres(words)?;
        for (axis, way) in words.ways.iter().enumerate() {
            let (Some(way), Some(word)) = (way, &mut words.motion.axes[axis]) else {
                continue;
            };
            self.modulo[axis] = true;
            let Some(present) = self.control.present(axis) else {
                let rapid = self.control.modal.motion == Some(Motion::Rapid);
                if rapid && *way == Way::Shorter {
                    let word = *word;
                    self.warn_of_turns(axis, word);
                    continue;
                }
                return Err(unknown_turn(axis, word.span));
            };
            let forward = (word.value.0 - present).rem_euclid(360.0);
            let step = match way {
                Way::Positive => forward,
                Way::Negative if forward == 0.0 => 0.0,
                Way::Negative => forward - 360.0,
                Way::Shorter if forward > 180.0 => forward - 360.0,
                Way::Shorter => forward,
            };
            word.value.0 = present + step;
        }
        Ok(())
    }

    /// Absolute angles of an axis that counts within one turn lie in the turn in which it is: the control does not
    /// cross 0 on the way to them, and LinuxCNC would unwind the turns that DC, ACP and ACN have added.
    pub(super) fn resolve_turns(&mut self, words: &mut BlockWords) -> Done {
        for (axis, letter) in AXES.into_iter().enumerate() {
            let plain = self.modulo[axis] && words.ways[axis].is_none();
            let Some(word) = words.motion.axes[axis].as_mut().filter(|_| plain) else {
                continue;
            };
            let (angle, dimension) = word.value;
            if self.is_incremental(dimension) {
                continue;
            }
            if !(0.0..=TURN).contains(&angle) {
                return Err(Diagnostic::error(
                    word.span,
                    format!("{letter} counts within one turn since DC, ACP or ACN, and {angle} is outside of it"),
                )
                .help(format!("write an angle from 0 to 360, or {letter}=DC(..), ACP(..) or ACN(..)")));
            }
            match self.control.present(axis) {
                Some(present) => {
                    // An angle that was reckoned may fall short of the turn by rounding.
                    let turns = (present / TURN + SAME_PLACE).floor();
                    word.value = (angle + turns * TURN, Dimension::Absolute);
                }
                None if self.control.modal.motion == Some(Motion::Rapid) => {
                    self.warn_of_turns(axis, *word);
                }
                None => return Err(unknown_turn(axis, word.span)),
            }
        }
        Ok(())
    }

    /// A rapid motion to an angle from nobody knows which turn.
    fn warn_of_turns(&mut self, axis: usize, word: At<(f64, Dimension)>) {
        let (letter, angle) = (AXES[axis], word.value.0);
        self.control.diagnostics.push(
            Diagnostic::warning(
                word.span,
                format!(
                    "where {letter} is, is not known ahead of time: it goes to {angle} as LinuxCNC counts its turns"
                ),
            )
            .help("the angle is the same; the way there may be the longer one"),
        );
    }

    /// Absolute places on the way of an arc are diameters as its end is; what counts from the start of the arc
    /// is a radius. (Siemens, SINUMERIK ONE, Programming Manual NC, "Channel-specific diameter programming".)
    fn resolve_centres(&self, words: &mut BlockWords) -> Done {
        if self.diameter == Diameter::Never {
            return Ok(());
        }
        if let Some(centre) = &mut words.motion.centre[0]
            && centre.value.1 == Dimension::Absolute
        {
            centre.value.0 /= 2.0;
        }
        if let Some(middle) = &mut words.middle[0] {
            match (self.is_incremental(middle.value.1), self.diameter) {
                (false, _) => middle.value.0 /= 2.0,
                (true, Diameter::Always) => {
                    return Err(Diagnostic::error(
                        middle.span,
                        "an increment to the intermediate point while diameters are programmed",
                    )
                    .help("write its diameter: I1=AC(..)"));
                }
                (true, _) => {}
            }
        }
        Ok(())
    }
}

/// A rotary axis that turns from a place that is not known.
fn unknown_turn(axis: usize, span: Span) -> Diagnostic {
    Diagnostic::unknown_place(span, "which way this axis turns is not known ahead of time").help(
        format!("program {} absolute with G0 and AC(..) before", AXES[axis]),
    )
}

/// G331 and G332 hold, and only axes with a pitch are a tap.
fn taps_on(span: Span) -> Diagnostic {
    Diagnostic::error(span, "a motion while G331 or G332 is in force")
        .help("write G0 or G1 in this block")
}

/// The axis along which a thread goes, and its pitch: I, J or K.
fn pitch(words: &BlockWords, span: Span) -> Result<(usize, f64), Diagnostic> {
    let given: Vec<(usize, f64)> = words
        .motion
        .centre
        .iter()
        .enumerate()
        .filter_map(|(axis, word)| word.map(|At { value, .. }| (axis, value.0)))
        .collect();
    match given[..] {
        [(axis, pitch)] => Ok((axis, pitch)),
        _ => Err(Diagnostic::error(span, "a thread needs its pitch").help(
            "G33 holds until G0 or G1; in each of its blocks write K2 for a pitch of 2 along Z; I is that \
             along X, J that along Y",
        )),
    }
}
