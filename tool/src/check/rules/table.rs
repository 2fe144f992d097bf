//! A tilting rotary table: its dimensions, its limits, and what it has to know of the tool.

use super::frame_nets::{look_at_net, net_line};
use crate::check::finding::{Findings, add};
use crate::wiring::framekins::{TABLE_NET, TOOL_CENTRE_POINT, table_pins};
use crate::wiring::subject::Subject;

pub fn look(subject: &Subject, findings: &mut Findings) {
    let Some(tilt) = subject.tilt() else {
        return;
    };
    look_at_net(subject, &TABLE_NET, findings);
    let state = &subject.state;
    let is_set = |pin: &str| state.settings.contains_key(pin) || state.signal_of(pin).is_some();
    let place = subject.place_of_module("framekins");
    for needed in table_pins(tilt, &subject.joints) {
        // The line is there and was refused.
        let key = needed
            .value
            .split_once(']')
            .map(|(section, key)| (section.trim_start_matches('['), key));
        let is_refused =
            key.is_some_and(|(section, key)| subject.ini.entry(section, key).is_none());
        if is_set(&needed.pin) || is_refused {
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
    if !is_set(TOOL_CENTRE_POINT.pin) {
        let found = format!(
            "{} is not linked: {}",
            TOOL_CENTRE_POINT.pin, TOOL_CENTRE_POINT.loss
        );
        findings.note(&place, found, net_line(subject, &TOOL_CENTRE_POINT));
    }
}
