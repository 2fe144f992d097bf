//! When moves reach the planner that a program is planned with.

use super::arrivals::Arrivals;

/// When moves reach the planner.
#[derive(Debug)]
pub enum Supply {
    /// One in each servo cycle, as far as there is room.
    EveryCycle,
    /// The same, and the machine is held until no more can be handed over.
    BeforeStart,
    /// When they were recorded to come.
    Recorded(Arrivals),
}

impl Supply {
    /// For the reader.
    pub fn name(&self) -> &'static str {
        match self {
            Supply::EveryCycle => "one in each cycle, overrides at 100 %",
            Supply::BeforeStart => {
                "one in each cycle, the machine held until the queue was full, overrides at 100 %"
            }
            Supply::Recorded(_) => "when they were recorded to come, with the feed scale of then",
        }
    }
}
