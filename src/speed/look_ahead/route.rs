//! What the look-ahead has to know of a path.

use crate::axes::Axes;
use crate::moves::shape::PathPoint;

/// Room for places where the third derivative of the path may jump in an interval.
pub const MOST_BREAKPOINTS: usize = 20;

/// How fast the program lets a place of the path be run, as ds/dt. Positive, may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedCap {
    /// What the program asks for at an override of 100 %.
    pub programmed: f64,
    /// What no override exceeds: at least `programmed`; equal to it where no override applies.
    pub greatest: f64,
}

/// A place where the path or the program changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteVertex {
    /// Where it is, as s.
    pub position: f64,
    /// How far the change of shape extends to both sides, 0 if there is none.
    pub reach: f64,
    /// How far a sharper change in the middle of it extends to both sides, 0 if there is none.
    pub core: f64,
    /// Whether the speed cap differs on both sides.
    pub cap_changes: bool,
    /// Whether the third derivative may jump there. Where it is known not to, nothing looks for a jump.
    pub may_jump: bool,
}

/// How near to a vertex is before it, share of the path distance.
const BESIDE: f64 = 1e-13;

/// A place just before a vertex.
pub(super) fn before(vertex: f64) -> f64 {
    vertex - BESIDE * (1.0 + vertex.abs())
}

/// A path that becomes known segment by segment.
///
/// What has been known once never changes: not the shape up to [`Self::known_end`], not the caps,
/// not the vertices before it. Derivatives are by s, continuous up to the second; s grows along
/// the path and need not be its arc length.
pub trait Route {
    /// The point at `s`, which lies between the start of the plan and the known end.
    fn point(&self, s: f64) -> PathPoint;

    /// The second and the third derivative of [that](Self::point) by s alone.
    fn bend(&self, s: f64) -> [Axes; 2] {
        let PathPoint { second, third, .. } = self.point(s);
        [second, third]
    }

    /// How far the path is known for good.
    fn known_end(&self) -> f64;

    /// Whether the motion has to end at the known end. Once `true`, it stays so.
    fn is_complete(&self) -> bool;

    /// The speed cap at `s`, on a change the lower one of both sides. `first`: dq/ds there, of
    /// [`Self::point`].
    fn speed_cap(&self, s: f64, first: &Axes) -> SpeedCap;

    /// The first vertex with a position greater than `s`.
    fn vertex_after(&self, s: f64) -> Option<RouteVertex>;

    /// The last vertex with a position less than `s`.
    fn vertex_before(&self, s: f64) -> Option<RouteVertex>;

    /// The greatest reach of all vertices.
    fn greatest_reach(&self) -> f64;

    /// How far the direction of the move itself turns from `s` on for a unit of s, radians, whatever
    /// smoothing makes of it: 0 on a line.
    fn turning(&self, _s: f64) -> f64 {
        0.0
    }

    /// The places behind `from` and before `to` where the third derivative of the path or its slope
    /// may jump, both sides of a jump of the third derivative itself, as many as there is room for; answers how many. In no
    /// order.
    fn breakpoints(&self, from: f64, to: f64, places: &mut [f64; MOST_BREAKPOINTS]) -> usize;
}
