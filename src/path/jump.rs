//! Jumps of the path's derivatives at a vertex, and what is added of them to a point of the path.
//!
//! Most programs move three axes. XYZ, ABC and UVW are left out as a whole where they do not take
//! part: dozens of kernels may overlap at a place of dense code.

use nalgebra::ArrayStorage;
use wide::f64x2;

use crate::axes::{AXIS_COUNT, Axes};
use crate::moves::shape::PathPoint;

/// XYZ, ABC and UVW.
pub(super) const GROUPS: usize = 3;

/// Axes in each.
pub(super) const GROUP_SIZE: usize = 3;

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

    /// XYZ, ABC and UVW.
    pub fn groups(&self) -> &[[f64; GROUP_SIZE]; GROUPS] {
        &self.groups
    }

    /// Whether nothing but XYZ jumps.
    pub fn is_linear(&self) -> bool {
        let [_, others @ ..] = self.present;
        others == [false; GROUPS - 1]
    }

    /// Of all axes, shape (9).
    pub fn axes(&self) -> Axes {
        let [[x, y, z], [a, b, c], [u, v, w]] = self.groups;
        Axes::from_array_storage(ArrayStorage([[x, y, z, a, b, c, u, v, w]]))
    }
}

/// What of a jump is added to a point of the path and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors {
    /// To the position and the first derivative.
    pub low: f64x2,
    /// To the second and the third derivative.
    pub high: f64x2,
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

#[inline(always)]
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
    /// What the first groups add up to, others none.
    pub fn of_groups(first: &[[f64; GROUP_SIZE]]) -> Self {
        let mut sum = Self::ZERO;
        for (sums, group) in sum.groups.iter_mut().zip(first) {
            *sums = group.map(|axis| [axis]);
        }
        sum
    }

    /// For all axes, shape (9).
    pub fn axes(&self) -> Axes {
        let [[[x], [y], [z]], [[a], [b], [c]], [[u], [v], [w]]] = self.groups;
        Axes::from_array_storage(ArrayStorage([[x, y, z, a, b, c, u, v, w]]))
    }
}

/// What all jumps add to a point of the path, of the first so many groups: that of one fits into the registers of a processor.
/// `LOW`: to the position and the first derivative; `HIGH`: to the second and the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointSum<const N: usize, const LOW: bool, const HIGH: bool> {
    groups: [GroupSum; N],
}

/// The same of one group, by axis.
#[derive(Clone, Copy, Debug)]
struct GroupSum {
    low: [f64x2; GROUP_SIZE],
    high: [f64x2; GROUP_SIZE],
}

impl GroupSum {
    const ZERO: Self = Self {
        low: [f64x2::ZERO; GROUP_SIZE],
        high: [f64x2::ZERO; GROUP_SIZE],
    };

    #[inline(always)]
    fn add<const LOW: bool, const HIGH: bool>(
        &mut self,
        group: &[f64x2; GROUP_SIZE],
        factors: &Factors,
    ) {
        let sums = self.low.iter_mut().zip(&mut self.high);
        for ((low, high), axis) in sums.zip(group) {
            if LOW {
                *low += *axis * factors.low;
            }
            if HIGH {
                *high += *axis * factors.high;
            }
        }
    }
}

impl<const N: usize, const LOW: bool, const HIGH: bool> PointSum<N, LOW, HIGH> {
    pub const ZERO: Self = Self {
        groups: [GroupSum::ZERO; N],
    };

    /// Adds a jump times its factors.
    #[inline(always)]
    pub fn add(&mut self, jump: &Jump, factors: &Factors) {
        let groups = self.groups.iter_mut().zip(&jump.groups);
        for ((sum, group), present) in groups.zip(jump.present) {
            if N == 1 || present {
                sum.add::<LOW, HIGH>(&group.map(f64x2::splat), factors);
            }
        }
    }

    /// The same of a jump of X, Y and Z alone, each twice.
    #[inline(always)]
    pub fn add_linear(&mut self, jump: &[f64x2; GROUP_SIZE], factors: &Factors) {
        let [linear, ..] = self.groups.as_mut_slice() else {
            return;
        };
        linear.add::<LOW, HIGH>(jump, factors);
    }

    /// Adds the sum to a point of the path.
    #[inline(always)]
    pub fn add_to(&self, point: &mut PathPoint) {
        // Arrays, since iterators of the linear algebra step by a stride.
        let [position] = &mut point.position.data.0;
        let [first] = &mut point.first.data.0;
        let [second] = &mut point.second.data.0;
        let [third] = &mut point.third.data.0;
        for (number, sum) in self.groups.iter().enumerate() {
            for of_group in 0..GROUP_SIZE {
                let axis = GROUP_SIZE * number + of_group;
                if LOW {
                    let [place, slope] = sum.low[of_group].to_array();
                    position[axis] += place;
                    first[axis] += slope;
                }
                if HIGH {
                    let [bend, twist] = sum.high[of_group].to_array();
                    second[axis] += bend;
                    third[axis] += twist;
                }
            }
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
            let mut sum = PointSum::<GROUPS, true, true>::ZERO;
            let factors = Factors {
                low: f64x2::new([1.0, 2.0]),
                high: f64x2::new([3.0, 4.0]),
            };
            sum.add(&jump, &factors);
            let once = Factors {
                low: f64x2::splat(1.0),
                high: f64x2::splat(1.0),
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
