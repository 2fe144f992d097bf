//! What vertices take the path off the program by where all that overlap have kernels of the same width.
//!
//! It is asked for at each vertex with one width after the other, and dozens of vertices are nearer to it than the wider ones: what is
//! asked of one lies in one line of a processor's cache.

use wide::f64x2;

use super::jump::{GROUP_SIZE, JumpSum};
use super::kernel;
use super::vertex::Vertex;
use super::widths::Widths;
use crate::axes::Axes;

/// What of a vertex counts where all that overlap have the same width.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct CurveVertex {
    /// Where it is, path distance.
    pub s: f64,
    /// Mean length of its legs.
    mean_leg: f64,
    /// Jump of the tangent in X, Y and Z.
    linear_jump: [f64; GROUP_SIZE],
    /// Whether this says all of it: it overlaps with its neighbours, and nothing but X, Y and Z jumps.
    is_all: bool,
    /// Whether nothing of it counts: it needs no tolerance, or is a wall.
    is_free: bool,
    /// No kernel crosses it.
    pub wall: bool,
}

impl CurveVertex {
    pub const NONE: Self = Self {
        s: 0.0,
        mean_leg: 0.0,
        linear_jump: [0.0; GROUP_SIZE],
        is_all: false,
        is_free: false,
        wall: true,
    };

    pub fn of(vertex: &Vertex) -> Self {
        let [linear, ..] = vertex.tangent_jump.groups();
        Self {
            s: vertex.s,
            mean_leg: vertex.mean_leg,
            linear_jump: *linear,
            is_all: !vertex.isolated && vertex.tangent_jump.is_linear(),
            is_free: vertex.wall || vertex.is_free(),
            wall: vertex.wall,
        }
    }
}

/// The sum at a place, of the vertices that are nearer to it than the width.
pub(super) struct EqualWidthsSum {
    /// Path distance.
    place: f64,
    width: f64,
    linear: [f64; GROUP_SIZE],
    /// Of those that are more than a [`CurveVertex`] says.
    others: JumpSum<1>,
    terms: usize,
}

impl EqualWidthsSum {
    pub fn new(place: f64, width: f64) -> Self {
        Self {
            place,
            width,
            linear: [0.0; GROUP_SIZE],
            others: JumpSum::ZERO,
            terms: 1,
        }
    }

    /// Adds those on one side, by their numbers, the nearest first, up to the width or a wall. `vertex`: one with all it has.
    #[inline(always)]
    pub fn add<'a>(
        &mut self,
        side: impl Iterator<Item = (u64, &'a CurveVertex)>,
        vertex: impl Fn(u64) -> &'a Vertex,
    ) {
        let (place, width) = (self.place, self.width);
        // In the registers of the processor, as long as nothing else needs them.
        let mut sum = self.linear;
        // Kernels are evaluated two at a time: the first of two.
        let mut waiting = None;
        for (number, here) in side {
            if (place - here.s).abs() >= width {
                break;
            }
            self.terms += 1;
            if here.is_free {
                // Nothing counts of it.
            } else if here.is_all {
                waiting = match waiting {
                    None => Some(here),
                    Some(before) => {
                        let pair: [&CurveVertex; 2] = [before, here];
                        for (vertex, value) in pair.into_iter().zip(self.values(pair)) {
                            add_times(&mut sum, &vertex.linear_jump, value);
                        }
                        None
                    }
                };
            } else {
                self.add_other(vertex(number));
            }
            if here.wall {
                break;
            }
        }
        if let Some(alone) = waiting {
            let [value, _] = self.values([alone; 2]);
            add_times(&mut sum, &alone.linear_jump, value);
        }
        self.linear = sum;
    }

    /// What two that overlap add of their jumps.
    #[inline(always)]
    fn values(&self, vertices: [&CurveVertex; 2]) -> [f64; 2] {
        let width = f64x2::splat(self.width);
        let distance = (self.place - f64x2::new(vertices.map(|vertex| vertex.s))).abs();
        let mix = Vertex::full_mixes(f64x2::new(vertices.map(|vertex| vertex.mean_leg)), width);
        (width * kernel::values(distance / width, mix)).to_array()
    }

    /// One that is isolated has its own widths.
    #[inline(never)]
    fn add_other(&mut self, vertex: &Vertex) {
        let distance = (self.place - vertex.s).abs();
        let value = if !vertex.isolated {
            let mix = Vertex::full_mixes(f64x2::splat(vertex.mean_leg), f64x2::splat(self.width));
            let [mix, _] = mix.to_array();
            self.width * kernel::value(distance / self.width, mix)
        } else if vertex.base.further_reach() > 0.0 {
            vertex.base.deviation(distance)
        } else {
            let widths = Widths {
                kernel: vertex.base.kernel.min(self.width),
                ..vertex.base
            };
            widths.deviation(distance)
        };
        self.others.add(&vertex.tangent_jump, &[value]);
    }

