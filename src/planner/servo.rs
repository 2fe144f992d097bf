//! The servo period: which move runs, what is reported, what is written.

use super::inputs::CycleInputs;
use super::motion_state::{HandedOut, Pace};
use super::planner::Planner;
use super::reference::{Ahead, Conditions, Outlook, ReferencePoint};
use super::spindle::SpindleError;
use super::status::{Fault, Status};
use crate::axes::Axes;
use crate::cycle::{Demand, ExecutorStep};
use crate::moves::shape::measure::LEAST_DISTANCE;
use crate::moves::{Move, SynchronisedOutputs};

/// At most so many servo periods of the reference are built in one cycle.
const CELLS_A_CYCLE: usize = 8;

/// At most so many pieces of the plan are taken in one cycle.
const PIECES_A_CYCLE: usize = 16;

/// With fewer periods ahead an open reference might run out in the next cycle.
const LEAST_CELLS: usize = 3;

/// A scale this near to 1 is 1: the rest is rounding.
const SCALE_ROUNDING: f64 = 1e-9;

impl Planner {
    /// Runs one servo period. The result is in the status.
    pub fn cycle(&mut self, inputs: &CycleInputs) -> &Status {
        self.status.outputs = SynchronisedOutputs::NONE;
        self.status.indexer = None;
        self.track_spindles(inputs);
        self.turn_to_steps(inputs);
        if !self.motion.is_running() {
            self.stand(inputs);
        }
        self.plan(inputs);
        if self.motion.is_running() {
            self.run(inputs);
        }
        &self.status
    }

    /// At rest: makes sure that there is a reference if there is anything to do.
    fn stand(&mut self, inputs: &CycleInputs) {
        if self.status.aborting {
            self.end_abort();
        } else if !self.is_locked(inputs) {
            return;
        } else if self.queue.is_empty() {
            self.drop_moves();
        }
        self.report_rest();
        let backwards = self.reference.is_backwards();
        let at_hand = self.move_at_hand();
        let begins_thread = at_hand.is_some_and(|next| self.spindle.begins_thread(&next));
        let Some(next) = self.queue.front() else {
            return;
        };
        self.status.waiting_for_spindle =
            !backwards && (next.wait_for_spindle || begins_thread) && !inputs.spindles_at_speed;
        // The path may have left the program, and rest beside the place where its next move begins.
        let beside = (next.shape.position(0.0) - self.status.position).amax() > LEAST_DISTANCE;
        let begun = beside || self.queue.has_begun();
        if !backwards {
            self.axes.set_move_jerk(next.axis_jerk);
        }
        let stale = self.settings_changed() || inputs.stepping != self.reference.is_single();
        if self.queue.released(self.queue.first_serial()).is_none() {
            return;
        }
        // What is in force is that of a move which waits for more moves, as with LinuxCNC's planner: it starts such a move at
        // once, but not one that waits for a spindle or an indexer.
        if !(backwards || self.status.waiting_for_spindle || next.indexer_joint.is_some()) {
            self.status.tag = next.tag;
        }
        // In the middle of a move there is only the path that led here.
        if !self.reference.is_active() || stale && !begun && !backwards {
            self.take_limits();
            let first = self.queue.first_serial();
            let Some(settings) = self.blending.settings(&self.queue, self.axes.limits()) else {
                self.fail(Fault::SettingsRefused);
                return;
            };
            let position = self.status.position;
            let kind = (inputs.stepping, self.axes.map().joints().is_some());
            self.reference.restart(first, kind, &position, &settings);
        }
    }

    /// At rest: starts if there is a plan and nothing holds the machine.
    fn start(&mut self, inputs: &CycleInputs) {
        let held = if self.spindle.is_tapping() {
            self.status.aborting
        } else {
            self.status.waiting_for_spindle || self.is_held(inputs)
        };
        if held || self.queue.is_empty() || !self.reference.is_ready() {
            return;
        }
        // On the way back it is not the next move that starts, but one that has been run.
        let backwards = self.reference.is_backwards();
        let permitted =
            backwards || self.indexer_permits_start(inputs) && self.spindle_permits_start();
        if !permitted {
            return;
        }
        self.executor.reset();
        self.motion.start();
        if !backwards {
            self.enter();
        }
    }

