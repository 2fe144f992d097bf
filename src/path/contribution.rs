//! What a vertex adds to the path in force, laid out to be added up.
//!
//! Dozens of kernels overlap at a place of dense code, and a place is looked at several times for each interval of the
//! plan: what is asked of a vertex there lies in four lines of a processor's cache, and numbers stand twice in a row where
//! two of their kind are calculated with at a time.

use wide::f64x2;

use super::jump::GROUP_SIZE;
use super::kernel::Kernel;
use super::vertex::Vertex;

/// See the module.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Contribution {
    /// Where the vertex is, path distance.
    pub s: f64,
    /// The width of its kernel; 0 where it has none.
    pub width: f64,
    /// Whether it adds more than its kernel: see [`Vertex::add_more`].
    pub more: bool,
    /// Whether the third derivative of the path or its slope may jump elsewhere than where its kernel ends: see
    /// [`Vertex::breakpoints`].
    pub breaks: bool,
    pub kernel: Kernel,
    /// The jump of the tangent: X, Y and Z, each twice.
    pub linear_jump: [f64x2; GROUP_SIZE],
}

impl Contribution {
    pub const NONE: Self = Self {
        s: 0.0,
        width: 0.0,
        more: false,
        breaks: false,
        kernel: Kernel::NONE,
        linear_jump: [f64x2::ZERO; GROUP_SIZE],
    };

    /// Of a vertex as it is in force.
    pub fn of(vertex: &Vertex) -> Self {
        let [linear, ..] = vertex.tangent_jump.groups();
        let (kernel, width) = vertex.stored_kernel();
        Self {
            s: vertex.s,
            width,
            more: vertex.has_more(),
            breaks: vertex.has_more() || vertex.curvature_jumps(),
            kernel,
            linear_jump: linear.map(f64x2::splat),
        }
    }
}
