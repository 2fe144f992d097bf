//! framekins before kinematics that stay as they are: it is loaded first, and what chooses a type of them goes to framekins.

use super::edits::Edits;
use crate::wiring::framekins::{INNER_TYPE, MOTION_TYPE};
use crate::wiring::subject::Subject;

/// Kinematics with a pin for the tool's length, and which of their types it counts for: without and with
/// `sparm=identityfirst`.
const WITH_TOOL: [(&str, &str, [u8; 2]); 5] = [
    ("5axiskins", "pivot-length", [0, 1]),
    ("maxkins", "pivot-length", [0, 0]),
    ("xyzab_tdr_kins", "tool-offset-z", [1, 1]),
    ("xyzac-trt-kins", "tool-offset", [0, 1]),
    ("xyzbc-trt-kins", "tool-offset", [0, 1]),
];

/// Loads it before these kinematics.
pub fn write(subject: &Subject, edits: &mut Edits) {
    let module = subject.kinematics();
    let place = subject.place_of("KINS", "KINEMATICS");
    if module.is_empty() {
        let help = "KINEMATICS = trivkins coordinates=XYZ under [KINS]";
        return edits.refuse(&place, "[KINS]KINEMATICS names no module", help);
    }
    if subject.state.module(module).is_none() {
        let help = "loadrt [KINS]KINEMATICS in a HAL file, before motmod";
        return edits.refuse(&place, format!("no HAL file loads {module}"), help);
    }
    edits.first_hal(format!(
        "loadrt framekins inner={module}{}",
        tool_types(subject)
    ));
    lead_type_to_framekins(subject, edits);
}

/// The parameter for kinematics that are told the tool's length.
fn tool_types(subject: &Subject) -> String {
    let module = subject.kinematics();
    let known = WITH_TOOL.iter().find(|(name, _, _)| *name == module);
    let Some((_, pin, [usual, identity_first])) = known else {
        return String::new();
    };
    if subject
        .state
        .signal_of(&format!("{module}.{pin}"))
        .is_none()
    {
        return String::new();
    }
    let is_moved = subject.kinematics_parameter("sparm") == Some("identityfirst");
    let number = if is_moved { identity_first } else { usual };
    format!(" tool_types={number}")
}

/// A net to motion's pin becomes one to that of framekins: in the INI file where it stands, behind a HAL file anew.
fn lead_type_to_framekins(subject: &Subject, edits: &mut Edits) {
    let Some(signal) = subject.state.signal_of(MOTION_TYPE) else {
        return;
    };
    let linked = subject.state.signals.get(signal).into_iter().flatten();
    let Some((_, place)) = linked.into_iter().find(|(pin, _)| pin == MOTION_TYPE) else {
        return;
    };
    let commands = subject.all("HAL", "HALCMD");
    let own = |line: usize, file: &std::path::Path| line == place.line && *file == *place.file;
    let outputs = subject.state.beside(MOTION_TYPE);
    let number = |pin: &str| pin.strip_prefix("motion.analog-out-")?.parse::<u32>().ok();
    if let Some(output) = outputs.filter_map(|(pin, _)| number(pin)).next()
        && output != subject.type_output()
    {
        edits.set("FRAMEPATH", "TYPE_OUTPUT", &output.to_string());
    }
    match commands
        .into_iter()
        .find(|entry| own(entry.place.line, &entry.place.file))
    {
        Some(entry) => edits.set_entry(entry, &entry.value.replace(MOTION_TYPE, INNER_TYPE)),
        None => {
            edits.add_hal(format!("unlinkp {MOTION_TYPE}"));
            edits.add_hal(format!("net {signal} => {INNER_TYPE}"));
        }
    }
}
