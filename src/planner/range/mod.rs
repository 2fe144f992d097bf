//! Whether the joints stay within their soft limits all along a move.
//!
//! LinuxCNC looks at the end of a move only. That is enough for a line on a machine whose joints
//! are its axes; in the middle of an arc, or where the joints do not follow the program in
//! proportion, a joint may go further than at either end.
//!
//! Where joints have limits of their own they are followed more closely: none may jump, and there have to be joints all along.
//!
//! The inverse kinematics are asked a few times in each servo period. A move is released to the
//! path when all of it has been looked at, so the machine never enters a move that is not.

mod check;
mod joints;
mod jump;
mod margin;
mod sweep;

pub use check::RangeCheck;
pub use joints::{Finding, JointRange, JointSolver, Joints, Jump, OutOfRange};
pub use margin::Deviation;
pub use sweep::{RangeVerdict, Sweep};
