//! What an operator sees, against the motion as it was recorded.

use crate::common::{Machine, PERIOD, at, feed_move, with_machine};
use crate::joint_models::{EXACT_TABLE, joint_limits, joints_of, table};
use framepath::axes::{AXIS_COUNT, AXIS_LETTERS, Axes};
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, TerminationCondition};
use framepath::planner::{MoveRequest, Quantity, SpeedLimit, Survey};
use nalgebra::Vector3;

/// A servo period of a run.
#[derive(Clone, Copy, Debug)]
struct Seen {
    survey: Survey,
    /// Along the path.
    speed: f64,
    queued: usize,
}

/// Runs to the end, with an override.
fn run(machine: &mut Machine, feed_scale: f64) -> Vec<Seen> {
    machine.inputs.feed_scale = feed_scale;
    let mut seen = Vec::new();
    loop {
        let status = machine.cycle();
        let survey = *machine.planner.survey(&machine.inputs);
        seen.push(Seen {
            survey,
            speed: status.current_velocity,
            queued: status.queue_depth,
        });
        if status.done {
            return seen;
        }
        assert!(seen.len() < 100_000, "{status:?}");
    }
}

/// Lines of `length` along a curve that becomes narrower, in XY.
fn curve(machine: &mut Machine, count: usize, length: f64, feed: f64) {
    let (mut end, mut angle) = (Axes::zeros(), 0.0f64);
    for k in 0..count {
        angle += 0.01 + 0.3 * k as f64 / count as f64;
        end += at(angle.cos(), angle.sin()) * length;
        machine.planner.set_id(k as i32 + 1);
        machine.line(end, &feed_move(feed)).expect("a line");
    }
}

fn blended(machine: &mut Machine) {
    machine
        .planner
        .set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
}

/// What of its limits each axis used in each period, by differences of the recorded positions: the greatest share, and of what.
fn recorded(machine: &Machine) -> Vec<(f64, SpeedLimit)> {
    let shares = |window: &[Axes]| {
        let [a, b, c, d] = window else {
            panic!("four positions");
        };
        let orders = [
            (
                Quantity::Velocity,
                (d - c) / PERIOD,
                machine.limits.velocity,
            ),
            (
                Quantity::Acceleration,
                (d - c * 2.0 + b) / PERIOD.powi(2),
                machine.limits.acceleration,
            ),
            (
                Quantity::Jerk,
                (d - c * 3.0 + b * 3.0 - a) / PERIOD.powi(3),
                machine.limits.jerk,
            ),
        ];
        let all = orders.iter().flat_map(|(quantity, values, limits)| {
            (0..AXIS_COUNT).map(move |axis| {
                let share = values[axis].abs() / limits[axis];
                let quantity = *quantity;
                (share, SpeedLimit::Axis { axis, quantity })
            })
        });
        all.max_by(|one, other| one.0.total_cmp(&other.0))
            .expect("nine axes")
    };
    machine.positions.windows(4).map(shares).collect()
}

/// Each answer against the recording; how often there was which.
fn check(machine: &Machine, seen: &[Seen], feed: f64, feed_scale: f64) -> Vec<(SpeedLimit, usize)> {
    let mut counts: Vec<(SpeedLimit, usize)> = Vec::new();
    let recorded = recorded(machine);
    let recorded = &recorded[recorded.len() - seen.len()..];
    for (k, (seen, (share, nearest))) in seen.iter().zip(recorded).enumerate() {
        let place = format!("period {k}: {seen:?}, {share} of {nearest:?}");
        let limit = seen.survey.limit;
        match limit {
            SpeedLimit::Axis { axis, quantity } => {
                assert_eq!(
                    limit, *nearest,
                    "{place}: {} {quantity:?}",
                    AXIS_LETTERS[axis]
                );
                assert!(*share >= 0.5, "{place}");
            }
            SpeedLimit::Feed => assert!((seen.speed / feed - 1.0).abs() < 5.1e-3, "{place}"),
            SpeedLimit::Override => assert!(seen.speed >= 0.995 * feed * feed_scale, "{place}"),
            SpeedLimit::Between => {
                assert!(*share < 0.5 && seen.speed < feed * feed_scale, "{place}");
            }
            SpeedLimit::Nothing => assert_eq!(seen.queued, 0, "{place}"),
            SpeedLimit::Rest => assert_eq!((seen.speed, *share < 1e-9), (0.0, true), "{place}"),
            other => panic!("{other:?} at {place}"),
        }
        match counts.iter_mut().find(|(counted, _)| *counted == limit) {
            Some((_, count)) => *count += 1,
            None => counts.push((limit, 1)),
        }
    }
    counts
}

