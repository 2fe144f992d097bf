//! A tilting rotary table: its dimensions, its limits, and what it has to know of the tool; and the limits of the axes that turn
//! the tool behind `inner=`.

use super::frame_nets::{look_at_net, net_line};
use crate::check::finding::{Findings, add};
use crate::wiring::framekins::{TABLE_NET, TOOL_CENTRE_POINT, TablePin, table_pins};
use crate::wiring::subject::Subject;
use crate::wiring::turning_axes::range_pins;

pub fn look(subject: &Subject, findings: &mut Findings) {
    if let Some(tilt) = subject.tilt() {
        look_at_net(subject, &TABLE_NET, findings);
        pins(subject, table_pins(tilt, &subject.joints), findings);
        tool_centre_point(subject, findings);
    } else if let Some(inner) = subject.inner() {
        pins(subject, range_pins(subject, inner), findings);
    }
}

fn is_set(subject: &Subject, pin: &str) -> bool {
    subject.state.settings.contains_key(pin) || subject.state.signal_of(pin).is_some()
}

fn pins(subject: &Subject, needed: Vec<TablePin>, findings: &mut Findings) {
    let place = subject.place_of_module("framekins");
    for needed in needed {
        // The line is there and was refused.
        let key = needed
            .value
            .split_once(']')
            .map(|(section, key)| (section.trim_start_matches('['), key));
        let is_refused =
            key.is_some_and(|(section, key)| subject.ini.entry(section, key).is_none());
        if is_set(subject, &needed.pin) || is_refused {
            continue;
        }
        let found = format!(
            "nothing sets {}: {}{}",
            needed.pin,
            needed.without,
            subject.unless_unread()
        );
        let line = format!("setp {} {}", needed.pin, needed.value);
        findings.warning(&place, found, add(subject.hal_file(), line));
    }
}

fn tool_centre_point(subject: &Subject, findings: &mut Findings) {
    if !is_set(subject, TOOL_CENTRE_POINT.pin) {
        let found = format!(
            "{} is not linked: {}",
            TOOL_CENTRE_POINT.pin, TOOL_CENTRE_POINT.loss
        );
        let place = subject.place_of_module("framekins");
        findings.note(&place, found, net_line(subject, &TOOL_CENTRE_POINT));
    }
}
