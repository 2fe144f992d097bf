//! One servo period of the reference, put together from stretches of segments.

use super::bulge::Bulge;
use super::reference_segment::{ReferenceSegment, SegmentMotion};
use crate::axes::{AXIS_COUNT, Axes};
use crate::cycle::{Cell, FeedPerTurn};
use crate::lanes::{greater, lesser};
use crate::machine_map::MachineMap;
use crate::moves::shape::PathPoint;
use crate::moves::{Move, MoveQueue};
use crate::path::BlendedPath;
use crate::speed::ProfileState;

/// A profile has seven phases at most, so a stretch is cut at most this often.
const MOST_PHASES: usize = 8;

/// How far before its end a stretch is looked at, share of its half.
const BESIDE: f64 = 1e-6;

/// A cell that is being filled.
#[derive(Debug)]
pub(super) struct CellBuilder {
    cell: Option<Cell>,
    /// Where the stretch before ended, as it was seen there.
    end: Option<StretchEnd>,
    /// Path velocity at its start, in path distance.
    start_velocity: f64,
    filled: f64,
}

/// The end of a stretch where the path goes on as smooth as it came: the next stretch begins with it.
#[derive(Clone, Copy, Debug)]
struct StretchEnd {
    /// Path distance.
    s: f64,
    /// By how much another place may be off that is the same but for rounding.
    beside: f64,
    /// Where the leg starts that it lies on.
    leg_start: f64,
    place: Place,
}

/// A place of the path.
#[derive(Clone, Copy, Debug)]
struct Place {
    point: PathPoint,
    /// Three derivatives of the joints by the path, where these have limits.
    joints: Option<[Axes; 3]>,
}

impl Place {
    fn of(point: &PathPoint, map: &MachineMap) -> Self {
        let by_path = [&point.first, &point.second, &point.third];
        let joints = map.joints();
        let joints = joints.map(|_| map.derivatives(&point.position, by_path));
        Self {
            point: *point,
            joints,
        }
    }
}

/// What lies under a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'a> {
    pub path: &'a BlendedPath,
    pub queue: &'a MoveQueue,
    pub map: &'a MachineMap,
    /// What the run multiplies the speeds of the program by, 1 and above.
    pub raise: f64,
}

impl CellBuilder {
    pub const fn new() -> Self {
        Self {
            cell: None,
            end: None,
            start_velocity: 0.0,
            filled: 0.0,
        }
    }

    pub fn clear(&mut self) {
        *self = Self::new();
    }

    /// Seconds of the cell that have been added.
    pub fn filled(&self) -> f64 {
        self.filled
    }

    /// Hands the cell out, `None` if nothing has been added, and begins the next one.
    pub fn take(&mut self) -> Option<Cell> {
        self.filled = 0.0;
        self.cell.take()
    }

    /// Adds the time from `from` to `to` of a segment, as the axes of the machine, or its joints, see it.
    pub fn add(&mut self, segment: &ReferenceSegment, ground: &Ground, from: f64, to: f64) {
        let mut start = from;
        for _ in 0..MOST_PHASES {
            let end = segment.next_jump(start).min(to);
            self.add_phase(segment, ground, start, end);
            start = end;
            if start >= to {
                break;
            }
        }
        self.filled += to - from;
    }

    /// Adds a stretch without jumps of acceleration or jerk.
    fn add_phase(&mut self, segment: &ReferenceSegment, ground: &Ground, from: f64, to: f64) {
        let middle = 0.5 * (from + to);
        let [start, inside, end] = [from, middle, to].map(|t| segment.state(t, middle));
        let seen = |along: &ProfileState, place: &Place| {
            MotionDerivatives::of(ground.path, place, along).behind(ground.map)
        };
        let first = seen(&start, &self.start_place(segment, ground, start.distance));
        let back = BESIDE * (inside.distance - start.distance);
        let last_place = self.end_place(segment, ground, end.distance, back);
        let last = seen(&end, &last_place);
        // What bends is asked for where it has to be alone.
        let by_ends = if self.is_smooth_from(start.distance) {
            let accelerations = [&first.acceleration, &last.acceleration];
            Bulge::between(accelerations, [&first.jerk, &last.jerk], to - from)
        } else {
            None
        };
        let bulge = by_ends.unwrap_or_else(|| {
            let point = segment.point(ground.path, inside.distance);
            let second = seen(&inside, &Place::of(&point, ground.map));
            let accelerations = [
                &first.acceleration,
                &second.acceleration,
                &last.acceleration,
            ];
            Bulge::through(accelerations, [&first.jerk, &second.jerk, &last.jerk])
        });
        let start_velocity = &mut self.start_velocity;
        let cell = self.cell.get_or_insert_with(|| {
            *start_velocity = first.along.velocity;
            first.cell(segment, ground, inside.distance)
        });
        for end in [&first, &last] {
            widen(cell, end, &bulge);
            // Where a rounded corner ends, the path velocity falls as the slope rises: the greatest
            // slope times the velocity before would be a feed that there never is.
            let share = if end.along.velocity < *start_velocity {
                end.along.velocity / *start_velocity
            } else {
                1.0
            };
            cell.feed_ratio = cell.feed_ratio.max(end.slope * share);
        }
    }

