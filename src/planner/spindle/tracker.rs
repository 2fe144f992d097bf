//! Angle and speed of a spindle, from what an encoder counts.

use crate::planner::inputs::SpindleInputs;

/// Rate at which the past is forgotten, 1 per second. A speed that is constant or changes steadily is
/// followed without a lag.
///
/// With 400 counts in a turn the speed is told to 2 % at 440 turns a minute (to 1 % with a rate of
/// 100, to 3 % with 200), and the angle to half a count. Where the spindle begins to accelerate the
/// error of the thread grows with the inverse of the rate.
const FORGETTING: f64 = 150.0;

/// Servo periods by which LinuxCNC's interpolator between planner and joints is late, besides the
/// one that the planner's step takes.
const DELAY: f64 = 1.0;

/// An angle further than this from where it is expected, turns, was set anew.
const JUMP: f64 = 0.2;

/// No spindle changes its speed faster than this, turns a second squared: in long servo periods it may be far from
/// where it is expected all the same.
const FASTEST_CHANGE: f64 = 1000.0;

/// Angle, speed and acceleration of a spindle by a fading-memory filter of third order (Zarchan and
/// Musoff, Fundamentals of Kalman Filtering, chapter 7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracker {
    turns: f64,
    /// Turns a second.
    speed: f64,
    /// Turns a second squared.
    acceleration: f64,
    /// Speeds of the last periods, the latest first.
    past: [f64; 4],
    /// Seconds that what is commanded is late.
    delay: f64,
    /// The last angle that was a number.
    measured: f64,
    awaited_index: bool,
    jumped: bool,
    begun: bool,
}

impl Tracker {
    pub const NEW: Self = Self {
        turns: 0.0,
        speed: 0.0,
        acceleration: 0.0,
        past: [0.0; 4],
        delay: 0.0,
        measured: 0.0,
        awaited_index: false,
        jumped: false,
        begun: false,
    };

    /// Takes what was measured in a servo period of `period` seconds.
    pub fn update(&mut self, measured: &SpindleInputs, period: f64) {
        let index_came = self.awaited_index && !measured.awaits_index;
        let by_index = index_came || measured.awaits_index;
        self.awaited_index = measured.awaits_index;
        self.jumped = false;
        let is_number = measured.turns.is_finite();
        if !(period > 0.0 && (is_number || self.begun)) {
            return;
        }
        // What is no number is as good as an encoder that does not count.
        let turns = if is_number {
            measured.turns
        } else {
            self.measured
        };
        let expected = self.turns + period * (self.speed + 0.5 * period * self.acceleration);
        let missing = turns - expected;
        self.measured = turns;
        self.delay = DELAY * period;
        if !self.begun || !missing.is_finite() {
            *self = Self {
                turns,
                measured: turns,
                speed: if measured.speed.is_finite() {
                    measured.speed
                } else {
                    0.0
                },
                awaited_index: measured.awaits_index,
                begun: true,
                ..Self::NEW
            };
            self.past = [self.speed; 4];
            return;
        }
        if index_came || missing.abs() > JUMP.max(0.5 * self.speed.abs() * period) {
            self.jumped = !by_index && missing.abs() > FASTEST_CHANGE * period * period;
            // The encoder set its count anew at the index, one or two periods ago.
            let [.., before] = self.past;
            self.turns = turns;
            self.speed = before;
            self.acceleration = 0.0;
        } else {
            let theta = (-FORGETTING * period).exp();
            let rest = 1.0 - theta;
            let expected_speed = self.speed + period * self.acceleration;
            self.turns = expected + (1.0 - theta * theta * theta) * missing;
            self.speed = expected_speed + 1.5 * rest * rest * (1.0 + theta) * missing / period;
            self.acceleration += rest * rest * rest * missing / (period * period);
        }
        let [first, second, third, _] = self.past;
        self.past = [self.speed, first, second, third];
    }

    /// Angle, turns, as it will be when the machine is where it is commanded to be now.
    pub fn turns(&self) -> f64 {
        self.turns + self.delay * (self.speed + 0.5 * self.delay * self.acceleration)
    }

    /// Turns a second, then.
    pub fn speed(&self) -> f64 {
        self.speed + self.delay * self.acceleration
    }

    /// Turns a second squared.
    pub fn acceleration(&self) -> f64 {
        self.acceleration
    }

    /// Whether the angle has just become one that no spindle can have turned to, and no index was awaited that may have
    /// set it anew.
    pub fn has_jumped(&self) -> bool {
        self.jumped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1e-3;

    fn at(turns: f64, awaits_index: bool) -> SpindleInputs {
        SpindleInputs {
            turns,
            awaits_index,
            ..SpindleInputs::STANDSTILL
        }
    }

    #[test]
    fn a_steady_spindle_is_followed_without_a_lag() {
        for speed in [0.1, 8.0, -50.0] {
            let mut tracker = Tracker::NEW;
            for n in 0..400 {
                tracker.update(&at(3.0 + speed * PERIOD * f64::from(n), false), PERIOD);
            }
            assert!((tracker.turns() - 3.0 - speed * PERIOD * (399.0 + DELAY)).abs() < 1e-9);
            assert!((tracker.speed() / speed - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_coarse_encoder_is_smoothed() {
        let (mut tracker, speed) = (Tracker::NEW, 7.3);
        for n in 0..3000 {
            let turns = speed * PERIOD * f64::from(n);
            let late = speed * PERIOD * DELAY;
            tracker.update(&at((turns * 400.0).floor() / 400.0, false), PERIOD);
            if n > 300 {
                // half a step of the encoder is its mean
                assert!((tracker.turns() - late - turns + 0.5 / 400.0).abs() < 0.5 / 400.0);
                let off = (tracker.speed() - speed).abs();
                assert!(off < 0.03 * speed, "{off}");
            }
        }
    }

    #[test]
    fn the_index_sets_the_angle_and_leaves_the_speed() {
        for offset in [0.03, 0.15, 0.8, 1234.5] {
            let (mut tracker, speed) = (Tracker::NEW, 20.0);
            for n in 0..500 {
                tracker.update(&at(offset + speed * PERIOD * f64::from(n), n > 300), PERIOD);
            }
            let turns = |n: i32| speed * PERIOD * (f64::from(n) + 0.4);
            // the count is set one period before the motion controller hears of it
            tracker.update(&at(turns(0), true), PERIOD);
            for n in 1..5 {
                tracker.update(&at(turns(n), false), PERIOD);
                assert!(
                    (tracker.speed() - speed).abs() < 1e-6,
                    "{offset}: {tracker:?}"
                );
                assert!((tracker.turns() - turns(n) - speed * PERIOD * DELAY).abs() < 1e-6);
            }
        }
    }
}
