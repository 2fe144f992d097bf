//! What `blendtp.rotary-tolerance` is a tolerance of: the tool axis, where framekins tells what tilts it, else each axis.

use crate::check::finding::{Findings, Remedy, advice};
use crate::wiring::subject::Subject;

const PIN: &str = "blendtp.rotary-tolerance";

/// Kinematics whose rotary axes tilt the tool.
const TILTING: [&str; 6] = [
    "5axiskins",
    "maxkins",
    "xyzab_tdr_kins",
    "xyzac-trt-kins",
    "xyzacb_trsrn",
    "xyzbc-trt-kins",
];

/// Those of which framekins finds out which axis tilts the tool while C turns it.
const ASKED_BY_FRAMEKINS: [&str; 4] = ["5axiskins", "maxkins", "xyzac-trt-kins", "xyzbc-trt-kins"];

pub fn look(subject: &Subject, findings: &mut Findings) {
    let kinematics = subject.inner().unwrap_or(subject.kinematics());
    let is_asked = ASKED_BY_FRAMEKINS.contains(&kinematics);
    let is_silent = TILTING.contains(&kinematics) && !(is_asked && subject.inner().is_some());
    let (true, Some(setting)) = (is_silent, subject.state.settings.get(PIN)) else {
        return;
    };
    if !setting
        .value
        .parse()
        .is_ok_and(|degrees: f64| degrees > 0.0)
    {
        return;
    }
    let found = format!(
        "{PIN} is {} degrees for each rotary axis by itself, since {kinematics} does not tell which of them tilts the tool: two axes \
         together may lean the tool by more, and next to the pole C keeps as near to the program as elsewhere",
        setting.value
    );
    findings.note(
        &setting.statement.place,
        found,
        remedy(kinematics, is_asked),
    );
}

fn remedy(kinematics: &str, is_asked: bool) -> Remedy {
    let half = "write half of what the tool axis may lean";
    advice(match is_asked {
        true => format!(
            "{half}, or load framekins before it (loadrt framekins inner={kinematics}), which finds that out: with it this is a \
             tolerance of the tool axis"
        ),
        false => half.to_owned(),
    })
}
