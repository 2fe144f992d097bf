//! What the look-ahead costs in a servo period, and to its first plan.

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../tests/look_ahead/routes/mod.rs"]
mod look_ahead_routes;

use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use framepath::axes::AxisLimits;
use framepath::machine_map::MachineMap;
use framepath::speed::look_ahead::{LookAhead, PlanProgress};
use look_ahead_routes::run::{PERIOD, limits, planner};
use look_ahead_routes::{Polyline, contour, zigzag};

/// Units a period: 10 microseconds or less.
const BUDGET: u32 = 300;

/// A machine that runs a route again and again.
struct Machine {
    planner: Box<LookAhead>,
    axes: AxisLimits,
    route: Polyline,
    now: f64,
}

impl Machine {
    fn new(route: Polyline) -> Self {
        let axes = limits(100.0, 1000.0, 20_000.0);
        Self {
            planner: planner(&axes),
            axes,
            route,
            now: 0.0,
        }
    }

    fn cycle(&mut self) {
        self.now += PERIOD;
        if self.planner.slice(&self.route, BUDGET) != PlanProgress::Ready {
            self.now = 0.0;
            return;
        }
        while self.planner.frozen_time() < self.now + 6.0 * PERIOD {
            let Some(piece) = self.planner.freeze() else {
                self.planner
                    .start(0.0, &self.axes, &MachineMap::IDENTITY, PERIOD);
                return;
            };
            black_box(piece);
        }
    }
}

fn cycles(c: &mut Criterion) {
    for (name, route) in [
        (
            "look-ahead/cycle, zig-zag of 10 mm",
            zigzag(20, 0.05, 100.0),
        ),
        ("look-ahead/cycle, contour of 0.2 mm", contour(300, 100.0)),
    ] {
        let mut machine = Machine::new(route);
        c.bench_function(name, |b| b.iter(|| machine.cycle()));
    }
}

fn first_plans(c: &mut Criterion) {
    for (name, route) in [
        (
            "look-ahead/first plan, zig-zag of 10 mm",
            zigzag(20, 0.05, 100.0),
        ),
        (
            "look-ahead/first plan, contour of 0.2 mm",
            contour(300, 100.0),
        ),
    ] {
        let axes = limits(100.0, 1000.0, 20_000.0);
        c.bench_function(name, |b| {
            b.iter_batched_ref(
                || planner(&axes),
                |planner| {
                    while planner.slice(&route, 1) == PlanProgress::Starting {}
                    planner.end()
                },
                BatchSize::LargeInput,
            );
        });
    }
}

criterion_group!(benches, cycles, first_plans);
criterion_main!(benches);
