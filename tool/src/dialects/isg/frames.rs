//! Mirrors (G20 to G23, G351), the reference point offset (G92), coordinate systems (`#CS`) and the
//! rotation of the contour (`#ROTATION`).
//!
//! From the programmed point outwards: rotation of the contour, mirror of the plane, coordinate
//! systems, reference point offset, mirror of the axes, zero offset. The mirror of the plane does not
//! touch shifts; that of the axes does.

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At};
use crate::dialects::settings::MirrorOutsideXy;
use crate::program::frame::FrameOperation;
use crate::program::{FrameScope, Plane};
use crate::source::Span;
use std::collections::BTreeMap;

/// Shift along X Y Z in machine units, and angles about X Y Z in degrees.
pub type System = [f64; 6];

/// How many coordinate systems can be stored, or active inside each other.
const SYSTEM_LIMIT: usize = 5;

/// All that moves programmed coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// G21 and G23: the first axis of the plane is negated; G22 and G23: the second.
    pub plane_mirror: [bool; 2],
    /// G351, X Y Z A B C U V W.
    pub axis_mirror: [bool; 9],
    /// G92, machine units and degrees.
    pub reference: [f64; 9],
    /// Coordinate systems that are active, the outermost first.
    pub systems: Vec<System>,
    /// Those that were defined with a number.
    pub stored: BTreeMap<u32, System>,
    /// The one that was defined last.
    pub last_defined: Option<System>,
    /// `#ROTATION`: the plane and the angle.
    pub rotation: Option<(Plane, f64)>,
}

impl Frames {
    /// The frame, outermost operation first.
    fn operations(&self, plane: Plane, outside: MirrorOutsideXy) -> Vec<FrameOperation> {
        let mut operations = Vec::new();
        let mirror =
            |[x, y, z]: [bool; 3]| (x || y || z).then_some(FrameOperation::Mirror([x, y, z]));
        let [x, y, z, ..] = self.axis_mirror;
        operations.extend(mirror([x, y, z]));
        let [x, y, z, ..] = self.reference;
        if [x, y, z] != [0.0; 3] {
            operations.push(FrameOperation::Translate([x, y, z]));
        }
        for [x, y, z, a, b, c] in &self.systems {
            if [*x, *y, *z] != [0.0; 3] {
                operations.push(FrameOperation::Translate([*x, *y, *z]));
            }
            if [*a, *b, *c] != [0.0; 3] {
                operations.push(FrameOperation::Rotate([*a, *b, *c]));
            }
        }
        let mut in_plane = [false; 3];
        let axes = match outside {
            MirrorOutsideXy::Plane => plane.axes(),
            MirrorOutsideXy::Refuse | MirrorOutsideXy::Xy => Plane::Xy.axes(),
        };
        for (axis, mirrored) in axes.into_iter().zip(self.plane_mirror) {
            in_plane[axis] = mirrored;
        }
        operations.extend(mirror(in_plane));
        if let Some((plane, angle)) = self.rotation.filter(|(_, angle)| *angle != 0.0) {
            operations.push(FrameOperation::RotateInPlane(plane, angle));
        }
        operations
    }

    /// Whether the plane is mirrored.
    pub fn mirrors_plane(&self) -> bool {
        self.plane_mirror != [false; 2]
    }
}

