//! The nine axes of LinuxCNC and quantities that have one value for each.

use nalgebra::SVector;

/// How many axes LinuxCNC knows: X Y Z A B C U V W, in the order of its `EmcPose`.
pub const AXIS_COUNT: usize = 9;

/// The letters of the axes, in the order of [`Axes`].
pub const AXIS_LETTERS: [char; AXIS_COUNT] = ['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'];

/// Which of them are A B C.
pub const ROTARY_AXES: core::ops::Range<usize> = 3..6;

/// One number for each axis, shape (9): a position, or its derivative by time or by arc length.
///
/// X Y Z and U V W are in machine units of length (usually mm), A B C in degrees.
pub type Axes = SVector<f64, AXIS_COUNT>;

/// What each axis is able to do: positive, `f64::INFINITY` where nothing limits it. What LinuxCNC says of an axis is taken
/// as it is, 0 where the machine does not have it: a move that needs an axis without usable limits is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisLimits {
    /// Machine units (or degrees) per second.
    pub velocity: Axes,
    /// Machine units (or degrees) per second squared.
    pub acceleration: Axes,
    /// Machine units (or degrees) per second cubed.
    pub jerk: Axes,
}

impl AxisLimits {
    /// The limits of jerk, shape (9), where positions are set once in a `period` of so many seconds:
    /// infinite where an axis could go from its acceleration one way to that the other way within one of
    /// them. Where the acceleration is infinite its velocity limits that.
    pub fn jerk_of_use(&self, period: f64) -> Axes {
        Axes::from_fn(|axis, _| {
            let acceleration = self.acceleration[axis].min(2.0 * self.velocity[axis] / period);
            let most = 2.0 * acceleration / period;
            if self.jerk[axis] < most {
                self.jerk[axis]
            } else {
                f64::INFINITY
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jerk_that_a_period_cannot_use_up_is_none() {
        let limits = |acceleration: f64, jerk: f64| AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(acceleration),
            jerk: Axes::repeat(jerk),
        };
        let of_use = |acceleration, jerk| limits(acceleration, jerk).jerk_of_use(1e-3)[4];
        assert_eq!(of_use(1000.0, 1.99e6), 1.99e6);
        for jerk in [2e6, 1e9, 1e300, f64::INFINITY] {
            assert_eq!(of_use(1000.0, jerk), f64::INFINITY);
        }
        assert_eq!(of_use(f64::INFINITY, 3.99e8), 3.99e8);
        assert_eq!(of_use(f64::INFINITY, 4e8), f64::INFINITY);
    }
}
