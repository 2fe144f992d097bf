//! Very short moves are merged before anything else looks at them.
//!
//! Lines far shorter than any kernel cost work and say nothing. They are replaced by their chord,
//! as long as the points left out lie within a small part of the tolerance from it. So are arcs that are no farther from theirs.
//!
//! What waits in front of a longer move becomes a part of it, within the same tolerance: the move begins where that does. Programs
//! are full of such moves where the radius of a tool was taken into account, with an arc of micrometres in each corner that hardly
//! is one. Kernels overlap where lines are short, but an [easement](super::easement) is only so many times as wide as the moves
//! beside it are long: next to nothing there.

use super::chords::sagitta;
use super::leg::{Leg, ProgrammedMove};
use super::metric::Metric;
use super::settings::{Allowance, BlendSettings};
use crate::axes::Axes;
use crate::moves::shape::measure::Measure;
use crate::moves::shape::{Arc9, Line9, Shape};
use crate::moves::{FeedWord, NearLimit};

/// Points left out of a chord at most, and its end.
const POINTS: usize = 32;

/// The greatest length of a chord, in design widths.
const GREATEST_CHORD: f64 = 1.0 / 16.0;

/// The share of the tolerance that leaving points out may use.
const DROPPED_SHARE: f64 = 0.1;

/// What becomes a part of a move is at most this share of it.
const ABSORBED_SHARE: f64 = 0.25;

/// How much the proportion of the two distances may differ between lines that are merged.
const SAME_RATE: f64 = 1.1;

/// Short moves that wait for more of their kind.
#[derive(Debug)]
pub(super) struct LineMerger {
    /// What is waiting, as one leg; of length 0 if nothing is.
    chord: Leg,
    waiting: bool,
    start: Axes,
    points: [Axes; POINTS],
    count: usize,
    /// That of each line, before anything is taken off it.
    allowance: Allowance,
    feed: f64,
    feed_word: Option<FeedWord>,
    measure: Measure,
    /// How far they all go, path distance.
    length: f64,
    /// How far an arc among them may be from its chord, machine units.
    bulge: f64,
}

impl LineMerger {
    pub const fn new() -> Self {
        const ORIGIN: Axes =
            Axes::from_array_storage(nalgebra::ArrayStorage([[0.0; crate::axes::AXIS_COUNT]]));
        Self {
            chord: Leg::VACANT,
            waiting: false,
            start: ORIGIN,
            points: [ORIGIN; POINTS],
            count: 0,
            allowance: Allowance::Exact(0.0),
            feed: 0.0,
            feed_word: None,
            measure: Measure::Linear,
            length: 0.0,
            bulge: 0.0,
        }
    }

    pub fn clear(&mut self) {
        self.waiting = false;
    }

    /// How long what is waiting is, machine units.
    pub fn waiting_length(&self) -> f64 {
        if self.waiting { self.chord.length } else { 0.0 }
    }

    /// What is waiting, which then waits no more.
    pub fn take(&mut self) -> Option<Leg> {
        core::mem::take(&mut self.waiting).then_some(self.chord)
    }

    /// Lets a leg wait, if it is a line short enough. Only while nothing is waiting.
    pub fn hold(&mut self, programmed: &ProgrammedMove, leg: &Leg) -> bool {
        if leg.is_exact() || leg.stop_after || leg.length > GREATEST_CHORD * leg.design_width {
            return false;
        }
        let Some(Straight { line, bulge }) = Straight::of(programmed, leg) else {
            return false;
        };
        self.waiting = true;
        self.start = line.position(0.0);
        self.count = 0;
        self.keep(line.end());
        self.allowance = leg.allowance;
        self.feed = programmed.feed;
        self.feed_word = programmed.feed_word;
        self.measure = leg.measure;
        self.length = leg.length;
        self.bulge = bulge;
        self.chord = *leg;
        true
    }

