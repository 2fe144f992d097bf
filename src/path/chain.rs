//! The legs that are known and the vertices between them, in a ring.

use core::cell::Cell;

use super::contribution::Contribution;
use super::equal_widths::CurveVertex;
use super::leg::Leg;
use super::metric::Metric;
use super::settings::BlendSettings;
use super::trial_kernel::TrialKernel;
use super::vertex::Vertex;
use super::widths::Widths;
use crate::ring::Ring;

/// How many legs are kept, with those behind the machine.
const SLOTS: usize = 4096;

/// A kernel reaches no farther than this many vertices to either side.
pub(super) const NEIGHBOURS: u64 = 32;

/// How many legs behind a place are needed to evaluate it: whatever reaches it, and what reaches these.
const REACHING: u64 = 2 * NEIGHBOURS + 8;

/// How many legs behind a place are kept: a run may go back over them.
const HISTORY: u64 = 512 + REACHING;

/// Legs, each with the vertex at its start, which has the number of the leg: they are numbered through the machine's life.
#[derive(Debug)]
pub(super) struct Chain {
    legs: Ring<Leg, SLOTS>,
    vertices: Ring<Vertex, SLOTS>,
    /// What the vertices add to the path.
    pub(super) contributions: Ring<Contribution, SLOTS>,
    /// What they would add on trial.
    trials: Ring<TrialKernel, SLOTS>,
    /// What they would add as parts of a curve.
    of_curve: Ring<CurveVertex, SLOTS>,
    first: u64,
    next: u64,
    /// Number of the leg that the path began with.
    begin: u64,
    /// Whether nothing but XYZ has jumped at a vertex since the path began.
    linear: bool,
    /// Number of the first leg that has not been [settled](Self::settle).
    unsettled: u64,
    /// Number of the leg that was found last: the next one asked for is mostly near it.
    found: Cell<u64>,
}

impl Chain {
    pub const fn new() -> Self {
        Self {
            legs: Ring::filled_with(Leg::VACANT),
            vertices: Ring::filled_with(Vertex::VACANT),
            contributions: Ring::filled_with(Contribution::NONE),
            trials: Ring::filled_with(TrialKernel::NONE),
            of_curve: Ring::filled_with(CurveVertex::NONE),
            first: 0,
            next: 0,
            begin: 0,
            linear: true,
            unsettled: 0,
            found: Cell::new(0),
        }
    }

    pub fn clear(&mut self) {
        self.first = self.next;
        self.begin = self.next;
        self.linear = true;
        self.unsettled = self.next;
    }

    /// Whether nothing but XYZ jumps at any vertex.
    #[inline]
    pub fn is_linear(&self) -> bool {
        self.linear
    }

    /// Number of the oldest leg.
    pub fn first(&self) -> u64 {
        self.first
    }

    /// Number of the oldest leg that everything is kept of that reaches it.
    pub fn oldest_whole(&self) -> u64 {
        if self.first == self.begin {
            self.first
        } else {
            self.first.saturating_add(REACHING)
        }
    }

    /// Number of the leg to come.
    pub fn next(&self) -> u64 {
        self.next
    }

    pub fn is_empty(&self) -> bool {
        self.first == self.next
    }

    /// How many legs there is room for.
    pub fn room(&self) -> usize {
        SLOTS - self.next.wrapping_sub(self.first) as usize
    }

    /// Only asked for numbers from the first to before the next.
    #[inline]
    pub fn leg(&self, number: u64) -> &Leg {
        self.legs.at(number)
    }

    #[inline]
    pub fn leg_mut(&mut self, number: u64) -> &mut Leg {
        self.legs.at_mut(number)
    }

    /// The start of the leg with this number.
    #[inline]
    pub fn vertex(&self, number: u64) -> &Vertex {
        self.vertices.at(number)
    }

    #[inline]
    pub fn vertex_mut(&mut self, number: u64) -> &mut Vertex {
        self.vertices.at_mut(number)
    }

    /// Puts widths of a vertex under examination.
    pub fn set_trial(&mut self, number: u64, widths: Widths) {
        let vertex = self.vertices.at_mut(number);
        vertex.set_trial(widths);
        *self.trials.at_mut(number) = TrialKernel::of(vertex);
    }

    /// Takes note of what has been found of a vertex as a part of a curve.
    pub fn set_of_curve(&mut self, number: u64) {
        *self.of_curve.at_mut(number) = CurveVertex::of(self.vertices.at(number));
    }

