//! Where the nodes of the plan are: they follow the time that the path will take, not the moves.
//!
//! The spacing is what a change of shape or of the speed cap asks for, grows by [`GROWTH`] of the
//! distance from it, and is at most what is run in [`FREE_TIME`] at the cap.

use super::context::PlanContext;
use super::feature::GROWTH;
use super::features::Features;
use super::place::Place;
use super::rest_arc::RestArc;
use super::route::{Route, before};
use super::sample::Sample;
use super::spline::{CAPACITY, SampleBanks, Spline, SplineInterval};

/// Seconds between nodes where nothing happens.
const FREE_TIME: f64 = 8e-3;

/// The most of a radius of curvature that an interval covers where no vertex asks for nodes.
const RADIUS_SHARE: f64 = 0.25;

/// The most of an arc that an interval covers, radians, also where easements wider than the arc straighten
/// it at the places that are looked at.
const GREATEST_ANGLE: f64 = 1.0;

/// The share of J that the third derivative of the path may leave its linear interpolation by.
const THIRD_DERIVATIVE_ERROR: f64 = 0.08;

/// The share of its length that an interval without a vertex keeps where only the joints bend.
const LEAST_BEND_SHARE: f64 = 0.3;

/// What the grid has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GridStep {
    /// Not yet at the end.
    More,
    /// The last node is at the arc of the final rest.
    Done,
    /// There are more nodes than there is room for.
    TooLong,
    /// The next node is nearer than the path distance can tell, beside an arc at rest of that size.
    TooFine,
    /// The path is not a number, or has a place that must not be passed at any speed.
    Unsound,
}

/// The grid of a candidate while it is being made.
#[derive(Debug)]
pub(super) struct Grid {
    features: Features,
    k: usize,
    end: f64,
    end_spacing: f64,
    /// The path where the next interval starts.
    place: Place,
}

impl Grid {
    pub const fn new() -> Self {
        Self {
            features: Features::new(),
            k: 0,
            end: 0.0,
            end_spacing: 0.0,
            place: Place::ZERO,
        }
    }

    /// The path is another one from now on.
    pub fn forget(&mut self) {
        self.features.forget();
    }

    /// Begins at the start of interval `cut`, whose place and sample the candidate has.
    pub fn restart<R: Route>(&mut self, context: &PlanContext<R>, candidate: &Spline, cut: usize) {
        let RestArc { length, .. } = candidate.end_arc;
        self.k = cut;
        self.end = candidate.end - length;
        self.end_spacing = GROWTH * length;
        let start = candidate.at(cut).start;
        self.place = context.rows.place(&context.route.point(start));
        let back = context.route.greatest_reach() * 1.01 + 1e-9 * start.abs();
        self.features
            .restart(start - back, start, context.raise_squared);
    }

    /// The interval that comes next.
    pub fn reached(&self) -> usize {
        self.k
    }

