//! How a frame reaches the kinematics of a running machine: commands, checks, the switch, and what
//! the operator sees.
//!
//! A program hands over one command at a time, under a number that changes.
//! [`FrameControl::update`] runs in the servo thread behind the motion controller: it applies the
//! command to a copy of the operations, builds the frame, and asks motion for a switch of
//! kinematics. Motion answers in its next period with [`FrameControl::switch`], the only place
//! where the active frame and the machine's dimensions change. Whatever is refused leaves both as
//! they are.
//!
//! A frame does not outlive its program: [`FrameControl::update`] removes it by itself, in the first
//! period in which motion allows it, when the command falls to 0 (an abort), the machine is switched
//! off, or the guard says so. User space is too slow for that: a user interface may be in teleop
//! mode before it has looked.
//!
//! Motion notices a request only when the number of the kinematics changes, so two slots are used
//! in turn.

use nalgebra::{Matrix3, Vector3};

use super::check;
use super::command::{Command, Source};
use super::heartbeat::{Guard, Heartbeat};
pub use super::pins::{FrameInputs, FrameOutputs};
use super::refusal::FrameRefusal;
use super::release::FrameRelease;
use crate::axes::Axes;
use crate::frame::{ActiveFrame, AffineMap, ProgrammableFrame, ToolLength, WorkOffset};
use crate::machine::{Coordinates, Machine, TableTiltingParameters};

/// Motion switches in the period after the request. If it has not done so by now, nobody listens.
const PATIENCE: u32 = 100;

/// How far, in machine units, an axis without a joint may be taken along, and how much of another
/// axis may reach it: rounding.
const STILL: f64 = 1e-9;

/// Kinematics that are ready to be switched to.
#[derive(Clone, Copy, Debug)]
struct Staged {
    source: Source,
    /// `None`: no frame.
    frame: Option<ActiveFrame>,
    machine: Machine,
    /// The tool offset it was made with.
    tool_offset: [f64; 3],
}

/// A switch that motion was asked for.
#[derive(Clone, Copy, Debug)]
struct Request {
    staged: Staged,
    slot: i32,
    /// The slot that was asked for before.
    previous: i32,
    /// Number of the command; `None`: nobody asked, the frame has to go.
    number: Option<f64>,
    waited: u32,
}

/// The frame of a machine with the machine's own kinematics, and the way to change them.
#[derive(Clone, Copy, Debug)]
pub struct FrameControl {
    active: Staged,
    slot: i32,
    request: Option<Request>,
    outputs: FrameOutputs,
    /// The slot that was asked for last: asking for it again would go unnoticed.
    asked: i32,
    /// The machine's dimensions have been read once.
    started: bool,
    heartbeat: Heartbeat,
    release: FrameRelease,
}

impl FrameControl {
    /// No frame. The dimensions of the machine are read at the first [`Self::update`].
    pub fn new(machine: Machine) -> Self {
        Self {
            active: Staged {
                source: Source::nothing(),
                frame: None,
                machine,
                tool_offset: [0.0; 3],
            },
            slot: 0,
            request: None,
            outputs: FrameOutputs {
                switchkins_type: 0,
                acknowledged: 0.0,
                active: false,
                slot: 0,
                operations: 0,
                tool_centre_point: false,
                parameters_pending: false,
                tool_offset: [0.0; 3],
                refusal: None,
                releasing: false,
                releases: 0,
                hold: false,
                guarded: true,
                guard: Guard::Never,
            },
            asked: 0,
            started: false,
            heartbeat: Heartbeat::new(),
            release: FrameRelease::default(),
        }
    }

    /// The frame in force, `None` if the machine runs without one.
    #[inline]
    pub fn active(&self) -> Option<&ActiveFrame> {
        self.active.frame.as_ref()
    }

    /// The machine with the dimensions in force.
    #[inline]
    pub fn machine(&self) -> &Machine {
        &self.active.machine
    }

