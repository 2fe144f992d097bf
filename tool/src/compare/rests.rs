//! Rests in the middle of a program that neither the program nor the operator nor the supply of moves
//! explains.

use super::asked::{Asked, Coupling, asked};
use crate::canon::call::PathMode;
use crate::host::job::Job;
use crate::host::recording::{ABORTED, DONE, HELD, Recording, STARVED, Sample, WAITING, step};
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

/// Slower than this share of the speed that is asked for counts as a rest. One of a whole period that begins
/// and ends within periods takes half of the travel from one of them at least.
const REST: f64 = 0.5;

/// Counts the rests between the first and the last motion (`range`).
///
/// A rest is where no axis travels more in a cycle than it does from a standstill, with its full
/// acceleration or, where `jerk` limits it, its full jerk, and none half as fast as the slowest of the moves
/// there asks for: a slow feed is no rest. The program explains one at an exact stop, before a move that waits
/// for the spindle, in a tap, which turns back where the spindle does, at a corner into or out of exact path
/// mode or a thread, where it goes back nearly the way it came, and where a corner is so sharp for its
/// tolerance that no axis could take it faster than that.
pub(crate) fn rests(
    recording: &Recording,
    program: &Program,
    job: &Job,
    range: Option<(usize, usize)>,
) -> Rests {
    let mut rests = Rests::default();
    let Some((start, end)) = range else {
        return rests;
    };
    let samples = &recording.samples;
    let period = job.period;
    let run = Run {
        program,
        job,
        jerk: job.jerk_limits(recording.takes_jerk),
        asked: asked(job),
    };
    let slow = |k: usize| run.rests(&step(samples, k), &samples[k]);
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
        // A rest with a pause in its beginning or end belongs to the pause.
        let around = &samples[from.saturating_sub(1)..(k + 1).min(samples.len())];
        let explained = around
            .iter()
            .any(|sample| sample.flags & reasons != 0 || run.program_stops(sample));
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

/// What a run is judged by.
struct Run<'a> {
    program: &'a Program,
    job: &'a Job,
    /// Limits of the axes, 0 = none.
    jerk: [f64; 9],
    /// Of each move.
    asked: Vec<Asked>,
}

