//! The least time on the path that a module executed.

use super::against_optimum::LeastTime;
use super::progress::Progress;
use super::rests::{exact_stop_near, is_slow};
use crate::host::job::Job;
use crate::host::recording::{DONE, Recording, Sample, WAITING, moves, step};
use crate::layer::program::{Feeds, Operation, Piece, Program};
use crate::optimum::{
    Boundary, ExecutedPath, Grid, PathLimits, PathSample, SpeedCap, corners, least_time, spacing,
    topp_ra,
};
use crate::path::Position;
use std::array::from_fn;
use std::ops::Range;

/// Less travel than this does not count, mm or degrees (LinuxCNC's own limit).
const LEAST_TRAVEL: f64 = 1e-7;

impl LeastTime {
    /// Measures a run that came to its end, between the samples `range`.
    pub(crate) fn of(
        recording: &Recording,
        program: &Program,
        job: &Job,
        range: (usize, usize),
        progress: &Progress,
    ) -> LeastTime {
        let samples = &recording.samples;
        let takes_jerk = recording.takes_jerk;
        let limits = PathLimits::new(job.bounds(takes_jerk), job.joint_bounds(takes_jerk));
        let handed_over = recording.adds.len() as f64 / job.adds_per_cycle.max(1) as f64;
        let mut found = LeastTime {
            supply: (handed_over - range.0 as f64).max(0.0) * job.period,
            ..LeastTime::default()
        };
        let waited = (range.0..=range.1)
            .filter(|&k| samples[k].flags & WAITING != 0 && !moves(&step(samples, k)))
            .count();
        found.executed = (range.1 - range.0 + 1 - waited) as f64 * job.period;
        let speeds = speeds(job);
        let followers = job.with_spindle();
        for stretch in stretches(samples, program, job, range) {
            let path: Vec<PathSample> = stretch
                .clone()
                .map(|k| path_sample(samples, program, (job, &speeds), k))
                .collect();
            found.stretches += 1;
            let ids = stretch.clone().filter_map(|k| k.checked_sub(1));
            let follows =
                ids.filter_map(|k| usize::try_from(samples.get(k)?.id).ok()?.checked_sub(1));
            if follows
                .into_iter()
                .any(|index| followers.get(index) == Some(&true))
            {
                let run = (path.len() - 1) as f64 * job.period;
                found.time += run;
                found.without_jerk_limit += run;
                found.with_spindle += 1;
            } else {
                found.add(&path, &limits, job.period);
            }
            progress.optimum_done((stretch.end - range.0) as f64 / (range.1 + 2 - range.0) as f64);
        }
        let bound = found.time.max(found.supply);
        found.limited_by_supply = found.supply > found.time;
        found.ratio = found.executed / bound;
        found
    }

    fn add(&mut self, path: &[PathSample], limits: &PathLimits, period: f64) {
        let mut cuts = corners(path, &limits.velocity);
        cuts.push(path.len() - 1);
        let mut from = 0;
        for to in cuts {
            let piece = &path[from..=to];
            let run = (to - from) as f64 * period;
            match optimum(piece, limits, period) {
                Ok((time, bound)) => {
                    self.time += time;
                    self.without_jerk_limit += bound;
                }
                Err(problem) => {
                    self.time += run;
                    self.without_jerk_limit += run;
                    self.not_solved += 1;
                    let at = piece.first().map_or([0.0; 9], PathSample::axes);
                    self.problem
                        .get_or_insert(format!("{problem} from {at:?} in {run} s"));
                }
            }
            from = to;
        }
    }
}

/// Least time with and without the limit of jerk.
fn optimum(piece: &[PathSample], limits: &PathLimits, period: f64) -> Result<(f64, f64), String> {
    let Some(path) = ExecutedPath::new(piece, period, &limits.velocity) else {
        return Err("too few positions".to_owned());
    };
    let rests = (Boundary::Rest, Boundary::Rest);
    let spacing = spacing(piece.len() as f64 * period);
    let grid = Grid::new(&path, limits, (0.0, path.end()), rests, spacing);
    let bound = topp_ra(&grid, limits).ok_or("no motion keeps the limits of acceleration")?;
    if !limits.limit_jerk() {
        return Ok((bound, bound));
    }
    let optimum = least_time(&grid, limits).map_err(|problem| problem.to_string())?;
    Ok((optimum.time, bound))
}

