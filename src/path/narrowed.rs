//! A kernel that is narrowed on trial: by how much the deviation may grow for it on the legs that it reaches.
//!
//! A leg that has more than that left of its tolerance needs no other check. Far from the vertex that is most of them: where
//! dozens of kernels reach each leg a check takes as much as what is asked here of some seventy legs.

use super::chain::Chain;
use super::kernel;
use super::trial_kernel::TrialKernel;

/// Kernel terms that it takes to ask for a leg.
const ASKED: usize = 2;

/// See the module.
struct Narrowed {
    before: TrialKernel,
    after: TrialKernel,
}

impl Narrowed {
    /// By how much the deviation changes at a distance, without its sign.
    fn change(&self, distance: f64) -> f64 {
        let value = |trial: &TrialKernel| trial.size * trial.value(distance);
        (value(&self.before) - value(&self.after)).abs()
    }

    /// By how much more than at both of two distances the deviation changes between them, at most.
    fn between(&self, near: f64, far: f64) -> f64 {
        0.125 * (far - near) * (far - near) * self.bend_bound(near)
    }

    /// A bound of the second derivative of the change from a distance on.
    fn bend_bound(&self, distance: f64) -> f64 {
        let bound = |trial: &TrialKernel| {
            if distance < trial.reach {
                let majorant = kernel::majorant(distance * trial.inverse_reach, trial.mix);
                trial.size * trial.inverse_reach * majorant
            } else {
                0.0
            }
        };
        bound(&self.before) + bound(&self.after)
    }
}

/// Takes note that a vertex was narrowed on trial: it had this kernel `before`, reached `reach`, and reaches no farther now. Answers the
/// kernel terms that it took.
pub(super) fn touch(
    chain: &mut Chain,
    number: u64,
    before: &TrialKernel,
    reach: f64,
    next: u64,
) -> usize {
    let after = *chain.trial(number);
    if !(before.is_all() && after.is_all()) {
        return chain.touch(number, reach, next);
    }
    let narrowed = Narrowed {
        before: *before,
        after,
    };
    // Where the leg before ends this one begins.
    let mut known = (f64::NAN, 0.0);
    let mut cost = 0;
    let visited = chain.visit_reached(number, reach, next, |leg, near, far| {
        if !leg.check.unchecked {
            let (at, change) = known;
            let at_near = if at == near {
                change
            } else {
                narrowed.change(near)
            };
            let at_far = narrowed.change(far);
            known = (far, at_far);
            let between = narrowed.between(near, far);
            leg.check.grow(at_near.max(at_far) + between);
            cost += ASKED;
        }
    });
    visited + cost
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::deviation;
    use super::super::hardening::tests::chain_of;
    use super::super::reaching::Reaching;
    use super::super::settings::Allowance;
    use super::super::widths::Widths;
    use super::*;
    use crate::test_room::with_room;

    /// A chain whose legs have been checked with kernels of these widths and mixes, with tolerances so much greater than the bounds
    /// that were found.
    fn checked(
        displacements: &[([f64; 3], f64)],
        kernels: impl Fn(u64) -> (f64, f64),
        left: f64,
    ) -> (Chain, super::super::metric::Metric) {
        let (mut chain, metric) = chain_of(displacements);
        let next = chain.next();
        for number in 1..next {
            let (kernel, mix) = kernels(number);
            let widths = Widths {
                kernel,
                mix,
                ..Widths::NONE
            };
            chain.set_trial(number, widths);
            chain.touch(number, kernel, next);
        }
        let mut reaching = Reaching::NONE;
        for leg in 0..next {
            let verdict =
                deviation::check(&chain, leg, 1.0, next, &metric, &mut reaching, &mut None);
            let bound = chain.leg(leg).tolerance() - verdict.left;
            let place = chain.leg_mut(leg);
            place.allowance = Allowance::Tolerance(bound * (1.0 + left));
            place.check.keeps(bound * left);
        }
        (chain, metric)
    }

    /// Narrows a vertex to a share of its width.
    fn narrow(chain: &mut Chain, number: u64, share: f64) {
        let before = *chain.trial(number);
        let trial = chain.vertex(number).trial;
        let widths = Widths {
            kernel: share * trial.kernel,
            mix: trial.mix * (2.0 - share),
            ..trial
        };
        chain.set_trial(number, widths);
        let next = chain.next();
        touch(chain, number, &before, trial.kernel, next);
    }

    #[test]
    fn legs_far_from_what_is_narrowed_need_no_check() {
        let unchecked = with_room(|| {
            let lines = [([1.0, 0.0, 0.0], 90.0), ([0.8, 0.6, 0.0], 90.0)];
            let (mut chain, _) = checked(&lines.repeat(20), |_| (12.0, 0.0), 0.1);
            narrow(&mut chain, 20, 0.95);
            (0..chain.next())
                .filter(|leg| chain.leg(*leg).check.unchecked)
                .collect::<Vec<_>>()
        });
        assert!(unchecked.contains(&20), "{unchecked:?}");
        assert!(
            unchecked.iter().all(|leg| (12..=27).contains(leg)),
            "{unchecked:?}"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 200,
            failure_persistence: None,
            ..ProptestConfig::default()
        })]

        #[test]
        fn between_two_places_it_changes_no_more_than_is_said(
            reaches in prop::array::uniform2(0.1..9.0f64),
            mixes in prop::array::uniform2(0.0..1.2f64),
            near in 0.0..9.0f64,
            length in 0.0..9.0f64,
            share in 0.0..1.0f64,
        ) {
            let trial = |which: usize| TrialKernel {
                reach: reaches[which],
                inverse_reach: 1.0 / reaches[which],
                mix: mixes[which],
                size: 0.7,
                ..TrialKernel::NONE
            };
            let narrowed = Narrowed { before: trial(0), after: trial(1) };
            let far = near + length;
            let ends = narrowed.change(near).max(narrowed.change(far));
            let change = narrowed.change(near + share * length);
            prop_assert!(change <= ends + narrowed.between(near, far) + 1e-12);
        }

        #[test]
        fn what_is_not_checked_again_keeps_the_tolerance(
            displacements in prop::collection::vec(
                (prop::array::uniform3(-1.0..1.0f64), 90.0..91.0f64),
                3..40,
            ),
            kernels in prop::collection::vec((0.1..9.0f64, 0.0..1.2f64), 40),
            narrowings in prop::collection::vec((1..40u64, 0.0..1.0f64), 1..6),
            left in 0.01..1.0f64,
        ) {
            let exceeded = with_room(move || {
                let kernel = |number: u64| kernels[number as usize];
                let (mut chain, metric) = checked(&displacements, kernel, left);
                for (number, share) in narrowings {
                    if number < chain.next() {
                        narrow(&mut chain, number, share);
                    }
                }
                let mut reaching = Reaching::NONE;
                (0..chain.next())
                    .filter(|leg| !chain.leg(*leg).check.unchecked)
                    .find(|number| {
                        reaching.collect(&chain, *number, chain.next());
                        let leg = chain.leg(*number);
                        (0..=20).any(|place| {
                            let s = leg.start + leg.length * f64::from(place) / 20.0;
                            let deviation = reaching.deviation(&chain, s, &metric, 1.0);
                            deviation > leg.tolerance() * (1.0 + 1e-9)
                        })
                    })
            });
            prop_assert_eq!(exceeded, None);
        }
    }
}
