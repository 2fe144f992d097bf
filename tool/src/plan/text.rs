//! The plan as text for a terminal: plain ASCII, aligned.

use super::distances::DistanceFigure;
use super::figures::{AxisFigures, Figures, PlaceFigure, SurfaceFigures};
use crate::format::{
    duration, fixed, greatest_speed, grouped, in_column, length, percent, significant, unit,
};
use crate::path::rates::Quantity;
use std::fmt::{self, Write};

/// Places that the text lists; all are in the JSON.
const LISTED_PLACES: usize = 10;

/// Width of the column of labels.
const LABEL: usize = 22;

/// What is programmed as a diameter is half of that in all figures.
const X_OF_LATHES: &str = "a radius in all figures, behind G7 too";

/// Characters of a program line that are shown.
const LINE_WIDTH: usize = 40;

/// All figures, ending in a line feed.
///
/// # Errors
/// Those of the writer; a `String` has none.
pub fn render(figures: &Figures) -> Result<String, fmt::Error> {
    let mut text = String::new();
    let out = &mut text;
    writeln!(out, "{}", figures.program)?;
    writeln!(out, "{}\n", "=".repeat(figures.program.chars().count()))?;
    heading(out, figures)?;
    times(out, figures)?;
    places(out, figures)?;
    evenness(out, figures)?;
    peaks(out, "axes", &figures.axes, |axis| {
        axis.letter.map_or(axis.name.clone(), String::from)
    })?;
    if !figures.joints.is_empty() {
        peaks(out, "joints", &figures.joints, |joint| {
            joint.index.to_string()
        })?;
    }
    for (index, finding) in figures.findings.iter().enumerate() {
        let label = if index == 0 { "\nNot kept\n" } else { "" };
        writeln!(out, "{label}  {finding}")?;
    }
    Ok(text)
}

/// A spindle cannot be as fast as G96 without D asks for near its middle, turns a minute.
const NO_SPINDLE: f64 = 1e5;

/// What the plan does not count is said, too.
fn surface_speed(speeds: &SurfaceFigures) -> String {
    let least = significant(speeds.least, 4);
    if speeds.greatest > NO_SPINDLE {
        return format!(
            "from {least} turns a minute on without an end: G96 has no D, the greatest speed of the spindle; give it one"
        );
    }
    let greatest = significant(speeds.greatest, 4);
    format!(
        "{least} to {greatest} turns a minute, each at once: the time in which a spindle changes its speed is not counted"
    )
}

fn heading(out: &mut String, figures: &Figures) -> fmt::Result {
    let u = figures.length_unit;
    let mut entry = |label: &str, value: String| writeln!(out, "{label:LABEL$}{value}");
    entry(
        "Time",
        format!(
            "{:.3} s{}, {} servo cycles of {} ms",
            figures.time,
            if figures.time < 60.0 {
                String::new()
            } else {
                format!(" ({})", duration(figures.time))
            },
            grouped(figures.cycles as usize),
            significant(figures.servo_period * 1e3, 6)
        ),
    )?;
    // A few cycles pass in any case until the first move is planned.
    for (label, time) in [
        ("Standing before", figures.before),
        ("Standing after", figures.after),
    ] {
        if time > 20.0 * figures.servo_period {
            entry(label, duration(time))?;
        }
    }
    if !figures.machine.is_empty() {
        entry("Machine", figures.machine.clone())?;
    }
    entry("Limits", figures.limits_from.clone())?;
    if let Some(joints) = &figures.limits_of_joints {
        entry("Limits of joints", joints.clone())?;
    }
    entry(
        "Moves",
        format!(
            "{}, handed over {}",
            grouped(figures.moves),
            figures.handed_over
        ),
    )?;
    if figures.is_lathe {
        entry("X", X_OF_LATHES.to_owned())?;
    }
    let long = significant(figures.path_length, 7);
    entry("Path length", format!("{long} {u}"))?;
    let speed = figures.greatest_speed;
    entry(
        "Greatest speed",
        greatest_speed(speed.value, speed.unit, speed.time, speed.line.into()),
    )?;
    if let Some(speeds) = &figures.surface_speed {
        entry("Spindle with G96", surface_speed(speeds))?;
    }
    let measure = figures.deviation.unit;
    let far = |figure: &DistanceFigure| {
        let tolerance = match figure.tolerance {
            Some(0.0) => "exact mode".to_owned(),
            Some(tolerance) => format!(
                "{:.0} % of the tolerance {}",
                100.0 * figure.distance / tolerance,
                length(tolerance, measure)
            ),
            None => match figure.advice(u, measure) {
                Some(advice) => format!("G64 without P: {advice}"),
                None => "G64 without P".to_owned(),
            },
        };
        format!(
            "{}, line {} ({tolerance})",
            length(figure.distance, measure),
            figure.line
        )
    };
    let deviation = &figures.deviation;
    entry(
        "Off the program",
        format!("at most {}", far(&deviation.planned)),
    )?;
    entry(
        "Programmed points",
        format!("passed at {}", far(&deviation.programmed)),
    )?;
    if let Some(tightest) = &deviation.tightest {
        entry("Nearest to P", far(tightest))?;
    }
    if let Some(exact) = &deviation.exact {
        entry("In exact modes", far(exact))?;
    }
    Ok(())
}

