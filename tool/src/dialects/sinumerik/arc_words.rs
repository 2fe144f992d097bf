//! Which form an arc has: a centre or a radius, an opening angle (AR), an intermediate point (CIP), or
//! the tangent of the path before (CT).

use super::block_words::BlockWords;
use super::evaluate_words::OneShot;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords};
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// Places along the normal of the plane that differ by less, in units of the program, are the same.
const SAME_PLACE: f64 = 1e-6;

/// The motions that are arcs of another form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcForm {
    /// Over an intermediate point.
    Cip,
    /// Tangent to the path before.
    Ct,
}

impl Interpreter<'_> {
    /// The motion of a block, by G0 to G3, CIP or CT.
    pub(super) fn path_motion(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        let own_feed = words.feed.is_some();
        let mut motion = words.motion;
        self.resolve_polar(words, &mut motion)?;
        let span = motion.first_axis().unwrap_or(block);
        if let Some(middle) = words.middle.iter().flatten().next()
            && self.arc_form != Some(ArcForm::Cip)
        {
            return Err(
                Diagnostic::error(middle.span, "I1, J1 and K1 belong to CIP")
                    .help("write CIP in this block, or I, J and K for a centre"),
            );
        }
        if self.line_by_angle(words, &mut motion, once.exact_stop)? {
            return Ok(());
        }
        if self.offset_free.active {
            self.refuse_arc_words(words, span)?;
            let mut state = self.offset_free;
            self.control.offset_free_motion(
                &motion,
                &mut state,
                block,
                own_feed,
                once.exact_stop,
            )?;
            self.offset_free = state;
            return Ok(());
        }
        match self.arc_form {
            None => {
                if let Some(opening) = words.opening {
                    self.resolve_opening(opening, &mut motion)?;
                }
                if words.opening.is_some() {
                    return self
                        .control
                        .motion(&motion, block, own_feed, once.exact_stop);
                }
                self.motion_in_its_plane(&motion, block, own_feed, once.exact_stop)
            }
            Some(form) => {
                if motion.names_a_centre() || words.opening.is_some() || motion.turns.is_some() {
                    return Err(Diagnostic::error(
                        span,
                        "CIP and CT have neither centre nor radius",
                    )
                    .help("write G2 or G3 for an arc by its centre or radius"));
                }
                match form {
                    ArcForm::Ct => self.control.tangent_arc(&motion, own_feed, span),
                    ArcForm::Cip => self.arc_over(words, &motion, own_feed, span),
                }
            }
        }
    }

    /// While the work offset is off there are straight lines only.
    fn refuse_arc_words(&self, words: &BlockWords, span: Span) -> Done {
        let opening = words.opening.map(|word| word.span);
        match self.arc_form.map(|_| span).or(opening) {
            None => Ok(()),
            Some(span) => Err(Diagnostic::error(
                span,
                "an arc while the work offset is off (G500)",
            )
            .help("set a work offset of the machine to 0 and select it instead of G500")),
        }
    }

    fn arc_over(
        &mut self,
        words: &BlockWords,
        motion: &MotionWords,
        own_feed: bool,
        span: Span,
    ) -> Done {
        let [first, second, normal] = self.control.modal.plane.axes();
        if let Some(middle) = words.middle[normal] {
            self.check_stays_in_plane(middle, motion.axes[normal], normal)?;
        }
        let middle = [first, second].map(|axis| words.middle[axis]);
        if middle.iter().any(Option::is_none) {
            return Err(Diagnostic::error(
                span,
                "CIP needs both coordinates of its intermediate point",
            )
            .help("write CIP X20 Y0 I1=10 J1=10"));
        }
        self.control.arc_through(motion, middle, own_feed, span)
    }

    /// Refuses an arc over an intermediate point that is given along all axes, unless it stays in the plane.
    /// `middle`, `end`: its places along the normal, axis `normal`.
    fn check_stays_in_plane(
        &self,
        middle: At<(f64, Dimension)>,
        end: Option<At<(f64, Dimension)>>,
        normal: usize,
    ) -> Done {
        let start = self.control.present(normal);
        let rise = |word: At<(f64, Dimension)>| match word.value {
            (value, Dimension::Incremental) => Some(value),
            (value, Dimension::Modal) if self.control.modal.incremental => Some(value),
            (value, _) => start.map(|start| value - start),
        };
        let stays = |rise: f64| rise.abs() <= SAME_PLACE;
        let message = match (rise(middle), end.map_or(Some(0.0), rise)) {
            (Some(middle), Some(end)) if stays(middle) && stays(end) => return Ok(()),
            (Some(middle), Some(_)) if stays(middle) => {
                "this arc leaves the plane behind its intermediate point"
            }
            (Some(_), Some(_)) => "an intermediate point outside of the plane",
            _ => {
                let name = AXES[normal];
                return Err(Diagnostic::error(
                    middle.span,
                    format!("where this arc begins along {name} is not known ahead of time"),
                )
                .help(format!(
                    "program {name} absolute before, or leave the intermediate point along {name} out"
                )));
            }
        };
        Err(Diagnostic::error(middle.span, message)
            .help("CIP makes arcs in the plane that is active: turn the plane with ROT"))
    }

    /// `AR=`: with the centre it gives the end, with the end the centre.
    fn resolve_opening(&mut self, opening: At<f64>, motion: &mut MotionWords) -> Done {
        let span = opening.span;
        let clockwise = match self.control.modal.motion {
            Some(Motion::Clockwise) => true,
            Some(Motion::Counterclockwise) => false,
            _ => {
                return Err(Diagnostic::error(span, "AR belongs to arcs")
                    .help("write G2 (clockwise) or G3 (counterclockwise) in this block"));
            }
        };
        if !(opening.value > 0.0 && opening.value < 360.0) {
            return Err(
                Diagnostic::error(span, format!("an arc of {} degrees", opening.value))
                    .help("AR lies between 0 and 360 degrees; full circles have a centre only"),
            );
        }
        if let Some(radius) = motion.radius {
            return Err(Diagnostic::error(radius.span, "an arc with AR has no CR")
                .help("give the centre or the end with AR"));
        }
        let [first, second, _] = self.control.modal.plane.axes();
        let plane = [first, second];
        let start = self.known_in_plane(span)?;
        let has_centre = plane.iter().any(|&axis| motion.centre[axis].is_some());
        let has_end = plane.iter().any(|&axis| motion.axes[axis].is_some());
        let (sin, cos) = sin_cos_degrees(if clockwise {
            -opening.value
        } else {
            opening.value
        });
        match (has_centre, has_end) {
            (true, false) => {
                let offset = [0, 1].map(|at| match motion.centre[plane[at]] {
                    Some(At {
                        value: (value, Dimension::Absolute),
                        ..
                    }) => value - start[at],
                    Some(word) => word.value.0,
                    None => 0.0,
                });
                // From the centre to the start, turned.
                let end = [
                    start[0] + offset[0] - offset[0] * cos + offset[1] * sin,
                    start[1] + offset[1] - offset[0] * sin - offset[1] * cos,
                ];
                for at in [0, 1] {
                    motion.axes[plane[at]] = Some(absolute(end[at], span));
                }
            }
            (false, true) => {
                let chord = [0, 1].map(|at| match motion.axes[plane[at]] {
                    Some(At {
                        value: (value, dimension),
                        ..
                    }) => match (dimension, self.control.modal.incremental) {
                        (Dimension::Incremental, _) | (Dimension::Modal, true) => value,
                        _ => value - start[at],
                    },
                    None => 0.0,
                });
                // The centre lies on the bisector of the chord, where it sees half of it under half of
                // the angle.
                let (half_sin, half_cos) = sin_cos_degrees(opening.value / 2.0);
                let aside = if clockwise { -0.5 } else { 0.5 } * half_cos / half_sin;
                let centre = [
                    0.5 * chord[0] - aside * chord[1],
                    0.5 * chord[1] + aside * chord[0],
                ];
                for at in [0, 1] {
                    motion.centre[plane[at]] = Some(At {
                        value: (centre[at], Dimension::Modal),
                        span,
                    });
                }
            }
            _ => {
                return Err(Diagnostic::error(
                    span,
                    "AR needs either the centre or the end of the arc",
                )
                .help("write G2 X10 Y10 AR=90, or G2 I5 J0 AR=90"));
            }
        }
        Ok(())
    }

    /// Where the tool is along the axes of the plane, units of the program.
    pub(super) fn known_in_plane(&self, span: Span) -> Result<[f64; 2], Diagnostic> {
        let [first, second, _] = self.control.modal.plane.axes();
        match [first, second].map(|axis| self.control.present(axis)) {
            [Some(a), Some(b)] => Ok([a, b]),
            _ => Err(Diagnostic::error(
                span,
                "where the tool is in the plane is not known ahead of time",
            )
            .help("program both axes of the plane absolute before")),
        }
    }
}

/// An absolute coordinate.
pub(super) fn absolute(value: f64, span: Span) -> At<(f64, Dimension)> {
    At {
        value: (value, Dimension::Absolute),
        span,
    }
}
