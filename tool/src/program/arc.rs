//! Arcs in their plane: the centre from a radius, and the check that start and end lie on one circle.

/// What is wrong with an arc; lengths in machine units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArcError {
    /// The end is farther from the start than the diameter.
    RadiusTooSmall {
        /// The programmed radius, positive.
        radius: f64,
        /// Half the distance from start to end.
        least: f64,
    },
    /// A radius does not say where a full circle has its centre.
    FullCircleByRadius,
    /// The start and the end are not equally far from the centre.
    RadiusMismatch {
        /// Distance from the centre to the start.
        start: f64,
        /// Distance from the centre to the end.
        end: f64,
    },
    /// The centre is the start.
    NoRadius,
}

/// How far a radius may be off, machine units: the larger of the absolute value and the share of the
/// radius (the control's circle end point monitoring, 0.01 mm and 0.1 %).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcTolerance {
    /// Machine units.
    pub absolute: f64,
    /// Share of the radius.
    pub relative: f64,
}

impl ArcTolerance {
    fn at(&self, radius: f64) -> f64 {
        self.absolute.max(self.relative * radius)
    }
}

/// Centre, relative to the start, of the arc to `chord` (the end relative to the start) with this
/// radius: negative for the arc of more than 180 degrees.
///
/// A chord that is longer than the diameter by no more than the tolerance gives a half circle.
pub fn centre_from_radius(
    chord: [f64; 2],
    radius: f64,
    clockwise: bool,
    tolerance: &ArcTolerance,
) -> Result<[f64; 2], ArcError> {
    let half = 0.5 * chord[0].hypot(chord[1]);
    if half == 0.0 {
        return Err(ArcError::FullCircleByRadius);
    }
    if half > radius.abs() + tolerance.at(radius.abs()) {
        return Err(ArcError::RadiusTooSmall {
            radius: radius.abs(),
            least: half,
        });
    }
    let height = (radius * radius - half * half).max(0.0).sqrt();
    // Counterclockwise arcs below 180 degrees have the centre on the left of the chord.
    let left = if clockwise == (radius < 0.0) {
        height
    } else {
        -height
    };
    let along = [chord[0] / (2.0 * half), chord[1] / (2.0 * half)];
    Ok([
        0.5 * chord[0] - left * along[1],
        0.5 * chord[1] + left * along[0],
    ])
}

/// Checks the centre of an arc, relative to the start, against its end, and moves it by the little
/// that makes both radii equal.
pub fn checked_centre(
    chord: [f64; 2],
    centre: [f64; 2],
    tolerance: &ArcTolerance,
) -> Result<[f64; 2], ArcError> {
    let start = centre[0].hypot(centre[1]);
    let end = (chord[0] - centre[0]).hypot(chord[1] - centre[1]);
    if start == 0.0 {
        return Err(ArcError::NoRadius);
    }
    if (start - end).abs() > tolerance.at(start) {
        return Err(ArcError::RadiusMismatch { start, end });
    }
    let squared = chord[0] * chord[0] + chord[1] * chord[1];
    if squared == 0.0 {
        return Ok(centre);
    }
    // Onto the perpendicular bisector of the chord. For a chord much shorter than the radius error
    // times the radius (a circle that closes badly) that would be a large step: leave those.
    let surplus = (0.5 * squared - (centre[0] * chord[0] + centre[1] * chord[1])) / squared;
    let step = [surplus * chord[0], surplus * chord[1]];
    if step[0].hypot(step[1]) > tolerance.at(start) {
        return Ok(centre);
    }
    Ok([centre[0] + step[0], centre[1] + step[1]])
}

/// The angle of an arc in radians, above 0 and at most one turn, plus the extra turns. `start` and
/// `end` are relative to the centre, along the first and the second axis of the plane.
pub fn sweep(start: [f64; 2], end: [f64; 2], clockwise: bool, extra_turns: u32) -> f64 {
    const TURN: f64 = std::f64::consts::TAU;
    // A circle that closes is one whole turn, and rounding must not make it none.
    const SAME_DIRECTION: f64 = 1e-10;
    let cross = start[0] * end[1] - start[1] * end[0];
    let dot = start[0] * end[0] + start[1] * end[1];
    let mut angle = cross.atan2(dot);
    if clockwise {
        angle = -angle;
    }
    if angle <= SAME_DIRECTION {
        angle += TURN;
    }
    angle.min(TURN) + TURN * f64::from(extra_turns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    const TOLERANCE: ArcTolerance = ArcTolerance {
        absolute: 0.01,
        relative: 0.0,
    };

    #[test]
    fn the_centre_of_a_quarter_turn_is_on_the_side_of_the_direction() {
        let ccw = centre_from_radius([10.0, 10.0], 10.0, false, &TOLERANCE).unwrap();
        assert!((ccw[0]).abs() < 1e-12 && (ccw[1] - 10.0).abs() < 1e-12);
        let cw = centre_from_radius([10.0, 10.0], 10.0, true, &TOLERANCE).unwrap();
        assert!((cw[0] - 10.0).abs() < 1e-12 && cw[1].abs() < 1e-12);
        let long = centre_from_radius([10.0, 10.0], -10.0, false, &TOLERANCE).unwrap();
        assert!((long[0] - 10.0).abs() < 1e-12 && long[1].abs() < 1e-12);
    }

    #[test]
    fn a_chord_longer_than_the_diameter_is_an_error() {
        assert_eq!(
            centre_from_radius([30.0, 0.0], 10.0, false, &TOLERANCE),
            Err(ArcError::RadiusTooSmall {
                radius: 10.0,
                least: 15.0
            })
        );
        let half = centre_from_radius([20.01, 0.0], 10.0, false, &TOLERANCE).unwrap();
        assert!((half[0] - 10.005).abs() < 1e-12 && half[1] == 0.0);
    }

    #[test]
    fn a_radius_that_is_off_is_an_error_and_a_small_one_is_put_right() {
        assert!(matches!(
            checked_centre([10.0, 0.0], [4.0, 0.0], &TOLERANCE),
            Err(ArcError::RadiusMismatch { .. })
        ));
        let centre = checked_centre([10.0, 0.0], [5.004, 1.0], &TOLERANCE).unwrap();
        assert!((centre[0] - 5.0).abs() < 1e-12 && centre[1] == 1.0);
    }

    #[test]
    fn sweeps_follow_the_direction() {
        let (east, north) = ([1.0, 0.0], [0.0, 1.0]);
        assert!((sweep(east, north, false, 0) - FRAC_PI_2).abs() < 1e-12);
        assert!((sweep(east, north, true, 0) - 1.5 * PI).abs() < 1e-12);
        assert_eq!(sweep(east, east, true, 0), TAU);
        assert_eq!(sweep(east, east, false, 2), 3.0 * TAU);
    }
}