fn share(counts: &[(SpeedLimit, usize)], of: impl Fn(SpeedLimit) -> bool) -> f64 {
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    let these = counts.iter().filter(|(limit, _)| of(*limit));
    these.map(|(_, count)| *count).sum::<usize>() as f64 / all as f64
}

fn is_of(axis: usize, quantity: Quantity) -> impl Fn(SpeedLimit) -> bool {
    move |limit| limit == SpeedLimit::Axis { axis, quantity }
}

#[test]
fn along_a_line_jerk_and_acceleration_of_its_axis_then_its_feed() {
    with_machine(|machine| {
        machine
            .line(at(0.0, 80.0), &feed_move(60.0))
            .expect("a line");
        let seen = run(machine, 1.0);
        let counts = check(machine, &seen, 60.0, 1.0);
        assert!(
            share(&counts, |limit| limit == SpeedLimit::Feed) > 0.7,
            "{counts:?}"
        );
        assert!(
            share(&counts, is_of(1, Quantity::Jerk)) > 0.04,
            "{counts:?}"
        );
        assert!(
            share(&counts, is_of(1, Quantity::Acceleration)) > 0.01,
            "{counts:?}"
        );
    });
}

#[test]
fn below_100_percent_it_is_the_override() {
    with_machine(|machine| {
        machine
            .line(at(90.0, 0.0), &feed_move(60.0))
            .expect("a line");
        let seen = run(machine, 0.3);
        let counts = check(machine, &seen, 60.0, 0.3);
        assert!(
            share(&counts, |limit| limit == SpeedLimit::Override) > 0.9,
            "{counts:?}"
        );
        assert!(
            share(&counts, is_of(0, Quantity::Jerk)) > 0.01,
            "{counts:?}"
        );
    });
}

#[test]
fn a_rapid_is_limited_by_its_axis_and_the_slider_by_itself() {
    with_machine(|machine| {
        let rapid = MoveRequest {
            motion_type: MotionType::Traverse,
            max_velocity: 100.0,
            ..feed_move(1e4)
        };
        machine.line(at(90.0, 10.0), &rapid).expect("a line");
        machine.limits.velocity *= 99.0 / 100.0;
        machine.planner.set_limits(&machine.limits);
        let seen = run(machine, 1.0);
        let fast = seen
            .iter()
            .filter(|seen| is_of(0, Quantity::Velocity)(seen.survey.limit));
        assert!(fast.count() > 500);
        machine.planner.set_velocity_limit(20.0);
        machine.line(at(70.0, 10.0), &rapid).expect("a line");
        let seen = run(machine, 1.0);
        let slow = seen
            .iter()
            .filter(|seen| seen.survey.limit == SpeedLimit::PathVelocity);
        assert!(slow.count() > 800);
    });
}

#[test]
fn in_a_curve_the_axes_take_turns() {
    with_machine(|machine| {
        blended(machine);
        curve(machine, 1500, 0.3, 80.0);
        let seen = run(machine, 1.0);
        let counts = check(machine, &seen, 80.0, 1.0);
        for axis in [0, 1] {
            let by_axis = |limit| matches!(limit, SpeedLimit::Axis { axis: of, .. } if of == axis);
            assert!(share(&counts, by_axis) > 0.25, "{counts:?}");
        }
    });
}

#[test]
fn a_hold_is_a_hold_and_what_waits_waits() {
    with_machine(|machine| {
        machine
            .line(at(60.0, 0.0), &feed_move(60.0))
            .expect("a line");
        machine.cycle();
        for _ in 0..300 {
            machine.cycle();
            machine.planner.survey(&machine.inputs);
        }
        machine.planner.pause();
        for _ in 0..300 {
            machine.cycle();
            let limit = machine.planner.survey(&machine.inputs).limit;
            assert_eq!(limit, SpeedLimit::Hold);
        }
        machine.planner.resume();
        let seen = run(machine, 1.0);
        assert_eq!(
            seen.last().map(|seen| seen.survey.limit),
            Some(SpeedLimit::Nothing)
        );
        let waits = MoveRequest {
            wait_for_spindle: true,
            ..feed_move(60.0)
        };
        machine.inputs.spindles_at_speed = false;
        machine.line(at(0.0, 0.0), &waits).expect("a line");
        for _ in 0..20 {
            machine.cycle();
            machine.planner.survey(&machine.inputs);
        }
        assert_eq!(machine.planner.surveyed().limit, SpeedLimit::Spindle);
    });
}

