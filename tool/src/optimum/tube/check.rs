//! What a motion keeps, looked at between its steps, too.

use super::course::{Course, Place};
use super::motion::{ACCELERATION_WEIGHTS, JERK_WEIGHTS, Motion, velocity_weights};
use crate::optimum::limits::PathLimits;
use crate::path::pieces::{Point, distance_to_segment};

/// So often a step is looked at.
const PARTS: usize = 8;

/// When a motion goes by a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pass {
    pub step: usize,
    /// Of the step, 0 to 1.
    pub share: f64,
    /// Distance over the radius.
    pub deviation: f64,
}

/// The greatest values of a motion, each over what is allowed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Check {
    /// Off the course, and of its vertices off the motion.
    pub deviation: f64,
    pub velocity: f64,
    pub acceleration: f64,
    /// 0 without a limit.
    pub jerk: f64,
    /// Off the course within each step.
    pub of_steps: Vec<f64>,
    /// By vertex 1 and so on.
    pub passes: Vec<Pass>,
}

impl Check {
    /// `places` belong to the knots of the motion.
    pub(super) fn of(
        motion: &Motion,
        course: &Course,
        places: &[Place],
        limits: &PathLimits,
    ) -> Check {
        let mut check = Check {
            passes: passes(motion, course, places),
            ..Check::default()
        };
        for step in 0..motion.steps() {
            let (from, to) = (places[step], places[step + 1]);
            let mut deviation: f64 = 0.0;
            for part in 0..=PARTS {
                let share = part as f64 / PARTS as f64;
                let point = motion.position(step, share);
                deviation = deviation.max(course.deviation(point, from, to));
                let speed = speed(motion, step, share, limits);
                let along = speed.0 / fastest(course, places, step);
                check.velocity = check.velocity.max(along).max(speed.1);
            }
            check.of_steps.push(deviation);
            check.deviation = check.deviation.max(deviation);
            let a = motion.weighted(step, &ACCELERATION_WEIGHTS);
            let j = motion.weighted(step, &JERK_WEIGHTS);
            let (square, cube) = (motion.step.powi(2), motion.step.powi(3));
            for axis in 0..3 {
                let acceleration = a[axis].abs() / square / limits.acceleration[axis];
                check.acceleration = check.acceleration.max(acceleration);
                check.jerk = check.jerk.max(j[axis].abs() / cube / limits.jerk[axis]);
            }
        }
        let missed = check.passes.iter().map(|pass| pass.deviation);
        check.deviation = missed.fold(check.deviation, f64::max);
        check
    }

    /// The greatest of them.
    pub(super) fn worst(&self) -> f64 {
        let limits = self.velocity.max(self.acceleration).max(self.jerk);
        limits.max(self.deviation)
    }
}

/// The greatest speed of the program in a step and those beside it: where it changes, it does so between two knots.
fn fastest(course: &Course, places: &[Place], step: usize) -> f64 {
    let (from, to) = (step.saturating_sub(1), (step + 2).min(places.len() - 1));
    let legs = &course.legs[places[from].leg..=places[to].leg];
    legs.iter().map(|leg| leg.speed).fold(0.0, f64::max)
}

/// Speed, mm/s, and the greatest velocity of an axis over its limit.
fn speed(motion: &Motion, step: usize, share: f64, limits: &PathLimits) -> (f64, f64) {
    let velocity = motion
        .weighted(step, &velocity_weights(share))
        .map(|part| part / motion.step);
    let square: f64 = velocity.iter().map(|part| part * part).sum();
    let axes = velocity.iter().zip(&limits.velocity);
    let ratio = axes.map(|(part, limit)| part.abs() / limit);
    (square.sqrt(), ratio.fold(0.0, f64::max))
}

/// When the motion is nearest to each vertex, around where it goes from one leg to the next.
pub(super) fn passes(motion: &Motion, course: &Course, places: &[Place]) -> Vec<Pass> {
    (1..course.legs.len())
        .map(|vertex| {
            let knot = places.partition_point(|place| place.leg < vertex);
            let steps = knot.saturating_sub(2)..(knot + 1).min(motion.steps());
            pass(
                motion,
                course.legs[vertex].start,
                course.radius_at(vertex),
                steps,
            )
        })
        .collect()
}

fn pass(motion: &Motion, vertex: Point, radius: f64, steps: std::ops::Range<usize>) -> Pass {
    let mut best = Pass {
        step: steps.start,
        share: 0.0,
        deviation: f64::INFINITY,
    };
    for step in steps {
        for part in 0..PARTS {
            let at = |part: usize| part as f64 / PARTS as f64;
            let (from, to) = (at(part), at(part + 1));
            let [start, end] = [from, to].map(|share| motion.position(step, share));
            let (far, along) = distance_to_segment(vertex, start, end);
            if far / radius < best.deviation {
                best = Pass {
                    step,
                    share: from + along * (to - from),
                    deviation: far / radius,
                };
            }
        }
    }
    best
}
