//! Drives a planner module through a program, servo cycle by servo cycle, in the place of task
//! controller and motion controller; faster than real time.

use super::functions::{Functions, load};
use super::job::Job;
use super::kinematics;
use super::machine::{self, Machine, pose, position};
use super::operator::Action;
use super::progress::{Progress, Step};
use super::recording::{
    ABORTED, DONE, End, Ending, HELD, Recorder, STARVED, Sample, WAITING, moves,
};
use super::stop_watch::StopWatch;
use crate::joints::LimitedJoints;
use crate::layer::program::{MotionType, Operation};
use crate::layer::spindle::{SpindleCommand, Surface};
use crate::loaded::stubs::Stubs;
use crate::path::Position;
use crate::path::segment::largest_difference;
use framepath::abi::linuxcnc::{
    DEFAULT_TC_QUEUE_SIZE, EMCMOT_MOTION_INPOS_BIT, EmcPose, FS_ENABLED,
};
use std::ffi::{c_int, c_long};
use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::os::fd::FromRawFd;
use std::process::ExitCode;

/// In this variable of the environment is the path of the progress word.
pub(crate) const PROGRESS_VARIABLE: &str = "FRAMEPATH_COMPARE_PROGRESS";

/// Cycles that are recorded after the end, in which the module has to stand still.
const SETTLING_CYCLES: u64 = 50;

/// A planner with nothing left to do that is so many of its longest steps from where its last move ends has
/// dropped it. LinuxCNC's own may be a step behind.
const DROPPED: f64 = 2.0;

/// The whole life of a driven process: job from standard input, records to standard output.
pub(crate) fn serve() -> ExitCode {
    match try_serve() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            crate::output::tell(format_args!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

fn try_serve() -> io::Result<()> {
    // Nobody reads the recording of one whose parent has ended; a module that hangs would hang for ever.
    rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::KILL))?;
    let output = take_standard_output()?;
    let mut bytes = Vec::new();
    io::stdin().lock().read_to_end(&mut bytes)?;
    let path = std::env::var(PROGRESS_VARIABLE).map_err(io::Error::other)?;
    let progress = Progress::open(&path)?;
    let job: Job = postcard::from_bytes(&bytes).map_err(io::Error::other)?;
    let stubs = Stubs::find().ok_or_else(|| io::Error::other("the stubs are not loaded"))?;
    let mut recorder = Recorder(BufWriter::with_capacity(1 << 20, output));
    progress.note(Step::Loading, 0);
    let ending = match load(&job.module) {
        Ok(functions) => Drive::new(&job, functions, &stubs, &progress).run(&mut recorder)?,
        Err(problem) => Ending::NotUsable(problem),
    };
    progress.note(Step::Finished, 0);
    recorder.end(End {
        ending,
        heap_calls: stubs.heap_calls(),
        errors: stubs.errors(),
        first_error: stubs.first_error(),
    })
}

/// Keeps everything there is in memory, as LinuxCNC's rtapi_app does with real-time rights: a page
/// that is fetched when it is first used is not what a call costs. Without the right to do so such
/// pages are measured along.
fn stay_in_memory() {
    // SAFETY: changes no memory.
    unsafe { libc::mlockall(libc::MCL_CURRENT) };
}

/// Standard output for the records alone: what a module prints goes to standard error.
fn take_standard_output() -> io::Result<File> {
    // SAFETY: descriptors of this process; the new one belongs to the file from here on.
    unsafe {
        let copy = libc::dup(libc::STDOUT_FILENO);
        if copy < 0 || libc::dup2(libc::STDERR_FILENO, libc::STDOUT_FILENO) < 0 {
            return Err(io::Error::last_os_error());
        }
        Ok(File::from_raw_fd(copy))
    }
}

pub(super) struct Drive<'a> {
    pub(super) job: &'a Job,
    pub(super) tp: Functions,
    pub(super) machine: Machine,
    stubs: &'a Stubs,
    progress: &'a Progress,
    cycle: u64,
    pub(super) next_operation: usize,
    next_event: usize,
    pub(super) dwell_until: Option<f64>,
    resume_at: Option<f64>,
    aborted: bool,
    pub(super) refused: Option<Ending>,
    /// Where the last move ends that was handed over, and its line.
    pub(super) goal: (Position, i32),
    revolutions: f64,
    /// Constant surface speed of the spindle.
    pub(super) surface: Option<Surface>,
    position: Position,
    last_motion: u64,
}

