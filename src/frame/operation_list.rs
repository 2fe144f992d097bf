//! The operations a program has laid over one another.

use nalgebra::{Matrix3, Vector3};

use super::affine::AffineMap;
use super::error::FrameError;
use super::operation::{Operation, OperationKind, check_scale};
use super::programmable::ProgrammableFrame;

/// How many groups of operations a list holds.
pub const OPERATION_CAPACITY: usize = 32;

/// Scales that differ by less than this, relative, count as equal; rotations by less than this, in
/// radians, as none.
const EQUALITY_TOLERANCE: f64 = 1e-12;

/// Operations that belong together: neighbours that are all scales, or all of another kind.
///
/// Only scales are ever dropped by themselves, so nothing is lost by joining the others, and a
/// program that turns its frame on and on in a loop never fills the list.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Group {
    /// Shifts, rotations and mirrors, and which axes the mirrors turned round.
    Rigid { map: AffineMap, mirrored: [bool; 3] },
    /// Factor of each axis, finite and not zero.
    Scale(Vector3<f64>),
}

impl Group {
    fn of(operation: &Operation) -> Self {
        match *operation.kind() {
            OperationKind::Scale(factors) => Self::Scale(factors),
            OperationKind::Mirror(mirrored) => Self::Rigid {
                map: operation.map(),
                mirrored,
            },
            OperationKind::Translate(_) | OperationKind::Rotate(_) => Self::Rigid {
                map: operation.map(),
                mirrored: [false; 3],
            },
        }
    }

    fn map(&self) -> AffineMap {
        match self {
            Self::Rigid { map, .. } => *map,
            Self::Scale(factors) => AffineMap::from_linear(Matrix3::from_diagonal(factors)),
        }
    }

    /// The axes whose direction the group turns round.
    fn mirrored(&self) -> [bool; 3] {
        match self {
            Self::Rigid { mirrored, .. } => *mirrored,
            Self::Scale(factors) => [factors.x < 0.0, factors.y < 0.0, factors.z < 0.0],
        }
    }

    /// This group with another after it, if both are of one kind.
    fn joined(&self, next: &Self) -> Result<Option<Self>, FrameError> {
        match (self, next) {
            (Self::Scale(factors), Self::Scale(more)) => {
                let factors = factors.component_mul(more);
                check_scale(&factors)?;
                Ok(Some(Self::Scale(factors)))
            }
            (Self::Rigid { map, mirrored }, Self::Rigid { map: inner, .. }) => {
                Ok(Some(Self::Rigid {
                    map: map.compose(inner),
                    mirrored: toggled(*mirrored, next.mirrored()),
                }))
            }
            _ => Ok(None),
        }
    }
}

fn toggled([x, y, z]: [bool; 3], [a, b, c]: [bool; 3]) -> [bool; 3] {
    [x ^ a, y ^ b, z ^ c]
}

/// The ordered operations of a frame, the first one outermost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperationList {
    groups: [Group; OPERATION_CAPACITY],
    count: usize,
}

impl Default for OperationList {
    fn default() -> Self {
        Self::new()
    }
}

impl OperationList {
    /// No operations: program coordinates are those of the work offset.
    pub fn new() -> Self {
        let nothing = Group::Rigid {
            map: AffineMap::identity(),
            mirrored: [false; 3],
        };
        Self {
            groups: [nothing; OPERATION_CAPACITY],
            count: 0,
        }
    }

    /// Whether there are no operations.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Drops all operations: TRANS, ROT, SCALE or MIRROR without values.
    pub fn clear(&mut self) {
        *self = Self::new();
    }

    /// An absolute command (TRANS, ROT, ROTS, SCALE, MIRROR): drops all that is there first.
    pub fn set(&mut self, operation: &Operation) {
        self.clear();
        if let Some(first) = self.groups.first_mut() {
            *first = Group::of(operation);
            self.count = 1;
        }
    }

    /// An additive command (ATRANS, AROT, AROTS, ASCALE, AMIRROR): acts in the coordinates made by
    /// the operations so far.
    ///
    /// # Errors
    ///
    /// [`FrameError::TooManyOperations`]; [`FrameError::ZeroScale`] or [`FrameError::NotFinite`]
    /// when the product of scales leaves the range of numbers. The list is then unchanged.
    pub fn append(&mut self, operation: &Operation) -> Result<(), FrameError> {
        self.append_group(&Group::of(operation))
    }

    fn append_group(&mut self, group: &Group) -> Result<(), FrameError> {
        let last = self.count.checked_sub(1);
        if let Some(last) = last.and_then(|index| self.groups.get_mut(index))
            && let Some(joined) = last.joined(group)?
        {
            *last = joined;
            return Ok(());
        }
        let free = self
            .groups
            .get_mut(self.count)
            .ok_or(FrameError::TooManyOperations {
                capacity: OPERATION_CAPACITY,
            })?;
        *free = *group;
        self.count += 1;
        Ok(())
    }

    /// Drops the scales and keeps everything else: ASCALE without values.
    ///
    /// # Errors
    ///
    /// None in practice: what is left is shorter. The signature is that of [`Self::append`], on
    /// which it is built.
    pub fn drop_scales(&mut self) -> Result<(), FrameError> {
        let mut kept = Self::new();
        for group in self.groups() {
            if matches!(group, Group::Rigid { .. }) {
                kept.append_group(group)?;
            }
        }
        *self = kept;
        Ok(())
    }

