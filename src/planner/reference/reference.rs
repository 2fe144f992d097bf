//! The trajectory through the queued moves.

use super::cell_builder::{CellBuilder, Ground};
use super::outlook::Outlook;
use super::piece::{Law, MoveLaw, Piece, Pieces};
use super::run::Run;
use super::supply::Supply;
use crate::axes::Axes;
use crate::cycle::Cell;
use crate::moves::MoveQueue;
use crate::path::blend::{BlendError, BlendSettings, BlendedPath};
use crate::speed::{JerkLimitedProfile, PathLimits};

/// Work on the path in [`BUDGET_PERIOD`], kernel terms of 5 ns or so.
const PATH_BUDGET: f64 = 800.0;

/// Work on the speed in [`BUDGET_PERIOD`], units of 20 to 40 ns.
const SPEED_BUDGET: f64 = 300.0;

/// The servo period that the budgets are meant for, seconds. In another one the work of a second is
/// the same ..
const BUDGET_PERIOD: f64 = 1e-3;
/// .. within these shares of the budgets.
const LEAST_SHARE: f64 = 0.25;
const GREATEST_SHARE: f64 = 2.0;

/// When the machine is going to brake to the end of the path within so many seconds, and nothing
/// more has come, the end is final.
const LAST_CALL: f64 = 0.08;

/// A path this near to the end of a move ends there, machine units.
const ROUNDING: f64 = 1e-9;

/// A cap on the velocity has to rise by more than this factor before a move is planned anew.
const NOTICEABLE_RAISE: f64 = 1.001;

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

/// The trajectory through the queued moves. About 4 MB, without a heap.
#[derive(Debug)]
pub struct Reference {
    path: BlendedPath,
    supply: Supply,
    /// The run that is handed out or comes next, and the one behind it.
    runs: [Run; 2],
    /// Whether the second of [`Self::runs`] is the current one.
    swapped: bool,
    /// Whether the other run is worked on in this period.
    turn: bool,
    /// Whether there is a path at all.
    active: bool,
    /// Whether what was handed out ends at rest, at [`Self::rest`].
    resting: bool,
    /// Path distance.
    rest: f64,
    /// From where the machine is to what was handed out last.
    pieces: Pieces,
    /// Seconds that the machine has gone into the first piece.
    elapsed: f64,
    /// Seconds of the last piece that have been handed out.
    frontier: f64,
    cell: CellBuilder,
}

impl Reference {
    /// A reference without moves.
    pub const fn new() -> Self {
        Self {
            path: BlendedPath::new(),
            supply: Supply::new(),
            runs: [Run::new(), Run::new()],
            swapped: false,
            turn: false,
            active: false,
            resting: true,
            rest: 0.0,
            pieces: Pieces::new(),
            elapsed: 0.0,
            frontier: 0.0,
            cell: CellBuilder::new(),
        }
    }

    /// Drops everything. At rest only.
    pub fn clear(&mut self) {
        self.active = false;
        self.rested(0.0);
    }

    /// Begins anew: at rest at `position`, shape (9), the start of the move with the serial number
    /// `first`. `single`: comes to rest at the end of this move.
    pub fn restart(&mut self, first: u64, single: bool, position: &Axes, settings: &BlendSettings) {
        self.path.restart(settings, position);
        self.supply.restart(first, single);
        for run in &mut self.runs {
            run.clear();
        }
        self.active = true;
        self.rested(0.0);
    }

    /// The machine is at rest at path distance `s`; what was handed out is behind it.
    fn rested(&mut self, s: f64) {
        self.pieces.clear();
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
        self.supply.is_single()
    }

    /// Serial number of the first move that the reference has not taken.
    pub fn end(&self) -> u64 {
        self.supply.next()
    }

    /// Whether the machine may start. Only asked at rest.
    pub fn is_ready(&self) -> bool {
        let begun = |run: &Run| run.starts_at(self.rest) && run.is_ready();
        self.active
            && (self.path.move_between_rests(self.rest).is_some() || self.runs.iter().any(begun))
    }

    /// Whether no plan was found for what comes next.
    pub fn is_refused(&self) -> bool {
        self.active && self.runs.iter().any(Run::is_refused)
    }

    fn current(&self) -> &Run {
        let [first, second] = &self.runs;
        if self.swapped { second } else { first }
    }

    fn current_mut(&mut self) -> &mut Run {
        both(&mut self.runs, self.swapped).0
    }

    fn other(&self) -> &Run {
        let [first, second] = &self.runs;
        if self.swapped { first } else { second }
    }

    /// Plans on, a fixed amount of work. Once in each servo period.
    ///
    /// # Errors
    /// A move that cannot be put on the path, which never happens to moves that follow one
    /// another.
    pub fn work(&mut self, outlook: &Outlook) -> Result<(), BlendError> {
        if !self.active {
            return Ok(());
        }
        self.supply.feed(&mut self.path, outlook)?;
        self.end_path();
        let share = (outlook.now.period / BUDGET_PERIOD).clamp(LEAST_SHARE, GREATEST_SHARE);
        self.path.step((PATH_BUDGET * share) as usize);
        self.begin_runs(outlook);
        self.turn = !self.turn;
        let turn = self.turn;
        let (current, other) = both(&mut self.runs, self.swapped);
        current.look_for_stop(&self.path);
        other.look_for_stop(&self.path);
        let worked = if turn && other.is_begun() {
            other
        } else {
            current
        };
        worked.work(&self.path, outlook, (SPEED_BUDGET * share) as u32);
        Ok(())
    }

