//! The derivatives of joints by a parameter, from nothing but the inverse kinematics.
//!
//! With q the position and d1 d2 d3 its derivatives, the joints are asked for at places of
//! q + d1 t + d2 t^2/2 + d3 t^3/6 and not of the path itself: that has the same three derivatives, and no kink beside
//! the place. Five places are enough where the joints hardly bend between them, and that is nearly everywhere. With o_k and
//! e_k the difference and the sum of the joints at t = +-kh, and f0 those of the place itself:
//!
//! ```text
//! f'   = (8 o1 - o2) / 12h
//! f''  = (16 e1 - e2 - 30 f0) / 12h^2
//! f''' = (o2 - 2 o1) / 2h^3
//! ```
//!
//! Where this f'' and (e1 - 2 f0) / h^2, the formula of two orders less, differ by more than [`SMOOTH`], two places more are
//! asked for:
//!
//! ```text
//! f'   = (45 o1 - 9 o2 + o3) / 60h
//! f''  = (270 e1 - 27 e2 + 2 e3 - 490 f0) / 180h^2
//! f''' = (8 o2 - 13 o1 - o3) / 8h^3
//! ```
//!
//! Too large a step leaves out what the joints do beside the place, too small a one is lost in rounding. The step
//! begins at [`STEP`], and is halved until the last two agree with (e1 - 2 f0) / h^2 and (o2 - 2 o1) / 2h^3, the formulas of
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
    numerical_estimate(inverse, position, derivatives, shares).jet
}

/// The same with how sure it is.
#[inline]
pub fn numerical_estimate(
    inverse: impl Fn(&Axes) -> Axes,
    position: &Axes,
    derivatives: &[Axes; 3],
    shares: &[Axes; 3],
) -> Estimate {
    let mut step = first_step(derivatives);
    if !step.is_finite() {
        return Estimate {
            jet: [Axes::zeros(); 3],
            disagreement: 0.0,
            taken: 0.0,
        };
    }
    let here = inverse(position);
    let places = Places {
        inverse: &inverse,
        position,
        derivatives,
        here: &here,
        shares,
    };
    let near = places.near(step);
    if let Some(smooth) = places.where_smooth(step, &near) {
        return smooth;
    }
    let mut best = places.estimate(step, &near);
    for _ in 0..HALVINGS {
        if best.disagreement <= AGREEMENT {
            break;
        }
        step *= 0.5;
        // In a smaller step rounding alone would be more than that.
        let rounding = ROUNDING * here.amax() * shares[2].amax();
        if rounding > AGREEMENT * (step * best.taken).powi(3) {
            break;
        }
        let finer = places.estimate(step, &places.near(step));
        if finer.disagreement < best.disagreement {
            best = finer;
        }
    }
    best
}

/// The parameter in which the first derivative moves no axis further than [`STEP`], and no other one further than [`BEND`];
/// infinite if they are 0.
fn first_step(derivatives: &[Axes; 3]) -> f64 {
    let [first, second, third] = derivatives.each_ref().map(Axes::amax);
    let step = (STEP / first).min((2.0 * BEND / second).sqrt());
    // The root takes longer than all of the rest.
    if third * (step * step * step) > 6.0 * BEND {
        cube_root(6.0 * BEND / third)
    } else {
        step
    }
}

/// Difference and sum of the joints at two places that are as far away to both sides.
type Pair = (Axes, Axes);

/// The places beside one.
struct Places<'a, F> {
    inverse: &'a F,
    position: &'a Axes,
    derivatives: &'a [Axes; 3],
    /// The joints of the place itself.
    here: &'a Axes,
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

    /// One step and two steps away.
    #[inline]
    fn near(&self, step: f64) -> [Pair; 2] {
        [self.pair(step), self.pair(2.0 * step)]
    }

    /// From five places, where these are enough.
    #[inline]
    fn where_smooth(&self, step: f64, [(o1, e1), (o2, e2)]: &[Pair; 2]) -> Option<Estimate> {
        let (rate, rate_squared) = (1.0 / step, 1.0 / (step * step));
        let by_velocity = (o1 * 8.0 - o2) * (rate / 12.0);
        let by_acceleration = (e1 * 16.0 - e2 - self.here * 30.0) * (rate_squared / 12.0);
        let by_jerk = (o2 - o1 * 2.0) * (rate_squared * rate / 2.0);
        let coarse = (e1 - self.here * 2.0) * rate_squared;
        let jet = [by_velocity, by_acceleration, by_jerk];
        let estimate = Estimate::new(jet, [&coarse, &by_jerk], self.shares);
        (estimate.disagreement <= SMOOTH).then_some(estimate)
    }

    /// From seven.
    #[inline]
    fn estimate(&self, step: f64, [(o1, e1), (o2, e2)]: &[Pair; 2]) -> Estimate {
        let (o3, e3) = self.pair(3.0 * step);
        let (rate, rate_squared) = (1.0 / step, 1.0 / (step * step));
        let by_velocity = (o1 * 45.0 - o2 * 9.0 + o3) * (rate / 60.0);
        let by_acceleration =
            (e1 * 270.0 - e2 * 27.0 + e3 * 2.0 - self.here * 490.0) * (rate_squared / 180.0);
        let by_jerk = (o2 * 8.0 - o1 * 13.0 - o3) * (rate_squared * rate / 8.0);
        let coarse = [
            (e1 - self.here * 2.0) * rate_squared,
            (o2 - o1 * 2.0) * (rate_squared * rate / 2.0),
        ];
        let jet = [by_velocity, by_acceleration, by_jerk];
        Estimate::new(jet, coarse.each_ref(), self.shares)
    }
}

impl Estimate {
    /// `coarse`: the second and third derivative as the formulas of two orders less say.
    #[inline]
    fn new(jet: [Axes; 3], coarse: [&Axes; 2], shares: &[Axes; 3]) -> Self {
        let share = |of: &Axes, by: &Axes| of.component_mul(by).amax();
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