    /// Merges a leg with what is waiting, if it fits.
    pub fn merge(
        &mut self,
        programmed: &ProgrammedMove,
        leg: &Leg,
        settings: &BlendSettings,
        metric: &Metric,
    ) -> bool {
        let same_feed = programmed.feed == self.feed;
        if !same_feed || leg.stop_after || !self.goes_on(programmed, leg) || self.count >= POINTS {
            return false;
        }
        let Some(Straight { line, bulge }) = Straight::of(programmed, leg) else {
            return false;
        };
        let end = line.end();
        let Ok(chord) = Line9::new(&self.start, &end) else {
            return false;
        };
        let Some(left_out) = self.greatest_distance(&end, metric) else {
            return false;
        };
        let bulge = bulge.max(self.bulge);
        let dropped = left_out + bulge;
        if dropped > DROPPED_SHARE * leg.tolerance() {
            return false;
        }
        let merged = leg_of(programmed, Shape::Line(chord), settings, metric);
        if merged.measure != self.measure || merged.length > GREATEST_CHORD * merged.design_width {
            return false;
        }
        self.chord = self.lengthened(merged, dropped);
        self.keep(end);
        self.length += leg.length;
        self.bulge = bulge;
        true
    }

    /// A move that begins where what is waiting does, if that is next to nothing beside it. It then waits no more.
    pub fn absorb(
        &mut self,
        programmed: &ProgrammedMove,
        leg: &Leg,
        settings: &BlendSettings,
        metric: &Metric,
    ) -> Option<Leg> {
        let same_feed = programmed.feed == self.feed
            || (self.feed_word.is_some() && programmed.feed_word == self.feed_word);
        let is_short = self.length <= ABSORBED_SHARE * leg.length;
        let is_free = self.chord.is_free() && leg.is_free();
        if !is_short || !is_free || !same_feed || !self.goes_on(programmed, leg) {
            return None;
        }
        let (shape, left_out) = match &programmed.shape {
            Shape::Line(line) => {
                let end = line.end();
                let whole = Line9::new(&self.start, &end).ok()?;
                (Shape::Line(whole), self.greatest_distance(&end, metric)?)
            }
            Shape::Arc(arc) => {
                let whole = arc.from_beside(&self.start)?;
                (
                    Shape::Arc(whole),
                    self.greatest_distance_of_arc(&whole, metric)?,
                )
            }
        };
        let dropped = left_out + self.bulge;
        if dropped > DROPPED_SHARE * leg.tolerance() {
            return None;
        }
        let whole = leg_of(programmed, shape, settings, metric);
        self.waiting = false;
        Some(Leg {
            greatest_speed: whole.greatest_speed,
            ..self.lengthened(whole, dropped)
        })
    }

    /// Whether something is waiting that a move goes on with as if they were one.
    fn goes_on(&self, programmed: &ProgrammedMove, leg: &Leg) -> bool {
        let rates = leg.measure_rate / self.chord.measure_rate;
        self.waiting
            && !programmed.separate
            && !leg.stop_before
            && leg.allowance == self.allowance
            && leg.measure == self.measure
            && (1.0 / SAME_RATE..=SAME_RATE).contains(&rates)
    }

    /// What all of it is run as, where that leaves the program by so much, with what holds for where it starts.
    fn lengthened(&self, chord: Leg, dropped: f64) -> Leg {
        Leg {
            allowance: match self.allowance {
                Allowance::Exact(whole) => Allowance::Exact(whole),
                Allowance::Tolerance(whole) => Allowance::Tolerance(whole - dropped),
                Allowance::HalfLegs(whole) => Allowance::HalfLegs(whole - dropped),
            },
            first: self.chord.first,
            stop_before: self.chord.stop_before,
            near_limit: NearLimit {
                start: self.chord.near_limit.start,
                ..chord.near_limit
            },
            greatest_speed: chord.greatest_speed.min(self.chord.greatest_speed),
            ..chord
        }
    }

    fn keep(&mut self, point: Axes) {
        if let Some(place) = self.points.get_mut(self.count) {
            *place = point;
            self.count += 1;
        }
    }

    /// How far all that is waiting is at most from an arc that begins where it does; `None` if it does not all advance along it.
    ///
    /// Behind it the arc comes nearer to the one that was programmed in proportion to the angle.
    fn greatest_distance_of_arc(&self, arc: &Arc9, metric: &Metric) -> Option<f64> {
        let mut greatest = 0.0f64;
        let mut reached = 0.0;
        for point in self.points.iter().take(self.count) {
            let s = arc.beside(point);
            if !(s > reached && s < arc.length()) {
                return None;
            }
            reached = s;
            greatest = greatest.max(metric.norm(&(point - arc.position(s))));
        }
        Some(greatest + sagitta(arc, reached))
    }

