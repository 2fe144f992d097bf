//! The swept coefficients of a candidate: bounds, both sweeps, the hull, one coefficient at a time.

use super::bounds::PathBounds;
use super::hull::Hull;
use super::spline::{CAPACITY, Spline};
use super::sweep::{Front, Stretch};
use crate::lanes::{greater, lesser};
use crate::ring::Ring;

/// Relative differences that are rounding.
const ROUNDING: f64 = 1e-9;

/// Why coefficients cannot be swept as they are.
#[derive(Clone, Copy, Debug)]
pub(super) enum SweepFault {
    /// The speed at the base cannot be kept up.
    Stall,
    /// The speed at the base is too high to brake from.
    Base,
    /// The speed of the arc to rest cannot be reached, or not be left.
    End,
}

#[derive(Clone, Copy, Debug)]
struct Swept {
    bounds: PathBounds,
    forward: Front,
    backward: Front,
    lower: f64,
}

/// The sweeps over a spline from a coefficient `base` that stays as it is.
#[derive(Debug)]
pub(super) struct Sweeps {
    base: usize,
    /// Up to here the forward sweep is on the plan that it leaves.
    leaves: usize,
    swept: Ring<Swept, CAPACITY>,
    hull: Hull,
    /// The corner of the hull that was come to from the end.
    corner: usize,
    settled: usize,
    settled_candidate: usize,
}

impl Sweeps {
    pub const NONE: Self = Self {
        base: 1,
        leaves: 1,
        swept: Ring::filled_with(Swept {
            bounds: PathBounds::NONE,
            forward: Front::NONE,
            backward: Front::NONE,
            lower: 0.0,
        }),
        hull: Hull::NONE,
        corner: 0,
        settled: 0,
        settled_candidate: 0,
    };

    /// Sets the bounds of interval k.
    pub fn bound(&mut self, k: usize, bounds: PathBounds) {
        self.at_mut(k).bounds = bounds;
    }

    /// Begins at `base`, whose coefficient and the one before it the spline has.
    pub fn begin_forward(&mut self, spline: &Spline, base: usize) {
        self.base = base;
        self.leaves = base;
        let (before, here) = (spline.at(base - 1), spline.at(base));
        let slope = (here.coefficient - before.coefficient) / (before.length + here.length);
        let (before, here) = (before.coefficient, here.coefficient);
        self.at_mut(base - 1).lower = before;
        self.at_mut(base - 1).forward = Front {
            value: before,
            slope: None,
        };
        self.at_mut(base).lower = here;
        self.at_mut(base).forward = Front {
            value: here,
            slope: Some(slope),
        };
    }

    /// From coefficient k, `base` to `last`, to the next one. Coefficients of the spline before
    /// `kept` are those of a plan: it is not left while it is faster than the sweep, which has more
    /// careful bounds.
    pub fn forward(&mut self, spline: &Spline, k: usize, kept: usize) -> Result<(), SweepFault> {
        let before = self.at(k - 1).forward.value;
        let front = self.at(k).forward;
        let mut next = front.step(before, &self.stretch(spline, k, k + 1));
        let planned = spline.at(k + 1).coefficient;
        if k == self.leaves && k + 1 < kept && next.value < planned {
            let distance = spline.at(k).length + spline.at(k + 1).length;
            next = Front {
                value: planned,
                slope: Some((planned - front.value) / distance),
            };
            self.leaves = k + 1;
        }
        self.at_mut(k + 1).forward = next;
        if next.value > 0.0 {
            Ok(())
        } else {
            Err(SweepFault::Stall)
        }
    }

    /// Begins at the coefficients that the arc to rest asks for.
    pub fn begin_backward(&mut self, spline: &Spline) {
        let last = spline.last;
        let [end, beyond] = end_coefficients(spline);
        let length = spline.at(last).length;
        self.at_mut(last + 1).backward = Front {
            value: beyond,
            slope: None,
        };
        self.at_mut(last).backward = Front {
            value: end,
            slope: Some((end - beyond) / (2.0 * length)),
        };
    }

    /// From coefficient k, `last` to `base + 1`, to the one before it.
    pub fn backward(&mut self, spline: &Spline, k: usize) {
        let before = self.at(k + 1).backward.value;
        let front = self.at(k).backward;
        let next = front.step(before, &self.stretch(spline, k, k - 1));
        self.at_mut(k - 1).backward = next;
    }

    /// The lower of both sweeps at coefficient k.
    fn lower_of_both(&self, k: usize) -> f64 {
        let swept = self.at(k);
        lesser(swept.forward.value, swept.backward.value)
    }

    /// The first coefficient behind `base` and before `cut` from which on the backward sweep is nowhere slower than the plan.
    pub fn meeting(&self, plan: &Spline, base: usize, cut: usize) -> Option<usize> {
        let slower = |k: &usize| self.at(*k).backward.value < plan.at(*k).coefficient;
        let last = (base..cut).rev().find(slower)?;
        // A node farther the sweep leads away from the plan, and not onto it.
        Some(last + 2).filter(|meeting| *meeting < cut)
    }

