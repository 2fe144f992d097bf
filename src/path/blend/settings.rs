//! What the shape of blends depends on, besides the program.

/// Blends are made for this jerk at most, although it may be unlimited; mm/s^3.
const GREATEST_JERK: f64 = 100_000.0;

/// What kernels are widened to at most where the tolerance leaves it open, mm.
const GREATEST_DESIGN_WIDTH: f64 = 8.0;

/// And at least, mm.
const LEAST_DESIGN_WIDTH: f64 = 0.001;

/// The tolerance of G64 without P is the length of the move over 20, within these, mm.
const DEFAULT_TOLERANCE: (f64, f64) = (0.05, 0.5);

/// A tolerance below this is met by following the path exactly, mm.
const LEAST_TOLERANCE: f64 = 1e-5;

/// What the shape of blends depends on, besides the program. The overrides of the operator are not
/// among it: they never change a path.
#[derive(Clone, Copy, Debug)]
pub struct BlendSettings {
    millimetre: f64,
    rotary_weight: f64,
    jerk: f64,
}

impl BlendSettings {
    /// A machine in millimetres: 0.1 mm counts as much as a degree, the jerk is not limited.
    pub const DEFAULT: Self = Self {
        millimetre: 1.0,
        rotary_weight: 0.1,
        jerk: GREATEST_JERK,
    };

    /// `millimetre`: its length in machine units (1, or 1/25.4). `rotary_weight`: how many machine
    /// units count as much as a degree of A B C, see the metric of the
    /// [blended path](super::BlendedPath). `jerk`: what the linear axes are able to do, machine
    /// units per second cubed; may be infinite.
    ///
    /// `None` if one is not positive, or one of the first two not finite.
    pub fn new(millimetre: f64, rotary_weight: f64, jerk: f64) -> Option<Self> {
        let sound = |value: f64| value > 0.0 && value.is_finite();
        (sound(millimetre) && sound(rotary_weight) && jerk > 0.0).then(|| Self {
            millimetre,
            rotary_weight,
            jerk: jerk.min(GREATEST_JERK * millimetre),
        })
    }

    pub(super) const fn rotary_weight(&self) -> f64 {
        self.rotary_weight
    }

    /// From this width on the kernels of dense code hardly limit a `speed` of so many machine units
    /// per second. Machine units.
    pub(super) fn design_width(&self, speed: f64) -> f64 {
        let (speed, jerk) = (speed / self.millimetre, self.jerk / self.millimetre);
        let width = 1.8 * (speed / 100.0) * (20_000.0 / jerk).cbrt();
        self.millimetre * width.clamp(LEAST_DESIGN_WIDTH, GREATEST_DESIGN_WIDTH)
    }

    /// What a width is never raised above for the sake of speed, machine units.
    pub(super) fn greatest_design_width(&self) -> f64 {
        GREATEST_DESIGN_WIDTH * self.millimetre
    }

    /// The width at which a corner that turns the direction by `turn` (length of the difference of
    /// unit vectors) is run through at `speed` within the jerk, machine units.
    pub(super) fn full_speed_width(&self, turn: f64, speed: f64) -> f64 {
        // The third derivative of the rounded corner is about 1.44 turn / w^2, and three times as
        // much is left free for changes of the speed.
        (4.3 * turn * speed * speed * speed / self.jerk).sqrt()
    }

    /// The width at which a jump of the curvature by `jump`, 1 per machine unit, is run through at
    /// `speed` within the jerk and as much again, machine units.
    pub(super) fn full_speed_easement(&self, jump: f64, speed: f64) -> f64 {
        2.0 * 1.152 * jump * speed * speed * speed / self.jerk
    }

    /// The tolerance of G64 for a move of this length. `given` is P, 0 where the program gave
    /// none. 0 if it is so small that the path is to be followed exactly. Machine units.
    pub(super) fn tolerance(&self, given: f64, length: f64) -> f64 {
        let (least, greatest) = DEFAULT_TOLERANCE;
        if given > LEAST_TOLERANCE * self.millimetre {
            given
        } else if given > 0.0 {
            0.0
        } else {
            // Not `clamp`, which panics if the limits are in the wrong order.
            (length / 20.0)
                .max(least * self.millimetre)
                .min(greatest * self.millimetre)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_sound_settings() {
        assert!(BlendSettings::new(1.0, 0.1, f64::INFINITY).is_some());
        for (millimetre, weight, jerk) in [
            (0.0, 0.1, 1.0),
            (1.0, 0.0, 1.0),
            (1.0, f64::NAN, 1.0),
            (f64::INFINITY, 0.1, 1.0),
            (1.0, 0.1, 0.0),
        ] {
            assert!(BlendSettings::new(millimetre, weight, jerk).is_none());
        }
    }

    #[test]
    fn the_same_blends_in_inches() {
        let metric = BlendSettings::new(1.0, 0.1, 30_000.0).expect("sound");
        let imperial = BlendSettings::new(1.0 / 25.4, 0.1, 30_000.0 / 25.4).expect("sound");
        let close = |mm: f64, inch: f64| assert!((mm - 25.4 * inch).abs() < 1e-12 * mm);
        close(
            metric.design_width(50.0),
            imperial.design_width(50.0 / 25.4),
        );
        close(
            metric.full_speed_width(0.3, 50.0),
            imperial.full_speed_width(0.3, 50.0 / 25.4),
        );
        close(
            metric.full_speed_easement(0.3, 50.0),
            imperial.full_speed_easement(0.3 * 25.4, 50.0 / 25.4),
        );
        close(
            metric.tolerance(0.0, 5.0),
            imperial.tolerance(0.0, 5.0 / 25.4),
        );
    }

    #[test]
    fn tolerances() {
        let settings = BlendSettings::new(1.0, 0.1, 1e4).expect("sound");
        assert_eq!(settings.tolerance(0.3, 5.0), 0.3);
        assert_eq!(settings.tolerance(0.0, 5.0), 0.25);
        assert_eq!(settings.tolerance(0.0, 0.01), 0.05);
        assert_eq!(settings.tolerance(0.0, 1000.0), 0.5);
        assert_eq!(settings.tolerance(1e-9, 5.0), 0.0);
    }
}
