//! `ANG=`: a line by its angle, and two lines of which only the end of the second is known. (Siemens,
//! SINUMERIK 840D sl, Programming Manual Fundamentals, "Contour definitions".)

use super::arc_words::absolute;
use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::moves::Corner;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// Lines whose directions differ by less have no intersection to speak of.
const PARALLEL: f64 = 1e-9;

/// The first of two lines, which ends where the second begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenLine {
    /// Degrees.
    angle: f64,
    /// What stands between both, lengths in units of the program.
    corner: Option<At<Corner>>,
    span: Span,
}

impl Interpreter<'_> {
    /// A line with ANG; `true` where it has been carried out, or waits for the next one.
    pub(super) fn line_by_angle(
        &mut self,
        words: &BlockWords,
        motion: &mut MotionWords,
        exact_stop: bool,
    ) -> Result<bool, Diagnostic> {
        let open = self.open_line.take();
        let Some(angle) = words.contour_angle else {
            return match open {
                Some(open) => Err(not_closed(open.span)),
                None => Ok(false),
            };
        };
        let straight = matches!(
            self.control.modal.motion,
            Some(Motion::Rapid | Motion::Line)
        );
        if !straight || self.arc_form.is_some() {
            return Err(
                Diagnostic::error(angle.span, "ANG belongs to straight lines")
                    .help("write G1 in this block; the angle of an arc is AR="),
            );
        }
        let [first, second, _] = self.control.modal.plane.axes();
        let start = self.known_in_plane(angle.span)?;
        let given = [first, second].map(|axis| motion.axes[axis]);
        match (open, given) {
            (None, [None, None]) => {
                if motion.names_an_axis() {
                    return Err(needs_one(angle.span));
                }
                self.open_line = Some(OpenLine {
                    angle: angle.value,
                    corner: words.corner,
                    span: angle.span,
                });
                Ok(true)
            }
            (None, [Some(_), Some(_)]) => Err(needs_one(angle.span)),
            (None, _) => {
                let end = self.end_by_angle(start, given, angle)?;
                motion.axes[first] = Some(absolute(end[0], angle.span));
                motion.axes[second] = Some(absolute(end[1], angle.span));
                Ok(false)
            }
            (Some(open), [Some(_), Some(_)]) => {
                self.refuse_increments(&given)?;
                let end = [0, 1].map(|at| self.target(given[at], start[at]));
                let corner =
                    intersection(start, open.angle, end, angle.value).ok_or_else(|| {
                        Diagnostic::error(
                            angle.span,
                            "these two lines do not meet between start and end",
                        )
                        .help("check both angles and the end point")
                    })?;
                if let Some(feed) = words.feed {
                    return Err(
                        Diagnostic::error(feed.span, "a feed for the second line only")
                            .help("write F in the block of the first line"),
                    );
                }
                let mut until = MotionWords::default();
                until.axes[first] = Some(absolute(corner[0], open.span));
                until.axes[second] = Some(absolute(corner[1], open.span));
                self.control.motion(&until, open.span, false, exact_stop)?;
                self.corner_after(open.corner)?;
                Ok(false)
            }
            (Some(open), _) => Err(not_closed(open.span)),
        }
    }

    /// Whether a block that does something else comes between two lines.
    pub(super) fn check_open_line(&mut self, words: &BlockWords) -> Done {
        let goes_on = words.contour_angle.is_some() || (words.m.is_empty() && !words.is_motion());
        match self.open_line.filter(|_| !goes_on) {
            Some(open) => {
                self.open_line = None;
                Err(not_closed(open.span))
            }
            None => Ok(()),
        }
    }

    /// Refuses an end of two lines that does not say whether it counts from their start or from where they meet.
    fn refuse_increments(&self, given: &[Option<At<(f64, Dimension)>>; 2]) -> Done {
        let mut words = given.iter().flatten();
        match words.find(|word| self.is_incremental(word.value.1)) {
            None => Ok(()),
            Some(word) => Err(Diagnostic::error(
                word.span,
                "an increment as the end of two lines with ANG",
            )
            .help("write both coordinates absolute: X=AC(50) Y=AC(20) ANG=90")),
        }
    }

    fn target(&self, word: Option<At<(f64, Dimension)>>, start: f64) -> f64 {
        let Some((value, dimension)) = word.map(|word| word.value) else {
            return start;
        };
        match self.is_incremental(dimension) {
            true => start + value,
            false => value,
        }
    }

    /// The end of a line of which one coordinate in the plane is given.
    fn end_by_angle(
        &self,
        start: [f64; 2],
        given: [Option<At<(f64, Dimension)>>; 2],
        angle: At<f64>,
    ) -> Result<[f64; 2], Diagnostic> {
        let (sin, cos) = sin_cos_degrees(angle.value);
        let along = usize::from(given[0].is_none());
        let direction = [cos, sin];
        let step = self.target(given[along], start[along]) - start[along];
        let length = step / direction[along];
        if direction[along].abs() < PARALLEL || length < 0.0 {
            return Err(Diagnostic::error(
                angle.span,
                format!("a line at {} degrees does not lead there", angle.value),
            )
            .help("ANG counts from the first axis of the plane, counterclockwise"));
        }
        let mut end = [0, 1].map(|at| start[at] + length * direction[at]);
        end[along] = start[along] + step;
        Ok(end)
    }
}

/// Where a line from `start` at one angle meets a line to `end` at another; `None` where they do not, or
/// behind the start or the end.
fn intersection(start: [f64; 2], first: f64, end: [f64; 2], second: f64) -> Option<[f64; 2]> {
    let (first_sin, first_cos) = sin_cos_degrees(first);
    let (second_sin, second_cos) = sin_cos_degrees(second);
    let cross = first_cos * second_sin - first_sin * second_cos;
    let chord = [end[0] - start[0], end[1] - start[1]];
    let length = (chord[0] * second_sin - chord[1] * second_cos) / cross;
    let rest = (first_cos * chord[1] - first_sin * chord[0]) / cross;
    let meets = cross.abs() > PARALLEL && length > 0.0 && rest > 0.0;
    meets.then(|| [start[0] + length * first_cos, start[1] + length * first_sin])
}

fn needs_one(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "ANG stands beside one coordinate of the plane, or alone",
    )
    .help("G1 X50 ANG=30 is one line; G1 ANG=30 and then X50 Y20 ANG=90 are two that meet")
}

fn not_closed(span: Span) -> Diagnostic {
    Diagnostic::error(span, "the line that begins here has no end")
        .help("the next block gives the end of the second line with its angle: X50 Y20 ANG=90")
}

#[cfg(test)]
mod tests {
    use super::intersection;

    #[test]
    fn lines_meet_in_front_of_both() {
        let near = |a: Option<[f64; 2]>, b: [f64; 2]| {
            a.is_some_and(|a| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12)
        };
        assert!(near(
            intersection([0.0, 0.0], 0.0, [10.0, 5.0], 90.0),
            [10.0, 0.0]
        ));
        assert!(near(
            intersection([0.0, 0.0], 45.0, [20.0, 0.0], -45.0),
            [10.0, 10.0]
        ));
        assert_eq!(intersection([0.0, 0.0], 0.0, [10.0, 5.0], 0.0), None);
        assert_eq!(intersection([0.0, 0.0], 180.0, [10.0, 5.0], 90.0), None);
        assert_eq!(intersection([0.0, 0.0], 0.0, [10.0, 5.0], -90.0), None);
    }
}
