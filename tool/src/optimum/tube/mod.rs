//! The least time within the tolerance of a program: the path is free, too.
//!
//! Successive convex programs. A motion is a cubic spline of equal steps of time ([`motion`]); each of its knots
//! belongs to a place on the legs of the program ([`course`]), as near as possible and in their order ([`matching`]).
//! A round ([`mod@round`]) finds the shortest motion whose knots stay near their legs; then they are matched again. What a
//! motion does between its knots is looked at ([`check`]) and put right in the next round. Nearly every round is
//! feasible, the time falls from round to round, and what comes out is a local optimum: no proven bound, but a motion
//! that keeps the limits and the tolerance.

#[cfg(test)]
mod calibration;
mod check;
mod course;
mod matching;
mod motion;
mod round;

pub(crate) use course::Leg;

use super::limits::PathLimits;
use crate::path::pieces::Point;
use check::{Check, Pass, passes};
use clarabel::solver::SolverStatus;
use course::{Course, Place};
use matching::places;
use motion::{LEAST_STEPS, Motion};
use round::Round;

/// Rounds at most, first with longer steps.
const MOST_ROUNDS: [usize; 2] = [24, 16];

/// The rounds end when one of them gains less than this share of the time.
const CONVERGED: [f64; 2] = [2e-3, 4e-4];

/// The first rounds have steps so much longer.
const LONGER: usize = 2;

/// The motion has so many steps at most.
const MOST_STEPS: usize = 3000;

/// In a step the greatest acceleration makes a motion bulge by no more than this share of the smallest radius.
const BULGE: f64 = 0.1;

/// So many steps at least make the time in which the jerk brings about the acceleration.
const STEPS_OF_A_RAMP: f64 = 5.0;

/// The longest step without a limit of jerk, where the acceleration still takes a step to change, s.
const STEP_WITHOUT_RAMPS: f64 = 1.5e-3;

/// No step is longer, s.
const LONGEST_STEP: f64 = 4e-3;

/// A motion counts if nothing is exceeded by more than this.
const EXCEEDED: f64 = 1.002;

/// Vertices where the course turns by more than this are looked after in every round: the cosine of .02 radians.
const STRAIGHT: f64 = 0.9998;

/// Others, where the motion went by at more than this share of the radius.
const MISSED: f64 = 0.98;

/// Knots stay no further inside than this share of the radius.
const GREATEST_MARGIN: f64 = 0.5;

/// The shortest motion that was found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InTube {
    motion: Motion,
    /// Convex programs that were solved.
    pub rounds: usize,
    /// Its greatest distance from the program, or of the program from it, over the tolerance.
    pub deviation: f64,
    /// Its greatest velocity, acceleration or jerk over the limit.
    pub limits: f64,
}

impl InTube {
    /// Its duration, s.
    pub(crate) fn time(&self) -> f64 {
        self.motion.duration()
    }

    /// Duration of its steps, s.
    pub(crate) fn step(&self) -> f64 {
        self.motion.step
    }
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum NoTube {
    /// Nothing to move along.
    #[error("the machine does not move")]
    NoMotion,
    /// More steps than can be computed.
    #[error(
        "the excerpt takes {duration:.1} s, which is more than {MOST_STEPS} steps of {:.2} ms: take fewer moves",
        step * 1e3
    )]
    TooLong {
        /// Of the executed motion, s.
        duration: f64,
        /// s.
        step: f64,
    },
    /// No round ended with a motion that keeps everything.
    #[error("no motion was found that keeps the limits and the tolerance")]
    NotFound,
    /// The solver did not come to its end.
    #[error("the solver gave up ({0:?})")]
    Solver(SolverStatus),
}

/// The least time along `legs`, from rest to rest, with the limits of X Y Z in `limits`. It is looked for from what a
/// machine did: its positions, which are `period` seconds apart. No step is shorter than that.
pub(crate) fn least_time_in_tube(
    legs: &[Leg],
    positions: &[Point],
    period: f64,
    limits: &PathLimits,
) -> Result<InTube, NoTube> {
    let course = Course::new(legs).ok_or(NoTube::NoMotion)?;
    if positions.len() < 2 {
        return Err(NoTube::NoMotion);
    }
    let duration = (positions.len() - 1) as f64 * period;
    let steps = steps(&course, limits, duration, period)?;
    let mut search = Search {
        course,
        limits: *limits,
        best: None,
        rounds: 0,
    };
    let motion = Motion::near(positions, duration, (steps / LONGER).max(LEAST_STEPS));
    let motion = search.rounds(motion, 0)?.resampled(steps);
    search.best = None;
    search.rounds(motion, 1)?;
    search.best.ok_or(NoTube::NotFound)
}

