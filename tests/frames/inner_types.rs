//! The kinematics of another module behind the frame, switched by programs and by frames.

use crate::common::Motion;
use framepath::kinematics::release::SETTLED;
use framepath::kinematics::{Behind, FrameRefusal, InnerType};

/// Kinematics of three types, of which the second turns the tool's length itself.
fn inner() -> Motion {
    let mut motion = Motion::before(Behind::Inner(InnerType::first(0b010)));
    motion.types = 3;
    motion
}

/// The type on the pin, and the three periods that it takes at most.
fn ask(motion: &mut Motion, number: f64) {
    motion.inputs.inner_type = number;
    for _ in 0..3 {
        motion.period();
    }
}

#[test]
fn without_a_frame_motion_is_asked_for_the_very_type() {
    let mut motion = inner();
    for number in [1, 2, 0, 2] {
        ask(&mut motion, f64::from(number));
        assert_eq!(motion.type_seen, number);
        assert_eq!((motion.out.inner_type, motion.out.slot), (number, 0));
        assert!(!motion.out.hold && motion.out.inner_refusal.is_none());
    }
    assert_eq!(motion.switched, [1, 2, 0, 2]);
}

#[test]
fn the_type_is_there_in_the_period_behind_that_of_the_pin() {
    let mut motion = inner();
    motion.period();
    motion.inputs.inner_type = 1.0;
    motion.period();
    assert_eq!((motion.out.switchkins_type, motion.out.hold), (1, true));
    motion.period();
    assert_eq!((motion.out.inner_type, motion.out.hold), (1, false));
}

#[test]
fn the_type_is_there_in_the_very_period_in_which_motion_looks() {
    let mut motion = inner();
    motion.period();
    motion.inputs.inner_type = 2.0;
    assert_eq!(motion.control.take_inner_type(&motion.inputs), 2);
    assert_eq!(motion.switch(2), Ok(()));
    motion.out = motion.control.update(&motion.inputs);
    assert_eq!((motion.out.inner_type, motion.out.hold), (2, false));
    // The same again is nothing new; in motion it waits.
    assert_eq!(motion.control.take_inner_type(&motion.inputs), 2);
    (motion.inputs.inner_type, motion.inputs.in_position) = (1.0, false);
    assert_eq!(motion.control.take_inner_type(&motion.inputs), 2);
}

#[test]
fn frames_leave_the_type_and_types_leave_the_frame() {
    let mut motion = inner();
    ask(&mut motion, 2.0);
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    assert_eq!(motion.type_seen, 16 + 2);
    ask(&mut motion, 1.0);
    assert_eq!(motion.out.inner_type, 1);
    assert!(motion.out.active);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
    assert_eq!(motion.send(1, [7.0, 0.0, 0.0]), None);
    assert_eq!(motion.out.inner_type, 1);
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert_eq!(motion.type_seen, 1);
    assert_eq!(motion.switched, [2, 1]);
}

#[test]
fn a_type_that_turns_the_tool_leaves_it_to_the_kinematics() {
    let mut motion = inner();
    motion.inputs.tool_offset = [0.0, 0.0, 10.0];
    // A quarter of a turn about Y: the tool's length is along X, or stays along Z.
    assert_eq!(motion.send(3, [90.0, 1.0, 0.0]), None);
    let tip = |motion: &Motion| motion.machine([0.0, 0.0, 10.0]).map(f64::round);
    assert_eq!(tip(&motion), [10.0, 0.0, 0.0]);
    ask(&mut motion, 1.0);
    assert_eq!(tip(&motion), [0.0, 0.0, 10.0]);
    assert!(motion.out.tool_centre_point);
    ask(&mut motion, 2.0);
    assert_eq!(tip(&motion), [10.0, 0.0, 0.0]);
    assert!(!motion.out.tool_centre_point);
}

#[test]
fn a_type_that_the_kinematics_do_not_have_is_asked_for_once() {
    let mut motion = inner();
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    motion.inputs.inner_type = 3.0;
    for _ in 0..300 {
        motion.period();
    }
    // And goes back to the one before, in whatever state it was left; so does motion's number.
    assert_eq!(motion.switched, [3, 0]);
    assert_eq!((motion.type_seen, motion.out.slot), (16, 1));
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
    let refused = Some(FrameRefusal::UnknownInnerType);
    assert_eq!(motion.out.inner_refusal, refused);
    assert!(motion.out.hold && motion.out.active);
    assert_eq!(motion.out.inner_type, 0);
    // A frame can go all the same, and no other come.
    assert_eq!(motion.send(1, [6.0, 0.0, 0.0]), refused);
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert!(!motion.out.active);
    ask(&mut motion, 0.0);
    assert_eq!((motion.out.inner_refusal, motion.out.hold), (None, false));
    assert_eq!(motion.type_seen, 0);
    assert_eq!(motion.send(1, [6.0, 0.0, 0.0]), None);
}

