//! A place of the path, as the program and as the limits see it.

use nalgebra::ArrayStorage;

use crate::axes::{AXIS_COUNT, Axes};
use crate::machine_map::MachineMap;
use crate::moves::shape::PathPoint;

const ZERO: Axes = Axes::from_array_storage(ArrayStorage([[0.0; AXIS_COUNT]]));

/// A place of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// As the program sees it.
    pub point: PathPoint,
    /// Three derivatives by the path of what the limits hold for, each shape (9).
    pub behind: [Axes; 3],
}

impl Place {
    pub const ZERO: Self = Self {
        point: PathPoint::ZERO,
        behind: [ZERO; 3],
    };

    #[inline]
    pub fn of(point: &PathPoint, map: &MachineMap) -> Self {
        let PathPoint {
            position,
            first,
            second,
            third,
        } = point;
        Self {
            point: *point,
            behind: map.derivatives(position, [first, second, third]),
        }
    }

    /// In the middle between two places that are `length` / 2 apart, where the path has this `point`: what bends is not
    /// asked for once more.
    pub fn between(point: &PathPoint, [from, to]: [&Self; 2], length: f64) -> Self {
        let [first, second, third] = &from.behind;
        let [to_first, to_second, to_third] = &to.behind;
        Self {
            point: *point,
            behind: [
                middle([first, to_first], [second, to_second], length),
                (second + to_second) * 0.5,
                // The one that bends q' more, whichever way.
                third.abs().sup(&to_third.abs()),
            ],
        }
    }
}

/// The value in the middle of the cubic with these values and slopes at two places that are `length` / 2 apart (Hermite).
#[inline]
pub(super) fn middle(values: [&Axes; 2], slopes: [&Axes; 2], length: f64) -> Axes {
    let change = (slopes[0] - slopes[1]) * (length / 16.0);
    (values[0] + values[1]) * 0.5 + change
}
