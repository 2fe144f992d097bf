//! What the vertices around a place add to the path there.

use super::chain::Chain;
use super::contribution::Contribution;
use super::jump::PointSum;
use super::kernel::Side;

impl Chain {
    /// What all vertices that reach into a leg add to it at path distance `s`, within it.
    #[inline(always)]
    pub fn jumps<const N: usize, const LOW: bool, const HIGH: bool>(
        &self,
        number: u64,
        s: f64,
    ) -> PointSum<N, LOW, HIGH> {
        let leg = self.leg(number);
        let mut sum = PointSum::ZERO;
        let mut at = number;
        let left = u64::from(leg.reached_from_left);
        let farthest = number.wrapping_add(1).wrapping_sub(left);
        for part in self.contributions.row(farthest, left).into_iter().rev() {
            for near in part.iter().rev() {
                self.add_to(&mut sum, at, near, s - near.s, Side::Right);
                at = at.wrapping_sub(1);
            }
        }
        let right = u64::from(leg.reached_from_right);
        let mut at = number;
        for part in self.contributions.row(number.wrapping_add(1), right) {
            for near in part {
                at = at.wrapping_add(1);
                self.add_to(&mut sum, at, near, near.s - s, Side::Left);
            }
        }
        sum
    }

    /// Adds what one of them contributes at a `distance` from it, 0 and above, on this `side`.
    #[inline(always)]
    fn add_to<const N: usize, const LOW: bool, const HIGH: bool>(
        &self,
        sum: &mut PointSum<N, LOW, HIGH>,
        number: u64,
        near: &Contribution,
        distance: f64,
        side: Side,
    ) {
        if distance < near.width {
            let factors = near.kernel.factors(distance, side);
            if N == 1 {
                sum.add_linear(&near.linear_jump, &factors);
            } else {
                sum.add(&self.vertex(number).tangent_jump, &factors);
            }
        }
        if near.more {
            let vertex = self.vertex(number);
            if N == 1 {
                // A sum that fits into the registers stays there, as long as none but a copy of it is lent.
                let mut whole = *sum;
                vertex.add_more(&mut whole, distance, side);
                *sum = whole;
            } else {
                vertex.add_more(sum, distance, side);
            }
        }
    }

    /// The [breakpoints](super::vertex::Vertex::breakpoints) of the vertices from `first` to `last` between two places.
    #[inline(always)]
    pub fn breakpoints(
        &self,
        first: u64,
        last: u64,
        [from, to]: [f64; 2],
        mut take: impl FnMut(f64),
    ) {
        let count = last.saturating_add(1).saturating_sub(first);
        let mut number = first;
        for part in self.contributions.row(first, count) {
            for near in part {
                if near.breaks {
                    self.vertex(number).breakpoints(from, to, &mut take);
                } else if near.width > 0.0 {
                    for place in [near.s - near.width, near.s + near.width] {
                        if from < place && place < to {
                            take(place);
                        }
                    }
                }
                number += 1;
            }
        }
    }
}
