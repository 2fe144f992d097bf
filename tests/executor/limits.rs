//! Whatever is asked for, in any order: no axis leaves its limits, there is always a way on, and
//! the end of the reference is reached exactly.

use crate::support::monitor::Monitor;
use crate::support::player::Player;
use crate::support::reference::{Move, Reference, Shape};
use crate::support::uniform_limits;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::{Demand, JERK_KEPT};
use proptest::prelude::*;

/// Axes with each value from a range.
fn axes(values: std::ops::Range<f64>) -> impl Strategy<Value = Axes> + Clone {
    prop::array::uniform9(values).prop_map(Axes::from)
}

/// Limits that differ between the axes by up to 1 : 3.
fn finite_limits() -> impl Strategy<Value = AxisLimits> {
    let part = || prop_oneof![Just(Axes::repeat(1.0)), axes(0.3..1.0)];
    let scales = (30.0..300.0, 300.0..3000.0, 5_000.0..100_000.0);
    (scales, part(), part(), part()).prop_map(|((v, a, j), pv, pa, pj)| AxisLimits {
        velocity: pv * v,
        acceleration: pa * a,
        jerk: pj * j,
    })
}

/// A move without its limits.
#[derive(Clone, Debug)]
struct Sketch {
    shape: Shape,
    length: f64,
    feed: f64,
    rapid: bool,
    override_enabled: bool,
}

/// From 1 to 9 moving axes.
fn direction() -> impl Strategy<Value = Axes> + Clone {
    (1..=9_usize, axes(-1.0..1.0)).prop_map(|(count, values)| {
        let kept = Axes::from_fn(|i, _| if i < count { values[i] } else { 0.0 });
        (kept + Axes::x() * 1e-3).normalize()
    })
}

fn line() -> impl Strategy<Value = Shape> {
    direction().prop_map(Shape::Line)
}

fn curve() -> impl Strategy<Value = Shape> {
    let waves = (direction(), axes(0.0..5.0), axes(0.0..0.4), axes(0.0..6.3));
    prop_oneof![
        (-1.6..4.6_f64).prop_map(|radius| Shape::circle(radius.exp())),
        waves.prop_map(|(direction, amplitude, wave_number, phase)| Shape::Waves {
            direction,
            amplitude,
            wave_number,
            phase,
        }),
    ]
}

/// One to five moves of 20 micrometres to 100 mm.
fn sketches(shape: impl Strategy<Value = Shape>) -> impl Strategy<Value = Vec<Sketch>> {
    let sketch = (
        shape,
        (-3.9..4.6_f64).prop_map(f64::exp),
        10.0..400.0,
        prop::bool::weighted(0.3),
        prop::bool::weighted(0.9),
    );
    let made = sketch.prop_map(|(shape, length, feed, rapid, override_enabled)| Sketch {
        shape,
        length,
        feed,
        rapid,
        override_enabled,
    });
    prop::collection::vec(made, 1..6)
}

fn reference(sketches: &[Sketch], limits: &AxisLimits) -> Reference {
    let made = |sketch: &Sketch| {
        let shape = sketch.shape.clone();
        let mut made = Move::new(shape, sketch.length, sketch.feed, limits, 0.999);
        made.rapid = sketch.rapid;
        made.override_enabled = sketch.override_enabled;
        made
    };
    Reference::new(sketches.iter().map(made).collect())
}

/// What the operator does next, and for how many periods.
fn events(longest: usize) -> impl Strategy<Value = Vec<(usize, Demand)>> {
    let scale = || prop_oneof![Just(1.0), Just(0.0), 0.0..2.0, Just(f64::NAN)];
    let demand = (
        prop::bool::weighted(0.4),
        scale(),
        scale(),
        prop_oneof![2 => Just(f64::INFINITY), 1 => 0.0..200.0],
    );
    let demand = demand.prop_map(
        |(hold, feed_override, rapid_override, max_velocity)| Demand {
            hold,
            feed_override,
            rapid_override,
            max_velocity,
            ..Demand::RUN
        },
    );
    prop::collection::vec((1..longest, demand), 0..40)
}

