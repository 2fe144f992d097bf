//! Values of pins, parameters and signals, as `halcmd` takes them.

/// Whether it takes a word for a bit.
pub fn is_bit(word: &str) -> bool {
    let words = ["0", "1", "TRUE", "FALSE"];
    words.iter().any(|known| word.eq_ignore_ascii_case(known))
}

/// Whether there is a type of which a word is a value.
pub fn is_value(word: &str) -> bool {
    is_bit(word) || is_number(word)
}

/// As the C library reads them.
fn is_number(word: &str) -> bool {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    match digits.get(..2) {
        Some("0x" | "0X") => {
            let is_of_number = |c: char| c.is_ascii_hexdigit() || ".pP+-".contains(c);
            digits.len() > 2 && digits.chars().skip(2).all(is_of_number)
        }
        _ => word.parse::<f64>().is_ok(),
    }
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
        for word in ["", "yes", "on", "5,5", "5x", "0x", "1 2", "true."] {
            assert!(!is_value(word), "{word}");
        }
    }
}
