//! Random programs of lines, arcs and helices while an operator does everything an operator can
//! do: always within the limits, always at the end point.

mod planner_common;
mod planner_random;

use std::cell::RefCell;
use std::f64::consts::TAU;

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use planner_common::{Extremes, Machine, feed_move, seeded_runner, with_room};
use planner_random::run::run;
use planner_random::{Programmed, Shape, any_event, any_limits, any_move};
use proptest::prelude::*;

/// A failing case: between the samples of a plan the third derivative of the path in a narrow corner
/// left its linear interpolation by more than the jerk allows.
#[test]
fn a_narrow_corner_behind_a_reversal_keeps_the_jerk() {
    let jerk = 13_014.075;
    with_room(|| {
        let mut machine = Machine::new(planner_common::equal_limits(jerk));
        let ways: [([f64; 3], f64, f64); 5] = [
            ([1.325357, 0.0, 0.0], 0.0, 63.767),
            ([0.0, -0.029627, 0.0], 1.0, 35.438),
            ([1.049039, -1.058961, -3.027968], 0.0996507, 30.611),
            ([0.064107, -0.072084, 0.0], 1.0, 27.425),
            ([-0.303147, 0.0, 0.603955], 1.0, 61.728),
        ];
        let mut position = Axes::zeros();
        for (way, tolerance, feed) in ways {
            for (axis, part) in way.into_iter().enumerate() {
                position[axis] += part;
            }
            machine.planner.set_termination(if tolerance > 0.0 {
                TerminationCondition::Continuous { tolerance }
            } else {
                TerminationCondition::Stop
            });
            machine.line(position, &feed_move(feed)).expect("a line");
        }
        machine
            .line(position - Axes::ith(2, 0.7829138), &feed_move(5.0))
            .expect("a line");
        machine.inputs.feed_scale = 1.815;
        machine.run(5000);
        let extremes = machine.extremes();
        assert!(extremes.jerk <= 1.05, "{extremes:?}");
    });
}

