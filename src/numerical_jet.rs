//! The derivatives of joints by a parameter, from nothing but the inverse kinematics.
//!
//! With q the position and d1 d2 d3 its derivatives, the joints are asked for at places of
//! q + d1 t + d2 t^2/2 + d3 t^3/6 and not of the path itself: that has the same three derivatives, and no kink beside
//! the place. Four places are enough where neither the path nor the joints bend much between them, see [`STRAIGHT`]. With o_k and
//! e_k the difference and the sum of the joints at t = +-kh:
//!
//! ```text
//! f'   = (27 o_1/2 - o_3/2) / 24h
//! f''  = (e_3/2 - e_1/2) / 2h^2
//! f''' = (o_3/2 - 3 o_1/2) / h^3
//! ```
//!
//! Nothing in these formulas tells how good they are. Elsewhere five places are asked for, with f0 the joints of the place itself:
//!
//! ```text
//! f'   = (8 o_1 - o_2) / 12h
//! f''  = (16 e_1 - e_2 - 30 f0) / 12h^2
//! f''' = (o_2 - 2 o_1) / 2h^3
//! ```
//!
//! Where this f'' and (e_1 - 2 f0) / h^2, the formula of two orders less, differ by more than [`SMOOTH`], two places more are
//! asked for:
//!
//! ```text
//! f'   = (45 o_1 - 9 o_2 + o_3) / 60h
//! f''  = (270 e_1 - 27 e_2 + 2 e_3 - 490 f0) / 180h^2
//! f''' = (8 o_2 - 13 o_1 - o_3) / 8h^3
//! ```
//!
//! Too large a step leaves out what the joints do beside the place, too small a one is lost in rounding. The step
//! begins at [`STEP`], and is halved until the last two agree with (e_1 - 2 f0) / h^2 and (o_2 - 2 o_1) / 2h^3, the formulas of
//! two orders less: near a singularity that takes a few times.

use crate::axes::Axes;
use crate::cube_root::cube_root;

/// By how much an axis is moved at first by the first derivative, machine units or degrees. In a step of .01 to
/// .03 mm the error of the jerk is below 1e-5 of its limit where tables turn at full speed.
pub const STEP: f64 = 0.03;

/// By how much at first by each of the two others. What they do to the joints grows with their products, and where they set the
/// step it is long enough for rounding not to matter. With 1e-3 the jerk is off by up to 2e-4 of its limit, with .03 by 1e-3.
pub const BEND: f64 = 1e-4;

/// How often the step is halved at most.
const HALVINGS: usize = 10;

/// How far the places of four are from each other, in steps: with that they lie no further away than those of five.
const SPACING: f64 = 1.2;

/// By how much the position may turn in a step, the second derivative over the first one, where four places are enough, and joints
/// more than that. The third derivative may be four times the square of it, and change the acceleration of a joint by this
/// share of its limit. With a singular place r steps away joints turn by 1 / 2r and their third derivative is 1 / r^2 of the
/// first one; the second one is off by 1.5 / r^2 of itself, which is 6e-5 then. A table turns by 5e-4.
const STRAIGHT: f64 = 1.0 / 256.0;
const STRAIGHT_TWICE: f64 = 4.0 * STRAIGHT * STRAIGHT;

/// What the formulas of two orders may differ by, over the limits, at the speed that the derivatives themselves allow. The
/// error of the better one is a small part of that.
const AGREEMENT: f64 = 2e-3;

/// What the formulas of two orders for the second derivative may differ by, over the limits, where five places are enough. With a
/// singular place r steps away that is some 1 / 4r^2, and the third derivative is off by 3 / r^2 of itself. A table that turns
/// by [`STEP`] has 2e-8.
const SMOOTH: f64 = 4e-6;

/// What rounding of an answer becomes in a third derivative, over the answer, for a step of 1.
const ROUNDING: f64 = 1e-15;

/// How joints move, and how sure that is.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// Three derivatives of the joints, each shape (9).
    pub jet: [Axes; 3],
    /// What the formulas of two orders differ by, over the limits; infinite where that is not a number. At a singular place
    /// no step makes it small.
    pub disagreement: f64,
    /// What the joints take of their limits, at the speed that the parameter has.
    taken: f64,
}

