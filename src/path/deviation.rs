//! How far the blended path is from the programmed one, and the proof that it is no farther.
//!
//! On a stretch of length h without a vertex inside, a function d with `|d''| <= m` is nowhere
//! larger than at the larger of its ends plus `h^2 m / 8`. The bound of d'' is a sum over the
//! vertices that reach the stretch. Where the bound is too coarse the stretch is halved.
//!
//! Under G64 without P corners may be cut by up to half of the shorter leg. Kernels no wider than
//! that do not count: each leg is touched in the middle, within what the others add.
//!
//! The deviation at equal path distance bounds the distance both ways, from the blended path to the
//! programmed one and back. On a line what leads [along it](super::leg::Leg::take_off_along) does not count, but at its ends: the blended
//! path is as near to these, and in between the nearest point of the line to it takes every place of the line once at least.

use super::chain::{Chain, NEIGHBOURS};
use super::kernel_lanes::KERNELS;
use super::metric::Metric;
use super::reaching::Reaching;

/// Deviations evaluated for one leg at most; more count as a violation.
const HALVINGS: u32 = 24;

/// Greatest depth of nested halves, which the number of halvings bounds.
const DEPTH: usize = 32;

/// The most kernel terms that the check of a leg takes.
pub(super) const GREATEST_COST: usize =
    KERNELS * 2 * NEIGHBOURS as usize * (3 * HALVINGS as usize + 7);

/// Where the tolerance is, or may be, violated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Violation {
    /// Path distance.
    pub s: f64,
    /// What is allowed there over the deviation, 0 to 1; 1 where nothing is known of it.
    pub allowed: f64,
    /// How many kernels reach the leg.
    pub kernels: usize,
}

/// The answer of a check.
#[derive(Clone, Copy, Debug)]
pub(super) struct DeviationVerdict {
    /// `None` where the tolerance is kept.
    pub violation: Option<Violation>,
    /// What is left of the tolerance where it is kept, at least; machine units.
    pub left: f64,
    /// Kernel terms that it took.
    pub cost: usize,
}

/// The deviation at the end of a leg: where the next one begins it is the same, as long as no width changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndDeviation {
    /// Number of the leg.
    leg: u64,
    /// What a degree of C counts there.
    turn_share: f64,
    deviation: f64,
}

/// Checks that the trial widths keep `share` of the tolerance everywhere on a leg. Vertices from
/// `next` on do not count. `reaching` is filled for it; `known` is what was found at the end of the leg checked last, if
/// no width has changed since.
pub(super) fn check(
    chain: &Chain,
    number: u64,
    share: f64,
    next: u64,
    metric: &Metric,
    reaching: &mut Reaching,
    known: &mut Option<EndDeviation>,
) -> DeviationVerdict {
    reaching.collect(chain, number, next);
    if reaching.count() == 0 {
        return DeviationVerdict {
            violation: None,
            left: share * chain.leg(number).tolerance(),
            cost: 1,
        };
    }
    let leg = chain.leg(number);
    let before = known
        .take()
        .filter(|end| end.leg.wrapping_add(1) == number && end.turn_share == leg.turn_share);
    let mut search = Search {
        chain,
        reaching,
        metric,
        tolerance: leg.tolerance() * share,
        turn_share: leg.turn_share,
        start: leg.start,
        end: leg.end(),
        at_start: before.map(|end| end.deviation),
        at_end: None,
        greatest: 0.0,
        halvings: 0,
        cost: 1 + reaching.count(),
    };
    let (start, end) = (leg.start, leg.end());
    let [from_left, from_right] = reaching.ends();
    let violation = if from_left < from_right {
        search
            .first_violation(start, from_left)
            .or_else(|| search.first_violation(from_right, end))
    } else {
        search.first_violation(start, end)
    };
    *known = search.at_end.map(|deviation| EndDeviation {
        leg: number,
        turn_share: leg.turn_share,
        deviation,
    });
    DeviationVerdict {
        violation,
        left: search.tolerance - search.greatest,
        cost: search.cost,
    }
}

struct Search<'a> {
    chain: &'a Chain,
    reaching: &'a Reaching,
    metric: &'a Metric,
    tolerance: f64,
    turn_share: f64,
    start: f64,
    end: f64,
    /// The deviations at both, where they are known.
    at_start: Option<f64>,
    at_end: Option<f64>,
    /// The greatest bound of the deviation that the tolerance holds.
    greatest: f64,
    halvings: u32,
    cost: usize,
}

impl Search<'_> {
    fn deviation(&mut self, s: f64) -> f64 {
        self.cost += self.reaching.count();
        if s == self.start
            && let Some(known) = self.at_start
        {
            return known;
        }
        let deviation = self
            .reaching
            .deviation(self.chain, s, self.metric, self.turn_share);
        if s == self.end {
            self.at_end = Some(deviation);
        }
        deviation
    }

    fn violation(&self, s: f64, deviation: f64) -> Violation {
        let allowed = self.tolerance / deviation;
        Violation {
            s,
            allowed,
            kernels: self.reaching.count(),
        }
    }

    /// Goes from left to right, each time over the largest half of halves that the bound allows.
    fn first_violation(&mut self, from: f64, to: f64) -> Option<Violation> {
        if from >= to {
            return None;
        }
        // The right ends of the stretches still to be done, the nearest last, with the deviation
        // there.
        let mut waiting = [(0.0, 0.0); DEPTH];
        let mut depth = 0usize;
        let (mut left, mut at_left) = (from, self.deviation(from));
        let (mut right, mut at_right) = (to, self.deviation(to));
        if exceeds(at_left, self.tolerance) {
            return Some(self.violation(left, at_left));
        }
        loop {
            if exceeds(at_right, self.tolerance) {
                return Some(self.violation(right, at_right));
            }
            let length = right - left;
            self.cost += self.reaching.count();
            let bound = at_left.max(at_right)
                + 0.125 * length * length * self.reaching.bend_bound(self.chain, left, right);
            if bound <= self.tolerance {
                self.greatest = self.greatest.max(bound);
                depth = depth.checked_sub(1)?;
                (left, at_left) = (right, at_right);
                let Some(next) = waiting.get(depth) else {
                    return Some(self.violation(right, self.tolerance));
                };
                (right, at_right) = *next;
                continue;
            }
            let middle = 0.5 * (left + right);
            self.halvings += 1;
            let place = waiting.get_mut(depth);
            let (Some(place), true) = (place, self.halvings <= HALVINGS) else {
                return Some(self.violation(middle, self.tolerance));
            };
            *place = (right, at_right);
            depth += 1;
            right = middle;
            at_right = self.deviation(middle);
        }
    }
}

/// Also if it is not a number.
fn exceeds(deviation: f64, tolerance: f64) -> bool {
    deviation.is_nan() || deviation > tolerance
}
