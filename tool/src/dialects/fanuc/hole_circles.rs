//! Holes on a circle, of Haas mills: G70 all round, G71 on an arc.
//!
//! `G70 I20. J15. L8`, `G71 I20. J15. K30. L4`: I is the radius round the place of the tool, J the angle of the first
//! hole from the first axis, counterclockwise, K the angle from hole to hole, L how many there are. The canned cycle
//! that is in force makes each. (Haas Automation, Mill Operator's Manual, "G70 Bolt Hole Circle", "G71 Bolt Hole Arc".)

use super::block_words::{BlockWords, g_name};
use super::cycles::is_cycle;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::Plane;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// How many holes a circle can have.
const MOST: f64 = 9999.0;

/// A circle of holes, units of the program and degrees.
struct HoleCircle {
    middle: [f64; 2],
    radius: f64,
    start: f64,
    step: f64,
    count: u32,
}

impl Interpreter<'_> {
    /// G70 and G71 while a canned cycle is in force.
    pub(super) fn hole_circle(&mut self, words: &mut BlockWords, g: At<u32>, block: Span) -> Done {
        let circle = self.read_circle(words, g)?;
        for hole in 0..circle.count {
            let (sin, cos) = sin_cos_degrees(circle.start + f64::from(hole) * circle.step);
            let mut place = MotionWords::default();
            for (axis, along) in [cos, sin].into_iter().enumerate() {
                place.axes[axis] = Some(At {
                    value: (
                        circle.middle[axis] + circle.radius * along,
                        Dimension::Absolute,
                    ),
                    span: g.span,
                });
            }
            self.run_cycle_at(&place, 1, block)?;
        }
        Ok(())
    }

    fn read_circle(&self, words: &mut BlockWords, g: At<u32>) -> Result<HoleCircle, Diagnostic> {
        let name = g_name(g.value);
        let wrong = |span: Span, what: &str| {
            Diagnostic::error(span, format!("{name}: {what}")).help(
                "write G70 I20. J15. L8 for 8 holes round the place of the tool, or G71 I20. J15. K30. L4 for 4 of \
                 them, 30 degrees apart, with the canned cycle in a block before",
            )
        };
        if self.control.modal.plane != Plane::Xy || words.g.iter().any(|g| is_cycle(g.value)) {
            return Err(wrong(
                g.span,
                "outside of G17, or in the block of the cycle",
            ));
        }
        if let Some(axis) = words.first_axis() {
            return Err(wrong(axis, "a place beside it"));
        }
        let [radius, start, step] = std::mem::take(&mut words.centre);
        let needs = |word: Option<At<f64>>, letter: &str| {
            word.ok_or_else(|| wrong(g.span, &format!("{letter} is missing")))
        };
        let radius = needs(radius, "I")?;
        let start = needs(start, "J")?;
        let count = needs(words.l.take(), "L")?;
        if radius.value <= 0.0 {
            return Err(wrong(radius.span, "the radius I is above 0"));
        }
        if count.value.fract() != 0.0 || !(1.0..=MOST).contains(&count.value) {
            return Err(wrong(
                count.span,
                "L is how many holes: a whole number up to 9999",
            ));
        }
        let step = match (g.value, step) {
            (700, None) => 360.0 / count.value,
            (700, Some(step)) => return Err(wrong(step.span, "K belongs to G71")),
            _ => needs(step, "K")?.value,
        };
        let known = [0, 1].map(|axis| self.control.present(axis).filter(|_| !self.skipped[axis]));
        let [Some(x), Some(y)] = known else {
            return Err(Diagnostic::unknown_place(
                g.span,
                format!("{name}, and where the tool is in X and Y is not known ahead of time"),
            )
            .help(
                "move to the middle with X and Y in G90 before the canned cycle, and leave them out beside its L0",
            ));
        };
        Ok(HoleCircle {
            middle: [x, y],
            radius: radius.value,
            start: start.value,
            step,
            count: count.value as u32,
        })
    }
}
