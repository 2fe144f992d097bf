//! The axes four at a time, in single precision.
//!
//! Rows are evaluated hundreds of times in a servo period, for all axes. Loops over four lanes become
//! vector instructions: with nine axes they take a third of the time. Single precision is exact to
//! 1e-7 of what is added up, far below the margins that are kept.

use crate::axes::{AXIS_COUNT, Axes};

/// Axes in a quad.
pub const LANES: usize = 4;

/// Four axes: a vector register.
pub type Quad = [f32; LANES];

/// Quads of all axes.
pub const QUADS: usize = AXIS_COUNT.div_ceil(LANES);

/// One number for each axis, shape (3, 4); the last three are 0.
pub type Quads = [Quad; QUADS];

pub const ZEROS: Quads = [[0.0; LANES]; QUADS];

/// Below this a row is noise, and its square would be a subnormal number, with which processors are slow.
const NOISE: f64 = 1e-18;

/// All axes in single precision.
pub fn quads(values: &Axes) -> Quads {
    let mut quads = ZEROS;
    for (lane, &value) in quads.as_flattened_mut().iter_mut().zip(values.iter()) {
        if value.abs() > NOISE {
            *lane = value as f32;
        }
    }
    quads
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_keep_their_order_and_noise_is_dropped() {
        let mut axes = Axes::from_fn(|axis, _| axis as f64 - 4.0);
        axes[8] = 1e-19;
        let [first, second, third] = quads(&axes);
        assert_eq!(first, [-4.0, -3.0, -2.0, -1.0]);
        assert_eq!(second, [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(third, [0.0; 4]);
    }
}
