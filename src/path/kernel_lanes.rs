//! Kernels laid out to be added up two at a time.

use wide::f64x2;

use super::chain::NEIGHBOURS;
use super::jump::{GROUP_SIZE, GROUPS, JumpSum};
use super::kernel;
use super::trial_kernel::TrialKernel;
use super::vertex::Vertex;
use super::widths::FURTHER;

/// The most kernels of a vertex.
pub(super) const KERNELS: usize = 1 + FURTHER;

/// The most that reach into a leg.
const MOST: usize = KERNELS * 2 * NEIGHBOURS as usize;

/// Kernels in a register.
const LANES: usize = 2;

/// Registers of all of them.
const PAIRS: usize = MOST / LANES;

/// A number of each kernel.
type OfKernels = [f64; MOST];

/// Kernels of vertices, none of them with a share of K8.
///
/// By what they say, and not one by one: it takes the place of a number to put one in, whichever half of a register that is.
#[derive(Debug)]
pub(super) struct KernelLanes {
    count: usize,
    s: OfKernels,
    /// 0 behind the last one.
    width: OfKernels,
    /// 1 over that.
    inverse_width: OfKernels,
    mix: OfKernels,
    /// Length of the jump of the tangent, over the width.
    bend: OfKernels,
    /// That jump, by group and axis.
    jump: [[OfKernels; GROUP_SIZE]; GROUPS],
}

impl KernelLanes {
    pub const NONE: Self = Self {
        count: 0,
        s: [0.0; MOST],
        width: [0.0; MOST],
        inverse_width: [0.0; MOST],
        mix: [0.0; MOST],
        bend: [0.0; MOST],
        jump: [[[0.0; MOST]; GROUP_SIZE]; GROUPS],
    };

    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// No more are put in.
    pub fn end(&mut self) {
        if let Some(width) = self.width.get_mut(self.count) {
            *width = 0.0;
        }
    }

    /// How many there are.
    #[inline]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Puts a kernel of a vertex in, so many times, of which `G` groups of axes jump.
    #[inline(always)]
    pub fn push<const G: usize>(&mut self, vertex: &Vertex, width: f64, mix: f64, times: f64) {
        let place = self.count;
        if place < MOST {
            self.s[place] = vertex.s;
            let inverse_width = 1.0 / width;
            self.width[place] = width;
            self.inverse_width[place] = inverse_width;
            self.mix[place] = mix;
            self.bend[place] = times.abs() * vertex.tangent_jump_size * inverse_width;
            let groups = self.jump.iter_mut().zip(vertex.tangent_jump.groups());
            for (lanes, group) in groups.take(G) {
                for (lanes, axis) in lanes.iter_mut().zip(group) {
                    lanes[place] = times * axis;
                }
            }
            self.count = place + 1;
        }
    }

    /// Puts a kernel in of which X, Y and Z alone jump.
    #[inline(always)]
    pub fn push_linear(&mut self, trial: &TrialKernel) {
        let place = self.count;
        if place < MOST {
            self.s[place] = trial.s;
            self.width[place] = trial.reach;
            self.inverse_width[place] = trial.inverse_reach;
            self.mix[place] = trial.mix;
            self.bend[place] = trial.size * trial.inverse_reach;
            let [linear, ..] = &mut self.jump;
            for (lanes, axis) in linear.iter_mut().zip(trial.linear_jump) {
                lanes[place] = axis;
            }
            self.count = place + 1;
        }
    }

    /// The deviations at `s`, of which `G` groups of axes are not 0.
    #[inline(always)]
    pub fn deviation<const G: usize>(&self, s: f64) -> JumpSum<1> {
        let mut sum = [[f64x2::ZERO; GROUP_SIZE]; G];
        for number in self.pairs() {
            let width = pair(&self.width, number);
            let distance = (s - pair(&self.s, number)).abs();
            let x = distance * pair(&self.inverse_width, number);
            let value = width * kernel::values(x, pair(&self.mix, number));
            // Beyond the width the polynomial means nothing, nor does it where there is no kernel.
            let value = value & distance.simd_lt(width);
            for (sums, jumps) in sum.iter_mut().zip(&self.jump) {
                for (sum, jump) in sums.iter_mut().zip(jumps) {
                    *sum += pair(jump, number) * value;
                }
            }
        }
        JumpSum::of_groups(&sum.map(|group| group.map(f64x2::reduce_add)))
    }

    /// A bound of the second derivative of the deviation between `from` and `to`.
    #[inline(always)]
    pub fn bend_bound(&self, from: f64, to: f64) -> f64 {
        let mut sum = f64x2::ZERO;
        for number in self.pairs() {
            let (s, width) = (pair(&self.s, number), pair(&self.width, number));
            let distance = (from - s).fast_max(s - to).fast_max(f64x2::ZERO);
            let x = distance * pair(&self.inverse_width, number);
            let majorants = kernel::majorants(x, pair(&self.mix, number));
            sum += (pair(&self.bend, number) * majorants) & distance.simd_lt(width);
        }
        sum.reduce_add()
    }

    /// The numbers of the registers that they fill.
    #[inline(always)]
    fn pairs(&self) -> core::ops::Range<usize> {
        0..self.count.div_ceil(LANES).min(PAIRS)
    }
}

/// A register of the numbers of kernels.
#[inline(always)]
fn pair(of_kernels: &OfKernels, number: usize) -> f64x2 {
    let (pairs, _) = of_kernels.as_chunks();
    f64x2::new(pairs[number])
}

const _: () = assert!(PAIRS * LANES == MOST);