impl<'a> Drive<'a> {
    fn new(job: &'a Job, tp: Functions, stubs: &'a Stubs, progress: &'a Progress) -> Self {
        Drive {
            job,
            tp,
            machine: Machine::new(job),
            stubs,
            progress,
            cycle: 0,
            next_operation: 0,
            next_event: 0,
            dwell_until: None,
            resume_at: None,
            aborted: false,
            refused: None,
            goal: ([0.0; 9], 0),
            revolutions: 0.0,
            surface: None,
            position: [0.0; 9],
            last_motion: 0,
        }
    }

    pub(super) fn time(&self) -> f64 {
        self.cycle as f64 * self.job.period
    }

    fn period_ns(&self) -> c_long {
        (self.job.period * 1e9).round() as c_long
    }

    /// Calls a function of the module; the heap is watched meanwhile. Returns its result and
    /// nanoseconds.
    pub(super) fn call<T>(&self, step: Step, function: impl FnOnce(&Functions) -> T) -> (T, u32) {
        self.progress.note(step, self.cycle);
        self.stubs.watch_heap(true);
        let watch = StopWatch::start();
        let result = function(&self.tp);
        let nanoseconds = watch.stop();
        self.stubs.watch_heap(false);
        self.progress.note(Step::Other, self.cycle);
        (result, nanoseconds)
    }

    /// As motmod starts its planner. The heap may be used here: it is where memory is taken.
    fn start(&self) -> Result<bool, String> {
        self.progress.note(Step::Creating, 0);
        self.stubs.set_period(self.period_ns());
        let Machine { tp, status, config } = self.machine;
        let limit = self.job.velocity_limit;
        let zero = pose(&[0.0; 9]);
        if let Some(joints) = &self.job.joints {
            self.stubs.set_kinematics(kinematics::with(joints));
        }
        // SAFETY: the structures of the machine, in the order in which motmod calls.
        unsafe {
            (self.tp.tpMotFunctions)(
                machine::write_digital,
                machine::write_analog,
                machine::set_rotary_unlock,
                machine::rotary_unlocked,
                machine::velocity_limit,
                machine::acceleration_limit,
            );
            (self.tp.tpMotData)(status, config);
            let result = (self.tp.tpCreate)(tp, DEFAULT_TC_QUEUE_SIZE as c_int, 1);
            if result != 0 {
                return Err(format!("tpCreate returned {result}"));
            }
            (self.tp.tpSetCycleTime)(tp, self.job.period);
            (self.tp.tpSetVmax)(tp, 0.0, 0.0);
            (self.tp.tpSetAmax)(tp, 0.0);
            (self.tp.tpSetPos)(tp, &zero);
            (self.tp.tpSetVmax)(tp, 0.0, 1.0);
            (self.tp.tpSetVlimit)(tp, limit);
            (self.tp.tpSetAmax)(tp, 1e99);
        }
        if let Some(joints) = &self.job.joints {
            self.limit_joints(joints);
        }
        let mut pins = 0;
        for (letter, jerk) in "xyzabcuvw".chars().zip(self.job.jerk) {
            pins += self.stubs.set(&format!("axis.{letter}.max-jerk"), jerk);
        }
        Ok(pins > 0)
    }

    /// As HAL files set the limits of joints, 0 for none.
    fn limit_joints(&self, joints: &LimitedJoints) {
        let [velocity, acceleration, jerk] = *joints.limits();
        let jerk = jerk.map(|jerk| if jerk.is_finite() { jerk } else { 0.0 });
        for joint in 0..joints.count().min(velocity.len()) {
            let set = |quantity: &str, limits: &Position| {
                let pin = format!("joint.{joint}.max-{quantity}");
                self.stubs.set(&pin, limits[joint]);
            };
            set("velocity", &velocity);
            set("acceleration", &acceleration);
            set("jerk", &jerk);
        }
    }

