//! The planner's state, its settings and commands.

use nalgebra::Matrix3;

use super::blending::{Blending, BlendingError};
use super::error_stop::ErrorStop;
use super::indexer::Indexer;
use super::machine_axes::MachineAxes;
use super::motion_state::MotionState;
use super::next_move::NextMove;
use super::range::RangeCheck;
use super::reference::Reference;
use super::request::{AddError, Added, LEAST_VELOCITY, MoveRequest};
use super::speed_limit::AxisMotion;
use super::spindle::SpindleFollower;
use super::status::{Fault, ORIGIN, Status};
use super::survey::SurveyState;
use super::velocity_slider::VelocitySlider;
use crate::axes::{Axes, AxisLimits};
use crate::cycle::Executor;
use crate::machine_map::JointMap;
use crate::moves::shape::{Arc9, Circle, Line9, Shape, ShapeError};
use crate::moves::{
    FeedWord, Move, MoveQueue, NearLimit, QueueFull, StateTag, SynchronisationMode,
    TerminationCondition,
};

/// A position with a coordinate that is infinite or not a number was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PositionError;

/// The trajectory planner. About 18 MB, without a heap: it belongs in a static.
#[derive(Debug)]
pub struct Planner {
    pub(super) queue: MoveQueue,
    pub(super) reference: Reference,
    pub(super) executor: Executor,
    pub(super) motion: MotionState,
    /// Why the motion was stopped, if it was: no move is taken before an abort.
    error_stop: Option<ErrorStop>,
    pub(super) status: Status,
    /// What the axes may do, and how they lie to those of the program.
    pub(super) axes: MachineAxes,
    /// Duration of a cycle, seconds; 0 before it is known.
    pub(super) period: f64,
    pub(super) slider: VelocitySlider,
    pub(super) blending: Blending,
    next_move: NextMove,
    pub(super) spindle: SpindleFollower,
    pub(super) indexer: Indexer,
    /// Whether the joints stay within their soft limits.
    pub(super) range_check: RangeCheck,
    /// Where the last queued move ends.
    pub(super) goal: Axes,
    /// How the axes of the machine move, for those who look at it.
    pub(super) axis_motion: AxisMotion,
    pub(super) survey: SurveyState,
}

impl Planner {
    /// A planner without limits or period, at the origin, with nothing to do.
    pub const fn new() -> Self {
        Self {
            queue: MoveQueue::new(),
            reference: Reference::new(),
            executor: Executor::new(),
            motion: MotionState::Standing,
            error_stop: None,
            status: Status::IDLE,
            axes: MachineAxes::UNLIMITED,
            period: 0.0,
            slider: VelocitySlider::UNLIMITED,
            blending: Blending::DEFAULT,
            next_move: NextMove::FIRST,
            spindle: SpindleFollower::NEW,
            indexer: Indexer::Locked,
            range_check: RangeCheck::OFF,
            goal: ORIGIN,
            axis_motion: AxisMotion::NONE,
            survey: SurveyState::NONE,
        }
    }

    /// Sets the duration of a cycle in seconds. `false`, and nothing changes, if it is not
    /// positive and finite or a move runs.
    pub fn set_cycle_time(&mut self, seconds: f64) -> bool {
        let standing = !self.motion.is_running();
        let limits = self.axes.limits_behind();
        let accepted = standing && self.executor.configure(limits, seconds).is_ok();
        if accepted {
            self.period = seconds;
        }
        accepted
    }

    /// Duration of a cycle, seconds; 0 before it is known.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Sets what the axes are able to do, from the next rest on: a motion that runs, and a stop of
    /// it, keep the limits that it began with. LinuxCNC may change limits at any time, so it is
    /// cheap to call this in each cycle.
    ///
    /// An axis one of whose limits is next to zero, negative or not a number keeps the limits it had,
    /// and new moves of it are refused.
    pub fn set_limits(&mut self, limits: &AxisLimits) {
        self.axes.set_next_limits(limits);
        if !self.reference.is_active() {
            self.take_limits();
        }
    }

