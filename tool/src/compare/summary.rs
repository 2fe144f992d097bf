//! Over all programs: what the calls cost by the number of axes that move, and how long it takes to
//! come to rest.

use super::figures::Figures;
use super::ratios::{ProgramRuns, kinds};
use crate::machine::limits::Jerk;
use std::fmt::Write;

/// Programs are taken together that move at most so many axes.
const AXES: [usize; 3] = [3, 5, 9];

/// Tables for people; empty if nothing was run.
pub(crate) fn text(programs: &[ProgramRuns]) -> String {
    let mut text = costs(programs);
    text.push_str(&rests(programs));
    text
}

fn all_runs(programs: &[ProgramRuns]) -> impl Iterator<Item = &Figures> {
    programs.iter().flat_map(|program| &program.runs)
}

/// The runs of a module with a limit of jerk, with their programs.
fn runs<'a>(
    programs: &'a [ProgramRuns],
    module: &'a str,
    jerk: Jerk,
) -> impl Iterator<Item = (&'a ProgramRuns, &'a Figures)> {
    programs.iter().flat_map(move |program| {
        let runs = program.runs.iter();
        runs.filter(move |run| run.module == module && run.jerk == jerk && run.came_through())
            .map(move |run| (program, run))
    })
}

fn label(module: &str, jerk: Jerk, run: &Figures) -> String {
    let jerk = if run.takes_jerk {
        jerk.to_string()
    } else {
        "-".to_owned()
    };
    format!("  {module}  jerk {jerk:>9}")
}

fn costs(programs: &[ProgramRuns]) -> String {
    let mut text = String::new();
    let kinds = kinds(all_runs(programs));
    let mut least = 0;
    for most in AXES {
        for (module, jerk) in &kinds {
            let here: Vec<(&ProgramRuns, &Figures)> = runs(programs, module, *jerk)
                .filter(|(program, _)| (least + 1..=most).contains(&program.axes))
                .collect();
            let Some((_, first)) = here.first() else {
                continue;
            };
            if text.is_empty() {
                text.push_str(
                    "cost of the calls, microseconds: mean of all calls, and the greatest 99.9th percentile\n",
                );
            }
            let cost = |of: fn(&Figures) -> super::cost::Cost| {
                let calls: usize = here.iter().map(|(_, run)| of(run).calls).sum();
                let sum: f64 = here
                    .iter()
                    .map(|(_, run)| of(run).mean * of(run).calls as f64)
                    .sum();
                let worst = here
                    .iter()
                    .max_by(|a, b| of(a.1).p999.total_cmp(&of(b.1).p999));
                let (p999, name) = worst.map_or((0.0, ""), |(program, run)| {
                    (of(run).p999, program.program.as_str())
                });
                format!("{:.2}, {p999:.1} ({name})", sum / calls.max(1) as f64)
            };
            let (label, count) = (label(module, *jerk, first), here.len());
            let (run, add) = (cost(|run| run.run), cost(|run| run.add));
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{label}  up to {most} axes: run {run}  add {add}  of {count} programs"
            );
        }
        least = most;
    }
    text
}

fn rests(programs: &[ProgramRuns]) -> String {
    let mut text = String::new();
    for (module, jerk) in kinds(all_runs(programs)) {
        let here: Vec<(&ProgramRuns, &Figures)> = runs(programs, &module, jerk)
            .filter(|(_, run)| run.holds.count > 0)
            .collect();
        let Some((_, first)) = here.first() else {
            continue;
        };
        if text.is_empty() {
            text.push_str("time to rest when held, over the shortest stop along the path\n");
        }
        let count: usize = here.iter().map(|(_, run)| run.holds.count).sum();
        let sum: f64 = here
            .iter()
            .map(|(_, run)| run.holds.mean_ratio * run.holds.count as f64)
            .sum();
        let ratio = here.iter().fold(0.0, |worst, (_, run)| {
            f64::max(worst, run.holds.worst_ratio)
        });
        let latest = here
            .iter()
            .max_by(|a, b| a.1.holds.latest.total_cmp(&b.1.holds.latest));
        let (latest, name) = latest.map_or((0.0, ""), |(program, run)| {
            (run.holds.latest * 1e3, program.program.as_str())
        });
        let (label, mean) = (label(&module, jerk, first), sum / count as f64);
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{label}  mean {mean:.3}  worst {ratio:.2}  {latest:.0} ms late at most ({name})  of {count} holds"
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::cost::Cost;
    use crate::compare::figures::tests::finished;

    fn program(name: &str, axes: usize, cost: (usize, f64, f64)) -> ProgramRuns {
        let mut run = finished("ours", 1.0);
        let (calls, mean, p999) = cost;
        run.run = Cost {
            calls,
            mean,
            p999,
            ..Cost::default()
        };
        run.holds.count = calls;
        run.holds.mean_ratio = mean;
        run.holds.latest = p999 * 1e-3;
        ProgramRuns {
            program: name.to_owned(),
            moves: 1,
            axes,
            runs: vec![run],
            ..ProgramRuns::default()
        }
    }

    #[test]
    fn by_axes_weighted_by_calls() {
        let programs = [
            program("a", 3, (100, 4.0, 10.0)),
            program("b", 2, (300, 8.0, 30.0)),
            program("c", 9, (10, 16.0, 40.0)),
        ];
        let text = text(&programs);
        assert!(text.contains("up to 3 axes: run 7.00, 30.0 (b)"), "{text}");
        assert!(text.contains("up to 9 axes: run 16.00, 40.0 (c)"), "{text}");
        assert!(!text.contains("up to 5"), "{text}");
        assert!(text.contains("mean 7.220"), "{text}");
        assert!(
            text.contains("40 ms late at most (c)  of 410 holds"),
            "{text}"
        );
        assert_eq!(super::text(&[]), "");
    }
}
