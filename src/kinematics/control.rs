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
//!
//! Where the kinematics behind the frame are another module's, programs switch these by a pin of their
//! own. Motion is then asked for both in one number, see [`Behind::number`].

use super::behind::Behind;
use super::check;
use super::command::{Command, Source};
use super::heartbeat::{Guard, Heartbeat};
use super::inner::InnerType;
pub use super::pins::{FrameInputs, FrameOutputs};
use super::refusal::FrameRefusal;
use super::release::FrameRelease;
use super::request::{Purpose, Request};
use super::staged::Staged;
use super::switching::{may_remove, offsets_stand, same_joints, standing};
use crate::frame::ActiveFrame;

/// Motion switches in the period after the request. If it has not done so by now, nobody listens.
const PATIENCE: u32 = 100;

/// The frame of a machine with the machine's own kinematics, and the way to change them.
#[derive(Clone, Copy, Debug)]
pub struct FrameControl {
    pub(super) active: Staged,
    slot: i32,
    pub(super) request: Option<Request>,
    pub(super) outputs: FrameOutputs,
    /// The kinematics type that was asked for last: asking for it again would go unnoticed.
    asked: i32,
    /// The type of the inner kinematics that cannot be had, and why: not asked for again while the pin says it.
    refused_type: Option<(i32, FrameRefusal)>,
    /// The kinematics type that motion is shown again after one that the inner kinematics did not take: nothing changes.
    put_back: Option<i32>,
    /// The joints of the inner kinematics have jumped with the tool offset, and no command has taken it over.
    tool_jumped: bool,
    /// The machine's dimensions have been read once.
    started: bool,
    heartbeat: Heartbeat,
    pub(super) release: FrameRelease,
}

