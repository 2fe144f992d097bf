//! Random programs of lines, arcs and helices while an operator does everything an operator can
//! do: always within the limits, always at the end point.

mod planner_common;

use std::cell::RefCell;

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use framepath::path::{self, Circle, ShapeError};
use framepath::planner::{Added, MoveRequest};
use nalgebra::Vector3;
use planner_common::path_check::{self, Place, Wanted};
use planner_common::{Extremes, Machine, feed_move, seeded_runner, with_room};
use proptest::prelude::*;

#[derive(Clone, Debug)]
enum Shape {
    Line(Axes),
    Arc {
        radial: [f64; 3],
        tilt: [f64; 3],
        radius: f64,
        angle: f64,
        height: f64,
        turn: i32,
        others: [f64; 6],
    },
}

#[derive(Clone, Debug)]
struct Programmed {
    shape: Shape,
    feed: f64,
    motion_type: MotionType,
    enables: u8,
    wait_for_spindle: bool,
    /// G61, G61.1 or G64 before it.
    mode: Option<TerminationCondition>,
}

#[derive(Clone, Copy, Debug)]
enum Event {
    Pause,
    Resume,
    Abort,
    FeedOverride(f64),
    RapidOverride(f64),
    Slider(f64),
    Adaptive(f64),
    Spindles(bool),
    Step,
}

