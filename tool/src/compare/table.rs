//! The figures as a table for people.

use super::against_optimum::{Holds, InTheTube, LeastTime};
use super::distance::Distance;
use super::figures::{Figures, State};
use super::kinematics::Peaks;
use super::subjects::Subject;
use crate::path::exceeded::exceeds;
use crate::path::rates::Quantity;
use std::fmt::Write;

const HEAD: [&str; 18] = [
    "module", "jerk", "time s", "v/V", "a/A", "jerk", "dev mm", "/tol", "miss mm", "/tol", "rests",
    "run us", "p99.9", "max", "add us", "p99.9", "max", "heap",
];

/// Behind those of the axes, where joints have limits of their own.
const JOINT_HEAD: [&str; 3] = ["joint v/V", "a/A", "jerk"];

/// Where these columns stand.
const AFTER_AXES: usize = 6;

/// What they mean.
pub(crate) const JOINT_LEGEND: &str = "\
joint       the same of a joint; where joints have limits of their own, axes keep their velocities alone
";

/// Beside the time, if the optimum was asked for.
const OPTIMUM_HEAD: [&str; 3] = ["least s", "/least", "any jerk s"];

/// Beside these, if the tube was asked for.
const TUBE_HEAD: [&str; 2] = ["tube s", "/tube"];

/// Where these columns stand.
const AFTER_TIME: usize = 3;

/// What the columns of the optimum mean.
pub(crate) const OPTIMUM_LEGEND: &str = "\
least       least time on the path as the module executed it, within the limits of velocity,
            acceleration and jerk of each axis and the feeds of the program
/least      time over it, without what the program waits; S: over the time in which the moves are
            handed over, where that is more
any jerk    least time without a limit of jerk (TOPP-RA)
";

/// What the columns of the tube mean.
pub(crate) const TUBE_LEGEND: &str = "\
tube        shortest motion that was found within the tolerance of the excerpt, whatever its path, with the same
            limits: a local optimum, no bound
/tube       time over it, as over the least time
";

/// What the columns mean, for the end of the output.
pub(crate) const LEGEND: &str = "\
v/V a/A     largest velocity and acceleration of an axis over its limit
jerk        the same for jerk; without a limit in units of the acceleration per second (..A)
dev, miss   largest distance of the executed path from the program, and of the program from the
            executed path; /tol: over the tolerance there (G64 P, and what merging took of Q)
rests       standstills in the middle that nothing explains
run, add    tpRunCycle and tpAddLine/tpAddCircle, microseconds: mean, 99.9th percentile, greatest
heap        calls of the heap in planner calls
!           a limit is exceeded by more than 1 %, a tolerance by more than 1 % and a micrometre
";

