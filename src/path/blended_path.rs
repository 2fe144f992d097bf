//! The blended path as the rest of the planner sees it.

use nalgebra::ArrayStorage;

/// What stays open of a leg is at least so many times as long as what the machine needs of it at once.
const OPEN: f64 = 0.25;

use super::chain::Chain;
use super::chords::{Chords, MOST_CHORDS};
use super::curve;
use super::error::BlendError;
use super::fairing::{Fairing, MOST_PIECES};
use super::jump::GROUPS;
use super::leg::{Leg, ProgrammedMove};
use super::line_merger::LineMerger;
use super::metric::Metric;
use super::settings::BlendSettings;
use super::width_optimizer::WidthOptimizer;
use crate::axes::{AXIS_COUNT, Axes};
use crate::moves::shape::measure::LEAST_DISTANCE;
use crate::moves::shape::{PathPoint, Shape};

const ORIGIN: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// Legs that a single move may need room for: the lines that were waiting, and itself.
const LEGS_A_MOVE: usize = 2;

// Each leg is divided into so many pieces at most, or is an arc whose chords are not divided.
const _: () = assert!(MOST_CHORDS <= MOST_PIECES);

/// Kernel terms that it takes to put a leg in its place.
const PUT_IN_PLACE: usize = 64;

/// The kernel terms that moving vertices took.
struct Faired {
    /// For what nothing to come changes any more.
    due: usize,
    /// For what may still wait.
    ahead: usize,
}

/// The path through the queued moves, over path distance s.
///
/// s is the arc length of the programmed path in machine units, a degree of A B C counting as much
/// as [`BlendSettings`] says. It starts at 0 and grows over all moves. What the feed F counts
/// (XYZ, else UVW, else ABC) is in proportion to s on each leg, see [`LegView::measure_rate`]:
/// at ds/dt the programmed path is run through at `measure_rate ds/dt` in F's measure.
///
/// Three places divide the path:
///
/// - up to [`final_end`](Self::final_end) it never changes again, whatever moves are added;
/// - up to [`known_end`](Self::known_end) it is within its tolerance and ends, on the programmed
///   path, at the end of a leg: the machine may come to rest there;
/// - up to [`programmed_end`](Self::programmed_end) moves were added; [`step`](Self::step) lets
///   the known end follow.
///
/// It is large and made to lie in a static.
#[derive(Debug)]
pub struct BlendedPath {
    settings: BlendSettings,
    metric: Metric,
    pub(super) chain: Chain,
    merger: LineMerger,
    fairing: Fairing,
    optimizer: WidthOptimizer,
    /// Where the path starts.
    start: Axes,
    /// Where the moves that were added end.
    goal: Axes,
    /// Number of the newest move.
    serial: Option<u64>,
    /// Widths are to be chosen up to the end, however little is new.
    hurry: bool,
    /// The machine comes to rest at the end of what was added.
    finished: bool,
}

impl BlendedPath {
    /// An empty path from the origin.
    pub const fn new() -> Self {
        Self {
            settings: BlendSettings::DEFAULT,
            metric: Metric::new(BlendSettings::DEFAULT.rotary_weight()),
            chain: Chain::new(),
            merger: LineMerger::new(),
            fairing: Fairing::new(),
            optimizer: WidthOptimizer::new(),
            start: ORIGIN,
            goal: ORIGIN,
            serial: None,
            hurry: false,
            finished: false,
        }
    }

    /// Drops everything: the machine is at rest at `position`, shape (9), where s is 0.
    pub fn restart(&mut self, settings: &BlendSettings, position: &Axes) {
        self.settings = *settings;
        self.metric = Metric::new(settings.rotary_weight());
        self.chain.clear();
        self.merger.clear();
        self.fairing.clear();
        self.optimizer.restart(&self.chain);
        self.start = *position;
        self.goal = *position;
        self.serial = None;
        self.hurry = false;
        self.finished = false;
    }

