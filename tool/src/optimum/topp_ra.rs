//! The least time without a limit of jerk.
//!
//! Pham and Pham, "A new approach to time-optimal path parameterization based on reachability
//! analysis", IEEE Transactions on Robotics 34 (2018): backward over the nodes the greatest speeds
//! from which the end can be reached, then forward the greatest acceleration that stays below them.

use super::grid::{Boundary, Grid};
use super::limits::PathLimits;

/// Least time, s; `None` if the motion at the ends is not possible.
///
/// The rows of the accelerations are held in the middle of each interval, with the acceleration of
/// that interval: the error falls with the square of its length.
pub(crate) fn topp_ra(grid: &Grid, limits: &PathLimits) -> Option<f64> {
    let squared = |boundary: Boundary| match boundary {
        Boundary::Rest => 0.0,
        Boundary::Moving { squared, .. } => squared,
    };
    let (first, last) = grid.margins();
    // With the ends themselves as nodes.
    let mut nodes = Vec::with_capacity(grid.nodes.len() + 2);
    let count = grid.nodes.len();
    if first > 0.0 {
        nodes.push((grid.range.0, 0));
    }
    nodes.extend((0..count).map(|k| (grid.nodes[k], k)));
    if last > 0.0 {
        nodes.push((grid.range.1, count - 1));
    }
    let steps: Vec<Step> = nodes
        .windows(2)
        .map(|pair| Step {
            grid,
            limits,
            length: pair[1].0 - pair[0].0,
            nodes: (pair[0].1, pair[1].1),
        })
        .collect();
    let mut reachable = vec![squared(grid.end)];
    for step in steps.iter().rev() {
        let next = reachable[reachable.len() - 1];
        reachable.push(step.greatest_start(next)?);
    }
    reachable.reverse();
    let mut now = squared(grid.start);
    if now > reachable[0] * (1.0 + 1e-6) {
        return None;
    }
    let mut time = 0.0;
    for (step, &most) in steps.iter().zip(&reachable[1..]) {
        now = now.min(step.cap().0);
        let next = step.greatest_end(now, most)?;
        time += 2.0 * step.length / (now.sqrt() + next.sqrt());
        now = next;
    }
    Some(time)
}

/// An interval; b is the square of ds/dt, and its slope over 2 the acceleration.
struct Step<'a> {
    grid: &'a Grid,
    limits: &'a PathLimits,
    length: f64,
    nodes: (usize, usize),
}

impl Step<'_> {
    fn cap(&self) -> (f64, f64) {
        (self.grid.caps[self.nodes.0], self.grid.caps[self.nodes.1])
    }

    /// Squares at the end that can be reached from `start`: least and greatest, if there are any.
    fn ends(&self, start: f64) -> Option<(f64, f64)> {
        let (mut low, mut high) = (0.0_f64, self.cap().1);
        let rows = self.rows();
        for (at_start, at_end, limit) in rows {
            // |at_start . start + at_end . end| <= limit
            let offset = at_start * start;
            if at_end.abs() * self.cap().1.min(1e12) < 1e-12 * limit {
                if offset.abs() > limit * (1.0 + 1e-9) {
                    return None;
                }
                continue;
            }
            let (one, other) = ((-limit - offset) / at_end, (limit - offset) / at_end);
            low = low.max(one.min(other));
            high = high.min(one.max(other));
        }
        (low <= high).then_some((low, high))
    }

    /// Coefficients of both squares in the acceleration of an axis, and its limit.
    fn rows(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let (from, to) = self.nodes;
        // Between an end at rest and the node beside it the path is all but straight.
        let slope = if from == to {
            &self.grid.at_nodes[from]
        } else {
            &self.grid.at_middles[from]
        };
        let per_slope = 0.5 / self.length;
        let axes = slope.first.iter().zip(&slope.second);
        axes.zip(&self.limits.acceleration)
            .map(move |((first, second), &limit)| {
                let (change, curved) = (first * per_slope, 0.5 * second);
                (curved - change, curved + change, limit)
            })
    }

    /// Greatest square at the start from which one up to `most` can be reached at the end.
    fn greatest_start(&self, most: f64) -> Option<f64> {
        let possible = |start: f64| self.ends(start).is_some_and(|(low, _)| low <= most);
        let cap = self.cap().0.min(1e12);
        if possible(cap) {
            return Some(cap);
        }
        if !possible(0.0) {
            return None;
        }
        let (mut low, mut high) = (0.0, cap);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if possible(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    fn greatest_end(&self, start: f64, most: f64) -> Option<f64> {
        // The start lies on the edge of what is possible: rounding must not make it impossible.
        let ends = self.ends(start).or_else(|| self.ends(start * (1.0 - 1e-9)));
        ends.map(|(_, high)| high.min(most))
    }
}
