//! The lines for blendtp: `[TRAJ]TPMOD`, a jerk limit for each axis, and what takes it to the pin.

use super::ConfigureArguments;
use super::edits::Edits;
use crate::machine::IniError;
use crate::machine::angles;
use crate::machine::configuration::{DEFAULT_LIMIT, taken_instead, unit_of};
use crate::machine::jerk::Jerk;
use crate::machine::length_unit;
use crate::machine::numbers;
use crate::machine::place::Place;
use crate::wiring::USUAL_JERK;
use crate::wiring::blendtp::{
    TOLERANCE_PIN, inch_line, inch_tolerance_line, jerk_line, jerk_pin, least_jerk,
};
use crate::wiring::comments;
use crate::wiring::subject::{Subject, shared};

/// Adds what is not there yet.
pub fn write(subject: &Subject, arguments: &ConfigureArguments, edits: &mut Edits) {
    usable(subject, edits);
    if subject.has_planner() && !arguments.frames {
        let place = subject.place_of("TRAJ", "TPMOD");
        return edits.refuse(
            &place,
            "this configuration has blendtp already",
            "framepath check says what it lacks",
        );
    }
    if subject.planner() != "blendtp" {
        edits.set("TRAJ", "TPMOD", "blendtp");
    }
    for letter in &subject.axes {
        jerk(subject, *letter, arguments, edits);
    }
    if subject.is_in_inches() && !subject.state.settings.contains_key("blendtp.millimetre") {
        edits.add_hal(inch_line());
    }
    if subject.is_in_inches() && !subject.state.settings.contains_key(TOLERANCE_PIN) {
        edits.add_hal(inch_tolerance_line());
    }
}

/// What LinuxCNC itself would not start with is for `check`.
fn usable(subject: &Subject, edits: &mut Edits) {
    if subject.text("EMC", "VERSION") != Some("1.1") {
        let place = subject.place_of("EMC", "VERSION");
        edits.refuse(
            &place,
            "the file is for another LinuxCNC",
            "start LinuxCNC once, or run update_ini, which writes VERSION = 1.1",
        );
    }
    for problem in &subject.ini_problems {
        if let IniError::Refused {
            file,
            line,
            problem,
            remedy,
        } = problem
        {
            edits.refuse(&Place::new(&shared(file), *line, 0), problem, remedy);
        }
    }
    for problem in &subject.script.problems {
        edits.refuse(
            &problem.place,
            &problem.found,
            "LinuxCNC does not start with this: framepath check says what to write",
        );
    }
    for entry in comments::commented(subject) {
        let help = format!(
            "{}, and the comment in a line of its own",
            comments::line(entry)
        );
        edits.refuse(&entry.place, comments::found(entry), help);
    }
    let name = subject.ini.file().file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    if name.contains(char::is_whitespace) {
        edits.refuse(
            &Place::file(subject.ini.file()),
            "the name of the file has a blank, at which LinuxCNC cuts the name of the HAL file that is called after it (HALFILE)",
            format!("call the file {}", name.split_whitespace().collect::<Vec<_>>().join("-")),
        );
    }
    if subject.axes.is_empty() {
        let place = Place::file(subject.ini.file());
        edits.refuse(
            &place,
            "[TRAJ]COORDINATES is missing",
            "COORDINATES = XYZ under [TRAJ], the axes of the machine",
        );
    }
    units(subject, edits);
    if let Some(module) = subject.state.module("blendtp") {
        edits.refuse(
            &module.statement.place,
            "a HAL file loads blendtp",
            "remove this line: [TRAJ]TPMOD loads it",
        );
    }
}

/// LinuxCNC does not start without units, and the lines for blendtp are for these alone.
fn units(subject: &Subject, edits: &mut Edits) {
    for (key, is_known, problem, help) in [
        (
            "LINEAR_UNITS",
            subject.length_unit().is_some(),
            length_unit::PROBLEM,
            "LINEAR_UNITS = mm, or inch, under [TRAJ], and all lengths in that unit",
        ),
        (
            "ANGULAR_UNITS",
            subject.text("TRAJ", "ANGULAR_UNITS").is_some() && angles::are_degrees(&subject.ini),
            angles::PROBLEM,
            angles::REMEDY,
        ),
    ] {
        if !is_known {
            let found = match subject.text("TRAJ", key) {
                Some(unit) => format!("[TRAJ]{key} = {unit}: {problem}"),
                None => format!("[TRAJ]{key} is missing, without which LinuxCNC does not start"),
            };
            edits.refuse(&subject.place_of("TRAJ", key), found, help);
        }
    }
}

