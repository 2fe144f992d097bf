//! Arcs and lines that take the place of a corner between two motions of a plane.

use std::f64::consts::TAU;

/// A point or a vector of the plane.
pub type Point = [f64; 2];

/// One motion in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// Centre and direction (whether clockwise), for an arc.
    pub arc: Option<(Point, bool)>,
}

/// What is put between two motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Where the first motion ends now.
    pub start: Point,
    /// Where the second motion begins now.
    pub end: Point,
    /// Centre and direction (whether clockwise); `None` for a straight line.
    pub arc: Option<(Point, bool)>,
}

/// Why nothing can be put between two motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointError {
    /// The motions are too short.
    DoesNotFit,
    /// The second motion leads straight back.
    Reversal,
    /// The joint needs straight lines.
    NeedsLine,
}

/// Directions that differ by less are tangent.
const TANGENT: f64 = 1e-9;

impl Element {
    /// Direction of motion at its start, length 1.
    fn start_direction(&self) -> Point {
        self.direction_at(self.start)
    }

    /// Direction of motion at its end, length 1.
    fn end_direction(&self) -> Point {
        self.direction_at(self.end)
    }

    fn direction_at(&self, place: Point) -> Point {
        unit(match self.arc {
            None => minus(self.end, self.start),
            Some((centre, clockwise)) => {
                let left = left_of(minus(place, centre));
                if clockwise { left.map(|a| -a) } else { left }
            }
        })
    }

    /// How far along the motion a place on it lies, as a share of the whole; may be outside of 0 to 1.
    fn share(&self, place: Point) -> f64 {
        match self.arc {
            None => {
                let along = minus(self.end, self.start);
                dot(minus(place, self.start), along) / dot(along, along)
            }
            Some((centre, clockwise)) => {
                let angle = |to: Point| {
                    let (from, to) = (minus(self.start, centre), minus(to, centre));
                    let angle = cross(from, to).atan2(dot(from, to));
                    if clockwise { -angle } else { angle }.rem_euclid(TAU)
                };
                let whole = match angle(self.end) {
                    angle if angle < TANGENT => TAU,
                    angle => angle,
                };
                angle(place) / whole
            }
        }
    }

    /// The place of the motion that is nearest to a point.
    fn nearest(&self, point: Point) -> Point {
        match self.arc {
            None => {
                let share = self.share(point);
                plus(self.start, times(minus(self.end, self.start), share))
            }
            Some((centre, _)) => {
                let radius = length(minus(self.start, centre));
                plus(centre, times(unit(minus(point, centre)), radius))
            }
        }
    }
}

/// An arc of this radius that is tangent to both motions. `None` where they already are tangent.
pub fn round(first: &Element, second: &Element, radius: f64) -> Result<Option<Joint>, JointError> {
    let corner = first.end;
    let Some(side) = turn(first, second)? else {
        return Ok(None);
    };
    let inside = |place: Point, element: &Element| {
        let share = element.share(place);
        (-TANGENT..=1.0 + TANGENT).contains(&share)
    };
    let candidates = offset_crossings(first, second, side * radius);
    let joints = candidates.into_iter().flatten().filter_map(|centre| {
        let (start, end) = (first.nearest(centre), second.nearest(centre));
        let touches = |place: Point| (length(minus(place, centre)) - radius).abs() < 1e-6 * radius;
        (inside(start, first) && inside(end, second) && touches(start) && touches(end)).then_some(
            Joint {
                start,
                end,
                arc: Some((centre, side < 0.0)),
            },
        )
    });
    let way = |joint: &Joint| length(minus(joint.start, corner)) + length(minus(joint.end, corner));
    joints
        .min_by(|a, b| way(a).total_cmp(&way(b)))
        .map(Some)
        .ok_or(JointError::DoesNotFit)
}

/// A straight line between two lines that begins and ends at this distance from the corner.
pub fn chamfer_from(
    first: &Element,
    second: &Element,
    distance: f64,
) -> Result<Option<Joint>, JointError> {
    if first.arc.is_some() || second.arc.is_some() {
        return Err(JointError::NeedsLine);
    }
    if turn(first, second)?.is_none() {
        return Ok(None);
    }
    let shortest = [first, second].map(|line| length(minus(line.end, line.start)));
    if distance > shortest[0].min(shortest[1]) * (1.0 + TANGENT) {
        return Err(JointError::DoesNotFit);
    }
    Ok(Some(Joint {
        start: minus(first.end, times(first.end_direction(), distance)),
        end: plus(second.start, times(second.start_direction(), distance)),
        arc: None,
    }))
}

