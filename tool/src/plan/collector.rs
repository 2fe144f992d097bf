//! Takes in the plan, cycle by cycle, and keeps what a report shows of it: the length of the program
//! does not matter.

use super::cause::{Asked, AxisLimits, Cause, Phase, classify};
use super::deviation::{Deviation, Follower};
use super::drive::Handed;
use super::evenness::{self, Evenness};
use super::places::{Pace, Place, Places};
use super::polyline::{PathPoint, Polyline};
use super::profile::Profiles;
use super::sample::Sample;
use super::setup::Setup;
use crate::layer::program::{Feeds, MotionType, Piece};
use crate::path::Position;
use crate::path::differences::{Differences, Rates};
use framepath::axes::AXIS_COUNT;
use std::collections::VecDeque;

/// Quantities in [`Profiles`]: each axis' velocity, acceleration and jerk, then the speed, then the
/// distance from the program.
pub const CHANNELS: usize = 3 * AXIS_COUNT + 2;
/// Channel of the speed along the path.
pub const SPEED: usize = 3 * AXIS_COUNT;
/// Channel of the distance from the program.
pub const DISTANCE: usize = SPEED + 1;

/// What the drawn path may be off at first, mm.
const DRAWN_WITHIN: f64 = 2e-4;

/// And its speed, as a share of the greatest velocity of an axis.
const DRAWN_SPEED: f64 = 0.005;

/// A greatest value and its place.
#[derive(Clone, Copy, Debug, Default)]
pub struct Peak {
    /// Of the absolute value, machine units.
    pub value: f64,
    /// s.
    pub time: f64,
    /// Line of the program.
    pub line: i32,
}

impl Peak {
    fn note(&mut self, value: f64, time: f64, line: i32) {
        if value.abs() > self.value {
            *self = Peak {
                value: value.abs(),
                time,
                line,
            };
        }
    }
}

/// A cycle as it is shown.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// Since the program was started, s.
    pub time: f64,
    /// Machine units and degrees.
    pub position: Position,
    /// Number of the running move, from 1; 0 for none.
    pub id: usize,
    /// Line of the program, 0 for none.
    pub line: i32,
    /// Along the path, machine units (degrees where only rotary axes move) per second.
    pub speed: f64,
    /// What keeps the machine from being faster.
    pub cause: Cause,
}

/// What was seen of a row of axes, or of joints.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Velocity, acceleration and jerk of each, shape (9, 3).
    pub peaks: [[Peak; 3]; AXIS_COUNT],
    /// Least and greatest coordinates, machine units.
    pub low: Position,
    /// See above.
    pub high: Position,
}

impl Seen {
    fn at(start: Position) -> Self {
        Seen {
            peaks: [[Peak::default(); 3]; AXIS_COUNT],
            low: start,
            high: start,
        }
    }

    fn extend(&mut self, position: &Position) {
        for (axis, coordinate) in position.iter().enumerate() {
            self.low[axis] = self.low[axis].min(*coordinate);
            self.high[axis] = self.high[axis].max(*coordinate);
        }
    }

    fn note(&mut self, rates: &Rates, pace: &Pace) {
        for (order, values) in rates.orders.iter().enumerate() {
            for (peaks, value) in self.peaks.iter_mut().zip(values) {
                peaks[order].note(*value, pace.time, pace.line);
            }
        }
    }
}

/// What the collector has to know of a move that the planner has.
#[derive(Clone, Copy, Debug)]
struct Known {
    index: usize,
    line: i32,
    /// Whether that is a line of the program, not of a file of subroutines.
    of_program: bool,
    is_rapid: bool,
    /// What F asks for where the move cuts: a feed move of a linear axis; machine units a minute.
    cutting_feed: Option<f64>,
    asked: Asked,
}

/// Everything that is kept.
#[derive(Debug)]
pub struct Collected {
    /// Servo cycles from the first motion to the last.
    pub cycles: u64,
    /// Cycles before the first motion.
    pub before: u64,
    /// Cycles behind the last motion.
    pub after: u64,
    /// Seconds by phase.
    pub by_phase: [f64; Phase::COUNT],
    /// Seconds lost against the feed, by phase.
    pub lost_by_phase: [f64; Phase::COUNT],
    /// Seconds by cause.
    pub by_cause: [f64; Cause::COUNT],
    /// Seconds lost against the feed, by cause.
    pub lost_by_cause: [f64; Cause::COUNT],
    /// Of the axes.
    pub axes: Seen,
    /// Of joints that have limits of their own.
    pub joints: Option<Seen>,
    /// Speed along the path, of linear axes.
    pub speed: Peak,
    /// Where only rotary axes move, degrees per second.
    pub turning: Peak,
    /// Travel in X Y Z, machine units.
    pub length: f64,
    /// Distance from the program.
    pub deviation: Deviation,
    /// The worst first.
    pub places: Vec<Place>,
    /// How even the speed is in cutting.
    pub evenness: evenness::Found,
    /// Over time, see [`CHANNELS`].
    pub profiles: Profiles,
    /// For drawings.
    pub path: Vec<PathPoint>,
}