    /// The kernels of so many vertices under examination from this one on, in two parts.
    #[inline(always)]
    pub fn trials(&self, first: u64, count: u64) -> [&[TrialKernel]; 2] {
        self.trials.row(first, count)
    }

    /// The kernel of a vertex under examination.
    pub fn trial(&self, number: u64) -> &TrialKernel {
        self.trials.at(number)
    }

    /// Puts the widths of a vertex under examination in force.
    pub fn store_trial(&mut self, number: u64) {
        let vertex = self.vertices.at_mut(number);
        if vertex.store_trial() {
            *self.contributions.at_mut(number) = Contribution::of(vertex);
        }
    }

    /// The newest leg.
    pub fn last(&self) -> Option<&Leg> {
        (!self.is_empty()).then(|| self.leg(self.next.wrapping_sub(1)))
    }

    /// Where the newest leg ends, path distance; 0 if there is none.
    pub fn end(&self) -> f64 {
        self.last().map_or(0.0, Leg::end)
    }

    /// Puts a leg at the end. Does nothing if there is no room.
    pub fn push(&mut self, leg: Leg, settings: &BlendSettings, metric: &Metric) {
        if self.room() == 0 {
            return;
        }
        let mut leg = leg;
        leg.start = self.end();
        let vertex = match self.last() {
            // The path begins here, at rest.
            None => Vertex::first(leg.start),
            Some(before) => {
                let mut vertex = Vertex::between(before, &leg, settings, metric);
                let previous = self.vertex(self.next.wrapping_sub(1));
                vertex.left_wall = if previous.wall {
                    previous.s
                } else {
                    previous.left_wall
                };
                vertex
            }
        };
        self.linear &= vertex.is_linear();
        *self.leg_mut(self.next) = leg;
        *self.vertex_mut(self.next) = vertex;
        *self.contributions.at_mut(self.next) = Contribution::of(&vertex);
        *self.trials.at_mut(self.next) = TrialKernel::of(&vertex);
        *self.of_curve.at_mut(self.next) = CurveVertex::of(&vertex);
        self.next = self.next.wrapping_add(1);
    }

    /// Number of the leg at path distance `s`: the later one where two meet. Held within the chain, which must not be empty.
    pub fn locate(&self, s: f64) -> u64 {
        let last = self.next.saturating_sub(1);
        let near = self.found.get().min(last).max(self.first);
        let starts = |number: u64| self.leg(number).start <= s;
        // Mostly it is asked for what was found last.
        if starts(near) && (near == last || !starts(near.saturating_add(1))) {
            return near;
        }
        let (mut low, mut high) = self.around(near, s);
        while high.saturating_sub(low) > 1 {
            let middle = low + (high - low) / 2;
            if starts(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.found.set(low);
        low
    }

    /// Numbers that the leg at path distance `s` lies between, the first included: steps from `near`, each twice the one before.
    fn around(&self, near: u64, s: f64) -> (u64, u64) {
        let (mut low, mut high) = (near, near);
        let mut step = 1;
        if self.leg(near).start <= s {
            while high < self.next && self.leg(high).start <= s {
                low = high;
                high = self.next.min(high.saturating_add(step));
                step *= 2;
            }
        } else {
            while low > self.first && self.leg(low).start > s {
                high = low;
                low = self.first.max(low.saturating_sub(step));
                step *= 2;
            }
        }
        (low, high)
    }

    /// Drops the legs that nothing from the leg with this number on depends on.
    pub fn discard_before(&mut self, number: u64) {
        let keep = number.saturating_sub(HISTORY).min(self.next);
        self.first = self.first.max(keep);
    }

    /// Vertices that may reach into a leg from its left, nearest first. Nothing reaches beyond a wall: they end with one.
    pub fn left_of(&self, leg: u64) -> impl Iterator<Item = (u64, &Vertex)> + '_ {
        let mut open = true;
        let count = leg.saturating_add(1).saturating_sub(self.first);
        (0..count.min(NEIGHBOURS))
            .map(move |k| leg.wrapping_sub(k))
            .map(|number| (number, self.vertex(number)))
            .take_while(move |(_, vertex)| {
                let taken = open;
                open = !vertex.wall;
                taken
            })
    }

    /// Vertices that may reach into a leg from its right, below `next`, nearest first.
    pub fn right_of(&self, leg: u64, next: u64) -> impl Iterator<Item = (u64, &Vertex)> + '_ {
        let mut open = true;
        (leg.saturating_add(1)..leg.saturating_add(1 + NEIGHBOURS).min(next))
            .map(|number| (number, self.vertex(number)))
            .take_while(move |(_, vertex)| {
                let taken = open;
                open = !vertex.wall;
                taken
            })
    }