    /// One servo period: takes a new command, asks for a switch, sees whether it took place.
    ///
    /// The first one takes over the dimensions of the machine, which has not moved yet.
    pub fn update(&mut self, inputs: &FrameInputs) -> FrameOutputs {
        if !self.started {
            self.started = true;
            match self.machine_with(&inputs.table) {
                Ok(machine) => self.active.machine = machine,
                Err(refusal) => self.outputs.refusal = Some(refusal),
            }
        }
        self.heartbeat
            .listen(inputs.heartbeat, inputs.period, inputs.clock);
        match &mut self.request {
            Some(request) => {
                request.waited += 1;
                if request.waited > PATIENCE {
                    let (number, previous) = (request.number, request.previous);
                    self.request = None;
                    // Taken back, or motion would switch whenever somebody links the pin.
                    self.asked = previous;
                    self.outputs.switchkins_type = previous;
                    self.refuse(number, FrameRefusal::NotSwitched);
                }
            }
            None => self.take_command(inputs),
        }
        self.remove_what_has_to_go(inputs);
        self.show(inputs);
        self.outputs
    }

    /// What the pins show.
    fn show(&mut self, inputs: &FrameInputs) {
        self.outputs.slot = self.slot;
        self.outputs.active = self.active.frame.is_some();
        self.outputs.operations = self.active.source.count();
        let wanted = self.machine_with(&inputs.table);
        self.outputs.tool_centre_point = self.machine().tool_centre_point();
        self.outputs.parameters_pending = wanted != Ok(self.active.machine);
        self.outputs.tool_offset = shown(&self.active.tool_offset);
        let guard = self.heartbeat.guard();
        let framed = self.outputs.active;
        self.outputs.guard = guard;
        self.outputs.releasing = self.release.is_due();
        self.outputs.guarded = !(framed && guard == Guard::Lost);
        let late = framed && matches!(guard, Guard::Late | Guard::Lost);
        self.outputs.hold = self.outputs.parameters_pending || late || self.is_unread(inputs);
    }

    /// The interpreter has positions with a frame that is gone or about to go, and somebody is there to
    /// tell it.
    fn is_unread(&self, inputs: &FrameInputs) -> bool {
        let going = self.request.is_some_and(|request| request.number.is_none());
        let told = self.outputs.releases == inputs.releases_seen;
        matches!(self.heartbeat.guard(), Guard::Lives | Guard::Late) && (going || !told)
    }

    /// Asks for the end of a frame that nobody answers for any more, once motion allows it.
    fn remove_what_has_to_go(&mut self, inputs: &FrameInputs) {
        let guard = self.heartbeat.guard();
        let framed = self.active.frame.is_some();
        let coming = self.request.is_some_and(|it| it.staged.frame.is_some());
        let standing = may_remove(inputs).is_ok();
        self.release
            .watch(inputs, guard, framed || coming, standing);
        if self
            .release
            .drops_the_rest(framed || self.request.is_some())
        {
            self.active.source = Source::nothing();
        }
        if self.release.is_ripe() && framed && self.request.is_none() {
            let machine = self.machine_with(&inputs.table);
            let staged = Staged {
                source: Source::nothing(),
                frame: None,
                machine: machine.unwrap_or(self.active.machine),
                tool_offset: inputs.tool_offset,
            };
            self.ask(staged, None);
        }
    }

    /// Motion switches to kinematics `slot`: 0 without a frame, 1 or 2 with one.
    ///
    /// A slot that was not asked for by [`Self::update`] takes the map pins as they are now: so a
    /// frame can also be switched on by hand. Every switch takes over the machine's dimensions.
    ///
    /// # Errors
    ///
    /// Why nothing changes.
    pub fn switch(&mut self, slot: i32, inputs: &FrameInputs) -> Result<(), FrameRefusal> {
        let request = self.request.take();
        let by_itself = request.is_some_and(|it| it.number.is_none() && it.slot == slot);
        let number = match request {
            Some(request) => request.number,
            None => Some(self.outputs.acknowledged),
        };
        // Motion remembers the number, whatever comes of it.
        self.asked = slot;
        match self.checked(slot, request, inputs) {
            Ok(staged) => {
                self.active = staged;
                self.slot = slot;
                // The refusal that ended the program stays to be read.
                self.answer(number, None);
                if by_itself && self.heartbeat.guard() != Guard::Lost {
                    self.outputs.releases = self.outputs.releases.wrapping_add(1);
                }
                Ok(())
            }
            Err(refusal) => {
                self.refuse(number, refusal);
                Err(refusal)
            }
        }
    }

