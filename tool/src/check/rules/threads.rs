//! Motion's two functions, and framekins behind them, in one thread and in order.

use crate::check::finding::{Findings, Remedy, add, if_missing, replace};
use crate::hal::Added;
use crate::wiring::framekins::{ADD_FUNCTION, SAMPLE_OUTPUTS};
use crate::wiring::subject::Subject;

const HANDLER: &str = "motion-command-handler";
const CONTROLLER: &str = "motion-controller";

pub fn look(subject: &Subject, findings: &mut Findings) {
    motion(subject, findings);
    for function in [HANDLER, CONTROLLER] {
        let loss = "the machine does not move";
        added_once(
            subject,
            function,
            &format!("addf {function} servo-thread"),
            loss,
            findings,
        );
    }
    behind(
        subject,
        HANDLER,
        CONTROLLER,
        "every command waits for a period",
        findings,
    );
    for added in all(subject, "blendtp") {
        let found =
            "blendtp has no function of its own, motion calls it, and halcmd refuses this line";
        findings.error(&added.place, found, Remedy::Remove);
    }
    if subject.has_frames() {
        added_once(
            subject,
            "framekins",
            ADD_FUNCTION,
            "no frame command is taken",
            findings,
        );
        behind(
            subject,
            CONTROLLER,
            "framekins",
            "a frame comes a period late",
            findings,
        );
    }
}

/// Everything hangs on motmod.
fn motion(subject: &Subject, findings: &mut Findings) {
    if subject.motion().is_some() {
        return;
    }
    let outputs = match subject.has_frames() {
        true => format!(" num_aio={SAMPLE_OUTPUTS}"),
        false => String::new(),
    };
    let line = format!(
        "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS{outputs}"
    );
    let found = format!(
        "nothing loads [EMCMOT]EMCMOT, motmod{}",
        subject.unless_unread()
    );
    let place = subject.place_of("EMCMOT", "EMCMOT");
    findings.add(
        if_missing(subject),
        &place,
        found,
        add(subject.hal_file(), line),
    );
}

fn all<'a>(subject: &'a Subject, function: &str) -> Vec<&'a Added> {
    let functions = subject.state.functions.iter();
    functions
        .filter(|added| added.function == function)
        .collect()
}

fn added_once(subject: &Subject, function: &str, line: &str, loss: &str, findings: &mut Findings) {
    match all(subject, function).as_slice() {
        [] => {
            let found = format!(
                "{function} is in no thread, and {loss}{}",
                subject.unless_unread()
            );
            let module = if function == "framekins" {
                function
            } else {
                "motmod"
            };
            let place = subject.place_of_module(module);
            let file = match function {
                "framekins" => subject.hal_file(),
                _ => place.file.display().to_string(),
            };
            findings.add(if_missing(subject), &place, found, add(file, line));
        }
        [only] if only.thread != "servo-thread" => {
            let found = format!("{function} is in the thread {}, and {loss}", only.thread);
            findings.error(&only.place, found, replace(line));
        }
        [_] => {}
        [_, others @ ..] => {
            for added in others {
                let found =
                    format!("{function} is added already, and halcmd refuses the second time");
                findings.error(&added.place, found, Remedy::Remove);
            }
        }
    }
}

/// `second` has to run behind `first`.
fn behind(subject: &Subject, first: &str, second: &str, loss: &str, findings: &mut Findings) {
    let place = |name: &str| {
        subject
            .state
            .functions
            .iter()
            .position(|added| added.function == name)
    };
    let (Some(before), Some(after)) = (place(first), place(second)) else {
        return;
    };
    let added = &subject.state.functions[after];
    if after < before && added.thread == subject.state.functions[before].thread {
        let found = format!("{second} is added before {first}, and {loss}");
        let remedy = format!(
            "addf {second} {} behind addf {first} {}",
            added.thread, added.thread
        );
        findings.error(&added.place, found, crate::check::finding::advice(remedy));
    }
}
