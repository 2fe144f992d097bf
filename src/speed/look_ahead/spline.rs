//! The plan: b = v^2 over s as a quadratic B-spline between two rests.
//!
//! Interval k of length h_k has the coefficient C_k. At its start, node k,
//!
//! ```text
//! b = (h_k C_{k-1} + h_{k-1} C_k) / (h_{k-1} + h_k)     a = (C_k - C_{k-1}) / (h_{k-1} + h_k)
//! ```
//!
//! and b is a parabola in between (de Boor, A Practical Guide to Splines, chapter IX), so that
//! s, v and a are continuous by construction. Intervals 1 to `last` are run; 0 and `last + 1` have
//! no motion of their own and hold the coefficients that tie the spline to the rests.

use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::rest_arc::RestArc;
use super::sample::Sample;
use crate::ring::Ring;

/// How many intervals there are from the oldest one that is needed.
pub(super) const CAPACITY: usize = 512;

/// The barrier's weight in a part that no refinement has seen.
pub(super) const FIRST_BARRIER: f64 = 0.06;

/// An interval of the spline.
#[derive(Clone, Copy, Debug)]
pub(super) struct SplineInterval {
    /// s at its start.
    pub start: f64,
    /// Length in s, greater than 0.
    pub length: f64,
    /// C, a speed squared.
    pub coefficient: f64,
    /// The weight of the barrier of its limits.
    pub barrier: f64,
    /// What its second derivatives are multiplied by, 1 and above: grows where steps fail.
    pub resistance: f64,
    /// Which of the two places its samples are in.
    pub bank: usize,
    /// Whether it is shorter than usual for the sake of the rest at the end.
    pub near_end: bool,
}

impl SplineInterval {
    pub const NONE: Self = Self {
        start: 0.0,
        length: 1.0,
        coefficient: 0.0,
        barrier: FIRST_BARRIER,
        resistance: 1.0,
        bank: 0,
        near_end: false,
    };
}

/// A plan from rest to rest.
#[derive(Debug)]
pub(super) struct Spline {
    intervals: Ring<SplineInterval, CAPACITY>,
    /// Number of the last interval that is run.
    pub last: usize,
    /// How it starts from rest, before interval 1.
    pub start_arc: RestArc,
    /// How it comes to rest, behind interval `last`.
    pub end_arc: RestArc,
    /// Where it starts.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
}

impl Spline {
    pub const NONE: Self = Self {
        intervals: Ring::filled_with(SplineInterval::NONE),
        last: 0,
        start_arc: RestArc::NONE,
        end_arc: RestArc::NONE,
        start: 0.0,
        end: 0.0,
    };

    /// Becomes what another plan is from interval `first` on, without a copy on the stack.
    pub fn copy_from(&mut self, other: &Self, first: usize) {
        for k in (first..other.last + 2).take(CAPACITY) {
            *self.at_mut(k) = *other.at(k);
        }
        self.last = other.last;
        self.start_arc = other.start_arc;
        self.end_arc = other.end_arc;
        self.start = other.start;
        self.end = other.end;
    }

    #[inline]
    pub fn at(&self, k: usize) -> &SplineInterval {
        self.intervals.at(k as u64)
    }

    #[inline]
    pub fn at_mut(&mut self, k: usize) -> &mut SplineInterval {
        self.intervals.at_mut(k as u64)
    }

    /// b over interval k, from 1 to `last`.
    #[inline]
    pub fn parabola(&self, k: usize) -> Parabola {
        let [before, here, after] = [k - 1, k, k + 1].map(|k| self.at(k));
        Parabola::of_coefficients(
            [before.length, here.length, after.length],
            [before.coefficient, here.coefficient, after.coefficient],
        )
    }

    /// Seconds of interval k; those of the arcs at rest for 0 and `last + 1`.
    pub fn duration(&self, k: usize) -> f64 {
        if k == 0 {
            self.start_arc.duration()
        } else if k <= self.last {
            self.parabola(k).duration()
        } else {
            self.end_arc.duration()
        }
    }

    /// The first interval of the braking to the final rest: from there on coefficients fall.
    /// Not before `from`.
    pub fn final_braking(&self, from: usize) -> usize {
        let mut k = self.last;
        for _ in 0..CAPACITY {
            let falls = self.at(k - 1).coefficient >= self.at(k).coefficient * (1.0 + 1e-12);
            if k <= from || !falls {
                break;
            }
            k -= 1;
        }
        k
    }
}

/// The samples of the path for all intervals of a plan and of the candidate of its continuation.
///
/// Each interval has two places; a candidate writes to the one that the plan does not use, so that the
/// plan stays whole until the candidate replaces it.
#[derive(Debug)]
pub(super) struct SampleBanks {
    banks: [Ring<IntervalSamples, CAPACITY>; 2],
}

impl SampleBanks {
    pub const NONE: Self = Self {
        banks: [const { Ring::filled_with(IntervalSamples::NONE) }; 2],
    };

    /// The samples of interval k.
    #[inline]
    pub fn of(&self, spline: &Spline, k: usize) -> &IntervalSamples {
        self.banks[spline.at(k).bank & 1].at(k as u64)
    }

    pub fn place_mut(&mut self, spline: &Spline, k: usize) -> &mut IntervalSamples {
        self.banks[spline.at(k).bank & 1].at_mut(k as u64)
    }

    /// The sample at node k.
    pub fn start(&self, spline: &Spline, k: usize) -> &Sample {
        &self.of(spline, k).start
    }
}