/// Runs a reference with these demands, then without any, and judges it.
fn judge(
    reference: &Reference,
    limits: &AxisLimits,
    events: &[(usize, Demand)],
    period: f64,
) -> Result<(), TestCaseError> {
    let mut player = Player::new(reference, limits, period);
    let mut monitor = Monitor::new(limits, period, Axes::zeros());
    let mut demands = events
        .iter()
        .flat_map(|(count, demand)| std::iter::repeat_n(*demand, *count));
    let expected = (reference.duration() / period) as usize;
    let mut left = 2 * expected + (1.0 / period) as usize;
    let mut ended = false;
    while !ended {
        let demand = demands.next().unwrap_or_else(|| {
            left -= 1;
            Demand::RUN
        });
        prop_assert!(
            left > 0,
            "no end: {} of {}",
            player.time,
            reference.duration()
        );
        let (step, position) = player.cycle(&demand);
        monitor.push(position);
        ended = step.end_reached;
    }
    for _ in 0..4 {
        let (step, position) = player.cycle(&Demand::RUN);
        prop_assert!(step.end_reached && step.at_rest);
        monitor.push(position);
    }
    // The sum of up to a million advances; the executor itself counts within a cell.
    let missed = player.time - reference.duration();
    prop_assert!(missed.abs() < 1e-9, "{} s from the end", missed);
    prop_assert!(monitor.velocity <= 1.0, "velocity {}", monitor.velocity);
    prop_assert!(
        monitor.acceleration <= 1.001,
        "acceleration {}",
        monitor.acceleration
    );
    prop_assert!(monitor.jerk <= JERK_KEPT, "jerk {}", monitor.jerk);
    prop_assert_eq!(player.executor.backups_lost(), 0);
    Ok(())
}

/// The axis that is slower lies across the path at the start and along it at the end, where the
/// acceleration is at its greatest for an instant only: the reference has to be slow enough there.
#[test]
fn a_slower_axis_at_the_end_of_an_arc() {
    let mut limits = uniform_limits(30.0, 640.0, 97_352.0);
    limits.acceleration[0] = 1602.0;
    let sketch = Sketch {
        shape: Shape::circle(1.0),
        length: 46.069_769_360_729_89,
        feed: 10.0,
        rapid: false,
        override_enabled: false,
    };
    judge(&reference(&[sketch], &limits), &limits, &[], 0.25e-3).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(70) })]

    #[test]
    fn an_operator_now_and_then(
        limits in finite_limits(),
        sketches in sketches(prop_oneof![line(), curve()]),
        events in events(300),
    ) {
        judge(&reference(&sketches, &limits), &limits, &events, 1e-3)?;
    }

    #[test]
    fn an_adversary(
        limits in finite_limits(),
        sketches in sketches(prop_oneof![line(), curve()]),
        events in events(12),
        periods in prop::sample::select(vec![0.25e-3, 0.5e-3, 1e-3, 2e-3]),
    ) {
        // The same demands again and again, for the whole reference.
        let duration = reference(&sketches, &limits).duration();
        let count: usize = events.iter().map(|(count, _)| count).sum();
        let rounds = ((duration / periods) as usize / (count + 1)).min(50) + 1;
        let events = events.repeat(rounds);
        judge(&reference(&sketches, &limits), &limits, &events, periods)?;
    }

    #[test]
    fn axes_without_limits(
        limits in finite_limits(),
        no_jerk in prop::array::uniform9(any::<bool>()),
        no_acceleration in prop::array::uniform9(prop::bool::weighted(0.2)),
        all in any::<bool>(),
        sketches in sketches(line()),
        events in events(200),
    ) {
        let mut limits = limits;
        for axis in 0..9 {
            if no_jerk[axis] || all {
                limits.jerk[axis] = f64::INFINITY;
            }
            if no_acceleration[axis] {
                limits.acceleration[axis] = f64::INFINITY;
            }
        }
        // One axis keeps its limit, or a move would take no time at all.
        limits.acceleration[0] = limits.acceleration[0].min(3000.0);
        let mut sketches = sketches;
        for sketch in &mut sketches {
            sketch.shape = match &sketch.shape {
                Shape::Line(direction) => Shape::Line((direction + Axes::x() * 0.1).normalize()),
                other => other.clone(),
            };
        }
        judge(&reference(&sketches, &limits), &limits, &events, 1e-3)?;
    }
}
