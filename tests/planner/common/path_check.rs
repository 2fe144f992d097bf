//! Whether an executed path is within tolerance of the program, in both directions.

use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Shape;

/// What is left to rounding, and to G61 where only the curvature jumps.
const MICROMETRE: f64 = 1e-3;

/// Moves before and behind the running one that a place may belong to.
const NEAR: i32 = 3;
const FAR: i32 = 40;

/// A move as it was programmed.
#[derive(Clone, Debug)]
pub struct Wanted {
    pub id: i32,
    pub shape: Shape,
    /// Distance that the path may keep; infinite without P.
    pub tolerance: f64,
    /// Counts the aborts before it.
    pub generation: usize,
}

impl Wanted {
    pub fn tolerance_of(condition: TerminationCondition) -> f64 {
        match condition {
            TerminationCondition::Continuous { tolerance } if tolerance > 0.0 => tolerance,
            TerminationCondition::Continuous { .. } => f64::INFINITY,
            _ => 0.0,
        }
    }

    fn distance(&self, point: &Axes) -> f64 {
        let length = self.shape.length();
        let at = |s: f64| counted(&(self.shape.position(s) - point));
        if let Shape::Line(_) = self.shape {
            let (start, end) = (self.shape.position(0.0), self.shape.end());
            return to_segment(point, &start, &end);
        }
        // Three turns at most, so that each part is less than an eighth of one.
        const PARTS: usize = 32;
        let place = |k: usize| length * k as f64 / PARTS as f64;
        (0..PARTS)
            .filter(|k| {
                // Only where the distance does not just fall or rise from part to part.
                let around = [k.saturating_sub(1), *k, k + 1, (k + 2).min(PARTS)];
                let [before, low, high, after] = around.map(|k| at(place(k)));
                low <= before && high <= after
            })
            .map(|k| {
                let (mut low, mut high) = (place(k), place(k + 1));
                for _ in 0..40 {
                    let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                    if at(a) < at(b) {
                        high = b;
                    } else {
                        low = a;
                    }
                }
                at(0.5 * (low + high))
            })
            .fold(at(0.0).min(at(length)), f64::min)
    }
}

/// What the nearest point of a line is away: nearest by what [counts](counted), which is convex along it.
fn to_segment(point: &Axes, start: &Axes, end: &Axes) -> f64 {
    let way = end - start;
    let at = |t: f64| counted(&(start + way * t - point));
    let both_ends =
        |axes: &Axes| axes.fixed_rows::<3>(0).amax() > 0.0 && axes.fixed_rows::<3>(6).amax() > 0.0;
    if !(both_ends(&way) || both_ends(&(point - start))) {
        let square = way.norm_squared();
        let t = (point - start).dot(&way) / square.max(f64::MIN_POSITIVE);
        return at(t.clamp(0.0, 1.0));
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) < at(b) {
            high = b;
        } else {
            low = a;
        }
    }
    at(0.5 * (low + high))
}

/// What a displacement counts of a tolerance: its length with X, Y, Z or with U, V, W, which keep it each by themselves.
pub fn counted(displacement: &Axes) -> f64 {
    let square = |first| displacement.fixed_rows::<3>(first).norm_squared();
    (square(0).max(square(6)) + square(3)).sqrt()
}

/// A place where the machine was.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub position: Axes,
    /// The move that ran, 0 if none did.
    pub id: i32,
    pub generation: usize,
}

/// What is wrong with the path, if anything.
pub fn fault(wanted: &[Wanted], places: &[Place]) -> Option<String> {
    outside(wanted, places).or_else(|| missed(wanted, places))
}

/// Moves of a generation with numbers about `id`.
fn about(wanted: &[Wanted], generation: usize, id: i32, reach: i32) -> &[Wanted] {
    let from = wanted.partition_point(|one| (one.generation, one.id) < (generation, id - reach));
    let to = wanted.partition_point(|one| (one.generation, one.id) <= (generation, id + reach));
    &wanted[from..to]
}

/// A place that is too far from the program.
fn outside(wanted: &[Wanted], places: &[Place]) -> Option<String> {
    for (cycle, place) in places.iter().enumerate().step_by(5) {
        if place.id == 0 {
            continue;
        }
        let allowed = about(wanted, place.generation, place.id, 1)
            .iter()
            .map(|one| one.tolerance)
            .fold(0.0, f64::max);
        if allowed.is_infinite() {
            continue;
        }
        let distance = |reach| {
            about(wanted, place.generation, place.id, reach)
                .iter()
                .map(|one| one.distance(&place.position))
                .fold(f64::INFINITY, f64::min)
        };
        let allowed = allowed + MICROMETRE;
        if distance(NEAR) > allowed && distance(FAR) > allowed {
            return Some(format!(
                "{} away from the program in cycle {cycle}, move {}, allowed {allowed}",
                distance(FAR),
                place.id
            ));
        }
    }
    None
}

/// The end of a move that the machine has left behind, but came nowhere near.
fn missed(wanted: &[Wanted], places: &[Place]) -> Option<String> {
    for (n, one) in wanted.iter().enumerate() {
        let allowed = wanted[n..]
            .iter()
            .take(2)
            .map(|one| one.tolerance)
            .fold(0.0, f64::max);
        let passed = places
            .iter()
            .any(|place| place.generation == one.generation && place.id > one.id);
        if allowed.is_infinite() || !passed {
            continue;
        }
        let end = one.shape.end();
        let near = |place: &Place| {
            place.generation == one.generation
                && (place.id == 0 || (place.id - one.id).abs() <= FAR)
        };
        let distance = places
            .windows(2)
            .filter(|pair| near(&pair[0]) || near(&pair[1]))
            .map(|pair| to_segment(&end, &pair[0].position, &pair[1].position))
            .fold(f64::INFINITY, f64::min);
        if distance > allowed + MICROMETRE {
            return Some(format!(
                "the end of move {} missed by {distance}, allowed {allowed}",
                one.id
            ));
        }
    }
    None
}

#[test]
fn the_nearest_place_of_a_line_is_nearest_by_what_counts() {
    let at = |x: f64, u: f64| Axes::from([x, 0.0, 0.0, 0.0, 0.0, 0.0, u, 0.0, 0.0]);
    // X is as far away there as U; the place nearest in six axes, at a fiftieth of the line, counts .08
    let distance = to_segment(&at(0.1, 0.0), &at(0.0, 0.0), &at(1.0, 2.0));
    assert!((distance - 0.2 / 3.0).abs() < 1e-9, "{distance}");
}