/// Three derivatives of what `inverse` makes of a position, see the head of this file. `shares`: what a unit of velocity,
/// acceleration and jerk is of the limit of each joint.
#[inline]
pub fn numerical_jet(
    inverse: impl Fn(&Axes) -> Axes,
    position: &Axes,
    derivatives: &[Axes; 3],
    shares: &[Axes; 3],
) -> [Axes; 3] {
    let first = FirstStep::of(derivatives);
    let places = Places {
        inverse: &inverse,
        position,
        derivatives,
        shares,
    };
    let of_four = first.is_straight().then(|| places.where_straight(&first));
    of_four
        .flatten()
        .unwrap_or_else(|| places.surest(first.step).jet)
}

/// The same from five places at least, with how sure it is.
#[inline]
pub fn numerical_estimate(
    inverse: impl Fn(&Axes) -> Axes,
    position: &Axes,
    derivatives: &[Axes; 3],
    shares: &[Axes; 3],
) -> Estimate {
    let places = Places {
        inverse: &inverse,
        position,
        derivatives,
        shares,
    };
    places.surest(FirstStep::of(derivatives).step)
}

/// The step that places are tried with first.
struct FirstStep {
    /// The parameter in which the first derivative moves no axis further than [`STEP`], and no other one further than [`BEND`];
    /// infinite if they are 0.
    step: f64,
    /// What the second and the third derivative change the first one by in it, over that.
    turn: f64,
    twist: f64,
}

impl FirstStep {
    fn of(derivatives: &[Axes; 3]) -> Self {
        let [first, second, third] = derivatives.each_ref().map(Axes::amax);
        let step = (STEP / first).min((2.0 * BEND / second).sqrt());
        // The root takes longer than all of the rest.
        let step = if third * (step * step * step) > 6.0 * BEND {
            cube_root(6.0 * BEND / third)
        } else {
            step
        };
        let share = step / first;
        Self {
            step,
            turn: second * share,
            twist: third * step * share,
        }
    }

    /// Whether the position hardly bends in it, see [`STRAIGHT`].
    fn is_straight(&self) -> bool {
        self.turn <= STRAIGHT && self.twist <= STRAIGHT_TWICE
    }
}

/// Difference and sum of the joints at two places that are as far away to both sides.
type Pair = (Axes, Axes);

/// The places beside one.
struct Places<'a, F> {
    inverse: &'a F,
    position: &'a Axes,
    derivatives: &'a [Axes; 3],
    shares: &'a [Axes; 3],
}

