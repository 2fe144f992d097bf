//! G34 to G37: mirror, scale and shift, each independent of the others.
//!
//! A programmed coordinate is mirrored and scaled, and then shifted: the shift acts as one more zero
//! offset and is itself neither mirrored nor scaled. The recalculation happens when a block is
//! prepared: tool length and radius are not touched.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At};
use crate::program::frame::FrameOperation;
use crate::source::Span;
use framepath::frame::programmable::SCALE_RANGE;

/// Mirror, scale and shift that are in force; axes X Y Z A B C U V W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recalculation {
    /// G35: which axes are negated.
    pub mirrored: [bool; 9],
    /// G36: the factor of all lengths.
    pub scale: f64,
    /// G37, machine units and degrees.
    pub shift: [f64; 9],
}

impl Default for Recalculation {
    fn default() -> Self {
        Recalculation {
            mirrored: [false; 9],
            scale: 1.0,
            shift: [0.0; 9],
        }
    }
}

impl Recalculation {
    /// The frame of X Y Z, outermost operation first.
    fn operations(&self) -> Vec<FrameOperation> {
        let mut operations = Vec::new();
        let [x, y, z, ..] = self.shift;
        if [x, y, z] != [0.0; 3] {
            operations.push(FrameOperation::Translate([x, y, z]));
        }
        let [x, y, z, ..] = self.mirrored;
        if x || y || z {
            operations.push(FrameOperation::Mirror([x, y, z]));
        }
        if self.scale != 1.0 {
            operations.push(FrameOperation::Scale([self.scale; 3]));
        }
        operations
    }

    /// What the coordinate of an axis is multiplied with. Angles are not scaled.
    pub fn factor(&self, axis: usize) -> f64 {
        let sign = if self.mirrored[axis] { -1.0 } else { 1.0 };
        match AXES[axis] {
            "A" | "B" | "C" => sign,
            _ => sign * self.scale,
        }
    }
}

impl Interpreter<'_> {
    /// A block with G34, G35, G36 or G37, which holds nothing else but axes.
    pub(super) fn recalculate(&mut self, function: At<u32>, words: &BlockWords) -> Done {
        let At { value: code, span } = function;
        if let Some((what, other)) = words.beside_axes(code) {
            return Err(Diagnostic::error(
                other,
                format!("{what} cannot stand in one block with G{code}"),
            )
            .help(format!(
                "G{code} stands alone in its block, without motion: put the rest in the next one"
            )));
        }
        let mut next = self.recalculation;
        match code {
            34 if words.motion.names_an_axis() => {
                let span = words.motion.first_axis().unwrap_or(span);
                return Err(Diagnostic::error(span, "G34 takes no axes")
                    .help("it cancels mirror, scale and shift"));
            }
            34 => next = Recalculation::default(),
            35 => next.mirrored = words.motion.axes.map(|axis| axis.is_some()),
            36 => next.scale = scale(words)?,
            _ => next.shift = self.shift(words, span),
        }
        self.control
            .refuse_compensation(span, "the recalculation of coordinates changes")?;
        self.control.set_frame(&next.operations(), span)?;
        for axis in 3..9 {
            self.control.modal.axis_factors[axis] = next.factor(axis);
        }
        self.recalculation = next;
        self.offset_free.forget();
        Ok(())
    }

    /// Angles are in degrees whatever the unit of length.
    fn length_factor(&self, axis: usize) -> f64 {
        match AXES[axis] {
            "A" | "B" | "C" => 1.0,
            _ => self.control.modal.length_factor,
        }
    }

    /// G37 replaces the whole shift.
    fn shift(&mut self, words: &BlockWords, span: Span) -> [f64; 9] {
        let mut shift = [0.0; 9];
        for (axis, value) in shift.iter_mut().enumerate() {
            let factor = self.length_factor(axis);
            match words.motion.axes[axis] {
                Some(word) => *value = word.value.0 * factor,
                None if self.recalculation.shift[axis] != 0.0 && words.motion.names_an_axis() => {
                    let letter = AXES[axis];
                    self.control.diagnostics.push(
                        Diagnostic::warning(
                            span,
                            format!(
                                "G37 replaces the whole shift: {letter} is not shifted any more"
                            ),
                        )
                        .help(format!("name {letter} too to keep its shift")),
                    );
                }
                None => {}
            }
        }
        shift
    }

    /// The words of a motion with the shift of the axes that have no frame.
    pub(super) fn shift_further_axes(&mut self, words: &mut BlockWords) {
        for (axis, word) in words.motion.axes.iter_mut().enumerate().skip(3) {
            let Some(word) = word else {
                continue;
            };
            let angle = matches!(AXES[axis], "A" | "B" | "C");
            if angle && self.recalculation.scale != 1.0 {
                self.control.diagnostics.push(
                    Diagnostic::warning(word.span, "G36 is active: angles are not scaled")
                        .help("end the scale with G36 where the rotary axis should not matter"),
                );
            }
            if !self.control.modal.incremental {
                let factor = self.recalculation.factor(axis) * self.length_factor(axis);
                word.value.0 += self.recalculation.shift[axis] / factor;
            }
        }
    }
}

/// `G36 X1.27`, `G36 Y0.38`: the factor; `G36 X1.54 Y3.28`: the first divided by the second; bare: 1.
fn scale(words: &BlockWords) -> Result<f64, Diagnostic> {
    let mut given = words.motion.axes.iter().flatten();
    let (first, second) = (given.next(), given.next());
    if let Some(third) = given.next() {
        return Err(
            Diagnostic::error(third.span, "G36 takes one value, or two for a fraction")
                .help("G36 X1.54 Y3.28 scales by 1.54 / 3.28, all axes alike"),
        );
    }
    let Some(first) = first else {
        return Ok(1.0);
    };
    for At {
        value: (value, _),
        span,
    } in [Some(first), second].into_iter().flatten()
    {
        if *value <= 0.0 {
            let error = Diagnostic::error(*span, format!("a scale of {value} is out of range"));
            return Err(match *value < 0.0 {
                true => error.help("G35 mirrors axes; factors are above 0"),
                false => error.help("G36 alone in its block ends scaling"),
            });
        }
    }
    let factor = first.value.0 / second.map_or(1.0, |second| second.value.0);
    let [least, largest] = SCALE_RANGE;
    if !(least..=largest).contains(&factor) {
        return Err(
            Diagnostic::error(first.span, format!("a scale of {factor} is out of range"))
                .help(format!("factors go from {least} to {largest}")),
        );
    }
    Ok(factor)
}
