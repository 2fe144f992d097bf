//! What vertices take the path off the program by where all that overlap have kernels of the same width.

use wide::f64x2;

use super::jump::JumpSum;
use super::kernel;
use super::vertex::Vertex;
use super::widths::Widths;
use crate::axes::Axes;

/// The sum at a place, of the vertices that are nearer to it than the width.
pub(super) struct EqualWidthsSum<'a> {
    /// Path distance.
    place: f64,
    width: f64,
    sum: JumpSum<1>,
    /// Kernels are evaluated two at a time: the first of two.
    waiting: Option<&'a Vertex>,
    terms: usize,
}

impl<'a> EqualWidthsSum<'a> {
    pub fn new(place: f64, width: f64) -> Self {
        Self {
            place,
            width,
            sum: JumpSum::ZERO,
            waiting: None,
            terms: 1,
        }
    }

    /// Adds a vertex: an isolated corner with its own widths.
    #[inline]
    pub fn add(&mut self, vertex: &'a Vertex) {
        self.terms += 1;
        if vertex.wall || vertex.is_free() {
            return;
        }
        if vertex.isolated {
            self.add_isolated(vertex);
        } else if let Some(before) = self.waiting.take() {
            let [first, second] = self.values([before, vertex]);
            self.sum.add(&before.tangent_jump, &[first]);
            self.sum.add(&vertex.tangent_jump, &[second]);
        } else {
            self.waiting = Some(vertex);
        }
    }

    fn add_isolated(&mut self, vertex: &Vertex) {
        self.add_waiting();
        let widths = if vertex.base.further_reach() > 0.0 {
            vertex.base
        } else {
            Widths {
                kernel: vertex.base.kernel.min(self.width),
                ..vertex.base
            }
        };
        let value = widths.deviation((self.place - vertex.s).abs());
        self.sum.add(&vertex.tangent_jump, &[value]);
    }

    /// What two that overlap add of their jumps.
    #[inline(always)]
    fn values(&self, vertices: [&Vertex; 2]) -> [f64; 2] {
        let width = f64x2::splat(self.width);
        let distance = (self.place - f64x2::new(vertices.map(|vertex| vertex.s))).abs();
        let mix = Vertex::full_mixes(vertices, width);
        (width * kernel::values(distance / width, mix)).to_array()
    }

    fn add_waiting(&mut self) {
        if let Some(alone) = self.waiting.take() {
            let [value, _] = self.values([alone; 2]);
            self.sum.add(&alone.tangent_jump, &[value]);
        }
    }

    /// For all axes, shape (9), and the kernel terms that it took.
    pub fn total(mut self) -> (Axes, usize) {
        self.add_waiting();
        (self.sum.axes(), self.terms)
    }
}
