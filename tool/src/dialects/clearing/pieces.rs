//! Lines and arcs, and how far they are from each other.

use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{
    PlineSegIntr, PlineVertex, pline_seg_intr, seg_arc_radius_and_center, seg_closest_point,
};

/// A line or an arc between two places.
pub type Piece = (PlineVertex, PlineVertex);

/// Places that differ by less are the same.
pub const SAME: f64 = 1e-9;

/// How far a place is from a piece.
pub fn from_place(piece: Piece, place: Vector2) -> f64 {
    (seg_closest_point(piece.0, piece.1, place, SAME) - place).length()
}

/// How far two pieces are from each other.
///
/// Where they do not cross, the least distance is at an end of one of them, or it lies on the line through
/// the centre of an arc that is perpendicular to the other piece.
pub fn between(one: Piece, other: Piece) -> f64 {
    let crossing = pline_seg_intr(one.0, one.1, other.0, other.1, SAME);
    if !matches!(crossing, PlineSegIntr::NoIntersect) {
        return 0.0;
    }
    let candidates = [
        (other, one.0.pos()),
        (other, one.1.pos()),
        (one, other.0.pos()),
        (one, other.1.pos()),
    ];
    let ends = candidates.map(|(piece, place)| from_place(piece, place));
    let seen = seen_from_centre(one, other).min(seen_from_centre(other, one));
    ends.into_iter().fold(seen, f64::min)
}

/// The least distance on the lines through the centre of the arc `other`; infinite where it is none.
fn seen_from_centre(one: Piece, other: Piece) -> f64 {
    if other.0.bulge_is_zero() {
        return f64::INFINITY;
    }
    let (_, centre) = seg_arc_radius_and_center(other.0, other.1);
    let nearest = seg_closest_point(one.0, one.1, centre, SAME);
    let near = from_place(other, nearest);
    if one.0.bulge_is_zero() {
        return near;
    }
    // The far side of a circle inside of another is nearer to it.
    let (_, own) = seg_arc_radius_and_center(one.0, one.1);
    let opposite = own + own - nearest;
    let far = seg_closest_point(one.0, one.1, opposite, SAME);
    near.min(from_place(other, far))
}

#[cfg(test)]
mod tests {
    use super::{Piece, between};
    use cavalier_contours::polyline::PlineVertex;

    fn piece([x1, y1, bulge, x2, y2]: [f64; 5]) -> Piece {
        (
            PlineVertex::new(x1, y1, bulge),
            PlineVertex::new(x2, y2, 0.0),
        )
    }

    #[test]
    fn distances_of_lines_and_arcs() {
        let half = |x: f64, radius: f64| [x - radius, 0.0, 1.0, x + radius, 0.0];
        for (one, other, wanted) in [
            ([0.0, 0.0, 0.0, 10.0, 0.0], [3.0, 2.0, 0.0, 5.0, 4.0], 2.0),
            ([0.0, 0.0, 0.0, 10.0, 0.0], [3.0, -2.0, 0.0, 5.0, 4.0], 0.0),
            // The lower half of a circle above a line, and inside of another circle.
            ([-9.0, -8.0, 0.0, 9.0, -8.0], half(0.0, 5.0), 3.0),
            (half(0.0, 10.0), half(1.0, 4.0), 5.0),
            (half(0.0, 5.0), half(20.0, 4.0), 11.0),
        ] {
            let [one, other] = [one, other].map(piece);
            assert!((between(one, other) - wanted).abs() < 1e-9, "{one:?}");
            assert!((between(other, one) - wanted).abs() < 1e-9, "{one:?}");
        }
    }
}
