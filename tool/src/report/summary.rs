//! The figures of a report: what the text, the JSON and the page all show.

use serde::Serialize;

use super::differences::{Judgement, Peak, find_peak};
use super::following::{Departure, Farthest, Following, compare};
use super::frame_changes::{FrameChange, find_frame_changes};
use super::recording::Recording;
use crate::machine::configuration::{Machine, Member, PathSource};
use crate::path::pieces::{Point, distance};
use crate::path::rates::Quantity;
use crate::program::contour::ContourMove;

/// A report. Lengths in `length_unit`, times in seconds, angles in degrees.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Headline.
    pub title: String,
    /// `[EMC]MACHINE` of the INI file.
    pub machine: String,
    /// `mm` or `in`.
    pub length_unit: &'static str,
    /// Whether X is a radius, for the reader.
    #[serde(skip)]
    pub is_lathe: bool,
    /// Seconds.
    pub servo_period: f64,
    /// Rows of the recording.
    pub rows: usize,
    /// The last digit that the recording writes, units.
    pub resolution: f64,
    /// How much was moved.
    pub moves: MoveCount,
    /// How the time was spent.
    pub time: TimeSpent,
    /// Length of the executed path of X, Y and Z.
    pub path_length: f64,
    /// The greatest speed on that path.
    pub greatest_speed: Speed,
    /// Commanded positions of the joints against `[JOINT_n]`.
    pub joints: Vec<MemberReport>,
    /// The planner's own output against `[AXIS_L]`; empty if a frame was active at any time: behind a
    /// turned frame the limits hold for the joints, and the axes of the program have none.
    pub axes: Vec<MemberReport>,
    /// Changes of the frame.
    pub frame_changes: Vec<FrameChange>,
    /// Servo cycles missing in the recording; differences across them are not taken.
    pub gaps: Vec<Place>,
    /// The executed path against the programmed path; `null` without a programmed path.
    pub path: Option<PathReport>,
    /// Everything in one word.
    pub verdict: Verdict,
    /// One sentence for each reason why the verdict is not `pass`.
    pub findings: Vec<String>,
}

/// How much was moved.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MoveCount {
    /// Moves of the programmed path; `null` without one.
    pub programmed: Option<usize>,
    /// Different motion ids above 0 in the recording.
    pub ids_seen: usize,
}

/// How the time of a recording was spent, seconds.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TimeSpent {
    /// First to last row.
    pub total: f64,
    /// Some joint moved.
    pub in_motion: f64,
    /// No joint moved.
    pub standing: f64,
}

/// A speed along the path and where it occurred.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Speed {
    /// Units per second.
    pub value: f64,
    /// Where.
    #[serde(flatten)]
    pub place: Place,
}

/// A time and the program line of that time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Seconds.
    pub time: f64,
    /// Program line as recorded.
    pub line: i64,
}

/// The peaks of a joint or an axis.
#[derive(Clone, Debug, Serialize)]
pub struct MemberReport {
    /// Name, letter, unit and limits.
    #[serde(flatten)]
    pub member: Member,
    /// Velocity, acceleration and jerk.
    pub peaks: Vec<Peak>,
    /// The worst of the three.
    pub verdict: Verdict,
}

/// What a check came to; the greater is the worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// All that can be checked is within its limits.
    Pass,
    /// Something could not be checked.
    Incomplete,
    /// Something is over its limit.
    Fail,
}

/// The greatest distance between the paths in one direction.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FarthestReport {
    /// Distance, point and move.
    #[serde(flatten)]
    pub farthest: Farthest,
    /// Where in the recording.
    #[serde(flatten)]
    pub place: Place,
    /// Line of the source program.
    pub source_line: u32,
    /// Index of the source file, 0 for the program itself.
    pub source_file: usize,
}

/// The executed path against the programmed path.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "result", rename_all = "snake_case")]
pub enum PathReport {
    /// The programmed path was followed.
    Followed {
        /// Which columns were compared.
        source: PathSource,
        /// Of the executed path from the programmed path.
        executed: FarthestReport,
        /// Of the programmed path from the executed path.
        programmed: FarthestReport,
        /// Length of the programmed path that the recording does not reach.
        not_reached: f64,
        /// From the last row to the end of the programmed path.
        final_position_error: f64,
        /// The tolerance that was asked for.
        tolerance: Option<f64>,
    },
    /// The recording goes somewhere else.
    Departed {
        /// Which columns were compared.
        source: PathSource,
        /// Where the paths part.
        place: Place,
        /// The last line of the source that was matched.
        source_line: u32,
        /// The paths are farther apart than this.
        farther_than: f64,
    },
}

/// A report with what the page draws besides.
pub struct Analysis {
    /// The figures.
    pub report: Report,
    /// The executed path in machine coordinates, shape (rows).
    pub points: Vec<Point>,
    /// The comparison row by row.
    pub following: Option<Following>,
    /// Rows across which the differences of axes and joints are not taken.
    pub breaks: Vec<usize>,
}

