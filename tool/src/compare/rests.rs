//! Rests in the middle of a program that neither the program nor the operator nor the supply of moves
//! explains.

use crate::canon::call::PathMode;
use crate::host::recording::{ABORTED, DONE, HELD, Recording, STARVED, WAITING, step};
use crate::layer::program::{Piece, Program};
use crate::machine::limits::Limits;
use crate::path::segment::{Segment, largest_difference};
use nalgebra::SVector;
use serde::Serialize;

/// A change of direction that needs no blending, radians.
const TANGENT: f64 = 0.02;

/// A change of direction that is a reversal, radians (170 degrees).
const REVERSAL: f64 = 2.967;

/// Rests of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Rests {
    /// How often the machine came to rest for no reason.
    pub count: usize,
    /// Cycles in which it stood.
    pub cycles: usize,
    /// When it happened first, s.
    pub first: Option<f64>,
    /// The first of them: numbers of the moves (from 1) and lines of the program.
    pub places: Vec<(i32, i32)>,
}

/// How many places are kept.
const MOST_PLACES: usize = 20;

/// Counts the rests between the first and the last motion (`range`).
///
/// A rest is where no axis travels more in a cycle than it does from a standstill, with its full
/// acceleration or, where `jerk` limits it (0 = none), its full jerk. The program explains one at an
/// exact stop, before a move that waits for the spindle, at a corner into or out of exact path mode,
/// where it goes back nearly the way it came, and where a corner is so sharp for its tolerance that no
/// axis could take it faster than that.
pub(crate) fn rests(
    recording: &Recording,
    program: &Program,
    limits: &Limits,
    jerk: &[f64; 9],
    period: f64,
    range: Option<(usize, usize)>,
) -> Rests {
    let mut rests = Rests::default();
    let Some((start, end)) = range else {
        return rests;
    };
    let samples = &recording.samples;
    let slow = |k: usize| {
        let travel = step(samples, k);
        let most = |jerk: f64| jerk * period.powi(3) / 6.0;
        let mut axes = travel.iter().zip(jerk);
        is_slow(&travel, limits, period)
            && axes.all(|(travel, &jerk)| jerk <= 0.0 || travel.abs() <= most(jerk))
    };
    // Where the motion begins and ends it is slow for a reason.
    let mut k = start;
    while k <= end && slow(k) {
        k += 1;
    }
    while k <= end {
        if !slow(k) {
            k += 1;
            continue;
        }
        let from = k;
        while k <= end && slow(k) {
            k += 1;
        }
        if k > end {
            break;
        }
        let reasons = HELD | DONE | WAITING | STARVED | ABORTED;
        let around = from.saturating_sub(1)..(k + 1).min(samples.len());
        let given = samples[around.clone()]
            .iter()
            .any(|sample| sample.flags & reasons != 0);
        // A rest with a pause in its beginning or end belongs to the pause.
        let explained = given
            || samples[around]
                .iter()
                .any(|sample| program_stops(program, limits, period, sample.id, &sample.position));
        if !explained {
            rests.count += 1;
            rests.cycles += k - from;
            rests.first.get_or_insert(from as f64 * period);
            if rests.places.len() < MOST_PLACES {
                rests.places.push(place(program, samples[from].id));
            }
        }
    }
    rests
}

/// Whether no axis travels more in a cycle than it does from a standstill with its full acceleration.
pub(crate) fn is_slow(travel: &[f64; 9], limits: &Limits, period: f64) -> bool {
    let most = |axis: usize| 0.5 * limits.acceleration[axis] * period * period;
    (0..9).all(|axis| travel[axis].abs() <= most(axis))
}

/// Whether the program asks for a standstill at this position: an exact stop, or a corner in exact
/// path mode, near the end of the move `id` or of one of its neighbours.
#[cfg(feature = "optimum")]
pub(crate) fn exact_stop_near(program: &Program, id: i32, position: &[f64; 9]) -> bool {
    /// At rest the machine is at the point itself.
    const NEAR: f64 = 1e-3;
    junctions_near(program, id).any(|(one, next)| {
        let stops = one.stops || one.mode == PathMode::ExactStop;
        let corner = one.mode == PathMode::ExactPath && turn(one, next) > TANGENT;
        (stops || corner) && largest_difference(&one.segment.end, position) <= NEAR
    })
}

