//! framekins before kinematics that stay as they are: it is loaded first, and what chooses a type of them goes to framekins.

use super::edits::Edits;
use crate::wiring::framekins::{INNER_TYPE, MOTION_TYPE};
use crate::wiring::subject::Subject;
use crate::wiring::told_the_tool::tool_type;
use crate::wiring::turning_axes::range_pins;

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
    let types = match tool_type(subject, module) {
        Some((_, number)) => format!(" tool_types={number}"),
        None => String::new(),
    };
    edits.first_hal(format!("loadrt framekins inner={module}{types}"));
    for pin in range_pins(subject, module) {
        edits.add_hal(format!("setp {} {}", pin.pin, pin.value));
    }
    lead_type_to_framekins(subject, edits);
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
