//! The refinement: a step of Newton's method over a window of the plan, a little at a time.
//!
//! Each interval joins three coefficients, so the second derivatives form a matrix with five
//! diagonals. It is factorised as L D L' (Golub and Van Loan, Matrix Computations, section 4.3)
//! while it is assembled, two columns behind. The step is taken as far as every interval still
//! keeps its limits. An interval that refuses gets stiffer for the steps to come: its second
//! derivatives are multiplied by a growing resistance.

use super::barrier::Barrier;
use super::candidate_plan::MARGIN;
use super::cost;
use super::interval::Parabola;
use super::rows::AxisRows;
use super::spline::{SampleBanks, Spline};
use crate::ring::Ring;

/// The most intervals in a window.
pub(super) const MOST_INTERVALS: usize = 140;

/// The fewest: two coefficients that change.
const LEAST_INTERVALS: usize = 4;

/// Room for the coefficients of a window, and those beside it.
const SLOTS: usize = 256;

/// What a step is multiplied by when an interval refuses it.
const SHORTER: f64 = 0.6;
/// How often, before the step is given up.
const MOST_SHORTENINGS: u32 = 14;
/// A shortened step is shortened by this once more and checked again.
const LAST_SHARE: f64 = 0.9;
/// What the resistance of an interval is multiplied by each time it refuses.
const RESISTANCE_GROWTH: f64 = 3.0;
/// What it is multiplied by when a step succeeds.
const RESISTANCE_DECAY: f64 = 0.6;
const GREATEST_RESISTANCE: f64 = 1e6;
/// What the weight of the barrier is multiplied by after a whole step; after a part of one by as much less.
const BARRIER_DECAY: f64 = 0.5;
const LEAST_BARRIER: f64 = 0.0015;
/// Up to this weight the barrier of an interval that refuses grows as its resistance does: it has come so near to a limit that it
/// ends the steps of all.
const REGAINED_BARRIER: f64 = 0.02;

/// An interval whose coefficient a whole step changes by no more than this share has converged ..
const CONVERGED: f64 = 3e-3;
/// .. if its resistance, which makes steps small, is no more than this.
const CONVERGED_RESISTANCE: f64 = 1.5;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NewtonPhase {
    Assemble,
    Substitute,
    Check,
    Apply,
    Done,
}

/// One coefficient of the window.
#[derive(Clone, Copy, Debug)]
struct SystemRow {
    /// The diagonal; when eliminated, its reciprocal.
    diagonal: f64,
    /// The first diagonal beside it; when eliminated, of L.
    next: f64,
    /// The second diagonal beside it.
    second: f64,
    /// The right side, later the step.
    step: f64,
    /// Product of the growths of resistance in this step.
    refusals: f64,
}

impl SystemRow {
    const NONE: Self = Self {
        diagonal: 0.0,
        next: 0.0,
        second: 0.0,
        step: 0.0,
        refusals: 1.0,
    };
}

/// The interval at hand and those beside it after the step. From one interval to the next only one of them is another.
struct MovedNeighbours {
    lengths: [f64; 3],
    coefficients: [f64; 3],
}

impl MovedNeighbours {
    #[inline]
    fn of(step: &NewtonStep, plan: &Spline) -> Self {
        let k = step.k;
        let numbers = [k - 1, k, k + 1];
        Self {
            lengths: numbers.map(|k| plan.at(k).length),
            coefficients: numbers.map(|k| step.moved(plan, k)),
        }
    }

    /// The same of the next interval, which is the one at hand now.
    #[inline]
    fn go_on(&mut self, step: &NewtonStep, plan: &Spline) {
        let ([_, length, next_length], [_, here, next]) = (self.lengths, self.coefficients);
        let behind = step.k + 1;
        self.lengths = [length, next_length, plan.at(behind).length];
        self.coefficients = [here, next, step.moved(plan, behind)];
    }

    fn parabola(&self) -> Parabola {
        Parabola::of_coefficients(self.lengths, self.coefficients)
    }
}

