//! A switch that motion is asked for.

use super::staged::Staged;

/// Why motion is asked for a switch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Purpose {
    /// A command of this number.
    Command(f64),
    /// Nobody asked, the frame has to go.
    Removal,
    /// The inner kinematics are to have another type.
    InnerType,
}

/// A switch that motion was asked for.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// What the switch makes active.
    pub staged: Staged,
    /// The kinematics type, see [`super::behind::Behind::number`].
    pub number: i32,
    /// The one that was asked for before.
    pub previous: i32,
    /// What it is for.
    pub purpose: Purpose,
    /// For how many periods motion has been asked.
    pub waited: u32,
}

impl Request {
    /// Whether it is to remove the frame without a command.
    pub fn removes(&self) -> bool {
        self.purpose == Purpose::Removal
    }
}
