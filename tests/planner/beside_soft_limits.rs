//! The path keeps clear of soft limits that it reaches by more than P: rotary axes with a tolerance of their own, and joints behind
//! a frame that enlarges.

use crate::at_soft_limits::{Cartesian, ROUNDING};
use crate::common::{Machine, equal_limits, feed_move, with_room};
use framepath::axes::Axes;
use framepath::machine::JOINT_COUNT;
use framepath::moves::TerminationCondition;
use framepath::planner::range::JointRange;

/// Lines of which the path leads to the outer side, near a limit: how far the limited axis is, and another one.
struct Nearing {
    places: &'static [[f64; 2]],
    /// The axis of the joint, and how far it goes for one unit; the other one is Y.
    axis: usize,
    unit: f64,
    /// P, machine units.
    tolerance: f64,
    /// Degrees, and the axis that tilts the tool.
    rotary_tolerance: f64,
    tilt: Option<usize>,
    /// What a frame enlarges by.
    scale: f64,
    /// How far the limit is from what is programmed, of the joint.
    gap: f64,
}

/// How far the joint goes beyond what is programmed, with the limit so far away.
fn outside(nearing: &Nearing, gap: f64) -> f64 {
    let mut range = JointRange {
        least: [f64::NEG_INFINITY; JOINT_COUNT],
        greatest: [f64::INFINITY; JOINT_COUNT],
        count: 6,
        ..JointRange::NONE
    };
    range.greatest[nearing.axis] = gap;
    let mut solver = Cartesian {
        scale: nearing.scale,
    };
    let mut machine = Machine::new(equal_limits(20_000.0));
    let planner = &mut machine.planner;
    planner
        .set_blending(1.0, nearing.rotary_tolerance, 0.02)
        .expect("tolerances");
    planner.set_tilt_axis(nearing.tilt);
    planner.set_termination(TerminationCondition::Continuous {
        tolerance: nearing.tolerance,
    });
    planner.wait_for_range_check(true);
    let mut places = nearing.places.iter().map(|[limited, other]| {
        let mut place = Axes::zeros();
        (place[nearing.axis], place[1]) = (nearing.unit * limited, *other);
        place
    });
    let start = places.next().expect("a start");
    planner.set_position(&start).expect("a position");
    let mut furthest = f64::NEG_INFINITY;
    loop {
        if let Some(place) = places.next() {
            machine.line(place, &feed_move(40.0)).expect("a line");
        }
        let joints = solver.joints(&machine.planner.status().position);
        let finding = machine.planner.check_range(&range, &joints, &mut solver);
        assert!(finding.is_none(), "{finding:?}");
        let status = machine.cycle();
        furthest = furthest.max(solver.joints(&status.position)[nearing.axis]);
        if status.done && places.len() == 0 {
            break furthest;
        }
    }
}

/// What would lead beyond the limit keeps to the inner side.
fn keeps_inside(nearing: &Nearing) {
    let [without, with] = [1e3, nearing.gap].map(|gap| with_room(|| outside(nearing, gap)));
    assert!(without > nearing.gap, "{without}");
    assert!(with <= ROUNDING, "{with}");
}

#[test]
fn a_rotary_axis_with_a_tolerance_of_its_own() {
    keeps_inside(&Nearing {
        places: &[
            [-2.382, 0.0],
            [-3.012, 0.336],
            [-3.643, 0.672],
            [-3.372, 1.333],
            [-1.755, 2.801],
            [-1.226, 3.282],
            [-0.513, 3.321],
            [0.0, 3.361],
            [0.0, 3.455],
            [0.0, 3.495],
            [0.0, 4.144],
        ],
        axis: 3,
        unit: 3.0,
        tolerance: 0.0175,
        rotary_tolerance: 0.5,
        tilt: None,
        scale: 1.0,
        gap: 0.075,
    });
}

#[test]
fn a_rotary_axis_that_turns_the_tool_next_to_the_pole() {
    keeps_inside(&Nearing {
        places: &[
            [-1.0, 0.0],
            [-0.971, 0.299],
            [-0.92, 0.594],
            [-0.696, 1.554],
            [-0.588, 2.021],
            [-0.334, 2.912],
            [-0.163, 3.536],
            [0.0, 4.242],
            [0.0, 4.531],
            [0.0, 4.821],
            [0.0, 5.11],
        ],
        axis: 5,
        unit: 30.0,
        tolerance: 0.0175,
        rotary_tolerance: 0.2,
        tilt: Some(3),
        scale: 1.0,
        gap: 0.08,
    });
}

#[test]
fn behind_a_frame_that_enlarges() {
    keeps_inside(&Nearing {
        places: &[
            [0.0, 0.0],
            [-0.9, 0.1],
            [0.0, 0.2],
            [0.0, 0.3],
            [0.0, 0.4],
            [0.0, 0.5],
            [0.0, 0.6],
        ],
        axis: 0,
        unit: 1.0,
        tolerance: 0.044,
        rotary_tolerance: 0.0,
        tilt: None,
        scale: 50.0,
        gap: 0.3,
    });
}