impl<F: Fn(&Axes) -> Axes> Places<'_, F> {
    /// So far away.
    #[inline]
    fn pair(&self, t: f64) -> Pair {
        let [first, second, third] = self.derivatives;
        let at = |t: f64| {
            let way = (first + (second + third * (t / 3.0)) * (t / 2.0)) * t;
            (self.inverse)(&(self.position + way))
        };
        let (on, back) = (at(t), at(-t));
        (on - back, on + back)
    }

    /// From four places, where second and third differences do not say that the joints bend more than the position does.
    #[inline]
    fn where_straight(&self, first: &FirstStep) -> Option<[Axes; 3]> {
        let h = SPACING * first.step;
        let ((o1, e1), (o3, e3)) = (self.pair(0.5 * h), self.pair(1.5 * h));
        let (bend, twist) = (e3 - e1, o3 - o1 * 3.0);
        let [velocity, acceleration, _] = self.shares;
        let way = share(&o1, velocity);
        let turn = SPACING * first.turn + STRAIGHT;
        let path_twist = SPACING * SPACING * first.twist;
        let bends = share(&bend, velocity) > 2.0 * turn * way
            || share(&twist, velocity) > (path_twist + STRAIGHT_TWICE) * way;
        // A joint that is slower than others may bend all the same, at the speed that the derivatives allow.
        let taken = (way * way).max(0.5 * share(&bend, acceleration));
        let most_change = path_twist * share(&o1, acceleration) + STRAIGHT * taken;
        let changes = share(&twist, acceleration);
        let (rate, rate_squared) = (1.0 / h, 1.0 / (h * h));
        let is_straight = !bends && changes <= most_change && bend.sum().is_finite();
        is_straight.then(|| {
            [
                (o1 * 27.0 - o3) * (rate / 24.0),
                bend * (rate_squared / 2.0),
                twist * (rate_squared * rate),
            ]
        })
    }

    /// From five places or more, in smaller and smaller steps where that is needed.
    fn surest(&self, mut step: f64) -> Estimate {
        if !step.is_finite() {
            return Estimate {
                jet: [Axes::zeros(); 3],
                disagreement: 0.0,
                taken: 0.0,
            };
        }
        let here = (self.inverse)(self.position);
        let near = self.near(step);
        if let Some(smooth) = self.where_smooth(step, &here, &near) {
            return smooth;
        }
        let mut best = self.estimate(step, &here, &near);
        for _ in 0..HALVINGS {
            if best.disagreement <= AGREEMENT {
                break;
            }
            step *= 0.5;
            // In a smaller step rounding alone would be more than that.
            let rounding = ROUNDING * here.amax() * self.shares[2].amax();
            if rounding > AGREEMENT * (step * best.taken).powi(3) {
                break;
            }
            let finer = self.estimate(step, &here, &self.near(step));
            if finer.disagreement < best.disagreement {
                best = finer;
            }
        }
        best
    }

    /// One step and two steps away.
    #[inline]
    fn near(&self, step: f64) -> [Pair; 2] {
        [self.pair(step), self.pair(2.0 * step)]
    }

    /// From five places, where these are enough.
    #[inline]
    fn where_smooth(
        &self,
        step: f64,
        here: &Axes,
        [(o1, e1), (o2, e2)]: &[Pair; 2],
    ) -> Option<Estimate> {
        let (rate, rate_squared) = (1.0 / step, 1.0 / (step * step));
        let by_velocity = (o1 * 8.0 - o2) * (rate / 12.0);
        let by_acceleration = (e1 * 16.0 - e2 - here * 30.0) * (rate_squared / 12.0);
        let by_jerk = (o2 - o1 * 2.0) * (rate_squared * rate / 2.0);
        let coarse = (e1 - here * 2.0) * rate_squared;
        let jet = [by_velocity, by_acceleration, by_jerk];
        let estimate = Estimate::new(jet, [&coarse, &by_jerk], self.shares);
        (estimate.disagreement <= SMOOTH).then_some(estimate)
    }

    /// From seven.
    #[inline]
    fn estimate(&self, step: f64, here: &Axes, [(o1, e1), (o2, e2)]: &[Pair; 2]) -> Estimate {
        let (o3, e3) = self.pair(3.0 * step);
        let (rate, rate_squared) = (1.0 / step, 1.0 / (step * step));
        let by_velocity = (o1 * 45.0 - o2 * 9.0 + o3) * (rate / 60.0);
        let by_acceleration =
            (e1 * 270.0 - e2 * 27.0 + e3 * 2.0 - here * 490.0) * (rate_squared / 180.0);
        let by_jerk = (o2 * 8.0 - o1 * 13.0 - o3) * (rate_squared * rate / 8.0);
        let coarse = [
            (e1 - here * 2.0) * rate_squared,
            (o2 - o1 * 2.0) * (rate_squared * rate / 2.0),
        ];
        let jet = [by_velocity, by_acceleration, by_jerk];
        Estimate::new(jet, coarse.each_ref(), self.shares)
    }
}

/// The greatest of some values, each over its limit.
#[inline]
fn share(of: &Axes, by: &Axes) -> f64 {
    of.component_mul(by).amax()
}

impl Estimate {
    /// `coarse`: the second and third derivative as the formulas of two orders less say.
    #[inline]
    fn new(jet: [Axes; 3], coarse: [&Axes; 2], shares: &[Axes; 3]) -> Self {
        let [velocity, acceleration, jerk] = shares;
        let taken = share(&jet[0], velocity).max(share(&jet[1], acceleration).sqrt());
        let by_jerk = share(&jet[2], jerk);
        let taken = if by_jerk > taken * taken * taken {
            cube_root(by_jerk)
        } else {
            taken
        };
        let second = share(&(jet[1] - coarse[0]), acceleration) / (taken * taken);
        let third = share(&(jet[2] - coarse[1]), jerk) / (taken * taken * taken);
        let sum: f64 = jet.iter().map(Axes::sum).sum();
        let disagreement = if taken == 0.0 {
            0.0
        } else if sum.is_finite() && second.is_finite() && third.is_finite() {
            second.max(third)
        } else {
            f64::INFINITY
        };
        Self {
            jet,
            disagreement,
            taken,
        }
    }
}
