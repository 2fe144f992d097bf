//! The task controller's part: hands over the operations of the program, one after the other.

use super::drive::Drive;
use super::functions::add_move;
use super::machine::{Machine, point, pose, state_tag};
use super::progress::Step;
use super::recording::{Ending, Recorder};
use crate::canon::call::PathMode;
use crate::layer::program::{Move, Operation, Shape};
use crate::layer::spindle::SpindleCommand;
use framepath::abi::linuxcnc::tc_term_cond_t;
use std::ffi::c_int;
use std::io::{self, Write};

impl Drive<'_> {
    /// The task controller: hands over what may be handed over in this cycle.
    pub(super) fn task<W: Write>(&mut self, recorder: &mut Recorder<W>) -> io::Result<()> {
        let tp = self.machine.tp;
        let mut added = 0;
        if self.dwell_until.is_some_and(|until| self.time() >= until) {
            self.dwell_until = None;
        }
        while self.dwell_until.is_none() {
            let Some(operation) = self.job.operations.get(self.next_operation) else {
                break;
            };
            match *operation {
                Operation::Move(ref a_move) => {
                    // SAFETY: the queue in the structure of the machine.
                    let full = unsafe { (self.tp.tcqFull)(&raw const (*tp).queue) != 0 };
                    // SAFETY: the structure of the machine.
                    let queued = unsafe { (self.tp.tpQueueDepth)(tp) };
                    let full = full || usize::try_from(queued).unwrap_or(0) >= self.job.queue;
                    if added >= self.job.adds_per_cycle || full {
                        break;
                    }
                    added += 1;
                    let (result, duration) = self.add(a_move);
                    recorder.add(duration)?;
                    if result < 0 {
                        let line = a_move.line;
                        self.refused = Some(Ending::Refused { line, code: result });
                        break;
                    }
                    // A tap comes back to where it began.
                    if !matches!(a_move.shape, Shape::Tap) {
                        self.goal = (a_move.end, a_move.line);
                    }
                }
                Operation::WaitForMotion => {
                    if !self.motion_done() {
                        break;
                    }
                }
                // Without an INI file tools have no length.
                Operation::ToolLength(_) => {}
                Operation::Dwell(seconds) => self.dwell_until = Some(self.time() + seconds),
                Operation::Termination(mode, tolerance) => {
                    let condition = match mode {
                        PathMode::ExactStop => tc_term_cond_t::TC_TERM_COND_STOP,
                        PathMode::ExactPath => tc_term_cond_t::TC_TERM_COND_EXACT,
                        PathMode::Continuous => tc_term_cond_t::TC_TERM_COND_PARABOLIC,
                    };
                    // SAFETY: the structure of the machine.
                    self.call(Step::Other, |f| unsafe {
                        (f.tpSetTermCond)(tp, condition as c_int, tolerance)
                    });
                }
                Operation::Synchronise {
                    per_revolution,
                    velocity_mode,
                } => {
                    // SAFETY: the structure of the machine.
                    self.call(Step::Other, |f| unsafe {
                        (f.tpSetSpindleSync)(tp, 0, per_revolution, c_int::from(velocity_mode))
                    });
                }
                Operation::Spindle(command) => self.switch_spindle(command),
            }
            self.next_operation += 1;
        }
        Ok(())
    }

    fn add(&self, a_move: &Move) -> (c_int, u32) {
        let Machine { tp, status, .. } = self.machine;
        let end = pose(&a_move.end);
        let tag = state_tag(&a_move.tag, a_move.line);
        let id = c_int::try_from(a_move.index + 1).unwrap_or(c_int::MAX);
        let kind = a_move.motion_type as c_int;
        let (feed, most, acceleration) = (
            a_move.velocity,
            a_move.greatest_velocity,
            a_move.acceleration,
        );
        let at_speed = i8::from(a_move.at_speed) as _;
        // SAFETY: the structures of the machine.
        let enables = unsafe { (*status).enables_new };
        self.call(Step::Adding, |f| {
            // SAFETY: as motmod adds moves, with the structures of the machine.
            unsafe {
                (f.tpSetId)(tp, id);
                match a_move.shape {
                    Shape::Line => add_move!(
                        (f.tpAddLine),
                        [tp, end, kind],
                        [feed, most, acceleration],
                        [enables, at_speed, -1, tag]
                    ),
                    Shape::Arc {
                        centre,
                        normal,
                        turn,
                    } => add_move!(
                        (f.tpAddCircle),
                        [tp, end, point(&centre), point(&normal), turn, kind],
                        [feed, most, acceleration],
                        [enables, at_speed, tag]
                    ),
                    Shape::Tap => add_move!(
                        (f.tpAddRigidTap),
                        [tp, end],
                        [feed, most, acceleration],
                        [enables, 1.0, tag]
                    ),
                }
            }
        })
    }

    fn switch_spindle(&mut self, command: SpindleCommand) {
        let speed = command.speed;
        self.surface = command.surface;
        // SAFETY: the structures of the machine.
        let spindle = unsafe { &mut (*self.machine.status).spindle_status[0] };
        spindle.speed = speed;
        spindle.direction = if speed == 0.0 {
            0
        } else {
            speed.signum() as c_int
        };
        spindle.state = c_int::from(speed != 0.0);
    }
}
