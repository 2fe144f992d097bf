//! A straight line in nine axes.

use nalgebra::ArrayStorage;

use super::error::{GREATEST_LENGTH, ShapeError, check_coordinates};
use super::measure::{self, Measure};
use super::point::PathPoint;
use crate::axes::{AXIS_COUNT, Axes};

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// A straight line: all nine axes in proportion to the distance s that F counts.
#[derive(Clone, Copy, Debug)]
pub struct Line9 {
    start: Axes,
    end: Axes,
    /// dq/ds.
    direction: Axes,
    length: f64,
    rotary: bool,
}

impl Line9 {
    /// A line from zero to zero.
    pub(super) const VACANT: Self = Self {
        start: ZERO,
        end: ZERO,
        direction: ZERO,
        length: 0.0,
        rotary: false,
    };

    /// The line between two points, shapes (9).
    ///
    /// # Errors
    /// [`ShapeError::ZeroLength`] if nothing moves by more than [`measure::LEAST_DISTANCE`],
    /// [`ShapeError::NotFinite`], [`ShapeError::TooFar`].
    pub fn new(start: &Axes, end: &Axes) -> Result<Self, ShapeError> {
        check_coordinates(start.iter().chain(end))?;
        let displacement = end - start;
        if displacement.amax() > GREATEST_LENGTH {
            return Err(ShapeError::TooFar);
        }
        let (measure, length) = measure::of(&displacement).ok_or(ShapeError::ZeroLength)?;
        Ok(Self {
            start: *start,
            end: *end,
            direction: displacement / length,
            length,
            rotary: measure == Measure::Rotary,
        })
    }

    /// Greatest s: the distance in the line's measure.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Where it ends, as given.
    pub fn end(&self) -> Axes {
        self.end
    }

    /// Whether nothing but A B C moves.
    pub fn is_rotary(&self) -> bool {
        self.rotary
    }

    /// Whether an axis, 0 to 8, moves at all.
    pub fn moves(&self, axis: usize) -> bool {
        self.direction.get(axis).is_some_and(|rate| *rate != 0.0)
    }

    /// dq/ds, shape (9), the same everywhere.
    pub fn direction(&self) -> &Axes {
        &self.direction
    }

    /// The point at `s`, held within 0 and the length.
    pub fn position(&self, s: f64) -> Axes {
        // Counted from the nearer end, so that both ends are hit exactly.
        if s < 0.5 * self.length {
            self.start + self.direction * s.max(0.0)
        } else {
            self.end - self.direction * (self.length - s).max(0.0)
        }
    }

    /// The point at `s`, held within 0 and the length, with derivatives.
    pub fn point(&self, s: f64) -> PathPoint {
        PathPoint {
            position: self.position(s),
            first: self.direction,
            second: ZERO,
            third: ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_through_both_ends_exactly() {
        let start = Axes::from_fn(|i, _| 0.1 * i as f64);
        let end = Axes::from_fn(|i, _| 1.0 / (1.0 + i as f64));
        let line = Line9::new(&start, &end).expect("a line");
        assert_eq!(line.position(0.0), start);
        assert_eq!(line.position(line.length()), end);
        assert_eq!(line.position(-1.0), start);
        assert_eq!(line.position(line.length() + 1.0), end);
        let middle = line.point(0.5 * line.length());
        assert!((middle.position - (start + end) * 0.5).amax() < 1e-15);
        assert!((middle.first.fixed_rows::<3>(0).norm() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn only_rotary_axes_are_measured_in_degrees() {
        let mut end = Axes::zeros();
        end[3] = 30.0;
        end[4] = 40.0;
        let line = Line9::new(&Axes::zeros(), &end).expect("a line");
        assert!(line.is_rotary());
        assert_eq!(line.length(), 50.0);
    }

    #[test]
    fn what_is_no_line_is_refused() {
        let zero = Axes::zeros();
        assert_eq!(Line9::new(&zero, &zero).err(), Some(ShapeError::ZeroLength));
        let mut end = zero;
        end[0] = f64::NAN;
        assert_eq!(Line9::new(&zero, &end).err(), Some(ShapeError::NotFinite));
        let refused = |from: f64, to: f64| {
            let [start, end] = [from, to].map(|coordinate| {
                let mut axes = zero;
                axes[4] = coordinate;
                axes
            });
            Line9::new(&start, &end).err()
        };
        for far in [1.1e7, -1e200, f64::MAX] {
            assert_eq!(refused(0.0, far), Some(ShapeError::TooFar));
            assert_eq!(refused(far, 0.0), Some(ShapeError::TooFar));
        }
        assert_eq!(refused(1.1e9, 1.1e9 + 1.0), Some(ShapeError::TooFar));
        assert_eq!(refused(1e9 - 1.0, 1e9), None);
        assert_eq!(refused(0.0, 1e7), None);
    }
}
