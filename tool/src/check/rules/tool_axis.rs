//! What `blendtp.rotary-tolerance` is a tolerance of: the tool axis, where framekins tells what tilts it, else each axis.

use crate::check::finding::{Findings, Remedy, advice};
use crate::wiring::subject::Subject;

const PIN: &str = "blendtp.rotary-tolerance";

/// Kinematics whose rotary axes tilt the tool, and which do not tell which of them does; with the table of ours that is
/// the same machine.
const SILENT: [(&str, Option<&str>); 6] = [
    ("5axiskins", None),
    ("maxkins", None),
    ("xyzab_tdr_kins", None),
    ("xyzac-trt-kins", Some("xyzac")),
    ("xyzacb_trsrn", None),
    ("xyzbc-trt-kins", Some("xyzbc")),
];

pub fn look(subject: &Subject, findings: &mut Findings) {
    let kinematics = subject.inner().unwrap_or(subject.kinematics());
    let silent = SILENT.iter().find(|(name, _)| *name == kinematics);
    let (Some((name, ours)), Some(setting)) = (silent, subject.state.settings.get(PIN)) else {
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
        "{PIN} is {} degrees for each rotary axis by itself, since {name} does not tell which of them tilts the tool: two axes \
         together may lean the tool by more, and next to the pole C keeps as near to the program as elsewhere",
        setting.value
    );
    findings.note(&setting.statement.place, found, remedy(*ours));
}

fn remedy(ours: Option<&str>) -> Remedy {
    let half = "write half of what the tool axis may lean";
    advice(match ours {
        Some(table) => format!(
            "{half}, or take the table of framekins (machine={table}), with which it is a tolerance of the tool axis"
        ),
        None => half.to_owned(),
    })
}
