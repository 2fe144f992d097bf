//! What an interval allows while nothing is known but its speed: the scalars of the sweep.
//!
//! The jerk of an axis has three terms, `q' j`, `3 q'' v a` and `q''' v^3`. Each is given a share
//! of J in advance, so that speed, acceleration and jerk along the path are limited one by one.

use super::rows::{AxisRows, MovingAxes, Sample};
use crate::axes::AXIS_COUNT;
use crate::cube_root::cube_root;

/// Share of the speed cap, so that the barrier of the cap has room.
const CAP_SHARE: f64 = 0.98;
/// Share of the acceleration for curvature.
const CURVE_SHARE: f64 = 0.6;
/// Share of the jerk for the change of curvature.
const CURVE_JERK_SHARE: f64 = 0.6;
/// Share of the jerk for accelerating in a curve.
const ACROSS_SHARE: f64 = 0.25;

/// The greatest amounts of an axis' rows in an interval.
#[derive(Clone, Copy)]
struct AxisBounds {
    first: f64,
    second: f64,
    third: f64,
    /// J / A.
    time: f64,
}

impl AxisBounds {
    const NONE: Self = Self {
        first: 0.0,
        second: 0.0,
        third: 0.0,
        time: 0.0,
    };
}

/// Limits along the path in one interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Of v^2.
    pub cap: f64,
    /// Of the amount of acceleration.
    pub acceleration: f64,
    /// Of the amount of jerk.
    pub jerk: f64,
    /// Of a^2 v^2.
    pub across: f64,
}

impl Bounds {
    /// An interval that limits nothing: what is beyond the ends of a plan.
    pub const NONE: Self = Self {
        cap: 1e30,
        acceleration: 1e30,
        jerk: 1e30,
        across: 1e60,
    };

    /// Of an interval with these samples at start, middle and end; `margin` is the share of the
    /// limits that is handed out.
    pub fn of(rows: &AxisRows, samples: [&Sample; 3], raise_squared: f64, margin: f64) -> Self {
        let mut cap = Self::NONE.cap;
        for sample in samples {
            cap = cap.min(CAP_SHARE * sample.cap(raise_squared));
        }
        let moving = MovingAxes::at_any(samples);
        let times = rows.jerk_time();
        let [start, middle, end] = samples;
        let greatest = |a: f64, b: f64, c: f64| a.abs().max(b.abs()).max(c.abs());
        let mut axes = [AxisBounds::NONE; AXIS_COUNT];
        let (mut curve, mut twist, mut steepest) = (0.0, 0.0, 0.0);
        let mut count = 0;
        for axis in 0..AXIS_COUNT {
            if !moving.contains(axis) {
                continue;
            }
            let time = times[axis];
            let second = greatest(start.second[axis], middle.second[axis], end.second[axis]);
            let third = greatest(start.third[axis], middle.third[axis], end.third[axis]);
            if let Some(bounds) = axes.get_mut(count) {
                *bounds = AxisBounds {
                    first: greatest(start.first[axis], middle.first[axis], end.first[axis]),
                    second,
                    third,
                    time,
                };
            }
            count += 1;
            curve = f64::max(curve, second * time);
            twist = f64::max(twist, third);
            steepest = f64::max(steepest, second);
        }
        curve /= 3.0;
        if curve * cap > CURVE_SHARE {
            cap = CURVE_SHARE / curve;
        }
        if twist * cap * cap.sqrt() > CURVE_JERK_SHARE {
            let root = cube_root(CURVE_JERK_SHARE / twist);
            cap = root * root;
        }

        let v = cap.sqrt();
        let mut acceleration = Self::NONE.acceleration;
        for bounds in axes.iter().take(count) {
            let slope = bounds.first * bounds.time;
            let left = margin - bounds.second * bounds.time / 3.0 * cap;
            if acceleration * slope > left {
                acceleration = left / slope;
            }
        }
        let mut jerk = Self::NONE.jerk;
        for bounds in axes.iter().take(count) {
            let across = (bounds.second * acceleration * v).min(ACROSS_SHARE);
            let left = margin - bounds.third * cap * v - across;
            if jerk * bounds.first > left {
                jerk = left / bounds.first;
            }
        }
        let across = if steepest > 0.0 {
            (ACROSS_SHARE / steepest) * (ACROSS_SHARE / steepest)
        } else {
            Self::NONE.across
        };
        Self {
            cap,
            acceleration,
            jerk,
            across,
        }
    }

    /// Lower ones.
    pub fn lower(&mut self) {
        self.cap *= 0.9;
        self.acceleration *= 0.9;
        self.jerk *= 0.7;
        self.across *= 0.5;
    }
}