    fn run<W: Write>(&mut self, recorder: &mut Recorder<W>) -> io::Result<Ending> {
        let takes_jerk = match self.start() {
            Ok(takes_jerk) => takes_jerk,
            Err(problem) => return Ok(Ending::NotUsable(problem)),
        };
        stay_in_memory();
        recorder.start(takes_jerk, StopWatch::shortest())?;
        let stuck_after = (self.job.stuck_after / self.job.period) as u64;
        let last_cycle = (self.job.time_limit / self.job.period) as u64;
        let mut settled = 0;
        loop {
            self.operate();
            if !self.aborted {
                self.task(recorder)?;
            }
            if let Some(refused) = self.refused.take() {
                return Ok(refused);
            }
            let sample = self.servo();
            recorder.sample(&sample)?;
            if !self.aborted && self.motion_done() && self.has_dropped(&sample.position) {
                return Ok(Ending::GaveUp { line: self.goal.1 });
            }
            if sample.flags & (HELD | WAITING) != 0 {
                self.last_motion = self.cycle;
            }
            let finished = self.aborted || self.next_operation >= self.job.operations.len();
            let at_rest = self.motion_done() && self.last_motion < self.cycle;
            settled = if finished && at_rest && self.dwell_until.is_none() {
                settled + 1
            } else {
                0
            };
            self.cycle += 1;
            if settled > SETTLING_CYCLES {
                return Ok(if self.aborted {
                    Ending::Aborted
                } else {
                    Ending::Complete
                });
            }
            if self.cycle - self.last_motion > stuck_after {
                return Ok(Ending::Stuck);
            }
            if self.cycle > last_cycle {
                return Ok(Ending::TooLong);
            }
        }
    }

    /// Whether the last move that was handed over cannot have been run.
    fn has_dropped(&self, position: &Position) -> bool {
        let fastest = self.job.limits.velocity.into_iter().fold(0.0, f64::max);
        largest_difference(position, &self.goal.0) > DROPPED * fastest * self.job.period
    }

    pub(super) fn motion_done(&self) -> bool {
        let tp = self.machine.tp;
        // SAFETY: the structure of the machine, after tpCreate.
        unsafe { (self.tp.tpIsDone)(tp) != 0 && (self.tp.tpQueueDepth)(tp) == 0 }
    }

    /// The operator's actions that are due.
    fn operate(&mut self) {
        let Machine { tp, status, config } = self.machine;
        let time = self.time() + 1e-9;
        if self.resume_at.is_some_and(|at| time >= at) {
            self.resume_at = None;
            // SAFETY: the structures of the machine.
            self.call(Step::Other, |f| unsafe { (f.tpResume)(tp) });
            // SAFETY: the structures of the machine.
            unsafe { (*status).paused = 0 };
        }
        while let Some(event) = self.job.events.get(self.next_event) {
            if event.time > time {
                break;
            }
            self.next_event += 1;
            match event.action {
                // SAFETY: the structures of the machine.
                Action::FeedOverride(scale) => unsafe { (*status).feed_scale = scale },
                Action::MaxVelocity(velocity) => {
                    // SAFETY: the structures of the machine.
                    unsafe { (*config).limitVel = velocity };
                    // SAFETY: the structures of the machine.
                    self.call(Step::Other, |f| unsafe { (f.tpSetVlimit)(tp, velocity) });
                }
                Action::Pause(seconds) if !self.aborted => {
                    if self.resume_at.is_none() {
                        // SAFETY: the structures of the machine.
                        self.call(Step::Other, |f| unsafe { (f.tpPause)(tp) });
                        // SAFETY: the structures of the machine.
                        unsafe { (*status).paused = 1 };
                    }
                    let until = time + seconds;
                    self.resume_at = Some(self.resume_at.map_or(until, |at| at.max(until)));
                }
                Action::Abort if !self.aborted => {
                    // SAFETY: the structures of the machine.
                    self.call(Step::Other, |f| unsafe { (f.tpAbort)(tp) });
                    // SAFETY: the structures of the machine.
                    unsafe { (*status).paused = 0 };
                    self.resume_at = None;
                    self.dwell_until = None;
                    self.aborted = true;
                }
                Action::Pause(_) | Action::Abort => {}
            }
        }
    }

