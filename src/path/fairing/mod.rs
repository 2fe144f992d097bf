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
//! Moved are lines and arcs in XYZ under G64 with P, in runs. What is more than two dozen lines away hardly matters, so that
//! vertices become final soon behind the newest one. Long lines beside a corner, and arcs, are [divided](division), or there
//! were nothing to be moved. What bends much anyway [counts less](weights).

mod division;
mod piece;
mod solver;
mod weights;

pub(super) use self::division::MOST_PIECES;
use self::division::{Corner, Cuts};
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

/// How often the [`Solver`] is run for them, half of it before weights are determined anew.
const ITERATIONS: u32 = 10;

/// While more than these wait no leg is taken: there is work to be done first.
const MOST_WAITING: u64 = AHEAD + 3 * BATCH;

/// The vertex that a path begins with has the number before the first.
const BEFORE_FIRST: u64 = u64::MAX;

/// Kernel terms that an iteration takes for a vertex.
const COST: usize = 4;

/// Legs whose vertices are being moved.
#[derive(Debug)]
pub(super) struct Fairing {
    pieces: Ring<Piece, ROOM>,
    /// Number of the first piece that waits, and of the one to come.
    first: u64,
    next: u64,
    /// A leg whose next one is not known.
    held: Option<Leg>,
    /// Where it starts, if that vertex may be moved.
    corner: Option<Corner>,
    /// Whether that one, or one before it with nothing but straight lines between them, is a corner.
    in_run: bool,
    /// Number behind the last piece that [closes](Piece::closes).
    closed: u64,
    /// How many of those that wait are final.
    due: u64,
    /// How many are to become final next, behind which piece nothing is looked at for that, and how often the solver is still to be
    /// run.
    batch: u64,
    end: u64,
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
            corner: None,
            in_run: false,
            closed: 0,
            due: 0,
            batch: 0,
            end: 0,
            iterations: 0,
            solver: Solver::new(),
        }
    }

    pub fn clear(&mut self) {
        (self.first, self.next) = (0, 0);
        self.held = None;
        self.corner = None;
        self.in_run = false;
        self.closed = 0;
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
        let held = self.held.take();
        let corner = held
            .or_else(|| self.last())
            .and_then(|before| self.corner(&before, &leg, settings));
        if let Some(held) = held {
            self.divide(&held, corner, settings);
        }
        self.corner = corner;
        self.in_run = corner.is_some_and(|corner| self.in_run || !corner.is_straight());
        if is_moved(&leg, settings) && !leg.stop_after {
            self.held = Some(leg);
        } else {
            self.divide(&leg, None, settings);
            self.close();
        }
    }

    /// Nothing more is waited for.
    pub fn flush(&mut self, settings: &BlendSettings) {
        if let Some(held) = self.held.take() {
            self.divide(&held, None, settings);
        }
        self.close();
    }

    /// The piece before those to come.
    fn last(&self) -> Option<Leg> {
        let number = self.next.checked_sub(1)?;
        Some(self.pieces.at(number).leg)
    }

    /// Where two legs meet, if the vertex in between may be moved.
    fn corner(&self, before: &Leg, after: &Leg, settings: &BlendSettings) -> Option<Corner> {
        let moved = is_moved(before, settings) && is_moved(after, settings);
        if !moved || before.stop_after || after.stop_before {
            return None;
        }
        let corner = Corner::between(before, after);
        (!corner.is_lone(self.in_run)).then_some(corner)
    }

    /// Nothing to come changes what waits: it is to become final, as it would have if it had come sooner.
    fn close(&mut self) {
        if self.first < self.next {
            self.pieces.at_mut(self.next - 1).closes = true;
            self.closed = self.next;
        }
    }

    /// Whether there is work that waits for nothing to come.
    pub fn is_pressed(&self) -> bool {
        self.due > 0 || self.closed > self.first
    }

    /// Number of the first piece whose vertex may still be moved.
    fn settled(&self) -> u64 {
        self.first + self.due
    }

    /// Behind which piece nothing matters to the one with the number `settled`, if that is known.
    fn end_of_run(&self, settled: u64) -> Option<u64> {
        let mut closed = settled..self.closed;
        let last = closed.find(|number| self.pieces.at(*number).closes)?;
        Some(last + 1)
    }

    /// Moves the vertices that wait a little nearer to where they should be. Answers the kernel terms that it took, 0 if there
    /// is nothing to do.
    pub fn step(&mut self) -> usize {
        let settled = self.settled();
        if self.iterations == 0 {
            let end_of_run = self.end_of_run(settled);
            let end = end_of_run.unwrap_or(self.next);
            if end.saturating_sub(settled) >= WINDOW {
                (self.batch, self.end) = (BATCH, settled + WINDOW);
            } else if end_of_run.is_none() {
                return 0;
            } else if (settled..end - 1).any(|number| self.pieces.at(number).joined) {
                (self.batch, self.end) = (end - settled, end);
            } else {
                self.due = end - self.first;
                return 1;
            }
            weights::begin(&mut self.pieces, settled, self.end);
            self.solver.prepare(&self.pieces, settled, self.end);
            self.iterations = ITERATIONS;
        }
        let vertices = self.solver.iterate();
        self.iterations -= 1;
        if self.iterations == ITERATIONS / 2 {
            self.solver.store(&mut self.pieces);
            weights::weigh(&mut self.pieces, settled, self.end);
            self.solver.prepare(&self.pieces, settled, self.end);
        }
        if self.iterations == 0 {
            self.solver.store(&mut self.pieces);
            self.due += self.batch;
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

    /// Divides a leg that ends with a `corner`, if that is moved.
    fn divide(&mut self, leg: &Leg, corner: Option<Corner>, settings: &BlendSettings) {
        let joined = self.corner.is_some();
        let ends = [self.corner, corner]
            .map(|corner| corner.map_or(f64::INFINITY, |corner| corner.first_piece(leg, settings)));
        let cuts = Cuts::new(leg.length, ends, division::longest(leg));
        let mut lead = 0.0;
        for end in cuts.ends() {
            self.push(leg.part(lead, end), joined || lead > 0.0, settings);
            lead = end;
        }
    }

    /// Takes a piece. `joined`: the vertex at its start may be moved.
    fn push(&mut self, leg: Leg, joined: bool, settings: &BlendSettings) {
        let number = self.next;
        let mut piece = Piece::new(leg, settings);
        if let Some(before) = number.checked_sub(1) {
            let before = self.pieces.at_mut(before);
            before.join(&leg, joined, settings);
            if !before.joined {
                self.close();
            }
        } else {
            *self.pieces.at_mut(BEFORE_FIRST) = Piece::before(&leg);
        }
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

#[cfg(test)]
mod tests {
    use super::super::leg::ProgrammedMove;
    use super::super::metric::Metric;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::moves::shape::{Arc9, Circle, Line9, Shape};
    use crate::moves::{NearLimit, TerminationCondition};
    use core::f64::consts::PI;

    const TOLERANCE: f64 = 0.05;

    /// Lines through these points at 100 mm/s, faired while they come, one by one.
    fn faired(points: &[[f64; 2]]) -> Vec<Leg> {
        faired_by(&mut Box::new(Fairing::new()), points, false)
    }

    fn faired_by(fairing: &mut Fairing, points: &[[f64; 2]], waits: bool) -> Vec<Leg> {
        let line = |ends: &[[f64; 2]]| {
            let line = Line9::new(&at(ends[0]), &at(ends[1]));
            Shape::Line(line.expect("a line"))
        };
        let lines: Vec<_> = points.windows(2).map(line).collect();
        faired_shapes(fairing, &lines, waits)
    }

    fn at(point: [f64; 2]) -> Axes {
        Axes::from_fn(|axis, _| point.get(axis).copied().unwrap_or(0.0))
    }

    /// `waits`: with nothing done before there is no room for another one.
    fn faired_shapes(fairing: &mut Fairing, shapes: &[Shape], waits: bool) -> Vec<Leg> {
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let settings = BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound");
        let metric = Metric::new(settings.rotary_weight());
        let mut legs = Vec::new();
        for (serial, shape) in (1..).zip(shapes) {
            let programmed = ProgrammedMove {
                serial,
                shape: *shape,
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
            if !waits || fairing.is_full() {
                legs.extend(settled(fairing));
            }
        }
        fairing.flush(&settings);
        assert!(fairing.is_pressed());
        legs.extend(settled(fairing));
        assert!(!fairing.is_pressed());
        assert_eq!((fairing.waiting(), fairing.waiting_length()), (0, 0.0));
        let mut start = 0.0;
        for leg in &mut legs {
            leg.start = start;
            start = leg.end();
        }
        legs
    }

    /// What becomes final by all the work that there is.
    fn settled(fairing: &mut Fairing) -> Vec<Leg> {
        let mut legs = Vec::new();
        while fairing.step() > 0 {
            legs.extend(core::iter::from_fn(|| fairing.next()));
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
            let again = faired_by(&mut fairing, &staircase(steps), false);
            assert_eq!(
                shifts(&again),
                shifts(&faired(&staircase(steps))),
                "{steps}"
            );
        }
    }

    #[test]
    fn when_the_work_is_done_does_not_matter() {
        // Runs of less than a window and of more, with lone corners between them.
        let mut points = Vec::new();
        for (run, steps) in (0u32..).zip([3, 40, 5, 13, 14, 15, 16, 1]) {
            let offset = 20.0 * f64::from(run);
            points.extend(staircase(steps).iter().map(|[x, y]| [x + offset, *y]));
            points.push([offset + 10.0, -5.0]);
        }
        let mut fairing = Box::new(Fairing::new());
        let waiting = faired_by(&mut fairing, &points, true);
        assert_eq!(shifts(&waiting), shifts(&faired(&points)));
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
    fn corners_are_moved_together_with_denser_ones_before_them() {
        // Their kernels are a quarter as wide as the lines are long.
        let wave = |k: u32| [f64::from(k), 0.6 * f64::from(k % 2)];
        let alone: Vec<_> = (0..20).map(wave).collect();
        assert!(shifts(&faired(&alone)).iter().all(|shift| *shift == 0.0));
        let mut behind = staircase(10);
        let [x, y] = behind[behind.len() - 1];
        behind.extend((1..20).map(wave).map(|[dx, dy]| [x + dx, y + dy]));
        let legs = faired(&behind);
        let of_wave = legs.iter().filter(|leg| leg.serial > 21 && leg.serial < 39);
        assert!(of_wave.filter(|leg| leg.is_last_part).count() == 17);
        let moved = legs
            .iter()
            .filter(|leg| leg.serial > 21 && leg.is_last_part);
        let moved = moved.map(|leg| leg.shift_at(leg.end()).norm());
        assert!(moved.take(17).all(|shift| shift > 0.1 * TOLERANCE));
    }

    /// An arc of a radius of 1 mm about a place, counter-clockwise between two angles.
    fn arc([x, y]: [f64; 2], from: f64, to: f64) -> Shape {
        let place = |angle: f64| at([x + angle.cos(), y + angle.sin()]);
        let circle = Circle {
            center: Point::new(x, y, 0.0),
            normal: Point::new(0.0, 0.0, 1.0),
            revolutions: 0,
        };
        Shape::Arc(Arc9::new(&place(from), &place(to), &circle).expect("an arc"))
    }

    #[test]
    fn arcs_are_divided_beside_corners_and_moved() {
        // A scalloped edge.
        let scallops: Vec<_> = (0..12)
            .map(|k| {
                arc(
                    [-2.0 * 0.4f64.sin() * f64::from(k), 0.0],
                    PI / 2.0 - 0.4,
                    PI / 2.0 + 0.4,
                )
            })
            .collect();
        let mut fairing = Box::new(Fairing::new());
        let legs = faired_shapes(&mut fairing, &scallops, false);
        assert!(legs.len() > 3 * scallops.len());
        assert!(legs.iter().all(|leg| leg.turning * leg.length < 0.6));
        let shifts = shifts(&legs);
        assert!(shifts.iter().all(|shift| *shift <= TOLERANCE));
        assert!(shifts.iter().filter(|shift| **shift > 0.0).count() > 2 * scallops.len());
        for legs in legs.windows(2) {
            let [before, after] = legs else {
                return;
            };
            let gap = before.point(before.end()).position - after.point(after.start).position;
            assert!(gap.norm() < 1e-12, "{gap}");
        }
    }

    #[test]
    fn a_circle_stays_as_it_is() {
        let halves = [arc([0.0, 0.0], 0.0, PI), arc([0.0, 0.0], PI, 2.0 * PI)];
        let mut fairing = Box::new(Fairing::new());
        let legs = faired_shapes(&mut fairing, &halves, false);
        assert_eq!(shifts(&legs), [0.0; 2]);
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