fn any_displacement() -> impl Strategy<Value = Axes> {
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

fn any_shape() -> impl Strategy<Value = Shape> {
    let direction = || prop::array::uniform3(-1.0..1.0f64);
    prop_oneof![
        2 => any_displacement().prop_map(Shape::Line),
        1 => (
            (direction(), direction(), (-3.0..3.0f64).prop_map(f64::exp), 0.05..6.2f64),
            (prop_oneof![Just(0.0), -10.0..10.0f64], -2..1i32),
            prop_oneof![Just([0.0; 6]), prop::array::uniform6(-10.0..10.0f64)],
        )
            .prop_map(|((radial, tilt, radius, angle), (height, turn), others)| Shape::Arc {
                radial, tilt, radius, angle, height, turn, others,
            }),
    ]
}

fn any_move() -> impl Strategy<Value = Programmed> {
    (
        any_shape(),
        (2.3..5.3f64).prop_map(f64::exp),
        prop_oneof![
            Just(MotionType::Feed),
            Just(MotionType::Traverse),
            Just(MotionType::Arc),
        ],
        prop_oneof![3 => Just(0x0fu8), 1 => Just(0x0d)],
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

fn any_mode() -> impl Strategy<Value = Option<TerminationCondition>> {
    let p = (-7.0..1.0f64).prop_map(f64::exp);
    prop_oneof![
        16 => Just(None),
        1 => Just(Some(TerminationCondition::Stop)),
        1 => Just(Some(TerminationCondition::Exact)),
        1 => Just(Some(TerminationCondition::Continuous { tolerance: 0.0 })),
        3 => p.prop_map(|tolerance| Some(TerminationCondition::Continuous { tolerance })),
    ]
}

fn any_event() -> impl Strategy<Value = Event> {
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

fn any_limits() -> impl Strategy<Value = AxisLimits> {
    let one = || prop::array::uniform9(0.3..1.0f64);
    let jerk =
        prop_oneof![4 => (3.7..5.0f64).prop_map(|j| 10f64.powf(j)), 1 => Just(f64::INFINITY)];
    (one(), one(), one(), jerk).prop_map(|(v, a, j, jerk)| AxisLimits {
        velocity: Axes::from(v) * 200.0,
        acceleration: Axes::from(a) * 2000.0,
        jerk: Axes::from(j) * jerk,
    })
}

/// Queues a move relative to where the last one ends.
fn queue(
    machine: &mut Machine,
    programmed: &Programmed,
    wanted: &mut Vec<Wanted>,
    (id, generation): (i32, usize),
) -> Added {
    let request = MoveRequest {
        motion_type: programmed.motion_type,
        max_velocity: 250.0,
        enables: programmed.enables,
        wait_for_spindle: programmed.wait_for_spindle,
        ..feed_move(programmed.feed)
    };
    if let Some(mode) = programmed.mode {
        machine.planner.set_termination(mode);
    }
    let mut want = |shape: Result<path::Shape, ShapeError>, machine: &Machine| {
        wanted.extend(shape.ok().map(|shape| Wanted {
            id,
            shape,
            tolerance: Wanted::tolerance_of(machine.planner.termination()),
            generation,
        }));
    };
    let start = *machine.planner.goal();
    let added = match &programmed.shape {
        Shape::Line(displacement) => {
            let end = start + displacement;
            want(machine.planner.line_to(&end), machine);
            machine.line(end, &request)
        }
        Shape::Arc {
            radial,
            tilt,
            radius,
            angle,
            height,
            turn,
            others,
        } => {
            let Some(radial) = Vector3::from(*radial).try_normalize(1e-3) else {
                return Added::ZeroLength;
            };
            let Some(normal) = radial.cross(&Vector3::from(*tilt)).try_normalize(1e-3) else {
                return Added::ZeroLength;
            };
            let center = start.fixed_rows::<3>(0) - radial * *radius;
            let turned = radial * angle.cos() + normal.cross(&radial) * angle.sin();
            let mut end = start;
            end.fixed_rows_mut::<3>(0)
                .copy_from(&(center + turned * *radius + normal * *height));
            for (coordinate, other) in end.iter_mut().skip(3).zip(others) {
                *coordinate += other;
            }
            let circle = Circle {
                center,
                normal,
                turn: *turn,
            };
            want(machine.planner.arc_to(&end, &circle), machine);
            machine.circle(end, &circle, &request)
        }
    };
    added.expect("a move that can be run")
}

/// What may explain a rest at or on a move.
#[derive(Clone, Copy, Debug)]
struct Supplied {
    /// When it was queued.
    cycle: usize,
    /// G61, G61.1 or G64 at its end.
    termination: TerminationCondition,
    wait_for_spindle: bool,
}

/// A move that came less than so many cycles before may have come too late: it takes the slowest of
/// the machines that long to brake.
const LATE: usize = 1000;

/// After so many cycles without a move the planner may take the one before for the last.
const SILENCE: usize = 8;

/// Whether the program or the supply of moves explains that the machine came to rest before or on the
/// move `next`.
fn explains_rest(supplied: &[Supplied], next: i32, cycle: usize) -> bool {
    let of = |id: i32| supplied.get(usize::try_from(id - 1).ok()?);
    let late = [next, next + 1]
        .into_iter()
        .filter_map(of)
        .any(|supplied| cycle < supplied.cycle + LATE);
    let silence = of(next - 1)
        .zip(of(next))
        .is_some_and(|(before, next)| next.cycle >= before.cycle + SILENCE);
    let stops = of(next - 1).is_some_and(|before| {
        !matches!(before.termination, TerminationCondition::Continuous { .. })
    });
    // What is to be followed exactly is so from its start on.
    let begins = of(next).is_some_and(|next| {
        next.wait_for_spindle || next.termination == TerminationCondition::Exact
    });
    late || silence || stops || begins
}

/// Runs a program to its end, with the greatest values and the number of cycles.
fn run(
    limits: AxisLimits,
    moves: &[Programmed],
    events: &[(usize, Event)],
    supply: usize,
) -> Result<(Extremes, usize), TestCaseError> {
    let mut machine = Machine::new(limits);
    machine.planner.set_velocity_limit(1e3);
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    let mut moves = moves.iter();
    let mut events = events.iter();
    let mut next_event = 0;
    let mut adaptive = 1.0;
    let mut step_from = None;
    let mut last_id = 0;
    let mut id = 1;
    let mut paused = false;
    let mut operator_gone = false;
    let mut generation = 0;
    let mut wanted = Vec::new();
    let mut supplied = Vec::new();
    let (mut moved, mut stepped) = (false, false);
    let mut places = vec![Place {
        position: Axes::zeros(),
        id: 0,
        generation,
    }];
    for cycle in 0.. {
        prop_assert!(
            cycle < 1_000_000,
            "not done: {:?}",
            machine.planner.status()
        );
        if cycle == next_event {
            let event = events.next();
            match event {
                Some((_, Event::Pause)) => {
                    machine.planner.pause();
                    paused = true;
                }
                Some((_, Event::Resume)) => {
                    machine.planner.resume();
                    paused = false;
                }
                Some((_, Event::Abort)) => machine.planner.abort(),
                Some((_, Event::FeedOverride(scale))) => machine.inputs.feed_scale = *scale,
                Some((_, Event::RapidOverride(scale))) => machine.inputs.rapid_scale = *scale,
                Some((_, Event::Slider(velocity))) => machine.planner.set_velocity_limit(*velocity),
                Some((_, Event::Adaptive(scale))) => adaptive = *scale,
                Some((_, Event::Spindles(at_speed))) => {
                    machine.inputs.spindles_at_speed = *at_speed
                }
                Some((_, Event::Step)) => {
                    if paused {
                        step_from = Some(machine.planner.status().exec_id);
                        machine.inputs.stepping = true;
                        machine.planner.resume();
                    }
                }
                // The operator goes home and leaves everything at 100 %.
                None => {
                    machine.planner.resume();
                    machine.planner.set_velocity_limit(1e3);
                    machine.inputs.feed_scale = 1.0;
                    machine.inputs.rapid_scale = 1.0;
                    machine.inputs.spindles_at_speed = true;
                    machine.inputs.stepping = false;
                    step_from = None;
                    adaptive = 1.0;
                    operator_gone = true;
                }
            }
            next_event += event.map_or(0, |(gap, _)| *gap);
        }
        if cycle % supply == 0 && !machine.planner.status().aborting {
            machine.planner.set_id(id);
            if let Some(programmed) = moves.next() {
                queue(&mut machine, programmed, &mut wanted, (id, generation));
                supplied.push(Supplied {
                    cycle,
                    termination: machine.planner.termination(),
                    wait_for_spindle: programmed.wait_for_spindle,
                });
                id += 1;
            }
        }
        let aborting = machine.planner.status().aborting;
        let status = machine.scaled_cycle(adaptive);
        generation += usize::from(aborting && !status.aborting);
        let standing = status.active_depth == 0;
        stepped |= machine.inputs.stepping;
        if moved && standing && !status.done && !aborting && !stepped {
            prop_assert!(
                explains_rest(&supplied, status.exec_id, cycle),
                "comes to rest at {} in cycle {cycle} for no reason",
                status.exec_id
            );
        }
        moved = !standing;
        stepped &= !standing;
        places.push(Place {
            position: status.position,
            id: status.exec_id,
            generation,
        });
        if step_from.is_some_and(|from| from != status.exec_id) {
            machine.planner.pause();
            machine.inputs.stepping = false;
            step_from = None;
        }
        if status.exec_id != 0 {
            prop_assert!(status.exec_id >= last_id, "ids go back");
            last_id = status.exec_id;
        }
        prop_assert!(status.current_velocity >= 0.0 && status.current_velocity.is_finite());
        prop_assert!(status.distance_to_go >= 0.0 && status.distance_to_go.is_finite());
        if status.done && moves.len() == 0 && operator_gone {
            break;
        }
    }
    let status = machine.planner.status();
    prop_assert_eq!(status.position, *machine.planner.goal());
    let fault = path_check::fault(&wanted, &places);
    prop_assert!(fault.is_none(), "{fault:?}");
    let extremes = machine.extremes();
    prop_assert!(extremes.velocity <= 1.001, "{extremes:?}");
    prop_assert!(extremes.acceleration <= 1.001, "{extremes:?}");
    prop_assert!(extremes.jerk <= 1.05, "{extremes:?}");
    Ok((extremes, machine.positions.len()))
}

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