/// The moves around the move `id`, each with the next one.
fn junctions_near(program: &Program, id: i32) -> impl Iterator<Item = (&Piece, &Piece)> {
    let index = usize::try_from(id).ok().and_then(|id| id.checked_sub(1));
    let from = index.map_or(usize::MAX, |index| index.saturating_sub(2));
    let pieces = program.handed.get(from..).unwrap_or_default();
    pieces.iter().zip(pieces.iter().skip(1)).take(5)
}

/// Angle between the end of a move and the start of the next, radians.
fn turn(one: &Piece, next: &Piece) -> f64 {
    direction(&one.segment, 1.0).angle(&direction(&next.segment, 0.0))
}

fn place(program: &Program, id: i32) -> (i32, i32) {
    let index = usize::try_from(id).ok().and_then(|id| id.checked_sub(1));
    let piece = index.and_then(|index| program.handed.get(index));
    (id, piece.map_or(0, |piece| piece.line))
}

/// Whether one of the junctions near this position makes the machine stop.
fn program_stops(
    program: &Program,
    limits: &Limits,
    period: f64,
    id: i32,
    position: &[f64; 9],
) -> bool {
    junctions_near(program, id).any(|(one, next)| {
        let far = largest_difference(&one.segment.end, position);
        let tolerance = one.tolerance.max(next.tolerance);
        // Without a tolerance the corner may be cut from the middle of the shorter move.
        let reach = if tolerance > 0.0 {
            2.0 * tolerance
        } else {
            0.5 * size(one).min(size(next))
        };
        far <= reach + 0.01 && junction_stops(one, next, limits, period)
    })
}

fn junction_stops(one: &Piece, next: &Piece, limits: &Limits, period: f64) -> bool {
    if one.stops || one.mode == PathMode::ExactStop {
        return true;
    }
    let turn = turn(one, next);
    // A move that is to be followed exactly, and to stop at its end, is so from its start on.
    let is_exact = next.mode == PathMode::ExactPath || next.mode == PathMode::ExactStop;
    if one.mode == PathMode::ExactPath || is_exact {
        return turn > TANGENT;
    }
    if turn > REVERSAL {
        return true;
    }
    // The radius of the circle in the corner that the tolerance allows, and half of the shorter move.
    let half = (turn / 2.0).cos();
    let by_length = 0.5 * size(one).min(size(next)) / (turn / 2.0).tan().max(1e-9);
    let by_tolerance = one.tolerance * half / (1.0 - half).max(1e-12);
    let radius = if one.tolerance > 0.0 {
        by_length.min(by_tolerance)
    } else {
        by_length
    };
    let acceleration = limits
        .acceleration
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    (acceleration * radius).sqrt() < acceleration * period
}

/// Length of a move, or its travel in the other axes where that is more.
fn size(piece: &Piece) -> f64 {
    let segment = &piece.segment;
    segment
        .length
        .max(largest_difference(&segment.start, &segment.end))
}

