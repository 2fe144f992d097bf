//! Slow moves among fast ones: the feed of no move is exceeded.

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, PERIOD, feed_move, with_room};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;
use proptest::prelude::*;

/// What the feed may be exceeded by.
const TOLERANCE: f64 = 1.001;

/// A line in XYZ.
#[derive(Clone, Debug)]
struct Line {
    displacement: [f64; 3],
    /// Millimetres per second.
    feed: f64,
    /// P, if it changes before the line.
    tolerance: Option<f64>,
}

/// Lines at 10 to 30 and at 1000 to 6000 mm/min, from micrometres to some millimetres; slow ones are
/// short.
fn any_line() -> impl Strategy<Value = Line> {
    let feed = prop_oneof![
        2 => 10.0..30.0f64,
        3 => 1000.0..6000.0f64,
        1 => (2.3..8.7f64).prop_map(f64::exp),
    ];
    let size = prop_oneof![2 => -7.0..-1.0f64, 1 => -1.0..2.0f64];
    let tolerance = prop_oneof![5 => Just(None), 1 => (-5.0..0.0f64).prop_map(|p| Some(p.exp()))];
    let direction = prop::array::uniform3(-1.0..1.0f64);
    (direction, 1usize..8, size, feed, tolerance).prop_map(
        |(direction, mask, size, feed, tolerance)| {
            let size = if feed < 40.0 { size.min(-1.5) } else { size };
            let along = |axis: usize| {
                if mask >> axis & 1 == 1 {
                    direction[axis] * size.exp()
                } else {
                    0.0
                }
            };
            Line {
                displacement: std::array::from_fn(along),
                feed: feed / 60.0,
                tolerance,
            }
        },
    )
}

/// Runs the lines with as many in the queue as it takes, and answers by how much a feed was exceeded at most:
/// the one reported by the speed reported, and in the mean of a period those of all moves that ran in it.
fn greatest_excess(limits: AxisLimits, tolerance: f64, lines: &[Line]) -> f64 {
    let mut machine = Machine::new(limits);
    machine.planner.set_velocity_limit(1e3);
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance });
    let mut waiting = (1..).zip(lines).peekable();
    let mut end = Axes::zeros();
    let (mut before, mut place, mut excess) = (1, Axes::zeros(), 0.0);
    loop {
        while machine.planner.status().queue_depth < 60
            && let Some((id, line)) = waiting.next()
        {
            if let Some(tolerance) = line.tolerance {
                machine
                    .planner
                    .set_termination(TerminationCondition::Continuous { tolerance });
            }
            for (coordinate, by) in end.iter_mut().zip(line.displacement) {
                *coordinate += by;
            }
            machine.planner.set_id(id);
            machine.line(end, &feed_move(line.feed)).expect("a line");
        }
        let status = machine.cycle();
        let running = if status.exec_id > 0 {
            status.exec_id as usize
        } else {
            lines.len()
        };
        let ran = &lines[before - 1..running];
        let fastest = ran.iter().map(|line| line.feed).fold(0.0, f64::max);
        let speed = (status.position - place).norm() / PERIOD;
        excess = f64::max(excess, speed / fastest);
        if status.active_depth > 0 {
            excess = f64::max(excess, status.current_velocity / lines[running - 1].feed);
        }
        (before, place) = (running, status.position);
        if status.done && waiting.peek().is_none() {
            return excess;
        }
    }
}

fn limits(jerk: f64) -> AxisLimits {
    AxisLimits {
        velocity: Axes::repeat(200.0),
        acceleration: Axes::repeat(2000.0),
        jerk: Axes::repeat(jerk),
    }
}

/// With caps at three places of an interval alone, one in fifteen of these exceeded a feed, by up to 12 %.
#[test]
fn slow_moves_among_fast_ones_keep_their_feed() {
    let strategy = (
        prop::collection::vec(any_line(), 2..30),
        (-5.0..0.0f64).prop_map(f64::exp),
    );
    let cases = std::env::var("FRAMEPATH_CASES").map_or(80, |cases| cases.parse().expect("cases"));
    let mut runner = seeded_runner(ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let result = runner.run(&strategy, |(lines, tolerance)| {
        let excess = with_room(|| greatest_excess(limits(20_000.0), tolerance, &lines));
        prop_assert!(excess <= TOLERANCE, "{excess}");
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

/// The first phase from rest, which is longer than both of the first moves, led over the slow one at the feed of
/// the first: 3.2 times its own.
#[test]
fn a_slow_move_behind_the_first_keeps_its_feed() {
    let along = |displacement: f64, feed: f64| Line {
        displacement: [displacement, 0.0, 0.0],
        feed: feed / 60.0,
        tolerance: None,
    };
    let lines = [
        along(0.0006, 1000.0),
        along(0.00155, 10.0),
        along(0.13, 1500.0),
    ];
    let excess = with_room(|| greatest_excess(limits(20_000.0), 0.02, &lines));
    assert!(excess <= TOLERANCE, "{excess}");
}
