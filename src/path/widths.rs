//! How far a vertex is smoothed to both sides.

use super::kernel;
use crate::lanes::greater;

/// Below this share of the widest change the sharpest one wants nodes of its own.
const CORE: f64 = 0.9;

/// The most kernels that a corner has besides its own.
pub(super) const FURTHER: usize = 2;

/// A biweight kernel besides a corner's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FurtherKernel {
    /// How far it reaches, machine units; 0 where there is none.
    pub width: f64,
    /// How much of it there is, negative where it is taken off. Of the corner's own there is as much less.
    pub share: f64,
}

impl FurtherKernel {
    pub const NONE: Self = Self {
        width: 0.0,
        share: 0.0,
    };
}

/// How far a vertex is smoothed to both sides, machine units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Widths {
    /// Of the kernel for the jump of the tangent; 0 without one.
    pub kernel: f64,
    /// Mix of the kernels.
    pub mix: f64,
    /// With which the corner [swings out](super::lone_corner).
    pub further: [FurtherKernel; FURTHER],
    /// Of the easement for the jump of curvature; 0 without one.
    pub easement: f64,
}

impl Widths {
    pub const NONE: Self = Self {
        kernel: 0.0,
        mix: 0.0,
        further: [FurtherKernel::NONE; FURTHER],
        easement: 0.0,
    };

    /// How far the sharpest of several changes reaches; 0 if they are of about the same size. A further kernel that is narrower than the
    /// corner's own does not count: it is half as wide, within the same nodes.
    pub fn core(&self) -> f64 {
        let reach = self.reach();
        let own = [self.kernel, self.easement];
        let there = own.into_iter().filter(|width| *width > 0.0);
        let least = there.fold(reach, f64::min);
        if least < CORE * reach { least } else { 0.0 }
    }

    /// How far the blended path is changed on both sides.
    #[inline]
    pub fn reach(&self) -> f64 {
        greater(greater(self.kernel, self.further_reach()), self.easement)
    }

    /// How far the further kernels reach; 0 without any.
    #[inline]
    pub fn further_reach(&self) -> f64 {
        let [one, other] = self.further;
        greater(one.width, other.width)
    }

    /// How much there is of the kernel itself.
    #[inline]
    pub fn own_share(&self) -> f64 {
        let [one, other] = self.further;
        1.0 - one.share - other.share
    }

    /// The kernels so many times as wide: what they take the path off the program by is as many times as much.
    pub fn scaled(&self, times: f64) -> Self {
        Self {
            kernel: times * self.kernel,
            further: self.further.map(|further| FurtherKernel {
                width: times * further.width,
                ..further
            }),
            ..*self
        }
    }

    /// How much of the jump of the tangent the kernels add to the path at `distance`, 0 and above.
    #[inline]
    pub fn deviation(&self, distance: f64) -> f64 {
        let mut sum = 0.0;
        if distance < self.kernel {
            let value = self.kernel * kernel::value(distance / self.kernel, self.mix);
            sum += self.own_share() * value;
        }
        for FurtherKernel { width, share } in self.further {
            if distance < width {
                sum += share * width * kernel::value(distance / width, 0.0);
            }
        }
        sum
    }

    /// A bound of the second derivative of that, at `distance` and everywhere beyond.
    #[inline]
    pub fn bend_bound(&self, distance: f64) -> f64 {
        let mut bound = 0.0;
        if distance < self.kernel {
            let majorant = kernel::majorant(distance / self.kernel, self.mix);
            bound += self.own_share().abs() / self.kernel * majorant;
        }
        for FurtherKernel { width, share } in self.further {
            if distance < width {
                bound += share.abs() / width * kernel::majorant(distance / width, 0.0);
            }
        }
        bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SWINGING: Widths = Widths {
        kernel: 2.2,
        further: [
            FurtherKernel {
                width: 16.0,
                share: -0.087,
            },
            FurtherKernel {
                width: 1.1,
                share: 0.3,
            },
        ],
        ..Widths::NONE
    };

    #[test]
    fn the_sharpest_change_is_known_where_there_are_several() {
        let one = Widths {
            kernel: 2.0,
            ..Widths::NONE
        };
        assert_eq!((one.core(), one.reach()), (0.0, 2.0));
        assert_eq!((SWINGING.core(), SWINGING.reach()), (2.2, 16.0));
        for (easement, core) in [(1.9, 0.0), (0.5, 0.5), (9.0, 2.0)] {
            assert_eq!(Widths { easement, ..one }.core(), core, "{easement}");
        }
    }

    #[test]
    fn the_second_derivative_keeps_its_bound() {
        let step = 1e-3;
        let at = |k: u32| SWINGING.deviation(f64::from(k) * step);
        for k in 1..16_100 {
            let bend = (at(k + 1) - 2.0 * at(k) + at(k - 1)) / (step * step);
            let bound = SWINGING.bend_bound(f64::from(k - 1) * step);
            assert!(bend.abs() < bound + 1e-5, "{k}: {bend} {bound}");
        }
    }

    #[test]
    fn what_is_wider_deviates_by_as_much_more() {
        let wide = SWINGING.scaled(3.0);
        for distance in [0.0, 0.7, 2.0, 5.0, 15.9, 16.1] {
            let (one, three) = (SWINGING.deviation(distance), wide.deviation(3.0 * distance));
            assert!((3.0 * one - three).abs() < 1e-12, "{distance}");
        }
    }
}
