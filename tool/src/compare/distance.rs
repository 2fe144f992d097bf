//! Distance between the executed and the programmed path, both ways, and against the tolerance.

use crate::host::recording::{Sample, moves, step};
use crate::layer::judged::{Around, BESIDE, REACH, judged, tolerance, wider, with_merging};
use crate::layer::program::{Operation, Piece, Program, Shape};
use crate::path::Position;
use crate::path::between::{around, way};
use crate::path::exceeded::is_beyond;
use crate::path::segment::{Segment, largest_difference};
use serde::Serialize;
use std::collections::HashSet;
use std::ops::Range;

/// Moves on each side of the one that runs in which the path is looked for.
const NEIGHBOURS: usize = 2;

/// Pieces on each side, at most.
const MOST_PIECES: usize = 20_000;

/// Distance of points in which a programmed piece is looked at, mm or degrees.
const SPACING: f64 = 0.1;

/// So near to the chord of a cycle nothing is gained by how the machine went between its ends, mm or degrees.
const NOTHING_MISSED: f64 = 1e-6;

/// The largest distance found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Distance {
    /// mm (or degrees of rotary axes).
    pub largest: f64,
    /// Line of the program there.
    pub line: i32,
    /// The largest ratio to the tolerance; `None` where no tolerance was in force at all.
    pub ratio: Option<f64>,
    /// Line of the program there.
    pub ratio_line: i32,
    /// The largest distance in exact path and exact stop.
    pub exact: Option<f64>,
    /// Somewhere it is more than 1 % and a micrometre beyond the tolerance.
    pub exceeds: bool,
}

impl Distance {
    fn note(&mut self, path: &Path, piece: usize, distance: f64) {
        let line = path.pieces[piece].line;
        if distance > self.largest || distance.is_nan() {
            self.largest = distance;
            self.line = line;
        }
        match path.allowed(piece) {
            Some(tolerance) if tolerance > 0.0 => {
                let ratio = distance / tolerance;
                self.exceeds |= is_beyond(distance, tolerance);
                if self.ratio.is_none_or(|worst| ratio > worst) {
                    self.ratio = Some(ratio);
                    self.ratio_line = line;
                }
            }
            Some(_) => {
                self.exact = Some(self.exact.unwrap_or(0.0).max(distance));
                self.exceeds |= is_beyond(distance, 0.0);
            }
            None => {}
        }
    }
}

/// A path to compare with.
pub(crate) struct Path<'a> {
    pieces: &'a [Piece],
    /// First and last piece of each move.
    ranges: Vec<(usize, usize)>,
    /// Length before each piece, and at the end.
    before: Vec<f64>,
    all_axes: bool,
    /// Moves that tap.
    taps: HashSet<usize>,
}

