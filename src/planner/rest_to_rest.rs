//! The reference of G61.1: each move from rest to rest, as fast as the axes allow.

use super::cell_builder::CellBuilder;
use super::piece::{Piece, Pieces};
use super::reference::{Ahead, Outlook, Reference, ReferencePoint};
use crate::moves::{Move, MoveQueue};
use crate::speed::{JerkLimitedProfile, PathLimits};

/// A cap on the velocity has to rise by more than this factor before a run is planned anew.
const NOTICEABLE_RAISE: f64 = 1.001;

/// Where the operator's slider stands near 0 moves are planned for this share of their feed; the
/// executor holds what is slower.
const LEAST_PLANNED_SHARE: f64 = 0.01;

/// Each move from rest to rest. Where the cap on the velocity rises (feed override above 100 %)
/// the run goes over to a faster one as soon as it is at steady velocity.
#[derive(Debug)]
pub struct RestToRest {
    /// From where the machine is to what was planned last.
    pieces: Pieces,
    /// Seconds that the machine has gone into the first piece.
    elapsed: f64,
    /// Seconds of the last piece that have been handed out.
    frontier: f64,
    /// Serial number of the first move of the reference.
    first: u64,
    /// Serial number of the next move to be planned.
    next: u64,
    cell: CellBuilder,
}

impl RestToRest {
    /// A reference that has not begun.
    pub const fn new() -> Self {
        Self {
            pieces: Pieces::new(),
            elapsed: 0.0,
            frontier: 0.0,
            first: 0,
            next: 0,
            cell: CellBuilder::new(),
        }
    }

    /// Plans the next move. `false` if the reference ends before it.
    fn plan_next(&mut self, outlook: &Outlook) -> bool {
        let Some(queued) = outlook.queue.get(self.next) else {
            return false;
        };
        if self.next != self.first && (queued.wait_for_spindle || outlook.single_move) {
            return false;
        }
        let cap = velocity_cap(queued, outlook);
        let limits = PathLimits::of(&queued.shape, outlook.map, outlook.limits, cap);
        let profile = JerkLimitedProfile::rest_to_rest(queued.shape.length(), &limits);
        // A profile without duration would be a jump. Positive limits never lead to one.
        if !(profile.duration() > 0.0 && profile.duration().is_finite()) {
            return false;
        }
        self.pieces.push(Piece {
            serial: self.next,
            start: 0.0,
            profile,
            duration: profile.duration(),
            cap,
        });
        self.frontier = 0.0;
        self.next += 1;
        true
    }

    /// Lets a faster run take over at the frontier, if the cap has risen and the run is steady
    /// there.
    fn raise(&mut self, outlook: &Outlook) {
        let frontier = self.frontier;
        if self.pieces.is_full() {
            return;
        }
        let Some(piece) = self.pieces.back_mut() else {
            return;
        };
        let Some(queued) = outlook.queue.get(piece.serial) else {
            return;
        };
        let cap = velocity_cap(queued, outlook);
        if cap <= piece.cap * NOTICEABLE_RAISE || piece.profile.steady_time_left(frontier).is_none()
        {
            return;
        }
        // Asked once for each cap, whatever the answer.
        piece.cap = cap;
        let state = piece.profile.state(frontier, frontier);
        let start = piece.start + state.distance;
        let limits = PathLimits::of(&queued.shape, outlook.map, outlook.limits, cap);
        let left = queued.shape.length() - start;
        if let Some(profile) = JerkLimitedProfile::raised(left, state.velocity, &limits) {
            piece.duration = frontier;
            let serial = piece.serial;
            self.pieces.push(Piece {
                serial,
                start,
                profile,
                duration: profile.duration(),
                cap,
            });
            self.frontier = 0.0;
        }
    }
}

impl Default for RestToRest {
    fn default() -> Self {
        Self::new()
    }
}

impl Reference for RestToRest {
    fn restart(&mut self, first: u64) {
        self.pieces.clear();
        self.cell.clear();
        self.elapsed = 0.0;
        self.frontier = 0.0;
        self.first = first;
        self.next = first;
    }

    fn next_cell(&mut self, outlook: &Outlook, budget: &mut usize) -> Ahead {
        loop {
            self.raise(outlook);
            let left = outlook.period - self.cell.filled();
            match self.pieces.back() {
                Some(piece) if self.frontier < piece.duration => {
                    let Some(queued) = outlook.queue.get(piece.serial) else {
                        return Ahead::End;
                    };
                    let to = piece.duration.min(self.frontier + left);
                    let completes = self.frontier + left <= piece.duration;
                    self.cell.add(queued, piece, outlook.map, self.frontier, to);
                    self.frontier = to;
                    if completes && let Some(cell) = self.cell.take() {
                        return Ahead::Cell(cell);
                    }
                }
                _ => {
                    if *budget == 0 || self.pieces.is_full() {
                        return Ahead::Later;
                    }
                    if !self.plan_next(outlook) {
                        return self.end_here();
                    }
                    *budget -= 1;
                }
            }
        }
    }

    /// Between two moves the machine is at rest, so the reference may end at any of them.
    fn end_here(&mut self) -> Ahead {
        let duration = self.cell.filled();
        match self.cell.take() {
            Some(cell) => Ahead::Last { cell, duration },
            None => Ahead::End,
        }
    }

    fn advance(&mut self, queue: &MoveQueue, duration: f64) -> Option<ReferencePoint> {
        self.elapsed += duration;
        while let Some(front) = self.pieces.front()
            && self.pieces.len() > 1
            && self.elapsed >= front.duration
        {
            self.elapsed -= front.duration;
            self.pieces.pop();
        }
        let piece = self.pieces.front()?;
        let shape = &queue.get(piece.serial)?.shape;
        let state = piece.profile.state(self.elapsed, self.elapsed);
        let distance = piece.start + state.distance;
        Some(ReferencePoint {
            serial: piece.serial,
            distance,
            velocity: state.velocity,
            position: shape.position(distance),
        })
    }

    fn end(&self) -> u64 {
        self.next
    }
}

/// What the velocity along a move may not exceed, with the overrides of this moment.
///
/// Overrides below 100 % are not planned for: the executor slows the reference down.
fn velocity_cap(queued: &Move, outlook: &Outlook) -> f64 {
    let scale = if !queued.override_enabled() {
        1.0
    } else if queued.motion_type.is_rapid() {
        outlook.rapid_scale.max(1.0)
    } else {
        outlook.feed_scale.max(1.0)
    };
    let wanted = (queued.feed * scale).min(queued.max_velocity);
    let slider = if queued.shape.is_rotary() {
        queued.max_velocity * outlook.velocity_share
    } else {
        outlook.velocity_limit
    };
    wanted.min(slider.max(wanted * LEAST_PLANNED_SHARE))
}
