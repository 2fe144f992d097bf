//! Which kinematics are loaded, and what their parameters say of joints and axes.

use super::inner_kinematics;
use crate::check::finding::{Findings, Remedy, add, advice, if_missing, replace};
use crate::hal::{Fix, Module};
use crate::machine::configuration::AXIS_LETTERS;
use crate::machine::place::Place;
use crate::wiring::subject::Subject;
use framepath::machine::{ConfigurationError, CoordinatesError, Machine};

/// LinuxCNC's own, and ours.
const MODULES: [&str; 25] = [
    "5axiskins",
    "corexykins",
    "framekins",
    "gantrykins",
    "genhexkins",
    "genserkins",
    "lineardeltakins",
    "matrixkins",
    "maxkins",
    "millturn",
    "pentakins",
    "pumakins",
    "rosekins",
    "rotarydeltakins",
    "rotatekins",
    "scarakins",
    "scorbot-kins",
    "tripodkins",
    "trivkins",
    "userkins",
    "xyzab_tdr_kins",
    "xyzac-trt-kins",
    "xyzbc-trt-kins",
    "xyzacb_trsrn",
    "xyzbca_trsrn",
];

/// Those of framekins.
const PARAMETERS: [&str; 6] = [
    "coordinates",
    "machine",
    "tool_length",
    "inner",
    "tool_types",
    "tool_axes",
];

pub fn look(subject: &Subject, findings: &mut Findings) {
    several(subject, findings);
    unhomed(subject, findings);
    let loaded = subject.state.module("framekins");
    if let Some(module) = loaded {
        unknown_parameters(subject, module, findings);
    }
    match loaded {
        Some(module) if subject.inner().is_some() => {
            let inner = subject.inner().unwrap_or("");
            inner_kinematics::look(subject, module, inner, findings);
        }
        Some(module) => {
            parameters(
                subject,
                &module.statement.place,
                |name| module.parameter(name),
                findings,
            );
            contradiction(subject, module, findings);
        }
        None if subject.kinematics() == "framekins" => not_loaded(subject, findings),
        None if subject.has_frames() => not_named(subject, findings),
        None => {}
    }
}

/// framekins is never the kinematics that motion moves without homing.
fn unhomed(subject: &Subject, findings: &mut Findings) {
    if subject.has_frames() && subject.may_run_unhomed() {
        let found = "NO_FORCE_HOMING has no effect with framekins: nothing but joints moves before all of them are homed";
        let remedy = "NO_FORCE_HOMING = 0, and home the machine first: a joint with HOME_SEARCH_VEL = 0 and HOME_LATCH_VEL = 0 \
                      is homed where it stands";
        let place = subject.place_of("TRAJ", "NO_FORCE_HOMING");
        findings.warning(&place, found, advice(remedy));
    }
}

/// With one that it does not have the module is not loaded.
fn unknown_parameters(subject: &Subject, module: &Module, findings: &mut Findings) {
    let place = match subject.kinematics() {
        "framekins" => subject.place_of("KINS", "KINEMATICS"),
        _ => module.statement.place.clone(),
    };
    for (name, _) in &module.parameters {
        if !PARAMETERS.contains(&name.as_str()) {
            let found = format!("framekins is not loaded: it has no parameter {name}=");
            let remedy = format!("leave it out; there are {}", PARAMETERS.join(", "));
            findings.error(&place, found, advice(remedy));
        }
    }
}

/// The value of `[KINS]KINEMATICS` for a machine with frames.
pub fn likely(subject: &Subject) -> String {
    let letters = match subject.joints.is_empty() || subject.kinematics().is_empty() {
        true => joint_letters(subject),
        false => subject.joints.iter().collect(),
    };
    let has_table = subject
        .script
        .statements
        .iter()
        .any(|statement| statement.word(1) == "framekins.x-rot-point");
    let machine = match (has_table, letters.contains('A')) {
        (true, true) => " machine=xyzac",
        (true, false) => " machine=xyzbc",
        (false, _) => "",
    };
    format!("framekins coordinates={letters}{machine}")
}

/// A letter for each joint, as far as `[TRAJ]COORDINATES` says: that of a gantry may name an axis twice.
fn joint_letters(subject: &Subject) -> String {
    let written: String = subject
        .text("TRAJ", "COORDINATES")
        .unwrap_or("")
        .split_whitespace()
        .collect();
    let joints = subject.number("KINS", "JOINTS");
    match joints.map(|joints| joints - subject.extra_joints() as f64) {
        Some(joints) if joints == written.chars().count() as f64 => written.to_ascii_uppercase(),
        _ => subject.axes.iter().collect(),
    }
}

/// Motmod takes the first; ours refuses to be another one, and goes before the one of `inner=`.
fn several(subject: &Subject, findings: &mut Findings) {
    let modules = subject.state.modules.iter();
    let kinematics: Vec<&Module> = modules
        .filter(|module| MODULES.contains(&module.name.as_str()))
        .collect();
    let [first, others @ ..] = kinematics.as_slice() else {
        return;
    };
    for module in others {
        if first.name == "framekins" && subject.inner() == Some(&module.name) {
            continue;
        }
        if module.name == "framekins" || first.name == "framekins" {
            let found = format!(
                "{} is loaded already, and {} is never asked",
                first.name, module.name
            );
            findings.error(&module.statement.place, found, Remedy::Remove);
        }
    }
}

