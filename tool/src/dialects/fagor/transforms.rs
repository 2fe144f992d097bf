//! Mirror image (G10 to G14), scaling factor (G72) and pattern rotation (G73).
//!
//! Programmed coordinates p are mirrored (M) and scaled (s), then turned (R) about a centre that is
//! mirrored and scaled itself, C' = M s C; the factors for single axes (D) act on the finished path:
//! p' = D (C' + R (M s p - C')). (Fagor, CNC 8055 Programming Manual, "Mirror image", "Scaling factor",
//! "Pattern rotation".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At};
use crate::program::Plane;
use crate::program::frame::FrameOperation;
use crate::source::Span;
use framepath::frame::programmable::SCALE_RANGE;

/// The transforms in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transforms {
    mirrored: [bool; 9],
    /// G72 S.
    scale: f64,
    /// G72 X..C.
    stretch: [f64; 9],
    rotation: Option<Rotation>,
}

/// G73.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rotation {
    plane: Plane,
    /// Degrees.
    angle: f64,
    /// Along the first and the second axis of the plane, machine units, as programmed.
    centre: [f64; 2],
}

impl Default for Transforms {
    fn default() -> Self {
        Transforms {
            mirrored: [false; 9],
            scale: 1.0,
            stretch: [1.0; 9],
            rotation: None,
        }
    }
}

impl Transforms {
    /// Whether coordinates are turned.
    pub fn rotates(&self) -> bool {
        self.rotation.is_some()
    }

    /// Whether coordinates are scaled.
    pub fn scales(&self) -> bool {
        self.scale != 1.0 || self.stretch != [1.0; 9]
    }

    /// G72 S: what all coordinates of the program are multiplied with.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    fn sign(&self, axis: usize) -> f64 {
        if self.mirrored[axis] { -1.0 } else { 1.0 }
    }

    /// The frame of X Y Z, outermost operation first.
    fn operations(&self) -> Vec<FrameOperation> {
        let mut list = Vec::new();
        let stretch = [0, 1, 2].map(|axis| self.stretch[axis]);
        if stretch != [1.0; 3] {
            list.push(FrameOperation::Stretch(stretch));
        }
        if let Some(rotation) = self.rotation {
            let [first, second, _] = rotation.plane.axes();
            let mut centre = [0.0; 3];
            centre[first] = rotation.centre[0] * self.sign(first) * self.scale;
            centre[second] = rotation.centre[1] * self.sign(second) * self.scale;
            let turn = FrameOperation::RotateInPlane(rotation.plane, rotation.angle);
            if centre == [0.0; 3] {
                list.push(turn);
            } else {
                let back = centre.map(|value| -value);
                list.push(FrameOperation::Translate(centre));
                list.push(turn);
                list.push(FrameOperation::Translate(back));
            }
        }
        let mirrored = [0, 1, 2].map(|axis| self.mirrored[axis]);
        if mirrored != [false; 3] {
            list.push(FrameOperation::Mirror(mirrored));
        }
        if self.scale != 1.0 {
            list.push(FrameOperation::Scale([self.scale; 3]));
        }
        list
    }

    /// What coordinates of A B C U V W are multiplied with.
    fn axis_factors(&self) -> [f64; 9] {
        std::array::from_fn(|axis| self.sign(axis) * self.scale)
    }
}

