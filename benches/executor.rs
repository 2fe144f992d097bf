//! What the executor costs in a servo period of 1 ms, nine axes moving.
//!
//! Each benchmark runs a whole reference with one kind of demand and reports the mean time of a
//! period; the worst period of many runs is printed before.

use criterion::{Criterion, criterion_group, criterion_main};
use framepath::cycle::cell::Cell;
use framepath::cycle::{Demand, Executor, ExecutorStep};
use std::time::{Duration, Instant};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../tests/executor/support/mod.rs"]
mod executor_support;
use executor_support::reference::{Move, Reference, Shape};
use executor_support::uniform_limits;
use framepath::axes::{Axes, AxisLimits};

const PERIOD: f64 = 1e-3;

/// A reference as cells, made beforehand: planning is not what is measured.
struct Cells {
    cells: Vec<Cell>,
    rest: f64,
    limits: AxisLimits,
}

impl Cells {
    /// Lines and waves in nine axes, at the limits of the axes.
    fn new(jerk: f64) -> Self {
        let limits = uniform_limits(150.0, 1000.0, jerk);
        let direction = Axes::from_fn(|i, _| 1.0 + 0.1 * i as f64).normalize();
        let waves = Shape::Waves {
            direction,
            amplitude: Axes::from_fn(|i, _| 0.5 + 0.3 * i as f64),
            wave_number: Axes::from_fn(|i, _| 0.11 + 0.02 * i as f64),
            phase: Axes::from_fn(|i, _| i as f64),
        };
        let moves = vec![
            Move::new(Shape::Line(direction), 200.0, 100.0, &limits, 0.999),
            Move::new(waves.clone(), 200.0, 100.0, &limits, 0.999),
            Move::new(Shape::Line(-direction), 5.0, 100.0, &limits, 0.999),
            Move::new(waves, 100.0, 50.0, &limits, 0.999),
        ];
        let reference = Reference::new(moves);
        let count = (reference.duration() / PERIOD).ceil() as usize;
        let cells = (0..count)
            .map(|i| reference.cell(i as f64 * PERIOD, PERIOD))
            .collect();
        Self {
            cells,
            rest: reference.duration() - (count - 1) as f64 * PERIOD,
            limits,
        }
    }

    /// Runs to the end, or for the given number of periods; `each` sees the time of every period.
    fn run(
        &self,
        executor: &mut Executor,
        periods: usize,
        mut demand: impl FnMut(usize) -> Demand,
        mut each: impl FnMut(Duration),
    ) {
        executor.configure(&self.limits, PERIOD).unwrap();
        let mut ahead = self.cells.iter().enumerate();
        for i in 0..periods {
            for _ in 0..8 {
                if executor.cells_ahead() >= executor.cells_wanted() {
                    break;
                }
                let Some((index, cell)) = ahead.next() else {
                    break;
                };
                executor.push(cell).unwrap();
                if index + 1 == self.cells.len() {
                    executor.close(self.rest).unwrap();
                }
            }
            let demand = demand(i);
            let start = Instant::now();
            let step: ExecutorStep = executor.cycle(&demand);
            each(start.elapsed());
            if step.end_reached {
                return;
            }
        }
    }
}

/// Feed override or hold that changes all the time, the same in every run.
fn restless(period: usize) -> Demand {
    let noise = (period / 50).wrapping_mul(2_654_435_761) >> 8;
    Demand {
        hold: noise.is_multiple_of(5),
        feed_override: 0.1 + (noise % 100) as f64 * 0.012,
        ..Demand::RUN
    }
}

/// Name of a case and its demand in each period.
type Case = (&'static str, fn(usize) -> Demand);

fn executor(criterion: &mut Criterion) {
    let cases: [Case; 4] = [
        ("run", |_| Demand::RUN),
        ("feed override 50 %", |_| Demand {
            feed_override: 0.5,
            ..Demand::RUN
        }),
        ("hold and resume", |i| {
            if i / 250 % 2 == 1 {
                Demand::HOLD
            } else {
                Demand::RUN
            }
        }),
        ("restless", restless),
    ];
    let mut executor = Box::new(Executor::new());
    for (jerk, jerk_name) in [(5_000.0, "jerk 5000"), (100_000.0, "jerk 100000")] {
        let cells = Cells::new(jerk);
        for (name, demand) in cases {
            let mut times = Vec::new();
            cells.run(&mut executor, 200_000, demand, |time| times.push(time));
            times.sort();
            let at = |part: f64| times[((times.len() - 1) as f64 * part) as usize];
            println!(
                "{name}, {jerk_name}: {} periods, 99 % {:?}, 99.9 % {:?}, worst {:?}",
                times.len(),
                at(0.99),
                at(0.999),
                at(1.0)
            );
            criterion.bench_function(&format!("cycle, {name}, {jerk_name}"), |bencher| {
                bencher.iter_custom(|iterations| {
                    let mut spent = Duration::ZERO;
                    let mut done = 0;
                    while done < iterations {
                        let left = (iterations - done) as usize;
                        cells.run(&mut executor, left, demand, |time| {
                            spent += time;
                            done += 1;
                        });
                    }
                    spent
                });
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
        .sample_size(20);
    targets = executor
}
criterion_main!(benches);
