//! The shortest stop along a path, from a state of motion.

use super::executed_path::ExecutedPath;
use super::grid::{Boundary, Grid};
use super::jerk_limited::least_time;
use super::limits::PathLimits;

/// Time between two nodes, s.
const SPACING: f64 = 3e-3;

/// The distance of the stop is found to this share.
const ACCURACY: f64 = 0.01;

/// The state is known from positions only, and the machine keeps its limits in the mean of a servo
/// period: the limits are taken this much wider, the first of them that leaves a solution. The stop that
/// is found is none too long for the machine.
const WIDER: [f64; 5] = [1.01, 1.02, 1.04, 1.07, 1.1];

/// With limits wider by these factors there is a solution where the first guess was too far from one; it
/// is the guess for the next narrower ones.
const GUESSES: [f64; 4] = [1.06, 1.2, 1.7, 4.0];

/// A motion to begin with: where it is, the square of ds/dt, and d2s/dt2.
pub(crate) type Start = (f64, f64, f64);

/// Least time to rest, s. The machine itself stopped after the distance `stopped` in s; `least` is a
/// distance that no stop undercuts. `None` if nothing was found, or if the path ends too early.
///
/// Each distance has its least time, the shorter it is the less, down to where no motion keeps the
/// limits: bisection between the distance that is possible and the one that is not. Without a limit of
/// jerk the shortest stop brakes as hard as it can everywhere.
pub(crate) fn shortest_stop(
    path: &ExecutedPath,
    limits: &PathLimits,
    (start, squared, acceleration): Start,
    least: f64,
    stopped: f64,
) -> Option<f64> {
    if !limits.limit_jerk() {
        return WIDER
            .into_iter()
            .find_map(|wider| hardest_braking(path, limits, (start, squared), stopped, wider));
    }
    let moving = Boundary::Moving {
        squared,
        acceleration,
    };
    let solve = |distance: f64, wider: f64, like: Option<&Profile>| -> Option<(f64, Profile)> {
        let limits = PathLimits {
            velocity: limits.velocity.map(|limit| limit * 2.0),
            acceleration: limits.acceleration.map(|limit| limit * wider),
            jerk: limits.jerk.map(|limit| limit * wider),
        };
        let end = start + distance;
        if end > path.end() {
            return None;
        }
        let ends = (moving, Boundary::Rest);
        let mut grid = Grid::new(path, &limits, (start, end), ends, SPACING);
        // It brakes: the feed of the program is no limit any more.
        grid.caps.fill(1e3 * squared);
        if let Some(like) = like {
            grid.executed = grid
                .nodes
                .iter()
                .map(|node| like.at((node - start) / distance))
                .collect();
        }
        let optimum = least_time(&grid, &limits).ok()?;
        let shares = grid.nodes.iter().map(|node| (node - start) / distance);
        let profile = Profile {
            shares: shares.collect(),
            squared: optimum.squared,
        };
        Some((optimum.time, profile))
    };
    // Where the first guess is too far off, the solution with wider limits leads there.
    let stop = |distance: f64, most: f64, like: Option<&Profile>| -> Option<(f64, Profile)> {
        let direct = solve(distance, most, like);
        if direct.is_some() {
            return direct;
        }
        let (index, mut found) = GUESSES
            .iter()
            .enumerate()
            .find_map(|(index, wider)| Some((index, solve(distance, most * wider, like)?)))?;
        for wider in GUESSES[..index].iter().rev() {
            found = solve(distance, most * wider, Some(&found.1))?;
        }
        solve(distance, most, Some(&found.1))
    };
    // Where the machine came to rest, or a little behind: its rest is seen in whole periods.
    let mut tries = WIDER
        .into_iter()
        .flat_map(|most| [1.0, 1.02, 1.1, 1.3].map(|longer| (most, stopped * longer)));
    let (most, mut possible, (mut time, mut profile)) =
        tries.find_map(|(most, distance)| Some((most, distance, stop(distance, most, None)?)))?;
    let mut impossible = least.min(possible);
    while possible - impossible > ACCURACY * possible {
        let middle = 0.5 * (possible + impossible);
        match stop(middle, most, Some(&profile)) {
            Some((shorter, like)) => {
                time = time.min(shorter);
                (possible, profile) = (middle, like);
            }
            None => impossible = middle,
        }
    }
    Some(time)
}

/// Places at which the rows are held on the way that the machine took.
const STEPS: usize = 500;

