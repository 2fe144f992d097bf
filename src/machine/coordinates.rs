//! The `coordinates=` parameter of a kinematics module: which joint is which axis.

use super::joints::JOINT_COUNT;
use crate::axes::{AXIS_COUNT, AXIS_LETTERS, Axes};

/// Why a `coordinates=` text is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinatesError {
    /// No letter at all.
    Empty,
    /// A character that is no axis letter.
    UnknownLetter {
        /// The byte, as it stands.
        letter: u8,
        /// Where it stands, counted from 0.
        position: usize,
    },
    /// More letters than there are joints.
    TooManyJoints {
        /// Where the first letter too many stands, counted from 0.
        position: usize,
    },
    /// The kinematics needs an axis that is not named.
    MissingAxis {
        /// Index into [`AXIS_LETTERS`].
        axis: usize,
    },
}

/// Which joint is which axis: joint n is the n-th letter.
///
/// As LinuxCNC's trivkins: letters in any case, spaces and tabs ignored, a letter given twice drives
/// two joints, of which the first is the one that tells the position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinates {
    /// Axis of each joint; `None` for joints that are not used.
    axis_of_joint: [Option<u8>; JOINT_COUNT],
    /// First joint of each axis.
    joint_of_axis: [Option<u8>; AXIS_COUNT],
    joint_count: usize,
}

impl Coordinates {
    /// Reads a text like `XYZAC` or `xyyz`, at most [`JOINT_COUNT`] letters.
    ///
    /// # Errors
    ///
    /// [`CoordinatesError::Empty`], [`CoordinatesError::UnknownLetter`],
    /// [`CoordinatesError::TooManyJoints`].
    pub fn parse(text: &[u8]) -> Result<Self, CoordinatesError> {
        let mut coordinates = Self {
            axis_of_joint: [None; JOINT_COUNT],
            joint_of_axis: [None; AXIS_COUNT],
            joint_count: 0,
        };
        for (position, &letter) in text.iter().enumerate() {
            if letter != b' ' && letter != b'\t' {
                coordinates.add_joint(letter, position)?;
            }
        }
        if coordinates.joint_count == 0 {
            return Err(CoordinatesError::Empty);
        }
        Ok(coordinates)
    }

    fn add_joint(&mut self, letter: u8, position: usize) -> Result<(), CoordinatesError> {
        let upper = char::from(letter.to_ascii_uppercase());
        let (axis, first_joint) = AXIS_LETTERS
            .iter()
            .zip(&mut self.joint_of_axis)
            .enumerate()
            .find_map(|(axis, (known, joint))| (*known == upper).then_some((axis, joint)))
            .ok_or(CoordinatesError::UnknownLetter { letter, position })?;
        let slot = self
            .axis_of_joint
            .get_mut(self.joint_count)
            .ok_or(CoordinatesError::TooManyJoints { position })?;
        *slot = Some(axis as u8);
        first_joint.get_or_insert(self.joint_count as u8);
        self.joint_count += 1;
        Ok(())
    }

    /// How many joints there are, 1 to 16.
    pub fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// The joint that tells the position of an axis (index into [`AXIS_LETTERS`]), if it has one.
    pub fn joint_of_axis(&self, axis: usize) -> Option<usize> {
        let joint = self.joint_of_axis.get(axis).copied().flatten();
        joint.map(usize::from)
    }

    /// The axis (index into [`AXIS_LETTERS`]) of a joint, if the joint is used.
    pub fn axis_of_joint(&self, joint: usize) -> Option<usize> {
        let axis = self.axis_of_joint.get(joint).copied().flatten();
        axis.map(usize::from)
    }

    /// That all of these axes are named.
    ///
    /// # Errors
    ///
    /// [`CoordinatesError::MissingAxis`], of the first that is not.
    pub fn require(&self, axes: &[usize]) -> Result<(), CoordinatesError> {
        for &axis in axes {
            if self.joint_of_axis(axis).is_none() {
                return Err(CoordinatesError::MissingAxis { axis });
            }
        }
        Ok(())
    }

    /// Gives each joint the value of its axis; unused joints stay as they are.
    #[inline]
    pub fn distribute(&self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) {
        let values: [f64; AXIS_COUNT] = (*axes).into();
        for (joint, axis) in joints.iter_mut().zip(&self.axis_of_joint) {
            if let Some(value) = axis.and_then(|axis| values.get(usize::from(axis))) {
                *joint = *value;
            }
        }
    }