    /// Sets what the joints are able to do and how they follow the program, `None` for no limits of joints: from the next
    /// rest on, as [`Self::set_limits`]. The axes keep their velocities; acceleration and jerk are those of the joints
    /// then. `false`, and nothing changes, if a limit is next to zero, negative or not a number.
    pub fn set_joints(&mut self, joints: Option<JointMap>) -> bool {
        let accepted = self.axes.set_next_joints(joints);
        if !self.reference.is_active() {
            self.take_limits();
        }
        accepted
    }

    /// At rest: what axes and joints are able to do now is what they may do.
    pub(super) fn take_limits(&mut self) {
        if !self.axes.limits_changed() {
            return;
        }
        self.axes.take_limits();
        if self.period > 0.0 && self.executor.set_limits(self.axes.limits_behind()).is_err() {
            self.fail(Fault::LimitsRefused);
        }
    }

    /// Sets how X Y Z of the program lie to those of the machine, shape (3, 3): the limits hold for
    /// the machine. `false`, and nothing changes, if it is not one of [`MachineMap`](crate::machine_map::MachineMap), or while anything
    /// is queued: a frame changes only at standstill.
    pub fn set_machine_map(&mut self, linear: &Matrix3<f64>) -> bool {
        self.status.done && self.axes.set_map(linear)
    }

    /// Sets what no move may exceed along its path, machine units per second, from the operator's
    /// slider. 0 holds the machine; what is negative or not a number counts as 0. A move of rotary
    /// axes only is slowed in proportion: to the same share of its greatest velocity as the limit
    /// is of the greatest limit that was ever set, or of what the linear axes reach together where that is less.
    pub fn set_velocity_limit(&mut self, velocity: f64) {
        self.slider.set(velocity);
    }

    /// Sets how far paths may leave the program where it does not say, see [`Blending`]. Holds from
    /// the next rest on.
    ///
    /// # Errors
    /// See [`BlendingError`]; nothing changes then.
    pub fn set_blending(
        &mut self,
        millimetre: f64,
        rotary_tolerance: f64,
        default_tolerance: f64,
    ) -> Result<(), BlendingError> {
        self.blending
            .set(millimetre, rotary_tolerance, default_tolerance)
    }

    /// Sets which axis tilts the tool while C turns it and the coordinates of the program are those of its tip: 3 for A, 4
    /// for B, `None` where the machine does not tell. The tolerance of rotary axes is then one of the tool axis. Holds
    /// from the next rest on.
    pub fn set_tilt_axis(&mut self, tilt: Option<usize>) {
        self.blending.set_tilt(tilt);
    }

    /// Chooses whether corners are rounded on their inner side only, and none swings out. Holds from the next rest on.
    pub fn set_corners_inside(&mut self, inside: bool) {
        self.blending.set_corners_inside(inside);
    }

    /// Sets how the moves to come meet the next one.
    pub fn set_termination(&mut self, termination: TerminationCondition) {
        self.next_move.termination = termination;
    }

    /// How the moves to come meet the next one.
    pub fn termination(&self) -> TerminationCondition {
        self.next_move.termination
    }

    /// Sets LinuxCNC's number for the next move; each further move gets the next number.
    pub fn set_id(&mut self, id: i32) {
        self.next_move.id = id;
    }

    /// Says which F the program has the next move with: arcs that are handed over with less than other moves of the same F are as
    /// fast as those where the axes allow it.
    pub fn set_feed_word(&mut self, word: Option<FeedWord>) {
        self.next_move.feed_word = word;
    }

    /// Gives the next move a digital output to write at its start (M62, M63). `false` if there is
    /// no output of this number.
    pub fn set_digital_output(&mut self, index: usize, value: bool) -> bool {
        self.next_move.outputs.set_digital(index, value)
    }

    /// Gives the next move an analog output to write at its start (M67). `false` if there is no
    /// output of this number or the value is not finite.
    pub fn set_analog_output(&mut self, index: usize, value: f64) -> bool {
        self.next_move.outputs.set_analog(index, value)
    }

