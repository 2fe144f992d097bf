//! The programmable frame: what the commands TRANS, ROT, SCALE and MIRROR, and their like in other
//! dialects, build up.

use super::Plane;
use framepath::frame::{self, AffineMap, FrameError, Operation, OperationList, RotsConvention};
use nalgebra::Vector3;

/// One operation of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameOperation {
    /// A shift along X Y Z.
    Translate([f64; 3]),
    /// Rotations about X Y Z in degrees, carried out as Rz Ry Rx.
    Rotate([f64; 3]),
    /// A rotation about the normal of a plane, degrees.
    RotateInPlane(Plane, f64),
    /// Two solid angles: see [`SolidAngles`].
    RotateBySolidAngles(SolidAngles, [f64; 2]),
    /// Factors for X Y Z, none of them 0.
    Scale([f64; 3]),
    /// Which of X Y Z are negated.
    Mirror([bool; 3]),
    /// Factors for X Y Z that act on the finished path, after compensation, and on the feed with it.
    /// The first operation of a frame, if it is there.
    Stretch([f64; 3]),
}

/// Which two solid angles tilt the plane: the angles between its traces and the axes, in the order
/// of the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidAngles {
    /// The XY plane: first about Y, then about the new X.
    XThenY,
    /// The ZX plane: first about X, then about the new Z.
    ZThenX,
    /// The YZ plane: first about Z, then about the new Y.
    YThenZ,
}

/// A command that changes the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameCommand {
    /// The frame is cleared.
    Cancel,
    /// The frame is cleared and consists of this operation then.
    Absolute(FrameOperation),
    /// The operation acts in the frame that the earlier ones made.
    Additive(FrameOperation),
    /// All scale operations are taken out.
    DropScales,
}

impl FrameOperation {
    /// The operation as the real-time core has it, its numbers checked.
    fn checked(&self) -> Result<Operation, FrameError> {
        match *self {
            FrameOperation::Translate(shift) => Operation::translate(Vector3::from(shift)),
            FrameOperation::Rotate(angles) => Operation::rotate_zyx(Vector3::from(angles)),
            FrameOperation::RotateInPlane(plane, angle) => {
                Operation::rotate_in_plane(plane.into(), angle)
            }
            FrameOperation::RotateBySolidAngles(which, [first, second]) => {
                let (x, y, z) = match which {
                    SolidAngles::XThenY => (Some(first), Some(second), None),
                    SolidAngles::ZThenX => (Some(second), None, Some(first)),
                    SolidAngles::YThenZ => (None, Some(first), Some(second)),
                };
                Operation::rotate_solid_angles(x, y, z, RotsConvention::Seed)
            }
            FrameOperation::Scale(factors) => Operation::scale(Vector3::from(factors)),
            FrameOperation::Mirror(axes) => Ok(Operation::mirror(axes)),
            FrameOperation::Stretch(factors) => Operation::scale(Vector3::from(factors)),
        }
    }
}

impl From<Plane> for frame::Plane {
    fn from(plane: Plane) -> frame::Plane {
        match plane {
            Plane::Xy => frame::Plane::Xy,
            Plane::Zx => frame::Plane::Zx,
            Plane::Yz => frame::Plane::Yz,
        }
    }
}

/// The operations that are active, in the order in which they were commanded, and the map that they
/// fold into.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    operations: Vec<FrameOperation>,
    list: OperationList,
    map: AffineMap,
    block_map: AffineMap,
}

impl Default for Frame {
    fn default() -> Self {
        Frame {
            operations: Vec::new(),
            list: OperationList::new(),
            map: AffineMap::identity(),
            block_map: AffineMap::identity(),
        }
    }
}

impl Frame {
    /// The frame after `command`.
    ///
    /// # Errors
    ///
    /// What [`OperationList`] and its fold refuse: too many operations, a frame that is singular or
    /// nearly so, factors or shifts out of range.
    pub fn after(&self, command: FrameCommand) -> Result<Frame, FrameError> {
        let mut next = self.clone();
        match command {
            FrameCommand::Cancel => next = Frame::default(),
            FrameCommand::Absolute(operation) => {
                next.list.set(&operation.checked()?);
                next.operations = vec![operation];
            }
            FrameCommand::Additive(operation) => {
                next.list.append(&operation.checked()?)?;
                next.operations.push(operation);
            }
            FrameCommand::DropScales => {
                next.list.drop_scales()?;
                next.operations
                    .retain(|operation| !matches!(operation, FrameOperation::Scale(_)));
            }
        }
        next.map = *next.list.fold()?.map();
        next.block_map = match next.operations.split_first() {
            Some((FrameOperation::Stretch(_), rest)) => {
                let mut list = OperationList::new();
                for operation in rest {
                    list.append(&operation.checked()?)?;
                }
                *list.fold()?.map()
            }
            _ => next.map,
        };
        Ok(next)
    }

    /// The operations, oldest first.
    pub fn operations(&self) -> &[FrameOperation] {
        &self.operations
    }

    /// Whether no operation is active.
    pub fn is_empty(&self) -> bool {
        self.operations.is_empty()
    }

    /// Whether factors act on the finished path.
    pub fn has_stretch(&self) -> bool {
        matches!(self.operations.first(), Some(FrameOperation::Stretch(_)))
    }

    /// The part of the map that acts on the coordinates of blocks, before compensation. The programmed
    /// feed is that along its path.
    pub fn block_map(&self) -> &AffineMap {
        &self.block_map
    }

    /// Whether a scale is active that acts before compensation.
    pub fn has_scale(&self) -> bool {
        let scale = |operation: &FrameOperation| matches!(operation, FrameOperation::Scale(_));
        self.operations.iter().any(scale)
    }

    /// Whether a rotation follows unequal scales, which shears.
    pub fn rotates_after_unequal_scale(&self) -> bool {
        self.list.rotates_after_unequal_scale()
    }

    /// The map from programmed coordinates to those of the work offset.
    pub fn map(&self) -> &AffineMap {
        &self.map
    }
}