impl Interpreter<'_> {
    /// Makes these the frames that act.
    pub(super) fn set_frames(&mut self, next: Frames, span: Span) -> Done {
        self.control
            .refuse_compensation(span, "mirror, offset or coordinate system changes")?;
        let outside = self.control.settings.mirror_outside_xy;
        let operations = next.operations(self.control.modal.plane, outside);
        self.control.set_frame(&operations, span)?;
        for (axis, mirrored) in next.axis_mirror.into_iter().enumerate().skip(3) {
            self.control.modal.axis_factors[axis] = if mirrored { -1.0 } else { 1.0 };
        }
        let turned = next.plane_mirror != self.frames.plane_mirror
            || next.axis_mirror != self.frames.axis_mirror
            || next.rotation != self.frames.rotation;
        if turned {
            self.unsettled = [true; 3];
        }
        self.frames = next;
        self.offset_free.forget();
        Ok(())
    }

    /// G20 to G23.
    pub(super) fn mirror_plane(&mut self, code: u32, span: Span) -> Done {
        let mut next = self.frames.clone();
        next.plane_mirror = [matches!(code, 21 | 23), matches!(code, 22 | 23)];
        if next.mirrors_plane() {
            self.check_mirror_plane(self.control.modal.plane, span)?;
        }
        self.set_frames(next, span)
    }

    /// The manual says both that the axes of the plane are mirrored and that Z never is.
    pub(super) fn check_mirror_plane(&self, plane: Plane, span: Span) -> Done {
        let outside = self.control.settings.mirror_outside_xy;
        if plane == Plane::Xy || outside != MirrorOutsideXy::Refuse {
            return Ok(());
        }
        Err(Diagnostic::error(
            span,
            "a mirror by G21, G22 or G23 outside of G17 can be read in two ways",
        )
        .help(
            "mirror axes by name (G351 X-1), or say what is meant: --mirror-outside-xy plane \
                 (the axes of the plane) or xy (X and Y in every plane)",
        ))
    }

    /// `G351 X-1 Y1`: each axis for itself, alone in its block.
    pub(super) fn mirror_axes(&mut self, words: &BlockWords, span: Span) -> Done {
        if let Some((what, other)) = words.beside_axes(&[351]) {
            return Err(Diagnostic::error(
                other,
                format!("{what} cannot stand in one block with G351"),
            )
            .help("G351 stands alone in its block: put the rest in the next one"));
        }
        if !words.motion.names_an_axis() {
            return Err(Diagnostic::error(span, "G351 needs axes")
                .help("G351 X-1 mirrors X, G351 X1 ends that"));
        }
        let mut next = self.frames.clone();
        for (axis, word) in words.motion.axes.iter().enumerate() {
            let Some(At {
                value: (value, _),
                span,
            }) = *word
            else {
                continue;
            };
            next.axis_mirror[axis] = match value {
                -1.0 => true,
                1.0 => false,
                _ => {
                    return Err(Diagnostic::error(
                        span,
                        format!("{value} has no meaning with G351"),
                    )
                    .help("-1 mirrors the axis, 1 ends that"));
                }
            };
        }
        if next.axis_mirror.contains(&true) && !next.systems.is_empty() {
            return Err(mirror_and_system(span));
        }
        self.set_frames(next, span)
    }

    /// G92: an offset, not a preset. With G91 it adds to the one before.
    pub(super) fn reference_offset(&mut self, words: &BlockWords, span: Span) -> Done {
        if !words.motion.names_an_axis() {
            return Err(Diagnostic::error(span, "G92 needs axes")
                .help("G92 X60 shifts what is programmed in X by 60; G92 X0 ends that"));
        }
        if words.motion.names_a_centre() {
            return Err(
                Diagnostic::error(span, "G92 takes axes only, no centre and no radius")
                    .help("put the arc in a block of its own"),
            );
        }
        self.refuse_system(span, "the reference point offset (G92)")?;
        let mut next = self.frames.clone();
        for (axis, word) in words.motion.axes.iter().enumerate() {
            if let Some(word) = word {
                let value = word.value.0 * self.length_factor(axis);
                let before = match self.control.modal.incremental {
                    true => next.reference[axis],
                    false => 0.0,
                };
                next.reference[axis] = before + value;
            }
        }
        self.set_frames(next, span)
    }

    /// The words of a motion with the offset of the axes that have no frame.
    pub(super) fn shift_further_axes(&self, words: &mut BlockWords) {
        if self.control.modal.incremental {
            return;
        }
        for (axis, word) in words.motion.axes.iter_mut().enumerate().skip(3) {
            if let Some(word) = word {
                word.value.0 += self.frames.reference[axis] / self.length_factor(axis);
            }
        }
    }

    /// Angles are in degrees whatever the unit of length.
    pub(super) fn length_factor(&self, axis: usize) -> f64 {
        match AXES[axis] {
            "A" | "B" | "C" => 1.0,
            _ => self.control.modal.length_factor,
        }
    }

    /// Offsets that change inside a coordinate system would act in it, not under it.
    pub(super) fn refuse_system(&self, span: Span, what: &str) -> Done {
        if self.frames.systems.is_empty() {
            return Ok(());
        }
        Err(
            Diagnostic::error(span, format!("{what} changes while #CS is active"))
                .help("change it before #CS ON, or after #CS OFF"),
        )
    }

    /// `#CS ON`.
    pub(super) fn system_on(&mut self, system: System, span: Span) -> Done {
        let mut next = self.frames.clone();
        if next.axis_mirror.contains(&true) {
            return Err(mirror_and_system(span));
        }
        if next.systems.len() >= SYSTEM_LIMIT {
            return Err(Diagnostic::error(
                span,
                format!("more than {SYSTEM_LIMIT} coordinate systems inside each other"),
            ));
        }
        next.systems.push(system);
        if !self.control.set_frame_scope(FrameScope::Machine) {
            return Err(Diagnostic::error(
                span,
                "#CS in a subprogram of a long program, which has used other frames before it",
            )
            .help("put a #CS ON [0,0,0,0,0,0] and #CS OFF into the program itself"));
        }
        self.set_frames(next, span)
    }

    /// `#CS OFF`, `#CS OFF ALL`.
    pub(super) fn system_off(&mut self, all: bool, span: Span) -> Done {
        let mut next = self.frames.clone();
        if next.systems.pop().is_none() && !all {
            return Err(
                Diagnostic::error(span, "#CS OFF, and no coordinate system is active")
                    .help("#CS OFF ALL does nothing then"),
            );
        }
        if all {
            next.systems.clear();
        }
        self.set_frames(next, span)
    }

    /// `#CS DEF`.
    pub(super) fn define_system(
        &mut self,
        number: Option<u32>,
        system: System,
        span: Span,
    ) -> Done {
        if let Some(number) = number {
            self.frames.stored.insert(number, system);
        }
        if self.frames.stored.len() > SYSTEM_LIMIT {
            return Err(Diagnostic::error(
                span,
                format!("more than {SYSTEM_LIMIT} coordinate systems are stored"),
            ));
        }
        self.frames.last_defined = Some(system);
        Ok(())
    }
}

fn mirror_and_system(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "G351 and #CS at the same time can be read in two ways",
    )
    .help("mirror inside of the coordinate system with G21, G22 or G23")
}
