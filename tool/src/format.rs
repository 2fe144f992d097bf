//! Numbers as people read them.

use crate::path::rates::Quantity;
#[cfg(feature = "linuxcnc")]
use indicatif::HumanDuration;
#[cfg(feature = "linuxcnc")]
use std::time::Duration;

/// From here on a number is shown in scientific notation: nobody counts its zeros.
const SCIENTIFIC_FROM: f64 = 1e15;

/// A number with so many significant digits, below [`SCIENTIFIC_FROM`] never in scientific notation.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    if value.abs() >= SCIENTIFIC_FROM {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", without_zeros(digits));
    }
    let magnitude = value.abs().log10().floor() as i64 + 1;
    let decimals = (digits as i64 - magnitude).clamp(0, 12) as usize;
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// Without zeros behind the last decimal.
fn without_zeros(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent.abs() < SCIENTIFIC_FROM {
        true => format!("{percent:.1} %"),
        false => format!("{} %", significant(percent, 4)),
    }
}

/// Below this a number in a column is shown as 0: it would need more room than the column has.
const SHOWN_IN_COLUMN: f64 = 1e-6;

/// The same for a column of a table: what is 0 but for rounding is 0.
pub fn in_column(value: f64, digits: usize) -> String {
    match value.abs() < SHOWN_IN_COLUMN {
        true => "0".to_owned(),
        false => significant(value, digits),
    }
}

/// A number with so many decimals; what they show as 0 has no sign. Of plan, which wants LinuxCNC's interpreter.
#[cfg(any(test, feature = "linuxcnc"))]
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|byte| matches!(byte, b'0' | b'.')) => size.to_owned(),
        _ => text,
    }
}

/// How long the rest of some work will take by what is done of it, in words behind others; nothing as long as nothing is done, and in
/// the last second, as which a loop in the last lines of a program would count.
#[cfg(feature = "linuxcnc")]
pub fn time_left(elapsed: Duration, done: u64, all: u64) -> String {
    let seconds = elapsed.as_secs_f64() * all.saturating_sub(done) as f64 / done as f64;
    match Duration::try_from_secs_f64(seconds) {
        Ok(left) if left.as_secs() > 0 => format!(", {:#} left", HumanDuration(left)),
        _ => String::new(),
    }
}

/// The greatest speed along a path, in units of length per second and per minute, and where it is.
pub fn greatest_speed(value: f64, length_unit: &str, time: f64, line: i64) -> String {
    format!(
        "{} {length_unit}/s ({} {length_unit}/min) at {time:.3} s, line {line}",
        significant(value, 5),
        significant(value * 60.0, 5)
    )
}

/// A length with its unit: small ones in micrometres (um) or nanometres (nm), inches as they are.
pub fn length(value: f64, unit: &str) -> String {
    let size = value.abs();
    if size >= SCIENTIFIC_FROM {
        return format!("{} {unit}", significant(value, 6));
    }
    if unit != "mm" {
        return format!("{value:.6} {unit}");
    }
    if size >= 0.1 {
        format!("{value:.3} mm")
    } else if size >= 1e-4 {
        format!("{:.2} um", value * 1e3)
    } else if size >= 1e-8 {
        format!("{:.2} nm", value * 1e6)
    } else {
        "0 um".to_owned()
    }
}

/// The unit of a quantity: `mm/s`, `mm/s2`, `mm/s3`.
pub fn unit(length_unit: &str, quantity: Quantity) -> String {
    match quantity {
        Quantity::Velocity => format!("{length_unit}/s"),
        Quantity::Acceleration => format!("{length_unit}/s2"),
        Quantity::Jerk => format!("{length_unit}/s3"),
    }
}

/// A peak above its limit: a sentence when it is displayed.
#[derive(Clone, Copy, Debug)]
pub struct Over<'a> {
    /// `joint.0` or `axis.x`.
    pub name: &'a str,
    /// What is too great.
    pub quantity: Quantity,
    /// How great it is.
    pub peak: f64,
    /// How great it may be, same units.
    pub limit: f64,
    /// Of a length: `mm`, `in` or `deg`.
    pub unit: &'a str,
    /// s.
    pub time: f64,
    /// Line of the program.
    pub line: i64,
}

impl std::fmt::Display for Over<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{}: {} is {} times its limit ({} of {} {}) at {:.3} s, line {}",
            self.name,
            self.quantity.name(),
            significant(self.peak / self.limit, 4),
            significant(self.peak, 6),
            significant(self.limit, 6),
            unit(self.unit, self.quantity),
            self.time,
            self.line
        )
    }
}

/// Groups of three digits: 1,234,567.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Minutes and seconds from one minute on, else seconds.
pub fn duration(seconds: f64) -> String {
    if seconds < 60.0 {
        return format!("{seconds:.3} s");
    }
    let minutes = (seconds / 60.0).floor();
    format!("{minutes:.0} min {:.1} s", seconds - 60.0 * minutes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(feature = "linuxcnc")]
    #[test]
    fn what_is_left_is_told_when_it_is_known() {
        let after = |done| time_left(Duration::from_secs(8), done, 100);
        assert_eq!(after(25), ", 24s left");
        assert_eq!(after(1), ", 13m left");
        assert_eq!((after(0), after(100), after(99)), Default::default());
    }

    #[test]
    fn numbers_are_readable() {
        assert_eq!(significant(19999.97, 6), "20000");
        assert_eq!(significant(0.00123456, 3), "0.00123");
        assert_eq!(significant(1234567.0, 3), "1234567");
        assert_eq!(significant(999e12, 3), "999000000000000");
        assert_eq!(significant(1e300, 6), "1e300");
        assert_eq!(significant(-1.23456e20, 4), "-1.235e20");
        assert_eq!(significant(f64::INFINITY, 4), "inf");
        assert_eq!(percent(0.12345), "12.3 %");
        assert_eq!(percent(1e298), "1e300 %");
        assert_eq!(percent(f64::INFINITY), "inf %");
        assert_eq!(length(1e300, "mm"), "1e300 mm");
        assert_eq!(length(f64::INFINITY, "in"), "inf in");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(significant(-0.0, 3), "0");
        assert_eq!(in_column(3.452e-9, 4), "0");
        assert_eq!(in_column(-0.001_234_56, 4), "-0.001235");
        assert_eq!(fixed(-0.000_04, 3), "0.000");
        assert_eq!(fixed(-0.0, 0), "0");
        assert_eq!(fixed(-0.6, 0), "-1");
        assert_eq!(fixed(-1.5, 2), "-1.50");
        assert_eq!(length(0.0049, "mm"), "4.90 um");
        assert_eq!(length(2.5e-7, "mm"), "0.25 nm");
        assert_eq!(length(12.0, "mm"), "12.000 mm");
        assert_eq!(length(1e-15, "mm"), "0 um");
        assert_eq!(length(0.0005, "in"), "0.000500 in");
        assert_eq!(grouped(1234567), "1,234,567");
        assert_eq!(grouped(12), "12");
        assert_eq!(duration(75.25), "1 min 15.2 s");
        assert_eq!(duration(7.5), "7.500 s");
    }
}
