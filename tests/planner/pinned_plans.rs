//! What plans are: for some dozens of programs the servo periods that they take and how they run. No promise
//! breaks where a number here changes, but a program has become faster or slower, and that is to be seen.

use std::fmt::Write as _;
use std::path::Path;

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngSeed, TestRunner};

use crate::common::{Machine, PERIOD, at, equal_limits, with_room};
use crate::program::queue::queue;
use crate::program::{Programmed, Shape};
use crate::random_program::{any_corners, any_curves, any_limits, any_move, any_unequal_limits};

/// How a program ran.
#[derive(Clone, Copy, Debug)]
struct Ran {
    /// Servo periods from the first move to the end.
    periods: usize,
    /// The sum of the squares of the path velocity over all periods: what the periods alone do not show.
    squares: f64,
}

/// Libraries of mathematics differ in the last digits, and plans with them.
const SAME: f64 = 1e-6;

impl Ran {
    fn is_as(&self, other: &Self) -> bool {
        self.periods == other.periods
            && (self.squares - other.squares).abs() <= SAME * other.squares
    }
}

/// What the operator does.
#[derive(Clone, Copy, Debug)]
enum Operator {
    /// Nothing.
    Away,
    /// In every 700 periods: from the 250th on a velocity limit of 10 units/s, and a pause from the 550th to the 600th.
    Restless,
}

const MOST_PERIODS: usize = 200_000;

/// No move is faster, units/s.
const MAX_VELOCITY: f64 = 250.0;

fn ran(limits: AxisLimits, moves: &[Programmed], operator: Operator) -> Ran {
    let mut machine = Machine::new(limits);
    machine.planner.set_velocity_limit(1e3);
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    let mut moves = moves.iter();
    let mut id = 1;
    let mut before = Axes::zeros();
    let mut squares = 0.0;
    for period in 0..MOST_PERIODS {
        if let Operator::Restless = operator {
            match period % 700 {
                0 => machine.planner.set_velocity_limit(1e3),
                250 => machine.planner.set_velocity_limit(10.0),
                550 => machine.planner.pause(),
                600 => machine.planner.resume(),
                _ => {}
            }
        }
        if let Some(programmed) = moves.next() {
            machine.planner.set_id(id);
            queue(&mut machine, programmed, MAX_VELOCITY);
            id += 1;
        }
        let status = machine.cycle();
        squares += ((status.position - before) / PERIOD).norm_squared();
        before = status.position;
        if status.done && moves.len() == 0 {
            return Ran {
                periods: period,
                squares,
            };
        }
    }
    panic!("not done: {:?}", machine.planner.status());
}

/// A program of these, the same for a seed at all times.
fn drawn<T: std::fmt::Debug>(of: impl Strategy<Value = T>, seed: u64) -> T {
    let mut runner = TestRunner::new(ProptestConfig {
        rng_seed: RngSeed::Fixed(seed),
        ..ProptestConfig::default()
    });
    of.new_tree(&mut runner)
        .expect("a strategy that filters nothing")
        .current()
}

/// A circle of `radius` made of chords of length `chord`, with a tail that leaves it straight on.
fn circle_of_chords(radius: f64, chord: f64, tolerance: f64) -> Vec<Programmed> {
    let chords = (std::f64::consts::TAU * radius / chord).round() as usize;
    let on = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / chords as f64;
        at(radius * angle.sin(), radius * (1.0 - angle.cos()))
    };
    let mut moves: Vec<_> = (0..chords)
        .map(|i| Programmed::feed(Shape::Line(on(i + 1) - on(i)), 80.0))
        .collect();
    moves.push(Programmed::feed(Shape::Line(at(5.0, 0.0)), 40.0));
    moves[0].mode = Some(TerminationCondition::Continuous { tolerance });
    moves
}

/// A tooth of `pitch` and `height`, again and again, with rapids between the rows.
fn zigzag(pitch: f64, height: f64) -> Vec<Programmed> {
    let row = (0..20).map(|i| {
        let up = if i % 2 == 0 { height } else { -height };
        Programmed::feed(Shape::Line(at(pitch, up)), 60.0)
    });
    let mut moves: Vec<_> = row.clone().collect();
    moves.push(Programmed {
        motion_type: MotionType::Traverse,
        ..Programmed::feed(Shape::Line(at(-20.0 * pitch, 3.0)), 100.0)
    });
    moves.extend(row);
    moves
}

