//! Behind a programmed frame the limits hold for the axes of the machine.

use crate::common::{Machine, at, equal_limits, feed_move, with_machine, with_room};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::machine_map::MachineMap;
use framepath::moves::shape::Circle;
use framepath::planner::{AddError, Added};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

/// A rotation with scales and mirrors.
fn any_map() -> impl Strategy<Value = Matrix3<f64>> {
    let angle = || -3.2..3.2f64;
    let factor = || prop_oneof![0.2..3.0f64, -3.0..-0.2f64];
    ((angle(), angle(), angle()), (factor(), factor(), factor())).prop_map(
        |((roll, pitch, yaw), (x, y, z))| {
            Rotation3::from_euler_angles(roll, pitch, yaw).into_inner()
                * Matrix3::from_diagonal(&Vector3::new(x, y, z))
        },
    )
}

/// A machine behind a frame, with the positions of its axes instead of those of the program.
fn run_behind(
    map: &Matrix3<f64>,
    add: impl FnOnce(&mut Machine) + Send,
) -> crate::common::Extremes {
    with_room(|| {
        let mut machine = Machine::new(equal_limits(20_000.0));
        assert!(machine.planner.set_machine_map(map));
        add(&mut machine);
        assert!(
            !machine.planner.set_machine_map(&Matrix3::identity()),
            "refused while a move is queued"
        );
        // Some operator: a slow start, a hold, full speed.
        machine.inputs.feed_scale = 0.6;
        for cycle in 0..700 {
            machine.scaled_cycle(if (300..500).contains(&cycle) {
                0.0
            } else {
                1.0
            });
        }
        machine.inputs.feed_scale = 1.0;
        machine.run(500_000);
        let map = MachineMap::new(map).expect("finite");
        for position in &mut machine.positions {
            *position = map.apply(position);
        }
        machine.extremes()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_line(map in any_map(), end in prop::array::uniform3(-80.0..80.0f64), feed in 5.0..300.0f64) {
        let end = Axes::from([end[0], end[1], end[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let extremes = run_behind(&map, |machine| {
            machine.line(end, &feed_move(feed)).expect("a line");
        });
        prop_assert!(extremes.velocity <= 1.001 && extremes.acceleration <= 1.001, "{extremes:?}");
        prop_assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    }

    #[test]
    fn an_arc(map in any_map(), radius in 0.5..60.0f64, feed in 5.0..300.0f64, revolutions in -2..2i32) {
        let circle = Circle { center: Vector3::new(radius, 0.0, 0.0), normal: Vector3::z(), revolutions };
        let extremes = run_behind(&map, |machine| {
            machine.circle(at(radius, radius), &circle, &feed_move(feed)).expect("an arc");
        });
        prop_assert!(extremes.velocity <= 1.001 && extremes.acceleration <= 1.001, "{extremes:?}");
        prop_assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    }
}

#[test]
fn a_turned_line_takes_what_its_joints_allow() {
    // 45 degrees: along X of the program both axes of the machine move, each at 0.707 of the speed
    let turn = Rotation3::from_euler_angles(0.0, 0.0, 45f64.to_radians()).into_inner();
    let extremes = run_behind(&turn, |machine| {
        machine
            .line(at(200.0, 0.0), &feed_move(1000.0))
            .expect("a line");
    });
    assert!(
        extremes.velocity > 0.999 && extremes.velocity <= 1.001,
        "{extremes:?}"
    );
}

/// With a scale along its axis the pitch of a thread would be scaled as well.
#[test]
fn a_thread_or_tap_that_the_frame_scales_is_refused() {
    let scale = |x, z| Matrix3::from_diagonal(&Vector3::new(x, 1.0, z));
    let turn = Rotation3::from_euler_angles(0.3, -0.5, 2.0).into_inner();
    let refused = Err(AddError::ScaledPitch);
    let queued = Ok(Added::Queued);
    for (map, expected) in [
        (scale(1.0, 2.0), refused),
        (scale(1.0, 0.999), refused),
        (turn * scale(1.0, 2.0), refused),
        (scale(3.0, 1.0), queued),
        (scale(-1.0, -1.0), queued),
        (turn, queued),
    ] {
        with_machine(|machine| {
            assert!(machine.planner.set_machine_map(&map));
            let deep = Axes::from([0.0, 0.0, -10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let request = feed_move(50.0);
            machine.planner.set_spindle_synchronisation(0, 2.0, false);
            let tap = machine.planner.add_rigid_tap(&deep, 1.0, &request);
            assert_eq!(tap, expected);
            assert_eq!(machine.line(deep, &request), expected);
        });
        with_machine(|machine| {
            assert!(machine.planner.set_machine_map(&map));
            // Feed per turn is a feed, and counts in the frame as F does.
            machine.planner.set_spindle_synchronisation(0, 0.1, true);
            assert_eq!(machine.line(at(5.0, 0.0), &feed_move(50.0)), queued);
        });
    }
}

#[test]
fn an_axis_that_a_frame_moves_needs_limits() {
    let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    for (map, moved) in [(Matrix3::identity(), 0), (quarter_turn, 1)] {
        for without in 0..4 {
            with_machine(|machine| {
                let mut limits = equal_limits(20_000.0);
                limits.acceleration[without] = 0.0;
                machine.planner.set_limits(&limits);
                assert!(machine.planner.set_machine_map(&map));
                let added = machine.line(at(5.0, 0.0), &feed_move(10.0));
                let refused = Err(AddError::AxisLimits { axis: without });
                let expected = if without == moved {
                    refused
                } else {
                    Ok(Added::Queued)
                };
                assert_eq!(added, expected);
            });
        }
    }
}