    /// Plans on, starts where that is possible, and hands over what the executor wants to see.
    fn plan(&mut self, inputs: &CycleInputs) {
        let outlook = Outlook {
            queue: &self.queue,
            limits: self.axes.limits(),
            map: self.axes.map(),
            now: self.conditions(inputs),
        };
        let fault = match self.reference.work(&outlook) {
            Err(_) => Some(Fault::MoveRefused),
            Ok(()) => self.reference.is_refused().then_some(Fault::NoPlan),
        };
        // A machine in motion comes to rest on what is planned.
        if let Some(fault) = fault
            && !self.status.aborting
        {
            self.fail(fault);
        }
        if !self.motion.is_running() {
            self.start(inputs);
        }
        if self.motion.is_running() {
            if !self.build(inputs) {
                self.reference.take_back();
                self.brake_for(Fault::CellRefused, inputs);
            }
            if self.executor.is_dry() {
                self.brake_for(Fault::Starved, inputs);
            }
        }
    }

    /// Goes on straight along the path, since nothing else is left, and comes to rest there.
    fn brake_for(&mut self, fault: Fault, inputs: &CycleInputs) {
        let outlook = Outlook {
            queue: &self.queue,
            limits: self.axes.limits(),
            map: self.axes.map(),
            now: self.conditions(inputs),
        };
        if self.reference.coast(&outlook) {
            self.fail(fault);
            // What follows a missing period would be a jump.
            let handed_out = if self.build(inputs) {
                HandedOut::Partly
            } else {
                HandedOut::ToTheEnd
            };
            self.motion.hand_out(handed_out);
        } else if fault == Fault::CellRefused {
            self.fail(fault);
            self.motion.hand_out(HandedOut::ToTheEnd);
        }
    }

    /// What holds in this servo period.
    fn conditions(&self, inputs: &CycleInputs) -> Conditions {
        Conditions {
            period: self.period,
            feed_scale: inputs.feed_scale,
            rapid_scale: inputs.rapid_scale,
            spindle_speeds: self.spindle.speeds(),
            velocity_limit: self.slider.limit(),
            velocity_share: self.slider.share(self.axes.reach()),
            greatest_tolerance: self.blending.greatest_tolerance(),
            stepping: inputs.stepping,
            settings_changed: self.settings_changed(),
            held: !self.motion.is_moving()
                && (self.status.waiting_for_spindle || self.is_held(inputs)),
        }
    }

    /// Whether limits or tolerances are others than when the motion began.
    fn settings_changed(&self) -> bool {
        self.axes.limits_changed() || self.blending.has_changed()
    }

    /// Hands the executor as much of the reference as it wants to see. `false` if it refused some.
    fn build(&mut self, inputs: &CycleInputs) -> bool {
        let outlook = Outlook {
            queue: &self.queue,
            limits: self.axes.limits(),
            map: self.axes.map(),
            now: self.conditions(inputs),
        };
        let mut budget = PIECES_A_CYCLE;
        // A machine that is to stop does not wait for a better plan.
        let needed = self.executor.cells_needed();
        let mut refused = false;
        for _ in 0..CELLS_A_CYCLE {
            let ahead = self.executor.cells_ahead();
            if !self.motion.takes_more() || refused || ahead >= self.executor.cells_wanted() {
                break;
            }
            // What the executor cannot do without takes as many pieces as it takes: beside a rest they may
            // be many times shorter than a period.
            let mut whole_ring = usize::MAX;
            let budget = if ahead < LEAST_CELLS {
                &mut whole_ring
            } else {
                &mut budget
            };
            let mut next = self.reference.next_cell(&outlook, needed, budget);
            // How it goes on is not known in time: the machine rests until it is.
            if matches!(next, Ahead::Later) && self.reference.is_resting() && ahead < LEAST_CELLS {
                next = self.reference.end_here();
            }
            let (cell, end) = match next {
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
                self.motion.hand_out(HandedOut::ToTheEnd);
            }
        }
        !refused
    }