/// Direction of all axes, mm and degrees alike.
fn direction(segment: &Segment, u: f64) -> SVector<f64, 9> {
    let mut direction = SVector::from(segment.end) - SVector::from(segment.start);
    for (part, spatial) in direction.iter_mut().zip(segment.direction(u)) {
        *part = spatial;
    }
    direction
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canon::Call;
    use crate::host::recording::Sample;
    use crate::layer::{LayerSettings, lay};

    /// Goes to X1 in 10 ms, stands for 5 ms, and goes on to the second point in 10 ms.
    fn stop_between(mode: &str, second: [f64; 9]) -> (Recording, Program) {
        let [x, y, _, a, ..] = second;
        let text =
            format!("{mode}\nRATE 6000\nFEED 1 1 0 0 0 0 0 0 0 0\nFEED 2 {x} {y} 0 {a} 0 0 0 0 0");
        let calls: Vec<Call> = text.lines().filter_map(Call::parse).collect();
        let program = lay(&calls, &LayerSettings::default());
        let mut recording = Recording::default();
        for k in 1..=25 {
            let mut sample = Sample {
                id: if k <= 15 { 1 } else { 2 },
                ..Sample::default()
            };
            let share = f64::from((k - 15).max(0)) / 10.0;
            for (axis, coordinate) in sample.position.iter_mut().enumerate() {
                let first = if axis == 0 {
                    f64::from(k.min(10)) / 10.0
                } else {
                    0.0
                };
                let corner = if axis == 0 { 1.0 } else { 0.0 };
                *coordinate = first + share * (second[axis] - corner);
            }
            recording.samples.push(sample);
        }
        (recording, program)
    }

    fn count(mode: &str, second: [f64; 9]) -> (usize, usize) {
        let (recording, program) = stop_between(mode, second);
        let rests = rests(
            &recording,
            &program,
            &Limits::default(),
            &[0.0; 9],
            0.001,
            Some((0, 24)),
        );
        (rests.count, rests.cycles)
    }

    fn to(x: f64, y: f64, a: f64) -> [f64; 9] {
        [x, y, 0.0, a, 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    #[test]
    fn at_a_corner_that_could_be_rounded() {
        assert_eq!(count("TERM 3 0.1", to(1.0, 1.0, 0.0)), (1, 5));
        assert_eq!(
            count("TERM 3 0.1", to(1.0, 0.0, 1.0)),
            (1, 5),
            "into a rotary axis"
        );
        assert_eq!(
            count("TERM 2 0", to(2.0, 0.0, 0.0)),
            (1, 5),
            "straight on in exact path mode"
        );
    }

    #[test]
    fn slow_is_not_at_rest_where_jerk_is_limited() {
        let rests = |creep: f64, jerk: f64| {
            let (mut recording, program) = stop_between("TERM 3 0.1", to(1.0, 1.0, 0.0));
            for (k, sample) in recording.samples.iter_mut().enumerate().skip(10) {
                sample.position[1] += creep * (k as f64 - 9.0).min(5.0);
            }
            let jerk = [jerk; 9];
            let limits = Limits::default();
            rests(&recording, &program, &limits, &jerk, 0.001, Some((0, 24))).count
        };
        // .4 mm/s: less than an acceleration of 1000 mm/s2 makes of a standstill in a period, more than
        // a jerk of 20,000 mm/s3 does.
        assert_eq!(rests(4e-4, 0.0), 1);
        assert_eq!(rests(4e-4, 20_000.0), 0);
        assert_eq!(rests(3e-6, 20_000.0), 1);
    }

    #[test]
    fn where_the_program_makes_it_stop() {
        assert_eq!(count("TERM 1 0", to(2.0, 0.0, 0.0)), (0, 0), "exact stop");
        assert_eq!(
            count("TERM 2 0", to(1.0, 1.0, 0.0)),
            (0, 0),
            "a corner in exact path mode"
        );
        assert_eq!(
            count("TERM 3 0.1", to(0.0, 0.0, 0.0)),
            (0, 0),
            "back the same way"
        );
        for mode in ["TERM 2 0", "TERM 1 0"] {
            let text = format!(
                "TERM 3 0.1\nRATE 6000\nFEED 1 1 0 0 0 0 0 0 0 0\n{mode}\nFEED 2 1 1 0 0 0 0 0 0 0"
            );
            let calls: Vec<Call> = text.lines().filter_map(Call::parse).collect();
            let program = lay(&calls, &LayerSettings::default());
            let (recording, _) = stop_between("TERM 3 0.1", to(1.0, 1.0, 0.0));
            let (limits, range) = (Limits::default(), Some((0, 24)));
            assert_eq!(
                rests(&recording, &program, &limits, &[0.0; 9], 0.001, range).count,
                0,
                "into a move with {mode}"
            );
        }
    }

    #[test]
    fn where_supply_or_operator_explain_it() {
        for flag in [HELD, STARVED, WAITING] {
            let (mut recording, program) = stop_between("TERM 3 0.1", to(1.0, 1.0, 0.0));
            recording.samples[12].flags = flag;
            let rests = rests(
                &recording,
                &program,
                &Limits::default(),
                &[0.0; 9],
                0.001,
                Some((0, 24)),
            );
            assert_eq!(rests, Rests::default());
        }
    }
}
