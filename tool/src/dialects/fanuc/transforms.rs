//! Mirror image (G51.1), scaling (G51) and coordinate rotation (G68).
//!
//! A coordinate is mirrored first, then scaled, then turned. The centre of a rotation is scaled and mirrored
//! with the coordinates, and a mirror of one axis of the plane turns its angle round: all this is the same
//! as turning p about the centre as it is written, then scaling, then mirroring. (Fanuc, Series 30i,
//! User's Manual, "Scaling", "Coordinate system rotation", "Programmable mirror image".)

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At};
use crate::program::Plane;
use crate::program::frame::FrameOperation;
use crate::source::Span;
use framepath::frame::programmable::SCALE_RANGE;

/// A factor without a point counts thousandths; fewer of them are a slip.
const LEAST_THOUSANDTHS: f64 = 100.0;

/// The transforms in force; lengths in machine units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transforms {
    /// G51.1: where the axis of symmetry crosses X, Y, Z.
    pub mirror: [Option<f64>; 3],
    /// G51.
    pub scale: Option<Scale>,
    /// G68.
    pub rotation: Option<Rotation>,
    /// G68.2: the frame that it makes.
    pub tilt: Vec<FrameOperation>,
    /// Whether a rotation outside of G17 was there.
    turned_aside: bool,
    /// The axes of the plane in which the coordinates have been turned since they were programmed.
    unsettled: Option<[usize; 2]>,
}

/// G51.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    centre: [f64; 3],
    factors: [f64; 3],
}

/// G68.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    plane: Plane,
    /// Degrees.
    angle: f64,
    /// Along the first and the second axis of the plane.
    centre: [f64; 2],
}

impl Transforms {
    /// Whether a motion must name both axes of the plane.
    pub fn is_unsettled(&self) -> bool {
        self.unsettled.is_some()
    }

    /// Whether the axes of a plane are scaled by different factors.
    pub fn distorts(&self, plane: Plane) -> bool {
        let [first, second, _] = plane.axes();
        self.factor(first) != self.factor(second)
    }

    /// Whether none is in force.
    pub fn is_empty(&self) -> bool {
        self.operations().is_empty() && self.rotation.is_none() && self.scale.is_none()
    }

    /// How much longer a step along an axis becomes.
    pub fn factor(&self, axis: usize) -> f64 {
        self.scale.map_or(1.0, |scale| scale.factors[axis].abs())
    }

    /// The frame of X Y Z, outermost operation first.
    fn operations(&self) -> Vec<FrameOperation> {
        let mut list = self.tilt.clone();
        let shift = |list: &mut Vec<FrameOperation>, by: [f64; 3]| {
            if by != [0.0; 3] {
                list.push(FrameOperation::Translate(by));
            }
        };
        if self.mirror != [None; 3] {
            shift(
                &mut list,
                self.mirror.map(|place| 2.0 * place.unwrap_or(0.0)),
            );
            list.push(FrameOperation::Mirror(
                self.mirror.map(|place| place.is_some()),
            ));
        }
        if let Some(Scale { centre, factors }) = self.scale {
            shift(
                &mut list,
                [0, 1, 2].map(|axis| centre[axis] * (1.0 - factors[axis])),
            );
            if factors.iter().any(|factor| *factor < 0.0) {
                list.push(FrameOperation::Mirror(factors.map(|factor| factor < 0.0)));
            }
            list.push(FrameOperation::Scale(factors.map(f64::abs)));
        }
        if let Some(rotation) = self.rotation {
            let [first, second, _] = rotation.plane.axes();
            let mut centre = [0.0; 3];
            centre[first] = rotation.centre[0];
            centre[second] = rotation.centre[1];
            shift(&mut list, centre);
            list.push(FrameOperation::RotateInPlane(
                rotation.plane,
                rotation.angle,
            ));
            shift(&mut list, centre.map(|along| -along));
        }
        list
    }
}

