//! What the axes are able to do.

use std::array::from_fn;

/// Number of axes: X Y Z A B C U V W.
pub(crate) const AXES: usize = 9;

/// Limits of each axis, mm or degrees and seconds; all positive, infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AxisLimits {
    pub velocity: [f64; AXES],
    pub acceleration: [f64; AXES],
    pub jerk: [f64; AXES],
}

impl AxisLimits {
    /// Whether the jerk of an axis is limited.
    pub(crate) fn limit_jerk(&self) -> bool {
        self.jerk.iter().any(|jerk| jerk.is_finite())
    }
}

/// How fast the program lets a place of the path be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SpeedCap {
    /// Where the program leaves it to the axes.
    None,
    /// The speed that three axes together may have, for a move of none but these.
    Counted {
        /// First of the three axes that the feed counts.
        first_axis: usize,
        /// mm/s or degrees per second; infinite where the program does not say.
        speed: f64,
    },
    /// dq/dt of a move at its feed, which counts some of the axes that move: mm and degrees per second.
    Along([f64; AXES]),
}

/// Where the path leads off a move by more than this, radians, the feed of that move does not hold: in a corner between
/// moves of which F counts different axes, the few that one of them counts may be almost all that moves.
const OFF_THE_MOVE: f64 = 0.03;

impl SpeedCap {
    /// The greatest ds/dt, with `first` = dq/ds. Directions are compared with each axis over its `velocity`.
    pub(crate) fn along(&self, first: &[f64; AXES], velocity: &[f64; AXES]) -> f64 {
        match self {
            SpeedCap::None => f64::INFINITY,
            SpeedCap::Counted { first_axis, speed } => {
                let counted = first.iter().skip(*first_axis).take(3);
                let slope = counted.map(|part| part * part).sum::<f64>().sqrt();
                if slope > 0.0 {
                    speed / slope
                } else {
                    f64::INFINITY
                }
            }
            SpeedCap::Along(rate) => {
                let [path, asked] = [first, rate].map(|of| over(of, velocity));
                if angle(&path, &asked) > OFF_THE_MOVE {
                    f64::INFINITY
                } else {
                    norm(&asked) / norm(&path)
                }
            }
        }
    }
}

/// Each axis over its greatest velocity.
pub(super) fn over(vector: &[f64; AXES], velocity: &[f64; AXES]) -> [f64; AXES] {
    from_fn(|axis| vector[axis] / velocity[axis])
}

pub(super) fn norm(vector: &[f64; AXES]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Angle between two vectors, radians; 0 if one of them is zero.
pub(super) fn angle(a: &[f64; AXES], b: &[f64; AXES]) -> f64 {
    let lengths = norm(a) * norm(b);
    if lengths <= 0.0 {
        return 0.0;
    }
    let cosine = a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / lengths;
    // More accurate than the arc cosine at small angles.
    let difference: [f64; AXES] = from_fn(|axis| a[axis] / norm(a) - b[axis] / norm(b));
    if cosine > 0.0 {
        2.0 * (norm(&difference) / 2.0).min(1.0).asin()
    } else {
        cosine.clamp(-1.0, 1.0).acos()
    }
}
