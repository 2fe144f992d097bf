//! What the refinement minimises in one interval: its duration, and a barrier at its limits.
//!
//! The duration is Simpson's rule for the integral of ds / sqrt(b). The barrier is the logarithm
//! of what is left of the cap, of the acceleration and of the jerk of each axis at start, middle
//! and end (Boyd and Vandenberghe, Convex Optimization, chapter 11). The jerk is bounded as
//! `|q' u + 3 q'' a + q''' b| <= J / sqrt(b)`; the right side is convex in b, which would make the
//! barrier's second derivatives indefinite, so that one term of them is left out.

use wide::{f32x4, f64x2, f64x4};

use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::rows::{AxisRows, THIRD};
use super::sample::{MovingAxes, Sample};
use crate::lanes::{QUAD_LANES, QUADS, quad};

/// Derivatives by the three coefficients that an interval depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct BarrierDerivatives {
    /// Gradient, shape (3).
    pub gradient: [f64; 3],
    /// Second derivatives, positive semidefinite, upper triangle by rows: 00 01 02 11 12 22.
    pub hessian: [f64; 6],
}

/// Derivatives by b, a and u, second ones symmetric; of one place, or of [`PLACES`] by lanes.
#[derive(Clone, Copy)]
struct Local<T> {
    b: T,
    a: T,
    u: T,
    bb: T,
    ba: T,
    bu: T,
    aa: T,
    au: T,
    uu: T,
}

/// Where in an interval, shares of its length: a lane each. The last one only fills the register, and weighs nothing. The
/// start comes behind the others, since it alone has nothing to be [transformed](Local::by_start).
const PLACES: [f64; 4] = [0.5, 1.0, 0.0, 0.0];

/// What each of them stands for in the barrier ..
const PARTS: [f64; 4] = [0.5, 0.25, 0.25, 0.0];

/// .. and in the duration, by Simpson's rule.
const SIMPSON: [f64; 4] = [4.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 0.0];

/// What the barrier is to be assembled with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Barrier {
    /// Its weight against the duration, per second of motion.
    pub weight: f64,
    /// The share of acceleration and jerk at which it is infinite.
    pub margin: f64,
    /// Square of what the program's caps are multiplied by.
    pub raise_squared: f64,
}

impl Barrier {
    /// Of an interval that keeps its limits, with the lengths of itself and its neighbours.
    pub fn derivatives(
        &self,
        rows: &AxisRows,
        parabola: &Parabola,
        interval: &IntervalSamples,
        lengths: [f64; 3],
    ) -> BarrierDerivatives {
        let h = parabola.length;
        let (b_middle, _) = parabola.at(0.5 * h);
        let weight = self.weight * h / b_middle.sqrt();
        let x = f64x4::new(PLACES) * h;
        let places = BarrierPlaces::of(parabola, x);
        let duration = places.duration(f64x4::new(SIMPSON) * h);
        let local = self.with_limits(
            duration,
            rows,
            &places,
            interval,
            f64x4::new(PARTS) * weight,
        );
        local.by_start(h).by_coefficients(lengths)
    }

    /// Duration and barrier at all places.
    #[inline]
    fn with_limits(
        &self,
        duration: DurationDerivatives,
        rows: &AxisRows,
        places: &BarrierPlaces,
        interval: &IntervalSamples,
        weight: f64x4,
    ) -> Local<f64x4> {
        let BarrierPlaces {
            b,
            a,
            u,
            root,
            inverse,
        } = *places;
        let samples = interval.places();
        let left = by_place(samples.map(|sample| sample.cap.raised(self.raise_squared))) - b;
        let inverse_left = (f64x4::ONE / left) & left.simd_gt(f64x4::ZERO);
        let rise = weight * inverse_left;
        // The bound of the jerk rows and its derivative by b.
        let third = f64::from(interval.departure.third);
        let whole = root * self.margin * inverse;
        let bound = whole - b * third;
        let bound_slope = whole * -0.5 * inverse - third;
        // The departure takes so little of the acceleration that how it changes with b does not matter.
        let margin = self.margin - b * f64::from(interval.departure.second);
        let factors = [b, a, f64x4::splat(u), bound, bound_slope, margin].map(to_single);
        let moving = MovingAxes::at_any(samples);
        let limits = of_axes(rows, samples, moving, &factors);
        let (mut jumps, mut even) = (to_double(limits.jumps), to_double(limits.even));
        if samples.iter().any(|sample| sample.axes != moving) {
            // Axes that stand still at a place have no row there, but the bound of one.
            let still = by_place(samples.map(|sample| moving.more_than(sample.axes)));
            let jump = f64x4::ONE / bound;
            jumps -= still * jump;
            even -= still * jump * jump;
        }
        let twice = weight + weight;
        Local {
            u: twice * to_double(limits.u),
            a: twice * to_double(limits.a),
            b: duration.b + rise + twice * (to_double(limits.b) - jumps * bound_slope),
            uu: twice * to_double(limits.uu),
            au: twice * to_double(limits.au),
            bu: twice * to_double(limits.bu),
            aa: twice * to_double(limits.aa),
            ba: twice * to_double(limits.ba),
            bb: duration.bb
                + rise * inverse_left
                + twice * (to_double(limits.bb) + even * bound_slope * bound_slope),
        }
    }
}

