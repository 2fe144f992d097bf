//! M functions beside a motion.
//!
//! LinuxCNC executes those of a line before its motion. Controls switch off and change tools when the motion is
//! over, or together with it, as the builder of the machine has it: behind it the spindle turns and the coolant
//! runs a block longer, before it the tool would cut without them, or be changed down in the part.

use super::words::At;
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::moves::MoveKind;
use crate::program::{Action, Coolant, Spindle};
use crate::source::Span;
use std::ops::Range;

/// Which M functions of a block wait for the end of its motion. M6 always does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Waiting {
    /// M5, M9 and M19.
    #[default]
    SwitchesOff,
    /// M9 and M19: M5 acts before the motion.
    AllButStop,
    /// None of them.
    Nothing,
}

/// The M functions of the block that runs.
#[derive(Clone, Debug, Default)]
pub(super) struct Functions {
    waiting: Waiting,
    /// M6.
    tool_change: Option<Span>,
    /// Whether the block names a tool offset too.
    has_offset: bool,
    /// What they do, among the actions of the block.
    actions: Range<usize>,
    /// How the spindle turned before them.
    spindle: Option<Spindle>,
    /// Whether the spindle stands when the motion is over.
    stops: bool,
}

impl Functions {
    fn waits(&self, action: &Action) -> bool {
        match action {
            Action::Spindle(Spindle::Stop) => self.waiting == Waiting::SwitchesOff,
            Action::Coolant(Coolant::Off) | Action::Orient(..) => self.waiting != Waiting::Nothing,
            _ => false,
        }
    }
}

impl Control<'_> {
    /// The M functions of a block are about to be carried out. `has_offset`: whether it names a tool offset.
    pub fn begin_functions(&mut self, list: &[At<u32>], waiting: Waiting, has_offset: bool) {
        let tool_change = list.iter().find(|m| m.value == 6);
        self.functions = Functions {
            waiting,
            tool_change: tool_change.map(|m| m.span),
            has_offset,
            actions: self.actions.len()..self.actions.len(),
            spindle: self.modal.spindle,
            stops: false,
        };
    }

    /// They have been: the motion of the block may follow. Until it is over the spindle turns on.
    pub fn hold_functions(&mut self) {
        self.functions.actions.end = self.actions.len();
        let functions = &mut self.functions;
        let switched = self.actions[functions.actions.clone()].iter().rev();
        let mut switched = switched.filter_map(|action| match action {
            Action::Spindle(spindle) => Some(*spindle),
            _ => None,
        });
        let stops = switched.next() == Some(Spindle::Stop);
        if stops && functions.waiting == Waiting::SwitchesOff && functions.tool_change.is_none() {
            functions.stops = true;
            self.modal.spindle = switched.next().or(functions.spindle);
        }
    }

    /// The block is over: what waits for the end of its motion is put there. Without a motion everything stays
    /// in its order.
    ///
    /// # Errors
    ///
    /// The tool is changed beside a motion that is no retraction.
    pub fn end_functions(&mut self) -> Done {
        let functions = self.take_functions();
        let Range { start, end } = functions.actions.clone();
        let behind = self.actions.get(end..).unwrap_or_default();
        let Some(first) = behind.iter().position(is_motion) else {
            return Ok(());
        };
        if let Some(span) = functions.tool_change {
            let retracts = |action: &Action| !is_motion(action) || is_of_machine(action);
            if functions.has_offset || !behind.iter().all(retracts) {
                return Err(refusal(&behind[first], span));
            }
            let states = |action: &mut Action| is_of_tool(action);
            let mut later: Vec<Action> = Vec::new();
            later.extend(self.actions.extract_if(end..end + first, states));
            let functions: Vec<Action> = self.actions.drain(start..end).collect();
            self.actions.extend(functions);
            self.actions.append(&mut later);
            return Ok(());
        }
        let waits = |action: &mut Action| functions.waits(action);
        let later: Vec<Action> = self.actions.extract_if(start..end, waits).collect();
        self.actions.extend(later);
        Ok(())
    }

    /// Nothing waits any more.
    pub(super) fn take_functions(&mut self) -> Functions {
        let functions = std::mem::take(&mut self.functions);
        if functions.stops {
            self.modal.spindle = Some(Spindle::Stop);
        }
        functions
    }
}

fn is_motion(action: &Action) -> bool {
    matches!(action, Action::Move(_) | Action::ToolNormal) || is_of_machine(action)
}

/// Whether it is a motion in coordinates of the machine.
fn is_of_machine(action: &Action) -> bool {
    match action {
        Action::Move(motion) => matches!(motion.kind, MoveKind::Machine { .. }),
        Action::RotaryZero | Action::Retract(_) => true,
        _ => false,
    }
}

/// Whether it is an offset that follows from the tool.
fn is_of_tool(action: &Action) -> bool {
    matches!(
        action,
        Action::ToolLength(_)
            | Action::ToolOffset(_)
            | Action::RadiusRow(_)
            | Action::CutterDiameter(_)
    )
}

/// M6 beside this motion.
fn refusal(motion: &Action, span: Span) -> Diagnostic {
    let name = match motion {
        Action::Move(motion) => match motion.kind {
            MoveKind::Rapid => "a rapid motion",
            MoveKind::Line => "a motion with feed",
            MoveKind::Arc(_) => "an arc",
            MoveKind::Thread { .. } => "a thread",
            MoveKind::Tap { .. } => "a tap",
            MoveKind::Machine { .. } => "a tool offset and a motion in machine coordinates",
        },
        _ => "a motion of the rotary axes",
    };
    Diagnostic::error(
        span,
        format!("M6 beside {name}: which of them the machine does first is not known"),
    )
    .help("write two blocks, in the order in which the machine does them")
}
