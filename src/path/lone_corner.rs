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
//!
//! Where jerk limits, the speed falls up to the middle of the corner and rises behind it: the path may bend the more the nearer it is.
//! There a third kernel, half as wide as the first, takes over some of it. K with the share of it, and as much less of itself, is
//! narrower in the middle than any mix of [`kernel`] and leads to the outer side as far.
//!
//! On the outer side the path leads away from a leg along the bisector of the corner. From the line itself it is less far: by the
//! cosine of half the turn, which is what the tolerance is about there ([`Leg::take_off_along`](super::leg::Leg::take_off_along)). At
//! the corner itself the whole of it counts.

use super::kernel;
use super::settings::swing::LEAST_NATURAL_SWING;
use super::widths::{FurtherKernel, Widths};

/// How far the wide kernel reaches, of the distance of the next corner.
pub(super) const OUTER_REACH: f64 = 1.5;

/// The same where those before and behind it turn to the same side, since what corners of a figure lead to its outer side adds up:
/// this share, and so many widths of the biweight kernel ..
const REACH_IN_A_FIGURE: f64 = 0.6;
const WIDTHS_IN_A_FIGURE: f64 = 2.14;
/// .. but no less than this.
const LEAST_REACH_IN_A_FIGURE: f64 = 1.1;

/// And no more than so many tolerances, unless all corners reach farther: by how far they do so where acceleration is what limits, those of
/// a figure would be led out by acceleration that they never come to.
const TOLERANCES_IN_A_FIGURE: f64 = 107.0;

/// Less room than this, in widths of the biweight kernel, gains nothing.
const LEAST_ROOM: f64 = 2.0;

/// The first and the third kernel together are as high as one no wider than this share of the wide one.
const CORE_SHARE: f64 = 0.6;

/// Where the path is farthest on the outer side the wide kernel has fallen by so many times the width of the other two over its own,
/// and by as much more the corner may be wider: with a mix of 0.
const LITTLE_ROOM: f64 = 1.74;

/// By how much more with a mix of 1, which ends farther out; by less with a flat kernel.
const LITTLE_ROOM_BY_MIX: f64 = 0.4;

/// The path leads to the outer side as if the corner turned by no more than 120 degrees: the cosine of half of that.
const LEAST_ACROSS: f64 = 0.5;

/// With less room than the first of these, in widths of the biweight kernel, the path leads away from the corner by the tolerance at
/// most, with more than the second from the legs.
const LITTLE_ROOM_ACROSS: f64 = 7.0;
const ROOM_ACROSS: f64 = 11.0;

/// What is left at least of 1 where so much falls with little room.
const LEAST_LEFT: f64 = 0.1;

/// Share of the third kernel beside the most peaked one, in a corner of 90 degrees; in others less by the sine of the turn.
const NARROW_SHARE: f64 = 0.35;

/// It is there where the machine gathers speed on a leg: in full where the longer one of both is longer than the second of these, in
/// widths of the biweight kernel, and not at all where it is shorter than the first.
const SHORT_LEG: f64 = 5.0;
const LONG_LEG: f64 = 10.0;

/// How wide it is, of the first.
const NARROW_WIDTH: f64 = 0.5;

/// What a corner may be that keeps clear of others.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoneCorner {
    /// Mix of its kernel.
    pub mix: f64,
    /// The width for which this alone would use its tolerance, machine units.
    pub width: f64,
    /// The same with the biweight kernel.
    pub biweight_width: f64,
    /// Its tolerance, machine units.
    pub tolerance: f64,
    /// Whether it gains by swinging out, where it has room.
    pub may_swing_out: bool,
    /// How far the next corner is, machine units.
    pub clear: f64,
    /// Whether those before and behind it turn to the same side.
    pub of_figure: bool,
    /// What of a jump of its tangent leads across its legs, 0 to 1.
    pub across: f64,
    /// Its [third kernel's share](narrow_share).
    pub narrow_share: f64,
    /// How far it swings out at most, machine units.
    pub greatest_width: f64,
    /// See [`BlendSettings::swing_limits`](super::settings::BlendSettings::swing_limits).
    pub share_limits: [f64; 2],
}

/// Share of the third kernel, of what it has together with the first one of this `mix`, in a corner that turns by an angle with this
/// sine. `longer_leg`: length of the longer one of its legs in widths of the biweight kernel.
pub(super) fn narrow_share(mix: f64, turn_sine: f64, longer_leg: f64) -> f64 {
    let peaked = mix / kernel::GREATEST_PEAKED;
    let long = (longer_leg - SHORT_LEG) / (LONG_LEG - SHORT_LEG);
    NARROW_SHARE * turn_sine * peaked.max(0.0) * long.clamp(0.0, 1.0)
}

