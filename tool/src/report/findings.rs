//! The conclusions of a report in words.

use super::differences::Judgement;
use super::summary::{FarthestReport, MemberReport, PathReport, Report, Verdict};
use crate::format::{Over, length, significant};
use crate::machine::configuration::{Member, PathSource};

/// The verdict over all parts of a report, and one sentence for each reason against `Pass`. `source` says whether its joints are
/// its axes.
pub fn conclude(report: &Report, source: PathSource) -> (Verdict, Vec<String>) {
    let mut findings = Vec::new();
    let mut verdict = Verdict::Pass;
    for member in report.joints.iter().chain(&report.axes) {
        verdict = verdict.max(member.verdict);
    }
    for joint in &report.joints {
        let mut axes = report.axes.iter().map(|axis| &axis.member);
        let axis = axes.find(|axis| axis.letter == joint.member.letter);
        let axis = axis.filter(|_| source == PathSource::Joints);
        findings.extend(member_findings(joint, axis));
    }
    findings.extend(
        report
            .axes
            .iter()
            .flat_map(|axis| member_findings(axis, None)),
    );
    if let Some(gap) = report.gaps.first() {
        verdict = verdict.max(Verdict::Incomplete);
        findings.push(format!(
            "The recording lacks servo cycles in {} place(s), first before {:.3} s: peaks there \
             are unknown",
            report.gaps.len(),
            gap.time
        ));
    }
    let moved = report
        .frame_changes
        .iter()
        .filter(|change| change.joint_movement > 2.0 * report.resolution)
        .max_by(|a, b| a.joint_movement.total_cmp(&b.joint_movement));
    if let Some(change) = moved {
        verdict = Verdict::Fail;
        findings.push(format!(
            "A joint moved by {} at the change of the frame at {:.3} s, line {}: all joints have to stand there",
            length(change.joint_movement, report.length_unit),
            change.time,
            change.line
        ));
    }
    if let Some(path) = &report.path {
        let (path_verdict, path_findings) = path_conclusion(path, report.length_unit);
        verdict = verdict.max(path_verdict);
        findings.extend(path_findings);
    }
    (verdict, findings)
}

/// `axis` is the one that a joint is: planners look at its limits alone.
fn member_findings(member: &MemberReport, axis: Option<&Member>) -> Vec<String> {
    let name = &member.member.name;
    let mut findings = Vec::new();
    for peak in &member.peaks {
        let (quantity, limit) = (peak.quantity.name(), peak.limit.unwrap_or(0.0));
        match peak.judgement {
            Judgement::Within | Judgement::NotLimited => {}
            Judgement::Over => {
                let over = Over {
                    name,
                    quantity: peak.quantity,
                    peak: peak.peak,
                    limit,
                    unit: member.member.unit,
                    time: peak.time,
                    line: peak.line,
                };
                let of_axis = axis.and_then(|axis| peak.quantity.limit(&axis.limits));
                let above = axis.zip(of_axis).filter(|(_, of_axis)| *of_axis > limit);
                let reason = above.map_or_else(String::new, |(axis, of_axis)| {
                    let (letter, key) = (axis.letter, peak.quantity.key());
                    format!(": [AXIS_{letter}]{key} = {of_axis} is above it")
                });
                findings.push(format!("{over}{reason}"));
            }
            Judgement::Unresolved => findings.push(format!(
                "{name}: {quantity} cannot be judged: the decimals of the recording leave {} \
                 open, the limit is {}; record positions with more decimals",
                significant(peak.uncertainty, 3),
                significant(limit, 6)
            )),
        }
    }
    findings
}

