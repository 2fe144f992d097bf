//! How far the path may leave the program where the program does not say.

use core::ops::RangeInclusive;

use super::range::Deviation;
use crate::axes::AxisLimits;
use crate::moves::{Move, MoveQueue, TerminationCondition};
use crate::path::{BlendSettings, Orientation};

/// Moves that are looked at for the first tolerance of a program, of those that have come when its
/// path begins.
const MOVES: u64 = 16;

/// Bounds of the weight of rotary axes. Where they bind both tolerances are still kept: a greater
/// weight lets rotary axes deviate less, and no P exceeds what
/// [`greatest_tolerance`](Blending::greatest_tolerance) says.
const LEAST_WEIGHT: f64 = 1e-9;
const GREATEST_WEIGHT: f64 = 1e9;

/// Lengths of a millimetre that are taken, machine units: 1 or 1/25.4; with a metre or a micrometre as the unit 1e-3 or 1e3.
const MILLIMETRES: RangeInclusive<f64> = 1e-6..=1e6;

/// The greatest tolerance that a configuration may give, machine units or degrees.
const GREATEST_TOLERANCE: f64 = 1e6;

/// Why settings were refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlendingError {
    /// The length of a millimetre is not a number from 1e-6 to 1e6.
    Millimetre,
    /// The tolerance of rotary axes is not a number from 0 to 1e6.
    RotaryTolerance,
    /// The tolerance for G64 without P is not a number from 0 to 1e6.
    DefaultTolerance,
}

/// What a machine's configuration says about blending, and the weight of rotary axes that follows.
#[derive(Clone, Copy, Debug)]
pub struct Blending {
    /// What is asked for now.
    asked: Asked,
    /// What was asked for when the path began that is under way.
    in_force: Asked,
    /// Machine units that count as much as a degree of A B C.
    weight: f64,
}

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Asked {
    /// The length of a millimetre in machine units.
    millimetre: f64,
    /// How far rotary axes may leave the program where P is given, degrees; 0: by as many degrees
    /// as P has millimetres.
    rotary_tolerance: f64,
    /// The tolerance of runs of short moves under G64 without P, machine units.
    default_tolerance: f64,
    /// Which axis tilts the tool while C turns it, 3 for A, 4 for B, where the machine tells.
    tilt: Option<usize>,
    /// Whether corners are rounded on their inner side only.
    corners_inside: bool,
}

impl Asked {
    const DEFAULT: Self = Self {
        millimetre: 1.0,
        rotary_tolerance: 0.0,
        default_tolerance: Blending::DEFAULT_TOLERANCE,
        tilt: None,
        corners_inside: false,
    };
}

impl Blending {
    /// The tolerance of runs of short moves under G64 without P, machine units.
    pub const DEFAULT_TOLERANCE: f64 = 0.02;

    /// A machine in millimetres.
    pub const DEFAULT: Self = Self {
        asked: Asked::DEFAULT,
        in_force: Asked::DEFAULT,
        weight: 1.0,
    };

    pub(super) fn set(
        &mut self,
        millimetre: f64,
        rotary_tolerance: f64,
        default_tolerance: f64,
    ) -> Result<(), BlendingError> {
        let not_negative = |value: f64| (0.0..=GREATEST_TOLERANCE).contains(&value);
        if !MILLIMETRES.contains(&millimetre) {
            return Err(BlendingError::Millimetre);
        }
        if !not_negative(rotary_tolerance) {
            return Err(BlendingError::RotaryTolerance);
        }
        if !not_negative(default_tolerance) {
            return Err(BlendingError::DefaultTolerance);
        }
        self.asked.millimetre = millimetre;
        self.asked.rotary_tolerance = rotary_tolerance;
        self.asked.default_tolerance = default_tolerance;
        Ok(())
    }

    /// Which axis tilts the tool while C turns it. Others than A and B count as none.
    pub(super) fn set_tilt(&mut self, tilt: Option<usize>) {
        self.asked.tilt = tilt.filter(|axis| (3..5).contains(axis));
    }

    /// Whether corners are rounded on their inner side only.
    pub(super) fn set_corners_inside(&mut self, inside: bool) {
        self.asked.corners_inside = inside;
    }

    /// What no tolerance P may exceed so that rotary axes keep theirs, machine units.
    pub(super) fn greatest_tolerance(&self) -> f64 {
        if self.in_force.rotary_tolerance > 0.0 {
            self.weight * self.in_force.rotary_tolerance
        } else {
            f64::INFINITY
        }
    }

    /// What moves are left by that are to be followed exactly, machine units.
    fn exact_tolerance(&self) -> f64 {
        BlendSettings::EXACT_TOLERANCE * self.in_force.millimetre
    }

    /// The tolerance of runs of short moves under G64 without P, machine units.
    fn default_tolerance(&self) -> f64 {
        self.in_force.default_tolerance.max(self.exact_tolerance())
    }

    /// How far the path may be from a move, but for corners that are cut by half of a leg.
    pub(super) fn greatest_deviation(&self, queued: &Move) -> Deviation {
        let exact = self.exact_tolerance();
        let tolerance = match queued.termination {
            TerminationCondition::Stop => 0.0,
            TerminationCondition::Exact => exact,
            TerminationCondition::Continuous { tolerance } if tolerance > 0.0 => {
                tolerance.min(self.greatest_tolerance()).max(exact)
            }
            TerminationCondition::Continuous { .. } => self.default_tolerance(),
        };
        let rotary = tolerance / self.weight;
        let turn_share = self.orientation().map_or(1.0, |orientation| {
            orientation.share(&queued.shape.position(0.0), &queued.shape.end())
        });
        Deviation {
            linear: tolerance,
            rotary,
            turn: rotary / turn_share,
        }
    }