impl Interpreter<'_> {
    /// G10 to G13: may stand in a block with others; G10 acts before them.
    pub(super) fn mirror_functions(&mut self, words: &BlockWords) -> Done {
        let mut list: Vec<At<u32>> = words
            .g
            .iter()
            .copied()
            .filter(|g| (10..=13).contains(&g.value))
            .collect();
        list.sort_by_key(|g| g.value);
        let Some(first) = list.first().copied() else {
            return Ok(());
        };
        let mut transforms = self.transforms;
        for g in list {
            match g.value {
                10 => transforms.mirrored = [false; 9],
                axis => transforms.mirrored[axis as usize - 11] = true,
            }
        }
        self.set_transforms(transforms, first.span)
    }

    /// `G14 X Z A`.
    pub(super) fn mirror_axes(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        rest.axes = Default::default();
        self.alone(&rest, 14, span)?;
        let mut transforms = self.transforms;
        for (axis, word) in words.axes.iter().enumerate() {
            let Some(word) = word else {
                continue;
            };
            if word.value.is_some() {
                return Err(
                    Diagnostic::error(word.span, "G14 names axes without values")
                        .help(format!("write G14 {}", AXES[axis])),
                );
            }
            transforms.mirrored[axis] = true;
        }
        if words.first_axis().is_none() {
            return Err(Diagnostic::error(span, "G14 needs axes").help("write G14 X Z A"));
        }
        self.set_transforms(transforms, span)
    }

    /// `G72 S2` for all coordinates, `G72 X2` for the finished path along X.
    pub(super) fn scale(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        rest.axes = Default::default();
        rest.speed = None;
        self.alone(&rest, 72, span)?;
        let mut transforms = self.transforms;
        match (words.speed, words.first_axis()) {
            (Some(factor), None) => {
                check_factor(factor.value, factor.span)?;
                transforms.scale = factor.value;
            }
            (None, Some(_)) => {
                for (axis, word) in words.axes.iter().enumerate() {
                    let Some(word) = word else {
                        continue;
                    };
                    if axis > 2 {
                        return Err(Diagnostic::error(
                            word.span,
                            format!("a factor for {} alone is not supported", AXES[axis]),
                        )
                        .help("X, Y and Z can have one; G72 S scales all axes"));
                    }
                    let factor = word.value.ok_or_else(|| {
                        super::block_words::missing(
                            AXES[axis].chars().next().unwrap_or('X'),
                            word.span,
                        )
                    })?;
                    check_factor(factor, word.span)?;
                    transforms.stretch[axis] = factor;
                }
            }
            _ => {
                return Err(Diagnostic::error(span, "G72 needs either S or axes").help(
                    "G72 S2 scales all coordinates, G72 X2 the finished path along X; \
                         G72 S1 ends scaling",
                ));
            }
        }
        self.set_transforms(transforms, span)
    }

    /// `G73 Q45 I10 J0`; `G73` alone ends the rotation. Angles add up.
    pub(super) fn rotation(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        (rest.axes, rest.centre) = Default::default();
        (rest.radius, rest.angle) = (None, None);
        self.alone(&rest, 73, span)?;
        if let Some(axis) = words.first_axis().or(words.radius.map(|word| word.span)) {
            return Err(Diagnostic::error(axis, "G73 has Q, I and J only")
                .help("G73 Q45 I10 J0 turns by 45 degrees about 10, 0"));
        }
        let plane = self.control.modal.plane;
        let mut transforms = self.transforms;
        let Some(angle) = words.angle else {
            if let Some(centre) = words.centre.iter().flatten().next() {
                return Err(
                    Diagnostic::error(centre.span, "G73 with a centre needs the angle Q")
                        .help("G73 alone ends the rotation"),
                );
            }
            transforms.rotation = None;
            return self.set_transforms(transforms, span);
        };
        if angle.value.abs() > 360_000.0 {
            return Err(Diagnostic::error(
                angle.span,
                format!("{} degrees is out of range", angle.value),
            ));
        }
        let [i, j, k] = words.centre;
        if let Some(k) = k {
            return Err(Diagnostic::error(k.span, "G73 has Q, I and J only")
                .help("I is the centre along the first axis of the plane, J along the second"));
        }
        let centre = [i, j]
            .map(|word| word.map_or(0.0, |word| word.value))
            .map(|value| value * self.control.modal.length_factor);
        let before = match transforms.rotation {
            Some(old) if old.plane != plane || old.centre != centre => {
                return Err(Diagnostic::error(
                    span,
                    "a rotation about another centre, or in another plane, is in force",
                )
                .help("end it with G73 in a block of its own before"));
            }
            Some(old) => old.angle,
            None => 0.0,
        };
        transforms.rotation = Some(Rotation {
            plane,
            angle: (before + angle.value) % 360.0,
            centre,
        });
        self.set_transforms(transforms, span)
    }

    fn set_transforms(&mut self, transforms: Transforms, span: Span) -> Done {
        if transforms == self.transforms {
            return Ok(());
        }
        let [_, _, normal] = self.control.modal.plane.axes();
        let along = |transforms: &Transforms| {
            transforms.sign(normal) * transforms.scale * transforms.stretch[normal]
        };
        if self.cycle.is_some() && along(&transforms) != along(&self.transforms) {
            return Err(Diagnostic::error(
                span,
                "a mirror or a scale of the tool's axis changes in a canned cycle",
            )
            .help("end the cycle with G80 before"));
        }
        self.control
            .refuse_compensation(span, "the frame changes")?;
        self.control.set_frame(&transforms.operations(), span)?;
        self.control.modal.axis_factors = transforms.axis_factors();
        self.transforms = transforms;
        Ok(())
    }

    /// Refuses other words in the block of a function that stands alone. `rest`: the words without its own.
    pub(super) fn alone(&self, rest: &BlockWords, g: u32, span: Span) -> Done {
        let other = rest.g.iter().find(|other| other.span != span);
        match other.map(|other| other.span).or(rest.first_word()) {
            Some(other) => Err(stands_alone(g, other)),
            None => Ok(()),
        }
    }
}

fn stands_alone(g: u32, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("G{g} stands alone in its block"))
        .help("put the rest into another block")
}

fn check_factor(factor: f64, span: Span) -> Done {
    let [least, largest] = SCALE_RANGE;
    if (least..=largest).contains(&factor) {
        return Ok(());
    }
    Err(
        Diagnostic::error(span, format!("the scale factor {factor} is out of range")).help(
            format!("factors go from {least} to {largest}; G72 S1 ends scaling"),
        ),
    )
}
