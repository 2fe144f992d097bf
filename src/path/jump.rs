//! Jumps of the path's derivatives at a vertex, and what is added of them to a point of the path.
//!
//! Most programs move three axes. XYZ, ABC and UVW are left out as a whole where they do not take
//! part: dozens of kernels may overlap at a place of dense code.

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes};
use crate::moves::shape::PathPoint;

/// XYZ, ABC and UVW.
const GROUPS: usize = 3;

/// Axes in each.
const GROUP_SIZE: usize = 3;

/// A jump of a derivative of the path, which knows the axes that take part in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jump {
    groups: [[f64; GROUP_SIZE]; GROUPS],
    /// Whether any axis of the group jumps.
    present: [bool; GROUPS],
}

impl Jump {
    pub const NONE: Self = Self {
        groups: [[0.0; GROUP_SIZE]; GROUPS],
        present: [false; GROUPS],
    };

    /// Of all axes, shape (9).
    pub fn new(axes: &Axes) -> Self {
        let [x, y, z, a, b, c, u, v, w]: [f64; AXIS_COUNT] = (*axes).into();
        let groups = [[x, y, z], [a, b, c], [u, v, w]];
        Self {
            groups,
            present: groups.map(|group| group != [0.0; GROUP_SIZE]),
        }
    }

    /// Of all axes, shape (9).
    pub fn axes(&self) -> Axes {
        let [[x, y, z], [a, b, c], [u, v, w]] = self.groups;
        Axes::from_array_storage(ArrayStorage([[x, y, z, a, b, c, u, v, w]]))
    }
}

/// What of a jump is added to a point of the path and its derivatives. In pairs, since processors
/// calculate in pairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors {
    /// To the position and the second derivative.
    pub even: [f64; 2],
    /// To the first and the third derivative.
    pub odd: [f64; 2],
}

/// A sum of jumps, each times so many factors.
#[derive(Clone, Copy, Debug)]
pub(super) struct JumpSum<const N: usize> {
    /// By group and axis.
    groups: [[[f64; N]; GROUP_SIZE]; GROUPS],
}

impl<const N: usize> JumpSum<N> {
    pub const ZERO: Self = Self {
        groups: [[[0.0; N]; GROUP_SIZE]; GROUPS],
    };

    /// Adds a jump times each of these factors.
    #[inline]
    pub fn add(&mut self, jump: &Jump, factors: &[f64; N]) {
        let groups = self.groups.iter_mut().zip(&jump.groups);
        for ((sums, group), present) in groups.zip(&jump.present) {
            if *present {
                add_group(sums, group, factors);
            }
        }
    }
}

#[inline]
fn add_group<const N: usize>(
    sums: &mut [[f64; N]; GROUP_SIZE],
    group: &[f64; GROUP_SIZE],
    factors: &[f64; N],
) {
    for (sum, axis) in sums.iter_mut().zip(group) {
        for (sum, factor) in sum.iter_mut().zip(factors) {
            *sum += axis * factor;
        }
    }
}

impl JumpSum<1> {
    /// For all axes, shape (9).
    pub fn axes(&self) -> Axes {
        let [[[x], [y], [z]], [[a], [b], [c]], [[u], [v], [w]]] = self.groups;
        Axes::from_array_storage(ArrayStorage([[x, y, z, a, b, c, u, v, w]]))
    }
}

/// What all jumps add to a point of the path and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointSum {
    even: JumpSum<2>,
    odd: JumpSum<2>,
}

impl PointSum {
    pub const ZERO: Self = Self {
        even: JumpSum::ZERO,
        odd: JumpSum::ZERO,
    };

    /// Adds a jump times its factors.
    #[inline(always)]
    pub fn add(&mut self, jump: &Jump, Factors { even, odd }: &Factors) {
        let sums = self.even.groups.iter_mut().zip(&mut self.odd.groups);
        let groups = sums.zip(&jump.groups).zip(&jump.present);
        for (((even_sums, odd_sums), group), present) in groups {
            if *present {
                add_group(even_sums, group, even);
                add_group(odd_sums, group, odd);
            }
        }
    }

    /// Adds the sum to a point of the path.
    #[inline]
    pub fn add_to(&self, point: &mut PathPoint) {
        let even = point.position.iter_mut().zip(point.second.iter_mut());
        for ((position, second), sum) in even.zip(self.even.groups.iter().flatten()) {
            *position += sum[0];
            *second += sum[1];
        }
        let odd = point.first.iter_mut().zip(point.third.iter_mut());
        for ((first, third), sum) in odd.zip(self.odd.groups.iter().flatten()) {
            *first += sum[0];
            *third += sum[1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_all_axes() {
        let all = Axes::from_fn(|axis, _| 1.0 + axis as f64);
        for present in 0..8u32 {
            let axes = Axes::from_fn(|axis, _| {
                if present >> (axis / 3) & 1 == 1 {
                    all[axis]
                } else {
                    0.0
                }
            });
            let jump = Jump::new(&axes);
            assert_eq!(jump.axes(), axes);
            let mut one = JumpSum::ZERO;
            one.add(&jump, &[2.0]);
            one.add(&jump, &[-0.5]);
            assert_eq!(one.axes(), axes * 1.5);
            let mut sum = PointSum::ZERO;
            let factors = Factors {
                even: [1.0, 3.0],
                odd: [2.0, 4.0],
            };
            sum.add(&jump, &factors);
            let once = Factors {
                even: [1.0; 2],
                odd: [1.0; 2],
            };
            sum.add(&Jump::new(&all), &once);
            let mut point = PathPoint {
                position: all,
                first: all,
                second: all,
                third: all,
            };
            sum.add_to(&mut point);
            assert_eq!(point.position, all * 2.0 + axes);
            assert_eq!(point.first, all * 2.0 + axes * 2.0);
            assert_eq!(point.second, all * 2.0 + axes * 3.0);
            assert_eq!(point.third, all * 2.0 + axes * 4.0);
        }
    }
}
