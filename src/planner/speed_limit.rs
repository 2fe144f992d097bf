//! What keeps the machine from being faster in a servo period.

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes, AxisLimits};
use crate::machine_map::MachineMap;

/// From this share of what is asked for on the machine is as fast as that.
const AS_ASKED: f64 = 0.995;

/// A feed below this share of the greatest velocity is what the program asks for.
const BELOW_GREATEST: f64 = 0.999;

/// From this share on the limit that is used up most counts as the one that limits the machine: in single periods even a
/// plan of least time is below all of them, on its way from one to the other.
const REACHED: f64 = 0.5;

/// The same for a machine that is as fast as the axes of a move allow.
const REACHED_AT_SPEED: f64 = 0.9;

/// What an axis may do only so much of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Units per second.
    Velocity,
    /// Units per second squared.
    Acceleration,
    /// Units per second cubed.
    Jerk,
}

/// What keeps the machine from being faster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedLimit {
    /// There is nothing to do.
    Nothing,
    /// It rests between moves, or while the next one is planned.
    Rest,
    /// Pause, step, feed hold or an abort; at rest, or braking for it.
    Hold,
    /// It waits for a spindle, or follows its angle.
    Spindle,
    /// F of the program, as it is.
    Feed,
    /// An override or adaptive feed below 100 %.
    Override,
    /// The greatest velocity along the path: the operator's slider, or what the move may not exceed for other reasons than the
    /// velocity of an axis ([TRAJ]MAX_LINEAR_VELOCITY).
    PathVelocity,
    /// The limit of an axis that is used up most, by more than half.
    Axis {
        /// Index of the axis of the machine.
        axis: usize,
        /// Of what.
        quantity: Quantity,
    },
    /// The same of a joint, where joints have limits.
    Joint {
        /// Number of the joint.
        joint: usize,
        /// Of what.
        quantity: Quantity,
    },
    /// On the way between two limits: those of all axes are used up by less than half.
    Between,
}

/// How fast the machine may be along its path, units of the move's measure per second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    /// F of the program.
    pub feed: f64,
    /// What overrides and adaptive feed multiply it by.
    pub scale: f64,
    /// What the move may not exceed, whatever the override.
    pub greatest: f64,
    /// The operator's slider.
    pub slider: f64,
}

/// How the axes of the machine move, or those of the program where joints have limits: differences of the positions of
/// servo periods. And how these joints do.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisMotion {
    position: Axes,
    velocity: Axes,
    acceleration: Axes,
    jerk: Axes,
    /// Velocity, acceleration and jerk.
    joints: [Axes; 3],
}

const ZEROS: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

impl AxisMotion {
    pub const NONE: Self = Self {
        position: ZEROS,
        velocity: ZEROS,
        acceleration: ZEROS,
        jerk: ZEROS,
        joints: [ZEROS; 3],
    };

    /// The machine stands at `position`, and nothing is known of how it came there.
    pub fn begin(&mut self, position: &Axes) {
        *self = Self {
            position: *position,
            ..Self::NONE
        };
    }

    /// A servo period of so many seconds has passed; positions of the machine's axes.
    pub fn pass(&mut self, position: &Axes, period: f64) {
        let rate = 1.0 / period;
        let velocity = (position - self.position) * rate;
        let acceleration = (velocity - self.velocity) * rate;
        self.jerk = (acceleration - self.acceleration) * rate;
        self.acceleration = acceleration;
        self.velocity = velocity;
        self.position = *position;
    }

    /// In that period joints with limits came to this velocity and acceleration.
    pub fn pass_joints(&mut self, [velocity, acceleration]: [Axes; 2], period: f64) {
        let jerk = (acceleration - self.joints[1]) / period;
        self.joints = [velocity, acceleration, jerk];
    }

    /// Whether it stands still.
    pub fn stands(&self) -> bool {
        self.velocity == ZEROS
    }

    /// The share of the limit that is used up most, and which one it is: of the axes, or of the joints behind `map` if
    /// these have limits.
    fn nearest(&self, axes: &AxisLimits, map: &MachineMap) -> (f64, SpeedLimit) {
        let mut found = (0.0, SpeedLimit::Between);
        let by_time = [&self.velocity, &self.acceleration, &self.jerk];
        let limits = map.limits(axes);
        let values = match map.joints() {
            Some(_) => self.joints.each_ref(),
            None => by_time,
        };
        for (values, (quantity, limits)) in values.into_iter().zip([
            (Quantity::Velocity, &limits.velocity),
            (Quantity::Acceleration, &limits.acceleration),
            (Quantity::Jerk, &limits.jerk),
        ]) {
            for axis in 0..AXIS_COUNT {
                let share = values[axis].abs() / limits[axis];
                if share > found.0 {
                    let limit = match map.joints() {
                        Some(_) => SpeedLimit::Joint {
                            joint: axis,
                            quantity,
                        },
                        None => SpeedLimit::Axis { axis, quantity },
                    };
                    found = (share, limit);
                }
            }
        }
        found
    }

