//! Two lines that a short arc joins, and a little more behind them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{at, equal_limits, feed_move, with_machine, with_room};
use crate::program::run::run;
use crate::program::{Program, Programmed, Shape, checked};
use crate::random_program::undisturbed;
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Circle;

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

/// Servo periods that two lines of 20 mm take which an arc joins without a corner, at F6000, 1000 mm/s2 and 20000 mm/s3.
fn rounded_corner(radius: f64, angle: f64, tolerance: f64) -> f64 {
    let mut periods = 0;
    with_machine(|machine| {
        let continuous = TerminationCondition::Continuous { tolerance };
        machine.planner.set_termination(continuous);
        let request = feed_move(100.0);
        machine.line(at(20.0, 0.0), &request).expect("a line");
        let circle = Circle {
            center: at(20.0, radius).fixed_rows::<3>(0).into(),
            normal: [0.0, 0.0, 1.0].into(),
            revolutions: 0,
        };
        let end = at(20.0 + radius * angle.sin(), radius - radius * angle.cos());
        machine.circle(end, &circle, &request).expect("an arc");
        let behind = at(angle.cos(), angle.sin()) * 20.0;
        machine.line(end + behind, &request).expect("a line");
        periods = machine.run(5_000);
    });
    periods as f64
}

/// Easements as wide as the tolerance lets them be led back and forth beside an arc that is small for it: with R .2 and P .8 a right
/// angle took 1.26 times as long as with P .01.
#[test]
fn more_tolerance_of_a_rounded_corner_costs_no_time() {
    for radius in [0.2, 0.5, 1.0, 2.0] {
        for angle in [PI / 6.0, FRAC_PI_2, 0.999 * PI] {
            let taken = [0.01, 0.05, 0.2, 0.8].map(|p| rounded_corner(radius, angle, p));
            let more = taken.windows(2).any(|pair| pair[1] > 1.01 * pair[0] + 2.0);
            assert!(!more, "R {radius}, {angle} radians: {taken:?} periods");
        }
    }
}
