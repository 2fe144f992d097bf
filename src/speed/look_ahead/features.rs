//! The features around the place where the grid is being made.
//!
//! There may be hundreds of them within the reach of the largest spacing, but few say anything about
//! a place: what is farther away than the spacing that was found so far is left out.

mod groups;
mod questions;

use super::context::PlanContext;
use super::feature::{Feature, Look, RoutePlace, TWIST_AT};
use super::route::{Route, RouteVertex};
use crate::ring::Ring;
use groups::{FeatureGroup, GROUP};
use questions::{FinestAsked, GreatestSpeedAsked, LandmarkAsked, Question, SpacingAsked};

/// Room for features.
const SLOTS: usize = 1024;

/// Room for groups of them: the newest must not take the place of the oldest where that is still needed in part.
const GROUPS: usize = 2 * SLOTS / GROUP;

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
    /// What those in a row say at the utmost.
    groups: Ring<FeatureGroup, GROUPS>,
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
            groups: Ring::filled_with(FeatureGroup::EMPTY),
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
        self.crowd(|_| false);
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
        // A change of the cap asks for nodes where it is, not all over a wide change of shape there, and for none where that is
        // far slower anyway.
        let point = RouteVertex {
            reach: 0.0,
            core: 0.0,
            ..*vertex
        };
        let counts = vertex.cap_changes && vertex.reach > 0.0 && path.nears_cap(vertex.position);
        let cap_change = counts.then(|| Feature::of(&point, &mut path));
        let shape = RouteVertex {
            cap_changes: vertex.cap_changes && vertex.reach <= 0.0,
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
            let joined = *last;
            self.note(self.next - 1, &joined);
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
            self.crowd(|last| feature.is_beside(last) && feature.start < last.end);
            if let Some(place) = self
                .next
                .checked_sub(SLOTS)
                .filter(|place| *place >= self.oldest)
            {
                self.lost = self.lost.max(self.at(place).end);
            }
            *self.slots.at_mut(self.next as u64) = feature;
            if self.next.is_multiple_of(GROUP) {
                *self.group_mut(self.next) = FeatureGroup::EMPTY;
            }
            self.note(self.next, &feature);
            self.next += 1;
            self.oldest = self.oldest.max(self.next.saturating_sub(SLOTS));
        }
    }

    /// Decides which of those at the end that no other one lies behind yet are crowded.
    fn crowd(&mut self, is_crowded: impl Fn(&Feature) -> bool) {
        for place in (self.first..self.next).rev() {
            let last = self.slots.at_mut(place as u64);
            last.crowded = is_crowded(last);
            let last = *last;
            self.group_mut(place).mark(place, &last);
            if place == self.first || last.is_beside(self.at(place - 1)) {
                return;
            }
        }
    }

    /// Takes note of what a feature at a place says.
    fn note(&mut self, place: usize, feature: &Feature) {
        self.before = self.before.max(feature.center - feature.start);
        self.behind = self.behind.max(feature.end - feature.center);
        let group = self.group_mut(place);
        group.add(feature);
        group.mark(place, feature);
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

    /// The group of the feature at a place.
    fn group(&self, place: usize) -> &FeatureGroup {
        self.groups.at((place / GROUP) as u64)
    }

    fn group_mut(&mut self, place: usize) -> &mut FeatureGroup {
        self.groups.at_mut((place / GROUP) as u64)
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
        let mut asked = SpacingAsked {
            s,
            before: self.before,
            behind: self.behind,
            least: most,
            within: false,
        };
        self.ask_around(s, &mut asked);
        (asked.least, asked.within)
    }

    /// The next place that a node should be on, if it is near the end of an interval from `s` on:
    /// start, center and end of a blend that stands alone or lies beside an arc, and changes of the
    /// speed cap.
    pub fn landmark(&self, s: f64, length: f64) -> Option<f64> {
        let mut asked = LandmarkAsked::new(s, length);
        for feature in self.behind(s) {
            if asked.ends_behind(feature, 0.0) {
                break;
            }
            if feature.cap_changes && !feature.jumps {
                asked.ask_center(feature);
            }
        }
        let first = self.place_behind(s.min(s + asked.nearest() - self.behind));
        let mut place = first;
        while place < self.next && !asked.ends_behind(self.at(place), self.before) {
            // Of what is rounded over many vertices nearly none.
            match self.group(place).marked_from(place) {
                Some(wide) if wide < self.next => {
                    self.ask_ends(wide, &mut asked);
                    place = wide + 1;
                }
                _ => place = group_behind(place),
            }
        }
        asked.answer()
    }

    /// Asks for the ends of a feature where nodes should be on these.
    fn ask_ends(&self, place: usize, asked: &mut LandmarkAsked) {
        let feature = self.at(place);
        if asked.ends_behind(feature, self.before) {
            return;
        }
        if feature.jumps {
            asked.ask_jump(feature, feature.unseen.max(NEAREST_NODE * asked.length));
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
            asked.ask_alone(feature);
        }
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
        let mut asked = FinestAsked {
            from: s,
            to: end,
            beside,
            before: self.before,
            finest: f64::INFINITY,
        };
        self.ask_behind(self.place_behind(s - beside - self.behind), &mut asked);
        // A change of shape asks for some spacing.
        asked.finest.is_finite().then_some(asked.finest)
    }

    /// About the most that v^2 can be at `s`, and no more than `most`, with this acceleration
    /// between there and where the features are at their limit speeds.
    pub fn greatest_speed_squared(&self, s: f64, acceleration: f64, most: f64) -> f64 {
        let mut asked = GreatestSpeedAsked {
            s,
            acceleration,
            widest: 0.25 * (self.before + self.behind),
            least: most,
        };
        self.ask_around(s, &mut asked);
        asked.least
    }

    /// Asks the features behind `s` and then those before it, from there outwards.
    fn ask_around(&self, s: f64, question: &mut impl Question) {
        let middle = self.place_behind(s);
        self.ask_behind(middle, question);
        self.ask_before(middle, question);
    }

    fn ask_behind(&self, from: usize, question: &mut impl Question) {
        let mut place = from;
        while place < self.next {
            let end = group_behind(place).min(self.next);
            if question.ends_behind(self.at(place)) {
                return;
            }
            if question.concerns(self.group(place)) {
                for place in place..end {
                    let feature = self.at(place);
                    if question.ends_behind(feature) {
                        return;
                    }
                    question.ask(feature);
                }
            }
            place = end;
        }
    }

    fn ask_before(&self, to: usize, question: &mut impl Question) {
        let mut end = to;
        while end > self.first {
            let last = end - 1;
            let start = (last - last % GROUP).max(self.first);
            if question.ends_before(self.at(last)) {
                return;
            }
            if question.concerns(self.group(last)) {
                for place in (start..end).rev() {
                    let feature = self.at(place);
                    if question.ends_before(feature) {
                        return;
                    }
                    question.ask(feature);
                }
            }
            end = start;
        }
    }

    fn last_mut(&mut self) -> Option<&mut Feature> {
        (self.next > self.first).then(|| self.slots.at_mut((self.next - 1) as u64))
    }
}

/// The place behind the group that a place is in.
fn group_behind(place: usize) -> usize {
    place - place % GROUP + GROUP
}

#[cfg(test)]
mod tests;
