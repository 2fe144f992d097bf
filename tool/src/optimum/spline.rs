//! The square of ds/dt as a quadratic spline over s.

use super::grid::Grid;

/// A linear function of three successive coefficients, of the interval at hand and its neighbours.
pub(crate) type Row = [f64; 3];

/// Interval `k` of the spline: b = (ds/dt)^2, the acceleration d2s/dt2 = b'/2, and its slope u, the
/// jerk of s over ds/dt, all as rows of the coefficients k, k + 1 and k + 2.
///
/// Each interval has a coefficient, and there is one more at both ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub length: f64,
    /// b at the left node, in the middle and at the right node.
    pub squared: [Row; 3],
    /// Acceleration there.
    pub acceleration: [Row; 3],
    pub slope: Row,
}

impl Interval {
    pub(crate) fn new(grid: &Grid, k: usize) -> Interval {
        let length = grid.length(k);
        let neighbour = |index: Option<usize>| {
            let index = index.filter(|&index| index < grid.intervals());
            index.map_or(length, |index| grid.length(index))
        };
        let (before, after) = (neighbour(k.checked_sub(1)), neighbour(Some(k + 1)));
        let (left, right) = (before + length, length + after);
        let squared_left = [length / left, before / left, 0.0];
        let squared_right = [0.0, after / right, length / right];
        let left = [-1.0 / left, 1.0 / left, 0.0];
        let right = [0.0, -1.0 / right, 1.0 / right];
        let slope = sum(&[(1.0 / length, right), (-1.0 / length, left)]);
        let half = 0.5 * length;
        Interval {
            length,
            squared: [
                squared_left,
                sum(&[
                    (1.0, squared_left),
                    (2.0 * half, left),
                    (half * half, slope),
                ]),
                squared_right,
            ],
            acceleration: [left, sum(&[(1.0, left), (half, slope)]), right],
            slope,
        }
    }

    /// Time to pass, s, exact; infinite if b is not positive at both ends.
    pub(crate) fn time(&self, coefficients: &[f64]) -> f64 {
        let [start, _, end] = self.squared.map(|row| value(&row, coefficients));
        if start <= 0.0 || end <= 0.0 {
            return f64::INFINITY;
        }
        let speeds = start.sqrt() + end.sqrt();
        let slope = value(&self.slope, coefficients);
        // b = start + 2 a x + u x^2: the integral of 1/sqrt(b).
        let y = slope * (self.length / speeds).powi(2);
        let factor = if y.abs() < 1e-4 {
            1.0 + y / 3.0 + y * y / 5.0
        } else if y > 0.0 {
            y.sqrt().min(1.0 - 1e-15).atanh() / y.sqrt()
        } else {
            (-y).sqrt().atan() / (-y).sqrt()
        };
        2.0 * self.length / speeds * factor
    }
}

/// Weighted sum of rows.
pub(crate) fn sum(terms: &[(f64, Row)]) -> Row {
    let mut sum = [0.0; 3];
    for (weight, row) in terms {
        for (sum, part) in sum.iter_mut().zip(row) {
            *sum += weight * part;
        }
    }
    sum
}

/// Value of a row with the three coefficients at the start of `coefficients`.
pub(crate) fn value(row: &Row, coefficients: &[f64]) -> f64 {
    row.iter().zip(coefficients).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_of_a_constant_jerk_in_s() {
        // b = 1 + 2 a x + u x^2 over x from 0 to 2, by the trapezoidal rule with many points.
        for (a, u) in [(0.3, 0.4), (0.3, -0.25), (-0.2, 0.05), (0.5, 0.0)] {
            let b = |x: f64| 1.0 + 2.0 * a * x + u * x * x;
            // Coefficients of the values themselves.
            let interval = Interval {
                length: 2.0,
                squared: [[1.0, 0.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0]],
                acceleration: [[0.0; 3]; 3],
                slope: [0.0, 0.0, 1.0],
            };
            let count = 20_000;
            let sum: f64 = (0..count)
                .map(|k| 1.0 / b(2.0 * (f64::from(k) + 0.5) / f64::from(count)).sqrt())
                .sum();
            let time = interval.time(&[1.0, b(2.0), u]);
            assert!((time - sum * 2.0 / f64::from(count)).abs() < 1e-7);
        }
    }
}
