//! The base widths of a vertex that follow from its two legs alone.

use nalgebra::Vector3;

use super::leg::Leg;
use super::linear_axes::{self, LinearAxes, ends, greater_end};
use super::lone_corner::{LoneCorner, narrow_share};
use super::settings::BlendSettings;
use super::vertex::Vertex;
use super::{easement, kernel, unlike_axes};
use crate::axes::Axes;

/// Of the tolerance, what the middle of a corner uses.
pub(super) const KERNEL_SHARE: f64 = 0.97;

/// Of the tolerance, what an easement uses.
const EASEMENT_SHARE: f64 = 0.9;

/// The same for a kernel and an easement where moves are to be followed exactly.
const EXACT_KERNEL_SHARE: f64 = 0.35;
const EXACT_EASEMENT_SHARE: f64 = 0.6;

/// Of the room for it, the least width over which a tangent that is not quite one is rounded.
const LEAST_ROUNDING: f64 = 0.01;

/// Halves of the shorter leg, of an arc not more than a radian, that an easement reaches at most. Those
/// at both ends of an arc much shorter than they are wide nearly cancel each other, but for their edges:
/// there the third derivative rises within the length of the arc, which is too short for the nodes of the
/// plan. Those at an arc of several turns would lead many radii away from it.
const WIDEST_EASEMENT: f64 = 64.0;

/// And radii of the arc: wider ones lead back and forth beside an arc that is small for its tolerance.
const RADII_OF_AN_EASEMENT: f64 = 3.0;

/// A kernel this much narrower than half the shorter leg makes an isolated corner.
const ISOLATED: f64 = 0.5;

impl Vertex {
    /// Where moves that are to be followed exactly meet in a tangent: within their tolerance, a
    /// micrometre or less. An easement leaves the point itself alone.
    pub(super) fn find_exact_widths(
        &mut self,
        before: &Leg,
        after: &Leg,
        settings: &BlendSettings,
    ) {
        let room = self.half_leg.min(settings.greatest_design_width());
        if self.tangent_jump_size > 0.0 {
            let slower = before.speed.min(after.speed);
            let wanted = settings
                .free_width(&self.tangent_jump.axes(), slower, 0.0)
                .max(LEAST_ROUNDING * room);
            let within = EXACT_KERNEL_SHARE * self.tolerance / self.tangent_jump_size;
            self.corner.width = within / kernel::peak(0.0);
            self.corner.biweight_width = self.corner.width;
            self.isolated = true;
            self.base.kernel = self.corner.width.min(room).min(wanted);
        }
        if self.curvature_jump_size > 0.0 {
            let within = EXACT_EASEMENT_SHARE * self.tolerance
                / (self.easement_peak() * self.curvature_jump_size);
            self.base.easement = within.sqrt().min(room);
        }
    }

    pub(super) fn find_base_widths(&mut self, before: &Leg, after: &Leg, settings: &BlendSettings) {
        let speed = before.speed.max(after.speed);
        let design_width = before.design_width.max(after.design_width);
        if before.allows_half_legs() && after.allows_half_legs() {
            self.free_limit = before.half_for_corner().min(after.half_for_corner());
        }
        if self.tangent_jump_size > 0.0 {
            let within = self.jumps_within(&after.shift_at(self.s));
            let biweight_width = within / kernel::peak(0.0);
            // In the slower leg's half the other's feed does not matter.
            let slower = before.speed.min(after.speed);
            let tangent_jump = self.tangent_jump.axes();
            let legs = [before, after].map(Leg::direction_at_start);
            let (mix, free) =
                self.mix_alone(&tangent_jump, &legs, biweight_width, slower, settings);
            self.corner = LoneCorner {
                mix,
                width: within / kernel::peak(mix),
                biweight_width,
                tolerance: self.tolerance,
                may_swing_out: before.may_swing_out
                    && after.may_swing_out
                    && !self.at_limit
                    && self.free_limit <= 0.0
                    && settings.gains_by_swinging_out(&tangent_jump, biweight_width, slower),
                clear: 2.0 * self.half_leg,
                share_limits: settings.swing_limits(
                    &tangent_jump,
                    [(&legs[0], before.speed), (&legs[1], after.speed)],
                ),
                greatest_width: settings
                    .greatest_swing(2.0 * self.half_leg, self.tolerance, slower)
                    .min(settings.natural_swing(&tangent_jump, self.tolerance, biweight_width)),
                ..self.corner_beside(before, after, mix, biweight_width)
            };
            self.free_kernel = free.min(self.free_limit);
            self.isolated = if self.at_limit {
                true
            } else if self.free_limit > 0.0 {
                free <= self.free_limit
            } else {
                biweight_width <= ISOLATED * self.half_leg
                    || unlike_axes::stands_alone(before, after, settings)
            };
            self.scan_done = self.isolated;
            self.searched = self.isolated;
            self.scanned = self.half_leg.min(biweight_width);
            self.design_width = settings
                .full_speed_width(self.tangent_jump_size, speed)
                .min(self.longer_leg)
                .max(design_width)
                .min(settings.greatest_design_width());
            self.base = self.widths_alone();
            self.find_taper(after);
            self.find_moved_beside(before, after);
        }
        if self.curvature_jump_size > 0.0 {
            self.find_base_easement(before, after, settings);
        }
    }