/// Takes in the plan.
pub struct Collector<'a> {
    setup: &'a Setup,
    limits: AxisLimits,
    scale: Position,
    differences: Differences,
    /// Those of joints that have limits of their own, with these.
    joints: Option<(Differences, AxisLimits)>,
    known: VecDeque<Known>,
    feeds: Feeds,
    running: Option<Known>,
    follower: Follower,
    places: Places,
    evenness: Evenness,
    polyline: Polyline,
    moved: bool,
    /// Cycles since the last motion, with what they are: they count only when motion goes on.
    standing: Vec<Pace>,
    standing_cycles: u64,
    out: Collected,
}

impl<'a> Collector<'a> {
    /// For a machine at its start.
    pub fn new(setup: &'a Setup) -> Self {
        let scale: Position = std::array::from_fn(|axis| setup.scale(axis));
        let scaled = |values: &Position| std::array::from_fn(|axis| values[axis] * scale[axis]);
        let start = scaled(&setup.surroundings.start);
        let limits = setup.bounds().each_ref().map(scaled);
        let limited = setup.joints.limited();
        let of_joints = limited.map(|joints| joints.at(&start));
        let joints = limited.zip(of_joints).map(|(joints, start)| {
            let start = Differences::new(start, setup.period);
            (start, *joints.limits())
        });
        let fastest = (0..AXIS_COUNT)
            .filter(|axis| setup.axes[*axis])
            .map(|axis| limits[0][axis])
            .fold(0.0, f64::max);
        Collector {
            setup,
            limits,
            scale,
            differences: Differences::new(start, setup.period),
            joints,
            known: VecDeque::new(),
            feeds: Feeds::BEGINNING,
            running: None,
            follower: Follower::new(setup.rotary_tolerance, setup.tool_tilt_axis),
            places: Places::default(),
            evenness: Evenness::default(),
            polyline: Polyline::new(DRAWN_WITHIN / setup.millimetres, DRAWN_SPEED * fastest),
            moved: false,
            standing: Vec::new(),
            standing_cycles: 0,
            out: Collected {
                cycles: 0,
                before: 0,
                after: 0,
                by_phase: [0.0; Phase::COUNT],
                lost_by_phase: [0.0; Phase::COUNT],
                by_cause: [0.0; Cause::COUNT],
                lost_by_cause: [0.0; Cause::COUNT],
                axes: Seen::at(start),
                joints: of_joints.map(Seen::at),
                speed: Peak::default(),
                turning: Peak::default(),
                length: 0.0,
                deviation: Deviation::default(),
                places: Vec::new(),
                evenness: evenness::Found::default(),
                profiles: Profiles::new(CHANNELS),
                path: Vec::new(),
            },
        }
    }

    /// A move that the planner was given.
    pub fn add(&mut self, handed: &Handed) {
        let [velocity, greatest_velocity] = self.feeds.of(&handed.a_move);
        self.follower.add(handed);
        self.known.push_back(Known {
            index: handed.a_move.index,
            line: handed.a_move.line,
            of_program: handed.a_move.is_of_program(),
            is_rapid: handed.a_move.motion_type == MotionType::Traverse,
            cutting_feed: is_cutting(handed).then(|| 60.0 * velocity / self.setup.millimetres),
            asked: Asked {
                velocity,
                greatest_velocity,
            },
        });
    }

    /// A servo cycle; returns how it is shown.
    pub fn note(&mut self, sample: &Sample) -> Shown {
        if let Some(index) = sample.running {
            while self.known.front().is_some_and(|known| known.index < index) {
                self.running = self.known.pop_front();
            }
            if let Some(known) = self.known.front().filter(|known| known.index == index) {
                self.running = Some(*known);
            }
        }
        let position: Position =
            std::array::from_fn(|axis| sample.position[axis] * self.scale[axis]);
        let before = *self.differences.position();
        let rates = self.differences.step(&position);
        let joints = match (&mut self.joints, self.setup.joints.limited()) {
            (Some((differences, limits)), Some(joints)) => {
                let there = joints.at(&position);
                if let Some(seen) = &mut self.out.joints {
                    seen.extend(&there);
                }
                Some((differences.step(&there), *limits))
            }
            _ => None,
        };
        let asked = self.running.map(|known| known.asked);
        let (phase, cause) = classify(
            sample,
            &rates,
            asked,
            &self.limits,
            joints.as_ref().map(|(rates, limits)| (rates, limits)),
        );
        let moves = phase != Phase::Standing;
        if moves {
            self.follower.step(&sample.position, sample.running);
            self.extend_box(&before, &position);
        }
        let line = self.running.map_or(0, |known| known.line);
        let (speed, turning) = speed(&rates);
        let pace = Pace {
            time: sample.time,
            duration: self.setup.period,
            share_of_feed: if moves {
                sample.share_of_feed.clamp(0.0, 1.0)
            } else {
                0.0
            },
            speed,
            turns: turning,
            line,
            of_program: self.running.is_none_or(|known| known.of_program),
            position,
            phase,
            cause,
        };
        self.count(&pace, &rates, moves);
        let peak = match turning {
            true => &mut self.out.turning,
            false => &mut self.out.speed,
        };
        peak.note(pace.speed, pace.time, pace.line);
        if let (Some(seen), Some((rates, _))) = (&mut self.out.joints, &joints) {
            seen.note(rates, &pace);
        }
        let feed = self.running.and_then(|known| known.cutting_feed);
        self.evenness.note(&pace, feed.filter(|_| moves));
        self.draw(&pace, &rates);
        Shown {
            time: sample.time,
            position,
            id: sample.running.map_or(0, |index| index + 1),
            line,
            speed,
            cause,
        }
    }

