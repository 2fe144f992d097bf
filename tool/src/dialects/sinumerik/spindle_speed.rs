//! S: turns per minute, or the cutting speed of G96, as far as LIMS allows them; SPOS. (Siemens, SINUMERIK ONE,
//! Programming Manual NC, "Constant cutting rate".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::syntax::Way;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::{Action, OrientWay};
use crate::source::Span;

/// Metres in a foot: with G70 and G700 cutting speeds are in feet per minute.
const FOOT: f64 = 0.3048;

/// What S counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpeedMode {
    /// Turns, with G93 to G95.
    #[default]
    Turns,
    /// Turns up to LIMS, with G97.
    LimitedTurns,
    /// Metres or feet at the surface, with G96.
    Surface,
}

/// What is in force of the speed of the spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpindleSpeed {
    /// What S counts.
    pub mode: SpeedMode,
    /// LIMS, turns per minute.
    most: Option<f64>,
    /// S of the last G96, metres per minute.
    surface: Option<f64>,
    /// S in turns per minute, whatever LIMS makes of it.
    turns: Option<f64>,
}

impl Interpreter<'_> {
    /// G93 to G97, S with them, LIMS, SPOS.
    pub(super) fn spindle_words(&mut self, words: &BlockWords) -> Done {
        if let Some(most) = words.most_speed {
            if most.value <= 0.0 {
                let message = "the limit of the spindle speed must be above 0";
                return Err(Diagnostic::error(most.span, message));
            }
            self.speed.most = Some(most.value);
        }
        let mode = words.g.iter().find_map(|g| Some((mode_of(g.value)?, g)));
        match mode {
            Some((mode, g)) => self.speed_mode(mode, words.speed, *g)?,
            None => match (words.speed, words.most_speed) {
                (Some(speed), _) => self.spindle_speed(speed)?,
                (None, Some(most)) => self.limit_speed(most.span)?,
                (None, None) => {}
            },
        }
        if let Some(angle) = words.spindle_angle {
            self.control.modal.spindle = None;
            let way = match words.spindle_way {
                None | Some(Way::Shorter) => OrientWay::Shorter,
                Some(Way::Positive) => OrientWay::Clockwise,
                Some(Way::Negative) => OrientWay::Counterclockwise,
            };
            let angle = angle.value.rem_euclid(360.0);
            self.control.actions.push(Action::Orient(angle, way));
        }
        Ok(())
    }

    /// A block with G93 to G97, which is in `g`, and its S.
    fn speed_mode(&mut self, mode: SpeedMode, speed: Option<At<f64>>, g: At<u32>) -> Done {
        let before = std::mem::replace(&mut self.speed.mode, mode);
        match (speed, mode) {
            (Some(speed), SpeedMode::LimitedTurns) => {
                self.control.end_surface_speed();
                self.spindle_speed(speed)
            }
            (Some(speed), _) => self.spindle_speed(speed),
            (None, SpeedMode::Surface) if self.speed.surface.is_none() => Err(Diagnostic::error(
                g.span,
                "G96, and no cutting speed is programmed",
            )
            .help("write it beside G96, in m/min, with G70 and G700 in ft/min: G96 S200")),
            (None, SpeedMode::LimitedTurns) if self.control.modal.surface_speed => {
                self.control.turning_speed(None, g.span)
            }
            (None, _) => self.enter_speed_mode(before, g.span),
        }
    }

    /// The mode of now instead of another one, without a new speed.
    pub(super) fn enter_speed_mode(&mut self, before: SpeedMode, span: Span) -> Done {
        if before == SpeedMode::Surface && self.speed.mode != SpeedMode::Surface {
            // S may follow before it matters.
            let modal = &mut self.control.modal;
            modal.kept_speed = Some((span, modal.feed_mode));
            return Ok(());
        }
        self.limit_speed(span)
    }

    /// S, as the mode has it.
    fn spindle_speed(&mut self, speed: At<f64>) -> Done {
        if self.speed.mode == SpeedMode::Surface {
            let metres = if self.millimetres() > 2.0 { FOOT } else { 1.0 };
            self.speed.surface = Some(speed.value * metres);
            return self.cut(speed.span);
        }
        self.speed.turns = Some(speed.value);
        let value = self.limited(speed.value);
        self.control.speed(At { value, ..speed })
    }

    /// The speed in force anew, where its limit or its mode makes another one of it.
    fn limit_speed(&mut self, span: Span) -> Done {
        match (self.speed.mode, self.speed.turns) {
            (SpeedMode::Surface, _) if self.speed.surface.is_some() => self.cut(span),
            (SpeedMode::Surface, _) | (_, None) => Ok(()),
            (_, Some(turns)) => {
                let value = self.limited(turns);
                match self.control.modal.spindle_speed == Some(value) {
                    true => Ok(()),
                    false => self.control.speed(At { value, span }),
                }
            }
        }
    }

    /// LIMS counts with G97, and not with G93 to G95.
    fn limited(&self, turns: f64) -> f64 {
        match (self.speed.mode, self.speed.most) {
            (SpeedMode::LimitedTurns, Some(most)) => turns.min(most),
            _ => turns,
        }
    }

    fn cut(&mut self, span: Span) -> Done {
        self.speed.turns = None;
        match self.speed.surface {
            Some(surface) => self.control.surface_speed(surface, self.speed.most, span),
            None => Ok(()),
        }
    }
}

/// What S counts behind a G number times ten, if that says so.
fn mode_of(code: u32) -> Option<SpeedMode> {
    match code {
        930 | 940 | 950 => Some(SpeedMode::Turns),
        960 => Some(SpeedMode::Surface),
        970 => Some(SpeedMode::LimitedTurns),
        _ => None,
    }
}
