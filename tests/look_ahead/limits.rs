//! Whatever the path and however it arrives: the limits hold, the pieces join, the end is exact.

use crate::routes::run::{
    PERIOD, Peaks, check_continuity, duration, limits, live, offline, peaks, planner,
};
use crate::routes::{Curve, Polyline, circle, contour, line, lissajous, zigzag};
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::JERK_KEPT;
use framepath::moves::shape::PathPoint;
use framepath::speed::look_ahead::{PlanProgress, PlanRefusal};
use proptest::prelude::*;

/// A polyline with legs of very different lengths, in all directions or nearly straight on.
fn any_polyline() -> impl Strategy<Value = Polyline> {
    let leg = (-2.0..1.0f64, prop::array::uniform3(-1.0..1.0f64));
    (
        prop::collection::vec(leg, 2..60),
        0.0..1.0f64,
        -2.0..0.5f64,
        0.0..2.0f64,
        prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 60),
    )
        .prop_map(|(legs, straightness, finest, feed, changes)| {
            let mut points = vec![[0.0; 3]];
            let mut direction = [1.0, 0.0, 0.0];
            let mut last = [0.0; 3];
            for (size, random) in &legs {
                let length = 10f64.powf(size.max(finest - 1.0));
                direction = std::array::from_fn(|i| straightness * direction[i] + random[i]);
                let norm = direction
                    .iter()
                    .map(|x| x * x)
                    .sum::<f64>()
                    .sqrt()
                    .max(1e-3);
                direction = direction.map(|x| x / norm);
                last = std::array::from_fn(|i| last[i] + length * direction[i]);
                points.push(last);
            }
            let tolerance = 10f64.powf(finest - 1.5);
            let mut line = Polyline::new(points, tolerance, 10f64.powf(0.5 + feed * 0.8));
            for (leg, (often, share)) in changes.iter().enumerate().take(legs.len()) {
                if *often < 0.1 {
                    line.feeds[leg] *= 0.2 + share;
                }
            }
            line
        })
}

fn any_limits() -> impl Strategy<Value = AxisLimits> {
    let one = || prop::array::uniform3(0.3..1.0f64);
    (one(), one(), one(), 3.7..5.0f64).prop_map(|(v, a, j, jerk)| {
        let nine = |x: [f64; 3]| Axes::from(std::array::from_fn(|i| x[i % 3]));
        AxisLimits {
            velocity: nine(v) * 150.0,
            acceleration: nine(a) * 1000.0,
            jerk: nine(j) * 10f64.powf(jerk),
        }
    })
}

fn within(peaks: &Peaks) -> Result<(), TestCaseError> {
    prop_assert!(peaks.velocity <= 1.0, "{peaks:?}");
    prop_assert!(peaks.acceleration <= 1.0, "{peaks:?}");
    prop_assert!(peaks.jerk <= JERK_KEPT, "{peaks:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn polylines_in_portions_keep_every_axis_within_its_limits(
        mut route in any_polyline(),
        limits in any_limits(),
        rate in 0.02..1.0f64,
        pause in 0.0..0.6f64,
        budget in 60..600u32,
    ) {
        let mut planner = planner(&limits);
        route.known = 1;
        let legs = route.legs();
        let run = live(&mut planner, &mut route, &limits, budget, |route, now, _| {
            // Nothing comes for a while, again and again.
            let flowing = (now % 1.0).min(1.0 - pause) + now.floor() * (1.0 - pause);
            let known = 1 + (flowing / PERIOD * rate) as usize;
            route.known = known.min(legs).max(route.known);
        });
        check_continuity(&run.pieces, route.length());
        within(&peaks(&run.pieces, &route, &limits, PERIOD))?;
    }
}

fn assert_within(peaks: &Peaks) {
    assert!(within(peaks).is_ok(), "{peaks:?}");
}

#[test]
fn dense_code_keeps_every_axis_within_its_limits() {
    for jerk in [20_000.0, 100_000.0] {
        let axes = limits(100.0, 1000.0, jerk);
        let mut route = contour(300, 100.0);
        let mut planner = planner(&axes);
        let legs = route.legs();
        let run = live(&mut planner, &mut route, &axes, 200, |route, now, _| {
            route.known = ((now / PERIOD) as usize + 1).min(legs);
        });
        assert_eq!(run.rests, 0);
        check_continuity(&run.pieces, route.length());
        assert_within(&peaks(&run.pieces, &route, &axes, PERIOD));
    }
}

#[test]
fn smooth_curves_keep_every_axis_within_its_limits() {
    let axes = limits(100.0, 1000.0, 20_000.0);
    let route = lissajous(100.0);
    let pieces = offline(&mut planner(&axes), &route, 400);
    check_continuity(&pieces, route.length);
    assert_within(&peaks(&pieces, &route, &axes, PERIOD));
    let route = circle(0.5, 3.0, 100.0);
    let pieces = offline(&mut planner(&axes), &route, 400);
    check_continuity(&pieces, route.length);
    assert_within(&peaks(&pieces, &route, &axes, PERIOD));
}

/// Where a limit is infinite, what a servo period can show of it is limited all the same.
#[test]
fn infinite_limits_are_no_infinite_numbers() {
    let all = f64::INFINITY;
    for (v, a, j, most) in [
        (100.0, 1000.0, all, 0.32),
        (100.0, all, 20_000.0, 0.36),
        (all, 1000.0, 20_000.0, 0.36),
        (100.0, all, all, 0.23),
        (all, all, 20_000.0, 0.36),
    ] {
        let axes = limits(v, a, j);
        let route = line(20.0, 100.0);
        let pieces = offline(&mut planner(&axes), &route, 400);
        check_continuity(&pieces, 20.0);
        assert_within(&peaks(&pieces, &route, &axes, PERIOD));
        let taken = duration(&pieces);
        assert!(taken > 0.2 && taken < most, "{v} {a} {j}: {taken} s");
    }
}

#[test]
fn what_cannot_be_planned_is_refused() {
    let all = f64::INFINITY;
    let mut unlimited = planner(&limits(all, all, all));
    let route = line(20.0, 100.0);
    for _ in 0..1000 {
        unlimited.slice(&route, 100);
    }
    assert_eq!(
        unlimited.progress(),
        PlanProgress::Refused(PlanRefusal::NoRest)
    );
    assert!(unlimited.freeze().is_none());

    let broken = Curve {
        point: |s: f64| {
            let good = line(20.0, 100.0);
            let mut point: PathPoint = framepath::speed::look_ahead::Route::point(&good, s);
            if s > 1.0 && s < 1.2 {
                point.second[0] = f64::NAN;
            }
            point
        },
        length: 20.0,
        feed: 100.0,
    };
    let mut planner = planner(&limits(100.0, 1000.0, 20_000.0));
    for _ in 0..1000 {
        planner.slice(&broken, 100);
    }
    assert_eq!(
        planner.progress(),
        PlanProgress::Refused(PlanRefusal::Unsound)
    );
}

/// A route that goes silent: the plan ends at rest inside what is known, and goes on later.
#[test]
fn a_starved_plan_rests_and_goes_on() {
    let axes = limits(100.0, 1000.0, 20_000.0);
    let mut route = zigzag(6, 0.05, 100.0);
    let mut planner = planner(&axes);
    route.known = 1;
    let run = live(&mut planner, &mut route, &axes, 300, |route, now, _| {
        route.known = if now < 1.5 { 3 } else { 6 };
    });
    assert_eq!(run.rests, 1);
    check_continuity(&run.pieces, route.length());
    assert_within(&peaks(&run.pieces, &route, &axes, PERIOD));
}
