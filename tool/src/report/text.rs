//! The report as text for a terminal: plain ASCII, aligned.

use std::fmt::{self, Write};

use super::differences::{Judgement, Peak};
use super::summary::{FarthestReport, MemberReport, PathReport, Report, Verdict};
use crate::format::{
    duration, greatest_speed, grouped, in_column, length, percent, significant, unit,
};
use crate::machine::configuration::PathSource;

/// Width of the column of labels.
const LABEL: usize = 22;

/// The whole report, ending in a line feed.
///
/// # Errors
/// Those of the writer; a `String` has none.
pub fn render(report: &Report, recording: &str) -> Result<String, fmt::Error> {
    let mut text = String::new();
    let out = &mut text;
    writeln!(out, "{}", report.title)?;
    writeln!(out, "{}", "=".repeat(report.title.chars().count()))?;
    writeln!(out)?;
    let mut entry = |label: &str, value: String| writeln!(out, "{label:LABEL$}{value}");
    entry(
        "Recording",
        format!(
            "{recording}, {} servo cycles of {} ms",
            grouped(report.rows),
            significant(report.servo_period * 1e3, 6)
        ),
    )?;
    if !report.machine.is_empty() {
        entry("Machine", report.machine.clone())?;
    }
    let programmed = match report.moves.programmed {
        Some(count) => format!("{} programmed, ", grouped(count)),
        None => String::new(),
    };
    entry(
        "Moves",
        format!("{programmed}{} executed", grouped(report.moves.ids_seen)),
    )?;
    if report.is_lathe {
        entry("X", "a radius in all figures".to_owned())?;
    }
    entry("Time in motion", duration(report.time.in_motion))?;
    entry("Time standing", duration(report.time.standing))?;
    entry(
        "Path length",
        format!(
            "{} {}",
            significant(report.path_length, 7),
            report.length_unit
        ),
    )?;
    let speed = report.greatest_speed;
    entry(
        "Greatest speed",
        greatest_speed(
            speed.value,
            report.length_unit,
            speed.place.time,
            speed.place.line,
        ),
    )?;
    frame_entries(report, &mut entry)?;
    if let Some(path) = &report.path {
        path_entries(path, report.length_unit, &mut entry)?;
    }

    writeln!(out)?;
    members(
        out,
        "Joints: commanded positions against [JOINT_n]",
        &report.joints,
    )?;
    if !report.axes.is_empty() {
        writeln!(out)?;
        members(
            out,
            "Axes: the planner's own output against [AXIS_L]",
            &report.axes,
        )?;
    }
    writeln!(out)?;
    for finding in &report.findings {
        writeln!(out, "  - {finding}")?;
    }
    writeln!(out, "{}", verdict_line(report.verdict))?;
    Ok(text)
}

fn frame_entries(
    report: &Report,
    entry: &mut impl FnMut(&str, String) -> fmt::Result,
) -> fmt::Result {
    if report.frame_changes.is_empty() {
        return Ok(());
    }
    let moved = report
        .frame_changes
        .iter()
        .map(|change| change.joint_movement)
        .fold(0.0, f64::max);
    let count = report.frame_changes.len();
    let movement = if moved > 2.0 * report.resolution {
        format!("a joint moved by {}", length(moved, report.length_unit))
    } else {
        "no joint moved".to_owned()
    };
    entry("Changes of the frame", format!("{count}, {movement}"))
}