fn times(out: &mut String, figures: &Figures) -> fmt::Result {
    for (title, shares) in [
        ("Where the time goes", &figures.phases),
        (
            "What keeps the machine from being faster",
            &figures.limited_by,
        ),
    ] {
        writeln!(out, "\n{title:44}{:>12}{:>9}{:>14}", "s", "share", "s lost")?;
        for share in shares {
            writeln!(
                out,
                "  {:42}{:>12}{:>7.1} %{:>14}",
                share.name,
                fixed(share.time, 3),
                100.0 * share.share,
                fixed(share.lost, 3)
            )?;
        }
    }
    writeln!(
        out,
        "  (lost: what would be saved if these stretches were run at feed)"
    )
}

fn places(out: &mut String, figures: &Figures) -> fmt::Result {
    if figures.slowest.is_empty() {
        return Ok(());
    }
    let unit = figures.greatest_speed.unit;
    let is_other = |place: &&PlaceFigure| place.speed_unit != unit;
    // Where only rotary axes move in a program that moves others too, the row says so.
    let width = match figures.slowest.iter().any(|place| is_other(&place)) {
        true => 16,
        false => 12,
    };
    writeln!(out, "\nSlowest places")?;
    writeln!(
        out,
        "  {:>8}{:>11}{:>10}{:>width$}{:>8}  {:<22}{:<26}",
        "line",
        "at s",
        "s lost",
        format!("{unit}/s"),
        "of F",
        "what it does",
        "limited by"
    )?;
    for place in figures.slowest.iter().take(LISTED_PLACES) {
        let mut speed = in_column(place.least_speed, 4);
        if is_other(&place) {
            speed += &format!(" {}", place.speed_unit);
        }
        let row = format!(
            "  {:>8}{:>11.3}{:>10}{:>width$}{:>6.0} %  {:<22}{:<26}{}",
            place.line,
            place.time,
            fixed(place.lost, 4),
            speed,
            100.0 * place.least_share,
            place.phase,
            place.cause,
            shown(&place.text, place.of_program)
        );
        writeln!(out, "{}", row.trim_end())?;
    }
    let more = figures.slowest.len().saturating_sub(LISTED_PLACES);
    if more > 0 {
        writeln!(out, "  and {more} more with --json or --html")?;
    }
    Ok(())
}

/// The text of a line, or whose it is.
fn shown(text: &str, of_program: bool) -> String {
    match of_program {
        true => text.chars().take(LINE_WIDTH).collect(),
        false => "(in a subroutine's file)".to_owned(),
    }
}

fn evenness(out: &mut String, figures: &Figures) -> fmt::Result {
    let Some(share) = figures.evenness.total.share else {
        return Ok(());
    };
    let all = 100.0 * share;
    writeln!(out, "\nCutting within 5 % of the feed: {all:.1} %")?;
    for feed in figures.evenness.feeds.iter().take(LISTED_PLACES) {
        let share = 100.0 * feed.cutting.share.unwrap_or(0.0);
        let label = format!("F{}", significant(feed.feed, 4));
        let time = fixed(feed.cutting.time, 3);
        writeln!(out, "  {label:10}{share:>6.1} % of {time} s")?;
    }
    if figures.evenness.below.is_empty() {
        return Ok(());
    }
    let heads = ["lines", "s below", "least of F"];
    let [lines, below, least] = heads;
    writeln!(out, "  {lines:>17}{below:>11}{least:>12}  limited by")?;
    for stretch in figures.evenness.below.iter().take(LISTED_PLACES) {
        let [first, last] = stretch.lines;
        let lines = format!("{first} to {last}");
        let duration = fixed(stretch.duration, 4);
        let least = 100.0 * stretch.least_share;
        let text = shown(&stretch.text, stretch.of_program);
        let row = format!(
            "  {lines:>17}{duration:>11}{least:>10.0} %  {:<26}{text}",
            stretch.cause
        );
        writeln!(out, "{}", row.trim_end())?;
    }
    Ok(())
}

/// What a row of axes or joints does, each by its `label`.
fn peaks(
    out: &mut String,
    movers: &str,
    figures: &[AxisFigures],
    label: fn(&AxisFigures) -> String,
) -> fmt::Result {
    writeln!(out, "\nPeaks of the {movers}")?;
    writeln!(
        out,
        "  {:4}{:14}{:>12}{:>12}  {:8}{:>8}{:>11}{:>9}",
        "", "quantity", "peak", "limit", "unit", "share", "at s", "line"
    )?;
    for axis in figures {
        for peak in &axis.peaks {
            let limit = peak.limit.map(|limit| significant(limit, 7));
            let share = peak.share.map(percent);
            let label = if peak.quantity == Quantity::Velocity {
                label(axis)
            } else {
                String::new()
            };
            writeln!(
                out,
                "  {label:4}{:14}{:>12}{:>12}  {:8}{:>8}{:>11.3}{:>9}",
                peak.quantity.name(),
                in_column(peak.peak, 6),
                limit.as_deref().unwrap_or("-"),
                unit(axis.unit, peak.quantity),
                share.as_deref().unwrap_or("-"),
                peak.time,
                peak.line
            )?;
        }
    }
    Ok(())
}
