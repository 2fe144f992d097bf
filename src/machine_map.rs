//! How what the program moves lies to what the limits hold for.
//!
//! Behind a programmed frame these are the axes of the machine, a linear map away. Behind kinematics that bend
//! they are its joints: then a derivative by the path depends on the place and on all derivatives below it, and
//! what the limits hold for is told by a jet, three derivatives at a time.

use nalgebra::{Matrix3, Vector3};

use crate::axes::{AXIS_COUNT, Axes, AxisLimits};

/// Three derivatives of the joints, each shape (9), at a position of the program, shape (9), for the three derivatives
/// of that by the same parameter. The last argument is what a unit of each is of the limit of a joint, see
/// [`JointMap::shares`]. What is not a number where the machine has no joints for the position.
pub type JointJet = fn(&Axes, &[Axes; 3], &[Axes; 3]) -> [Axes; 3];

/// What a joint reaches in so many seconds stands for a velocity that has no limit, in [`JointMap::shares`].
const TIME_TO_SPEED: f64 = 0.2;

/// The joints behind kinematics that bend. Joint n has the place of axis n in [`Axes`] and [`AxisLimits`].
#[derive(Clone, Copy, Debug)]
pub struct JointMap {
    jet: JointJet,
    limits: AxisLimits,
    shares: [Axes; 3],
    nanoseconds: f64,
}

impl JointMap {
    /// Joints with these limits, infinite for those that there are not. A jet takes so many nanoseconds.
    pub fn new(jet: JointJet, limits: &AxisLimits, nanoseconds: f64) -> Self {
        let share = |limit: &Axes| limit.map(|limit| 1.0 / limit);
        let reached = limits.acceleration * TIME_TO_SPEED;
        let velocity =
            limits.velocity.zip_map(
                &reached,
                |limit, reached| if limit.is_finite() { limit } else { reached },
            );
        Self {
            jet,
            limits: *limits,
            shares: [&velocity, &limits.acceleration, &limits.jerk].map(share),
            nanoseconds,
        }
    }

    /// The same with other limits.
    #[must_use]
    pub fn with_limits(&self, limits: &AxisLimits) -> Self {
        Self::new(self.jet, limits, self.nanoseconds)
    }

    /// What the joints may do.
    pub fn limits(&self) -> &AxisLimits {
        &self.limits
    }

    /// What a unit of velocity, acceleration and jerk of each joint is of its limit; 0 where acceleration and jerk have none,
    /// and of some velocity where that has none: the scale by which a jet is exact enough.
    pub fn shares(&self) -> &[Axes; 3] {
        &self.shares
    }

    /// Whether with these limits they are the other ones, however long a jet takes.
    pub fn is_with(&self, limits: &AxisLimits, other: &Self) -> bool {
        *limits == other.limits && core::ptr::fn_addr_eq(self.jet, other.jet)
    }
}

/// How X Y Z of the program lie to those of the machine, the linear part of a programmed frame, shape (3, 3) (the other
/// axes are the same); and the joints behind both, where they have limits of their own.
///
/// Derivatives of the path pass through here before they are compared with limits.
#[derive(Clone, Copy, Debug)]
pub struct MachineMap {
    linear: Matrix3<f64>,
    /// Whether that is more than the identity: mostly it is not, and nothing has to be calculated.
    is_framed: bool,
    joints: Option<JointMap>,
}

impl MachineMap {
    /// Without a frame the axes of the program are those of the machine.
    pub const IDENTITY: Self = Self {
        linear: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        is_framed: false,
        joints: None,
    };

    /// What no element exceeds. A programmed frame scales by a thousand at most.
    pub const GREATEST_ELEMENT: f64 = 1e4;

    /// `None` if an element is not a number or greater than [`Self::GREATEST_ELEMENT`].
    pub fn new(linear: &Matrix3<f64>) -> Option<Self> {
        linear
            .iter()
            .all(|element| element.abs() <= Self::GREATEST_ELEMENT)
            .then_some(Self {
                linear: *linear,
                is_framed: *linear != Self::IDENTITY.linear,
                joints: None,
            })
    }

    /// The same frame with these joints behind it.
    #[must_use]
    pub fn with_joints(self, joints: Option<JointMap>) -> Self {
        Self { joints, ..self }
    }

    /// The joints that have limits of their own.
    #[inline]
    pub fn joints(&self) -> Option<&JointMap> {
        self.joints.as_ref()
    }

    /// The axes of the program, 0 to 8, that move an axis of the machine.
    pub fn axes_of(&self, axis: usize) -> impl Iterator<Item = usize> {
        let row: [f64; AXIS_COUNT] =
            core::array::from_fn(|from| match self.linear.get((axis, from)) {
                Some(element) => *element,
                None => f64::from(u8::from(axis == from)),
            });
        (0..AXIS_COUNT).filter(move |from| row[*from] != 0.0)
    }