    /// The spindle has its speed at once; its index pulse resets the revolutions when asked for.
    fn turn_spindle(&mut self) {
        // SAFETY: the structures of the machine.
        let spindle = unsafe { &mut (*self.machine.status).spindle_status[0] };
        let command = SpindleCommand {
            speed: spindle.speed,
            surface: self.surface,
        };
        let speed = command.at(self.position[0]);
        let before = self.revolutions;
        self.revolutions += speed / 60.0 * self.job.period;
        let [before, now] = [before, self.revolutions].map(f64::floor);
        if spindle.spindle_index_enable != 0 && before != now {
            self.revolutions -= before.max(now);
            spindle.spindle_index_enable = 0;
        }
        spindle.spindleRevs = self.revolutions;
        spindle.spindleSpeedIn = speed / 60.0;
        spindle.at_speed = 1;
    }

    /// One servo cycle of the motion controller.
    fn servo(&mut self) -> Sample {
        let Machine { tp, status, .. } = self.machine;
        let busy = !self.motion_done();
        self.turn_spindle();
        // SAFETY: the structures of the machine.
        let scale = unsafe {
            let on = u32::from((*status).enables_queued) & FS_ENABLED != 0;
            let rapid = (*status).motionType == MotionType::Traverse as c_int;
            let scale = match (on, rapid) {
                (false, _) => 1.0,
                (true, true) => (*status).rapid_scale,
                (true, false) => (*status).feed_scale,
            };
            (*status).net_feed_scale = scale;
            scale
        };
        let period = self.period_ns();
        // SAFETY: the structures of the machine.
        let (_, run) = self.call(Step::RunCycle, |f| unsafe { (f.tpRunCycle)(tp, period) });
        let mut now = pose(&[0.0; 9]);
        // SAFETY: the structures of the machine.
        unsafe { (self.tp.tpGetPos)(tp, &raw mut now) };
        let (id, depth) = self.publish(&now);
        self.stubs.run_functions();

        let position = position(&now);
        let mut travel = position;
        for (travel, before) in travel.iter_mut().zip(self.position) {
            *travel -= before;
        }
        if moves(&travel) {
            self.last_motion = self.cycle;
        }
        self.position = position;
        Sample {
            position,
            scale,
            id,
            queued: depth,
            run: if busy { run.max(1) } else { 0 },
            flags: self.flags(scale, depth),
        }
    }

    /// What motmod copies from the planner to its status after each cycle.
    fn publish(&self, now: &EmcPose) -> (c_int, c_int) {
        let Machine { tp, status, .. } = self.machine;
        // SAFETY: the structures of the machine, after tpCreate.
        unsafe {
            let status = &mut *status;
            status.carte_pos_cmd = *now;
            status.carte_pos_fb = *now;
            if let Some(joints) = &self.job.joints {
                let there = joints.at(&position(now));
                for (joint, position) in status.joint_status.iter_mut().zip(there) {
                    joint.pos_cmd = position;
                }
            }
            status.depth = (self.tp.tpQueueDepth)(tp);
            status.activeDepth = (self.tp.tpActiveDepth)(tp);
            status.id = (self.tp.tpGetExecId)(tp);
            status.tag = (self.tp.tpGetExecTag)(tp);
            status.motionType = (self.tp.tpGetMotionType)(tp);
            status.queueFull = (self.tp.tcqFull)(&raw const (*tp).queue);
            status.heartbeat = status.heartbeat.wrapping_add(1);
            let in_position = EMCMOT_MOTION_INPOS_BIT as u16;
            if (self.tp.tpIsDone)(tp) != 0 {
                status.motionFlag |= in_position;
            } else {
                status.motionFlag &= !in_position;
            }
            (status.id, status.depth)
        }
    }

    fn flags(&self, scale: f64, depth: c_int) -> u8 {
        let next = self.job.operations.get(self.next_operation);
        let set = |on: bool, flag: u8| if on { flag } else { 0 };
        set(self.resume_at.is_some() || scale <= 0.0, HELD)
            | set(self.motion_done(), DONE)
            | set(self.dwell_until.is_some(), WAITING)
            | set(
                depth < 2 && matches!(next, Some(Operation::Move(_))),
                STARVED,
            )
            | set(self.aborted, ABORTED)
    }
}
