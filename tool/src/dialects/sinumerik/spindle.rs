//! Threads, taps, the angle and the surface speed of the spindle; diameters, which come with them.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::syntax::Way;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::spindle_motion::Tap;
use crate::dialects::control::words::{AXES, At, Dimension};
use crate::program::Action;
use crate::source::Span;

/// Places of the spindle axis that differ by less, in units of the program, are the same.
const SAME_PLACE: f64 = 1e-6;

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

/// A tap that has gone in with G331 and must come out with G332.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tapping {
    start: f64,
    tap: Tap,
    span: Span,
}

impl Interpreter<'_> {
    /// The motion of a block with G33, G63, G331 or G332; `false` where it has none of them.
    pub(super) fn spindle_motion(
        &mut self,
        words: &BlockWords,
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
        let Some(code) = code else {
            return Ok(false);
        };
        match code.value {
            330 => self.thread(words, code.span)?,
            630 => self.floating_tap(words, block)?,
            3310 => self.tap_in(words, code.span)?,
            _ => self.tap_out(words, code.span)?,
        }
        Ok(true)
    }

    /// `G33 Z-20 K2`: I, J or K is the pitch along X, Y or Z.
    fn thread(&mut self, words: &BlockWords, span: Span) -> Done {
        let (axis, pitch) = pitch(words, span)?;
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
        let motion = self.control.modal.motion.replace(Motion::Line);
        self.control.begin_cycle();
        self.control.actions.push(Action::Overrides(false));
        let done = self
            .control
            .motion(&words.motion, block, words.feed.is_some(), false);
        self.control.actions.push(Action::Overrides(true));
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
            span,
        });
        Ok(())
    }

    /// `G332 Z5 K1.5`: the tap that LinuxCNC makes goes in and out in one.
    fn tap_out(&mut self, words: &BlockWords, span: Span) -> Done {
        let Some(Tapping { start, tap, .. }) = self.tapping.take() else {
            return Err(Diagnostic::error(span, "G332 without a G331 before it")
                .help("G331 Z-20 K1.5 taps, G332 Z5 K1.5 comes back"));
        };
        let (axis, pitch) = pitch(words, span)?;
        let value = words.motion.axes[axis].map(|at| at.value);
        let end = match value {
            Some((value, dimension)) if self.is_incremental(dimension) => tap.bottom + value,
            Some((value, _)) => value,
            None => tap.bottom,
        };
        if (end - start).abs() > SAME_PLACE || pitch != tap.pitch {
            return Err(Diagnostic::error(
                    span,
                    "this tap does not come back to where it began with the pitch with which it went in",
                )
                .help("LinuxCNC taps back to the start: end G332 where G331 began, and move on with G0"));
        }
        self.control.tap(&tap, span)
    }

    fn is_incremental(&self, dimension: Dimension) -> bool {
        match dimension {
            Dimension::Modal => self.control.modal.incremental,
            Dimension::Absolute => false,
            Dimension::Incremental => true,
        }
    }

    /// G96, G97, S with them, LIMS, SPOS.
    pub(super) fn spindle_words(&mut self, words: &BlockWords) -> Done {
        if let Some(most) = words.most_speed {
            self.most_speed = Some(most.value);
        }
        let mode = words.g.iter().find(|g| matches!(g.value, 960 | 970));
        if let Some(mode) = mode {
            self.surface_speed = mode.value == 960;
            if !self.surface_speed {
                self.control
                    .turning_speed(words.speed.map(|speed| speed.value), mode.span)?;
            }
        }
        // G96 without S takes the cutting speed of before, and LIMS holds for the one in force.
        let again = mode.map(|mode| mode.span);
        let again = again.or(words.most_speed.map(|most| most.span));
        match (words.speed, self.surface_speed, again) {
            (Some(speed), true, _) => self.cutting_speed(speed)?,
            (Some(speed), false, _) => self.control.speed(speed)?,
            (None, true, Some(span)) => match (self.cutting_speed, mode) {
                (Some(value), _) => self.cutting_speed(At { value, span })?,
                (None, None) => {}
                (None, Some(mode)) => {
                    return Err(Diagnostic::error(
                        mode.span,
                        "G96, and no cutting speed is programmed",
                    )
                    .help("write it beside G96, in m/min: G96 S200"));
                }
            },
            (None, ..) => {}
        }
        if let Some(angle) = words.spindle_angle {
            self.control.modal.spindle = None;
            self.control
                .actions
                .push(Action::Orient(angle.value.rem_euclid(360.0)));
        }
        Ok(())
    }

    fn cutting_speed(&mut self, speed: At<f64>) -> Done {
        self.cutting_speed = Some(speed.value);
        self.control
            .surface_speed(speed.value, self.most_speed, speed.span)
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
        for (axis, way) in words.ways.iter().enumerate() {
            let (Some(way), Some(word)) = (way, &mut words.motion.axes[axis]) else {
                continue;
            };
            let Some(present) = self.control.present(axis) else {
                let rapid = self.control.modal.motion == Some(Motion::Rapid);
                if rapid && *way == Way::Shorter {
                    self.control.diagnostics.push(
                        Diagnostic::warning(
                            word.span,
                            format!(
                                "where {} is, is not known ahead of time: it goes to {} as LinuxCNC \
                                 counts its turns",
                                AXES[axis], word.value.0
                            ),
                        )
                        .help("the angle is the same; the way there may be the longer one"),
                    );
                    continue;
                }
                return Err(Diagnostic::error(
                    word.span,
                    "which way this axis turns is not known ahead of time",
                )
                .help(format!(
                    "program {} absolute with AC(..) before",
                    AXES[axis]
                )));
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
        _ => Err(Diagnostic::error(span, "a thread needs its pitch")
            .help("write K2 for a pitch of 2 along Z; I is that along X, J that along Y")),
    }
}
