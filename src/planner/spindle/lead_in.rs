//! The start of a thread: from rest until the machine is in step.

use crate::speed::PathLimits;

/// Part of what the axes are able to do that the start uses: the rest is for the spindle's changes.
const PART: f64 = 0.85;

/// Shortest start, seconds.
const SHORTEST: f64 = 0.02;

/// The machine starts before the thread does, so that it is in step where the acceleration ends:
/// with the velocity of the thread after `span` turns, it has gone half of `span` by then.
///
/// Everything depends on the angle of the spindle only, so the start is in step too, and every
/// pass has the same one at the same speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadIn {
    /// Turns of the spindle in which the machine starts from rest.
    span: f64,
}

/// What the machine has to do where the spindle is in a [`LeadIn`], in turns instead of lengths,
/// with derivatives by turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    pub place: f64,
    pub first: f64,
    pub second: f64,
    pub third: f64,
}

impl Target {
    /// Velocity, acceleration and jerk of the place, in turns, where the spindle turns with `speed` turns a second and that
    /// changes by `rise` in each second.
    pub fn rates(&self, speed: f64, rise: f64) -> [f64; 3] {
        let square = speed * speed;
        [
            self.first * speed,
            self.second * square + self.first * rise,
            self.third * square * speed + 3.0 * self.second * speed * rise,
        ]
    }
}

impl LeadIn {
    /// In step at once.
    pub const NONE: Self = Self { span: 0.0 };

    /// For a spindle that turns with `speed` turns a second and a thread that moves by `per_turn`
    /// in each: as short as the limits along the path allow.
    pub fn new(speed: f64, per_turn: f64, limits: &PathLimits) -> Self {
        let velocity = speed * per_turn;
        // The velocity rises as 3 u^2 - 2 u^3: acceleration up to 1.5, jerk up to 6.
        let by_acceleration = 1.5 * velocity / (PART * limits.acceleration);
        let by_jerk = (6.0 * velocity / (PART * limits.jerk)).sqrt();
        let time = by_acceleration.max(by_jerk).max(SHORTEST);
        Self { span: speed * time }
    }

    /// Turns before the start of the thread at which the machine has to leave.
    pub fn lead(&self) -> f64 {
        0.5 * self.span
    }

    /// Where the machine has to be `turns` after the start of the thread (before it: negative).
    pub fn target(&self, turns: f64) -> Target {
        let u = if self.span > 0.0 {
            (turns + self.lead()) / self.span
        } else {
            1.0
        };
        if u >= 1.0 {
            return Target {
                place: turns,
                first: 1.0,
                second: 0.0,
                third: 0.0,
            };
        }
        let u = u.max(0.0);
        Target {
            place: self.span * u * u * u * (1.0 - 0.5 * u),
            first: u * u * (3.0 - 2.0 * u),
            second: 6.0 * u * (1.0 - u) / self.span,
            third: (6.0 - 12.0 * u) / (self.span * self.span),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: PathLimits = PathLimits {
        velocity: 100.0,
        acceleration: 1000.0,
        jerk: 20_000.0,
    };

    #[test]
    fn it_joins_the_thread_smoothly_and_within_the_limits() {
        for (speed, per_turn) in [(0.5, 0.5), (8.0, 1.5), (25.0, 3.5), (50.0, 0.25)] {
            let lead_in = LeadIn::new(speed, per_turn, &LIMITS);
            let end = lead_in.target(lead_in.lead() - 1e-9);
            assert!((end.place - lead_in.lead()).abs() < 1e-8);
            assert!((end.first - 1.0).abs() < 1e-8 && end.second.abs() < 1e-3);
            let start = lead_in.target(-lead_in.lead());
            assert_eq!((start.place, start.first), (0.0, 0.0));
            let step = lead_in.lead() * 1e-3;
            for n in -1100..1100 {
                let turns = f64::from(n) * step;
                let here = lead_in.target(turns);
                let next = lead_in.target(turns + step);
                let slope = (next.place - here.place) / step;
                assert!((slope - 0.5 * (here.first + next.first)).abs() < 1e-5);
                let factor = per_turn * speed * speed;
                assert!(here.second * factor < 0.86 * LIMITS.acceleration);
                assert!(here.third.abs() * factor * speed < 0.86 * LIMITS.jerk);
            }
        }
    }

    #[test]
    fn its_rates_are_those_of_the_place_while_the_spindle_becomes_faster() {
        let lead_in = LeadIn::new(8.0, 1.5, &LIMITS);
        let (rise, step) = (60.0, 1e-4);
        let at = |time: f64| {
            let turns = -0.7 * lead_in.lead() + (8.0 + 0.5 * rise * time) * time;
            lead_in.target(turns)
        };
        let [far_before, before, behind, far_behind] =
            [-2.0, -1.0, 1.0, 2.0].map(|steps| at(steps * step).place);
        let [velocity, acceleration, jerk] = at(0.0).rates(8.0, rise);
        let close = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-4;
        assert!(close((behind - before) / (2.0 * step), velocity));
        let second = (behind - 2.0 * at(0.0).place + before) / (step * step);
        assert!(close(second, acceleration), "{second} {acceleration}");
        let third = (far_behind - 2.0 * behind + 2.0 * before - far_before) / 2.0;
        let third = third / (step * step * step);
        assert!(close(third, jerk), "{third} {jerk}");
    }

    #[test]
    fn without_a_jerk_limit_it_has_a_length_still() {
        let limits = PathLimits {
            jerk: f64::INFINITY,
            ..LIMITS
        };
        assert!(LeadIn::new(10.0, 1.0, &limits).lead() >= 0.5 * 10.0 * SHORTEST);
    }
}