    /// For all axes, shape (9), and the kernel terms that it took.
    pub fn total(self) -> (Axes, usize) {
        let linear = JumpSum::of_groups(&[self.linear]);
        (linear.axes() + self.others.axes(), self.terms)
    }
}

#[inline(always)]
fn add_times(sum: &mut [f64; GROUP_SIZE], jump: &[f64; GROUP_SIZE], value: f64) {
    for (sum, axis) in sum.iter_mut().zip(jump) {
        *sum += axis * value;
    }
}

#[cfg(test)]
mod tests {
    use super::super::hardening::tests::chain_of;
    use super::super::metric::Metric;
    use super::*;
    use crate::path::chain::Chain;
    use crate::test_room::with_room;

    /// The same one by one.
    fn sum_of_all(chain: &Chain, number: u64, width: f64) -> (Axes, usize) {
        let place = chain.vertex(number).s;
        let mut sum = JumpSum::ZERO;
        let mut terms = 1;
        for near in 1..chain.next() {
            let vertex = chain.vertex(near);
            let distance = (place - vertex.s).abs();
            if distance >= width || near.abs_diff(number) > 30 {
                continue;
            }
            terms += 1;
            let mix = Vertex::full_mixes(f64x2::splat(vertex.mean_leg), f64x2::splat(width));
            let widths = if !vertex.isolated {
                Widths {
                    kernel: width,
                    mix: mix.to_array()[0],
                    ..Widths::NONE
                }
            } else if vertex.base.further_reach() > 0.0 {
                vertex.base
            } else {
                Widths {
                    kernel: vertex.base.kernel.min(width),
                    ..vertex.base
                }
            };
            if !vertex.is_free() {
                sum.add(&vertex.tangent_jump, &[widths.deviation(distance)]);
            }
        }
        (sum.axes(), terms)
    }

    /// The greatest difference of both over many places and widths, and how many vertices are isolated.
    fn difference(displacement: fn(i32) -> [f64; 3]) -> (f64, usize) {
        with_room(move || {
            let lines: Vec<_> = (0..60).map(|k| (displacement(k), 0.05)).collect();
            let (mut chain, metric): (Chain, Metric) = chain_of(&lines);
            let next = chain.next();
            for number in (1..next).filter(|number| number % 7 == 3) {
                // Found to need no tolerance.
                let vertex = chain.vertex_mut(number);
                vertex.scan_done = true;
                vertex.base.kernel = 0.0;
                chain.set_of_curve(number);
            }
            let mut greatest = 0.0f64;
            for number in 1..next {
                for width in [0.3, 1.1, 4.0] {
                    let mut sum = EqualWidthsSum::new(chain.vertex(number).s, width);
                    let vertex = |number| chain.vertex(number);
                    sum.add(chain.curve_left_of(number), vertex);
                    sum.add(chain.curve_right_of(number, next), vertex);
                    let (found, terms) = sum.total();
                    let (expected, all) = sum_of_all(&chain, number, width);
                    greatest = greatest.max(metric.norm(&(found - expected)));
                    // Where the path begins is a wall.
                    assert!(terms == all || terms == all + 1, "{number} {width}");
                }
            }
            let isolated = (1..next).filter(|number| chain.vertex(*number).isolated);
            (greatest, isolated.count())
        })
    }

    #[test]
    fn the_sum_is_that_of_all_that_are_near() {
        let even = |k: i32| {
            let angle = 0.1 * f64::from(k);
            [0.2 * angle.cos(), 0.2 * angle.sin(), 0.01]
        };
        let with_corners = |k: i32| {
            let angle = 2.2 * f64::from(k / 8) + 0.05 * f64::from(k % 8);
            let length = if (k + 1) % 8 < 2 { 1.0 } else { 0.2 };
            [length * angle.cos(), length * angle.sin(), 0.0]
        };
        let (difference_on_curve, isolated) = difference(even);
        assert!(difference_on_curve < 1e-13, "{difference_on_curve}");
        assert_eq!(isolated, 0);
        let (difference_at_corners, isolated) = difference(with_corners);
        assert!(difference_at_corners < 1e-13, "{difference_at_corners}");
        assert!(isolated > 3, "{isolated}");
    }
}