    /// The same as [`Self::left_of`], up to a wall or beyond it, as parts of a curve.
    #[inline(always)]
    pub fn curve_left_of(&self, leg: u64) -> impl Iterator<Item = (u64, &CurveVertex)> + '_ {
        let count = leg.saturating_add(1).saturating_sub(self.first);
        let count = count.min(NEIGHBOURS);
        let [before, behind] = self
            .of_curve
            .row(leg.wrapping_add(1).wrapping_sub(count), count);
        let row = behind.iter().rev().chain(before.iter().rev());
        row.zip(0..)
            .map(move |(vertex, k)| (leg.wrapping_sub(k), vertex))
    }

    /// The same as [`Self::right_of`], up to a wall or beyond it, as parts of a curve.
    #[inline(always)]
    pub fn curve_right_of(
        &self,
        leg: u64,
        next: u64,
    ) -> impl Iterator<Item = (u64, &CurveVertex)> + '_ {
        let first = leg.saturating_add(1);
        let count = next.saturating_sub(first).min(NEIGHBOURS);
        let [before, behind] = self.of_curve.row(first, count);
        let row = before.iter().chain(behind);
        row.zip(first..).map(|(vertex, number)| (number, vertex))
    }

    /// Up to `frozen` the path never changes again, and vertices before `open` are final: forgets of the legs there
    /// the vertices that reached into them on trial only.
    pub fn settle(&mut self, open: u64, frozen: f64) {
        self.unsettled = self.unsettled.max(self.first);
        while self.unsettled < open && self.leg(self.unsettled).end() <= frozen {
            self.settle_leg(self.unsettled);
            self.unsettled += 1;
        }
    }

    fn settle_leg(&mut self, number: u64) {
        let leg = self.leg(number);
        let (start, end) = (leg.start, leg.end());
        // As the path is evaluated.
        let mut left = leg.reached_from_left;
        while left > 0 {
            let vertex = self.vertex(number.wrapping_sub(u64::from(left - 1)));
            if start - vertex.s < vertex.stored().reach() {
                break;
            }
            left -= 1;
        }
        let mut right = leg.reached_from_right;
        while right > 0 {
            let vertex = self.vertex(number.wrapping_add(u64::from(right)));
            if vertex.s - end < vertex.stored().reach() {
                break;
            }
            right -= 1;
        }
        let leg = self.leg_mut(number);
        leg.reached_from_left = left;
        leg.reached_from_right = right;
    }

    /// Takes note that a vertex reaches `reach` to both sides on trial, or did: its legs have to be
    /// checked, and evaluation has to look for it there. Answers the number of legs visited.
    pub fn touch(&mut self, number: u64, reach: f64, next: u64) -> usize {
        self.visit_reached(number, reach, next, |leg, _, _| leg.check.unchecked = true)
    }

    /// The same, where it is for `visit` to say which legs have to be checked: it is given the distances of their nearer and of
    /// their farther end from the vertex, first those on its right.
    #[inline(always)]
    pub fn visit_reached(
        &mut self,
        number: u64,
        reach: f64,
        next: u64,
        mut visit: impl FnMut(&mut Leg, f64, f64),
    ) -> usize {
        let s = self.vertex(number).s;
        let mut visited = 1;
        for k in 0..NEIGHBOURS {
            let right = number.saturating_add(k);
            if right >= next || self.leg(right).start >= s + reach {
                break;
            }
            let leg = self.leg_mut(right);
            visit(leg, leg.start - s, leg.end() - s);
            leg.reached_from_left = leg.reached_from_left.max(k as u32 + 1);
            visited += 1;
        }
        for k in 1..=NEIGHBOURS {
            let Some(left) = number.checked_sub(k).filter(|left| *left >= self.first) else {
                break;
            };
            if self.leg(left).end() <= s - reach {
                break;
            }
            let leg = self.leg_mut(left);
            visit(leg, s - leg.end(), s - leg.start);
            leg.reached_from_right = leg.reached_from_right.max(k as u32);
            visited += 1;
        }
        visited
    }
}

