//! Chooses the widths of all vertices while the path grows, in small steps of bounded work.
//!
//! There are always two assignments of widths. The *stored* one is in force: it keeps the
//! tolerance everywhere, and leaves the programmed path alone at the end of what is known. The
//! *trial* one takes the path as far as it has grown since, at the widths that would be best. It
//! is [checked leg by leg](checking); the vertices that are to blame for a violation are narrowed and their legs
//! checked again. When all is within the tolerance it takes the place of the stored one, at once.
//! Beside what is final they may [go back](beside_final) to what is in force.
//! When that fails, or takes too much work, the stored one stays and the new vertices are
//! hardened (see there), until the next trial: where no more of the path comes, there is one without.
//!
//! Vertices become final from the oldest on, as soon as what is yet to come is beyond their reach.

use super::base_width;
mod beside_final;
mod checking;

use super::chain::{Chain, NEIGHBOURS};
use super::deviation::{EndDeviation, GREATEST_COST};
use super::hardening::{self, ATTEMPTS};
use super::leg_check::LegCheck;
use super::metric::Metric;
use super::reaching::Reaching;
use super::settings::BlendSettings;
use super::widths::Widths;
use super::window::Window;

/// Path that has to come, in design widths, before widths are chosen anew.
const CHUNK: f64 = 0.18;

/// Vertices that have to come at most.
const GREATEST_CHUNK: u64 = 16;

/// So many are taken at a time where more have come: a trial checks as many legs before the new ones as well, and more.
const MOST_AT_A_TIME: u64 = NEIGHBOURS;

/// A vertex so many behind the newest is final whatever comes.
const GREATEST_OPEN: u64 = 48;

/// Distance of what is yet to come from the edge of a final kernel, in design widths.
const LAG: f64 = 0.5;

/// Kernel terms that a trial may take in its checks, and half as many in its base widths.
const GREATEST_TRIAL: usize = 200_000;

/// The most kernel terms by which a call of
/// [`BlendedPath::step`](super::BlendedPath::step) exceeds its budget.
pub const GREATEST_EXCESS: usize = 2 * GREATEST_COST + 4 * NEIGHBOURS as usize;

#[derive(Clone, Copy, Debug)]
enum OptimizerPhase {
    /// No trial at hand.
    Idle,
    /// Looks for the base width of this vertex.
    Widen(u64),
    /// Gives this vertex its trial widths.
    Assign(u64),
    /// Checks this leg.
    Check(u64),
    /// Narrows this vertex if it is marked.
    Narrow(u64),
    /// The trial failed: this new vertex gets widths that depend on nothing else.
    Harden { vertex: u64, attempt: usize },
}

/// See the module.
#[derive(Debug)]
pub(super) struct WidthOptimizer {
    window: Window,
    phase: OptimizerPhase,
    /// Number of the first leg that the stored assignment does not know.
    stored_next: u64,
    /// Up to where the stored assignment is good, path distance.
    stored_end: f64,
    round: u32,
    /// Kernel terms spent on the phase's part of the trial.
    spent: usize,
    violated: bool,
    /// Whether legs are passed over that were not violated when they were checked last.
    violated_alone: bool,
    narrowed: bool,
    /// Whether the last trial failed, so that the vertices that were new to it wait for another one ..
    hardened: bool,
    /// .. and whether the one at hand is another one with no more of the path.
    repeated: bool,
    /// Of all final vertices.
    greatest_reach: f64,
    /// Of the leg that is checked.
    reaching: Reaching,
    /// Of the one that was checked last.
    known: Option<EndDeviation>,
}

impl WidthOptimizer {
    pub const fn new() -> Self {
        Self {
            window: Window::EMPTY,
            phase: OptimizerPhase::Idle,
            stored_next: 0,
            stored_end: 0.0,
            round: 0,
            spent: 0,
            violated: false,
            violated_alone: false,
            narrowed: false,
            hardened: false,
            repeated: false,
            greatest_reach: 0.0,
            reaching: Reaching::NONE,
            known: None,
        }
    }

    /// Begins anew with an empty chain.
    pub fn restart(&mut self, chain: &Chain) {
        let next = chain.next();
        self.window = Window {
            open: next,
            next,
            ..Window::EMPTY
        };
        self.phase = OptimizerPhase::Idle;
        self.hardened = false;
        self.stored_next = next;
        self.stored_end = 0.0;
        self.greatest_reach = 0.0;
    }

    /// Up to where the path is within its tolerance, path distance.
    pub fn stored_end(&self) -> f64 {
        self.stored_end
    }

    /// Up to where the path never changes again, path distance.
    pub fn frozen(&self) -> f64 {
        self.window.frozen
    }

