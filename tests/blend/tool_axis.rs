//! Where an axis tilts the tool: the tip keeps P and the tool axis the rotary tolerance, whatever C does.

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::{Line9, Shape};
use framepath::moves::{NearLimit, TerminationCondition};
use framepath::path::{BlendSettings, BlendedPath, ProgrammedMove};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::common::with_path;

/// P, mm, and the tolerance of rotary axes, degrees.
const P: f64 = 0.05;
const O: f64 = 0.05;

fn blend_settings(tilts: bool) -> BlendSettings {
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    };
    let plain = BlendSettings::new(1.0, P / O, 0.02, &limits).expect("sound");
    if tilts { plain.with_tilt(3, O) } else { plain }
}

/// Lines between these places: X, A and C.
fn lines(places: &[[f64; 3]]) -> Vec<ProgrammedMove> {
    let position = |[x, a, c]: [f64; 3]| Axes::from([x, 0.0, 0.0, a, 0.0, c, 0.0, 0.0, 0.0]);
    let shapes = places
        .windows(2)
        .filter_map(|ends| Line9::new(&position(ends[0]), &position(ends[1])).ok());
    (0..)
        .zip(shapes)
        .map(|(serial, line)| ProgrammedMove {
            serial,
            shape: Shape::Line(line),
            feed: 50.0,
            feed_word: None,
            greatest_feed: 50.0,
            termination: TerminationCondition::Continuous { tolerance: P },
            stop_before: false,
            separate: false,
            may_swing_out: true,
            near_limit: NearLimit::NONE,
        })
        .collect()
}

fn tool_axis(position: &Axes) -> Vector3<f64> {
    let (a, c) = (position[3].to_radians(), position[5].to_radians());
    Vector3::new(a.sin() * c.sin(), -a.sin() * c.cos(), a.cos())
}

/// How far the tip, the tool axis (degrees) and C leave the program at most.
fn deviations(path: &BlendedPath) -> [f64; 3] {
    let mut greatest = [0.0f64; 3];
    for k in 0..=20_000 {
        let s = path.known_end() * f64::from(k) / 20_000.0;
        let (is, programmed) = (path.point(s).position, path.programmed_point(s).position);
        let chord = (tool_axis(&is) - tool_axis(&programmed)).norm();
        let here = [
            (is[0] - programmed[0]).abs(),
            2.0 * (0.5 * chord).asin().to_degrees(),
            (is[5] - programmed[5]).abs(),
        ];
        for (greatest, here) in greatest.iter_mut().zip(here) {
            *greatest = greatest.max(here);
        }
    }
    greatest
}

fn of_path(places: Vec<[f64; 3]>, tilts: bool) -> [f64; 3] {
    with_path(move |path| {
        path.restart(&blend_settings(tilts), &{
            let [x, a, c] = places[0];
            Axes::from([x, 0.0, 0.0, a, 0.0, c, 0.0, 0.0, 0.0])
        });
        for programmed in &lines(&places) {
            assert_eq!(path.add(programmed), Ok(()));
            path.step(20_000);
        }
        path.finish();
        path.step(1_000_000);
        assert!(path.is_settled());
        deviations(path)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tip_and_tool_axis_keep_their_tolerances(
        places in prop::collection::vec([0.0..10.0f64, -1.0..1.0f64, -30.0..30.0f64], 3..30),
        furthest in prop_oneof![Just(2.0), Just(40.0), Just(180.0)],
    ) {
        let places = places.into_iter().map(|[x, a, c]| [x, a * furthest, c]).collect();
        let [tip, axis, _] = of_path(places, true);
        prop_assert!(tip <= 1.005 * P && axis <= 1.005 * O, "{tip} {axis}");
    }
}

#[test]
fn next_to_the_pole_c_leaves_the_program_by_more() {
    let places = (0..12)
        .map(|k: i32| [f64::from(k), 1.0, 20.0 * f64::from(k % 2)])
        .collect::<Vec<_>>();
    let [_, axis, before] = of_path(places.clone(), false);
    let [tip, axis_now, now] = of_path(places, true);
    println!("C {before} -> {now}, tool axis {axis} -> {axis_now}, tip {tip}");
    assert!(before <= 1.001 * O && now > 10.0 * before, "{before} {now}");
}