/// What all rows of the axes that move somewhere in an interval add. `factors`: see [`BarrierLimits::add`].
#[inline(always)]
fn of_axes(
    rows: &AxisRows,
    samples: [&Sample; 3],
    moving: MovingAxes,
    factors: &[f32x4; 6],
) -> BarrierLimits {
    let mut limits = BarrierLimits::default();
    for number in (0..QUADS).filter(|number| moving.in_quad(*number)) {
        let times = quad(&rows.jerk_time_lanes, number);
        let [by_u, by_a, by_b] = [0, 1, 2].map(|order| {
            let [start, middle, end] =
                samples.map(|sample| f32x4::new(*quad(&sample.lanes[order], number)));
            f32x4::transpose([middle, end, start, start])
        });
        for (lane, time) in times.iter().enumerate() {
            if moving.contains(QUAD_LANES * number + lane) {
                limits.add(&[by_u[lane], by_a[lane], by_b[lane]], *time, factors);
            }
        }
    }
    limits
}

/// What belongs to start, middle and end as the lanes of [`PLACES`].
#[inline(always)]
fn by_place([start, middle, end]: [f64; 3]) -> f64x4 {
    f64x4::new([middle, end, start, start])
}

#[inline(always)]
fn to_single(values: f64x4) -> f32x4 {
    f32x4::new(values.to_array().map(|value| value as f32))
}

#[inline(always)]
fn to_double(values: f32x4) -> f64x4 {
    f64x4::new(values.to_array().map(f64::from))
}

/// Half of what the limits of the axes add at each place, for a weight of 1.
#[derive(Default)]
struct BarrierLimits {
    b: f32x4,
    a: f32x4,
    u: f32x4,
    bb: f32x4,
    ba: f32x4,
    bu: f32x4,
    aa: f32x4,
    au: f32x4,
    uu: f32x4,
    /// What the slope of the bound of the jerk is to be multiplied by ..
    jumps: f32x4,
    /// .. and its square.
    even: f32x4,
}

impl BarrierLimits {
    /// Adds an axis: its rows by u, a and b at each place, and its time J / A.
    ///
    /// Half of `1 / (bound - y) - 1 / (bound + y)` is called slope, of the sum of both jumps, of that of their
    /// squares even and of the difference of the squares odd.
    #[inline(always)]
    fn add(
        &mut self,
        &[by_u, by_a, by_b]: &[f32x4; 3],
        time: f32,
        &[b, a, u, bound, bound_slope, margin]: &[f32x4; 6],
    ) {
        let jerk = by_u * u + by_a * a + by_b * b;
        let inverse = 1.0 / ((bound - jerk) * (bound + jerk));
        let (slope, jumps) = (jerk * inverse, bound * inverse);
        let even = slope * slope + jumps * jumps;
        let odd = slope * jumps * (bound_slope + bound_slope);
        let (even_u, across) = (even * by_u, even * by_b - odd);
        self.jumps += jumps;
        self.even += even;
        self.u += slope * by_u;
        self.uu += even_u * by_u;
        self.au += even_u * by_a;
        self.bu += across * by_u;
        let (along, over) = (by_u * time, by_a * (time * THIRD));
        let acceleration = along * a + over * b;
        let inverse = 1.0 / ((margin - acceleration) * (margin + acceleration));
        let (rise, leaps) = (acceleration * inverse, margin * inverse);
        let both = rise * rise + leaps * leaps;
        self.a += slope * by_a + rise * along;
        self.b += slope * by_b + rise * over;
        self.aa += even * by_a * by_a + both * along * along;
        self.ba += across * by_a + both * along * over;
        self.bb += (across - odd) * by_b + both * over * over;
    }
}