/// A straight line of this length between two lines, as far from the corner at both ends.
pub fn chamfer_of(
    first: &Element,
    second: &Element,
    long: f64,
) -> Result<Option<Joint>, JointError> {
    let across = plus(first.end_direction(), second.start_direction());
    chamfer_from(first, second, long / length(across))
}

/// An arc that ends where the second motion begins, tangent to it, and to which the line of the first
/// motion leads tangentially.
pub fn enter(first: &Element, second: &Element, radius: f64) -> Result<Joint, JointError> {
    if first.arc.is_some() {
        return Err(JointError::NeedsLine);
    }
    let (start, arc) = tangent_from(first.start, second.start, second.start_direction(), radius)?;
    Ok(Joint {
        start,
        end: second.start,
        arc: Some(arc),
    })
}

/// An arc that begins where the first motion ends, tangent to it, and from which the line of the second
/// motion leads on tangentially.
pub fn leave(first: &Element, second: &Element, radius: f64) -> Result<Joint, JointError> {
    if second.arc.is_some() {
        return Err(JointError::NeedsLine);
    }
    // The same, run backwards.
    let back = first.end_direction().map(|a| -a);
    let (end, (centre, clockwise)) = tangent_from(second.end, first.end, back, radius)?;
    Ok(Joint {
        start: first.end,
        end,
        arc: Some((centre, !clockwise)),
    })
}

/// The circle of this radius that runs through `place` in this direction, on the side of `from`; and the
/// point where the tangent from `from` meets it in the direction of its motion.
fn tangent_from(
    from: Point,
    place: Point,
    direction: Point,
    radius: f64,
) -> Result<(Point, (Point, bool)), JointError> {
    let side = cross(direction, minus(from, place));
    if side.abs() <= TANGENT * length(minus(from, place)) {
        return Err(JointError::DoesNotFit);
    }
    let side = side.signum();
    let centre = plus(place, times(left_of(direction), side * radius));
    let outwards = minus(from, centre);
    let distance = length(outwards);
    if distance <= radius {
        return Err(JointError::DoesNotFit);
    }
    let angle = outwards[1].atan2(outwards[0]) + side * (radius / distance).acos();
    let touch = plus(centre, times([angle.cos(), angle.sin()], radius));
    Ok((touch, (centre, side < 0.0)))
}

/// 1 where the path turns to the left, -1 to the right, `None` where it goes straight on.
fn turn(first: &Element, second: &Element) -> Result<Option<f64>, JointError> {
    let (before, after) = (first.end_direction(), second.start_direction());
    let side = cross(before, after);
    if side.abs() > TANGENT {
        return Ok(Some(side.signum()));
    }
    match dot(before, after) > 0.0 {
        true => Ok(None),
        false => Err(JointError::Reversal),
    }
}

/// Where the two motions, shifted to the left by `offset`, meet.
fn offset_crossings(first: &Element, second: &Element, offset: f64) -> [Option<Point>; 2] {
    match (shifted(first, offset), shifted(second, offset)) {
        (Some(Curve::Line(a, u)), Some(Curve::Line(b, v))) => {
            let t = cross(minus(b, a), v) / cross(u, v);
            [Some(plus(a, times(u, t))), None]
        }
        (Some(Curve::Line(a, u)), Some(Curve::Circle(centre, radius)))
        | (Some(Curve::Circle(centre, radius)), Some(Curve::Line(a, u))) => {
            let foot = plus(a, times(u, dot(minus(centre, a), u)));
            let height = length(minus(foot, centre));
            if height > radius {
                return [None, None];
            }
            let half = (radius * radius - height * height).sqrt();
            [half, -half].map(|step| Some(plus(foot, times(u, step))))
        }
        (Some(Curve::Circle(a, r)), Some(Curve::Circle(b, s))) => {
            let between = minus(b, a);
            let distance = length(between);
            if distance == 0.0 || distance > r + s || distance < (r - s).abs() {
                return [None, None];
            }
            let along = (distance * distance + r * r - s * s) / (2.0 * distance);
            let height = (r * r - along * along).max(0.0).sqrt();
            let (ahead, aside) = (unit(between), left_of(unit(between)));
            let middle = plus(a, times(ahead, along));
            [height, -height].map(|step| Some(plus(middle, times(aside, step))))
        }
        _ => [None, None],
    }
}

enum Curve {
    /// A point and a direction.
    Line(Point, Point),
    /// Centre and radius.
    Circle(Point, f64),
}