    /// Values of the joints 0 to 8 for those of the axes; 0 for what is no joint.
    #[inline]
    pub fn first_joints<const N: usize>(&self, axes: &[Axes; N]) -> [Axes; N] {
        let mut joints = [Axes::zeros(); N];
        for (joint, axis) in self.axis_of_joint.iter().take(AXIS_COUNT).enumerate() {
            let Some(axis) = axis.map(usize::from) else {
                break;
            };
            for (joints, axes) in joints.iter_mut().zip(axes) {
                if let (Some(joint), Some(value)) = (joints.get_mut(joint), axes.get(axis)) {
                    *joint = *value;
                }
            }
        }
        joints
    }

    /// The value of each axis, from its first joint; 0 for an axis without a joint.
    #[inline]
    pub fn collect(&self, joints: &[f64; JOINT_COUNT]) -> Axes {
        let mut values = [0.0; AXIS_COUNT];
        for (value, joint) in values.iter_mut().zip(&self.joint_of_axis) {
            if let Some(position) = joint.and_then(|joint| joints.get(usize::from(joint))) {
                *value = *position;
            }
        }
        Axes::from(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes_of(text: &[u8]) -> Vec<usize> {
        let coordinates = Coordinates::parse(text).unwrap();
        let joints = 0..coordinates.joint_count();
        joints
            .map(|joint| coordinates.axis_of_joint(joint).unwrap())
            .collect()
    }

    #[test]
    fn letters_number_the_joints() {
        assert_eq!(axes_of(b"XYZ"), [0, 1, 2]);
        assert_eq!(axes_of(b"zyx"), [2, 1, 0]);
        assert_eq!(axes_of(b"XyZabcUVW"), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(axes_of(b" x\tYyz "), [0, 1, 1, 2]);
        assert_eq!(axes_of(b"ZZZZZZZZZZZZZZZZ"), [2; 16]);
    }

    #[test]
    fn the_first_of_two_joints_tells_the_position() {
        let coordinates = Coordinates::parse(b"xyzbcwy").unwrap();
        assert_eq!(coordinates.joint_of_axis(1), Some(1));
        assert_eq!(coordinates.joint_of_axis(8), Some(5));
        assert_eq!(coordinates.joint_of_axis(3), None);
        assert_eq!(coordinates.joint_of_axis(9), None);
        assert_eq!(coordinates.axis_of_joint(7), None);
        assert_eq!(coordinates.axis_of_joint(99), None);
        let mut joints = [-1.0; JOINT_COUNT];
        let axes = Axes::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        coordinates.distribute(&axes, &mut joints);
        assert_eq!(joints[..7], [1.0, 2.0, 3.0, 5.0, 6.0, 9.0, 2.0]);
        assert_eq!(joints[7..], [-1.0; 9]);
        let first = Axes::from([1.0, 2.0, 3.0, 5.0, 6.0, 9.0, 2.0, 0.0, 0.0]);
        assert_eq!(coordinates.first_joints(&[axes, -axes]), [first, -first]);
        joints[6] = 77.0;
        let back = coordinates.collect(&joints);
        let expected = Axes::from([1.0, 2.0, 3.0, 0.0, 5.0, 6.0, 0.0, 0.0, 9.0]);
        assert_eq!(back, expected);
    }

    #[test]
    fn what_is_no_list_of_axes_is_refused() {
        assert_eq!(Coordinates::parse(b""), Err(CoordinatesError::Empty));
        assert_eq!(Coordinates::parse(b" \t"), Err(CoordinatesError::Empty));
        assert_eq!(
            Coordinates::parse(b"XYQ"),
            Err(CoordinatesError::UnknownLetter {
                letter: b'Q',
                position: 2
            })
        );
        assert_eq!(
            Coordinates::parse("XÝ".as_bytes()),
            Err(CoordinatesError::UnknownLetter {
                letter: 0xC3,
                position: 1
            })
        );
        assert_eq!(
            Coordinates::parse(b"XYZABCUVWXYZABCUV"),
            Err(CoordinatesError::TooManyJoints { position: 16 })
        );
        let three = Coordinates::parse(b"XYZ").unwrap();
        assert_eq!(three.require(&[0, 1, 2]), Ok(()));
        assert_eq!(
            three.require(&[2, 3, 5]),
            Err(CoordinatesError::MissingAxis { axis: 3 })
        );
    }
}
