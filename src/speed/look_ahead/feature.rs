//! What the grid has to resolve: a vertex with the spacing that it asks for.

use super::context::PlanContext;
use super::route::{Route, RouteVertex, before};
use crate::axes::Axes;
use crate::lanes::greater;

/// How much the spacing grows with the distance from what asked for a small one. Also the spacing
/// beside a rest over the length of its arc.
pub(super) const GROWTH: f64 = 0.35;

/// Seconds between nodes in a change of shape, at its limit speed.
const SHAPE_TIME: f64 = 2.5e-3;

/// The finest and the coarsest spacing in a change of shape, over its reach to one side.
const FINEST: f64 = 1.0 / 20.0;
/// See [`FINEST`].
const COARSEST: f64 = 1.0 / 4.8;

/// Seconds between nodes at a change of the speed cap, at the lower cap.
const CAP_TIME: f64 = 5e-3;

/// The share of J by which the path's part of the jerk may jump inside of an interval.
const NOTICEABLE_JUMP: f64 = 0.02;

/// Seconds, at the limit speed, for which a jump of J may go unseen inside of an interval: a few
/// hundredths of a servo period. Also a spike of the third derivative on a short arc, which the
/// places that are looked at would miss, is longer than that where it matters.
const UNSEEN_TIME: f64 = 3e-5;

/// The most that the spacings of two changes of shape differ by, one of which stands for both.
const JOINED: f64 = 2.0;

/// A change of the cap asks for nodes where the curve lets the speed be this share of the lower cap.
const CAP_SHARE: f64 = 0.7;

/// Where the curvature of most blends changes most, share of their reach.
pub(super) const TWIST_AT: f64 = 0.45;

/// A vertex, or several that lie closer together than they need nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Feature {
    /// Where its change of shape begins.
    pub start: f64,
    /// Where the vertex is.
    pub center: f64,
    /// Where the change of shape ends.
    pub end: f64,
    /// The distance of nodes within, infinite if the vertex asks for none.
    pub spacing: f64,
    /// The limit speed within, 0 without a change of shape.
    pub speed: f64,
    /// Whether the speed cap changes at the center.
    pub cap_changes: bool,
    /// Whether the third derivative of the path jumps at the center.
    pub jumps: bool,
    /// How near to the start of an interval the jump may be without a node of its own.
    pub unseen: f64,
    /// Whether it stands for a single vertex.
    pub single: bool,
    /// Whether the next one is known to begin before it ends.
    pub crowded: bool,
}

impl Feature {
    pub const NONE: Self = Self {
        start: 0.0,
        center: 0.0,
        end: 0.0,
        spacing: f64::INFINITY,
        speed: 0.0,
        cap_changes: false,
        jumps: false,
        unseen: 0.0,
        single: true,
        crowded: false,
    };

    /// Of a vertex, with up to three evaluations of the path. All features of a `path` are of the same vertex.
    pub fn of<R: Route>(vertex: &RouteVertex, path: &mut Look<R>) -> Self {
        let RouteVertex {
            position,
            reach,
            cap_changes,
            may_jump,
            ..
        } = *vertex;
        let mut feature = Self {
            start: position - reach,
            center: position,
            end: position + reach,
            cap_changes,
            ..Self::NONE
        };
        if cap_changes {
            feature.spacing = CAP_TIME * path.at_vertex(position).cap_speed;
        }
        if reach > 0.0 {
            // Curvature is greatest at the centre.
            let (twisted, center) = (
                path.at(position + TWIST_AT * reach),
                path.at_vertex(position),
            );
            let beside = if may_jump {
                path.at(before(position))
            } else {
                center
            };
            let speed = twisted.speed.min(center.speed).min(beside.speed);
            let jump = (center.third - beside.third).amax() * speed * speed;
            feature.jumps = jump * speed > NOTICEABLE_JUMP;
            feature.unseen = UNSEEN_TIME / jump;
            let spacing = (SHAPE_TIME * speed)
                .max(FINEST * reach)
                .min(COARSEST * reach);
            feature.speed = speed;
            feature.spacing = feature.spacing.min(spacing);
        }
        feature
    }

