//! What axes and joints are able to do.

use std::array::from_fn;

/// Number of axes: X Y Z A B C U V W.
pub(crate) const AXES: usize = 9;

/// Coordinates of a path: those of the axes, and behind these the joints where they have limits of their own, else 0.
pub(crate) const COORDINATES: usize = 2 * AXES;

/// One number for each of them, shape (18).
pub(crate) type Coordinates = [f64; COORDINATES];

/// Axes and joints, one behind the other.
pub(super) fn coordinates(axes: &[f64; AXES], joints: &[f64; AXES]) -> Coordinates {
    from_fn(|index| match index.checked_sub(AXES) {
        None => axes[index],
        Some(joint) => joints[joint],
    })
}

/// Limits of each coordinate, mm or degrees and seconds; all positive, infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathLimits {
    pub velocity: Coordinates,
    pub acceleration: Coordinates,
    pub jerk: Coordinates,
}

impl PathLimits {
    /// From velocity, acceleration and jerk of the axes, and of the joints that have limits, shapes (3, 9).
    pub(crate) fn new(axes: [[f64; AXES]; 3], joints: Option<[[f64; AXES]; 3]>) -> PathLimits {
        let joints = joints.unwrap_or([[f64::INFINITY; AXES]; 3]);
        let [velocity, acceleration, jerk] =
            from_fn(|quantity| coordinates(&axes[quantity], &joints[quantity]));
        PathLimits {
            velocity,
            acceleration,
            jerk,
        }
    }

    /// Whether the jerk of a coordinate is limited.
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
    pub(crate) fn along(&self, first: &Coordinates, velocity: &Coordinates) -> f64 {
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
                let none = [0.0; AXES];
                let axes: [f64; AXES] = from_fn(|axis| first[axis]);
                let [path, asked] = [&axes, rate].map(|of| over(&coordinates(of, &none), velocity));
                if angle(&path, &asked) > OFF_THE_MOVE {
                    f64::INFINITY
                } else {
                    norm(&asked) / norm(&path)
                }
            }
        }
    }
}

/// Each coordinate over its greatest velocity.
pub(super) fn over(vector: &Coordinates, velocity: &Coordinates) -> Coordinates {
    from_fn(|index| vector[index] / velocity[index])
}

pub(super) fn norm(vector: &Coordinates) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Angle between two vectors, radians; 0 if one of them is zero.
pub(super) fn angle(a: &Coordinates, b: &Coordinates) -> f64 {
    let lengths = norm(a) * norm(b);
    if lengths <= 0.0 {
        return 0.0;
    }
    let cosine = a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / lengths;
    // More accurate than the arc cosine at small angles.
    let difference: Coordinates = from_fn(|index| a[index] / norm(a) - b[index] / norm(b));
    if cosine > 0.0 {
        2.0 * (norm(&difference) / 2.0).min(1.0).asin()
    } else {
        cosine.clamp(-1.0, 1.0).acos()
    }
}
