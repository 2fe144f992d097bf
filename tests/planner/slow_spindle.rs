//! Feed per turn of a spindle whose speed changes slowly, as with a constant surface speed.

use crate::common::lathe::{Lathe, SPINDLE, keeps_limits};
use crate::common::{Machine, PERIOD, feed_move, with_room, xyz};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::MoveRequest;

const PER_TURN: f64 = 0.15;

/// Turns a second at the centre, for which the moves are planned ..
const AT_CENTRE: f64 = 41.7;

/// .. and where they are run.
const AT_RADIUS: f64 = 9.0;

/// A rapid from the centre and two lines outwards.
fn queue(machine: &mut Machine) {
    let rapid = MoveRequest {
        motion_type: MotionType::Traverse,
        ..feed_move(500.0)
    };
    let planner = &mut machine.planner;
    planner.set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
    planner
        .add_line(&xyz(35.0, 0.0, -1.6), &rapid)
        .expect("a rapid");
    planner.set_spindle_synchronisation(SPINDLE as i32, PER_TURN, true);
    for end in [xyz(36.7, 0.0, -2.3), xyz(38.2, 0.0, -2.4)] {
        planner.add_line(&end, &feed_move(5.0)).expect("a line");
    }
}

/// Least and greatest share of the feed per turn, away from the corner and the ends, at a spindle that becomes faster by `change`
/// turns a second squared.
fn shares(acceleration: f64, jerk: f64, change: f64) -> (f64, f64) {
    let mut machine = Machine::new(AxisLimits {
        velocity: Axes::repeat(500.0),
        acceleration: Axes::repeat(acceleration),
        jerk: Axes::repeat(jerk),
    });
    let mut lathe = Lathe::new(&mut machine, AT_CENTRE);
    queue(lathe.machine);
    lathe.cycle();
    lathe.speed = AT_RADIUS;
    lathe.commanded = AT_RADIUS + 4.0 * change;
    lathe.acceleration = change.abs();
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    let mut last = lathe.machine.planner.status().position;
    for _ in 0..10_000 {
        let status = lathe.cycle();
        if status.done {
            break;
        }
        let position = status.position;
        let place = position[0];
        if (35.3..36.5).contains(&place) || (36.9..37.8).contains(&place) {
            let share = (position - last).norm() / PERIOD / (PER_TURN * lathe.speed);
            (least, greatest) = (least.min(share), greatest.max(share));
        }
        last = position;
    }
    assert!(lathe.machine.planner.status().done);
    keeps_limits(lathe.machine);
    (least, greatest)
}

/// Where a period's jerk changes such a feed by a third, the approach to a cap that moves led beyond it and back in every period,
/// until only the hardest braking was left: the feed fell to a third, again and again.
#[test]
fn feed_per_turn_follows_a_spindle_evenly_that_changes_slowly() {
    with_room(|| {
        for (acceleration, jerk) in [
            (1000.0, 20_000.0),
            (1000.0, 100_000.0),
            (5000.0, 100_000.0),
            (5000.0, 500_000.0),
            (5000.0, 1_000_000.0),
            (5000.0, f64::INFINITY),
        ] {
            for change in [0.2, -0.2, 1.0, -1.0] {
                let (least, greatest) = shares(acceleration, jerk, change);
                assert!(
                    least > 0.99 && greatest < 1.005,
                    "{acceleration} {jerk} {change}: {least} to {greatest}"
                );
            }
        }
    });
}
