//! Values of pins, parameters and signals, as `halcmd` takes them.

/// Whether it takes a word for a bit.
pub fn is_bit(word: &str) -> bool {
    let words = ["0", "1", "TRUE", "FALSE"];
    words.iter().any(|known| word.eq_ignore_ascii_case(known))
}

/// Whether there is a type of which a word is a value.
pub fn is_value(word: &str) -> bool {
    is_bit(word) || number(word).is_some()
}

/// The number that a word is, as the C library reads it; `None` if it is none.
pub fn number(word: &str) -> Option<f64> {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    match digits.strip_prefix("0x").or(digits.strip_prefix("0X")) {
        Some(digits) if word.starts_with('-') => Some(-hexadecimal(digits)?),
        Some(digits) => hexadecimal(digits),
        None => word.parse().ok(),
    }
}

/// Hexadecimal digits, and behind `p` the exponent of two.
fn hexadecimal(digits: &str) -> Option<f64> {
    let (mantissa, exponent) = digits.split_once(['p', 'P']).unwrap_or((digits, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let mut digits = whole.chars().chain(fraction.chars()).peekable();
    digits.peek()?;
    let value = digits.try_fold(0.0, |value, digit| {
        Some(value * 16.0 + f64::from(digit.to_digit(16)?))
    })?;
    let exponent: i32 = exponent.parse().ok()?;
    Some(value * 2f64.powi(exponent.saturating_sub(4 * fraction.len() as i32)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_halcmd_takes_is_a_value() {
        for word in ["0", "1", "true", "FALSE"] {
            assert!(is_bit(word) && is_value(word), "{word}");
        }
        let numbers = [
            "2", "1.0", "-.5", "+1e-3", "010", "0x1F", "-0X1p3", "inf", "nan",
        ];
        for word in numbers {
            assert!(!is_bit(word) && is_value(word), "{word}");
        }
        for (word, value) in [("0x4e20", 20000.0), ("-0X1.8p3", -12.0), ("010", 10.0)] {
            assert_eq!(number(word), Some(value), "{word}");
        }
        for word in ["", "yes", "on", "5,5", "5x", "0x", "0x1g", "1 2", "true."] {
            assert!(!is_value(word), "{word}");
        }
    }
}
