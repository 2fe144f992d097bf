//! What the shape of blends depends on, besides the program.

pub(super) mod swing;

use super::kernel;
use super::orientation::Orientation;
use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::cube_root::cube_root;

/// Dense code is smoothed for this jerk at most, although it may be unlimited; mm/s^3.
const GREATEST_JERK: f64 = 100_000.0;

/// And for one that builds up the acceleration of all axes in this share of the time in which that comes to the speed at least: a slow
/// machine has the path of a fast one that needs the same way to come to its speed. With 1000 mm/s2 and 100 mm/s that is
/// the jerk above.
const SHORTEST_BUILD_UP: f64 = 0.1;

/// What kernels are widened to at most where the tolerance leaves it open, mm.
const GREATEST_DESIGN_WIDTH: f64 = 8.0;

/// And at least, mm.
const LEAST_DESIGN_WIDTH: f64 = 0.001;

/// What a corner without a tolerance is rounded over at most to either side, mm.
const GREATEST_FREE_WIDTH: f64 = 12.0;

/// A corner without a tolerance is this much wider than its feed needs at a constant speed, so that
/// the speed may change in it.
const FREE_RESERVE: f64 = 1.1;

/// Acceleration is built up in this time at least, seconds: unlimited jerk is still a few cycles
/// long.
const SHORTEST_RAMP: f64 = 1.0 / 300.0;

/// A tolerance up to this rounds no corner: the moves are followed exactly, but for that tolerance
/// on either side of a tangent joint; mm.
const LEAST_TOLERANCE: f64 = 1e-5;

/// What the shape of blends depends on, besides the program. The overrides of the operator are not
/// among it: they never change a path.
#[derive(Clone, Copy, Debug)]
pub struct BlendSettings {
    millimetre: f64,
    rotary_weight: f64,
    default_tolerance: f64,
    /// The least of X Y Z U V W, held below [`GREATEST_JERK`].
    linear_jerk: f64,
    /// The greatest acceleration of X Y Z U V W.
    linear_acceleration: f64,
    /// 1 over the limits of each axis; 0 where there is none.
    per_acceleration: Axes,
    per_jerk: Axes,
    orientation: Option<Orientation>,
    /// Whether corners may [swing out](super::lone_corner).
    swings: bool,
    /// Whether rotary axes turn the tool about its tip.
    turns_tool: bool,
}

/// How far the blended path may be from a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowance {
    /// Not at its ends, and in between by no more than this, machine units, which is for easements
    /// where it meets another move in a tangent.
    Exact(f64),
    /// By a tolerance P, machine units.
    Tolerance(f64),
    /// Corners are cut by up to half of their shorter leg, and what else is done stays within this,
    /// machine units.
    HalfLegs(f64),
}

impl BlendSettings {
    /// What moves that are to be followed exactly are left by on either side of a tangent joint, mm.
    pub const EXACT_TOLERANCE: f64 = 1e-3;

    /// A machine in millimetres without limits: 0.1 mm counts as much as a degree.
    pub const DEFAULT: Self = Self {
        millimetre: 1.0,
        rotary_weight: 0.1,
        default_tolerance: 0.02,
        linear_jerk: GREATEST_JERK,
        linear_acceleration: f64::INFINITY,
        per_acceleration: Axes::from_array_storage(nalgebra::ArrayStorage([[0.0; AXIS_COUNT]])),
        per_jerk: Axes::from_array_storage(nalgebra::ArrayStorage([[0.0; AXIS_COUNT]])),
        orientation: None,
        swings: true,
        turns_tool: false,
    };

