//! Why a plan was not made.

/// Why there is no plan to the place that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanRefusal {
    /// The path is infinite or not a number, or a speed cap is not positive.
    Unsound,
    /// No motion from or to rest fits the limits there.
    NoRest,
    /// More nodes than there is room for.
    TooLong,
    /// The machine is too near to the end of the plan.
    TooLate,
    /// No plan was found that keeps the limits.
    NotFound,
}