    /// Adds a move at the end.
    ///
    /// # Errors
    /// See [`BlendError`].
    pub fn add(&mut self, programmed: &ProgrammedMove) -> Result<(), BlendError> {
        let away = (programmed.shape.position(0.0) - self.goal).amax();
        if away.is_nan() || away > LEAST_DISTANCE {
            return Err(BlendError::Gap);
        }
        if !(programmed.feed > 0.0 && programmed.feed.is_finite()) {
            return Err(BlendError::Feed);
        }
        if self
            .serial
            .is_some_and(|newest| programmed.serial <= newest)
        {
            return Err(BlendError::Serial);
        }
        let room = LEGS_A_MOVE * MOST_PIECES + self.fairing.waiting();
        if self.chain.room() < room || self.fairing.is_full() {
            return Err(BlendError::Full);
        }
        let leg = Leg {
            stop_before: programmed.stop_before || self.finished,
            ..Leg::new(programmed, &self.settings, &self.metric)
        };
        if !(leg.length > 0.0 && leg.length.is_finite()) {
            return Err(BlendError::ZeroLength);
        }
        let (settings, metric) = (&self.settings, &self.metric);
        if !self.merger.merge(programmed, &leg, settings, metric) {
            if let Some(whole) = self.merger.absorb(programmed, &leg, settings, metric) {
                self.push_as_chords(whole);
            } else {
                self.release_waiting();
                if !self.merger.hold(programmed, &leg) {
                    self.push_as_chords(leg);
                }
            }
        }
        self.goal = programmed.shape.end();
        self.serial = Some(programmed.serial);
        self.hurry = false;
        self.finished = false;
        Ok(())
    }

    /// Nothing more came for a while: lines that wait to be merged wait no longer, and
    /// [`step`](Self::step) takes the known end to the end of all moves. Later moves are blended
    /// with these as far as the path is not yet final.
    pub fn flush(&mut self) {
        self.release_waiting();
        self.press();
        self.hurry = true;
    }

    /// More of the path is needed now: [`step`](Self::step) puts vertices where they are to be, whatever comes. Lines that wait
    /// to be merged go on waiting. Answers whether there is anything to be pressed for.
    pub fn press(&mut self) -> bool {
        let waited = self.fairing.waiting() > 0;
        self.fairing.flush(&self.settings);
        waited
    }

    /// The next move is late. As much becomes final behind path distance `from` as the machine runs in `seconds` on the last leg and
    /// where it gathers speed and brakes besides; beyond that a corner with the next move may still be rounded. Only when
    /// [settled](Self::is_settled). Answers whether that leaves anything worth while.
    pub fn leave_open(&mut self, from: f64, seconds: f64) -> bool {
        let Some(last) = self.chain.last().filter(|last| !last.is_exact()) else {
            return false;
        };
        let needed = last.way_within(seconds, &self.settings);
        let place = from + needed;
        let worthwhile = self.chain.end() - place > OPEN * needed;
        if worthwhile {
            self.optimizer.freeze_up_to(&self.chain, place);
        }
        worthwhile
    }

    /// The machine will come to rest at the end of all moves: as [`flush`](Self::flush), and all
    /// of the path becomes final.
    pub fn finish(&mut self) {
        self.flush();
        self.finished = !self.chain.is_empty() || self.fairing.waiting() > 0;
        self.freeze_at_rest();
    }

    /// Moves vertices and chooses widths, for about `budget` kernel terms of 5 ns or so; at most
    /// [`GREATEST_EXCESS`](super::GREATEST_EXCESS) more. Answers what it took: less than the
    /// budget if there is nothing more to do.
    pub fn step(&mut self, budget: usize) -> usize {
        let faired = self.fair(budget);
        // What is due is little mostly, and widths do not come later for it.
        let taken = faired.ahead + faired.due.saturating_sub(budget / 2);
        let spent = self.optimizer.step(
            &mut self.chain,
            &self.settings,
            &self.metric,
            self.hurry,
            budget.saturating_sub(taken),
        );
        self.freeze_at_rest();
        faired.ahead + faired.due + spent
    }

