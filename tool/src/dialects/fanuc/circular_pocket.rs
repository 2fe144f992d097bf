//! Circular pockets of Haas mills: G12 clockwise, G13 counterclockwise.
//!
//! `G13 D1 I5. K20. Q4. Z-3. F200.` from the middle of the pocket: I is the radius of the first round, K that of the
//! wall, Q the step from round to round; without K, I is that of the wall. Z is the depth, L with G91 how many times
//! the tool goes deeper by Z. The radius in row D keeps the tool off the wall, D0 none; at the end it is in the middle,
//! at the depth. (Haas Automation, Mill Operator's Manual, "G12 Circular Pocket Milling CW / G13".) Which way the tool
//! comes from the middle and to the next round the manual only draws: here it is half a circle, tangential at both ends.

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension, MotionWords};
use crate::program::Plane;
use crate::source::Span;

/// How many rounds a pocket may have at one depth, and how many depths.
const MOST: f64 = 9999.0;

/// A pocket, units of the program.
struct CircularPocket {
    /// The radii of the rounds of the tool's centre, from the inner one to the one along the wall.
    rounds: Vec<f64>,
    /// Z as it is written.
    depth: Option<At<f64>>,
    /// How often the tool goes round all of them.
    times: u32,
    clockwise: bool,
    span: Span,
}

impl Interpreter<'_> {
    /// G12 and G13.
    pub(super) fn circular_pocket(
        &mut self,
        words: &mut BlockWords,
        g: At<u32>,
        block: Span,
    ) -> Done {
        let At { value: code, span } = g;
        let name = g_name(code);
        self.control.refuse_compensation(span, &name)?;
        self.control.refuse_inverse_time(span, &name)?;
        if self.control.modal.plane != Plane::Xy || !self.transforms.is_empty() {
            return Err(Diagnostic::error(
                span,
                format!("{name} outside of G17, or under G51, G51.1, G68 or G68.2"),
            )
            .help("write G17, and end them with G69, G50 and G50.1 before"));
        }
        if let Some(axis) = words.axes[0].or(words.axes[1]) {
            return Err(
                Diagnostic::error(axis.span, format!("a place beside {name}"))
                    .help("move to the middle in a block of its own before"),
            );
        }
        let Some(radius) = self.radius_of_cutter(&name, span)? else {
            return Ok(());
        };
        let pocket = CircularPocket {
            rounds: rounds(words, g, radius)?,
            depth: words.axes[2].take(),
            times: self.times(words)?,
            clockwise: code == 120,
            span: block,
        };
        let before = self.control.modal.motion;
        self.control.begin_cycle();
        let done = self.mill(&pocket);
        self.control.end_cycle();
        self.control.modal.motion = before;
        done
    }

    /// The radius that D says, units of the program; `None` where it cannot be read, which has been reported.
    fn radius_of_cutter(&mut self, name: &str, span: Span) -> Result<Option<f64>, Diagnostic> {
        match self.offsets.radius_row {
            Some(0) => Ok(Some(0.0)),
            Some(row) => {
                let found = self.control.tool_diameter(name, Some(row), span)?;
                let factor = self.control.modal.length_factor;
                Ok(found.map(|(_, diameter)| diameter / 2.0 / factor))
            }
            None => Err(
                Diagnostic::error(span, format!("{name} without D")).help(format!(
                    "write {name} D1 with the row of the tool's radius; D0 leads its centre along the radius"
                )),
            ),
        }
    }

    /// L.
    fn times(&self, words: &mut BlockWords) -> Result<u32, Diagnostic> {
        match words.l.take() {
            None => Ok(1),
            Some(At { value, span }) if value != 1.0 && !self.control.modal.incremental => {
                Err(Diagnostic::error(span, "L beside a pocket in G90")
                    .help("L counts depths, one below the other: write G91, and Z as the step"))
            }
            Some(At { value, .. }) if value.fract() == 0.0 && (1.0..=MOST).contains(&value) => {
                Ok(value as u32)
            }
            Some(At { span, .. }) => Err(Diagnostic::error(
                span,
                "L is how many times the tool goes deeper: a whole number up to 9999",
            )),
        }
    }

    fn mill(&mut self, pocket: &CircularPocket) -> Done {
        for _ in 0..pocket.times {
            if let Some(depth) = pocket.depth {
                let mut down = MotionWords::default();
                down.axes[2] = Some(At {
                    value: (depth.value, Dimension::Modal),
                    span: depth.span,
                });
                self.check_skipped(&down, pocket.span)?;
                self.control.modal.motion = Some(Motion::Line);
                self.control.motion(&down, pocket.span, false, false)?;
            }
            let mut at = 0.0;
            for radius in &pocket.rounds {
                if !self.control.count_block(pocket.span) {
                    return Ok(());
                }
                let side = if at > 0.0 { -*radius } else { *radius };
                self.half_circle(pocket, side - at)?;
                self.arc(pocket, 0.0, -side)?;
                at = side;
            }
            self.half_circle(pocket, -at)?;
        }
        Ok(())
    }

    /// Half a circle to a place beside the tool along X.
    fn half_circle(&mut self, pocket: &CircularPocket, step: f64) -> Done {
        self.arc(pocket, step, step / 2.0)
    }

    /// An arc to a place beside the tool along X, round a middle that lies along X too.
    fn arc(&mut self, pocket: &CircularPocket, step: f64, middle: f64) -> Done {
        let along = |value: f64| {
            Some(At {
                value: (value, Dimension::Incremental),
                span: pocket.span,
            })
        };
        let mut words = MotionWords::default();
        (words.axes[0], words.axes[1]) = (along(step), along(0.0));
        (words.centre[0], words.centre[1]) = (along(middle), along(0.0));
        self.check_skipped(&words, pocket.span)?;
        self.control.modal.motion = Some(match pocket.clockwise {
            true => Motion::Clockwise,
            false => Motion::Counterclockwise,
        });
        self.control.motion(&words, pocket.span, false, false)
    }
}

/// The radii of the rounds of the tool's centre, from I, K and Q.
fn rounds(words: &mut BlockWords, g: At<u32>, cutter: f64) -> Result<Vec<f64>, Diagnostic> {
    let name = g_name(g.value);
    let wrong = |span: Span, what: &str| {
        Diagnostic::error(span, format!("{name}: {what}")).help(format!(
            "write {name} D1 I10. for a wall of this radius, or {name} D1 I5. K20. Q4. for rounds from I to K, Q apart"
        ))
    };
    let Some(first) = words.centre[0].take() else {
        return Err(wrong(g.span, "the radius I is missing"));
    };
    let (wall, step) = (words.centre[2].take(), words.q.take());
    if first.value <= cutter {
        return Err(wrong(
            first.span,
            &format!("I is not above the radius of the tool, {cutter}"),
        ));
    }
    let (wall, step) = match (wall, step) {
        (None, None) => return Ok(vec![first.value - cutter]),
        (Some(wall), Some(step)) => (wall, step),
        (None, Some(word)) | (Some(word), None) => {
            return Err(wrong(word.span, "K and Q belong together"));
        }
    };
    if wall.value <= first.value {
        return Err(wrong(wall.span, "K is not above I"));
    }
    let steps = ((wall.value - first.value) / step.value - 1e-6).ceil();
    if step.value <= 0.0 || steps > MOST {
        return Err(wrong(
            step.span,
            "Q is the step from round to round, and above 0",
        ));
    }
    let inner = (0..steps as u32).map(|round| first.value + f64::from(round) * step.value);
    let radii = inner.chain([wall.value]);
    Ok(radii.map(|radius| radius - cutter).collect())
}
