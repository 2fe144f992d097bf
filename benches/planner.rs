//! What the planner costs in a servo period, and when a move is added.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, StateTag, TerminationCondition};
use framepath::path::Circle;
use framepath::planner::{CycleInputs, MoveRequest, Planner};
use nalgebra::Vector3;

fn request(feed: f64) -> MoveRequest {
    MoveRequest {
        motion_type: MotionType::Feed,
        feed,
        max_velocity: 100.0,
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
        turn: 0,
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
    let mut idle = planner();
    c.bench_function("cycle/nothing to do", |b| b.iter(|| idle.cycle(&full).done));
}

/// Point `k` of a curve, 0.2 mm from the one before, in as many axes.
fn contour(k: u32, axes: usize) -> Axes {
    let s = 0.2 * f64::from(k);
    let curve = [
        20.0 * (s / 20.0).sin(),
        15.0 * (s / 17.0).cos(),
        5.0 * (s / 11.0).sin(),
    ];
    Axes::from_fn(|axis, _| {
        if axis < axes {
            curve[axis % 3] + 0.1 * (s / (5.0 + axis as f64)).sin()
        } else {
            0.0
        }
    })
}

/// Short lines along a curve for ever, at G64 P0.01, with so many of them queued.
fn look_ahead(c: &mut Criterion) {
    let full = CycleInputs::default();
    let queues = [10, 100, 200, 1000, 2000].map(|queue| (3, queue));
    for (axes, queue) in queues.into_iter().chain([(5, 2000), (9, 2000)]) {
        let mut planner = planner();
        planner.set_termination(TerminationCondition::Continuous { tolerance: 0.01 });
        let mut k = 0;
        let name = format!("look-ahead/{axes} axes, {queue} moves queued");
        c.bench_function(&name, |b| {
            b.iter(|| {
                while planner.status().queue_depth < queue {
                    k += 1;
                    planner
                        .add_line(&contour(k, axes), &request(100.0))
                        .expect("a line");
                }
                planner.cycle(&full).done
            })
        });
    }
}

fn adding(c: &mut Criterion) {
    c.bench_function("add/line", |b| {
        b.iter_batched_ref(
            planner,
            |planner| planner.add_line(&Axes::repeat(1.0), &request(50.0)),
            BatchSize::LargeInput,
        );
    });
}

criterion_group!(benches, cycles, look_ahead, adding);
criterion_main!(benches);
