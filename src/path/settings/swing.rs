//! How far corners [swing out](super::super::lone_corner).

use super::super::kernel;
use super::{BlendSettings, GREATEST_JERK};
use crate::axes::Axes;
use crate::cube_root::cube_root;

/// A corner swings out over so many lengths of the shorter leg beside it at most: what it may reach stays open until the next
/// leg comes, or its shape would depend on when that is.
const LEGS_OF_A_SWING: f64 = 3.0;

/// And over so many widths of the widest kernel within the tolerance that limits the speed: wider ones gain little, and less of
/// the path is final.
const WIDTHS_OF_A_SWING: f64 = 3.0;

/// And over so much, mm.
const GREATEST_SWING: f64 = 30.0;

/// A corner limits the speed if its feed needs it so many times as wide.
const LIMITING: f64 = 1.05;

/// And over so many times what is run through at the speed that acceleration reaches, over the length of the tolerance, within the
/// time that jerk takes for that length.
const NATURAL_SWING: f64 = 38.0;

/// But so many widths of its biweight kernel at least.
pub(in crate::path) const LEAST_NATURAL_SWING: f64 = 6.0;

/// Halfway from its middle to its end a wide kernel of a width of 1 is so high, about.
const HALFWAY_OUT: f64 = 0.5;

impl BlendSettings {
    /// How far a corner beside a leg of this `length` swings out at most within `tolerance`, where it is run through at most at
    /// `speed`; machine units.
    pub(in crate::path) fn greatest_swing(&self, length: f64, tolerance: f64, speed: f64) -> f64 {
        if self.swings {
            let room = WIDTHS_OF_A_SWING * self.widest_limiting(tolerance, speed);
            (LEGS_OF_A_SWING * length)
                .min(room.max(self.greatest_design_width()))
                .min(GREATEST_SWING * self.millimetre)
        } else {
            0.0
        }
    }

    /// How far a corner swings out with gain: the farther the more `tolerance` it has. `tangent_jump`: jump of dp/ds, shape (9);
    /// `width`: of its biweight kernel; machine units. Fitted to measured times of two legs that turn by 15 to 165 degrees, P .005
    /// to 1.
    pub(in crate::path) fn natural_swing(
        &self,
        tangent_jump: &Axes,
        tolerance: f64,
        width: f64,
    ) -> f64 {
        let [per_acceleration, per_jerk] = self.slowness(tangent_jump);
        let speed = (tolerance / per_acceleration).sqrt();
        let natural = NATURAL_SWING * speed * cube_root(tolerance * per_jerk);
        natural.max(LEAST_NATURAL_SWING * width)
    }

    /// 1 over the share of its wide kernel with which a corner would hold up the machine on its legs, where axes are unlike: of
    /// legs on which it gathers speed, and, times the width of that kernel in machine units, of legs at the programmed speed.
    ///
    /// On a leg with an acceleration of A the machine has a speed of sqrt(A W) halfway out, where the wide kernel bends the path by
    /// its share times the jump over 2 W: across the leg, where the slower axis of the corner moves. `legs`: directions, shape (9),
    /// and speeds of both, machine units per second.
    pub(in crate::path) fn swing_limits(
        &self,
        tangent_jump: &Axes,
        legs: [(&Axes, f64); 2],
    ) -> [f64; 2] {
        let [per_acceleration, _] = self.slowness(tangent_jump);
        let bend = HALFWAY_OUT * tangent_jump.norm();
        let mut gathered: f64 = 0.0;
        let mut programmed: f64 = 0.0;
        for (direction, speed) in legs {
            gathered = gathered.max(self.times_as_slow(tangent_jump, direction));
            programmed = programmed.max(per_acceleration * speed * speed);
        }
        [bend * gathered, bend * programmed]
    }

    /// How many times as slow the axes of a corner with this jump of dp/ds are as those of a leg in this `direction`, by acceleration or
    /// by jerk; shape (9).
    pub(in crate::path) fn times_as_slow(&self, tangent_jump: &Axes, direction: &Axes) -> f64 {
        let [per_acceleration, per_jerk] = self.slowness(tangent_jump);
        let [along, jerk_along] = self.slowness(direction);
        (per_acceleration / along).max(per_jerk / jerk_along)
    }

    /// 1 over the acceleration, and over the jerk up to [`GREATEST_JERK`], with which a place moves in a `direction`, shape (9): of
    /// its linear axes the one that needs most of its own, as if it were the one that moves most.
    fn slowness(&self, direction: &Axes) -> [f64; 2] {
        let [x, y, z, _, _, _, u, v, w]: [f64; 9] = direction.abs().into();
        let size = Axes::from([x, y, z, 0.0, 0.0, 0.0, u, v, w]);
        let most = size.max();
        if most <= 0.0 {
            let per_acceleration = self.per_acceleration.fixed_rows::<3>(0).max();
            return [per_acceleration, self.linear_jerk.recip()];
        }
        let share = size / most;
        let least = (GREATEST_JERK * self.millimetre).recip();
        [
            share.component_mul(&self.per_acceleration).max(),
            share.component_mul(&self.per_jerk).max().max(least),
        ]
    }

