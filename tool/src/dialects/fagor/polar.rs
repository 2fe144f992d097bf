//! Polar coordinates: G93, places given by R and Q, and lines by their angle Q and one coordinate.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// The origin of polar coordinates along the axes of the plane, machine units. Arcs leave it where it is, as on
/// controls whose machine parameter PORGMOVE is NO.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolarOrigin(pub [f64; 2]);

impl Interpreter<'_> {
    /// `G93 I10 J20`; G93 alone takes the present place.
    pub(super) fn polar_origin(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        (rest.axes, rest.centre) = Default::default();
        self.alone(&rest, 93, span)?;
        let [i, j, k] = words.centre;
        if let Some(other) = k.map(|k| k.span).or(words.first_axis()) {
            return Err(Diagnostic::error(other, "G93 has I and J only")
                .help("G93 I10 J20 sets the origin of polar coordinates"));
        }
        self.polar = PolarOrigin(
            match (i, j) {
                (None, None) => self.present_in_plane(span)?,
                (i, j) => [i, j].map(|word| word.map_or(0.0, |word| word.value)),
            }
            .map(|value| value * self.control.modal.length_factor),
        );
        Ok(())
    }

    /// Where the tool is along the axes of the plane, units of the program.
    fn present_in_plane(&self, span: Span) -> Result<[f64; 2], Diagnostic> {
        let [first, second, _] = self.control.modal.plane.axes();
        match [first, second].map(|axis| self.control.present(axis)) {
            [Some(a), Some(b)] => Ok([a, b]),
            _ => Err(Diagnostic::unknown_place(
                span,
                "polar coordinates from a place that is not known ahead of time",
            )
            .help("program both axes of the plane absolute before")),
        }
    }

    /// Replaces R and Q of a block by coordinates of the axes, absolute.
    pub(super) fn resolve_polar(
        &mut self,
        words: &BlockWords,
        motion: &mut MotionWords,
        kind: Option<Motion>,
    ) -> Done {
        let Some(angle) = words.angle else {
            let polar_radius = words.radius.filter(|_| words.first_axis().is_none());
            return match (polar_radius, kind) {
                (Some(radius), Some(Motion::Rapid | Motion::Line)) => {
                    let present = self.present_in_plane(radius.span)?;
                    let from = self.relative_to_origin(present);
                    let mut distance = radius;
                    if self.control.modal.incremental {
                        distance.value += from[0].hypot(from[1]);
                    }
                    self.place_at(motion, distance, from[1].atan2(from[0]).to_degrees())
                }
                _ => Ok(()),
            };
        };
        let [first, second, _] = self.control.modal.plane.axes();
        let straight = matches!(kind, None | Some(Motion::Rapid | Motion::Line));
        match [motion.axes[first], motion.axes[second]] {
            [Some(word), None] if straight && words.radius.is_none() => {
                return self.along_angle(angle, word, [0, 1], motion);
            }
            [None, Some(word)] if straight && words.radius.is_none() => {
                return self.along_angle(angle, word, [1, 0], motion);
            }
            _ => {}
        }
        if let Some(axis) = motion.axes[first].or(motion.axes[second]) {
            return Err(Diagnostic::error(
                axis.span,
                "polar and rectangular coordinates in one block",
            )
            .help("a place is given by R and Q or by the axes of the plane"));
        }
        match kind {
            Some(Motion::Clockwise | Motion::Counterclockwise) => self.polar_arc(angle, motion),
            _ => self.polar_place(angle, words.radius, motion),
        }
    }

    /// A line in the direction Q to one of its coordinates. `given`, `other`: along which axes of the plane
    /// the coordinate is, and the one that is looked for.
    fn along_angle(
        &mut self,
        angle: At<f64>,
        word: At<(f64, Dimension)>,
        [given, other]: [usize; 2],
        motion: &mut MotionWords,
    ) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let start = self.present_in_plane(angle.span)?;
        let way = match self.control.modal.incremental {
            true => word.value.0,
            false => word.value.0 - start[given],
        };
        let (sin, cos) = sin_cos_degrees(angle.value);
        let direction = [cos, sin];
        // The angle is that of the line: which way along it, the coordinate says.
        if way == 0.0 || direction[given].abs() < 1e-9 {
            return Err(Diagnostic::error(
                angle.span,
                "the angle Q does not lead to this coordinate",
            )
            .help("Q is the angle of the line with the first axis of the plane"));
        }
        let mut end = start;
        end[given] += way;
        end[other] += way * direction[other] / direction[given];
        for (axis, value) in [first, second].into_iter().zip(end) {
            motion.axes[axis] = Some(At {
                value: (value, Dimension::Absolute),
                span: word.span,
            });
        }
        Ok(())
    }

    /// The origin in units of the program.
    fn origin(&self) -> [f64; 2] {
        let PolarOrigin(origin) = self.polar;
        origin.map(|value| value / self.control.modal.length_factor)
    }

    fn relative_to_origin(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let origin = self.origin();
        [a - origin[0], b - origin[1]]
    }

    /// G91: R and Q count from the present place. A missing R keeps the distance from the origin.
    fn polar_place(
        &mut self,
        angle: At<f64>,
        radius: Option<At<f64>>,
        motion: &mut MotionWords,
    ) -> Done {
        let incremental = self.control.modal.incremental;
        let (mut distance, mut direction) = (0.0, 0.0);
        if incremental || radius.is_none() {
            let from = self.relative_to_origin(self.present_in_plane(angle.span)?);
            distance = from[0].hypot(from[1]);
            direction = from[1].atan2(from[0]).to_degrees();
        }
        let distance = match (radius, incremental) {
            (Some(radius), true) => distance + radius.value,
            (Some(radius), false) => radius.value,
            (None, _) => distance,
        };
        let direction = match incremental {
            true => direction + angle.value,
            false => angle.value,
        };
        let distance = At {
            value: distance,
            span: radius.unwrap_or(angle).span,
        };
        self.place_at(motion, distance, direction)
    }

    fn place_at(&self, motion: &mut MotionWords, distance: At<f64>, direction: f64) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let (sin, cos) = sin_cos_degrees(direction);
        let [a, b] = self.origin();
        let place = [a + distance.value * cos, b + distance.value * sin];
        for (axis, value) in [first, second].into_iter().zip(place) {
            motion.axes[axis] = Some(At {
                value: (value, Dimension::Absolute),
                span: distance.span,
            });
        }
        motion.radius = None;
        Ok(())
    }

    /// An arc to the direction Q, seen from its centre: I and J, or the polar origin.
    fn polar_arc(&mut self, angle: At<f64>, motion: &mut MotionWords) -> Done {
        if let Some(radius) = motion.radius {
            return Err(
                Diagnostic::error(radius.span, "an arc to an angle Q has no R")
                    .help("give the centre with I and J, or the polar origin with G93"),
            );
        }
        let [first, second, _] = self.control.modal.plane.axes();
        let start = self.present_in_plane(angle.span)?;
        let given = motion.centre[first].is_some() || motion.centre[second].is_some();
        let centre = match given {
            true => {
                let along = |axis: usize, start: f64| match motion.centre[axis] {
                    Some(At {
                        value: (value, Dimension::Absolute),
                        ..
                    }) => value,
                    Some(word) => start + word.value.0,
                    None => start,
                };
                [along(first, start[0]), along(second, start[1])]
            }
            false => self.origin(),
        };
        let from = [start[0] - centre[0], start[1] - centre[1]];
        let radius = from[0].hypot(from[1]);
        let begin = from[1].atan2(from[0]).to_degrees();
        let end = match self.control.modal.incremental {
            true => begin + angle.value,
            false => angle.value,
        };
        let turn = (end - begin).rem_euclid(360.0);
        let closes = turn.min(360.0 - turn) < 1e-9;
        let (sin, cos) = sin_cos_degrees(end);
        let end = match closes {
            true => start,
            false => [centre[0] + radius * cos, centre[1] + radius * sin],
        };
        for (index, axis) in [first, second].into_iter().enumerate() {
            motion.axes[axis] = Some(At {
                value: (end[index], Dimension::Absolute),
                span: angle.span,
            });
            motion.centre[axis] = Some(At {
                value: (centre[index] - start[index], Dimension::Modal),
                span: angle.span,
            });
        }
        Ok(())
    }

    /// The origin of polar coordinates is the part zero again.
    pub(super) fn reset_polar_origin(&mut self) {
        self.polar = PolarOrigin::default();
    }
}