impl Run<'_> {
    /// Whether the machine rests, with this travel in the cycle that ends here.
    fn rests(&self, travel: &[f64; 9], sample: &Sample) -> bool {
        let period = self.job.period;
        let by_jerk = |(travel, &jerk): (&f64, &f64)| {
            jerk <= 0.0 || travel.abs() <= jerk * period.powi(3) / 6.0
        };
        let by_feed = REST * self.speed_near(sample) * period;
        is_slow(travel, &self.job.limits, period)
            && travel.iter().zip(&self.jerk).all(by_jerk)
            && travel.iter().all(|travel| travel.abs() <= by_feed)
    }

    /// The slowest that the running move and its neighbours ask for, with the override, mm/s or degrees per
    /// second: a planner brakes for the next one, and a blend has parts of two.
    fn speed_near(&self, sample: &Sample) -> f64 {
        let next = usize::try_from(sample.id).unwrap_or(0);
        let near = self
            .asked
            .iter()
            .take(next + 1)
            .skip(next.saturating_sub(2));
        let slowest = near.map(|asked| asked.speed).fold(f64::INFINITY, f64::min);
        slowest * sample.scale
    }

    /// The coupling of the move with this index.
    fn coupling(&self, index: usize) -> Coupling {
        self.asked
            .get(index)
            .map_or(Coupling::None, |asked| asked.coupling)
    }

    /// Whether the machine stops here in a tap, or for one of the junctions near this position.
    fn program_stops(&self, sample: &Sample) -> bool {
        let index = usize::try_from(sample.id)
            .ok()
            .and_then(|id| id.checked_sub(1));
        if index.is_some_and(|index| self.coupling(index) == Coupling::Tap) {
            return true;
        }
        junctions_near(self.program, sample.id).any(|(one, next)| {
            let far = largest_difference(&one.segment.end, &sample.position);
            let tolerance = one.tolerance.max(next.tolerance);
            // Without a tolerance the corner may be cut from the middle of the shorter move.
            let reach = if tolerance > 0.0 {
                2.0 * tolerance
            } else {
                0.5 * size(one).min(size(next))
            };
            far <= reach + 0.01 && self.junction_stops(one, next)
        })
    }

    fn junction_stops(&self, one: &Piece, next: &Piece) -> bool {
        if one.stops || one.mode == PathMode::ExactStop {
            return true;
        }
        let couplings = [one, next].map(|piece| self.coupling(piece.move_index));
        // It waits for the index at rest; a thread behind another one goes on with its count.
        if couplings == [Coupling::None, Coupling::Thread] {
            return true;
        }
        let turn = turn(one, next);
        // A move that is to be followed exactly, and to stop at its end, is so from its start on.
        let exact = |piece: &Piece| piece.mode != PathMode::Continuous;
        if exact(one) || exact(next) || couplings.contains(&Coupling::Thread) {
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
        let accelerations = self.job.limits.acceleration.iter().copied();
        let acceleration = accelerations.fold(f64::INFINITY, f64::min);
        (acceleration * radius).sqrt() < acceleration * self.job.period
    }
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
    use crate::host::job::tests::job;
    use crate::layer::{LayerSettings, lay};

    fn laid(text: &str) -> Program {
        let calls: Vec<Call> = text.lines().filter_map(Call::parse).collect();
        lay(&calls, &LayerSettings::default())
    }

    /// Goes to X1 in 10 ms, stands for 5 ms, and goes on to the second point in 10 ms.
    fn stop_between(mode: &str, second: [f64; 9]) -> (Recording, Program) {
        let [x, y, _, a, ..] = second;
        let program = laid(&format!(
            "{mode}\nRATE 6000\nFEED 1 1 0 0 0 0 0 0 0 0\nFEED 2 {x} {y} 0 {a} 0 0 0 0 0"
        ));
        let mut recording = Recording::default();
        for k in 1..=25 {
            let mut sample = Sample {
                id: if k <= 15 { 1 } else { 2 },
                scale: 1.0,
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

    /// Along X with these travels, mm, in a cycle each; the moves that run.
    fn along_x(travels: &[(i32, f64)]) -> Recording {
        let mut recording = Recording::default();
        let mut position = [0.0; 9];
        for &(id, travel) in travels {
            position[0] += travel;
            recording.samples.push(Sample {
                position,
                id,
                scale: 1.0,
                ..Sample::default()
            });
        }
        recording
    }

    /// With a period of 1 ms and 1000 mm/s2.
    fn found(recording: &Recording, program: &Program, jerk: [f64; 9]) -> Rests {
        let job = Job {
            jerk,
            events: Vec::new(),
            operations: program.operations.clone(),
            ..job()
        };
        let last = recording.samples.len() - 1;
        rests(recording, program, &job, Some((0, last)))
    }

    fn count(mode: &str, second: [f64; 9]) -> (usize, usize) {
        let (recording, program) = stop_between(mode, second);
        let rests = found(&recording, &program, [0.0; 9]);
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
            recording.takes_jerk = true;
            for (k, sample) in recording.samples.iter_mut().enumerate().skip(10) {
                sample.position[1] += creep * (k as f64 - 9.0).min(5.0);
            }
            found(&recording, &program, [jerk; 9]).count
        };
        // .4 mm/s: less than an acceleration of 1000 mm/s2 makes of a standstill in a period, more than
        // a jerk of 20,000 mm/s3 does.
        assert_eq!(rests(4e-4, 0.0), 1);
        assert_eq!(rests(4e-4, 20_000.0), 0);
        assert_eq!(rests(3e-6, 20_000.0), 1);
    }

    /// F20, a third of a mm/s: what the axes do in a period from a standstill is more.
    #[test]
    fn a_slow_feed_is_no_rest() {
        let program = laid(
            "TERM 3 0.1\nRATE 600\nFEED 1 1 0 0 0 0 0 0 0 0\nRATE 20\nFEED 2 2 0 0 0 0 0 0 0 0\n\
             RATE 600\nFEED 3 3 0 0 0 0 0 0 0 0",
        );
        let feed = 20.0 / 60.0 * 1e-3;
        let count = |middle: &[(i32, f64)]| {
            let fast = [1e-3, 2e-3, 1e-3].map(|travel| (1, travel));
            let on = [1e-3, 2e-3, 1e-3].map(|travel| (3, travel));
            let travels = [&fast, middle, &on].concat();
            let rests = found(&along_x(&travels), &program, [0.0; 9]);
            (rests.count, rests.cycles)
        };
        // the module may say a while that the move before it runs still
        let slow = [(1, feed), (1, feed), (2, feed), (2, feed), (2, feed)];
        assert_eq!(count(&slow), (0, 0));
        let stands = [(2, feed), (2, 0.0), (2, feed)];
        assert_eq!(count(&stands), (1, 1));
        let between_periods = [(2, feed), (2, 0.4 * feed), (2, 0.4 * feed), (2, feed)];
        assert_eq!(count(&between_periods), (1, 2));
    }

    /// At 1000 mm/s2 it stands for an instant on the border of two periods.
    #[test]
    fn a_stop_for_an_instant_is_a_rest() {
        let program = laid("TERM 3 0.1\nRATE 600\nFEED 1 9 0 0 0 0 0 0 0 0");
        let travels = [
            3.49e-3, 2.49e-3, 1.49e-3, 0.49e-3, 0.49e-3, 1.49e-3, 2.49e-3,
        ];
        let rests = found(&along_x(&travels.map(|t| (1, t))), &program, [0.0; 9]);
        assert_eq!((rests.count, rests.cycles), (1, 2));
    }

    #[test]
    fn a_thread_waits_for_the_index_and_a_tap_for_the_spindle() {
        let travels: Vec<(i32, f64)> = (1..=25)
            .map(|k| match k {
                1..=10 => (1, 0.1),
                11..=15 => (1, 0.0),
                _ => (2, 0.01),
            })
            .collect();
        let on = |between: &str, end: f64| {
            let program = laid(&format!(
                "SPINDLE 600 1\nTERM 3 0.1\nRATE 6000\nFEED 1 1 0 0 0 0 0 0 0 0\n{between}\n\
                 FEED 2 {end} 0 0 0 0 0 0 0 0"
            ));
            let rests = found(&along_x(&travels), &program, [0.0; 9]);
            (rests.count, rests.cycles)
        };
        assert_eq!(on("SYNC 1 0", 2.0), (0, 0), "into a thread");
        assert_eq!(on("SYNC 1 1", 2.0), (1, 5), "into a feed per turn");
        assert_eq!(on("SYNC 0 0", 2.0), (1, 5));

        let tap = laid("SPINDLE 600 1\nTERM 3 0.1\nSYNC 1 0\nTAP 1 1 0 0 0 0 0 0 0 0");
        let beyond: Vec<(i32, f64)> = [1e-2, 2e-2, 1e-2, 0.0, -1e-2, -2e-2]
            .into_iter()
            .map(|travel| (1, 10.0 * travel))
            .collect();
        assert_eq!(found(&along_x(&beyond), &tap, [0.0; 9]).count, 0);
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
            let program = laid(&format!(
                "TERM 3 0.1\nRATE 6000\nFEED 1 1 0 0 0 0 0 0 0 0\n{mode}\nFEED 2 1 1 0 0 0 0 0 0 0"
            ));
            let (recording, _) = stop_between("TERM 3 0.1", to(1.0, 1.0, 0.0));
            assert_eq!(
                found(&recording, &program, [0.0; 9]).count,
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
            let rests = found(&recording, &program, [0.0; 9]);
            assert_eq!(rests, Rests::default());
        }
    }
}