impl LoneCorner {
    pub const NONE: Self = Self {
        mix: 0.0,
        width: 0.0,
        biweight_width: 0.0,
        tolerance: 0.0,
        may_swing_out: false,
        clear: 0.0,
        of_figure: false,
        across: 1.0,
        narrow_share: 0.0,
        greatest_width: 0.0,
        share_limits: [0.0; 2],
    };

    /// Its widths where it swings out and reaches no farther than `limit`; `None` where it has no room for it or gains
    /// nothing by it.
    pub fn swinging_out(&self, limit: f64) -> Option<Widths> {
        let outer = self.outer_reach().min(self.greatest_width).min(limit);
        let room = outer / self.biweight_width;
        if !self.may_swing_out || room < LEAST_ROOM {
            return None;
        }
        let outside = self.outside(room);
        let little_room = LITTLE_ROOM * (1.0 + LITTLE_ROOM_BY_MIX * self.mix);
        let left = (1.0 - little_room * outside / room).max(LEAST_LEFT);
        // How wide a biweight kernel would be that leads to the inner side as far as the first and the third together do.
        let core = ((1.0 + outside) / left).min(CORE_SHARE * room);
        let [gathered, programmed] = self.share_limits;
        let per_share = gathered.min(programmed / outer);
        let core = core.min(1.0 + (room - 1.0) / (per_share + 1.0));
        let narrow = self.narrow_share;
        let peak = kernel::peak(self.mix) / kernel::peak(0.0);
        let width = core / ((1.0 - narrow) * peak + narrow * NARROW_WIDTH) * self.biweight_width;
        let share = (core - 1.0) / (room - core);
        let wide = FurtherKernel {
            width: outer,
            share: -share,
        };
        let narrow = if narrow > 0.0 {
            FurtherKernel {
                width: NARROW_WIDTH * width,
                share: narrow * (1.0 + share),
            }
        } else {
            FurtherKernel::NONE
        };
        Some(Widths {
            kernel: width,
            mix: self.mix,
            further: [wide, narrow],
            ..Widths::NONE
        })
    }

    /// How far the wide kernel reaches at most on account of the next corner, machine units.
    fn outer_reach(&self) -> f64 {
        let most = OUTER_REACH * self.clear;
        if !self.of_figure {
            return most;
        }
        let reach = REACH_IN_A_FIGURE * self.clear + WIDTHS_IN_A_FIGURE * self.biweight_width;
        let natural = (LEAST_NATURAL_SWING * self.biweight_width)
            .max(TOLERANCES_IN_A_FIGURE * self.tolerance);
        let reach = reach.max(LEAST_REACH_IN_A_FIGURE * self.clear);
        reach.min(most).min(natural)
    }