/// A motion shifted to the left; `None` where nothing is left of an arc.
fn shifted(element: &Element, offset: f64) -> Option<Curve> {
    let Some((centre, clockwise)) = element.arc else {
        let direction = element.start_direction();
        let aside = times(left_of(direction), offset);
        return Some(Curve::Line(plus(element.start, aside), direction));
    };
    let radius = length(minus(element.start, centre));
    // The centre of a counterclockwise arc is on its left.
    let radius = if clockwise {
        radius + offset
    } else {
        radius - offset
    };
    (radius > 0.0).then_some(Curve::Circle(centre, radius))
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

fn times(a: Point, factor: f64) -> Point {
    a.map(|value| value * factor)
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: Point) -> f64 {
    a[0].hypot(a[1])
}

fn unit(a: Point) -> Point {
    times(a, 1.0 / length(a))
}

fn left_of(a: Point) -> Point {
    [-a[1], a[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(start: Point, end: Point) -> Element {
        Element {
            start,
            end,
            arc: None,
        }
    }

    fn near(a: Point, b: Point) {
        assert!(length(minus(a, b)) < 1e-12, "{a:?}, not {b:?}");
    }

    #[test]
    fn a_right_angle_is_rounded_on_both_sides() {
        let first = line([0.0, 0.0], [10.0, 0.0]);
        for (second, centre, clockwise) in [
            (line([10.0, 0.0], [10.0, 10.0]), [8.0, 2.0], false),
            (line([10.0, 0.0], [10.0, -10.0]), [8.0, -2.0], true),
        ] {
            let joint = round(&first, &second, 2.0).unwrap().unwrap();
            near(joint.start, [8.0, 0.0]);
            near(joint.end, [10.0, centre[1]]);
            let (given, direction) = joint.arc.unwrap();
            near(given, centre);
            assert_eq!(direction, clockwise);
        }
        assert_eq!(
            round(&first, &line([10.0, 0.0], [10.0, 1.0]), 2.0),
            Err(JointError::DoesNotFit)
        );
        assert_eq!(
            round(&first, &line([10.0, 0.0], [12.0, 0.0]), 2.0),
            Ok(None)
        );
        assert_eq!(
            round(&first, &line([10.0, 0.0], [5.0, 0.0]), 2.0),
            Err(JointError::Reversal)
        );
    }

    #[test]
    fn an_arc_is_met_from_inside_and_outside() {
        // Up the Y axis, then clockwise about (10, 10) from (0, 10): a left of nothing, tangent.
        let first = line([-10.0, 10.0], [0.0, 10.0]);
        let second = Element {
            start: [0.0, 10.0],
            end: [10.0, 20.0],
            arc: Some(([10.0, 10.0], true)),
        };
        let joint = round(&first, &second, 2.0).unwrap().unwrap();
        let (centre, clockwise) = joint.arc.unwrap();
        assert!(!clockwise);
        assert!((centre[1] - 12.0).abs() < 1e-12);
        assert!((length(minus(centre, [10.0, 10.0])) - 12.0).abs() < 1e-12);
        near(joint.start, [centre[0], 10.0]);
        assert!((length(minus(joint.end, [10.0, 10.0])) - 10.0).abs() < 1e-12);
    }

    #[test]
    fn chamfers_by_distance_and_by_length() {
        let first = line([0.0, 0.0], [10.0, 0.0]);
        let second = line([10.0, 0.0], [10.0, 10.0]);
        let joint = chamfer_from(&first, &second, 3.0).unwrap().unwrap();
        near(joint.start, [7.0, 0.0]);
        near(joint.end, [10.0, 3.0]);
        let joint = chamfer_of(&first, &second, 2.0_f64.sqrt())
            .unwrap()
            .unwrap();
        near(joint.start, [9.0, 0.0]);
        near(joint.end, [10.0, 1.0]);
    }

    #[test]
    fn tangential_entry_and_exit() {
        // From (-10, 5) to a path that begins at the origin in the direction of X: by an arc of 5 about
        // (0, 5) the tangent from (-10, 5) meets it on the lower left.
        let first = line([-10.0, 5.0], [0.0, 0.0]);
        let second = line([0.0, 0.0], [10.0, 0.0]);
        let joint = enter(&first, &second, 5.0).unwrap();
        let (centre, clockwise) = joint.arc.unwrap();
        near(centre, [0.0, 5.0]);
        assert!(!clockwise);
        near(joint.end, [0.0, 0.0]);
        let touch = minus(joint.start, centre);
        assert!(dot(touch, minus(joint.start, first.start)).abs() < 1e-9);
        assert!(joint.start[0] < 0.0 && joint.start[1] < 5.0);
        // Backwards it is an exit.
        let turned = |element: &Element| line(element.end, element.start);
        let out = leave(&turned(&second), &turned(&first), 5.0).unwrap();
        near(out.end, joint.start);
        assert_eq!(out.arc, Some((centre, true)));
    }
}
