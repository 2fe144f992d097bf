//! The vertices that reach into a leg with those of their trial widths that count, laid out to be added up two at a
//! time.

use wide::f64x2;

use super::chain::{Chain, NEIGHBOURS};
use super::jump::{GROUP_SIZE, GROUPS, JumpSum};
use super::kernel;
use super::metric::Metric;
use super::shift;
use super::trial_kernel::TrialKernel;
use super::vertex::Vertex;

/// The most vertices that reach into a leg.
const MOST: usize = 2 * NEIGHBOURS as usize;

/// Kernels in a register.
const LANES: usize = 2;

/// The most kernels of a vertex.
pub(super) const KERNELS: usize = 2;

/// Two kernels of vertices, none of them with a share of K8.
#[derive(Clone, Copy, Debug)]
struct KernelPair {
    s: [f64; LANES],
    /// 0 where there is none.
    width: [f64; LANES],
    mix: [f64; LANES],
    /// Length of the jump of the tangent.
    size: [f64; LANES],
    jump: [[[f64; LANES]; GROUP_SIZE]; GROUPS],
}

impl KernelPair {
    const NONE: Self = Self {
        s: [0.0; LANES],
        width: [0.0; LANES],
        mix: [0.0; LANES],
        size: [0.0; LANES],
        jump: [[[0.0; LANES]; GROUP_SIZE]; GROUPS],
    };

    /// Whether a vertex has nothing but such kernels.
    #[inline(always)]
    fn suits(vertex: &Vertex) -> bool {
        vertex.counted.mix >= 0.0 && vertex.counted.easement <= 0.0
    }

    /// Puts a kernel of a vertex in, so many times, of which `G` groups of axes jump. Beside the first one there is no
    /// other yet.
    #[inline(always)]
    fn set<const G: usize>(
        &mut self,
        is_second: bool,
        vertex: &Vertex,
        width: f64,
        mix: f64,
        times: f64,
    ) {
        let lane = usize::from(is_second);
        if !is_second {
            self.width = [0.0; LANES];
        }
        self.s[lane] = vertex.s;
        self.width[lane] = width;
        self.mix[lane] = mix;
        self.size[lane] = times.abs() * vertex.tangent_jump_size;
        let groups = self.jump.iter_mut().zip(vertex.tangent_jump.groups());
        for (axes, group) in groups.take(G) {
            for (lanes, axis) in axes.iter_mut().zip(group) {
                lanes[lane] = times * axis;
            }
        }
    }

    /// Puts a kernel in of which X, Y and Z alone jump. Beside the first one there is no other yet.
    #[inline(always)]
    fn set_linear(&mut self, lane: usize, trial: &TrialKernel) {
        if lane == 0 {
            self.width = [0.0; LANES];
        }
        self.s[lane] = trial.s;
        self.width[lane] = trial.reach;
        self.mix[lane] = trial.mix;
        self.size[lane] = trial.size;
        let [linear, ..] = &mut self.jump;
        for (lanes, axis) in linear.iter_mut().zip(trial.linear_jump) {
            lanes[lane] = axis;
        }
    }

    /// Adds the deviations at `s`.
    #[inline(always)]
    fn add_deviation<const G: usize>(&self, s: f64, sum: &mut [[f64x2; GROUP_SIZE]; G]) {
        let width = f64x2::new(self.width);
        let distance = (s - f64x2::new(self.s)).abs();
        let value = width * kernel::values(distance / width, f64x2::new(self.mix));
        // Beyond the width the polynomial means nothing, and where there is no kernel it is no number.
        let value = value & distance.simd_lt(width);
        for (sums, jumps) in sum.iter_mut().zip(&self.jump) {
            for (sum, jump) in sums.iter_mut().zip(jumps) {
                *sum += f64x2::new(*jump) * value;
            }
        }
    }

    /// Bounds of the second derivatives of the deviations between `from` and `to`.
    #[inline(always)]
    fn bend_bounds(&self, from: f64, to: f64) -> f64x2 {
        let (s, width) = (f64x2::new(self.s), f64x2::new(self.width));
        let distance = (from - s).fast_max(s - to).fast_max(f64x2::ZERO);
        let majorants = kernel::majorants(distance / width, f64x2::new(self.mix));
        (f64x2::new(self.size) / width * majorants) & distance.simd_lt(width)
    }
}

/// The vertices that reach into a leg. Kept, since it takes as long to clear as to fill.
#[derive(Debug)]
pub(super) struct Reaching {
    pairs: [KernelPair; KERNELS * MOST / LANES],
    /// How many kernels there are in these.
    in_pairs: usize,
    /// The numbers of those with an easement or a share of K8.
    others: [u64; MOST],
    /// How many of those there are.
    in_others: usize,
    /// Up to where those on the left reach, and from where on those on the right do, within the leg.
    ends: [f64; 2],
    /// Number of the leg.
    leg: u64,
}