/// Samples between standstills that the program asks for: from one at rest to the next.
///
/// A range counts positions: number k is the position after cycle k - 1, number 0 the origin.
fn stretches(
    samples: &[Sample],
    program: &Program,
    job: &Job,
    (first, last): (usize, usize),
) -> Vec<Range<usize>> {
    let slow = |k: usize| is_slow(&step(samples, k), &job.limits, job.period);
    let mut stretches = Vec::new();
    let mut from = first;
    let mut k = first;
    while k <= last && slow(k) {
        k += 1;
    }
    while k <= last {
        if !slow(k) {
            k += 1;
            continue;
        }
        let begin = k;
        while k <= last && slow(k) {
            k += 1;
        }
        if k > last {
            break;
        }
        let waits = (begin..k).any(|k| samples[k].flags & (WAITING | DONE) != 0);
        let stops =
            (begin..k).any(|k| exact_stop_near(program, samples[k].id, &samples[k].position));
        if waits || stops {
            // Position numbers: the slowest cycle lies between both.
            let still: Vec<usize> = (begin..k).filter(|&k| !moves(&step(samples, k))).collect();
            let (end, start) = match (still.first(), still.last()) {
                (Some(&a), Some(&b)) => (a, b + 1),
                _ => {
                    let slowest = (begin..k)
                        .min_by(|&a, &b| travel(samples, a).total_cmp(&travel(samples, b)));
                    let slowest = slowest.unwrap_or(begin);
                    (slowest + 1, slowest + 1)
                }
            };
            stretches.push(from..end + 1);
            from = start;
        }
    }
    stretches.push(from..last + 2);
    stretches
}

fn travel(samples: &[Sample], k: usize) -> f64 {
    step(samples, k).iter().map(|part| part * part).sum()
}

fn path_sample(
    samples: &[Sample],
    program: &Program,
    (job, speeds): (&Job, &[f64]),
    number: usize,
) -> PathSample {
    let at = |position: &Position, cap: SpeedCap| {
        let joints = job.joints.as_ref().map(|joints| joints.at(position));
        PathSample::new(position, joints.as_ref(), cap)
    };
    let Some(sample) = number.checked_sub(1).and_then(|k| samples.get(k)) else {
        return at(&[0.0; 9], SpeedCap::None);
    };
    let index = usize::try_from(sample.id)
        .ok()
        .and_then(|id| id.checked_sub(1));
    let cap = index.and_then(|index| {
        let piece = program.handed.get(index)?;
        Some(asked(piece, *speeds.get(index)?))
    });
    at(&sample.position, cap.unwrap_or(SpeedCap::None))
}

/// What each move asks for, mm/s or degrees per second.
fn speeds(job: &Job) -> Vec<f64> {
    let mut feeds = Feeds::BEGINNING;
    let moves = job
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Move(a_move) => {
                let [feed, greatest] = feeds.of(a_move);
                Some(feed.min(greatest))
            }
            _ => None,
        });
    moves.map(|speed| speed.min(job.velocity_limit)).collect()
}

/// What a move with this `speed` says: F counts X Y Z, else U V W, else A B C.
fn asked(piece: &Piece, speed: f64) -> SpeedCap {
    let segment = &piece.segment;
    let travel: [f64; 9] = from_fn(|axis| segment.end[axis] - segment.start[axis]);
    let moves = |first: usize| {
        let axes = &travel[first..first + 3];
        axes.iter().any(|travel| travel.abs() > LEAST_TRAVEL)
    };
    let counted = |first_axis: usize| SpeedCap::Counted { first_axis, speed };
    if segment.arc.is_some() {
        return counted(0);
    }
    let groups: Vec<usize> = [0, 6, 3]
        .into_iter()
        .filter(|&first| moves(first))
        .collect();
    match groups[..] {
        [first] => counted(first),
        [first, ..] => {
            let counts = &travel[first..first + 3];
            let length = counts.iter().map(|part| part * part).sum::<f64>().sqrt();
            SpeedCap::Along(travel.map(|travel| travel * speed / length))
        }
        [] => counted(3),
    }
}