/// The motion at all places.
struct BarrierPlaces {
    b: f64x4,
    a: f64x4,
    u: f64,
    /// sqrt(b).
    root: f64x4,
    /// 1 / b.
    inverse: f64x4,
}

impl BarrierPlaces {
    /// At `x` from the start.
    #[inline(always)]
    fn of(parabola: &Parabola, x: f64x4) -> Self {
        let change = x * parabola.u;
        let b = parabola.b + x * (2.0 * parabola.a + change);
        Self {
            b,
            a: parabola.a + change,
            u: parabola.u,
            root: b.sqrt(),
            inverse: f64x4::ONE / b,
        }
    }

    /// `weight / sqrt(b)`.
    #[inline(always)]
    fn duration(&self, weight: f64x4) -> DurationDerivatives {
        let cubed = weight * self.root * self.inverse * self.inverse;
        DurationDerivatives {
            b: cubed * -0.5,
            bb: cubed * 0.75 * self.inverse,
        }
    }
}

/// The derivatives of the duration at each place; those by a and u are 0.
struct DurationDerivatives {
    b: f64x4,
    bb: f64x4,
}

impl Local<f64x4> {
    /// The sum over all places of what is meant by b, a, u there as seen from the start, where
    /// `b = b0 + 2 a0 x + u x^2` and `a = a0 + u x` at `x` in an interval of the `length`.
    #[inline(always)]
    fn by_start(&self, length: f64) -> Local<f64> {
        let [middle, end, ..] = PLACES;
        let x = f64x2::new([middle, end]) * length;
        let two_x = x * 2.0;
        let xx = x * x;
        let [b, a] = [self.b, self.a].map(ByStart::of);
        let [bb, ba, bu, aa, au] = [self.bb, self.ba, self.bu, self.aa, self.au].map(ByStart::of);
        let [u, uu] = [self.u, self.uu].map(ByStart::of);
        // Rows of the second derivatives times the columns of the transformation.
        let b_a = bb.behind * two_x + ba.behind;
        let a_a = ba.behind * two_x + aa.behind;
        let b_u = bb.behind * xx + ba.behind * x + bu.behind;
        let a_u = ba.behind * xx + aa.behind * x + au.behind;
        let u_u = bu.behind * xx + au.behind * x + uu.behind;
        Local {
            b: b.plus(b.behind),
            a: a.plus(b.behind * two_x + a.behind),
            u: u.plus(b.behind * xx + a.behind * x + u.behind),
            bb: bb.plus(bb.behind),
            ba: ba.plus(b_a),
            bu: bu.plus(b_u),
            aa: aa.plus(two_x * b_a + a_a),
            au: au.plus(two_x * b_u + a_u),
            uu: uu.plus(xx * b_u + x * a_u + u_u),
        }
    }
}

/// A derivative at the start, and at middle and end.
#[derive(Clone, Copy)]
struct ByStart {
    start: f64,
    behind: f64x2,
}

impl ByStart {
    #[inline(always)]
    fn of(derivative: f64x4) -> Self {
        let [middle, end, start, _] = derivative.to_array();
        Self {
            start,
            behind: f64x2::new([middle, end]),
        }
    }

    /// What is at the start, and what middle and end come to as seen from there.
    #[inline(always)]
    fn plus(self, behind: f64x2) -> f64 {
        let [middle, end] = behind.to_array();
        self.start + middle + end
    }
}

