//! Arcs that are given otherwise than by centre or radius.

use super::words::{At, Dimension, MotionWords};
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::source::Span;

impl Control<'_> {
    /// The arc from here over an intermediate point to the end, both in the active plane. `middle` has
    /// the coordinates of the intermediate point along the first and the second axis, in units of the
    /// program, as the axes of `words` have those of the end.
    pub fn arc_through(
        &mut self,
        words: &MotionWords,
        middle: [Option<At<(f64, Dimension)>>; 2],
        own_feed: bool,
        span: Span,
    ) -> Done {
        self.check_feed(own_feed, span)?;
        let mut path = self.path(words)?;
        let [first, second, _] = self.modal.plane.axes();
        let mut over = [0.0; 2];
        for ((offset, axis), word) in over.iter_mut().zip([first, second]).zip(middle) {
            let Some(word) = word else {
                continue;
            };
            let value = word.value.0 * self.modal.length_factor;
            let incremental = match word.value.1 {
                Dimension::Modal => self.modal.incremental,
                Dimension::Absolute => false,
                Dimension::Incremental => true,
            };
            *offset = match incremental {
                true => value,
                false => value - self.known_start(&path, axis, span)?,
            };
        }
        let chord = self.chord(&path, span)?;
        let Some((centre, clockwise)) = circle_through(over, chord) else {
            return Err(
                Diagnostic::error(span, "these three points do not lie on a circle")
                    .help("they must be different and not on a line"),
            );
        };
        path.kind = arc(centre, clockwise);
        self.add_move(path, span)
    }

    /// The arc that goes on in the direction in which the last motion ended.
    pub fn tangent_arc(&mut self, words: &MotionWords, own_feed: bool, span: Span) -> Done {
        self.check_feed(own_feed, span)?;
        let mut path = self.path(words)?;
        let [first, second, _] = self.modal.plane.axes();
        let chord = self.chord(&path, span)?;
        let Some(tangent) = self.modal.tangent else {
            return Err(Diagnostic::unknown_place(
                span,
                "a tangent arc, and the direction before it is not known ahead of time",
            )
            .help("program a line or an arc with all axes of the plane before it"));
        };
        match tangent_centre([tangent[first], tangent[second]], chord) {
            Some((centre, clockwise)) => path.kind = arc(centre, clockwise),
            None if tangent[first] * chord[0] + tangent[second] * chord[1] > 0.0 => {
                path.kind = MoveKind::Line;
            }
            None => {
                return Err(Diagnostic::error(span, "no arc leads straight back")
                    .help("a tangent arc ends beside the direction of the last motion"));
            }
        }
        self.add_move(path, span)
    }

    /// A move to the targets of `words`, of no kind yet.
    fn path(&mut self, words: &MotionWords) -> Result<Move, Diagnostic> {
        Ok(Move {
            kind: MoveKind::Line,
            target: super::motion::targets(words, &self.modal, self.settings, self.diagnostics)?,
            start: self.modal.position.coordinates(),
            exact_stop: false,
            corner: None,
        })
    }

    fn known_start(&self, path: &Move, axis: usize, span: Span) -> Result<f64, Diagnostic> {
        path.start[axis].ok_or_else(|| {
            Diagnostic::unknown_place(span, "where this arc begins is not known ahead of time")
                .help("program the axes of the plane absolute before the arc")
        })
    }

    /// From the start of a move to its end, along the axes of the plane.
    fn chord(&self, path: &Move, span: Span) -> Result<[f64; 2], Diagnostic> {
        let [first, second, _] = self.modal.plane.axes();
        let along = |axis: usize| -> Result<f64, Diagnostic> {
            Ok(match path.target[axis] {
                Coordinate::Keep => 0.0,
                Coordinate::By(step) => step,
                Coordinate::At(end) => end - self.known_start(path, axis, span)?,
            })
        };
        Ok([along(first)?, along(second)?])
    }
}

fn arc(centre: [f64; 2], clockwise: bool) -> MoveKind {
    MoveKind::Arc(Arc {
        clockwise,
        centre: Centre::Offset(centre),
        extra_turns: 0,
    })
}

/// Centre and direction of the arc from the origin over `middle` to `end`; `None` where the points lie
/// on a line or coincide.
fn circle_through(middle: [f64; 2], end: [f64; 2]) -> Option<([f64; 2], bool)> {
    let cross = middle[0] * end[1] - middle[1] * end[0];
    let [a, b] = [middle, end].map(|point| point[0] * point[0] + point[1] * point[1]);
    // The distance of the middle from the chord, relative to the lengths.
    if cross.abs() <= 1e-9 * (a * b).sqrt().max(f64::MIN_POSITIVE) {
        return None;
    }
    let centre = [
        (a * end[1] - b * middle[1]) / (2.0 * cross),
        (b * middle[0] - a * end[0]) / (2.0 * cross),
    ];
    // Counterclockwise, the end is on the left of the line to the middle.
    Some((centre, cross < 0.0))
}

/// Centre and direction of the arc from the origin to `end` that begins along `tangent`; `None` where
/// the end lies straight ahead.
fn tangent_centre(tangent: [f64; 2], end: [f64; 2]) -> Option<([f64; 2], bool)> {
    let length = tangent[0].hypot(tangent[1]);
    let left = [-tangent[1] / length, tangent[0] / length];
    let off = left[0] * end[0] + left[1] * end[1];
    let squared = end[0] * end[0] + end[1] * end[1];
    if length == 0.0 || off.abs() <= 1e-9 * squared.sqrt() {
        return None;
    }
    let radius = squared / (2.0 * off);
    Some(([left[0] * radius, left[1] * radius], radius < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_points_give_centre_and_direction() {
        let (centre, clockwise) = circle_through([5.0, 5.0], [10.0, 0.0]).unwrap();
        assert!((centre[0] - 5.0).abs() < 1e-12 && centre[1].abs() < 1e-12 && clockwise);
        let (centre, clockwise) = circle_through([5.0, -5.0], [10.0, 0.0]).unwrap();
        assert!((centre[0] - 5.0).abs() < 1e-12 && centre[1].abs() < 1e-12 && !clockwise);
        assert_eq!(circle_through([5.0, 0.0], [10.0, 0.0]), None);
        assert_eq!(circle_through([0.0, 0.0], [10.0, 0.0]), None);
    }

    #[test]
    fn a_tangent_arc_begins_straight_on() {
        let (centre, clockwise) = tangent_centre([3.0, 0.0], [0.0, 10.0]).unwrap();
        assert!(centre[0].abs() < 1e-12 && (centre[1] - 5.0).abs() < 1e-12 && !clockwise);
        let (centre, clockwise) = tangent_centre([0.0, 1.0], [10.0, 0.0]).unwrap();
        assert!((centre[0] - 5.0).abs() < 1e-12 && centre[1].abs() < 1e-12 && clockwise);
        assert_eq!(tangent_centre([1.0, 0.0], [7.0, 0.0]), None);
    }
}
