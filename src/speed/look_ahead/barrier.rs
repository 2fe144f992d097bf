//! What the refinement minimises in one interval: its duration, and a barrier at its limits.
//!
//! The duration is Simpson's rule for the integral of ds / sqrt(b). The barrier is the logarithm
//! of what is left of the cap, of the acceleration and of the jerk of each axis at start, middle
//! and end (Boyd and Vandenberghe, Convex Optimization, chapter 11). The jerk is bounded as
//! `|q' u + 3 q'' a + q''' b| <= J / sqrt(b)`; the right side is convex in b, which would make the
//! barrier's second derivatives indefinite, so that one term of them is left out.

use super::departure::Departure;
use super::interval::Parabola;
use super::interval_samples::IntervalSamples;
use super::rows::{AxisRows, THIRD};
use super::sample::Sample;
use crate::lanes::{QUAD_LANES, QUADS, Quad, quad};

/// Derivatives by the three coefficients that an interval depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct BarrierDerivatives {
    /// Gradient, shape (3).
    pub gradient: [f64; 3],
    /// Second derivatives, positive semidefinite, upper triangle by rows: 00 01 02 11 12 22.
    pub hessian: [f64; 6],
}

/// Derivatives by b, a and u at a place, second ones symmetric.
#[derive(Clone, Copy, Default)]
struct Local {
    b: f64,
    a: f64,
    u: f64,
    bb: f64,
    ba: f64,
    bu: f64,
    aa: f64,
    au: f64,
    uu: f64,
}

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
        let mut sum = Local::default();
        let places = [(0.0, 0.25, 1.0), (0.5, 0.5, 4.0), (1.0, 0.25, 1.0)];
        for ((share, part, simpson), sample) in places.into_iter().zip(interval.places()) {
            let x = share * h;
            let (b, a) = parabola.at(x);
            let place = BarrierPlace {
                b,
                a,
                u: parabola.u,
                inverse: 1.0 / b,
                root: b.sqrt(),
            };
            let mut local = place.duration(h * (simpson / 6.0));
            self.add_limits(
                &mut local,
                rows,
                &place,
                sample,
                &interval.departure,
                weight * part,
            );
            sum.add_at(&local, x);
        }
        sum.by_coefficients(lengths)
    }

    /// Adds the barrier at a place.
    fn add_limits(
        &self,
        sum: &mut Local,
        rows: &AxisRows,
        place: &BarrierPlace,
        sample: &Sample,
        departure: &Departure,
        weight: f64,
    ) {
        let BarrierPlace {
            b, a, u, inverse, ..
        } = *place;
        let left = sample.cap.raised(self.raise_squared) - b;
        if left > 0.0 {
            let inverse = 1.0 / left;
            sum.b += weight * inverse;
            sum.bb += weight * inverse * inverse;
        }
        // The bound of the jerk rows and its derivative by b.
        let third = f64::from(departure.third);
        let whole = self.margin * place.root * inverse;
        let bound = whole - third * b;
        let bound_slope = -0.5 * whole * inverse - third;
        // The departure takes so little of the acceleration that how it changes with b does not matter.
        let margin = self.margin - f64::from(departure.second) * b;
        let mut limits = BarrierLimits::default();
        let mut lanes = 0;
        for number in (0..QUADS).filter(|number| sample.axes.in_quad(*number)) {
            lanes += QUAD_LANES;
            limits.add(
                sample.lanes.each_ref().map(|rows| *quad(rows, number)),
                quad(&rows.jerk_time_lanes, number),
                [b, a, u, bound, bound_slope, margin].map(|value| value as f32),
            );
        }
        // Axes that stand still have no row, but the bound of one.
        let still = f64::from(lanes as u32 - sample.axes.count());
        let jump = 2.0 / bound;
        let jumps = total(limits.jumps) - still * jump;
        let even = total(limits.even) - still * 0.5 * jump * jump;
        sum.u += weight * total(limits.u);
        sum.a += weight * total(limits.a);
        sum.b += weight * (total(limits.b) - jumps * bound_slope);
        sum.uu += weight * total(limits.uu);
        sum.au += weight * total(limits.au);
        sum.bu += weight * total(limits.bu);
        sum.aa += weight * total(limits.aa);
        sum.ba += weight * total(limits.ba);
        sum.bb += weight * (total(limits.bb) + even * bound_slope * bound_slope);
    }
}

