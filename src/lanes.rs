//! The nine axes in single precision, padded to whole vector registers.
//!
//! Limits are checked hundreds of times in a servo period, for all axes at once. Loops over [`Lanes`], or
//! over a [`Quad`] of them where most axes stand still, with plain compares become vector instructions:
//! with nine axes they take a third of the time. Single precision is exact to 1e-7 of what is added up, far
//! below the margins that are kept.

use crate::axes::{AXIS_COUNT, Axes};

/// Nine axes and three that never move.
pub const LANE_COUNT: usize = 12;

/// One number for each axis, shape (12); the last three are those of an axis that never moves.
pub type Lanes = [f32; LANE_COUNT];

/// Axes in a quad.
pub const QUAD_LANES: usize = 4;

/// Quads of all axes.
pub const QUADS: usize = LANE_COUNT / QUAD_LANES;

/// Four axes: a vector register.
pub type Quad = [f32; QUAD_LANES];

pub const ZEROS: Lanes = [0.0; LANE_COUNT];

/// Stands for an unlimited acceleration or jerk: far above any [`GREATEST_BOUND`], and still
/// finite, so that no difference of two of them is NaN.
pub const UNLIMITED: f32 = 1e34;

/// Single precision must not turn a reference that is on the limit into one that is beyond.
pub const ROUNDING: f32 = 1.0 + 1e-5;

/// What a reference may at most claim to need; infinite bounds are lowered to it.
const GREATEST_BOUND: f64 = 1e30;

/// Below this a number is noise; zero saves the processor's slow path for subnormal numbers.
const LEAST_MAGNITUDE: f64 = 1e-20;

/// The same for what is squared.
const LEAST_SQUARED: f64 = 1e-18;

/// Four axes of the twelve, by the number of their quad.
#[inline(always)]
pub fn quad(lanes: &Lanes, number: usize) -> &Quad {
    let (quads, _) = lanes.as_chunks();
    &quads[number]
}

/// Each axis as it is, but for noise: what may be squared, and is finite.
pub fn rounded(values: &Axes) -> Lanes {
    let mut lanes = ZEROS;
    for (lane, &value) in lanes.iter_mut().zip(values.iter()) {
        if value.abs() > LEAST_SQUARED {
            *lane = value as f32;
        }
    }
    lanes
}

/// `value * scale` for each axis. Infinite values become huge ones, NaN and noise become 0.
pub fn scaled(value: &Axes, scale: f64) -> Lanes {
    let mut lanes = ZEROS;
    for (lane, axis) in lanes.iter_mut().zip(value.iter()) {
        *lane = single(axis * scale);
    }
    lanes
}

/// The nine axes, as far as single precision tells them.
pub fn axes_of(lanes: &Lanes) -> Axes {
    Axes::from_fn(|axis, _| f64::from(lanes[axis]))
}

/// One number in single precision, held within finite bounds; NaN and noise become 0.
pub fn single(value: f64) -> f32 {
    if value.abs() > LEAST_MAGNITUDE {
        value.clamp(-GREATEST_BOUND, GREATEST_BOUND) as f32
    } else {
        0.0
    }
}

/// `limit * scale` for each axis, [`UNLIMITED`] where it is infinite and for the padding.
pub fn scaled_limits(limit: &Axes, scale: f64) -> Lanes {
    let mut lanes = [UNLIMITED; LANE_COUNT];
    for (lane, axis) in lanes.iter_mut().zip(limit.iter()) {
        let value = axis * scale;
        if value < GREATEST_BOUND {
            *lane = value as f32;
        }
    }
    lanes
}

/// The lesser of two, by a plain compare; `a` if one is not a number. One instruction, where `min` takes six.
#[inline(always)]
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// The greater of two, by a plain compare; `a` if one is not a number.
#[inline(always)]
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// The greatest amount of all axes that are numbers.
#[inline(always)]
pub fn greatest_amount(axes: &Axes) -> f64 {
    axes.iter()
        .fold(0.0, |most, value| greater(most, value.abs()))
}

/// The least of all lanes.
#[inline(always)]
pub fn least(lanes: &Lanes) -> f32 {
    lanes.iter().fold(f32::INFINITY, |a, &b| lesser(a, b))
}

/// The greatest of all lanes.
#[inline(always)]
pub fn greatest(lanes: &Lanes) -> f32 {
    lanes.iter().fold(f32::NEG_INFINITY, |a, &b| greater(a, b))
}

const _: () = assert!(LANE_COUNT >= AXIS_COUNT && QUADS * QUAD_LANES == LANE_COUNT);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_becomes_finite() {
        let mut axes = Axes::zeros();
        axes[0] = f64::INFINITY;
        axes[1] = f64::NEG_INFINITY;
        axes[2] = f64::NAN;
        axes[3] = 1e-300;
        axes[4] = -2.5;
        let lanes = scaled(&axes, 2.0);
        assert_eq!(lanes[..6], [1e30, -1e30, 0.0, 0.0, -5.0, 0.0]);
        assert!(least(&lanes) == -1e30 && greatest(&lanes) == 1e30);
        assert_eq!((lesser(1.0, f32::NAN), greater(1.0, f32::NAN)), (1.0, 1.0));
        let limits = scaled_limits(&axes.map(f64::abs), 2.0);
        assert_eq!(limits[0], UNLIMITED);
        assert_eq!(limits[4], 5.0);
        assert_eq!(limits[AXIS_COUNT..], [UNLIMITED; LANE_COUNT - AXIS_COUNT]);
    }

    #[test]
    fn axes_keep_their_order_in_quads_and_noise_is_dropped() {
        let mut axes = Axes::from_fn(|axis, _| axis as f64 - 4.0);
        axes[8] = 1e-19;
        let lanes = rounded(&axes);
        assert_eq!(quad(&lanes, 0), &[-4.0, -3.0, -2.0, -1.0]);
        assert_eq!(quad(&lanes, 1), &[0.0, 1.0, 2.0, 3.0]);
        assert_eq!(quad(&lanes, 2), &[0.0; 4]);
        axes[8] = 0.0;
        assert_eq!(axes_of(&lanes), axes);
    }
}
