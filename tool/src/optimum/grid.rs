//! The nodes of the optimisation, and the shape of the path at them.

use super::executed_path::{ExecutedPath, Slope};
use super::limits::{Coordinates, PathLimits};

/// The motion at an end of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Boundary {
    /// At rest, without acceleration.
    Rest,
    /// In motion: square of ds/dt, and d2s/dt2.
    Moving { squared: f64, acceleration: f64 },
}

/// Nodes along a path. At an end at rest the first node lies a little inside: between it and the
/// end the motion is a single stretch of constant jerk.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Parameters of the nodes, n + 1.
    pub nodes: Vec<f64>,
    /// Shape at the nodes, n + 1.
    pub at_nodes: Vec<Slope>,
    /// Shape in the middle of the intervals, n.
    pub at_middles: Vec<Slope>,
    /// Greatest square of ds/dt at the nodes, n + 1.
    pub caps: Vec<f64>,
    /// What the machine did: square of ds/dt at the nodes.
    pub executed: Vec<f64>,
    pub start: Boundary,
    pub end: Boundary,
    /// Parameters of both ends.
    pub range: (f64, f64),
}

/// Time between two nodes of a motion that the machine did in `duration` seconds, s.
pub(crate) fn spacing(duration: f64) -> f64 {
    (duration / 200.0).min(2e-3)
}

/// Nodes are not further apart than this share of the distance to where they are closer.
const GRADING: f64 = 0.4;

impl Grid {
    /// Nodes between two parameters, about as far apart as the machine came in `spacing` seconds,
    /// or as it can come from a rest.
    pub(crate) fn new(
        path: &ExecutedPath,
        limits: &PathLimits,
        (from, to): (f64, f64),
        (start, end): (Boundary, Boundary),
        spacing: f64,
    ) -> Grid {
        let steps = Steps::new(path, limits, (from, to), (start, end), spacing);
        let mut nodes = steps.nodes();
        if start == Boundary::Rest {
            nodes.remove(0);
        }
        if end == Boundary::Rest {
            nodes.pop();
        }
        let at_nodes: Vec<Slope> = nodes.iter().map(|&s| path.slope(s)).collect();
        let at_middles = nodes
            .windows(2)
            .map(|pair| path.slope(0.5 * (pair[0] + pair[1])))
            .collect();
        let caps = nodes
            .iter()
            .zip(&at_nodes)
            .map(|(&s, slope)| {
                let axes = slope.first.iter().zip(&limits.velocity);
                let by_axes = axes.map(|(first, limit)| limit / first.abs().max(1e-300));
                by_axes.fold(path.cap(s, slope), f64::min).powi(2)
            })
            .collect();
        let executed = nodes.iter().map(|&s| steps.executed(path, s)).collect();
        Grid {
            nodes,
            at_nodes,
            at_middles,
            caps,
            executed,
            start,
            end,
            range: (from, to),
        }
    }

    /// Number of intervals.
    pub(crate) fn intervals(&self) -> usize {
        self.at_middles.len()
    }

    /// Length of interval `k`.
    pub(crate) fn length(&self, k: usize) -> f64 {
        self.nodes[k + 1] - self.nodes[k]
    }

    /// Distance of the outermost nodes from both ends: 0 unless they are at rest.
    pub(crate) fn margins(&self) -> (f64, f64) {
        let first = self.nodes.first().map_or(0.0, |node| node - self.range.0);
        let last = self.nodes.last().map_or(0.0, |node| self.range.1 - node);
        (first, last)
    }
}

/// How far apart nodes may be, at the positions of the path.
struct Steps {
    at: Vec<f64>,
    step: Vec<f64>,
    /// Starts from the rests at both ends.
    first: Option<Start>,
    last: Option<Start>,
}

