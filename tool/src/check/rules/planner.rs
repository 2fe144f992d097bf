//! blendtp: its jerk limits and tolerances, the servo period, the greatest velocity.

use crate::check::finding::{Findings, Level, Remedy, add, advice, if_missing, replace};
use crate::hal::{Fix, Setting, number};
use crate::machine::length_unit::INCH;
use crate::wiring::USUAL_JERK;
use crate::wiring::blendtp::{
    TOLERANCE_PIN, axis_of_pin, has_pin, inch_tolerance_line, is_refused_jerk, jerk_line, jerk_pin,
    least_jerk,
};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    unknown_pins(subject, findings);
    for letter in &subject.axes {
        jerk(subject, *letter, findings);
    }
    other_axes(subject, findings);
    tolerances(subject, findings);
    tolerance_in_inches(subject, findings);
    millimetre(subject, findings);
    period(subject, findings);
    greatest_velocity(subject, findings);
}

fn unknown_pins(subject: &Subject, findings: &mut Findings) {
    for statement in &subject.script.statements {
        for word in &statement.words {
            if word.text.starts_with("blendtp.") && !has_pin(&word.text) {
                let found = format!(
                    "blendtp has no pin {}, and halcmd refuses the line",
                    word.text
                );
                let remedy = "correct the name: man blendtp has all of them";
                findings.error(&word.place, found, advice(remedy));
            }
        }
    }
}

fn jerk(subject: &Subject, letter: char, findings: &mut Findings) {
    let section = format!("AXIS_{letter}");
    let pin = jerk_pin(letter);
    let entry = subject.ini.entry(&section, "MAX_JERK");
    let is_linked = subject.state.signal_of(&pin).is_some();
    match (subject.state.settings.get(&pin), entry) {
        (Some(setting), _) => value(subject, letter, setting, findings),
        (None, _) if is_linked => {}
        (None, Some(entry)) => findings.add(
            if_missing(subject),
            &entry.place,
            format!(
                "nothing sets {pin}, so that the jerk of {letter} is not limited, although the INI file has a limit{}",
                subject.unless_unread()
            ),
            add(subject.hal_file(), jerk_line(letter)),
        ),
        (None, None) => no_limit(subject, letter, findings),
    }
}

fn no_limit(subject: &Subject, letter: char, findings: &mut Findings) {
    let section = format!("AXIS_{letter}");
    // Then the key is asked for already.
    let asked = |fix: &Fix| matches!(fix, Fix::Key { section: other, .. } if *other == section);
    if subject
        .script
        .problems
        .iter()
        .any(|problem| asked(&problem.remedy))
    {
        return;
    }
    let remedy = match subject.number(&section, "MAX_ACCELERATION") {
        Some(acceleration) => advice(format!(
            "under [{section}] MAX_JERK = {}, and in {}: {}",
            acceleration * USUAL_JERK,
            subject.hal_file(),
            jerk_line(letter)
        )),
        None => advice(format!(
            "MAX_JERK under [{section}], and {}",
            jerk_line(letter)
        )),
    };
    let found = format!(
        "the jerk of {letter} is not limited{}",
        subject.unless_unread()
    );
    findings.warning(&subject.place_of(&section, "MAX_VELOCITY"), found, remedy);
}

fn value(subject: &Subject, letter: char, setting: &Setting, findings: &mut Findings) {
    let section = format!("AXIS_{letter}");
    let place = &setting.statement.place;
    let pin = jerk_pin(letter);
    let acceleration = subject.number(&section, "MAX_ACCELERATION");
    let likely = acceleration.map_or("...".to_owned(), |a| (a * USUAL_JERK).to_string());
    let key_place = match setting.statement.text.contains(&format!("[{section}]")) {
        true => subject.place_of(&section, "MAX_JERK"),
        false => place.clone(),
    };
    let Some(jerk) = number(&setting.value) else {
        let found = format!("{pin} is set to `{}`, which is no number", setting.value);
        return findings.error(&key_place, found, replace(format!("MAX_JERK = {likely}")));
    };
    let least = least_jerk(acceleration.unwrap_or(0.0));
    if jerk == f64::INFINITY {
        return;
    }
    if is_refused_jerk(jerk, least) {
        let found = format!(
            "{pin} is {jerk}, and blendtp refuses every move: it has to be 0 (not limited) or at least {least}, a fifth of \
             the acceleration"
        );
        return findings.error(&key_place, found, replace(format!("MAX_JERK = {likely}")));
    }
    let period = subject.number("EMCMOT", "SERVO_PERIOD").unwrap_or(1e6) * 1e-9;
    if acceleration.is_some_and(|acceleration| jerk * period > acceleration) {
        let found = format!(
            "{pin} is {jerk}: more than the acceleration can change in a servo period, so that nothing is limited"
        );
        findings.note(&key_place, found, replace(format!("MAX_JERK = {likely}")));
    }
    match subject.ini.entry(&section, "MAX_JERK") {
        Some(entry) if subject.number(&section, "MAX_JERK") != Some(jerk) => {
            let found = format!(
                "{pin} is set to {jerk}, and [{section}]MAX_JERK = {} is not used",
                entry.value
            );
            findings.warning(place, found, replace(jerk_line(letter)));
        }
        _ => {}
    }
}

