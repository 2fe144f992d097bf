//! Ordinary programs that once ended in a fault of the planner itself, or not at all.

use crate::common::{Machine, equal_limits, feed_move, with_room};
use framepath::axes::Axes;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::MoveRequest;

/// Lines to X Y Z with F in mm/min, infinite for a rapid move, each sent in a servo period of its own;
/// G64 with this P. How many servo periods it takes.
fn run(jerk: f64, tolerance: f64, lines: &[([f64; 3], f64)]) -> usize {
    let mut machine = Machine::new(equal_limits(jerk));
    let mode = TerminationCondition::Continuous { tolerance };
    machine.planner.set_termination(mode);
    let mut cycles = 0;
    for ([x, y, z], feed) in lines {
        let end = Axes::from([*x, *y, *z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let request = if feed.is_finite() {
            feed_move(feed / 60.0)
        } else {
            MoveRequest {
                motion_type: MotionType::Traverse,
                ..feed_move(1e3)
            }
        };
        machine.line(end, &request).expect("a line");
        machine.cycle();
        cycles += 1;
    }
    cycles += machine.run(100_000);
    assert_eq!(machine.planner.status().position, *machine.planner.goal());
    let extremes = machine.extremes();
    assert!(extremes.velocity <= 1.001, "{extremes:?}");
    assert!(extremes.acceleration <= 1.001, "{extremes:?}");
    assert!(extremes.jerk <= 1.05, "{extremes:?}");
    cycles
}

/// Beside a rest after some nanometres the plan's intervals last microseconds: more of them than were
/// taken in a servo period, which the executor had then nothing left to run on.
#[test]
fn a_first_move_of_nanometres_starves_nobody() {
    let program = [
        ([0.0, 1e-5, 0.0], 1658.0),
        ([0.0, 1e-5, -0.00089], 1106.6),
        ([1.0, 1e-5, -0.00089], 1200.0),
        ([1.0, 1e-5, 50.0], f64::INFINITY),
    ];
    for jerk in [f64::INFINITY, 1e6, 1e5, 2e4] {
        with_room(|| run(jerk, 0.0, &program));
    }
}

/// The jerk of one servo period is .3 of the acceleration at most, whatever the limit says: with more
/// the arcs at rest are too short for the rounding of path distance.
#[test]
fn any_limit_of_jerk_gives_a_plan() {
    let program = [
        ([20.0, 0.0, 0.0], 6000.0),
        ([20.0, 20.0, 0.0], 6000.0),
        ([40.0, 21.0, 0.0], f64::INFINITY),
    ];
    let unlimited = with_room(|| run(f64::INFINITY, 0.05, &program));
    for jerk in [2e6, 1e7, 1e9, 1e12, 1e300] {
        let periods = with_room(|| run(jerk, 0.05, &program));
        assert_eq!(periods, unlimited, "at a jerk of {jerk}");
    }
}

/// Where a slow stretch of some nanometres is left the sweep once grew many times over in one interval,
/// which no lower bound cures: no plan was found.
#[test]
fn a_slow_stretch_of_nanometres_is_left_again() {
    let program = [
        ([-0.0002, 0.0, 0.0], 2.0),
        ([-0.000_200_2, 1e-7, 4e-7], 0.025),
        ([0.0016, 0.0005, 0.00175], 0.5),
        ([0.0016, 0.5, 0.00175], 600.0),
    ];
    for jerk in [f64::INFINITY, 1e6] {
        for tolerance in [0.0, 0.016] {
            with_room(|| run(jerk, tolerance, &program));
        }
    }
}

/// Where F changes within a wide blend the nodes that the slow feed asks for were placed all over it.
#[test]
fn steps_of_the_feed_ask_for_no_rest() {
    let mut program = Vec::new();
    for corner in 0..6 {
        let x = f64::from(corner);
        program.push(([x, 0.01, 0.0], 6000.0));
        program.push(([x + 0.005, 0.0, 0.0], 3.0));
    }
    for jerk in [f64::INFINITY, 1e5] {
        let periods = with_room(|| run(jerk, 0.05, &program));
        assert!(periods < 2000, "{periods} at a jerk of {jerk}");
    }
}

/// Behind the end of a reference nothing is asked for: that counted as a cap of 0 in its last period, and
/// a machine that was held there, with the override lowered, never came to the end.
#[test]
fn a_hold_in_the_last_period_leads_to_the_end() {
    with_room(|| {
        for held in 195..220 {
            let mut machine = Machine::new(equal_limits(2e4));
            machine.inputs.feed_scale = 1.13;
            let end = Axes::z() * 0.0003;
            machine.line(end, &feed_move(0.0012)).expect("a line");
            for _ in 0..held {
                machine.cycle();
            }
            machine.planner.pause();
            machine.inputs.feed_scale = 0.5;
            for _ in 0..20 {
                machine.cycle();
            }
            machine.planner.resume();
            machine.run(200);
            assert_eq!(machine.planner.status().position, end);
        }
    });
}
