//! Two lines that a short arc joins, and a little more behind them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, at, equal_limits, feed_move, with_room};
use crate::program::run::run;
use crate::program::{Program, Programmed, Shape, checked};
use crate::random_program::undisturbed;
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Circle;

/// A line, an arc, a line and two micrometres of another one, at this feed and tolerance.
fn fillet(
    line: (f64, f64),
    arc: (f64, f64),
    behind: [f64; 3],
    feed: f64,
    tolerance: f64,
) -> Vec<Programmed> {
    let (length, direction) = line;
    let (radius, angle) = arc;
    let [x, y, z] = behind;
    let in_space = |x, y, z| Shape::Line(Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    [
        in_space(length * direction.cos(), length * direction.sin(), 0.1),
        Shape::Arc {
            radial: [1.0, 0.5, 0.0],
            tilt: [0.0, 0.0, 1.0],
            radius,
            angle,
            height: 0.0,
            revolutions: 0,
            others: [0.0; 6],
        },
        in_space(x, y, z),
        in_space(0.0, 0.002, 0.0),
    ]
    .map(|shape| Programmed {
        mode: Some(TerminationCondition::Continuous { tolerance }),
        ..Programmed::feed(shape, feed)
    })
    .into()
}

fn any_fillet() -> impl Strategy<Value = Program> {
    let strategy = (
        (0.3..6.0, 0.0..TAU, 0.01..1.0, 10.0..200.0),
        (0.01..0.4, 0.006..0.9),
        (0.002..3.0, -3.0..3.0, -3.0..3.0),
        3.7..5.2,
    );
    strategy.prop_map(
        |((length, direction, tolerance, feed), arc, (x, y, z), jerk)| {
            let moves = fillet((length, direction), arc, [x, y, z], feed, tolerance);
            undisturbed(equal_limits(10f64.powf(jerk)), moves)
        },
    )
}

/// The easements at both ends of a short arc may be many times as wide as it is long.
#[test]
fn short_arcs_between_wide_easements_keep_the_limits() {
    let config = ProptestConfig {
        cases: 60,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let result = seeded_runner(config).run(&any_fillet(), |program| {
        with_room(|| run(&program)).map(|_| ())
    });
    checked(result);
}

/// Two lines that an arc joins without a corner.
#[derive(Clone, Copy, Debug)]
struct RoundedCorner {
    /// Of each line, mm.
    length: f64,
    radius: f64,
    /// Radians.
    angle: f64,
    tolerance: f64,
    feed: f64,
    acceleration: f64,
    jerk: f64,
}

impl RoundedCorner {
    /// With lines of 20 mm, at F6000, 1000 mm/s2 and 20000 mm/s3.
    fn new(radius: f64, angle: f64, tolerance: f64) -> Self {
        Self {
            length: 20.0,
            radius,
            angle,
            tolerance,
            feed: 100.0,
            acceleration: 1000.0,
            jerk: 2e4,
        }
    }

    /// Of all kinds, within this tolerance.
    fn all(tolerance: f64) -> impl Iterator<Item = Self> {
        let angles = [PI / 6.0, FRAC_PI_2, 0.999 * PI];
        [0.2, 0.5, 1.0, 2.0]
            .into_iter()
            .flat_map(move |radius| angles.map(|angle| Self::new(radius, angle, tolerance)))
    }

    /// Servo periods that it takes.
    fn periods(&self) -> f64 {
        let mut periods = 0;
        with_room(|| {
            let mut machine = Machine::new(AxisLimits {
                acceleration: Axes::repeat(self.acceleration),
                ..equal_limits(self.jerk)
            });
            let (length, radius, tolerance) = (self.length, self.radius, self.tolerance);
            let continuous = TerminationCondition::Continuous { tolerance };
            machine.planner.set_termination(continuous);
            let request = feed_move(self.feed);
            machine.line(at(length, 0.0), &request).expect("a line");
            let circle = Circle {
                center: at(length, radius).fixed_rows::<3>(0).into(),
                normal: [0.0, 0.0, 1.0].into(),
                revolutions: 0,
            };
            let (sine, cosine) = self.angle.sin_cos();
            let end = at(length + radius * sine, radius - radius * cosine);
            machine.circle(end, &circle, &request).expect("an arc");
            machine
                .line(end + at(cosine, sine) * length, &request)
                .expect("a line");
            periods = machine.run(20_000);
        });
        periods as f64
    }
}

/// Each of these corners takes no longer than the one before it, to `rounding`.
fn costs_no_time(corners: impl Iterator<Item = RoundedCorner>, rounding: f64) {
    let taken: Vec<_> = corners.map(|corner| (corner, corner.periods())).collect();
    for pair in taken.windows(2) {
        let [(_, less), (_, more)] = pair else {
            unreachable!("windows of two")
        };
        assert!(*more <= rounding * less + 2.0, "{pair:?} periods");
    }
}

/// Easements as wide as the tolerance lets them be led back and forth beside an arc that is small for it: with R .2 and P .8 a right
/// angle took 1.26 times as long as with P .01.
#[test]
fn more_tolerance_of_a_rounded_corner_costs_no_time() {
    for corner in RoundedCorner::all(0.0) {
        let tolerances = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8].into_iter();
        costs_no_time(
            tolerances.map(|tolerance| RoundedCorner {
                tolerance,
                ..corner
            }),
            1.01,
        );
    }
}

/// Nor, to 3 % beside short lines, where the radius becomes small for it: arcs that are slow for their acceleration took up to 1.16
/// times as long as chords.
#[test]
fn more_tolerance_for_a_radius_costs_hardly_any_time() {
    for radius in [0.5, 1.0, 2.0, 4.0] {
        for (length, jerk) in [(2.0, 1e4), (2.0, 2e4), (5.0, 2e4), (2.0, 1e5)] {
            let tolerances = [21.0, 19.8, 19.0, 15.0, 10.0, 7.0, 4.6, 4.4, 4.0].into_iter();
            costs_no_time(
                tolerances.map(|share| RoundedCorner {
                    length: length * radius,
                    jerk,
                    ..RoundedCorner::new(radius, FRAC_PI_2, radius / share)
                }),
                1.03,
            );
        }
    }
}

/// Nor do more jerk, acceleration and feed. Where it depended on the jerk whether an arc is run as its chords, more of it took 1.08
/// times as long. Widths are chosen for the feed in steps.
#[test]
fn nor_do_limits() {
    let growing = |first: f64| (0..9).map(move |k| first * 1.2f64.powi(k));
    for corner in RoundedCorner::all(0.1).filter(|corner| corner.radius <= 0.5) {
        costs_no_time(
            growing(1.6e4).map(|jerk| RoundedCorner { jerk, ..corner }),
            1.01,
        );
        costs_no_time(
            growing(40.0).map(|feed| RoundedCorner { feed, ..corner }),
            1.02,
        );
        costs_no_time(
            growing(400.0).map(|acceleration| RoundedCorner {
                acceleration,
                ..corner
            }),
            1.02,
        );
    }
}

/// Nor does more jerk on a slow machine. What may limit the path's jerk did not depend on how slow a machine is, so that arcs were
/// led on narrower easements the more jerk there was: 1.15 times as long without a limit as with 50 accelerations a second.
#[test]
fn nor_does_jerk_on_a_slow_machine() {
    for radius in [0.25, 1.0, 2.0, 5.0] {
        for angle in [PI / 4.0, FRAC_PI_2] {
            let corner = RoundedCorner {
                feed: 30.0,
                acceleration: 100.0,
                ..RoundedCorner::new(radius, angle, 0.5)
            };
            let jerks = [2e3, 5e3, 1e4, 4e4, f64::INFINITY];
            costs_no_time(
                jerks
                    .map(|jerk| RoundedCorner { jerk, ..corner })
                    .into_iter(),
                1.01,
            );
        }
    }
}

/// As arcs with easements they took as long with P .2 as with P .01.
#[test]
fn small_arcs_use_the_tolerance() {
    for radius in [0.2, 0.5] {
        for angle in [PI / 6.0, FRAC_PI_2] {
            let [narrow, wide] =
                [0.01, 0.2].map(|p| RoundedCorner::new(radius, angle, p).periods());
            assert!(
                wide < 0.96 * narrow,
                "R {radius}, {angle} radians: {narrow}, {wide} periods"
            );
        }
    }
}
