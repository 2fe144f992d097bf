//! How kernels of a curve taper off towards the end of what is known.
//!
//! There the path has to be the programmed one, so that kernels end with it. But kernels of fourth order leave a curve where it is
//! only as long as all are of the same width: where the width w changes with the path distance s, those on one side do not make
//! up for those on the other. For a curvature k the curve is off by
//!
//! ```text
//! .016 (dw/ds)^2 k w^2
//! ```
//!
//! and by up to .04 of it where w falls as fast as s grows. As wide as they can be at the end, kernels of a tight curve with a small
//! tolerance leave it there in each trial. What is to blame was narrowed then step by step, one vertex more than its
//! neighbours, so that these left the tolerance as well, now and then until nothing of them was left: trochoids took up to
//! 1.4 times as long with more feed, which makes kernels wider. So where the tolerance leaves `left`, the width falls no faster than
//!
//! ```text
//! w dw/ds = sqrt(left / (.03 k))
//! ```

use super::leg::Leg;
use super::linear_axes::greater_end;
use super::vertex::Vertex;

/// Of the tolerance, what tapering kernels and what the program is moved by may use.
const TOLERANCE_SHARE: f64 = 0.98;

/// What the slope of the width takes a curve off the program by, times its square, the curvature and the square of the width. Of
/// the bounds of .016 and .04: with .018 trochoids still take 1.06 with more feed, with .036 to .05 flowsnake is now faster,
/// now slower.
const OFF_PER_SLOPE: f64 = 0.03;

impl Vertex {
    /// Finds [how its width tapers](Self::taper), where the leg `after` it [ends a curve](Leg::ends_curve).
    pub fn find_taper(&mut self, after: &Leg) {
        if !after.ends_curve || self.isolated || self.tolerance_jump_size <= 0.0 {
            return;
        }
        let moved = greater_end(&after.shift_at(self.s));
        let left = (TOLERANCE_SHARE * self.tolerance - moved).max(0.0);
        let curvature = self.tolerance_jump_size / self.mean_leg;
        self.taper = 2.0 * (left / (OFF_PER_SLOPE * curvature)).sqrt();
    }

    /// How far it may reach where what is known ends at this distance, at least half of its shorter leg; infinite where it is on no
    /// curve.
    pub fn tapered(&self, distance: f64) -> f64 {
        if self.taper < f64::INFINITY {
            (self.taper * distance).sqrt().max(self.half_leg)
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::kernel;

    /// By how much a curve of curvature 1 is off at most whose kernels of fourth order are as wide as `width` says of the distance
    /// from the end, at most 1.
    fn off(width: impl Fn(f64) -> f64) -> f64 {
        const STEP: f64 = 2e-3;
        let width = |distance: f64| width(distance).min(distance).min(1.0);
        let vertices = (1..3000)
            .map(|k| STEP * f64::from(k))
            .map(|s| (s, width(s)));
        let vertices: Vec<_> = vertices.collect();
        (0..100)
            .map(|k| 0.04 * f64::from(k))
            .fold(0.0, |most: f64, place| {
                let of = |&(s, width): &(f64, f64)| {
                    let x = (s - place).abs() / width;
                    if x < 1.0 {
                        STEP * width * kernel::value(x, 1.0)
                    } else {
                        0.0
                    }
                };
                most.max(vertices.iter().map(of).sum::<f64>().abs())
            })
    }

    fn vertex(tolerance: f64) -> Vertex {
        let mut vertex = Vertex::VACANT;
        vertex.tolerance = tolerance;
        vertex.tolerance_jump_size = 0.02;
        vertex.mean_leg = 0.02;
        vertex.half_leg = 0.01;
        vertex
    }

    #[test]
    fn what_tapers_hardly_leaves_the_tolerance() {
        let curve = Leg {
            ends_curve: true,
            ..Leg::VACANT
        };
        assert!(off(|distance| distance) > 0.0039);
        for tolerance in [0.001, 0.002, 0.004] {
            let mut vertex = vertex(tolerance);
            vertex.find_taper(&curve);
            let off = off(|distance| vertex.tapered(distance));
            assert!(off < 1.1 * tolerance, "{tolerance}: {off}");
        }
    }

    #[test]
    fn what_is_on_no_curve_does_not_taper() {
        let mut vertex = vertex(0.001);
        vertex.find_taper(&Leg::VACANT);
        assert_eq!(vertex.tapered(0.0), f64::INFINITY);
    }
}