fn path_entries(
    path: &PathReport,
    unit: &str,
    entry: &mut impl FnMut(&str, String) -> fmt::Result,
) -> fmt::Result {
    match path {
        PathReport::Departed {
            place,
            source_line,
            farther_than,
            ..
        } => entry(
            "Path",
            format!(
                "leaves the programmed path by more than {} at {:.3} s, behind source line \
                 {source_line}",
                length(*farther_than, unit),
                place.time
            ),
        ),
        PathReport::Followed {
            source,
            executed,
            programmed,
            not_reached,
            final_position_error,
            tolerance,
        } => {
            let columns = match source {
                PathSource::Joints => "joints",
                PathSource::Axes => "axes",
            };
            let far = |far: &FarthestReport| {
                format!(
                    "{} at {:.3} s, source line {}",
                    length(far.farthest.distance, unit),
                    far.place.time,
                    far.source_line
                )
            };
            entry(
                "Off the path",
                format!("at most {} ({columns})", far(executed)),
            )?;
            entry(
                "Programmed points",
                format!("passed at {}", far(programmed)),
            )?;
            if let Some(tolerance) = tolerance {
                entry("Tolerance", length(*tolerance, unit))?;
            }
            if *not_reached > 0.0 {
                entry("Not reached", length(*not_reached, unit))?;
            }
            entry("Final position error", length(*final_position_error, unit))
        }
    }
}

fn members(out: &mut String, headline: &str, members: &[MemberReport]) -> fmt::Result {
    writeln!(out, "{headline}")?;
    writeln!(
        out,
        "  {:12}{:14}{:>12}{:>12}  {:8}{:>8}{:>10}{:>8}",
        "", "quantity", "peak", "limit", "unit", "share", "at s", "line"
    )?;
    for report in members {
        let member = &report.member;
        let mut name = format!("{} {}", member.letter, member.name);
        for peak in &report.peaks {
            let limit = peak
                .limit
                .map_or("-".to_owned(), |limit| significant(limit, 7));
            let share = peak.share.map_or("-".to_owned(), percent);
            writeln!(
                out,
                "  {name:12}{:14}{:>12}{limit:>12}  {:8}{share:>8}{:>10.3}{:>8}  {}",
                peak.quantity.name(),
                in_column(peak.peak, 6),
                unit(member.unit, peak.quantity),
                peak.time,
                peak.line,
                judgement(peak)
            )?;
            name.clear();
        }
        writeln!(
            out,
            "  {:12}{}",
            "",
            match report.verdict {
                Verdict::Pass => "PASS: within its limits",
                Verdict::Incomplete => "NOT CHECKED: the recording has too few decimals",
                Verdict::Fail => "OVER LIMIT",
            }
        )?;
    }
    Ok(())
}

fn judgement(peak: &Peak) -> &'static str {
    match peak.judgement {
        Judgement::Within => "within",
        Judgement::Over => "OVER",
        Judgement::Unresolved => "not resolved",
        Judgement::NotLimited => "not limited",
    }
}

fn verdict_line(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "Result: PASS, all within limits",
        Verdict::Incomplete => "Result: INCOMPLETE, not all could be checked",
        Verdict::Fail => "Result: FAIL, see above",
    }
}

#[cfg(test)]
mod tests {
    use super::super::recording::tests::recording_of;
    use super::super::summary::analyse;
    use super::super::summary::tests::circle_run;
    use super::*;
    use crate::machine::configuration::tests::{MILL, machine};

    #[test]
    fn the_text_is_ascii_aligned_and_says_how_it_went() {
        let mill = machine(MILL).expect("a machine");
        let (recording, contour) = circle_run(50.0, 0.005);
        let analysis = analyse("Circle", &mill, &recording, &contour, Some(0.01));
        let text = render(&analysis.report, "run.csv").expect("a text");
        assert!(text.is_ascii(), "{text}");
        insta::assert_snapshot!("a_circle_that_is_over_its_limits", text);
        assert!(text.lines().all(|line| line.len() <= 160));

        let still = recording_of(&[[1.0; 3]; 50], |_| 0);
        let analysis = analyse("Still", &mill, &still, &[], None);
        let text = render(&analysis.report, "run.csv").expect("a text");
        assert_eq!(text.matches("PASS: within its limits").count(), 6);
        assert!(text.ends_with("Result: PASS, all within limits\n"));
    }
}
