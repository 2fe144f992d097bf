//! What the executor wants.

/// What the executor wants in a servo period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Come to rest: rate 0.
    Hold,
    /// As fast as the reference: rate 1.
    Run,
    /// As fast as the feed cap allows. The reference exceeds it ahead, at most by this ratio.
    Cap(f64),
    /// To be where a thread wants the machine to be.
    Follow,
}