/// A failing case: the third derivative on an arc of a few micrometres, between two places of the plan,
/// was not looked at, and took up to 16 times the jerk.
#[test]
fn a_short_narrow_arc_within_wide_corners_keeps_the_jerk() {
    let programmed = |shape, feed, tolerance: Option<f64>| Programmed {
        shape,
        feed,
        motion_type: MotionType::Feed,
        enables: 0x0f,
        wait_for_spindle: false,
        mode: tolerance.map(|tolerance| TerminationCondition::Continuous { tolerance }),
    };
    let line = |part: [f64; 9]| Shape::Line(Axes::from(part));
    let arc = |radial, tilt, radius, angle, turn| Shape::Arc {
        radial,
        tilt,
        radius,
        angle,
        height: 0.0,
        turn,
        others: [0.0; 6],
    };
    let moves = [
        (
            line([0.0, 0.0, 0.0, 0.0, -0.559, 0.0, 0.577, 0.0, -0.885]),
            10.0,
            Some(1.0),
        ),
        (
            arc(
                [-0.3394, 0.2908, 0.7524],
                [0.0, 0.0, -0.5312],
                3.0745,
                0.97826,
                -2,
            ),
            26.3,
            None,
        ),
        (
            line([0.0, 0.001616, 0.000861, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            10.0,
            None,
        ),
        (
            arc(
                [-0.453, 0.0, 0.0],
                [0.0, 0.0, -0.613],
                0.07137,
                6.197027,
                -1,
            ),
            195.2,
            None,
        ),
        (
            line([0.0, 0.12484, -0.07178, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            10.0,
            None,
        ),
        (
            line([0.0, 0.0, -0.80946, -0.63782, 0.27015, 0.0, 0.0, 0.0, 0.0]),
            182.0,
            None,
        ),
        (
            line([0.0, 0.0, 0.0, 0.0, -0.17174, 0.0, 0.0, 0.0, 0.0]),
            10.0,
            Some(1.0),
        ),
        (
            line([0.2792, 0.1678, -0.5897, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            17.2,
            Some(0.845),
        ),
    ]
    .map(|(shape, feed, tolerance)| programmed(shape, feed, tolerance));
    for jerk in [f64::INFINITY, 6e4, 3e4, 1.2e4] {
        let limits = AxisLimits {
            velocity: Axes::repeat(60.0),
            acceleration: Axes::from([600.0, 2e3, 600.0, 2e3, 600.0, 1.4e3, 1.4e3, 600.0, 2e3]),
            jerk: Axes::repeat(jerk),
        };
        with_room(|| run(limits, &moves, &[], 1)).expect("within the limits");
    }
}

/// Two lines that a short arc joins, and a little more behind them.
#[derive(Clone, Copy, Debug)]
struct Filleted {
    line: f64,
    direction: f64,
    tolerance: f64,
    feed: f64,
    radius: f64,
    angle: f64,
    behind: [f64; 3],
    jerk: f64,
}

impl Filleted {
    fn run(self) -> Result<(Extremes, usize), TestCaseError> {
        let shapes = [
            Shape::Line(Axes::from([
                self.line * self.direction.cos(),
                self.line * self.direction.sin(),
                0.1,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ])),
            Shape::Arc {
                radial: [1.0, 0.5, 0.0],
                tilt: [0.0, 0.0, 1.0],
                radius: self.radius,
                angle: self.angle,
                height: 0.0,
                turn: 0,
                others: [0.0; 6],
            },
            Shape::Line(Axes::from_fn(|axis, _| {
                self.behind.get(axis).copied().unwrap_or(0.0)
            })),
            Shape::Line(Axes::ith(1, 0.002)),
        ];
        let tolerance = self.tolerance;
        let moves = shapes.map(|shape| Programmed {
            shape,
            feed: self.feed,
            motion_type: MotionType::Feed,
            enables: 0x0f,
            wait_for_spindle: false,
            mode: Some(TerminationCondition::Continuous { tolerance }),
        });
        let limits = planner_common::equal_limits(self.jerk);
        with_room(|| run(limits, &moves, &[], 1))
    }
}

/// Failing cases: the easements at both ends of an arc of some micrometres were up to a millimetre wide,
/// and at their edges, between two places of the plan, the third derivative jumped.
#[test]
fn an_arc_much_shorter_than_its_easements_keeps_the_jerk() {
    let soft = Filleted {
        line: 3.608,
        direction: 3.629,
        tolerance: 0.33694,
        feed: 165.8,
        radius: 0.017_939,
        angle: 0.17939,
        behind: [1.883, 0.0, 0.0],
        jerk: 5931.0,
    };
    let wide = Filleted {
        line: 3.5543,
        direction: 2.6553,
        tolerance: 0.62493,
        feed: 26.713,
        radius: 0.044_464,
        angle: 0.14469,
        behind: [1.9863, 0.0, 0.0],
        jerk: 6673.0,
    };
    for case in [soft, wide] {
        case.run().expect("within the limits");
    }
    let strategy = (
        (0.3..6.0, 0.0..TAU, 0.01..1.0, 10.0..200.0),
        (0.01..0.25, 0.006..0.18),
        (0.002..3.0, -3.0..3.0, -3.0..3.0),
        3.7..5.2,
    );
    let config = ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let filleted = strategy.prop_map(|(first, (radius, angle), (x, y, z), jerk)| {
        let (line, direction, tolerance, feed) = first;
        Filleted {
            line,
            direction,
            tolerance,
            feed,
            radius,
            angle,
            behind: [x, y, z],
            jerk: 10f64.powf(jerk),
        }
    });
    let result = seeded_runner(config).run(&filleted, |case| case.run().map(|_| ()));
    result.expect("within the limits");
}

#[test]
fn programs_keep_the_limits_whatever_the_operator_does() {
    let strategy = (
        any_limits(),
        prop::collection::vec(any_move(), 1..60),
        prop::collection::vec((1usize..400, any_event()), 0..40),
        prop_oneof![Just(1usize), 1usize..300],
    );
    let sum = RefCell::new((Extremes::default(), 0));
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(100, |cases| cases.parse().expect("a number"));
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let mut runner = seeded_runner(config);
    let result = runner.run(&strategy, |(limits, moves, events, supply)| {
        let (extremes, cycles) = with_room(|| run(limits, &moves, &events, supply))?;
        let mut sum = sum.borrow_mut();
        sum.0.join(&extremes);
        sum.1 += cycles;
        Ok(())
    });
    let (greatest, cycles) = sum.into_inner();
    println!("{cycles} cycles, greatest over the limits: {greatest:?}");
    if let Err(error) = result {
        panic!("{error}");
    }
}