    /// Begins the hull, if the sweeps have met both ends.
    pub fn begin_hull(&mut self, spline: &Spline) -> Result<(), SweepFault> {
        let last = spline.last;
        let pinned = self.at(self.base).forward.value;
        let [end, beyond] = end_coefficients(spline);
        let brakes = self.at(self.base).backward.value >= pinned * (1.0 - ROUNDING);
        if !brakes {
            return Err(SweepFault::Base);
        }
        let arrives = self.lower_of_both(last) >= end * (1.0 - ROUNDING);
        if !arrives {
            return Err(SweepFault::End);
        }
        self.at_mut(last).lower = end;
        self.at_mut(last + 1).lower = beyond;
        self.hull.restart(self.base, pinned);
        self.settled = 0;
        self.settled_candidate = 0;
        self.corner = last + 1;
        Ok(())
    }

    /// Appends coefficient k, `base + 1` to `last + 1`.
    pub fn append(&mut self, spline: &Spline, k: usize) {
        if k < spline.last {
            self.at_mut(k).lower = self.lower_of_both(k);
        }
        let before = self.at(k - 1);
        let value = self.at(k).lower;
        let most = greater(greater(self.at(k - 2).lower, before.lower), value);
        let length = spline.at(k - 1).length;
        let fall = length * before.bounds.bend(most);
        let distance = length + spline.at(k).length;
        self.hull.append(k, value, distance, fall);
    }

    /// The coefficient k, asked for from `last + 1` down to `base + 1`.
    pub fn coefficient(&mut self, spline: &Spline, k: usize) -> Result<f64, SweepFault> {
        if k == self.hull.previous(self.corner) {
            self.corner = k;
        }
        let value = if k == self.corner {
            self.note_settled(spline, k);
            self.at(k).lower
        } else {
            self.hull.value(k, self.corner)
        };
        let [end, _] = end_coefficients(spline);
        let wanted = k != spline.last || (value - end).abs() <= 100.0 * ROUNDING * end.abs();
        if wanted {
            Ok(value)
        } else {
            Err(SweepFault::End)
        }
    }

    /// A coefficient that what comes behind the known end hardly changes any more; 0 if none.
    pub fn settled(&self) -> usize {
        self.settled
    }

    /// A corner of the hull on its cap, with three restarts of the backward sweep at and behind it,
    /// depends on what comes later only through them. The second such corner from the end counts.
    fn note_settled(&mut self, spline: &Spline, k: usize) {
        if self.settled > 0 || k + 3 > spline.last {
            return;
        }
        let on_cap = self.at(k).lower >= self.cap(spline, k) * (1.0 - 1e-12);
        let restarts = (k..k + 3).all(|other| self.at(other).backward.slope.is_none());
        if on_cap && restarts {
            if self.settled_candidate == 0 {
                self.settled_candidate = k;
            } else if k + 6 <= self.settled_candidate {
                self.settled = k;
            }
        }
    }

    /// The cap of a coefficient: it is never far from b in its own interval and the two beside it.
    fn cap(&self, spline: &Spline, k: usize) -> f64 {
        let last = spline.last;
        if k > last {
            return PathBounds::NONE.cap;
        }
        let cap = |k: usize| self.at(k).bounds.cap;
        let least = lesser(lesser(cap(k), cap(k - 1)), cap(k + 1));
        if k == last {
            let [end, _] = end_coefficients(spline);
            return least.max(end);
        }
        least
    }

    fn stretch(&self, spline: &Spline, from: usize, to: usize) -> Stretch<'_> {
        Stretch {
            here: &self.at(from).bounds,
            next: &self.at(to).bounds,
            length: spline.at(from).length,
            next_length: spline.at(to).length,
            cap: self.cap(spline, to),
        }
    }

    fn at(&self, k: usize) -> &Swept {
        self.swept.at(k as u64)
    }

    fn at_mut(&mut self, k: usize) -> &mut Swept {
        self.swept.at_mut(k as u64)
    }
}

/// The coefficients `last` and `last + 1`, which give the last node the speed of the end arc.
fn end_coefficients(spline: &Spline) -> [f64; 2] {
    let length = spline.at(spline.last).length;
    let [beyond, end] = spline.end_arc.coefficients(length);
    [end, beyond]
}

#[cfg(test)]
mod tests {
    use std::boxed::Box;

    use super::*;
    use crate::test_room::with_room;

    /// Sweeps of ten coefficients, and a plan of 4 all over; backward they come to these values.
    fn with_backward<R: Send + 'static>(
        values: [f64; 10],
        test: impl FnOnce(&mut Sweeps, &Spline) -> R + Send + 'static,
    ) -> R {
        let run = move || {
            let (mut sweeps, mut plan) = (Box::new(Sweeps::NONE), Box::new(Spline::NONE));
            for (k, value) in values.into_iter().enumerate() {
                plan.at_mut(k).coefficient = 4.0;
                sweeps.at_mut(k).backward.value = value;
            }
            test(&mut sweeps, &plan)
        };
        with_room(run)
    }

    #[test]
    fn the_plan_is_kept_until_the_sweep_has_come_down_to_it() {
        let of = |values| with_backward(values, |sweeps, plan| sweeps.meeting(plan, 1, 8));
        let [slow, fast] = [3.0, 5.0];
        assert_eq!(of([fast; 10]), None);
        assert_eq!(of([slow; 10]), None);
        let mut values = [fast; 10];
        (values[1], values[2]) = (slow, slow);
        assert_eq!(of(values), Some(4));
        values[5] = slow;
        assert_eq!(of(values), Some(7));
        values[6] = slow;
        assert_eq!(of(values), None);
    }
}
