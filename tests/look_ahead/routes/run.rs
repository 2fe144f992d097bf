//! Runs a look-ahead to its end and watches what the axes do.

use framepath::axes::{AXIS_COUNT, Axes, AxisLimits};
use framepath::machine_map::MachineMap;
use framepath::speed::look_ahead::{LookAhead, PlanProgress, PlannedSegment, Route};

/// Servo period, seconds.
pub const PERIOD: f64 = 1e-3;

pub fn limits(velocity: f64, acceleration: f64, jerk: f64) -> AxisLimits {
    AxisLimits {
        velocity: Axes::repeat(velocity),
        acceleration: Axes::repeat(acceleration),
        jerk: Axes::repeat(jerk),
    }
}

/// A planner at rest at 0, on the heap since it is larger than the stack of a test.
pub fn planner(limits: &AxisLimits) -> Box<LookAhead> {
    let mut planner = std::thread::Builder::new()
        .stack_size(64 << 20)
        .spawn(|| Box::new(LookAhead::new()))
        .expect("a thread")
        .join()
        .expect("a planner");
    planner.start(0.0, limits, &MachineMap::IDENTITY, PERIOD);
    planner
}

/// The greatest values of all samples over their limits.
#[derive(Clone, Copy, Debug, Default)]
pub struct Peaks {
    pub velocity: f64,
    pub acceleration: f64,
    /// Third differences at the period of the samples.
    pub jerk: f64,
    /// In continuous time, at the samples.
    pub continuous_jerk: f64,
}

/// Watches positions that come one each period.
pub struct Monitor {
    limits: AxisLimits,
    period: f64,
    last: [Axes; 3],
    count: usize,
    pub peaks: Peaks,
}

impl Monitor {
    pub fn new(limits: &AxisLimits, period: f64) -> Self {
        Self {
            limits: *limits,
            period,
            last: [Axes::zeros(); 3],
            count: 0,
            peaks: Peaks::default(),
        }
    }

    pub fn push(&mut self, position: Axes) {
        if self.count == 0 {
            // At rest before the first sample.
            self.last = [position; 3];
        }
        self.count += 1;
        let [a, b, c] = self.last;
        let h = self.period;
        let velocity = (position - c) / h;
        let acceleration = (position - c * 2.0 + b) / (h * h);
        let jerk = (position - c * 3.0 + b * 3.0 - a) / (h * h * h);
        for axis in 0..AXIS_COUNT {
            let peak = |old: f64, value: f64, limit: f64| old.max(value.abs() / limit);
            let (peaks, limits) = (&mut self.peaks, &self.limits);
            peaks.velocity = peak(peaks.velocity, velocity[axis], limits.velocity[axis]);
            peaks.acceleration = peak(
                peaks.acceleration,
                acceleration[axis],
                limits.acceleration[axis],
            );
            peaks.jerk = peak(peaks.jerk, jerk[axis], limits.jerk[axis]);
        }
        self.last = [b, c, position];
    }
}

/// Makes a plan of a route that is known as a whole, with `slices` slices before it starts, and
/// freezes it as a machine would that is told of everything in advance.
pub fn offline<R: Route>(planner: &mut LookAhead, route: &R, slices: usize) -> Vec<PlannedSegment> {
    for _ in 0..slices {
        planner.slice(route, 2000);
    }
    let mut pieces = Vec::new();
    while let Some(piece) = planner.freeze() {
        pieces.push(piece);
        for _ in 0..20 {
            planner.slice(route, 2000);
        }
    }
    pieces
}

/// What a machine has seen that ran a plan while it was made.
pub struct LiveRun {
    pub pieces: Vec<PlannedSegment>,
    /// Rests before the end.
    pub rests: usize,
    /// Seconds in total, from the first call.
    pub duration: f64,
}

