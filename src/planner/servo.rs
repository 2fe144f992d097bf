//! The servo period: which move runs, what is reported, what is written.

use super::inputs::CycleInputs;
use super::planner::Planner;
use super::reference::{Ahead, Outlook, Reference, ReferencePoint};
use super::status::{Fault, Status};
use crate::axes::Axes;
use crate::cycle::{Demand, Step};
use crate::moves::{Move, SynchronisedOutputs};

/// At most so many servo periods of the reference are built in one cycle.
const CELLS_A_CYCLE: usize = 8;

/// At most so many moves are planned in one cycle.
const MOVES_A_CYCLE: usize = 16;

/// With fewer periods ahead an open reference might run out in the next cycle.
const LEAST_CELLS: usize = 3;

/// A scale this near to 1 is 1: the rest is rounding.
const SCALE_ROUNDING: f64 = 1e-9;

impl Planner {
    /// Runs one servo period. The result is in the status.
    pub fn cycle(&mut self, inputs: &CycleInputs) -> &Status {
        self.status.outputs = SynchronisedOutputs::NONE;
        if !self.running {
            self.start(inputs);
        }
        if self.running {
            self.build(inputs);
            self.run(inputs);
        }
        &self.status
    }

    /// At rest: starts the next move if there is one and nothing holds it.
    fn start(&mut self, inputs: &CycleInputs) {
        if self.status.aborting {
            self.end_abort();
        } else if self.queue.is_empty() {
            self.drop_moves();
        }
        self.report_rest();
        let Some(next) = self.queue.front() else {
            return;
        };
        self.status.waiting_for_spindle = next.wait_for_spindle && !inputs.spindles_at_speed;
        if self.status.waiting_for_spindle || self.demand(inputs).hold {
            return;
        }
        let serial = self.queue.first_serial();
        self.executor.reset();
        self.reference.restart(serial);
        self.running = true;
        self.closed = false;
        self.enter();
    }

    /// Hands the executor as much of the reference as it wants to see.
    fn build(&mut self, inputs: &CycleInputs) {
        let outlook = Outlook {
            queue: &self.queue,
            limits: &self.limits,
            map: &self.map,
            period: self.period,
            feed_scale: inputs.feed_scale,
            rapid_scale: inputs.rapid_scale,
            velocity_limit: self.velocity_limit,
            velocity_share: self.velocity_share(),
            single_move: inputs.stepping,
        };
        let mut budget = MOVES_A_CYCLE;
        let mut refused = false;
        for _ in 0..CELLS_A_CYCLE {
            if self.closed || self.executor.cells_ahead() >= self.executor.cells_wanted() {
                break;
            }
            let mut ahead = self.reference.next_cell(&outlook, &mut budget);
            // Moves so short that planning them cannot keep up: rest before nothing is left.
            if matches!(ahead, Ahead::Later) && self.executor.cells_ahead() < LEAST_CELLS {
                ahead = self.reference.end_here();
            }
            let (cell, end) = match ahead {
                Ahead::Later => break,
                Ahead::Cell(cell) => (Some(cell), None),
                Ahead::Last { cell, duration } => (Some(cell), Some(duration)),
                Ahead::End => (None, Some(self.period)),
            };
            if let Some(cell) = cell {
                refused |= self.executor.push(&cell).is_err();
            }
            if let Some(end) = end {
                refused |= self.executor.close(end).is_err();
                self.closed = true;
            }
        }
        if refused {
            self.fail(Fault::CellRefused);
        }
    }

    /// Runs the reference for one servo period and reports where that leads.
    fn run(&mut self, inputs: &CycleInputs) {
        let demand = self.demand(inputs);
        let step = self.executor.cycle(&demand);
        if step.starved {
            self.fail(Fault::Starved);
        }
        let Some(point) = self.reference.advance(&self.queue, step.advance) else {
            // Nothing was planned, so nothing was run: the machine is where it was.
            self.running = false;
            return;
        };
        if step.end_reached {
            self.finish();
        } else {
            self.leave_moves_before(point.serial);
            self.report_motion(&point, &step);
            if self.status.aborting && step.at_rest {
                self.end_abort();
            }
        }
    }

