//! What motmod is loaded with: whole numbers, or LinuxCNC does not start.

use crate::check::finding::{Findings, advice};
use crate::machine::numbers::whole_of_module;
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
        let forms = [format!("[{section}]{key}"), format!("[{section}]({key})")];
        let is_named = forms
            .iter()
            .any(|form| module.statement.text.contains(form));
        // With the comment behind it, which gets into the line.
        let entry = subject.ini.entry(section, key).filter(|_| is_named);
        let (place, named, value) = match entry {
            Some(entry) => (&entry.place, forms[0].as_str(), entry.raw.as_str()),
            None => {
                let value = module.parameter(name).unwrap_or("0");
                (&module.statement.place, name, value)
            }
        };
        if whole_of_module(value).is_some() {
            continue;
        }
        let found = format!("LinuxCNC does not start: {named} = {value} is no whole number");
        let remedy = "a whole number alone, without a point, and a comment in a line of its own";
        findings.error(place, found, advice(remedy));
    }
}
