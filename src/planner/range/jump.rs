//! Joints that jump: from one place to the next the kinematics turn to other joints, and no machine follows that within limits.
//!
//! Derivatives do not tell it: to both sides of such a place they are those of smooth joints. But second differences do, which
//! become a quarter where a span is halved, and stay what they are where a joint jumps. So a span in which they are
//! greater than [`LEAST_JUMP`] is halved until its places are next to each other, see [`BESIDE`]: the joint jumps if they are
//! greater there, too.
//!
//! Near a singular place joints turn fast, but smoothly: a wrist that passes the straight one at a distance of r degrees turns
//! over within r, and has second differences of up to 37 h^2 / r^2 degrees for places h apart. It counts as
//! one that jumps if r is below .0009: that close derivatives by numbers let joints exceed their limits. Arms that stretch
//! bend without end, by (2 h / r)^0.5 with arms of length r: with 5 mm that is not a jump yet.

use super::joints::{Joints, Jump};
use crate::axes::Axes;

/// Second differences that are greater are a jump where places are next to each other, machine units or degrees.
const LEAST_JUMP: f64 = 0.5;

/// Places that are not further from each other in any axis are next to each other, machine units or degrees.
const BESIDE: f64 = 1e-4;

/// Ways that differ by less are the same for the reader, machine units or degrees: joints move a little besides.
const SAME_WAY: f64 = 0.1;

/// How long a span is at first where no joint may jump, machine units, or degrees of a rotary axis: what jumps and jumps back
/// between two places is not seen.
pub(super) const SPAN: f64 = 10.0;

/// Whether a joint might jump whose greatest second difference in a span is this.
pub(super) fn may_jump(second: f64) -> bool {
    second > LEAST_JUMP
}

/// Whether two places are next to each other.
pub(super) fn are_beside(one: &Axes, other: &Axes) -> bool {
    (other - one).amax() <= BESIDE
}

/// The furthest way of a joint from one place to the next, of several the first joint's, for the first `count` joints; `place` is where a place of the
/// span is.
pub(super) fn furthest(
    places: &[Joints],
    count: usize,
    place: impl Fn(usize) -> Axes,
) -> Option<Jump> {
    let mut furthest: Option<(usize, usize, f64)> = None;
    for (number, pair) in places.windows(2).enumerate() {
        let [before, behind] = pair else {
            continue;
        };
        for (joint, (from, to)) in before.iter().zip(behind).enumerate().take(count) {
            let way = to - from;
            if furthest.is_none_or(|(.., known)| way.abs() > known.abs() + SAME_WAY) {
                furthest = Some((number, joint, way));
            }
        }
    }
    furthest.map(|(number, joint, way)| Jump {
        joint,
        way,
        place: place(number),
    })
}