impl Reaching {
    pub const NONE: Self = Self {
        pairs: [KernelPair::NONE; KERNELS * MOST / LANES],
        in_pairs: 0,
        others: [0; MOST],
        in_others: 0,
        ends: [0.0; 2],
        leg: 0,
    };

    /// Collects those of a leg that are below `next`.
    pub fn collect(&mut self, chain: &Chain, number: u64, next: u64) {
        if chain.is_linear() {
            self.collect_groups::<1>(chain, number, next);
        } else {
            self.collect_groups::<GROUPS>(chain, number, next);
        }
    }

    /// The same where the first `G` groups of axes jump.
    fn collect_groups<const G: usize>(&mut self, chain: &Chain, number: u64, next: u64) {
        let leg = chain.leg(number);
        let (start, end) = (leg.start, leg.end());
        self.in_pairs = 0;
        self.in_others = 0;
        let (mut from_left, mut from_right) = (start, end);
        for k in 0..u64::from(leg.reached_from_left) {
            let left = number.wrapping_sub(k);
            let trial = chain.trial(left);
            let far = trial.s + trial.reach;
            if far > start {
                self.add::<G>(chain, left, trial);
                from_left = if far > from_left { far } else { from_left };
            }
        }
        let right = u64::from(leg.reached_from_right).min(next.saturating_sub(number + 1));
        for k in 1..=right {
            let right = number.wrapping_add(k);
            let trial = chain.trial(right);
            let near = trial.s - trial.reach;
            if near < end {
                self.add::<G>(chain, right, trial);
                from_right = if near < from_right { near } else { from_right };
            }
        }
        self.leg = number;
        self.ends = [from_left.min(end), from_right.max(start)];
    }

    #[inline(always)]
    fn add<const G: usize>(&mut self, chain: &Chain, number: u64, trial: &TrialKernel) {
        if G == 1 && trial.is_all {
            if let Some(pair) = self.pairs.get_mut(self.in_pairs / LANES) {
                pair.set_linear(self.in_pairs % LANES, trial);
                self.in_pairs += 1;
            }
        } else {
            self.add_all::<G>(number, chain.vertex(number));
        }
    }

    #[inline(never)]
    fn add_all<const G: usize>(&mut self, number: u64, vertex: &Vertex) {
        let widths = &vertex.counted;
        if !KernelPair::suits(vertex) {
            if let Some(other) = self.others.get_mut(self.in_others) {
                *other = number;
                self.in_others += 1;
            }
        } else {
            self.add_kernel::<G>(vertex, widths.kernel, widths.mix, 1.0 + widths.outer_share);
            if widths.outer > 0.0 {
                self.add_kernel::<G>(vertex, widths.outer, 0.0, -widths.outer_share);
            }
        }
    }

    #[inline(always)]
    fn add_kernel<const G: usize>(&mut self, vertex: &Vertex, width: f64, mix: f64, times: f64) {
        if let Some(pair) = self.pairs.get_mut(self.in_pairs / LANES) {
            pair.set::<G>(self.in_pairs % LANES == 1, vertex, width, mix, times);
            self.in_pairs += 1;
        }
    }

    /// How many kernels they have; one with an easement or a share of K8 counts as one.
    pub fn count(&self) -> usize {
        self.in_pairs + self.in_others
    }