/// Time to rest, s, with the least square of ds/dt everywhere that limits of acceleration leave which
/// are `wider` by this factor. `None` if they leave none, or it takes much longer than the machine.
fn hardest_braking(
    path: &ExecutedPath,
    limits: &PathLimits,
    (start, squared): (f64, f64),
    stopped: f64,
    wider: f64,
) -> Option<f64> {
    let length = stopped / STEPS as f64;
    let (mut now, mut time) = (squared, 0.0);
    for step in 0..2 * STEPS {
        let middle = start + (step as f64 + 0.5) * length;
        if middle > path.end() {
            return None;
        }
        let slope = path.slope(middle);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let axes = slope.first.iter().zip(&slope.second);
        for ((first, second), limit) in axes.zip(&limits.acceleration) {
            // |first (next - now) / (2 length) + second (next + now) / 2| <= limit
            let limit = limit * wider;
            let (change, curved) = (0.5 * first / length, 0.5 * second);
            let (of_now, of_next) = ((curved - change) * now, curved + change);
            if of_next.abs() * squared < 1e-12 * limit {
                continue;
            }
            let (one, other) = ((-limit - of_now) / of_next, (limit - of_now) / of_next);
            low = low.max(one.min(other));
            high = high.min(one.max(other));
        }
        if low > high {
            return None;
        }
        if low <= 0.0 {
            // At rest within this step: the square falls in a straight line.
            let share = now / (now - low);
            return Some(time + 2.0 * share * length / now.sqrt());
        }
        time += 2.0 * length / (now.sqrt() + low.sqrt());
        now = low;
    }
    None
}

/// Squares of ds/dt over the share of the distance.
struct Profile {
    shares: Vec<f64>,
    squared: Vec<f64>,
}