    /// What the executor is asked for.
    fn demand(&self, inputs: &CycleInputs) -> Demand {
        let running = self.queue.front();
        let scale = further_scale(inputs, running, &self.status);
        let slider = match running {
            Some(running) if running.shape.is_rotary() => {
                running.max_velocity * self.velocity_share()
            }
            _ => self.velocity_limit,
        };
        let held = inputs.net_feed_scale.is_nan() || inputs.net_feed_scale <= 0.0 || slider <= 0.0;
        // The executor knows of no factor for moves without override (M49); for those adaptive
        // feed is a limit of the velocity.
        let fixed = match running {
            Some(running) if scale < 1.0 && !running.override_enabled() => running.feed * scale,
            _ => f64::INFINITY,
        };
        Demand {
            hold: self.status.pausing || self.status.aborting || held,
            feed_override: inputs.feed_scale * scale,
            rapid_override: inputs.rapid_scale * scale,
            max_velocity: slider.min(fixed),
        }
    }

    /// The end of the reference is reached: at rest exactly where its last move ends.
    fn finish(&mut self) {
        let end = self.reference.end();
        if let Some(last) = self.queue.get(end.wrapping_sub(1)) {
            self.status.position = last.shape.end();
        }
        self.leave_moves_before(end.wrapping_sub(1));
        self.queue.pop();
        self.running = false;
        if self.status.aborting {
            self.end_abort();
        } else if self.queue.is_empty() {
            self.drop_moves();
        } else {
            self.report_rest();
        }
    }

    /// At rest after an abort: goes on from here with no moves and nothing synchronised.
    fn end_abort(&mut self) {
        self.drop_moves();
        self.spindle_synchronised = false;
    }

    /// Drops the moves that are behind the machine.
    fn leave_moves_before(&mut self, serial: u64) {
        while self.queue.first_serial() < serial && !self.queue.is_empty() {
            self.queue.pop();
            self.enter();
        }
    }

    /// The first move of the queue starts.
    fn enter(&mut self) {
        if let Some(started) = self.queue.front() {
            self.status.tag = started.tag;
            // An abort takes back what was to be written.
            if !self.status.aborting {
                self.status.outputs.merge(&started.outputs);
            }
        }
    }

    /// Reports the queue, and the move that runs or comes next.
    pub(super) fn report_queue(&mut self) {
        let status = &mut self.status;
        status.queue_depth = self.queue.len();
        status.queue_full = self.queue.is_full();
        let current = self.queue.front();
        status.exec_id = current.map_or(0, |queued| queued.id);
        status.motion_type = current.map(|queued| queued.motion_type);
        status.enables = current.map(|queued| queued.enables);
        status.requested_velocity = current.map_or(0.0, |queued| queued.feed);
    }

    /// Reports a machine at rest between moves.
    pub(super) fn report_rest(&mut self) {
        self.report_queue();
        let status = &mut self.status;
        let next = self.queue.front();
        status.active_depth = 0;
        status.done = next.is_none();
        status.current_velocity = 0.0;
        status.distance_to_go = next.map_or(0.0, |queued| queued.shape.length());
        status.axis_distance_to_go =
            next.map_or(Axes::zeros(), |queued| queued.shape.end() - status.position);
        status.waiting_for_spindle = false;
    }

    /// Reports a machine under way.
    fn report_motion(&mut self, point: &ReferencePoint, step: &Step) {
        self.report_queue();
        let status = &mut self.status;
        status.position = point.position;
        status.active_depth = 1;
        status.done = false;
        status.current_velocity = point.velocity * step.rate;
        if let Some(running) = self.queue.front() {
            status.distance_to_go = (running.shape.length() - point.distance).max(0.0);
            status.axis_distance_to_go = running.shape.end() - point.position;
        }
    }
}

/// What scales the running move besides the operator's override: adaptive feed, 0 to 1.
///
/// LinuxCNC hands over the product of all, made with the motion type and the enables that were
/// reported in the last cycle; the override is divided out again.
fn further_scale(inputs: &CycleInputs, running: Option<&Move>, reported: &Status) -> f64 {
    let Some(running) = running.filter(|_| reported.active_depth > 0) else {
        return 1.0;
    };
    let operator = match (running.override_enabled(), running.motion_type.is_rapid()) {
        (false, _) => 1.0,
        (true, true) => inputs.rapid_scale,
        (true, false) => inputs.feed_scale,
    };
    let further = inputs.net_feed_scale / operator;
    if (0.0..1.0 - SCALE_ROUNDING).contains(&further) {
        further
    } else {
        1.0
    }
}
