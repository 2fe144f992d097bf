//! What is measured of a run with the help of [`crate::optimum`]: nothing in a build without that feature.

use serde::Serialize;

/// The optimum of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct LeastTime {
    /// With the limits of velocity, acceleration and jerk, s.
    pub time: f64,
    /// Without the limit of jerk (TOPP-RA), s.
    pub without_jerk_limit: f64,
    /// From the first motion to the last move that is handed over, at the earliest, s: no planner ends
    /// before it.
    pub supply: f64,
    /// Time of the module without what it waited for the program, s.
    pub executed: f64,
    /// Executed over the greater one of optimum and supply.
    pub ratio: f64,
    /// The ratio is to the supply.
    pub limited_by_supply: bool,
    /// Stretches between standstills that the program asks for.
    pub stretches: usize,
    /// Those of them with moves that follow the spindle, which says how fast they are: they count as
    /// they were run.
    pub with_spindle: usize,
    /// Those of them for which there is no optimum: they count as they were run.
    pub not_solved: usize,
    /// The first reason for one.
    pub problem: Option<String>,
}

/// The least time in the tolerance of an excerpt; without a problem there is all of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct InTheTube {
    /// The shortest motion that was found, s.
    pub time: Option<f64>,
    /// Executed, as in [`LeastTime`], over the greater one of that and the supply.
    pub ratio: Option<f64>,
    /// Steps of time of that motion, s.
    pub step: Option<f64>,
    /// Convex programs that were solved for it.
    pub rounds: Option<usize>,
    /// Its greatest distance from the program over the tolerance.
    pub deviation: Option<f64>,
    /// Its greatest velocity, acceleration or jerk over the limit.
    pub limits: Option<f64>,
    /// Why there is none.
    pub problem: Option<String>,
}

/// The holds of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Holds {
    /// How often a moving machine was held until it stood.
    pub count: usize,
    /// How often it did not stand at the end of the hold.
    pub not_at_rest: usize,
    /// How often it was held in a thread, which it follows to its end.
    pub in_threads: usize,
    /// Longest time to rest, s.
    pub longest: f64,
    /// Mean of the time to rest over that of the shortest stop from the same speed and acceleration
    /// along the path.
    pub mean_ratio: f64,
    pub worst_ratio: f64,
    /// How much longer than that it took at worst, s.
    pub latest: f64,
    /// Largest travel of an axis while it was held and had been at rest, mm or degrees.
    pub drift: f64,
}

impl Holds {
    /// How often it was held in motion.
    pub(crate) fn all(&self) -> usize {
        self.count + self.not_at_rest + self.in_threads
    }
}
