//! What the limits of the axes are at a place of the path.

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes};
use crate::lanes::{Lanes, QUAD_LANES, ZEROS};

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// The rows of all axes at a place of the path, in units of J.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// q' / J, shape (9).
    pub first: Axes,
    /// 3 q'' / J, shape (9).
    pub second: Axes,
    /// q''' / J, shape (9).
    pub third: Axes,
    /// The three in single precision.
    pub lanes: [Lanes; 3],
    pub cap: Cap,
    /// Rows of all other axes are 0.
    pub axes: MovingAxes,
}

impl Sample {
    pub const NONE: Self = Self {
        first: ZERO,
        second: ZERO,
        third: ZERO,
        lanes: [ZEROS; 3],
        cap: Cap::NONE,
        axes: MovingAxes::NONE,
    };

    /// Whether the path gave numbers and a speed to run at.
    pub fn is_sound(&self) -> bool {
        let sum = self.first.sum() + self.second.sum() + self.third.sum();
        sum.is_finite() && self.cap.programmed > 0.0 && self.cap.greatest > 0.0
    }

    /// The radius of the curve as the rows see it: |q'| / |q''| in s, infinite on a line.
    pub fn radius(&self) -> f64 {
        3.0 * self.first.norm_squared().sqrt() / self.second.norm_squared().sqrt()
    }
}

/// What a [`Sample`] says of curvature alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curving {
    /// 3 q'' / J, shape (9).
    pub second: Axes,
    /// q''' / J, shape (9).
    pub third: Axes,
}

/// The caps of v^2 at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    /// What the program asks for at 100 %.
    pub programmed: f64,
    /// What neither override nor axes exceed.
    pub greatest: f64,
}

impl Cap {
    pub const NONE: Self = Self {
        programmed: 0.0,
        greatest: 0.0,
    };

    #[cfg(test)]
    pub fn of(programmed: f64, greatest: f64) -> Self {
        Self {
            programmed,
            greatest,
        }
    }

    /// What two caps both allow.
    pub fn least(&self, other: &Self) -> Self {
        Self {
            programmed: self.programmed.min(other.programmed),
            greatest: self.greatest.min(other.greatest),
        }
    }

    /// The cap while those of the program are raised by sqrt(`raise_squared`).
    #[inline]
    pub fn raised(&self, raise_squared: f64) -> f64 {
        let programmed = self.programmed * raise_squared;
        // A plain compare is one instruction.
        if programmed < self.greatest {
            programmed
        } else {
            self.greatest
        }
    }
}

/// The axes that move at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MovingAxes(u16);

impl MovingAxes {
    pub const NONE: Self = Self(0);

    /// Those that have a first or a second derivative by the path, shapes (9), that is not 0.
    #[inline]
    pub fn of(first: &Axes, second: &Axes) -> Self {
        // All bits but the sign at once: no branches, of which there would be one for each axis.
        let moves = |axis: usize| (first[axis].to_bits() | second[axis].to_bits()) << 1 != 0;
        Self((0..AXIS_COUNT).fold(0, |axes, axis| axes | u16::from(moves(axis)) << axis))
    }

    #[cfg(test)]
    pub fn add(&mut self, axis: usize) {
        self.0 |= 1 << (axis & 15);
    }

    /// Those that move at any of these places.
    #[inline]
    pub fn at_any(samples: [&Sample; 3]) -> Self {
        let [start, middle, end] = samples;
        Self(start.axes.0 | middle.axes.0 | end.axes.0)
    }

    #[inline]
    pub fn contains(self, axis: usize) -> bool {
        self.0 >> (axis & 15) & 1 == 1
    }

    /// Whether one of the four axes of a quad is among them.
    #[inline]
    pub fn in_quad(self, quad: usize) -> bool {
        self.0 >> (QUAD_LANES * quad) & 15 != 0
    }

    /// How many there are more than some of them.
    #[inline]
    pub fn more_than(self, some: Self) -> f64 {
        // To count takes long, and mostly there is nothing to be counted.
        if self == some {
            0.0
        } else {
            f64::from(Self(self.0 & !some.0).count())
        }
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_sound_with_numbers_and_two_speeds() {
        let with = |first: f64, cap: Cap| Sample {
            first: Axes::repeat(first),
            cap,
            ..Sample::NONE
        };
        assert!(with(1.0, Cap::of(1.0, 2.0)).is_sound());
        assert!(!with(f64::NAN, Cap::of(1.0, 2.0)).is_sound());
        assert!(!with(f64::INFINITY, Cap::of(1.0, 2.0)).is_sound());
        assert!(!with(1.0, Cap::of(0.0, 2.0)).is_sound());
        assert!(!with(1.0, Cap::of(1.0, 0.0)).is_sound());
    }
}