fn path_conclusion(path: &PathReport, unit: &'static str) -> (Verdict, Vec<String>) {
    let mut findings = Vec::new();
    match path {
        PathReport::Departed {
            place,
            source_line,
            farther_than,
            ..
        } => {
            findings.push(format!(
                "The executed path leaves the programmed path by more than {} at {:.3} s, behind \
                 line {source_line} of the source",
                length(*farther_than, unit),
                place.time
            ));
            (Verdict::Fail, findings)
        }
        PathReport::Followed {
            executed,
            programmed,
            not_reached,
            tolerance,
            ..
        } => {
            let mut verdict = Verdict::Pass;
            if *not_reached > 0.0 {
                verdict = Verdict::Incomplete;
                findings.push(format!(
                    "The recording ends {} before the end of the programmed path",
                    length(*not_reached, unit)
                ));
            }
            let mut check = |far: &FarthestReport, which: &str| {
                let Some(tolerance) = tolerance else { return };
                // Room for rounding only: positions are known to about 1e-12.
                if far.farthest.distance > tolerance * (1.0 + 1e-6) {
                    verdict = Verdict::Fail;
                    findings.push(format!(
                        "{which} by {}, the tolerance is {}: at {:.3} s, line {} of the source",
                        length(far.farthest.distance, unit),
                        length(*tolerance, unit),
                        far.place.time,
                        far.source_line
                    ));
                }
            };
            check(executed, "The executed path is off the programmed path");
            check(programmed, "The executed path passes by a programmed point");
            (verdict, findings)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::recording::Recording;
    use super::super::recording::tests::recording_of;
    use super::super::summary::tests::circle_run;
    use super::super::summary::{Report, analyse};
    use super::*;
    use crate::machine::configuration::tests::{MILL, machine};

    fn standing() -> Recording {
        recording_of(&[[0.0; 3]; 40], |_| 1)
    }

    fn report(recording: &Recording) -> Report {
        let mill = machine(MILL).expect("a machine");
        analyse("test", &mill, recording, &[], None).report
    }

    #[test]
    fn a_machine_that_stands_passes() {
        let report = report(&standing());
        assert_eq!((report.verdict, report.findings.len()), (Verdict::Pass, 0));
    }

    #[test]
    fn missing_cycles_make_it_incomplete() {
        let mut recording = standing();
        recording.gaps = vec![7];
        let report = report(&recording);
        assert_eq!(report.verdict, Verdict::Incomplete);
        assert!(report.findings[0].contains("first before 0.007 s"));
    }

    #[test]
    fn a_joint_that_moves_at_a_frame_change_fails() {
        let mut recording = standing();
        recording.axes[0].1[20..].fill(50.0);
        assert_eq!(report(&recording).verdict, Verdict::Pass);
        // Half a micrometre within one cycle would also break limits: spread it out.
        for (row, position) in recording.joints[2].iter_mut().enumerate() {
            *position = 1e-7 * (row as f64 - 15.0).clamp(0.0, 10.0);
        }
        let report = report(&recording);
        assert_eq!(report.verdict, Verdict::Fail);
        assert!(
            report
                .findings
                .iter()
                .any(|f| f.contains("at the change of the frame"))
        );
    }

    #[test]
    fn the_tolerance_decides_about_the_path() {
        let mill = machine(MILL).expect("a machine");
        let (recording, contour) = circle_run(10.0, 0.005);
        let off = |tolerance| {
            analyse("test", &mill, &recording, &contour, Some(tolerance))
                .report
                .findings
                .iter()
                .filter(|finding| finding.contains("programmed"))
                .cloned()
                .collect::<Vec<String>>()
        };
        assert!(off(0.0055).is_empty());
        let found = off(0.0045);
        assert_eq!(found.len(), 2);
        assert!(
            found[0].starts_with("The executed path is off the programmed path by 5.00 um"),
            "{found:?}"
        );
        assert!(found[0].ends_with("line 3 of the source"));
    }

    #[test]
    fn a_run_that_ends_early_or_goes_elsewhere_is_no_pass() {
        let mill = machine(MILL).expect("a machine");
        let (mut recording, contour) = circle_run(10.0, 0.0);
        let half = recording.rows() / 2;
        recording.times.truncate(half);
        recording.lines.truncate(half);
        recording.ids.truncate(half);
        recording.joints.iter_mut().for_each(|p| p.truncate(half));
        recording
            .axes
            .iter_mut()
            .for_each(|(_, p)| p.truncate(half));
        let findings = analyse("half", &mill, &recording, &contour, None)
            .report
            .findings;
        let early = "The recording ends 31.";
        assert!(
            findings.iter().any(|f| f.starts_with(early)),
            "{findings:?}"
        );

        recording.joints[2][half / 2..].fill(80.0);
        let report = analyse("elsewhere", &mill, &recording, &contour, None).report;
        let gone = "The executed path leaves the programmed path by more than";
        assert!(
            report.findings.iter().any(|f| f.starts_with(gone)),
            "{:?}",
            report.findings
        );
        assert_eq!(report.verdict, Verdict::Fail);
    }
}