fn jerk(subject: &Subject, letter: char, arguments: &ConfigureArguments, edits: &mut Edits) {
    let section = format!("AXIS_{letter}");
    let pin = jerk_pin(letter);
    if subject.state.settings.contains_key(&pin) || subject.state.signal_of(&pin).is_some() {
        return;
    }
    if subject.text(&section, "MAX_JERK").is_some() {
        edits.add_hal(jerk_line(letter));
        return own_jerk(subject, &section, edits);
    }
    let Some(acceleration) = acceleration(subject, letter, arguments.jerk, edits) else {
        return;
    };
    let jerk = arguments.jerk.of_axis(acceleration);
    if jerk > 0.0 && jerk < least_jerk(acceleration) {
        let found = format!(
            "--jerk {} lets nothing move: {}",
            arguments.jerk,
            needed(&section, acceleration)
        );
        let place = subject.place_of(&section, "MAX_ACCELERATION");
        let help = "--jerk 20A, which is usual, or --jerk unlimited";
        edits.refuse(&place, found, help);
    }
    // LinuxCNC checks the limits of axes that have a section against those of their joints, and does not start where a new one has none.
    match subject.ini.has_section(&section) {
        true => {
            edits.add_hal(jerk_line(letter));
            edits.add_last(&section, "MAX_JERK", &jerk.to_string());
        }
        false => edits.add_hal(format!("setp {pin} {jerk}")),
    }
}

/// The acceleration of an axis: where the INI file gives none, what LinuxCNC takes, with a warning if the jerk comes from it. One that
/// is no number above 0 is refused: LinuxCNC does not start, or nothing moves.
fn acceleration(subject: &Subject, letter: char, jerk: Jerk, edits: &mut Edits) -> Option<f64> {
    let (section, key) = (format!("AXIS_{letter}"), "MAX_ACCELERATION");
    let Some(entry) = subject.ini.entry(&section, key) else {
        if matches!(jerk, Jerk::Accelerations(_)) {
            let unit = unit_of(letter, subject.length_unit().unwrap_or("machine units"));
            let unit = format!("{unit}/s2");
            edits.warn(taken_instead(&subject.ini, &section, key, &unit, "1000"));
        }
        return Some(DEFAULT_LIMIT);
    };
    let acceleration = numbers::number(entry).filter(|number| *number > 0.0);
    if acceleration.is_none() {
        let found = format!("[{section}]{key} = {} is no number above 0", entry.raw);
        let help = format!("{key} = a number alone, machine units per second squared");
        edits.refuse(&entry.place, found, help);
    }
    acceleration
}

/// The limit of jerk that the configuration has already, which nothing has used so far.
fn own_jerk(subject: &Subject, section: &str, edits: &mut Edits) {
    let written = subject.ini.entry(section, "MAX_JERK");
    if let Some(entry) = written.filter(|entry| numbers::number(entry).is_none()) {
        let found = format!("[{section}]MAX_JERK = {} is no number", entry.raw);
        let remedy = "MAX_JERK = a number alone, and a comment in a line of its own";
        return edits.refuse(&entry.place, found, remedy);
    }
    let [jerk, acceleration] =
        ["MAX_JERK", "MAX_ACCELERATION"].map(|key| subject.number(section, key));
    if let (Some(jerk), Some(acceleration)) = (jerk, acceleration)
        && (jerk < 0.0 || jerk > 0.0 && jerk < least_jerk(acceleration))
    {
        let found = format!(
            "[{section}]MAX_JERK = {jerk} lets nothing move: {}",
            needed(section, acceleration)
        );
        let place = subject.place_of(section, "MAX_JERK");
        let usual = acceleration * USUAL_JERK;
        edits.refuse(&place, found, format!("MAX_JERK = {usual}"));
    }
}

/// What blendtp asks of a limit of jerk.
fn needed(section: &str, acceleration: f64) -> String {
    format!(
        "blendtp takes 0 (not limited) or at least {}, a fifth of [{section}]MAX_ACCELERATION",
        least_jerk(acceleration)
    )
}
