//! framekins before the kinematics of another module (`inner=`): what is loaded in which order, and the type of the
//! kinematics that programs ask for.

use crate::check::finding::{Findings, add, advice, if_missing, replace};
use crate::hal::Module;
use crate::wiring::framekins::{INNER_TYPE as TYPE, MOTION_TYPE as MOTION, OUTPUTS};
use crate::wiring::subject::Subject;
use crate::wiring::told_the_tool::tool_type;
use framepath::kinematics::ToolAxes;
use framepath::kinematics::inner::tool_types;

pub fn look(subject: &Subject, module: &Module, inner: &str, findings: &mut Findings) {
    parameters(module, inner, findings);
    tool_of_type(subject, module, inner, findings);
    named(subject, module, inner, findings);
    order(subject, module, inner, findings);
    types(subject, findings);
}

fn parameters(module: &Module, inner: &str, findings: &mut Findings) {
    let place = &module.statement.place;
    for name in ["coordinates", "machine", "tool_length"] {
        if module
            .parameter(name)
            .is_some_and(|value| !value.is_empty())
        {
            let found = format!(
                "framekins is not loaded: inner={inner} and {name}= exclude each other, since the joints are those of {inner}"
            );
            findings.error(
                place,
                found,
                replace(format!("loadrt framekins inner={inner}")),
            );
        }
    }
    let types = module.parameter("tool_types").unwrap_or("");
    if tool_types(types.as_bytes()).is_none() {
        let found =
            format!("framekins is not loaded: tool_types={types} is no list of types from 0 to 15");
        findings.error(place, found, advice("tool_types=0,2"));
    }
    let axes = module.parameter("tool_axes").unwrap_or("");
    if ToolAxes::from_text(axes.as_bytes()).is_none() {
        let found = format!(
            "framekins is not loaded: tool_axes={axes} names no axes of A B C that could turn a tool"
        );
        findings.error(place, found, advice("tool_axes=C,B"));
    }
}

/// What turns the tool's length itself cannot be seen from outside.
fn tool_of_type(subject: &Subject, module: &Module, inner: &str, findings: &mut Findings) {
    let Some((pin, number)) = tool_type(subject, inner) else {
        return;
    };
    let written = module.parameter("tool_types").unwrap_or("");
    let bits = tool_types(written.as_bytes());
    if bits.is_some_and(|bits| bits & 1 << number == 0) {
        let found = format!(
            "{pin} is linked, and framekins takes the tool of type {number} of {inner} for one that stays along Z: its tip \
             is elsewhere in a tilted frame"
        );
        let separator = if written.is_empty() { "" } else { "," };
        let list = format!("tool_types={number}{separator}{written}");
        let remedy = format!("write {list}, unless {pin} has nothing of the tool");
        findings.warning(&module.statement.place, found, advice(remedy));
    }
}

/// What the INI file says is what screens believe.
fn named(subject: &Subject, module: &Module, inner: &str, findings: &mut Findings) {
    if subject.kinematics() != inner {
        let found = format!(
            "framekins is loaded before {inner}, and [KINS]KINEMATICS is {}",
            subject.kinematics()
        );
        let remedy = format!(
            "write loadrt framekins inner= with the module of [KINS]KINEMATICS, or KINEMATICS = {inner}"
        );
        findings.warning(&module.statement.place, found, advice(remedy));
    }
}

/// framekins, the module, motmod.
fn order(subject: &Subject, module: &Module, inner: &str, findings: &mut Findings) {
    let position = |name: &str| {
        let mut modules = subject.state.modules.iter();
        modules.position(|module| module.name == name)
    };
    let (own, other) = (position("framekins"), position(inner));
    let remedy = format!(
        "first loadrt framekins inner={inner}, then loadrt [KINS]KINEMATICS, then loadrt [EMCMOT]EMCMOT"
    );
    let place = &module.statement.place;
    match (other, position("motmod")) {
        (None, _) => {
            let found = format!(
                "nothing loads {inner}, and framekins finds no kinematics{}",
                subject.unless_unread()
            );
            let line = add("the line behind it", "loadrt [KINS]KINEMATICS");
            findings.add(if_missing(subject), place, found, line);
        }
        (Some(_), _) if other < own => {
            let found = format!("{inner} is loaded before framekins, which is not loaded then");
            findings.error(place, found, advice(remedy));
        }
        (Some(_), Some(motion)) if other > Some(motion) => {
            let found =
                format!("motmod is loaded before {inner}, and framekins finds no kinematics");
            findings.error(place, found, advice(remedy));
        }
        _ => {}
    }
}

/// The number of an analog output.
fn output(pin: &str) -> Option<u32> {
    pin.strip_prefix("motion.analog-out-")?.parse().ok()
}

/// What went to motion to choose a type goes to framekins, over an output that is not one of a frame's.
fn types(subject: &Subject, findings: &mut Findings) {
    let is_linked = subject.state.signal_of(TYPE).is_some();
    for (pin, place) in subject.state.beside(MOTION) {
        if !is_linked && output(pin).is_some() {
            let found =
                format!("{pin} chooses the kinematics past framekins, which knows nothing of it");
            findings.error(
                place,
                found,
                replace(format!("net inner-type {pin} => {TYPE}")),
            );
        }
    }
    let frames = subject.first_output()..subject.first_output() + OUTPUTS;
    for (pin, place) in subject.state.beside(TYPE) {
        if let Some(taken) = output(pin).filter(|output| frames.contains(output)) {
            let found = format!("{pin} chooses the kinematics and carries a part of each frame");
            let remedy = format!(
                "ANALOG_OUTPUT = {} under [FRAMEPATH], with num_aio={} and the nets of frames from there",
                taken + 1,
                taken + 1 + OUTPUTS
            );
            findings.error(place, found, advice(remedy));
        }
    }
    type_output(subject, findings);
}

/// G43.4 puts the type on an output of which the INI file tells.
fn type_output(subject: &Subject, findings: &mut Findings) {
    let outputs = subject.state.beside(TYPE);
    let mut outputs = outputs.filter_map(|(pin, place)| Some((output(pin)?, place)));
    if let Some((number, place)) = outputs.next()
        && number != subject.type_output()
    {
        let found = format!(
            "G43.4 chooses the kinematics by output {}, and is refused since {number} is linked",
            subject.type_output()
        );
        let line = format!("TYPE_OUTPUT = {number}");
        findings.warning(place, found, add("[FRAMEPATH]", line));
    }
}
