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

use super::limits::AxisLimits;
use crate::path::pieces::Point;
use check::{Check, Pass, passes};
use clarabel::solver::SolverStatus;
use course::{Course, Place};
use matching::places;
use motion::{LEAST_STEPS, Motion};
use round::Round;

/// Rounds at most, with each number of steps.
const MOST_ROUNDS: usize = 14;

/// The rounds end when one of them gains less than this share of the time: with few steps, and with all.
const CONVERGED: [f64; 2] = [2e-3, 2e-4];

/// The first rounds have steps so much longer, where there are enough.
const LONGER: usize = 3;

/// Fewer steps than this are not made longer, twice as many would be.
const ENOUGH: usize = 100;

/// A motion counts if nothing is exceeded by more than this.
const EXCEEDED: f64 = 1.002;

/// Vertices where the course turns by more than this are looked after in every round; cosine.
const SHARP: f64 = 0.5;

/// Others where the motion went by at more than this share of the radius.
const MISSED: f64 = 0.98;

/// Knots stay no further inside than this share of the radius.
const GREATEST_MARGIN: f64 = 0.5;

/// The shortest motion that was found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InTube {
    /// s.
    pub time: f64,
    /// Duration of its steps, s.
    pub step: f64,
    /// Convex programs that were solved.
    pub rounds: usize,
    /// Its greatest distance from the program, or of the program from it, over the tolerance.
    pub deviation: f64,
    /// Its greatest velocity, acceleration or jerk over the limit.
    pub limits: f64,
}

/// Why there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum NoTube {
    /// Nothing to move along.
    #[error("the machine does not move")]
    NoMotion,
    /// No round ended with a motion that keeps everything.
    #[error("no motion was found that keeps the limits and the tolerance")]
    NotFound,
    /// The solver did not come to its end.
    #[error("the solver gave up ({0:?})")]
    Solver(SolverStatus),
}

/// The least time along `legs`, from rest to rest, with the limits of X Y Z in `limits`. It is looked for from what a
/// machine did: its positions, which are `period` seconds apart. `most_steps` (at least 12) bounds the steps, none of
/// which is shorter than the period.
pub(crate) fn least_time_in_tube(
    legs: &[Leg],
    positions: &[Point],
    period: f64,
    limits: &AxisLimits,
    most_steps: usize,
) -> Result<InTube, NoTube> {
    let course = Course::new(legs).ok_or(NoTube::NoMotion)?;
    if positions.len() < 2 {
        return Err(NoTube::NoMotion);
    }
    let steps = (positions.len() - 1).clamp(LEAST_STEPS, most_steps.max(LEAST_STEPS));
    let duration = (positions.len() - 1) as f64 * period;
    let few = steps / LONGER;
    let mut search = Search {
        course,
        limits: *limits,
        best: None,
        rounds: 0,
    };
    let mut motion = Motion::near(positions, duration, steps.min(few.max(ENOUGH)));
    if motion.steps() < steps {
        motion = search.rounds(motion, CONVERGED[0])?.resampled(steps);
        search.best = None;
    }
    search.rounds(motion, CONVERGED[1])?;
    search.best.ok_or(NoTube::NotFound)
}

/// The rounds so far.
struct Search {
    course: Course,
    limits: AxisLimits,
    best: Option<InTube>,
    rounds: usize,
}

impl Search {
    /// Rounds from a motion on until they gain less than `converged`; the last motion.
    fn rounds(&mut self, mut motion: Motion, converged: f64) -> Result<Motion, NoTube> {
        let mut places = places(&self.course, &motion.knots());
        let mut found = passes(&motion, &self.course, &places);
        let mut margins = vec![0.0; motion.steps() + 1];
        let mut sharp: Vec<bool> = (1..self.course.legs.len())
            .map(|vertex| self.course.cosine(vertex) < SHARP)
            .collect();
        for _ in 0..MOST_ROUNDS {
            let round = Round {
                course: &self.course,
                limits: &self.limits,
                motion: &motion,
                places: &places,
                margins: &margins,
                passes: &looked_after(&sharp, &found),
            };
            let next = round.solve().map_err(NoTube::Solver)?;
            self.rounds += 1;
            let gain = 1.0 - next.duration() / motion.duration();
            motion = next;
            places = self.places(&motion);
            let check = Check::of(&motion, &self.course, &places, &self.limits);
            let good = self.note(&motion, &check);
            self.put_right(&check, &places, &mut margins);
            for (sharp, pass) in sharp.iter_mut().zip(&check.passes) {
                *sharp |= pass.deviation > MISSED;
            }
            found = check.passes;
            if good && gain < converged {
                break;
            }
        }
        Ok(motion)
    }

    fn places(&self, motion: &Motion) -> Vec<Place> {
        places(&self.course, &motion.knots())
    }

    /// Keeps the motion if it is the best one so far; whether it keeps everything.
    fn note(&mut self, motion: &Motion, check: &Check) -> bool {
        let good = check.worst() <= EXCEEDED;
        let time = motion.duration();
        if good && self.best.as_ref().is_none_or(|best| time < best.time) {
            self.best = Some(InTube {
                time,
                step: motion.step,
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
fn looked_after(sharp: &[bool], passes: &[Pass]) -> Vec<(usize, Pass)> {
    let vertices = (1..).zip(passes).zip(sharp);
    vertices
        .filter_map(|((vertex, pass), sharp)| sharp.then_some((vertex, *pass)))
        .collect()
}
