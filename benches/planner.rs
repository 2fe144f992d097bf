//! What the planner costs in a servo period, and when a move is added.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::Circle;
use framepath::moves::{MotionType, StateTag, TerminationCondition};
use framepath::planner::{CycleInputs, MoveRequest, Planner};
use nalgebra::Vector3;

fn request(feed: f64) -> MoveRequest {
    MoveRequest {
        motion_type: MotionType::Feed,
        feed,
        max_velocity: 100.0,
        path_jerk: f64::INFINITY,
        enables: 0x0f,
        wait_for_spindle: false,
        indexer_joint: None,
        tag: StateTag::EMPTY,
    }
}

/// At G61.1. Made where there is room for it on the stack.
fn planner() -> Box<Planner> {
    let thread = std::thread::Builder::new().stack_size(64 << 20);
    let mut planner = thread
        .spawn(|| Box::new(Planner::new()))
        .expect("a thread")
        .join()
        .expect("a planner");
    planner.set_cycle_time(1e-3);
    planner.set_termination(TerminationCondition::Stop);
    planner.set_limits(&AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    });
    planner
}

/// Goes to and fro by `distance` on all axes for ever.
fn shuttle(planner: &mut Planner, distance: f64, inputs: &CycleInputs) {
    while planner.status().queue_depth < 16 {
        let sign = if planner.goal()[0] > 0.0 { -1.0 } else { 1.0 };
        let end = Axes::repeat(sign * distance);
        planner.add_line(&end, &request(50.0)).expect("a line");
    }
    planner.cycle(inputs);
}

/// Quarter circles with all other axes in proportion, for ever.
fn circles(planner: &mut Planner, radius: f64, inputs: &CycleInputs) {
    let circle = Circle {
        center: Vector3::new(-radius, 0.0, 0.0),
        normal: Vector3::z(),
        revolutions: 0,
    };
    while planner.status().queue_depth < 16 {
        let mut end = Axes::zeros();
        end[5] = if planner.goal()[5] > 0.0 { -1.0 } else { 1.0 };
        planner
            .add_circle(&end, &circle, &request(50.0))
            .expect("an arc");
    }
    planner.cycle(inputs);
}

/// What it takes to say what the operator sees, `count` servo periods in sum; with what it takes to look at the clock.
fn survey_time(planner: &mut Planner, radius: f64, inputs: &CycleInputs, count: u64) -> Duration {
    (0..count)
        .map(|_| {
            circles(planner, radius, inputs);
            let start = Instant::now();
            black_box(planner.survey(inputs));
            start.elapsed()
        })
        .sum()
}

fn cycles(c: &mut Criterion) {
    let full = CycleInputs::default();
    let half = CycleInputs {
        feed_scale: 0.5,
        net_feed_scale: 0.5,
        ..full
    };
    for (name, distance, inputs) in [
        ("cycle/lines of 100 mm", 50.0, full),
        ("cycle/lines of 100 mm at 50 %", 50.0, half),
        ("cycle/lines of 0.02 mm", 0.01, full),
    ] {
        let mut planner = planner();
        c.bench_function(name, |b| {
            b.iter(|| shuttle(&mut planner, distance, &inputs))
        });
    }
    for (name, radius) in [
        ("cycle/circles of 20 mm", 20.0),
        ("cycle/circles of 0.1 mm", 0.1),
    ] {
        let mut planner = planner();
        c.bench_function(name, |b| b.iter(|| circles(&mut planner, radius, &full)));
    }
    let mut moving = planner();
    c.bench_function("survey/circles of 20 mm", |b| {
        b.iter_custom(|count| survey_time(&mut moving, 20.0, &full, count))
    });
    let mut idle = planner();
    c.bench_function("cycle/nothing to do", |b| b.iter(|| idle.cycle(&full).done));
}

/// What a program consists of.
#[derive(Clone, Copy)]
enum Kind {
    /// Corners 7 mm apart.
    Lines,
    /// Half circles of 5 mm.
    Arcs,
    /// Lines of 0.2 mm along a curve.
    Dense,
}

