//! The optimum against what has a closed form.

use super::executed_path::{ExecutedPath, PathSample, corners};
use super::grid::{Boundary, Grid, spacing};
use super::jerk_limited::least_time;
use super::limits::{AXES, COORDINATES, PathLimits, SpeedCap};
use super::stop::shortest_stop;
use super::topp_ra::topp_ra;
use framepath::machine::{JOINT_COUNT, Machine, TableTiltingParameters};
use nalgebra::Vector3;
use std::array::from_fn;
use std::f64::consts::TAU;

const PERIOD: f64 = 1e-3;
const LIMITS: PathLimits = PathLimits {
    velocity: [100.0; COORDINATES],
    acceleration: [1000.0; COORDINATES],
    jerk: [20_000.0; COORDINATES],
};

/// A motion from rest to rest in `duration` seconds: share of the path by a polynomial of the fifth
/// degree, which is nowhere near the optimum.
fn executed(
    duration: f64,
    cap: SpeedCap,
    position: impl Fn(f64) -> [f64; AXES],
) -> Vec<PathSample> {
    let count = (duration / PERIOD).ceil() as usize;
    (0..=count)
        .map(|k| {
            let t = (k as f64 / count as f64).min(1.0);
            let share = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
            PathSample::new(&position(share), None, cap)
        })
        .collect()
}

/// Least times with and without the limit of jerk.
fn optimum(samples: &[PathSample], limits: &PathLimits) -> (f64, f64) {
    let path = ExecutedPath::new(samples, PERIOD, &limits.velocity).expect("a path");
    let rests = (Boundary::Rest, Boundary::Rest);
    let spacing = spacing(samples.len() as f64 * PERIOD);
    let grid = Grid::new(&path, limits, (0.0, path.end()), rests, spacing);
    let optimum = least_time(&grid, limits).expect("an optimum");
    (optimum.time, topp_ra(&grid, limits).expect("a bound"))
}

/// Rest to rest on a line with limits along it, for velocities that are reached with full
/// acceleration.
fn line_time(length: f64, [v, a, j]: [f64; 3]) -> f64 {
    if length >= v * (v / a + a / j) {
        length / v + v / a + a / j
    } else if length >= 2.0 * a.powi(3) / (j * j) {
        a / j + ((a / j).powi(2) + 4.0 * length / a).sqrt()
    } else {
        (32.0 * length / j).cbrt()
    }
}

fn trapezoid_time(length: f64, [v, a, _]: [f64; 3]) -> f64 {
    if length >= v * v / a {
        length / v + v / a
    } else {
        2.0 * (length / a).sqrt()
    }
}

fn assert_within(found: f64, exact: f64, share: f64) {
    assert!((found / exact - 1.0).abs() <= share, "{found} for {exact}");
}

