//! What the grid has to resolve: vertices with the spacing that each asks for.

use super::grid::GROWTH;
use super::route::{Route, Vertex};
use super::rows::AxisRows;

/// Seconds between nodes in a change of shape, at its limit speed.
const SHAPE_TIME: f64 = 2.5e-3;

/// Seconds between nodes at a change of the speed cap, at the lower cap.
const CAP_TIME: f64 = 5e-3;

/// The share of J by which the path's part of the jerk may jump inside of an interval.
const NOTICEABLE_JUMP: f64 = 0.02;

/// How near to a vertex is before it, share of the path distance.
const BESIDE: f64 = 1e-13;

/// A place just before a vertex.
pub(super) fn before(vertex: f64) -> f64 {
    vertex - BESIDE * (1.0 + vertex.abs())
}

/// A power of two, so that a masked index is in range for the compiler too.
const SLOTS: usize = 256;

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
    /// Whether it stands for a single vertex.
    pub single: bool,
}

impl Feature {
    const NONE: Self = Self {
        start: 0.0,
        center: 0.0,
        end: 0.0,
        spacing: f64::INFINITY,
        speed: 0.0,
        cap_changes: false,
        jumps: false,
        single: true,
    };

    /// Of a vertex, with three evaluations of the path. `longest` is as far as it is known.
    fn of<R: Route>(
        vertex: &Vertex,
        rows: &AxisRows,
        route: &R,
        raise_squared: f64,
        longest: f64,
    ) -> Self {
        let Vertex {
            position,
            reach,
            cap_changes,
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
            let cap = rows
                .sample(route, position.min(longest), 0.0)
                .cap(raise_squared);
            feature.spacing = CAP_TIME * cap.sqrt();
        }
        if reach > 0.0 {
            let mut speed = f64::INFINITY;
            // Curvature is greatest at the centre, its derivative of most blends near 0.45.
            let mut sample = |place: f64| {
                let sample = rows.sample(route, place.min(longest), 0.0);
                speed = speed
                    .min(sample.curve_speed(rows))
                    .min(sample.cap(raise_squared).sqrt());
                sample.third
            };
            sample(position + 0.45 * reach);
            let jump = sample(position) - sample(before(position));
            feature.jumps = jump.amax() * speed * speed * speed > NOTICEABLE_JUMP;
            let spacing = (SHAPE_TIME * speed).max(reach / 12.0).min(reach / 4.8);
            feature.speed = speed;
            feature.spacing = feature.spacing.min(spacing);
        }
        feature
    }

    /// About the most that v^2 can be at `s`, with this acceleration between there and where the
    /// feature is at its limit speed.
    pub fn greatest_speed_squared(&self, s: f64, acceleration: f64) -> f64 {
        let core = 0.25 * (self.end - self.start);
        let beside = ((s - self.center).abs() - core).max(0.0);
        self.speed * self.speed + 2.0 * acceleration * beside
    }

    /// Whether a node belongs on its center.
    pub fn wants_node(&self) -> bool {
        self.cap_changes || self.jumps
    }

    /// The spacing at `s` outside or within, growing with the distance.
    pub fn spacing_at(&self, s: f64) -> f64 {
        if s < self.start {
            // The node after s is nearer to it than s is.
            let grown = (self.spacing + GROWTH * (self.start - s)) / (1.0 + GROWTH);
            grown.max(self.spacing)
        } else {
            self.spacing + GROWTH * (s - self.end).max(0.0)
        }
    }
}

/// Features in the order of the path, around the place where the grid is being made.
///
/// What lies within the known path never changes, so that it is kept for the drafts to come. Places
/// in the ring are counted on without end.
#[derive(Debug)]
pub(super) struct Features {
    slots: [Feature; SLOTS],
    /// The first one that is kept.
    oldest: usize,
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
}

impl Features {
    pub const fn new() -> Self {
        Self {
            slots: [Feature::NONE; SLOTS],
            oldest: 0,
            first: 0,
            next: 0,
            begin: f64::INFINITY,
            taken: 0.0,
            exhausted: false,
            lasting: 0,
            lasting_taken: 0.0,
            raise_squared: 0.0,
        }
    }

    /// Drops what is kept: the path is another one.
    pub fn forget(&mut self) {
        self.begin = f64::INFINITY;
    }