    /// The greatest reach of a final vertex.
    pub fn greatest_reach(&self) -> f64 {
        self.greatest_reach
    }

    /// Number of the first vertex whose widths may change.
    pub fn open(&self) -> u64 {
        self.window.open
    }

    /// Whether the stored assignment knows all legs there are.
    pub fn is_settled(&self, chain: &Chain) -> bool {
        let idle = matches!(self.phase, OptimizerPhase::Idle) && !self.hardened;
        idle && self.stored_next == chain.next()
    }

    /// The machine comes to rest at the end of the chain: nothing will change any more. Only when
    /// settled.
    pub fn freeze(&mut self, chain: &Chain) {
        while self.window.open < self.stored_next {
            self.close(chain);
        }
        self.window.frozen = self.stored_end;
    }

    /// The machine needs the path up to path distance `place` now: up to there it is final, with the widths in force. What comes
    /// behind the chain may still change what lies beyond. Only when settled.
    pub fn freeze_up_to(&mut self, chain: &Chain, place: f64) {
        while self.window.open < self.stored_next {
            self.close(chain);
        }
        self.window.frozen = self.window.frozen.max(place.min(self.stored_end));
    }

    /// Works for about `budget` kernel terms, at most [`GREATEST_EXCESS`] more. `hurry`: does not
    /// wait until enough of the path is new. Answers what it took.
    pub fn step(
        &mut self,
        chain: &mut Chain,
        settings: &BlendSettings,
        metric: &Metric,
        hurry: bool,
        budget: usize,
    ) -> usize {
        let mut spent = 0;
        while spent < budget {
            let cost = match self.phase {
                OptimizerPhase::Idle => {
                    if !self.begin(chain, hurry) {
                        break;
                    }
                    2 * NEIGHBOURS as usize
                }
                OptimizerPhase::Widen(vertex) => self.widen(chain, vertex, settings, metric),
                OptimizerPhase::Assign(vertex) => self.assign(chain, vertex),
                OptimizerPhase::Check(leg) => self.check(chain, leg, settings, metric),
                OptimizerPhase::Narrow(vertex) => self.narrow(chain, vertex),
                OptimizerPhase::Harden { vertex, attempt } => {
                    self.harden(chain, vertex, attempt, settings, metric)
                }
            };
            spent += cost;
        }
        spent
    }

    /// Begins a trial if there is enough to be done.
    fn begin(&mut self, chain: &mut Chain, hurry: bool) -> bool {
        let fresh = chain.next().saturating_sub(self.stored_next);
        let Some(last) = chain.last() else {
            return false;
        };
        let enough = fresh >= GREATEST_CHUNK
            || hurry
            // The machine rests at its end, or may have to: nothing to come changes it.
            || last.stop_after
            || last.is_exact()
            || chain.end() - self.stored_end >= CHUNK * last.design_width;
        let repeated = fresh == 0 && self.hardened;
        if !enough || !(fresh > 0 || repeated) {
            return false;
        }
        self.repeated = repeated;
        self.hardened = false;
        let next = self.stored_next + fresh.min(MOST_AT_A_TIME);
        self.window.next = next;
        self.window.end = chain.leg(next.wrapping_sub(1)).end();
        // Walls, from the right. The vertex at the end of the window may be known to be one.
        let mut wall = if next < chain.next() && chain.vertex(next).wall {
            self.window.end
        } else {
            f64::INFINITY
        };
        for number in (self.window.open..next).rev() {
            let vertex = chain.vertex_mut(number);
            vertex.right_wall = wall;
            if vertex.wall {
                wall = vertex.s;
            }
        }
        for number in self.first_leg(chain)..next {
            chain.leg_mut(number).check = LegCheck::NONE;
        }
        self.spent = 0;
        self.phase = OptimizerPhase::Widen(self.window.open);
        true
    }

    /// The first leg that an open vertex may reach.
    fn first_leg(&self, chain: &Chain) -> u64 {
        self.window
            .open
            .saturating_sub(NEIGHBOURS)
            .max(chain.first())
    }

    fn widen(
        &mut self,
        chain: &mut Chain,
        vertex: u64,
        settings: &BlendSettings,
        metric: &Metric,
    ) -> usize {
        if vertex >= self.window.next || self.spent > GREATEST_TRIAL / 2 {
            self.phase = OptimizerPhase::Assign(self.window.open);
            return 1;
        }
        let (goes_on, cost) = base_width::widen(chain, vertex, &self.window, settings, metric);
        self.spent += cost;
        if !goes_on {
            self.phase = OptimizerPhase::Widen(vertex + 1);
        }
        cost
    }