/// Runs to the end with `budget` units a period. `arrive` is told the time and makes more of the
/// route known; a rest before the end starts the planner anew from there.
pub fn live<R: Route>(
    planner: &mut LookAhead,
    route: &mut R,
    limits: &AxisLimits,
    budget: u32,
    mut arrive: impl FnMut(&mut R, f64, bool),
) -> LiveRun {
    let mut run = LiveRun {
        pieces: Vec::new(),
        rests: 0,
        duration: 0.0,
    };
    // When the plan that is running was started.
    let mut origin: Option<f64> = None;
    let mut cycle = 0;
    loop {
        let now = cycle as f64 * PERIOD;
        cycle += 1;
        assert!(now < 100.0, "the machine does not arrive");
        arrive(route, now, origin.is_some() && planner.brakes_within(0.08));
        let progress = planner.slice(route, budget);
        assert!(
            !matches!(progress, PlanProgress::Refused(_)),
            "{progress:?} at {}",
            planner.end()
        );
        if progress != PlanProgress::Ready {
            continue;
        }
        let origin_time = *origin.get_or_insert(now);
        while planner.frozen_time() < now - origin_time + 6.0 * PERIOD {
            let Some(mut piece) = planner.freeze() else {
                break;
            };
            piece.start_time += origin_time;
            run.pieces.push(piece);
        }
        let at_rest = planner.is_frozen() && now - origin_time >= planner.frozen_time();
        if at_rest {
            run.duration = origin_time + planner.frozen_time();
            let s = planner.end();
            if route.is_complete() && s >= route.known_end() {
                return run;
            }
            run.rests += 1;
            planner.start(s, limits, &MachineMap::IDENTITY, PERIOD);
            origin = None;
        }
    }
}

/// Seconds of motion.
pub fn duration(pieces: &[PlannedSegment]) -> f64 {
    pieces.iter().map(|piece| piece.duration).sum()
}

/// The pieces join without a jump in s, v and a, and end at rest at `end`.
pub fn check_continuity(pieces: &[PlannedSegment], end: f64) {
    for (piece, next) in pieces.iter().zip(&pieces[1..]) {
        assert!(piece.duration > 0.0 && piece.duration.is_finite());
        let (before, behind) = (piece.at(piece.duration), next.at(0.0));
        let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-8 * scale;
        assert!(
            near(before.distance, behind.distance, 1.0 + end),
            "{before:?} {behind:?}"
        );
        assert!(
            near(before.velocity, behind.velocity, 1.0 + before.velocity),
            "{before:?} {behind:?}"
        );
        assert!(
            near(before.acceleration, behind.acceleration, 1e3),
            "{before:?} {behind:?}"
        );
    }
    let last = &pieces[pieces.len() - 1];
    let rest = last.at(last.duration);
    assert_eq!(rest.distance, end);
    assert_eq!(rest.velocity, 0.0);
}

/// Samples the pieces once a period.
pub fn peaks<R: Route>(
    pieces: &[PlannedSegment],
    route: &R,
    limits: &AxisLimits,
    period: f64,
) -> Peaks {
    let mut monitor = Monitor::new(limits, period);
    let mut piece = 0;
    let last = pieces.len() - 1;
    let duration = pieces[last].start_time + pieces[last].duration;
    let count = (duration / period).ceil() as usize + 3;
    for sample in 0..count {
        let t = sample as f64 * period;
        while piece < last && t >= pieces[piece].start_time + pieces[piece].duration {
            piece += 1;
        }
        let state = pieces[piece].at(t - pieces[piece].start_time);
        let point = route.point(state.distance);
        monitor.push(point.position);
        let (v, a, j) = (state.velocity, state.acceleration, state.jerk);
        let jerk = point.first * j + point.second * (3.0 * v * a) + point.third * (v * v * v);
        if t < duration {
            let most = jerk.component_div(&limits.jerk).amax();
            monitor.peaks.continuous_jerk = monitor.peaks.continuous_jerk.max(most);
        }
    }
    monitor.peaks
}
