//! What the grid has to resolve: vertices with the spacing that each asks for.

use super::grid::GROWTH;
use super::route::{Route, Vertex};
use super::rows::AxisRows;

/// Seconds between nodes in a change of shape, at its limit speed.
const SHAPE_TIME: f64 = 2.5e-3;

/// Seconds between nodes at a change of the speed cap, at the lower cap.
const CAP_TIME: f64 = 5e-3;

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
        single: true,
    };

    /// Of a vertex, with two evaluations of the path. `longest` is as far as it is known.
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
        } = *vertex;
        let mut feature = Self {
            start: position - reach,
            center: position,
            end: position + reach,
            cap_changes,
            ..Self::NONE
        };
        if cap_changes {
            let cap = rows.sample(route, position).cap(raise_squared);
            feature.spacing = CAP_TIME * cap.sqrt();
        }
        if reach > 0.0 {
            let mut speed = f64::INFINITY;
            // Curvature is greatest at the centre, its derivative of most blends near 0.45.
            for share in [0.0, 0.45] {
                let sample = rows.sample(route, (position + share * reach).min(longest));
                speed = speed
                    .min(sample.curve_speed(rows))
                    .min(sample.cap(raise_squared).sqrt());
            }
            let spacing = (SHAPE_TIME * speed).max(reach / 12.0).min(reach / 4.8);
            feature.speed = speed;
            feature.spacing = feature.spacing.min(spacing);
        }
        feature
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
#[derive(Debug)]
pub(super) struct Features {
    slots: [Feature; SLOTS],
    first: usize,
    count: usize,
    /// The position of the last vertex that was taken, the start of the search for the next.
    taken: f64,
    /// Whether there is no further one.
    exhausted: bool,
}

impl Features {
    pub const fn new() -> Self {
        Self {
            slots: [Feature::NONE; SLOTS],
            first: 0,
            count: 0,
            taken: 0.0,
            exhausted: false,
        }
    }

    /// Begins with the first vertex behind `s`.
    pub fn restart(&mut self, s: f64) {
        self.first = 0;
        self.count = 0;
        self.taken = s;
        self.exhausted = false;
    }

    /// Whether all features up to `s` are there.
    pub fn covers(&self, s: f64) -> bool {
        self.exhausted || self.taken >= s || self.count >= SLOTS
    }

    /// Takes one more vertex.
    pub fn take_next<R: Route>(&mut self, rows: &AxisRows, route: &R, raise_squared: f64) {
        let longest = route.known_end();
        let next = route
            .vertex_after(self.taken)
            .filter(|vertex| vertex.position > self.taken && vertex.position <= longest);
        let Some(vertex) = next else {
            self.exhausted = true;
            return;
        };
        self.taken = vertex.position;
        if vertex.reach <= 0.0 && !vertex.cap_changes {
            return;
        }
        let feature = Feature::of(&vertex, rows, route, raise_squared, longest);
        if let Some(last) = self.last_mut()
            && !last.cap_changes
            && !feature.cap_changes
            && feature.center - last.center < 0.25 * last.spacing.min(feature.spacing)
        {
            last.end = last.end.max(feature.end);
            last.start = last.start.min(feature.start);
            last.spacing = last.spacing.min(feature.spacing);
            last.speed = last.speed.max(feature.speed);
            last.single = false;
        } else if self.count < SLOTS {
            self.slots[(self.first + self.count) & (SLOTS - 1)] = feature;
            self.count += 1;
        }
    }

    /// Drops those in front that say nothing any more for spacings below `most` from `s` on.
    pub fn drop_before(&mut self, s: f64, most: f64) {
        while self.count > 1
            && let front = &self.slots[self.first & (SLOTS - 1)]
            && front.end < s
            && front.spacing_at(s) > most
        {
            self.first += 1;
            self.count -= 1;
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &Feature> {
        (self.first..self.first + self.count).map(|place| &self.slots[place & (SLOTS - 1)])
    }

    fn last_mut(&mut self) -> Option<&mut Feature> {
        (self.count > 0).then(|| &mut self.slots[(self.first + self.count - 1) & (SLOTS - 1)])
    }
}
