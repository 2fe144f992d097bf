//! blendtp's limits of joints: if one is set, all of them are.

use crate::check::finding::{Findings, add, advice, if_missing};
use crate::hal::Setting;
use crate::wiring::blendtp::{JOINT_LIMITS, JointLimit, LIMITED_JOINTS};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let joints = of_kinematics(subject);
    let Some(first) = first_setting(subject, joints.min(LIMITED_JOINTS)) else {
        return;
    };
    if joints > LIMITED_JOINTS && !is_trivial(subject) {
        let found = format!(
            "limits of joints are set, and there are {joints} joints: with more than {LIMITED_JOINTS} blendtp refuses every move"
        );
        let remedy = advice("set none of blendtp.joint.*: the axes keep their limits instead");
        return findings.error(&first.statement.place, found, remedy);
    }
    for joint in 0..joints {
        for limit in &JOINT_LIMITS {
            let pin = limit.pin(joint);
            if has(subject, &pin) {
                continue;
            }
            let found = format!(
                "nothing sets {pin}, although limits of joints are set: {}{}",
                limit.without,
                subject.unless_unread()
            );
            let remedy = add(subject.hal_file(), limit.line(joint));
            let level = if_missing(subject);
            findings.add(level, &first.statement.place, found, remedy);
        }
    }
}

/// Whether the joints are the axes, whose limits hold then.
fn is_trivial(subject: &Subject) -> bool {
    !subject.joints.is_empty() && subject.inner().is_none() && subject.tilt().is_none()
}

/// How many joints the kinematics move: not those that motmod has beside them.
fn of_kinematics(subject: &Subject) -> usize {
    let joints = subject.number("KINS", "JOINTS").unwrap_or(0.0) as usize;
    joints.saturating_sub(subject.extra_joints())
}

fn has(subject: &Subject, pin: &str) -> bool {
    subject.state.settings.contains_key(pin) || subject.state.signal_of(pin).is_some()
}

/// The first line that sets a limit of a joint.
fn first_setting(subject: &Subject, joints: usize) -> Option<&Setting> {
    let of_joint = |joint| {
        let pin = move |limit: &JointLimit| limit.pin(joint);
        let mut pins = JOINT_LIMITS.iter().map(pin);
        pins.find_map(|pin| subject.state.settings.get(&pin))
    };
    (0..joints).find_map(of_joint)
}
