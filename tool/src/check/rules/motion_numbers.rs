//! What motmod is loaded with: whole numbers, or LinuxCNC does not start.

use crate::check::finding::{Findings, advice};
use crate::wiring::subject::Subject;

/// Its parameters that are numbers, with the keys of the INI file that HAL files take them from.
const NUMBERS: [(&str, &str, &str); 6] = [
    ("num_joints", "KINS", "JOINTS"),
    ("servo_period_nsec", "EMCMOT", "SERVO_PERIOD"),
    ("base_period_nsec", "EMCMOT", "BASE_PERIOD"),
    ("num_spindles", "TRAJ", "SPINDLES"),
    ("num_dio", "EMCMOT", "NUM_DIO"),
    ("num_aio", "EMCMOT", "NUM_AIO"),
];

pub fn look(subject: &Subject, findings: &mut Findings) {
    let Some(module) = subject.motion() else {
        return;
    };
    for (name, section, key) in NUMBERS {
        let value = module.parameter(name).unwrap_or("0");
        let word = value.split_whitespace().next().unwrap_or("");
        if is_whole(word) {
            continue;
        }
        let entry = format!("[{section}]{key}");
        let (place, named) = match module.statement.text.contains(&entry) {
            true => (subject.place_of(section, key), entry),
            false => (module.statement.place.clone(), name.to_owned()),
        };
        let found = format!("LinuxCNC does not start: {named} = {value} is no whole number");
        findings.error(&place, found, advice("a whole number, without a point"));
    }
}

/// As RTAPI reads it.
fn is_whole(word: &str) -> bool {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    match digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"))
    {
        Some(digits) => i64::from_str_radix(digits, 16).is_ok(),
        None => !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()),
    }
}