impl Local<f64> {
    /// The same by the coefficients before, in and behind the interval.
    fn by_coefficients(&self, lengths: [f64; 3]) -> BarrierDerivatives {
        let [before, here, after] = lengths;
        let left = 1.0 / (before + here);
        let right = 1.0 / (here + after);
        let inverse = 1.0 / here;
        // b, a and u of a unit of each coefficient.
        let units = [
            [here * left, -left, left * inverse],
            [before * left, left, -(left + right) * inverse],
            [0.0, 0.0, right * inverse],
        ];
        let gradient = units.map(|[b, a, u]| self.b * b + self.a * a + self.u * u);
        let images = units.map(|[b, a, u]| {
            [
                self.bb * b + self.ba * a + self.bu * u,
                self.ba * b + self.aa * a + self.au * u,
                self.bu * b + self.au * a + self.uu * u,
            ]
        });
        let product = |[b, a, u]: [f64; 3], [x, y, z]: [f64; 3]| b * x + a * y + u * z;
        let [unit_0, unit_1, unit_2] = units;
        let [image_0, image_1, image_2] = images;
        BarrierDerivatives {
            gradient,
            hessian: [
                product(unit_0, image_0),
                product(unit_0, image_1),
                product(unit_0, image_2),
                product(unit_1, image_1),
                product(unit_1, image_2),
                product(unit_2, image_2),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::departure::Departure;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::machine_map::MachineMap;
    use crate::moves::shape::PathPoint;
    use crate::speed::look_ahead::test_route::TestRoute;

    /// A curve whose derivatives are all different from 0.
    fn bent(s: f64) -> PathPoint {
        let along = |x: f64, y: f64| Axes::from([x, y, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        PathPoint {
            position: Axes::zeros(),
            first: along(0.8 + 0.1 * s, 0.6),
            second: along(0.1, -0.2 + 0.3 * s),
            third: along(0.05, 0.3),
        }
    }

    /// What the derivatives are meant to be of, with the weight of the barrier given.
    fn value(rows: &AxisRows, parabola: &Parabola, interval: &IntervalSamples, weight: f64) -> f64 {
        let h = parabola.length;
        let places = [(0.0, 0.25, 1.0), (0.5, 0.5, 4.0), (1.0, 0.25, 1.0)];
        let mut sum = 0.0;
        for ((share, part, simpson), sample) in places.into_iter().zip(interval.places()) {
            let (b, a) = parabola.at(share * h);
            sum += h * simpson / 6.0 / b.sqrt();
            let mut logarithms = (sample.cap.raised(1.0) - b).ln();
            for axis in 0..3 {
                let u = parabola.u;
                let [first, second, third] = [sample.first, sample.second, sample.third];
                let jerk = first[axis] * u + second[axis] * a + third[axis] * b;
                let bound = 0.98 / b.sqrt() - f64::from(interval.departure.third) * b;
                logarithms += (bound - jerk).ln() + (bound + jerk).ln();
                let acceleration =
                    (first[axis] * a + second[axis] * b / 3.0) * rows.jerk_time()[axis];
                logarithms += (0.98 - acceleration).ln() + (0.98 + acceleration).ln();
            }
            sum -= weight * part * logarithms;
        }
        sum
    }

    #[test]
    fn the_gradient_is_that_of_duration_and_barrier() {
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let rows = AxisRows::new(&limits, &MachineMap::IDENTITY, 1e-3);
        let route = TestRoute {
            point: bent,
            breakpoints: Vec::new(),
            vertices: Vec::new(),
        };
        let [start, middle, end] = [0.0, 0.2, 0.4].map(|s| rows.sample(&route, s, 0.0));
        let departure = Departure {
            second: 0.0,
            third: 2e-6,
        };
        let interval = IntervalSamples {
            quarters: [middle.cap; 2],
            start,
            middle,
            end,
            departure,
        };
        let lengths = [0.3, 0.4, 0.5];
        let coefficients = [900.0, 1050.0, 1100.0];
        let parabola = Parabola::of_coefficients(lengths, coefficients);
        assert!(rows.keeps(&parabola, &interval, 1.0, 0.98));
        let barrier = Barrier {
            weight: 0.1,
            margin: 0.98,
            raise_squared: 1.0,
        };
        let derivatives = barrier.derivatives(&rows, &parabola, &interval, lengths);
        let (middle, _) = parabola.at(0.2);
        let weight = 0.1 * 0.4 / middle.sqrt();
        for i in 0..3 {
            let at = |step: f64| {
                let mut moved = coefficients;
                moved[i] += step;
                let parabola = Parabola::of_coefficients(lengths, moved);
                value(&rows, &parabola, &interval, weight)
            };
            let difference = (at(1e-3) - at(-1e-3)) / 2e-3;
            let gradient = derivatives.gradient[i];
            let near = (difference - gradient).abs() <= 1e-6 * gradient.abs().max(1e-6);
            assert!(near, "{i}: {difference} {gradient}");
        }
        let [h00, h01, _, h11, _, h22] = derivatives.hessian;
        assert!(h00 > 0.0 && h22 > 0.0 && h00 * h11 > h01 * h01);
    }
}
