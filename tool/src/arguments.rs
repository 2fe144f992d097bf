//! What the commands share in reading their arguments.

use std::path::Path;

/// A number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("a number above 0 is needed".to_owned()),
    }
}

/// A speed, an acceleration or a jerk that machines may have, in their units: the planner counts with its square and cube.
pub(crate) fn rate(text: &str) -> Result<f64, String> {
    match positive(text)? {
        number if (1e-3..=1e9).contains(&number) => Ok(number),
        _ => Err("a number from 0.001 to 1e9 is needed".to_owned()),
    }
}

/// A number from 0 up.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err("a number from 0 up is needed".to_owned()),
    }
}

/// A servo period, s.
#[cfg(feature = "linuxcnc")]
pub(crate) fn period(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (1e-5..=0.1).contains(&number) => Ok(number),
        _ => Err("seconds from 0.00001 to 0.1 are needed".to_owned()),
    }
}

/// What the output calls a file: the last part of its path.
pub(crate) fn file_name(file: &Path) -> String {
    file.file_name().map_or_else(
        || file.display().to_string(),
        |name| name.to_string_lossy().into_owned(),
    )
}
