//! What the pins show of the tool and of what turns it.

use libc::c_int;

use super::normal_pins::NormalPins;
use super::retract_pins::RetractPins;

/// In a servo period.
#[derive(Clone, Copy)]
pub(super) struct ToolPins {
    pub(super) normal: NormalPins,
    pub(super) retract: RetractPins,
    /// Types of the inner kinematics: for the tool centre point, and for the machine's own axes; -1 if there is none.
    pub(super) types: [c_int; 2],
}