    /// Where nothing more is to be expected the path may end.
    fn end_path(&mut self) {
        // A line may still wait to be merged with the next one, behind what is known to end at rest.
        let last = self.path.leg_ending_at(self.path.programmed_end());
        let complete = last.is_some_and(|(serial, _)| serial + 1 >= self.supply.next());
        if self.path.rests_at_end() && complete {
            return;
        }
        if self.supply.is_barred() {
            self.path.finish();
        } else if self.supply.is_silent() {
            let last = if self.other().is_begun() {
                self.other()
            } else {
                self.current()
            };
            if last.brakes_within(LAST_CALL) {
                self.path.finish();
            } else {
                self.path.flush();
            }
        }
    }

    /// Begins the runs that are due: from where the reference rests, and from where the run that
    /// is handed out will come to rest.
    fn begin_runs(&mut self, outlook: &Outlook) {
        let s = if self.resting {
            self.rest
        } else {
            match self.current().final_stop(&self.path) {
                Some(stop) => stop,
                None => return,
            }
        };
        if s >= self.path.programmed_end() || self.path.move_between_rests(s).is_some() {
            return;
        }
        if self.other().starts_at(s) || self.resting && self.current().starts_at(s) {
            return;
        }
        let (current, other) = both(&mut self.runs, self.swapped);
        let due = if self.resting { current } else { other };
        due.begin(s, outlook);
    }

    /// Hands out the next servo period and freezes it. After [`Ahead::Last`] and [`Ahead::End`] it
    /// is not called before the machine has [come to rest](Self::come_to_rest).
    pub fn next_cell(&mut self, outlook: &Outlook, budget: &mut usize) -> Ahead {
        loop {
            self.raise(outlook);
            let left = outlook.now.period - self.cell.filled();
            match self.pieces.back() {
                Some(piece) if self.frontier < piece.duration => {
                    let to = piece.duration.min(self.frontier + left);
                    let completes = self.frontier + left <= piece.duration;
                    let ground = Ground {
                        path: &self.path,
                        queue: outlook.queue,
                        map: outlook.map,
                    };
                    self.cell.add(piece, &ground, self.frontier, to);
                    self.frontier = to;
                    if completes && let Some(cell) = self.cell.take() {
                        return Ahead::Cell(cell);
                    }
                }
                _ => {
                    if *budget == 0 || self.pieces.is_full() || !self.next_piece(outlook) {
                        return if self.is_at_end() {
                            self.end_here()
                        } else {
                            Ahead::Later
                        };
                    }
                    *budget -= 1;
                    self.frontier = 0.0;
                }
            }
        }
    }

    /// Whether the reference rests where the path ends for good.
    fn is_at_end(&self) -> bool {
        self.resting && self.path.rests_at_end() && self.rest >= self.path.programmed_end()
    }

    /// Takes the next piece of the plan. `false` if there is none yet.
    fn next_piece(&mut self, outlook: &Outlook) -> bool {
        if !self.resting {
            if self.push_frozen() {
                return true;
            }
            self.rest = self.current().end();
            self.resting = true;
            self.current_mut().clear();
        }
        if outlook.now.stepping && self.pieces.front().is_some() {
            return false;
        }
        if self.next_move(outlook) {
            return true;
        }
        if !self.current().starts_at(self.rest) {
            self.swapped = !self.swapped;
        }
        let ready = self.current().starts_at(self.rest) && self.current().is_ready();
        if ready && self.push_frozen() {
            self.resting = false;
            return true;
        }
        false
    }

    /// Freezes the next piece of the current run. `false` at its end.
    fn push_frozen(&mut self) -> bool {
        let Some(piece) = self.current_mut().freeze() else {
            return false;
        };
        self.pieces.push(Piece {
            law: Law::Run(piece),
            duration: piece.duration,
        });
        true
    }

    /// Plans a move that stands alone between two rests. `false` if that is not what comes next.
    fn next_move(&mut self, outlook: &Outlook) -> bool {
        let Some((shape, leg)) = self.path.move_between_rests(self.rest) else {
            return false;
        };
        let Some(queued) = outlook.queue.get(leg.serial) else {
            return false;
        };
        let cap = outlook.velocity_cap(queued);
        let limits = PathLimits::of(&shape, outlook.map, outlook.limits, cap);
        let profile = JerkLimitedProfile::rest_to_rest(shape.length(), &limits);
        // A profile without duration would be a jump. Positive limits never lead to one.
        if !(profile.duration() > 0.0 && profile.duration().is_finite()) {
            return false;
        }
        self.pieces.push(Piece {
            law: Law::Move(MoveLaw {
                serial: leg.serial,
                start: leg.start,
                end: leg.end,
                rate: 1.0 / leg.measure_rate,
                profile,
                cap,
            }),
            duration: profile.duration(),
        });
        // The look-ahead may have begun before it was known that the move ends at rest.
        for run in &mut self.runs {
            if run.starts_at(self.rest) {
                run.clear();
            }
        }
        self.rest = leg.end;
        true
    }