impl<'a> Path<'a> {
    /// The path as programmed.
    pub(crate) fn programmed(program: &'a Program) -> Path<'a> {
        Path::new(program, &program.programmed, program.ranges.clone())
    }

    /// The path as it was handed to the planner: after merging.
    pub(crate) fn handed(program: &'a Program) -> Path<'a> {
        let ranges = (0..program.handed.len())
            .map(|index| (index, index))
            .collect();
        Path::new(program, &program.handed, ranges)
    }

    fn new(program: &Program, pieces: &'a [Piece], ranges: Vec<(usize, usize)>) -> Path<'a> {
        let mut before = vec![0.0];
        let mut length = 0.0;
        for piece in pieces {
            let segment = &piece.segment;
            length += segment
                .length
                .max(largest_difference(&segment.start, &segment.end));
            before.push(length);
        }
        Path {
            pieces,
            ranges,
            before,
            all_axes: program.other_axes,
            taps: taps(program),
        }
    }

    /// How far a position is from a piece. Beyond the ends of a tap the machine follows its spindle while that turns back.
    fn distance(&self, piece: &Piece, sample: &Sample) -> f64 {
        let runs = || usize::try_from(sample.id).ok() == Some(piece.move_index + 1);
        let segment = match self.taps.contains(&piece.move_index) && runs() {
            true => &piece.segment.beyond_both_ends(),
            false => &piece.segment,
        };
        segment.deviation(&sample.position, self.all_axes).0
    }

    fn is_empty(&self) -> bool {
        self.pieces.is_empty() || self.ranges.is_empty()
    }

    /// First and last piece of the move that the module says it runs.
    fn pieces_of(&self, sample: &Sample) -> Option<(usize, usize)> {
        let index = usize::try_from(sample.id).ok()?.checked_sub(1)?;
        self.ranges.get(index).copied()
    }

    /// Near a piece its own tolerance holds, at its start that of the one before: `Some(0)` in exact modes, `None` without P.
    fn allowed(&self, index: usize) -> Option<f64> {
        let pieces = [index, index.saturating_sub(1)];
        let [own, before] = pieces.map(|index| tolerance(&self.pieces[index]));
        // A corner reaches over several moves, and the piece that is nearest need not be one that was merged.
        let beside = index.saturating_sub(BESIDE)..(index + BESIDE + 1).min(self.pieces.len());
        let merged = self.pieces[beside].iter().map(|piece| piece.merged_within);
        let merged = merged.fold(0.0, f64::max);
        wider(own, before).map(|tolerance| with_merging(tolerance, merged))
    }

    /// The piece by which a position is judged, and how far it is from that.
    fn judged(&self, sample: &Sample, (distance, piece): (f64, usize)) -> (usize, f64) {
        let nearest = (piece, distance);
        match self.pieces_of(sample) {
            Some((first, last)) => judged(&Place { path: self, sample }, [first, last], nearest),
            None => nearest,
        }
    }

    /// Pieces near a move: its neighbours, and as far as `reach` goes.
    fn window(&self, move_index: usize, reach: f64) -> (usize, usize) {
        let last = self.ranges.len() - 1;
        let most = self.pieces.len() - 1;
        let middle = self.ranges[move_index.min(last)];
        let mut low = self.ranges[move_index.saturating_sub(NEIGHBOURS).min(last)].0;
        let mut high = self.ranges[(move_index + NEIGHBOURS).min(last)].1.min(most);
        let lowest = low.saturating_sub(MOST_PIECES);
        while low > lowest && self.before[middle.0] - self.before[low] < reach {
            low -= 1;
        }
        let highest = (high + MOST_PIECES).min(most);
        while high < highest && self.before[high + 1] - self.before[middle.1 + 1] < reach {
            high += 1;
        }
        (low, high)
    }

    fn reach(&self, piece: usize, travel: f64) -> f64 {
        REACH * self.allowed(piece).unwrap_or(0.0) + 3.0 * travel
    }
}

/// Where the machine is, on the path that it is compared with.
struct Place<'a> {
    path: &'a Path<'a>,
    sample: &'a Sample,
}

impl Around for Place<'_> {
    fn count(&self) -> usize {
        self.path.pieces.len()
    }

    fn piece(&self, index: usize) -> Option<&Piece> {
        self.path.pieces.get(index)
    }

    fn distance(&self, index: usize) -> Option<f64> {
        let piece = self.piece(index)?;
        Some(self.path.distance(piece, self.sample))
    }

    fn allowed(&self, index: usize) -> Option<f64> {
        self.path.allowed(index)
    }

    fn merged(&self, index: usize) -> f64 {
        self.piece(index).map_or(0.0, |piece| piece.merged_within)
    }

    fn length(&self, pieces: Range<usize>) -> f64 {
        self.path.before[pieces.end] - self.path.before[pieces.start]
    }

    fn admits(&self, distance: f64, tolerance: Option<f64>) -> bool {
        tolerance.is_none_or(|tolerance| !is_beyond(distance, tolerance))
    }
}

/// The moves that tap.
fn taps(program: &Program) -> HashSet<usize> {
    let moves = program.operations.iter();
    let tap = |operation: &Operation| match operation {
        Operation::Move(a_move) if a_move.shape == Shape::Tap => Some(a_move.index),
        _ => None,
    };
    moves.filter_map(tap).collect()
}

/// The executed path, matched with a path to compare with.
pub(crate) struct Matched<'a> {
    samples: &'a [Sample],
    /// For each sample the piece nearest to it.
    pieces: Vec<usize>,
}