    /// Where the machine rests at the end nothing to come changes the path.
    fn freeze_at_rest(&mut self) {
        if self.rests_at_end() && self.optimizer.is_settled(&self.chain) {
            self.optimizer.freeze(&self.chain);
        }
    }

    /// Moves vertices and puts what is final of them at the end of the chain.
    fn fair(&mut self, budget: usize) -> Faired {
        let mut faired = Faired { due: 0, ahead: 0 };
        while faired.due < budget {
            if let Some(leg) = self.fairing.next() {
                self.put_in_place(leg);
                faired.due += PUT_IN_PLACE;
            } else if self.fairing.is_pressed() {
                faired.due += self.fairing.step();
            } else if faired.ahead < budget / 2 {
                let cost = self.fairing.step();
                faired.ahead += cost;
                if cost == 0 {
                    break;
                }
            } else {
                break;
            }
        }
        faired
    }

    fn push(&mut self, leg: Leg) {
        self.fairing.take(leg, &self.settings);
    }

    /// The chords of a leg that is run as those, or itself.
    fn push_as_chords(&mut self, leg: Leg) {
        match Chords::of(&leg, &self.settings) {
            Some(chords) => chords.legs().for_each(|chord| self.push(chord)),
            None => self.push(leg),
        }
    }

    /// Puts a leg that is to be where it is at the end of the chain.
    fn put_in_place(&mut self, leg: Leg) {
        let leg = curve::with_its_width(leg, &self.chain, &self.settings, &self.metric);
        self.chain.push(leg, &self.settings, &self.metric);
    }

    fn release_waiting(&mut self) {
        if let Some(leg) = self.merger.take() {
            self.push_as_chords(leg);
        }
    }

    /// Where the moves that were added end, without lines that wait to be merged, or for what comes behind them; path distance.
    pub fn programmed_end(&self) -> f64 {
        self.chain.end()
    }

    /// Where the moves that were added end, with all that waits; path distance.
    pub fn added_end(&self) -> f64 {
        self.chain.end() + self.fairing.waiting_length() + self.merger.waiting_length()
    }

    /// Up to where the path is within its tolerance, path distance.
    pub fn known_end(&self) -> f64 {
        self.optimizer.stored_end()
    }

    /// Up to where the path never changes again, path distance.
    pub fn final_end(&self) -> f64 {
        self.optimizer.frozen()
    }

    /// Where all moves end, shape (9), exactly as given.
    pub fn goal(&self) -> Axes {
        self.goal
    }

    /// The path at `s`, held within what there is, with derivatives by s. At a stop: of the leg
    /// that starts there.
    pub fn point(&self, s: f64) -> PathPoint {
        if self.chain.is_empty() {
            return self.rest();
        }
        self.point_of_leg(self.chain.locate(s), s)
    }

    /// The same, but at a stop of the leg that ends there.
    pub fn point_before(&self, s: f64) -> PathPoint {
        if self.chain.is_empty() {
            return self.rest();
        }
        let number = self.chain.locate(s);
        let before = number.saturating_sub(1);
        if before >= self.chain.first() && before < number && self.chain.leg(number).start >= s {
            self.point_of_leg(before, s)
        } else {
            self.point_of_leg(number, s)
        }
    }

    /// The programmed path at `s`, held within what there is, with derivatives by s.
    pub fn programmed_point(&self, s: f64) -> PathPoint {
        if self.chain.is_empty() {
            return self.rest();
        }
        self.chain.leg(self.chain.locate(s)).programmed_point(s)
    }

    fn rest(&self) -> PathPoint {
        PathPoint {
            position: self.start,
            first: ORIGIN,
            second: ORIGIN,
            third: ORIGIN,
        }
    }

    fn point_of_leg(&self, number: u64, s: f64) -> PathPoint {
        let leg = self.chain.leg(number);
        let s = s.max(leg.start).min(leg.end());
        let mut point = leg.point(s);
        self.add_jumps::<true, true>(number, s, &mut point);
        point
    }

