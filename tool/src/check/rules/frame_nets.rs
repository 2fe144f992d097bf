//! The nets of framekins: between it and motion, and from the analog outputs that carry a frame.

use crate::check::finding::{Findings, Remedy, add, advice, if_missing, replace};
use crate::wiring::framekins::{
    MOST_OUTPUTS, NETS, Net, OUTPUTS, SAMPLE_OUTPUTS, Source, USUAL_OUTPUTS, has_pin, needs_inner,
    needs_table, needs_turning_axes,
};
use crate::wiring::outputs_line::OutputsLine;
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    unknown_pins(subject, findings);
    outputs(subject, findings);
    for net in &NETS {
        match net.pin {
            "motion.feed-inhibit" | "motion.enable" => stop(subject, net, findings),
            _ => look_at_net(subject, net, findings),
        }
    }
}

fn unknown_pins(subject: &Subject, findings: &mut Findings) {
    let has_table = subject.tilt().is_some();
    for statement in &subject.script.statements {
        for word in statement
            .words
            .iter()
            .filter(|word| word.text.starts_with("framekins."))
        {
            if !has_pin(&word.text) {
                let found = format!(
                    "framekins has no pin {}, and halcmd refuses the line",
                    word.text
                );
                findings.error(
                    &word.place,
                    found,
                    advice("correct the name: man framekins has all of them"),
                );
            } else if needs_table(&word.text) && !has_table {
                let found = format!(
                    "{} is there with a tilting table only, and halcmd refuses the line",
                    word.text
                );
                let remedy = "write machine=xyzac or machine=xyzbc behind framekins under [KINS]KINEMATICS, or remove the line";
                findings.error(&word.place, found, advice(remedy));
            } else if needs_turning_axes(&word.text) && !has_table && subject.inner().is_none() {
                let found = format!(
                    "{} is there with a tilting table or inner= only, and halcmd refuses the line",
                    word.text
                );
                let remedy = "remove the line, or name the machine: machine=xyzac or machine=xyzbc behind framekins under [KINS]KINEMATICS, or loadrt framekins inner= before all others";
                findings.error(&word.place, found, advice(remedy));
            } else if needs_inner(&word.text) && subject.inner().is_none() {
                let found = format!(
                    "{} is there with inner= only, and halcmd refuses the line",
                    word.text
                );
                let remedy = "write loadrt framekins inner= with the module of [KINS]KINEMATICS before all others, or remove the line";
                findings.error(&word.place, found, advice(remedy));
            }
        }
    }
}

/// `num_aio` of motmod.
fn outputs(subject: &Subject, findings: &mut Findings) {
    let Some(motion) = subject.motion() else {
        return;
    };
    let given = motion.parameter("num_aio");
    let there = given.map_or(Some(USUAL_OUTPUTS), |text| text.parse().ok());
    let needed = subject.first_output() + OUTPUTS;
    if there.is_some_and(|there| (needed..=MOST_OUTPUTS).contains(&there)) {
        return;
    }
    let enough = needed.max(SAMPLE_OUTPUTS);
    let found = match given {
        None => format!(
            "motmod has {USUAL_OUTPUTS} analog outputs, and frames take motion.analog-out-{:02} to {:02}",
            needed - OUTPUTS,
            needed - 1
        ),
        Some(given) => format!(
            "num_aio={given}: frames take motion.analog-out-{:02} to {:02}, and motmod has {MOST_OUTPUTS} at most",
            needed - OUTPUTS,
            needed - 1
        ),
    };
    match OutputsLine::new(subject, motion, enough) {
        OutputsLine::Ini { place, key, value } => {
            let line = format!("{key} = {value}");
            let remedy = match subject.ini.entry("EMCMOT", key) {
                Some(_) => replace(line),
                None => add("[EMCMOT]", line),
            };
            findings.error(&place, found, remedy);
        }
        OutputsLine::Hal(line) => {
            findings.error(&motion.statement.place, found, replace(line));
        }
    }
}

/// The remedy for a net that is missing: the line of the samples, with the signal that is there already.
pub fn net_line(subject: &Subject, net: &Net) -> Remedy {
    let source = net.source_pin(subject.first_output());
    let line = match subject.state.signal_of(&source) {
        Some(signal) => format!("net {signal} => {}", net.pin),
        None => match subject.state.signal_of(net.pin) {
            Some(signal) => format!("net {signal} {source}"),
            None => net.line(subject.first_output()),
        },
    };
    add(subject.hal_file(), line)
}

/// A net from a certain pin to a certain pin.
pub fn look_at_net(subject: &Subject, net: &Net, findings: &mut Findings) {
    let source = net.source_pin(subject.first_output());
    let beside: Vec<_> = subject.state.beside(net.pin).collect();
    let missing = |findings: &mut Findings, found: String| {
        let place = subject.place_of_module("framekins");
        findings.add(
            if_missing(subject),
            &place,
            found + &subject.unless_unread(),
            net_line(subject, net),
        );
    };
    if beside.is_empty() {
        return missing(findings, format!("{} is not linked: {}", net.pin, net.loss));
    }
    if beside.iter().any(|(pin, _)| *pin == source) {
        return;
    }
    // What stands between may be meant; another output, or another pin of motion, is a mistake.
    let is_motion = |pin: &str| pin.starts_with("motion.") || pin.starts_with("framekins.");
    let is_other = |pin: &str| match net.source {
        Source::Output(_) => pin.starts_with("motion.analog-out-"),
        Source::Pin(_) => {
            is_motion(pin)
                && !NETS.iter().any(|net| net.pin == pin)
                && pin != "framekins.tool-offset"
        }
    };
    if let Some((pin, place)) = beside.iter().find(|(pin, _)| is_other(pin)) {
        let found = format!(
            "{} is linked to {pin}, and {source} is needed: {}",
            net.pin, net.loss
        );
        findings.error(place, found, replace(net.line(subject.first_output())));
    } else if beside.iter().all(|(pin, _)| is_motion(pin)) {
        missing(
            findings,
            format!("nothing writes the signal of {}: {}", net.pin, net.loss),
        );
    }
}

/// What holds or stops the machine may go through the or2 or and2 of a machine that has more reasons to.
fn stop(subject: &Subject, net: &Net, findings: &mut Findings) {
    let Source::Pin(own) = net.source else {
        return;
    };
    let is_heard = subject.state.beside(own).next().is_some();
    let is_written = subject.state.beside(net.pin).next().is_some();
    if is_heard && is_written {
        return;
    }
    let remedy = match (is_heard, subject.state.signal_of(net.pin)) {
        (false, Some(signal)) => {
            let gate = if net.pin == "motion.enable" {
                "and2"
            } else {
                "or2"
            };
            advice(format!(
                "{} is on the signal {signal}: join it with {own} in an {gate} (loadrt, addf, net), and link that to {}",
                net.pin, net.pin
            ))
        }
        _ => net_line(subject, net),
    };
    let place = subject.place_of_module("framekins");
    let found = match is_heard {
        true => format!("{} is not linked: {}", net.pin, net.loss),
        false => format!("{own} goes nowhere: {}", net.loss),
    };
    findings.add(
        if_missing(subject),
        &place,
        found + &subject.unless_unread(),
        remedy,
    );
}
