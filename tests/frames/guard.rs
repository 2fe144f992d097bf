//! A frame does not outlive its program, nor the guard, and a command that lost a value on its way is refused.

use crate::common::Motion;
use framepath::kinematics::FrameRefusal;
use framepath::kinematics::check::check_sum;
use framepath::kinematics::control::FrameInputs;
use framepath::kinematics::heartbeat::{Guard, LATE, LOST};
use framepath::kinematics::release::SETTLED;

/// A machine that stands with a frame in force.
fn framed() -> Motion {
    let mut motion = Motion::new("identity", "XYZ");
    assert_eq!(motion.send(1, [5.0, 6.0, 7.0]), None);
    assert!(motion.out.active);
    for _ in 0..SETTLED {
        motion.period();
    }
    motion
}

/// How many periods it takes until no frame is in force.
fn periods_until_gone(motion: &mut Motion) -> Option<u32> {
    (0..10).find(|_| {
        motion.period();
        !motion.out.active
    })
}

type Change = fn(&mut FrameInputs);

const ENDS: [(&str, Change); 3] = [
    ("abort", |inputs| inputs.command = 0.0),
    ("machine off", |inputs| inputs.enabled = false),
    ("the guard", |inputs| inputs.release = true),
];

#[test]
fn a_frame_goes_as_soon_as_motion_stands() {
    for (name, end) in ENDS {
        let mut motion = framed();
        let acknowledged = motion.out.acknowledged;
        motion.inputs.in_position = false;
        end(&mut motion.inputs);
        assert_eq!(periods_until_gone(&mut motion), None, "{name}");
        assert!(motion.out.releasing, "{name}");
        motion.inputs.in_position = true;
        // Asked for when the interpolator has come to its end, switched in the next period.
        assert_eq!(periods_until_gone(&mut motion), Some(SETTLED), "{name}");
        assert_eq!(motion.out.slot, 0, "{name}");
        assert_eq!(motion.machine([0.0; 3]), [0.0; 3], "{name}");
        assert_eq!(motion.out.acknowledged, acknowledged, "{name}");
        assert!(!motion.out.releasing, "{name}");
    }
}

#[test]
fn a_frame_that_has_to_go_waits_for_external_offsets() {
    let mut motion = framed();
    motion.inputs.offsets_move = true;
    motion.inputs.command = 0.0;
    assert_eq!(periods_until_gone(&mut motion), None);
    assert!(motion.out.releasing);
    assert_eq!(motion.out.refusal, None);
    // those that do not come to rest are told of
    for _ in 0..100 {
        motion.period();
    }
    assert_eq!(motion.out.refusal, Some(FrameRefusal::OffsetsMove));
    motion.inputs.offsets_move = false;
    assert_eq!(periods_until_gone(&mut motion), Some(1));
    // with the machine off there are none
    let mut motion = framed();
    (motion.inputs.offsets_move, motion.inputs.unknown_offset) = (true, true);
    motion.inputs.enabled = false;
    assert!(periods_until_gone(&mut motion).is_some());
}

#[test]
fn settings_may_keep_it_past_an_abort() {
    for (name, end) in &ENDS[..2] {
        let mut motion = framed();
        motion.inputs.release_on_abort = false;
        end(&mut motion.inputs);
        assert_eq!(periods_until_gone(&mut motion), None, "{name}");
    }
}

#[test]
fn in_teleop_it_goes_when_that_is_left_or_the_machine_is_off() {
    let mut motion = framed();
    motion.inputs.teleop = true;
    motion.inputs.command = 0.0;
    assert_eq!(periods_until_gone(&mut motion), None);
    motion.inputs.teleop = false;
    assert_eq!(periods_until_gone(&mut motion), Some(SETTLED));
    let mut motion = framed();
    motion.inputs.teleop = true;
    motion.period();
    motion.inputs.enabled = false;
    assert_eq!(periods_until_gone(&mut motion), Some(SETTLED));
}