    fn groups(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter().take(self.count)
    }

    /// All operations as one map, with the axes that mirrors (and negative scales) turned round.
    ///
    /// # Errors
    ///
    /// Those of [`ProgrammableFrame::new`].
    pub fn fold(&self) -> Result<ProgrammableFrame, FrameError> {
        let mut map = AffineMap::identity();
        let mut mirrored = [false; 3];
        for group in self.groups() {
            map = map.compose(&group.map());
            mirrored = toggled(mirrored, group.mirrored());
        }
        ProgrammableFrame::new(map, mirrored)
    }

    /// Whether a rotation comes after unequal scales. Such a frame shears, and controls that store
    /// one value per component instead of a list give another result: worth a warning.
    pub fn rotates_after_unequal_scale(&self) -> bool {
        let mut scales = Vector3::new(1.0, 1.0, 1.0);
        for group in self.groups() {
            match group {
                Group::Scale(factors) => scales.component_mul_assign(&factors.abs()),
                Group::Rigid { map, .. } => {
                    let unequal = scales.max() - scales.min() > EQUALITY_TOLERANCE * scales.max();
                    if unequal && turns(map) {
                        return true;
                    }
                }
            }
        }
        false
    }
}

/// Whether a rigid map takes an axis out of its line, which shifts, mirrors and half turns do not.
fn turns(map: &AffineMap) -> bool {
    let m = map.linear();
    [m.m12, m.m13, m.m21, m.m23, m.m31, m.m32]
        .iter()
        .any(|element| element.abs() > EQUALITY_TOLERANCE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::plane::{LinearAxis, Plane};

    fn translate(x: f64, y: f64, z: f64) -> Operation {
        Operation::translate(Vector3::new(x, y, z)).unwrap()
    }

    fn scale(x: f64, y: f64, z: f64) -> Operation {
        Operation::scale(Vector3::new(x, y, z)).unwrap()
    }

    #[test]
    fn a_full_list_refuses_and_stays_as_it_is() {
        let mut list = OperationList::new();
        for _ in 0..OPERATION_CAPACITY / 2 {
            list.append(&translate(1.0, 0.0, 0.0)).unwrap();
            list.append(&scale(2.0, 2.0, 2.0)).unwrap();
        }
        let before = list;
        assert_eq!(
            list.append(&translate(1.0, 0.0, 0.0)),
            Err(FrameError::TooManyOperations { capacity: 32 })
        );
        assert_eq!(list, before);
        // Another scale joins the last.
        list.append(&scale(0.5, 0.5, 0.5)).unwrap();
    }

    #[test]
    fn loops_of_shifts_and_rotations_never_fill_it() {
        let mut list = OperationList::new();
        for _ in 0..360 {
            list.append(&translate(1.0, 0.0, 0.0)).unwrap();
            list.append(&Operation::rotate_in_plane(Plane::Xy, 1.0).unwrap())
                .unwrap();
        }
        // A closed polygon of 360 sides.
        let map = *list.fold().unwrap().map();
        assert!((map.linear() - nalgebra::Matrix3::identity()).norm() < 1e-12);
        assert!(map.translation().norm() < 1e-11);
    }

    #[test]
    fn only_scales_are_dropped() {
        let mut list = OperationList::new();
        list.set(&scale(2.0, 2.0, 1.0));
        list.append(&translate(2.5, 18.0, 0.0)).unwrap();
        list.append(&scale(3.0, 3.0, 1.0)).unwrap();
        list.append(&Operation::mirror([true, false, false]))
            .unwrap();
        list.drop_scales().unwrap();
        let image = list
            .fold()
            .unwrap()
            .map()
            .apply(&Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(image, Vector3::new(1.5, 18.0, 0.0));
        list.clear();
        assert!(list.is_empty());
        assert_eq!(list.fold().unwrap(), ProgrammableFrame::identity());
    }

    #[test]
    fn scales_may_not_vanish_or_overflow() {
        let mut list = OperationList::new();
        list.set(&scale(1e-200, 1.0, 1.0));
        let before = list;
        assert_eq!(
            list.append(&scale(1e-200, 1.0, 1.0)),
            Err(FrameError::ZeroScale { axis: 0 })
        );
        list.set(&scale(1.0, 1e200, 1.0));
        assert_eq!(
            list.append(&scale(1.0, 1e200, 1.0)),
            Err(FrameError::NotFinite)
        );
        list.set(&scale(1e-200, 1.0, 1.0));
        assert_eq!(list, before);
        assert_eq!(list.fold(), Err(FrameError::Singular));
    }

    #[test]
    fn rotation_after_unequal_scale_is_noticed() {
        let turn = Operation::rotate(LinearAxis::Z, 45.0).unwrap();
        let mut list = OperationList::new();
        list.set(&scale(2.0, 1.0, 1.0));
        assert!(!list.rotates_after_unequal_scale());
        list.append(&translate(1.0, 0.0, 0.0)).unwrap();
        list.append(&Operation::mirror([true, true, false]))
            .unwrap();
        assert!(!list.rotates_after_unequal_scale());
        list.append(&turn).unwrap();
        assert!(list.rotates_after_unequal_scale());
        list.set(&turn);
        list.append(&scale(2.0, 1.0, 1.0)).unwrap();
        assert!(!list.rotates_after_unequal_scale());
        list.set(&scale(2.0, -2.0, 2.0));
        list.append(&turn).unwrap();
        assert!(!list.rotates_after_unequal_scale());
    }
}