    /// How the tool is kept to its tolerance, where the machine tells.
    fn orientation(&self) -> Option<Orientation> {
        let tilt = self
            .in_force
            .tilt
            .filter(|_| self.in_force.rotary_tolerance > 0.0)?;
        Some(Orientation {
            tilt,
            tolerance: self.in_force.rotary_tolerance,
        })
    }

    /// The settings of a path that begins with the first move of the queue. Finds the weight of
    /// rotary axes: linear and rotary axes use up their tolerances together. The weight belongs to the
    /// first P of the first 16 moves that have come so far, or to the tolerance for G64 without P where they
    /// have none; a P that comes later on the same path is held down so that rotary axes keep their
    /// tolerance.
    ///
    /// `None` where a limit is not positive, which [`Planner::set_limits`](super::Planner::set_limits)
    /// never takes over.
    pub(super) fn settings(
        &mut self,
        queue: &MoveQueue,
        limits: &AxisLimits,
    ) -> Option<BlendSettings> {
        self.take(queue);
        let settings = BlendSettings::new(
            self.in_force.millimetre,
            self.weight,
            self.in_force.default_tolerance,
            limits,
        )?;
        let settings = if self.in_force.corners_inside {
            settings.without_swings()
        } else {
            settings
        };
        let settings = if self.in_force.tilt.is_some() {
            settings.with_turning_tool()
        } else {
            settings
        };
        Some(match self.orientation() {
            Some(orientation) => settings.with_tilt(orientation.tilt, orientation.tolerance),
            None => settings,
        })
    }

    /// Whether something else is asked for than the path under way began with.
    pub(super) fn has_changed(&self) -> bool {
        self.asked != self.in_force
    }

    /// What is asked for holds on a path that begins with the first move of the queue. Finds its weight of rotary axes.
    pub(super) fn take(&mut self, queue: &MoveQueue) {
        self.in_force = self.asked;
        self.weight = self.in_force.millimetre;
        if self.in_force.rotary_tolerance > 0.0 {
            let first = queue.first_serial();
            let given = (first..first + MOVES)
                .filter_map(|serial| queue.get(serial))
                .find_map(|queued| match queued.termination {
                    TerminationCondition::Continuous { tolerance } if tolerance > 0.0 => {
                        Some(tolerance)
                    }
                    _ => None,
                });
            let tolerance = given.unwrap_or_else(|| self.default_tolerance());
            self.weight =
                (tolerance / self.in_force.rotary_tolerance).clamp(LEAST_WEIGHT, GREATEST_WEIGHT);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axes::Axes;

    static EMPTY: MoveQueue = MoveQueue::new();

    fn limits(jerk: f64) -> AxisLimits {
        AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(jerk),
        }
    }

    #[test]
    fn tolerances_that_are_taken_make_settings() {
        for (rotary, default) in [
            (0.0, 0.02),
            (0.5, 0.02),
            (f64::MIN_POSITIVE, 1e6),
            (1e6, 0.0),
        ] {
            let mut blending = Blending::DEFAULT;
            assert_eq!(blending.set(1.0, rotary, default), Ok(()));
            assert!(blending.settings(&EMPTY, &limits(2e4)).is_some());
            assert!(blending.greatest_tolerance() > 0.0);
        }
    }

    #[test]
    fn rotary_axes_keep_their_tolerance_also_where_a_default_is_less_than_what_exact_moves_are_left_by()
     {
        for (millimetre, default) in [(1.0, 0.0), (1.0, 1e-4), (1.0, 0.02), (1.0 / 25.4, 0.0)] {
            let mut blending = Blending::DEFAULT;
            assert_eq!(blending.set(millimetre, 0.05, default), Ok(()));
            blending.take(&EMPTY);
            for left_by in [default, BlendSettings::EXACT_TOLERANCE * millimetre] {
                let rotary = left_by / blending.weight;
                assert!(rotary <= 0.05 * (1.0 + 1e-12), "{default}: {rotary}");
            }
        }
    }

    #[test]
    fn what_makes_no_sense_is_refused_by_name() {
        let mut blending = Blending::DEFAULT;
        let mut set = |millimetre, rotary, default| blending.set(millimetre, rotary, default);
        for wrong in [-1.0, f64::NAN, f64::INFINITY, 1.1e6, f64::MAX] {
            assert_eq!(set(wrong, 0.0, 0.02), Err(BlendingError::Millimetre));
            assert_eq!(set(1.0, wrong, 0.02), Err(BlendingError::RotaryTolerance));
            assert_eq!(set(1.0, 0.0, wrong), Err(BlendingError::DefaultTolerance));
        }
        assert_eq!(set(9e-7, 0.0, 0.02), Err(BlendingError::Millimetre));
        assert_eq!(set(1e-6, 0.0, 0.0), Ok(()));
    }

    #[test]
    fn limits_that_are_not_positive_make_none() {
        let mut blending = Blending::DEFAULT;
        assert!(blending.settings(&EMPTY, &limits(0.0)).is_none());
    }
}