impl FrameControl {
    /// No frame. The dimensions of the machine are read at the first [`Self::update`].
    pub fn new(behind: impl Into<Behind>) -> Self {
        Self {
            active: Staged {
                source: Source::nothing(),
                frame: None,
                behind: behind.into(),
                tool_offset: [0.0; 3],
                work_offset: [0.0; 3],
                work_rotation: 0.0,
            },
            slot: 0,
            request: None,
            outputs: FrameOutputs::first(),
            asked: 0,
            refused_type: None,
            put_back: None,
            tool_jumped: false,
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

    /// What is behind the frame, with the dimensions and the type in force.
    #[inline]
    pub fn behind(&self) -> &Behind {
        &self.active.behind
    }

    /// One servo period: takes a new command, asks for a switch, sees whether it took place.
    ///
    /// The first one takes over the dimensions of the machine, which has not moved yet.
    pub fn update(&mut self, inputs: &FrameInputs) -> FrameOutputs {
        if !self.started {
            self.started = true;
            // The type of inner kinematics is motion's to change.
            if self.active.behind.machine().is_some() {
                match self.active.behind.as_on_pins(inputs) {
                    Ok(behind) => self.active.behind = behind,
                    Err(refusal) => self.outputs.refusal = Some(refusal),
                }
            }
        }
        self.heartbeat
            .listen(inputs.heartbeat, inputs.period, inputs.clock);
        match &mut self.request {
            Some(request) => {
                request.waited += 1;
                if request.waited > PATIENCE {
                    let request = *request;
                    self.request = None;
                    // Taken back, or motion would switch whenever somebody links the pin.
                    self.asked = request.previous;
                    self.outputs.switchkins_type = request.previous;
                    self.refuse(&request, FrameRefusal::NotSwitched);
                }
            }
            None => self.take_command(inputs),
        }
        // With the machine off motion takes its position from the joints when it is switched on again.
        self.tool_jumped = inputs.enabled && (self.tool_jumped || inputs.tool_jumped);
        self.remove_what_has_to_go(inputs);
        self.follow_inner_type(inputs);
        self.show(inputs);
        self.outputs
    }

    /// What the pins show.
    fn show(&mut self, inputs: &FrameInputs) {
        self.outputs.slot = self.slot;
        self.outputs.active = self.active.frame.is_some();
        self.outputs.operations = self.active.source.count();
        let wanted = self.behind_on_pins(inputs);
        self.outputs.tool_centre_point = self.active.behind.turns_tool();
        self.outputs.inner_type = self.active.behind.inner_type();
        self.outputs.parameters_pending = wanted != Ok(self.active.behind) || self.tool_jumped;
        self.outputs.tool_offset = shown(&self.active.tool_offset);
        self.outputs.work_offset = shown(&self.active.work_offset);
        [self.outputs.work_rotation] = shown(&[self.active.work_rotation]);
        let guard = self.heartbeat.guard();
        let framed = self.outputs.active;
        self.outputs.guard = guard;
        self.outputs.releasing = self.release.is_due();
        self.outputs.guarded = !(framed && guard == Guard::Lost);
        let late = framed && matches!(guard, Guard::Late | Guard::Lost);
        let going = self.is_kept_from_going(inputs);
        self.outputs.hold =
            self.outputs.parameters_pending || late || going || self.is_unread(inputs);
    }

    /// The guard wants the frame removed, no program runs as far as it knows, and the frame is still there: what starts now
    /// waits until the guard has looked at it. A jog in teleop mode is none.
    fn is_kept_from_going(&self, inputs: &FrameInputs) -> bool {
        self.active.frame.is_some() && inputs.release && !inputs.teleop
    }

    /// The interpreter has positions with a frame that is gone or about to go, and somebody is there to
    /// tell it.
    fn is_unread(&self, inputs: &FrameInputs) -> bool {
        let going = self.request.as_ref().is_some_and(Request::removes);
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
            if let Err(refusal) = same_joints(inputs) {
                // An offset that is on its way is waited for; one that does not come to rest is told of.
                if refusal != FrameRefusal::OffsetsMove || self.release.stands_for(PATIENCE) {
                    self.outputs.refusal = Some(refusal);
                }
                return;
            }
            let behind = self.behind_on_pins(inputs).unwrap_or(self.active.behind);
            let staged = Staged::without_frame(Source::nothing(), behind, inputs);
            self.ask(staged, Purpose::Removal);
        }
    }

    /// Before motion looks at the number in a period: the one to show it, with the type of the inner kinematics that the pin
    /// says. LinuxCNC's programs put it there and wait for nothing: their interpreter reads the position in the next
    /// moment, and has to find that of the new kinematics.
    pub fn take_inner_type(&mut self, inputs: &FrameInputs) -> i32 {
        self.follow_inner_type(inputs);
        self.outputs.switchkins_type
    }

    /// Asks for the type of the inner kinematics that the pin says, as soon as motion stands.
    fn follow_inner_type(&mut self, inputs: &FrameInputs) {
        if self.active.behind.machine().is_some() {
            return;
        }
        let said = InnerType::on_pin(inputs.inner_type);
        self.refused_type = self
            .refused_type
            .filter(|(number, _)| Some(*number) == said);
        self.outputs.inner_refusal = match self.behind_on_pins(inputs) {
            Err(refusal) => Some(refusal),
            Ok(wanted) if wanted == self.active.behind || self.request.is_some() => None,
            Ok(wanted) => match standing(inputs)
                .and_then(|()| offsets_stand(inputs))
                .and_then(|()| self.again(wanted, inputs))
            {
                Err(refusal) => Some(refusal),
                Ok(staged) => {
                    self.ask(staged, Purpose::InnerType);
                    None
                }
            },
        };
    }

    /// Motion switches to kinematics `number`: slot 0 without a frame, 1 or 2 with one, and the type of inner kinematics,
    /// which `switch_inner` is asked for where it changes; it returns whether they took it.
    ///
    /// A slot that was not asked for by [`Self::update`] takes the map pins as they are now: so a
    /// frame can also be switched on by hand. Every switch takes over the machine's dimensions.
    ///
    /// # Errors
    ///
    /// Why nothing changes.
    pub fn switch(
        &mut self,
        number: i32,
        inputs: &FrameInputs,
        switch_inner: impl FnMut(i32) -> bool,
    ) -> Result<(), FrameRefusal> {
        let request = self.request.take();
        let put_back = self.put_back.take();
        if request.is_none() && put_back == Some(number) {
            self.asked = number;
            return Ok(());
        }
        let by_itself = request.is_some_and(|it| it.removes() && it.number == number);
        let asked = request.unwrap_or(Request {
            staged: self.active,
            number,
            previous: self.asked,
            purpose: Purpose::Command(self.outputs.acknowledged),
            waited: 0,
        });
        // Motion remembers the number, whatever comes of it.
        self.asked = number;
        let checked = self.checked(number, request, inputs);
        let before = self.active.behind.inner_type();
        match checked.and_then(|staged| staged.taken(before, switch_inner)) {
            Ok(staged) => {
                self.active = staged;
                self.slot = staged.behind.switched_to(number).0;
                self.tool_jumped = false;
                // The refusal that ended the program stays to be read.
                self.answer(&asked, None);
                if by_itself && self.heartbeat.guard() != Guard::Lost {
                    self.outputs.releases = self.outputs.releases.wrapping_add(1);
                }
                Ok(())
            }
            Err(refusal) => {
                self.refuse(&asked, refusal);
                Err(refusal)
            }
        }
    }

    /// What a switch to `number` would make the active frame.
    pub(super) fn checked(
        &self,
        number: i32,
        request: Option<Request>,
        inputs: &FrameInputs,
    ) -> Result<Staged, FrameRefusal> {
        let request = request.filter(|request| request.number == number);
        if request.as_ref().is_some_and(Request::removes) {
            may_remove(inputs)?;
        } else {
            standing(inputs)?;
        }
        // Another type of the inner kinematics is theirs to answer for.
        match request {
            Some(request) if request.purpose == Purpose::InnerType => offsets_stand(inputs)?,
            _ => same_joints(inputs)?,
        }
        if let Some(request) = request {
            return Ok(request.staged);
        }
        let (slot, behind) = self.active.behind.switched_to(number);
        let behind = match behind {
            Behind::Own(_) => behind.as_on_pins(inputs)?,
            Behind::Inner(_) => behind,
        };
        match slot {
            0 => Staged::new(Source::nothing(), behind, inputs),
            1 | 2 => Staged::new(Source::map_pins(), behind, inputs),
            _ => Err(FrameRefusal::UnknownType),
        }
    }

    /// The answer to a command; nobody waits for one where none was given.
    fn answer(&mut self, request: &Request, refusal: Option<FrameRefusal>) {
        if let Purpose::Command(number) = request.purpose {
            self.outputs.acknowledged = number;
            self.outputs.refusal = refusal;
        }
    }

    /// What motion did not do, or the inner kinematics did not take.
    fn refuse(&mut self, request: &Request, refusal: FrameRefusal) {
        self.answer(request, Some(refusal));
        let wanted = request.staged.behind.inner_type();
        let is_final = matches!(
            refusal,
            FrameRefusal::NotSwitched | FrameRefusal::UnknownInnerType
        );
        if is_final && wanted != self.active.behind.inner_type() {
            self.refused_type = Some((wanted, refusal));
            if refusal == FrameRefusal::UnknownInnerType {
                self.put_back = Some(request.previous);
                self.outputs.switchkins_type = request.previous;
            }
        }
    }

    /// The answer to a command that motion is not asked for.
    fn answer_at_once(&mut self, number: f64, refusal: Option<FrameRefusal>) {
        self.outputs.acknowledged = number;
        self.outputs.refusal = refusal;
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
        // Of a program that has started in a frame that has to go: the guard stops it.
        if self.is_kept_from_going(inputs) && !command.removes() {
            return;
        }
        // It would be given a pose on the way. In motion it is refused at once.
        if standing(inputs).is_ok() && !self.release.is_settled() {
            return;
        }
        match self.commanded(&command, inputs) {
            Err(refusal) => self.answer_at_once(number, Some(refusal)),
            Ok(staged) if self.changes_nothing(&staged) => {
                self.active.source = staged.source;
                self.tool_jumped = false;
                self.answer_at_once(number, None);
            }
            Ok(staged) => match same_joints(inputs) {
                Err(refusal) => self.answer_at_once(number, Some(refusal)),
                Ok(()) => self.ask(staged, Purpose::Command(number)),
            },
        }
    }

    /// What a command makes of the frame.
    pub(super) fn commanded(
        &self,
        command: &Command,
        inputs: &FrameInputs,
    ) -> Result<Staged, FrameRefusal> {
        self.trusted(command, inputs)?;
        if command.suspends() || (command.keeps() && self.is_suspended()) {
            standing(inputs)?;
            let behind = self.behind_on_pins(inputs)?;
            return Ok(Staged::without_frame(self.active.source, behind, inputs));
        }
        if command.adds() && self.is_suspended() {
            return Err(FrameRefusal::Suspended);
        }
        let source = self.active.source.after(command, &inputs.value)?;
        standing(inputs)?;
        let behind = match self.behind_on_pins(inputs) {
            // Whatever the pin says, a frame can go.
            Err(FrameRefusal::UnknownInnerType) if command.removes() => self.active.behind,
            behind => behind?,
        };
        Staged::new(source, behind, inputs)
    }

    /// The frame of now with something else behind it.
    fn again(&self, behind: Behind, inputs: &FrameInputs) -> Result<Staged, FrameRefusal> {
        match self.active.frame {
            Some(_) => Staged::new(
                self.active.source,
                behind,
                &self.active.with_its_work_offset(inputs),
            ),
            None => Ok(Staged::without_frame(self.active.source, behind, inputs)),
        }
    }

    /// A frame is taken off for a while.
    fn is_suspended(&self) -> bool {
        self.active.frame.is_none() && self.active.source.count() > 0
    }

    /// There was no frame, there will be none, and the machine is the same.
    fn changes_nothing(&self, staged: &Staged) -> bool {
        let frames = staged.frame.is_some() || self.active.frame.is_some();
        !frames && self.slot == 0 && staged.behind == self.active.behind
    }

    /// Asks motion for a switch, under a number that differs from the last.
    fn ask(&mut self, staged: Staged, purpose: Purpose) {
        let (last, behind) = self.active.behind.switched_to(self.asked);
        let same = behind.inner_type() == staged.behind.inner_type();
        let slot = match (staged.frame, last) {
            (None, last) if last != 0 || !same => 0,
            (_, 1) => 2,
            _ => 1,
        };
        let number = staged.behind.number(slot);
        self.request = Some(Request {
            staged,
            number,
            previous: self.asked,
            purpose,
            waited: 0,
        });
        self.asked = number;
        self.outputs.switchkins_type = number;
    }

    /// What is behind the frame with the dimensions and the type that the pins say.
    pub(super) fn behind_on_pins(&self, inputs: &FrameInputs) -> Result<Behind, FrameRefusal> {
        let wanted = self.active.behind.as_on_pins(inputs)?;
        match self.refused_type {
            Some((number, refusal)) if number == wanted.inner_type() => Err(refusal),
            _ => Ok(wanted),
        }
    }
}

/// Offsets as operators see them: without a frame they may be anything, and removing a frame must not depend on them.
fn shown<const COUNT: usize>(offsets: &[f64; COUNT]) -> [f64; COUNT] {
    offsets.map(|offset| if offset.is_finite() { offset } else { 0.0 })
}
