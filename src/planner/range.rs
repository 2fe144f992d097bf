//! Whether the joints stay within their soft limits all along a move.
//!
//! LinuxCNC looks at the end of a move only. That is enough for a line on a machine whose joints
//! are its axes; in the middle of an arc, or where rotary axes turn the workpiece, a joint may go
//! further than at either end.

use crate::axes::Axes;
use crate::machine::JOINT_COUNT;
use crate::path::Shape;

/// Soft limits of the joints, machine units or degrees. Joints beyond the last one are not looked at.
#[derive(Clone, Copy, Debug)]
pub struct JointRange {
    /// Least position of each joint.
    pub least: [f64; JOINT_COUNT],
    /// Greatest position of each joint.
    pub greatest: [f64; JOINT_COUNT],
    /// How many joints there are.
    pub count: usize,
}

/// A joint that would leave its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    /// Number of the joint.
    pub joint: usize,
    /// How far it would go.
    pub position: f64,
    /// Its limit.
    pub limit: f64,
}

/// Intervals between the points that are looked at first.
const INTERVALS: usize = 64;

/// How often the neighbourhood of the furthest point is looked at more closely, each time half as
/// wide: in the end a 32768th of the move, within which an arc departs from its furthest point by
/// 2e-8 of its radius.
const REFINEMENTS: usize = 9;

/// What a position may exceed a limit by rounding.
const ROUNDING: f64 = 1e-9;

/// The first joint that a move takes out of its range between its ends.
///
/// `joints` is the inverse kinematics: joint positions for a position, `None` where there are none
/// (then nothing can be said here, and motion itself refuses the move). 65 positions are looked at,
/// and 36 more for each limit that a joint comes near.
pub fn out_of_range(
    shape: &Shape,
    range: &JointRange,
    mut joints: impl FnMut(&Axes) -> Option<[f64; JOINT_COUNT]>,
) -> Option<OutOfRange> {
    if matches!(shape, Shape::Line(line) if !(3..6).any(|rotary| line.moves(rotary))) {
        return None;
    }
    let length = shape.length();
    let step = length / INTERVALS as f64;
    // For each joint the furthest places in both directions, and its longest way in an interval.
    let mut extremes = [[(f64::NEG_INFINITY, 0.0); 2]; JOINT_COUNT];
    let mut ways = [0.0; JOINT_COUNT];
    let mut last = joints(&shape.position(0.0))?;
    for index in 0..=INTERVALS {
        let s = step * index as f64;
        let positions = joints(&shape.position(s))?;
        for ((way, position), last) in ways.iter_mut().zip(&positions).zip(&mut last) {
            *way = f64::max(*way, (position - *last).abs());
            *last = *position;
        }
        for (extreme, position) in extremes.iter_mut().zip(&positions) {
            for (furthest, sign) in extreme.iter_mut().zip([1.0, -1.0]) {
                if sign * position > furthest.0 {
                    *furthest = (sign * position, s);
                }
            }
        }
    }
    let limits = range.greatest.iter().zip(&range.least);
    let found = extremes.iter().zip(&ways).zip(limits);
    for (joint, ((extreme, way), (greatest, least))) in found.enumerate().take(range.count) {
        for ((furthest, sign), limit) in extreme.iter().zip([1.0, -1.0]).zip([*greatest, -*least]) {
            let mut at = |s: f64| {
                let s = s.max(0.0).min(length);
                let positions = joints(&shape.position(s))?;
                positions.get(joint).map(|position| (sign * position, s))
            };
            let mut best = *furthest;
            if best.0 + way < limit {
                continue;
            }
            let mut width = step;
            for _ in 0..REFINEMENTS {
                for offset in [-0.75, -0.25, 0.25, 0.75] {
                    let candidate = at(best.1 + offset * width)?;
                    if candidate.0 > best.0 {
                        best = candidate;
                    }
                }
                width *= 0.5;
            }
            if best.0 > limit + ROUNDING {
                return Some(OutOfRange {
                    joint,
                    position: sign * best.0,
                    limit: sign * limit,
                });
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::path::{Arc9, Circle, Line9};

    fn range(reach: f64) -> JointRange {
        JointRange {
            least: [-reach; JOINT_COUNT],
            greatest: [reach; JOINT_COUNT],
            count: 3,
        }
    }

    /// Each joint is an axis.
    fn identity(position: &Axes) -> Option<[f64; JOINT_COUNT]> {
        let mut joints = [0.0; JOINT_COUNT];
        joints
            .iter_mut()
            .zip(position.iter())
            .for_each(|(joint, axis)| *joint = *axis);
        Some(joints)
    }

    /// From (10, 0) over (0, 10) to (-10, 0).
    fn half_circle() -> Shape {
        let end = |x: f64| Axes::from([x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            turn: 0,
        };
        Shape::Arc(Arc9::new(&end(10.0), &end(-10.0), &circle).expect("an arc"))
    }

    #[test]
    fn the_middle_of_an_arc_counts() {
        assert_eq!(
            out_of_range(&half_circle(), &range(10.000001), identity),
            None
        );
        let mut narrow = range(20.0);
        narrow.greatest[1] = 9.99999;
        let found = out_of_range(&half_circle(), &narrow, identity).expect("Y goes to 10");
        assert_eq!((found.joint, found.limit), (1, 9.99999));
        assert!((found.position - 10.0).abs() < 1e-9, "{found:?}");
        narrow = range(20.0);
        narrow.least[0] = -9.5;
        let found = out_of_range(&half_circle(), &narrow, identity).expect("X goes to -10");
        assert_eq!((found.joint, found.position, found.limit), (0, -10.0, -9.5));
    }

    #[test]
    fn a_joint_behind_rotary_axes_is_found_between_the_ends_of_a_line() {
        let end = Axes::from([0.0, 0.0, 0.0, 0.0, 0.0, 180.0, 0.0, 0.0, 0.0]);
        let line = Shape::Line(Line9::new(&Axes::zeros(), &end).expect("a line"));
        // the workpiece turns a point 50 from the centre past Y = 50
        let table = |position: &Axes| {
            let mut joints = [0.0; JOINT_COUNT];
            let angle = position[5].to_radians();
            joints[0] = 50.0 * angle.cos();
            joints[1] = 50.0 * angle.sin();
            Some(joints)
        };
        assert_eq!(out_of_range(&line, &range(50.1), table), None);
        let mut narrow = range(60.0);
        narrow.greatest[1] = 49.9;
        assert_eq!(
            out_of_range(&line, &narrow, table).map(|found| found.joint),
            Some(1)
        );
    }

    #[test]
    fn a_straight_line_is_motions_own_affair() {
        let end = Axes::from([100.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let line = Shape::Line(Line9::new(&Axes::zeros(), &end).expect("a line"));
        assert_eq!(out_of_range(&line, &range(10.0), identity), None);
    }
}
