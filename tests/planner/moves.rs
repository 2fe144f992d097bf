//! Single moves: as fast as the limits allow, and within them.

use std::f64::consts::TAU;

use crate::common::{Machine, PERIOD, feed_move, with_room};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::Circle;
use framepath::planner::CycleInputs;
use nalgebra::Vector3;
use proptest::prelude::*;

fn any_limits() -> impl Strategy<Value = AxisLimits> {
    let one = || prop::array::uniform9(0.2..1.0f64);
    let jerk =
        prop_oneof![3 => (3.7..5.7f64).prop_map(|j| 10f64.powf(j)), 1 => Just(f64::INFINITY)];
    (one(), one(), one(), jerk).prop_map(|(v, a, j, jerk)| AxisLimits {
        velocity: Axes::from(v) * 200.0,
        acceleration: Axes::from(a) * 3000.0,
        jerk: Axes::from(j) * jerk,
    })
}

/// A displacement of one to nine axes, 1 micrometre to 1 metre.
fn any_displacement() -> impl Strategy<Value = Axes> {
    (
        prop::array::uniform9(-1.0..1.0f64),
        1u32..512,
        1e-3f64.ln()..1e3f64.ln(),
    )
        .prop_filter_map("a direction", |(direction, mask, size)| {
            let masked = Axes::from_fn(|i, _| {
                if mask >> i & 1 == 0 {
                    0.0
                } else {
                    direction[i]
                }
            });
            masked.try_normalize(0.1).map(|unit| unit * size.exp())
        })
}

/// The least time from rest to rest over a length, by the cases of the textbook.
fn least_time(length: f64, v: f64, a: f64, j: f64) -> f64 {
    let full = length / v + v / a + a / j;
    if v * j >= a * a && length >= v * (v / a + a / j) {
        full
    } else if v * j < a * a && length >= 2.0 * v * (v / j).sqrt() {
        length / v + 2.0 * (v / j).sqrt()
    } else if length >= 2.0 * a.powi(3) / (j * j) {
        a / j + ((a / j).powi(2) + 4.0 * length / a).sqrt()
    } else {
        (32.0 * length / j).cbrt()
    }
}

#[test]
fn the_textbook_formulas_agree_where_their_cases_meet() {
    let (v, a, j) = (100.0, 1000.0, 20_000.0);
    let length = v * (v / a + a / j);
    assert!(
        (least_time(length, v, a, j) - least_time(length * (1.0 - 1e-12), v, a, j)).abs() < 1e-9
    );
    let length = 2.0 * a * a * a / (j * j);
    assert!(
        (least_time(length, 1e3, a, j) - least_time(length * (1.0 - 1e-12), 1e3, a, j)).abs()
            < 1e-9
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn a_line_takes_the_least_time_there_is(
        limits in any_limits(),
        displacement in any_displacement(),
        feed in (0.0..7.0f64).prop_map(f64::exp),
    ) {
        with_room(|| {
            let measure = match (
                displacement.fixed_rows::<3>(0).norm(),
                displacement.fixed_rows::<3>(6).norm(),
            ) {
                (xyz, _) if xyz > 0.0 => xyz,
                (_, uvw) if uvw > 0.0 => uvw,
                _ => displacement.norm(),
            };
            // A few seconds at most.
            let feed = feed.max(0.2 * measure);
            let mut machine = Machine::new(limits);
            machine.line(displacement, &feed_move(feed)).expect("a line");
            let least = |limit: &Axes| {
                limit
                    .iter()
                    .zip(displacement.iter())
                    .map(|(limit, d)| limit * measure / d.abs())
                    .fold(f64::INFINITY, f64::min)
            };
            let (v, a, j) = (least(&limits.velocity).min(feed), least(&limits.acceleration), least(&limits.jerk));
            let optimum = least_time(measure, v, a, j);
            let time = machine.run(200_000) as f64 * PERIOD;
            prop_assert!(time > optimum - 1e-9 && time < optimum + PERIOD, "{time} {optimum}");
            let extremes = machine.extremes();
            prop_assert!(extremes.velocity <= 1.001, "{extremes:?}");
            prop_assert!(extremes.acceleration <= 1.001, "{extremes:?}");
            prop_assert!(extremes.jerk <= 1.001, "{extremes:?}");
            prop_assert_eq!(machine.planner.status().position, displacement);
            Ok(())
        })?;
    }

    #[test]
    fn an_arc_stays_on_its_circle_and_within_the_limits(
        limits in any_limits(),
        (normal, tilt) in (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-1.0..1.0f64)),
        (radius, height, angle, revolutions) in (
            (-4.0..4.0f64).prop_map(f64::exp),
            prop_oneof![Just(0.0), -20.0..20.0f64],
            0.01..TAU,
            -2..2i32,
        ),
        (feed, others) in ((0.0..6.0f64).prop_map(f64::exp), prop::array::uniform6(-20.0..20.0f64)),
        plain in prop::bool::ANY,
    ) {
        let normal = Vector3::from(normal);
        let radial = normal.cross(&Vector3::from(tilt));
        prop_assume!(normal.norm() > 0.1 && radial.norm() > 0.1);
        let (normal, radial) = (normal.normalize(), radial.normalize());
        let center = -radial * radius;
        let last = center + (radial * angle.cos() + normal.cross(&radial) * angle.sin()) * radius + normal * height;
        let mut end = Axes::zeros();
        end.fixed_rows_mut::<3>(0).copy_from(&last);
        if !plain {
            end.fixed_rows_mut::<6>(3).copy_from(&nalgebra::Vector6::from(others));
        }
        with_room(|| {
            let mut machine = Machine::new(limits);
            // Some seconds at most.
            let feed = feed.max(radius);
            machine.circle(end, &Circle { center, normal, revolutions }, &feed_move(feed)).expect("an arc");
            machine.run(500_000);
            let extremes = machine.extremes();
            prop_assert!(extremes.velocity <= 1.001, "{extremes:?}");
            prop_assert!(extremes.acceleration <= 1.001, "{extremes:?}");
            prop_assert!(extremes.jerk <= 1.001, "{extremes:?}");
            for position in &machine.positions {
                let from_center = position.fixed_rows::<3>(0) - center;
                let across = from_center - normal * normal.dot(&from_center);
                prop_assert!((across.norm() - radius).abs() < 1e-9);
            }
            prop_assert_eq!(machine.planner.status().position, end);
            Ok(())
        })?;
    }
}

