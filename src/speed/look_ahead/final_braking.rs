//! How long it is until the braking to the rest at the end of the plan.

use super::frozen::Frozen;
use super::spline::Spline;

/// Seconds to the final braking that are counted whether anybody asks or not.
const SEEN: f64 = 0.15;

/// The final braking as seen from the frozen part.
#[derive(Clone, Copy, Debug)]
pub(super) struct FinalBraking {
    start: usize,
    /// Seconds from the frozen part until then, [`SEEN`] and no more of them.
    seconds: f64,
    /// Up to this interval its seconds are counted in that.
    counted: usize,
}

impl FinalBraking {
    pub const AT_REST: Self = Self {
        start: 1,
        seconds: 0.0,
        counted: 0,
    };

    /// The interval in which it begins.
    pub fn start(&self) -> usize {
        self.start
    }

    /// Whether it begins less than `seconds` behind the frozen part. More than [`SEEN`] take longer to be found out.
    pub fn begins_within(&self, plan: &Spline, seconds: f64) -> bool {
        let mut sum = self.seconds;
        for interval in self.counted..self.start {
            if sum >= seconds {
                break;
            }
            sum += plan.duration(interval);
        }
        sum < seconds
    }

    /// Looks how long it is until then: goes on from where it looked before.
    pub fn look(&mut self, plan: &Spline) {
        while self.counted < self.start && self.seconds < SEEN {
            self.seconds += plan.duration(self.counted);
            self.counted += 1;
        }
    }

    /// The same anew: the plan behind the frozen part has changed.
    pub fn look_anew(&mut self, plan: &Spline, frozen: &Frozen) {
        self.seconds = 0.0;
        self.counted = frozen.next();
        self.look(plan);
    }

    /// The frozen part has grown by an interval of this `duration`, seconds.
    pub fn come_nearer(&mut self, plan: &Spline, frozen: &Frozen, duration: f64) {
        if frozen.next() < self.counted {
            self.seconds -= duration;
        } else {
            self.look_anew(plan, frozen);
        }
    }

    /// Behind interval `base` the plan is another one.
    pub fn replan(&mut self, plan: &Spline, frozen: &Frozen, base: usize) {
        self.start = plan.final_braking(base + 1);
        self.look_anew(plan, frozen);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_comes_nearer_as_the_plan_is_frozen() {
        let mut plan = Box::new(Spline::NONE);
        for (k, b) in [100.0, 100.0, 100.0, 100.0, 100.0, 80.0, 60.0, 40.0]
            .into_iter()
            .enumerate()
        {
            plan.at_mut(k).coefficient = b;
        }
        plan.last = 6;
        let mut frozen = Frozen::NOTHING;
        let mut braking = FinalBraking::AT_REST;
        braking.replan(&plan, &frozen, 0);
        // From there on coefficients fall; a tenth of a second an interval until then.
        assert_eq!(braking.start(), 4);
        let begins = [
            (0.29, 0.31),
            (0.29, 0.31),
            (0.19, 0.21),
            (0.09, 0.11),
            (-1.0, 1e-9),
        ];
        for (not_within, within) in begins {
            let begins_within = |seconds| braking.begins_within(&plan, seconds);
            assert!(!begins_within(not_within) && begins_within(within));
            let segment = frozen.freeze(&plan);
            braking.come_nearer(&plan, &frozen, segment.duration);
            braking.look(&plan);
        }
    }
}