    fn extend_box(&mut self, before: &Position, position: &Position) {
        self.out.axes.extend(position);
        let steps = (0..3).map(|axis| position[axis] - before[axis]);
        self.out.length += steps.map(|step| step * step).sum::<f64>().sqrt();
    }

    /// Counts a cycle, standing only between motions.
    fn count(&mut self, pace: &Pace, rates: &Rates, moves: bool) {
        if !moves {
            if !self.moved {
                self.out.before += 1;
                return;
            }
            self.standing_cycles += 1;
            // A long rest is one entry for each cause.
            match self
                .standing
                .last_mut()
                .filter(|last| last.cause == pace.cause)
            {
                Some(last) => {
                    last.duration += pace.duration;
                    last.time = pace.time;
                }
                None => self.standing.push(*pace),
            }
        } else {
            self.moved = true;
            for rest in std::mem::take(&mut self.standing) {
                self.enter(&rest);
            }
            self.out.cycles += self.standing_cycles + 1;
            self.standing_cycles = 0;
            self.enter(pace);
        }
        self.out.axes.note(rates, pace);
    }

    fn enter(&mut self, pace: &Pace) {
        let lost = pace.duration * (1.0 - pace.share_of_feed);
        self.out.by_phase[pace.phase as usize] += pace.duration;
        self.out.lost_by_phase[pace.phase as usize] += lost;
        self.out.by_cause[pace.cause.index()] += pace.duration;
        self.out.lost_by_cause[pace.cause.index()] += lost;
        self.places.note(pace);
    }

    fn draw(&mut self, pace: &Pace, rates: &Rates) {
        let mut values = [0.0; CHANNELS];
        for axis in 0..AXIS_COUNT {
            for order in 0..3 {
                values[3 * axis + order] = rates.orders[order][axis] as f32;
            }
        }
        values[SPEED] = pace.speed as f32;
        values[DISTANCE] = (self.follower.found().now / self.setup.millimetres) as f32;
        self.out.profiles.note(&values);
        let [x, y, z, ..] = pace.position;
        self.polyline.note(PathPoint {
            point: [x, y, z],
            time: pace.time,
            speed: pace.speed as f32,
            // Those of other files are not in the listing.
            line: if pace.of_program { pace.line } else { 0 },
            is_rapid: self.running.is_some_and(|known| known.is_rapid),
            cause: pace.cause.index() as u8,
        });
    }

    /// Everything that was kept.
    pub fn finish(mut self) -> Collected {
        self.out.after = self.standing_cycles;
        self.out.deviation = self.follower.finish();
        self.out.places = self.places.finish();
        self.out.evenness = self.evenness.finish();
        self.out.path = self.polyline.finish();
        self.out
    }
}

/// Whether a move is run at a feed that counts lengths.
fn is_cutting(handed: &Handed) -> bool {
    let linear = |axis: &usize| !(3..6).contains(axis);
    let travels = |piece: &Piece| {
        let segment = &piece.segment;
        let mut axes = (0..AXIS_COUNT).filter(linear);
        segment.arc.is_some() || axes.any(|axis| segment.start[axis] != segment.end[axis])
    };
    let fed = matches!(
        handed.a_move.motion_type,
        MotionType::Feed | MotionType::Arc
    );
    fed && handed.pieces.iter().any(travels)
}

/// In X Y Z, else in U V W, else in A B C: the group that F counts; and whether it is the last.
fn speed(rates: &Rates) -> (f64, bool) {
    let velocity = &rates.orders[0];
    let size = |group: std::ops::Range<usize>| -> f64 {
        let square: f64 = velocity[group].iter().map(|v| v * v).sum();
        square.sqrt()
    };
    [(0..3, false), (6..9, false), (3..6, true)]
        .into_iter()
        .map(|(group, turning)| (size(group), turning))
        .find(|(speed, _)| *speed > 1e-9)
        .unwrap_or((0.0, false))
}