/// What the limits of the axes add, by lanes, for a weight of 1.
#[derive(Default)]
struct BarrierLimits {
    b: Quad,
    a: Quad,
    u: Quad,
    bb: Quad,
    ba: Quad,
    bu: Quad,
    aa: Quad,
    au: Quad,
    uu: Quad,
    /// What the slope of the bound of the jerk is to be multiplied by ..
    jumps: Quad,
    /// .. and its square.
    even: Quad,
}

impl BarrierLimits {
    /// Adds four axes: their rows by u, a and b, and the times J / A.
    ///
    /// `1 / (bound - y) - 1 / (bound + y)` is called slope, the sum of both jumps, that of their
    /// squares even and the difference of the squares odd.
    #[inline]
    fn add(
        &mut self,
        [by_u, by_a, by_b]: [Quad; 3],
        times: &Quad,
        [b, a, u, bound, bound_slope, margin]: [f32; 6],
    ) {
        for lane in 0..QUAD_LANES {
            let (by_u, by_a, by_b) = (by_u[lane], by_a[lane], by_b[lane]);
            let jerk = by_u * u + by_a * a + by_b * b;
            let inverse = 2.0 / ((bound - jerk) * (bound + jerk));
            let (slope, jumps) = (jerk * inverse, bound * inverse);
            let even = 0.5 * (slope * slope + jumps * jumps);
            let odd = slope * jumps * bound_slope;
            let (even_u, across) = (even * by_u, even * by_b - odd);
            self.jumps[lane] += jumps;
            self.even[lane] += even;
            self.u[lane] += slope * by_u;
            self.uu[lane] += even_u * by_u;
            self.au[lane] += even_u * by_a;
            self.bu[lane] += across * by_u;

            let (along, over) = (by_u * times[lane], by_a * (times[lane] * THIRD));
            let acceleration = along * a + over * b;
            let inverse = 2.0 / ((margin - acceleration) * (margin + acceleration));
            let (rise, leaps) = (acceleration * inverse, margin * inverse);
            let both = 0.5 * (rise * rise + leaps * leaps);
            self.a[lane] += slope * by_a + rise * along;
            self.b[lane] += slope * by_b + rise * over;
            self.aa[lane] += even * by_a * by_a + both * along * along;
            self.ba[lane] += across * by_a + both * along * over;
            self.bb[lane] += (across - odd) * by_b + both * over * over;
        }
    }
}

/// The sum of all lanes.
fn total([first, second, third, fourth]: Quad) -> f64 {
    f64::from((first + second) + (third + fourth))
}

/// b, a and u somewhere in an interval.
struct BarrierPlace {
    b: f64,
    a: f64,
    u: f64,
    /// 1 / b.
    inverse: f64,
    /// sqrt(b).
    root: f64,
}

impl BarrierPlace {
    /// `weight / sqrt(b)`.
    fn duration(&self, weight: f64) -> Local {
        let cubed = weight * self.root * self.inverse * self.inverse;
        Local {
            b: -0.5 * cubed,
            bb: 0.75 * cubed * self.inverse,
            ..Local::default()
        }
    }
}

impl Local {
    /// Adds what is meant by b, a, u at `x` as seen from the start, where
    /// `b = b0 + 2 a0 x + u x^2` and `a = a0 + u x`.
    fn add_at(&mut self, other: &Self, x: f64) {
        let two_x = 2.0 * x;
        let xx = x * x;
        // Rows of the second derivatives times the columns of the transformation.
        let b_a = other.bb * two_x + other.ba;
        let a_a = other.ba * two_x + other.aa;
        let b_u = other.bb * xx + other.ba * x + other.bu;
        let a_u = other.ba * xx + other.aa * x + other.au;
        let u_u = other.bu * xx + other.au * x + other.uu;
        self.b += other.b;
        self.a += other.b * two_x + other.a;
        self.u += other.b * xx + other.a * x + other.u;
        self.bb += other.bb;
        self.ba += b_a;
        self.bu += b_u;
        self.aa += two_x * b_a + a_a;
        self.au += two_x * b_u + a_u;
        self.uu += xx * b_u + x * a_u + u_u;
    }

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
