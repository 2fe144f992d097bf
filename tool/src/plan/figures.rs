//! All figures of a plan, as they are shown and written as JSON. Lengths are machine units.

use super::cause::{Cause, Phase};
use super::collector::{Collected, Peak, Seen};
use super::distances::{DeviationFigures, Measure};
use super::evenness::{CuttingTime, Found, Stretch};
use super::findings;
use super::joints;
use super::places::Place;
use super::setup::Setup;
use super::speed::{DrawnSpeed, SpeedFigure};
use crate::path::rates::Quantity;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};
use serde::Serialize;

/// A share of the time.
#[derive(Clone, Debug, Serialize)]
pub struct TimeShare {
    /// What it is.
    pub name: String,
    /// Seconds.
    pub time: f64,
    /// Seconds that would be saved at feed.
    pub lost: f64,
    /// Share of the whole time.
    pub share: f64,
    /// Number of the cause, for the colours of the page.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<usize>,
}

/// A greatest value.
#[derive(Clone, Debug, Serialize)]
pub struct PeakFigure {
    /// Of what.
    pub quantity: Quantity,
    /// The greatest value.
    pub peak: f64,
    /// What is allowed; `None`: not limited.
    pub limit: Option<f64>,
    /// Of the limit.
    pub share: Option<f64>,
    /// s.
    pub time: f64,
    /// Line of the program.
    pub line: i32,
}

/// An axis, or a joint.
#[derive(Clone, Debug, Serialize)]
pub struct AxisFigures {
    /// Its letter, or that of the axis that the joint moves; `None` where it moves several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub letter: Option<char>,
    /// `axis.x`, `joint.0`.
    pub name: String,
    /// `mm`, `in` or `deg`.
    pub unit: &'static str,
    /// Its number.
    #[serde(skip)]
    pub index: usize,
    /// Where it goes.
    pub from: f64,
    /// See above.
    pub to: f64,
    /// Velocity, acceleration, jerk.
    pub peaks: Vec<PeakFigure>,
}

/// The spindle under constant surface speed (G96), while the machine moves.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SurfaceFigures {
    /// Turns a minute.
    pub least: f64,
    /// See above.
    pub greatest: f64,
}

impl From<[f64; 2]> for SurfaceFigures {
    fn from([least, greatest]: [f64; 2]) -> Self {
        SurfaceFigures { least, greatest }
    }
}

/// A slow place.
#[derive(Clone, Debug, Serialize)]
pub struct PlaceFigure {
    /// Line where the machine is slowest.
    pub line: i32,
    /// Lines from, to.
    pub lines: [i32; 2],
    /// Text of the line, empty if it is not known.
    pub text: String,
    /// Whether lines are those of the program, not of a file of subroutines.
    pub of_program: bool,
    /// s.
    pub time: f64,
    /// s.
    pub duration: f64,
    /// Seconds that would be saved at feed.
    pub lost: f64,
    /// The least speed, in its unit per second.
    pub least_speed: f64,
    /// `mm` or `in`; `deg` where only rotary axes move.
    pub speed_unit: &'static str,
    /// The same over the feed.
    pub least_share: f64,
    /// X Y Z.
    pub position: [f64; 3],
    /// What the machine does there.
    pub phase: &'static str,
    /// What keeps it from being faster.
    pub cause: String,
}

/// Time of cutting near the feed.
#[derive(Clone, Debug, Serialize)]
pub struct NearFigure {
    /// Of cutting, s.
    pub time: f64,
    /// Within 5 % of the feed, s.
    pub near: f64,
    /// The same over the time of cutting; `None`: nothing is cut.
    pub share: Option<f64>,
}

/// The same for one feed.
#[derive(Clone, Debug, Serialize)]
pub struct FeedFigure {
    /// F within what the axes allow, machine units a minute.
    pub feed: f64,
    /// Its cutting.
    #[serde(flatten)]
    pub cutting: NearFigure,
}

/// A stretch of cutting below the feed.
#[derive(Clone, Debug, Serialize)]
pub struct BelowFigure {
    /// Line where it is slowest.
    pub line: i32,
    /// Lines from, to.
    pub lines: [i32; 2],
    /// Text of the line, empty if it is not known.
    pub text: String,
    /// Whether lines are those of the program, not of a file of subroutines.
    pub of_program: bool,
    /// When it is slowest, s.
    pub time: f64,
    /// s.
    pub duration: f64,
    /// The least speed over the feed.
    pub least_share: f64,
    /// What keeps it below.
    pub cause: String,
}