#[test]
fn while_it_has_to_go_nothing_else_is_switched_to_in_teleop() {
    for slot in [-1, 0, 1, 2, 3] {
        let mut motion = framed();
        motion.linked = false;
        (motion.inputs.teleop, motion.inputs.enabled) = (true, false);
        for _ in 0..=SETTLED {
            motion.period();
        }
        assert_eq!(motion.out.switchkins_type, 0, "it has been asked for");
        let switched = motion.switch(slot);
        if slot == 0 {
            assert_eq!(switched, Ok(()));
            assert!(motion.control.active().is_none());
        } else {
            assert_eq!(switched, Err(FrameRefusal::Teleop), "type {slot}");
            assert_eq!(motion.machine([0.0; 3]), [5.0, 6.0, 7.0]);
            // It goes all the same.
            (motion.linked, motion.type_seen) = (true, slot);
            assert!(periods_until_gone(&mut motion).is_some());
        }
    }
}

#[test]
fn an_abort_between_request_and_switch_removes_what_comes() {
    let mut motion = Motion::new("identity", "XYZ");
    motion.put(1, [5.0, 0.0, 0.0]);
    motion.out = motion.control.update(&motion.inputs);
    motion.inputs.command = 0.0;
    for _ in 0..=SETTLED {
        motion.period();
    }
    assert!(!motion.out.active);
}

#[test]
fn the_refusal_that_ended_a_program_stays_to_be_read() {
    let mut motion = framed();
    assert_eq!(
        motion.send(107, [0.0, 1.0, 1.0]),
        Some(FrameRefusal::ZeroScale)
    );
    motion.inputs.command = 0.0;
    assert!(periods_until_gone(&mut motion).is_some());
    assert_eq!(motion.out.refusal, Some(FrameRefusal::ZeroScale));
}

