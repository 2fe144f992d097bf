//! When a frame has to go without a command.

use super::heartbeat::Guard;
use super::pins::FrameInputs;

/// Periods in which motion has to have stood: its interpolator runs on over four points, and a switch before would take
/// a pose on the way for the last one.
pub const SETTLED: u32 = 4;

/// Whether the frame has to go, from what the pins have said so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameRelease {
    /// `framekins.command` in the period before.
    command: f64,
    due: bool,
    /// An abort, machine off, or the guard: what is suspended is not to come back either.
    ended: bool,
    /// for how many periods motion has allowed it
    standing: u32,
}

impl FrameRelease {
    /// One servo period. `framed`: a frame is in force, or motion has been asked for one; `standing`: motion allows it to
    /// be removed.
    ///
    /// A guard that is lost removes nothing by itself, or a program that dwells would lose its frame: the machine is
    /// switched off for it, and then the frame goes.
    pub fn watch(&mut self, inputs: &FrameInputs, guard: Guard, framed: bool, standing: bool) {
        let aborted = inputs.command == 0.0 && self.command != 0.0;
        self.command = inputs.command;
        self.ended = inputs.release || (inputs.release_on_abort && (aborted || !inputs.enabled));
        self.standing = if standing {
            self.standing.saturating_add(1)
        } else {
            0
        };
        let lost = guard == Guard::Lost && !inputs.enabled;
        self.due = framed && (self.due || self.ended || lost);
    }

    /// Whether motion has stood for so long that a switch takes the pose that was reached.
    pub fn is_settled(&self) -> bool {
        self.standing >= SETTLED
    }

    /// Whether motion has stood for more than so many periods.
    pub fn stands_for(&self, periods: u32) -> bool {
        self.standing > periods
    }

    /// Whether the frame has to go and can.
    pub fn is_ripe(&self) -> bool {
        self.due && self.is_settled()
    }

    /// Whether the frame has to go as soon as motion allows it.
    pub fn is_due(&self) -> bool {
        self.due
    }

    /// Whether operations that are kept for a suspended frame are to be forgotten. `busy`: a frame is in force, or a
    /// switch is under way.
    pub fn drops_the_rest(&self, busy: bool) -> bool {
        self.ended && !busy
    }
}
