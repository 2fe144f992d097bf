//! Moves as the planner takes them.

use framepath::axes::Axes;
use framepath::moves::shape::{self, Circle};
use framepath::planner::{AddError, Added, MoveRequest};
use nalgebra::Vector3;

use super::{Programmed, Shape};
use crate::common::{Machine, feed_move};

/// Where a move ends, and on which circle.
struct Goal {
    end: Axes,
    circle: Option<Circle>,
}

/// Queues a move from where the last one ends, with its shape where it has one. A turn may be none by LinuxCNC's
/// rounding: it is left out then.
pub fn queue(
    machine: &mut Machine,
    programmed: &Programmed,
    max_velocity: f64,
) -> (Added, Option<shape::Shape>) {
    if let Some(mode) = programmed.mode {
        machine.planner.set_termination(mode);
    }
    let Some(goal) = goal(&programmed.shape, machine.planner.goal()) else {
        return (Added::ZeroLength, None);
    };
    let request = MoveRequest {
        motion_type: programmed.motion_type,
        max_velocity,
        enables: programmed.enables,
        wait_for_spindle: programmed.wait_for_spindle,
        ..feed_move(programmed.feed)
    };
    let shape = match &goal.circle {
        None => machine.planner.line_to(&goal.end),
        Some(circle) => machine.planner.arc_to(&goal.end, circle),
    };
    let added = add(machine, &goal, &request);
    match (&programmed.shape, added) {
        (Shape::Turn { .. }, Err(_)) => (Added::ZeroLength, None),
        (_, added) => (added.expect("a move that can be run"), shape.ok()),
    }
}

fn add(machine: &mut Machine, goal: &Goal, request: &MoveRequest) -> Result<Added, AddError> {
    match &goal.circle {
        None => machine.line(goal.end, request),
        Some(circle) => machine.circle(goal.end, circle, request),
    }
}

/// `None` where an arc has no plane.
fn goal(shape: &Shape, start: &Axes) -> Option<Goal> {
    match shape {
        Shape::Line(displacement) => Some(Goal {
            end: start + displacement,
            circle: None,
        }),
        Shape::Arc { .. } => arc(shape, start),
        Shape::Turn { .. } => turn(shape, start),
    }
}

fn arc(shape: &Shape, start: &Axes) -> Option<Goal> {
    let Shape::Arc {
        radial,
        tilt,
        radius,
        angle,
        height,
        revolutions,
        others,
    } = shape
    else {
        return None;
    };
    let radial = Vector3::from(*radial).try_normalize(1e-3)?;
    let normal = radial.cross(&Vector3::from(*tilt)).try_normalize(1e-3)?;
    let center = start.fixed_rows::<3>(0) - radial * *radius;
    let turned = radial * angle.cos() + normal.cross(&radial) * angle.sin();
    let mut end = moved(start, others);
    end.fixed_rows_mut::<3>(0)
        .copy_from(&(center + turned * *radius + normal * *height));
    Some(Goal {
        end,
        circle: Some(Circle {
            center,
            normal,
            revolutions: *revolutions,
        }),
    })
}

fn turn(shape: &Shape, start: &Axes) -> Option<Goal> {
    let Shape::Turn {
        center,
        across,
        angle,
        height,
        others,
    } = shape
    else {
        return None;
    };
    let (first, second) = ((across + 1) % 3, (across + 2) % 3);
    let mut middle = Vector3::from(start.fixed_rows::<3>(0));
    middle[first] += center[0];
    middle[second] += center[1];
    let (sine, cosine) = angle.sin_cos();
    let mut end = moved(start, others);
    end[first] = middle[first] - cosine * center[0] + sine * center[1];
    end[second] = middle[second] - cosine * center[1] - sine * center[0];
    end[*across] += height;
    let turns = (angle.abs() / std::f64::consts::TAU) as i32;
    Some(Goal {
        end,
        circle: Some(Circle {
            center: middle,
            normal: Vector3::ith(*across, 1.0),
            revolutions: if *angle > 0.0 { turns } else { -1 - turns },
        }),
    })
}

/// With A B C U V W moved.
fn moved(start: &Axes, others: &[f64; 6]) -> Axes {
    let mut end = *start;
    for (coordinate, other) in end.iter_mut().skip(3).zip(others) {
        *coordinate += other;
    }
    end
}
