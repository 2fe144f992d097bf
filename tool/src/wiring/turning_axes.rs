//! Which axes turn the tool behind framekins before the kinematics of another module, and how far they go: what `o<tool_normal>`
//! keeps to.

use super::framekins::{TablePin, range_pin};
use super::subject::Subject;
use framepath::kinematics::ToolAxes;

/// The module, the letters of its joints where `coordinates=` does not say others, the axis that carries the tool and the one that
/// carries that one, seen from the workpiece: what framekins finds out by asking it.
const TURNING: [(&str, &str, char, char); 5] = [
    ("5axiskins", "XYZBCW", 'B', 'C'),
    ("maxkins", "XYZBC", 'B', 'C'),
    ("xyzab_tdr_kins", "XYZAB", 'B', 'A'),
    ("xyzac-trt-kins", "XYZAC", 'A', 'C'),
    ("xyzbc-trt-kins", "XYZBC", 'B', 'C'),
];

/// What has to be set before this module, as far as it is known which axes turn the tool and the INI file has limits of them.
pub fn range_pins(subject: &Subject, module: &str) -> Vec<TablePin> {
    let known = TURNING.iter().find(|(name, ..)| *name == module);
    let axes = match known {
        Some((_, _, tilt, rotary)) => vec![("tilt", *tilt), ("rotary", *rotary)],
        None => said(subject),
    };
    let loaded = subject.state.module(module);
    let given = loaded.and_then(|module| module.parameter("coordinates"));
    let joints = given.or(known.map(|(_, letters, ..)| *letters));
    let joints = joints.unwrap_or("").to_ascii_uppercase();
    let ends = axes.into_iter().flat_map(|(name, letter)| {
        let joint = joints.find(letter);
        ["MIN", "MAX"].map(|end| {
            let key = narrower(subject, letter, joint, end)?;
            Some(range_pin(name, end, key))
        })
    });
    ends.flatten().collect()
}

/// What `tool_axes=` says of an arm.
fn said(subject: &Subject) -> Vec<(&'static str, char)> {
    let framekins = subject.state.module("framekins");
    let text = framekins.and_then(|module| module.parameter("tool_axes"));
    let Some(ToolAxes::Turning(chain)) = ToolAxes::from_text(text.unwrap_or("").as_bytes()) else {
        return Vec::new();
    };
    let letter = |number: usize| ['A', 'B', 'C'][number];
    let rotary = chain.rotary.map(|axis| ("rotary", letter(axis.letter)));
    let tilt = ("tilt", letter(chain.tilt.letter));
    std::iter::once(tilt).chain(rotary).collect()
}

/// LinuxCNC keeps to the limits of the axis and to those of its joint: the key of the end that comes first.
fn narrower(subject: &Subject, letter: char, joint: Option<usize>, end: &str) -> Option<String> {
    let key = format!("{end}_LIMIT");
    let sections = [
        joint.map(|joint| format!("JOINT_{joint}")),
        Some(format!("AXIS_{letter}")),
    ];
    let sign = if end == "MIN" { -1.0 } else { 1.0 };
    let limits = sections.into_iter().flatten().filter_map(|section| {
        let limit = sign * subject.number(&section, &key)?;
        Some((limit, format!("[{section}]{key}")))
    });
    // The first of equal ones: the joint.
    let nearest = limits.min_by(|(one, _), (other, _)| one.total_cmp(other));
    nearest.map(|(_, key)| key)
}
