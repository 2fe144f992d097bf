//! A run: from rest to rest along the path, planned by the look-ahead.

use super::creep;
use super::outlook::Outlook;
use super::path_route::PathRoute;
use super::reference_segment::ProfiledMotion;
use super::return_route::{ReturnRoute, may_go_back};
use super::running_move::end_of_merged_line;
use crate::moves::{MoveQueue, Synchronisation};
use crate::path::BlendedPath;
use crate::speed::look_ahead::{LookAhead, PlanEnd, PlanProgress, PlanRefusal, PlannedSegment};

/// Vertices that are looked at in a cycle, in search of the end of the run.
const VERTICES_A_CYCLE: usize = 64;

/// Seconds before the braking to an end that is to be moved on, at which the plan is still as easy
/// to continue as anywhere else.
const CONTINUED_BEFORE: f64 = 24e-3;

/// Seconds that a plan which ends too soon is waited for at most.
const LONGEST_WAIT: f64 = 0.06;

/// A run, and where it ends as far as that is known.
#[derive(Debug)]
pub(super) struct RestToRest {
    speed: LookAhead,
    /// Whether it leads back along the path: the look-ahead then sees path distance with the other
    /// sign.
    backwards: bool,
    /// Whether it ends with the move that it begins in, on the way on.
    ends_with_move: bool,
    /// Where it starts, path distance; `None` if there is no run.
    start: Option<f64>,
    /// Where the machine has to come to rest.
    stop: Option<f64>,
    /// Up to here no stop was found.
    searched: f64,
    /// Seconds since there is a plan.
    ready_for: f64,
}

impl RestToRest {
    pub const fn new() -> Self {
        Self {
            speed: LookAhead::new(),
            backwards: false,
            ends_with_move: false,
            start: None,
            stop: None,
            searched: 0.0,
            ready_for: 0.0,
        }
    }

    /// There is no run.
    pub fn clear(&mut self) {
        self.start = None;
    }

    /// Begins a run at rest at `s`, on or back along the path.
    pub fn begin(&mut self, s: f64, backwards: bool, outlook: &Outlook) {
        self.backwards = backwards;
        self.ends_with_move = false;
        self.speed.start(
            self.signed(s),
            outlook.limits,
            outlook.map,
            outlook.now.period,
        );
        self.start = Some(s);
        self.stop = None;
        self.searched = s;
        self.ready_for = 0.0;
    }

    /// The machine comes to rest at the end of the move that the run begins in. Right behind [`Self::begin`]; on the way
    /// back it means nothing.
    pub fn end_with_move(&mut self) {
        self.ends_with_move = !self.backwards;
    }

    /// Path distance as the look-ahead sees it, and back.
    fn signed(&self, s: f64) -> f64 {
        if self.backwards { -s } else { s }
    }

    /// Whether there is a run.
    pub fn is_begun(&self) -> bool {
        self.start.is_some()
    }

    /// Whether there is a run from `s` on.
    pub fn starts_at(&self, s: f64) -> bool {
        self.start == Some(s)
    }

    /// Whether there is a plan that may be run.
    pub fn is_ready(&self) -> bool {
        self.is_begun() && self.speed.progress() == PlanProgress::Ready
    }

    /// Whether the first plan waits for more of the path.
    pub fn waits_for_path(&self) -> bool {
        self.is_begun() && self.speed.waits_for_path()
    }

    /// Whether the machine, at rest, may begin with the plan: one that ends at once for now is given
    /// some time to be continued.
    pub fn may_start(&self, path: &BlendedPath) -> bool {
        self.is_ready() && (self.ready_for >= LONGEST_WAIT || !self.brakes_for_now(path))
    }

    /// Whether no plan was found.
    fn is_refused(&self) -> bool {
        self.is_begun() && matches!(self.speed.progress(), PlanProgress::Refused(_))
    }

    /// Whether no plan was found, nor will be one to creep.
    pub fn is_unsound(&self) -> bool {
        self.is_begun() && self.speed.progress() == PlanProgress::Refused(PlanRefusal::Unsound)
    }

    /// Whether the machine, at rest, may begin to creep where no plan was found.
    pub fn may_creep(&self, path: &BlendedPath) -> bool {
        let known = if self.backwards {
            self.signed(self.searched)
        } else {
            path.final_end()
        };
        self.is_refused() && self.start.is_some_and(|start| known > self.signed(start))
    }

    /// How to creep where no plan was found, see [`creep::motion`].
    pub fn creep(&self, path: &BlendedPath, outlook: &Outlook) -> Option<ProfiledMotion> {
        let start = self.start.filter(|_| self.is_refused())?;
        if self.backwards {
            creep::motion(&self.way_back(path), -start, outlook)
        } else {
            creep::motion(&self.way_on(path), start, outlook)
        }
    }

    /// Refuses the plan as if none had been found.
    #[cfg(test)]
    pub fn refuse(&mut self) {
        self.speed.refuse();
    }

