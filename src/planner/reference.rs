//! The seam between what is planned ahead and the servo cycle.

use crate::axes::{Axes, AxisLimits, MachineMap};
use crate::cycle::Cell;
use crate::moves::MoveQueue;

/// What a reference has to know while it is extended.
#[derive(Clone, Copy, Debug)]
pub struct Outlook<'a> {
    /// The moves there are.
    pub queue: &'a MoveQueue,
    /// What the axes of the machine are able to do now.
    pub limits: &'a AxisLimits,
    /// How the axes of the program lie to those of the machine.
    pub map: &'a MachineMap,
    /// Duration of a cell, seconds.
    pub period: f64,
    /// The feed override in effect, 0 and above.
    pub feed_scale: f64,
    /// The rapid override in effect, 0 and above.
    pub rapid_scale: f64,
    /// What no move may exceed along its path, machine units per second: the operator's slider.
    pub velocity_limit: f64,
    /// The same as a share of the slider's whole range, for moves measured in degrees.
    pub velocity_share: f64,
    /// Whether the reference has to end where the move ends that it has come to.
    pub single_move: bool,
}

/// What a reference has to offer when the executor asks for more of it.
#[derive(Clone, Copy, Debug)]
pub enum Ahead {
    /// One more servo period.
    Cell(Cell),
    /// The last period: the reference comes to rest after `duration` seconds of it, and stays.
    Last {
        /// The period; at rest after `duration`.
        cell: Cell,
        /// Greater than 0, less than the period of a cell.
        duration: f64,
    },
    /// The reference came to rest at the end of the period before, and stays.
    End,
    /// Nothing yet: the budget is spent at the end of a move. Ask again in the next cycle, or
    /// [end there](Reference::end_here).
    Later,
}

/// Where the machine is on the reference.
#[derive(Clone, Copy, Debug)]
pub struct ReferencePoint {
    /// Serial number of the move, see [`MoveQueue::get`].
    pub serial: u64,
    /// Distance travelled in the move, in its measure.
    pub distance: f64,
    /// Speed by reference time along the path, units of the measure per second.
    pub velocity: f64,
    /// Position, shape (9).
    pub position: Axes,
}

/// A trajectory through the queued moves, in a time of its own that starts at 0.
///
/// What is true of every reference: it keeps the limits of the axes; what it has handed out as
/// cells never changes; and wherever the queue ends it comes to rest, so that the executor can
/// finish what it was given whether or not more moves arrive.
pub trait Reference {
    /// Begins anew: at rest at the start of the move with this serial number.
    fn restart(&mut self, first: u64);

    /// Hands out the next servo period and freezes it. At most `budget` moves are planned; what
    /// was planned is taken off. After [`Ahead::Last`] and [`Ahead::End`] it is not called before
    /// the next restart.
    fn next_cell(&mut self, outlook: &Outlook, budget: &mut usize) -> Ahead;

    /// Comes to rest for good at the end of the move that was handed out last. Only after
    /// [`Ahead::Later`]; never answers with a whole cell or `Later`.
    fn end_here(&mut self) -> Ahead;

    /// Goes on by `duration` seconds, not beyond what was handed out, and says where that is;
    /// `None` if nothing was handed out since the restart.
    fn advance(&mut self, queue: &MoveQueue, duration: f64) -> Option<ReferencePoint>;

    /// Serial number of the first move that the reference does not hold.
    fn end(&self) -> u64;
}
