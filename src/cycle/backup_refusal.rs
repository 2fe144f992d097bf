//! Why no backup trajectory was found.

/// Why no backup trajectory was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BackupRefusal {
    /// It would leave the known cells.
    Wall,
    /// It breaks a limit, or the rate would leave 0 to 1.
    Limits,
    /// It takes longer than the periods that may be simulated in one cycle.
    Budget,
    /// A feed cap ahead cannot be kept any more.
    Cap,
}
