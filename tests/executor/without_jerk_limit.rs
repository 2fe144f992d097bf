//! How the executor slows down and goes on where no axis has a limit of jerk.

use crate::support::monitor::Monitor;
use crate::support::uniform_limits;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::{Cell, Demand, Executor, ExecutorStep};
use proptest::prelude::*;

const PERIOD: f64 = 1e-3;
const ACCELERATION: f64 = 1000.0;

fn limits() -> AxisLimits {
    uniform_limits(200.0, ACCELERATION, f64::INFINITY)
}

/// A path at constant speed, for ever: a circle, or a line where the radius is infinite.
#[derive(Clone, Copy)]
struct Path {
    radius: f64,
    speed: f64,
    /// What the program asks for, over the speed.
    programmed: f64,
    /// From this reference time on it asks for a part of that only.
    slow: (f64, f64),
}

impl Path {
    fn new(radius: f64, speed: f64) -> Self {
        Self {
            radius,
            speed,
            programmed: 1.0,
            slow: (f64::INFINITY, 1.0),
        }
    }

    fn line(speed: f64) -> Self {
        Self::new(f64::INFINITY, speed)
    }

    /// What the program asks for.
    fn feed(&self, time: f64) -> f64 {
        let (from, part) = self.slow;
        self.programmed * self.speed * if time < from { 1.0 } else { part }
    }

    /// The derivative of this order by reference time.
    fn at(&self, time: f64, order: i32) -> Axes {
        if self.radius.is_infinite() {
            return Axes::x() * [self.speed * time, self.speed, 0.0][order as usize];
        }
        let turning = self.speed / self.radius;
        let angle = turning * time + f64::from(order) * std::f64::consts::FRAC_PI_2;
        (Axes::x() * angle.cos() + Axes::y() * angle.sin()) * self.radius * turning.powi(order)
    }

    fn cell(&self, start: f64) -> Cell {
        let ends = [self.at(start, 2), self.at(start + PERIOD, 2)];
        // A curve over a small angle hardly leaves what lies between its ends.
        let bulge = if self.radius.is_infinite() {
            0.0
        } else {
            ends[0].norm() * (self.speed / self.radius * PERIOD).powi(2) / 8.0
        };
        Cell {
            velocity: self.at(start, 1),
            acceleration: ends[0],
            acceleration_min: ends[0].inf(&ends[1]) - Axes::repeat(bulge),
            acceleration_max: ends[0].sup(&ends[1]) + Axes::repeat(bulge),
            jerk_min: Axes::zeros(),
            jerk_max: Axes::zeros(),
            path_velocity: self.speed,
            path_acceleration: 0.0,
            feed_ratio: 1.0,
            programmed_feed: self.feed(start),
            feed_per_turn: None,
            rapid: false,
            override_enabled: true,
        }
    }
}

/// A machine on such a path.
struct Machine {
    path: Path,
    executor: Box<Executor>,
    monitor: Monitor,
    time: f64,
    pushed: usize,
}

impl Machine {
    /// At full speed.
    fn new(path: Path) -> Self {
        let mut executor = Box::new(Executor::new());
        executor.configure(&limits(), PERIOD).unwrap();
        let mut machine = Self {
            path,
            executor,
            monitor: Monitor::new(&limits(), PERIOD, path.at(0.0, 0)),
            time: 0.0,
            pushed: 0,
        };
        // That it starts at full speed is not to be seen.
        for _ in 0..4 {
            machine.cycle(&Demand::RUN);
        }
        machine.monitor.acceleration = 0.0;
        machine
    }

    fn cycle(&mut self, demand: &Demand) -> ExecutorStep {
        while self.executor.cells_ahead() < self.executor.cells_wanted() {
            let start = PERIOD * self.pushed as f64;
            self.executor.push(&self.path.cell(start)).unwrap();
            self.pushed += 1;
        }
        let step = self.executor.cycle(demand);
        self.time += step.advance;
        self.monitor.push(self.path.at(self.time, 0));
        step
    }

    /// Periods until it is as fast as the demand leaves it.
    fn reaches(&mut self, rate: f64, demand: &Demand) -> usize {
        let reached = |step: ExecutorStep| (step.rate - rate).abs() < 1e-3;
        (1..2000)
            .find(|_| reached(self.cycle(demand)))
            .expect("the rate")
    }
}

fn override_of(feed_override: f64) -> Demand {
    Demand {
        feed_override,
        ..Demand::RUN
    }
}