    /// `millimetre`: its length in machine units (1, or 1/25.4). `rotary_weight`: how many machine
    /// units count as much as a degree of A B C, see the metric of the
    /// [blended path](super::BlendedPath). `default_tolerance`: how far the path may be from a run
    /// of short moves under G64 without P, machine units; less than a micrometre counts as one.
    /// `limits`: what the axes are able to do; each may be infinite.
    ///
    /// `None` if one of the first two is not positive and finite, the tolerance negative or not
    /// finite, or a limit not positive.
    pub fn new(
        millimetre: f64,
        rotary_weight: f64,
        default_tolerance: f64,
        limits: &AxisLimits,
    ) -> Option<Self> {
        let sound = |value: f64| value > 0.0 && value.is_finite();
        let positive = |limits: &Axes| limits.iter().all(|limit| *limit > 0.0);
        if !(sound(millimetre)
            && sound(rotary_weight)
            && default_tolerance >= 0.0
            && default_tolerance.is_finite()
            && positive(&limits.acceleration)
            && positive(&limits.jerk))
        {
            return None;
        }
        let linear = |limits: &Axes| {
            let [x, y, z, _, _, _, u, v, w]: [f64; 9] = (*limits).into();
            [x, y, z, u, v, w].into_iter()
        };
        let greatest = GREATEST_JERK * millimetre;
        Some(Self {
            millimetre,
            rotary_weight,
            default_tolerance,
            linear_jerk: linear(&limits.jerk).fold(greatest, f64::min),
            linear_acceleration: linear(&limits.acceleration).fold(0.0, f64::max),
            per_acceleration: limits.acceleration.map(f64::recip),
            per_jerk: limits.jerk.map(f64::recip),
            orientation: None,
            swings: true,
            turns_tool: false,
        })
    }

    /// The same where an axis, 3 for A or 4 for B, tilts the tool, C turns it, and it may lean from the program by a
    /// tolerance in degrees, positive: what a P allows rotary axes is no more.
    #[must_use]
    pub fn with_tilt(self, tilt: usize, tolerance: f64) -> Self {
        Self {
            orientation: Some(Orientation { tilt, tolerance }),
            turns_tool: true,
            ..self
        }
    }

    /// The same where rotary axes turn the tool about its tip: joints follow them with X, Y and Z.
    #[must_use]
    pub fn with_turning_tool(self) -> Self {
        Self {
            turns_tool: true,
            ..self
        }
    }

    /// The same where no corner [swings out](super::lone_corner).
    #[must_use]
    pub fn without_swings(self) -> Self {
        Self {
            swings: false,
            ..self
        }
    }

    pub(super) const fn orientation(&self) -> Option<&Orientation> {
        self.orientation.as_ref()
    }

    pub(super) const fn rotary_weight(&self) -> f64 {
        self.rotary_weight
    }

    /// The jerk that the path is smoothed for where it is run at `speed`, machine units per second.
    fn jerk_at(&self, speed: f64) -> f64 {
        self.linear_jerk.min(self.greatest_jerk_at(speed))
    }

    /// The most that a path is smoothed for at this speed.
    fn greatest_jerk_at(&self, speed: f64) -> f64 {
        let acceleration = self.linear_acceleration;
        let built_up = acceleration * acceleration / (SHORTEST_BUILD_UP * speed);
        built_up.min(GREATEST_JERK * self.millimetre)
    }

    /// From this width on the kernels of dense code hardly limit a `speed` of so many machine units
    /// per second. Machine units.
    pub(super) fn design_width(&self, speed: f64) -> f64 {
        let (speed, jerk) = (
            speed / self.millimetre,
            self.jerk_at(speed) / self.millimetre,
        );
        let width = 1.8 * (speed / 100.0) * cube_root(20_000.0 / jerk);
        self.millimetre * width.clamp(LEAST_DESIGN_WIDTH, GREATEST_DESIGN_WIDTH)
    }

    /// The third derivative of a path that is run through at `speed` within acceleration and jerk of XYZ, 1 per square
    /// machine unit: with more of it the path limits the speed. Jerk counts as no more than what builds up the acceleration
    /// of the circle that it allows while its radius is passed.
    pub(super) fn even_third(&self, speed: f64) -> f64 {
        let square = speed * speed;
        let by_jerk = self.jerk_at(speed) / (square * speed);
        let acceleration = self.per_acceleration.fixed_rows::<3>(0).max().recip();
        let by_acceleration = acceleration / square;
        by_jerk.min(by_acceleration * by_acceleration)
    }

    /// The acceleration of a motion in which each axis has at most a share of it, shape (9); infinite without a limit.
    pub(super) fn acceleration_of(&self, shares: &Axes) -> f64 {
        shares.component_mul(&self.per_acceleration).max().recip()
    }

