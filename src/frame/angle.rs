//! Angles in degrees.

/// Up to here, degrees, the multiples of 90 are computed without rounding.
const EXACT_QUARTERS: f64 = 1e12;

/// Sine and cosine of an angle in degrees, exact at multiples of 90.
///
/// The angle is first reduced to the nearest quarter turn, which loses nothing: `ROT RPL=90` maps
/// an axis onto an axis and leaves no 1e-17 behind. Any finite angle.
#[inline]
pub fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    let angle = if angle.abs() < EXACT_QUARTERS {
        angle
    } else {
        part_of_turn(angle)
    };
    let quarters = (angle / 90.0).round();
    let (sin, cos) = (angle - quarters * 90.0).to_radians().sin_cos();
    // The conversion saturates, and the mask is right for negative numbers too. Subtracting from
    // zero makes no negative zero, which as a divisor would change the sign of an infinity.
    match (quarters as i64) & 3 {
        0 => (sin, cos),
        1 => (cos, 0.0 - sin),
        2 => (0.0 - sin, -cos),
        _ => (-cos, sin),
    }
}

/// What is left of an angle (degrees) without its whole turns, exactly, with its sign.
///
/// Long division by doubling and halving: at most a thousand steps for the greatest number there
/// is. The operator `%` would do, but the library function behind it has a panic path.
#[cold]
fn part_of_turn(angle: f64) -> f64 {
    let mut rest = angle.abs();
    let mut turns = 360.0;
    for _ in 0..f64::MAX_EXP {
        if rest < 2.0 * turns {
            break;
        }
        turns *= 2.0;
    }
    for _ in 0..=f64::MAX_EXP {
        // Exact: rest lies between turns and twice that (Sterbenz).
        if rest >= turns {
            rest -= turns;
        }
        if turns <= 360.0 {
            break;
        }
        turns *= 0.5;
    }
    rest.copysign(angle)
}

/// How many whole turns to add to `angle` (degrees) to come closest to `target`.
pub fn turns_towards(angle: f64, target: f64) -> f64 {
    ((target - angle) / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        for (angle, expected) in [
            (0.0, (0.0, 1.0)),
            (90.0, (1.0, 0.0)),
            (180.0, (0.0, -1.0)),
            (270.0, (-1.0, 0.0)),
            (-90.0, (-1.0, 0.0)),
            (-180.0, (0.0, -1.0)),
            (360_090.0, (1.0, 0.0)),
            (360e12 - 90.0, (-1.0, 0.0)),
        ] {
            let (sin, cos) = sin_cos_degrees(angle);
            assert_eq!((sin, cos), expected, "{angle}");
            let zero = if sin == 0.0 { sin } else { cos };
            assert!(zero.is_sign_positive(), "{angle}");
        }
    }

    #[test]
    fn other_angles_agree_with_the_standard_library() {
        for step in -3000..3000 {
            let angle = f64::from(step) * 0.37;
            let (sin, cos) = sin_cos_degrees(angle);
            let (expected_sin, expected_cos) = angle.to_radians().sin_cos();
            assert!((sin - expected_sin).abs() < 1e-14, "{angle}");
            assert!((cos - expected_cos).abs() < 1e-14, "{angle}");
        }
    }

    #[test]
    fn every_finite_angle_has_a_sine() {
        for angle in [f64::MAX, f64::MIN, 1e300, -1e15, f64::MIN_POSITIVE] {
            let (sin, cos) = sin_cos_degrees(angle);
            assert!((sin.hypot(cos) - 1.0).abs() < 1e-15, "{angle}");
        }
    }

    #[test]
    fn whole_turns_are_taken_off_exactly() {
        for angle in [
            f64::MAX,
            -1.2345e300,
            1e15,
            360.0,
            359.0,
            -720.5,
            1e12 + 0.125,
        ] {
            assert_eq!(part_of_turn(angle), angle % 360.0, "{angle}");
        }
        assert!(part_of_turn(f64::INFINITY).is_nan());
        assert!(part_of_turn(f64::NAN).is_nan());
    }

    #[test]
    fn turns_come_closest() {
        assert_eq!(turns_towards(10.0, 365.0), 1.0);
        assert_eq!(turns_towards(10.0, -300.0), -1.0);
        assert_eq!(turns_towards(350.0, 350.0), 0.0);
    }
}