    /// About the most that v^2 can be at `s`, with this acceleration between there and where the
    /// feature is at its limit speed.
    pub fn greatest_speed_squared(&self, s: f64, acceleration: f64) -> f64 {
        let core = 0.25 * (self.end - self.start);
        let beside = greater(0.0, (s - self.center).abs() - core);
        self.speed * self.speed + 2.0 * acceleration * beside
    }

    /// Whether one may stand for both. A wide change of shape must not ask for the nodes of a narrow one all
    /// over its reach.
    pub fn is_as_fine_as(&self, other: &Self) -> bool {
        let (finer, coarser) = if self.spacing < other.spacing {
            (self.spacing, other.spacing)
        } else {
            (other.spacing, self.spacing)
        };
        coarser <= JOINED * finer
    }

    /// Whether it stands in the way of another one that would stand alone without it: not a change of its own speed cap.
    pub fn is_beside(&self, other: &Self) -> bool {
        self.speed > 0.0 || self.center != other.center
    }

    /// Whether a node belongs on its center.
    pub fn wants_node(&self) -> bool {
        self.cap_changes || self.jumps
    }

    /// Whether nodes may belong on its ends, too: those of a jump, and of a change of shape that may stand alone.
    pub fn may_be_wide(&self) -> bool {
        self.jumps || self.speed > 0.0 && self.single && !self.crowded
    }

    /// The spacing at `s` outside or within, growing with the distance.
    pub fn spacing_at(&self, s: f64) -> f64 {
        if s < self.start {
            // The node after s is nearer to it than s is.
            let grown = (self.spacing + GROWTH * (self.start - s)) / (1.0 + GROWTH);
            greater(self.spacing, grown)
        } else {
            self.spacing + GROWTH * greater(0.0, s - self.end)
        }
    }
}

/// What a feature has to know of a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoutePlace {
    s: f64,
    /// The speed cap.
    cap_speed: f64,
    /// What cap and curvature allow.
    speed: f64,
    /// As in the rows, shape (9).
    third: Axes,
}

/// The path as features see it: what is not known yet looks like its end.
pub(super) struct Look<'a, R: Route> {
    pub context: &'a PlanContext<'a, R>,
    /// How far the path is known.
    pub longest: f64,
    /// The end, which stands for many places.
    pub end: &'a mut Option<RoutePlace>,
    /// The vertex, which several features may have in common, once it was looked at.
    pub vertex: Option<RoutePlace>,
}

impl<R: Route> Look<'_, R> {
    /// The vertex itself.
    fn at_vertex(&mut self, s: f64) -> RoutePlace {
        if let Some(vertex) = self.vertex {
            return vertex;
        }
        let vertex = self.at(s);
        self.vertex = Some(vertex);
        vertex
    }

    /// Whether the path lets the speed come near the cap at the vertex.
    pub fn nears_cap(&mut self, s: f64) -> bool {
        let vertex = self.at_vertex(s);
        vertex.speed >= CAP_SHARE * vertex.cap_speed
    }

    fn at(&mut self, s: f64) -> RoutePlace {
        if s < self.longest {
            return self.evaluate(s);
        }
        match *self.end {
            Some(end) if end.s == self.longest => end,
            _ => *self.end.insert(self.evaluate(self.longest)),
        }
    }

    fn evaluate(&self, s: f64) -> RoutePlace {
        let context = self.context;
        let sample = context.rows.sample(context.route, s, 0.0);
        let cap_speed = sample.cap.raised(context.raise_squared).sqrt();
        RoutePlace {
            s,
            cap_speed,
            speed: context.rows.curve_speed(&sample).min(cap_speed),
            third: sample.third,
        }
    }
}