/// A step of Newton's method, until it is done.
#[derive(Debug)]
pub(super) struct NewtonStep {
    phase: NewtonPhase,
    /// The first interval of the window; its coefficient and those before it are not changed.
    first: usize,
    /// The interval behind the window; its coefficient and the one before are not changed.
    end: usize,
    k: usize,
    share: f64,
    shortenings: u32,
    clean: bool,
    /// Whether only intervals that refused a step before are asked for now: these mostly tell how long it may be, and then all
    /// are asked but once.
    probing: bool,
    /// The first interval that has not converged.
    unconverged: usize,
    rows: Ring<SystemRow, SLOTS>,
}

impl NewtonStep {
    pub const NONE: Self = Self {
        phase: NewtonPhase::Done,
        first: 0,
        end: 0,
        k: 0,
        share: 1.0,
        shortenings: 0,
        clean: true,
        probing: true,
        unconverged: 0,
        rows: Ring::filled_with(SystemRow::NONE),
    };

    /// Begins a step on intervals `first` to `end - 1`, at most [`MOST_INTERVALS`] of them, instead of the one
    /// before. Answers where its window ends; `None` if there are too few intervals for one.
    pub fn begin(&mut self, first: usize, end: usize) -> Option<usize> {
        let end = end.min(first + MOST_INTERVALS);
        if end < first + LEAST_INTERVALS {
            return None;
        }
        *self = Self {
            phase: NewtonPhase::Assemble,
            first,
            end,
            k: first,
            ..Self::NONE
        };
        Some(end)
    }

    /// The first interval that the step changes.
    pub fn first(&self) -> usize {
        self.first
    }

    /// The first interval that the step found unconverged.
    pub fn unconverged(&self) -> usize {
        self.unconverged
    }

    /// Works until the step is done or the budget is spent. Answers whether it is done.
    pub fn advance(
        &mut self,
        plan: &mut Spline,
        samples: &SampleBanks,
        axes: &AxisRows,
        raise_squared: f64,
        budget: &mut u32,
    ) -> bool {
        while *budget > 0 && self.phase != NewtonPhase::Done {
            let price = match self.phase {
                NewtonPhase::Assemble => cost::ASSEMBLE,
                NewtonPhase::Check => cost::CHECK,
                _ => cost::SUBSTITUTE,
            };
            *budget = budget.saturating_sub(price);
            match self.phase {
                NewtonPhase::Assemble => self.assemble(plan, samples, axes, raise_squared),
                NewtonPhase::Substitute => self.substitute(),
                NewtonPhase::Check => self.check(plan, samples, axes, raise_squared, budget),
                NewtonPhase::Apply => self.apply(plan),
                NewtonPhase::Done => {}
            }
        }
        self.phase == NewtonPhase::Done
    }

    /// The first and the last coefficient that may change.
    fn free(&self) -> (usize, usize) {
        (self.first + 1, self.end - 2)
    }

    /// Coefficient k after the step.
    #[inline]
    fn moved(&self, plan: &Spline, k: usize) -> f64 {
        plan.at(k).coefficient + self.share * self.row(k).step
    }

    fn row(&self, k: usize) -> &SystemRow {
        self.rows.at((k + 1 - self.first) as u64)
    }

    fn row_mut(&mut self, k: usize) -> &mut SystemRow {
        self.rows.at_mut((k + 1 - self.first) as u64)
    }

