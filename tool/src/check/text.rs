//! The findings as text: file, line, column, what was found, the line to write.

use super::Report;
use super::finding::{Finding, Remedy};
use crate::format::significant;

/// The whole text.
pub fn render(report: &Report) -> String {
    let mut text: String = report.findings.iter().map(finding).collect();
    if !report.stops.is_empty() {
        text.push_str("from its greatest velocity to rest, by an abort or a feed hold:\n");
    }
    for stop in &report.stops {
        let number = |number: f64| significant(number, 4);
        let unit = stop.unit;
        let jerk = stop.jerk.map_or_else(
            || "jerk not limited".to_owned(),
            |jerk| format!("{} {unit}/s3", number(jerk)),
        );
        text.push_str(&format!(
            "  {}: {} {unit} in {} s ({} {unit}/s, {} {unit}/s2, {jerk})\n",
            stop.axis,
            number(stop.distance),
            number(stop.time),
            number(stop.velocity),
            number(stop.acceleration),
        ));
    }
    text.push_str(&format!("{}: {}\n", report.ini, counts(report)));
    text
}

fn finding(finding: &Finding) -> String {
    let mut place = finding.file.clone();
    for number in [finding.line, finding.column].into_iter().flatten() {
        place.push_str(&format!(":{number}"));
    }
    let remedy = match &finding.remedy {
        Remedy::Add { into, lines } => {
            let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
            format!("  write into {into}:\n{lines}")
        }
        Remedy::Replace { line } => format!("  write instead:\n    {line}\n"),
        Remedy::Remove => "  remove this line\n".to_owned(),
        Remedy::Advice { text } => format!("  help: {text}\n"),
    };
    format!("{place}: {}: {}\n{remedy}\n", finding.level, finding.found)
}

fn counts(report: &Report) -> String {
    let count = |number: usize, name: &str| match number {
        1 => format!("1 {name}"),
        _ => format!("{number} {name}s"),
    };
    format!(
        "{}, {}, {}",
        count(report.errors, "error"),
        count(report.warnings, "warning"),
        count(report.notes, "note")
    )
}
