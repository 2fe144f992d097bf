//! The least time with a limit of jerk: successive convex programs.
//!
//! With b = (ds/dt)^2, a = b'/2 and u = a' each axis has to keep
//!
//! ```text
//! |q' a + q'' b| <= A        |q' u + 3 q'' a + q''' b| <= J / sqrt(b)
//! ```
//!
//! The first is linear in b. The right side of the second is convex, so the tangent at the b of the
//! last round lies below it: the rows with the tangent are linear, and what fulfils them fulfils
//! the true ones. The time, convex in b, is taken to the second order. Each round is a quadratic
//! program, which clarabel solves (an interior-point method: Goulart and Chen, "Clarabel", 2024).
//! Every round is feasible, the time falls from round to round, and what the rounds converge to
//! fulfils the conditions of a local minimum of the problem itself.

use super::grid::{Boundary, Grid};
use super::limits::{COORDINATES, PathLimits};
use super::spline::{Interval, Row, sum, value};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, SupportedConeT,
    ZeroConeT,
};

/// Rounds at most.
const MOST_ROUNDS: usize = 40;

/// The rounds end when one of them gains less than this share of the time.
const CONVERGED: f64 = 2e-6;

/// So often the first guess is lowered if it is too far from what the limits allow.
const MOST_RETRIES: usize = 8;

/// b falls in a round to no less than this share.
const GREATEST_FALL: f64 = 0.15;

/// By how much more than its neighbour a coefficient may keep of the first guess.
const SHARE_GROWTH: f64 = 1.02;

/// Weights of left, middle and right in the integral over an interval (Simpson).
const SIMPSON: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];

/// The optimum on a grid.
#[derive(Clone, Debug)]
pub(crate) struct Optimum {
    /// s.
    pub time: f64,
    /// Square of ds/dt at the nodes.
    pub squared: Vec<f64>,
}

/// Why there is no optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum NoOptimum {
    /// No motion keeps the limits with these ends.
    #[error("no motion keeps the limits")]
    Infeasible,
    /// The solver did not come to its end.
    #[error("the solver gave up ({0:?})")]
    Solver(SolverStatus),
}

/// Least time on the grid.
pub(crate) fn least_time(grid: &Grid, limits: &PathLimits) -> Result<Optimum, NoOptimum> {
    let problem = Problem::new(grid, limits);
    let mut coefficients = problem.first_guess();
    let mut time = problem.time(&coefficients);
    let at_rest = problem.at_rest();
    let mut rounds = 0;
    let mut feasible = false;
    while rounds < MOST_ROUNDS {
        rounds += 1;
        let target = match problem.round(&coefficients) {
            // What the machine did may break a row by more than the round allows for.
            Err(NoOptimum::Infeasible) if at_rest && rounds <= MOST_RETRIES => {
                for coefficient in &mut coefficients {
                    *coefficient *= 0.5;
                }
                time = problem.time(&coefficients);
                continue;
            }
            target => target?,
        };
        // The first guess itself need not fulfil the rows.
        let first = !std::mem::replace(&mut feasible, true);
        // What lies between two points that fulfil the rows of the round fulfils them too.
        let mut share = 1.0;
        let (next, next_time) = loop {
            let next: Vec<f64> = coefficients
                .iter()
                .zip(&target)
                .map(|(from, to)| from + share * (to - from))
                .collect();
            let next_time = problem.time(&next);
            if next_time <= time || first || share < 1e-3 {
                break (next, next_time);
            }
            share *= 0.5;
        };
        if next_time > time && !first {
            break;
        }
        let gain = (time - next_time) / next_time;
        coefficients = next;
        time = next_time;
        if !first && gain < CONVERGED && share == 1.0 {
            break;
        }
    }
    Ok(Optimum {
        time,
        squared: problem.at_nodes(&coefficients),
    })
}

/// An axis at a place: its row as a share of its limit.
struct Share {
    row: Row,
    /// First of the three coefficients.
    interval: usize,
}

