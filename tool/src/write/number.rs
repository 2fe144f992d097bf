//! Numbers as G-code words have them.

/// Decimals of coordinates: a nanometre where the unit is the millimetre.
const COORDINATE_DECIMALS: usize = 6;

/// Decimals of angles, factors and everything that coordinates are multiplied with.
const FACTOR_DECIMALS: usize = 10;

/// A length, a feed, a speed.
pub fn coordinate(value: f64) -> String {
    trimmed(value, COORDINATE_DECIMALS)
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