    /// Runs the reference for one servo period and reports where that leads.
    fn run(&mut self, inputs: &CycleInputs) {
        self.watch_spindle();
        let demand = self.demand(inputs);
        self.status.following_spindle = demand.follow.is_some();
        let step = self.executor.cycle(&demand);
        self.motion.set_pace(if step.at_rest {
            Pace::StandingStill
        } else {
            Pace::Moving
        });
        if step.starved {
            self.fail(Fault::Starved);
        }
        let Some(point) = self.reference.advance(&self.queue, step.advance) else {
            // Nothing was planned, so nothing was run: the machine is where it was.
            self.motion.stand();
            return;
        };
        if step.end_reached {
            self.finish();
        } else {
            self.pass_to(point.serial);
            self.report_motion(&point, &step);
            if self.status.aborting {
                if step.at_rest {
                    self.end_abort();
                }
            } else {
                self.advance_tap(&step);
            }
        }
    }

    /// What the executor is asked for.
    fn demand(&self, inputs: &CycleInputs) -> Demand {
        let running = self.queue.front();
        let scale = further_scale(inputs, running, &self.status);
        let overridden = running.is_none_or(|running| running.override_enabled());
        let slider = self.slider_for(running);
        let follow = self
            .move_at_hand()
            .and_then(|running| self.spindle.follow(&running, &self.status));
        // In a thread nothing but an abort may part the machine from the spindle.
        let hold = if follow.is_some() {
            self.status.aborting
        } else {
            self.is_held(inputs)
        };
        let spindle = self.feed_spindle();
        // The executor knows of no factor for moves without override (M49); for those adaptive
        // feed is a limit of the velocity.
        let fixed = match running {
            Some(running) if scale < 1.0 && !overridden && running.synchronisation.is_none() => {
                running.feed * scale
            }
            _ => f64::INFINITY,
        };
        Demand {
            hold,
            feed_override: inputs.feed_scale * scale,
            rapid_override: inputs.rapid_scale * scale,
            turns: self.spindle.feed_turns(spindle) * if overridden { 1.0 } else { scale },
            max_velocity: slider.min(fixed),
            follow,
        }
    }

    /// Whether the next move may start: a locking indexer has to be unlocked for it.
    fn indexer_permits_start(&mut self, inputs: &CycleInputs) -> bool {
        let Some(joint) = self.queue.front().and_then(|next| next.indexer_joint) else {
            return true;
        };
        self.status.indexer = Some((joint, true));
        // What was asked for in this cycle is answered in a later one.
        self.indexer.unlock(joint) && inputs.indexer_unlocked
    }

    /// The end of the reference is reached: at rest, exactly where its last move ends, or in the
    /// middle of one whose continuation was not planned in time.
    pub(super) fn finish(&mut self) {
        let rest = self.reference.come_to_rest(&self.queue);
        self.status.position = rest.position;
        // The turns are over that the spindle may take to turn back.
        if self.spindle.has_tap() && !self.status.aborting {
            self.stop_for_spindle(SpindleError::NotReversed);
        }
        self.motion.stand();
        if self.reference.is_backwards() {
            self.pass_to(rest.next);
            if self.status.aborting {
                self.end_abort();
            } else {
                self.report_rest();
            }
            return;
        }
        self.leave_moves_before(rest.next.saturating_sub(1));
        if self.queue.first_serial() < rest.next {
            let turned = self.queue.front().and_then(|ended| ended.indexer_joint);
            if let Some(joint) = turned {
                self.indexer.lock(joint);
            }
            if turned.is_none() || self.status.aborting {
                self.queue.pop();
            }
        }
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
        self.spindle.set_command(None);
        // At once: another mode may be chosen before the next cycle.
        self.tell_to_lock();
    }

