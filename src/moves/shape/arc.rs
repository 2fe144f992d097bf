//! An arc, helix or spiral in XYZ, the other axes in proportion to the angle.

use core::f64::consts::TAU;

use nalgebra::{SVector, Vector3};

use super::error::{GREATEST_LENGTH, ShapeError, check_coordinates};
use super::measure::LEAST_DISTANCE;
use super::point::PathPoint;
use crate::axes::Axes;
use crate::machine_map::MachineMap;

/// An arc whose end direction is nearer to its start direction than this, in radians, is a full
/// circle, as in LinuxCNC.
const FULL_CIRCLE_WITHIN: f64 = 1e-6;

/// The share of an axis in an arc that is nothing but rounding.
const NO_SHARE: f64 = 1e-9;

/// Beyond this the angle along the arc loses the digits that the end point needs.
const MOST_REVOLUTIONS: i64 = 1_000_000;

/// What determines a circle besides its start and end.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    /// A point of the axis, machine units.
    pub center: Vector3<f64>,
    /// Along the axis, of any length but zero.
    pub normal: Vector3<f64>,
    /// LinuxCNC's `turn`. 0 and above: counter-clockwise about the normal, with so many full ones more. Below 0:
    /// clockwise, with `-1 - revolutions` full ones more.
    pub revolutions: i32,
}

impl Circle {
    /// The full turns besides the way from the start to the end.
    fn further_turns(&self) -> Result<i64, ShapeError> {
        let revolutions = i64::from(self.revolutions);
        let further = if revolutions < 0 {
            -1 - revolutions
        } else {
            revolutions
        };
        if further > MOST_REVOLUTIONS {
            return Err(ShapeError::TooManyRevolutions);
        }
        Ok(further)
    }

    /// The unit vector about which the turn is counter-clockwise.
    fn axis(&self) -> Result<Vector3<f64>, ShapeError> {
        let size = self.normal.norm();
        if !size.is_finite() {
            return Err(ShapeError::NotFinite);
        }
        if size < f64::MIN_POSITIVE {
            return Err(ShapeError::NoNormal);
        }
        let sign = if self.revolutions < 0 { -1.0 } else { 1.0 };
        Ok(self.normal * (sign / size))
    }
}

/// An arc (constant radius), spiral (the radius changes in proportion to the angle), helix (so
/// does the height) or both.
///
/// The parameter s grows in proportion to the angle. For arcs and helices it is the distance
/// travelled in XYZ. For spirals it is the distance at the greatest radius: the speed in XYZ is
/// at most ds/dt everywhere and equal to it where the radius is greatest. (LinuxCNC's interpreter
/// lets the radius differ by a thousandth, so little speed is lost, and the derivatives stay
/// exact.)
#[derive(Clone, Copy, Debug)]
pub struct Arc9 {
    start: Axes,
    end: Axes,
    /// Where the axis meets the plane of the start point, with the start values of the other axes.
    base: Axes,
    /// Unit vector from the axis to the start point, zero beyond XYZ.
    radial: Axes,
    /// Unit vector of the direction of travel at the start of a plain arc, zero beyond XYZ.
    tangential: Axes,
    /// d/ds of what moves in proportion: height, A B C U V W.
    linear: Axes,
    radius: f64,
    /// Change of the radius per radian.
    radius_rate: f64,
    /// Radians per unit of s.
    angular_rate: f64,
    length: f64,
}

/// How far the derivatives of an arc reach, for limits on speed that hold everywhere on it.
#[derive(Clone, Copy, Debug)]
pub struct ArcExtent {
    /// For each axis, the length of the circle's plane as seen along it, 0 to 1.
    pub amplitude: Axes,
    /// For each axis, |dq/ds| of the motion in proportion.
    pub linear: Axes,
    /// Greatest length of the first, second and third derivative within the plane.
    pub derivative: [f64; 3],
    /// Greatest cosine between the second derivative and the first or third; 0 for a constant
    /// radius.
    pub cosine: f64,
}

