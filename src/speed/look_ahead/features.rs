//! The features around the place where the grid is being made.
//!
//! There may be hundreds of them within the reach of the largest spacing, but few say anything about
//! a place: what is farther away than the spacing that was found so far is left out.

use super::context::PlanContext;
use super::feature::{Feature, GROWTH, Look, RoutePlace, TWIST_AT};
use super::route::{Route, RouteVertex};
use crate::lanes::lesser;
use crate::ring::Ring;

/// Room for features.
const SLOTS: usize = 1024;

/// The most that a vertex has: its change of shape, the sharpest part of that, and a change of the cap.
const OF_A_VERTEX: usize = 3;

/// As many vertices that say nothing any more are passed over at a time.
const SKIPPED: usize = 16;

/// No interval is made shorter than this share of the spacing there, for the sake of a jump.
const NEAREST_NODE: f64 = 1e-3;

/// Features in the order of the path, around the place where the grid is being made.
///
/// What lies within the known path never changes, so that it is kept for the candidates to come. Places
/// in the ring are counted on without end.
#[derive(Debug)]
pub(super) struct Features {
    slots: Ring<Feature, SLOTS>,
    /// The first one that is kept.
    oldest: usize,
    /// None of those that were not kept for want of room ends behind this.
    lost: f64,
    /// The first one that matters where the grid is.
    first: usize,
    /// The place behind the last one.
    next: usize,
    /// Where the search for vertices began.
    begin: f64,
    /// The position of the last vertex that was taken, the start of the search for the next.
    taken: f64,
    /// Whether there is no further one.
    exhausted: bool,
    /// The place behind the last one that never changes, as long as all before it are like that.
    lasting: usize,
    /// The position of the last vertex that was taken up to there.
    lasting_taken: f64,
    /// What the program's caps were multiplied by, squared.
    raise_squared: f64,
    /// No feature begins farther before its center ..
    before: f64,
    /// .. or ends farther behind it.
    behind: f64,
    /// The end of the known path, in this candidate.
    end: Option<RoutePlace>,
}

impl Features {
    pub const fn new() -> Self {
        Self {
            slots: Ring::filled_with(Feature::NONE),
            oldest: 0,
            lost: f64::NEG_INFINITY,
            first: 0,
            next: 0,
            begin: f64::INFINITY,
            taken: 0.0,
            exhausted: false,
            lasting: 0,
            lasting_taken: 0.0,
            raise_squared: 0.0,
            before: 0.0,
            behind: 0.0,
            end: None,
        }
    }

    /// Drops what is kept: the path is another one.
    pub fn forget(&mut self) {
        self.begin = f64::INFINITY;
    }

    /// Begins with the first vertex behind `s`, for a grid from `start` on.
    pub fn restart(&mut self, s: f64, start: f64, raise_squared: f64) {
        self.exhausted = false;
        self.end = None;
        let kept = self.lasting > self.oldest
            && self.raise_squared == raise_squared
            && self.begin <= s
            && self.lasting_taken > s
            && self.lost <= start;
        if !kept {
            self.oldest = 0;
            self.lost = f64::NEG_INFINITY;
            self.first = 0;
            self.next = 0;
            self.begin = s;
            self.taken = s;
            self.lasting = 0;
            self.lasting_taken = s;
            self.raise_squared = raise_squared;
            self.before = 0.0;
            self.behind = 0.0;
            return;
        }
        self.next = self.lasting;
        self.taken = self.lasting_taken;
        // Another one may come behind it.
        self.slots.at_mut(self.next.wrapping_sub(1) as u64).crowded = false;
        self.first = self.oldest;
        while self.first + 1 < self.next && self.at(self.first + 1).center <= s {
            self.first += 1;
        }
    }

    /// Whether all features up to `s` are there, or as many as there is room for: of a vertex all or none.
    pub fn covers(&self, s: f64) -> bool {
        self.exhausted || self.taken >= s || self.is_full()
    }