impl Steps {
    fn new(
        path: &ExecutedPath,
        limits: &PathLimits,
        (from, to): (f64, f64),
        (start, end): (Boundary, Boundary),
        spacing: f64,
    ) -> Steps {
        let inside = path.parameters().iter().copied();
        let mut at: Vec<f64> = inside.filter(|&s| s > from && s < to).collect();
        // Close to a rest the positions are too far apart to say how far apart nodes may be.
        for (boundary, end, inward) in [(start, from, 1.0), (end, to, -1.0)] {
            if boundary == Boundary::Rest {
                at.extend((0..60).map(|n| end + inward * (to - from) * 0.5 * 0.8_f64.powi(n)));
            }
        }
        at.push(from);
        at.push(to);
        at.sort_unstable_by(f64::total_cmp);
        at.dedup();
        let profile = |boundary: Boundary, end: f64| {
            (boundary == Boundary::Rest).then(|| Start::new(path, limits, end, spacing))
        };
        let (first, last) = (profile(start, from), profile(end, to));
        let mut step: Vec<f64> = at
            .iter()
            .map(|&s| {
                let mut step = (path.speed(s) * spacing).max((to - from) * 1e-7);
                if let Some(rest) = &first {
                    step = step.min(rest.step(s - from));
                }
                if let Some(rest) = &last {
                    step = step.min(rest.step(to - s));
                }
                step.min((to - from) / 40.0)
            })
            .collect();
        for k in 1..at.len() {
            step[k] = step[k].min(step[k - 1] + GRADING * (at[k] - at[k - 1]));
        }
        for k in (1..at.len()).rev() {
            step[k - 1] = step[k - 1].min(step[k] + GRADING * (at[k] - at[k - 1]));
        }
        Steps {
            at,
            step,
            first,
            last,
        }
    }

    /// What the machine did at `s`: square of ds/dt. Close to a rest the positions are too far apart
    /// to say.
    fn executed(&self, path: &ExecutedPath, s: f64) -> f64 {
        let (from, to) = (self.at[0], self.at[self.at.len() - 1]);
        let mut squared = path.speed(s).powi(2);
        if let Some(rest) = &self.first {
            squared = squared.min(rest.squared(s - from));
        }
        if let Some(rest) = &self.last {
            squared = squared.min(rest.squared(to - s));
        }
        squared
    }

    /// Nodes that are evenly spaced in the number of steps.
    fn nodes(&self) -> Vec<f64> {
        let mut count = vec![0.0];
        for (at, step) in self.at.windows(2).zip(self.step.windows(2)) {
            let (one, other) = (step[0], step[1]);
            // The integral of 1/step, with the step linear in between.
            let ratio = other / one;
            let mean = if (ratio - 1.0).abs() < 1e-6 {
                one
            } else {
                (other - one) / ratio.ln()
            };
            count.push(count[count.len() - 1] + (at[1] - at[0]) / mean);
        }
        let total = count[count.len() - 1];
        let intervals = total.ceil().max(8.0);
        let mut nodes = vec![self.at[0]];
        let mut k = 0;
        for node in 1..intervals as usize {
            let wanted = total * node as f64 / intervals;
            while count[k + 1] < wanted {
                k += 1;
            }
            let share = (wanted - count[k]) / (count[k + 1] - count[k]);
            let ratio = self.step[k + 1] / self.step[k];
            // Inverts the integral above.
            let along = if (ratio - 1.0).abs() < 1e-6 {
                share
            } else {
                (ratio.powf(share) - 1.0) / (ratio - 1.0)
            };
            nodes.push(self.at[k] + along * (self.at[k + 1] - self.at[k]));
        }
        nodes.push(self.at[self.at.len() - 1]);
        nodes
    }
}

/// The start from a rest: constant jerk.
struct Start {
    jerk: f64,
    spacing: f64,
}

impl Start {
    fn new(path: &ExecutedPath, limits: &PathLimits, end: f64, spacing: f64) -> Start {
        let first = path.slope(end).first;
        let along = |limits: &Coordinates| {
            let axes = limits.iter().zip(&first);
            axes.map(|(limit, first)| limit / first.abs().max(1e-300))
                .fold(f64::INFINITY, f64::min)
        };
        // Without a limit of jerk the acceleration is there within a step.
        let jerk = along(&limits.jerk).min(along(&limits.acceleration) / spacing);
        Start { jerk, spacing }
    }

    /// Distance between the places of two moments, the second of them this far from the rest. The
    /// closer to the rest, the less time is between them: there the spline is least like the motion.
    fn step(&self, distance: f64) -> f64 {
        let time = (6.0 * distance / self.jerk).cbrt();
        let least = self.spacing / 8.0;
        let first = self.jerk * least.powi(3) / 6.0;
        let between = (0.2 * time).clamp(least, self.spacing);
        (0.5 * self.jerk * time * time * between).max(first)
    }

    /// Square of ds/dt at this distance from the rest.
    fn squared(&self, distance: f64) -> f64 {
        (0.5 * (36.0 * self.jerk * distance * distance).cbrt()).powi(2)
    }
}
