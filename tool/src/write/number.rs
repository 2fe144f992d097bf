//! Numbers as G-code words have them.

/// Decimals of coordinates: a nanometre where the unit is the millimetre.
const COORDINATE_DECIMALS: usize = 6;

/// Decimals of angles, factors and everything that coordinates are multiplied with.
const FACTOR_DECIMALS: usize = 10;

/// Numbers below this can be counted in units of the last decimal of a coordinate, and the count is
/// exact in a double: it has 15 digits.
const COUNTED: f64 = 1e9;

/// A length, a feed, a speed.
pub fn coordinate(value: f64) -> String {
    let mut text = String::new();
    push_coordinate(&mut text, value);
    text
}

/// Appends a length, a feed or a speed.
pub fn push_coordinate(text: &mut String, value: f64) {
    const UNIT: u64 = 10_u64.pow(COORDINATE_DECIMALS as u32);
    if value.abs() >= COUNTED || value.is_nan() {
        text.push_str(&trimmed(value, COORDINATE_DECIMALS));
        return;
    }
    let count = (value.abs() * UNIT as f64).round() as u64;
    if value < 0.0 && count > 0 {
        text.push('-');
    }
    let mut digits = itoa::Buffer::new();
    text.push_str(digits.format(count / UNIT));
    let mut decimals = count % UNIT;
    if decimals == 0 {
        return;
    }
    let mut places = COORDINATE_DECIMALS;
    while decimals.is_multiple_of(10) {
        decimals /= 10;
        places -= 1;
    }
    let digits = digits.format(decimals);
    text.push('.');
    for _ in digits.len()..places {
        text.push('0');
    }
    text.push_str(digits);
}

/// Appends a whole number.
pub fn push_whole(text: &mut String, value: u32) {
    text.push_str(itoa::Buffer::new().format(value));
}

/// An angle or a factor.
pub fn factor(value: f64) -> String {
    trimmed(value, FACTOR_DECIMALS)
}

fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" | "" => "0".to_string(),
        text => text.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_was_written_with_few_decimals_is_written_again(count in -1e14..1e14_f64) {
            let value = count.trunc() / 1e6;
            prop_assert_eq!(coordinate(value), trimmed(value, COORDINATE_DECIMALS));
        }

        #[test]
        fn no_coordinate_is_off_by_more_than_half_of_the_last_decimal(value in -1e8..1e8_f64) {
            let read: f64 = coordinate(value).parse().unwrap();
            prop_assert!((read - value).abs() <= 0.500_000_1e-6 + 1e-15 * value.abs());
        }
    }

    #[test]
    fn no_needless_zeros_and_no_minus_zero() {
        assert_eq!(coordinate(10.0), "10");
        assert_eq!(coordinate(-0.5), "-0.5");
        assert_eq!(coordinate(-1e-9), "0");
        assert_eq!(coordinate(100.0), "100");
        assert_eq!(coordinate(1.0 / 3.0), "0.333333");
        assert_eq!(factor(1.0 / 3.0), "0.3333333333");
    }
}
