//! What the blended path costs: an evaluation, and the choice of widths for a move.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::{Line9, Shape};
use framepath::moves::{NearLimit, TerminationCondition};
use framepath::path::{BlendSettings, BlendedPath, ProgrammedMove};

fn line(serial: u64, from: &Axes, to: &Axes) -> ProgrammedMove {
    ProgrammedMove {
        serial,
        shape: Shape::Line(Line9::new(from, to).expect("a line")),
        feed: 100.0,
        feed_word: None,
        greatest_feed: 100.0,
        termination: TerminationCondition::Continuous { tolerance: 0.01 },
        stop_before: false,
        separate: false,
        may_swing_out: true,
        near_limit: NearLimit::NONE,
    }
}

/// Points of a curve in XYZ and C at a distance of `step` mm, rounded to `grid` mm.
fn points(step: f64, grid: f64) -> impl Fn(u64) -> Axes {
    move |k| {
        let s = step * k as f64;
        let mut point = Axes::zeros();
        point[0] = 20.0 * (s / 20.0).cos() - 20.0;
        point[1] = 15.0 * (s / 17.0).sin();
        point[2] = 2.0 * (s / 5.0).sin();
        point[5] = 10.0 * (s / 9.0).sin();
        point.map(|x| (x / grid).round() * grid)
    }
}

/// The corners of a zigzag.
fn corners(k: u64) -> Axes {
    let mut point = Axes::zeros();
    point[0] = 5.0 * k as f64;
    point[1] = if k.is_multiple_of(2) { 0.0 } else { 5.0 };
    point
}

/// Made where there is room for it on the stack.
fn new_path() -> Box<BlendedPath> {
    let thread = std::thread::Builder::new().stack_size(64 << 20);
    let made = thread.spawn(|| Box::new(BlendedPath::new()));
    let mut path = made.expect("a thread").join().expect("a path");
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(20_000.0),
    };
    let settings = BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound");
    path.restart(&settings, &Axes::zeros());
    path
}

fn measure(c: &mut Criterion, name: &str, point: impl Fn(u64) -> Axes) {
    let mut path = new_path();
    let mut k = 0;
    let mut add = |path: &mut BlendedPath| {
        path.add(&line(k, &point(k), &point(k + 1))).expect("room");
        k += 1;
        path.step(100_000);
        path.discard_before(path.final_end() - 20.0);
    };
    for _ in 0..200 {
        add(&mut path);
    }
    let end = path.final_end();
    let mut s = end - 10.0;
    c.bench_function(&format!("{name}: point"), |b| {
        b.iter(|| {
            s = if s > end { end - 10.0 } else { s + 0.0137 };
            black_box(path.point(s))
        });
    });
    c.bench_function(&format!("{name}: a move"), |b| b.iter(|| add(&mut path)));
}

fn blend(c: &mut Criterion) {
    measure(c, "zigzag of 7 mm", corners);
    measure(c, "lines of 0.2 mm", points(0.2, 1e-6));
    measure(c, "lines of 0.05 mm, rounded", points(0.05, 1e-3));
}

criterion_group!(benches, blend);
criterion_main!(benches);