    /// Up to where those on the left reach, and from where on those on the right do, within the leg; path distances.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    fn pairs(&self) -> impl Iterator<Item = &KernelPair> {
        self.pairs.iter().take(self.in_pairs.div_ceil(LANES))
    }

    fn others<'a>(&self, chain: &'a Chain) -> impl Iterator<Item = &'a Vertex> {
        let numbers = self.others.iter().take(self.in_others);
        numbers.map(|number| chain.vertex(*number))
    }

    /// How far the blended path is from the programmed one at `s`, within the leg, where a degree of C counts a share.
    pub fn deviation(&self, chain: &Chain, s: f64, metric: &Metric, turn_share: f64) -> f64 {
        let mut sum = if chain.is_linear() {
            self.sum_of_pairs::<1>(s)
        } else {
            self.sum_of_pairs::<GROUPS>(s)
        };
        for vertex in self.others(chain) {
            vertex.add_deviation(&vertex.counted, s - vertex.s, &mut sum);
        }
        let mut deviation = sum.axes();
        shift::add(&mut deviation, &chain.leg(self.leg).shift_at(s));
        metric.deviation(&deviation, turn_share)
    }

    #[inline(always)]
    fn sum_of_pairs<const G: usize>(&self, s: f64) -> JumpSum<1> {
        let mut sum = [[f64x2::ZERO; GROUP_SIZE]; G];
        for pair in self.pairs() {
            pair.add_deviation(s, &mut sum);
        }
        JumpSum::of_groups(&sum.map(|group| group.map(f64x2::reduce_add)))
    }

    /// A bound of the second derivative of the deviation between `from` and `to`.
    pub fn bend_bound(&self, chain: &Chain, from: f64, to: f64) -> f64 {
        let bounds = self.pairs().map(|pair| pair.bend_bounds(from, to));
        let of_pairs = bounds.fold(f64x2::ZERO, |sum, bounds| sum + bounds);
        let of_others = self.others(chain).map(|vertex| {
            let distance = (from - vertex.s).max(vertex.s - to).max(0.0);
            vertex.bend_bound(&vertex.counted, distance)
        });
        of_pairs.reduce_add() + of_others.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::super::leg::{Leg, ProgrammedMove};
    use super::super::settings::BlendSettings;
    use super::super::widths::Widths;
    use super::*;
    use crate::axes::Axes;
    use crate::moves::shape::{Line9, Shape};
    use crate::moves::{NearLimit, TerminationCondition};

    /// Forty lines that turn all the time, in XYZ or in as many axes as that, and widths on trial of all kinds.
    fn with_curve<R: Send + 'static>(axes: usize, test: fn(&Chain, &Metric) -> R) -> R {
        let run = move || {
            let settings = BlendSettings::DEFAULT;
            let metric = Metric::new(settings.rotary_weight());
            let mut chain = Chain::new();
            let mut at = Axes::zeros();
            for serial in 0..40u32 {
                let angle = 0.3 * f64::from(serial);
                let end = at
                    + Axes::from_fn(|axis, _| match axis {
                        0 => angle.cos(),
                        1 => angle.sin(),
                        _ if axis < axes => 0.1 * (angle * axis as f64).sin(),
                        _ => 0.0,
                    });
                let programmed = ProgrammedMove {
                    serial: serial.into(),
                    shape: Shape::Line(Line9::new(&at, &end).expect("a line")),
                    feed: 50.0,
                    greatest_feed: 50.0,
                    termination: TerminationCondition::Continuous { tolerance: 0.1 },
                    stop_before: false,
                    separate: false,
                    may_swing_out: true,
                    near_limit: NearLimit::NONE,
                };
                chain.push(
                    Leg::new(&programmed, &settings, &metric),
                    &settings,
                    &metric,
                );
                at = end;
            }
            let next = chain.next();
            for number in 1..next {
                let widths = Widths {
                    kernel: [7.3, 2.1, 0.0][number as usize % 3],
                    mix: [0.2, 1.1, 0.0, -0.5][number as usize % 4],
                    outer: [11.0, 0.0, 0.0, 9.2, 0.0][number as usize % 5],
                    outer_share: [0.3, 0.0, 0.0, 1.4, 0.0][number as usize % 5],
                    easement: if number % 5 == 0 { 1.7 } else { 0.0 },
                };
                chain.set_trial(number, widths);
                chain.touch(number, widths.reach(), next);
            }
            test(&chain, &metric)
        };
        std::thread::Builder::new()
            .stack_size(16 << 20)
            .spawn(run)
            .expect("a thread")
            .join()
            .expect("the test itself")
    }

    #[test]
    fn sums_are_those_of_all_vertices() {
        for axes in [3, 9] {
            let linear = with_curve(axes, |chain, metric| {
                let mut reaching = Reaching::NONE;
                for number in 0..chain.next() {
                    reaching.collect(chain, number, chain.next());
                    let leg = chain.leg(number);
                    for share in [0.0, 0.3, 1.0] {
                        let s = leg.start + share * leg.length;
                        let (mut sum, mut bound) = (JumpSum::ZERO, 0.0);
                        for vertex in (1..chain.next()).map(|number| chain.vertex(number)) {
                            let counted = &vertex.counted;
                            vertex.add_deviation(counted, s - vertex.s, &mut sum);
                            let near = (leg.start - vertex.s).max(vertex.s - leg.end()).max(0.0);
                            bound += vertex.bend_bound(counted, near);
                        }
                        let expected = metric.deviation(&sum.axes(), 0.7);
                        let deviation = reaching.deviation(chain, s, metric, 0.7);
                        assert!((deviation - expected).abs() < 1e-12, "{number} {share}");
                        let bend = reaching.bend_bound(chain, leg.start, leg.end());
                        assert!(
                            (bend - bound).abs() < 1e-12 * bound,
                            "{number}: {bend} {bound}"
                        );
                    }
                }
                chain.is_linear()
            });
            assert_eq!(linear, axes == 3);
        }
    }

    #[test]
    fn those_that_reach_into_a_leg_and_no_others_are_counted() {
        let counts = with_curve(3, |chain, _| {
            let mut reaching = Reaching::NONE;
            [10, 20, 39].map(|number| {
                reaching.collect(chain, number, chain.next());
                let leg = chain.leg(number);
                let reaches = |vertex: &Vertex| {
                    let reach = vertex.counted.reach();
                    vertex.s + reach > leg.start && vertex.s - reach < leg.end()
                };
                let all = (1..chain.next()).map(|number| chain.vertex(number));
                let kernels = all.filter(|vertex| reaches(vertex)).map(|vertex| {
                    1 + usize::from(KernelPair::suits(vertex) && vertex.counted.outer > 0.0)
                });
                (reaching.count(), kernels.sum::<usize>())
            })
        });
        for (collected, all) in counts {
            assert_eq!(collected, all);
        }
    }
}