    /// Takes a vertex or places a node, at most nine evaluations of the path.
    pub fn advance<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        candidate: &mut Spline,
        samples: &mut SampleBanks,
    ) -> GridStep {
        let route = context.route;
        let k = self.k;
        if k + 3 - context.oldest >= CAPACITY {
            return GridStep::TooLong;
        }
        let s = candidate.at(k).start;
        let left = samples.start(candidate, k);
        let free = FREE_TIME * left.cap.raised(context.raise_squared).sqrt();
        let window = free / GROWTH + route.greatest_reach();
        self.features.make_room(s);
        if !self.features.covers(s + window) {
            self.features.take_next(context, s - free / GROWTH);
            return GridStep::More;
        }
        self.features.drop_before(s, free);

        let previous = candidate.at(k - 1).length;
        let step = self.step(route, s, previous, free, left);
        if step.length.is_nan() {
            return GridStep::Unsound;
        }
        if step.end <= s {
            return GridStep::TooFine;
        }
        let (step, middle, right) = self.resolve(context, s, step, left);
        if !(middle.sample.is_sound() && right.sample.is_sound()) {
            return GridStep::Unsound;
        }
        self.place(context, candidate, samples, &step, &middle, right);
        if step.end >= self.end {
            candidate.last = k;
            return GridStep::Done;
        }
        self.k = k + 1;
        GridStep::More
    }

    /// Puts the interval that comes next into the candidate, with what was seen in its middle and at its end, and the
    /// node there.
    #[inline]
    fn place<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        candidate: &mut Spline,
        samples: &mut SampleBanks,
        step: &NextNode,
        middle: &Seen,
        right: Seen,
    ) {
        let PlanContext { route, rows, .. } = *context;
        let k = self.k;
        let s = candidate.at(k).start;
        let (length, end) = (step.length, step.end);
        let interval = candidate.at_mut(k);
        *interval = SplineInterval {
            start: s,
            length,
            near_end: step.near_end,
            bank: interval.bank,
            ..SplineInterval::NONE
        };
        let samples_here = samples.place_mut(candidate, k);
        samples_here.middle = middle.sample;
        samples_here.end = right.sample;
        let places = [&self.place, &middle.place, &right.place];
        samples_here.look_between(rows, route, s, length, places);
        // Those that lie too near to another node to have one of their own.
        for place in self.features.cap_changes(s, end) {
            let cap = rows.sample(route, place, 0.0).cap;
            samples_here.cap_beside((place - s) / length, &cap);
        }
        let right = if self.features.is_on_vertex(end) {
            Seen::at(context, end, length)
        } else {
            right
        };
        self.place = right.place;
        let right = right.sample;
        *candidate.at_mut(k + 1) = SplineInterval {
            start: end,
            length,
            near_end: true,
            bank: context.plan.at(k + 1).bank ^ 1,
            ..SplineInterval::NONE
        };
        samples.place_mut(candidate, k + 1).start = right;
    }

    /// The length of the interval from `s` on, by features and neighbours.
    fn step<R: Route>(
        &self,
        route: &R,
        s: f64,
        previous: f64,
        free: f64,
        left: &Sample,
    ) -> NextNode {
        let most = free.min(previous * (1.0 + 2.0 * GROWTH));
        let (mut length, within) = self.features.spacing(s, most);
        if !within {
            length = length.min((RADIUS_SHARE * left.radius()).max(0.02 * free));
        }
        length = length.min(GREATEST_ANGLE / route.turning(s));
        let by_end = (self.end_spacing + GROWTH * (self.end - s)) / (1.0 + GROWTH);
        let mut near_end = by_end < 0.9 * length;
        length = length.min(by_end);
        let mut end = s + length;
        if let Some(place) = self.features.landmark(s, length) {
            end = place;
            length = place - s;
        } else if let Some(place) = self.features.cap_change(s, length) {
            length = 0.5 * (place - s);
            end = s + length;
        }
        let left_over = self.end - s;
        if left_over < 1.3 * length {
            near_end = true;
            end = self.end;
            length = left_over;
        } else if left_over < 2.0 * length {
            near_end = true;
            length = 0.5 * left_over;
            end = s + length;
        }
        NextNode {
            length,
            end,
            near_end,
        }
    }

    /// The rows at the end of an interval, as they are inside of it.
    fn look_at_end<R: Route>(&self, context: &PlanContext<R>, end: f64, length: f64) -> Seen {
        let place = if self.features.is_on_vertex(end) {
            before(end)
        } else {
            end
        };
        Seen::at(context, place, length)
    }

    /// Shortens an interval at most three times while the third derivative of the path is not
    /// resolved at the speed to be expected. Returns it, and what its middle and end look like.
    fn resolve<R: Route>(
        &self,
        context: &PlanContext<R>,
        s: f64,
        step: NextNode,
        left: &Sample,
    ) -> (NextNode, Seen, Seen) {
        let NextNode {
            mut length,
            mut end,
            near_end,
        } = step;
        let (mut speed, mut finest) = (0.0, f64::INFINITY);
        if let Some(spacing) = self.features.finest(s, end) {
            finest = spacing;
            let acceleration = context.rows.acceleration_from_rest(left);
            let (center, cap) = (s + 0.5 * length, left.cap.raised(context.raise_squared));
            let features = &self.features;
            let most = features.greatest_speed_squared(center, acceleration, cap);
            speed = 1.2 * most.sqrt();
        } else if context.rows.bends() {
            // The joints may bend where no vertex is.
            finest = LEAST_BEND_SHARE * length;
            let cap = left.cap.raised(context.raise_squared);
            speed = context.rows.curve_speed(left).min(cap.sqrt());
        }
        let cubed = speed * speed * speed;
        let mut middle = Seen::at(context, s + 0.5 * length, length);
        let mut right = self.look_at_end(context, end, length);
        for _ in 0..3 {
            let bulge = middle.sample.third - (left.third + right.sample.third) * 0.5;
            let error = bulge.amax() * cubed;
            if error <= THIRD_DERIVATIVE_ERROR || length <= 0.4 * finest {
                break;
            }
            let halved = error > 2.5 * THIRD_DERIVATIVE_ERROR;
            length *= if halved { 0.5 } else { 0.7 };
            end = s + length;
            // It ends where its middle was.
            right = if halved && !self.features.is_on_vertex(end) {
                Seen::with(context, end, middle.place, length)
            } else {
                self.look_at_end(context, end, length)
            };
            middle = Seen::at(context, s + 0.5 * length, length);
        }
        let step = NextNode {
            length,
            end,
            near_end,
        };
        (step, middle, right)
    }
}

/// A place of the path and the rows there.
struct Seen {
    place: Place,
    sample: Sample,
}

impl Seen {
    fn at<R: Route>(context: &PlanContext<R>, s: f64, length: f64) -> Self {
        let PlanContext { route, rows, .. } = *context;
        Self::with(context, s, rows.place(&route.point(s)), length)
    }

    /// The same where the path is known to have this `place`.
    fn with<R: Route>(context: &PlanContext<R>, s: f64, place: Place, length: f64) -> Self {
        let sample = context.rows.sample_of(context.route, s, &place, length);
        Self { place, sample }
    }
}

struct NextNode {
    length: f64,
    end: f64,
    near_end: bool,
}