    /// The path where a stretch begins.
    fn start_place(&mut self, segment: &ReferenceSegment, ground: &Ground, distance: f64) -> Place {
        match self.end.take() {
            Some(end) if segment.is_run() && (distance - end.s).abs() <= end.beside => end.place,
            _ => Place::of(&segment.point(ground.path, distance), ground.map),
        }
    }

    /// The path where a stretch ends. Where it ends with a leg, the third derivative of the path may jump: it is looked
    /// at `back` before.
    fn end_place(
        &mut self,
        segment: &ReferenceSegment,
        ground: &Ground,
        distance: f64,
        back: f64,
    ) -> Place {
        let leg = ground.path.leg(distance).filter(|leg| {
            let is_inside = leg.start < distance - back && distance + back < leg.end;
            segment.is_run() && is_inside
        });
        let Some(leg) = leg else {
            return Place::of(&segment.point(ground.path, distance - back), ground.map);
        };
        let place = Place::of(&segment.point(ground.path, distance), ground.map);
        self.end = Some(StretchEnd {
            s: distance,
            beside: back,
            leg_start: leg.start,
            place,
        });
        place
    }

    /// Whether the stretch that ended last has no place where the third derivative of the path may jump, if it began
    /// at this distance.
    fn is_smooth_from(&self, distance: f64) -> bool {
        let end = self.end.as_ref();
        end.is_some_and(|end| end.leg_start <= distance + end.beside)
    }
}

/// Makes the bounds of a cell hold for the motion at an end of a stretch, give or take its bulge.
fn widen(cell: &mut Cell, end: &MotionDerivatives, bulge: &Bulge) {
    for axis in 0..AXIS_COUNT {
        let [value, margin] = [end.acceleration[axis], bulge.acceleration[axis]];
        cell.acceleration_min[axis] = lesser(cell.acceleration_min[axis], value - margin);
        cell.acceleration_max[axis] = greater(cell.acceleration_max[axis], value + margin);
        let [value, margin] = [end.jerk[axis], bulge.jerk[axis]];
        cell.jerk_min[axis] = lesser(cell.jerk_min[axis], value - margin);
        cell.jerk_max[axis] = greater(cell.jerk_max[axis], value + margin);
    }
}

/// Derivatives of a reference by its time.
struct MotionDerivatives {
    velocity: Axes,
    acceleration: Axes,
    jerk: Axes,
    along: ProfileState,
    /// Length of dq/ds: less than 1 where a corner is rounded.
    slope: f64,
}

impl MotionDerivatives {
    /// Where the path has this `place` and the motion along it this state: of the joints where these have limits, else of
    /// the program.
    fn of(path: &BlendedPath, place: &Place, along: &ProfileState) -> Self {
        let point = &place.point;
        let [first, second, third] = match &place.joints {
            Some(joints) => joints.each_ref(),
            None => [&point.first, &point.second, &point.third],
        };
        let (v, a, j) = (along.velocity, along.acceleration, along.jerk);
        Self {
            velocity: first * v,
            acceleration: first * a + second * (v * v),
            jerk: first * j + second * (3.0 * v * a) + third * (v * v * v),
            slope: path.distance(&point.first),
            along: *along,
        }
    }

    /// The same for what the limits hold for: the axes of the machine instead of those of the program.
    fn behind(self, map: &MachineMap) -> Self {
        if map.joints().is_some() {
            return self;
        }
        Self {
            velocity: map.apply(&self.velocity),
            acceleration: map.apply(&self.acceleration),
            jerk: map.apply(&self.jerk),
            ..self
        }
    }

    /// A cell that starts here; the distance `inside` lies in its first stretch.
    fn cell(&self, segment: &ReferenceSegment, ground: &Ground, inside: f64) -> Cell {
        // In the first stretch, since at its start the move before may end.
        let leg = ground.path.leg(segment.path_distance(inside));
        let rate = leg.map_or(1.0, |leg| leg.measure_rate);
        let serial = match &segment.motion {
            SegmentMotion::Move(motion) => Some(motion.serial),
            _ => leg.map(|leg| leg.serial),
        };
        let queued = serial.and_then(|serial| ground.queue.get(serial));
        Cell {
            velocity: self.velocity,
            acceleration: self.acceleration,
            acceleration_min: self.acceleration,
            acceleration_max: self.acceleration,
            jerk_min: self.jerk,
            jerk_max: self.jerk,
            path_velocity: rate * self.along.velocity,
            path_acceleration: rate * self.along.acceleration,
            feed_ratio: self.slope,
            programmed_feed: queued.map_or(f64::INFINITY, |queued| {
                queued
                    .synchronisation
                    .map_or(queued.feed, |with| with.per_turn)
            }),
            feed_per_turn: queued.and_then(|queued| feed_per_turn(queued, segment, ground.raise)),
            rapid: queued.is_some_and(|queued| queued.motion_type.is_rapid()),
            override_enabled: queued.is_some_and(|queued| queued.override_enabled()),
        }
    }
}

