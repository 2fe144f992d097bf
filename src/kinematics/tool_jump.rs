//! Whether the joints of inner kinematics jump when the tool offset changes.
//!
//! LinuxCNC hands the offset to their pin past framekins, which sees the jump only when it is there: the position that
//! motion asks for is the same, and the joints are others.

use super::inner::same_joints;
use crate::axes::AXIS_COUNT;
use crate::machine::JOINT_COUNT;

/// Periods in which a new offset arrives: motion shows it at the end of one, and what adds to it may take others.
const ARRIVAL: u32 = 10;

/// The axes that motion asked with, and the joints that it was given.
pub type Given = ([f64; AXIS_COUNT], [f64; JOINT_COUNT]);

/// Looks at the joints behind a change of the tool offset.
#[derive(Clone, Copy, Debug)]
pub struct ToolJump {
    offset: [f64; 3],
    /// What motion was given before the change.
    before: Option<Given>,
    /// Periods that are left to look at.
    left: u32,
}

impl ToolJump {
    /// No tool.
    pub const fn new() -> Self {
        Self {
            offset: [0.0; 3],
            before: None,
            left: 0,
        }
    }

    /// One servo period with this tool offset, in which motion was given these joints last: whether they have jumped.
    pub fn watch(&mut self, offset: &[f64; 3], given: Option<&Given>) -> bool {
        let jumped = match (&self.before, given) {
            (Some((axes, before)), Some((now, joints))) if self.left > 0 => {
                axes == now && !same_joints(before, joints)
            }
            _ => false,
        };
        self.left = self.left.saturating_sub(1);
        if *offset != self.offset {
            *self = Self {
                offset: *offset,
                before: given.copied(),
                left: ARRIVAL,
            };
        } else if jumped {
            self.left = 0;
        }
        jumped
    }
}

impl Default for ToolJump {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(place: f64, joint: f64) -> Given {
        ([place; AXIS_COUNT], [joint; JOINT_COUNT])
    }

    #[test]
    fn joints_that_differ_at_one_place_behind_a_new_offset_have_jumped() {
        for late in 1..4 {
            let mut jump = ToolJump::new();
            assert!(!jump.watch(&[0.0; 3], Some(&given(1.0, 5.0))));
            for _ in 0..late {
                assert!(!jump.watch(&[0.0, 0.0, 15.0], Some(&given(1.0, 5.0))));
            }
            assert!(jump.watch(&[0.0, 0.0, 15.0], Some(&given(1.0, 5.1))));
            assert!(!jump.watch(&[0.0, 0.0, 15.0], Some(&given(1.0, 5.1))));
        }
    }

    #[test]
    fn moves_and_offsets_that_move_nothing_are_no_jumps() {
        let mut jump = ToolJump::new();
        assert!(!jump.watch(&[0.0; 3], None));
        assert!(!jump.watch(&[0.0, 0.0, 15.0], None));
        assert!(!jump.watch(&[0.0, 0.0, 15.0], Some(&given(1.0, 5.0))));
        assert!(!jump.watch(&[0.0, 0.0, 20.0], Some(&given(1.0, 5.0))));
        assert!(!jump.watch(&[0.0, 0.0, 20.0], Some(&given(1.0, 5.0 + 1e-9))));
        assert!(!jump.watch(&[0.0, 0.0, 20.0], Some(&given(2.0, 6.0))));
        // what the kinematics do long after is not the tool's
        for _ in 0..ARRIVAL {
            assert!(!jump.watch(&[0.0, 0.0, 20.0], Some(&given(1.0, 5.0))));
        }
        assert!(!jump.watch(&[0.0, 0.0, 20.0], Some(&given(1.0, 7.0))));
    }
}