    /// What a switch to `slot` would make the active frame.
    fn checked(
        &self,
        slot: i32,
        request: Option<Request>,
        inputs: &FrameInputs,
    ) -> Result<Staged, FrameRefusal> {
        match request {
            Some(removal) if removal.number.is_none() && removal.slot == slot => {
                may_remove(inputs)?
            }
            _ => standing(inputs)?,
        }
        match request {
            Some(request) if request.slot == slot => Ok(request.staged),
            _ if slot == 0 => self.staged(Source::nothing(), inputs),
            _ if slot == 1 || slot == 2 => self.staged(Source::map_pins(), inputs),
            _ => Err(FrameRefusal::UnknownType),
        }
    }

    /// The answer to a command; nobody waits for one where the frame went by itself.
    fn answer(&mut self, number: Option<f64>, refusal: Option<FrameRefusal>) {
        if let Some(number) = number {
            self.outputs.acknowledged = number;
            self.outputs.refusal = refusal;
        }
    }

    fn refuse(&mut self, number: Option<f64>, refusal: FrameRefusal) {
        self.answer(number, Some(refusal));
    }

    /// Whether a command can be believed, and somebody is there to remove its frame.
    fn trusted(&self, command: &Command, inputs: &FrameInputs) -> Result<(), FrameRefusal> {
        let guard = self.heartbeat.guard();
        if command.removes() {
            Ok(())
        } else if !check::is_whole(inputs) {
            Err(FrameRefusal::WrongCheck)
        } else if matches!(guard, Guard::Never | Guard::Lost) {
            Err(FrameRefusal::Unguarded)
        } else {
            Ok(())
        }
    }

    fn take_command(&mut self, inputs: &FrameInputs) {
        let Some(command) = Command::on_pin(inputs.command) else {
            return;
        };
        let number = command.number;
        if number == self.outputs.acknowledged {
            return;
        }
        // It would be given a pose on the way. In motion it is refused at once.
        if standing(inputs).is_ok() && !self.release.is_settled() {
            return;
        }
        match self.commanded(&command, inputs) {
            Err(refusal) => self.refuse(Some(number), refusal),
            Ok(staged) if self.changes_nothing(&staged) => {
                self.active.source = staged.source;
                self.answer(Some(number), None);
            }
            Ok(staged) => self.ask(staged, Some(number)),
        }
    }

    /// What a command makes of the frame.
    fn commanded(&self, command: &Command, inputs: &FrameInputs) -> Result<Staged, FrameRefusal> {
        self.trusted(command, inputs)?;
        if command.suspends() {
            standing(inputs)?;
            return self.suspended(inputs);
        }
        let source = self.active.source.after(command, &inputs.value)?;
        standing(inputs)?;
        self.staged(source, inputs)
    }

    /// There was no frame, there will be none, and the machine is the same.
    fn changes_nothing(&self, staged: &Staged) -> bool {
        let frames = staged.frame.is_some() || self.active.frame.is_some();
        !frames && self.slot == 0 && staged.machine == self.active.machine
    }

    /// Asks motion for a switch, under a number that differs from the last.
    fn ask(&mut self, staged: Staged, number: Option<f64>) {
        let slot = match (staged.frame, self.asked) {
            (None, asked) if asked != 0 => 0,
            (_, 1) => 2,
            _ => 1,
        };
        self.request = Some(Request {
            staged,
            slot,
            previous: self.asked,
            number,
            waited: 0,
        });
        self.asked = slot;
        self.outputs.switchkins_type = slot;
    }

