//! Pins that are bits, and set to what is none: halcmd refuses the line.

use crate::check::finding::{Findings, replace};
use crate::hal::{is_bit, is_value, number};
use crate::wiring::subject::Subject;

/// Those of framekins, blendtp and motion that a HAL file may set: `#` is a number, `*` a letter.
const BITS: [&str; 37] = [
    "framekins.mirror.*",
    "framekins.in-position",
    "framekins.teleop",
    "framekins.tool-length-machine",
    "framekins.conventional-directions",
    "framekins.tool-centre-point",
    "framekins.enabled",
    "framekins.release-on-abort",
    "framekins.release",
    "blendtp.corners-inside",
    "motion.digital-in-#",
    "motion.enable",
    "motion.feed-hold",
    "motion.feed-inhibit",
    "motion.homing-inhibit",
    "motion.jog-inhibit",
    "motion.jog-stop",
    "motion.jog-stop-immediate",
    "motion.misc-error-#",
    "motion.probe-input",
    "axis.*.eoffset-clear",
    "axis.*.eoffset-enable",
    "axis.*.jog-enable",
    "axis.*.jog-vel-mode",
    "joint.#.amp-fault-in",
    "joint.#.home-sw-in",
    "joint.#.index-enable",
    "joint.#.is-unlocked",
    "joint.#.jog-enable",
    "joint.#.jog-vel-mode",
    "joint.#.neg-lim-sw-in",
    "joint.#.pos-lim-sw-in",
    "spindle.#.amp-fault-in",
    "spindle.#.at-speed",
    "spindle.#.index-enable",
    "spindle.#.inhibit",
    "spindle.#.is-oriented",
];

pub fn look(subject: &Subject, findings: &mut Findings) {
    for (pin, setting) in &subject.state.settings {
        let value = setting.value.as_str();
        // What is a value of no type is told with the lines that halcmd refuses.
        if is_bit(value) || !is_value(value) || !BITS.contains(&form(pin).as_str()) {
            continue;
        }
        let found =
            format!("{pin} is a bit, and halcmd refuses {value}: it takes 1, 0, TRUE and FALSE");
        let bit = u8::from(number(value) != Some(0.0));
        findings.error(
            &setting.statement.place,
            found,
            replace(format!("setp {pin} {bit}")),
        );
    }
}

/// A pin with `#` for its numbers and `*` for the letters that stand alone.
fn form(pin: &str) -> String {
    let parts = pin.split('.').map(|part| match part.as_bytes() {
        [letter] if letter.is_ascii_lowercase() => "*".to_owned(),
        _ => {
            let name = part.trim_end_matches(|c: char| c.is_ascii_digit());
            let number = if name.len() < part.len() { "#" } else { "" };
            format!("{name}{number}")
        }
    });
    parts.collect::<Vec<_>>().join(".")
}
