//! The lines for framekins: kinematics, analog outputs, subroutines and codes in the INI file, the function, the
//! nets and frame_guard in the HAL file.

use super::ConfigureArguments;
use super::edits::Edits;
use super::{inner, subroutines, twopass, unread};
use crate::hal::Stock;
use crate::wiring::codes::{CODES, Remap};
use crate::wiring::framekins::{
    ADD_FUNCTION, MOST_OUTPUTS, MOTION_TYPE, NETS, OUTPUTS, SAMPLE_OUTPUTS, Source,
};
use crate::wiring::outputs_line::OutputsLine;
use crate::wiring::previews::screen;
use crate::wiring::screens::{OTHERS, ending, why_ending};
use crate::wiring::settings::{KEYS, SECTION};
use crate::wiring::subject::{Subject, guard_line};

/// Adds it all; what is in the way is refused.
pub fn write(subject: &Subject, arguments: &ConfigureArguments, edits: &mut Edits) {
    if subject.has_frames() {
        let place = subject.place_of("KINS", "KINEMATICS");
        return edits.refuse(
            &place,
            "this configuration has framekins already",
            "framepath check says what it lacks",
        );
    }
    readable(subject, edits);
    shown(subject, edits);
    homed(subject, edits);
    if subject.kinematics() == "trivkins" && !needs_trivkins(subject) {
        trivial_kinematics(subject, edits);
    } else {
        inner::write(subject, edits);
    }
    let first = first_output(subject);
    let Some(first) = first else {
        let place = subject.place_of_module("motmod");
        return edits.refuse(
            &place,
            "no nine analog outputs in a row are free",
            "free motion.analog-out-00 to 08",
        );
    };
    motion(subject, first, edits);
    edits.add_hal(ADD_FUNCTION);
    nets(subject, first, edits);
    for letter in subject.external_offsets() {
        edits.add_hal(subject.external_offset_line(letter));
    }
    edits.add_hal(guard_line(&arguments.subroutines));
    subroutines::write(subject, &arguments.subroutines, edits);
    codes(subject, edits);
    settings(subject, first, edits);
    preview(subject, arguments, edits);
}

/// What is linked and loaded has to be known.
fn readable(subject: &Subject, edits: &mut Edits) {
    unread::refuse(subject, edits);
    twopass::refuse(subject, edits);
    if !subject.has_linear_units() {
        let place = subject.place_of("TRAJ", "LINEAR_UNITS");
        edits.refuse(
            &place,
            "[TRAJ]LINEAR_UNITS is neither mm nor inch",
            "LINEAR_UNITS = mm under [TRAJ]",
        );
    }
}

/// LinuxCNC ends with its screen.
fn shown(subject: &Subject, edits: &mut Edits) {
    if let Some(screen) = ending(subject) {
        let place = subject.place_of("DISPLAY", "DISPLAY");
        edits.refuse(
            &place,
            why_ending(screen),
            format!("{OTHERS}; or do without --frames"),
        );
    }
}

/// Motion moves joints that are the axes without homing, but not those behind framekins.
fn homed(subject: &Subject, edits: &mut Edits) {
    let kind = subject.kinematics_parameter("kinstype").unwrap_or("1");
    let is_identity = subject.kinematics() == "trivkins" && !kind.starts_with(['b', 'B']);
    if is_identity && subject.may_run_unhomed() {
        edits.refuse(
            &subject.place_of("TRAJ", "NO_FORCE_HOMING"),
            "programs run on this machine before it is homed, and with frames nothing but its joints moves then",
            "NO_FORCE_HOMING = 0, and home it first: a joint with HOME_SEARCH_VEL = 0 and HOME_LATCH_VEL = 0 is homed where \
             it stands",
        );
    }
}

/// LinuxCNC's HAL file for a pendant has it jog joints where the kinematics are trivkins, by their name.
fn needs_trivkins(subject: &Subject) -> bool {
    subject.script.stock.contains(&Stock::Pendant)
}

/// framekins takes their place.
fn trivial_kinematics(subject: &Subject, edits: &mut Edits) {
    let place = subject.place_of("KINS", "KINEMATICS");
    let words = subject.text("KINS", "KINEMATICS").unwrap_or("");
    let known = |word: &str| word.starts_with("coordinates=") || word.starts_with("kinstype=");
    let other = words.split_whitespace().skip(1).find(|word| !known(word));
    if let Some(word) = other {
        return edits.refuse(
            &place,
            format!("framekins does not know `{word}`"),
            "coordinates=, a letter for each joint",
        );
    }
    let letters: String = subject.joints.iter().collect();
    let beside = subject.extra_joints();
    let count = subject.number("KINS", "JOINTS").unwrap_or(0.0);
    if letters.len() as f64 != count - beside as f64 {
        let extra = match beside {
            0 => String::new(),
            _ => format!(", {beside} of them by num_extrajoints"),
        };
        let found = format!(
            "[KINS]JOINTS is {count}{extra}, and coordinates= names {} joints",
            letters.len()
        );
        return edits.refuse(
            &place,
            found,
            "a letter of XYZABCUVW for each joint behind coordinates=",
        );
    }
    if let Some(letter) = subject
        .axes
        .iter()
        .find(|letter| !subject.joints.contains(letter))
    {
        let found = format!("no joint moves the axis {letter} of [TRAJ]COORDINATES");
        return edits.refuse(&place, found, "a letter for each joint behind coordinates=");
    }
    edits.set(
        "KINS",
        "KINEMATICS",
        &format!("framekins coordinates={letters}"),
    );
    let loads = subject
        .state
        .modules
        .iter()
        .find(|module| module.name == "trivkins");
    if let Some(module) = loads.filter(|module| !module.statement.text.contains("[KINS]")) {
        let help = "loadrt [KINS]KINEMATICS";
        edits.refuse(
            &module.statement.place,
            "the HAL file names trivkins itself",
            help,
        );
    }
}