    /// Begins with the first vertex behind `s`.
    pub fn restart(&mut self, s: f64, raise_squared: f64) {
        self.exhausted = false;
        let kept = self.lasting > self.oldest
            && self.raise_squared == raise_squared
            && self.begin <= s
            && self.lasting_taken > s
            && (self.oldest == 0 || self.slots[self.oldest & (SLOTS - 1)].center <= s);
        if !kept {
            self.oldest = 0;
            self.first = 0;
            self.next = 0;
            self.begin = s;
            self.taken = s;
            self.lasting = 0;
            self.lasting_taken = s;
            self.raise_squared = raise_squared;
            return;
        }
        self.next = self.lasting;
        self.taken = self.lasting_taken;
        self.first = self.oldest;
        while self.first + 1 < self.next && self.slots[(self.first + 1) & (SLOTS - 1)].center <= s {
            self.first += 1;
        }
    }

    /// Whether all features up to `s` are there.
    pub fn covers(&self, s: f64) -> bool {
        self.exhausted || self.taken >= s || self.next - self.first >= SLOTS
    }

    /// Takes one more vertex.
    pub fn take_next<R: Route>(&mut self, rows: &AxisRows, route: &R, raise_squared: f64) {
        let longest = route.known_end();
        // A vertex behind the known end may reach back over it.
        let farthest = longest + route.greatest_reach();
        let next = route
            .vertex_after(self.taken)
            .filter(|vertex| vertex.position > self.taken && vertex.position <= farthest);
        let Some(vertex) = next else {
            self.exhausted = true;
            return;
        };
        let all_lasting = self.lasting == self.next && self.lasting_taken == self.taken;
        let lasting = all_lasting && vertex.position + vertex.reach.max(vertex.core) <= longest;
        self.taken = vertex.position;
        let changes = vertex.reach > 0.0 || vertex.cap_changes;
        if changes && vertex.position - vertex.reach <= longest {
            self.take(&vertex, lasting, rows, route, raise_squared);
        }
        if lasting {
            self.lasting = self.next;
            self.lasting_taken = self.taken;
        }
    }

    /// Adds a vertex that asks for nodes, or lets the last feature stand for it too.
    fn take<R: Route>(
        &mut self,
        vertex: &Vertex,
        lasting: bool,
        rows: &AxisRows,
        route: &R,
        raise_squared: f64,
    ) {
        let feature = Feature::of(vertex, rows, route, raise_squared, route.known_end());
        // What never changes is not joined with what may.
        let may_join = lasting || self.next > self.lasting;
        if let Some(last) = self.last_mut()
            && may_join
            && !last.wants_node()
            && !feature.wants_node()
            && feature.center - last.center < 0.25 * last.spacing.min(feature.spacing)
        {
            last.end = last.end.max(feature.end);
            last.start = last.start.min(feature.start);
            last.spacing = last.spacing.min(feature.spacing);
            last.speed = last.speed.max(feature.speed);
            last.single = false;
        } else {
            self.push(feature);
        }
        if vertex.core > 0.0 {
            let core = Vertex {
                reach: vertex.core,
                ..*vertex
            };
            let core = Feature::of(&core, rows, route, raise_squared, route.known_end());
            self.push(core);
        }
    }

    /// Appends a feature, over the oldest one that does not matter any more.
    fn push(&mut self, feature: Feature) {
        if self.next - self.first < SLOTS {
            self.slots[self.next & (SLOTS - 1)] = feature;
            self.next += 1;
            self.oldest = self.oldest.max(self.next.saturating_sub(SLOTS));
        }
    }

    /// Leaves those in front that say nothing any more for spacings below `most` from `s` on.
    pub fn drop_before(&mut self, s: f64, most: f64) {
        while self.next - self.first > 1
            && let front = &self.slots[self.first & (SLOTS - 1)]
            && front.end < s
            && front.spacing_at(s) > most
        {
            self.first += 1;
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &Feature> {
        (self.first..self.next).map(|place| &self.slots[place & (SLOTS - 1)])
    }

    fn last_mut(&mut self) -> Option<&mut Feature> {
        (self.next > self.first).then(|| &mut self.slots[(self.next - 1) & (SLOTS - 1)])
    }
}