#[test]
fn what_is_no_type_never_reaches_motion() {
    for nonsense in [-1.0, 16.0, 0.5, f64::NAN, f64::INFINITY] {
        let mut motion = inner();
        ask(&mut motion, nonsense);
        assert_eq!(motion.type_seen, 0);
        assert_eq!(
            motion.out.inner_refusal,
            Some(FrameRefusal::UnknownInnerType)
        );
        assert!(motion.out.hold);
    }
}

#[test]
fn in_motion_and_in_teleop_the_type_waits_and_the_machine_is_held() {
    for (moving, refusal) in [(true, FrameRefusal::Moving), (false, FrameRefusal::Teleop)] {
        let mut motion = inner();
        (motion.inputs.in_position, motion.inputs.teleop) = (!moving, !moving);
        ask(&mut motion, 1.0);
        assert_eq!(motion.out.inner_refusal, Some(refusal));
        assert!(motion.out.hold && motion.switched.is_empty());
        (motion.inputs.in_position, motion.inputs.teleop) = (true, false);
        ask(&mut motion, 1.0);
        assert_eq!((motion.out.inner_type, motion.out.hold), (1, false));
    }
}

#[test]
fn the_type_waits_for_external_offsets_and_the_machine_is_held() {
    let mut motion = inner();
    motion.inputs.offsets_move = true;
    ask(&mut motion, 1.0);
    assert_eq!(motion.out.inner_refusal, Some(FrameRefusal::OffsetsMove));
    assert!(motion.out.hold && motion.switched.is_empty());
    // from the request on, too
    motion.inputs.offsets_move = false;
    motion.out = motion.control.update(&motion.inputs);
    motion.inputs.offsets_move = true;
    motion.period();
    assert_eq!((motion.out.inner_type, motion.out.hold), (0, true));
    motion.inputs.offsets_move = false;
    ask(&mut motion, 1.0);
    assert_eq!((motion.out.inner_type, motion.out.hold), (1, false));
}

#[test]
fn a_motion_that_is_not_linked_is_told_once() {
    let mut motion = inner();
    motion.linked = false;
    motion.inputs.inner_type = 1.0;
    for _ in 0..300 {
        motion.period();
    }
    assert_eq!(motion.out.inner_refusal, Some(FrameRefusal::NotSwitched));
    assert_eq!(motion.out.switchkins_type, 0);
    ask(&mut motion, 0.0);
    assert_eq!(motion.out.inner_refusal, None);
}

#[test]
fn a_frame_that_goes_by_itself_leaves_the_type() {
    let mut motion = inner();
    ask(&mut motion, 2.0);
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    motion.inputs.command = 0.0;
    for _ in 0..SETTLED + 3 {
        motion.period();
    }
    assert!(!motion.out.active);
    assert_eq!((motion.type_seen, motion.out.inner_type), (2, 2));
    assert_eq!(motion.out.releases, 1);
}

#[test]
fn a_suspended_frame_stays_away_when_the_type_changes() {
    let mut motion = inner();
    assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
    assert_eq!(motion.send(13, [0.0; 3]), None);
    ask(&mut motion, 2.0);
    assert_eq!((motion.type_seen, motion.out.active), (2, false));
    assert_eq!(motion.send(15, [0.0; 3]), None);
    assert_eq!((motion.out.inner_type, motion.out.active), (2, false));
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [6.0, 0.0, 0.0]);
}

#[test]
fn numbers_by_hand_are_slots_and_types() {
    let mut motion = inner();
    motion.inputs.map[3] = 7.0;
    for (number, answer) in [
        (48, Err(FrameRefusal::UnknownType)),
        (-1, Err(FrameRefusal::UnknownType)),
        (35, Err(FrameRefusal::UnknownInnerType)),
        (18, Ok(())),
    ] {
        assert_eq!(motion.switch(number), answer, "{number}");
        assert_eq!(motion.control.active().is_some(), answer.is_ok());
    }
    assert_eq!(motion.machine([1.0, 0.0, 0.0]), [8.0, 0.0, 0.0]);
    assert_eq!(motion.control.behind().inner_type(), 2);
}