    /// How far the wide kernel may lead to the outer side, along the bisector, in tolerances. `room`: width of the wide kernel in
    /// those of the biweight one.
    fn outside(&self, room: f64) -> f64 {
        let over = (room - LITTLE_ROOM_ACROSS) / (ROOM_ACROSS - LITTLE_ROOM_ACROSS);
        let across = self.across.max(LEAST_ACROSS);
        1.0 + (across.recip() - 1.0) * over.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::vertex_widths::KERNEL_SHARE;
    use super::*;

    /// With a biweight width of 1.
    fn corner(clear: f64, mix: f64) -> LoneCorner {
        LoneCorner {
            mix,
            width: kernel::peak(0.0) / kernel::peak(mix),
            biweight_width: 1.0,
            tolerance: 1.0,
            may_swing_out: true,
            clear,
            of_figure: false,
            across: 1.0,
            narrow_share: narrow_share(mix, 1.0, 2.0 * clear),
            greatest_width: 200.0,
            share_limits: [0.0; 2],
        }
    }

    /// How far it leads to the inner and to the outer side at most, in tolerances.
    fn both_sides(widths: &Widths) -> [f64; 2] {
        let tolerance = kernel::peak(0.0);
        let all = (0..20_000).map(|k| widths.deviation(f64::from(k) * 1e-2) / tolerance);
        all.fold([0.0; 2], |[inside, outside], here| {
            [f64::max(inside, here), f64::max(outside, -here)]
        })
    }

    #[test]
    fn it_uses_the_tolerance_inside_and_keeps_it_outside() {
        for mix in [-1.0, -0.4, 0.0, kernel::GREATEST_PEAKED] {
            for clear in [1.4, 2.0, 3.0, 4.0, 6.0, 10.0, 30.0, 100.0] {
                for across in [1.0, 0.8, 0.6] {
                    let corner = LoneCorner {
                        across,
                        ..corner(clear, mix)
                    };
                    let widths = corner.swinging_out(f64::INFINITY).expect("room");
                    let [inside, outside] = both_sides(&widths);
                    assert!((inside - 1.0).abs() < 1e-9, "{mix} {clear}: {inside}");
                    // What is above the share that a trial keeps is narrowed by it.
                    let of_tolerance = KERNEL_SHARE * outside * across;
                    assert!(of_tolerance < 1.0, "{mix} {clear} {across}: {of_tolerance}");
                    assert!(
                        widths.kernel > 1.15 * corner.width,
                        "{mix} {clear} {across}: {widths:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn with_room_it_leads_to_the_outer_side_as_far_as_its_legs_allow() {
        for (across, allowed) in [(1.0, 1.0), (0.8, 1.25), (0.1, 2.0)] {
            let corner = LoneCorner {
                across,
                ..corner(100.0, 0.0)
            };
            let widths = corner.swinging_out(f64::INFINITY).expect("room");
            let [_, outside] = both_sides(&widths);
            assert!(
                (outside / allowed - 1.0).abs() < 0.03,
                "{across}: {outside}"
            );
            let little = corner.swinging_out(LITTLE_ROOM_ACROSS).expect("room");
            let [_, outside] = both_sides(&little);
            assert!(outside < 1.02, "{across}: {outside}");
        }
    }

    #[test]
    fn where_the_wide_kernel_would_hold_up_the_machine_it_swings_out_less() {
        let swing = |share_limits| {
            let corner = LoneCorner {
                share_limits,
                ..corner(10.0, 0.0)
            };
            let widths = corner.swinging_out(f64::INFINITY).expect("room");
            let [inside, outside] = both_sides(&widths);
            assert!((inside - 1.0).abs() < 1e-9, "{share_limits:?}: {inside}");
            (widths.further[0], outside)
        };
        let (free, outside) = swing([2.0, f64::INFINITY]);
        assert!(-free.share < 0.5 && outside > 0.9, "{free:?} {outside}");
        let (slow_axis, outside) = swing([50.0, f64::INFINITY]);
        assert!((slow_axis.share + 0.02).abs() < 1e-9, "{slow_axis:?}");
        assert!((0.01..0.5).contains(&outside), "{outside}");
        // A machine that does not gather speed, since the program asks for less.
        let (slow_feed, _) = swing([50.0, 2.0 * free.width]);
        assert_eq!(slow_feed, free);
        let (none, outside) = swing([f64::INFINITY, 1e9]);
        assert!(-none.share < 1e-7 && outside < 1e-3, "{none:?} {outside}");
    }

    #[test]
    fn peaked_ones_beside_a_long_leg_are_narrow_in_the_middle() {
        let narrow = |mix: f64, longer_leg: f64| {
            let corner = LoneCorner {
                narrow_share: narrow_share(mix, 1.0, longer_leg),
                ..corner(30.0, mix)
            };
            let widths = corner.swinging_out(f64::INFINITY).expect("room");
            let [wide, narrow] = widths.further;
            let rest = wide.share + narrow.share + widths.own_share();
            assert!(narrow.width == 0.0 || narrow.width == NARROW_WIDTH * widths.kernel);
            assert!((rest - 1.0).abs() < 1e-12);
            narrow.share / (narrow.share + widths.own_share())
        };
        let peaked = kernel::GREATEST_PEAKED;
        assert_eq!(narrow(-1.0, 100.0), 0.0);
        assert_eq!(narrow(0.0, 100.0), 0.0);
        assert_eq!(narrow(peaked, SHORT_LEG), 0.0);
        for (mix, leg, share) in [
            (peaked, LONG_LEG, 1.0),
            (peaked, 100.0, 1.0),
            (0.5 * peaked, 100.0, 0.5),
            (peaked, 0.5 * (SHORT_LEG + LONG_LEG), 0.5),
        ] {
            let found = narrow(mix, leg);
            assert!(
                (found - share * NARROW_SHARE).abs() < 1e-12,
                "{mix} {leg}: {found}"
            );
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

    #[test]
    fn in_a_figure_it_reaches_less_far() {
        let reach = |clear: f64, of_figure: bool| {
            let corner = LoneCorner {
                of_figure,
                ..corner(clear, 0.0)
            };
            corner.swinging_out(f64::INFINITY).expect("room").reach()
        };
        for clear in [1.5, 3.0, 4.0, 10.0] {
            assert!((reach(clear, false) - OUTER_REACH * clear).abs() < 1e-12);
        }
        // As far as it may anyway, by its own width, and by the distance alone.
        for (clear, expected) in [(1.5, 2.25), (3.0, 3.94), (4.0, 4.54), (10.0, 11.0)] {
            let found = reach(clear, true);
            assert!((found - expected).abs() < 1e-12, "{clear}: {found}");
        }
        // And by its tolerance, or the six widths that all reach.
        for (tolerance, expected) in [(0.08, 8.56), (0.01, LEAST_NATURAL_SWING)] {
            let corner = LoneCorner {
                tolerance,
                of_figure: true,
                ..corner(10.0, 0.0)
            };
            let found = corner.swinging_out(f64::INFINITY).expect("room").reach();
            assert!((found - expected).abs() < 1e-12, "{tolerance}: {found}");
        }
    }
}