    /// The machine with other dimensions.
    fn machine_with(&self, table: &TableTiltingParameters) -> Result<Machine, FrameRefusal> {
        let mut machine = self.active.machine;
        match machine.set_parameters(table) {
            Ok(()) => Ok(machine),
            Err(_) => Err(FrameRefusal::MachineParameters),
        }
    }

    /// No frame, with what it was made of kept for later.
    fn suspended(&self, inputs: &FrameInputs) -> Result<Staged, FrameRefusal> {
        Ok(Staged {
            source: self.active.source,
            frame: None,
            machine: self.machine_with(&inputs.table)?,
            tool_offset: inputs.tool_offset,
        })
    }

    /// The kinematics that this makes, with machine, work offset and tool as they are now.
    fn staged(&self, source: Source, inputs: &FrameInputs) -> Result<Staged, FrameRefusal> {
        let machine = self.machine_with(&inputs.table)?;
        let programmed = match source.operations() {
            Some(list) if list.is_empty() => None,
            Some(list) => Some(list.fold()?),
            None => {
                let [xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z] = inputs.map;
                let linear = Matrix3::new(xx, xy, xz, yx, yy, yz, zx, zy, zz);
                let map = AffineMap::new(linear, Vector3::new(x, y, z))?;
                Some(ProgrammableFrame::from_map(map)?)
            }
        };
        let frame = match programmed {
            None => None,
            Some(programmed) => Some(joined(&programmed, &machine, inputs)?),
        };
        Ok(Staged {
            source,
            frame,
            machine,
            tool_offset: inputs.tool_offset,
        })
    }
}

/// A frame with work offset and tool as they are now.
fn joined(
    programmed: &ProgrammableFrame,
    machine: &Machine,
    inputs: &FrameInputs,
) -> Result<ActiveFrame, FrameRefusal> {
    let offset = spread(&inputs.work_offset);
    let work = WorkOffset::new(offset, Axes::zeros(), inputs.work_rotation)?;
    let tool = spread(&inputs.tool_offset);
    // With the tool centre point on, the kinematics behind the frame turn the tool's length.
    let tool_length = if machine.tool_centre_point() {
        ToolLength::Machine
    } else {
        inputs.tool_length
    };
    let frame = ActiveFrame::new(programmed, inputs.mirror, &work, &tool, tool_length)?;
    if moves_missing_axis(frame.map(), machine.coordinates()) {
        return Err(FrameRefusal::MissingAxis);
    }
    Ok(frame)
}

/// Whether an axis that has no joint would have to leave its zero for the program to be run.
fn moves_missing_axis(map: &AffineMap, coordinates: &Coordinates) -> bool {
    map.to_rows().iter().enumerate().any(|(axis, row)| {
        let [x, y, z, shift] = *row;
        let others = [x, y, z]
            .iter()
            .enumerate()
            .any(|(other, part)| other != axis && part.abs() > STILL);
        coordinates.joint_of_axis(axis).is_none() && (others || shift.abs() > STILL)
    })
}

/// Whether kinematics may change now.
fn standing(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    if inputs.teleop {
        Err(FrameRefusal::Teleop)
    } else if !inputs.in_position {
        Err(FrameRefusal::Moving)
    } else {
        Ok(())
    }
}

/// Whether the frame may be removed now. With the machine off teleop mode is no obstacle: motion takes its position
/// from the kinematics when it is switched on again.
fn may_remove(inputs: &FrameInputs) -> Result<(), FrameRefusal> {
    standing(&FrameInputs {
        teleop: inputs.teleop && inputs.enabled,
        ..*inputs
    })
}

/// A tool offset as operators see it: without a frame it may be anything, and removing a frame must not depend on it.
fn shown(tool_offset: &[f64; 3]) -> [f64; 3] {
    tool_offset.map(|offset| if offset.is_finite() { offset } else { 0.0 })
}

/// X Y Z of nine axes, the others 0.
fn spread([x, y, z]: &[f64; 3]) -> Axes {
    Axes::from([*x, *y, *z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}