    /// What of its corner follows from what it turns by, and from the legs beside it.
    fn corner_beside(
        &self,
        before: &Leg,
        after: &Leg,
        mix: f64,
        biweight_width: f64,
    ) -> LoneCorner {
        let half_turn_sine = 0.5 * self.tangent_jump_size;
        let half_turn_cosine = (1.0 - half_turn_sine * half_turn_sine).max(0.0).sqrt();
        LoneCorner {
            across: if before.is_free_along() && after.is_free_along() {
                half_turn_cosine
            } else {
                1.0
            },
            narrow_share: narrow_share(
                mix,
                self.tangent_jump_size * half_turn_cosine,
                self.longer_leg / biweight_width,
            ),
            ..LoneCorner::NONE
        }
    }

    /// How many jumps of its tangent lead so far from the program as the middle of a corner may be, where it is moved: at
    /// both ends, as if the jump of each were that of the greater one.
    fn jumps_within(&self, shift: &LinearAxes) -> f64 {
        let allowed = KERNEL_SHARE * self.tolerance;
        let jumps = ends(&linear_axes::of(&self.tangent_jump.axes()));
        let of_end = |(shift, jump): (Vector3<f64>, &Vector3<f64>)| {
            let towards = shift.dot(jump);
            if towards == 0.0 {
                return allowed / self.tolerance_jump_size;
            }
            let left = (allowed * allowed - shift.norm_squared()).max(0.0);
            let square = self.tolerance_jump_size * self.tolerance_jump_size;
            ((towards * towards + square * left).sqrt() - towards) / square
        };
        let moved = ends(shift).into_iter().zip(&jumps);
        let within = moved.filter(|(_, jump)| **jump != Vector3::zeros());
        within
            .map(of_end)
            .reduce(f64::min)
            .unwrap_or(allowed / self.tolerance_jump_size)
    }

    /// The mix of its kernel where it keeps clear of its neighbours', and the width that its feed wants where half legs may be
    /// cut. `legs`: directions of both, shape (9).
    fn mix_alone(
        &self,
        tangent_jump: &Axes,
        legs: &[Axes; 2],
        biweight_width: f64,
        speed: f64,
        settings: &BlendSettings,
    ) -> (f64, f64) {
        // What leads an arc back to the inner side is meant for the biweight kernel.
        let biweight = self.at_limit && self.curvature_jump_size > 0.0;
        let times_as_slow = legs
            .iter()
            .map(|direction| settings.times_as_slow(tangent_jump, direction))
            .fold(1.0, f64::max);
        let mix_of = |width: f64, by_tolerance: bool| {
            if biweight {
                0.0
            } else {
                let mix = settings.corner_mix(tangent_jump, width, by_tolerance);
                // At the end of a flat one a faster leg could not yet be run faster.
                mix.max(mix / times_as_slow)
            }
        };
        if self.free_limit > 0.0 {
            let width = settings.free_width(tangent_jump, speed, 0.0);
            let mix = mix_of(width.min(self.free_limit), false);
            (mix, settings.free_width(tangent_jump, speed, mix))
        } else {
            let by_tolerance = biweight_width < self.half_leg;
            (mix_of(biweight_width.min(self.half_leg), by_tolerance), 0.0)
        }
    }

    fn find_base_easement(&mut self, before: &Leg, after: &Leg, settings: &BlendSettings) {
        let speed = before.speed.max(after.speed);
        let design_width = before.design_width.max(after.design_width);
        let left = self.tolerance - greater_end(&after.shift_at(self.s));
        let within = EASEMENT_SHARE * left / (self.easement_peak() * self.curvature_jump_size);
        let halves = before.half_for_corner().min(after.half_for_corner());
        let wanted = if self.at_limit {
            halves
        } else {
            settings
                .full_speed_easement(self.curvature_jump_size, speed)
                .max(design_width)
                .min(WIDEST_EASEMENT * halves)
                .min(RADII_OF_AN_EASEMENT / self.curvature_jump_size)
        };
        self.free_easement = wanted.min(self.free_limit);
        self.base.easement = within.sqrt().min(wanted).max(self.free_easement);
    }

    /// The greatest value of its easement for a width of 1.
    fn easement_peak(&self) -> f64 {
        if self.at_limit {
            easement::INNER_PEAK
        } else {
            easement::PEAK
        }
    }
}