fn not_loaded(subject: &Subject, findings: &mut Findings) {
    let line = "loadrt [KINS]KINEMATICS";
    let mut modules = subject.state.modules.iter();
    if let Some(other) = modules.find(|module| MODULES.contains(&module.name.as_str())) {
        let found = format!(
            "the HAL file loads {}, and [KINS]KINEMATICS is framekins",
            other.name
        );
        return findings.error(&other.statement.place, found, replace(line));
    }
    let found = format!(
        "nothing loads [KINS]KINEMATICS, framekins{}",
        subject.unless_unread()
    );
    let place = subject.place_of("KINS", "KINEMATICS");
    findings.add(
        if_missing(subject),
        &place,
        found,
        add(subject.hal_file(), line),
    );
}

fn not_named(subject: &Subject, findings: &mut Findings) {
    let statement = subject
        .first_naming("framekins")
        .map(|statement| statement.text.as_str());
    let found = format!(
        "`{}` needs framekins, which is not loaded",
        statement.unwrap_or("")
    );
    let line = format!("KINEMATICS = {}", likely(subject));
    let asked = |fix: &Fix| matches!(fix, Fix::Key { key, .. } if key == "KINEMATICS");
    if subject
        .script
        .problems
        .iter()
        .any(|problem| asked(&problem.remedy))
    {
        return;
    }
    let remedy = match subject.ini.entry("KINS", "KINEMATICS") {
        Some(_) => replace(line),
        None => add("[KINS]", line),
    };
    findings.error(&subject.place_of("KINS", "KINEMATICS"), found, remedy);
}

/// What the INI file says is what screens and frame_guard believe.
fn contradiction(subject: &Subject, module: &Module, findings: &mut Findings) {
    let place = &module.statement.place;
    if subject.kinematics() != "framekins" {
        let found = format!(
            "framekins is loaded, and [KINS]KINEMATICS is {}",
            subject.kinematics()
        );
        let line = format!("KINEMATICS = {}", likely(subject));
        return findings.warning(
            &subject.place_of("KINS", "KINEMATICS"),
            found,
            replace(line),
        );
    }
    for name in ["coordinates", "machine", "tool_length"] {
        let named = subject.kinematics_parameter(name);
        let loaded = module.parameter(name);
        if named.map(str::to_ascii_uppercase) != loaded.map(str::to_ascii_uppercase) {
            let found = format!(
                "{name}={} is loaded, and [KINS]KINEMATICS says {name}={}",
                loaded.unwrap_or(""),
                named.unwrap_or("")
            );
            findings.error(place, found, replace("loadrt [KINS]KINEMATICS"));
        }
    }
}

fn parameters<'a>(
    subject: &Subject,
    place: &Place,
    parameter: impl Fn(&str) -> Option<&'a str>,
    findings: &mut Findings,
) {
    let place = match subject.kinematics() {
        "framekins" => &subject.place_of("KINS", "KINEMATICS"),
        _ => place,
    };
    let letters = parameter("coordinates").unwrap_or("");
    let machine = parameter("machine").unwrap_or("");
    let line = replace(format!("KINEMATICS = {}", likely(subject)));
    if let Err(error) = Machine::configured(machine.as_bytes(), letters.as_bytes()) {
        return findings.error(place, words(error, letters, machine), line);
    }
    if !matches!(parameter("tool_length"), None | Some("frame" | "machine")) {
        let found = "framekins is not loaded: tool_length= is frame or machine";
        findings.error(place, found, advice("tool_length=frame"));
    }
    joints(subject, place, letters, findings);
}

fn words(error: ConfigurationError, letters: &str, machine: &str) -> String {
    let reason = match error {
        ConfigurationError::UnknownMachine => {
            return format!(
                "framekins is not loaded: machine={machine} is none of identity, xyzac, xyzbc"
            );
        }
        ConfigurationError::Coordinates(error) => error,
    };
    let words = match reason {
        CoordinatesError::Empty => "a letter for each joint is missing".to_owned(),
        CoordinatesError::UnknownLetter { position, .. } => {
            format!("letter {} is none of {AXIS_LETTERS}", position + 1)
        }
        CoordinatesError::TooManyJoints { .. } => "LinuxCNC has 16 joints at most".to_owned(),
        CoordinatesError::MissingAxis { axis } => {
            let letter = AXIS_LETTERS.chars().nth(axis).unwrap_or('?');
            format!("machine={machine} needs the axis {letter}")
        }
    };
    format!("framekins is not loaded: coordinates={letters}: {words}")
}

fn joints(subject: &Subject, place: &Place, letters: &str, findings: &mut Findings) {
    let letters = letters.to_ascii_uppercase();
    let joints = subject
        .text("KINS", "JOINTS")
        .and_then(|text| text.parse::<usize>().ok());
    let beside = subject.extra_joints();
    if let Some(joints) = joints.filter(|joints| *joints != letters.chars().count() + beside) {
        let extra = match beside {
            0 => String::new(),
            _ => format!(", {beside} of them by num_extrajoints"),
        };
        let found = format!(
            "coordinates={letters} names {} joints, and [KINS]JOINTS is {joints}{extra}: frame_guard, and with it LinuxCNC, does not \
             start",
            letters.chars().count()
        );
        findings.error(
            place,
            found,
            advice("write a letter for each joint, and their number as JOINTS"),
        );
    }
    for letter in subject
        .axes
        .iter()
        .filter(|letter| !letters.contains(**letter))
    {
        let found = format!(
            "[TRAJ]COORDINATES has an axis {letter} that moves no joint: coordinates={letters}"
        );
        findings.error(
            place,
            found,
            advice("write a letter for each axis of the machine"),
        );
    }
}