#[test]
fn a_suspended_frame_does_not_come_back_after_an_abort() {
    let mut motion = framed();
    assert_eq!(motion.send(13, [0.0; 3]), None);
    motion.inputs.command = 0.0;
    motion.period();
    assert_eq!(motion.send(101, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.machine([0.0; 3]), [1.0, 0.0, 0.0]);
}

#[test]
fn a_suspended_frame_does_not_come_back_once_the_guard_has_released_it() {
    let mut motion = framed();
    motion.inputs.release_on_abort = false;
    assert_eq!(motion.send(13, [0.0; 3]), None);
    assert_eq!(motion.out.operations, 1);
    motion.inputs.release = true;
    motion.period();
    motion.inputs.release = false;
    motion.period();
    assert_eq!(motion.out.operations, 0);
    // The interpreter has had its position without the frame all the while.
    assert_eq!(motion.out.releases, 0);
    assert_eq!(motion.send(11, [0.0; 3]), None);
    assert!(!motion.out.active);
}

#[test]
fn nothing_moves_until_the_interpreter_knows() {
    let mut motion = framed();
    assert!(!motion.out.hold);
    motion.inputs.command = 0.0;
    motion.period();
    assert!(motion.out.active && motion.out.hold);
    motion.period();
    assert!(!motion.out.active && motion.out.hold);
    assert_eq!(motion.out.releases, 1);
    for _ in 0..10 {
        motion.period();
        assert!(motion.out.hold);
    }
    motion.inputs.releases_seen = 1;
    motion.period();
    assert!(!motion.out.hold);
    // A frame that a command removes is known to whoever gave the command.
    assert_eq!(motion.send(1, [1.0, 0.0, 0.0]), None);
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert!(!motion.out.hold);
    assert_eq!(motion.out.releases, 1);
}

/// Runs for so many seconds.
fn run(motion: &mut Motion, seconds: f64) {
    let periods = (seconds / motion.inputs.period).round();
    for _ in 0..periods as u32 {
        motion.period();
    }
}

#[test]
fn a_guard_that_is_late_holds_the_machine_and_one_that_is_lost_switches_it_off() {
    for period in [0.0001, 0.001, 0.01] {
        let mut motion = framed();
        motion.inputs.period = period;
        motion.period();
        motion.beating = false;
        run(&mut motion, LATE - 0.02);
        assert!(motion.out.guarded && !motion.out.hold, "{period}");
        run(&mut motion, 0.04);
        assert!(motion.out.guarded && motion.out.hold, "{period}");
        // In time it goes on where it was.
        motion.beating = true;
        motion.period();
        assert!(motion.out.guarded && !motion.out.hold, "{period}");
        motion.beating = false;
        run(&mut motion, LOST + 0.02);
        assert!(!motion.out.guarded && motion.out.hold, "{period}");
        // A program that dwells keeps its frame while the machine is on.
        run(&mut motion, 3.0);
        assert!(motion.out.active && motion.out.hold, "{period}");
        motion.inputs.enabled = false;
        motion.inputs.release_on_abort = false;
        assert_eq!(periods_until_gone(&mut motion), Some(1), "{period}");
        // Without a frame the machine can be moved by hand.
        motion.period();
        assert!(motion.out.guarded && !motion.out.hold, "{period}");
        motion.inputs.enabled = true;
        assert_eq!(
            motion.send(1, [1.0, 0.0, 0.0]),
            Some(FrameRefusal::Unguarded)
        );
        assert_eq!(motion.send(9, [0.0; 3]), None);
        motion.beating = true;
        assert_eq!(motion.send(1, [1.0, 0.0, 0.0]), None);
    }
}

#[test]
fn a_servo_thread_that_was_late_does_not_blame_the_guard() {
    let mut motion = framed();
    motion.beating = false;
    // The machine stood still for ten seconds, and the periods are made up for at once.
    motion.inputs.clock += 10_000_000_000;
    for _ in 0..10_000 {
        motion.out = motion.control.update(&motion.inputs);
        motion.inputs.clock += 5_000;
    }
    assert!(!motion.out.hold);
    // Some milliseconds late now and then, the time of the clock counts in full.
    let start = motion.inputs.clock;
    while !motion.out.hold {
        motion.inputs.clock += 20_000_000;
        for _ in 0..20 {
            motion.out = motion.control.update(&motion.inputs);
        }
    }
    let seconds = (motion.inputs.clock - start) as f64 * 1e-9;
    assert!((LATE - 0.15..LATE + 0.02).contains(&seconds), "{seconds}");
}

#[test]
fn without_a_guard_there_are_no_frames() {
    let mut motion = Motion::new("identity", "XYZ");
    motion.beating = false;
    motion.inputs.heartbeat = 0;
    motion.control = framepath::kinematics::control::FrameControl::new(*motion.control.behind());
    assert_eq!(
        motion.send(1, [1.0, 0.0, 0.0]),
        Some(FrameRefusal::Unguarded)
    );
    assert_eq!(motion.send(9, [0.0; 3]), None);
    assert_eq!(motion.out.guard, Guard::Never);
    run(&mut motion, 3.0);
    assert!(motion.out.guarded && !motion.out.hold);
}

/// What arrives over nine nets in this order, of the numbers that were sent.
fn arrive(inputs: &mut FrameInputs, sent: &[f64; 9], nets: [Option<usize>; 9]) {
    let at = |pin: usize| nets[pin].map_or(0.0, |net| sent[net]);
    inputs.command = at(0);
    inputs.value = [at(1), at(2), at(3)];
    inputs.work_offset = [at(4), at(5), at(6)];
    inputs.work_rotation = at(7);
    inputs.check = at(8);
}

/// Whole numbers, decimal ones, and such as a sum with whole weights would mix up.
const SENT: [[f64; 7]; 4] = [
    [10.0, 5.0, 1.0, 100.0, -50.0, 25.0, 30.0],
    [1.0, 3.0, 0.0, 2.0, 4.0, 6.0, 8.0],
    [0.001, -0.002, 0.003, 1234.567, 0.1, -0.3, 90.0],
    [-1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -4.0],
];

#[test]
fn a_missing_or_swapped_net_is_refused() {
    let identity: [Option<usize>; 9] = core::array::from_fn(Some);
    for values in SENT {
        for number in [1.0, 99_999.0] {
            let mut motion = framed();
            let mut sent = [0.0; 9];
            sent[0] = number * 1000.0 + 1.0;
            sent[1..8].copy_from_slice(&values);
            arrive(&mut motion.inputs, &sent, identity);
            sent[8] = check_sum(&motion.inputs);
            let mut wrong = Vec::new();
            for a in 0..9 {
                let mut nets = identity;
                nets[a] = None;
                wrong.push(nets);
                for b in 0..9 {
                    for c in 0..9 {
                        let mut nets = identity;
                        nets.swap(a, b);
                        nets.swap(b, c);
                        wrong.push(nets);
                    }
                }
            }
            for nets in wrong {
                let mut arrived = [0.0; 9];
                for (place, net) in arrived.iter_mut().zip(nets) {
                    *place = net.map_or(0.0, |net| sent[net]);
                }
                // A missing net of a 0, and equal values exchanged, are no faults.
                if arrived == sent || arrived[0] < 1000.0 {
                    continue;
                }
                arrive(&mut motion.inputs, &sent, nets);
                let whole = framepath::kinematics::check::is_whole(&motion.inputs);
                assert!(!whole, "{sent:?} {nets:?}");
            }
            arrive(&mut motion.inputs, &sent, identity);
            assert!(
                framepath::kinematics::check::is_whole(&motion.inputs),
                "{sent:?}"
            );
        }
    }
}

#[test]
fn a_command_without_its_check_changes_nothing() {
    let mut motion = framed();
    motion.put(1, [10.0, 5.0, 0.0]);
    motion.inputs.value[1] = 0.0;
    motion.period();
    assert_eq!(motion.out.refusal, Some(FrameRefusal::WrongCheck));
    assert_eq!(motion.machine([0.0; 3]), [5.0, 6.0, 7.0]);
    for check in [0.0, f64::NAN, f64::INFINITY] {
        motion.put(1, [10.0, 5.0, 0.0]);
        motion.inputs.check = check;
        motion.period();
        assert_eq!(motion.out.refusal, Some(FrameRefusal::WrongCheck));
    }
    // A frame can be removed whatever the nets are.
    motion.put(9, [1.0; 3]);
    motion.inputs.check = 0.0;
    motion.period();
    motion.period();
    assert_eq!((motion.out.refusal, motion.out.active), (None, false));
}

#[test]
fn what_starts_while_the_guard_waits_for_a_frame_to_go_is_held() {
    let mut motion = framed();
    motion.inputs.other_joints = true;
    motion.inputs.release = true;
    for _ in 0..10 {
        motion.period();
        assert!(motion.out.active && motion.out.hold);
    }
    assert_eq!(motion.out.refusal, Some(FrameRefusal::OtherJoints));
    // a program has started in it: its command waits, until the guard has looked
    let answered = motion.out.acknowledged;
    motion.put(101, [1.0, 0.0, 0.0]);
    for _ in 0..10 {
        motion.period();
        assert!(motion.out.hold);
        assert_eq!(motion.out.acknowledged, answered);
    }
    // in MDI the guard lets it go on, to where the frame can go
    motion.inputs.release = false;
    motion.period();
    assert!(!motion.out.hold);
    assert_eq!(motion.out.acknowledged, motion.number);
    // a jog leads there, too
    motion.inputs.release = true;
    motion.inputs.teleop = true;
    motion.period();
    assert!(!motion.out.hold);
    motion.inputs.teleop = false;
    motion.inputs.other_joints = false;
    assert!(periods_until_gone(&mut motion).is_some());
}
