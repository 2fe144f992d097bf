//! What servo periods to come are simulated with.

use super::rows::PeriodLimits;
use super::table::Table;

/// What servo periods to come are simulated with.
#[derive(Debug)]
pub struct Simulation<'a> {
    /// The reference as far as it is known.
    pub table: &'a Table,
    pub limits: &'a PeriodLimits,
    /// Seconds.
    pub servo_period: f64,
    /// Periods left to simulate in this cycle.
    pub budget: &'a mut usize,
}

impl Simulation<'_> {
    /// Counts a period that is simulated, `None` if none is left.
    #[inline(always)]
    pub fn spend(&mut self) -> Option<()> {
        *self.budget = self.budget.checked_sub(1)?;
        Some(())
    }
}
