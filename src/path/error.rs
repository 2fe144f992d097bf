//! Why a move cannot be put on a path.

/// Why a move cannot be put on a path. The path is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlendError {
    /// There is no room. Once the machine has moved on the move may be offered again.
    Full,
    /// The move does not start where the one before ends.
    Gap,
    /// Its feed is not a positive, finite number.
    Feed,
    /// It has no length.
    ZeroLength,
    /// Its number is not greater than that of the move before.
    Serial,
}
