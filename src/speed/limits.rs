//! Limits of the axes as limits along a path.
//!
//! With q(s) the path and v = ds/dt, a and j its derivatives, each axis has to keep
//!
//! ```text
//! |q' v| <= V      |q' a + q'' v^2| <= A      |q' j + 3 q'' v a + q''' v^3| <= J
//! ```

use super::path_limits::PathLimits;
use super::profile::JerkLimitedProfile;
use crate::axes::{Axes, AxisLimits};
use crate::cube_root::cube_root;
use crate::machine_map::MachineMap;
use crate::moves::shape::{ArcExtent, Shape};

impl PathLimits {
    /// What a shape allows below a velocity of `cap` > 0, with the axes of the machine lying to
    /// those of the program as `map` says.
    ///
    /// Exact for lines. On an arc a higher speed leaves less acceleration and jerk along the
    /// path: of a fixed number of splits the one is taken that runs the whole arc from rest to
    /// rest in the least time.
    pub fn of(shape: &Shape, map: &MachineMap, axes: &AxisLimits, cap: f64) -> Self {
        match shape {
            Shape::Line(line) => {
                let direction = map.apply(line.direction());
                let least = |limits: &Axes| {
                    limits
                        .iter()
                        .zip(direction.iter())
                        .filter(|(_, direction)| **direction != 0.0)
                        .map(|(limit, direction)| limit / direction.abs())
                        .fold(f64::INFINITY, f64::min)
                };
                Self {
                    velocity: least(&axes.velocity).min(cap),
                    acceleration: least(&axes.acceleration),
                    jerk: least(&axes.jerk),
                }
            }
            Shape::Arc(arc) => of_arc(&arc.extent(map), arc.length(), axes, cap),
        }
    }
}

/// Speeds that are tried, as shares of the greatest possible one.
const SPEEDS: [f64; 8] = [1.0, 0.93, 0.86, 0.79, 0.7, 0.6, 0.45, 0.3];

/// Accelerations that are tried, as shares of what the speed leaves.
const ACCELERATIONS: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

fn of_arc(extent: &ArcExtent, length: f64, axes: &AxisLimits, cap: f64) -> PathLimits {
    let greatest = greatest_speed(extent, axes, cap);
    let mut best = PathLimits {
        velocity: 0.0,
        acceleration: 0.0,
        jerk: 0.0,
    };
    let mut least_time = f64::INFINITY;
    for speed in SPEEDS {
        let velocity = greatest * speed;
        let most = acceleration_left(extent, axes, velocity);
        for share in ACCELERATIONS {
            let acceleration = most * share;
            let jerk = jerk_left(extent, axes, velocity, acceleration);
            let limits = PathLimits {
                velocity,
                acceleration,
                jerk,
            };
            if acceleration > 0.0 && jerk > 0.0 {
                let time = JerkLimitedProfile::rest_to_rest(length, &limits).duration();
                if time < least_time {
                    least_time = time;
                    best = limits;
                }
            }
        }
    }
    best
}

/// One axis of an arc: how much of the motion in the plane and of the motion in proportion it
/// takes, and its limits.
struct ArcAxis {
    turning: f64,
    linear: f64,
    velocity: f64,
    acceleration: f64,
    jerk: f64,
}

fn rows<'a>(extent: &'a ArcExtent, axes: &'a AxisLimits) -> impl Iterator<Item = ArcAxis> + 'a {
    // Vectors that are not quite perpendicular add up to more than the square root of the sum of
    // squares, by at most this factor.
    let oblique = (1.0 + extent.cosine).sqrt();
    extent
        .amplitude
        .iter()
        .zip(extent.linear.iter())
        .zip(
            axes.velocity
                .iter()
                .zip(axes.acceleration.iter())
                .zip(axes.jerk.iter()),
        )
        .map(
            move |((amplitude, linear), ((velocity, acceleration), jerk))| ArcAxis {
                turning: amplitude * oblique,
                linear: *linear,
                velocity: *velocity,
                acceleration: *acceleration,
                jerk: *jerk,
            },
        )
        .filter(|row| row.turning > 0.0 || row.linear > 0.0)
}