#[test]
fn no_frame_comes_or_goes_where_joints_would_jump() {
    let mut motion = inner();
    let others = Some(FrameRefusal::OtherJoints);
    motion.inputs.other_joints = true;
    assert_eq!(
        motion.send(9, [0.0; 3]),
        None,
        "there is no frame to remove"
    );
    assert_eq!(motion.send(1, [1.0, 0.0, 0.0]), others);
    assert_eq!(motion.switch(16), Err(FrameRefusal::OtherJoints));
    motion.inputs.other_joints = false;
    assert_eq!(motion.send(1, [1.0, 0.0, 0.0]), None);
    motion.inputs.other_joints = true;
    assert_eq!(motion.send(9, [0.0; 3]), others);
    assert_eq!(motion.send(13, [0.0; 3]), others);
    // An abort waits until it can.
    motion.inputs.command = 0.0;
    for _ in 0..10 {
        motion.period();
    }
    assert!(motion.out.active && motion.out.releasing && !motion.out.hold);
    assert_eq!(motion.out.refusal, others);
    motion.inputs.other_joints = false;
    for _ in 0..10 {
        motion.period();
    }
    assert!(!motion.out.active);
}

#[test]
fn the_frame_that_comes_is_known_beforehand() {
    let mut motion = inner();
    for (code, comes) in [
        (1, true),
        (11, true),
        (13, false),
        (15, false),
        (2, true),
        (9, false),
    ] {
        motion.period();
        motion.put(code, [5.0, 0.0, 0.0]);
        let coming = motion.control.frame_of_command(&motion.inputs);
        assert_eq!(coming.is_some(), comes, "{code}");
        assert_eq!(motion.send(code, [5.0, 0.0, 0.0]), None);
        // once it is answered it brings nothing
        assert!(motion.control.frame_of_command(&motion.inputs).is_none());
    }
    for (number, comes) in [(16, true), (32, true), (0, false), (48, false)] {
        let coming = motion.control.frame_of_switch(number, &motion.inputs);
        assert_eq!(coming.is_some(), comes, "{number}");
    }
}

#[test]
fn a_frame_that_needs_an_axis_the_kinematics_lack_is_refused() {
    let mut motion = inner();
    motion.inputs.fixed_axes = [false, true, false];
    let missing = Some(FrameRefusal::MissingAxis);
    assert_eq!(motion.send(3, [30.0, 2.0, 0.0]), missing);
    assert_eq!(motion.send(3, [30.0, 1.0, 0.0]), None);
}

#[test]
fn joints_that_jump_with_the_tool_hold_the_machine_until_a_command_takes_it_over() {
    type Remedy = fn(&mut Motion);
    let remedies: [Remedy; 3] = [
        |motion| assert_eq!(motion.send(11, [0.0; 3]), None),
        |motion| ask(motion, 1.0),
        |motion| {
            motion.inputs.enabled = false;
            motion.period();
            motion.inputs.enabled = true;
            motion.period();
        },
    ];
    for framed in [false, true] {
        for remedy in remedies {
            let mut motion = inner();
            motion.inputs.release_on_abort = false;
            if framed {
                assert_eq!(motion.send(1, [5.0, 0.0, 0.0]), None);
            }
            motion.inputs.tool_jumped = true;
            motion.period();
            motion.inputs.tool_jumped = false;
            for _ in 0..10 {
                motion.period();
                assert!(motion.out.hold && motion.out.parameters_pending);
                assert_eq!(motion.out.inner_refusal, None);
            }
            remedy(&mut motion);
            assert!(!motion.out.hold && !motion.out.parameters_pending);
        }
    }
}

#[test]
fn another_type_keeps_the_work_offset_of_the_frame() {
    let mut motion = inner();
    motion.inputs.work_offset = [10.0, 0.0, 0.0];
    assert_eq!(motion.send(3, [90.0, 2.0, 0.0]), None);
    let before = motion.machine([1.0, 2.0, 3.0]);
    motion.inputs.work_offset = [70.0, 0.0, 0.0];
    ask(&mut motion, 2.0);
    assert_eq!((motion.out.inner_type, motion.out.active), (2, true));
    assert_eq!(motion.machine([1.0, 2.0, 3.0]), before);
}
