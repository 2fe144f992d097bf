//! Limits of axes, joints and the path that contradict each other.

use crate::check::finding::{Findings, Remedy, add, advice, replace};
use crate::machine::above_joints::AboveJoint;
use crate::machine::configuration::is_rotary;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    for letter in &subject.axes {
        own(subject, &format!("AXIS_{letter}"), findings);
    }
    for (joint, letter) in subject.joints.iter().enumerate() {
        own(subject, &format!("JOINT_{joint}"), findings);
        against_axis(subject, joint, *letter, findings);
    }
    path(subject, findings);
}

/// The limits of one axis or joint by themselves.
fn own(subject: &Subject, section: &str, findings: &mut Findings) {
    for key in ["MAX_VELOCITY", "MAX_ACCELERATION"] {
        match (subject.text(section, key), subject.number(section, key)) {
            (None, _) => {
                let found = format!("LinuxCNC takes 1 for [{section}]{key}");
                let place = subject.place_of(section, key);
                findings.warning(
                    &place,
                    found,
                    add(format!("[{section}]"), format!("{key} = ...")),
                );
            }
            (Some(_), Some(number)) if number <= 0.0 => {
                let found = format!("[{section}]{key} = {number}: it never moves");
                findings.error(
                    &subject.place_of(section, key),
                    found,
                    advice("a number above 0"),
                );
            }
            _ => {}
        }
    }
    let [least, greatest] = ["MIN_LIMIT", "MAX_LIMIT"].map(|key| subject.number(section, key));
    if let (Some(least), Some(greatest)) = (least, greatest)
        && least > greatest
    {
        let found = format!("[{section}]MIN_LIMIT = {least} is above MAX_LIMIT = {greatest}");
        findings.error(
            &subject.place_of(section, "MIN_LIMIT"),
            found,
            advice("MIN_LIMIT below MAX_LIMIT"),
        );
    }
}

/// A joint that is an axis: the planner knows the limits of the axis only.
fn against_axis(subject: &Subject, joint: usize, letter: char, findings: &mut Findings) {
    let above = AboveJoint::of(&subject.ini, letter, joint);
    let [axis, joint] = [format!("AXIS_{letter}"), format!("JOINT_{joint}")];
    if !subject.axes.contains(&letter) {
        return;
    }
    for above in above {
        findings.warning(
            &subject.place_of(&axis, above.key),
            above.to_string(),
            replace(format!("{} = {}", above.key, above.of_joint)),
        );
    }
    travel(subject, &axis, &joint, findings);
}

/// LinuxCNC checks trivkins at its start: an axis must not reach beyond its joint. With frames it should.
fn travel(subject: &Subject, axis: &str, joint: &str, findings: &mut Findings) {
    let is_checked = subject.kinematics() == "trivkins";
    let edges = [("MIN_LIMIT", 1.0, -1e99), ("MAX_LIMIT", -1.0, 1e99)];
    for (key, sign, unlimited) in edges {
        let Some(j) = subject.number(joint, key) else {
            continue;
        };
        let a = subject.number(axis, key);
        let beyond = sign * j > sign * a.unwrap_or(unlimited);
        let place = subject.place_of(axis, key);
        let line = format!("{key} = {j}");
        let remedy: Remedy = match a {
            Some(_) => replace(line),
            None => add(format!("[{axis}]"), line),
        };
        if is_checked && beyond && subject.ini.has_section(axis) {
            let found =
                format!("LinuxCNC does not start: [{axis}] reaches beyond [{joint}]{key} = {j}");
            findings.error(&place, found, remedy);
        } else if !is_checked && a.is_some_and(|a| sign * j < sign * a) && subject.has_frames() {
            let found = format!(
                "[{axis}]{key} is in coordinates of the program with its frame, and narrower than [{joint}]{key} = {j}: moves that \
                 the machine could make are refused"
            );
            findings.note(&place, found, remedy);
        }
    }
}

/// `[TRAJ]` against the axes.
fn path(subject: &Subject, findings: &mut Findings) {
    let axes = |rotary: bool| {
        let letters = subject
            .axes
            .iter()
            .filter(move |letter| is_rotary(**letter) == rotary);
        let velocities = letters
            .filter_map(|l| Some((*l, subject.number(&format!("AXIS_{l}"), "MAX_VELOCITY")?)));
        velocities.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let pairs = [
        ("MAX_LINEAR_VELOCITY", "DEFAULT_LINEAR_VELOCITY", false),
        ("MAX_ANGULAR_VELOCITY", "DEFAULT_ANGULAR_VELOCITY", true),
    ];
    for (key, usual, rotary) in pairs {
        let Some(limit) = subject.number("TRAJ", key).filter(|limit| *limit > 0.0) else {
            continue;
        };
        let place = subject.place_of("TRAJ", key);
        if let Some((letter, velocity)) = axes(rotary).filter(|(_, velocity)| *velocity > limit) {
            let found = format!(
                "[TRAJ]{key} = {limit} keeps {letter} from its [AXIS_{letter}]MAX_VELOCITY = {velocity}"
            );
            findings.warning(&place, found, replace(format!("{key} = {velocity}")));
        }
        if let Some(usual_value) = subject.number("TRAJ", usual).filter(|usual| *usual > limit) {
            let found = format!("[TRAJ]{usual} = {usual_value} is above {key} = {limit}");
            findings.warning(
                &subject.place_of("TRAJ", usual),
                found,
                replace(format!("{usual} = {limit}")),
            );
        }
        if let Some(shown) = subject
            .number("DISPLAY", key)
            .filter(|shown| *shown > limit)
        {
            let found =
                format!("[DISPLAY]{key} = {shown} is above [TRAJ]{key} = {limit}, which counts");
            findings.note(
                &subject.place_of("DISPLAY", key),
                found,
                replace(format!("{key} = {limit}")),
            );
        }
    }
}