impl Profile {
    fn at(&self, share: f64) -> f64 {
        let last = self.shares.len() - 1;
        let next = self
            .shares
            .partition_point(|&known| known < share)
            .clamp(1, last);
        let (from, to) = (self.shares[next - 1], self.shares[next]);
        let along = ((share - from) / (to - from)).clamp(0.0, 1.0);
        self.squared[next - 1] + along * (self.squared[next] - self.squared[next - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::super::executed_path::PathSample;
    use super::super::limits::{AXES, COORDINATES, SpeedCap};
    use super::*;

    const PERIOD: f64 = 1e-3;
    const LIMITS: PathLimits = PathLimits {
        velocity: [100.0; COORDINATES],
        acceleration: [1000.0; COORDINATES],
        jerk: [20_000.0; COORDINATES],
    };

    /// Distances, mm, after each period of a stop from `speed`: jerk for the first number of periods,
    /// none for the second, jerk back for the third.
    fn stop_in(speed: f64, [brake, hold, release]: [usize; 3]) -> Vec<f64> {
        let [b, h, r] = [brake, hold, release].map(|periods| periods as f64 * PERIOD);
        let greatest = speed / (0.5 * b + h + 0.5 * r);
        let (mut at, mut velocity, mut acceleration) = (0.0, speed, 0.0);
        (0..brake + hold + release)
            .map(|k| {
                let jerk = if k < brake {
                    -greatest / b
                } else if k < brake + hold {
                    0.0
                } else {
                    greatest / r
                };
                at += PERIOD * (velocity + PERIOD * (acceleration / 2.0 + PERIOD * jerk / 6.0));
                velocity += PERIOD * (acceleration + PERIOD * jerk / 2.0);
                acceleration += PERIOD * jerk;
                at
            })
            .collect()
    }

    /// Periods of the shortest of these stops, all of which are tried, that keeps the limits on
    /// `path`, from the distance `start` on.
    fn brute_force(path: impl Fn(f64) -> [f64; 2], start: f64, speed: f64) -> usize {
        let keeps = |stop: &[f64]| {
            let before = [3.0, 2.0, 1.0, 0.0].map(|k| -k * speed * PERIOD);
            let behind = [stop[stop.len() - 1]; 3];
            let distances = before.iter().chain(stop).chain(&behind);
            let points: Vec<[f64; 2]> = distances.map(|d| path(start + d)).collect();
            points.windows(4).all(|p| {
                (0..2).all(|axis| {
                    let [a, b, c, d] = [0, 1, 2, 3].map(|k| p[k][axis]);
                    (d - 2.0 * c + b).abs() <= LIMITS.acceleration[axis] * PERIOD.powi(2)
                        && (d - 3.0 * c + 3.0 * b - a).abs() <= LIMITS.jerk[axis] * PERIOD.powi(3)
                })
            })
        };
        let all = |periods: usize| {
            (5..periods - 5).step_by(3).flat_map(move |brake| {
                (5..=periods - brake)
                    .step_by(3)
                    .map(move |release| [brake, periods - brake - release, release])
            })
        };
        (20..400)
            .find(|&periods| all(periods).any(|phases| keeps(&stop_in(speed, phases))))
            .expect("a stop")
    }

    /// The shortest stop, s, on a path that is known from a machine that stopped softly, in `soft`
    /// periods, and went on.
    fn found(path: impl Fn(f64) -> [f64; 2], start: f64, speed: f64, soft: usize) -> f64 {
        let run_in = 40;
        let mut distances: Vec<f64> = (0..=run_in)
            .map(|k| start - f64::from(run_in - k) * speed * PERIOD)
            .collect();
        let stop = stop_in(speed, [soft / 2, 0, soft / 2]);
        let rest = stop[stop.len() - 1];
        distances.extend(stop.iter().map(|d| start + d));
        distances.extend([start + rest; 50]);
        distances.extend(stop.iter().rev().map(|d| start + 2.0 * rest - d));
        let samples: Vec<PathSample> = distances
            .iter()
            .map(|&d| {
                let mut position = [0.0; AXES];
                position[..2].copy_from_slice(&path(d));
                PathSample::new(&position, None, SpeedCap::None)
            })
            .collect();
        let path = ExecutedPath::new(&samples, PERIOD, &LIMITS.velocity).expect("a path");
        let at = f64::from(run_in) * PERIOD;
        let state = path.state(at).expect("in motion");
        let stopped = path.parameter_at(at + soft as f64 * PERIOD) - state.0;
        shortest_stop(&path, &LIMITS, state, 0.2 * stopped, stopped).expect("a stop")
    }

    /// No stop that is possible is shorter than the one that is found, and that one is not far from
    /// the best of a simple kind.
    fn check(path: impl Fn(f64) -> [f64; 2], start: f64, speed: f64) {
        let simple = brute_force(&path, start, speed);
        for soft in [(simple + 2) & !1, (2 * simple) & !1] {
            let share = found(&path, start, speed, soft) / (simple as f64 * PERIOD);
            assert!(
                (0.8..=1.0).contains(&share),
                "{share} of {simple} ms, {soft}"
            );
        }
    }

    /// Time of the hardest stop that is found on the path of a machine that stopped half as hard as it
    /// may and went on.
    fn hardest(path: impl Fn(f64) -> [f64; 2], speed: f64) -> f64 {
        const RUN_IN: usize = 40;
        let periods = (2.0 * speed / LIMITS.acceleration[0] / PERIOD) as usize;
        let mean = |k: usize| speed * (k as f64 + 0.5) / periods as f64;
        let speeds = [speed; RUN_IN]
            .into_iter()
            .chain((0..periods).rev().map(mean))
            .chain([0.0; 20])
            .chain((0..periods).map(mean));
        let mut at = -speed * PERIOD * RUN_IN as f64;
        let samples: Vec<PathSample> = std::iter::once(0.0)
            .chain(speeds)
            .map(|speed| {
                at += speed * PERIOD;
                let mut position = [0.0; AXES];
                position[..2].copy_from_slice(&path(at));
                PathSample::new(&position, None, SpeedCap::None)
            })
            .collect();
        let path = ExecutedPath::new(&samples, PERIOD, &LIMITS.velocity).expect("a path");
        let rest = path.parameter_at((RUN_IN + periods) as f64 * PERIOD);
        let state = path.state(RUN_IN as f64 * PERIOD).expect("in motion");
        let limits = PathLimits {
            jerk: [f64::INFINITY; COORDINATES],
            ..LIMITS
        };
        shortest_stop(&path, &limits, state, 0.0, rest - state.0).expect("a stop")
    }

    #[test]
    fn without_a_limit_of_jerk() {
        let (speed, most) = (80.0, WIDER[0] * LIMITS.acceleration[0]);
        let line = hardest(|s| [s, 0.0], speed);
        assert!((line / (speed / most) - 1.0).abs() < 0.005, "{line}");
        // On a circle, from 45 degrees on, each axis brakes with what curvature leaves of it.
        let radius = 20.0;
        let angle = |s: f64| s / radius + std::f64::consts::FRAC_PI_4;
        let circle = hardest(
            |s| [radius * angle(s).sin(), radius * angle(s).cos()],
            speed,
        );
        let (mut s, mut v, mut time) = (0.0, speed, 0.0);
        while v > 0.0 {
            let (curved, (sine, cosine)) = (v * v / radius, angle(s).sin_cos());
            let braking = ((most - curved * sine) / cosine).min((most + curved * cosine) / sine);
            s += v * 1e-6;
            v -= braking * 1e-6;
            time += 1e-6;
        }
        assert!((circle / time - 1.0).abs() < 0.005, "{circle} {time}");
    }

    #[test]
    fn on_a_circle() {
        for (radius, speed) in [(5.0, 30.0), (1.0, 20.0), (20.0, 90.0)] {
            let circle = |s: f64| [radius * (s / radius).sin(), radius * (s / radius).cos()];
            for start in [0.0, 0.4 * radius] {
                check(circle, start, speed);
            }
        }
    }

    /// A corner: a hyperbola with both legs along the axes, by its arc length from the apex.
    fn corner(width: f64, s: f64) -> [f64; 2] {
        let slope = |x: f64| 1.0 / (1.0 + x * x / (x * x + width * width)).sqrt();
        let h = s / 24.0;
        let mut x = 0.0;
        for _ in 0..24 {
            let first = slope(x);
            let second = slope(x + 0.5 * h * first);
            let third = slope(x + 0.5 * h * second);
            let fourth = slope(x + h * third);
            x += h / 6.0 * (first + 2.0 * (second + third) + fourth);
        }
        let y = (x * x + width * width).sqrt();
        [(x + y) / 2.0_f64.sqrt(), (y - x) / 2.0_f64.sqrt()]
    }

    #[test]
    fn in_the_corner_of_a_zigzag() {
        for start in [-1.0, -0.5, 0.2] {
            check(|s| corner(1.0, s), start, 20.0);
        }
    }
}