    /// A derivative of the path, shape (9), as the axes of the machine see it.
    #[inline]
    pub fn apply(&self, program: &Axes) -> Axes {
        if !self.is_framed {
            return *program;
        }
        let [x, y, z, a, b, c, u, v, w]: [f64; AXIS_COUNT] = (*program).into();
        let linear = self.linear * Vector3::new(x, y, z);
        Axes::from([linear.x, linear.y, linear.z, a, b, c, u, v, w])
    }

    /// How much longer what leads in this direction, shape (9), is in X Y Z of the machine than in those of the program; 1 where
    /// it leads along none of them.
    pub fn stretch(&self, direction: &Axes) -> f64 {
        let length = |axes: &Axes| axes.fixed_rows::<3>(0).norm();
        let programmed = length(direction);
        if programmed > 0.0 {
            length(&self.apply(direction)) / programmed
        } else {
            1.0
        }
    }

    /// Three derivatives of the path at a position of the program, all shape (9), as what [`Self::limits`] hold for
    /// sees them.
    #[inline]
    pub fn derivatives(&self, position: &Axes, program: [&Axes; 3]) -> [Axes; 3] {
        match &self.joints {
            None => program.map(|derivative| self.apply(derivative)),
            Some(joints) => (joints.jet)(
                position,
                &program.map(|derivative| *derivative),
                &joints.shares,
            ),
        }
    }

    /// What the derivatives are compared with: the limits of the joints where they have some, else those of the axes.
    #[inline]
    pub fn limits<'a>(&'a self, axes: &'a AxisLimits) -> &'a AxisLimits {
        self.joints.as_ref().map_or(axes, |joints| &joints.limits)
    }

    /// How long [`Self::derivatives`] takes, nanoseconds: 0 for what is linear.
    pub fn nanoseconds(&self) -> f64 {
        self.joints
            .as_ref()
            .map_or(0.0, |joints| joints.nanoseconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn turns_and_mirrors_stretch_nothing_and_scales_what_leads_along_them() {
        let direction = Axes::from([0.0, 0.0, -2.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let stretch = |linear: Matrix3<f64>| {
            MachineMap::new(&linear)
                .expect("finite")
                .stretch(&direction)
        };
        let turn = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.6, -0.8, 0.0, 0.8, 0.6);
        let scale = |x, y, z| Matrix3::from_diagonal(&Vector3::new(x, y, z));
        assert_eq!(stretch(turn), 1.0);
        assert_eq!(stretch(scale(2.0, 3.0, -1.0)), 1.0);
        assert_eq!(stretch(scale(1.0, 1.0, 2.0)), 2.0);
        let map = MachineMap::new(&scale(2.0, 2.0, 2.0)).expect("finite");
        assert_eq!(map.stretch(&Axes::zeros()), 1.0);
    }

    #[test]
    fn joints_have_derivatives_and_limits_of_their_own() {
        // A joint that is the square of X.
        let jet: JointJet = |q, [d, a, j], _| {
            let x = q[0];
            let mut joints = [Axes::zeros(); 3];
            joints[0][0] = 2.0 * x * d[0];
            joints[1][0] = 2.0 * (d[0] * d[0] + x * a[0]);
            joints[2][0] = 2.0 * (3.0 * d[0] * a[0] + x * j[0]);
            joints
        };
        let limits = |factor: f64| AxisLimits {
            velocity: Axes::repeat(factor),
            acceleration: Axes::repeat(10.0 * factor),
            jerk: Axes::repeat(f64::INFINITY),
        };
        let joints = JointMap::new(jet, &limits(2.0), 100.0);
        let map = MachineMap::IDENTITY.with_joints(Some(joints));
        let along = [Axes::x(), Axes::zeros(), Axes::zeros()];
        let [first, second, third] = map.derivatives(&(Axes::x() * 3.0), along.each_ref());
        assert_eq!([first[0], second[0], third[0]], [6.0, 2.0, 0.0]);
        assert_eq!(map.limits(&limits(1.0)), &limits(2.0));
        assert_eq!(joints.shares()[1][8], 0.05);
        assert_eq!(joints.shares()[2][8], 0.0);
        assert!(joints.is_with(&limits(2.0), &JointMap::new(jet, &limits(2.0), 300.0)));
        assert!(!joints.is_with(&limits(3.0), &joints));
        assert!(joints.is_with(&limits(3.0), &joints.with_limits(&limits(3.0))));
        assert_eq!(MachineMap::IDENTITY.limits(&limits(1.0)), &limits(1.0));
    }
}
