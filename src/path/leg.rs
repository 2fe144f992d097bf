//! One leg of the programmed path: a move, or several short lines merged into one.

use super::leg_check::LegCheck;
use super::linear_axes::LinearAxes;
use super::metric::Metric;
use super::nearly_linear::is_nearly_linear;
use super::settings::{Allowance, BlendSettings};
use super::shift::Shift;
use crate::axes::Axes;
use crate::moves::shape::measure::{self, Measure};
use crate::moves::shape::{Line9, PathPoint, Shape};
use crate::moves::{FeedWord, NearLimit, TerminationCondition};

/// Legs that turn by less, length of the difference of unit vectors, may be chords of a curve: 60
/// degrees.
const CHORD_JUMP: f64 = 1.0;

/// A move as the blended path takes it.
#[derive(Clone, Copy, Debug)]
pub struct ProgrammedMove {
    /// Number of the move, growing from move to move; what
    /// [`BlendedPath::progress`](super::BlendedPath::progress) reports.
    pub serial: u64,
    /// Where it goes. Starts where the move before ended.
    pub shape: Shape,
    /// What the program asks for at an override of 100 %, units of the shape's measure per
    /// second, positive. Widths are chosen for it.
    pub feed: f64,
    /// The F of the program, if it is one for a minute: `feed` is less where LinuxCNC has slowed the move down.
    pub feed_word: Option<FeedWord>,
    /// What no override may exceed, and no spindle that feed per turn follows, in the same units; at least `feed`, equal to
    /// it where neither applies.
    pub greatest_feed: f64,
    /// How it meets the next move.
    pub termination: TerminationCondition,
    /// Whether the machine has to come to rest before it: it waits for a spindle, probes, or turns
    /// a locked axis.
    pub stop_before: bool,
    /// Whether it must not be merged with the lines before it: something happens when it starts
    /// (outputs), or other overrides apply.
    pub separate: bool,
    /// Whether corners at its ends may [swing out](super::lone_corner): not on a thread, which would be off its groove far from
    /// them.
    pub may_swing_out: bool,
    /// Which of its ends are so near a soft limit that the path must not leave the program to the outer side there.
    pub near_limit: NearLimit,
}

/// A leg of the programmed path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub shape: Shape,
    /// Number of the last move that it covers.
    pub serial: u64,
    /// Number of the first move that it covers.
    pub first: u64,
    /// Where it starts, path distance.
    pub start: f64,
    /// Path distance.
    pub length: f64,
    /// How much of the whole leg lies before this part of it, path distance.
    pub lead: f64,
    /// Length of the whole leg, path distance.
    pub whole: f64,
    /// Whether it ends where the whole leg does.
    pub is_last_part: bool,
    /// How much of its move lies before and behind the whole leg, where that is a [chord](super::chords) of an arc: path distance.
    pub before: f64,
    pub after: f64,
    /// What it is moved by.
    pub shift: Shift,
    /// How much F counts for a unit of path distance.
    pub measure_rate: f64,
    /// What F counts.
    pub measure: Measure,
    /// Whether nothing but linear axes counts for much on it: see [`nearly_linear`](super::nearly_linear).
    pub is_linear: bool,
    /// How far its direction turns for a unit of path distance, radians: 0 on a line.
    pub turning: f64,
    /// Programmed speed, path distance per second.
    pub speed: f64,
    /// The speed that no override may exceed.
    pub greatest_speed: f64,
    /// How far the blended path may be from it.
    pub allowance: Allowance,
    /// What a degree of C counts of that, see [`orientation`](super::orientation).
    pub turn_share: f64,
    /// See [`BlendSettings::design_width`].
    pub design_width: f64,
    /// Whether it ends a [curve](super::curve) made of short lines.
    pub ends_curve: bool,
    pub stop_before: bool,
    pub stop_after: bool,
    /// Whether corners at its ends may [swing out](super::lone_corner).
    pub may_swing_out: bool,
    /// Which of its ends are near a soft limit.
    pub near_limit: NearLimit,
    /// What a trial of widths has found out about it.
    pub check: LegCheck,
    /// How many vertices to the left, its own start included, reach into it at most.
    pub reached_from_left: u32,
    /// How many vertices to the right, its own end included, reach into it at most.
    pub reached_from_right: u32,
}

