//! What is handed out: servo periods, made of the segments of the plan.

use super::cell_builder::Ground;
use super::outlook::Outlook;
use super::reference::{Ahead, Reference};
use super::reference_segment::{ReferenceSegment, SegmentMotion};

/// The servo periods that the executor is given where the plan is about to be continued: what it
/// asks for while it runs the reference as it is, and a little more.
const PERIODS_AHEAD: f64 = 10.0;

impl Reference {
    /// Hands out the next servo period and freezes it. The executor needs `needed` of them from where
    /// the machine is, whatever becomes of the plan. After [`Ahead::Last`] and [`Ahead::End`] it is not
    /// called before the machine has [come to rest](Self::come_to_rest).
    pub fn next_cell(&mut self, outlook: &Outlook, needed: usize, budget: &mut usize) -> Ahead {
        loop {
            self.raise(outlook);
            let left = outlook.now.period - self.cell.filled();
            match self.segments.back() {
                Some(segment) if self.frontier < segment.duration => {
                    if self.cell.filled() == 0.0 {
                        self.cell_start = (self.segments.last(), self.frontier);
                    }
                    let to = segment.duration.min(self.frontier + left);
                    let completes = self.frontier + left <= segment.duration;
                    let ground = Ground {
                        path: &self.path,
                        queue: outlook.queue,
                        map: outlook.map,
                        raise: self.current().raised(),
                    };
                    self.cell.add(segment, &ground, self.frontier, to);
                    self.frontier = to;
                    if completes && let Some(cell) = self.cell.take() {
                        #[cfg(test)]
                        let cell = self.spoil(cell);
                        return Ahead::Cell(cell);
                    }
                }
                _ => {
                    #[cfg(test)]
                    if self.dry {
                        return Ahead::Later;
                    }
                    if self.waits_for_continuation(outlook, needed) {
                        return Ahead::Later;
                    }
                    if *budget == 0 || self.segments.is_full() || !self.next_piece(outlook) {
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

    /// Takes back the servo period that was handed out last: what lies before it stays.
    pub fn take_back(&mut self) {
        let (segment, from) = self.cell_start;
        if from > 0.0 {
            self.segments.truncate(segment);
            self.frontier = from;
        } else {
            // The segment that it begins with may be what is wrong.
            self.segments.truncate(segment.wrapping_sub(1));
            self.frontier = self.segments.back().map_or(0.0, |last| last.duration);
        }
        self.cell.clear();
        self.resting = self.segments.front().is_none();
    }

    /// A cell that the executor refuses, unless the machine already coasts.
    #[cfg(test)]
    fn spoil(&self, cell: crate::cycle::Cell) -> crate::cycle::Cell {
        let path_velocity = if self.spoiled && !self.is_coasting() {
            f64::NAN
        } else {
            cell.path_velocity
        };
        crate::cycle::Cell {
            path_velocity,
            ..cell
        }
    }

    /// Whether nothing more is to be frozen yet: the plan is soon to brake to an end that is to be
    /// moved on, and the executor has what it needs for now.
    fn waits_for_continuation(&self, outlook: &Outlook, needed: usize) -> bool {
        let periods = PERIODS_AHEAD.max(needed as f64);
        !self.resting
            && self
                .segments
                .lasts(self.elapsed + periods * outlook.now.period)
            && self.current().brakes_for_now(&self.path)
    }

    /// Whether the reference rests where the path ends for good.
    pub(super) fn is_at_end(&self) -> bool {
        !self.backwards
            && self.resting
            && self.path.rests_at_end()
            && self.rest >= self.path.programmed_end()
    }

    /// Takes the next segment of the plan. `false` if there is none yet.
    pub(super) fn next_piece(&mut self, outlook: &Outlook) -> bool {
        if !self.resting {
            if self.push_frozen() {
                return true;
            }
            self.rest = self.current().end();
            self.resting = true;
            self.current_mut().clear();
        }
        // The motion ends with this rest.
        let ends = outlook.now.stepping || self.step_by_step || outlook.now.settings_changed;
        if ends && self.segments.front().is_some() {
            return false;
        }
        if self.next_move(outlook) {
            return true;
        }
        if !self.current().starts_at(self.rest) {
            self.swapped = !self.swapped;
        }
        if self.current().starts_at(self.rest) && self.creep(outlook) {
            return true;
        }
        let ready = self.current().starts_at(self.rest) && self.current().is_ready();
        if ready && self.push_frozen() {
            self.resting = false;
            return true;
        }
        false
    }

    /// Freezes the next segment of the current run. `false` at its end.
    pub(super) fn push_frozen(&mut self) -> bool {
        let Some(segment) = self.current_mut().freeze() else {
            return false;
        };
        let motion = if self.backwards {
            SegmentMotion::Return(segment)
        } else {
            SegmentMotion::Run(segment)
        };
        self.segments.push(ReferenceSegment {
            motion,
            duration: segment.duration,
        });
        true
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
}
