//! Which vertices are narrowed where a trial leaves the tolerance.
//!
//! A vertex is to blame by how much of the deviation there is its own, times its reach: of two that add the same
//! the wider one loses less. To narrow all that reach the place makes vertices narrow that have nothing to do with it.

use super::chain::{Chain, NEIGHBOURS};
use super::deviation::Violation;
use super::jump::{GROUP_SIZE, JumpSum};
use super::linear_axes;
use super::metric::Metric;
use super::vertex::Vertex;
use super::window::Window;

/// Vertices with at least this share of the greatest blame are narrowed.
const BLAMED: f64 = 0.5;

/// The most vertices that reach a leg.
const MOST: usize = 2 * NEIGHBOURS as usize;

/// A vertex is narrowed to this share of its widths at least, and at most: with less than a few per cent at a time a trial
/// does not come to its end.
const MOST_NARROWED: f64 = 0.7;
const LEAST_NARROWED: f64 = 0.97;

/// Where more kernels than this reach a leg a trial takes long, and small steps would not end: the more of it is spent, the
/// larger they are.
pub(super) const MANY_KERNELS: usize = 12;

/// What a vertex among so many is narrowed to at most when all of a trial is spent.
const NARROWED_IN_THE_END: f64 = 0.75;

/// On a curve all steps are alike where there are so many kernels: single ones that are narrower than their neighbours leave it
/// uneven.
const NARROWED_ON_CURVE: f64 = 0.93;

/// To what share of its widths a vertex is narrowed for a violation, where this share of the trial is `spent`. The deviation on a
/// curve grows with the square of the widths: narrowed by more than that, a corner would be so narrow that a little more feed or
/// tolerance cost a tenth of the time.
fn narrowing(violation: &Violation, on_curve: bool, spent: f64) -> f64 {
    let many = violation.kernels > MANY_KERNELS;
    if many && on_curve {
        return NARROWED_ON_CURVE;
    }
    let most = if many {
        LEAST_NARROWED - (LEAST_NARROWED - NARROWED_IN_THE_END) * spent
    } else {
        LEAST_NARROWED
    };
    let share = violation.allowed.sqrt();
    // `clamp` would panic if the bounds were the wrong way round.
    share.min(most).max(MOST_NARROWED)
}

/// Marks the open vertices that are to blame for a violation of the tolerance on a leg. `near_end`: it may be due to the
/// end of what is known. `spent`: of what a trial may take, the share that it has taken, 0 to 1. Answers the kernel terms that it
/// took.
pub(super) fn mark(
    chain: &mut Chain,
    leg: u64,
    violation: Violation,
    near_end: bool,
    window: &Window,
    metric: &Metric,
    spent: f64,
) -> usize {
    let s = violation.s;
    let from = leg
        .saturating_sub(NEIGHBOURS - 1)
        .max(window.open)
        .max(chain.first());
    let to = leg.saturating_add(1 + NEIGHBOURS).min(window.next);
    let blames = blames(chain, leg, s, from..to, metric);
    let greatest = blames.iter().copied().fold(0.0, f64::max);
    for (blame, number) in blames.into_iter().zip(from..to) {
        let on_curve = chain.leg(number).ends_curve;
        let vertex = chain.vertex_mut(number);
        if blame > 0.0 && blame >= BLAMED * greatest && reaches(vertex, s) {
            vertex.narrowing = vertex.narrowing.min(narrowing(&violation, on_curve, spent));
            vertex.marked_temporarily |= near_end;
        }
    }
    2 * to.saturating_sub(from) as usize
}

/// By how much each of the `vertices` is to blame for the deviation of a leg at a place. Those that are held are not narrowed whatever
/// they add.
fn blames(
    chain: &Chain,
    leg: u64,
    s: f64,
    vertices: core::ops::Range<u64>,
    metric: &Metric,
) -> [f64; MOST] {
    let count = vertices.end.saturating_sub(vertices.start);
    let trials = || {
        let row = chain.trials(vertices.start, count).into_iter().flatten();
        row.zip(vertices.clone())
    };
    // What most of them are to be multiplied by is asked for once.
    let mut values = [0.0; MOST];
    let mut linear = [0.0; GROUP_SIZE];
    let mut others = JumpSum::ZERO;
    for ((trial, number), value) in trials().zip(&mut values) {
        if chain.is_linear() && trial.is_all() {
            *value = trial.value((s - trial.s).abs());
            for (sum, axis) in linear.iter_mut().zip(&trial.linear_jump) {
                *sum += *value * axis;
            }
        } else {
            let vertex = chain.vertex(number);
            vertex.add_deviation(&vertex.counted, s - vertex.s, &mut others);
        }
    }
    let mut total = others.axes() + JumpSum::of_groups(&[linear]).axes();
    let place = chain.leg(leg);
    linear_axes::add(&mut total, &place.shift_at(s));
    place.take_off_along(s, metric, &mut total);
    let mut blames = [0.0; MOST];
    for (((trial, number), value), blame) in trials().zip(values).zip(&mut blames) {
        if chain.vertex(number).held {
            continue;
        }
        *blame = trial.reach
            * if chain.is_linear() && trial.is_all() {
                let axes = trial.linear_jump.iter().zip(total.iter());
                value * axes.map(|(jump, total)| jump * total).sum::<f64>()
            } else {
                let vertex = chain.vertex(number);
                let mut own = JumpSum::ZERO;
                vertex.add_deviation(&vertex.counted, s - vertex.s, &mut own);
                metric.product(&own.axes(), &total)
            };
    }
    blames
}

