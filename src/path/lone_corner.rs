//! A corner that keeps clear of other corners, and how it swings out.
//!
//! A corner rounded by one kernel is cut on its inner side: the tolerance on the outer side is left unused. A driver
//! swings out before and behind a turn. So does a corner whose kernel K, wider than the tolerance allows it alone,
//! has a little of a much wider one taken off, with `e` such that its middle keeps the tolerance on the inner side:
//!
//! ```text
//! (1 + e) K(x / w) / w  -  e K2(x / W) / W
//! ```
//!
//! On the wide kernel the path leads away to the outer side, and the narrow one has twice the way to lead back over.
//! With w2 the width for which the biweight kernel alone uses the tolerance, where both sides use it:
//!
//! | W / w2 | w / w2 | e | speed in the corner, acceleration or jerk limiting |
//! |---|---|---|---|
//! | 6 | 2.80 | .56 | 1.47, 1.74 |
//! | 8 | 2.50 | .27 | 1.45, 1.71 |
//! | 16 | 2.20 | .087 | 1.43, 1.65 |
//! | 64 | 2.05 | .017 | 1.42, 1.60 |
//!
//! What the wide kernel bends is little: a hundredth of what the narrow one does where it is ten times as wide, so that
//! the machine speeds up on it as on a line.

use super::kernel;
use super::widths::Widths;

/// How far the wide kernel reaches, of the distance of the next corner.
pub(super) const OUTER_REACH: f64 = 1.5;

/// Less room than this, in widths of the biweight kernel, gains nothing.
const LEAST_ROOM: f64 = 2.0;

/// The narrow kernel is no wider than this share of the wide one.
const CORE_SHARE: f64 = 0.6;

/// What of the width is used that the narrow kernel would gain with the whole tolerance on the outer side.
const OUTER_TOLERANCE: f64 = 0.95;

/// What a corner may be that keeps clear of others.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoneCorner {
    /// Mix of its kernel.
    pub mix: f64,
    /// The width for which this alone would use its tolerance, machine units.
    pub width: f64,
    /// The same with the biweight kernel.
    pub biweight_width: f64,
    /// Whether it gains by swinging out, where it has room.
    pub may_swing_out: bool,
    /// How far the next corner is, machine units.
    pub clear: f64,
    /// How far it swings out at most, machine units.
    pub greatest_width: f64,
}

impl LoneCorner {
    pub const NONE: Self = Self {
        mix: 0.0,
        width: 0.0,
        biweight_width: 0.0,
        may_swing_out: false,
        clear: 0.0,
        greatest_width: 0.0,
    };

    /// Its widths where it swings out and reaches no farther than `limit`; `None` where it has no room for it or gains
    /// nothing by it.
    pub fn swinging_out(&self, limit: f64) -> Option<Widths> {
        let outer = (OUTER_REACH * self.clear)
            .min(self.greatest_width)
            .min(limit);
        let room = outer / self.biweight_width;
        if !self.may_swing_out || room < LEAST_ROOM {
            return None;
        }
        let peak = kernel::peak(self.mix) / kernel::peak(0.0);
        // Fitted to the table above, and to that of flatter kernels, which lead farther to the outer side.
        let little_room = 2.24 / room + 15.4 / (room * room);
        let both_sides = 1.0 + little_room * (1.0 + 0.45 * self.mix.min(0.0));
        let width = (1.0 + OUTER_TOLERANCE * both_sides).min(CORE_SHARE * room) / peak;
        Some(Widths {
            kernel: width * self.biweight_width,
            mix: self.mix,
            outer,
            outer_share: (width * peak - 1.0) / (room - width * peak),
            ..Widths::NONE
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With a biweight width of 1.
    fn corner(clear: f64, mix: f64) -> LoneCorner {
        LoneCorner {
            mix,
            width: kernel::peak(0.0) / kernel::peak(mix),
            biweight_width: 1.0,
            may_swing_out: true,
            clear,
            greatest_width: 200.0,
        }
    }

    #[test]
    fn it_uses_the_tolerance_inside_and_keeps_it_outside() {
        let tolerance = kernel::peak(0.0);
        for mix in [-1.0, -0.4, 0.0, kernel::GREATEST_PEAKED] {
            for clear in [1.4, 2.0, 3.0, 4.0, 6.0, 10.0, 30.0, 100.0] {
                let widths = corner(clear, mix)
                    .swinging_out(f64::INFINITY)
                    .expect("room");
                let all = (0..20_000).map(|k| widths.deviation(f64::from(k) * 1e-2));
                let (least, greatest) = all.fold((0.0f64, 0.0f64), |(least, greatest), here| {
                    (least.min(here), greatest.max(here))
                });
                assert!(
                    (greatest / tolerance - 1.0).abs() < 1e-9,
                    "{mix} {clear}: {greatest}"
                );
                assert!(-least < 0.99 * tolerance, "{mix} {clear}: {least}");
                assert!(
                    widths.kernel > 1.15 * corner(clear, mix).width,
                    "{mix} {clear}: {widths:?}"
                );
            }
        }
    }

    #[test]
    fn it_reaches_no_farther_than_there_is_room() {
        let widths = corner(10.0, 0.0).swinging_out(f64::INFINITY).expect("room");
        assert_eq!(widths.reach(), 15.0);
        let widths = corner(10.0, 0.0).swinging_out(3.0).expect("room");
        assert_eq!(widths.reach(), 3.0);
        assert_eq!(corner(10.0, 0.0).swinging_out(1.9), None);
        assert_eq!(corner(1.3, 0.0).swinging_out(f64::INFINITY), None);
        let held = LoneCorner {
            may_swing_out: false,
            ..corner(10.0, 0.0)
        };
        assert_eq!(held.swinging_out(f64::INFINITY), None);
    }
}
