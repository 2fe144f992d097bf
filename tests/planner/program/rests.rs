//! Rests of a machine that moves on the way to the end.

use framepath::axes::{AXIS_COUNT, AxisLimits};
use framepath::moves::TerminationCondition;
use framepath::planner::Status;
use proptest::prelude::*;

use super::RestsAsked;
use crate::common::PERIOD;

/// What may explain a rest at or on a move.
#[derive(Clone, Copy, Debug)]
pub struct Supplied {
    /// When it was queued.
    pub period: usize,
    /// G61, G61.1 or G64 at its end.
    pub termination: TerminationCondition,
    pub wait_for_spindle: bool,
}

/// After so many periods without a move the planner may take the one before for the last.
const SILENCE: usize = 8;

/// A move that came less than so many periods before may have come too late: it takes the machine that
/// long to brake, 1000 at least.
fn late(limits: &AxisLimits, max_velocity: f64) -> usize {
    let longest = (0..AXIS_COUNT).fold(0.0, |longest: f64, axis| {
        let (a, j) = (limits.acceleration[axis], limits.jerk[axis]);
        let v = limits.velocity[axis].min(max_velocity);
        longest.max((v / a + a / j).max(2.0 * (v / j).sqrt()))
    });
    (1.2 * longest / PERIOD).max(1000.0) as usize
}

/// What is known of rests while a program runs.
pub struct Rests {
    asked: RestsAsked,
    late: usize,
    supplied: Vec<Supplied>,
    moved: bool,
    stepped: bool,
}

impl Rests {
    pub fn new(asked: RestsAsked, limits: &AxisLimits, max_velocity: f64) -> Self {
        Self {
            asked,
            late: late(limits, max_velocity),
            supplied: Vec::new(),
            moved: false,
            stepped: false,
        }
    }

    pub fn supply(&mut self, supplied: Supplied) {
        self.supplied.push(supplied);
    }

    /// Judges a period; `excused` where the operator aborts, `stepping` where single steps are taken.
    ///
    /// # Errors
    /// A rest that is not to be.
    pub fn look(
        &mut self,
        status: &Status,
        period: usize,
        excused: bool,
        stepping: bool,
    ) -> Result<(), TestCaseError> {
        let standing = status.active_depth == 0;
        self.stepped |= stepping;
        if self.moved && standing && !status.done && !excused && !self.stepped {
            let allowed = match self.asked {
                RestsAsked::Any => true,
                RestsAsked::Explained => self.explain(status.exec_id, period),
                RestsAsked::None => false,
            };
            prop_assert!(
                allowed,
                "comes to rest at {} in period {period} for no reason",
                status.exec_id
            );
        }
        // A step that the machine has not begun yet ends the path before the next move all the same.
        self.stepped &= !(self.moved && standing);
        self.moved = !standing;
        Ok(())
    }

    /// Whether the program or the supply of moves explains that the machine came to rest before or on the
    /// move `next`.
    fn explain(&self, next: i32, period: usize) -> bool {
        let of = |id: i32| self.supplied.get(usize::try_from(id - 1).ok()?);
        let late = [next, next + 1]
            .into_iter()
            .filter_map(of)
            .any(|supplied| period < supplied.period + self.late);
        let silence = of(next - 1)
            .zip(of(next))
            .is_some_and(|(before, next)| next.period >= before.period + SILENCE);
        let stops = of(next - 1).is_some_and(|before| {
            !matches!(before.termination, TerminationCondition::Continuous { .. })
        });
        // What is to be followed exactly is so from its start on.
        let begins = of(next).is_some_and(|next| {
            next.wait_for_spindle || next.termination == TerminationCondition::Exact
        });
        late || silence || stops || begins
    }
}