    /// The widest biweight kernel within `tolerance` of all corners in XYZ that limit a `speed`, whatever they turn by; machine
    /// units.
    fn widest_limiting(&self, tolerance: f64, speed: f64) -> f64 {
        let width_times_turn = tolerance / kernel::peak(0.0);
        let bend = self.per_acceleration.fixed_rows::<3>(0).max();
        let by_acceleration = (kernel::greatest(0.0) * width_times_turn * bend).sqrt();
        let by_jerk = cube_root(kernel::steepest(0.0) * width_times_turn / self.jerk_at(speed));
        speed * by_acceleration.max(by_jerk)
    }

    /// Whether a corner that is run through at most at `speed` is faster where it [swings out](super::lone_corner): it limits the
    /// speed. `width`: of its biweight kernel.
    pub(in crate::path) fn gains_by_swinging_out(
        &self,
        tangent_jump: &Axes,
        width: f64,
        speed: f64,
    ) -> bool {
        self.swings && self.free_width(tangent_jump, speed, 0.0) > LIMITING * width
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{limits, settings};
    use super::super::{FREE_RESERVE, GREATEST_DESIGN_WIDTH};
    use super::*;

    #[test]
    fn a_corner_swings_out_as_far_as_its_kernel_can_be_wide() {
        for jerk in [20_000.0, f64::INFINITY] {
            let settings = settings(jerk);
            let swing = |tolerance| settings.greatest_swing(100.0, tolerance, 100.0);
            assert_eq!(swing(0.005), GREATEST_DESIGN_WIDTH);
            assert_eq!(swing(100.0), GREATEST_SWING);
            let width = swing(1.0) / WIDTHS_OF_A_SWING;
            // A corner with a kernel of this width just limits the speed.
            let mut turn = Axes::zeros();
            turn[0] = 1.0 / (kernel::peak(0.0) * width);
            let wanted = settings.free_width(&turn, 100.0, 0.0) / FREE_RESERVE;
            assert!((wanted / width - 1.0).abs() < 1e-9, "{wanted} {width}");
            assert_eq!(settings.greatest_swing(1.0, 1.0, 100.0), LEGS_OF_A_SWING);
            let still = settings.without_swings();
            assert_eq!(still.greatest_swing(100.0, 1.0, 100.0), 0.0);
        }
    }

    #[test]
    fn a_slow_axis_counts_in_corners_that_it_moves_in() {
        let slow_z = |ratio: f64| {
            let mut limits = limits(20_000.0);
            limits.acceleration[2] /= ratio;
            limits.jerk[2] /= ratio;
            BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound")
        };
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let mut direction = Axes::zeros();
            direction[axis] = 1.0;
            direction
        });
        let (plane, retract) = (y - x, z - x);
        let alike = slow_z(1.0);
        let swing = |settings: &BlendSettings, jump| settings.natural_swing(jump, 0.05, 0.0);
        assert_eq!(swing(&slow_z(30.0), &plane), swing(&alike, &plane));
        let slower = swing(&slow_z(30.0), &retract) / swing(&alike, &retract);
        assert!(
            (slower / 30f64.powf(-1.0 / 6.0) - 1.0).abs() < 1e-9,
            "{slower}"
        );
        let limits =
            |ratio, jump, other| slow_z(ratio).swing_limits(jump, [(&x, 100.0), (other, 50.0)]);
        for (jump, other) in [(&plane, &y), (&retract, &z)] {
            let [gathered, programmed] = limits(1.0, jump, other);
            let bend = HALFWAY_OUT * 2f64.sqrt();
            assert!((gathered - bend).abs() < 1e-12 && (programmed - 10.0 * bend).abs() < 1e-9);
        }
        assert_eq!(limits(30.0, &plane, &y), limits(1.0, &plane, &y));
        let [gathered, programmed] = limits(30.0, &retract, &z);
        let [alike, slowly] = limits(1.0, &retract, &z);
        assert!((gathered - 30.0 * alike).abs() < 1e-9);
        assert!((programmed - 30.0 * slowly).abs() < 1e-9);
        let unlimited = BlendSettings::DEFAULT.swing_limits(&plane, [(&x, 100.0), (&y, 50.0)]);
        assert!(unlimited[1] == 0.0, "{unlimited:?}");
    }

    #[test]
    fn the_more_tolerance_the_farther_a_corner_swings_out() {
        let settings = settings(20_000.0);
        let tangent_jump = Axes::repeat(0.3);
        let swing = |tolerance| settings.natural_swing(&tangent_jump, tolerance, 0.0);
        // The way in which acceleration is built up at full jerk and taken back: A^3 / J^2.
        let way: f64 = 2.5;
        assert!((swing(way) / (NATURAL_SWING * way) - 1.0).abs() < 1e-12);
        for share in [1e-3, 0.1, 4.0f64] {
            let expected = share.powf(5.0 / 6.0) * swing(way);
            assert!((swing(share * way) / expected - 1.0).abs() < 1e-12);
        }
        let least = settings.natural_swing(&tangent_jump, 0.01, 3.0);
        assert_eq!(least, 3.0 * LEAST_NATURAL_SWING);
        let unlimited = BlendSettings::DEFAULT.natural_swing(&tangent_jump, 0.05, 1.0);
        assert_eq!(unlimited, f64::INFINITY);
    }
}
