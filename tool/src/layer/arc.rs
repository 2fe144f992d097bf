//! Arcs: velocity and acceleration in the plane and along the normal; flat ones become lines, whatever turns they have.

use super::Layer;
use crate::canon::call::{Call, Plane};
use crate::layer::program::{MotionType, Move, Shape};
use crate::path::segment::Segment;
use std::f64::consts::TAU;

/// Share of the acceleration that may point to the centre: the rest is left for the feed.
const NORMAL_SHARE: f64 = 0.866_025_403_784_438_6; // sqrt(3) / 2

/// The angle up to which an arc counts as a full turn when its height is looked at, radians.
const FULL_TURN: f64 = 1e-5;

impl Layer<'_> {
    pub(super) fn arc(&mut self, call: &Call) {
        let Call::Arc {
            line,
            end,
            centre,
            normal,
            turns,
            plane,
            rotated,
        } = *call
        else {
            return;
        };
        let programmed = Segment::arc(self.programmed_end, end, centre, normal, turns);
        if turns != 0
            && plane == Plane::Xy
            && self.continuous()
            && self.merge_flat_arc(line, programmed)
        {
            return;
        }
        self.flush();
        let segment = if turns == 0 {
            Segment::line(self.end, end)
        } else {
            Segment::arc(self.end, end, centre, normal, turns)
        };
        let (velocity, acceleration) = self.arc_rates(&segment, plane, rotated);
        let feed = velocity.min(self.linear_feed);
        if feed > 0.0 && acceleration > 0.0 {
            self.builder.piece(line, segment);
            let shape = if turns == 0 {
                Shape::Line
            } else {
                Shape::Arc {
                    centre,
                    normal,
                    turn: if turns > 0 { turns - 1 } else { turns },
                }
            };
            let at_speed = std::mem::take(&mut self.at_speed_next);
            self.builder.hand(
                Move {
                    index: 0,
                    line,
                    shape,
                    end,
                    motion_type: MotionType::Arc,
                    velocity: feed,
                    greatest_velocity: velocity,
                    acceleration,
                    at_speed,
                    tag: self.tag,
                },
                segment,
            );
        }
        self.end = end;
        self.programmed_end = end;
    }

    /// Passes on an arc whose height over its chord is below the tolerance of the merging.
    fn merge_flat_arc(&mut self, line: i32, programmed: Segment) -> bool {
        let Some(arc) = programmed.arc else {
            return false;
        };
        let mut within = arc.sweep % TAU;
        if within <= FULL_TURN {
            within += TAU;
        }
        if arc.start_radius * (1.0 - (within / 2.0).cos()) >= self.chain.tolerance {
            return false;
        }
        let turns = match 2.0 * arc.start_radius < self.chain.tolerance {
            // Where a whole turn is as flat, they are within the tolerance.
            true => 0,
            false => ((arc.sweep - within) / TAU).round() as u32,
        };
        let mut once = programmed;
        if let Some(arc) = &mut once.arc {
            arc.sweep = within;
            arc.end_radius = arc.start_radius;
        }
        let half = once.point(0.5);
        let end = programmed.end;
        let mut middle = [0.0; 9];
        for (axis, value) in middle.iter_mut().enumerate() {
            *value = (self.end[axis] + end[axis]) / 2.0;
        }
        middle[0] = half[0];
        middle[1] = half[1];
        middle[2] = (self.last_height() + end[2]) / 2.0;
        self.feed_flat_arc(line, (programmed, turns), middle);
        true
    }

    /// Greatest velocity and acceleration of an arc.
    fn arc_rates(&self, segment: &Segment, plane: Plane, rotated: bool) -> (f64, f64) {
        let limits = &self.settings.limits;
        let (mut plane_velocity, mut plane_acceleration) = (f64::INFINITY, f64::INFINITY);
        for axis in 0..3 {
            // In rotated coordinates the third axis may have a part in it.
            if axis != plane.normal_axis() || (rotated && plane != Plane::Xy) {
                plane_velocity = plane_velocity.min(limits.velocity[axis]);
                plane_acceleration = plane_acceleration.min(limits.acceleration[axis]);
            }
        }
        let (mut flat, mut length, mut radius) = (0.0, segment.length, 0.0);
        if let Some(arc) = segment.arc {
            let smaller = arc.start_radius.min(arc.end_radius);
            let grown = arc.end_radius - arc.start_radius;
            flat = (smaller * arc.sweep).hypot(grown);
            length = flat.hypot(arc.climb);
            radius = (grown / arc.sweep).hypot(smaller);
        }
        let straight = self.straight(&segment.end);
        let round = (plane_acceleration * NORMAL_SHARE * radius)
            .sqrt()
            .min(plane_velocity);
        let velocity_time = straight
            .velocity_time
            .max(if flat > 0.0 { flat / round } else { 0.0 });
        let acceleration_ratio = straight.acceleration_ratio.max(flat / plane_acceleration);
        if velocity_time > 0.0 && acceleration_ratio > 0.0 {
            (length / velocity_time, length / acceleration_ratio)
        } else {
            (0.0, 0.0)
        }
    }
}