    /// Drops the outputs given for the next move.
    pub fn clear_outputs(&mut self) {
        self.next_move.clear_outputs();
    }

    /// Queues a line to `end`, shape (9).
    ///
    /// # Errors
    /// See [`AddError`]; nothing changes then.
    pub fn add_line(&mut self, end: &Axes, request: &MoveRequest) -> Result<Added, AddError> {
        let mode = self.spindle.mode_of_next(self.queue.is_empty());
        self.add(self.line_to(end), mode, request)
    }

    /// Queues an arc, helix or spiral to `end`, shape (9).
    ///
    /// # Errors
    /// See [`AddError`]; nothing changes then.
    pub fn add_circle(
        &mut self,
        end: &Axes,
        circle: &Circle,
        request: &MoveRequest,
    ) -> Result<Added, AddError> {
        let mode = self.spindle.mode_of_next(self.queue.is_empty());
        self.add(self.arc_to(end, circle), mode, request)
    }

    /// The line that [`Self::add_line`] would queue, to be looked at.
    ///
    /// # Errors
    /// See [`ShapeError`].
    pub fn line_to(&self, end: &Axes) -> Result<Shape, ShapeError> {
        Line9::new(&self.goal, end).map(Shape::Line)
    }

    /// The arc that [`Self::add_circle`] would queue, to be looked at.
    ///
    /// # Errors
    /// See [`ShapeError`].
    pub fn arc_to(&self, end: &Axes, circle: &Circle) -> Result<Shape, ShapeError> {
        Arc9::new(&self.goal, end, circle).map(Shape::Arc)
    }

    pub(super) fn add(
        &mut self,
        shape: Result<Shape, ShapeError>,
        mode: SynchronisationMode,
        request: &MoveRequest,
    ) -> Result<Added, AddError> {
        if self.error_stop.is_some() {
            return Err(AddError::Tripped);
        }
        if self.status.aborting {
            return Err(AddError::Aborting);
        }
        if self.period == 0.0 {
            return Err(AddError::NotConfigured);
        }
        // First of all: LinuxCNC sends moves that go nowhere without a feed.
        let shape = match shape {
            Ok(shape) => shape,
            Err(ShapeError::ZeroLength) => return Ok(Added::ZeroLength),
            Err(error) => return Err(AddError::Shape(error)),
        };
        let synchronisation = self.spindle.synchronisation_in(mode)?;
        if synchronisation.is_some_and(|with| with.follows_angle()) && self.axes.stretches(&shape) {
            return Err(AddError::ScaledPitch);
        }
        let [feed, max_velocity] = match synchronisation {
            Some(with) => {
                let greatest = request.max_velocity;
                [self.spindle.planned_feed(&with, greatest), greatest]
            }
            None => self.next_move.feeds(&shape, request, self.status.done),
        };
        let usable = |velocity: f64| velocity >= LEAST_VELOCITY && velocity.is_finite();
        if !(usable(feed) && usable(max_velocity)) {
            return Err(AddError::Feed { feed, max_velocity });
        }
        if let Some(axis) = self.axes.unusable_axis(&shape) {
            return Err(AddError::AxisLimits { axis });
        }
        let Some(axis_jerk) = self.axes.move_jerk(&shape, request.path_jerk, self.period) else {
            return Err(AddError::PathJerk(request.path_jerk));
        };
        self.take(Move {
            id: self.next_move.id,
            tag: request.tag,
            motion_type: request.motion_type,
            shape,
            feed,
            feed_word: self.next_move.feed_word,
            max_velocity,
            axis_jerk,
            enables: request.enables,
            wait_for_spindle: request.wait_for_spindle,
            synchronisation,
            indexer_joint: request.indexer_joint,
            termination: self.next_move.termination,
            near_limit: NearLimit::NONE,
            outputs: self.next_move.outputs,
        })
    }