    /// Adds an interval and eliminates the coefficient before it, which is complete then.
    fn assemble(
        &mut self,
        plan: &Spline,
        samples: &SampleBanks,
        axes: &AxisRows,
        raise_squared: f64,
    ) {
        let k = self.k;
        let interval = plan.at(k);
        let barrier = Barrier {
            weight: interval.barrier,
            margin: MARGIN,
            raise_squared,
        };
        let lengths = [
            plan.at(k - 1).length,
            interval.length,
            plan.at(k + 1).length,
        ];
        let derivatives =
            barrier.derivatives(axes, &plan.parabola(k), samples.of(plan, k), lengths);
        let [g0, g1, g2] = derivatives.gradient;
        let [h00, h01, h02, h11, h12, h22] = derivatives.hessian.map(|h| h * interval.resistance);
        let before = self.row_mut(k - 1);
        before.step -= g0;
        before.diagonal += h00;
        before.next += h01;
        before.second += h02;
        let here = self.row_mut(k);
        here.step -= g1;
        here.diagonal += h11;
        here.next += h12;
        let after = self.row_mut(k + 1);
        after.step -= g2;
        after.diagonal += h22;

        let (first_free, last_free) = self.free();
        if k > first_free {
            self.eliminate(k - 1);
        }
        if k + 1 < self.end {
            self.k = k + 1;
        } else {
            self.phase = NewtonPhase::Substitute;
            self.k = last_free;
        }
    }

    fn eliminate(&mut self, k: usize) {
        let (_, last_free) = self.free();
        let row = *self.row(k);
        let inverse = 1.0 / row.diagonal;
        let l1 = row.next * inverse;
        let l2 = row.second * inverse;
        if k < last_free {
            let next = self.row_mut(k + 1);
            next.diagonal -= l1 * row.next;
            next.next -= l1 * row.second;
            next.step -= l1 * row.step;
        }
        if k + 1 < last_free {
            let second = self.row_mut(k + 2);
            second.diagonal -= l2 * row.second;
            second.step -= l2 * row.step;
        }
        *self.row_mut(k) = SystemRow {
            diagonal: inverse,
            next: l1,
            second: l2,
            ..row
        };
    }

    fn substitute(&mut self) {
        let k = self.k;
        let (first_free, last_free) = self.free();
        let row = *self.row(k);
        let mut step = row.step * row.diagonal;
        if k < last_free {
            step -= row.next * self.row(k + 1).step;
        }
        if k + 1 < last_free {
            step -= row.second * self.row(k + 2).step;
        }
        self.row_mut(k).step = step;
        if k > first_free {
            self.k = k - 1;
            return;
        }
        for fixed in [self.first - 1, self.first, self.end - 1, self.end] {
            self.row_mut(fixed).step = 0.0;
        }
        self.phase = NewtonPhase::Check;
        self.k = self.first;
    }

    /// Asks an interval whether it keeps its limits after the step, and while it does and the budget lasts the next one.
    fn check(
        &mut self,
        plan: &Spline,
        samples: &SampleBanks,
        axes: &AxisRows,
        raise_squared: f64,
        budget: &mut u32,
    ) {
        if self.probing && !self.go_on_to_stiff(plan) {
            return;
        }
        let margin = MARGIN * (1.0 - 1e-5);
        let mut moving = MovedNeighbours::of(self, plan);
        loop {
            let k = self.k;
            if !axes.keeps(
                &moving.parabola(),
                samples.of(plan, k),
                raise_squared,
                margin,
            ) {
                self.refuse();
                return;
            }
            self.k = k + 1;
            if self.probing || self.k == self.end || *budget == 0 {
                break;
            }
            *budget = budget.saturating_sub(cost::CHECK);
            moving.go_on(self, plan);
        }
        if self.k == self.end && !self.probing {
            if self.clean {
                self.begin_apply();
            } else {
                self.begin_to_ask_all();
            }
        }
    }

    /// The interval at hand does not keep its limits after the step, which is made shorter.
    fn refuse(&mut self) {
        self.clean = false;
        self.share *= SHORTER;
        self.shortenings += 1;
        self.row_mut(self.k).refusals *= RESISTANCE_GROWTH;
        if self.shortenings > MOST_SHORTENINGS {
            self.share = 0.0;
            self.begin_apply();
        }
    }

    /// Goes on to the next interval that refused a step before, from this one on. Answers whether there is one; if not, all are
    /// asked next.
    fn go_on_to_stiff(&mut self, plan: &Spline) -> bool {
        while self.k < self.end {
            if plan.at(self.k).resistance > 1.0 {
                return true;
            }
            self.k += 1;
        }
        self.begin_to_ask_all();
        false
    }