    /// Lets a faster profile take over at the frontier, if the cap has risen and the move is
    /// steady there.
    fn raise(&mut self, outlook: &Outlook) {
        let frontier = self.frontier;
        if self.pieces.is_full() {
            return;
        }
        let Some(piece) = self.pieces.back_mut() else {
            return;
        };
        let Law::Move(law) = &mut piece.law else {
            return;
        };
        let Some(queued) = outlook.queue.get(law.serial) else {
            return;
        };
        let cap = outlook.velocity_cap(queued);
        if cap <= law.cap * NOTICEABLE_RAISE || law.profile.steady_time_left(frontier).is_none() {
            return;
        }
        // Asked once for each cap, whatever the answer.
        law.cap = cap;
        let state = law.profile.state(frontier, frontier);
        let start = law.start + law.rate * state.distance;
        let limits = PathLimits::of(&queued.shape, outlook.map, outlook.limits, cap);
        let left = (law.end - start) / law.rate;
        if let Some(profile) = JerkLimitedProfile::raised(left, state.velocity, &limits) {
            let law = MoveLaw {
                start,
                profile,
                ..*law
            };
            piece.duration = frontier;
            self.pieces.push(Piece {
                law: Law::Move(law),
                duration: profile.duration(),
            });
            self.frontier = 0.0;
        }
    }

    /// Comes to rest for good where the reference rests. Only after [`Ahead::Later`]; never
    /// answers with a whole cell or `Later`.
    pub fn end_here(&mut self) -> Ahead {
        let duration = self.cell.filled();
        match self.cell.take() {
            Some(cell) => Ahead::Last { cell, duration },
            None => Ahead::End,
        }
    }

    /// Whether the reference rests at the end of what was handed out.
    pub fn is_resting(&self) -> bool {
        self.resting
    }

    /// Goes on by `duration` seconds, not beyond what was handed out, and says where that is;
    /// `None` if nothing was handed out.
    pub fn advance(&mut self, queue: &MoveQueue, duration: f64) -> Option<ReferencePoint> {
        self.elapsed += duration;
        while let Some(front) = self.pieces.front()
            && self.pieces.len() > 1
            && self.elapsed >= front.duration
        {
            self.elapsed -= front.duration;
            self.pieces.pop();
        }
        let piece = self.pieces.front()?;
        let state = piece.state(self.elapsed, self.elapsed);
        let point = piece.point(&self.path, state.distance);
        self.path.discard_before(state.distance);
        let leg = self.path.leg(state.distance)?;
        let velocity = leg.measure_rate * self.path.distance(&point.first) * state.velocity;
        let (serial, distance_to_go) = self.running(queue, state.distance)?;
        Some(ReferencePoint {
            serial,
            distance_to_go,
            velocity,
            position: point.position,
        })
    }

    /// Serial number of the move at path distance `s`, and what F will count until its end.
    ///
    /// Where lines were merged it is told by their lengths.
    fn running(&self, queue: &MoveQueue, s: f64) -> Option<(u64, f64)> {
        let progress = self.path.progress(s)?;
        let first = progress.first.max(queue.first_serial());
        if first >= progress.serial {
            return Some((progress.serial, progress.distance_to_go));
        }
        let lengths = |from: u64| {
            (from..=progress.serial)
                .filter_map(|serial| queue.get(serial))
                .map(|queued| queued.shape.length())
        };
        // Counted from the end, since the moves at the start may have left the queue.
        let mut left: f64 = lengths(first).sum();
        for serial in first..progress.serial {
            let length = queue.get(serial)?.shape.length();
            if progress.distance_to_go > left - length {
                return Some((serial, progress.distance_to_go - (left - length)));
            }
            left -= length;
        }
        Some((progress.serial, progress.distance_to_go.min(left)))
    }

    /// The machine has come to the end of what was handed out, at rest.
    pub fn come_to_rest(&mut self) -> Rest {
        let s = self.rest;
        let before = self.path.point_before(s);
        let rest = match self.path.leg_ending_at(s) {
            Some((serial, end)) => Rest {
                next: serial + 1,
                // Within a rounded corner the path does not come by the end of the move.
                position: if (end - before.position).amax() < ROUNDING {
                    end
                } else {
                    before.position
                },
            },
            None => Rest {
                next: self
                    .path
                    .leg(s)
                    .map_or(self.supply.next(), |leg| leg.serial),
                position: before.position,
            },
        };
        self.rested(s);
        if rest.next >= self.supply.next() {
            self.active = false;
        }
        rest
    }
}

/// The current run, and the other one.
fn both(runs: &mut [Run; 2], swapped: bool) -> (&mut Run, &mut Run) {
    let [first, second] = runs;
    if swapped {
        (second, first)
    } else {
        (first, second)
    }
}

impl Default for Reference {
    fn default() -> Self {
        Self::new()
    }
}