impl Leg {
    pub const VACANT: Self = Self {
        shape: Shape::VACANT,
        serial: 0,
        first: 0,
        start: 0.0,
        length: 0.0,
        lead: 0.0,
        whole: 0.0,
        is_last_part: true,
        before: 0.0,
        after: 0.0,
        shift: Shift::NONE,
        measure_rate: 1.0,
        measure: Measure::Linear,
        is_linear: false,
        turning: 0.0,
        speed: 0.0,
        greatest_speed: 0.0,
        allowance: Allowance::Exact(0.0),
        turn_share: 1.0,
        design_width: 0.0,
        ends_curve: false,
        stop_before: false,
        stop_after: false,
        may_swing_out: false,
        near_limit: NearLimit::NONE,
        check: LegCheck::NONE,
        reached_from_left: 0,
        reached_from_right: 0,
    };

    /// The leg of a single move, not yet placed: it starts at 0.
    pub fn new(programmed: &ProgrammedMove, settings: &BlendSettings, metric: &Metric) -> Self {
        let per_measure = metric.per_measure(&programmed.shape);
        let length = programmed.shape.length() * per_measure;
        let speed = programmed.feed * per_measure;
        let measure = match &programmed.shape {
            Shape::Line(line) => {
                let displacement = line.direction() * line.length();
                measure::of(&displacement).map_or(Measure::Linear, |(measure, _)| measure)
            }
            Shape::Arc(_) => Measure::Linear,
        };
        let allowance = match programmed.termination {
            TerminationCondition::Continuous { tolerance } => settings.allowance(tolerance),
            TerminationCondition::Exact | TerminationCondition::Stop => settings.exact(),
        };
        Self {
            shape: programmed.shape,
            serial: programmed.serial,
            first: programmed.serial,
            length,
            whole: length,
            measure_rate: 1.0 / per_measure,
            measure,
            is_linear: measure == Measure::Linear
                && is_nearly_linear(&programmed.shape, per_measure, settings),
            turning: turning(&programmed.shape) / per_measure,
            speed,
            greatest_speed: programmed.greatest_feed.max(programmed.feed) * per_measure,
            allowance,
            turn_share: turn_share(&programmed.shape, &allowance, settings),
            design_width: settings.design_width(speed),
            stop_before: programmed.stop_before,
            may_swing_out: programmed.may_swing_out,
            near_limit: programmed.near_limit,
            stop_after: programmed.termination == TerminationCondition::Stop,
            ..Self::VACANT
        }
    }

    /// The part of it between two distances from its start.
    pub fn part(&self, from: f64, to: f64) -> Self {
        Self {
            lead: from,
            length: to - from,
            is_last_part: to >= self.length,
            stop_before: self.stop_before && from <= 0.0,
            stop_after: self.stop_after && to >= self.length,
            ..*self
        }
    }

    /// What it is moved by at path distance `s`, held within it.
    #[inline]
    pub fn shift_at(&self, s: f64) -> LinearAxes {
        self.shift.at(self.distance(s))
    }

    /// How far path distance `s` is from its start, held within it.
    #[inline]
    fn distance(&self, s: f64) -> f64 {
        if s < self.end() {
            (s - self.start).max(0.0)
        } else {
            self.length
        }
    }

    /// Whether it is one of several [chords](super::chords) of an arc.
    pub fn is_chord(&self) -> bool {
        self.before > 0.0 || self.after > 0.0
    }

    /// Whether it may be anywhere in its tolerance, and where along it does not matter.
    pub fn is_free(&self) -> bool {
        self.may_swing_out && self.near_limit == NearLimit::NONE && self.is_linear
    }

    /// The line, if it does not matter where along it the path is: one of linear axes for the most, and no thread, whose pitch that would change.
    fn line_in_space(&self) -> Option<&Line9> {
        match &self.shape {
            Shape::Line(line) if self.may_swing_out && self.is_linear => Some(line),
            _ => None,
        }
    }

    /// Whether there is [something to take off](Self::take_off_along).
    pub fn is_free_along(&self) -> bool {
        self.line_in_space().is_some()
    }

    /// Takes off a deviation at path distance `s` what leads along the leg, as far as the leg goes. What is left is the way to the
    /// nearest point of the line, where it does not matter [where along it](Self::is_free_along) the path is. At the ends of the whole
    /// leg all of it is left: the path comes as near to each corner of the program.
    ///
    /// The distance from a line is convex, and two places differ in it by no more than they are apart: what bounds the
    /// deviation between two places bounds this as well.
    #[inline]
    pub fn take_off_along(&self, s: f64, metric: &Metric, deviation: &mut Axes) {
        let behind = self.distance(s) + self.lead;
        let ahead = self.whole - behind;
        let is_end = behind <= 0.0 || ahead <= 0.0 || (self.is_last_part && s >= self.end());
        if !is_end && let Some(line) = self.line_in_space() {
            let direction = line.direction() * self.measure_rate;
            let along = metric
                .product(&direction, deviation)
                .min(ahead)
                .max(-behind);
            *deviation -= direction * along;
        }
    }