impl Interpreter<'_> {
    /// G51, G51.1, G50.1, G68 and G68.2.
    pub(super) fn transform(&mut self, words: &mut BlockWords, g: At<u32>) -> Done {
        if !self.transforms.tilt.is_empty() {
            return Err(Diagnostic::error(
                g.span,
                format!("{} in a tilted plane (G68.2)", g_name(g.value)),
            )
            .help("end the plane with G69 before"));
        }
        match g.value {
            510 => self.scale(words, g.span),
            511 => self.mirror(words, g.span),
            501 => self.mirror_off(words, g.span),
            680 => self.rotation(words, g.span),
            _ => self.tilted_plane(words, g.span),
        }
    }

    /// `G51 X0 Y0 Z0 P2000`, `G51 X0 Y0 Z0 I-1000 J1000 K1000`.
    fn scale(&mut self, words: &mut BlockWords, span: Span) -> Done {
        self.refuse_order(
            self.transforms.rotation.is_some(),
            "G51",
            "G68",
            "G69",
            span,
        )?;
        let thousandths = |letter: char| words.pointless.iter().any(|(found, _)| *found == letter);
        let factors = match (words.p, words.centre) {
            (
                Some(At {
                    value: (value, digits),
                    span,
                }),
                [None, None, None],
            ) => [factor(At { value, span }, digits.is_some())?; 3],
            (None, [Some(i), Some(j), Some(k)]) => [
                factor(i, thousandths('I'))?,
                factor(j, thousandths('J'))?,
                factor(k, thousandths('K'))?,
            ],
            _ => {
                return Err(Diagnostic::error(span, "G51 needs P, or I, J and K, all three").help(
                        "write G51 X0 Y0 Z0 P2000 for twice the size, or G51 X0 Y0 Z0 I1000 J-1000 K1000",
                    ));
            }
        };
        words.p = None;
        words.centre = [None; 3];
        let mut centre = [0.0; 3];
        for (axis, along) in centre.iter_mut().enumerate() {
            *along = match factors[axis] == 1.0 && words.axes[axis].is_none() {
                true => 0.0,
                false => self.centre(words, axis, span)?,
            };
        }
        let mut next = self.transforms.clone();
        next.scale = Some(Scale { centre, factors });
        if next
            .mirror
            .iter()
            .zip(centre)
            .any(|(mirror, along)| mirror.is_some_and(|at| at != along))
        {
            self.explain_centre("G51", span);
        }
        self.set_transforms(next, span)
    }

    /// `G51.1 X0`: coordinates on the other side of X0.
    fn mirror(&mut self, words: &mut BlockWords, span: Span) -> Done {
        let inside = self.transforms.rotation.is_some() || self.transforms.scale.is_some();
        self.refuse_order(inside, "G51.1", "G51 and G68", "G50 and G69", span)?;
        let mut next = self.transforms.clone();
        let named = self.named_axes(words, span)?;
        for axis in named {
            next.mirror[axis] = Some(self.centre(words, axis, span)?);
        }
        self.set_transforms(next, span)
    }

    /// `G50.1 X0`; the value says nothing.
    fn mirror_off(&mut self, words: &mut BlockWords, span: Span) -> Done {
        let named = match words.first_axis() {
            Some(_) => self.named_axes(words, span)?,
            None => vec![0, 1, 2],
        };
        let mut next = self.transforms.clone();
        for axis in named {
            words.axes[axis] = None;
            next.mirror[axis] = None;
        }
        if next.mirror == self.transforms.mirror {
            return Ok(());
        }
        let inside = self.transforms.rotation.is_some() || self.transforms.scale.is_some();
        self.refuse_order(inside, "G50.1", "G51 and G68", "G50 and G69", span)?;
        self.set_transforms(next, span)
    }

    /// `G68 X10. Y10. R45.`
    fn rotation(&mut self, words: &mut BlockWords, span: Span) -> Done {
        let plane = self.control.modal.plane;
        let [first, second, normal] = plane.axes();
        if let Some(word) = words.centre.iter().flatten().next() {
            return Err(Diagnostic::error(
                word.span,
                "G68 about an axis in space is not supported",
            )
            .help("write G68.2 with the angles of the plane"));
        }
        let Some(angle) = words.radius.take() else {
            return Err(
                Diagnostic::error(span, "G68 needs the angle R").help("write G68 X0 Y0 R45.")
            );
        };
        if let Some(word) = words.axes[normal] {
            return Err(Diagnostic::error(
                word.span,
                "the centre of G68 lies in the plane that is active",
            )
            .help("G17 has X and Y, G18 Z and X, G19 Y and Z"));
        }
        if let Some(Scale { factors, .. }) = self.transforms.scale
            && factors[first] != factors[second]
        {
            return Err(Diagnostic::error(
                span,
                "G68 while the axes of its plane have different factors (G51)",
            )
            .help("scale both alike, or end G51 with G50 before"));
        }
        let before = self.transforms.rotation;
        let mut sum = angle.value;
        if let (Some(before), true) = (before, self.control.modal.incremental) {
            sum = before.angle + angle.value;
            self.control.diagnostics.push(
                Diagnostic::warning(
                    span,
                    format!("G68 with R in G91: the angle adds up, to {sum} degrees"),
                )
                .help(
                    "the control can also be set to replace it (parameter 5400): write it in G90",
                ),
            );
        }
        if before.is_some_and(|before| before.plane != plane) {
            return Err(Diagnostic::error(span, "G68 while another plane is turned")
                .help("write G69 before"));
        }
        let mut centre = [0.0; 2];
        for (along, axis) in centre.iter_mut().zip([first, second]) {
            *along = self.centre(words, axis, span)?;
        }
        let mut next = self.transforms.clone();
        next.rotation = Some(Rotation {
            plane,
            angle: sum % 360.0,
            centre,
        });
        next.turned_aside |= plane != Plane::Xy;
        let off_axis = [first, second].into_iter().zip(centre);
        if off_axis
            .into_iter()
            .any(|(axis, along)| next.mirror[axis].is_some_and(|at| at != along))
        {
            self.explain_centre("G68", span);
        }
        self.set_transforms(next, span)
    }

    /// G50 and G69.
    pub(super) fn transform_off(&mut self, code: u32, span: Span) -> Done {
        let mut next = self.transforms.clone();
        match code {
            500 => {
                if next.scale.is_none() {
                    return Ok(());
                }
                self.refuse_order(next.rotation.is_some(), "G50", "G68", "G69", span)?;
                next.scale = None;
            }
            _ => {
                next.rotation = None;
                next.tilt.clear();
            }
        }
        self.set_transforms(next, span)
    }

    /// Makes the frame that of `next`, and remembers what it does to coordinates that are not named.
    pub(super) fn set_transforms(&mut self, mut next: Transforms, span: Span) -> Done {
        if next == self.transforms {
            return Ok(());
        }
        if self.cycle.is_some() {
            return Err(
                Diagnostic::error(span, "the frame changes in a canned cycle")
                    .help("end the cycle with G80 before"),
            );
        }
        let turned = [self.transforms.rotation, next.rotation];
        let plane = turned
            .into_iter()
            .flatten()
            .map(|rotation| rotation.plane)
            .next();
        let axes = plane
            .filter(|_| turned[0] != turned[1])
            .map(|plane| plane.axes());
        let before = axes.map(|axes| axes.map(|axis| self.control.modal.position.get(axis)));
        self.control.set_frame(&next.operations(), span)?;
        if let (Some(axes), Some(before)) = (axes, before) {
            let same = |(axis, before): (usize, Option<f64>)| {
                let after = self.control.modal.position.get(axis);
                matches!((before, after), (Some(a), Some(b)) if (a - b).abs() < 1e-9)
            };
            let settled = axes.into_iter().zip(before).take(2).all(same);
            next.unsettled = (!settled).then_some([axes[0], axes[1]]);
        }
        self.transforms = next;
        Ok(())
    }

    /// Behind G68 and G69 a coordinate that is not named is another one than before: which of both the
    /// axis keeps is a setting of the control.
    pub(super) fn check_settled(&mut self, words: &BlockWords, span: Span) -> Done {
        let Some(axes) = self.transforms.unsettled else {
            return Ok(());
        };
        let named = axes.map(|axis| words.axes[axis].is_some());
        let off = self.transforms.rotation.is_none();
        match (named, self.control.modal.incremental) {
            ([false, false], _) => return Ok(()),
            ([true, true], false) => {
                self.transforms.unsettled = None;
                return Ok(());
            }
            // Increments of a turned plane count from where the tool is.
            (_, true) if !off => return Ok(()),
            _ => {}
        }
        let [first, second] = axes.map(|axis| AXES[axis]);
        let what = if off { "G69" } else { "G68" };
        Err(Diagnostic::error(
            words.first_axis().unwrap_or(span),
            format!("the first motion behind {what} does not name {first} and {second} in G90"),
        )
        .help(
            "write G90 and both: where the axis that is not named goes is a setting of the control",
        ))
    }

    /// The coordinate of a centre, machine units; where the tool is if it is not named.
    fn centre(
        &mut self,
        words: &mut BlockWords,
        axis: usize,
        span: Span,
    ) -> Result<f64, Diagnostic> {
        let letter = AXES[axis];
        let present = self.control.modal.position.get(axis);
        let factor = self.control.modal.length_factor;
        // Centres are absolute, in G91 too.
        if let Some(word) = words.axes[axis].take() {
            return Ok(word.value * factor);
        }
        present.filter(|_| self.control.modal.frame.is_empty() && !self.skipped[axis]).ok_or_else(|| {
            Diagnostic::unknown_place(
                    span,
                    format!("the centre in {letter} is where the tool is, and that is not known ahead of time"),
                )
                .help(format!("write {letter} in this block"))
        })
    }

    /// Which of X, Y, Z are named; one at least.
    fn named_axes(&self, words: &BlockWords, span: Span) -> Result<Vec<usize>, Diagnostic> {
        if let Some(other) = words.axes.iter().skip(3).flatten().next() {
            return Err(
                Diagnostic::error(other.span, "only X, Y and Z can be mirrored")
                    .help("write the coordinates of the other axes with their signs"),
            );
        }
        let named: Vec<usize> = (0..3).filter(|axis| words.axes[*axis].is_some()).collect();
        match named.is_empty() {
            true => Err(Diagnostic::error(span, "G51.1 needs axes").help("write G51.1 X0")),
            false => Ok(named),
        }
    }

    /// Mirror, scale and rotation are set in this order, and end in the other.
    fn refuse_order(&self, wrong: bool, what: &str, inside: &str, end: &str, span: Span) -> Done {
        match wrong {
            false => Ok(()),
            true => Err(Diagnostic::error(span, format!("{what} inside of {inside}")).help(format!(
                    "the order is G51.1, G51, G68, and G69, G50, G50.1 to end them: write {end} before"
                ))),
        }
    }

    fn explain_centre(&mut self, what: &str, span: Span) {
        self.control.diagnostics.push(
            Diagnostic::warning(
                span,
                format!("the centre of {what} is mirrored with the coordinates"),
            )
            .help("put the centre on the axis of the mirror where something else is meant"),
        );
    }

    /// Whether a rotation of this program would tilt the tool together with a tilted plane.
    pub(super) fn has_turned_aside(&self) -> bool {
        self.transforms.turned_aside
    }
}

/// A factor of G51. `thousandths`: it is written without a point.
fn factor(word: At<f64>, thousandths: bool) -> Result<f64, Diagnostic> {
    let At { value, span } = word;
    if thousandths && value.abs() < LEAST_THOUSANDTHS {
        return Err(Diagnostic::error(
            span,
            format!("{value} without a point is a factor of {}", value / 1000.0),
        )
        .help("without a point thousandths count: write 2000, or 2., for twice the size"));
    }
    let factor = if thousandths { value / 1000.0 } else { value };
    let [least, largest] = SCALE_RANGE;
    match (least..=largest).contains(&factor.abs()) {
        true => Ok(factor),
        false => Err(
            Diagnostic::error(span, format!("the factor {factor} is out of range")).help(format!(
                "factors go from {least} to {largest}; G50 ends scaling"
            )),
        ),
    }
}
