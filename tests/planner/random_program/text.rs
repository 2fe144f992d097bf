//! Programs as text, a move a line, so that what was found stays short.

use framepath::axes::Axes;
use framepath::moves::TerminationCondition;

use super::{Programmed, Shape};

/// Each line: `line` and nine displacements, or `arc` and radial (3), tilt (3), radius, angle, height,
/// revolutions, others (6), see [`Shape`]; then the feed, and `stop`, `exact` or P if the mode changes before it.
pub fn program(text: &str) -> Vec<Programmed> {
    text.lines()
        .filter(|line| !line.trim().is_empty())
        .map(one)
        .collect()
}

fn one(line: &str) -> Programmed {
    let mut words = line.split_whitespace();
    let kind = words.next().expect("a kind");
    let mut number = || -> f64 {
        let word = words.next().unwrap_or_else(|| panic!("too short: {line}"));
        word.parse().unwrap_or_else(|_| panic!("no number: {word}"))
    };
    let shape = match kind {
        "line" => Shape::Line(Axes::from_fn(|_, _| number())),
        "arc" => Shape::Arc {
            radial: std::array::from_fn(|_| number()),
            tilt: std::array::from_fn(|_| number()),
            radius: number(),
            angle: number(),
            height: number(),
            revolutions: number() as i32,
            others: std::array::from_fn(|_| number()),
        },
        other => panic!("neither a line nor an arc: {other}"),
    };
    let feed = number();
    let mode = words.next().map(|word| match word {
        "stop" => TerminationCondition::Stop,
        "exact" => TerminationCondition::Exact,
        tolerance => TerminationCondition::Continuous {
            tolerance: tolerance.parse().expect("P"),
        },
    });
    Programmed {
        mode,
        ..Programmed::feed(shape, feed)
    }
}