/// Distance of every executed position from the path.
pub(crate) fn executed_to_path<'a>(path: &Path, samples: &'a [Sample]) -> (Distance, Matched<'a>) {
    let mut distance = Distance::default();
    let mut pieces = Vec::with_capacity(samples.len());
    if path.is_empty() {
        return (distance, Matched { samples, pieces });
    }
    let mut last = 0;
    for (k, sample) in samples.iter().enumerate() {
        let travel = step(samples, k);
        if k > 0 && !moves(&travel) {
            pieces.push(last);
            continue;
        }
        let reach = path.reach(last, largest_difference(&travel, &[0.0; 9]));
        let mut best = (f64::INFINITY, last);
        let mut look = |from: usize, to: usize| {
            for (index, piece) in path.pieces.iter().enumerate().take(to + 1).skip(from) {
                let found = path.distance(piece, sample);
                if found < best.0 {
                    best = (found, index);
                }
            }
        };
        // Around where it was, in case the module's numbers mislead.
        let most = path.pieces.len() - 1;
        let (near_low, near_high) = (
            last.saturating_sub(NEIGHBOURS),
            (last + NEIGHBOURS).min(most),
        );
        look(near_low, near_high);
        if let Some(index) = usize::try_from(sample.id)
            .ok()
            .and_then(|id| id.checked_sub(1))
        {
            let (low, high) = path.window(index, reach);
            if low < near_low {
                look(low, high.min(near_low - 1));
            }
            if high > near_high {
                look(low.max(near_high + 1), high);
            }
        }
        last = best.1;
        pieces.push(last);
        let (piece, found) = path.judged(sample, best);
        let found = if found.is_finite() { found } else { f64::NAN };
        distance.note(path, piece, found);
    }
    (distance, Matched { samples, pieces })
}

/// Distance of the points of the path from the executed path: it grows where moves are left out.
pub(crate) fn path_to_executed(path: &Path, matched: &Matched) -> Distance {
    let mut distance = Distance::default();
    let samples = matched.samples;
    if path.is_empty() || samples.is_empty() {
        return distance;
    }
    let (first, last, travelled, longest) = extents(path, matched);
    let mut guess = 0;
    for (index, piece) in path.pieces.iter().enumerate() {
        let reach = path.reach(index, longest);
        let (low, high) = path.window(piece.move_index, reach);
        let from = first[low].saturating_sub(1);
        let to = (last[high] + 1).min(samples.len() - 1).max(from);
        let segment = &piece.segment;
        let size = segment
            .length
            .max(largest_difference(&segment.start, &segment.end));
        let count = ((size / SPACING).ceil() as usize).clamp(2, 100);
        for part in usize::from(index > 0)..=count {
            let point = segment.point(part as f64 / count as f64);
            let chord = |k: usize| {
                let start = k.checked_sub(1).map_or([0.0; 9], |k| samples[k].position);
                Segment::line(start, samples[k].position)
                    .deviation(&point, path.all_axes)
                    .0
            };
            let mut at = guess.clamp(from, to);
            let mut best = chord(at);
            let mut k = from;
            while k <= to {
                let found = chord(k);
                if found < best {
                    best = found;
                    at = k;
                }
                // Nothing is nearer before the path has come nearer by the difference.
                let needed = travelled[k] + (found - best);
                k = if found > best {
                    let next = travelled[k + 1..=to].partition_point(|&length| length < needed);
                    k + 1 + next
                } else {
                    k + 1
                };
            }
            guess = at;
            if best > NOTHING_MISSED {
                best = best.min(nearest_on_way(samples, at, &point, path.all_axes));
            }
            distance.note(path, index, best);
        }
    }
    distance
}

/// How far a point is from the way around a sample: the machine may turn back there, beyond all samples.
fn nearest_on_way(samples: &[Sample], at: usize, point: &Position, all_axes: bool) -> f64 {
    let lines = way(around(samples.len(), at, |at| samples[at].position));
    let distances = lines.map(|[from, to]| Segment::line(from, to).deviation(point, all_axes).0);
    distances.fold(f64::INFINITY, f64::min)
}