/// What a move with feed per turn, or a thread, counts with, in a segment of a run that multiplies the speeds of the program
/// by `raise`.
fn feed_per_turn(queued: &Move, segment: &ReferenceSegment, raise: f64) -> Option<FeedPerTurn> {
    let with = queued.synchronisation?;
    let planned = match &segment.motion {
        SegmentMotion::Move(motion) => queued.feed.max(motion.cap),
        _ => queued.feed * raise,
    };
    Some(FeedPerTurn {
        spindle: with.spindle,
        planned_turns: planned.min(queued.max_velocity) / with.per_turn,
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use proptest::prelude::*;

    use super::super::reference_segment::ProfiledMotion;
    use super::*;
    use crate::moves::shape::{Arc9, Circle, Shape};
    use crate::moves::{NearLimit, TerminationCondition};
    use crate::path::{BlendSettings, ProgrammedMove};
    use crate::speed::{JerkLimitedProfile, PathLimits};
    use crate::test_room::with_room;

    /// The path of a circle from rest to rest, on the heap since it is larger than a stack.
    fn with_circle<R: Send>(radius: f64, test: impl FnOnce(&BlendedPath, &Shape) -> R + Send) -> R {
        let run = || {
            let mut start = Axes::zeros();
            start[0] = radius;
            let mut end = start;
            end[5] = 7.0;
            let circle = Circle {
                center: Vector3::zeros(),
                normal: Vector3::new(0.1, 0.2, 1.0),
                revolutions: 1,
            };
            let shape = Shape::Arc(Arc9::new(&start, &end, &circle).expect("an arc"));
            let mut path = BlendedPath::new();
            path.restart(&BlendSettings::DEFAULT, &start);
            path.add(&ProgrammedMove {
                serial: 0,
                shape,
                feed: 1.0,
                feed_word: None,
                greatest_feed: 1.0,
                termination: TerminationCondition::Stop,
                stop_before: false,
                separate: false,
                may_swing_out: true,
                near_limit: NearLimit::NONE,
            })
            .expect("room");
            path.step(1000);
            assert!(path.final_end() > 0.0);
            test(&path, &shape)
        };
        with_room(run)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The executor trusts the bounds: nothing inside a cell may be beyond them.
        #[test]
        fn bounds_hold_everywhere_in_the_cell(
            (radius, feed) in ((-4.0..4.0f64).prop_map(f64::exp), (0.0..5.0f64).prop_map(f64::exp)),
            (from, share, inside) in (0.0..1.0f64, 0.0..1.0f64, 0.0..=1.0f64),
        ) {
            // What one axis with 1000 mm/s2 and 20000 mm/s3 allows on this circle.
            let velocity = feed.min((500.0 * radius).sqrt()).min((10_000.0 * radius * radius).cbrt());
            let limits = PathLimits { velocity, acceleration: 500.0, jerk: 10_000.0 };
            with_circle(radius, |path, shape| {
                let profile = JerkLimitedProfile::rest_to_rest(shape.length(), &limits);
                let duration = profile.duration();
                let end = path.final_end();
                let motion = ProfiledMotion { serial: 0, start: 0.0, end, rate: end / shape.length(), profile, cap: feed };
                let segment = ReferenceSegment { motion: SegmentMotion::Move(motion), duration };
                let begin = from * duration;
                let finish = (begin + 1e-3 * share.max(0.01)).min(duration);
                let mut builder = CellBuilder::new();
                let queue = MoveQueue::new();
                builder.add(&segment, &Ground { path, queue: &queue, map: &MachineMap::IDENTITY, raise: 1.0 }, begin, finish);
                prop_assert!((builder.filled() - (finish - begin)).abs() < 1e-15);
                let cell = builder.take().expect("a cell");
                let t = begin + inside * (finish - begin);
                let along = segment.state(t, t);
                let place = Place::of(&segment.point(path, along.distance), &MachineMap::IDENTITY);
                let here = MotionDerivatives::of(path, &place, &along);
                for axis in 0..9 {
                    // A parabola stands for the curve: a thousandth of the limits is left to it.
                    let (a, j) = (here.acceleration[axis], here.jerk[axis]);
                    prop_assert!(a >= cell.acceleration_min[axis] - 1.0 && a <= cell.acceleration_max[axis] + 1.0);
                    prop_assert!(j >= cell.jerk_min[axis] - 20.0 && j <= cell.jerk_max[axis] + 20.0);
                }
                Ok(())
            })?;
        }
    }
}