    fn is_full(&self) -> bool {
        self.next - self.first + OF_A_VERTEX > SLOTS
    }

    /// Makes room for a vertex at the cost of what lies behind `s`, the farthest first: dense code within the reach of a wide
    /// corner fills all of it, and what is not known ahead is run through unseen.
    pub fn make_room(&mut self, s: f64) {
        while self.is_full() && self.at(self.first).center < s {
            self.first += 1;
        }
    }

    /// Takes one more vertex, behind as many as [`SKIPPED`] that change the path before `needed` only.
    pub fn take_next<R: Route>(&mut self, context: &PlanContext<R>, needed: f64) {
        let route = context.route;
        let longest = route.known_end();
        // A vertex behind the known end may reach back over it.
        let farthest = longest + route.greatest_reach();
        for _ in 0..=SKIPPED {
            let next = route
                .vertex_after(self.taken)
                .filter(|vertex| vertex.position > self.taken && vertex.position <= farthest);
            let Some(vertex) = next else {
                self.exhausted = true;
                return;
            };
            let all_lasting = self.lasting == self.next && self.lasting_taken == self.taken;
            let widest = vertex.reach.max(vertex.core);
            let lasting = all_lasting && vertex.position + TWIST_AT * widest <= longest;
            self.taken = vertex.position;
            let matters = vertex.position + widest >= needed;
            let changes = vertex.reach > 0.0 || vertex.cap_changes;
            if matters && changes && vertex.position - vertex.reach <= longest {
                self.take(&vertex, lasting, context);
            }
            if lasting {
                self.lasting = self.next;
                self.lasting_taken = self.taken;
            }
            if matters {
                return;
            }
        }
    }

    /// Adds a vertex that asks for nodes, or lets the last feature stand for it too.
    fn take<R: Route>(&mut self, vertex: &RouteVertex, lasting: bool, context: &PlanContext<R>) {
        let mut path = Look {
            context,
            longest: context.route.known_end(),
            end: &mut self.end,
            vertex: None,
        };
        // A change of the cap asks for nodes where it is, not all over a wide change of shape there.
        let point = RouteVertex {
            reach: 0.0,
            core: 0.0,
            ..*vertex
        };
        let cap_change =
            (vertex.cap_changes && vertex.reach > 0.0).then(|| Feature::of(&point, &mut path));
        let shape = RouteVertex {
            cap_changes: vertex.cap_changes && cap_change.is_none(),
            ..*vertex
        };
        let feature = Feature::of(&shape, &mut path);
        let core = (vertex.core > 0.0).then(|| {
            let reach = vertex.core;
            Feature::of(&RouteVertex { reach, ..shape }, &mut path)
        });
        // What never changes is not joined with what may.
        let may_join = lasting || self.next > self.lasting;
        if let Some(last) = self.last_mut()
            && may_join
            && !last.wants_node()
            && !feature.wants_node()
            && feature.center - last.center < 0.25 * last.spacing.min(feature.spacing)
            && last.is_as_fine_as(&feature)
        {
            last.end = last.end.max(feature.end);
            last.start = last.start.min(feature.start);
            last.spacing = last.spacing.min(feature.spacing);
            last.speed = last.speed.max(feature.speed);
            last.single = false;
            let (before, behind) = (last.center - last.start, last.end - last.center);
            self.before = self.before.max(before);
            self.behind = self.behind.max(behind);
        } else {
            self.push(feature);
        }
        for further in [cap_change, core].into_iter().flatten() {
            self.push(further);
        }
    }

