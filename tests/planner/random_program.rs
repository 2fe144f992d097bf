//! Random programs, and what an operator may do while they run.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use proptest::prelude::*;

use crate::program::{
    ALL_ENABLED, Asked, Event, FEED_OVERRIDE_OFF, Program, Programmed, RestsAsked, Shape,
};

/// Programs of these moves on these machines, and what the operator does meanwhile.
pub fn any_program(
    limits: impl Strategy<Value = AxisLimits>,
    moves: impl Strategy<Value = Vec<Programmed>>,
) -> impl Strategy<Value = Program> {
    (
        limits,
        moves,
        prop::collection::vec((1usize..400, any_event()), 0..40),
        prop_oneof![Just(1usize), 1usize..300],
    )
        .prop_map(|(limits, moves, events, supply)| Program {
            supply,
            events: in_periods(0, &events),
            ..undisturbed(limits, moves)
        })
}

/// A program without an operator, of which everything is asked.
pub fn undisturbed(limits: AxisLimits, moves: Vec<Programmed>) -> Program {
    Program {
        limits,
        max_velocity: 250.0,
        slider: Some(1e3),
        mode: TerminationCondition::Continuous { tolerance: 0.05 },
        supply: 1,
        moves,
        events: Vec::new(),
        asked: Asked {
            path: true,
            rests: RestsAsked::Explained,
            ..Asked::LIMITS
        },
    }
}

/// Events with the periods to the next one, the first in period `first`: the period of each, and behind the last one
/// the operator goes home.
pub fn in_periods(first: usize, events: &[(usize, Event)]) -> Vec<(usize, Event)> {
    let mut period = first;
    let mut all = Vec::new();
    for (gap, event) in events {
        all.push((period, *event));
        period += gap;
    }
    all.push((period, Event::Gone));
    all
}

pub fn any_displacement() -> impl Strategy<Value = Axes> {
    (
        prop::array::uniform9(-1.0..1.0f64),
        prop_oneof![Just(7u32), 1u32..512],
        -7.0..4.0f64,
    )
        .prop_map(|(direction, mask, size)| {
            Axes::from_fn(|i, _| {
                if mask >> i & 1 == 0 {
                    0.0
                } else {
                    direction[i] * size.exp()
                }
            })
        })
}

pub fn any_shape() -> impl Strategy<Value = Shape> {
    let direction = || prop::array::uniform3(-1.0..1.0f64);
    prop_oneof![
        2 => any_displacement().prop_map(Shape::Line),
        1 => (
            (direction(), direction(), (-3.0..3.0f64).prop_map(f64::exp), 0.05..6.2f64),
            (prop_oneof![Just(0.0), -10.0..10.0f64], -2..1i32),
            prop_oneof![Just([0.0; 6]), prop::array::uniform6(-10.0..10.0f64)],
        )
            .prop_map(|((radial, tilt, radius, angle), (height, revolutions), others)| Shape::Arc {
                radial, tilt, radius, angle, height, revolutions, others,
            }),
    ]
}

pub fn any_move() -> impl Strategy<Value = Programmed> {
    (
        any_shape(),
        (2.3..5.3f64).prop_map(f64::exp),
        prop_oneof![
            Just(MotionType::Feed),
            Just(MotionType::Traverse),
            Just(MotionType::Arc),
        ],
        prop_oneof![3 => Just(ALL_ENABLED), 1 => Just(FEED_OVERRIDE_OFF)],
        prop::bool::weighted(0.05),
        any_mode(),
    )
        .prop_map(
            |(shape, feed, motion_type, enables, wait_for_spindle, mode)| Programmed {
                shape,
                feed,
                motion_type,
                enables,
                wait_for_spindle,
                mode,
            },
        )
}

/// A curve as CAM writes it: short lines at one feed, each turned a little, and a sharp corner now and
/// then.
pub fn any_curve() -> impl Strategy<Value = Vec<Programmed>> {
    (
        (any_displacement(), any_displacement()),
        (-5.5..0.7f64).prop_map(f64::exp),
        prop_oneof![Just(0.0), -0.4..0.4f64],
        prop::collection::vec(prop::bool::weighted(0.03), 3..60),
        any_move(),
    )
        .prop_filter_map(
            "a plane to lie in",
            |((along, across), length, turn, corners, first)| {
                let along = along.try_normalize(1e-9)?;
                let across = (across - along * along.dot(&across)).try_normalize(1e-9)?;
                let mut angle = 0.0f64;
                let lines = corners.iter().enumerate().map(|(number, corner)| {
                    angle += if *corner { 1.5 } else { turn };
                    let direction = along * angle.cos() + across * angle.sin();
                    Programmed {
                        shape: Shape::Line(direction * length),
                        motion_type: MotionType::Feed,
                        wait_for_spindle: false,
                        mode: first.mode.filter(|_| number == 0),
                        ..first.clone()
                    }
                });
                Some(lines.collect())
            },
        )
}