    /// The same of its jerk, and no more than a path is smoothed for at this `speed`.
    pub(super) fn jerk_of(&self, shares: &Axes, speed: f64) -> f64 {
        let jerk = shares.component_mul(&self.per_jerk).max().recip();
        jerk.min(self.greatest_jerk_at(speed))
    }

    /// Whether rotary axes turn the tool about its tip.
    pub(super) fn turns_tool(&self) -> bool {
        self.turns_tool
    }

    /// Whether the path may be led to the outer side of the program.
    pub(super) fn swings(&self) -> bool {
        self.swings
    }

    /// The speed at which a curve can be run that turns the direction by `turn`, shape (9), of this `size`, over
    /// `length`: within acceleration and jerk of all axes; machine units per second. Infinite without limits.
    pub(super) fn curve_speed(&self, turn: &Axes, size: f64, length: f64) -> f64 {
        let turned = turn.abs();
        let bend = turned.component_mul(&self.per_acceleration).max() / length;
        let twist = turned.component_mul(&self.per_jerk).max() * size / (length * length);
        // Nothing divided by a 0 of no limit is no limit either.
        bend.sqrt().recip().min(cube_root(twist).recip())
    }

    /// Seconds from rest to a `speed` in this `direction`, shape (9), as acceleration and jerk of all axes allow; a little more where
    /// the greatest acceleration is not reached. Machine units per second.
    pub(super) fn time_to_speed(&self, direction: &Axes, speed: f64) -> f64 {
        let size = direction.abs();
        let per_acceleration = size.component_mul(&self.per_acceleration).max();
        let per_jerk = size.component_mul(&self.per_jerk).max();
        let built_up = (speed * per_jerk).sqrt();
        if per_acceleration > 0.0 {
            speed * per_acceleration + built_up.min(per_jerk / per_acceleration)
        } else {
            2.0 * built_up
        }
    }

    /// What a width is never raised above for the sake of speed where kernels overlap, machine
    /// units.
    pub(super) fn greatest_design_width(&self) -> f64 {
        GREATEST_DESIGN_WIDTH * self.millimetre
    }

    /// The width at which a corner that turns the direction by `tangent_jump` (length of the difference of
    /// unit vectors) is run through at `speed` within the jerk, machine units.
    pub(super) fn full_speed_width(&self, tangent_jump: f64, speed: f64) -> f64 {
        // The third derivative of the rounded corner is about 1.44 tangent_jump / w^2, and three times as
        // much is left free for changes of the speed.
        (4.3 * tangent_jump * speed * speed * speed / self.jerk_at(speed)).sqrt()
    }

    /// The width at which a jump of the curvature by `curvature_jump`, 1 per machine unit, is run through at
    /// `speed` within the jerk and as much again, machine units.
    pub(super) fn full_speed_easement(&self, curvature_jump: f64, speed: f64) -> f64 {
        2.0 * 1.152 * curvature_jump * speed * speed * speed / self.jerk_at(speed)
    }

    /// The width at which a corner that stands alone is run through at `speed` within acceleration
    /// and jerk of all axes, with kernels of this `mix`; machine units. `tangent_jump`: jump of dp/ds,
    /// shape (9).
    pub(super) fn free_width(&self, tangent_jump: &Axes, speed: f64, mix: f64) -> f64 {
        let size = tangent_jump.abs();
        let bend = size.component_mul(&self.per_acceleration).max();
        // Also where jerk is not limited nothing is gained by more than this.
        let twist = size.component_mul(&self.per_jerk).max();
        let twist = twist.max(size.max() / (GREATEST_JERK * self.millimetre));
        let square = speed * speed;
        let by_acceleration = kernel::greatest(mix) * bend * square;
        let by_jerk = (kernel::steepest(mix) * twist * square * speed).sqrt();
        (FREE_RESERVE * by_acceleration.max(by_jerk)).min(self.greatest_free_width())
    }

    /// What [`free_width`](Self::free_width) never exceeds, machine units.
    pub(super) fn greatest_free_width(&self) -> f64 {
        GREATEST_FREE_WIDTH * self.millimetre
    }

