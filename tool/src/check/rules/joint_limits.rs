//! blendtp's limits of joints: if one is set, all of them are.

use crate::check::finding::{Findings, add, if_missing};
use crate::hal::Setting;
use crate::wiring::blendtp::{JOINT_LIMITS, JointLimit, LIMITED_JOINTS};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let joints = subject.number("KINS", "JOINTS").unwrap_or(0.0) as usize;
    let joints = joints.min(LIMITED_JOINTS);
    let Some(first) = first_setting(subject, joints) else {
        return;
    };
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
