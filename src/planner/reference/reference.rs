//! The trajectory through the queued moves.

use super::cell_builder::CellBuilder;
use super::move_feeder::MoveFeeder;
use super::reference_segment::ReferenceSegments;
use super::rest_to_rest::RestToRest;
use crate::axes::Axes;
use crate::cycle::Cell;
use crate::path::{BlendSettings, BlendedPath};

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
    /// It is at rest and does not know yet how to go on. Ask again in the next cycle, or
    /// [end there](Reference::end_here).
    Later,
}

/// Where the machine is on the reference.
#[derive(Clone, Copy, Debug)]
pub struct ReferencePoint {
    /// Serial number of the move, see [`MoveQueue::get`].
    pub serial: u64,
    /// What F will count until the end of the move.
    pub distance_to_go: f64,
    /// Speed by reference time along the path, units of the measure per second.
    pub velocity: f64,
    /// Position, shape (9).
    pub position: Axes,
}

/// Where the machine came to rest.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    /// Serial number of the first move that is not finished.
    pub next: u64,
    /// Position, shape (9): at the end of a move exactly its end.
    pub position: Axes,
}

/// The trajectory through the queued moves. About 10 MB, without a heap.
#[derive(Debug)]
pub struct Reference {
    pub(super) path: BlendedPath,
    pub(super) feeder: MoveFeeder,
    /// The run that is handed out or comes next, and the one behind it.
    pub(super) runs: [RestToRest; 2],
    /// Whether the second of [`Self::runs`] is the current one.
    pub(super) swapped: bool,
    /// Whether it is the turn of the other run to be worked on: every second period.
    pub(super) serves_next: bool,
    /// Whether the machine goes back along the path.
    pub(super) backwards: bool,
    /// Whether the machine comes to rest at the end of each move, wherever in one it began.
    pub(super) step_by_step: bool,
    /// Whether joints have limits, which bend where the path does not.
    pub(super) bends: bool,
    /// Whether there is a path at all.
    pub(super) active: bool,
    /// Whether what was handed out ends at rest, at [`Self::rest`].
    pub(super) resting: bool,
    /// Path distance.
    pub(super) rest: f64,
    /// From where the machine is to what was handed out last.
    pub(super) segments: ReferenceSegments,
    /// Seconds that the machine has gone into the first segment.
    pub(super) elapsed: f64,
    /// Seconds of the last segment that have been handed out.
    pub(super) frontier: f64,
    pub(super) cell: CellBuilder,
    /// Where the servo period began that was handed out last: the number of its first segment, and how many
    /// seconds of it had been handed out before.
    pub(super) cell_start: (u64, f64),
    /// Hands out nothing more.
    #[cfg(test)]
    pub dry: bool,
    /// Hands out servo periods that are no numbers.
    #[cfg(test)]
    pub spoiled: bool,
}

impl Reference {
    /// A reference without moves.
    pub const fn new() -> Self {
        Self {
            path: BlendedPath::new(),
            feeder: MoveFeeder::new(),
            runs: [RestToRest::new(), RestToRest::new()],
            swapped: false,
            serves_next: false,
            backwards: false,
            step_by_step: false,
            bends: false,
            active: false,
            resting: true,
            rest: 0.0,
            segments: ReferenceSegments::new(),
            elapsed: 0.0,
            frontier: 0.0,
            cell: CellBuilder::new(),
            cell_start: (0, 0.0),
            #[cfg(test)]
            dry: false,
            #[cfg(test)]
            spoiled: false,
        }
    }

    /// Drops everything. At rest only.
    pub fn clear(&mut self) {
        self.backwards = false;
        self.step_by_step = false;
        self.active = false;
        self.rested(0.0);
    }

    /// Begins anew: at rest at `position`, shape (9), the start of the move with the serial number
    /// `first`. `single`: comes to rest at the end of this move. `bends`: joints have limits, see [`MachineMap`].
    ///
    /// [`MachineMap`]: crate::machine_map::MachineMap
    pub fn restart(
        &mut self,
        first: u64,
        (single, bends): (bool, bool),
        position: &Axes,
        settings: &BlendSettings,
    ) {
        self.path.restart(settings, position);
        self.feeder.restart(first, single);
        for run in &mut self.runs {
            run.clear();
        }
        self.serves_next = false;
        self.backwards = false;
        self.step_by_step = false;
        self.bends = bends;
        self.active = true;
        self.rested(0.0);
    }

    /// The machine is at rest at path distance `s`; what was handed out is behind it.
    pub(super) fn rested(&mut self, s: f64) {
        self.segments.clear();
        self.cell.clear();
        self.elapsed = 0.0;
        self.frontier = 0.0;
        self.resting = true;
        self.rest = s;
    }

    /// Whether there is a path, begun and not dropped.
    pub fn is_active(&self) -> bool {
        self.active
    }

    /// Whether the reference ends with its first move.
    pub fn is_single(&self) -> bool {
        self.feeder.is_single()
    }

    /// Serial number of the first move that the reference has not taken.
    pub fn end(&self) -> u64 {
        self.feeder.next()
    }

    /// Whether the machine may start. Only asked at rest.
    pub fn is_ready(&self) -> bool {
        let begun = |run: &RestToRest| {
            run.starts_at(self.rest) && (run.may_start(&self.path) || run.may_creep(&self.path))
        };
        self.active && (self.stands_alone(self.rest) || self.runs.iter().any(begun))
    }

    /// Whether there is no plan for what comes next, not even to creep: the path is not a number.
    pub fn is_refused(&self) -> bool {
        self.active && self.runs.iter().any(RestToRest::is_unsound)
    }

    /// Refuses all plans that there are, as if none had been found.
    #[cfg(test)]
    pub fn refuse_all(&mut self) {
        for run in &mut self.runs {
            run.refuse();
        }
    }

    /// Whether the reference rests at the end of what was handed out.
    pub fn is_resting(&self) -> bool {
        self.resting
    }
}

impl Default for Reference {
    fn default() -> Self {
        Self::new()
    }
}