    /// How flat or peaked the kernel of a corner should be: its mix, see [`kernel`]. `tangent_jump`: jump
    /// of dp/ds, shape (9); `width`: of its biweight kernel, machine units. `by_tolerance`: whether
    /// it is the tolerance that the width follows from, not the length of the legs.
    ///
    /// What counts is how often the time of a ramp from 0 to the greatest acceleration fits into
    /// half of the corner, run through at that acceleration. The lines are fitted to measured times
    /// of squares with legs of 5 mm and random polylines.
    pub(super) fn corner_mix(&self, tangent_jump: &Axes, width: f64, by_tolerance: bool) -> f64 {
        let Some(ramps) = self.ramps(tangent_jump, width) else {
            return 0.0;
        };
        let mix = if by_tolerance {
            kernel::GREATEST_PEAKED - 0.2 * (ramps - 2.0)
        } else {
            -0.22 * ramps
        };
        mix.clamp(-1.0, kernel::GREATEST_PEAKED)
    }

    /// How often the time of a ramp from 0 to the greatest acceleration fits into half of a corner, with the biweight kernel of
    /// this `width`; `None` without a limit.
    fn ramps(&self, tangent_jump: &Axes, width: f64) -> Option<f64> {
        let size = tangent_jump.abs();
        let bend = size.component_mul(&self.per_acceleration).max();
        let twist = size.component_mul(&self.per_jerk).max();
        let ramp = (twist / bend).max(SHORTEST_RAMP);
        (bend > 0.0 && width > 0.0).then(|| (kernel::greatest(0.0) * bend * width).sqrt() / ramp)
    }

    /// What G61 and G61.1 allow.
    pub(super) fn exact(&self) -> Allowance {
        Allowance::Exact(Self::EXACT_TOLERANCE * self.millimetre)
    }

