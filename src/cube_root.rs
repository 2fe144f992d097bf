//! The cube root.
//!
//! Not that of the standard library: that one comes from the C library in the modules and from
//! Rust's own in the tool. Their last digits differ, which is enough for the nodes of a plan to lie
//! elsewhere, and a plan would no longer be what the machine does.

/// A third of a number's bits, plus this, is about its cube root: a third of its exponent (W. Kahan,
/// Computing a Real Cube Root, 1991).
const OFFSET: u64 = 0x2a9f_7893_0000_0000;

/// The cube root of `x`, within 4e-16 of its amount; of 0, infinities and what is not a number, the
/// same.
pub(crate) fn cube_root(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return x;
    }
    let size = x.abs();
    let mut root = f64::from_bits(size.to_bits() / 3 + OFFSET);
    // Each of Halley's steps makes three times as many digits right: 5 bits, 15, 45, all.
    for _ in 0..3 {
        let rest = size / (root * root) - root;
        root += root * rest / (2.0 * root + (rest + root));
    }
    root.copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_has_no_other_root_is_its_own() {
        for x in [0.0, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(cube_root(x), x);
        }
        assert!(cube_root(f64::NAN).is_nan());
        for whole in 1..1000 {
            let whole = f64::from(whole);
            assert_eq!(cube_root(whole * whole * whole), whole);
        }
    }

    proptest! {
        #[test]
        fn it_is_that_of_the_standard_library(exponent in -250.0..250.0f64, sign in prop::bool::ANY) {
            let x = if sign { 10f64.powf(exponent) } else { -10f64.powf(exponent) };
            let expected = x.cbrt();
            prop_assert!((cube_root(x) - expected).abs() <= 4e-16 * expected.abs());
        }
    }
}
