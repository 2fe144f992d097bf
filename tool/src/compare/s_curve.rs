//! LinuxCNC master's S-curve planner (PLANNER_TYPE 1), which cannot be loaded beside the stock planner of
//! 2.9: its times over those of 2.9 on some of the generated programs, as measured in real runs of
//! both.

use super::figures::Figures;
use super::ratios::{ProgramRuns, Ratio};
use crate::machine::limits::{Jerk, Limits};

/// Jerk limit of those runs, in accelerations per second; velocity and acceleration were
/// [`Limits::default`].
const JERK: Jerk = Jerk::Accelerations(20.0);

/// What its ratios are to.
const BASELINE: &str = "master's S-curve planner (published ratios)";

/// Program, time of 2.9, time of master's S-curve planner, s.
const TIMES: [(&str, f64, f64); 8] = [
    ("dense", 17.8, 149.0),
    ("spiral", 18.7, 76.5),
    ("trochoidal", 15.3, 92.4),
    ("squares-p.005", 8.5, 11.4),
    ("squares-p.5", 6.9, 26.5),
    ("blade", 42.5, 108.0),
    ("wrapped", 37.7, 86.0),
    ("abc", 14.6, 15.3),
];

/// Ratios to it; none if there is nothing to compare: other limits, another jerk, none of the
/// programs, or a first module other than LinuxCNC's.
pub(crate) fn ratios(programs: &[ProgramRuns], limits: &Limits) -> Vec<Ratio> {
    if *limits != Limits::default() {
        return Vec::new();
    }
    let mut found: Vec<(String, Vec<(f64, &str)>)> = Vec::new();
    for (name, stock, s_curve) in TIMES {
        let runs = programs.iter().find(|program| program.program == name);
        let Some((baseline, others)) = runs.and_then(|runs| runs.runs.split_first()) else {
            continue;
        };
        // The shapes are alike, not the same: the ratio of the two times is taken over.
        let reference = baseline.motion.time * s_curve / stock;
        if baseline.module != "tpmod.so" || !baseline.came_through() || reference <= 0.0 {
            continue;
        }
        let comparable = |run: &&Figures| run.jerk == JERK && run.takes_jerk && run.came_through();
        for run in others.iter().filter(comparable) {
            let ratio = (run.motion.time / reference, name);
            match found.iter_mut().find(|(module, _)| *module == run.module) {
                Some((_, ratios)) => ratios.push(ratio),
                None => found.push((run.module.clone(), vec![ratio])),
            }
        }
    }
    found
        .into_iter()
        .map(|(module, ratios)| Ratio::of(module, JERK, BASELINE, &ratios))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::figures::tests::finished;

    fn squares(jerk: Jerk) -> [ProgramRuns; 1] {
        let mut ours = finished("ours", 5.7);
        ours.takes_jerk = true;
        ours.jerk = jerk;
        [ProgramRuns {
            program: "squares-p.005".to_owned(),
            moves: 60,
            axes: 2,
            runs: vec![finished("tpmod.so", 8.5), ours],
            ..ProgramRuns::default()
        }]
    }

    #[test]
    fn half_of_its_time() {
        let found = ratios(&squares(JERK), &Limits::default());
        assert_eq!(found.len(), 1);
        assert!((found[0].geometric_mean.expect("a mean") - 0.5).abs() < 1e-12);
    }

    #[test]
    fn only_on_the_limits_that_it_was_measured_with() {
        assert!(ratios(&squares(Jerk::Unlimited), &Limits::default()).is_empty());
        let mut limits = Limits::default();
        limits.apply(&"A=500".parse().expect("valid"));
        assert!(ratios(&squares(JERK), &limits).is_empty());
    }
}
