//! What lies at a place of the blended path: legs, vertices, moves.

use super::blended_path::BlendedPath;
use super::views::{LegView, MoveProgress, VertexView};
use crate::axes::Axes;
use crate::lanes::lesser;
use crate::moves::shape::Shape;

impl BlendedPath {
    /// The leg at `s`, the later one where two meet; `None` if there is none at all.
    pub fn leg(&self, s: f64) -> Option<LegView> {
        (!self.chain.is_empty()).then(|| self.leg_view(self.chain.locate(s)))
    }

    /// The least programmed speed of the legs within `near` of `s`, and the least that no override may exceed; infinite
    /// where there is none. `near` is shorter than any leg.
    pub fn speeds_near(&self, s: f64, near: f64) -> [f64; 2] {
        if self.chain.is_empty() {
            return [f64::INFINITY; 2];
        }
        let before = self.chain.leg(self.chain.locate(s - near));
        let after = if s + near < before.end() {
            before
        } else {
            self.chain.leg(self.chain.locate(s + near))
        };
        [
            lesser(before.speed, after.speed),
            lesser(before.greatest_speed, after.greatest_speed),
        ]
    }

    /// The leg that `s` lies in, the earlier one where two meet; `None` if there is none or not
    /// everything is kept that it depends on.
    pub fn leg_before(&self, s: f64) -> Option<LegView> {
        if self.chain.is_empty() {
            return None;
        }
        let number = self.chain.locate(s);
        let number = if self.chain.leg(number).start < s {
            number
        } else {
            number.checked_sub(1)?
        };
        (number >= self.chain.oldest_whole()).then(|| self.leg_view(number))
    }

    fn leg_view(&self, number: u64) -> LegView {
        let leg = self.chain.leg(number);
        LegView {
            serial: leg.serial,
            first: leg.first,
            start: leg.start - leg.lead - leg.before,
            end: if leg.is_last_part {
                leg.end() + leg.after
            } else {
                leg.start - leg.lead + leg.whole + leg.after
            },
            speed: leg.speed,
            greatest_speed: leg.greatest_speed,
            turning: leg.turning,
            measure_rate: leg.measure_rate,
            measure: leg.measure,
        }
    }

    /// Which move runs at `s` and how far it is; `None` if there is none.
    pub fn progress(&self, s: f64) -> Option<MoveProgress> {
        (!self.chain.is_empty()).then(|| {
            let leg = self.chain.leg(self.chain.locate(s));
            let distance = leg.measured(s);
            MoveProgress {
                serial: leg.serial,
                first: leg.first,
                distance: leg.before * leg.measure_rate + distance,
                distance_to_go: leg.after * leg.measure_rate + leg.shape.length() - distance,
            }
        })
    }

    /// The leg that ends at `s`: number of its last move, and where that ends, shape (9), exactly as
    /// given. `None` if none ends there.
    pub fn leg_ending_at(&self, s: f64) -> Option<(u64, Axes)> {
        if self.chain.is_empty() {
            return None;
        }
        let number = self.chain.locate(s);
        let number = if s >= self.chain.leg(number).end() {
            number
        } else {
            number.checked_sub(1)?
        };
        let leg = self.chain.leg(number);
        let ends = leg.is_last_part && leg.after <= 0.0 && leg.end() == s;
        (number >= self.chain.first() && ends).then(|| (leg.serial, leg.shape.end()))
    }

    /// How far the path may be from the programmed one on the leg at `s`, machine units; 0 if
    /// nothing is known. Under G64 without P: but for corners that are cut by up to half of their
    /// shorter leg.
    pub fn tolerance(&self, s: f64) -> f64 {
        if self.chain.is_empty() {
            0.0
        } else {
            self.chain.leg(self.chain.locate(s)).tolerance()
        }
    }

    /// The vertices from `from` on, the start of the path or its oldest leg included, in order.
    pub fn vertices(&self, from: f64) -> impl Iterator<Item = VertexView> + '_ {
        let first = if self.chain.is_empty() {
            self.chain.next()
        } else {
            self.chain.locate(from)
        };
        (first..self.chain.next())
            .map(|number| self.vertex_view(number))
            .skip_while(move |vertex| vertex.s < from)
    }

    fn vertex_view(&self, number: u64) -> VertexView {
        let vertex = self.chain.vertex(number);
        let mut reach = vertex.stored().reach();
        if vertex.tangent_jump_size <= 0.0 && !vertex.wall {
            // In a smoothed run the path is as curved here as at its neighbours.
            for neighbour in [number.saturating_sub(1), number.saturating_add(1)] {
                if neighbour < self.chain.first() || neighbour >= self.chain.next() {
                    continue;
                }
                let widths = self.chain.vertex(neighbour).stored();
                if widths.mix > 0.0 {
                    reach = reach.max(widths.kernel);
                }
            }
        }
        VertexView {
            s: vertex.s,
            reach,
            core: vertex.stored().core(),
            stop: vertex.stop,
            curvature_jumps: vertex.curvature_jump_size > 0.0,
            speed_changes: number > self.chain.first() && {
                let (before, after) = (self.chain.leg(number - 1), self.chain.leg(number));
                before.speed != after.speed || before.greatest_speed != after.greatest_speed
            },
        }
    }

    /// The first vertex behind `s`.
    pub fn vertex_after(&self, s: f64) -> Option<VertexView> {
        if self.chain.is_empty() {
            return None;
        }
        let number = self.chain.locate(s);
        let number = if self.chain.leg(number).start > s {
            number
        } else {
            number.saturating_add(1)
        };
        (number < self.chain.next()).then(|| self.vertex_view(number))
    }

    /// The last vertex before `s`.
    pub fn vertex_before(&self, s: f64) -> Option<VertexView> {
        if self.chain.is_empty() {
            return None;
        }
        let number = self.chain.locate(s);
        let number = if self.chain.leg(number).start < s {
            Some(number)
        } else {
            number.checked_sub(1)
        };
        number
            .filter(|number| *number >= self.chain.first())
            .map(|number| self.vertex_view(number))
    }

    /// The shape of the leg at `s`, the later one where two meet; `None` if there is none.
    pub fn shape(&self, s: f64) -> Option<Shape> {
        (!self.chain.is_empty()).then(|| self.chain.leg(self.chain.locate(s)).shape)
    }

    /// The leg that starts at a stop at `s`, if the machine comes to rest at its end too, and that is final: then
    /// it is the programmed move itself. Within the blend of a corner a machine that creeps may rest as well.
    pub fn move_between_rests(&self, s: f64) -> Option<(Shape, LegView)> {
        let view = self.leg(s)?;
        let number = self.chain.locate(s);
        let leg = self.chain.leg(number);
        let after = number.saturating_add(1);
        let rests = leg.stop_after
            || after < self.chain.next() && self.chain.vertex(after).stop
            || after == self.chain.next() && self.rests_at_end();
        let starts = view.start == s && self.chain.vertex(number).stop;
        (starts && rests && self.final_end() >= view.end).then_some((leg.shape, view))
    }
}