/// In whole periods, from one in which the machine is faster than it should be to the last that moves.
#[test]
fn a_line_takes_the_periods_that_acceleration_asks_for() {
    for speed in [0.3, 0.99, 2.5, 7.0, 40.5, 99.0, 151.3] {
        let ideal = |share: f64| (share * speed / (ACCELERATION * PERIOD)).ceil() as usize;
        let mut machine = Machine::new(Path::line(speed));
        let falls = machine.reaches(0.0, &Demand::HOLD);
        let step = machine.cycle(&Demand::HOLD);
        assert!(step.at_rest && step.advance == 0.0);
        let rises = machine.reaches(1.0, &Demand::RUN);
        let slows = machine.reaches(0.3, &override_of(0.3));
        let hastens = machine.reaches(0.6, &override_of(0.6));
        for (periods, share) in [(falls, 1.0), (rises, 1.0), (slows, 0.7), (hastens, 0.3)] {
            let ideal = ideal(share);
            assert!(
                (ideal..=ideal + 1).contains(&periods),
                "{periods} periods for {share} of {speed} mm/s, {ideal} are possible"
            );
        }
        assert!(machine.monitor.acceleration <= 1.001);
    }
}

/// A circle that needs most of the acceleration by itself: it is braked as what is left allows.
#[test]
fn a_circle_at_its_limit_comes_to_rest() {
    let mut machine = Machine::new(Path::new(4.0, 60.0));
    let falls = machine.reaches(0.0, &Demand::HOLD);
    // By acceleration along the path alone it would be 60.
    assert!((61..=75).contains(&falls), "{falls}");
    assert!(machine.monitor.acceleration <= 1.001);
}

/// At half the feed the reference is faster than the program asks for further on; the executor brakes in
/// time, from full speed and from rests anywhere before.
#[test]
fn a_cap_ahead_is_kept() {
    let from = 0.2;
    let held = [f64::INFINITY, 0.1, 0.14, 0.18];
    let shortly_before = (0..100).map(|k| 0.19 + 1e-4 * f64::from(k));
    // From a rest the slow ones would be too fast for their cap after a single period.
    for (speed, part) in [(100.0, 0.6), (1.5, 0.1), (3.0, 0.05), (10.0, 0.02)] {
        for held_at in held.into_iter().chain(shortly_before.clone()) {
            let mut path = Path::line(speed);
            path.programmed = 2.0;
            path.slow = (from, part);
            let mut machine = Machine::new(path);
            let (mut periods, mut held) = (0, false);
            while machine.time < 0.25 {
                if machine.time >= held_at && !held {
                    machine.reaches(0.0, &Demand::HOLD);
                    held = true;
                }
                let step = machine.cycle(&override_of(0.5));
                if machine.time > from + PERIOD {
                    assert!(step.rate <= 1.01 * part + 1e-3, "{} of {part}", step.rate);
                }
                periods += 1;
                assert!(periods < 3000, "it stands at {}", machine.time);
            }
            assert!(machine.monitor.acceleration <= 1.001);
        }
    }
}

fn demands() -> impl Strategy<Value = Vec<(usize, Demand)>> {
    let demand = (
        prop::bool::weighted(0.3),
        prop_oneof![Just(1.0), Just(0.0), 0.0..1.2],
        prop_oneof![2 => Just(f64::INFINITY), 1 => 0.0..80.0],
    );
    let demand = demand.prop_map(|(hold, feed_override, max_velocity)| Demand {
        hold,
        feed_override,
        max_velocity,
        ..Demand::RUN
    });
    prop::collection::vec((1..60_usize, demand), 1..60)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn whatever_the_operator_does_the_limits_hold(
        radius in prop_oneof![Just(f64::INFINITY), 0.5..50.0_f64],
        used in 0.05..0.99_f64,
        demands in demands(),
    ) {
        let speed = (used * ACCELERATION * radius.min(20.0)).sqrt();
        let mut machine = Machine::new(Path::new(radius, speed));
        for (count, demand) in demands {
            for _ in 0..count {
                let step = machine.cycle(&demand);
                prop_assert!(!step.starved);
            }
        }
        let hold = machine.reaches(0.0, &Demand::HOLD);
        prop_assert!(hold < 1000);
        let acceleration = machine.monitor.acceleration;
        prop_assert!(acceleration <= 1.001, "{acceleration}");
    }
}