    fn way_on<'a>(&self, path: &'a BlendedPath) -> PathRoute<'a> {
        let stop = self.stop.unwrap_or(f64::INFINITY);
        PathRoute { path, stop }
    }

    fn way_back<'a>(&self, path: &'a BlendedPath) -> ReturnRoute<'a> {
        ReturnRoute {
            path,
            end: self.searched,
            complete: self.stop.is_some(),
        }
    }

    /// Whether the machine is to begin to brake to rest within `seconds`, as far as the plan goes.
    pub fn brakes_within(&self, seconds: f64) -> bool {
        !self.is_ready() || self.speed.brakes_within(seconds)
    }

    /// Whether the machine is soon to brake to an end of the plan that is not the end of the run.
    pub fn brakes_for_now(&self, path: &BlendedPath) -> bool {
        let final_stop = self.final_stop(path);
        let provisional = |stop| self.signed(self.end()) < self.signed(stop);
        final_stop.is_none_or(provisional) && self.brakes_within(CONTINUED_BEFORE)
    }

    /// Where the machine will come to rest for sure, if that is known and final.
    pub fn final_stop(&self, path: &BlendedPath) -> Option<f64> {
        self.stop
            .filter(|stop| self.backwards || path.final_end() >= *stop)
    }

    /// Whether a place was found where the machine has to come to rest, without a move that is yet to come.
    pub fn has_stop(&self, path: &BlendedPath) -> bool {
        // At the end of a move as such the path is not final before it is known how it goes on.
        if self.ends_with_move {
            self.final_stop(path).is_some()
        } else {
            self.stop.is_some()
        }
    }

    /// The next segment of the plan, which stays as it is; `None` at its end.
    pub fn freeze(&mut self) -> Option<PlannedSegment> {
        self.speed.freeze()
    }

    /// Where the plan ends so far.
    pub fn end(&self) -> f64 {
        self.signed(self.speed.end())
    }

    /// Up to where there is a plan, or where it is to begin; `None` if there is no run.
    pub fn planned(&self) -> Option<f64> {
        let start = self.start?;
        Some(if self.is_ready() { self.end() } else { start })
    }

    /// Goes on with the sum of how long the plan takes. Once in each servo period.
    pub fn sum_time(&mut self) {
        if self.is_begun() {
            self.speed.sum_time();
        }
    }

    /// Where the plan comes to rest, as it was summed last, and how long it is until then from what has been handed out,
    /// seconds; `None` before it was.
    pub fn planned_end(&self) -> Option<PlanEnd> {
        let end = self.speed.planned_end().filter(|_| self.is_ready())?;
        Some(PlanEnd {
            time: (end.time - self.speed.frozen_time()).max(0.0),
            place: self.signed(end.place),
        })
    }

    /// Looks where the path asks for a rest.
    pub fn look_for_stop(&mut self, path: &BlendedPath, queue: &MoveQueue) {
        if !self.is_begun() {
            return;
        }
        for _ in 0..VERTICES_A_CYCLE {
            if self.stop.is_some() {
                return;
            }
            if self.backwards {
                self.look_back(path, queue);
                continue;
            }
            if self.ends_with_move && self.starts_at(self.searched) {
                self.stop = end_of_merged_line(path, queue, self.searched);
                if self.stop.is_some() {
                    return;
                }
            }
            match path.vertex_after(self.searched) {
                Some(vertex) => {
                    self.searched = vertex.s;
                    let ends = self.ends_with_move && path.leg_ending_at(vertex.s).is_some();
                    self.stop = (vertex.stop || ends).then_some(vertex.s);
                }
                None => {
                    let end = path.programmed_end();
                    if path.rests_at_end() && end > self.searched {
                        self.stop = Some(end);
                    }
                    return;
                }
            }
        }
    }

    /// The same for the next vertex on the way back.
    fn look_back(&mut self, path: &BlendedPath, queue: &MoveQueue) {
        let leg = may_go_back(path, queue, self.searched);
        let vertex = leg.and_then(|_| path.vertex_before(self.searched));
        match vertex {
            Some(vertex) => {
                self.searched = vertex.s;
                self.stop = vertex.stop.then_some(vertex.s);
            }
            None => self.stop = Some(self.searched),
        }
    }

    /// What the program's speeds are multiplied by in the plan, 1 and above.
    pub fn raised(&self) -> f64 {
        self.speed.raised()
    }

    /// Works on the plan for `budget` units.
    pub fn work(&mut self, path: &BlendedPath, outlook: &Outlook, budget: u32) {
        if !self.is_begun() {
            return;
        }
        self.speed.raise(outlook.now.feed_scale);
        let asked = outlook.asked_over_planned();
        if asked > self.speed.raised() {
            // A spindle that goes on to become faster does not ask anew in each period.
            self.speed.raise(Synchronisation::RESERVE * asked);
        }
        if self.backwards {
            let route = self.way_back(path);
            self.speed.slice(&route, budget);
        } else {
            let route = self.way_on(path);
            let progress = self.speed.slice(&route, budget);
            if progress == PlanProgress::Ready {
                self.ready_for += outlook.now.period;
            }
        }
    }
}