#[test]
fn lines_of_all_lengths_to_a_thousandth() {
    // Unequal axes: along (0.6, 0, 0.8) X allows A = 1000 and J = 50000, Z A = 750 and J = 25000.
    let mut limits = LIMITS;
    limits.acceleration[0] = 600.0;
    limits.acceleration[2] = 600.0;
    limits.jerk[0] = 30_000.0;
    let along = [100.0 / 0.8, 600.0 / 0.8, 20_000.0 / 0.8];
    for length in [0.003, 0.3, 1.2, 10.0, 40.0] {
        let exact = line_time(length, along);
        let samples = executed(1.5 * exact, SpeedCap::None, |share| {
            let mut position = [50.0, 0.0, -20.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            position[0] += 0.6 * length * share;
            position[2] -= 0.8 * length * share;
            position
        });
        let (time, bound) = optimum(&samples, &limits);
        assert_within(time, exact, 1e-3);
        assert_within(bound, trapezoid_time(length, along), 1e-3);
    }
}

/// 8 mm of X while A turns by 60 degrees, which is slower than X.
fn with_rotation(share: f64) -> [f64; AXES] {
    let mut position = [0.0; AXES];
    position[0] = 8.0 * share;
    position[3] = 5.0 - 60.0 * share;
    position
}

#[test]
fn lines_of_rotary_axes_to_a_thousandth() {
    let mut limits = LIMITS;
    limits.velocity[3] = 60.0;
    limits.acceleration[3] = 450.0;
    limits.jerk[3] = 6000.0;
    // Over the greatest velocities A goes 7.5 times as far as X, and X is never at a limit.
    let of_a = [60.0, 450.0, 6000.0];
    for (together, length) in [(true, 60.0), (false, 60.0), (false, 2.0), (false, 0.01)] {
        let exact = line_time(length, of_a);
        let samples = executed(1.5 * exact, SpeedCap::None, |share| {
            let mut position = with_rotation(share * length / 60.0);
            position[0] *= f64::from(u8::from(together));
            position
        });
        let (time, bound) = optimum(&samples, &limits);
        assert_within(time, exact, 1e-3);
        assert_within(bound, trapezoid_time(length, of_a), 1e-3);
    }
}

/// A table that C turns, with the tool centre point: its joints where the tip stands at `axes`, and back.
fn table() -> Machine {
    let mut table = Machine::configured(b"xyzac", b"XYZABC").expect("a table");
    let parameters = TableTiltingParameters {
        rotation_point: Vector3::new(-30.0, 10.0, 0.0),
        tool_centre_point: true,
        ..TableTiltingParameters::default()
    };
    table.set_parameters(&parameters).expect("dimensions");
    table
}

/// A path of joints, which bends where the axes are.
fn executed_by_joints(duration: f64, joints: impl Fn(f64) -> [f64; AXES]) -> Vec<PathSample> {
    let table = table();
    executed(duration, SpeedCap::None, joints)
        .iter()
        .map(|sample| {
            let (joints, mut all) = (sample.axes(), [0.0; JOINT_COUNT]);
            all[..AXES].copy_from_slice(&joints);
            let axes = table.forward(&all).into();
            PathSample::new(&axes, Some(&joints), SpeedCap::None)
        })
        .collect()
}

#[test]
fn a_line_of_joints_to_a_thousandth() {
    let limits = |axes: f64| {
        let joints = [[100.0; AXES], [1000.0; AXES], [20_000.0; AXES]];
        let infinite = [f64::INFINITY; AXES];
        PathLimits::new([[axes; AXES], infinite, infinite], Some(joints))
    };
    for length in [1.5, 40.0] {
        let exact = line_time(length, [100.0, 1000.0, 20_000.0]);
        let samples = executed_by_joints(1.5 * exact, |share| {
            let mut joints = [0.0; AXES];
            (joints[0], joints[1], joints[5]) = (length * share, 10.0, -0.8 * length * share);
            joints
        });
        let (time, bound) = optimum(&samples, &limits(1e4));
        assert_within(time, exact, 1e-3);
        assert_within(bound, trapezoid_time(length, [100.0, 1000.0, 0.0]), 1e-3);
    }
}

#[test]
#[ignore = "half a minute; make thorough runs it"]
fn axes_keep_their_velocities_before_joints_to_a_thousandth() {
    // The workpiece turns under a tip that stays at 50 mm from C: half a turn at 20 degrees per second of C, which
    // no joint of its own needs.
    let joints = [[400.0; AXES], [1e5; AXES], [1e8; AXES]];
    let infinite = [f64::INFINITY; AXES];
    let limits = PathLimits::new([[20.0; AXES], infinite, infinite], Some(joints));
    let table = table();
    let samples: Vec<PathSample> = executed(12.0, SpeedCap::None, |share| {
        let mut axes = [0.0; AXES];
        (axes[0], axes[1], axes[5]) = (10.0, 40.0, 180.0 * share);
        axes
    })
    .iter()
    .map(|sample| {
        let mut all = [0.0; JOINT_COUNT];
        table.inverse(&sample.axes().into(), &mut all);
        let joints = from_fn(|joint| all[joint]);
        PathSample::new(&sample.axes(), Some(&joints), SpeedCap::None)
    })
    .collect();
    assert_within(optimum(&samples, &limits).0, 9.0, 1e-3);
}

#[test]
fn the_feed_of_a_line_with_a_rotary_axis_to_a_thousandth() {
    // 4 mm/s along X, which F counts: 30 degrees per second of A, which ramps up with its jerk.
    let mut rate = [0.0; AXES];
    (rate[0], rate[3]) = (4.0, -30.0);
    let exact = 2.0 + 2.0 * (30.0_f64 / 20_000.0).sqrt();
    let samples = executed(1.4 * exact, SpeedCap::Along(rate), with_rotation);
    assert_within(optimum(&samples, &LIMITS).0, exact, 1e-3);
}

#[test]
fn off_its_move_a_feed_does_not_hold() {
    // A corner's way along X, which belongs to a move that turns A and hardly moves X: 1 mm/s of X would take 8 s.
    let mut rate = [0.0; AXES];
    (rate[0], rate[3]) = (1.0, 100.0);
    let along = |share: f64| {
        let mut position = with_rotation(share);
        position[3] = 0.0;
        position
    };
    let exact = line_time(8.0, [100.0, 1000.0, 20_000.0]);
    let samples = executed(1.5 * exact, SpeedCap::Along(rate), along);
    assert_within(optimum(&samples, &LIMITS).0, exact, 1e-3);
}

fn on_circle(radius: f64, share: f64) -> [f64; AXES] {
    let (sine, cosine) = (TAU * share).sin_cos();
    let mut position = [0.0; AXES];
    position[1] = radius * sine;
    position[2] = radius * cosine;
    position
}

#[test]
fn a_circle_at_constant_speed_to_a_thousandth() {
    let feed = 20.0;
    let cap = SpeedCap::Counted {
        first_axis: 0,
        speed: feed,
    };
    let length = TAU * 4.0;
    let samples = executed(1.4 * length / feed, cap, |share| on_circle(4.0, share));
    let (time, bound) = optimum(&samples, &LIMITS);
    // Each of both ramps takes half of its time more than the same distance at the feed.
    assert_within(
        time,
        length / feed + 2.0 * (feed / 20_000.0_f64).sqrt(),
        1e-3,
    );
    assert_within(bound, length / feed + feed / 1000.0, 1e-3);
}

#[test]
fn a_turning_acceleration_that_is_limited_by_axes() {
    // Far above what the axes allow: at the speed at which an axis alone turns the machine at the
    // four points of the circle, faster in between.
    let length = TAU * 2.0;
    let samples = executed(1.0, SpeedCap::None, |share| on_circle(2.0, share));
    let (time, bound) = optimum(&samples, &LIMITS);
    let constant = length / (1000.0_f64 * 2.0).sqrt();
    let greatest = length / (2.0_f64.sqrt() * 1000.0 * 2.0).sqrt();
    assert!(bound > greatest && bound < constant + 0.06, "{bound}");
    assert!(time > bound && time < 1.0, "{time}");
}

#[test]
fn a_near_reversal_is_no_standstill() {
    // An ellipse, .02 mm wide: at its ends the machine all but turns back.
    let ellipse = |share: f64| {
        let (sine, cosine) = (TAU * share).sin_cos();
        let mut position = [0.0; AXES];
        position[0] = 0.01 * sine;
        position[1] = 5.0 * (1.0 - cosine);
        position
    };
    let samples = executed(1.2, SpeedCap::None, ellipse);
    assert!(corners(&samples, &LIMITS.velocity).is_empty());
    let (time, bound) = optimum(&samples, &LIMITS);
    // From rest to rest over there and back again, if there were none in between: 2 x 10 mm.
    let there = line_time(10.0, [100.0, 1000.0, 20_000.0]);
    assert!(time < 2.0 * there - 0.01, "{time} {there}");
    assert!(time > there + 0.1 && bound < time, "{time} {bound}");
}

#[test]
fn a_corner_is_cut_where_the_machine_stood() {
    let mut samples = executed(0.5, SpeedCap::None, |share| {
        from_fn(|axis| if axis == 0 { 5.0 * share } else { 0.0 })
    });
    let corner = samples.len() - 1;
    let second = executed(0.5, SpeedCap::None, |share| {
        from_fn(|axis| match axis {
            0 => 5.0,
            1 => 3.0 * share,
            _ => 0.0,
        })
    });
    samples.extend(&second[1..]);
    let found = corners(&samples, &LIMITS.velocity);
    assert_eq!(found.len(), 1);
    assert!(found[0].abs_diff(corner) <= 1, "{found:?} {corner}");
}

#[test]
fn stops_on_a_line() {
    // 40 mm/s in Y, and full acceleration from 40 mm/s on.
    for acceleration in [0.0, 1000.0] {
        let samples: Vec<PathSample> = (0..=600)
            .map(|k| {
                let t = f64::from(k) * PERIOD;
                let mut position = [0.0; AXES];
                position[1] = 40.0 * t + 0.5 * acceleration * t * t;
                PathSample::new(&position, None, SpeedCap::None)
            })
            .collect();
        let path = ExecutedPath::new(&samples, PERIOD, &LIMITS.velocity).expect("a path");
        let state = path.state(0.02).expect("in motion");
        let speed = 40.0 + acceleration * 0.02;
        assert_within(state.1.sqrt(), speed / 100.0, 1e-6);
        assert!((state.2 - acceleration / 100.0).abs() < 1e-5);
        let least = state.1 / (2.0 * 10.0);
        let time = shortest_stop(&path, &LIMITS, state, least, 5.0 * least).expect("a stop");
        // Full jerk down, the greatest braking if it comes to that, full jerk up.
        let square = 20_000.0 * speed + 0.5 * acceleration * acceleration;
        let braking = square.sqrt().min(1000.0);
        let held = (square - braking * braking) / (20_000.0 * braking);
        let exact = (acceleration + 2.0 * braking) / 20_000.0 + held;
        // The limits are taken 1 % wider, and the distance is found to 1 %.
        assert_within(time, exact, 0.013);
    }
}

#[test]
fn a_rounded_corner_does_not_depend_on_the_grid() {
    // Two legs of 5 mm with the sixth-degree blend of reach 0.4 mm between them.
    let reach = 0.4;
    let corner = |share: f64| {
        let s = 10.0 * share - 5.0;
        let x = (s.abs() / reach).min(1.0);
        let square = x * x;
        let blend = reach
            * (0.15625 - 0.5 * x + square * (0.46875 - square * (0.15625 - 0.03125 * square)));
        let mut position = [0.0; AXES];
        position[0] = s.min(0.0) - blend;
        position[1] = s.max(0.0) + blend;
        position
    };
    let mut limits = LIMITS;
    limits.jerk = [100_000.0; COORDINATES];
    let samples = executed(0.8, SpeedCap::None, corner);
    let path = ExecutedPath::new(&samples, PERIOD, &limits.velocity).expect("a path");
    let [(coarse, coarse_bound), (fine, fine_bound)] = [2e-3, 5e-4].map(|spacing| {
        let rests = (Boundary::Rest, Boundary::Rest);
        let grid = Grid::new(&path, &limits, (0.0, path.end()), rests, spacing);
        let optimum = least_time(&grid, &limits).expect("an optimum");
        (optimum.time, topp_ra(&grid, &limits).expect("a bound"))
    });
    assert_within(coarse, fine, 1e-3);
    assert_within(coarse_bound, fine_bound, 1e-3);
    assert!(fine_bound < fine && coarse_bound < coarse);
}
