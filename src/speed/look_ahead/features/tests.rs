//! Room for features.

use super::*;
use crate::axes::{Axes, AxisLimits};
use crate::machine_map::MachineMap;
use crate::moves::shape::PathPoint;
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
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    };
    let rows = AxisRows::new(&limits, &MachineMap::IDENTITY, 1e-3);
    let plan = Box::new(Spline::NONE);
    let context = PlanContext {
        route: &route,
        rows: &rows,
        plan: &plan,
        raise_squared: 1.0,
        oldest: 0,
    };
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
