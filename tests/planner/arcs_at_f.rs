//! Small arcs, which LinuxCNC hands over with less than F: they are as fast as other moves of the program with the same F.

use framepath::moves::shape::Circle;
use framepath::moves::{FeedWord, MotionType, UNITS_PER_MINUTE};
use framepath::planner::MoveRequest;

use crate::common::{Machine, at, feed_move, with_machine};

/// F 3000 in millimetres, as the state tag of LinuxCNC's moves has it.
fn word() -> Option<FeedWord> {
    FeedWord::of_tag(3000.0, UNITS_PER_MINUTE)
}

/// A quarter of a circle of R 2 that LinuxCNC has slowed down to 20 mm/s, and the greatest speed in it.
fn on_slow_arc(machine: &mut Machine) -> f64 {
    let start = *machine.planner.goal();
    let circle = Circle {
        center: start.fixed_rows::<3>(0) + at(0.0, 2.0).fixed_rows::<3>(0),
        normal: [0.0, 0.0, 1.0].into(),
        revolutions: 0,
    };
    let slow = MoveRequest {
        motion_type: MotionType::Arc,
        max_velocity: 20.0,
        ..feed_move(20.0)
    };
    machine.planner.set_feed_word(word());
    let arc = machine.circle(start + at(2.0, 2.0), &circle, &slow);
    arc.expect("an arc");
    let mut greatest = 0.0f64;
    for _ in 0..2000 {
        let status = machine.cycle();
        if status.done {
            return greatest;
        }
        if status.motion_type == Some(MotionType::Arc) {
            greatest = greatest.max(status.current_velocity);
        }
    }
    panic!("not done");
}

/// LinuxCNC hands small arcs over with less than F. What F is tell other moves of the same program alone.
#[test]
fn what_is_known_of_f_is_forgotten_when_all_moves_are_done() {
    with_machine(|machine| {
        assert!(on_slow_arc(machine) <= 20.01);
        machine.planner.set_feed_word(word());
        let end = machine.planner.goal() + at(5.0, 0.0);
        machine.line(end, &feed_move(50.0)).expect("a line");
        let with_line = on_slow_arc(machine);
        assert!(with_line > 25.0, "{with_line}");
        let alone = on_slow_arc(machine);
        assert!(alone <= 20.01, "{alone}");
    });
}