    /// What limits a machine that moves at `speed` along its path.
    pub fn limit(
        &self,
        speed: f64,
        asked: &Asked,
        limits: &AxisLimits,
        map: &MachineMap,
    ) -> SpeedLimit {
        let (share, nearest) = self.nearest(limits, map);
        let wanted = asked.feed * asked.scale;
        let greatest = asked.greatest.min(asked.slider);
        if speed >= AS_ASKED * wanted.min(greatest) {
            return if wanted < BELOW_GREATEST * greatest {
                if asked.scale < 1.0 {
                    SpeedLimit::Override
                } else {
                    SpeedLimit::Feed
                }
            } else if asked.greatest <= asked.slider && share >= REACHED_AT_SPEED {
                nearest
            } else {
                SpeedLimit::PathVelocity
            };
        }
        if share >= REACHED {
            nearest
        } else {
            SpeedLimit::Between
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: AxisLimits = AxisLimits {
        velocity: Axes::from_array_storage(ArrayStorage([[100.0; AXIS_COUNT]])),
        acceleration: Axes::from_array_storage(ArrayStorage([[1000.0; AXIS_COUNT]])),
        jerk: Axes::from_array_storage(ArrayStorage([[20_000.0; AXIS_COUNT]])),
    };

    /// Of a machine that came by these places of Y, 1 ms apart, and is as fast as that.
    fn limit(places: [f64; 4], asked: &Asked) -> SpeedLimit {
        let mut motion = AxisMotion::NONE;
        let at = |y| Axes::from([0.0, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        motion.begin(&at(places[0]));
        for y in places {
            motion.pass(&at(y), 1e-3);
        }
        let speed = (places[3] - places[2]) * 1e3;
        motion.limit(speed, asked, &LIMITS, &MachineMap::IDENTITY)
    }

    const F50: Asked = Asked {
        feed: 50.0,
        scale: 1.0,
        greatest: 100.0,
        slider: 100.0,
    };

    fn y(quantity: Quantity) -> SpeedLimit {
        SpeedLimit::Axis { axis: 1, quantity }
    }

    #[test]
    fn a_machine_as_fast_as_asked_is_limited_by_who_asks() {
        let at = |v: f64| [0.0, 1e-3 * v, 2e-3 * v, 3e-3 * v];
        let half = Asked { scale: 0.5, ..F50 };
        let slow = Asked {
            slider: 20.0,
            ..F50
        };
        let rapid = Asked { feed: 1e9, ..F50 };
        let path = Asked {
            greatest: 80.0,
            ..rapid
        };
        for (v, asked, expected) in [
            (50.0, &F50, SpeedLimit::Feed),
            (25.0, &half, SpeedLimit::Override),
            (20.0, &slow, SpeedLimit::PathVelocity),
            (100.0, &rapid, y(Quantity::Velocity)),
            (80.0, &path, SpeedLimit::PathVelocity),
            (20.0, &F50, SpeedLimit::Between),
            (49.0, &rapid, SpeedLimit::Between),
        ] {
            assert_eq!(limit(at(v), asked), expected, "{v} {asked:?}");
        }
    }

    #[test]
    fn a_machine_that_is_slower_is_limited_by_the_limit_that_is_used_up_most() {
        // 1000 mm/s2, from 10 mm/s on.
        let acceleration = [0.0, 10.0e-3, 21.0e-3, 33.0e-3];
        assert_eq!(limit(acceleration, &F50), y(Quantity::Acceleration));
        let jerk = [0.0, 0.0, 0.0, 20e-6];
        assert_eq!(limit(jerk, &F50), y(Quantity::Jerk));
        let less = [0.0, 0.0, 0.0, 9e-6];
        assert_eq!(limit(less, &F50), SpeedLimit::Between);
    }

    #[test]
    fn a_machine_stands_where_its_place_is_the_same() {
        let mut motion = AxisMotion::NONE;
        motion.begin(&Axes::repeat(3.0));
        motion.pass(&Axes::repeat(3.0), 1e-3);
        assert!(motion.stands());
        motion.pass(&Axes::repeat(3.1), 1e-3);
        assert!(!motion.stands());
    }
}
