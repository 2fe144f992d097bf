//! Times of the modules over that of the first, over all programs.

use super::excerpt::Excerpt;
use super::figures::Figures;
use super::subjects::Subject;
use crate::machine::limits::Jerk;
use serde::Serialize;
use std::fmt::Write;

/// The runs of one program: its name, and the figures of every module.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct ProgramRuns {
    pub program: String,
    pub moves: usize,
    /// How many axes move.
    pub axes: usize,
    /// Where in the program it stands that was run in place of all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excerpt: Option<Excerpt>,
    /// Why there is none, and nothing was run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_excerpt: Option<String>,
    pub runs: Vec<Figures>,
}

impl ProgramRuns {
    pub(super) fn new(subject: Subject, runs: Vec<Figures>) -> ProgramRuns {
        ProgramRuns {
            moves: subject.program.handed.len(),
            axes: subject.moving_axes(),
            program: subject.name,
            excerpt: subject.excerpt,
            no_excerpt: subject.no_excerpt,
            runs,
        }
    }
}

/// A module at a jerk limit against the first module.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Ratio {
    pub module: String,
    pub jerk: Jerk,
    pub baseline: String,
    /// Geometric mean of the ratios of time over all programs that both came through.
    pub geometric_mean: Option<f64>,
    pub programs: usize,
    /// The largest ratio, and its program, among those where the first module itself stays in the
    /// limits and the tolerance.
    pub worst: Option<(f64, String)>,
    /// Programs on which it does not: they count in the mean only.
    pub mean_only: Vec<String>,
    /// Programs on which the module leaves a limit or the tolerance: its time is not to be trusted.
    pub exceeded: Vec<String>,
    /// Programs that one of the two did not bring to their end: they do not count.
    pub not_finished: Vec<String>,
}

impl Ratio {
    /// Of ratios and their programs, at least one of them, all of which count.
    pub(crate) fn of(module: String, jerk: Jerk, baseline: &str, ratios: &[(f64, &str)]) -> Ratio {
        let sum: f64 = ratios.iter().map(|(ratio, _)| ratio.ln()).sum();
        let worst = ratios.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        Ratio {
            module,
            jerk,
            baseline: baseline.to_owned(),
            geometric_mean: Some((sum / ratios.len() as f64).exp()),
            programs: ratios.len(),
            worst: worst.map(|&(ratio, name)| (ratio, name.to_owned())),
            mean_only: Vec::new(),
            exceeded: Vec::new(),
            not_finished: Vec::new(),
        }
    }
}

/// Time over the least times on the executed path and in the tube, of all modules for which they were measured.
pub(crate) fn over_the_optimum(programs: &[ProgramRuns]) -> Vec<Ratio> {
    let on_the_path = |run: &Figures| run.optimum.as_ref().map(|optimum| optimum.ratio);
    let in_the_tube = |run: &Figures| run.tube.as_ref()?.ratio;
    let mut ratios = over(programs, "the least time on its path", on_the_path);
    ratios.extend(over(programs, "the least time in the tube", in_the_tube));
    ratios
}

/// What each module has of a ratio to a time that is called `baseline`.
fn over(
    programs: &[ProgramRuns],
    baseline: &str,
    ratio: impl Fn(&Figures) -> Option<f64>,
) -> Vec<Ratio> {
    let mut found: Vec<(&Figures, Vec<(f64, &str)>)> = Vec::new();
    for program in programs {
        for run in &program.runs {
            let Some(ratio) = ratio(run) else {
                continue;
            };
            let ratio = (ratio, program.program.as_str());
            let same = |known: &Figures| known.module == run.module && known.jerk == run.jerk;
            match found.iter_mut().find(|(known, _)| same(known)) {
                Some((_, ratios)) => ratios.push(ratio),
                None => found.push((run, vec![ratio])),
            }
        }
    }
    found
        .into_iter()
        .map(|(run, ratios)| {
            let jerk = if run.takes_jerk {
                run.jerk
            } else {
                Jerk::Unlimited
            };
            Ratio::of(run.module.clone(), jerk, baseline, &ratios)
        })
        .collect()
}

/// The modules of these runs with their limits of jerk, in their order, each once.
pub(crate) fn kinds<'a>(runs: impl Iterator<Item = &'a Figures>) -> Vec<(String, Jerk)> {
    let mut kinds: Vec<(String, Jerk)> = Vec::new();
    for run in runs {
        let known = |(module, jerk): &(String, Jerk)| *module == run.module && *jerk == run.jerk;
        if !kinds.iter().any(known) {
            kinds.push((run.module.clone(), run.jerk));
        }
    }
    kinds
}

/// Ratios of all modules but the first.
pub(crate) fn ratios(programs: &[ProgramRuns]) -> Vec<Ratio> {
    let others = programs
        .iter()
        .flat_map(|program| program.runs.iter().skip(1));
    kinds(others)
        .into_iter()
        .filter_map(|(module, jerk)| ratio(programs, module, jerk))
        .collect()
}