impl Arc9 {
    /// The arc between two points, shapes (9). The start point fixes the plane; the centre is
    /// moved into it along the normal.
    ///
    /// # Errors
    /// [`ShapeError::NoNormal`], [`ShapeError::RadiusTooSmall`], [`ShapeError::TooManyRevolutions`],
    /// [`ShapeError::NotFinite`], [`ShapeError::TooFar`].
    pub fn new(start: &Axes, end: &Axes, circle: &Circle) -> Result<Self, ShapeError> {
        let further = circle.further_turns()?;
        let ends = start.iter().chain(end);
        check_coordinates(ends.chain(circle.center.iter()))?;
        let normal = circle.axis()?;
        let first = xyz(start);
        let last = xyz(end);
        let center = circle.center + normal * normal.dot(&(first - circle.center));
        let radius = (first - center).norm();
        let height = normal.dot(&(last - center));
        let last_radial = last - center - normal * height;
        let last_radius = last_radial.norm();
        if radius < LEAST_DISTANCE || last_radius < LEAST_DISTANCE {
            return Err(ShapeError::RadiusTooSmall);
        }
        let radial = (first - center) / radius;
        let tangential = normal.cross(&radial);
        let angle = turned(&radial, &tangential, &last_radial) + TAU * further as f64;
        let radius_rate = (last_radius - radius) / angle;
        let greatest_radius = radius.max(last_radius);
        let length = angle * norm3(greatest_radius, radius_rate, height / angle);
        if length > GREATEST_LENGTH || (end - start).amax() > GREATEST_LENGTH {
            return Err(ShapeError::TooFar);
        }
        let mut arc = Self {
            start: *start,
            end: *end,
            base: *start,
            radial: nine(&radial),
            tangential: nine(&tangential),
            linear: Axes::zeros(),
            radius,
            radius_rate,
            angular_rate: angle / length,
            length,
        };
        arc.base.fixed_rows_mut::<3>(0).copy_from(&center);
        // Whatever the turning part leaves of the way to the end point is travelled in
        // proportion: height, the other axes, and the last digits of XYZ.
        arc.linear = (end - arc.turning(length)) / length;
        Ok(arc)
    }

    /// The arc about the same axis to the same end from another place beside its start; `None` where that would be another
    /// way.
    pub fn from_beside(&self, start: &Axes) -> Option<Self> {
        let circle = Circle {
            center: xyz(&self.base),
            normal: xyz(&self.radial).cross(&xyz(&self.tangential)),
            revolutions: (self.angle() / TAU) as i32,
        };
        let away = (start - self.start).norm();
        let arc = Self::new(start, &self.end, &circle).ok()?;
        ((arc.length - self.length).abs() <= 2.0 * away).then_some(arc)
    }

    /// The `s` at which it is on the same side of its axis as a point no more than half a turn from its start; below 0 before it.
    pub fn beside(&self, point: &Axes) -> f64 {
        let outward = point - self.base;
        let angle = self
            .tangential
            .dot(&outward)
            .atan2(self.radial.dot(&outward));
        angle / self.angular_rate
    }

    /// The angle from the start to the end about the axis, radians, above 0.
    pub fn angle(&self) -> f64 {
        self.angular_rate * self.length
    }

    /// Greatest s.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Where it ends, as given.
    pub fn end(&self) -> Axes {
        self.end
    }

    /// Whether an axis, 0 to 8, moves by more than rounding.
    pub fn moves(&self, axis: usize) -> bool {
        let extent = self.extent(&MachineMap::IDENTITY);
        let above = |axes: &Axes| axes.get(axis).is_some_and(|value| *value > NO_SHARE);
        above(&extent.amplitude) || above(&extent.linear)
    }

