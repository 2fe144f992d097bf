//! Frames on a running machine: commands, slots, refusals and switches, with motion played.

use crate::common::Motion;
use framepath::kinematics::FrameRefusal;
use framepath::kinematics::check::check_sum;
use framepath::kinematics::control::FrameInputs;
use framepath::kinematics::release::SETTLED;

fn xyz() -> Motion {
    Motion::new("identity", "XYZ")
}

#[test]
fn slots_are_used_in_turn() {
    let mut motion = xyz();
    let mut slots = Vec::new();
    for n in 0..4 {
        assert_eq!(motion.send(1, [f64::from(n), 0.0, 0.0]), None);
        slots.push(motion.out.slot);
    }
    assert_eq!(motion.send(9, [0.0; 3]), None);
    slots.push(motion.out.slot);
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    slots.push(motion.out.slot);
    assert_eq!(slots, [1, 2, 1, 2, 0, 1]);
}

#[test]
fn commands_replace_or_add() {
    let mut motion = xyz();
    assert_eq!(motion.send(1, [55.0, 35.0, 0.0]), None);
    assert_eq!(motion.send(103, [90.0, 2.0, 0.0]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [55.0, 45.0, 0.0]);
    assert_eq!((motion.out.operations, motion.out.active), (2, true));
    assert_eq!(motion.send(107, [2.0, 2.0, 2.0]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [55.0, 55.0, 0.0]);
    // Scales alone are dropped.
    assert_eq!(motion.send(10, [0.0; 3]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [55.0, 45.0, 0.0]);
    assert_eq!(motion.send(8, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [-10.0, 0.0, 0.0]);
    assert_eq!(motion.out.operations, 1);
    // A map, and what follows it starts anew.
    motion.inputs.map[3] = 7.0;
    assert_eq!(motion.send(12, [0.0; 3]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [17.0, 0.0, 0.0]);
    assert_eq!(motion.send(101, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [11.0, 0.0, 0.0]);
}

#[test]
fn a_suspended_frame_comes_back() {
    let mut motion = xyz();
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    assert_eq!(motion.send(13, [0.0; 3]), None);
    assert!(!motion.out.active);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [1.0, 0.0, 0.0]);
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
}

#[test]
fn what_only_keeps_a_frame_does_not_bring_it_back() {
    let mut motion = xyz();
    assert_eq!(motion.send(3, [90.0, 2.0, 0.0]), None);
    motion.inputs.work_offset = [10.0, 0.0, 0.0];
    assert_eq!(motion.send(15, [0.0; 3]), None);
    assert_eq!(motion.machine([11.0, 0.0, 0.0]), [10.0, 1.0, 0.0]);
    assert_eq!(motion.send(13, [0.0; 3]), None);
    motion.inputs.work_offset = [20.0, 0.0, 0.0];
    for code in [14, 15, 15] {
        assert_eq!(motion.send(code, [0.0; 3]), None);
        assert_eq!((motion.out.active, motion.out.operations), (false, 1));
        assert_eq!(motion.machine([1.0, 0.0, 0.0]), [1.0, 0.0, 0.0]);
    }
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([21.0, 0.0, 0.0]), [20.0, 1.0, 0.0]);
    // without a frame there is nothing to keep
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert_eq!(motion.send(15, [0.0; 3]), None);
    assert_eq!((motion.out.active, motion.out.operations), (false, 0));
}

#[test]
fn a_question_changes_nothing() {
    let mut motion = xyz();
    assert_eq!(motion.send(14, [0.0; 3]), None);
    assert_eq!((motion.out.slot, motion.out.active), (0, false));
    assert_eq!(motion.send(1, [55.0, 35.0, 0.0]), None);
    assert_eq!(motion.send(14, [0.0; 3]), None);
    assert_eq!(motion.machine([10.0, 0.0, 0.0]), [65.0, 35.0, 0.0]);
    assert_eq!(motion.out.operations, 1);
    assert_eq!(
        motion.send(114, [0.0; 3]),
        Some(FrameRefusal::UnknownCommand)
    );
}

#[test]
fn removing_nothing_needs_no_switch() {
    let mut motion = xyz();
    motion.linked = false;
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert_eq!((motion.out.active, motion.out.slot), (false, 0));
}

#[test]
fn a_refusal_keeps_the_old_frame() {
    let mut motion = xyz();
    assert_eq!(motion.send(1, [5.0, 6.0, 7.0]), None);
    let refusals = [
        (1, [f64::NAN, 0.0, 0.0], FrameRefusal::NotFinite),
        (2, [0.0, f64::INFINITY, 0.0], FrameRefusal::NotFinite),
        (3, [10.0, f64::NAN, 0.0], FrameRefusal::NotFinite),
        (8, [f64::NAN, 0.0, 0.0], FrameRefusal::NotFinite),
        (3, [10.0, 3.0, 0.0], FrameRefusal::UnknownCommand),
        (3, [10.0, 0.5, 0.0], FrameRefusal::UnknownCommand),
        (4, [10.0, 20.0, 2.0], FrameRefusal::UnknownCommand),
        (0, [0.0; 3], FrameRefusal::UnknownCommand),
        (16, [0.0; 3], FrameRefusal::UnknownCommand),
        (109, [0.0; 3], FrameRefusal::UnknownCommand),
        (999, [0.0; 3], FrameRefusal::UnknownCommand),
        (107, [1.0, 0.0, 1.0], FrameRefusal::ZeroScale),
        (101, [1e7, 0.0, 0.0], FrameRefusal::TranslationTooLarge),
        (4, [90.0, 45.0, 0.0], FrameRefusal::ImpossibleAngles),
        (7, [1.0, 1.0, 1000.0], FrameRefusal::IllConditioned),
        (7, [2000.0, 2000.0, 2000.0], FrameRefusal::ScaleOutOfRange),
    ];
    for (code, value, refusal) in refusals {
        assert_eq!(motion.send(code, value), Some(refusal), "{code} {value:?}");
        assert_eq!(motion.machine([1.0, 1.0, 1.0]), [6.0, 7.0, 8.0]);
        assert_eq!(motion.out.operations, 1);
    }
    motion.inputs.map[10] = 0.0;
    assert_eq!(motion.send(12, [0.0; 3]), Some(FrameRefusal::Singular));
    motion.inputs.work_offset[1] = f64::NAN;
    assert_eq!(motion.send(11, [0.0; 3]), Some(FrameRefusal::NotFinite));
    motion.inputs.work_offset[1] = 0.0;
    // And the next command is carried out as if nothing had been.
    assert_eq!(motion.send(101, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([1.0, 1.0, 1.0]), [7.0, 7.0, 8.0]);
}

#[test]
fn alternating_operations_fill_the_list() {
    let mut motion = xyz();
    let mut refused = None;
    for _ in 0..100 {
        for (code, value) in [
            (107, [1.5, 1.0, 1.0]),
            (103, [30.0, 2.0, 0.0]),
            (107, [1.0 / 1.5, 1.0, 1.0]),
        ] {
            refused = refused.or(motion.send(code, value));
        }
    }
    assert!(matches!(
        refused,
        Some(FrameRefusal::TooManyOperations | FrameRefusal::IllConditioned)
    ));
}

#[test]
fn nonsense_on_the_command_pin_is_no_command() {
    let mut motion = xyz();
    for command in [
        f64::NAN,
        f64::INFINITY,
        -1.0,
        -77_001.0,
        0.0,
        999.0,
        -f64::MAX,
    ] {
        motion.inputs.command = command;
        let before = motion.out;
        motion.period();
        assert_eq!(motion.out, before, "{command}");
    }
    // A number with a code that is none.
    for command in [77_000.5, 77_001.25, f64::MAX] {
        motion.inputs.command = command;
        motion.inputs.check = check_sum(&motion.inputs);
        motion.period();
        assert_eq!(
            motion.out.refusal,
            Some(FrameRefusal::UnknownCommand),
            "{command}"
        );
        assert!(!motion.out.active);
        motion.inputs.command = 88_009.0;
        motion.period();
        assert_eq!(motion.out.refusal, None);
    }
}

#[test]
fn numbers_may_start_again() {
    let mut motion = xyz();
    motion.number = 99_998.0;
    assert_eq!(motion.send(1, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.out.acknowledged, 99_999.0);
    motion.number = 0.0;
    assert_eq!(motion.send(1, [2.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([0.0; 3]), [2.0, 0.0, 0.0]);
    // The same number again is the same command.
    motion.inputs.value = [9.0, 9.0, 9.0];
    motion.period();
    assert_eq!(motion.machine([0.0; 3]), [2.0, 0.0, 0.0]);
}

#[test]
fn moving_teleop_and_external_offsets_refuse_at_both_ends() {
    type Change = fn(&mut FrameInputs, bool);
    let changes: [(Change, FrameRefusal); 4] = [
        (|inputs, on| inputs.in_position = !on, FrameRefusal::Moving),
        (|inputs, on| inputs.teleop = on, FrameRefusal::Teleop),
        (
            |inputs, on| inputs.offsets_move = on,
            FrameRefusal::OffsetsMove,
        ),
        (
            |inputs, on| inputs.unknown_offset = on,
            FrameRefusal::UnknownOffset,
        ),
    ];
    for (change, refusal) in changes {
        let mut motion = xyz();
        assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
        // When the command comes.
        change(&mut motion.inputs, true);
        assert_eq!(motion.send(1, [6.0, 0.0, 0.0]), Some(refusal));
        change(&mut motion.inputs, false);
        // Between the request and the switch.
        for code in [1, 9] {
            motion.put(code, [0.0; 3]);
            motion.out = motion.control.update(&motion.inputs);
            change(&mut motion.inputs, true);
            motion.period();
            assert_eq!(motion.out.refusal, Some(refusal));
            assert_eq!(motion.machine([0.0; 3]), [5.0, 0.0, 0.0]);
            change(&mut motion.inputs, false);
        }
        // Motion remembers the number that it was refused: another one is asked for.
        assert_eq!(motion.send(9, [0.0; 3]), None);
        assert!(!motion.out.active);
        assert_eq!(motion.send(1, [6.0, 0.0, 0.0]), None);
        assert_eq!(motion.machine([0.0; 3]), [6.0, 0.0, 0.0]);
    }
}

#[test]
fn a_switch_that_nobody_makes_is_given_up() {
    let mut motion = xyz();
    motion.linked = false;
    assert_eq!(
        motion.send(1, [5.0, 0.0, 0.0]),
        Some(FrameRefusal::NotSwitched)
    );
    // Linked later: nothing happens by itself.
    motion.linked = true;
    for _ in 0..5 {
        motion.period();
    }
    assert!(!motion.out.active);
    assert_eq!(motion.type_seen, 0);
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([0.0; 3]), [5.0, 0.0, 0.0]);
}

#[test]
fn motion_may_take_a_hundred_periods_to_switch() {
    for (periods, taken) in [
        (0, true),
        (1, true),
        (100, true),
        (101, false),
        (200, false),
    ] {
        let mut motion = xyz();
        motion.linked = false;
        for _ in 0..SETTLED {
            motion.period();
        }
        motion.put(1, [5.0, 0.0, 0.0]);
        for _ in 0..=periods {
            motion.period();
        }
        motion.linked = true;
        motion.period();
        assert_eq!(motion.out.active, taken, "after {periods} periods");
        let refusal = (!taken).then_some(FrameRefusal::NotSwitched);
        assert_eq!(motion.out.refusal, refusal, "after {periods} periods");
    }
}

/// A command as soon as motion stood took the pose of a period in which motion's interpolator still ran on: 2e-5 mm short
/// with 20000 mm/s3.
#[test]
fn a_command_waits_until_the_interpolator_of_motion_stands() {
    let mut motion = xyz();
    for standing in 0..=SETTLED {
        motion.inputs.in_position = false;
        motion.period();
        motion.inputs.in_position = true;
        for _ in 0..standing {
            motion.period();
        }
        motion.put(1, [f64::from(standing + 1), 0.0, 0.0]);
        let asked = motion.out.switchkins_type;
        for _ in standing..SETTLED {
            motion.period();
            assert_eq!(motion.out.switchkins_type, asked, "{standing}");
            assert_eq!(motion.out.refusal, None, "{standing}");
        }
        motion.period();
        assert_ne!(motion.out.switchkins_type, asked, "{standing}");
        motion.period();
        assert!(motion.out.active, "{standing}");
    }
}

#[test]
fn by_hand() {
    let mut motion = xyz();
    motion.inputs.map[3] = 3.0;
    assert_eq!(motion.switch(1), Ok(()));
    motion.out = motion.control.update(&motion.inputs);
    assert_eq!((motion.out.slot, motion.out.active), (1, true));
    assert_eq!(motion.machine([0.0; 3]), [3.0, 0.0, 0.0]);
    for kind in [-1, 3, i32::MIN, i32::MAX] {
        let result = motion.switch(kind);
        assert_eq!(result, Err(FrameRefusal::UnknownType));
    }
    assert_eq!(motion.machine([0.0; 3]), [3.0, 0.0, 0.0]);
    assert_eq!(motion.switch(0), Ok(()));
    assert_eq!(motion.machine([0.0; 3]), [0.0; 3]);
}

#[test]
fn a_lathe_has_no_y_to_turn_into() {
    let mut lathe = Motion::new("identity", "XZ");
    for (code, value) in [
        (1, [10.0, 0.0, 5.0]),
        (2, [0.0, 30.0, 0.0]),
        (7, [2.0, 2.0, 2.0]),
        (8, [0.0, 1.0, 1.0]),
    ] {
        assert_eq!(lathe.send(code, value), None, "{code}");
    }
    assert_eq!(lathe.send(1, [1.0, 0.0, 0.0]), None);
    for (code, value) in [
        (101, [0.0, 1.0, 0.0]),
        (2, [0.0, 0.0, 30.0]),
        (102, [30.0, 0.0, 0.0]),
    ] {
        assert_eq!(
            lathe.send(code, value),
            Some(FrameRefusal::MissingAxis),
            "{code}"
        );
        assert_eq!(lathe.machine([0.0; 3]), [1.0, 0.0, 0.0]);
    }
}

#[test]
fn a_frame_is_removed_whatever_the_tool_offset_is() {
    let mut motion = xyz();
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    motion.inputs.tool_offset = [1.0, f64::NAN, f64::INFINITY];
    for code in [13, 9] {
        assert_eq!(motion.send(code, [0.0; 3]), None);
        assert!(!motion.out.active);
        assert_eq!(motion.out.tool_offset, [1.0, 0.0, 0.0]);
    }
    assert_eq!(
        motion.send(1, [5.0, 0.0, 0.0]),
        Some(FrameRefusal::NotFinite)
    );
}

#[test]
fn nothing_is_added_to_a_suspended_frame() {
    let mut motion = xyz();
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    assert_eq!(motion.send(13, [0.0; 3]), None);
    for (code, value) in [(101, [1.0, 0.0, 0.0]), (107, [2.0; 3]), (10, [0.0; 3])] {
        let refusal = motion.send(code, value);
        assert_eq!(refusal, Some(FrameRefusal::Suspended), "{code}");
        assert_eq!(motion.machine([1.0, 0.0, 0.0]), [1.0, 0.0, 0.0]);
    }
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
    // one that begins anew takes its place
    assert_eq!(motion.send(13, [0.0; 3]), None);
    assert_eq!(motion.send(1, [7.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [8.0, 0.0, 0.0]);
    // a frame of which nothing is left is not suspended
    assert_eq!(motion.send(7, [2.0; 3]), None);
    assert_eq!(motion.send(10, [0.0; 3]), None);
    assert_eq!((motion.out.active, motion.out.operations), (false, 0));
    assert_eq!(motion.send(101, [1.0, 0.0, 0.0]), None);
}

#[test]
fn the_work_offset_that_is_shown_is_that_of_the_frame() {
    let mut motion = xyz();
    motion.inputs.work_offset = [10.0, 20.0, 30.0];
    motion.inputs.work_rotation = 40.0;
    assert_eq!(motion.send(3, [90.0, 2.0, 0.0]), None);
    // a command that is refused has brought another one
    motion.inputs.work_offset = [50.0, 0.0, 0.0];
    motion.inputs.work_rotation = 0.0;
    assert_eq!(
        motion.send(107, [0.0, 1.0, 1.0]),
        Some(FrameRefusal::ZeroScale)
    );
    let shown = |motion: &Motion| (motion.out.work_offset, motion.out.work_rotation);
    assert_eq!(shown(&motion), ([10.0, 20.0, 30.0], 40.0));
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(shown(&motion), ([50.0, 0.0, 0.0], 0.0));
}
