//! Section `[FRAMEPATH]` of the INI file: its keys and what may be written.

use super::framekins::{MOST_OUTPUTS, OUTPUTS};
use std::ops::RangeInclusive;

/// The section.
pub const SECTION: &str = "FRAMEPATH";

/// Tolerances that can be set, mm.
pub const TOLERANCES: RangeInclusive<f64> = 0.001..=10.0;

/// Places of an axis that can be set, mm.
pub const PLACES: RangeInclusive<f64> = -100_000.0..=100_000.0;

/// A key.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// What is taken where it is not set; `None`: nothing.
    pub usual: Option<&'static str>,
    /// What may be written.
    pub possible: &'static str,
    is_possible: fn(&str) -> bool,
}

impl Key {
    /// Whether this may be written.
    pub fn takes(&self, value: &str) -> bool {
        (self.is_possible)(value)
    }
}

fn switch(text: &str) -> bool {
    matches!(text, "0" | "1")
}

fn one_of(text: &str, words: [&str; 2]) -> bool {
    words.iter().any(|word| text.eq_ignore_ascii_case(word))
}

fn number(text: &str, range: &RangeInclusive<f64>) -> bool {
    text.parse().is_ok_and(|value| range.contains(&value))
}

/// The first of so many outputs.
fn output(text: &str, width: u32) -> bool {
    text.parse::<u32>()
        .is_ok_and(|first| first <= MOST_OUTPUTS - width)
}

const SWITCH: Key = Key {
    name: "",
    usual: Some("1"),
    possible: "0 or 1",
    is_possible: switch,
};

/// All keys.
pub const KEYS: [Key; 9] = [
    Key {
        name: "CLEAR_AT_START",
        ..SWITCH
    },
    Key {
        name: "CLEAR_AT_END",
        ..SWITCH
    },
    Key {
        name: "CLEAR_ON_ABORT",
        ..SWITCH
    },
    Key {
        name: "TOOL_LENGTH",
        usual: Some("frame"),
        possible: "frame or machine",
        is_possible: |text| one_of(text, ["frame", "machine"]),
    },
    Key {
        name: "ROTS_CONVENTION",
        usual: Some("seed"),
        possible: "seed or k2",
        is_possible: |text| one_of(text, ["seed", "k2"]),
    },
    Key {
        name: "TOLERANCE",
        usual: Some("0.01"),
        possible: "a tolerance from 0.001 to 10 mm",
        is_possible: |text| number(text, &TOLERANCES),
    },
    Key {
        name: "RETRACT_Z",
        usual: None,
        possible: "a place of the machine in mm",
        is_possible: |text| number(text, &PLACES),
    },
    Key {
        name: "ANALOG_OUTPUT",
        usual: Some("0"),
        possible: "a whole number from 0 to 55",
        is_possible: |text| output(text, OUTPUTS),
    },
    // Without it USUAL_TYPE_OUTPUT, and only G43.4 behind inner= looks at it.
    Key {
        name: "TYPE_OUTPUT",
        usual: None,
        possible: "a whole number from 0 to 63",
        is_possible: |text| output(text, 1),
    },
];

/// The key of this name.
pub fn key(name: &str) -> Option<Key> {
    KEYS.into_iter().find(|key| key.name == name)
}
