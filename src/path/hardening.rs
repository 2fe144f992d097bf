//! Widths that always hold.
//!
//! The stored assignment keeps 98 % of the tolerance, and is the programmed path at its end. A new
//! vertex there with a kernel of a hundredth of what would use up the tolerance on its own, no
//! wider than half its shorter leg, adds less than 1 % to its two legs and nothing to others. Each
//! leg has two ends: whatever comes, the next assignment keeps the tolerance too. Wider ones are
//! tried before, with a check. The next trial begins with all of the base widths of such vertices: one trial in a hundred fails,
//! and the 16 vertices of it would be narrow for good.

use super::chain::Chain;
use super::deviation;
use super::metric::Metric;
use super::reaching::Reaching;
use super::widths::Widths;
use super::window::Window;
use super::{easement, kernel};

/// Of what would use up the tolerance, what is tried one after another.
const SHARES: [f64; ATTEMPTS] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

/// How many there are.
pub(super) const ATTEMPTS: usize = 6;

/// Of the tolerance, what a hardened vertex would use up with a share of 1.
const TOLERANCE_SHARE: f64 = 0.98;

/// Gives a new vertex trial widths of its attempt's share. The vertices after it must have none
/// yet. Answers whether the tolerance is kept, and the kernel terms it took; the last attempt
/// always keeps it.
pub(super) fn harden(
    chain: &mut Chain,
    number: u64,
    attempt: usize,
    window: &Window,
    metric: &Metric,
    reaching: &mut Reaching,
) -> (bool, usize) {
    let clip = window.clip(chain, number);
    let share = SHARES.get(attempt).copied().unwrap_or(0.01);
    let vertex = chain.vertex_mut(number);
    if !vertex.is_smoothed() {
        chain.set_trial(number, Widths::NONE);
        return (true, 1);
    }
    let room = vertex.half_leg.min(clip);
    let tolerance = TOLERANCE_SHARE * vertex.tolerance;
    let kernel = if vertex.tangent_jump_size > 0.0 {
        (tolerance / (kernel::peak(vertex.corner.mix) * vertex.tangent_jump_size)).min(room)
    } else {
        0.0
    };
    let easement = if vertex.curvature_jump_size > 0.0 {
        (tolerance / (easement::PEAK * vertex.curvature_jump_size))
            .sqrt()
            .min(room)
    } else {
        0.0
    };
    // Without a tolerance half legs always hold.
    let free = vertex.free_kernel.min(clip);
    let free_easement = vertex.free_easement.min(clip);
    let widths = Widths {
        kernel: free.max(share * kernel),
        mix: vertex.corner.mix,
        easement: free_easement.max(share * easement),
        ..Widths::NONE
    };
    chain.set_trial(number, widths);
    let vertex = chain.vertex_mut(number);
    let reach = vertex.trial.reach();
    let mut cost = chain.touch(number, reach, window.next);
    let mut holds = true;
    let mut known = None;
    for leg in [number.saturating_sub(1), number] {
        let verdict = deviation::check(chain, leg, 1.0, window.next, metric, reaching, &mut known);
        cost += verdict.cost;
        holds &= verdict.violation.is_none();
    }
    (holds, cost)
}

#[cfg(test)]
pub(super) mod tests {
    use proptest::prelude::*;

    use super::super::jump::JumpSum;
    use super::super::leg::{Leg, ProgrammedMove};
    use super::super::settings::{Allowance, BlendSettings};
    use super::*;
    use crate::axes::Axes;
    use crate::moves::shape::{Line9, Shape};
    use crate::moves::{NearLimit, TerminationCondition};
    use crate::test_room::with_room;

    /// Lines in XYZ, each given by its displacement and tolerance.
    pub(in crate::path) fn lines(
        displacements: &[([f64; 3], f64)],
        settings: &BlendSettings,
        chain: &mut Chain,
    ) {
        let metric = Metric::new(settings.rotary_weight());
        let mut at = Axes::zeros();
        for (displacement, tolerance) in displacements {
            let mut end = at;
            for (end, step) in end.iter_mut().zip(displacement) {
                *end += step;
            }
            let Ok(line) = Line9::new(&at, &end) else {
                continue;
            };
            let programmed = ProgrammedMove {
                serial: 0,
                shape: Shape::Line(line),
                feed: 50.0,
                feed_word: None,
                greatest_feed: 50.0,
                termination: TerminationCondition::Continuous {
                    tolerance: *tolerance,
                },
                stop_before: false,
                separate: false,
                may_swing_out: true,
                near_limit: NearLimit::NONE,
            };
            chain.push(Leg::new(&programmed, settings, &metric), settings, &metric);
            at = end;
        }
    }

    /// A chain of them with the settings where nothing is configured.
    pub(in crate::path) fn chain_of(displacements: &[([f64; 3], f64)]) -> (Chain, Metric) {
        let settings = BlendSettings::DEFAULT;
        let mut chain = Chain::new();
        lines(displacements, &settings, &mut chain);
        (chain, Metric::new(settings.rotary_weight()))
    }

    #[test]
    fn what_does_not_fit_beside_a_wide_kernel_is_seen() {
        let answers = with_room(|| {
            let (mut chain, metric) = chain_of(&[
                ([10.0, 0.0, 0.0], 9.0),
                ([1.0, 1.0, 0.0], 9.0),
                ([0.0, 1.0, 0.0], 9.0),
            ]);
            // The first corner alone uses 97 % of the tolerance at the second.
            let wide = Widths {
                kernel: 5.0,
                ..Widths::NONE
            };
            let (first, second) = (*chain.vertex(1), *chain.vertex(2));
            let mut deviation = JumpSum::ZERO;
            first.add_deviation(&wide, second.s - first.s, &mut deviation);
            let tolerance = metric.norm(&deviation.axes()) / 0.97;
            chain.set_trial(1, wide);
            let next = chain.next();
            chain.touch(1, wide.reach(), next);
            chain.vertex_mut(2).tolerance = tolerance;
            chain.leg_mut(2).allowance = Allowance::Tolerance(tolerance);
            let window = Window {
                next: chain.next(),
                end: chain.end(),
                ..Window::EMPTY
            };
            let mut reaching = Reaching::NONE;
            [0, ATTEMPTS - 1]
                .map(|attempt| harden(&mut chain, 2, attempt, &window, &metric, &mut reaching).0)
        });
        assert_eq!(answers, [false, true]);
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            cases: 100,
            failure_persistence: None,
            ..ProptestConfig::default()
        })]

        #[test]
        fn the_last_attempt_always_holds(
            displacements in prop::collection::vec(
                (prop::array::uniform3(-1.0..1.0f64), 0.0005..1.0f64),
                2..60,
            ),
            attempt in 0..ATTEMPTS,
        ) {
            let failed = with_room(move || {
                    let (mut chain, metric) = chain_of(&displacements);
                    let window = Window { next: chain.next(), end: chain.end(), ..Window::EMPTY };
                    let mut reaching = Reaching::NONE;
                    for number in chain.first()..chain.next() {
                        let held = (attempt..ATTEMPTS).any(|attempt| {
                            harden(&mut chain, number, attempt, &window, &metric, &mut reaching).0
                        });
                        assert!(held, "vertex {number}");
                        // The next trial begins with all of its base widths.
                        assert_eq!(chain.vertex(number).factor, 1.0, "vertex {number}");
                    }
                    (chain.first()..chain.next()).find(|leg| {
                        deviation::check(&chain, *leg, 1.0, window.next, &metric, &mut reaching, &mut None)
                            .violation
                            .is_some()
                    })
                });
            prop_assert_eq!(failed, None);
        }
    }
}
