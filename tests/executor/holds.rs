//! How soon the executor comes to rest where the reference turns at its jerk limit.

use crate::support::monitor::Monitor;
use crate::support::uniform_limits;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::{Cell, Demand, Executor, ExecutorStep, JERK_KEPT};

const PERIOD: f64 = 1e-3;
const RADIUS: f64 = 2.0;
/// Radians per second: turning takes .997 of the jerk, R w^3, and .93 of the acceleration.
const TURNING: f64 = 21.523;

fn limits() -> AxisLimits {
    uniform_limits(100.0, 1000.0, 20_000.0)
}

/// A machine that was held on a circle that the reference runs at constant speed, for ever.
struct Circling {
    executor: Box<Executor>,
    monitor: Monitor,
    /// Angle where the machine began, radians.
    phase: f64,
    time: f64,
    pushed: usize,
}

impl Circling {
    fn new(phase: f64) -> Self {
        let mut executor = Box::new(Executor::new());
        executor.configure(&limits(), PERIOD).unwrap();
        let mut circling = Self {
            executor,
            monitor: Monitor::new(&limits(), PERIOD, at(phase, 0)),
            phase,
            time: 0.0,
            pushed: 0,
        };
        // That the machine starts at full speed is not to be seen.
        circling.cycle(&Demand::RUN);
        circling.hold();
        let position = at(circling.phase + TURNING * circling.time, 0);
        circling.monitor = Monitor::new(&limits(), PERIOD, position);
        circling
    }

    fn cycle(&mut self, demand: &Demand) -> ExecutorStep {
        while self.executor.cells_ahead() < self.executor.cells_wanted() {
            let angle = self.phase + TURNING * PERIOD * self.pushed as f64;
            self.executor.push(&cell(angle)).unwrap();
            self.pushed += 1;
        }
        let step = self.executor.cycle(demand);
        self.time += step.advance;
        self.monitor.push(at(self.phase + TURNING * self.time, 0));
        step
    }

    /// Periods until it rests.
    fn hold(&mut self) -> usize {
        (1..2000)
            .find(|_| self.cycle(&Demand::HOLD).at_rest)
            .expect("a rest")
    }

    /// Periods until it runs as the reference does.
    fn rise(&mut self) -> usize {
        let full = |step: ExecutorStep| step.rate == 1.0 && step.rate_acceleration == 0.0;
        (1..2000)
            .find(|_| full(self.cycle(&Demand::RUN)))
            .expect("full rate")
    }

    fn keeps_limits(&self) {
        let monitor = &self.monitor;
        assert!(monitor.acceleration <= 1.001, "{}", monitor.acceleration);
        assert!(monitor.jerk <= JERK_KEPT, "{}", monitor.jerk);
        assert_eq!(self.executor.backups_lost(), 0);
    }
}

/// The derivative of this order by time, at an angle on the circle.
fn at(angle: f64, order: i32) -> Axes {
    let (sin, cos) = (angle + f64::from(order) * std::f64::consts::FRAC_PI_2).sin_cos();
    (Axes::x() * cos + Axes::y() * sin) * RADIUS * TURNING.powi(order)
}

fn cell(angle: f64) -> Cell {
    let turned = TURNING * PERIOD;
    // A curve over a small angle hardly leaves what lies between its ends.
    let bulge = |order: i32| (Axes::x() + Axes::y()) * at(0.0, order).norm() * turned.powi(2) / 8.0;
    let least = |order: i32| at(angle, order).inf(&at(angle + turned, order)) - bulge(order);
    let greatest = |order: i32| at(angle, order).sup(&at(angle + turned, order)) + bulge(order);
    Cell {
        velocity: at(angle, 1),
        acceleration: at(angle, 2),
        acceleration_min: least(2),
        acceleration_max: greatest(2),
        jerk_min: least(3),
        jerk_max: greatest(3),
        path_velocity: RADIUS * TURNING,
        path_acceleration: 0.0,
        feed_ratio: 1.0,
        programmed_feed: RADIUS * TURNING,
        feed_per_turn: None,
        rapid: false,
        override_enabled: true,
    }
}

fn phases() -> impl Iterator<Item = f64> {
    (0..16).map(|sixteenth| f64::from(sixteenth) * std::f64::consts::TAU / 16.0)
}

/// A rate that rises as fast as the limits allow cannot be taken back soon on such a circle.
#[test]
fn a_hold_while_the_rate_rises_takes_little_longer_than_one_at_full_rate() {
    let (mut at_full_rate, mut while_rising) = (0, 0);
    for phase in phases() {
        let mut circling = Circling::new(phase);
        circling.rise();
        at_full_rate = at_full_rate.max(circling.hold());
        circling.keeps_limits();
        for risen in (20..160).step_by(10) {
            let mut circling = Circling::new(phase);
            for _ in 0..risen {
                circling.cycle(&Demand::RUN);
            }
            while_rising = while_rising.max(circling.hold());
            circling.keeps_limits();
        }
    }
    assert!(
        while_rising <= at_full_rate + 25,
        "{while_rising} periods while it rises, {at_full_rate} at full rate"
    );
}

/// What is held back for a hold does not make the rise much longer.
#[test]
fn the_rate_rises_nearly_as_fast_as_it_falls() {
    let (mut falls, mut rises) = (0, 0);
    for phase in phases() {
        let mut circling = Circling::new(phase);
        rises += circling.rise();
        falls += circling.hold();
        circling.keeps_limits();
    }
    assert!(
        (rises as f64) < 1.2 * falls as f64,
        "it rises in {rises}, falls in {falls} periods"
    );
}
