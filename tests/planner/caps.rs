//! Caps that hold from the start are kept behind sharp corners too, where the reference gathers speed
//! at its limits while its rate still rises. And with what lowers them while the machine runs.

use crate::common::seeded_runner::seeded_runner;
use crate::common::{Machine, PERIOD, equal_limits, feed_move, with_room};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::MoveRequest;
use proptest::prelude::*;

/// What lowers the speed below F6000.
#[derive(Clone, Copy, Debug)]
enum Cap {
    /// The operator's slider, or the velocity in [TRAJ].
    Slider,
    FeedOverride,
    RapidOverride,
    Adaptive,
}

/// How much faster than the cap, mm/s, the machine runs at most, G64 P.2 F6000 through these places of X Y;
/// the cap comes in the given servo period. And how many periods it takes.
fn run(jerk: f64, corners: &[[f64; 2]], kind: Cap, cap: f64, from: usize) -> (f64, usize) {
    let mut machine = Machine::new(equal_limits(jerk));
    let mode = TerminationCondition::Continuous { tolerance: 0.2 };
    machine.planner.set_termination(mode);
    let request = match kind {
        Cap::RapidOverride => MoveRequest {
            motion_type: MotionType::Traverse,
            ..feed_move(100.0)
        },
        _ => feed_move(100.0),
    };
    for [x, y] in corners {
        let end = Axes::x() * *x + Axes::y() * *y;
        machine.line(end, &request).expect("a line");
    }
    let mut adaptive = 1.0;
    let mut cycles = 0;
    while !machine.planner.status().done {
        if cycles == from {
            match kind {
                Cap::Slider => machine.planner.set_velocity_limit(cap),
                Cap::FeedOverride => machine.inputs.feed_scale = cap / 100.0,
                Cap::RapidOverride => machine.inputs.rapid_scale = cap / 100.0,
                Cap::Adaptive => adaptive = cap / 100.0,
            }
        }
        machine.scaled_cycle(adaptive);
        cycles += 1;
        assert!(cycles < 100_000, "not done");
    }
    let extremes = machine.extremes();
    assert!(extremes.acceleration <= 1.001, "{extremes:?}");
    assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    // Twice what it takes on a line from 100 mm/s, where the acceleration is built up and taken back with all of
    // the jerk: a corner may need the acceleration for itself.
    let slowing = if from == 0 {
        0
    } else {
        (2.0 * (100.0 / 1000.0 + 2.0 * 1000.0 / jerk) / PERIOD) as usize
    };
    let steps = machine.positions.windows(2).skip(4 + from + slowing);
    let speeds = steps.map(|pair| (pair[1] - pair[0]).norm() / PERIOD);
    (speeds.fold(0.0, f64::max) / cap, cycles)
}

#[test]
fn caps_are_kept_behind_reversals() {
    let corners = [[20.0, 0.0], [0.0, 0.0], [60.0, 0.0], [0.0, 0.0]];
    for cap in [
        Cap::Slider,
        Cap::FeedOverride,
        Cap::RapidOverride,
        Cap::Adaptive,
    ] {
        let (over, cycles) = with_room(|| run(2e4, &corners, cap, 30.0, 0));
        assert!(over <= 1.001, "{over} of the {cap:?}");
        // 160 mm at 30 mm/s.
        assert!(cycles < 5600, "{cycles}");
    }
}

#[test]
fn caps_are_kept_behind_slanted_corners() {
    for (jerk, caps) in [(2e4, [22.0, 30.0, 40.0]), (1e5, [15.0, 22.0, 60.0])] {
        for angle in [0.1, 0.6, 1.0, 1.5_f64] {
            let (y, x) = angle.sin_cos();
            let first = [20.0 - 20.0 * x, 20.0 * y];
            let second = [20.0 + 40.0 * x, 20.0 * y - 40.0 * y];
            let corners = [[20.0, 0.0], first, second, [0.0, 0.0]];
            for cap in caps {
                let (over, _) = with_room(|| run(jerk, &corners, Cap::Slider, cap, 0));
                assert!(over <= 1.001, "{over} of {cap}, {angle}, jerk {jerk}");
            }
        }
    }
}

#[test]
fn caps_are_kept_behind_any_corners() {
    let cases =
        std::env::var("FRAMEPATH_CASES").map_or(12, |cases| cases.parse().expect("a number"));
    let mut runner = seeded_runner(ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let kind = prop::sample::select(vec![Cap::Slider, Cap::FeedOverride, Cap::RapidOverride]);
    let leg = (5.0..40.0f64, 0.0..std::f64::consts::PI);
    let strategy = (
        (kind, 15.0..60.0f64),
        prop_oneof![
            (4.0..5.5f64).prop_map(|j| 10f64.powf(j)),
            Just(f64::INFINITY)
        ],
        prop_oneof![Just(0usize), 1..500usize],
        prop::collection::vec(leg, 2..5),
    );
    let result = runner.run(&strategy, |((kind, cap), jerk, from, legs)| {
        let (mut x, mut y, mut angle) = (0.0, 0.0, 0.0_f64);
        let corners: Vec<_> = legs
            .iter()
            .map(|(length, turn)| {
                angle += turn;
                x += length * angle.cos();
                y += length * angle.sin();
                [x, y]
            })
            .collect();
        let (over, _) = with_room(|| run(jerk, &corners, kind, cap, from));
        prop_assert!(over <= 1.001, "{over}");
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

/// Found at random: the reference needed the jerk that braking for the cap had counted on, and a change of caps in a run.
#[test]
fn caps_are_kept_where_the_path_needs_the_jerk() {
    let rapid = |corners: &[[f64; 2]], jerk, cap, from| {
        let (over, _) = with_room(|| run(jerk, corners, Cap::RapidOverride, cap, from));
        assert!(over <= 1.001, "{over} of {cap}, jerk {jerk}");
    };
    // Legs, and by how much each turns.
    let through = |legs: &[[f64; 2]]| {
        let (mut place, mut angle) = ([0.0, 0.0], 0.0_f64);
        let corner = |leg: &[f64; 2]| {
            angle += leg[1];
            place = [
                place[0] + leg[0] * angle.cos(),
                place[1] + leg[0] * angle.sin(),
            ];
            place
        };
        legs.iter().map(corner).collect::<Vec<_>>()
    };
    let zigzag = through(&[
        [16.668121328167803, 2.014852961569253],
        [10.575102265584219, 3.031364529239722],
        [18.352260776930105, 1.2085367716767075],
        [39.03990583180834, 0.5557083501860434],
    ]);
    rapid(&zigzag, 51896.73935488497, 38.4969581670001, 0);
    let lowered = through(&[
        [35.450088426616325, 2.193136853205524],
        [39.6879405816593, 1.5046990483053804],
        [39.54356327961062, 0.7373481603341715],
    ]);
    rapid(&lowered, 271315.8836975128, 59.29954694425483, 392);
    let short = through(&[
        [20.93344723460019, 1.973198489352669],
        [6.396416782934038, 1.7510185193894048],
        [5.8208931770270596, 0.056805769033359994],
        [23.72031191010192, 1.7482257673350532],
    ]);
    rapid(&short, 169071.87049370192, 15.048695112994015, 0);
}