    /// The point at `s`, held within 0 and the length.
    pub fn position(&self, s: f64) -> Axes {
        if s <= 0.0 {
            self.start
        } else if s >= self.length {
            self.end
        } else {
            self.turning(s) + self.linear * s
        }
    }

    /// The point at `s`, held within 0 and the length, with derivatives.
    pub fn point(&self, s: f64) -> PathPoint {
        let s = s.max(0.0).min(self.length);
        let (outward, forward) = self.directions(s);
        let radius = self.radius_at(s);
        let rate = self.radius_rate;
        let w = self.angular_rate;
        PathPoint {
            position: self.position(s),
            first: (outward * rate + forward * radius) * w + self.linear,
            second: (forward * (2.0 * rate) - outward * radius) * (w * w),
            third: (outward * (-3.0 * rate) - forward * radius) * (w * w * w),
        }
    }

    /// Bounds of the derivatives on the whole arc, for the axes of the machine.
    pub fn extent(&self, map: &MachineMap) -> ArcExtent {
        let (first_radius, last_radius) = (self.radius, self.radius_at(self.length));
        let greatest = first_radius.max(last_radius);
        let least = first_radius.min(last_radius);
        let rate = self.radius_rate.abs();
        let w = self.angular_rate;
        // cos = k r / sqrt((r^2 + k^2) (r^2 + 4 k^2)) <= k / r, and never above 1/3, for the first
        // and second derivative; for the second and third it is smaller still.
        let cosine = if rate < least {
            (rate / least).min(1.0 / 3.0)
        } else {
            1.0 / 3.0
        };
        ArcExtent {
            amplitude: map
                .apply(&self.radial)
                .zip_map(&map.apply(&self.tangential), f64::hypot),
            linear: map.apply(&self.linear).abs(),
            derivative: [
                greatest.hypot(rate) * w,
                greatest.hypot(2.0 * rate) * (w * w),
                greatest.hypot(3.0 * rate) * (w * w * w),
            ],
            cosine,
        }
    }

    fn radius_at(&self, s: f64) -> f64 {
        self.radius + self.radius_rate * (self.angular_rate * s)
    }

    /// Unit vectors away from the axis and along the turn.
    fn directions(&self, s: f64) -> (Axes, Axes) {
        let (sine, cosine) = (self.angular_rate * s).sin_cos();
        (
            self.radial * cosine + self.tangential * sine,
            self.tangential * cosine - self.radial * sine,
        )
    }

    /// The point at `s` without what moves in proportion.
    fn turning(&self, s: f64) -> Axes {
        self.base + self.directions(s).0 * self.radius_at(s)
    }
}

/// The angle from the start, where these are the directions outward and along the turn, to the direction `last` from
/// the axis: above 0, radians.
fn turned(radial: &Vector3<f64>, tangential: &Vector3<f64>, last: &Vector3<f64>) -> f64 {
    let mut angle = tangential.dot(last).atan2(radial.dot(last));
    if angle < 0.0 {
        angle += TAU;
    }
    if angle < FULL_CIRCLE_WITHIN {
        angle += TAU;
    }
    angle
}

fn xyz(position: &Axes) -> Vector3<f64> {
    Vector3::new(position[0], position[1], position[2])
}