    /// How far the points are from the chord to `end`; `None` if they do not all advance along it.
    fn greatest_distance(&self, end: &Axes, metric: &Metric) -> Option<f64> {
        let chord = end - self.start;
        let square = metric.product(&chord, &chord);
        let mut greatest = 0.0f64;
        let mut reached = 0.0;
        for point in self.points.iter().take(self.count) {
            let way = point - self.start;
            let share = metric.product(&way, &chord) / square;
            if !(share > reached && share < 1.0) {
                return None;
            }
            reached = share;
            greatest = greatest.max(metric.norm(&(way - chord * share)));
        }
        Some(greatest)
    }
}

/// What is run as a line.
struct Straight {
    line: Line9,
    /// How far from it its move may be, machine units.
    bulge: f64,
}

impl Straight {
    fn of(programmed: &ProgrammedMove, leg: &Leg) -> Option<Self> {
        match &programmed.shape {
            Shape::Line(line) => Some(Self {
                line: *line,
                bulge: 0.0,
            }),
            Shape::Arc(arc) if leg.is_free() => {
                let bulge = sagitta(arc, arc.length());
                let line = Line9::new(&arc.position(0.0), &arc.end()).ok()?;
                (bulge <= DROPPED_SHARE * leg.tolerance()).then_some(Self { line, bulge })
            }
            Shape::Arc(_) => None,
        }
    }
}

