//! What the machine does in a servo cycle, and what keeps it from being faster.

use super::sample::{Activity, Sample};
use crate::path::Position;
use crate::path::differences::Rates;
use crate::path::rates::Quantity;
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS};

/// From this share of the feed on the machine is at feed.
const AT_FEED: f64 = 0.995;

/// From this share on the limit that is used up most counts as the one that limits the machine: in
/// single periods even a plan of least time is below all of them, on its way from one to the other.
const REACHED: f64 = 0.5;

/// The same at feed, where mostly nothing but the feed limits.
const REACHED_AT_FEED: f64 = 0.9;

/// The feed that is below the greatest velocity by more than this is what the program asks for.
const BELOW_GREATEST: f64 = 0.999;

/// What the machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// As fast as the move asks for.
    AtFeed,
    /// Below feed: speeding up or braking.
    ChangingSpeed,
    /// Below feed: the direction changes, in a corner or a curve.
    Turning,
    /// Not at all.
    Standing,
}

impl Phase {
    /// How many there are.
    pub const COUNT: usize = 4;
    /// In the order in which they are shown.
    pub const ALL: [Phase; Phase::COUNT] = [
        Phase::AtFeed,
        Phase::ChangingSpeed,
        Phase::Turning,
        Phase::Standing,
    ];

    /// For the reader.
    pub fn name(self) -> &'static str {
        match self {
            Phase::AtFeed => "at feed",
            Phase::ChangingSpeed => "speeding up, braking",
            Phase::Turning => "in corners and curves",
            Phase::Standing => "standing",
        }
    }
}

/// What keeps the machine from being faster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// F of the program.
    Feed,
    /// The greatest velocity along the path: [TRAJ]MAX_LINEAR_VELOCITY.
    PathVelocity,
    /// A limit of an axis, by its index.
    Axis(usize, Quantity),
    /// A limit of a joint behind kinematics, by its number.
    Joint(usize, Quantity),
    /// On the way between two limits: all are used up by less than half.
    Between,
    /// G4.
    Dwell,
    /// The next move waits for the spindle.
    Spindle,
    /// Rest between moves.
    Rest,
    /// The program waits for the end of motion.
    Program,
}

impl Cause {
    /// How many there are.
    pub const COUNT: usize = 7 + 6 * AXIS_COUNT;

    /// Number, below [`Self::COUNT`].
    pub fn index(self) -> usize {
        match self {
            Cause::Feed => 0,
            Cause::PathVelocity => 1,
            Cause::Between => 2,
            Cause::Dwell => 3,
            Cause::Spindle => 4,
            Cause::Rest => 5,
            Cause::Program => 6,
            Cause::Axis(axis, quantity) => 7 + 3 * axis + quantity.order() - 1,
            Cause::Joint(joint, quantity) => Cause::Axis(AXIS_COUNT + joint, quantity).index(),
        }
    }

    /// The cause with a number.
    pub fn at(index: usize) -> Cause {
        match index {
            0 => Cause::Feed,
            1 => Cause::PathVelocity,
            2 => Cause::Between,
            3 => Cause::Dwell,
            4 => Cause::Spindle,
            5 => Cause::Rest,
            6 => Cause::Program,
            more => {
                let (place, quantity) = ((more - 7) / 3, Quantity::ALL[(more - 7) % 3]);
                match place.checked_sub(AXIS_COUNT) {
                    None => Cause::Axis(place, quantity),
                    Some(joint) => Cause::Joint(joint, quantity),
                }
            }
        }
    }

    /// For the reader.
    pub fn name(self) -> String {
        match self {
            Cause::Feed => "programmed feed".to_owned(),
            Cause::PathVelocity => "greatest path velocity".to_owned(),
            Cause::Axis(axis, quantity) => format!(
                "{} of {}",
                quantity.name(),
                AXIS_LETTERS.get(axis).copied().unwrap_or('?')
            ),
            Cause::Joint(joint, quantity) => format!("{} of joint {joint}", quantity.name()),
            Cause::Between => "between limits".to_owned(),
            Cause::Dwell => "dwell (G4)".to_owned(),
            Cause::Spindle => "waiting for the spindle".to_owned(),
            Cause::Rest => "rest between moves".to_owned(),
            Cause::Program => "waiting for the end of motion".to_owned(),
        }
    }
}

/// Limits of each axis in the order velocity, acceleration, jerk, shape (3, 9); infinite: none.
pub type AxisLimits = [Position; 3];

/// What is known of the running move.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// What the program asks for within what the axes allow, units per second.
    pub velocity: f64,
    /// What the axes allow.
    pub greatest_velocity: f64,
}

