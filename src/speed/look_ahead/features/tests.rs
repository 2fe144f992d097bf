//! Room for features.

use super::*;
use crate::axes::{Axes, AxisLimits};
use crate::machine_map::MachineMap;
use crate::moves::shape::PathPoint;
use crate::speed::look_ahead::counted_route::CountedRoute;
use crate::speed::look_ahead::rows::AxisRows;
use crate::speed::look_ahead::spline::Spline;
use crate::speed::look_ahead::test_route::TestRoute;

fn straight(s: f64) -> PathPoint {
    let x = |value: f64| Axes::from([value, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    PathPoint {
        position: x(s),
        first: x(1.0),
        second: x(0.0),
        third: x(0.0),
    }
}

fn rows() -> AxisRows {
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    };
    AxisRows::new(&limits, &MachineMap::IDENTITY, 1e-3)
}

fn context<'a, R: Route>(
    route: &'a CountedRoute<'a, R>,
    rows: &'a AxisRows,
    plan: &'a Spline,
) -> PlanContext<'a, R> {
    PlanContext {
        route,
        rows,
        plan,
        raise_squared: 1.0,
        oldest: 0,
    }
}

/// The features of a corner behind so many vertices that there are for a grid at its start, and just before the corner.
fn of_a_corner_behind(vertices: usize) -> [usize; 2] {
    let dense = (1..=vertices).map(|k| RouteVertex {
        position: 0.005 * k as f64,
        reach: 0.0025,
        core: 0.0,
        cap_changes: false,
        may_jump: false,
    });
    let corner = RouteVertex {
        position: 9.0,
        reach: 0.5,
        core: 0.05,
        cap_changes: true,
        may_jump: false,
    };
    let route = TestRoute {
        point: straight,
        breakpoints: Vec::new(),
        vertices: dense.chain([corner]).collect(),
    };
    let rows = rows();
    let plan = Box::new(Spline::NONE);
    let route = CountedRoute::new(&route);
    let context = context(&route, &rows, &plan);
    let mut features = Box::new(Features::new());
    features.restart(0.0, 0.0, 1.0);
    [0.0, 8.0].map(|s| {
        features.make_room(s);
        while !features.covers(10.0) {
            features.take_next(&context, 0.0);
            features.make_room(s);
        }
        let at_corner = features.before(9.0);
        at_corner.filter(|feature| feature.center == 9.0).count()
    })
}

/// Of a corner at the end of the room the sharpest part was left out, and run through at eight times the jerk.
#[test]
fn of_a_vertex_all_features_are_taken_or_none() {
    for vertices in SLOTS - 6..SLOTS + 3 {
        let at_once = if vertices + OF_A_VERTEX <= SLOTS {
            3
        } else {
            0
        };
        let found = of_a_corner_behind(vertices);
        assert_eq!(found, [at_once, 3], "behind {vertices}");
    }
}

/// Features of all widths, every fourth one a change of the cap, in the order of the path.
fn many() -> Box<Features> {
    let mut features = Box::new(Features::new());
    features.restart(0.0, 0.0, 1.0);
    for k in 0..600usize {
        let share = |period: usize| (k % period) as f64 / period as f64;
        let center = 0.1 * k as f64 + 0.05 * share(7);
        let reach = if k % 4 == 3 {
            0.0
        } else {
            0.05 + 4.0 * share(13) * share(29)
        };
        features.push(Feature {
            start: center - reach,
            center,
            end: center + reach * (0.5 + share(5)),
            spacing: 0.02 + 0.3 * share(31) + 0.1 * reach,
            speed: if reach > 0.0 {
                1.0 + 9.0 * share(37)
            } else {
                0.0
            },
            cap_changes: reach == 0.0,
            jumps: k % 17 == 5,
            ..Feature::NONE
        });
    }
    features
}

/// Whole groups are passed over, but none that one of has something to say.
#[test]
fn answers_are_those_of_all_features_asked_one_by_one() {
    let features = many();
    let all = || (0..features.next).map(|place| features.at(place));
    let shapes = || all().filter(|feature| feature.speed > 0.0);
    for step in 0..400 {
        let s = 0.15 * f64::from(step) + 0.01;
        for most in [0.01, 0.1, 1.0, 10.0] {
            let spacings = all().map(|feature| feature.spacing_at(s));
            let within = shapes().any(|feature| feature.start <= s && s < feature.end);
            assert_eq!(
                features.spacing(s, most),
                (spacings.fold(most, f64::min), within)
            );
            let squares = shapes().map(|feature| feature.greatest_speed_squared(s, 2.0));
            let least = squares.fold(9.0 * most, f64::min);
            assert_eq!(features.greatest_speed_squared(s, 2.0, 9.0 * most), least);
            let (end, beside) = (s + most, 0.1 * (s + most - s));
            let touched =
                shapes().filter(|feature| end > feature.start - beside && s < feature.end + beside);
            let finest = touched.map(|feature| feature.spacing).reduce(f64::min);
            assert_eq!(features.finest(s, end), finest);
        }
    }
}

/// Of what is crowded neither start nor end is a landmark, but those of a jump are, and of what stands alone.
#[test]
fn landmarks_are_centers_of_changes_and_the_ends_of_jumps_and_of_what_stands_alone() {
    let of = |centers: &[f64], jumps: bool| {
        let mut features = Box::new(Features::new());
        features.restart(0.0, 0.0, 1.0);
        for &center in centers {
            features.push(Feature {
                start: center - 1.0,
                center,
                end: center + 1.0,
                spacing: 0.2,
                speed: 1.0,
                jumps,
                ..Feature::NONE
            });
            features.push(Feature {
                start: center,
                center,
                end: center,
                spacing: 0.5,
                cap_changes: true,
                ..Feature::NONE
            });
        }
        [4.5, 5.5, 6.5].map(|s| features.landmark(s, 1.0))
    };
    assert_eq!(of(&[6.0], false), [Some(5.0), Some(6.0), Some(7.0)]);
    assert_eq!(of(&[6.0, 7.5], false), [None, Some(6.0), Some(7.5)]);
    assert_eq!(of(&[6.0, 7.5], true), [Some(5.0), Some(6.0), Some(7.0)]);
}

/// The features that are changes of the cap, of a vertex where the curve allows this share of the cap.
fn changes_of_cap_where_the_curve_allows(share: f64) -> usize {
    let curve = move |s: f64| PathPoint {
        second: Axes::y() * (0.4 / (share * share)),
        ..straight(s)
    };
    let vertex = RouteVertex {
        position: 5.0,
        reach: 1.0,
        core: 0.0,
        cap_changes: true,
        may_jump: false,
    };
    let route = TestRoute {
        point: curve,
        breakpoints: Vec::new(),
        vertices: vec![vertex],
    };
    let rows = rows();
    let plan = Box::new(Spline::NONE);
    let route = CountedRoute::new(&route);
    let context = context(&route, &rows, &plan);
    let mut features = Box::new(Features::new());
    features.restart(0.0, 0.0, 1.0);
    while !features.covers(10.0) {
        features.take_next(&context, 0.0);
    }
    features.cap_changes(0.0, 10.0).count()
}

#[test]
fn a_change_of_the_cap_counts_where_the_curve_lets_the_speed_come_near_it() {
    for (share, changes) in [(0.3, 0), (0.6, 0), (0.8, 1), (2.0, 1)] {
        assert_eq!(changes_of_cap_where_the_curve_allows(share), changes);
    }
}
