//! Runs a program while an operator acts, and judges every cycle of it.

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::moves::TerminationCondition;
use framepath::moves::shape::{self, Circle, ShapeError};
use framepath::planner::{Added, MoveRequest};
use nalgebra::Vector3;
use proptest::prelude::*;

use super::{Event, Programmed, Shape};
use crate::common::path_check::{self, Place, Wanted};
use crate::common::{Extremes, Machine, PERIOD, feed_move};

/// Queues a move relative to where the last one ends.
pub fn queue(
    machine: &mut Machine,
    programmed: &Programmed,
    wanted: &mut Vec<Wanted>,
    (id, generation): (i32, usize),
) -> Added {
    let request = MoveRequest {
        motion_type: programmed.motion_type,
        max_velocity: GREATEST_SPEED,
        enables: programmed.enables,
        wait_for_spindle: programmed.wait_for_spindle,
        ..feed_move(programmed.feed)
    };
    if let Some(mode) = programmed.mode {
        machine.planner.set_termination(mode);
    }
    let mut want = |shape: Result<shape::Shape, ShapeError>, machine: &Machine| {
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
            revolutions,
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
                revolutions: *revolutions,
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

/// No move is faster.
const GREATEST_SPEED: f64 = 250.0;

/// A move that came less than so many cycles before may have come too late: it takes the machine that
/// long to brake, 1000 at least.
fn late(limits: &AxisLimits) -> usize {
    let longest = (0..AXIS_COUNT).fold(0.0, |longest: f64, axis| {
        let (a, j) = (limits.acceleration[axis], limits.jerk[axis]);
        let v = limits.velocity[axis].min(GREATEST_SPEED);
        longest.max((v / a + a / j).max(2.0 * (v / j).sqrt()))
    });
    (1.2 * longest / PERIOD).max(1000.0) as usize
}

/// After so many cycles without a move the planner may take the one before for the last.
const SILENCE: usize = 8;

/// Whether the program or the supply of moves explains that the machine came to rest before or on the
/// move `next`.
fn explains_rest(supplied: &[Supplied], next: i32, cycle: usize, late: usize) -> bool {
    let of = |id: i32| supplied.get(usize::try_from(id - 1).ok()?);
    let late = [next, next + 1]
        .into_iter()
        .filter_map(of)
        .any(|supplied| cycle < supplied.cycle + late);
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
pub fn run(
    limits: AxisLimits,
    moves: &[Programmed],
    events: &[(usize, Event)],
    supply: usize,
) -> Result<(Extremes, usize), TestCaseError> {
    let mut machine = Machine::new(limits);
    let late = late(&limits);
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
                explains_rest(&supplied, status.exec_id, cycle, late),
                "comes to rest at {} in cycle {cycle} for no reason",
                status.exec_id
            );
        }
        // A step that the machine has not begun yet ends the path before the next move all the same.
        stepped &= !(moved && standing);
        moved = !standing;
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