/// Distance in which the search for the programmed path begins, machine units. Small whatever the
/// tolerance: the smaller it is, the less can be taken for a neighbouring pass.
fn first_radius(machine: &Machine) -> f64 {
    if machine.length_unit == "in" {
        0.001
    } else {
        0.02
    }
}

/// Computes all figures.
///
/// The columns of `recording` have to be those of `machine`. An empty `contour` means that there
/// is no programmed path to compare with. `tolerance` is in machine units, above 0.
pub fn analyse(
    title: &str,
    machine: &Machine,
    recording: &Recording,
    contour: &[ContourMove],
    tolerance: Option<f64>,
) -> Analysis {
    let period = machine.servo_period;
    let frame_changes = find_frame_changes(recording);
    let mut breaks: Vec<usize> = frame_changes.iter().map(|change| change.row).collect();
    breaks.extend(&recording.gaps);
    breaks.sort_unstable();

    let joints: Vec<MemberReport> = machine
        .joints
        .iter()
        .zip(&recording.joints)
        .map(|(member, positions)| judge(recording, member, positions, &recording.gaps, period))
        .collect();
    let judged_axes = if frame_changes.is_empty() {
        machine.axes.as_slice()
    } else {
        &[]
    };
    let axes: Vec<MemberReport> = judged_axes
        .iter()
        .zip(&recording.axes)
        .map(|(member, (_, positions))| judge(recording, member, positions, &breaks, period))
        .collect();

    let points = path_points(machine, recording);
    let place = |row: usize| Place {
        time: recording.times[row],
        line: recording.lines[row],
    };
    let mut following = None;
    let path = compare(&points, contour, first_radius(machine)).map(|result| {
        let farthest = |farthest: Farthest| FarthestReport {
            farthest,
            place: place(farthest.row),
            source_line: contour[farthest.move_index].line,
            source_file: contour[farthest.move_index].file,
        };
        match result {
            Ok(found) => {
                let report = PathReport::Followed {
                    source: machine.path_source,
                    executed: farthest(found.executed),
                    programmed: farthest(found.programmed),
                    not_reached: found.not_reached,
                    final_position_error: found.final_position_error,
                    tolerance,
                };
                following = Some(found);
                report
            }
            Err(Departure {
                row,
                farther_than,
                move_index,
            }) => PathReport::Departed {
                source: machine.path_source,
                place: place(row),
                source_line: contour[move_index].line,
                farther_than,
            },
        }
    });

    let (path_length, greatest_speed) = length_and_speed(&points, recording, &breaks, period);
    let mut report = Report {
        title: title.to_owned(),
        machine: machine.name.clone(),
        length_unit: machine.length_unit,
        is_lathe: machine.is_lathe,
        servo_period: period,
        rows: recording.rows(),
        resolution: recording.resolution,
        moves: MoveCount {
            programmed: (!contour.is_empty()).then_some(contour.len()),
            ids_seen: ids_seen(&recording.ids),
        },
        time: time_spent(recording),
        path_length,
        greatest_speed,
        joints,
        axes,
        frame_changes,
        gaps: recording.gaps.iter().map(|row| place(*row)).collect(),
        path,
        verdict: Verdict::Pass,
        findings: Vec::new(),
    };
    let (verdict, findings) = super::findings::conclude(&report, machine.path_source);
    report.verdict = verdict;
    report.findings = findings;
    Analysis {
        report,
        points,
        following,
        breaks,
    }
}

fn judge(
    recording: &Recording,
    member: &Member,
    positions: &[f64],
    breaks: &[usize],
    period: f64,
) -> MemberReport {
    let peaks: Vec<Peak> = Quantity::ALL
        .into_iter()
        .map(|quantity| {
            find_peak(
                recording,
                positions,
                breaks,
                quantity,
                &member.limits,
                period,
            )
        })
        .collect();
    let verdict = peaks
        .iter()
        .map(|peak| match peak.judgement {
            Judgement::Within | Judgement::NotLimited => Verdict::Pass,
            Judgement::Unresolved => Verdict::Incomplete,
            Judgement::Over => Verdict::Fail,
        })
        .max()
        .unwrap_or(Verdict::Pass);
    MemberReport {
        member: member.clone(),
        peaks,
        verdict,
    }
}

/// The executed path of X, Y and Z in machine coordinates; 0 for a letter that is not there.
fn path_points(machine: &Machine, recording: &Recording) -> Vec<Point> {
    let column = |letter: char| match machine.path_source {
        PathSource::Joints => machine
            .joints
            .iter()
            .zip(&recording.joints)
            .find(|(joint, _)| joint.letter == letter)
            .map(|(_, positions)| positions),
        PathSource::Axes => recording
            .axes
            .iter()
            .find(|(name, _)| name.to_ascii_uppercase() == letter)
            .map(|(_, positions)| positions),
    };
    let columns = ['X', 'Y', 'Z'].map(column);
    (0..recording.rows())
        .map(|row| columns.map(|column| column.map_or(0.0, |positions| positions[row])))
        .collect()
}