fn ratio(programs: &[ProgramRuns], module: String, jerk: Jerk) -> Option<Ratio> {
    let mut logarithms = Vec::new();
    let mut worst: Option<(f64, String)> = None;
    let [mut mean_only, mut exceeded, mut not_finished] = [const { Vec::new() }; 3];
    let mut baseline_name = String::new();
    for program in programs {
        let Some((baseline, others)) = program.runs.split_first() else {
            continue;
        };
        let found = others
            .iter()
            .find(|run| run.module == module && run.jerk == jerk);
        let Some(run) = found else {
            continue;
        };
        baseline_name.clone_from(&baseline.module);
        let name = &program.program;
        let timed = |run: &Figures| run.came_through() && run.motion.time > 0.0;
        if !timed(run) || !timed(baseline) {
            not_finished.push(name.clone());
            continue;
        }
        let ratio = run.motion.time / baseline.motion.time;
        logarithms.push(ratio.ln());
        if run.exceeds() {
            exceeded.push(name.clone());
        }
        if baseline.exceeds() {
            mean_only.push(name.clone());
        } else if worst.as_ref().is_none_or(|(most, _)| ratio > *most) {
            worst = Some((ratio, name.clone()));
        }
    }
    let programs = logarithms.len();
    let found = programs > 0 || !not_finished.is_empty();
    found.then(|| Ratio {
        module,
        jerk,
        baseline: baseline_name,
        geometric_mean: (programs > 0)
            .then(|| (logarithms.iter().sum::<f64>() / programs as f64).exp()),
        programs,
        worst,
        mean_only,
        exceeded,
        not_finished,
    })
}

/// The ratios as a table; empty if there are none.
pub(crate) fn text(ratios: &[Ratio]) -> String {
    let mut text = String::new();
    if ratios.is_empty() {
        return text;
    }
    let module_width = ratios
        .iter()
        .map(|ratio| ratio.module.chars().count())
        .max()
        .unwrap_or(0);
    let over_width = ratios
        .iter()
        .map(|ratio| ratio.baseline.chars().count())
        .max()
        .unwrap_or(0);
    text.push_str("ratios of time\n");
    for ratio in ratios {
        let (module, jerk, over) = (&ratio.module, ratio.jerk.to_string(), &ratio.baseline);
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "  {module:<module_width$}  jerk {jerk:>9}  over {over:<over_width$}"
        );
        if let Some(mean) = ratio.geometric_mean {
            let _ = write!(text, "  mean {mean:.3}");
        }
        if let Some((worst, program)) = &ratio.worst {
            let _ = write!(text, "  worst {worst:.3} ({program})");
        }
        let _ = writeln!(text, "  of {} programs", ratio.programs);
        if !ratio.exceeded.is_empty() {
            let names = ratio.exceeded.join(", ");
            let _ = writeln!(
                text,
                "      leaves a limit or the tolerance itself: {names}"
            );
        }
        if !ratio.not_finished.is_empty() {
            let names = ratio.not_finished.join(", ");
            let _ = writeln!(
                text,
                "      not counted, one of the two does not finish: {names}"
            );
        }
    }
    text.push_str("  mean: geometric\n");
    if let Some(ratio) = ratios.iter().find(|ratio| !ratio.mean_only.is_empty()) {
        let _ = writeln!(
            text,
            "  in the mean only, since {} leaves a limit or the tolerance there: {}",
            ratio.baseline,
            ratio.mean_only.join(", ")
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::figures::tests::finished;

    fn runs(program: &str, baseline: Figures, other: Figures) -> ProgramRuns {
        ProgramRuns {
            program: program.to_owned(),
            moves: 1,
            axes: 3,
            runs: vec![baseline, other],
            ..ProgramRuns::default()
        }
    }

    fn exceeding(mut figures: Figures) -> Figures {
        figures.motion.axes.acceleration.ratio = 2.0;
        figures
    }

    #[test]
    fn geometric_mean_and_worst() {
        let found = ratios(&[
            runs("a", finished("stock", 1.0), finished("ours", 0.5)),
            runs("b", finished("stock", 1.0), finished("ours", 2.0)),
        ]);
        assert_eq!(found.len(), 1);
        assert!((found[0].geometric_mean.expect("a mean") - 1.0).abs() < 1e-12);
        assert_eq!(found[0].worst, Some((2.0, "b".to_owned())));
    }

    #[test]
    fn where_the_first_module_breaks_a_limit_the_program_counts_in_the_mean_only() {
        let found = ratios(&[
            runs("a", finished("stock", 1.0), finished("ours", 0.5)),
            runs(
                "b",
                exceeding(finished("stock", 1.0)),
                finished("ours", 2.0),
            ),
        ]);
        assert_eq!(found[0].programs, 2);
        assert_eq!(found[0].worst, Some((0.5, "a".to_owned())));
        assert_eq!(found[0].mean_only, ["b"]);
        assert!(text(&found).contains("since stock leaves a limit or the tolerance there: b"));
    }

    #[test]
    fn a_module_gains_nothing_by_not_finishing_or_breaking_limits_unseen() {
        let mut short = finished("ours", 0.1);
        short.final_error = 5.0;
        let found = ratios(&[
            runs(
                "a",
                finished("stock", 1.0),
                exceeding(finished("ours", 0.5)),
            ),
            runs("b", finished("stock", 1.0), short),
        ]);
        assert_eq!(found[0].programs, 1);
        assert_eq!(found[0].exceeded, ["a"]);
        assert_eq!(found[0].not_finished, ["b"]);
        let text = text(&found);
        assert!(
            text.contains("itself: a") && text.contains("does not finish: b"),
            "{text}"
        );
    }
}