    /// Appends a feature, over the oldest one that does not matter any more.
    fn push(&mut self, feature: Feature) {
        if self.next - self.first < SLOTS {
            if let Some(last) = self.last_mut() {
                last.crowded = feature.is_beside(last) && feature.start < last.end;
            }
            self.before = self.before.max(feature.center - feature.start);
            self.behind = self.behind.max(feature.end - feature.center);
            if let Some(place) = self
                .next
                .checked_sub(SLOTS)
                .filter(|place| *place >= self.oldest)
            {
                self.lost = self.lost.max(self.at(place).end);
            }
            *self.slots.at_mut(self.next as u64) = feature;
            self.next += 1;
            self.oldest = self.oldest.max(self.next.saturating_sub(SLOTS));
        }
    }

    /// Leaves those in front that say nothing any more for spacings below `most` from `s` on.
    pub fn drop_before(&mut self, s: f64, most: f64) {
        while self.next - self.first > 1
            && let front = self.at(self.first)
            && front.end < s
            && front.spacing_at(s) > most
        {
            self.first += 1;
        }
    }

    fn at(&self, place: usize) -> &Feature {
        self.slots.at(place as u64)
    }

    /// The place of the first feature with its center behind `s`.
    fn place_behind(&self, s: f64) -> usize {
        let (mut low, mut high) = (self.first, self.next);
        while low < high {
            let middle = low + (high - low) / 2;
            if self.at(middle).center <= s {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The features with their centers behind `s`, from the first on.
    fn behind(&self, s: f64) -> impl Iterator<Item = &Feature> {
        (self.place_behind(s)..self.next).map(|place| self.at(place))
    }

    /// The features with their centers at `s` or before, from the last on.
    fn before(&self, s: f64) -> impl Iterator<Item = &Feature> {
        (self.first..self.place_behind(s))
            .rev()
            .map(|place| self.at(place))
    }

    /// The least spacing at `s` and `most`, and whether `s` lies in a change of shape.
    pub fn spacing(&self, s: f64, most: f64) -> (f64, bool) {
        let (mut least, mut within) = (most, false);
        let mut consider = |feature: &Feature| {
            // Nowhere does one ask for less than within.
            if feature.spacing < least {
                least = lesser(least, feature.spacing_at(s));
            }
            within = within || feature.speed > 0.0 && feature.start <= s && s < feature.end;
            least
        };
        let mut reached = most;
        let middle = self.place_behind(s);
        // Features farther away say nothing about less than this.
        for place in middle..self.next {
            let feature = self.at(place);
            if GROWTH / (1.0 + GROWTH) * (feature.center - self.before - s) > reached {
                break;
            }
            reached = consider(feature);
        }
        for place in (self.first..middle).rev() {
            let feature = self.at(place);
            if GROWTH * (s - feature.center - self.behind) > reached {
                break;
            }
            reached = consider(feature);
        }
        (least, within)
    }

    /// The next place that a node should be on, if it is near the end of an interval from `s` on:
    /// start, center and end of a blend that stands alone or lies beside an arc, and changes of the
    /// speed cap.
    pub fn landmark(&self, s: f64, length: f64) -> Option<f64> {
        let (mut best, mut rise): (Option<f64>, Option<f64>) = (None, None);
        let is_near = |place: f64, nearest: f64| place - s > nearest && place - s < 1.3 * length;
        let mut consider = |place: f64, nearest: f64| {
            if is_near(place, nearest) && best.is_none_or(|other| place < other) {
                best = Some(place);
            }
        };
        let nearest = 0.3 * length;
        let first = self.place_behind(s.min(s + nearest - self.behind));
        for place in first..self.next {
            let feature = self.at(place);
            if feature.center - self.before - s >= 1.3 * length {
                break;
            }
            // Of what is rounded over many vertices nearly all of them.
            if feature.crowded && !feature.wants_node() {
                continue;
            }
            if feature.jumps {
                let unseen = feature.unseen.max(NEAREST_NODE * length);
                consider(feature.center, unseen.min(nearest));
                // The changes of shape at both ends of a short arc nearly cancel each other. Where
                // they begin and end one after the other, the third derivative rises and falls
                // within the length of the arc: a node belongs behind the rise, and before the fall.
                consider(feature.end, nearest);
                let place = feature.start;
                if is_near(place, nearest) {
                    rise = Some(match rise {
                        Some(other) if (place - other).abs() < nearest => place.max(other),
                        Some(other) => place.min(other),
                        None => place,
                    });
                }
            } else if feature.cap_changes {
                consider(feature.center, nearest);
            }
            let is_other = |other: &&Feature| other.is_beside(feature);
            let free_before = || {
                let mut before = (self.first..place).rev().map(|other| self.at(other));
                let other = before.find(is_other);
                other.is_none_or(|other| other.end <= feature.start)
            };
            let free_behind = || {
                let mut behind = (place + 1..self.next).map(|other| self.at(other));
                let other = behind.find(is_other);
                other.is_none_or(|other| feature.end <= other.start)
            };
            if feature.speed > 0.0 && feature.single && free_before() && free_behind() {
                consider(feature.start, nearest);
                consider(feature.center, nearest);
                consider(feature.end, nearest);
            }
        }
        best.into_iter().chain(rise).reduce(f64::min)
    }

    /// A change of the speed cap that two intervals of a `length` from `s` on would not quite come
    /// to.
    pub fn cap_change(&self, s: f64, length: f64) -> Option<f64> {
        self.behind(s + length)
            .take_while(|feature| feature.center - s < 2.0 * length)
            .find(|feature| feature.wants_node() && feature.center - s >= 1.3 * length)
            .map(|feature| feature.center)
    }

    /// The changes of the speed cap between two places.
    pub fn cap_changes(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        self.behind(from)
            .map_while(move |feature| (feature.center < to).then_some(feature))
            .filter(|feature| feature.cap_changes)
            .map(|feature| feature.center)
    }

    /// Whether there is a vertex at `s` that has a node of its own.
    pub fn is_on_vertex(&self, s: f64) -> bool {
        self.before(s)
            .take_while(|feature| feature.center == s)
            .any(Feature::wants_node)
    }

    /// The least spacing of the changes of shape that an interval touches; `None` if it touches
    /// none.
    pub fn finest(&self, s: f64, end: f64) -> Option<f64> {
        let beside = 0.1 * (end - s);
        let features = self
            .behind(s - beside - self.behind)
            .take_while(|feature| feature.center - self.before < end + beside);
        let mut finest = f64::INFINITY;
        for feature in features {
            if feature.spacing < finest
                && feature.speed > 0.0
                && end > feature.start - beside
                && s < feature.end + beside
            {
                finest = feature.spacing;
            }
        }
        // A change of shape asks for some spacing.
        finest.is_finite().then_some(finest)
    }

    /// About the most that v^2 can be at `s`, and no more than `most`, with this acceleration
    /// between there and where the features are at their limit speeds.
    pub fn greatest_speed_squared(&self, s: f64, acceleration: f64, most: f64) -> f64 {
        let widest = 0.25 * (self.before + self.behind);
        let mut least = most;
        let mut consider = |feature: &Feature| {
            // Nowhere does one allow less than in its middle.
            if feature.speed > 0.0 && feature.speed * feature.speed < least {
                least = lesser(least, feature.greatest_speed_squared(s, acceleration));
            }
            least
        };
        let mut reached = most;
        let middle = self.place_behind(s);
        for place in middle..self.next {
            let feature = self.at(place);
            if 2.0 * acceleration * (feature.center - s - widest) > reached {
                break;
            }
            reached = consider(feature);
        }
        for place in (self.first..middle).rev() {
            let feature = self.at(place);
            if 2.0 * acceleration * (s - feature.center - widest) > reached {
                break;
            }
            reached = consider(feature);
        }
        least
    }

    fn last_mut(&mut self) -> Option<&mut Feature> {
        (self.next > self.first).then(|| self.slots.at_mut((self.next - 1) as u64))
    }
}

#[cfg(test)]
mod tests;
