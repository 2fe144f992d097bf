//! The mix of kernels that overlap: how far the curve that they stand for shrinks.
//!
//! Kernels of fourth order leave a curve of short lines where it is, and those of second order cut it on its inner side, by
//! the half of their second moment times the curvature:
//!
//! ```text
//! (1 - mix) w^2 / 14 |jump| / leg
//! ```
//!
//! But the derivative of one of fourth order is 2.4 times as large at the same width, and so is what it lets through of
//! the lines: for chords of equal length c it is the Fourier transform of the kernel at 1 / c, 5 to 10 times as much for
//! widths of 1.5 to 4 chords with a mix of 1 as with one of .1 to .3. So where the tolerance leaves room beside a kernel as wide
//! as it is to be, the curve may shrink by a part of that.

use wide::f64x2;

use super::leg::Leg;
use super::linear_axes::greater_end;
use super::vertex::Vertex;

/// Of what the tolerance leaves, how much the curve may shrink by.
const SHARE: f64 = 0.25;

/// Of the tolerance, what leaves nothing for that: neighbours differ.
const GREATEST_USED: f64 = 0.7;

/// A vertex with a greater jump of its tangent is a corner, and belongs to no curve.
const GREATEST_JUMP: f64 = 0.8;

/// On a curve that is moved by more than this share of the tolerance beside a vertex nothing is left beside it either ..
const MOVED_BY_ALL: f64 = 0.6;

/// .. where it turns by less than this at the vertex: at more it is a corner whose legs are divided.
const GREATEST_TURN: f64 = 0.2;

/// The second moment of the biweight kernel is 1/7 of the square of its width.
const MOMENT: f64 = 14.0;

/// The least mix of kernels that overlap. With less, chords are let through as well.
const LEAST_MIX: f64 = 0.15;

/// What is above 1 balances deviations to the outside and to the inside when the legs are so long that the curve lies well
/// outside of them: so much where they are as long as the width, and so much at most.
const OUTWARD: f64 = 0.29;
const GREATEST_OUTWARD: f64 = 0.15;

impl Vertex {
    /// The mix of its kernels for a width.
    pub fn mix(&self, width: f64) -> f64 {
        if width <= self.half_leg * 1.001 {
            return self.corner.mix;
        }
        let mean_leg = f64x2::splat(self.mean_leg);
        let [mix, _] = Self::full_mixes(mean_leg, f64x2::splat(width)).to_array();
        mix - (self.shrinkage / (width * width)).min(1.0 - LEAST_MIX)
    }

    /// The mixes of two vertices where the curve is not to shrink, by the mean lengths of their legs.
    #[inline(always)]
    pub fn full_mixes(mean_legs: f64x2, width: f64x2) -> f64x2 {
        let share = mean_legs / width;
        1.0 + (share * OUTWARD * share).fast_min(f64x2::splat(GREATEST_OUTWARD))
    }

    /// Finds by how much more than itself the other ends of its legs are moved, where these are moved by about all they may be.
    ///
    /// What is moved on a curve made of chords: their ends to the inner side, and the middles to the outer one. In between nothing is
    /// moved and the tolerance seems to be left; but what shrinks there takes the ends of the chords with it.
    pub fn find_moved_beside(&mut self, before: &Leg, after: &Leg) {
        let here = greater_end(&after.shift_at(self.s));
        let ends = [before.shift_at(before.start), after.shift_at(after.end())];
        let beside = ends.iter().map(greater_end).fold(0.0, f64::max);
        let by_all = beside > MOVED_BY_ALL * self.tolerance;
        if after.ends_curve && by_all && self.tangent_jump_size < GREATEST_TURN {
            self.moved_beside = (beside - here).max(0.0);
        }
    }

    /// Lets the curve shrink by a part of what is left of the tolerance where it is used up to `deviation` otherwise.
    pub fn let_shrink(&mut self, deviation: f64) {
        let left = GREATEST_USED * self.tolerance - deviation - self.moved_beside;
        let turns = self.tangent_jump_size < GREATEST_JUMP && self.tolerance_jump_size > 0.0;
        self.shrinkage = if turns && !self.at_limit && left > 0.0 {
            SHARE * MOMENT * left * self.mean_leg / self.tolerance_jump_size
        } else {
            0.0
        };
    }
}

