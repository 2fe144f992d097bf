//! Rectangles with rounded corners, seen from their middle: the outlines of pockets and slots. A circle
//! and a slot are two of them.

/// Lengths that differ by less, relative to the larger, are the same.
const SAME: f64 = 1e-12;

/// The widest step between two outlines that leaves nothing in sharp corners, over the radius of the
/// tool: along the diagonal they lie sqrt 2 times as far apart, and the tool reaches 1 + sqrt 2 radii.
const WIDEST_STEP: f64 = 1.7;

/// How many outlines clear a pocket at most.
const MOST: f64 = 10_000.0;

/// An outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Half of its length and of its width.
    pub half: [f64; 2],
    /// The radius of its corners.
    pub corner: f64,
}

/// A piece of a way: a line, or an arc about `centre`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Where it ends.
    pub end: [f64; 2],
    /// The centre of an arc, which turns as the whole way does.
    pub centre: Option<[f64; 2]>,
}

impl Outline {
    /// The outline so far inside of this one.
    pub fn inside(&self, distance: f64) -> Outline {
        Outline {
            half: self.half.map(|half| (half - distance).max(0.0)),
            corner: (self.corner - distance).max(0.0),
        }
    }

    /// Once round from the middle of the side at the end of the first axis.
    pub fn way_round(&self, clockwise: bool) -> Vec<Piece> {
        let [length, width] = self.half;
        let side = if clockwise { -1.0 } else { 1.0 };
        let corner = self.corner.min(length).min(width);
        let start = [length, 0.0];
        if (length - corner).max(width - corner) <= SAME * length.max(width) {
            let circle = Piece {
                end: start,
                centre: Some([0.0, 0.0]),
            };
            return if corner > 0.0 {
                vec![circle]
            } else {
                Vec::new()
            };
        }
        let mut way = Vec::new();
        // Corners in the order in which they are passed, by the signs of their coordinates; the second and
        // the fourth are left along the second axis.
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        for (at, (x, y)) in corners.into_iter().enumerate() {
            let y = y * side;
            let middle = [x * (length - corner), y * (width - corner)];
            let on_length = [x * length, middle[1]];
            let on_width = [middle[0], y * width];
            let (enters, leaves) = match at % 2 {
                0 => (on_length, on_width),
                _ => (on_width, on_length),
            };
            way.push(line(enters));
            if corner > 0.0 {
                way.push(Piece {
                    end: leaves,
                    centre: Some(middle),
                });
            }
        }
        way.push(line(start));
        let mut at = start;
        way.retain(|piece| {
            let stays = piece.centre.is_none() && piece.end == at;
            at = piece.end;
            !stays
        });
        way
    }

    /// The outlines that clear what lies inside of this one, which is the last, from the middle outwards.
    /// `step` is how far apart they are at most, `radius` that of the tool.
    pub fn clearing(&self, step: f64, radius: f64) -> Vec<Outline> {
        let narrow = self.half[0].min(self.half[1]);
        let step = step.min(WIDEST_STEP * radius);
        let count = (narrow / step - 1e-9).ceil().clamp(0.0, MOST);
        let is_long = self.half[0] != self.half[1];
        let first = if is_long { 0 } else { 1 };
        let outline = |number: u32| {
            let out = f64::from(number) / count.max(1.0);
            self.inside(narrow * (1.0 - out))
        };
        match count == 0.0 {
            true => vec![*self],
            false => (first..=count as u32).map(outline).collect(),
        }
    }
}

fn line(end: [f64; 2]) -> Piece {
    Piece { end, centre: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(length: f64, width: f64, corner: f64) -> Outline {
        Outline {
            half: [length, width],
            corner,
        }
    }

    #[test]
    fn ways_close_and_arcs_keep_their_radius() {
        for (shape, pieces) in [
            (outline(10.0, 5.0, 2.0), 9),
            (outline(10.0, 5.0, 0.0), 5),
            (outline(10.0, 5.0, 5.0), 6),
            (outline(5.0, 10.0, 5.0), 7),
            (outline(5.0, 5.0, 5.0), 1),
            (outline(5.0, 0.0, 0.0), 2),
        ] {
            for clockwise in [false, true] {
                let way = shape.way_round(clockwise);
                assert_eq!(way.len(), pieces, "{shape:?} {way:?}");
                let mut at = [shape.half[0], 0.0];
                for piece in &way {
                    if let Some(centre) = piece.centre {
                        for place in [at, piece.end] {
                            let radius = (place[0] - centre[0]).hypot(place[1] - centre[1]);
                            assert!((radius - shape.corner).abs() < 1e-12, "{way:?}");
                        }
                    }
                    at = piece.end;
                }
                assert_eq!(at, [shape.half[0], 0.0]);
            }
        }
        assert_eq!(outline(0.0, 0.0, 0.0).way_round(true), []);
    }

    /// A tool of this radius on the outlines takes away all that lies inside.
    #[test]
    fn clearing_leaves_nothing() {
        let radius = 3.0;
        for shape in [
            outline(20.0, 12.0, 4.0),
            outline(20.0, 12.0, 0.0),
            outline(12.0, 12.0, 12.0),
            outline(20.0, 7.0, 7.0),
            outline(2.0, 9.0, 0.0),
        ] {
            let rings = shape.clearing(4.8, radius);
            // It goes down in the middle.
            let mut path: Vec<[f64; 2]> = vec![[0.0; 2]];
            for ring in &rings {
                let mut at = [ring.half[0], 0.0];
                path.push(at);
                for piece in ring.way_round(false) {
                    path.extend((1..=60).map(|part| along(at, &piece, f64::from(part) / 60.0)));
                    at = piece.end;
                }
            }
            let [length, width] = shape.half;
            for i in -40..=40 {
                for j in -40..=40 {
                    let place = [length * f64::from(i) / 40.0, width * f64::from(j) / 40.0];
                    let near = path
                        .iter()
                        .any(|at| (at[0] - place[0]).hypot(at[1] - place[1]) < radius + 1e-2);
                    let corner = [0, 1]
                        .map(|axis| (place[axis].abs() - shape.half[axis] + shape.corner).max(0.0));
                    let outside = corner[0].hypot(corner[1]) > shape.corner;
                    assert!(near || outside, "{shape:?}: {place:?} of {rings:?}");
                }
            }
        }
    }

    fn along(start: [f64; 2], piece: &Piece, t: f64) -> [f64; 2] {
        let Some(centre) = piece.centre else {
            return [0, 1].map(|axis| start[axis] + t * (piece.end[axis] - start[axis]));
        };
        let radius = (start[0] - centre[0]).hypot(start[1] - centre[1]);
        let begin = (start[1] - centre[1]).atan2(start[0] - centre[0]);
        let finish = (piece.end[1] - centre[1]).atan2(piece.end[0] - centre[0]);
        let mut sweep = (finish - begin).rem_euclid(std::f64::consts::TAU);
        if sweep == 0.0 {
            sweep = std::f64::consts::TAU;
        }
        let angle = begin + t * sweep;
        [
            centre[0] + radius * angle.cos(),
            centre[1] + radius * angle.sin(),
        ]
    }
}