/// How even the speed is in cutting.
#[derive(Clone, Debug, Serialize)]
pub struct EvennessFigures {
    /// All feeds together.
    pub total: NearFigure,
    /// The one that takes most time first.
    pub feeds: Vec<FeedFigure>,
    /// The longest first.
    pub below: Vec<BelowFigure>,
}

/// All figures of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// Name of the program.
    pub program: String,
    /// Name of the machine.
    pub machine: String,
    /// Where the limits come from.
    pub limits_from: String,
    /// What is planned of the limits of joints, where these have some.
    pub limits_of_joints: Option<String>,
    /// `mm` or `in`.
    pub length_unit: &'static str,
    /// Whether X is a radius, for the reader.
    #[serde(skip)]
    pub is_lathe: bool,
    /// s.
    pub servo_period: f64,
    /// From the first motion to the last, s.
    pub time: f64,
    /// The same in servo cycles.
    pub cycles: u64,
    /// Standing before the first motion, s.
    pub before: f64,
    /// Standing behind the last motion, s.
    pub after: f64,
    /// Moves handed to the planner.
    pub moves: usize,
    /// When they were handed over.
    pub handed_over: &'static str,
    /// Travel in X Y Z.
    pub path_length: f64,
    /// Along the path.
    pub greatest_speed: SpeedFigure,
    /// For drawings.
    #[serde(skip)]
    pub drawn_speed: DrawnSpeed,
    /// The spindle under constant surface speed; `None`: there is none. Put in by the caller.
    pub surface_speed: Option<SurfaceFigures>,
    /// Where the time goes.
    pub phases: Vec<TimeShare>,
    /// What limits the machine.
    pub limited_by: Vec<TimeShare>,
    /// The worst first.
    pub slowest: Vec<PlaceFigure>,
    /// Speed in cutting.
    pub evenness: EvennessFigures,
    /// Distance from the program.
    pub deviation: DeviationFigures,
    /// Axes that move.
    pub axes: Vec<AxisFigures>,
    /// Joints that move, where they have limits of their own.
    pub joints: Vec<AxisFigures>,
    /// A sentence for each limit and tolerance that the plan does not keep.
    pub findings: Vec<String>,
}

