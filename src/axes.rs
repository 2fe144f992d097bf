//! The nine axes of LinuxCNC and quantities that have one value for each.

use nalgebra::SVector;

/// How many axes LinuxCNC knows: X Y Z A B C U V W, in the order of its `EmcPose`.
pub const AXIS_COUNT: usize = 9;

/// The letters of the axes, in the order of [`Axes`].
pub const AXIS_LETTERS: [char; AXIS_COUNT] = ['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'];

/// One number for each axis, shape (9): a position, or its derivative by time or by arc length.
///
/// X Y Z and U V W are in machine units of length (usually mm), A B C in degrees.
pub type Axes = SVector<f64, AXIS_COUNT>;

/// What each axis is able to do. Always positive; `f64::INFINITY` where nothing limits the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisLimits {
    /// Machine units (or degrees) per second.
    pub velocity: Axes,
    /// Machine units (or degrees) per second squared.
    pub acceleration: Axes,
    /// Machine units (or degrees) per second cubed.
    pub jerk: Axes,
}