fn length_and_speed(
    points: &[Point],
    recording: &Recording,
    breaks: &[usize],
    period: f64,
) -> (f64, Speed) {
    let mut length = 0.0;
    let mut greatest = (0.0, 0);
    for (row, pair) in points.windows(2).enumerate() {
        let step = distance(pair[0], pair[1]);
        length += step;
        if step > greatest.0 && breaks.binary_search(&(row + 1)).is_err() {
            greatest = (step, row);
        }
    }
    let (step, row) = greatest;
    let speed = Speed {
        value: step / period,
        place: Place {
            time: recording.times[row],
            line: recording.lines[row],
        },
    };
    (length, speed)
}

fn ids_seen(ids: &[i64]) -> usize {
    let mut changes = ids.to_vec();
    changes.dedup();
    changes.sort_unstable();
    changes.dedup();
    changes.iter().filter(|id| **id > 0).count()
}

/// A joint counts as moving in a step of more than the last written digit.
fn time_spent(recording: &Recording) -> TimeSpent {
    let moves = |row: usize| {
        recording
            .joints
            .iter()
            .any(|p| (p[row] - p[row - 1]).abs() > recording.resolution)
    };
    let times = &recording.times;
    let total = times[times.len() - 1] - times[0];
    // A sum of nothing is -0.
    let in_motion = (1..times.len())
        .filter(|row| moves(*row))
        .map(|row| times[row] - times[row - 1])
        .fold(0.0, |sum, step| sum + step);
    TimeSpent {
        total,
        in_motion,
        standing: (total - in_motion).max(0.0),
    }
}

#[cfg(test)]
pub mod tests {
    use super::super::recording::tests::recording_of;
    use super::*;
    use crate::machine::configuration::tests::{MILL, machine};
    use crate::path::pieces::tests::{arc, line};

    /// A circle of radius 10 round (10, 0) from the origin at `speed` mm/s, `error` mm too large,
    /// with 0.1 s of rest before and after.
    pub fn circle_run(speed: f64, error: f64) -> (Recording, Vec<ContourMove>) {
        let radius = 10.0 + error;
        let mut contour = vec![arc(
            3,
            [10.0, 0.0, 0.0],
            [10.0, 10.0],
            std::f64::consts::TAU,
            0.0,
        )];
        contour.push(line(4, [20.0, 0.0, 0.0], [20.0, 0.0, 0.0]));
        let turn = (std::f64::consts::TAU * radius / speed / 0.001).round();
        let points: Vec<Point> = (-100..=turn as i32 + 100)
            .map(|row| {
                let angle = f64::from(row).clamp(0.0, turn) / turn * std::f64::consts::TAU;
                [10.0 + radius * angle.cos(), radius * angle.sin(), 0.0]
            })
            .collect();
        (
            recording_of(&points, |row| if row < 100 { 2 } else { 3 }),
            contour,
        )
    }

    #[test]
    fn a_circle_has_the_figures_of_a_circle() {
        let mill = machine(MILL).expect("a machine");
        let (recording, contour) = circle_run(50.0, 0.005);
        let analysis = analyse("circle", &mill, &recording, &contour, Some(0.01));
        let report = &analysis.report;
        let circumference = std::f64::consts::TAU * 10.005;
        assert!((report.path_length - circumference).abs() < 1e-4);
        assert!((report.time.standing - 0.2).abs() < 1.5e-3);
        assert!((report.time.in_motion - circumference / 50.0).abs() < 1.5e-3);
        assert!((report.greatest_speed.value - 50.0).abs() < 0.05);
        assert_eq!(
            (report.moves.programmed, report.moves.ids_seen),
            (Some(2), 2)
        );
        let Some(PathReport::Followed {
            executed,
            programmed,
            final_position_error,
            not_reached,
            ..
        }) = &report.path
        else {
            panic!("the circle is followed: {:?}", report.path);
        };
        assert!((executed.farthest.distance - 0.005).abs() < 1e-9);
        assert!((programmed.farthest.distance - 0.005).abs() < 1e-4);
        assert!((final_position_error - 0.005).abs() < 1e-9);
        assert_eq!((*not_reached, executed.source_line), (0.0, 3));
        // v^2 / r on the circle, but the jump to full speed is far over every limit.
        assert_eq!(report.verdict, Verdict::Fail);
        assert!(report.joints[1].peaks[1].peak > 10_000.0);
    }

    #[test]
    fn what_does_not_move_is_0_s_in_motion() {
        let mill = machine(MILL).expect("a machine");
        let recording = recording_of(&[[1.0, 2.0, 3.0]; 5], |_| 1);
        let time = analyse("rest", &mill, &recording, &[], None).report.time;
        assert_eq!(time.in_motion.to_bits(), 0.0_f64.to_bits());
        assert_eq!(time.standing, time.total);
    }

    #[test]
    fn columns_of_gantries_are_chosen_by_letter() {
        let gantry = machine(&MILL.replace("coordinates=XYZ", "coordinates=YYX")).expect("valid");
        let recording = recording_of(&[[1.0, 1.0, 5.0]; 4], |_| 1);
        assert_eq!(path_points(&gantry, &recording)[0], [5.0, 1.0, 0.0]);
    }
}