    /// Tells what is to lock.
    fn tell_to_lock(&mut self) {
        if let Some(locking) = self.indexer.locking() {
            self.status.indexer = Some((locking.joint, false));
        }
    }

    /// At rest: whether no indexer is being locked. Where one has locked behind its move, that is over.
    fn is_locked(&mut self, inputs: &CycleInputs) -> bool {
        let Some(locking) = self.indexer.locking() else {
            return true;
        };
        self.tell_to_lock();
        if inputs.indexer_unlocked {
            return false;
        }
        self.indexer.has_locked();
        if locking.ends_move {
            self.queue.pop();
        }
        true
    }

    /// The machine is on the move with this serial number, ahead of the last one or, on the way
    /// back, before it.
    fn pass_to(&mut self, serial: u64) {
        if serial < self.queue.first_serial() {
            self.queue.return_to(serial);
            if let Some(running) = self.queue.front() {
                self.status.tag = running.tag;
            }
        } else {
            self.leave_moves_before(serial);
        }
    }

    /// Drops the moves that are behind the machine.
    fn leave_moves_before(&mut self, serial: u64) {
        while self.queue.first_serial() < serial && !self.queue.is_empty() {
            self.queue.pop();
            self.enter();
        }
    }

    /// The first move of the queue starts, or goes on: its outputs are written once.
    fn enter(&mut self) {
        if let Some((started, first_time)) = self.queue.begin_front() {
            self.status.tag = started.tag;
            // An abort takes back what was to be written.
            if first_time && !self.status.aborting {
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
        status.requested_velocity = current.map_or(0.0, |queued| self.spindle.feed(queued));
    }

    /// Reports a machine at rest between moves.
    pub(super) fn report_rest(&mut self) {
        self.report_queue();
        let status = &mut self.status;
        let next = self.queue.front();
        status.active_depth = 0;
        status.done = next.is_none();
        status.current_velocity = 0.0;
        status.distance_to_go = self
            .reference
            .distance_to_go_at_rest(&self.queue)
            .or_else(|| next.map(|queued| queued.shape.length()))
            .unwrap_or(0.0);
        status.axis_distance_to_go =
            next.map_or(Axes::zeros(), |queued| queued.shape.end() - status.position);
        status.waiting_for_spindle = false;
        status.waiting_for_index = false;
        status.following_spindle = false;
    }

    /// Reports a machine under way.
    fn report_motion(&mut self, point: &ReferencePoint, step: &ExecutorStep) {
        self.report_queue();
        let status = &mut self.status;
        status.position = point.position;
        status.active_depth = 1;
        status.done = false;
        status.current_velocity = point.velocity * step.rate;
        if let Some(running) = self.queue.front() {
            let shape = &running.shape;
            let (distance, end) = if status.backwards {
                let back = shape.length() - point.distance_to_go;
                (back, shape.position(0.0))
            } else {
                (point.distance_to_go, shape.end())
            };
            status.distance_to_go = distance.max(0.0);
            status.axis_distance_to_go = end - point.position;
        }
    }
}

/// What scales the running move besides the operator's override: adaptive feed, 0 to 1.
///
/// LinuxCNC hands over the product of all, made with the motion type and the enables that were
/// reported in the last cycle; the override is divided out again.
pub(super) fn further_scale(
    inputs: &CycleInputs,
    running: Option<&Move>,
    reported: &Status,
) -> f64 {
    let Some(running) = running.filter(|_| reported.active_depth > 0) else {
        return 1.0;
    };
    let operator = running.override_of(inputs.feed_scale, inputs.rapid_scale);
    let further = inputs.net_feed_scale / operator;
    if (0.0..1.0 - SCALE_ROUNDING).contains(&further) {
        further
    } else {
        1.0
    }
}