struct Problem<'a> {
    grid: &'a Grid,
    intervals: Vec<Interval>,
    /// Accelerations over their limits, at most 1.
    accelerations: Vec<Share>,
    /// Jerks over their limits and over ds/dt: times sqrt(b) in the middle at most 1.
    jerks: Vec<Share>,
    /// Greatest b at the nodes.
    caps: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(grid: &'a Grid, limits: &PathLimits) -> Self {
        let count = grid.intervals();
        let intervals: Vec<Interval> = (0..count).map(|k| Interval::new(grid, k)).collect();
        let mut accelerations = Vec::new();
        let mut jerks = Vec::new();
        for node in 0..=count {
            // The right end of the last interval, the left end of all others.
            let (k, side) = if node < count {
                (node, 0)
            } else {
                (count - 1, 2)
            };
            let interval = &intervals[k];
            let slope = &grid.at_nodes[node];
            for axis in 0..COORDINATES {
                let (first, second) = (slope.first[axis], slope.second[axis]);
                let limit = limits.acceleration[axis];
                let row = sum(&[
                    (first / limit, interval.acceleration[side]),
                    (second / limit, interval.squared[side]),
                ]);
                if limit.is_finite() && (first != 0.0 || second != 0.0) {
                    accelerations.push(Share { row, interval: k });
                }
            }
        }
        for (k, (interval, slope)) in intervals.iter().zip(&grid.at_middles).enumerate() {
            for axis in 0..COORDINATES {
                let limit = limits.jerk[axis];
                let parts = [slope.first[axis], slope.second[axis], slope.third[axis]];
                if !limit.is_finite() || parts == [0.0; 3] {
                    continue;
                }
                let row = sum(&[
                    (parts[0] / limit, interval.slope),
                    (3.0 * parts[1] / limit, interval.acceleration[1]),
                    (parts[2] / limit, interval.squared[1]),
                ]);
                jerks.push(Share { row, interval: k });
            }
        }
        let mut caps = grid.caps.clone();
        // From a rest to the node beside it the jerk is constant: t^3 = 6 s / j, ds/dt = j t^2 / 2.
        for (node, margin) in [(0, grid.margins().0), (count, grid.margins().1)] {
            let axes = grid.at_nodes[node].first.iter().zip(&limits.jerk);
            let jerk = axes
                .map(|(first, limit)| limit / first.abs().max(1e-300))
                .fold(f64::INFINITY, f64::min);
            if margin > 0.0 {
                let speed = 0.5 * (36.0 * jerk * margin * margin).cbrt();
                caps[node] = caps[node].min(speed * speed);
            }
        }
        Problem {
            grid,
            intervals,
            accelerations,
            jerks,
            caps,
        }
    }

    /// Rows that are zero: what the motion at both ends says, with the value they have to take.
    fn ends(&self) -> Vec<(usize, Row, f64)> {
        let last = self.intervals.len() - 1;
        let margins = self.grid.margins();
        let mut rows = Vec::new();
        for (boundary, k, side, margin) in [
            (self.grid.start, 0, 0, margins.0),
            (self.grid.end, last, 2, -margins.1),
        ] {
            let interval = &self.intervals[k];
            let (squared, acceleration) = (interval.squared[side], interval.acceleration[side]);
            match boundary {
                // Constant jerk from the rest: a = 2/3 b / distance.
                Boundary::Rest => {
                    let row = sum(&[(margin, acceleration), (-2.0 / 3.0, squared)]);
                    rows.push((k, row, 0.0));
                }
                Boundary::Moving {
                    squared: b,
                    acceleration: a,
                } => {
                    rows.push((k, squared, b));
                    rows.push((k, acceleration, a));
                }
            }
        }
        rows
    }

    /// What the machine did, slower by as much as is needed for all rows to hold.
    fn first_guess(&self) -> Vec<f64> {
        let executed = &self.grid.executed;
        let mut guess = vec![0.0];
        for k in 0..self.intervals.len() {
            let cap = self.caps[k].min(self.caps[k + 1]);
            guess.push((0.5 * (executed[k] + executed[k + 1])).min(cap));
        }
        guess.push(0.0);
        for (end, next, k, margin) in [
            (0, 1, 0, self.grid.margins().0),
            (
                guess.len() - 1,
                guess.len() - 2,
                self.intervals.len() - 1,
                self.grid.margins().1,
            ),
        ] {
            let h = self.intervals[k].length;
            guess[end] = if margin > 0.0 {
                guess[next] * (1.0 - 4.0 * h / (3.0 * margin + 2.0 * h))
            } else {
                guess[next]
            };
        }
        if !self.at_rest() {
            // A given motion cannot be slowed down.
            return guess;
        }
        let shares = self.shares(&guess);
        for (coefficient, share) in guess.iter_mut().zip(shares) {
            *coefficient *= 0.98 * share;
        }
        guess
    }

    /// Whether the path begins and ends at rest.
    fn at_rest(&self) -> bool {
        self.grid.start == Boundary::Rest && self.grid.end == Boundary::Rest
    }

    /// By how much each coefficient has to be lowered for the rows to hold: the least of what the
    /// rows nearby ask for, rising slowly away from them.
    fn shares(&self, guess: &[f64]) -> Vec<f64> {
        let mut shares = vec![1.0_f64; guess.len()];
        let mut lower = |k: usize, share: f64| {
            for place in &mut shares[k..k + 3] {
                *place = place.min(share);
            }
        };
        for row in &self.accelerations {
            lower(
                row.interval,
                1.0 / value(&row.row, &guess[row.interval..]).abs(),
            );
        }
        for row in &self.jerks {
            let coefficients = &guess[row.interval..];
            let squared = value(&self.intervals[row.interval].squared[1], coefficients);
            let jerk = value(&row.row, coefficients).abs() * squared.max(0.0).sqrt();
            lower(row.interval, jerk.powf(-2.0 / 3.0));
        }
        for k in 1..shares.len() {
            shares[k] = shares[k].min(shares[k - 1] * SHARE_GROWTH);
        }
        for k in (1..shares.len()).rev() {
            shares[k - 1] = shares[k - 1].min(shares[k] * SHARE_GROWTH);
        }
        shares
    }

    fn at_nodes(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut squared: Vec<f64> = self
            .intervals
            .iter()
            .enumerate()
            .map(|(k, interval)| value(&interval.squared[0], &coefficients[k..]))
            .collect();
        if let Some((k, interval)) = self.intervals.iter().enumerate().next_back() {
            squared.push(value(&interval.squared[2], &coefficients[k..]));
        }
        squared
    }

    /// Time of the whole path, s.
    fn time(&self, coefficients: &[f64]) -> f64 {
        let intervals = self.intervals.iter().enumerate();
        let inside: f64 = intervals
            .map(|(k, interval)| interval.time(&coefficients[k..]))
            .sum();
        let squared = self.at_nodes(coefficients);
        let (first, last) = self.grid.margins();
        let rest = |margin: f64, squared: Option<&f64>| {
            let squared = squared.copied().unwrap_or(0.0);
            if margin > 0.0 {
                3.0 * margin / squared.sqrt()
            } else {
                0.0
            }
        };
        inside + rest(first, squared.first()) + rest(last, squared.last())
    }

    /// The terms of the time: weight over sqrt(row).
    fn terms(&self) -> Vec<(usize, Row, f64)> {
        let last = self.intervals.len() - 1;
        let (first_margin, last_margin) = self.grid.margins();
        let mut terms = Vec::new();
        for (k, interval) in self.intervals.iter().enumerate() {
            for (row, weight) in interval.squared.iter().zip(SIMPSON) {
                terms.push((k, *row, weight * interval.length));
            }
        }
        terms.push((0, self.intervals[0].squared[0], 3.0 * first_margin));
        terms.push((last, self.intervals[last].squared[2], 3.0 * last_margin));
        terms
    }

    /// The quadratic program at these coefficients; its solution.
    fn round(&self, at: &[f64]) -> Result<Vec<f64>, NoOptimum> {
        let size = at.len();
        // The unknowns are the coefficients over these.
        let mut scale: Vec<f64> = at.iter().map(|coefficient| coefficient.abs()).collect();
        for k in 1..size - 1 {
            scale[k] = scale[k].max(0.2 * scale[k - 1].min(at[k + 1].abs()));
        }
        scale[0] = scale[1];
        scale[size - 1] = scale[size - 2];
        let (hessian, gradient) = self.objective(at, &scale);
        let mut rows = Rows::default();
        for (k, row, target) in self.ends() {
            let size = row
                .iter()
                .zip(&scale[k..])
                .map(|(a, b)| (a * b).abs())
                .sum::<f64>();
            rows.push(k, &sum(&[(1.0 / size, row)]), &scale, target / size);
        }
        let equalities = rows.count();
        for share in &self.accelerations {
            rows.push(share.interval, &share.row, &scale, 1.0);
            rows.push(share.interval, &share.row.map(|part| -part), &scale, 1.0);
        }
        for share in &self.jerks {
            let k = share.interval;
            let middle = self.intervals[k].squared[1];
            let squared = value(&middle, &at[k..]);
            let speed = squared.sqrt();
            // The tangent of 1/sqrt(b) at b = squared.
            for sign in [speed, -speed] {
                let row = sum(&[(sign, share.row), (0.5 / squared, middle)]);
                rows.push(k, &row, &scale, 1.5);
            }
        }
        for (k, interval) in self.intervals.iter().enumerate() {
            let last = k + 1 == self.intervals.len();
            let sides = if last { &[0, 1, 2][..] } else { &[0, 1] };
            for &side in sides {
                let row = interval.squared[side];
                let now = value(&row, &at[k..]);
                rows.push(k, &row.map(|part| -part / now), &scale, -GREATEST_FALL);
                if side != 1 {
                    let cap = self.caps[k + usize::from(side == 2)];
                    rows.push(k, &row.map(|part| part / cap), &scale, 1.0);
                }
            }
        }
        let cones: [SupportedConeT<f64>; 2] = [
            ZeroConeT(equalities),
            NonnegativeConeT(rows.count() - equalities),
        ];
        let settings = DefaultSettings {
            verbose: false,
            max_iter: 100,
            ..DefaultSettings::default()
        };
        let (matrix, right) = rows.matrix(size);
        let mut solver = DefaultSolver::new(&hessian, &gradient, &matrix, &right, &cones, settings)
            .map_err(|_| NoOptimum::Solver(SolverStatus::Unsolved))?;
        solver.solve();
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {}
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                return Err(NoOptimum::Infeasible);
            }
            other => return Err(NoOptimum::Solver(other)),
        }
        let scaled = solver.solution.x.iter().zip(&scale);
        Ok(scaled.map(|(x, scale)| x * scale).collect())
    }

    /// Second and first derivatives of the time at these coefficients, for the scaled unknowns.
    fn objective(&self, at: &[f64], scale: &[f64]) -> (CscMatrix<f64>, Vec<f64>) {
        let size = at.len();
        // Upper triangle: the diagonal and two beside it.
        let mut bands = vec![[0.0; 3]; size];
        let mut gradient = vec![0.0; size];
        for (k, row, weight) in self.terms() {
            let squared = value(&row, &at[k..]);
            let first = -0.5 * weight / (squared * squared.sqrt());
            let second = -1.5 * first / squared;
            let parts: [f64; 3] = std::array::from_fn(|i| row[i] * scale[k + i]);
            for i in 0..3 {
                // The model is a function of the coefficients themselves, not of their changes.
                gradient[k + i] += parts[i] * (first - second * squared);
                for j in i..3 {
                    bands[k + j][j - i] += second * parts[i] * parts[j];
                }
            }
        }
        let mut starts = vec![0];
        let (mut indices, mut values) = (Vec::new(), Vec::new());
        for (column, band) in bands.iter().enumerate() {
            for offset in (0..=2.min(column)).rev() {
                indices.push(column - offset);
                values.push(band[offset]);
            }
            starts.push(indices.len());
        }
        (
            CscMatrix::new(size, size, starts, indices, values),
            gradient,
        )
    }
}

