//! One servo period of the reference, put together from stretches of moves.

use crate::axes::{Axes, MachineMap};
use crate::cycle::Cell;
use crate::moves::Move;
use crate::path::{PathPoint, Shape};
use crate::speed::ProfileState;

use super::piece::Piece;

/// A profile has seven phases at most, so a stretch is cut at most this often.
const MOST_PHASES: usize = 8;

/// A cell that is being filled.
#[derive(Debug)]
pub(super) struct CellBuilder {
    cell: Option<Cell>,
    filled: f64,
}

impl CellBuilder {
    pub const fn new() -> Self {
        Self {
            cell: None,
            filled: 0.0,
        }
    }

    pub fn clear(&mut self) {
        *self = Self::new();
    }

    /// Seconds of the cell that have been added.
    pub fn filled(&self) -> f64 {
        self.filled
    }

    /// Hands the cell out, `None` if nothing has been added, and begins the next one.
    pub fn take(&mut self) -> Option<Cell> {
        self.filled = 0.0;
        self.cell.take()
    }

    /// Adds the time from `from` to `to` of a piece of the move, as the axes of the machine see it.
    pub fn add(&mut self, queued: &Move, piece: &Piece, map: &MachineMap, from: f64, to: f64) {
        let mut start = from;
        for _ in 0..MOST_PHASES {
            let end = piece.profile.next_jump(start).min(to);
            self.add_phase(queued, piece, map, start, end);
            start = end;
            if start >= to {
                break;
            }
        }
        self.filled += to - from;
    }

    /// Adds a stretch without jumps of acceleration or jerk.
    fn add_phase(&mut self, queued: &Move, piece: &Piece, map: &MachineMap, from: f64, to: f64) {
        let middle = 0.5 * (from + to);
        let at = |t| Derivatives::at(&queued.shape, piece, t, middle).behind(map);
        let (first, second, third) = (at(from), at(middle), at(to));
        let cell = self.cell.get_or_insert(Cell {
            velocity: first.velocity,
            acceleration: first.acceleration,
            acceleration_min: first.acceleration,
            acceleration_max: first.acceleration,
            jerk_min: first.jerk,
            jerk_max: first.jerk,
            path_velocity: first.along.velocity,
            path_acceleration: first.along.acceleration,
            feed_ratio: 1.0,
            programmed_feed: queued.feed,
            rapid: queued.motion_type.is_rapid(),
            override_enabled: queued.override_enabled(),
        });
        // A parabola through three values exceeds its ends by no more than the middle value
        // exceeds their mean; a smooth curve over a small angle hardly differs from it.
        let bulge = |a: &Axes, b: &Axes, c: &Axes| (b - (a + c) * 0.5).abs();
        let acceleration = bulge(
            &first.acceleration,
            &second.acceleration,
            &third.acceleration,
        );
        let jerk = bulge(&first.jerk, &second.jerk, &third.jerk);
        for end in [&first, &third] {
            widen(cell, &end.acceleration, &acceleration, &end.jerk, &jerk);
        }
    }
}

/// Makes the bounds of a cell hold for two values, each give or take its margin.
fn widen(
    cell: &mut Cell,
    acceleration: &Axes,
    acceleration_margin: &Axes,
    jerk: &Axes,
    jerk_margin: &Axes,
) {
    cell.acceleration_min = cell
        .acceleration_min
        .inf(&(acceleration - acceleration_margin));
    cell.acceleration_max = cell
        .acceleration_max
        .sup(&(acceleration + acceleration_margin));
    cell.jerk_min = cell.jerk_min.inf(&(jerk - jerk_margin));
    cell.jerk_max = cell.jerk_max.sup(&(jerk + jerk_margin));
}

/// Derivatives of a reference by its time.
struct Derivatives {
    velocity: Axes,
    acceleration: Axes,
    jerk: Axes,
    along: ProfileState,
}

impl Derivatives {
    /// At time `t` of a piece, in the phase at `within`.
    fn at(shape: &Shape, piece: &Piece, t: f64, within: f64) -> Self {
        let along = piece.profile.state(t, within);
        let PathPoint {
            first,
            second,
            third,
            ..
        } = shape.point(piece.start + along.distance);
        let (v, a, j) = (along.velocity, along.acceleration, along.jerk);
        Self {
            velocity: first * v,
            acceleration: first * a + second * (v * v),
            jerk: first * j + second * (3.0 * v * a) + third * (v * v * v),
            along,
        }
    }

    /// The same for the axes of the machine.
    fn behind(self, map: &MachineMap) -> Self {
        Self {
            velocity: map.apply(&self.velocity),
            acceleration: map.apply(&self.acceleration),
            jerk: map.apply(&self.jerk),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use proptest::prelude::*;

    use super::*;
    use crate::moves::{MotionType, StateTag, SynchronisedOutputs, TerminationCondition};
    use crate::path::{Arc9, Circle};
    use crate::speed::{JerkLimitedProfile, PathLimits};

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// The executor trusts the bounds: nothing inside a cell may be beyond them.
        #[test]
        fn bounds_hold_everywhere_in_the_cell(
            (radius, feed) in ((-4.0..4.0f64).prop_map(f64::exp), (0.0..5.0f64).prop_map(f64::exp)),
            (from, share, inside) in (0.0..1.0f64, 0.0..1.0f64, 0.0..=1.0f64),
        ) {
            let mut start = Axes::zeros();
            start[0] = radius;
            let mut end = start;
            end[5] = 7.0;
            let circle = Circle { center: Vector3::zeros(), normal: Vector3::new(0.1, 0.2, 1.0), turn: 1 };
            let queued = Move {
                id: 1,
                tag: StateTag::EMPTY,
                motion_type: MotionType::Arc,
                shape: Shape::Arc(Arc9::new(&start, &end, &circle).expect("an arc")),
                feed,
                max_velocity: 1e3,
                enables: 0,
                wait_for_spindle: false,
                termination: TerminationCondition::Stop,
                outputs: SynchronisedOutputs::NONE,
            };
            // What one axis with 1000 mm/s2 and 20000 mm/s3 allows on this circle.
            let velocity = feed.min((500.0 * radius).sqrt()).min((10_000.0 * radius * radius).cbrt());
            let limits = PathLimits { velocity, acceleration: 500.0, jerk: 10_000.0 };
            let profile = JerkLimitedProfile::rest_to_rest(queued.shape.length(), &limits);
            let duration = profile.duration();
            let piece = Piece { serial: 0, start: 0.0, profile, duration, cap: feed };
            let begin = from * duration;
            let finish = (begin + 1e-3 * share.max(0.01)).min(duration);
            let mut builder = CellBuilder::new();
            builder.add(&queued, &piece, &MachineMap::IDENTITY, begin, finish);
            prop_assert!((builder.filled() - (finish - begin)).abs() < 1e-15);
            let cell = builder.take().expect("a cell");
            let t = begin + inside * (finish - begin);
            let here = Derivatives::at(&queued.shape, &piece, t, t);
            for axis in 0..9 {
                // A parabola stands for the curve: a thousandth of the limits is left to it.
                let (a, j) = (here.acceleration[axis], here.jerk[axis]);
                prop_assert!(a >= cell.acceleration_min[axis] - 1.0 && a <= cell.acceleration_max[axis] + 1.0);
                prop_assert!(j >= cell.jerk_min[axis] - 20.0 && j <= cell.jerk_max[axis] + 20.0);
            }
        }
    }
}