/// The first of nine analog outputs in a row that nothing is linked to.
fn first_output(subject: &Subject) -> Option<u32> {
    let is_free = |output: u32| {
        subject
            .state
            .signal_of(&format!("motion.analog-out-{output:02}"))
            .is_none()
    };
    (0..=MOST_OUTPUTS - OUTPUTS).find(|first| (0..OUTPUTS).all(|number| is_free(first + number)))
}

/// motmod with enough analog outputs, where the INI file says how many it has.
fn motion(subject: &Subject, first: u32, edits: &mut Edits) {
    let Some(motion) = subject.motion() else {
        let place = subject.place_of("EMCMOT", "EMCMOT");
        return edits.refuse(
            &place,
            "no HAL file loads motmod",
            "loadrt [EMCMOT]EMCMOT in a HAL file",
        );
    };
    let needed = (first + OUTPUTS).max(SAMPLE_OUTPUTS);
    let given = motion
        .parameter("num_aio")
        .and_then(|text| text.parse::<u32>().ok());
    if given.is_some_and(|given| given >= first + OUTPUTS) {
        return;
    }
    match OutputsLine::new(subject, motion, needed) {
        OutputsLine::Ini { key, value, .. } => edits.set("EMCMOT", key, &value),
        OutputsLine::Hal(line) => {
            let found = "motmod has too few analog outputs for a frame";
            edits.refuse(&motion.statement.place, found, line);
        }
    }
}

fn nets(subject: &Subject, first: u32, edits: &mut Edits) {
    for net in &NETS {
        let source = net.source_pin(first);
        if net.pin == MOTION_TYPE && subject.kinematics() != "trivkins" {
            // What chose a type there goes to framekins.
            edits.add_hal(net.line(first));
            continue;
        }
        let is_motions = |pin: &str| pin.starts_with("motion.");
        match (subject.state.signal_of(net.pin), net.source) {
            (Some(signal), Source::Pin(own)) if is_motions(net.pin) => {
                let linked = subject.state.signals.get(signal).into_iter().flatten();
                let place = linked
                    .filter(|(pin, _)| pin == net.pin)
                    .map(|(_, place)| place.clone())
                    .next();
                let place = place.unwrap_or_else(|| subject.place_of_module("motmod"));
                let gate = if net.pin == "motion.enable" {
                    "and2"
                } else {
                    "or2"
                };
                let found = format!(
                    "{} is linked to {signal} already, and {own} has to reach it",
                    net.pin
                );
                edits.refuse(
                    &place,
                    found,
                    format!("join both in an {gate}, as the README of the subroutines says"),
                );
            }
            _ => match subject.state.signal_of(&source) {
                Some(signal) => edits.add_hal(format!("net {signal} => {}", net.pin)),
                None => edits.add_hal(net.line(first)),
            },
        }
    }
}

fn codes(subject: &Subject, edits: &mut Edits) {
    let remaps = subject.all("RS274NGC", "REMAP");
    for code in &CODES {
        let taken = remaps
            .iter()
            .find(|entry| Remap::parse(&entry.value).code == code.code);
        match taken {
            None => edits.add_last("RS274NGC", "REMAP", &code.value()),
            Some(entry) if entry.value == code.value() => {}
            Some(entry) => {
                let found = format!("{} is remapped already", code.code);
                let help = format!(
                    "remove this line, for REMAP = {}, or call the subroutine of frames yourself",
                    code.value()
                );
                edits.refuse(&entry.place, found, help);
            }
        }
    }
}

/// The preview follows frames; a file of the user's own stays, and `check` says what it needs.
fn preview(subject: &Subject, arguments: &ConfigureArguments, edits: &mut Edits) {
    let key = ("DISPLAY", "USER_COMMAND_FILE");
    if let (Some(screen), None) = (screen(subject), subject.ini.entry(key.0, key.1)) {
        edits.set(key.0, key.1, &screen.value(&arguments.subroutines));
    }
}

/// The section as in the samples.
fn settings(subject: &Subject, first: u32, edits: &mut Edits) {
    for key in &KEYS {
        let value = match key.name {
            "ANALOG_OUTPUT" => Some(first.to_string()),
            _ => key.usual.map(str::to_owned),
        };
        match value {
            Some(value) if key.name == "ANALOG_OUTPUT" => edits.set(SECTION, key.name, &value),
            Some(value) if subject.text(SECTION, key.name).is_none() => {
                edits.set(SECTION, key.name, &value)
            }
            _ => {}
        }
    }
}
