//! What the program meant by a move.

/// LinuxCNC's kinds of motion, with the numbers of its `motion_types.h`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum MotionType {
    /// G0.
    Traverse = 1,
    /// G1, and the feed moves of canned cycles.
    Feed = 2,
    /// G2 and G3.
    Arc = 3,
    /// To the tool change position.
    ToolChange = 4,
    /// G38.x.
    Probing = 5,
    /// Of a locking rotary indexer.
    IndexRotary = 6,
}

impl MotionType {
    /// The kind with LinuxCNC's number, `None` if there is none.
    pub const fn from_number(number: i32) -> Option<Self> {
        match number {
            1 => Some(Self::Traverse),
            2 => Some(Self::Feed),
            3 => Some(Self::Arc),
            4 => Some(Self::ToolChange),
            5 => Some(Self::Probing),
            6 => Some(Self::IndexRotary),
            _ => None,
        }
    }

    /// Whether the rapid override applies instead of the feed override, as in LinuxCNC's motion
    /// controller: to G0 only.
    pub const fn is_rapid(self) -> bool {
        matches!(self, Self::Traverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_linuxcnc() {
        for number in 1..=6 {
            assert_eq!(
                MotionType::from_number(number).map(|t| t as i32),
                Some(number)
            );
        }
        assert_eq!(MotionType::from_number(0), None);
        assert_eq!(MotionType::from_number(7), None);
    }
}