/// Curves of short lines among other moves.
pub fn any_curves() -> impl Strategy<Value = Vec<Programmed>> {
    let part = prop_oneof![any_curve(), prop::collection::vec(any_move(), 1..3)];
    prop::collection::vec(part, 1..8).prop_map(|parts| parts.concat())
}

pub fn any_mode() -> impl Strategy<Value = Option<TerminationCondition>> {
    let p = (-7.0..1.0f64).prop_map(f64::exp);
    prop_oneof![
        16 => Just(None),
        1 => Just(Some(TerminationCondition::Stop)),
        1 => Just(Some(TerminationCondition::Exact)),
        1 => Just(Some(TerminationCondition::Continuous { tolerance: 0.0 })),
        3 => p.prop_map(|tolerance| Some(TerminationCondition::Continuous { tolerance })),
    ]
}

pub fn any_event() -> impl Strategy<Value = Event> {
    prop_oneof![
        2 => Just(Event::Pause),
        4 => Just(Event::Resume),
        1 => Just(Event::Abort),
        4 => prop_oneof![0.0..2.0f64, Just(0.0), Just(1.0), Just(2.0)].prop_map(Event::FeedOverride),
        2 => prop_oneof![0.0..1.0f64, Just(1.0)].prop_map(Event::RapidOverride),
        2 => prop_oneof![0.0..200.0f64, Just(0.0), Just(1e3)].prop_map(Event::Slider),
        2 => prop_oneof![0.0..1.0f64, Just(0.0), Just(1.0)].prop_map(Event::Adaptive),
        1 => prop::bool::ANY.prop_map(Event::Spindles),
        1 => Just(Event::Step),
    ]
}

pub fn any_limits() -> impl Strategy<Value = AxisLimits> {
    let one = || prop::array::uniform9(0.3..1.0f64);
    let jerk =
        prop_oneof![4 => (3.7..5.0f64).prop_map(|j| 10f64.powf(j)), 1 => Just(f64::INFINITY)];
    (one(), one(), one(), jerk).prop_map(|(v, a, j, jerk)| AxisLimits {
        velocity: Axes::from(v) * 200.0,
        acceleration: Axes::from(a) * 2000.0,
        jerk: Axes::from(j) * jerk,
    })
}

/// Lines in XYZ at one feed with corners of all kinds between them, and other moves now and then.
pub fn any_corners() -> impl Strategy<Value = Vec<Programmed>> {
    let p = prop_oneof![
        3 => Just(None),
        1 => (-5.0..0.0f64).prop_map(|x| Some(TerminationCondition::Continuous { tolerance: x.exp() })),
    ];
    let direction = prop::array::uniform3(-1.0..1.0f64);
    let line = (direction, 1usize..8, -1.5..2.0f64, p).prop_map(|(direction, mask, size, mode)| {
        let is_moved = |axis: usize| axis < 3 && mask >> axis & 1 == 1;
        let displacement = Axes::from_fn(|axis, _| {
            if is_moved(axis) {
                direction[axis] * size.exp()
            } else {
                0.0
            }
        });
        Programmed {
            mode,
            ..Programmed::feed(Shape::Line(displacement), 200.0)
        }
    });
    let other = any_move().prop_map(|other| Programmed {
        mode: None,
        wait_for_spindle: false,
        ..other
    });
    prop::collection::vec(prop_oneof![4 => line, 1 => other], 3..25)
}

/// Limits that each axis has for itself over three decades, one of them without a limit of jerk now and
/// then; and machines with one axis 5 to 30 times softer than the others.
pub fn any_unequal_limits() -> impl Strategy<Value = AxisLimits> {
    let decades = || prop::array::uniform9((0.0..3.0f64).prop_map(|x| 10f64.powf(x)));
    let free = prop_oneof![2 => Just(None), 1 => (0usize..4).prop_map(Some)];
    let mixed = (decades(), decades(), decades(), free).prop_map(|(v, a, j, free)| {
        let acceleration = Axes::from(a) * 5.0;
        let mut jerk = (Axes::from(j) * 200.0).inf(&(acceleration * GREATEST_JERK_RATE));
        if let Some(axis) = free {
            jerk[axis] = f64::INFINITY;
        }
        AxisLimits {
            velocity: Axes::from(v),
            acceleration,
            jerk,
        }
    });
    let soft = (3.7..5.7f64, 0usize..3, 5.0..30.0f64, any::<bool>());
    let one_soft = soft.prop_map(|(jerk, axis, times, all)| {
        let mut limits = AxisLimits {
            velocity: Axes::repeat(200.0),
            acceleration: Axes::repeat(2000.0),
            jerk: Axes::repeat(10f64.powf(jerk)),
        };
        limits.jerk[axis] /= times;
        if all {
            limits.acceleration[axis] /= times;
        }
        limits
    });
    prop_oneof![mixed, one_soft]
}

/// Jerk over acceleration, per second: more cannot be seen in positions once a period.
const GREATEST_JERK_RATE: f64 = 250.0;
