//! Two lines that a short arc joins, and a little more behind them.

use std::f64::consts::TAU;

use proptest::prelude::*;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{equal_limits, with_room};
use crate::program::run::run;
use crate::program::{Program, Programmed, Shape, checked};
use crate::random_program::undisturbed;
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;

/// A line, an arc, a line and two micrometres of another one, at this feed and tolerance.
fn fillet(
    line: (f64, f64),
    arc: (f64, f64),
    behind: [f64; 3],
    feed: f64,
    tolerance: f64,
) -> Vec<Programmed> {
    let (length, direction) = line;
    let (radius, angle) = arc;
    let [x, y, z] = behind;
    let in_space = |x, y, z| Shape::Line(Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    [
        in_space(length * direction.cos(), length * direction.sin(), 0.1),
        Shape::Arc {
            radial: [1.0, 0.5, 0.0],
            tilt: [0.0, 0.0, 1.0],
            radius,
            angle,
            height: 0.0,
            revolutions: 0,
            others: [0.0; 6],
        },
        in_space(x, y, z),
        in_space(0.0, 0.002, 0.0),
    ]
    .map(|shape| Programmed {
        mode: Some(TerminationCondition::Continuous { tolerance }),
        ..Programmed::feed(shape, feed)
    })
    .into()
}

fn any_fillet() -> impl Strategy<Value = Program> {
    let strategy = (
        (0.3..6.0, 0.0..TAU, 0.01..1.0, 10.0..200.0),
        (0.01..0.4, 0.006..0.9),
        (0.002..3.0, -3.0..3.0, -3.0..3.0),
        3.7..5.2,
    );
    strategy.prop_map(
        |((length, direction, tolerance, feed), arc, (x, y, z), jerk)| {
            let moves = fillet((length, direction), arc, [x, y, z], feed, tolerance);
            undisturbed(equal_limits(10f64.powf(jerk)), moves)
        },
    )
}

/// The easements at both ends of a short arc may be many times as wide as it is long.
#[test]
fn short_arcs_between_wide_easements_keep_the_limits() {
    let config = ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let result = seeded_runner(config).run(&any_fillet(), |program| {
        with_room(|| run(&program)).map(|_| ())
    });
    checked(result);
}