/// One program with the runs of all modules.
pub(crate) fn table(subject: &Subject, runs: &[Figures]) -> String {
    let (name, program) = (&subject.name, &subject.program);
    if let Some(reason) = &subject.no_excerpt {
        return format!("{name}: not run, {reason}\n");
    }
    let length: f64 = program
        .programmed
        .iter()
        .map(|piece| piece.segment.length)
        .sum();
    let mut text = format!("{name}: {} moves, {length:.1} mm\n", program.handed.len());
    let mut rows = vec![HEAD.map(str::to_owned).to_vec()];
    rows.extend(runs.iter().map(|run| row(run).to_vec()));
    if runs.iter().any(|run| run.motion.joints.is_some()) {
        let cells = runs.iter().map(joints);
        add_columns(&mut rows, AFTER_AXES, JOINT_HEAD, cells);
    }
    if runs.iter().any(|run| run.tube.is_some()) {
        let cells = runs.iter().map(in_the_tube);
        add_columns(&mut rows, AFTER_TIME, TUBE_HEAD, cells);
    }
    if runs.iter().any(|run| run.optimum.is_some()) {
        let cells = runs.iter().map(|run| optimum(run.optimum.as_ref()));
        add_columns(&mut rows, AFTER_TIME, OPTIMUM_HEAD, cells);
    }
    let mut widths = vec![0; rows[0].len()];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.chars().count());
        }
    }
    for (index, row) in rows.iter().enumerate() {
        let mut line = String::new();
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            // Writing to a string does not fail.
            let _ = match column {
                0 => write!(line, "  {cell:<width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        if let Some(note) = index
            .checked_sub(1)
            .and_then(|index| runs.get(index))
            .and_then(note)
        {
            line.push_str("  ");
            line.push_str(&note);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Puts columns in front of the one of this number.
fn add_columns<const N: usize>(
    rows: &mut [Vec<String>],
    at: usize,
    heads: [&str; N],
    cells: impl Iterator<Item = [String; N]>,
) {
    let heads = heads.map(str::to_owned);
    for (row, cells) in rows.iter_mut().zip(std::iter::once(heads).chain(cells)) {
        row.splice(at..at, cells);
    }
}

fn row(figures: &Figures) -> [String; HEAD.len()] {
    let jerk = if figures.takes_jerk {
        figures.jerk.to_string()
    } else {
        "-".to_owned()
    };
    if matches!(figures.state, State::NotUsable(_)) {
        let mut row = [const { String::new() }; HEAD.len()];
        row[0].clone_from(&figures.module);
        return row;
    }
    let motion = &figures.motion;
    let [velocity, acceleration, jerk_ratio] = ratios(&motion.axes);
    let [acceleration, jerk_ratio] = match motion.joints {
        None => [acceleration, jerk_ratio],
        Some(_) => ["-", "-"].map(str::to_owned),
    };
    let path_ratio = |distance: &Distance| {
        let mark = if distance.exceeds { "!" } else { "" };
        let ratio = distance.ratio.map_or("-".to_owned(), number);
        format!("{ratio}{mark}")
    };
    [
        figures.module.clone(),
        jerk,
        format!("{:.3}", motion.time),
        velocity,
        acceleration,
        jerk_ratio,
        format!("{:.4}", figures.deviation.largest),
        path_ratio(&figures.deviation),
        format!("{:.4}", figures.missed.largest),
        path_ratio(&figures.missed),
        figures.rests.count.to_string(),
        format!("{:.2}", figures.run.mean),
        format!("{:.1}", figures.run.p999),
        format!("{:.0}", figures.run.max),
        format!("{:.2}", figures.add.mean),
        format!("{:.1}", figures.add.p999),
        format!("{:.0}", figures.add.max),
        figures.heap_calls.to_string(),
    ]
}

fn joints(figures: &Figures) -> [String; JOINT_HEAD.len()] {
    match &figures.motion.joints {
        Some(peaks) if !matches!(figures.state, State::NotUsable(_)) => ratios(peaks),
        _ => [const { String::new() }; JOINT_HEAD.len()],
    }
}

/// Velocity, acceleration and jerk over their limits.
fn ratios(peaks: &Peaks) -> [String; 3] {
    let jerk = if peaks.jerk.ratio > 0.0 {
        ratio(Quantity::Jerk, peaks.jerk.ratio)
    } else {
        format!("{:.0}A", peaks.jerk_in_accelerations)
    };
    [
        ratio(Quantity::Velocity, peaks.velocity.ratio),
        ratio(Quantity::Acceleration, peaks.acceleration.ratio),
        jerk,
    ]
}

fn optimum(optimum: Option<&LeastTime>) -> [String; OPTIMUM_HEAD.len()] {
    let Some(optimum) = optimum else {
        return ["-"; OPTIMUM_HEAD.len()].map(str::to_owned);
    };
    let mark = if optimum.limited_by_supply { "S" } else { "" };
    let open = if optimum.not_solved > 0 { "?" } else { "" };
    [
        format!("{:.3}{open}", optimum.time),
        format!("{:.3}{mark}", optimum.ratio),
        format!("{:.3}", optimum.without_jerk_limit),
    ]
}

fn in_the_tube(figures: &Figures) -> [String; TUBE_HEAD.len()] {
    let tube = figures.tube.as_ref();
    let found = |value: fn(&InTheTube) -> Option<f64>| {
        let value = tube.and_then(value);
        value.map_or("-".to_owned(), |value| format!("{value:.3}"))
    };
    [found(|tube| tube.time), found(|tube| tube.ratio)]
}

fn ratio(quantity: Quantity, value: f64) -> String {
    let mark = if exceeds(quantity, value) { "!" } else { "" };
    format!("{}{mark}", number(value))
}

fn number(value: f64) -> String {
    if value < 99.95 {
        format!("{value:.3}")
    } else {
        format!("{value:.0}")
    }
}

/// What is to be said of a run that did not simply come to its end.
fn note(figures: &Figures) -> Option<String> {
    let text = match &figures.state {
        State::Complete if figures.motion.not_finite => "a position was not a number".to_owned(),
        State::Complete if figures.final_error > 1e-6 => {
            format!(
                "ends {:.6} mm off {}",
                figures.final_error, figures.first_error
            )
        }
        State::Complete if figures.errors > 0 => figures.first_error.clone(),
        State::Complete if no_tube(figures).is_some() => no_tube(figures)?.to_owned(),
        State::Complete if figures.holds.all() > 0 => holds(&figures.holds),
        State::Complete => return None,
        state => state.in_words(),
    };
    Some(text)
}

/// Why there is no least time in the tube.
fn no_tube(figures: &Figures) -> Option<&str> {
    figures.tube.as_ref()?.problem.as_deref()
}

fn holds(holds: &Holds) -> String {
    let mut text = format!("{} holds", holds.count);
    if holds.count > 0 {
        let (ratio, worst, late) = (holds.mean_ratio, holds.worst_ratio, holds.latest * 1e3);
        // Writing to a string does not fail.
        let _ = write!(
            text,
            ": rest in {ratio:.3} of the shortest stop, worst {worst:.2}, {late:.0} ms late at most"
        );
    }
    if holds.not_at_rest > 0 {
        let _ = write!(text, ", {} too short for a rest", holds.not_at_rest);
    }
    if holds.in_threads > 0 {
        let _ = write!(text, ", {} in threads", holds.in_threads);
    }
    if holds.drift > 0.0 {
        let _ = write!(text, ", drifts by {:.6} mm", holds.drift);
    }
    text
}