/// Everything that is pinned: its name, limits and moves.
fn programs() -> Vec<(String, AxisLimits, Vec<Programmed>)> {
    let mut programs = Vec::new();
    for (jerk, text) in [
        (f64::INFINITY, "unlimited"),
        (1e5, "100000"),
        (2e4, "20000"),
    ] {
        for (radius, chord, tolerance) in [(3.0, 0.1, 0.02), (10.0, 1.0, 0.005), (4.0, 2.5, 0.2)] {
            let name = format!("circle {radius} {chord} {tolerance} jerk {text}");
            let moves = circle_of_chords(radius, chord, tolerance);
            programs.push((name, equal_limits(jerk), moves));
        }
        for (pitch, height) in [(0.3, 0.05), (2.0, 2.0), (4.0, 0.01)] {
            let name = format!("zigzag {pitch} {height} jerk {text}");
            programs.push((name, equal_limits(jerk), zigzag(pitch, height)));
        }
    }
    for seed in 1..=20 {
        programs.push((
            format!("corners {seed}"),
            drawn(any_unequal_limits(), seed),
            drawn(any_corners(), seed),
        ));
        programs.push((
            format!("curves {seed}"),
            drawn(any_limits(), seed),
            drawn(any_curves(), seed),
        ));
        programs.push((
            format!("moves {seed}"),
            drawn(any_limits(), seed),
            drawn(prop::collection::vec(any_move(), 5..20), seed)
                .into_iter()
                .map(|programmed| Programmed {
                    wait_for_spindle: false,
                    ..programmed
                })
                .collect(),
        ));
    }
    programs
}

/// A line of the file: name, periods and squares, for each operator.
fn line(name: &str, [away, restless]: [Ran; 2]) -> String {
    format!(
        "{name}: {} {:.9e}, {} {:.9e}",
        away.periods, away.squares, restless.periods, restless.squares
    )
}

/// What a line says, `None` where it is none.
fn parsed(line: &str) -> Option<(&str, [Ran; 2])> {
    let (name, rest) = line.split_once(": ")?;
    let ran = |text: &str| {
        let (periods, squares) = text.split_once(' ')?;
        Some(Ran {
            periods: periods.parse().ok()?,
            squares: squares.parse().ok()?,
        })
    };
    let (away, restless) = rest.split_once(", ")?;
    Some((name, [ran(away)?, ran(restless)?]))
}

/// How plans differ from what is written down, a line each.
fn differences(pinned: &str, now: &str) -> String {
    let before: Vec<_> = pinned.lines().filter_map(parsed).collect();
    let after: Vec<_> = now.lines().filter_map(parsed).collect();
    let mut said = String::new();
    for (name, now) in &after {
        let Some((_, was)) = before.iter().find(|(before, _)| before == name) else {
            writeln!(said, "{name}: is new").expect("a string takes text");
            continue;
        };
        for ((was, now), operator) in was
            .iter()
            .zip(now)
            .zip([Operator::Away, Operator::Restless])
        {
            if !now.is_as(was) {
                writeln!(
                    said,
                    "{name}, operator {operator:?}: {:.4} of its time ({} for {} periods), {:.7} of its squares",
                    now.periods as f64 / was.periods as f64,
                    now.periods,
                    was.periods,
                    now.squares / was.squares
                )
                .expect("a string takes text");
            }
        }
    }
    for (name, _) in before {
        if !after.iter().any(|(after, _)| *after == name) {
            writeln!(said, "{name}: is gone").expect("a string takes text");
        }
    }
    said
}

#[test]
fn plans_are_what_they_were() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/planner/pinned_plans.txt");
    let now: String = programs()
        .into_iter()
        .map(|(name, limits, moves)| {
            let both = [Operator::Away, Operator::Restless]
                .map(|operator| with_room(|| ran(limits, &moves, operator)));
            line(&name, both) + "\n"
        })
        .collect();
    if std::env::var_os("FRAMEPATH_WRITE_PLANS").is_some() {
        std::fs::write(&path, &now).expect("tests/planner/pinned_plans.txt is writable");
    }
    let pinned = std::fs::read_to_string(&path).expect("tests/planner/pinned_plans.txt is there");
    let differences = differences(&pinned, &now);
    assert!(
        differences.is_empty(),
        "plans have changed:\n{differences}where that is meant, write them anew with \
         `FRAMEPATH_WRITE_PLANS=1 cargo test --test planner pinned_plans` and look at the change"
    );
}
