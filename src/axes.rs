//! The nine axes of LinuxCNC and quantities that have one value for each.

use nalgebra::{Matrix3, SVector, Vector3};

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

/// How X Y Z of the program lie to those of the machine: the linear part of a programmed frame,
/// shape (3, 3). The other axes are the same.
///
/// The limits of the axes hold for the machine, so that derivatives of the path pass through here
/// before they are compared with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MachineMap(Matrix3<f64>);

impl MachineMap {
    /// Without a frame the axes of the program are those of the machine.
    pub const IDENTITY: Self = Self(Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0));

    /// What no element exceeds. A programmed frame scales by a thousand at most.
    pub const GREATEST_ELEMENT: f64 = 1e4;

    /// `None` if an element is not a number or greater than [`Self::GREATEST_ELEMENT`].
    pub fn new(linear: &Matrix3<f64>) -> Option<Self> {
        linear
            .iter()
            .all(|element| element.abs() <= Self::GREATEST_ELEMENT)
            .then_some(Self(*linear))
    }

    /// The axes of the program, 0 to 8, that move an axis of the machine.
    pub fn axes_of(&self, axis: usize) -> impl Iterator<Item = usize> {
        let row: [f64; AXIS_COUNT] = core::array::from_fn(|from| match self.0.get((axis, from)) {
            Some(element) => *element,
            None => f64::from(u8::from(axis == from)),
        });
        (0..AXIS_COUNT).filter(move |from| row[*from] != 0.0)
    }

    /// A derivative of the path, shape (9), as the axes of the machine see it.
    #[inline]
    pub fn apply(&self, program: &Axes) -> Axes {
        let [x, y, z, a, b, c, u, v, w]: [f64; AXIS_COUNT] = (*program).into();
        let linear = self.0 * Vector3::new(x, y, z);
        Axes::from([linear.x, linear.y, linear.z, a, b, c, u, v, w])
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

    #[test]
    fn a_map_acts_on_the_linear_axes_alone() {
        let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let map = MachineMap::new(&quarter_turn).expect("finite");
        let program = Axes::from([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        let machine = Axes::from([-2.0, 1.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert_eq!(map.apply(&program), machine);
        assert_eq!(MachineMap::IDENTITY.apply(&program), program);
        for factor in [f64::NAN, f64::INFINITY, -1.1e4, 1e300] {
            assert!(MachineMap::new(&(quarter_turn * factor)).is_none());
        }
        assert!(MachineMap::new(&(quarter_turn * 1e4)).is_some());
    }
}
