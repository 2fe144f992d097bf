//! Very short lines are merged before anything else looks at them.
//!
//! Lines far shorter than any kernel cost work and say nothing. They are replaced by their chord,
//! as long as the points left out lie within a small part of the tolerance from it.

use super::leg::{Leg, ProgrammedMove};
use super::metric::Metric;
use super::settings::{Allowance, BlendSettings};
use crate::axes::Axes;
use crate::moves::NearLimit;
use crate::moves::shape::measure::Measure;
use crate::moves::shape::{Line9, Shape};

/// Points left out of a chord at most, and its end.
const POINTS: usize = 32;

/// The greatest length of a chord, in design widths.
const GREATEST_CHORD: f64 = 1.0 / 16.0;

/// The share of the tolerance that leaving points out may use.
const DROPPED_SHARE: f64 = 0.1;

/// How much the proportion of the two distances may differ between lines that are merged.
const SAME_RATE: f64 = 1.1;

/// Lines waiting for more of their kind.
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
    measure: Measure,
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
            measure: Measure::Linear,
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
        let Shape::Line(line) = &programmed.shape else {
            return false;
        };
        if leg.is_exact() || leg.stop_after || leg.length > GREATEST_CHORD * leg.design_width {
            return false;
        }
        self.waiting = true;
        self.chord = *leg;
        self.start = line.position(0.0);
        self.count = 0;
        self.keep(line.end());
        self.allowance = leg.allowance;
        self.feed = programmed.feed;
        self.measure = leg.measure;
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
        let Shape::Line(line) = &programmed.shape else {
            return false;
        };
        let rates = leg.measure_rate / self.chord.measure_rate;
        if !self.waiting
            || programmed.separate
            || leg.stop_before
            || leg.stop_after
            || leg.allowance != self.allowance
            || programmed.feed != self.feed
            || leg.measure != self.measure
            || !(1.0 / SAME_RATE..=SAME_RATE).contains(&rates)
            || self.count >= POINTS
        {
            return false;
        }
        let end = line.end();
        let Ok(chord) = Line9::new(&self.start, &end) else {
            return false;
        };
        let shape = Shape::Line(chord);
        let Some(dropped) = self.greatest_distance(&end, metric) else {
            return false;
        };
        if dropped > DROPPED_SHARE * leg.tolerance() {
            return false;
        }
        let merged = Leg::new(
            &ProgrammedMove {
                shape,
                ..*programmed
            },
            settings,
            metric,
        );
        if merged.measure != self.measure || merged.length > GREATEST_CHORD * merged.design_width {
            return false;
        }
        self.chord = self.lengthened(merged, dropped);
        self.keep(end);
        true
    }

    /// The chord of all lines, where points are left out that far from it, with what holds for where it starts.
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
