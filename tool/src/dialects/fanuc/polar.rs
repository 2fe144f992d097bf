//! Polar coordinates, G16: X is a radius round the zero of the program, Y an angle from X, counterclockwise. Both hold
//! until they are named again; the angle may be an increment. (Fanuc, Series 30i, User's Manual, "Polar coordinate
//! command".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::Plane;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// The place that was named last: the radius, units of length of the machine, and the angle, degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolarPlace {
    radius: Option<f64>,
    angle: Option<f64>,
}

impl Interpreter<'_> {
    /// G16.
    pub(super) fn begin_polar(&mut self, span: Span) -> Done {
        if self.control.modal.plane != Plane::Xy {
            return Err(Diagnostic::error(span, "G16 outside of G17")
                .help("write G17 before, or post X, Y and Z"));
        }
        self.polar.get_or_insert_default();
        Ok(())
    }

    /// The words of a motion, with the place of X and Y where they are polar.
    pub(super) fn place_words(
        &mut self,
        words: &mut BlockWords,
        block: Span,
    ) -> Result<MotionWords, Diagnostic> {
        let mut motion = self.motion_words(words);
        if self.polar.is_some() {
            self.resolve_polar(&mut motion, block)?;
            if let Some(corner) = words.corner {
                return Err(Diagnostic::error(corner.span, ",R or ,C in G16")
                    .help("write G15 before, with X and Y"));
            }
        }
        Ok(motion)
    }

    /// Replaces a radius in X and an angle in Y by the coordinates of their place.
    pub(super) fn resolve_polar(&mut self, motion: &mut MotionWords, block: Span) -> Done {
        let Some(mut polar) = self.polar else {
            return Ok(());
        };
        let arc = matches!(
            self.control.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        );
        if motion.names_a_centre() || arc && self.cycle.is_none() && motion.names_an_axis() {
            return Err(Diagnostic::error(block, "an arc in G16")
                .help("write G15 before, with X and Y of its end"));
        }
        let [radius, angle] = [motion.axes[0], motion.axes[1]];
        let Some(span) = radius.or(angle).map(|word| word.span) else {
            return Ok(());
        };
        if !self.transforms.is_empty() || self.control.modal.plane != Plane::Xy {
            return Err(Diagnostic::error(
                span,
                "polar coordinates outside of G17, or under G51, G51.1, G68 or G68.2",
            )
            .help("write G15 before, with X and Y"));
        }
        let incremental = self.control.modal.incremental;
        if let Some(radius) = radius {
            if incremental {
                return Err(Diagnostic::error(
                    radius.span,
                    "the radius of G16 in G91, from the place of the tool",
                )
                .help("write the radius with G90; the angle alone may be an increment"));
            }
            polar.radius = Some(radius.value.0 * self.control.modal.length_factor);
        }
        if let Some(angle) = angle {
            let from = match incremental {
                true => polar.angle,
                false => Some(0.0),
            };
            polar.angle = from.map(|from| from + angle.value.0);
        }
        let (Some(radius), Some(angle)) = (polar.radius, polar.angle) else {
            return Err(Diagnostic::error(
                span,
                "the first place behind G16 needs its radius and its angle",
            )
            .help("write G90 G16, and then X50. Y30. for the radius 50 at 30 degrees"));
        };
        self.polar = Some(polar);
        let (sin, cos) = sin_cos_degrees(angle);
        for (axis, along) in [cos, sin].into_iter().enumerate() {
            let value = radius * along / self.control.modal.length_factor;
            motion.axes[axis] = Some(At {
                value: (value, Dimension::Absolute),
                span,
            });
        }
        Ok(())
    }
}