impl Kind {
    const ALL: [(Self, &'static str); 3] = [
        (Self::Lines, "lines"),
        (Self::Arcs, "arcs"),
        (Self::Dense, "dense"),
    ];

    /// Where move `k` ends, in as many axes.
    fn end(self, k: u32, axes: usize) -> Axes {
        let s = 0.2 * f64::from(k);
        let across = if k.is_multiple_of(2) { 0.0 } else { 5.0 };
        let first = match self {
            Self::Lines => [5.0 * f64::from(k), across, across],
            Self::Arcs => [10.0 * f64::from(k), 0.0, across],
            Self::Dense => [
                20.0 * (s / 20.0).sin(),
                15.0 * (s / 17.0).cos(),
                5.0 * (s / 11.0).sin(),
            ],
        };
        Axes::from_fn(|axis, _| match (first.get(axis), self) {
            (Some(place), _) => *place,
            (None, _) if axis >= axes => 0.0,
            (None, Self::Dense) => first[axis % 3] + 0.1 * (s / (5.0 + axis as f64)).sin(),
            (None, _) => across / axis as f64,
        })
    }

    fn add(self, planner: &mut Planner, k: u32, axes: usize) {
        let end = self.end(k, axes);
        let request = request(100.0);
        match self {
            Self::Lines | Self::Dense => planner.add_line(&end, &request),
            Self::Arcs => {
                let center = Vector3::new(10.0 * f64::from(k) - 5.0, 0.0, 0.0);
                let up = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
                let circle = Circle {
                    center,
                    normal: up * Vector3::z(),
                    revolutions: 0,
                };
                planner.add_circle(&end, &circle, &request)
            }
        }
        .expect("a move");
    }
}

/// Moves in the queue, of the 2000 that LinuxCNC has room for.
const QUEUES: [usize; 4] = [10, 100, 1000, 2000];
const AXES: [usize; 3] = [3, 5, 9];

/// Calls `measure` for every kind of move, number of axes and length of the queue, with a planner at
/// G64 P0.01.
fn tables(
    c: &mut Criterion,
    name: &str,
    mut measure: impl FnMut(&mut Planner, Kind, usize, usize, u64) -> Duration,
) {
    for (kind, kind_name) in Kind::ALL {
        let mut group = c.benchmark_group(format!("{name}, {kind_name}"));
        group.sample_size(10);
        group.warm_up_time(Duration::from_millis(200));
        group.measurement_time(Duration::from_millis(500));
        for (axes, queue) in AXES
            .into_iter()
            .flat_map(|axes| QUEUES.map(|queue| (axes, queue)))
        {
            let mut planner = planner();
            planner.set_termination(TerminationCondition::Continuous { tolerance: 0.01 });
            let id = BenchmarkId::new(format!("{axes} axes"), queue);
            group.bench_function(id, |b| {
                b.iter_custom(|iterations| measure(&mut planner, kind, axes, queue, iterations));
            });
        }
        group.finish();
    }
}

/// What this thread has used of the processor so far: other programs must not count.
#[allow(unsafe_code)]
fn thread_time() -> Duration {
    let mut time = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: the address is that of a timespec, which the call fills.
    let failed = unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) };
    assert_eq!(failed, 0, "Linux has this clock");
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// What the measurement itself adds to each time that is measured.
fn overhead() -> Duration {
    const TIMES: u32 = 10_000;
    let mut spent = Duration::ZERO;
    for _ in 0..TIMES {
        let begin = thread_time();
        spent += thread_time() - begin;
    }
    spent / TIMES
}

/// A servo period, planning included, while the queue is kept as long.
fn servo_periods(c: &mut Criterion) {
    let mut k = 0;
    let overhead = overhead();
    tables(
        c,
        "servo period",
        |planner, kind, axes, queue, iterations| {
            if planner.status().queue_depth == 0 {
                k = 0;
            }
            let mut spent = Duration::ZERO;
            for _ in 0..iterations {
                while planner.status().queue_depth < queue {
                    k += 1;
                    kind.add(planner, k, axes);
                }
                let begin = thread_time();
                black_box(planner.cycle(&CycleInputs::default()).done);
                spent += (thread_time() - begin).saturating_sub(overhead);
            }
            spent
        },
    );
}

/// A move added, until the queue is as long.
fn adding(c: &mut Criterion) {
    tables(c, "move added", |planner, kind, axes, queue, iterations| {
        let mut spent = Duration::ZERO;
        let mut left = iterations;
        while left > 0 {
            planner
                .set_position(&kind.end(0, axes))
                .expect("a position");
            let moves = left.min(queue as u64) as u32;
            let begin = thread_time();
            for k in 1..=moves {
                kind.add(planner, k, axes);
            }
            spent += thread_time() - begin;
            left -= u64::from(moves);
        }
        spent
    });
}

criterion_group!(benches, cycles, servo_periods, adding);
criterion_main!(benches);
