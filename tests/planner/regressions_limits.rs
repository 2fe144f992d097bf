//! Programs that once exceeded a limit, found by random ones.

use std::f64::consts::TAU;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Extremes, Machine, feed_move, with_room};
use crate::random_program::run::run;
use crate::random_program::{Programmed, Shape};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use proptest::prelude::*;

/// A failing case: between the samples of a plan the third derivative of the path in a narrow corner
/// left its linear interpolation by more than the jerk allows.
#[test]
fn a_narrow_corner_behind_a_reversal_keeps_the_jerk() {
    let jerk = 13_014.075;
    with_room(|| {
        let mut machine = Machine::new(crate::common::equal_limits(jerk));
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
    let arc = |radial, tilt, radius, angle, revolutions| Shape::Arc {
        radial,
        tilt,
        radius,
        angle,
        height: 0.0,
        revolutions,
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
                revolutions: 0,
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
        let limits = crate::common::equal_limits(self.jerk);
        with_room(|| run(limits, &moves, &[], 1))
    }
}

/// Failing cases: the easements at both ends of a short arc were up to hundreds of times as wide as it is long,
/// and at their edges, between two nodes of the plan, the third derivative jumped.
#[test]
fn a_short_arc_between_wide_easements_keeps_the_jerk() {
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
        (0.01..0.4, 0.006..0.9),
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

/// A failing case: where the acceleration of an axis rises and falls again between two of the places
/// that are looked at, three values do not show it. It was 1.027 of the limit.
#[test]
fn arcs_without_a_jerk_limit_keep_the_acceleration() {
    let limits = AxisLimits {
        velocity: Axes::from([
            190.8628, 79.98876, 96.66727, 199.1441, 175.6322, 128.5935, 180.7252, 159.3782,
            90.02778,
        ]),
        acceleration: Axes::from([
            1987.1385, 807.37575, 1987.3664, 693.59217, 1489.3749, 920.15545, 1108.9715, 1092.9506,
            946.2039,
        ]),
        jerk: Axes::repeat(f64::INFINITY),
    };
    let moves = [
        (
            ([-0.7739846, -0.0494351, -0.6206738], 0.9753075, 5.574893),
            ([-0.927226, 0.3119524, 0.6667799], -6.901446, 0),
            [-4.40486, 0.499594, -8.100288, 2.101973, 2.90979, -1.798563],
            (24.56632, None),
        ),
        (
            ([-0.9275996, -0.6718406, 0.1010534], 19.166196, 1.966586),
            ([-0.2904886, 0.5551758, -0.9708218], 5.955838, -1),
            [
                3.442509, 0.05024098, 5.734774, 9.080938, -3.651387, 1.807123,
            ],
            (108.82891, Some(0.09640743)),
        ),
        (
            ([0.8743251, -0.2841289, 0.9285773], 0.1271692, 0.7983998),
            ([0.7271658, 0.6328082, -0.2839209], 0.0, -2),
            [0.0; 6],
            (28.1897, None),
        ),
    ]
    .map(|(plane, rise, others, (feed, tolerance))| {
        let (radial, radius, angle) = plane;
        let (tilt, height, revolutions) = rise;
        Programmed {
            shape: Shape::Arc {
                radial,
                tilt,
                radius,
                angle,
                height,
                revolutions,
                others,
            },
            feed,
            motion_type: MotionType::Feed,
            enables: 0x0f,
            wait_for_spindle: false,
            mode: tolerance.map(|tolerance| TerminationCondition::Continuous { tolerance }),
        }
    });
    with_room(|| run(limits, &moves, &[], 1)).expect("within the limits");
}

/// A failing case: where a change of shape begins or ends within another one there was no node, and
/// the third derivative has a kink there. The jerk was 1.07 of the limit.
#[test]
fn a_corner_that_begins_within_another_keeps_the_jerk() {
    let limits = AxisLimits {
        velocity: Axes::from([
            175.7781, 103.1663, 60.95579, 115.8442, 152.431, 129.4601, 67.5072, 73.90571, 118.5687,
        ]),
        acceleration: Axes::from([
            920.6101, 788.6547, 1679.299, 1369.367, 915.7958, 1705.267, 1285.314, 662.6919, 652.528,
        ]),
        jerk: Axes::from([
            29190.27, 18178.88, 54838.99, 34848.02, 22503.37, 50630.01, 28366.64, 28293.21,
            50386.45,
        ]),
    };
    let line = |part: [f64; 9]| Shape::Line(Axes::from(part));
    let arc = Shape::Arc {
        radial: [0.134817, 0.3683539, 0.463123],
        tilt: [-0.403131, -0.4788271, -0.5036681],
        radius: 0.09378835,
        angle: 0.5062625,
        height: 0.0,
        revolutions: -2,
        others: [
            -0.1376185, -6.37191, -1.552273, -5.808728, -7.24589, -3.155701,
        ],
    };
    let moves = [
        (
            line([
                0.0, 1.063978, -4.250147, -4.476705, -1.69485, 0.0, 2.01413, 0.0, 4.35298,
            ]),
            156.7314,
        ),
        (
            line([
                -0.00172445,
                0.002289108,
                -0.002633588,
                0.0,
                -0.001406815,
                -0.003197936,
                0.0,
                0.0,
                0.001502113,
            ]),
            11.90742,
        ),
        (arc, 13.400929),
        (
            line([
                -0.03311208,
                -0.3485582,
                0.3516493,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ]),
            102.2752,
        ),
        (
            line([-3.155696, 12.96767, -12.98812, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            27.757,
        ),
    ];
    let mut moves = moves.map(|(shape, feed)| Programmed::feed(shape, feed));
    moves[1].mode = Some(TerminationCondition::Continuous {
        tolerance: 0.06359031,
    });
    with_room(|| run(limits, &moves, &[], 1)).expect("within the limits");
}

/// A failing case: where the feed of merged lines between two rests was raised, the limits were those in
/// the direction of the last line.
#[test]
fn merged_lines_between_rests_keep_the_limits_when_their_feed_is_raised() {
    with_room(|| {
        let mut machine = Machine::new(crate::common::equal_limits(20_000.0));
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.1 });
        machine.planner.set_velocity_limit(0.1);
        let mut position = Axes::zeros();
        for number in 0..7 {
            let angle = 0.085 * f64::from(number);
            position += crate::common::at(angle.cos(), angle.sin()) * 0.0077;
            machine.line(position, &feed_move(50.0)).expect("a line");
        }
        for _ in 0..200 {
            machine.cycle();
        }
        machine.planner.set_velocity_limit(1e3);
        let cycles = machine.run(500);
        assert!(cycles < 200, "the raised feed is not taken: {cycles}");
        let extremes = machine.extremes();
        assert!(extremes.jerk <= 1.001, "{extremes:?}");
    });
}
