//! The unit of lengths, `[TRAJ]LINEAR_UNITS`: the millimetre or the inch.

use super::error::IniError;
use super::ini::Ini;

/// Millimetres in an inch.
pub const INCH: f64 = 25.4;

/// What is wrong with another one.
pub const PROBLEM: &str = "mm or inch are understood here";

/// The unit that this text means, `mm` or `in`.
pub fn meant(text: &str) -> Option<&'static str> {
    // LinuxCNC 2.9 also takes how many units a millimetre has.
    let is_near = |units: f64| {
        text.parse::<f64>()
            .is_ok_and(|number| (number / units - 1.0).abs() < 1e-3)
    };
    match text.to_ascii_lowercase().as_str() {
        "mm" | "metric" => Some("mm"),
        "in" | "inch" | "imperial" => Some("in"),
        _ if is_near(1.0) => Some("mm"),
        _ if is_near(1.0 / INCH) => Some("in"),
        _ => None,
    }
}

/// The unit of a machine, `mm` or `in`.
///
/// # Errors
/// Another one, or none, with the remedy.
pub fn needed(ini: &Ini) -> Result<&'static str, IniError> {
    let text = ini.required_text(
        "TRAJ",
        "LINEAR_UNITS",
        "write LINEAR_UNITS = mm (or inch); without it no number of the report has a unit",
    )?;
    meant(text).ok_or_else(|| ini.bad_value("TRAJ", "LINEAR_UNITS", PROBLEM))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_numbers_mean_a_unit() {
        for text in ["mm", "Metric", "1", "1.0"] {
            assert_eq!(meant(text), Some("mm"), "{text}");
        }
        for text in ["in", "INCH", "imperial", ".03937", "0.0393700787"] {
            assert_eq!(meant(text), Some("in"), "{text}");
        }
        for text in ["", "cm", "1/25.4", "2.0", "0", "nan"] {
            assert_eq!(meant(text), None, "{text}");
        }
    }
}