/// Whether what it said it would take until the end is what it took, from where all of it was planned on.
fn check_times(seen: &[Seen], least_planned: f64) {
    let mut planned = 0;
    for (k, now) in seen.iter().enumerate() {
        let left = (seen.len() - 1 - k) as f64 * PERIOD;
        let survey = &now.survey;
        assert!(
            survey.seconds_ahead <= survey.seconds_queued + 1e-9,
            "{k}: {now:?}"
        );
        assert!(survey.moves_ahead <= now.queued, "{k}: {now:?}");
        if survey.moves_ahead == now.queued && now.queued > 0 {
            planned += 1;
            // A plan becomes faster while it is run, and never slower.
            let saved = survey.seconds_queued - left;
            assert!(
                (-2.0 * PERIOD..=0.035 * left + PERIOD).contains(&saved),
                "{k}: {now:?}, left {left}"
            );
        }
    }
    let share = f64::from(planned) / seen.len() as f64;
    assert!(share > least_planned, "{share}");
}

#[test]
fn what_is_planned_takes_as_long_as_it_says() {
    with_machine(|machine| {
        blended(machine);
        curve(machine, 60, 2.0, 40.0);
        let seen = run(machine, 1.0);
        check_times(&seen, 0.1);
    });
    with_machine(|machine| {
        machine
            .line(at(60.0, 0.0), &feed_move(60.0))
            .expect("a line");
        let circle = Circle {
            center: Vector3::new(60.0, 20.0, 0.0),
            normal: Vector3::z(),
            revolutions: 0,
        };
        machine
            .circle(at(80.0, 20.0), &circle, &feed_move(30.0))
            .expect("an arc");
        let seen = run(machine, 1.0);
        check_times(&seen, 0.1);
    });
}

#[test]
fn what_is_queued_takes_about_as_long_as_it_says() {
    with_machine(|machine| {
        blended(machine);
        curve(machine, 1900, 0.2, 80.0);
        let seen = run(machine, 1.0);
        let all = seen.len();
        for (k, now) in seen.iter().enumerate().skip(all / 4) {
            let left = (all - 1 - k) as f64 * PERIOD;
            let off = (now.survey.seconds_queued - left).abs();
            assert!(off <= 0.4 * left + 0.1, "{k}: {now:?}, left {left}");
        }
        assert_eq!(machine.planner.moves_done(), 1900);
    });
}

#[test]
fn looking_changes_nothing() {
    let mut runs = [false, true].map(|looks| {
        let mut positions = Vec::new();
        with_machine(|machine| {
            blended(machine);
            curve(machine, 300, 0.2, 80.0);
            while !machine.cycle().done {
                if looks {
                    machine.planner.survey(&machine.inputs);
                }
            }
            positions.clone_from(&machine.positions);
        });
        positions
    });
    assert!(runs[0].len() > 500);
    let [one, other] = &mut runs;
    assert_eq!(one, other);
}

/// By how much the share that is told may be below the greatest one of the recording, but where one limit follows on another:
/// third differences are means over three periods.
const BESIDE: f64 = 0.1;

#[test]
fn joints_with_limits_limit_the_machine_in_place_of_axes() {
    with_machine(|machine| {
        assert!(machine.planner.set_joints(Some(joints_of(EXACT_TABLE, 5))));
        blended(machine);
        let ends = [
            [60.0, 20.0, 0.0, 30.0, 90.0],
            [0.0, 50.0, 10.0, -20.0, 200.0],
        ];
        for [x, y, z, a, c] in ends {
            let end = Axes::from([x, y, z, a, 0.0, c, 0.0, 0.0, 0.0]);
            machine.line(end, &feed_move(1e5)).expect("a line");
        }
        let seen = run(machine, 1.0);
        machine.limits = joint_limits(5, [100.0, 1000.0, 20_000.0]);
        for position in &mut machine.positions {
            *position = table(position);
        }
        let (mut told, mut beside) = ([0; 3], 0);
        let windows = machine.positions.windows(4);
        for (window, seen) in windows
            .skip(machine.positions.len() - 3 - seen.len())
            .zip(&seen)
        {
            let SpeedLimit::Joint { joint, quantity } = seen.survey.limit else {
                continue;
            };
            let limits = &machine.limits;
            let [a, b, c, d] = window else {
                panic!("four positions");
            };
            let shares = [
                ((d - c) / PERIOD).component_div(&limits.velocity),
                ((d - c * 2.0 + b) / PERIOD.powi(2)).component_div(&limits.acceleration),
                ((d - c * 3.0 + b * 3.0 - a) / PERIOD.powi(3)).component_div(&limits.jerk),
            ];
            let greatest = shares.iter().map(Axes::amax).fold(0.0, f64::max);
            let order = quantity as usize;
            let share = shares[order][joint].abs();
            told[order] += 1;
            beside += usize::from(share < greatest - BESIDE);
        }
        assert!(20 * beside < told.iter().sum(), "{beside} of {told:?}");
        assert!(told.iter().all(|count| *count > 20), "{told:?}");
    });
}