    /// Where it ends, path distance.
    #[inline]
    pub fn end(&self) -> f64 {
        self.start + self.length
    }

    /// Whether the blended path has to pass through its ends exactly, and nothing of other corners
    /// may reach into it.
    pub fn is_exact(&self) -> bool {
        matches!(self.allowance, Allowance::Exact(_))
    }

    /// Whether its corners may be cut by up to half of the shorter leg, without a tolerance.
    pub fn allows_half_legs(&self) -> bool {
        matches!(self.allowance, Allowance::HalfLegs(_))
    }

    /// How far the blended path may be from it, but for corners that are cut by half of a leg;
    /// machine units.
    pub fn tolerance(&self) -> f64 {
        match self.allowance {
            Allowance::Exact(tolerance)
            | Allowance::Tolerance(tolerance)
            | Allowance::HalfLegs(tolerance) => tolerance,
        }
    }

    /// How far before its end the path may still change when the next leg comes: as far as a corner
    /// with the next leg may want to reach, which swings out over all of this one, and where it may be
    /// one of the chords of a curve, two of them. `tangent_jump_size` is that of the vertex at its start.
    pub fn reserve(&self, settings: &BlendSettings, tangent_jump_size: f64) -> f64 {
        let widest = if self.allows_half_legs() {
            settings.greatest_free_width()
        } else {
            settings.greatest_design_width()
        };
        let reserve = (0.5 * self.length).min(widest);
        if self.is_exact() {
            reserve
        } else {
            let swing = if self.may_swing_out && !self.allows_half_legs() {
                settings.greatest_swing(self.length, self.tolerance(), self.speed)
            } else {
                0.0
            };
            let on_curve = tangent_jump_size < CHORD_JUMP;
            let chords = if on_curve { 2.0 * self.length } else { 0.0 };
            let chords = chords.min(settings.greatest_design_width());
            reserve.max(swing).max(self.design_width).max(chords)
        }
    }

    /// How far the machine runs on it in `seconds`, and from rest to rest besides; path distance.
    pub fn way_within(&self, seconds: f64, settings: &BlendSettings) -> f64 {
        // At half of the speed in the mean, twice.
        self.speed * (seconds + settings.time_to_speed(&self.direction_at_start(), self.speed))
    }

    /// How far a corner with another leg may be rounded into this one if half legs are allowed:
    /// half of it, on an arc not more than a radian.
    pub fn half_for_corner(&self) -> f64 {
        let curvature = self.point(self.start).second.norm();
        let half = 0.5 * self.length;
        if half * curvature > 1.0 {
            curvature.recip()
        } else {
            half
        }
    }

    /// How much F has counted at path distance `s`, held within the leg.
    pub fn measured(&self, s: f64) -> f64 {
        if self.is_last_part && s >= self.end() {
            self.shape.length()
        } else {
            ((s - self.start + self.lead) * self.measure_rate)
                .max(0.0)
                .min(self.shape.length())
        }
    }

    /// Where the program is at path distance `s`, held within the leg, moved by what [fairing](super::fairing) moves it by,
    /// with derivatives by path distance: what kernels round.
    #[inline]
    pub fn point(&self, s: f64) -> PathPoint {
        let mut point = self.programmed_point(s);
        self.shift.move_point(&mut point, self.distance(s));
        point
    }

    /// The first derivative of [that](Self::point) at its start alone.
    #[inline]
    pub fn direction_at_start(&self) -> Axes {
        let mut direction = match &self.shape {
            Shape::Line(line) => line.direction() * self.measure_rate,
            Shape::Arc(_) => self.programmed_point(self.start).first,
        };
        self.shift.turn(&mut direction);
        direction
    }

    /// The second and the third derivative of [that](Self::point) alone.
    #[inline]
    pub fn bend(&self, s: f64) -> [Axes; 2] {
        match &self.shape {
            Shape::Line(_) => [PathPoint::ZERO.second, PathPoint::ZERO.third],
            Shape::Arc(_) => {
                let PathPoint { second, third, .. } = self.programmed_point(s);
                [second, third]
            }
        }
    }

