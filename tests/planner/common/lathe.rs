//! A machine with a simulated spindle and its encoder.

use framepath::axes::Axes;
use framepath::planner::{MoveRequest, SpindleError, Status};

use super::{Machine, PERIOD, feed_move};

/// One that is not the first.
pub const SPINDLE: usize = 3;

/// Along Z.
pub fn z(depth: f64) -> Axes {
    let mut axes = Axes::zeros();
    axes[2] = depth;
    axes
}

/// A feed move that may use 100 mm/s.
pub fn fast() -> MoveRequest {
    MoveRequest {
        max_velocity: 100.0,
        ..feed_move(5.0)
    }
}

/// A machine with a spindle that comes to its commanded speed with a given acceleration.
pub struct Lathe<'a> {
    pub machine: &'a mut Machine,
    /// Turns, never set anew.
    pub turns: f64,
    pub speed: f64,
    pub commanded: f64,
    pub reverse: bool,
    /// Turns a second squared.
    pub acceleration: f64,
    /// Where the encoder's count was 0.
    pub zero: f64,
    pub awaits_index: bool,
    /// Whether the encoder has an index.
    pub has_index: bool,
    /// Counts of the encoder in a turn, 0: as fine as can be.
    pub counts: f64,
    /// For each cycle: the encoder's turns, as measured before it, and Z after it.
    pub record: Vec<(f64, f64)>,
    pub errors: Vec<SpindleError>,
}

impl<'a> Lathe<'a> {
    pub fn new(machine: &'a mut Machine, speed: f64) -> Self {
        let mut lathe = Self {
            machine,
            turns: 0.37,
            speed,
            commanded: speed,
            reverse: speed < 0.0,
            acceleration: 20.0,
            zero: 0.1,
            awaits_index: false,
            has_index: true,
            counts: 0.0,
            record: Vec::new(),
            errors: Vec::new(),
        };
        for _ in 0..500 {
            lathe.cycle();
        }
        lathe.record.clear();
        lathe
    }

    pub fn cycle(&mut self) -> Status {
        let change = self.acceleration * PERIOD;
        self.speed += (self.commanded - self.speed).clamp(-change, change);
        let before = self.turns;
        self.turns += self.speed * PERIOD;
        // The index is at whole turns.
        if self.has_index && self.awaits_index && before.floor() != self.turns.floor() {
            self.zero = before.floor().max(self.turns.floor());
            self.awaits_index = false;
        }
        let mut turns = self.turns - self.zero;
        if self.counts > 0.0 {
            turns = (turns * self.counts).floor() / self.counts;
        }
        let spindle = &mut self.machine.inputs.spindles[SPINDLE];
        spindle.turns = turns;
        spindle.speed = self.speed;
        spindle.commanded = self.commanded.abs();
        // As with LinuxCNC, what a tap does is no change of the direction.
        spindle.reverse = self.reverse;
        spindle.awaits_index = self.awaits_index;
        let status = self.machine.cycle();
        if status.index_request == Some(SPINDLE) {
            self.awaits_index = true;
        }
        if let Some((SPINDLE, factor)) = status.spindle_factor {
            self.commanded *= factor;
        }
        self.errors.extend(status.spindle_error);
        self.record.push((turns, status.position[2]));
        status
    }

    pub fn run(&mut self, most: usize) {
        for _ in 0..most {
            if self.cycle().done {
                return;
            }
        }
        panic!("not done: {:?}", self.machine.planner.status());
    }

    /// Distance in pitches less turns, while Z is from `from` to `to`: Z after a cycle belongs to
    /// the angle that is measured two cycles later, since LinuxCNC's interpolator is late by one.
    pub fn phases(&self, from: f64, to: f64, pitch: f64) -> Vec<f64> {
        let pairs = self.record.windows(3);
        pairs
            .filter(|pair| (from.min(to)..=from.max(to)).contains(&pair[0].1))
            .map(|pair| pair[0].1 / pitch - pair[2].0)
            .collect()
    }

    /// Runs a thread along Z down to `depth`.
    pub fn thread(&mut self, depth: f64, pitch: f64) {
        self.machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, pitch, false);
        self.machine.line(z(depth), &fast()).expect("a thread");
        self.machine
            .planner
            .set_spindle_synchronisation(SPINDLE as i32, 0.0, false);
        self.run(100_000);
    }
}

pub fn spread(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
}

/// Greatest distance from a whole number.
pub fn off_the_groove(phases: &[f64]) -> f64 {
    assert!(phases.len() > 50);
    phases
        .iter()
        .map(|phase| (phase - phase.round()).abs())
        .fold(0.0, f64::max)
}

pub fn keeps_limits(machine: &Machine) {
    let worst = machine.extremes();
    assert!(worst.velocity < 1.001, "{worst:?}");
    assert!(worst.acceleration < 1.001, "{worst:?}");
    assert!(worst.jerk < 1.04, "{worst:?}");
}

/// How fast Z moves over the last 50 cycles.
pub fn feed_of(lathe: &Lathe) -> f64 {
    let last = lathe.record.len() - 1;
    (lathe.record[last].1 - lathe.record[last - 50].1).abs() / (50.0 * PERIOD)
}
