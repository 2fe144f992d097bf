//! The vertices that reach into a leg with those of their trial widths that count.

use super::chain::{Chain, NEIGHBOURS};
use super::jump::GROUPS;
use super::kernel_lanes::KernelLanes;
use super::linear_axes;
use super::metric::Metric;
use super::trial_kernel::TrialKernel;
use super::vertex::Vertex;
use super::widths::FurtherKernel;

/// The most vertices that reach into a leg.
const MOST: usize = 2 * NEIGHBOURS as usize;

/// The vertices that reach into a leg. Kept, since it takes as long to clear as to fill.
#[derive(Debug)]
pub(super) struct Reaching {
    /// The kernels of those that have nothing else.
    kernels: KernelLanes,
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
        kernels: KernelLanes::NONE,
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
        self.kernels.clear();
        self.in_others = 0;
        let (mut from_left, mut from_right) = (start, end);
        let left = u64::from(leg.reached_from_left);
        let mut at = number;
        let farthest = number.wrapping_add(1).wrapping_sub(left);
        for part in chain.trials(farthest, left).into_iter().rev() {
            for trial in part.iter().rev() {
                let far = trial.s + trial.reach;
                if far > start {
                    self.add::<G>(chain, at, trial);
                    from_left = if far > from_left { far } else { from_left };
                }
                at = at.wrapping_sub(1);
            }
        }
        let right = u64::from(leg.reached_from_right).min(next.saturating_sub(number + 1));
        let mut at = number;
        for part in chain.trials(number.wrapping_add(1), right) {
            for trial in part {
                at = at.wrapping_add(1);
                let near = trial.s - trial.reach;
                if near < end {
                    self.add::<G>(chain, at, trial);
                    from_right = if near < from_right { near } else { from_right };
                }
            }
        }
        self.kernels.end();
        self.leg = number;
        self.ends = [from_left.min(end), from_right.max(start)];
    }

    #[inline(always)]
    fn add<const G: usize>(&mut self, chain: &Chain, number: u64, trial: &TrialKernel) {
        if G == 1 && trial.is_all() {
            self.kernels.push_linear(trial);
        } else {
            self.add_all::<G>(number, chain.vertex(number));
        }
    }

    #[inline(never)]
    fn add_all<const G: usize>(&mut self, number: u64, vertex: &Vertex) {
        let widths = &vertex.counted;
        if !has_kernels_alone(vertex) {
            if let Some(other) = self.others.get_mut(self.in_others) {
                *other = number;
                self.in_others += 1;
            }
        } else {
            let times = widths.own_share();
            self.kernels
                .push::<G>(vertex, widths.kernel, widths.mix, times);
            for FurtherKernel { width, share } in widths.further {
                if width > 0.0 {
                    self.kernels.push::<G>(vertex, width, 0.0, share);
                }
            }
        }
    }

    /// How many kernels they have; one with an easement or a share of K8 counts as one.
    pub fn count(&self) -> usize {
        self.kernels.count() + self.in_others
    }

    /// Up to where those on the left reach, and from where on those on the right do, within the leg; path distances.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    fn others<'a>(&self, chain: &'a Chain) -> impl Iterator<Item = &'a Vertex> {
        let numbers = self.others.iter().take(self.in_others);
        numbers.map(|number| chain.vertex(*number))
    }

    /// How far the blended path is at `s` from the leg, within it, where a degree of C counts a share.
    pub fn deviation(&self, chain: &Chain, s: f64, metric: &Metric, turn_share: f64) -> f64 {
        let mut sum = if chain.is_linear() {
            self.kernels.deviation::<1>(s)
        } else {
            self.kernels.deviation::<GROUPS>(s)
        };
        for vertex in self.others(chain) {
            vertex.add_deviation(&vertex.counted, s - vertex.s, &mut sum);
        }
        let mut deviation = sum.axes();
        let leg = chain.leg(self.leg);
        linear_axes::add(&mut deviation, &leg.shift_at(s));
        leg.take_off_along(s, metric, &mut deviation);
        metric.deviation(&deviation, turn_share)
    }

    /// A bound of the second derivative of the deviation between `from` and `to`.
    pub fn bend_bound(&self, chain: &Chain, from: f64, to: f64) -> f64 {
        let of_others = self.others(chain).map(|vertex| {
            let distance = (from - vertex.s).max(vertex.s - to).max(0.0);
            vertex.bend_bound(&vertex.counted, distance)
        });
        self.kernels.bend_bound(from, to) + of_others.sum::<f64>()
    }
}

/// Whether a vertex has nothing but kernels without a share of K8.
#[inline(always)]
fn has_kernels_alone(vertex: &Vertex) -> bool {
    vertex.counted.mix >= 0.0 && vertex.counted.easement <= 0.0
}

#[cfg(test)]
mod tests {
    use super::super::jump::JumpSum;
    use super::super::leg::{Leg, ProgrammedMove};
    use super::super::settings::BlendSettings;
    use super::super::widths::Widths;
    use super::*;
    use crate::axes::Axes;
    use crate::moves::shape::{Line9, Shape};
    use crate::moves::{NearLimit, TerminationCondition};
    use crate::test_room::with_room;

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
                    feed_word: None,
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
                    further: [
                        FurtherKernel {
                            width: [11.0, 0.0, 0.0, 9.2, 0.0][number as usize % 5],
                            share: [-0.3, 0.0, 0.0, -1.4, 0.0][number as usize % 5],
                        },
                        FurtherKernel {
                            width: [0.0, 0.0, 1.1, 2.3, 0.0][number as usize % 5],
                            share: [0.0, 0.0, 0.2, 0.4, 0.0][number as usize % 5],
                        },
                    ],
                    easement: if number % 5 == 0 { 1.7 } else { 0.0 },
                };
                chain.set_trial(number, widths);
                chain.touch(number, widths.reach(), next);
            }
            test(&chain, &metric)
        };
        with_room(run)
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
                        let mut expected = sum.axes();
                        leg.take_off_along(s, metric, &mut expected);
                        let expected = metric.deviation(&expected, 0.7);
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
                    let further = vertex.counted.further.iter();
                    let further = further.filter(|further| further.width > 0.0).count();
                    if has_kernels_alone(vertex) {
                        1 + further
                    } else {
                        1
                    }
                });
                (reaching.count(), kernels.sum::<usize>())
            })
        });
        for (collected, all) in counts {
            assert_eq!(collected, all);
        }
    }
}
