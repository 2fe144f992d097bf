//! Where nothing more can be handed out although the machine moves: on along the path at the speed it has,
//! for as long as it takes to come to rest.

use crate::axes::Axes;
use crate::moves::shape::PathPoint;
use crate::path::BlendedPath;
use crate::speed::ProfileState;

/// On along the path at a speed that stays as it is once the acceleration has been released.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coast {
    pub start: ProfileState,
    /// Seconds until the acceleration is 0.
    pub release: f64,
    /// Where the path may still change or ends: from there on straight ahead.
    pub end: f64,
    pub backwards: bool,
}

impl Coast {
    /// Distance and its derivatives at time `t`, before or behind the release as `within` is.
    pub fn state(&self, t: f64, within: f64) -> ProfileState {
        let ProfileState {
            distance,
            velocity,
            acceleration,
            ..
        } = self.start;
        let jerk = -acceleration / self.release;
        let ramp = |t: f64| ProfileState {
            distance: distance + t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0)),
            velocity: (velocity + t * (acceleration + t * jerk / 2.0)).max(0.0),
            acceleration: acceleration + t * jerk,
            jerk,
        };
        if within < self.release {
            return ramp(t);
        }
        let released = ramp(self.release);
        ProfileState {
            distance: released.distance + (t - self.release) * released.velocity,
            velocity: released.velocity,
            acceleration: 0.0,
            jerk: 0.0,
        }
    }

    /// When the acceleration is released, if that is after `t`; else infinite.
    pub fn next_jump(&self, t: f64) -> f64 {
        if t < self.release {
            self.release
        } else {
            f64::INFINITY
        }
    }

    /// The path at a distance, straight on behind its end.
    pub fn point(&self, path: &BlendedPath, distance: f64) -> PathPoint {
        let at = |distance: f64| {
            if self.backwards {
                path.point_before(-distance).backwards()
            } else {
                path.point(distance)
            }
        };
        if distance < self.end {
            return at(distance);
        }
        let end = if self.backwards {
            path.point(-self.end).backwards()
        } else {
            path.point_before(self.end)
        };
        PathPoint {
            position: end.position + end.first * (distance - self.end),
            first: end.first,
            second: Axes::zeros(),
            third: Axes::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::{Coast, ProfileState};
    use crate::axes::{Axes, AxisLimits};
    use crate::cycle::JERK_KEPT;
    use crate::machine_map::{JointJet, JointMap};
    use crate::moves::shape::Circle;
    use crate::moves::{MotionType, StateTag, TerminationCondition};
    use crate::planner::reference::Reference;
    use crate::planner::status::Fault;
    use crate::planner::{CycleInputs, MoveRequest, Planner};
    use crate::test_room::with_room;

    const PERIOD: f64 = 1e-3;

    #[test]
    fn the_only_jump_is_where_the_acceleration_is_released() {
        let coast = Coast {
            start: ProfileState {
                velocity: 10.0,
                acceleration: 100.0,
                distance: 0.0,
                jerk: 0.0,
            },
            release: 0.02,
            end: f64::INFINITY,
            backwards: false,
        };
        assert_eq!(coast.next_jump(0.0), coast.release);
        assert_eq!(coast.next_jump(coast.release), f64::INFINITY);
        let [before, behind] =
            [0.0, coast.release].map(|within| coast.state(coast.release, within));
        assert!((before.velocity - 11.0).abs() < 1e-12 && before.acceleration.abs() < 1e-12);
        assert_eq!(
            (before.distance, before.velocity),
            (behind.distance, behind.velocity)
        );
        assert_eq!((before.jerk, behind.jerk), (-5000.0, 0.0));
    }

    /// What goes wrong.
    type Spoil = fn(&mut Reference);

    /// Nothing more is handed out.
    const DRY: Spoil = |reference| reference.dry = true;
    /// What is handed out is refused.
    const REFUSED: Spoil = |reference| reference.spoiled = true;

    /// Queues a line, an arc and a line.
    fn queue(planner: &mut Planner) {
        let request = MoveRequest {
            motion_type: MotionType::Feed,
            feed: 80.0,
            max_velocity: 1e3,
            path_jerk: f64::INFINITY,
            enables: 0x0f,
            wait_for_spindle: false,
            indexer_joint: None,
            tag: StateTag::EMPTY,
        };
        let half = Circle {
            center: Vector3::new(20.0, 10.0, 0.0),
            normal: Vector3::z(),
            revolutions: 0,
        };
        let turned = Axes::x() * 20.0 + Axes::y() * 20.0;
        planner
            .add_line(&(Axes::x() * 20.0), &request)
            .expect("a line");
        planner
            .add_circle(&turned, &half, &request)
            .expect("an arc");
        planner
            .add_line(&(Axes::y() * 20.0), &request)
            .expect("a line");
    }

    /// A joint that bends with Y: X + Y^2 / 200.
    const BENT: JointJet = |q, [d, a, j], _| {
        let mut joints = [*d, *a, *j];
        joints[0][0] += q[1] * d[1] / 100.0;
        joints[1][0] += (d[1] * d[1] + q[1] * a[1]) / 100.0;
        joints[2][0] += (3.0 * d[1] * a[1] + q[1] * j[1]) / 100.0;
        joints
    };

    /// Lets something go wrong in the given servo period of a line, an arc and a line, with limits of the axes or of
    /// [`BENT`] joints. How far from the circle and its tangents the machine comes to rest.
    fn stop_for(fault: Fault, spoil: Spoil, jerk: f64, period: usize, bent: bool) -> f64 {
        let mut planner = Planner::new();
        assert!(planner.set_cycle_time(PERIOD));
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(jerk),
        };
        planner.set_limits(&limits);
        assert!(planner.set_joints(bent.then(|| JointMap::new(BENT, &limits, 0.0))));
        planner.set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
        queue(&mut planner);
        let mut positions = vec![Axes::zeros(); 4];
        for cycle in 0.. {
            assert!(cycle < 5000, "never at rest: {:?}", planner.status());
            if cycle == period {
                spoil(&mut planner.reference);
            }
            let status = planner.cycle(&CycleInputs::default());
            positions.push(status.position);
            if status.done {
                break;
            }
        }
        assert_eq!(planner.status().fault, Some(fault));
        let rest = planner.status().position;
        positions.extend([rest; 4]);
        for position in positions.iter_mut().filter(|_| bent) {
            position[0] += position[1] * position[1] / 200.0;
        }
        // That of F, or of the joints.
        keep_the_limits(&positions, if bent { 100.0 } else { 80.0 }, jerk);
        let [x, y] = [rest[0] - 20.0, rest[1] - 10.0];
        if x <= 0.0 {
            (y.abs() - 10.0).abs()
        } else {
            (x.hypot(y) - 10.0).abs()
        }
    }

    /// The velocity is at most `greatest`, the acceleration the limit, and the jerk what is promised.
    fn keep_the_limits(positions: &[Axes], greatest: f64, jerk: f64) {
        for window in positions.windows(4) {
            let velocity = (window[3] - window[2]).amax() / PERIOD;
            let acceleration = (window[3] - window[2] * 2.0 + window[1]).amax() / PERIOD.powi(2);
            let third = window[3] - window[2] * 3.0 + window[1] * 3.0 - window[0];
            let third = third.amax() / PERIOD.powi(3);
            assert!(
                velocity <= 1.001 * greatest && acceleration <= 1001.0,
                "{velocity} {acceleration}"
            );
            assert!(third <= JERK_KEPT * jerk, "{third}");
        }
    }

    fn brakes_on_its_path(fault: Fault, spoil: Spoil, bent: bool) {
        for jerk in [2e4, 1e5, f64::INFINITY] {
            with_room(move || {
                for period in (20..620).step_by(20) {
                    let away = stop_for(fault, spoil, jerk, period, bent);
                    assert!(away < 0.05, "{away} at {period}, jerk {jerk}");
                }
            });
        }
    }

    #[test]
    fn a_machine_that_is_starved_brakes_on_its_path() {
        brakes_on_its_path(Fault::Starved, DRY, false);
    }

    /// It goes on from the last period that was good.
    #[test]
    fn a_machine_whose_next_period_is_refused_brakes_on_its_path() {
        brakes_on_its_path(Fault::CellRefused, REFUSED, false);
    }

    #[test]
    fn joints_that_bend_are_braked_within_their_limits() {
        brakes_on_its_path(Fault::Starved, DRY, true);
        brakes_on_its_path(Fault::CellRefused, REFUSED, true);
    }

    #[test]
    fn a_first_period_that_is_refused_moves_nothing() {
        with_room(|| {
            let away = stop_for(Fault::CellRefused, REFUSED, 2e4, 0, false);
            // At the start of the line to the circle.
            assert_eq!(away, 0.0);
        });
    }
}