fn nine(v: &Vector3<f64>) -> Axes {
    SVector::from([v[0], v[1], v[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

fn norm3(x: f64, y: f64, z: f64) -> f64 {
    x.hypot(y).hypot(z)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    fn at(x: f64, y: f64, z: f64) -> Axes {
        nine(&Vector3::new(x, y, z))
    }

    fn circle(revolutions: i32) -> Circle {
        Circle {
            center: Vector3::zeros(),
            normal: Vector3::z() * 3.0,
            revolutions,
        }
    }

    #[test]
    fn counter_clockwise_and_clockwise() {
        let (start, end) = (at(2.0, 0.0, 0.0), at(0.0, 2.0, 0.0));
        for (revolutions, angle, middle) in [
            (0, 0.5 * PI, at(2f64.sqrt(), 2f64.sqrt(), 0.0)),
            (-1, 1.5 * PI, at(-(2f64.sqrt()), -(2f64.sqrt()), 0.0)),
            (1, 2.5 * PI, at(-(2f64.sqrt()), -(2f64.sqrt()), 0.0)),
        ] {
            let arc = Arc9::new(&start, &end, &circle(revolutions)).expect("an arc");
            assert!((arc.length() - 2.0 * angle).abs() < 1e-14);
            assert!(
                (arc.position(0.5 * arc.length()) - middle).amax() < 1e-14,
                "{revolutions}"
            );
            assert_eq!(arc.position(0.0), start);
            assert_eq!(arc.position(arc.length()), end);
        }
    }

    #[test]
    fn an_end_at_the_start_is_a_full_turn() {
        let start = at(2.0, 0.0, 0.0);
        for (revolutions, turns) in [(0, 1.0), (2, 3.0), (-1, 1.0), (-2, 2.0)] {
            let arc = Arc9::new(&start, &start, &circle(revolutions)).expect("an arc");
            assert!(
                (arc.length() - 2.0 * TAU * turns).abs() < 1e-12,
                "{revolutions}"
            );
        }
    }

    #[test]
    fn a_helix_is_measured_along_its_slope() {
        let mut end = at(0.0, 2.0, 3.0);
        end[5] = 90.0;
        let helix = Arc9::new(&at(2.0, 0.0, 0.0), &end, &circle(0)).expect("a helix");
        assert!((helix.length() - PI.hypot(3.0)).abs() < 1e-14);
        let middle = helix.point(0.5 * helix.length());
        assert!((middle.position[2] - 1.5).abs() < 1e-14);
        assert!((middle.position[5] - 45.0).abs() < 1e-13);
        assert!((middle.first.fixed_rows::<3>(0).norm() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_centre_is_moved_into_the_plane_of_the_start() {
        let far = Circle {
            center: Vector3::new(0.0, 0.0, 70.0),
            ..circle(0)
        };
        let arc = Arc9::new(&at(2.0, 0.0, 1.0), &at(0.0, 2.0, 1.0), &far).expect("an arc");
        assert!((arc.length() - PI).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_arc_is_refused() {
        let (start, end) = (at(2.0, 0.0, 0.0), at(0.0, 2.0, 0.0));
        let refused =
            |start: &Axes, end: &Axes, circle: Circle| Arc9::new(start, end, &circle).err();
        let no_normal = Circle {
            normal: Vector3::zeros(),
            ..circle(0)
        };
        assert_eq!(refused(&start, &end, no_normal), Some(ShapeError::NoNormal));
        let axis = at(0.0, 0.0, 5.0);
        assert_eq!(
            refused(&axis, &end, circle(0)),
            Some(ShapeError::RadiusTooSmall)
        );
        assert_eq!(
            refused(&start, &axis, circle(0)),
            Some(ShapeError::RadiusTooSmall)
        );
        assert_eq!(
            refused(&start, &end, circle(i32::MAX)),
            Some(ShapeError::TooManyRevolutions)
        );
        assert_eq!(
            refused(&start, &end, circle(i32::MIN)),
            Some(ShapeError::TooManyRevolutions)
        );
        let nowhere = at(f64::NAN, 0.0, 0.0);
        assert_eq!(
            refused(&start, &nowhere, circle(0)),
            Some(ShapeError::NotFinite)
        );
        let far = at(1e10, 0.0, 0.0);
        for (from, to) in [(&start, &far), (&far, &end)] {
            assert_eq!(refused(from, to, circle(0)), Some(ShapeError::TooFar));
        }
        // A million turns of a circle two metres wide.
        assert_eq!(
            refused(&at(1e3, 0.0, 0.0), &at(-1e3, 0.0, 0.0), circle(1_000_000)),
            Some(ShapeError::TooFar)
        );
        let mut turning = end;
        turning[3] = 1.1e7;
        assert_eq!(
            refused(&start, &turning, circle(0)),
            Some(ShapeError::TooFar)
        );
    }

    /// Any arc, helix or spiral: start and end at their own angle and radius in a random plane.
    fn any_arc() -> impl Strategy<Value = Arc9> {
        let length = 0.01..100.0;
        (
            prop::array::uniform3(-1.0..1.0),
            (length.clone(), length, 0.0..TAU, 0.0..TAU, -50.0..50.0),
            prop::array::uniform6(-90.0..90.0),
            (-3..3i32, prop::bool::ANY),
        )
            .prop_filter_map(
                "an axis",
                |(normal, (r0, r1, from, to, height), others, (revolutions, plain))| {
                    let normal = Vector3::from(normal).try_normalize(0.1)?;
                    let across = normal.cross(&Vector3::x()).try_normalize(0.1)?;
                    let along = normal.cross(&across);
                    let place =
                        |r: f64, angle: f64| across * (r * angle.cos()) + along * (r * angle.sin());
                    let center = Vector3::new(others[0], others[1], others[2]);
                    let mut end =
                        nine(&(center + place(if plain { r0 } else { r1 }, to) + normal * height));
                    for (end, other) in end.iter_mut().skip(3).zip(others) {
                        *end = other;
                    }
                    let start = nine(&(center + place(r0, from)));
                    Arc9::new(
                        &start,
                        &end,
                        &Circle {
                            center,
                            normal,
                            revolutions,
                        },
                    )
                    .ok()
                },
            )
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn derivatives_are_those_of_the_position(arc in any_arc(), share in 0.01..0.99f64) {
            // A small angle in terms of the circle, central differences of each order below.
            let step = 1e-4 / arc.angular_rate;
            let s = (share * arc.length()).clamp(step.min(arc.length() * 0.25), arc.length() - step.min(arc.length() * 0.25));
            let step = step.min(arc.length() * 0.25);
            let (before, here, after) = (arc.point(s - step), arc.point(s), arc.point(s + step));
            let slope = |a: Axes, b: Axes| (b - a) / (2.0 * step);
            let w = arc.angular_rate;
            let scale = arc.radius.max(arc.radius_at(arc.length())) + 200.0;
            prop_assert!((slope(before.position, after.position) - here.first).amax() < 1e-6 * scale * w);
            prop_assert!((slope(before.first, after.first) - here.second).amax() < 1e-6 * scale * w * w);
            prop_assert!((slope(before.second, after.second) - here.third).amax() < 1e-6 * scale * w * w * w);
        }

        #[test]
        fn the_end_is_met_without_a_jump(arc in any_arc()) {
            let just_before = arc.turning(arc.length()) + arc.linear * arc.length();
            prop_assert!((just_before - arc.end()).amax() < 1e-12);
            let just_after = arc.turning(0.0);
            prop_assert!((just_after - arc.start).amax() < 1e-12);
        }

        #[test]
        fn extents_bound_the_derivatives(arc in any_arc(), share in 0.0..=1.0f64) {
            let extent = arc.extent(&MachineMap::IDENTITY);
            let point = arc.point(share * arc.length());
            let [first, second, third] = extent.derivative;
            prop_assert!(point.first.fixed_rows::<3>(0).norm() <= 1.0 + 1e-9);
            for axis in 0..9 {
                let amplitude = extent.amplitude[axis];
                let tiny = 1e-12;
                prop_assert!(point.first[axis].abs() <= amplitude * first + extent.linear[axis] + tiny);
                prop_assert!(point.second[axis].abs() <= amplitude * second * (1.0 + tiny) + tiny);
                prop_assert!(point.third[axis].abs() <= amplitude * third * (1.0 + tiny) + tiny);
            }
        }
    }
}
