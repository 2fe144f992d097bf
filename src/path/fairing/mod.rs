//! Fairing: the vertices of runs of short lines are moved within a part of the tolerance, so that the path bends as
//! evenly as it can.
//!
//! Kernels round each vertex where it is. Where lines are short it is the polygon itself that bends more than it has to: it
//! zigzags within what coordinates are rounded to, keeps each step of a staircase, and turns at a corner all at once.
//! What is wanted is the polygon within the tolerance with the least sum over its thirds of divided differences,
//!
//! ```text
//! sum of (s[k+3] - s[k]) / 3 |6 q[s[k], s[k+1], s[k+2], s[k+3]]|^2
//! ```
//!
//! the integral of the square of the third derivative over path distance, which jerk is in proportion to (a smoothing
//! spline: Reinsch, Numerische Mathematik 10, 1967; for polygons, Whittaker, Proceedings of the Edinburgh Mathematical
//! Society 41, 1922). It is a quadratic programme with a constraint for each vertex, which [`solver`] approaches.
//!
//! The kernels of the path find their widths afterwards, within what is left of the tolerance. Nothing depends on how well
//! vertices were moved: none is moved by more than a share of the tolerance, so that a kernel narrow enough always keeps it.
//!
//! Moved are lines in XYZ under G64 with P, in runs. What is more than two dozen lines away hardly matters, so that vertices
//! become final soon behind the newest one. Long lines beside a corner are [divided](division), or there were nothing to be
//! moved.

mod division;
mod piece;
mod solver;

use self::division::Cuts;
pub(super) use self::division::MOST_PIECES;
use self::piece::{Piece, Point, ROOM, is_moved};
use self::solver::Solver;
use super::leg::Leg;
use super::settings::BlendSettings;
use super::shift::Shift;
use crate::ring::Ring;

/// A vertex with so many behind it is final.
const AHEAD: u64 = 24;

/// As many become final at a time.
const BATCH: u64 = 4;

/// Pieces that are looked at for that.
const WINDOW: u64 = AHEAD + BATCH;

/// How often the [`Solver`] is run for them.
const ITERATIONS: u32 = 10;

/// While more than these wait no leg is taken: there is work to be done first.
const MOST_WAITING: u64 = AHEAD + 3 * BATCH;

/// Kernel terms that an iteration takes for a vertex.
const COST: usize = 4;

/// Lines whose vertices are being moved.
#[derive(Debug)]
pub(super) struct Fairing {
    pieces: Ring<Piece, ROOM>,
    /// Number of the first piece that waits, and of the one to come.
    first: u64,
    next: u64,
    /// A leg whose next one is not known.
    held: Option<Leg>,
    /// How many of those that wait are final.
    due: u64,
    /// How often the solver is still to be run for those that are to be.
    iterations: u32,
    solver: Solver,
}

impl Fairing {
    pub const fn new() -> Self {
        Self {
            pieces: Ring::filled_with(Piece::VACANT),
            first: 0,
            next: 0,
            held: None,
            due: 0,
            iterations: 0,
            solver: Solver::new(),
        }
    }

    pub fn clear(&mut self) {
        (self.first, self.next) = (0, 0);
        // The vertex that a path begins with has the number before the first.
        *self.pieces.at_mut(0u64.wrapping_sub(1)) = Piece::VACANT;
        self.held = None;
        self.due = 0;
        self.iterations = 0;
    }

    /// How long what waits is, path distance.
    pub fn waiting_length(&self) -> f64 {
        let pieces = (self.first..self.next).map(|number| self.pieces.at(number).leg.length);
        self.held.map_or(0.0, |leg| leg.length) + pieces.sum::<f64>()
    }

    /// How many pieces wait, and may come of the leg that is held.
    pub fn waiting(&self) -> usize {
        let held = if self.held.is_some() { MOST_PIECES } else { 0 };
        held + (self.next - self.first) as usize
    }

    /// Whether there is work to be done before it takes another leg.
    pub fn is_full(&self) -> bool {
        self.next - self.first > MOST_WAITING
    }

    /// Takes the leg that comes next.
    pub fn take(&mut self, leg: Leg, settings: &BlendSettings) {
        if let Some(held) = self.held.take() {
            self.divide(&held, Some(&leg), settings);
        }
        if is_moved(&leg, settings) && !leg.stop_after {
            self.held = Some(leg);
        } else {
            self.divide(&leg, None, settings);
            self.close(self.next);
        }
    }

    /// Nothing more is waited for.
    pub fn flush(&mut self, settings: &BlendSettings) {
        if let Some(held) = self.held.take() {
            self.divide(&held, None, settings);
        }
        self.close(self.next);
    }

