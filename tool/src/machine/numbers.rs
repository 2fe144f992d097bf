//! How LinuxCNC reads the numbers of its INI file.
//!
//! What its task controller reads has to be a number and nothing else: behind a decimal comma or a comment in the same line
//! LinuxCNC does not start, or never switches on. The same holds for jerk, which HAL files hand to blendtp: comments get into
//! their lines. Periods go to modules, which read whole numbers alone.

use super::ini::Entry;

/// What stands in the place of a number has to be like this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A number alone.
    Number,
    /// A whole number alone.
    Whole,
    /// A whole number alone, as modules read it: 0x.. as well.
    OfModule,
    /// Others read it: a number, which may have a comment behind it.
    Other,
}

/// The keys under `[JOINT_n]`.
const OF_JOINTS: [&str; 13] = [
    "BACKLASH",
    "FERROR",
    "HOME",
    "HOME_FINAL_VEL",
    "HOME_LATCH_VEL",
    "HOME_OFFSET",
    "HOME_SEARCH_VEL",
    "MAX_ACCELERATION",
    "MAX_JERK",
    "MAX_LIMIT",
    "MAX_VELOCITY",
    "MIN_FERROR",
    "MIN_LIMIT",
];

/// Those under `[AXIS_L]`.
const OF_AXES: [&str; 6] = [
    "MAX_ACCELERATION",
    "MAX_JERK",
    "MAX_LIMIT",
    "MAX_VELOCITY",
    "MIN_LIMIT",
    "OFFSET_AV_RATIO",
];

/// Those under `[TRAJ]`.
const OF_PATH: [&str; 10] = [
    "ARC_BLEND_ENABLE",
    "ARC_BLEND_FALLBACK_ENABLE",
    "ARC_BLEND_GAP_CYCLES",
    "ARC_BLEND_KINK_RATIO",
    "ARC_BLEND_OPTIMIZATION_DEPTH",
    "ARC_BLEND_RAMP_FREQ",
    "DEFAULT_LINEAR_ACCELERATION",
    "DEFAULT_LINEAR_VELOCITY",
    "MAX_LINEAR_ACCELERATION",
    "MAX_LINEAR_VELOCITY",
];

/// How LinuxCNC reads the number of a key.
pub fn form(section: &str, key: &str) -> Form {
    let is_alone = match (section, section.rsplit_once('_')) {
        ("DISPLAY", _) => key == "MAX_FEED_OVERRIDE",
        ("TRAJ", _) => OF_PATH.contains(&key),
        (_, Some(("JOINT", _))) => OF_JOINTS.contains(&key),
        (_, Some(("AXIS", _))) => OF_AXES.contains(&key),
        _ => false,
    };
    match (section, key) {
        _ if is_alone => Form::Number,
        ("KINS", "JOINTS") | ("TRAJ", "SPINDLES") => Form::Whole,
        ("EMCMOT", "SERVO_PERIOD" | "BASE_PERIOD") => Form::OfModule,
        (_, "HOME_SEQUENCE") if section.starts_with("JOINT_") => Form::Whole,
        (_, "LOCKING_INDEXER_JOINT") if section.starts_with("AXIS_") => Form::Whole,
        _ => Form::Other,
    }
}

/// The number of a key as LinuxCNC reads it, which may be infinite or none; `None`: what is there is no number to it.
pub fn number(entry: &Entry) -> Option<f64> {
    let text = entry.raw.as_str();
    match form(&entry.section, &entry.key) {
        Form::Number => decimal(text),
        Form::Whole => text.parse::<i32>().ok().map(f64::from),
        Form::OfModule => whole_of_module(text).map(|whole| whole as f64),
        Form::Other => decimal(&entry.value),
    }
}

/// A number with decimals. Infinity is a word: digits that mean a greater number than there is are none to LinuxCNC.
fn decimal(text: &str) -> Option<f64> {
    let number: f64 = text.parse().ok()?;
    let has_digits = text.contains(|character: char| character.is_ascii_digit());
    (number.is_finite() || !has_digits).then_some(number)
}

/// A whole number as RTAPI reads it.
pub fn whole_of_module(text: &str) -> Option<i64> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let hexadecimal = digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"));
    let (digits, radix) = match hexadecimal {
        Some(digits) => (digits, 16),
        None => (digits, 10),
    };
    let is_signed_twice = digits.starts_with(['+', '-']);
    let whole = i64::from_str_radix(digits, radix).ok();
    whole.filter(|_| !is_signed_twice).map(|whole| sign * whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::ini::Ini;
    use std::path::Path;

    fn read(section: &str, key: &str, value: &str) -> Option<f64> {
        let text = format!("[{section}]\n{key} = {value}\n");
        let ini = Ini::parse(Path::new("mill.ini"), &text).expect("a file");
        number(ini.entry(section, key).expect("the key"))
    }

    /// As the functions of liblinuxcncini answer.
    #[test]
    fn the_task_controller_reads_a_number_alone() {
        let of_axis = |value| read("AXIS_X", "MAX_VELOCITY", value);
        for (value, expected) in [
            ("50", 50.0),
            ("+50 \t", 50.0),
            (".5", 0.5),
            ("5.", 5.0),
            ("1e6", 1e6),
            ("-inf", f64::NEG_INFINITY),
            ("INF", f64::INFINITY),
            ("010", 10.0),
        ] {
            assert_eq!(of_axis(value), Some(expected), "{value}");
        }
        for value in [
            "50 # c", "50,5", "50;c", "50 60", "0x10", "\"5\"", "TRUE", "1e400",
        ] {
            assert_eq!(of_axis(value), None, "{value}");
        }
        for (value, expected) in [
            ("3", Some(3.0)),
            ("+3", Some(3.0)),
            ("3.0", None),
            ("1e1", None),
            ("3 # c", None),
        ] {
            assert_eq!(read("KINS", "JOINTS", value), expected, "{value}");
        }
    }

    #[test]
    fn modules_and_others_read_otherwise() {
        let period = |value| read("EMCMOT", "SERVO_PERIOD", value);
        assert_eq!(period("1000000"), Some(1e6));
        assert_eq!(period("0xF4240"), Some(1e6));
        for value in ["1e6", "1000000 # ns", "1000000.0", "--1", "+", "0x", ""] {
            assert_eq!(period(value), None, "{value}");
        }
        let output = |value| read("FRAMEPATH", "ANALOG_OUTPUT", value);
        assert_eq!(output("4 # c"), Some(4.0));
        assert_eq!(output("4,5"), None);
        assert_eq!(output("-1e400"), None);
    }
}