#[cfg(test)]
mod tests {
    use super::super::settings::Allowance;
    use super::*;
    use crate::test_room::with_room;

    /// A chain of legs of length 1; it is too large for the stack of a test.
    fn with_chain(legs: u32, test: fn(&mut Chain)) {
        with_room(move || {
            let settings = BlendSettings::DEFAULT;
            let metric = Metric::new(settings.rotary_weight());
            let mut chain = Chain::new();
            for _ in 0..legs {
                let leg = Leg {
                    length: 1.0,
                    allowance: Allowance::Tolerance(0.1),
                    ..Leg::VACANT
                };
                chain.push(leg, &settings, &metric);
            }
            test(&mut chain);
        });
    }

    #[test]
    fn legs_are_found_by_distance() {
        with_chain(100, |chain| {
            assert_eq!(chain.end(), 100.0);
            for (s, leg) in [
                (-1.0, 0),
                (0.0, 0),
                (0.99, 0),
                (1.0, 1),
                (57.5, 57),
                (100.0, 99),
                (1e9, 99),
            ] {
                assert_eq!(chain.locate(s), leg, "{s}");
            }
        });
    }

    #[test]
    fn history_is_kept() {
        with_chain(2000, |chain| {
            chain.discard_before(50);
            assert_eq!((chain.first(), chain.oldest_whole()), (0, 0));
            chain.discard_before(1500);
            assert_eq!(chain.first(), 1500 - HISTORY);
            assert_eq!(chain.oldest_whole(), 1500 - HISTORY + REACHING);
            assert_eq!(chain.locate(0.0), chain.first());
            chain.discard_before(1000);
            assert_eq!(chain.first(), 1500 - HISTORY);
        });
    }

    #[test]
    fn there_is_room_for_so_many() {
        with_chain(SLOTS as u32 + 5, |chain| {
            assert_eq!(chain.room(), 0);
            assert_eq!(chain.end(), SLOTS as f64);
            chain.clear();
            assert!(chain.is_empty() && chain.last().is_none());
            assert_eq!((chain.room(), chain.end()), (SLOTS, 0.0));
        });
    }

    #[test]
    fn nothing_reaches_over_a_wall_or_farther_than_its_neighbours() {
        with_chain(200, |chain| {
            assert_eq!(chain.left_of(100).count() as u64, NEIGHBOURS);
            assert_eq!(chain.right_of(100, 200).count() as u64, NEIGHBOURS);
            chain.vertex_mut(98).wall = true;
            chain.vertex_mut(103).wall = true;
            let left: Vec<u64> = chain.left_of(100).map(|(number, _)| number).collect();
            let right: Vec<u64> = chain.right_of(100, 200).map(|(number, _)| number).collect();
            assert_eq!((left, right), (vec![100, 99, 98], vec![101, 102, 103]));
            assert_eq!(chain.right_of(100, 102).count(), 1);
            assert_eq!(chain.left_of(3).count(), 4);
        });
    }

    #[test]
    fn a_touch_reaches_as_far_as_the_kernel() {
        with_chain(20, |chain| {
            chain.touch(10, 2.5, 20);
            let touched: Vec<u64> = (0..20)
                .filter(|leg| chain.leg(*leg).check.unchecked)
                .collect();
            assert_eq!(touched, [7, 8, 9, 10, 11, 12]);
            assert_eq!(chain.leg(7).reached_from_right, 3);
            assert_eq!(chain.leg(9).reached_from_right, 1);
            assert_eq!(chain.leg(10).reached_from_left, 1);
            assert_eq!(chain.leg(12).reached_from_left, 3);
        });
    }

    #[test]
    fn what_reached_a_leg_on_trial_only_is_forgotten() {
        with_chain(20, |chain| {
            chain.touch(10, 2.5, 20);
            chain.touch(11, 1.5, 20);
            let widths = Widths {
                kernel: 1.5,
                ..Widths::NONE
            };
            chain.set_trial(11, widths);
            chain.store_trial(11);
            chain.settle(20, 14.0);
            let reached = |leg| {
                let leg = chain.leg(leg);
                (leg.reached_from_left, leg.reached_from_right)
            };
            let legs = [8, 9, 10, 11, 12, 13].map(reached);
            assert_eq!(legs, [(0, 0), (0, 2), (0, 1), (1, 0), (2, 0), (0, 0)]);
        });
    }
}