/// Rows of inequalities: row . x <= right side.
#[derive(Default)]
struct Rows {
    entries: Vec<(usize, [f64; 3])>,
    right: Vec<f64>,
}

impl Rows {
    fn push(&mut self, first: usize, row: &Row, scale: &[f64], right: f64) {
        self.entries
            .push((first, std::array::from_fn(|i| row[i] * scale[first + i])));
        self.right.push(right);
    }

    fn count(&self) -> usize {
        self.right.len()
    }

    /// As compressed columns.
    fn matrix(self, columns: usize) -> (CscMatrix<f64>, Vec<f64>) {
        let mut starts = vec![0; columns + 1];
        for (first, row) in &self.entries {
            for (i, part) in row.iter().enumerate() {
                starts[first + i + 1] += usize::from(*part != 0.0);
            }
        }
        for column in 0..columns {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut indices = vec![0; starts[columns]];
        let mut values = vec![0.0; starts[columns]];
        for (line, (first, row)) in self.entries.iter().enumerate() {
            for (i, &part) in row.iter().enumerate() {
                if part != 0.0 {
                    let place = &mut next[first + i];
                    indices[*place] = line;
                    values[*place] = part;
                    *place += 1;
                }
            }
        }
        let matrix = CscMatrix::new(self.right.len(), columns, starts, indices, values);
        (matrix, self.right)
    }
}
