//! The kernel of a vertex on trial, laid out to be collected.
//!
//! Dozens of them reach a leg of dense code, and each leg is checked several times before widths are in force: what is asked of
//! a vertex there lies in one line of a processor's cache.

use super::jump::GROUP_SIZE;
use super::kernel;
use super::vertex::Vertex;

/// See the module.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct TrialKernel {
    /// Where the vertex is, path distance.
    pub s: f64,
    /// How far it reaches, as far as that needs a tolerance: the width of its kernel, if that is [all](Self::is_all).
    pub reach: f64,
    /// 1 over that.
    pub inverse_reach: f64,
    /// Mix of its kernels; negative where that is not [all](Self::is_all).
    pub mix: f64,
    /// Length of the jump of the tangent.
    pub size: f64,
    /// That jump in X, Y and Z.
    pub linear_jump: [f64; GROUP_SIZE],
}

impl TrialKernel {
    pub const NONE: Self = Self {
        s: 0.0,
        reach: 0.0,
        inverse_reach: 0.0,
        mix: 0.0,
        size: 0.0,
        linear_jump: [0.0; GROUP_SIZE],
    };

    /// Of a vertex as it is on trial.
    pub fn of(vertex: &Vertex) -> Self {
        let [linear, ..] = vertex.tangent_jump.groups();
        let counted = &vertex.counted;
        let times = counted.own_share();
        let is_all = counted.further_reach() <= 0.0 && counted.easement <= 0.0;
        let reach = counted.reach();
        Self {
            s: vertex.s,
            reach,
            inverse_reach: if reach > 0.0 { 1.0 / reach } else { 0.0 },
            mix: if is_all { counted.mix } else { -1.0 },
            size: times.abs() * vertex.tangent_jump_size,
            linear_jump: linear.map(|axis| times * axis),
        }
    }

    /// Whether this says all of it: it has one kernel without a share of K8, and nothing else.
    #[inline(always)]
    pub fn is_all(&self) -> bool {
        self.mix >= 0.0
    }

    /// What of the jump it adds to the path at a distance, if it is all.
    #[inline]
    pub fn value(&self, distance: f64) -> f64 {
        if distance < self.reach {
            self.reach * kernel::value(distance * self.inverse_reach, self.mix)
        } else {
            0.0
        }
    }
}