#[cfg(test)]
mod tests {
    use super::super::linear_axes;
    use super::super::shift::Shift;
    use super::*;
    use crate::axes::Axes;
    use crate::path::jump::Jump;
    use crate::path::kernel;

    /// A vertex of a circle with a radius of 10 made of chords of this length.
    fn vertex(chord: f64, tolerance: f64) -> Vertex {
        let jump = chord / 10.0;
        let mut vertex = Vertex::VACANT;
        vertex.tangent_jump = Jump::new(&(Axes::x() * jump));
        vertex.tangent_jump_size = jump;
        vertex.tolerance_jump_size = jump;
        vertex.tolerance = tolerance;
        vertex.half_leg = 0.5 * chord;
        vertex.mean_leg = chord;
        vertex
    }

    /// By how much kernels of this width and mix take a circle of such chords to its inner side, in the mean.
    fn inward(vertex: &Vertex, width: f64, mix: f64) -> f64 {
        let places = 1000;
        let value = |k: i32| kernel::value((f64::from(k) / f64::from(places)).abs(), mix);
        let mean = (-places..=places).map(value).sum::<f64>() / f64::from(places);
        mean * width * width * vertex.tangent_jump_size / vertex.mean_leg
    }

    #[test]
    fn a_curve_shrinks_by_a_quarter_of_what_is_left() {
        let (width, tolerance) = (1.8, 0.05);
        let mut vertex = vertex(0.2, tolerance);
        let full = inward(&vertex, width, vertex.mix(width));
        vertex.let_shrink(0.3 * tolerance);
        let mix = vertex.mix(width);
        assert!((LEAST_MIX..0.9).contains(&mix), "{mix}");
        let by = inward(&vertex, width, mix) - full;
        let expected = SHARE * (GREATEST_USED - 0.3) * tolerance;
        assert!((by / expected - 1.0).abs() < 1e-3, "{by} {expected}");
    }

    #[test]
    fn what_is_moved_by_all_it_may_be_beside_leaves_nothing() {
        let leg = |start: f64, end: f64, ends_curve: bool| {
            let [start, end] = [start, end].map(|moved| {
                linear_axes::of(&Axes::from_fn(
                    |axis, _| if axis == 1 { moved } else { 0.0 },
                ))
            });
            Leg {
                length: 0.2,
                ends_curve,
                shift: Shift::between(&start, &end, 0.2),
                ..Leg::VACANT
            }
        };
        let found = |moved: f64, jump: f64, curve: bool| {
            let mut vertex = vertex(0.2, 0.05);
            vertex.tangent_jump_size = jump;
            vertex.find_moved_beside(&leg(moved, 0.001, true), &leg(0.001, -moved, curve));
            vertex.let_shrink(0.3 * vertex.tolerance);
            (vertex.moved_beside, vertex.shrinkage > 0.0)
        };
        let (beside, shrinks) = found(0.035, 0.02, true);
        assert!((beside - 0.034).abs() < 1e-12 && !shrinks, "{beside}");
        for (moved, jump, curve) in [(0.01, 0.02, true), (0.035, 0.3, true), (0.035, 0.02, false)] {
            assert_eq!(found(moved, jump, curve), (0.0, true), "{moved} {jump}");
        }
    }

    #[test]
    fn with_room_enough_the_mix_is_the_least() {
        let mut vertex = vertex(0.2, 10.0);
        vertex.let_shrink(0.0);
        let mix = vertex.mix(1.8);
        assert!((mix - LEAST_MIX).abs() < 0.01, "{mix}");
    }

    #[test]
    fn nothing_shrinks_where_the_tolerance_is_used_at_a_corner_or_at_a_limit() {
        let full = vertex(0.2, 0.05).mix(1.8);
        let mut used = vertex(0.2, 0.05);
        used.let_shrink(0.04);
        let mut corner = vertex(9.0, 0.05);
        corner.half_leg = 0.1;
        corner.mean_leg = 0.2;
        corner.let_shrink(0.0);
        let mut limit = vertex(0.2, 0.05);
        limit.at_limit = true;
        limit.let_shrink(0.0);
        for vertex in [used, corner, limit] {
            assert_eq!(vertex.mix(1.8), full);
        }
    }
}