/// The speed at which the first axis has nothing left for changes of speed.
fn greatest_speed(extent: &ArcExtent, axes: &AxisLimits, cap: f64) -> f64 {
    let [first, second, third] = extent.derivative;
    rows(extent, axes).fold(cap, |speed, row| {
        let velocity = row.velocity / (row.turning * first + row.linear);
        let centripetal = (row.acceleration / (row.turning * second)).sqrt();
        let jerk = cube_root(row.jerk / (row.turning * third));
        speed.min(velocity).min(centripetal).min(jerk)
    })
}

/// The acceleration along the arc that all axes have left at a speed, and that does not take all
/// of their jerk.
fn acceleration_left(extent: &ArcExtent, axes: &AxisLimits, velocity: f64) -> f64 {
    let [first, second, _] = extent.derivative;
    let centripetal = second / first * velocity * velocity;
    rows(extent, axes)
        .map(|row| {
            let by_jerk = row.jerk / (3.0 * row.turning * second * velocity);
            along(
                row.turning * first,
                row.linear,
                row.acceleration,
                centripetal,
            )
            .min(by_jerk)
        })
        .fold(f64::INFINITY, f64::min)
}

/// The jerk along the arc that all axes have left at a speed and an acceleration.
fn jerk_left(extent: &ArcExtent, axes: &AxisLimits, velocity: f64, acceleration: f64) -> f64 {
    let [first, second, third] = extent.derivative;
    let backward = third / first * velocity * velocity * velocity;
    rows(extent, axes)
        .map(|row| {
            if row.jerk == f64::INFINITY {
                return f64::INFINITY;
            }
            let across = 3.0 * second / first * velocity * acceleration;
            let bound = row.jerk + row.linear * backward;
            along(row.turning * first, row.linear, bound, across) - backward
        })
        .fold(f64::INFINITY, f64::min)
}