    /// The programmed path at path distance `s`, held within the leg, with derivatives by path
    /// distance.
    #[inline]
    pub fn programmed_point(&self, s: f64) -> PathPoint {
        let (at, rate) = (self.measured(s), self.measure_rate);
        let mut point = match &self.shape {
            Shape::Line(line) => {
                return PathPoint {
                    position: line.position(at),
                    first: line.direction() * rate,
                    ..PathPoint::ZERO
                };
            }
            Shape::Arc(arc) => arc.point(at),
        };
        point.first *= rate;
        point.second *= rate * rate;
        point.third *= rate * rate * rate;
        point
    }
}

/// What a degree of C counts where a P is to be kept. Half legs are cut without one, so that nothing is known of the
/// tilt there.
fn turn_share(shape: &Shape, allowance: &Allowance, settings: &BlendSettings) -> f64 {
    match (settings.orientation(), allowance) {
        (Some(orientation), Allowance::Tolerance(_)) => {
            orientation.share(&shape.position(0.0), &shape.end())
        }
        _ => 1.0,
    }
}

/// How far the direction of a shape turns where it starts for a unit of its length, radians.
///
/// Of a circle the second derivative is the radius times the square of that, the third one times its third
/// power; what moves on evenly is in neither.
fn turning(shape: &Shape) -> f64 {
    let start = shape.point(0.0);
    let (second, third) = (start.second.norm(), start.third.norm());
    if second > 0.0 { third / second } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axes::AXIS_COUNT;

    /// A line of 10 mm along X, and along this much of B.
    fn line(b: f64, may_swing_out: bool) -> Leg {
        let mut end = Axes::zeros();
        (end[0], end[4]) = (10.0, b);
        let programmed = ProgrammedMove {
            serial: 1,
            shape: Shape::Line(Line9::new(&Axes::zeros(), &end).expect("a line")),
            feed: 50.0,
            feed_word: None,
            greatest_feed: 50.0,
            termination: TerminationCondition::Continuous { tolerance: 0.1 },
            stop_before: false,
            separate: false,
            may_swing_out,
            near_limit: NearLimit::NONE,
        };
        Leg::new(&programmed, &BlendSettings::DEFAULT, &Metric::new(0.1))
    }

    /// What is left at `s` of a deviation by this much along the leg, .4 across it, and .2 degrees.
    fn left(leg: &Leg, s: f64, along: f64) -> [f64; AXIS_COUNT] {
        let mut deviation = Axes::from([along, 0.0, 0.4, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0]);
        leg.take_off_along(s, &Metric::new(0.1), &mut deviation);
        let [axes] = deviation.data.0;
        axes
    }

    fn of(along: f64) -> [f64; AXIS_COUNT] {
        [along, 0.0, 0.4, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0]
    }

    #[test]
    fn what_leads_along_a_line_is_taken_off_within_it() {
        let leg = line(0.0, true);
        for (s, along, expected) in [
            (5.0, 0.3, 0.0),
            (5.0, -0.3, 0.0),
            (0.25, -1.0, -0.75),
            (9.75, 1.0, 0.75),
            (0.25, 1.0, 0.0),
            (0.0, 0.3, 0.3),
            (10.0, -0.3, -0.3),
            (0.0, -0.3, -0.3),
            (10.0, 0.3, 0.3),
        ] {
            assert_eq!(left(&leg, s, along), of(expected), "{s} {along}");
        }
    }

    #[test]
    fn a_part_of_a_line_has_all_of_it_to_either_side() {
        let mut part = line(0.0, true).part(4.0, 6.0);
        part.start = 104.0;
        for (s, along, expected) in [
            (104.0, 0.3, 0.0),
            (106.0, 0.3, 0.0),
            (105.0, 7.0, 2.0),
            (105.0, -7.0, -2.0),
        ] {
            assert_eq!(left(&part, s, along), of(expected), "{s} {along}");
        }
    }

    #[test]
    fn on_a_thread_and_beside_other_axes_all_of_it_counts() {
        for leg in [line(0.0, false), line(100.0, true)] {
            assert!(!leg.is_free_along());
            assert_eq!(left(&leg, 5.0, 0.3), of(0.3));
        }
        assert!(line(0.0, true).is_free_along());
    }

    #[test]
    fn beside_a_little_of_a_rotary_axis_what_is_left_is_across_both() {
        let metric = Metric::new(0.1);
        let leg = line(50.0, true);
        assert!(leg.is_free_along());
        let rest = Axes::from(left(&leg, 5.0, 0.3));
        assert!(metric.product(&rest, &leg.direction_at_start()).abs() < 1e-15);
        let along = Axes::from(of(0.3)) - rest;
        let share = metric.product(&along, &leg.direction_at_start()) / metric.norm(&along);
        assert!((share.abs() - 1.0).abs() < 1e-12, "{share}");
    }
}