    /// What waits before the piece with the number `end` is final.
    fn close(&mut self, end: u64) {
        // As if there had been time for it before, or the shape would depend on when moves come.
        while end.saturating_sub(self.settled()) >= WINDOW {
            while self.step() > 0 && self.iterations > 0 {}
        }
        self.iterations = 0;
        let settled = self.settled();
        if (settled..end).any(|number| number + 1 < end && self.pieces.at(number).joined) {
            self.solver.prepare(&self.pieces, settled, end);
            for _ in 0..ITERATIONS {
                self.solver.iterate();
            }
            self.solver.store(&mut self.pieces);
        }
        self.due = self.due.max(end.saturating_sub(self.first));
    }

    /// Number of the first piece whose vertex may still be moved.
    fn settled(&self) -> u64 {
        self.first + self.due
    }

    /// Moves the vertices that wait a little nearer to where they should be. Answers the kernel terms that it took, 0 if there
    /// is nothing to do.
    pub fn step(&mut self) -> usize {
        if self.iterations == 0 {
            let settled = self.settled();
            if self.next.saturating_sub(settled) < WINDOW {
                return 0;
            }
            self.solver.prepare(&self.pieces, settled, settled + WINDOW);
            self.iterations = ITERATIONS;
        }
        let vertices = self.solver.iterate();
        self.iterations -= 1;
        if self.iterations == 0 {
            self.solver.store(&mut self.pieces);
            self.due += BATCH;
        }
        COST * vertices
    }

    /// The next piece that is final, in the place where it is.
    pub fn next(&mut self) -> Option<Leg> {
        if self.due == 0 || self.first >= self.next {
            self.due = 0;
            return None;
        }
        let start = match self.first.checked_sub(1) {
            Some(before) => self.pieces.at(before).shift,
            None => Point::zeros(),
        };
        let piece = self.pieces.at(self.first);
        let leg = Leg {
            shift: Shift::between(&start, &piece.shift, piece.leg.length),
            ..piece.leg
        };
        self.first += 1;
        self.due -= 1;
        Some(leg)
    }

    /// Divides a leg that is followed by `next`, if that is known.
    fn divide(&mut self, leg: &Leg, next: Option<&Leg>, settings: &BlendSettings) {
        let before = self
            .next
            .checked_sub(1)
            .map(|number| self.pieces.at(number).leg);
        let ends = [
            before.map_or(f64::INFINITY, |before| {
                first_piece(leg, &before, leg, settings)
            }),
            next.map_or(f64::INFINITY, |next| first_piece(leg, leg, next, settings)),
        ];
        let cuts = Cuts::new(leg.length, ends);
        let mut lead = 0.0;
        for end in cuts.ends() {
            self.push(leg.part(lead, end), settings);
            lead = end;
        }
    }

    fn push(&mut self, leg: Leg, settings: &BlendSettings) {
        let number = self.next;
        if let Some(before) = number.checked_sub(1) {
            let before = self.pieces.at_mut(before);
            before.join(&leg, settings);
            if !before.joined {
                // Nothing to come changes what lies before.
                self.close(number);
            }
        }
        let mut piece = Piece::new(leg);
        if let Some(earliest) = number.checked_sub(2) {
            let (one, two) = (self.pieces.at(earliest), self.pieces.at(earliest + 1));
            if one.joined && two.joined {
                piece.third = piece::third([one.leg.length, two.leg.length, leg.length]);
            }
        }
        *self.pieces.at_mut(number) = piece;
        self.next += 1;
    }
}

