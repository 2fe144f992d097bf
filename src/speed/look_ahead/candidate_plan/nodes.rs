//! The nodes of a candidate: arcs at rest, and the grid in between.

use super::super::context::PlanContext;
use super::super::feature::GROWTH;
use super::super::grid::GridStep;
use super::super::refusal::PlanRefusal;
use super::super::rest_arc::free_length;
use super::super::rest_arc_search::{ArcStep, RestArcSearch};
use super::super::route::Route;
use super::super::spline::{SampleBanks, SplineInterval};
use super::{CandidatePhase, CandidatePlan, refused};

/// How many times its length an interval is away from the rest if that has no influence on it.
const NODES_BEFORE_REST: f64 = 6.0;

/// How many times its length the start of the last interval that is kept is away from the arc at least.
const ROOM_BEFORE_ARC: f64 = 3.0;

/// Room for the intervals before the rest of a candidate that grew too long, of that before.
const MORE_ROOM: usize = 2;

/// Nodes that the sweeps need.
const LEAST_NODES: usize = 3;

impl CandidatePlan {
    pub(super) fn search_start<R: Route>(&self, context: &PlanContext<R>) -> CandidatePhase {
        CandidatePhase::StartArc(RestArcSearch::from_rest(
            context,
            self.spline.start,
            self.most_start,
        ))
    }

    pub(super) fn search_end<R: Route>(&self, context: &PlanContext<R>) -> CandidatePhase {
        CandidatePhase::EndArc(RestArcSearch::to_rest(
            context,
            self.spline.end,
            self.most_end,
        ))
    }

    pub(super) fn step_start_arc<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        mut search: RestArcSearch,
    ) -> CandidatePhase {
        match search.advance(context) {
            ArcStep::More => CandidatePhase::StartArc(search),
            ArcStep::Failed => refused(PlanRefusal::NoRest),
            ArcStep::Found(arc) => {
                self.spline.start_arc = arc;
                self.search_end(context)
            }
        }
    }

    pub(super) fn step_end_arc<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &mut SampleBanks,
        mut search: RestArcSearch,
    ) -> CandidatePhase {
        match search.advance(context) {
            ArcStep::More => CandidatePhase::EndArc(search),
            ArcStep::Failed => refused(PlanRefusal::NoRest),
            ArcStep::Found(arc) => {
                self.spline.end_arc = arc;
                self.begin_grid(context, samples)
            }
        }
    }

    /// Gives the node at the cut its place and sample, in the bank that the plan does not use.
    pub(super) fn begin_grid<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &mut SampleBanks,
    ) -> CandidatePhase {
        self.leave_room_for_arc();
        let from = self.grid_from;
        let bank = context.plan.at(from).bank ^ 1;
        if from > self.cut {
            let SplineInterval { start, length, .. } = *self.spline.at(from);
            let sample = context.rows.sample(context.route, start, length);
            samples.place_mut(&self.spline, from).start = sample;
        } else if self.first {
            let length = self.spline.start_arc.length;
            let start = self.spline.start + length;
            *self.spline.at_mut(0) = SplineInterval {
                start,
                length: GROWTH * length,
                ..SplineInterval::NONE
            };
            *self.spline.at_mut(1) = SplineInterval {
                start,
                bank,
                ..SplineInterval::NONE
            };
            let sample = context.rows.sample(context.route, start, 0.0);
            if !sample.is_sound() {
                return refused(PlanRefusal::Unsound);
            }
            samples.place_mut(&self.spline, 1).start = sample;
        } else {
            let SplineInterval { start, length, .. } = *context.plan.at(from);
            let sample = context.rows.sample(context.route, start, length);
            self.spline.at_mut(from).start = start;
            self.spline.at_mut(from).bank = bank;
            samples.place_mut(&self.spline, from).start = sample;
        }
        self.grid.restart(context, &self.spline, from);
        CandidatePhase::Grid
    }

    pub(super) fn step_grid<R: Route>(
        &mut self,
        context: &PlanContext<R>,
        samples: &mut SampleBanks,
    ) -> CandidatePhase {
        match self.grid.advance(context, &mut self.spline, samples) {
            GridStep::More if self.grid.reached() > self.cut + self.most => self.shorten(context),
            GridStep::More => CandidatePhase::Grid,
            GridStep::TooLong => refused(PlanRefusal::TooLong),
            GridStep::TooFine => refused(PlanRefusal::NotFound),
            GridStep::Unsound => refused(PlanRefusal::Unsound),
            // So short that the arcs leave hardly anything between them.
            GridStep::Done if self.spline.last < LEAST_NODES => refused(PlanRefusal::NotFound),
            GridStep::Done => {
                if self.first {
                    let length = self.spline.at(1).length;
                    self.spline.at_mut(0).length = length;
                }
                // Bounds of intervals that were kept are known.
                let kept = if self.bounded && self.grid_from > self.cut {
                    self.grid_from - 1
                } else {
                    0
                };
                CandidatePhase::Bounds(kept.max(self.base - 1))
            }
        }
    }

    /// Keeps the nodes that the rest at the end has no influence on: where it is approached the
    /// spacing is [`GROWTH`] of the distance from it, however long its arc is. `count` nodes behind
    /// the cut are known.
    pub(super) fn keep_nodes(&mut self, count: usize) {
        let end = self.spline.end;
        let mut from = self.cut;
        for _ in 0..count {
            let interval = self.spline.at(from);
            let left = end - interval.start - interval.length;
            if interval.near_end || left < NODES_BEFORE_REST * interval.length {
                break;
            }
            from += 1;
        }
        self.grid_from = from;
    }

    /// Drops nodes that were kept and lie on the arc to rest, or hardly before it.
    fn leave_room_for_arc(&mut self) {
        let end = self.spline.end - self.spline.end_arc.length;
        for _ in self.cut..self.grid_from {
            let before = self.spline.at(self.grid_from - 1);
            if end - before.start >= ROOM_BEFORE_ARC * before.length {
                break;
            }
            self.grid_from -= 1;
        }
    }

    /// Ends the candidate where the grid has come to, and leaves more room for the intervals before its rest. With the
    /// same room one that has a short arc at its end came to be a little shorter each time, and was given up.
    pub(super) fn shorten<R: Route>(&mut self, context: &PlanContext<R>) -> CandidatePhase {
        if let Some(refused) = self.again() {
            return refused;
        }
        let end = self.spline.at(self.cut + self.enough).start;
        self.spline.end = end;
        let total = end - self.spline.at(self.cut).start;
        self.most_end = free_length(context.route, end, total);
        self.keep_nodes(self.enough);
        self.most = self.enough + MORE_ROOM * (self.most - self.enough);
        self.bounded = false;
        self.search_end(context)
    }
}