    /// What G64 allows. `given` is P, 0 where the program gave none.
    pub(super) fn allowance(&self, given: f64) -> Allowance {
        let least = LEAST_TOLERANCE * self.millimetre;
        if given > least {
            Allowance::Tolerance(given)
        } else if given > 0.0 {
            Allowance::Exact(given)
        } else {
            let default = self.default_tolerance;
            Allowance::HalfLegs(default.max(Self::EXACT_TOLERANCE * self.millimetre))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn limits(jerk: f64) -> AxisLimits {
        AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(jerk),
        }
    }

    pub(super) fn settings(jerk: f64) -> BlendSettings {
        BlendSettings::new(1.0, 0.1, 0.02, &limits(jerk)).expect("sound")
    }

    #[test]
    fn only_sound_settings() {
        assert!(BlendSettings::new(1.0, 0.1, 0.0, &limits(f64::INFINITY)).is_some());
        for (millimetre, weight, tolerance, jerk) in [
            (0.0, 0.1, 0.02, 1.0),
            (1.0, 0.0, 0.02, 1.0),
            (1.0, f64::NAN, 0.02, 1.0),
            (f64::INFINITY, 0.1, 0.02, 1.0),
            (1.0, 0.1, -0.02, 1.0),
            (1.0, 0.1, f64::NAN, 1.0),
            (1.0, 0.1, 0.02, 0.0),
        ] {
            assert!(BlendSettings::new(millimetre, weight, tolerance, &limits(jerk)).is_none());
        }
    }

    #[test]
    fn a_slow_machine_has_the_widths_of_a_fast_one() {
        let unlimited = |acceleration: f64| {
            let limits = AxisLimits {
                acceleration: Axes::repeat(acceleration),
                ..limits(f64::INFINITY)
            };
            BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound")
        };
        let (fast, slow) = (unlimited(1000.0), unlimited(90.0));
        // Both come to their speed over the same way.
        assert!((slow.design_width(30.0) / fast.design_width(100.0) - 1.0).abs() < 1e-9);
        let easement = |settings: &BlendSettings, speed| settings.full_speed_easement(0.1, speed);
        assert!((easement(&slow, 30.0) / easement(&fast, 100.0) - 1.0).abs() < 1e-9);
        let even = slow.even_third(30.0) / fast.even_third(100.0);
        assert!((even - 1.0).abs() < 1e-9);
        assert_eq!(fast.jerk_at(50.0), GREATEST_JERK);
    }

    #[test]
    fn the_time_to_a_speed() {
        let mut along = Axes::zeros();
        along[0] = 1.0;
        let time = |settings: BlendSettings, speed| settings.time_to_speed(&along, speed);
        assert!((time(settings(20_000.0), 100.0) - 0.15).abs() < 1e-12);
        assert!((time(settings(f64::INFINITY), 100.0) - 0.1).abs() < 1e-12);
        assert_eq!(time(BlendSettings::DEFAULT, 100.0), 0.0);
    }

    #[test]
    fn the_same_blends_in_inches() {
        let inches = AxisLimits {
            velocity: Axes::repeat(100.0 / 25.4),
            acceleration: Axes::repeat(1000.0 / 25.4),
            jerk: Axes::repeat(30_000.0 / 25.4),
        };
        let metric = settings(30_000.0);
        let imperial = BlendSettings::new(1.0 / 25.4, 0.1, 0.02 / 25.4, &inches).expect("sound");
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
        let tangent_jump = Axes::repeat(0.3);
        for speed in [5.0, 50.0, 500.0] {
            close(
                metric.free_width(&tangent_jump, speed, -0.5),
                imperial.free_width(&tangent_jump, speed / 25.4, -0.5),
            );
        }
        for by_tolerance in [false, true] {
            let mix = metric.corner_mix(&tangent_jump, 2.0, by_tolerance);
            assert!((-1.0..0.0).contains(&mix) || by_tolerance);
            assert!(
                (mix - imperial.corner_mix(&tangent_jump, 2.0 / 25.4, by_tolerance)).abs() < 1e-12
            );
        }
    }

    #[test]
    fn corners_are_flat_where_acceleration_limits_and_peaked_where_jerk_does() {
        let mut tangent_jump = Axes::zeros();
        tangent_jump[0] = 1.0;
        assert_eq!(
            settings(f64::INFINITY).corner_mix(&tangent_jump, 2.0, true),
            -1.0
        );
        assert_eq!(
            settings(f64::INFINITY).corner_mix(&tangent_jump, 2.0, false),
            -1.0
        );
        let peaked = settings(20_000.0).corner_mix(&tangent_jump, 0.2, true);
        assert_eq!(peaked, kernel::GREATEST_PEAKED);
        let free = settings(20_000.0).corner_mix(&tangent_jump, 2.0, false);
        assert!((-0.5..0.0).contains(&free), "{free}");
        assert_eq!(
            BlendSettings::DEFAULT.corner_mix(&tangent_jump, 2.0, true),
            0.0
        );
    }

    #[test]
    fn a_curve_is_run_as_fast_as_acceleration_and_jerk_allow() {
        let radius = 2.0;
        let mut turn = Axes::zeros();
        turn[0] = 0.1;
        let by_acceleration = settings(f64::INFINITY).curve_speed(&turn, 0.1, 0.1 * radius);
        assert!((by_acceleration - (1000.0 * radius).sqrt()).abs() < 1e-9);
        let by_jerk = settings(10_000.0).curve_speed(&turn, 0.1, 0.1 * radius);
        assert!((by_jerk.powi(3) - 10_000.0 * radius * radius).abs() < 1e-6);
        let unlimited = BlendSettings::DEFAULT.curve_speed(&turn, 0.1, 0.1 * radius);
        assert_eq!(unlimited, f64::INFINITY);
    }

    #[test]
    fn a_free_corner_is_as_wide_as_its_feed_wants() {
        let mut tangent_jump = Axes::zeros();
        tangent_jump[1] = 1.0;
        let settings = settings(f64::INFINITY);
        let width = settings.free_width(&tangent_jump, 100.0, -1.0);
        // The acceleration in the middle, at 100 mm/s.
        let acceleration = kernel::greatest(-1.0) / width * 10_000.0;
        assert!((acceleration * 1.1 - 1000.0).abs() < 1e-9);
        assert_eq!(settings.free_width(&tangent_jump, 1e4, -1.0), 12.0);
    }

    #[test]
    fn allowances() {
        let settings = settings(1e4);
        assert_eq!(settings.allowance(0.3), Allowance::Tolerance(0.3));
        assert_eq!(settings.allowance(0.0), Allowance::HalfLegs(0.02));
        // Less than what exact moves are left by otherwise.
        assert_eq!(settings.allowance(1e-9), Allowance::Exact(1e-9));
    }
}