    fn assign(&mut self, chain: &mut Chain, number: u64) -> usize {
        if number >= self.window.next {
            self.spent = 0;
            self.round = 0;
            self.begin_check(chain, false);
            return 1;
        }
        self.phase = OptimizerPhase::Assign(number + 1);
        let vertex = chain.vertex_mut(number);
        vertex.temporary_factor = 1.0;
        vertex.narrowing = 1.0;
        vertex.marked_temporarily = false;
        vertex.goes_back = false;
        vertex.held = false;
        self.set_trial(chain, number);
        let vertex = chain.vertex(number);
        if vertex.trial == *vertex.stored() && number < self.stored_next {
            return 1;
        }
        let reach = vertex.trial.reach().max(vertex.stored().reach());
        chain.touch(number, reach, self.window.next)
    }

    /// Trial widths as the base widths, the factors and the surroundings allow.
    fn set_trial(&self, chain: &mut Chain, number: u64) {
        let clip = self.window.clip(chain, number);
        let vertex = chain.vertex(number);
        let clip = clip.min(vertex.tapered(self.window.end - vertex.s));
        let widths = if vertex.is_smoothed() {
            vertex.widths_within(clip)
        } else {
            Widths::NONE
        };
        chain.set_trial(number, widths);
    }

    /// Back to the stored assignment, which does not know the new vertices yet. What it knows stays as narrow, so that trials come
    /// to their end. The new ones are hardened for the time being: the next trial begins with all of their base widths.
    fn give_up(&mut self, chain: &mut Chain) -> usize {
        for number in self.window.open..self.window.next {
            chain.set_trial(number, *chain.vertex(number).stored());
            let vertex = chain.vertex_mut(number);
            vertex.factor = vertex.stored_factor();
            if number < self.stored_next && vertex.base.kernel > 0.0 {
                vertex.factor = vertex
                    .factor
                    .min(vertex.stored().kernel / vertex.base.kernel);
            }
        }
        self.phase = OptimizerPhase::Harden {
            vertex: self.stored_next,
            attempt: 0,
        };
        2 * NEIGHBOURS as usize
    }

    fn harden(
        &mut self,
        chain: &mut Chain,
        vertex: u64,
        attempt: usize,
        settings: &BlendSettings,
        metric: &Metric,
    ) -> usize {
        if vertex >= self.window.next {
            // What was new closes with the next trial at the earliest: narrow for good it would cost time.
            let closing = self.stored_next;
            self.hardened = !self.repeated;
            return self.accept(chain, settings, closing);
        }
        let reaching = &mut self.reaching;
        let (holds, cost) =
            hardening::harden(chain, vertex, attempt, &self.window, metric, reaching);
        self.phase = if holds || attempt + 1 >= ATTEMPTS {
            OptimizerPhase::Harden {
                vertex: vertex + 1,
                attempt: 0,
            }
        } else {
            OptimizerPhase::Harden {
                vertex,
                attempt: attempt + 1,
            }
        };
        cost
    }

    /// Puts the trial assignment in force. Vertices before number `closing` may become final since what is yet to come is
    /// beyond their reach.
    fn accept(&mut self, chain: &mut Chain, settings: &BlendSettings, closing: u64) -> usize {
        for number in self.window.open..self.window.next {
            chain.store_trial(number);
        }
        self.stored_next = self.window.next;
        self.stored_end = self.window.end;
        self.phase = OptimizerPhase::Idle;
        self.advance(chain, settings, closing);
        chain.settle(self.window.open, self.window.frozen);
        2 * NEIGHBOURS as usize
    }

    /// Makes the first open vertex final.
    fn close(&mut self, chain: &Chain) {
        let reach = chain.vertex(self.window.open).stored().reach();
        self.greatest_reach = self.greatest_reach.max(reach);
        self.window.open += 1;
    }

    /// Finds out what is final. `closing`: as in [`accept`](Self::accept).
    fn advance(&mut self, chain: &Chain, settings: &BlendSettings, closing: u64) {
        let Window { next, end, .. } = self.window;
        let last = chain.leg(next.wrapping_sub(1));
        while self.window.open < next {
            let vertex = chain.vertex(self.window.open);
            // Closed before its search is over it would be narrow for good.
            let searched = vertex.searched || vertex.wall || vertex.tangent_jump_size <= 0.0;
            let beyond_reach =
                searched && end - vertex.s >= vertex.stored().reach() + LAG * last.design_width;
            let before_wall = vertex.right_wall <= end;
            let out_of_reach = self.window.open < closing && (beyond_reach || before_wall);
            let too_many = next - self.window.open >= GREATEST_OPEN;
            if !(vertex.is_bare_wall() || out_of_reach || too_many) {
                break;
            }
            self.close(chain);
        }
        self.window.frozen = self
            .window
            .frozen
            .max(self.window.untouchable(chain, settings))
            .min(end);
    }
}

#[cfg(test)]
mod tests;