    /// Puts a move that may be run into the queue.
    fn take(&mut self, queued: Move) -> Result<Added, AddError> {
        self.queue
            .push(queued)
            .map_err(|QueueFull| AddError::QueueFull)?;
        if !self.range_check.is_on() {
            self.queue.release_all();
        }
        let serial = self.queue.first_serial() + self.queue.len() as u64 - 1;
        self.spindle.take_note_of(&queued, serial);
        self.next_move.pass_on();
        self.goal = queued.shape.end();
        self.status.done = false;
        self.report_queue();
        Ok(Added::Queued)
    }

    /// The state after the last cycle or command.
    pub fn status(&self) -> &Status {
        &self.status
    }

    /// Brings the machine to rest on its path and holds it there. Forgotten, as with LinuxCNC's
    /// planner, when there is nothing to hold.
    pub fn pause(&mut self) {
        self.status.pausing = true;
    }

    /// Ends a pause. Does nothing while an abort brings the machine to rest.
    pub fn resume(&mut self) {
        self.status.pausing = self.status.aborting;
    }

    /// Brings the machine to rest on its path, drops all moves, and goes on from where it came to
    /// rest. Moves are refused until then.
    pub fn abort(&mut self) {
        self.forget_error();
        self.stop();
    }

    /// The same where it is the motion controller that gives up a motion, not the operator or the
    /// program: where an error has stopped the motion, moves are still refused.
    pub fn stop(&mut self) {
        self.clear_outputs();
        self.status.aborting = true;
        self.status.pausing = true;
    }

    /// Stops for an error: what follows in the program must not run. No move is taken before the
    /// operator, or task for him, has aborted.
    pub(super) fn stop_for_error(&mut self, error: ErrorStop) {
        self.stop();
        let error = error.after(self.error_stop);
        self.error_stop = Some(error);
        self.status.fault = error.fault();
    }

    /// Whether an error has stopped the motion, and nothing has been aborted since.
    pub fn is_stopped_for_error(&self) -> bool {
        self.error_stop.is_some()
    }

    fn forget_error(&mut self) {
        self.error_stop = None;
        self.status.fault = None;
    }

    /// Drops everything and starts from `position`, shape (9). For changes of mode and of
    /// kinematics, when nothing moves.
    ///
    /// # Errors
    /// [`PositionError`]; nothing changes then.
    pub fn set_position(&mut self, position: &Axes) -> Result<(), PositionError> {
        if !position.iter().all(|coordinate| coordinate.is_finite()) {
            return Err(PositionError);
        }
        self.status.position = *position;
        self.forget_error();
        self.drop_moves();
        Ok(())
    }

    /// Drops all moves and all state but the position, the settings and the termination
    /// condition. For the end of a program, when nothing moves.
    pub fn clear(&mut self) {
        self.drop_moves();
        self.spindle.set_command(None);
        self.forget_error();
        self.next_move.id = 0;
        self.status.tag = StateTag::EMPTY;
        self.clear_outputs();
    }

    /// Stays where the machine is, with nothing to do.
    pub(super) fn drop_moves(&mut self) {
        self.queue.clear();
        self.executor.reset();
        self.reference.clear();
        self.motion.stand();
        self.status.backwards = false;
        self.spindle.drop_moves();
        self.indexer.give_up();
        self.goal = self.status.position;
        self.status.pausing = false;
        self.status.aborting = false;
        self.report_rest();
    }

    /// Stops for a fault of the planner itself.
    pub(super) fn fail(&mut self, fault: Fault) {
        self.stop_for_error(ErrorStop::Fault(fault));
    }

    /// Has the planner fail, as if it had broken its own rules in the next cycle: only in builds
    /// for tests.
    #[cfg(feature = "fault-injection")]
    pub fn inject(&mut self, fault: Fault) {
        self.fail(fault);
    }

    /// The joint of the locking indexer that is unlocked or being locked, or that the next move waits for.
    pub fn indexer_joint(&self) -> Option<i32> {
        let next = || self.queue.front().and_then(|queued| queued.indexer_joint);
        self.indexer.joint().or_else(next)
    }

    /// Where the last queued move ends, shape (9): the start of the next one.
    pub fn goal(&self) -> &Axes {
        &self.goal
    }
}

impl Default for Planner {
    fn default() -> Self {
        Self::new()
    }
}
