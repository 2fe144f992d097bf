//! Why a motion that follows a spindle is aborted.

/// Why a motion that follows a spindle was aborted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpindleError {
    /// The spindle came to a stop.
    Stalled,
    /// The spindle turned back.
    Reversed,
    /// The angle of the spindle became one that it cannot have turned to.
    Jumped,
    /// The thread asks for more than the axes are able to do.
    Outrun {
        /// Units per second.
        asked: f64,
        /// Units per second.
        greatest: f64,
    },
    /// The spindle did not turn back within ten turns of a tap's end.
    NotReversed,
    /// The spindle's angle does not change, or its index does not come.
    NoIndex,
}
