//! S: turns per minute, the cutting speed of G96, or the limit of G92.

use super::block_words::BlockWords;
use super::g_functions::OneShot;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::source::Span;

/// Metres in a foot: in G20 cutting speeds are in feet per minute.
const FOOT: f64 = 0.3048;

impl Interpreter<'_> {
    /// S, as G96, G97 and G92 beside it want it.
    pub(super) fn spindle_speed(&mut self, words: &mut BlockWords, once: &OneShot) -> Done {
        let speed = words.speed.take();
        let presets = once.place.is_some_and(|place| place.value == 920);
        match (speed, once.surface) {
            (Some(speed), surface) if presets => {
                if surface.is_some() || words.first_axis().is_some() {
                    return Err(Diagnostic::error(
                        speed.span,
                        "S beside G92 is the limit of the speed",
                    )
                    .help("write G92 S2000 in a block of its own"));
                }
                self.speed_limit = Some(speed.value);
                match self.surface_speed {
                    true => self.cut_at_speed(speed.span),
                    false => Ok(()),
                }
            }
            (speed, Some(At { value: true, span })) => {
                self.surface_speed = true;
                self.cutting_speed(speed, span)
            }
            (speed, Some(At { value: false, span })) if self.surface_speed => {
                self.surface_speed = false;
                let value = speed.map(|speed| speed.value);
                self.control.turning_speed(value, span)?;
                speed.map_or(Ok(()), |speed| self.control.speed(speed))
            }
            (Some(speed), _) if self.surface_speed => self.cutting_speed(Some(speed), speed.span),
            (Some(speed), _) => self.control.speed(speed),
            (None, _) => Ok(()),
        }
    }

    /// G96: with a new speed, or that of before.
    fn cutting_speed(&mut self, speed: Option<At<f64>>, span: Span) -> Done {
        if let Some(speed) = speed {
            let metres = if self.inch { FOOT } else { 1.0 };
            self.metres_per_minute = Some(speed.value * metres);
        }
        self.cut_at_speed(speed.map_or(span, |speed| speed.span))
    }

    fn cut_at_speed(&mut self, span: Span) -> Done {
        let Some(speed) = self.metres_per_minute else {
            return Err(Diagnostic::error(span, "G96, and no cutting speed").help("write G96 S200"));
        };
        self.control.surface_speed(speed, self.speed_limit, span)
    }
}
