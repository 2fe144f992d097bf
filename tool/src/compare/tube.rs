//! The least time in the tolerance tube of a program, found from what a module did.

use super::against_optimum::{InTheTube, LeastTime};
use crate::host::job::Job;
use crate::host::recording::{Recording, Sample};
use crate::layer::program::{Feeds, Operation, Piece, Program};
use crate::optimum::{Leg, PathLimits, least_time_in_tube};
use crate::path::pieces::Point;

/// An arc is taken as chords, as far from it as this share of its tolerance at most, by which the tube is narrower.
const SAGITTA: f64 = 0.005;

/// No chord turns by more than this, radians.
const GREATEST_TURN: f64 = 0.4;

impl InTheTube {
    /// Of an excerpt that came to its end between the samples `range`.
    pub(crate) fn of(
        recording: &Recording,
        program: &Program,
        job: &Job,
        range: (usize, usize),
        on_the_path: &LeastTime,
    ) -> InTheTube {
        let speeds = feeds(job);
        let legs: Vec<Leg> = program
            .handed
            .iter()
            .zip(&speeds)
            .flat_map(|(piece, &speed)| legs(piece, speed))
            .collect();
        let positions: Vec<Point> = (range.0..range.1 + 2)
            .map(|number| position(&recording.samples, number))
            .collect();
        let limits = PathLimits::new(job.bounds(recording.takes_jerk), None);
        match least_time_in_tube(&legs, &positions, job.period, &limits) {
            Ok(found) => InTheTube {
                time: Some(found.time()),
                ratio: Some(on_the_path.executed / found.time().max(on_the_path.supply)),
                step: Some(found.step()),
                rounds: Some(found.rounds),
                deviation: Some(found.deviation),
                limits: Some(found.limits),
                problem: None,
            },
            Err(problem) => InTheTube {
                problem: Some(problem.to_string()),
                ..InTheTube::default()
            },
        }
    }
}

/// In X Y Z: number k is the position after cycle k - 1, number 0 the origin.
fn position(samples: &[Sample], number: usize) -> Point {
    let sample = number.checked_sub(1).and_then(|k| samples.get(k));
    sample.map_or([0.0; 3], |sample| {
        let [x, y, z, ..] = sample.position;
        [x, y, z]
    })
}

/// The speed of the program in each move, mm/s: what the axes allow is looked at by itself.
fn feeds(job: &Job) -> Vec<f64> {
    let mut feeds = Feeds::BEGINNING;
    let moves = job
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Move(a_move) => Some(feeds.of(a_move)[0].min(job.velocity_limit)),
            _ => None,
        });
    moves.collect()
}

fn legs(piece: &Piece, speed: f64) -> Vec<Leg> {
    let segment = &piece.segment;
    let (chords, off) = match &segment.arc {
        None => (1.0, 0.0),
        Some(arc) => {
            let off = SAGITTA * piece.tolerance;
            let radius = arc.start_radius.max(arc.end_radius);
            let turn = 2.0 * (1.0 - off / radius).max(0.0).acos();
            ((arc.sweep / turn.min(GREATEST_TURN)).ceil().max(1.0), off)
        }
    };
    let point = |index: usize| -> Point {
        let position = segment.point(index as f64 / chords);
        [position[0], position[1], position[2]]
    };
    (0..chords as usize)
        .map(|index| Leg {
            start: point(index),
            end: point(index + 1),
            radius: piece.tolerance - off,
            speed,
        })
        .collect()
}