/// First sample that may belong to each piece or a later one, last that may belong to it or an
/// earlier one; length executed up to each sample, and the longest step.
fn extents(path: &Path, matched: &Matched) -> (Vec<usize>, Vec<usize>, Vec<f64>, f64) {
    let samples = matched.samples;
    let count = path.pieces.len();
    let mut first = vec![samples.len() - 1; count];
    let mut last = vec![0; count];
    let mut travelled = Vec::with_capacity(samples.len());
    let (mut length, mut longest) = (0.0, 0.0);
    for (k, &piece) in matched.pieces.iter().enumerate() {
        // Where a path runs back over itself, what runs there is as near to the pieces on the way out, and those on the way
        // back may have no sample: the move that the module says it runs counts as well.
        let (earliest, latest) = path.pieces_of(&samples[k]).unwrap_or((piece, piece));
        let (earliest, latest) = (earliest.min(piece), latest.max(piece));
        first[latest] = first[latest].min(k);
        last[earliest] = last[earliest].max(k);
        let travel = largest_difference(&step(samples, k), &[0.0; 9]);
        longest = f64::max(longest, travel);
        length += travel;
        travelled.push(length);
    }
    for index in (1..count).rev() {
        first[index - 1] = first[index - 1].min(first[index]);
    }
    for index in 1..count {
        last[index] = last[index].max(last[index - 1]);
    }
    (first, last, travelled, longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canon::call::Call;
    use crate::layer::{LayerSettings, lay};

    fn program() -> Program {
        // G61, then G64 P0.5 with a short step and the way back.
        let text = "RATE 600\nTERM 1 0\nFEED 1 20 0 0 0 0 0 0 0 0\nTERM 3 0.5\n\
                    FEED 2 20 0 0.02 0 0 0 0 0 0\nFEED 3 5 0 0.02 0 0 0 0 0 0";
        let calls = text.lines().map(|line| Call::parse(line).expect("a call"));
        lay(&calls.collect::<Vec<_>>(), &LayerSettings::default())
    }

    /// The distance from the program of a machine that is beside the middle of a move, while this one runs.
    fn beside(program: &Program, running: usize, off: f64) -> Distance {
        let mut position = program.handed[running].segment.point(0.5);
        position[2] += off;
        let sample = Sample {
            position,
            scale: 1.0,
            id: running as i32 + 1,
            queued: 1,
            run: 0,
            flags: 0,
        };
        executed_to_path(&Path::programmed(program), &[sample]).0
    }

    #[test]
    fn a_place_is_judged_by_the_move_that_runs() {
        let program = program();
        let found = beside(&program, 2, -0.25);
        assert!(!found.exceeds && found.line == 3, "{found:?}");
        // The line to come has nothing to do with it.
        assert!(beside(&program, 0, -0.25).exceeds);
        assert!(beside(&program, 2, -0.6).exceeds);
    }

    #[test]
    fn a_tip_between_two_cycles_is_not_missed() {
        let text =
            "RATE 600\nTERM 3 0.002\nFEED 1 20 0.02 0 0 0 0 0 0 0\nFEED 2 0 0.04 0 0 0 0 0 0 0";
        let calls = text.lines().map(|line| Call::parse(line).expect("a call"));
        let program = lay(&calls.collect::<Vec<_>>(), &LayerSettings::default());
        // 8000 mm/s2, 2 ms: 4 um are taken off in half a cycle.
        let sample = |n: i32| {
            let x = (20.0 - 4e-3 * f64::from(2 * n + 1).powi(2)).max(0.0);
            let y = if n < 0 { 1e-3 * x } else { 0.04 - 1e-3 * x };
            Sample {
                position: [x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                scale: 1.0,
                id: 1 + i32::from(n >= 0),
                queued: 1,
                run: 0,
                flags: 0,
            }
        };
        let samples: Vec<Sample> = (-40..40).map(sample).collect();
        let path = Path::programmed(&program);
        let missed = path_to_executed(&path, &executed_to_path(&path, &samples).1);
        assert!(missed.largest < 1e-3 && !missed.exceeds, "{missed:?}");
    }
}
