//! Feeds a reference to the executor as the planner does, and keeps its own reference time.

use super::reference::Reference;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::{Demand, Executor, ExecutorStep};

/// A machine that runs one reference.
pub struct Player<'a> {
    pub reference: &'a Reference,
    pub executor: Box<Executor>,
    pub period: f64,
    /// Reference time by the sum of all advances.
    pub time: f64,
    pushed: usize,
    closed: bool,
    /// Periods in which the executor wanted more cells than it had.
    pub walls: usize,
}

impl<'a> Player<'a> {
    pub fn new(reference: &'a Reference, limits: &AxisLimits, period: f64) -> Self {
        let mut executor = Box::new(Executor::new());
        executor.configure(limits, period).unwrap();
        Self {
            reference,
            executor,
            period,
            time: 0.0,
            pushed: 0,
            closed: false,
            walls: 0,
        }
    }

    /// One servo period; the position behind it.
    pub fn cycle(&mut self, demand: &Demand) -> (ExecutorStep, Axes) {
        for _ in 0..8 {
            if self.closed || self.executor.cells_ahead() >= self.executor.cells_wanted() {
                break;
            }
            let start = self.pushed as f64 * self.period;
            self.executor
                .push(&self.reference.cell(start, self.period))
                .unwrap();
            self.pushed += 1;
            let rest = self.reference.duration() - start;
            if rest <= self.period {
                self.executor.close(rest).unwrap();
                self.closed = true;
            }
        }
        let step = self.executor.cycle(demand);
        self.walls += usize::from(step.wall);
        assert!(!step.starved, "starved at {}", self.time);
        assert!(
            (0.0..=self.period * (1.0 + 1e-9)).contains(&step.advance),
            "advance {}",
            step.advance
        );
        assert!((0.0..=1.0).contains(&step.rate), "rate {}", step.rate);
        assert!(step.rate_acceleration.is_finite());
        self.time += step.advance;
        let position = if step.end_reached {
            self.reference.at(self.reference.duration())[0]
        } else {
            self.reference.at(self.time)[0]
        };
        (step, position)
    }
}