fn leg_of(
    programmed: &ProgrammedMove,
    shape: Shape,
    settings: &BlendSettings,
    metric: &Metric,
) -> Leg {
    Leg::new(
        &ProgrammedMove {
            shape,
            ..*programmed
        },
        settings,
        metric,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moves::TerminationCondition;
    use crate::moves::shape::Circle;

    const SETTINGS: BlendSettings = BlendSettings::DEFAULT;
    const TOLERANCE: f64 = 0.05;

    fn at(x: f64, y: f64) -> Axes {
        Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// An arc from `start` by so many radians about `center`.
    fn arc(serial: u64, start: &Axes, center: &Axes, angle: f64) -> ProgrammedMove {
        let circle = Circle {
            center: center.fixed_rows::<3>(0).into(),
            normal: [0.0, 0.0, 1.0].into(),
            revolutions: 0,
        };
        let (sine, cosine) = angle.sin_cos();
        let [x, y] = [start[0] - center[0], start[1] - center[1]];
        let end = center + at(cosine * x - sine * y, sine * x + cosine * y);
        ProgrammedMove {
            serial,
            shape: Shape::Arc(Arc9::new(start, &end, &circle).expect("an arc")),
            feed: 100.0,
            feed_word: None,
            greatest_feed: 120.0,
            termination: TerminationCondition::Continuous {
                tolerance: TOLERANCE,
            },
            stop_before: false,
            separate: false,
            may_swing_out: true,
            near_limit: NearLimit::NONE,
        }
    }

    /// An arc of .5 mm radius and this length.
    fn tiny(length: f64) -> ProgrammedMove {
        arc(1, &at(0.0, 0.0), &at(0.0, 0.5), length / 0.5)
    }

    /// A quarter of a circle behind it.
    fn quarter(before: &ProgrammedMove) -> ProgrammedMove {
        let start = before.shape.end();
        arc(2, &start, &(start + at(0.0, 3.0)), 1.5)
    }

    /// What the second of two moves is with what it absorbs of the first, which waits.
    fn absorbed(first: &ProgrammedMove, second: &ProgrammedMove) -> Option<Leg> {
        let metric = Metric::new(0.1);
        let mut merger = LineMerger::new();
        let leg = |programmed: &ProgrammedMove| Leg::new(programmed, &SETTINGS, &metric);
        assert!(merger.hold(first, &leg(first)));
        assert!(!merger.merge(second, &leg(second), &SETTINGS, &metric));
        let taken = merger.absorb(second, &leg(second), &SETTINGS, &metric);
        assert_eq!(taken.is_none(), merger.take().is_some());
        taken
    }

    #[test]
    fn a_move_of_micrometres_becomes_a_part_of_the_line_behind_it() {
        let first = tiny(0.003);
        let start = first.shape.end();
        let line = |x, y| ProgrammedMove {
            serial: 2,
            shape: Shape::Line(Line9::new(&start, &at(x, y)).expect("a line")),
            ..first
        };
        let leg = absorbed(&first, &line(5.0, 0.0)).expect("one leg");
        assert_eq!((leg.first, leg.serial), (1, 2));
        assert_eq!(leg.shape.position(0.0), first.shape.position(0.0));
        assert_eq!(leg.shape.end(), at(5.0, 0.0));
        // 9 nm aside, and the arc 4.5 um beside its chord at most.
        let dropped = TOLERANCE - leg.tolerance();
        assert!((1e-6..2e-5).contains(&dropped), "{dropped}");
        assert!(absorbed(&first, &line(-5.0, 0.0)).is_none());
    }

    #[test]
    fn a_move_of_micrometres_becomes_a_part_of_the_arc_behind_it() {
        let first = tiny(0.003);
        let leg = absorbed(&first, &quarter(&first)).expect("one leg");
        assert_eq!((leg.first, leg.serial), (1, 2));
        assert_eq!(leg.shape.position(0.0), first.shape.position(0.0));
        assert_eq!(leg.shape.end(), quarter(&first).shape.end());
        // It ends 3 um further along the arc and 9 nm beside it.
        let dropped = TOLERANCE - leg.tolerance();
        assert!((1e-6..2e-5).contains(&dropped), "{dropped}");
        assert!((leg.length - 4.5).abs() < 0.006, "{}", leg.length);
    }

    #[test]
    fn what_waits_alone_is_run_as_it_is() {
        let metric = Metric::new(0.1);
        let mut merger = LineMerger::new();
        let first = tiny(0.004);
        assert!(merger.hold(&first, &Leg::new(&first, &SETTINGS, &metric)));
        let waited = merger.take().expect("it waits");
        assert!(matches!(waited.shape, Shape::Arc(_)));
        assert_eq!(waited.tolerance(), TOLERANCE);
    }

    #[test]
    fn arcs_that_hardly_are_any_are_merged_as_lines_are() {
        let metric = Metric::new(0.1);
        let mut merger = LineMerger::new();
        let first = tiny(0.003);
        let second = arc(2, &first.shape.end(), &at(0.0, 0.5), 0.006);
        let leg = |programmed: &ProgrammedMove| Leg::new(programmed, &SETTINGS, &metric);
        assert!(merger.hold(&first, &leg(&first)));
        assert!(merger.merge(&second, &leg(&second), &SETTINGS, &metric));
        let merged = merger.take().expect("both wait");
        assert!(matches!(merged.shape, Shape::Line(_)));
        assert_eq!((merged.first, merged.serial), (1, 2));
        assert_eq!(merged.shape.end(), second.shape.end());
        // Half of the way .6 um aside, and each arc half a um beside its chord at most.
        let dropped = TOLERANCE - merged.tolerance();
        assert!((4e-6..12e-6).contains(&dropped), "{dropped}");
    }

    #[test]
    fn what_is_more_than_next_to_nothing_is_left_as_it_is() {
        let first = tiny(0.003);
        let second = quarter(&first);
        let word = FeedWord::of_tag(3000.0, crate::moves::UNITS_PER_MINUTE);
        let slower = |feed_word| ProgrammedMove {
            feed: 60.0,
            feed_word,
            ..first
        };
        let with = |change: fn(&mut ProgrammedMove)| {
            let mut changed = second;
            change(&mut changed);
            changed
        };
        // It ends 12 um aside.
        let bent = arc(1, &at(0.0, 0.0), &at(0.0, 0.1), 0.5);
        assert!(absorbed(&bent, &quarter(&bent)).is_none());
        let long = tiny(0.02);
        assert!(absorbed(&long, &quarter(&long)).is_some());
        let short = arc(2, &long.shape.end(), &at(0.0, 3.0), 0.025);
        assert!(absorbed(&long, &short).is_none());
        let circle = arc(2, &first.shape.end(), &at(0.0, 3.0), core::f64::consts::TAU);
        // Another way round is none.
        assert!(absorbed(&first, &circle).is_none_or(|leg| leg.length > 18.8));
        assert!(absorbed(&first, &with(|next| next.separate = true)).is_none());
        assert!(absorbed(&first, &with(|next| next.stop_before = true)).is_none());
        assert!(absorbed(&first, &with(|next| next.may_swing_out = false)).is_none());
        assert!(absorbed(&first, &with(|next| next.near_limit.end = true)).is_none());
        assert!(absorbed(&slower(None), &second).is_none());
        assert!(absorbed(&slower(word), &second).is_none());
        // Slower for its axes alone: F is the same.
        let same =
            with(|next| next.feed_word = FeedWord::of_tag(3000.0, crate::moves::UNITS_PER_MINUTE));
        assert!(absorbed(&slower(word), &same).is_some());
    }
}
