//! What an interval allows while nothing is known but its speed: the scalars of the sweep.
//!
//! The jerk of an axis has three terms, `q' j`, `3 q'' v a` and `q''' v^3`. Each is given a share
//! of J in advance, so that speed, acceleration and jerk along the path are limited one by one.

use super::rows::{AxisRows, Sample};
use crate::axes::{AXIS_COUNT, Axes};

/// Share of the speed cap, so that the barrier of the cap has room.
const CAP_SHARE: f64 = 0.98;
/// Share of the acceleration for curvature.
const CURVE_SHARE: f64 = 0.6;
/// Share of the jerk for the change of curvature.
const CURVE_JERK_SHARE: f64 = 0.6;
/// Share of the jerk for accelerating in a curve.
const ACROSS_SHARE: f64 = 0.25;

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
        let mut first = Axes::zeros();
        let mut second = Axes::zeros();
        let mut third = Axes::zeros();
        let mut cap = Self::NONE.cap;
        for sample in samples {
            first = first.sup(&sample.first.abs());
            second = second.sup(&sample.second.abs());
            third = third.sup(&sample.third.abs());
            cap = cap.min(CAP_SHARE * sample.cap(raise_squared));
        }
        let time = rows.jerk_time();
        let curve = second.component_mul(time).max() / 3.0;
        if curve * cap > CURVE_SHARE {
            cap = CURVE_SHARE / curve;
        }
        let twist = third.max();
        if twist * cap * cap.sqrt() > CURVE_JERK_SHARE {
            let root = (CURVE_JERK_SHARE / twist).cbrt();
            cap = root * root;
        }

        let v = cap.sqrt();
        let mut acceleration = Self::NONE.acceleration;
        for axis in 0..AXIS_COUNT {
            let slope = first[axis] * time[axis];
            let left = margin - second[axis] * time[axis] / 3.0 * cap;
            if acceleration * slope > left {
                acceleration = left / slope;
            }
        }
        let mut jerk = Self::NONE.jerk;
        for axis in 0..AXIS_COUNT {
            let across = (second[axis] * acceleration * v).min(ACROSS_SHARE);
            let left = margin - third[axis] * cap * v - across;
            if jerk * first[axis] > left {
                jerk = left / first[axis];
            }
        }
        let steepest = second.max();
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