/// How many steps a motion of this duration, s, has.
fn steps(
    course: &Course,
    limits: &PathLimits,
    duration: f64,
    period: f64,
) -> Result<usize, NoTube> {
    let least = |of: &[f64]| of[..3].iter().copied().fold(f64::INFINITY, f64::min);
    let most = |of: &[f64]| of[..3].iter().copied().fold(0.0, f64::max);
    let bulge = (8.0 * BULGE * course.least_radius() / most(&limits.acceleration)).sqrt();
    let ramp = least(&limits.acceleration) / most(&limits.jerk) / STEPS_OF_A_RAMP;
    let ramp = if ramp > 0.0 { ramp } else { STEP_WITHOUT_RAMPS };
    let step = bulge.min(ramp).min(LONGEST_STEP).max(period);
    let steps = (duration / step).ceil();
    if steps > MOST_STEPS as f64 {
        return Err(NoTube::TooLong { duration, step });
    }
    Ok((steps as usize).max(LEAST_STEPS))
}

/// The rounds so far.
struct Search {
    course: Course,
    limits: PathLimits,
    best: Option<InTube>,
    rounds: usize,
}

impl Search {
    /// Rounds from a motion on until they gain little, the first or the second ones; the last motion.
    fn rounds(&mut self, mut motion: Motion, stage: usize) -> Result<Motion, NoTube> {
        let mut places = places(&self.course, &motion.knots());
        let mut found = passes(&motion, &self.course, &places);
        let mut margins = vec![0.0; motion.steps() + 1];
        let mut turns = self.turns();
        for _ in 0..MOST_ROUNDS[stage] {
            let round = Round {
                course: &self.course,
                limits: &self.limits,
                motion: &motion,
                places: &places,
                margins: &margins,
                passes: &looked_after(&turns, &found),
            };
            let next = match round.solve() {
                Ok(next) => next,
                Err(_) if self.best.is_some() => break,
                Err(status) => return Err(NoTube::Solver(status)),
            };
            self.rounds += 1;
            let gain = 1.0 - next.duration() / motion.duration();
            motion = next;
            places = matching::places(&self.course, &motion.knots());
            let check = Check::of(&motion, &self.course, &places, &self.limits);
            let good = self.note(&motion, &check);
            if (good || stage == 0) && gain.abs() < CONVERGED[stage] {
                break;
            }
            self.put_right(&check, &places, &mut margins);
            for (turns, pass) in turns.iter_mut().zip(&check.passes) {
                *turns |= pass.deviation > MISSED;
            }
            found = check.passes;
        }
        Ok(motion)
    }

    /// Which vertices are looked after from the first round on.
    fn turns(&self) -> Vec<bool> {
        let vertices = 1..self.course.legs.len();
        vertices
            .map(|vertex| self.course.cosine(vertex) < STRAIGHT)
            .collect()
    }

    /// Keeps the motion if it is the best one so far; whether it keeps everything.
    fn note(&mut self, motion: &Motion, check: &Check) -> bool {
        let good = check.worst() <= EXCEEDED;
        let shorter = |best: &InTube| motion.duration() < best.time();
        if good && self.best.as_ref().is_none_or(shorter) {
            self.best = Some(InTube {
                motion: motion.clone(),
                rounds: self.rounds,
                deviation: check.deviation,
                limits: check.velocity.max(check.acceleration).max(check.jerk),
            });
        }
        good
    }

    /// The knots around a step that leaves the tube have to stay further inside.
    fn put_right(&self, check: &Check, places: &[Place], margins: &mut [f64]) {
        for (step, deviation) in check.of_steps.iter().enumerate() {
            for knot in [step, step + 1] {
                let radius = self.course.legs[places[knot].leg].radius;
                let more = (deviation - 1.0).max(0.0) * radius;
                margins[knot] = (margins[knot] + more).min(GREATEST_MARGIN * radius);
            }
        }
    }
}

/// The vertices that are looked after, with when they were passed by.
fn looked_after(turns: &[bool], passes: &[Pass]) -> Vec<(usize, Pass)> {
    let vertices = (1..).zip(passes).zip(turns);
    vertices
        .filter_map(|((vertex, pass), turns)| turns.then_some((vertex, *pass)))
        .collect()
}
