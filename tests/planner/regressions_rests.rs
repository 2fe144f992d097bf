//! Programs in which the machine once came to rest for no reason, found by random ones.

use crate::common::{Machine, feed_move, with_room};
use crate::random_program::run::run;
use crate::random_program::{Event, Programmed, Shape};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};

/// A failing case: a plan that ended for now before a slow corner was passed below what sweeps allow
/// there and faster than they allow before it, so that each continuation was refused and the machine
/// came to rest, with all moves in the queue.
#[test]
fn a_soft_machine_comes_to_no_rest_before_a_wide_slow_corner() {
    let limits = AxisLimits {
        velocity: Axes::from([
            158.4, 196.2, 120.6, 193.0, 77.14, 67.35, 79.17, 110.9, 147.6,
        ]),
        acceleration: Axes::from([
            887.2, 1987.0, 1823.4, 1401.8, 1869.6, 1300.9, 1863.0, 1063.8, 676.7,
        ]),
        jerk: Axes::from([
            16546.0, 12747.0, 13630.0, 11078.0, 20000.0, 16855.0, 20000.0, 20000.0, 20000.0,
        ]),
    };
    let ways = [
        (
            [-1.5892, 0.0, 0.8785, 0.0, 0.0, 0.0, -0.5936, 1.5919, 0.0],
            109.25,
        ),
        ([2.0713, -0.2861, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 18.25),
        ([-0.0846, 0.349, 0.0, 0.0, 0.0, 1.0914, 0.0, 0.0, 0.0], 76.0),
        ([0.01418, 0.0031, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 78.58),
        ([3.8539, 7.7803, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 14.38),
        (
            [0.02115, 0.17866, 0.0669, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            10.663,
        ),
        (
            [0.0, 0.0, 0.0, 0.0, 0.3496, 0.0, 0.0, 0.5673, 0.1087],
            43.03,
        ),
        (
            [0.0, 0.0, -0.1128, 0.0, -0.1214, 0.0, 0.0, 0.0, -0.2141],
            14.794,
        ),
    ];
    with_room(|| {
        let mut machine = Machine::new(limits);
        machine.planner.set_velocity_limit(1e3);
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 1.46981 });
        let mut moved = false;
        for cycle in 0..5000 {
            if let Some((way, feed)) = ways.get(cycle) {
                let end = machine.planner.goal() + Axes::from(*way);
                machine.line(end, &feed_move(*feed)).expect("a line");
            }
            let status = machine.cycle();
            if status.done && moved {
                return;
            }
            moved |= status.active_depth > 0;
            assert!(
                !moved || status.active_depth > 0,
                "at rest in cycle {cycle}"
            );
        }
        panic!("not done: {:?}", machine.planner.status());
    });
}

/// A failing case: a helix at its limits was nowhere slow enough to be left for a narrow corner with what
/// the sweeps handed out, and the machine came to rest in it.
#[test]
fn a_soft_machine_leaves_a_helix_at_its_limits() {
    let limits = AxisLimits {
        velocity: Axes::from([
            100.697079, 166.825031, 122.502055, 162.903724, 163.185453, 171.087238, 170.363503,
            69.737925, 174.80608,
        ]),
        acceleration: Axes::from([
            1461.31038,
            856.313352,
            973.475895,
            1326.84535,
            1519.1682,
            690.941988,
            1229.167405,
            1850.519547,
            1773.096823,
        ]),
        jerk: Axes::from([
            2703.423154,
            3882.22499,
            6273.909077,
            7199.625255,
            5729.34628,
            7893.267944,
            5274.90254,
            5004.852393,
            7914.093708,
        ]),
    };
    let line = |part: [f64; 9]| Shape::Line(Axes::from(part));
    let helix = Shape::Arc {
        radial: [-0.7254675, -0.8389256, 0.5739707],
        tilt: [0.7057518, -0.6953437, -0.4416545],
        radius: 0.3096725,
        angle: 0.8891127,
        height: -5.31638,
        revolutions: -2,
        others: [
            -9.482059, -6.154674, -9.517246, 0.9964664, -9.576517, -1.212071,
        ],
    };
    let mut moves = [
        (
            line([
                -0.02402354,
                0.0,
                0.03084678,
                0.00041658,
                0.03740236,
                0.03853724,
                0.0132343,
                0.0,
                0.00893476,
            ]),
            52.8189,
        ),
        (
            line([
                -0.03096851,
                -0.02617826,
                0.02075311,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ]),
            17.775619,
        ),
        (
            line([
                0.0,
                0.0,
                0.07598364,
                0.0,
                0.0,
                0.098765,
                -0.08773109,
                -0.03286419,
                0.0,
            ]),
            85.583988,
        ),
        (helix, 17.985026),
        (
            line([-0.9372795, -0.8611517, 0.9184, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
            10.007639,
        ),
        (
            line([
                -0.05303965,
                -0.03420563,
                -0.00541387,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ]),
            152.689812,
        ),
        (
            line([
                4.3470962, 3.2449605, 0.8092277, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            ]),
            80.683043,
        ),
        (
            line([
                -0.00567415,
                0.0,
                0.0,
                0.0,
                0.00852961,
                0.00475802,
                -0.01084205,
                -0.01110329,
                0.0,
            ]),
            15.574843,
        ),
        (
            Shape::Arc {
                radial: [-0.08982308, 0.5940770, -0.7969122],
                tilt: [0.7146804, -0.2632550, 0.5969456],
                radius: 2.4946686,
                angle: 5.2984618,
                height: 3.3014283,
                revolutions: -1,
                others: [
                    0.4961328, 0.2517701, -9.1281077, -6.3895248, 0.0099339, -9.3978693,
                ],
            },
            41.566049,
        ),
    ]
    .map(|(shape, feed)| Programmed::feed(shape, feed));
    moves[2].motion_type = MotionType::Traverse;
    for index in [0, 1, 4] {
        moves[index].enables = 0x0d;
    }
    let events = [
        (376, Event::FeedOverride(0.0)),
        (368, Event::FeedOverride(1.5992123)),
    ];
    with_room(|| run(limits, &moves, &events, 1)).expect("no rest");
}

/// A failing case: behind a last move in G61.1 the end of the path was never final, so that the machine
/// stood on the way to it for ever.
#[test]
fn a_last_move_in_exact_stop_is_run_to_its_end() {
    let place = |n: f64| {
        let way = 0.2 * n;
        let (x, y) = (20.0 * (way / 20.0).sin(), 12.0 * (1.0 - (way / 9.0).cos()));
        Axes::from([x, y, 2.0 * (way / 5.0).sin(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    };
    for stops in [5, 10] {
        with_room(|| {
            let mut machine = Machine::new(crate::common::equal_limits(20_000.0));
            for n in 1..=60 {
                machine.planner.set_termination(if n % stops == 0 {
                    TerminationCondition::Stop
                } else {
                    TerminationCondition::Continuous { tolerance: 0.01 }
                });
                let end = place(f64::from(n));
                machine.line(end, &feed_move(47.0)).expect("a line");
                machine.cycle();
            }
            machine.run(5000);
            assert_eq!(machine.planner.status().position, place(60.0));
        });
    }
}