/// Axes that the machine does not have.
fn other_axes(subject: &Subject, findings: &mut Findings) {
    for (pin, setting) in &subject.state.settings {
        let Some(letter) = axis_of_pin(pin).filter(|letter| !subject.axes.contains(letter)) else {
            continue;
        };
        let found = format!("the machine has no axis {letter} ([TRAJ]COORDINATES)");
        findings.warning(&setting.statement.place, found, Remedy::Remove);
    }
}

fn tolerances(subject: &Subject, findings: &mut Findings) {
    for (name, unit) in [
        ("rotary-tolerance", "degrees"),
        ("default-tolerance", "machine units"),
    ] {
        let pin = format!("blendtp.{name}");
        let Some(setting) = subject.state.settings.get(&pin) else {
            continue;
        };
        let is_possible = |number: f64| (0.0..=1e6).contains(&number);
        if !number(&setting.value).is_some_and(is_possible) {
            let found = format!(
                "{pin} is `{}`, and blendtp refuses every move: it has to be a number of {unit} from 0 to 1e6",
                setting.value
            );
            findings.error(&setting.statement.place, found, Remedy::Remove);
        }
    }
}

/// What blendtp begins with is meant for millimetres.
fn tolerance_in_inches(subject: &Subject, findings: &mut Findings) {
    let is_set = subject.state.settings.contains_key(TOLERANCE_PIN)
        || subject.state.signal_of(TOLERANCE_PIN).is_some();
    if is_set || !subject.is_in_inches() {
        return;
    }
    let found = format!(
        "the machine is in inches, and {TOLERANCE_PIN} is 0.02 of them, half a millimetre: so far runs of short moves may leave \
         the program under G64 without P{}",
        subject.unless_unread()
    );
    findings.warning(
        &subject.place_of("TRAJ", "LINEAR_UNITS"),
        found,
        add(subject.hal_file(), inch_tolerance_line()),
    );
}

fn millimetre(subject: &Subject, findings: &mut Findings) {
    let units = subject.text("TRAJ", "LINEAR_UNITS").unwrap_or("");
    let unit = match subject.length_unit() {
        Some("in") => 1.0 / INCH,
        Some(_) => 1.0,
        None => return,
    };
    let pin = "blendtp.millimetre";
    let line = format!(
        "setp {pin} {}",
        if unit < 1.0 { "0.0393700787" } else { "1" }
    );
    match subject.state.settings.get(pin) {
        None if unit < 1.0 => findings.add(
            if_missing(subject).max(Level::Warning),
            &subject.place_of("TRAJ", "LINEAR_UNITS"),
            format!(
                "the machine is in inches, and {pin} says that a millimetre is one machine unit{}",
                subject.unless_unread()
            ),
            add(subject.hal_file(), line),
        ),
        Some(setting)
            if !number(&setting.value).is_some_and(|value| (value / unit - 1.0).abs() < 1e-3) =>
        {
            let found = format!(
                "{pin} is {}, and [TRAJ]LINEAR_UNITS is {units}",
                setting.value
            );
            findings.error(&setting.statement.place, found, replace(line));
        }
        _ => {}
    }
}

fn period(subject: &Subject, findings: &mut Findings) {
    let period = subject.number("EMCMOT", "SERVO_PERIOD");
    if period.is_some_and(|period| !(1e4..=1e8).contains(&period)) {
        findings.error(
            &subject.place_of("EMCMOT", "SERVO_PERIOD"),
            "blendtp refuses every move: the servo period is in nanoseconds, 10000 to 100000000",
            replace("SERVO_PERIOD = 1000000"),
        );
    }
}

fn greatest_velocity(subject: &Subject, findings: &mut Findings) {
    let velocity = subject.number("TRAJ", "MAX_LINEAR_VELOCITY");
    if velocity.is_some_and(|velocity| velocity <= 0.0) {
        let greatest = subject
            .axes
            .iter()
            .filter_map(|l| subject.number(&format!("AXIS_{l}"), "MAX_VELOCITY"));
        let greatest = greatest.fold(0.0, f64::max);
        findings.error(
            &subject.place_of("TRAJ", "MAX_LINEAR_VELOCITY"),
            "blendtp refuses every move: the greatest velocity along the path has to be above 0",
            replace(format!("MAX_LINEAR_VELOCITY = {greatest}")),
        );
    }
}
