//! A jerk-limited run from rest to rest along one coordinate, in closed form.

/// Seven phases of constant jerk (some of them empty), from 0 to `length`, symmetric.
/// See Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 3.4.
#[derive(Clone, Debug)]
pub struct SCurve {
    /// Start of each phase, seconds, and the end of the last one.
    times: [f64; 8],
    /// Position, velocity, acceleration at the start of each phase.
    states: [[f64; 3]; 8],
    jerks: [f64; 7],
}

impl SCurve {
    /// The fastest run within these limits; an infinite jerk gives a trapezoid of velocity.
    pub fn new(length: f64, velocity: f64, acceleration: f64, jerk: f64) -> Self {
        let reach = |v: f64| v * 0.5 * ramp(v, acceleration, jerk).0;
        let mut peak = velocity;
        if 2.0 * reach(peak) > length {
            let (mut low, mut high) = (0.0, velocity);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if 2.0 * reach(middle) > length {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            peak = low;
        }
        let (ramp_time, jerk_time) = ramp(peak, acceleration, jerk);
        let constant = ramp_time - 2.0 * jerk_time;
        let cruise = (length - 2.0 * reach(peak)) / peak;
        let durations = [
            jerk_time, constant, jerk_time, cruise, jerk_time, constant, jerk_time,
        ];
        let top = peak / (ramp_time - jerk_time);
        let slope = if jerk_time > 0.0 {
            top / jerk_time
        } else {
            0.0
        };
        let jerks = [slope, 0.0, -slope, 0.0, -slope, 0.0, slope];
        let accelerations = [0.0, top, top, 0.0, 0.0, -top, -top];
        let mut curve = Self {
            times: [0.0; 8],
            states: [[0.0; 3]; 8],
            jerks,
        };
        let mut state = [0.0; 3];
        for phase in 0..7 {
            state[2] = accelerations[phase];
            curve.states[phase] = state;
            let t = durations[phase];
            state = advance(state, jerks[phase], t);
            curve.times[phase + 1] = curve.times[phase] + t;
        }
        curve.states[7] = [length, 0.0, 0.0];
        curve
    }

    pub fn duration(&self) -> f64 {
        self.times[7]
    }

    /// The instants at which the jerk jumps.
    pub fn breaks(&self) -> &[f64] {
        &self.times
    }

    /// Position and three derivatives at `t`; at a jump those of the later phase.
    pub fn at(&self, t: f64) -> [f64; 4] {
        if t >= self.times[7] {
            return [self.states[7][0], 0.0, 0.0, 0.0];
        }
        let phase = (0..7).rev().find(|&i| t >= self.times[i]).unwrap_or(0);
        let jerk = self.jerks[phase];
        let [s, v, a] = advance(self.states[phase], jerk, t - self.times[phase]);
        [s, v, a, jerk]
    }
}

/// Time from rest to `velocity`, and how long the jerk acts at either end of it.
fn ramp(velocity: f64, acceleration: f64, jerk: f64) -> (f64, f64) {
    let full = acceleration / jerk;
    if full * acceleration >= velocity {
        let t = (velocity / jerk).sqrt();
        (2.0 * t, t)
    } else {
        (velocity / acceleration + full, full)
    }
}

fn advance([s, v, a]: [f64; 3], j: f64, t: f64) -> [f64; 3] {
    [
        s + t * (v + t * (a / 2.0 + t * j / 6.0)),
        v + t * (a + t * j / 2.0),
        a + t * j,
    ]
}