fn reaches(vertex: &Vertex, s: f64) -> bool {
    (vertex.s - s).abs() < vertex.counted.reach()
}

#[cfg(test)]
mod tests {
    use super::super::hardening::tests::chain_of;
    use super::super::widths::Widths;
    use super::*;
    use crate::test_room::with_room;

    /// What the first and the second corner of a bend are narrowed to for the deviation at the second, of which .81 is
    /// allowed, with kernels of these widths.
    fn marked(widths: [f64; 2]) -> [f64; 2] {
        marked_among(2, widths, [false; 2], 0.0)
    }

    /// The same among so many kernels, where the legs behind the corners end a curve or do not, and so much of the trial is spent.
    fn marked_among(kernels: usize, widths: [f64; 2], on_curve: [bool; 2], spent: f64) -> [f64; 2] {
        marked_where(kernels, widths, spent, move |chain| {
            for (number, on_curve) in (1..).zip(on_curve) {
                chain.leg_mut(number).ends_curve = on_curve;
            }
        })
    }

    /// The same of a bend that was prepared.
    fn marked_where(
        kernels: usize,
        widths: [f64; 2],
        spent: f64,
        prepare: impl Fn(&mut Chain) + Send + 'static,
    ) -> [f64; 2] {
        with_room(move || {
            let (mut chain, metric) = chain_of(&[
                ([10.0, 0.0, 0.0], 9.0),
                ([1.0, 1.0, 0.0], 9.0),
                ([0.0, 10.0, 0.0], 9.0),
            ]);
            for (number, kernel) in (1..).zip(widths) {
                let widths = Widths {
                    kernel,
                    ..Widths::NONE
                };
                chain.set_trial(number, widths);
            }
            prepare(&mut chain);
            let window = Window {
                next: chain.next(),
                end: chain.end(),
                ..Window::EMPTY
            };
            let s = chain.vertex(2).s;
            let violation = Violation {
                s,
                allowed: 0.81,
                kernels,
            };
            mark(&mut chain, 1, violation, false, &window, &metric, spent);
            [1, 2].map(|number| chain.vertex(number).narrowing)
        })
    }

    #[test]
    fn one_that_is_held_is_not_narrowed_whatever_it_adds() {
        let narrowed = |held: &'static [u64]| {
            marked_where(2, [8.0, 0.5], 0.0, move |chain| {
                for number in held {
                    chain.vertex_mut(*number).held = true;
                }
            })
        };
        assert_eq!(narrowed(&[]), [0.9, 1.0]);
        assert_eq!(narrowed(&[1]), [1.0, 0.9]);
        assert_eq!(narrowed(&[1, 2]), [1.0, 1.0]);
    }

    /// What a vertex is narrowed to where so many kernels reach the leg and so much of the trial is spent, for these shares of the
    /// deviation that are allowed.
    fn narrowed(kernels: usize, on_curve: bool, spent: f64, allowed: [f64; 4]) -> [f64; 4] {
        allowed.map(|allowed| {
            let violation = Violation {
                s: 0.0,
                allowed,
                kernels,
            };
            narrowing(&violation, on_curve, spent)
        })
    }

    #[test]
    fn the_more_there_is_too_much_the_more_is_narrowed() {
        let expected = [0.97, 0.9f64.sqrt(), 0.9, 0.7];
        for (kernels, on_curve, spent) in [
            (MANY_KERNELS, false, 0.0),
            (MANY_KERNELS, true, 1.0),
            (MANY_KERNELS + 1, false, 0.0),
        ] {
            let found = narrowed(kernels, on_curve, spent, [0.999, 0.9, 0.81, 0.1]);
            assert_eq!(found, expected, "{kernels} {on_curve} {spent}");
        }
    }

    #[test]
    fn among_many_steps_grow_with_what_is_spent() {
        let of = |spent| narrowed(MANY_KERNELS + 1, false, spent, [0.999, 0.81, 0.64, 0.1]);
        assert_eq!(of(0.5), [0.86, 0.86, 0.8, 0.7]);
        assert_eq!(of(1.0), [0.75, 0.75, 0.75, 0.7]);
        assert_eq!(of(1.5), [0.7; 4]);
    }

    #[test]
    fn each_vertex_is_narrowed_as_where_it_lies_and_by_what_is_spent() {
        let of = |on_curve, spent| marked_among(MANY_KERNELS + 1, [9.0, 5.0], on_curve, spent);
        assert_eq!(of([false; 2], 0.0), [0.9; 2]);
        assert_eq!(of([false; 2], 1.0), [NARROWED_IN_THE_END; 2]);
        assert_eq!(
            of([true, false], 1.0),
            [NARROWED_ON_CURVE, NARROWED_IN_THE_END]
        );
        assert_eq!(
            of([false, true], 1.0),
            [NARROWED_IN_THE_END, NARROWED_ON_CURVE]
        );
    }

    #[test]
    fn among_many_on_a_curve_all_steps_are_alike() {
        for spent in [0.0, 1.0] {
            let found = narrowed(MANY_KERNELS + 1, true, spent, [0.999, 0.9, 0.81, 0.1]);
            assert_eq!(found, [NARROWED_ON_CURVE; 4]);
        }
    }

    #[test]
    fn who_adds_most_and_reaches_far_is_narrowed_first() {
        assert_eq!(marked([8.0, 0.5]), [0.9, 1.0]);
        assert_eq!(marked([1.5, 4.0]), [1.0, 0.9]);
        assert_eq!(marked([9.0, 5.0]), [0.9, 0.9]);
    }
}