/// What happens in a cycle. `joints` are the rates of joints that have limits of their own, with these.
pub fn classify(
    sample: &Sample,
    rates: &Rates,
    asked: Option<Asked>,
    limits: &AxisLimits,
    joints: Option<(&Rates, &AxisLimits)>,
) -> (Phase, Cause) {
    // At rest the planner repeats its position to the last digit.
    let stands = rates.orders[0].iter().all(|v| *v == 0.0);
    if stands {
        let cause = match sample.activity {
            Activity::Dwells => Cause::Dwell,
            Activity::Waits => Cause::Program,
            Activity::Moves if sample.awaits_spindle => Cause::Spindle,
            Activity::Moves => Cause::Rest,
        };
        return (Phase::Standing, cause);
    }
    let (mut reached, axis, quantity) = strongest(rates, limits);
    let mut cause = Cause::Axis(axis, quantity);
    if let Some((share, joint, quantity)) = joints.map(|(rates, limits)| strongest(rates, limits))
        && share > reached
    {
        (reached, cause) = (share, Cause::Joint(joint, quantity));
    }
    let strongest = cause;
    if sample.share_of_feed >= AT_FEED {
        let cause = match asked {
            Some(asked) if sample.path_velocity < asked.velocity => Cause::PathVelocity,
            Some(asked) if asked.velocity < BELOW_GREATEST * asked.greatest_velocity => Cause::Feed,
            _ if reached >= REACHED_AT_FEED => strongest,
            _ => Cause::Feed,
        };
        return (Phase::AtFeed, cause);
    }
    let cause = if reached >= REACHED {
        strongest
    } else {
        Cause::Between
    };
    let phase = if turns(rates) {
        Phase::Turning
    } else {
        Phase::ChangingSpeed
    };
    (phase, cause)
}

/// The limit that is used up most: its share, the axis, the quantity.
fn strongest(rates: &Rates, limits: &AxisLimits) -> (f64, usize, Quantity) {
    let mut found = (0.0, 0, Quantity::Velocity);
    let orders = rates.orders.iter().zip(limits).zip(Quantity::ALL);
    for ((values, limits), quantity) in orders {
        for (axis, (value, limit)) in values.iter().zip(limits).enumerate() {
            let share = value.abs() / limit;
            if share > found.0 {
                found = (share, axis, quantity);
            }
        }
    }
    found
}

/// Whether more of the acceleration changes the direction than the speed.
fn turns(rates: &Rates) -> bool {
    let [velocity, acceleration, _] = &rates.orders;
    let dot = |a: &Position, b: &Position| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let square = dot(acceleration, acceleration);
    let along = dot(acceleration, velocity);
    let along_square = along * along / dot(velocity, velocity);
    square - along_square > along_square
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_causes_belong_together() {
        for index in 0..Cause::COUNT {
            assert_eq!(Cause::at(index).index(), index);
        }
    }

    const LIMITS: AxisLimits = [[100.0; 9], [1000.0; 9], [20_000.0; 9]];

    fn of(orders: [[f64; 2]; 3], share_of_feed: f64, asked: Asked) -> (Phase, Cause) {
        let mut rates = Rates::default();
        for (all, [x, y]) in rates.orders.iter_mut().zip(orders) {
            (all[0], all[1]) = (x, y);
        }
        let sample = Sample {
            time: 0.0,
            position: [0.0; 9],
            running: Some(0),
            share_of_feed,
            path_velocity: f64::INFINITY,
            awaits_spindle: false,
            activity: Activity::Moves,
            moves_done: 0,
            distance_to_go: 0.0,
        };
        classify(&sample, &rates, Some(asked), &LIMITS, None)
    }

    const SLOW: Asked = Asked {
        velocity: 20.0,
        greatest_velocity: 100.0,
    };
    const FAST: Asked = Asked {
        velocity: 100.0,
        greatest_velocity: 100.0,
    };

    #[test]
    fn feed_axis_acceleration_and_corner() {
        let x = |order| Cause::Axis(0, Quantity::ALL[order]);
        let at_feed = of([[20.0, 0.0], [0.0; 2], [0.0; 2]], 1.0, SLOW);
        assert_eq!(at_feed, (Phase::AtFeed, Cause::Feed));
        let rapid = of([[100.0, 0.0], [0.0; 2], [0.0; 2]], 1.0, FAST);
        assert_eq!(rapid, (Phase::AtFeed, x(0)));
        let starting = of([[5.0, 0.0], [1000.0, 0.0], [0.0; 2]], 0.25, SLOW);
        assert_eq!(starting, (Phase::ChangingSpeed, x(1)));
        let corner = of([[5.0, 5.0], [-990.0, 990.0], [0.0; 2]], 0.3, SLOW);
        assert_eq!(corner, (Phase::Turning, x(1)));
        let between = of([[5.0, 0.0], [400.0, 0.0], [9000.0, 0.0]], 0.3, SLOW);
        assert_eq!(between, (Phase::ChangingSpeed, Cause::Between));
        let still = of([[0.0; 2]; 3], 0.0, SLOW);
        assert_eq!(still, (Phase::Standing, Cause::Rest));
    }
}