/// The greatest x with `turning sqrt(x^2 + across^2) + linear x <= bound`, 0 if `across` alone
/// takes more.
fn along(turning: f64, linear: f64, bound: f64, across: f64) -> f64 {
    if bound == f64::INFINITY {
        return f64::INFINITY;
    }
    // The quadratic's solution in the form without cancellation.
    let rest = bound * bound - (turning * across) * (turning * across);
    if rest <= 0.0 {
        return 0.0;
    }
    let root = rest + (linear * across) * (linear * across);
    rest / (bound * linear + turning * root.sqrt())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use proptest::prelude::*;

    use super::*;
    use crate::moves::shape::{Arc9, Circle, Line9};

    fn equal_limits(velocity: f64, acceleration: f64, jerk: f64) -> AxisLimits {
        AxisLimits {
            velocity: Axes::repeat(velocity),
            acceleration: Axes::repeat(acceleration),
            jerk: Axes::repeat(jerk),
        }
    }

    #[test]
    fn a_diagonal_uses_all_axes() {
        let line = Line9::new(
            &Axes::zeros(),
            &Axes::from([3.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        );
        let limits = PathLimits::of(
            &Shape::Line(line.expect("a line")),
            &MachineMap::IDENTITY,
            &equal_limits(100.0, 1000.0, 20_000.0),
            1e9,
        );
        assert!((limits.velocity - 125.0).abs() < 1e-12);
        assert!((limits.acceleration - 1250.0).abs() < 1e-12);
        assert!((limits.jerk - 25_000.0).abs() < 1e-9);
    }

    fn quarter(radius: f64) -> Shape {
        let start = Axes::from([radius, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let end = Axes::from([0.0, radius, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            revolutions: 0,
        };
        Shape::Arc(Arc9::new(&start, &end, &circle).expect("an arc"))
    }

    #[test]
    fn a_slow_arc_takes_hardly_longer_than_a_line() {
        let axes = equal_limits(100.0, 1000.0, 20_000.0);
        let arc = quarter(100.0);
        let limits = PathLimits::of(&arc, &MachineMap::IDENTITY, &axes, 10.0);
        assert_eq!(limits.velocity, 10.0);
        let time =
            |limits: &PathLimits| JerkLimitedProfile::rest_to_rest(arc.length(), limits).duration();
        let line = PathLimits {
            velocity: 10.0,
            acceleration: 1000.0,
            jerk: 20_000.0,
        };
        assert!(time(&limits) < 1.0001 * time(&line));
    }

    #[test]
    fn unlimited_axes_leave_the_cap() {
        let all = f64::INFINITY;
        let limits = PathLimits::of(
            &quarter(10.0),
            &MachineMap::IDENTITY,
            &equal_limits(all, all, all),
            70.0,
        );
        assert_eq!(
            limits,
            PathLimits {
                velocity: 70.0,
                acceleration: all,
                jerk: all
            }
        );
        let no_jerk = PathLimits::of(
            &quarter(10.0),
            &MachineMap::IDENTITY,
            &equal_limits(100.0, 1000.0, all),
            70.0,
        );
        assert!(no_jerk.acceleration > 800.0 && no_jerk.jerk == all);
        let no_acceleration = PathLimits::of(
            &quarter(10.0),
            &MachineMap::IDENTITY,
            &equal_limits(100.0, all, 20_000.0),
            70.0,
        );
        assert!(no_acceleration.acceleration.is_finite() && no_acceleration.jerk > 0.0);
    }

    fn any_axis_limits() -> impl Strategy<Value = AxisLimits> {
        let one = || prop::array::uniform9(0.1..1.0f64);
        (one(), one(), one(), 3.7..5.5f64).prop_map(|(v, a, j, jerk)| AxisLimits {
            velocity: Axes::from(v) * 200.0,
            acceleration: Axes::from(a) * 2000.0,
            jerk: Axes::from(j) * 10f64.powf(jerk),
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Whatever a profile does within the limits along the arc, no axis exceeds its own.
        #[test]
        fn arcs_keep_every_axis_within_its_limits(
            axes in any_axis_limits(),
            (normal, tilt) in (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-1.0..1.0f64)),
            (radius, growth, height) in (0.01..100.0f64, 0.5..2.0f64, -20.0..20.0f64),
            (to, revolutions) in (0.01..6.2f64, -2..2i32),
            others in prop::array::uniform6(-20.0..20.0f64),
            (cap, share, signs) in (1.0..300.0f64, 0.0..=1.0f64, (0..4u32)),
        ) {
            let normal = Vector3::from(normal);
            let radial = normal.cross(&Vector3::from(tilt));
            prop_assume!(normal.norm() > 0.1 && radial.norm() > 0.1);
            let (normal, radial) = (normal.normalize(), radial.normalize());
            let other = normal.cross(&radial);
            let mut start = Axes::zeros();
            let mut end = Axes::zeros();
            start.fixed_rows_mut::<3>(0).copy_from(&(radial * radius));
            let last = (radial * to.cos() + other * to.sin()) * (radius * growth) + normal * height;
            end.fixed_rows_mut::<3>(0).copy_from(&last);
            end.fixed_rows_mut::<6>(3).copy_from(&nalgebra::Vector6::from(others));
            let circle = Circle { center: Vector3::zeros(), normal, revolutions };
            let arc = Arc9::new(&start, &end, &circle).expect("an arc");
            let limits = PathLimits::of(&Shape::Arc(arc), &MachineMap::IDENTITY, &axes, cap);
            prop_assert!(limits.velocity > 0.0 && limits.velocity <= cap);
            prop_assert!(limits.acceleration > 0.0 && limits.jerk > 0.0);

            let point = arc.point(share * arc.length());
            let v = limits.velocity;
            let a = limits.acceleration * if signs & 1 == 0 { 1.0 } else { -1.0 };
            let j = limits.jerk * if signs & 2 == 0 { 1.0 } else { -1.0 };
            let velocity = point.first * v;
            let acceleration = point.first * a + point.second * (v * v);
            let jerk = point.first * j + point.second * (3.0 * v * a) + point.third * (v * v * v);
            for axis in 0..9 {
                let near = 1.0 + 1e-9;
                prop_assert!(velocity[axis].abs() <= axes.velocity[axis] * near);
                prop_assert!(acceleration[axis].abs() <= axes.acceleration[axis] * near);
                prop_assert!(jerk[axis].abs() <= axes.jerk[axis] * near);
            }
        }

        /// What is said of vectors that are not quite perpendicular: of a growing circle.
        #[test]
        fn spirals_keep_every_axis_within_its_limits_all_along(
            (growth, to) in (prop_oneof![0.2..0.8f64, 1.2..4.0f64], 0.2..3.0f64),
            (velocity, acceleration, jerk) in (20.0..2000.0f64, 200.0..2000.0f64, 2e3..2e5f64),
        ) {
            let start = Axes::from([10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let (x, y) = (10.0 * growth * to.cos(), 10.0 * growth * to.sin());
            let end = Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let circle = Circle { center: Vector3::zeros(), normal: Vector3::z(), revolutions: 0 };
            let arc = Arc9::new(&start, &end, &circle).expect("an arc");
            let axes = equal_limits(velocity, acceleration, jerk);
            let extent = arc.extent(&MachineMap::IDENTITY);
            let v = greatest_speed(&extent, &axes, 1e9);
            for share in (0..=40).map(|i| f64::from(i) / 40.0) {
                let point = arc.point(share * arc.length());
                for speed in [v, 0.7 * v, 0.3 * v] {
                    let a = acceleration_left(&extent, &axes, speed);
                    let j = jerk_left(&extent, &axes, speed, 0.5 * a);
                    for sign in [-1.0, 1.0] {
                        let taken = point.first * (sign * a) + point.second * (speed * speed);
                        prop_assert!(taken.fixed_rows::<2>(0).norm() <= acceleration * (1.0 + 1e-9));
                        let change = point.first * (sign * j)
                            + point.second * (1.5 * speed * a)
                            + point.third * (speed * speed * speed);
                        prop_assert!(j <= 0.0 || change.amax() <= jerk * (1.0 + 1e-9));
                    }
                }
            }
        }

        /// The greatest x is the one at which the bound is met.
        #[test]
        fn what_is_left_is_used_up(
            (turning, linear) in (0.0..2.0f64, 0.0..2.0f64),
            (bound, across) in (0.1..100.0f64, 0.0..100.0f64),
        ) {
            prop_assume!(turning + linear > 0.01);
            let x = along(turning, linear, bound, across);
            if turning * across >= bound {
                prop_assert_eq!(x, 0.0);
            } else {
                let met = turning * x.hypot(across) + linear * x;
                prop_assert!((met - bound).abs() < 1e-9 * bound, "{} of {}", met, bound);
            }
        }
    }

    /// A circle of radius r, in closed form.
    #[test]
    fn a_circle_leaves_what_its_curvature_leaves() {
        let r = 10.0;
        let Shape::Arc(arc) = quarter(r) else {
            panic!("no arc");
        };
        let extent = arc.extent(&MachineMap::IDENTITY);
        let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b, "{a} is not {b}");
        let all = f64::INFINITY;
        let speed = |v, a, j| greatest_speed(&extent, &equal_limits(v, a, j), 1e9);
        same(speed(80.0, all, all), 80.0);
        same(speed(all, 1000.0, all), 100.0);
        same(speed(all, all, 80_000.0), 200.0);
        let axes = equal_limits(all, 1000.0, 20_000.0);
        let left = |v: f64| (1e6 - (v * v / r).powi(2)).sqrt();
        same(acceleration_left(&extent, &axes, 40.0), left(40.0));
        // Softer axes: then it is what the acceleration takes of the jerk, 3 v a / r.
        let softer = equal_limits(all, 1000.0, 10_000.0);
        same(
            acceleration_left(&extent, &softer, 60.0),
            10_000.0 * r / 180.0,
        );
        let (v, a) = (40.0, 300.0);
        let across = 3.0 * v * a / r;
        let backward = v * v * v / (r * r);
        let along_the_path = (20_000f64.powi(2) - across * across).sqrt();
        same(jerk_left(&extent, &axes, v, a), along_the_path - backward);
    }

    /// A helix whose height is 3/4 of its way in the plane: of each unit .8 and .6.
    #[test]
    fn what_moves_in_proportion_counts() {
        let height = 0.75 * std::f64::consts::FRAC_PI_2 * 10.0;
        let start = Axes::from([10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let end = Axes::from([0.0, 10.0, height, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let circle = Circle {
            center: Vector3::zeros(),
            normal: Vector3::z(),
            revolutions: 0,
        };
        let arc = Arc9::new(&start, &end, &circle).expect("an arc");
        let extent = arc.extent(&MachineMap::IDENTITY);
        let mut axes = equal_limits(f64::INFINITY, f64::INFINITY, f64::INFINITY);
        axes.velocity[2] = 30.0;
        axes.acceleration[2] = 300.0;
        axes.jerk[2] = 6000.0;
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b, "{a} is not {b}");
        near(greatest_speed(&extent, &axes, 1e9), 50.0);
        near(acceleration_left(&extent, &axes, 10.0), 500.0);
        // What runs on evenly does not go back with the third derivative in the plane.
        near(jerk_left(&extent, &axes, 10.0, 100.0), 10_000.0);
    }
}
