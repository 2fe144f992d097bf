//! The shortest stop along a path, from a state of motion.

use super::executed_path::ExecutedPath;
use super::grid::{Boundary, Grid};
use super::jerk_limited::least_time;
use super::limits::AxisLimits;

/// Time between two nodes, s.
const SPACING: f64 = 3e-3;

/// The distance of the stop is found to this share.
const ACCURACY: f64 = 0.01;

/// The state is known from positions only: the limits are taken this much wider, so that a machine
/// at its limits is within them. The stop that is found is none too long for it.
const WIDER: f64 = 1.01;

/// A motion to begin with: where it is, the square of ds/dt, and d2s/dt2.
pub(crate) type Start = (f64, f64, f64);

/// Least time to rest, s. The machine itself stopped after the distance `stopped` in s; `least` is a
/// distance that no stop undercuts. `None` if nothing was found, or if the path ends too early.
///
/// Each distance has its least time, the shorter it is the less, down to where no motion keeps the
/// limits: bisection between the distance that is possible and the one that is not.
pub(crate) fn shortest_stop(
    path: &ExecutedPath,
    limits: &AxisLimits,
    (start, squared, acceleration): Start,
    least: f64,
    stopped: f64,
) -> Option<f64> {
    let limits = AxisLimits {
        velocity: limits.velocity.map(|limit| limit * 2.0),
        acceleration: limits.acceleration.map(|limit| limit * WIDER),
        jerk: limits.jerk.map(|limit| limit * WIDER),
    };
    let moving = Boundary::Moving {
        squared,
        acceleration,
    };
    let stop = |distance: f64, like: Option<&Profile>| -> Option<(f64, Profile)> {
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
    let mut possible = stopped;
    let mut found = stop(possible, None);
    for longer in [1.02, 1.1, 1.3] {
        if found.is_none() {
            possible = stopped * longer;
            found = stop(possible, None);
        }
    }
    let (mut time, mut profile) = found?;
    let mut impossible = least.min(possible);
    while possible - impossible > ACCURACY * possible {
        let middle = 0.5 * (possible + impossible);
        match stop(middle, Some(&profile)) {
            Some((shorter, like)) => {
                time = time.min(shorter);
                (possible, profile) = (middle, like);
            }
            None => impossible = middle,
        }
    }
    Some(time)
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
