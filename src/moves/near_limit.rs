//! Which ends of a move are near a soft limit.

/// Which ends of a move are so near a soft limit that the path, within its tolerance, might lead beyond it there. Where a
/// joint comes near a limit on the way, both count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NearLimit {
    /// Where it starts.
    pub start: bool,
    /// Where it ends.
    pub end: bool,
}

impl NearLimit {
    /// Neither.
    pub const NONE: Self = Self {
        start: false,
        end: false,
    };

    /// Both.
    pub const BOTH: Self = Self {
        start: true,
        end: true,
    };
}