impl Figures {
    /// Shows what was collected. So many moves were handed to the planner, when the text says; the text
    /// of the slowest lines is put in by the caller.
    pub fn new(
        program: &str,
        setup: &Setup,
        (moves, handed_over): (usize, &'static str),
        collected: &Collected,
    ) -> Figures {
        let time = collected.cycles as f64 * setup.period;
        let share = |part: f64| if time > 0.0 { part / time } else { 0.0 };
        let phases = Phase::ALL.map(|phase| TimeShare {
            name: phase.name().to_owned(),
            time: collected.by_phase[phase as usize],
            lost: collected.lost_by_phase[phase as usize],
            share: share(collected.by_phase[phase as usize]),
            cause: None,
        });
        let mut limited_by: Vec<TimeShare> = (0..Cause::COUNT)
            .filter(|index| collected.by_cause[*index] > 0.0)
            .map(|index| TimeShare {
                name: Cause::at(index).name(),
                time: collected.by_cause[index],
                lost: collected.lost_by_cause[index],
                share: share(collected.by_cause[index]),
                cause: Some(index),
            })
            .collect();
        limited_by.sort_by(|a, b| b.time.total_cmp(&a.time));
        let (axes, joints) = (axes(setup, collected), joints(setup, collected));
        let speed = SpeedFigure::new(setup, collected);
        let places = collected.places.iter();
        let measure = Measure::new(setup, &speed);
        let deviation = DeviationFigures::new(measure, &collected.deviation);
        let beyond = collected.deviation.beyond.as_ref();
        let beyond = beyond.map(|farthest| measure.figure(farthest));
        let movers = axes.iter().chain(&joints);
        let mut findings =
            findings::conclude(movers, beyond, collected.deviation.turns, measure.unit);
        findings.extend(findings::of_joints(&axes, &setup.above_joints));
        Figures {
            findings,
            program: program.to_owned(),
            machine: setup.machine.clone(),
            limits_from: setup.origin.clone(),
            limits_of_joints: joints::told(&setup.joints),
            length_unit: setup.unit,
            is_lathe: setup.is_lathe,
            servo_period: setup.period,
            time,
            cycles: collected.cycles,
            before: collected.before as f64 * setup.period,
            after: collected.after as f64 * setup.period,
            moves,
            handed_over,
            path_length: collected.length,
            greatest_speed: speed,
            drawn_speed: DrawnSpeed::new(setup, collected),
            surface_speed: None,
            phases: phases.into(),
            limited_by,
            slowest: places
                .map(|place| place_figure(place, speed.unit))
                .collect(),
            evenness: evenness_figures(&collected.evenness),
            deviation,
            axes,
            joints,
        }
    }
}

fn near_figure(cutting: &CuttingTime) -> NearFigure {
    NearFigure {
        time: cutting.all,
        near: cutting.near,
        share: (cutting.all > 0.0).then(|| cutting.near / cutting.all),
    }
}

fn below_figure(stretch: &Stretch) -> BelowFigure {
    BelowFigure {
        line: stretch.line,
        lines: [stretch.first_line, stretch.last_line],
        text: String::new(),
        of_program: stretch.of_program,
        time: stretch.time,
        duration: stretch.duration,
        least_share: stretch.least_share,
        cause: stretch.cause.name(),
    }
}

fn evenness_figures(found: &Found) -> EvennessFigures {
    let feeds = found.by_feed.iter();
    EvennessFigures {
        total: near_figure(&found.total),
        feeds: feeds
            .map(|(feed, cutting)| FeedFigure {
                feed: *feed,
                cutting: near_figure(cutting),
            })
            .collect(),
        below: found.stretches.iter().map(below_figure).collect(),
    }
}

/// `unit` is that of the greatest speed of the program.
fn place_figure(place: &Place, unit: &'static str) -> PlaceFigure {
    let [x, y, z, ..] = place.position;
    PlaceFigure {
        line: place.line,
        lines: [place.first_line, place.last_line],
        text: String::new(),
        of_program: place.of_program,
        time: place.time,
        duration: place.duration,
        lost: place.lost,
        least_speed: place.least_speed,
        speed_unit: if place.turns { "deg" } else { unit },
        least_share: place.least_share,
        position: [x, y, z],
        phase: place.phase.name(),
        cause: place.cause.name(),
    }
}

/// Travel below this is none, machine units or degrees.
const NO_TRAVEL: f64 = 1e-9;

fn axes(setup: &Setup, collected: &Collected) -> Vec<AxisFigures> {
    let limits = setup.bounds();
    let seen = &collected.axes;
    let of_axis = |axis: usize| {
        let name = format!("axis.{}", AXIS_LETTERS[axis].to_ascii_lowercase());
        let limits = limits.map(|limits| limits[axis] * setup.scale(axis));
        let unit = setup.unit_of(axis);
        mover(seen, (axis, Some(axis)), name, unit, limits)
    };
    (0..AXIS_COUNT)
        .filter(|axis| travels(seen, *axis))
        .map(of_axis)
        .collect()
}

/// Joints that have limits of their own, and move.
fn joints(setup: &Setup, collected: &Collected) -> Vec<AxisFigures> {
    let (Some(joints), Some(seen)) = (setup.joints.limited(), &collected.joints) else {
        return Vec::new();
    };
    let of_joint = |joint: usize| {
        let limits = joints.limits().map(|limits| limits[joint]);
        let unit = if joints.is_rotary(joint) {
            "deg"
        } else {
            setup.unit
        };
        let (axis, name) = (joints.axis(joint), format!("joint.{joint}"));
        mover(seen, (joint, axis), name, unit, limits)
    };
    (0..joints.count().min(AXIS_COUNT))
        .filter(|joint| travels(seen, *joint))
        .map(of_joint)
        .collect()
}

/// What was seen of an axis, or of a joint: `index` is its own, beside the axis that it moves.
fn mover(
    seen: &Seen,
    (index, axis): (usize, Option<usize>),
    name: String,
    unit: &'static str,
    limits: [f64; 3],
) -> AxisFigures {
    AxisFigures {
        letter: axis.map(|axis| AXIS_LETTERS[axis]),
        name,
        unit,
        index,
        from: seen.low[index],
        to: seen.high[index],
        peaks: peaks(&seen.peaks[index], limits),
    }
}

fn travels(seen: &Seen, axis: usize) -> bool {
    seen.high[axis] - seen.low[axis] > NO_TRAVEL
}

/// Velocity, acceleration and jerk against their limits, infinite where there is none.
fn peaks(found: &[Peak; 3], limits: [f64; 3]) -> Vec<PeakFigure> {
    let of_quantity = |((quantity, peak), limit): ((Quantity, &Peak), f64)| {
        let limit = limit.is_finite().then_some(limit);
        PeakFigure {
            quantity,
            peak: peak.value,
            limit,
            share: limit.map(|limit| peak.value / limit),
            time: peak.time,
            line: peak.line,
        }
    };
    let found = Quantity::ALL.into_iter().zip(found);
    found.zip(limits).map(of_quantity).collect()
}
