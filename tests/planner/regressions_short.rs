//! Short programs that once broke a limit, or starved the executor.

use crate::common::{equal_limits, with_room};
use crate::short_program::{ShortMove, ShortProgram, Way, run};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;

fn line(x: f64, y: f64, z: f64) -> Way {
    Way::Line(Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
}

/// A flat arc across an axis, X to Z as 0 to 2.
fn arc(center: [f64; 2], across: usize, angle: f64) -> Way {
    Way::Arc {
        center,
        across,
        angle,
        height: 0.0,
        others: [0.0; 6],
    }
}

/// One move at a feed, millimetres per second.
fn at(feed: f64, way: Way) -> ShortMove {
    ShortMove {
        way,
        feed,
        rapid: false,
        mode: None,
    }
}

fn check(limits: AxisLimits, moves: Vec<ShortMove>) {
    let program = ShortProgram {
        limits,
        moves,
        supply: 1,
        acts: Vec::new(),
    };
    if let Err(error) = with_room(|| run(&program)) {
        panic!("{error}");
    }
}

/// Between two arcs, a line of less than a nanometre: its change of shape and those of the arcs were joined to one
/// as wide as these and as fine as that, with hundreds of nodes some microseconds apart.
#[test]
fn a_line_of_a_nanometre_between_arcs_starves_nobody() {
    for jerk in [1e6, f64::INFINITY] {
        let moves = vec![
            at(27.0, arc([0.0026, -0.0003], 1, 3.5)),
            at(2.0, line(0.0, 0.0, -4.26e-7)),
            at(53.0, arc([0.076, 0.015], 2, 14.5)),
            at(0.013, line(3.5e-5, 6.7e-6, 0.0)),
        ];
        let mut limits = equal_limits(jerk);
        limits.velocity = Axes::repeat(10.0);
        limits.acceleration = Axes::from_fn(|axis, _| [680.0, 118.0, 4280.0][axis % 3]);
        check(limits, moves);
    }
}

/// Two turns of less than a tenth of a micrometre within the blends at both ends, which straighten the path where the
/// arc begins and ends: one interval of the plan led over both turns.
#[test]
fn turns_between_two_nodes_keep_the_acceleration() {
    let continuous = |tolerance| Some(TerminationCondition::Continuous { tolerance });
    let mode = |tolerance, one| ShortMove {
        mode: continuous(tolerance),
        ..one
    };
    let mut limits = equal_limits(f64::INFINITY);
    limits.acceleration[0] = 215.0;
    limits.acceleration[1] = 5450.0;
    limits.acceleration[2] = 30.0;
    let rapid = |one| ShortMove { rapid: true, ..one };
    let moves = vec![
        mode(0.067, at(2.48, line(0.0, 6.9e-6, -1.94e-5))),
        mode(0.03, rapid(at(0.27, line(-0.037, 0.0, 0.0)))),
        mode(0.0, rapid(at(71.6, arc([1.22e-6, 2.575e-5], 0, -12.58)))),
        mode(0.0, at(8.06, line(0.0, -0.0167, -0.001385))),
        at(7.75, arc([7.75e-7, -1.893e-5], 2, 6.75)),
        at(0.0016, line(0.0, 0.0, -0.000146)),
    ];
    check(limits, moves);
}