/// How long the piece of `leg` is beside the vertex where `before` and `after` meet; infinite if vertices are not moved there.
fn first_piece(leg: &Leg, before: &Leg, after: &Leg, settings: &BlendSettings) -> f64 {
    let moved = is_moved(before, settings) && is_moved(after, settings);
    if !moved || before.stop_after || after.stop_before {
        return f64::INFINITY;
    }
    let turn = division::turn_between(before, after);
    if turn > 0.0 && !division::is_lone(before, after) {
        division::first_piece(leg, turn, settings)
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::leg::ProgrammedMove;
    use super::super::metric::Metric;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::moves::shape::{Line9, Shape};
    use crate::moves::{NearLimit, TerminationCondition};

    const TOLERANCE: f64 = 0.05;

    /// Lines through these points at 100 mm/s, faired while they come, one by one.
    fn faired(points: &[[f64; 2]]) -> Vec<Leg> {
        faired_by(&mut Box::new(Fairing::new()), points)
    }

    fn faired_by(fairing: &mut Fairing, points: &[[f64; 2]]) -> Vec<Leg> {
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let settings = BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound");
        let metric = Metric::new(settings.rotary_weight());
        let mut legs = Vec::new();
        let at = |point: [f64; 2]| Axes::from_fn(|axis, _| point.get(axis).copied().unwrap_or(0.0));
        for (serial, ends) in (1..).zip(points.windows(2)) {
            let programmed = ProgrammedMove {
                serial,
                shape: Shape::Line(Line9::new(&at(ends[0]), &at(ends[1])).expect("a line")),
                feed: 100.0,
                greatest_feed: 100.0,
                termination: TerminationCondition::Continuous {
                    tolerance: TOLERANCE,
                },
                stop_before: false,
                separate: false,
                may_swing_out: true,
                near_limit: NearLimit::NONE,
            };
            fairing.take(Leg::new(&programmed, &settings, &metric), &settings);
            while fairing.step() > 0 {
                legs.extend(core::iter::from_fn(|| fairing.next()));
            }
            legs.extend(core::iter::from_fn(|| fairing.next()));
        }
        assert!(fairing.waiting() > 0 && fairing.waiting_length() > 0.0);
        fairing.flush(&settings);
        legs.extend(core::iter::from_fn(|| fairing.next()));
        assert_eq!((fairing.waiting(), fairing.waiting_length()), (0, 0.0));
        let mut start = 0.0;
        for leg in &mut legs {
            leg.start = start;
            start = leg.end();
        }
        legs
    }

    fn shifts(legs: &[Leg]) -> Vec<f64> {
        let ends = legs.iter().map(|leg| leg.shift_at(leg.end()).norm());
        ends.collect()
    }

    /// The sum over the third divided differences of the vertices, where they are and where the program has them.
    fn sums(legs: &[Leg]) -> [f64; 2] {
        [false, true].map(|programmed| {
            let place = |leg: &Leg, s: f64| {
                if programmed {
                    leg.programmed_point(s).position
                } else {
                    leg.point(s).position
                }
            };
            let thirds = legs.windows(3).map(|legs| {
                let [one, two, three] = legs else {
                    return 0.0;
                };
                let places = [
                    place(one, one.start),
                    place(two, two.start),
                    place(three, three.start),
                    place(three, three.end()),
                ];
                let counts = piece::third([one.length, two.length, three.length]);
                let terms = places.iter().zip(counts);
                terms
                    .map(|(place, counts)| place * counts)
                    .sum::<Axes>()
                    .norm_squared()
            });
            thirds.sum()
        })
    }

    fn staircase(steps: u32) -> Vec<[f64; 2]> {
        let corner = |k: u32| [0.03 * f64::from(k.div_ceil(2)), 0.03 * f64::from(k / 2)];
        (0..=2 * steps).map(corner).collect()
    }

    #[test]
    fn a_staircase_is_made_even_within_its_room() {
        let legs = faired(&staircase(60));
        let shifts = shifts(&legs);
        let greatest = shifts
            .iter()
            .fold(0.0, |greatest, shift| f64::max(greatest, *shift));
        assert!(greatest <= TOLERANCE, "{greatest}");
        assert_eq!(shifts.last(), Some(&0.0));
        let [moved, programmed] = sums(&legs);
        assert!(moved < 1e-3 * programmed, "{moved} {programmed}");
    }

    #[test]
    fn what_was_moved_before_a_path_does_not_matter_to_it() {
        let mut fairing = Box::new(Fairing::new());
        for steps in [60, 63, 64, 65, 60] {
            fairing.clear();
            let again = faired_by(&mut fairing, &staircase(steps));
            assert_eq!(
                shifts(&again),
                shifts(&faired(&staircase(steps))),
                "{steps}"
            );
        }
    }

    #[test]
    fn moved_lines_meet() {
        for legs in faired(&staircase(60)).windows(2) {
            let [before, after] = legs else {
                return;
            };
            assert_eq!(before.shift_at(before.end()), after.shift_at(after.start));
        }
    }

    #[test]
    fn corners_that_stand_alone_stay_as_they_are() {
        let square = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0], [0.0, 0.0]];
        let legs = faired(&square);
        assert_eq!(legs.len(), 4);
        assert_eq!(shifts(&legs), [0.0; 4]);
    }

    #[test]
    fn a_circle_of_chords_does_not_shrink() {
        let point = |k: u32| {
            let angle = f64::from(k) * 0.05;
            [10.0 * angle.cos(), 10.0 * angle.sin()]
        };
        let circle: Vec<_> = (0..200).map(point).collect();
        let shifts = shifts(&faired(&circle));
        assert!(
            shifts.iter().all(|shift| *shift < 0.1 * TOLERANCE),
            "{shifts:?}"
        );
    }

    #[test]
    fn the_parts_of_a_line_make_up_the_whole_one() {
        let bend = [[0.0, 0.0], [2.0, 0.0], [2.02, 0.3], [2.0, 0.6], [0.0, 0.6]];
        let legs = faired(&bend);
        let first: Vec<_> = legs.iter().filter(|leg| leg.serial == 1).collect();
        assert!(first.len() > 2);
        assert!(first.iter().all(|leg| leg.whole == 2.0));
        let mut lead = 0.0;
        for (number, leg) in first.iter().enumerate() {
            assert!((leg.lead - lead).abs() < 1e-12);
            assert_eq!(leg.is_last_part, number + 1 == first.len());
            assert!((leg.measured(leg.start) - lead).abs() < 1e-12);
            lead += leg.length;
        }
        assert!((lead - 2.0).abs() < 1e-12);
        let last = first[first.len() - 1];
        assert_eq!(last.measured(last.end()), 2.0);
    }
}