    /// The position and the first derivative of [that](Self::point) alone.
    pub fn position_and_direction(&self, s: f64) -> [Axes; 2] {
        if self.chain.is_empty() {
            return [self.start, ORIGIN];
        }
        let number = self.chain.locate(s);
        let leg = self.chain.leg(number);
        let s = s.max(leg.start).min(leg.end());
        let mut point = leg.point(s);
        self.add_jumps::<true, false>(number, s, &mut point);
        [point.position, point.first]
    }

    /// The second and the third derivative of [that](Self::point) alone.
    pub fn bend(&self, s: f64) -> [Axes; 2] {
        if self.chain.is_empty() {
            return [ORIGIN; 2];
        }
        let number = self.chain.locate(s);
        let leg = self.chain.leg(number);
        let s = s.max(leg.start).min(leg.end());
        let [second, third] = leg.bend(s);
        let mut point = PathPoint {
            second,
            third,
            ..PathPoint::ZERO
        };
        self.add_jumps::<false, true>(number, s, &mut point);
        [point.second, point.third]
    }

    /// Adds what vertices add to the path at `s`, within the leg with this number: to the position and the first derivative
    /// (`LOW`), and to the second and the third (`HIGH`).
    #[inline(always)]
    fn add_jumps<const LOW: bool, const HIGH: bool>(
        &self,
        number: u64,
        s: f64,
        point: &mut PathPoint,
    ) {
        if self.chain.is_linear() {
            self.chain.jumps::<1, LOW, HIGH>(number, s).add_to(point);
        } else {
            let sum = self.chain.jumps::<GROUPS, LOW, HIGH>(number, s);
            sum.add_to(point);
        }
    }

    /// The places behind `from` and before `to` where the third derivative or its slope may jump, both sides of a jump of the
    /// third derivative itself, as many as there is room for; answers how many. In no order.
    pub fn breakpoints(&self, from: f64, to: f64, places: &mut [f64]) -> usize {
        if self.chain.is_empty() {
            return 0;
        }
        let (start, end) = (self.chain.locate(from), self.chain.locate(to));
        let left = u64::from(self.chain.leg(start).reached_from_left);
        let right = u64::from(self.chain.leg(end).reached_from_right);
        let first = start.saturating_add(1).saturating_sub(left);
        let mut room = places.iter_mut();
        let mut count = 0;
        self.chain
            .breakpoints(first, end.saturating_add(right), [from, to], |place| {
                if let Some(free) = room.next() {
                    *free = place;
                    count += 1;
                }
            });
        count
    }

    /// What no final vertex reaches beyond, so far.
    pub fn greatest_reach(&self) -> f64 {
        self.optimizer.greatest_reach()
    }

    /// Whether the machine comes to rest at the [programmed end](Self::programmed_end).
    pub fn rests_at_end(&self) -> bool {
        let finished = self.finished && self.fairing.waiting() == 0;
        finished || self.chain.last().is_some_and(|leg| leg.stop_after)
    }

    /// The length of a displacement, shape (9), as path distance counts it.
    pub fn distance(&self, displacement: &Axes) -> f64 {
        self.metric.norm(displacement)
    }

    /// The machine will not go back behind `s`: makes room.
    pub fn discard_before(&mut self, s: f64) {
        if !self.chain.is_empty() {
            let number = self.chain.locate(s).min(self.optimizer.open());
            self.chain.discard_before(number);
        }
    }

    /// Whether [`step`](Self::step) has taken the known end to the programmed one.
    pub fn is_settled(&self) -> bool {
        self.fairing.waiting() == 0 && self.optimizer.is_settled(&self.chain)
    }

    /// A shape's length in path distance.
    pub fn path_length(&self, shape: &Shape) -> f64 {
        shape.length() * self.metric.per_measure(shape)
    }
}

impl Default for BlendedPath {
    fn default() -> Self {
        Self::new()
    }
}