#[test]
fn moves_shorter_than_a_cycle_share_cycles() {
    with_room(|| {
        let limits = AxisLimits {
            velocity: Axes::repeat(1000.0),
            acceleration: Axes::repeat(1e6),
            jerk: Axes::repeat(f64::INFINITY),
        };
        let mut machine = Machine::new(limits);
        // Ten micrometres from rest to rest take 0.2 milliseconds at this acceleration.
        let one = least_time(0.01, 900.0, 1e6, f64::INFINITY);
        assert!(one < 0.25 * PERIOD);
        for i in 1..=1000 {
            let mut end = Axes::zeros();
            end[0] = 0.01 * f64::from(i);
            machine.line(end, &feed_move(900.0)).expect("a line");
        }
        let cycles = machine.run(1000);
        let ideal = (1000.0 * one / PERIOD).ceil() as usize;
        assert!(cycles <= ideal + ideal / 50 + 1, "{cycles} {ideal}");
        assert!((machine.planner.status().position[0] - 10.0).abs() < 1e-12);
    });
}

#[test]
fn an_override_above_100_percent_is_planned() {
    with_room(|| {
        let mut machine = Machine::new(crate::common::equal_limits(20_000.0));
        machine.inputs = CycleInputs {
            feed_scale: 1.5,
            ..CycleInputs::default()
        };
        let mut end = Axes::zeros();
        end[0] = 100.0;
        machine.line(end, &feed_move(40.0)).expect("a line");
        let time = machine.run(10_000) as f64 * PERIOD;
        let optimum = least_time(100.0, 60.0, 1000.0, 20_000.0);
        assert!(time < optimum + 2.0 * PERIOD, "{time} {optimum}");
        assert!(machine.extremes().velocity <= 0.6 * 1.001);
    });
}

#[test]
fn a_raised_override_speeds_the_running_move_up() {
    with_room(|| {
        let mut machine = Machine::new(crate::common::equal_limits(20_000.0));
        let mut end = Axes::zeros();
        end[0] = 100.0;
        machine.line(end, &feed_move(40.0)).expect("a line");
        for _ in 0..1000 {
            machine.cycle();
        }
        machine.inputs.feed_scale = 2.0;
        let mut fastest = 0f64;
        let mut cycles = 1000;
        while !machine.planner.status().done {
            fastest = fastest.max(machine.cycle().current_velocity);
            cycles += 1;
        }
        assert!((fastest - 80.0).abs() < 0.1, "{fastest}");
        // 40 mm in the first second, less the way to get going; the rest at twice the speed.
        assert!((1000..1950).contains(&cycles), "{cycles}");
        let extremes = machine.extremes();
        assert!(
            extremes.acceleration <= 1.001 && extremes.jerk <= 1.01,
            "{extremes:?}"
        );
        assert_eq!(machine.planner.status().position, end);
    });
}