    fn begin_to_ask_all(&mut self) {
        self.probing = false;
        self.k = self.first;
        if !self.clean {
            // Intervals before the refusing one have only seen a longer step.
            self.clean = true;
            self.share *= LAST_SHARE;
        }
    }

    /// The first interval whose coefficient a whole step would change noticeably; the end of the window where there is none.
    fn first_unconverged(&self, plan: &Spline) -> usize {
        let mut window = self.first..self.end;
        let unconverged = window.find(|k| {
            let interval = plan.at(*k);
            let converged = self.row(*k).step.abs() <= CONVERGED * interval.coefficient;
            !converged || interval.resistance > CONVERGED_RESISTANCE
        });
        unconverged.unwrap_or(self.end)
    }

    fn begin_apply(&mut self) {
        self.phase = NewtonPhase::Apply;
        self.k = self.first;
    }

    /// Takes the step, all at once: half of a step would be no plan.
    fn apply(&mut self, plan: &mut Spline) {
        self.unconverged = self.first_unconverged(plan);
        for k in self.first..self.end {
            let refusals = self.row(k).refusals;
            let step = self.share * self.row(k).step;
            let interval = plan.at_mut(k);
            // A step of share 0 was given up and need not even be a number.
            if self.share > 0.0 {
                interval.coefficient += step;
            }
            if refusals > 1.0 {
                let grown = (interval.resistance * refusals).min(GREATEST_RESISTANCE);
                interval.resistance = grown;
                let regained = (interval.barrier * refusals).min(REGAINED_BARRIER);
                interval.barrier = interval.barrier.max(regained);
                let beside = grown.sqrt();
                for neighbour in [k - 1, k + 1] {
                    let interval = plan.at_mut(neighbour);
                    interval.resistance = interval.resistance.max(beside);
                }
            } else {
                // With less of a barrier an interval that ended a step ends the next ones sooner still.
                let decay = 1.0 - (1.0 - BARRIER_DECAY) * self.share;
                interval.barrier = (interval.barrier * decay).max(LEAST_BARRIER);
                if self.share > 0.05 {
                    interval.resistance = (interval.resistance * RESISTANCE_DECAY).max(1.0);
                }
            }
        }
        self.phase = NewtonPhase::Done;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_whole_step_hardly_changes_has_converged() {
        let mut plan = Box::new(Spline::NONE);
        let mut step = NewtonStep::NONE;
        assert_eq!(step.begin(1, 9), Some(9));
        for k in 1..9 {
            plan.at_mut(k).coefficient = 100.0;
            step.row_mut(k).step = 0.9 * CONVERGED * -100.0;
        }
        assert_eq!(step.first_unconverged(&plan), 9);
        step.row_mut(7).step = 1.1 * CONVERGED * -100.0;
        assert_eq!(step.first_unconverged(&plan), 7);
        plan.at_mut(5).resistance = 2.0;
        assert_eq!(step.first_unconverged(&plan), 5);
        step.row_mut(3).step = f64::NAN;
        assert_eq!(step.first_unconverged(&plan), 3);
        // However short the step becomes.
        step.share = 0.01;
        step.apply(&mut plan);
        assert_eq!(step.unconverged(), 3);
    }

    #[test]
    fn an_interval_that_refuses_regains_its_barrier() {
        let mut plan = Box::new(Spline::NONE);
        let mut step = NewtonStep::NONE;
        assert_eq!(step.begin(1, 9), Some(9));
        for (k, barrier) in [(3, 0.0015), (5, 0.0015), (7, 0.05)] {
            plan.at_mut(k).barrier = barrier;
        }
        for (k, refused) in [(3, 2), (5, 3), (7, 1)] {
            step.row_mut(k).refusals = RESISTANCE_GROWTH.powi(refused);
        }
        step.apply(&mut plan);
        let barriers = [3, 5, 7].map(|k| plan.at(k).barrier);
        assert_eq!(barriers, [0.0135, REGAINED_BARRIER, 0.05]);
        assert_eq!(plan.at(5).resistance, 27.0);
    }
}
