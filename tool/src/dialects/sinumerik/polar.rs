//! Polar coordinates: the pole (G110 to G112), the angle AP and the radius RP. (Siemens, SINUMERIK 840D
//! sl, Programming Manual Fundamentals, "Motion commands with polar coordinates".)

use super::arc_words::absolute;
use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::Plane;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// The pole and the last polar coordinates: along the axes of the plane, machine units and degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pole {
    at: [f64; 2],
    angle: Option<f64>,
    radius: Option<f64>,
}

impl Pole {
    /// AP stays until a pole is set or the plane changes.
    fn forget_angle(&mut self) {
        self.angle = None;
    }
}

impl Interpreter<'_> {
    /// G17 to G19.
    pub(super) fn choose_plane(&mut self, plane: Plane, span: Span) -> Done {
        if plane != self.control.modal.plane {
            self.pole.forget_angle();
        }
        self.control.plane(plane, span)
    }

    /// `G110 X5 Y5`: the pole from the present place; `G111` from the zero; `G112` from the last pole.
    pub(super) fn set_pole(&mut self, words: &BlockWords, g: At<u32>) -> Done {
        let [first, second, normal] = self.control.modal.plane.axes();
        if let Some(word) = words.motion.axes[normal] {
            return Err(
                Diagnostic::error(word.span, "a pole lies in the plane that is active")
                    .help("name the two axes of the plane only"),
            );
        }
        let factor = self.control.modal.length_factor;
        let base = match g.value {
            110 => self.known_in_plane(g.span)?.map(|value| value * factor),
            111 => [0.0; 2],
            _ => self.pole.at,
        };
        let offset = match (words.polar_angle, words.polar_radius) {
            (Some(angle), Some(radius)) => {
                let (sin, cos) = sin_cos_degrees(angle.value.0);
                [radius.value.0 * cos, radius.value.0 * sin]
            }
            (None, None) => {
                [first, second].map(|axis| words.motion.axes[axis].map_or(0.0, |word| word.value.0))
            }
            (Some(word), None) | (None, Some(word)) => {
                return Err(Diagnostic::error(
                    word.span,
                    "a pole in polar coordinates needs AP and RP",
                )
                .help("write G111 AP=30 RP=50, or G111 X40 Y25"));
            }
        };
        self.pole.at = [0, 1].map(|at| base[at] + offset[at] * factor);
        self.pole.forget_angle();
        Ok(())
    }

    /// Replaces AP and RP by coordinates of the axes; one that is missing keeps its last value.
    pub(super) fn resolve_polar(&mut self, words: &BlockWords, motion: &mut MotionWords) -> Done {
        let Some(word) = words.polar_angle.or(words.polar_radius) else {
            return Ok(());
        };
        let span = word.span;
        let [first, second, _] = self.control.modal.plane.axes();
        if let Some(axis) = motion.axes[first].or(motion.axes[second]) {
            return Err(Diagnostic::error(
                axis.span,
                "polar and rectangular coordinates in one block",
            )
            .help("a place is given by AP and RP or by the axes of the plane"));
        }
        let factor = self.control.modal.length_factor;
        let angle = merged(words.polar_angle, self.pole.angle, "AP", span)?;
        let radius = merged(
            words.polar_radius,
            self.pole.radius.map(|radius| radius / factor),
            "RP",
            span,
        )?;
        self.pole.angle = Some(angle);
        self.pole.radius = Some(radius * factor);
        let pole = self.pole.at.map(|value| value / factor);
        let (sin, cos) = sin_cos_degrees(angle);
        let place = [pole[0] + radius * cos, pole[1] + radius * sin];
        let is_arc = matches!(
            self.control.modal.motion,
            Some(Motion::Clockwise | Motion::Counterclockwise)
        );
        if is_arc && self.arc_form.is_none() && !motion.names_a_centre() {
            // The pole is the centre.
            let start = self.known_in_plane(span)?;
            for (at, axis) in [first, second].into_iter().enumerate() {
                motion.centre[axis] = Some(At {
                    value: (pole[at] - start[at], Dimension::Modal),
                    span,
                });
            }
        }
        for (at, axis) in [first, second].into_iter().enumerate() {
            motion.axes[axis] = Some(absolute(place[at], span));
        }
        Ok(())
    }
}

/// The value of AP or RP: absolute, or with IC from the last one.
fn merged(
    word: Option<At<(f64, Dimension)>>,
    last: Option<f64>,
    name: &str,
    span: Span,
) -> Result<f64, Diagnostic> {
    let missing = || {
        Diagnostic::error(span, format!("{name} has no value yet"))
            .help(
                "the first polar block names both, G1 AP=30 RP=50; behind a new pole and another plane AP is \
                 named again",
            )
    };
    match word {
        Some(At {
            value: (value, Dimension::Incremental),
            ..
        }) => last.map(|last| last + value).ok_or_else(missing),
        Some(word) => Ok(word.value.0),
        None => last.ok_or_else(missing),
    }
}
