//! The last resort where no plan was found: a stretch of the path from rest to rest, by one profile.
//!
//! It exists by construction: between two places where the shape of the path changes its derivatives are
//! bounded, and a speed, an acceleration and a jerk along it that are small enough keep the limits of all
//! axes together.

use super::outlook::Outlook;
use super::reference_segment::ProfiledMotion;
use crate::speed::look_ahead::Route;
use crate::speed::{DerivativeBounds, JerkLimitedProfile, PathLimits};

/// Places of a stretch that are looked at.
const PLACES: u32 = 48;

/// How many vertices on each side are looked at for the end of a stretch.
const NEIGHBOURS: usize = 16;

/// Changes of shape nearer than this are no end of a stretch, share of the path distance.
const NEAREST: f64 = 1e-9;

/// The profile of a stretch of the route from `start` on; `None` if nothing of it is known for good, or
/// the path is not a number.
pub(super) fn motion<R: Route>(route: &R, start: f64, outlook: &Outlook) -> Option<ProfiledMotion> {
    let end = stretch_end(route, start);
    let length = end - start;
    if length.is_nan() || length <= 0.0 {
        return None;
    }
    let limits = path_limits(route, start, end, outlook);
    let profile = JerkLimitedProfile::rest_to_rest(length, &limits);
    let sound = profile.duration() > 0.0 && profile.duration().is_finite();
    sound.then_some(ProfiledMotion {
        serial: 0,
        start,
        end,
        rate: 1.0,
        profile,
        cap: limits.velocity,
    })
}

/// The next place behind `start` where a change of shape begins or ends, or the end of what is known.
fn stretch_end<R: Route>(route: &R, start: f64) -> f64 {
    let nearest = start + NEAREST * (1.0 + start.abs());
    let mut end = route.known_end();
    let (mut before, mut behind) = (nearest, nearest);
    for _ in 0..NEIGHBOURS {
        let vertices = [route.vertex_before(before), route.vertex_after(behind)];
        for vertex in vertices.into_iter().flatten() {
            let (place, reach) = (vertex.position, vertex.reach.max(vertex.core));
            for edge in [place - reach, place, place + reach] {
                if edge > nearest && edge < end {
                    end = edge;
                }
            }
            before = before.min(place);
            behind = behind.max(place);
        }
    }
    end
}

/// What is possible all along a stretch, all of it at the same time.
fn path_limits<R: Route>(route: &R, start: f64, end: f64, outlook: &Outlook) -> PathLimits {
    let mut velocity = f64::INFINITY;
    let (mut axes, mut behind) = (DerivativeBounds::none(), DerivativeBounds::none());
    for place in 0..=PLACES {
        let s = start + (end - start) * f64::from(place) / f64::from(PLACES);
        let point = route.point(s);
        velocity = velocity.min(route.speed_cap(s, &point.first).programmed);
        let derivatives = [&point.first, &point.second, &point.third];
        behind.include(&outlook.map.derivatives(&point.position, derivatives));
        if outlook.map.joints().is_some() {
            axes.include(&derivatives.map(|of| outlook.map.apply(of)));
        }
    }
    let velocity = velocity.min(axes.velocity(&outlook.limits.velocity));
    behind.path_limits(&outlook.limits_behind(), velocity)
}

#[cfg(test)]
mod tests {
    use crate::axes::{Axes, AxisLimits};
    use crate::cycle::JERK_KEPT;
    use crate::moves::{MotionType, StateTag, TerminationCondition};
    use crate::planner::{CycleInputs, MoveRequest, Planner};
    use crate::test_room::with_room;

    const PERIOD: f64 = 1e-3;

    fn request(feed: f64) -> MoveRequest {
        MoveRequest {
            motion_type: MotionType::Feed,
            feed,
            max_velocity: 1e3,
            path_jerk: f64::INFINITY,
            enables: 0x0f,
            wait_for_spindle: false,
            indexer_joint: None,
            tag: StateTag::EMPTY,
        }
    }

    fn equal_limits(jerk: f64) -> AxisLimits {
        AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(jerk),
        }
    }

    const CORNERS: [(f64, f64, f64); 4] = [
        (3.0, 0.0, 50.0),
        (3.0, 2.0, 20.0),
        (0.0, 0.1, 90.0),
        (1.0, 0.0, 1.0),
    ];

    /// Runs lines with blends, X, Y and feed, to their end, within all limits, while each plan of the look-ahead is
    /// refused in so many of the first servo periods. The servo periods that it takes.
    fn run(limits: &AxisLimits, corners: &[(f64, f64, f64)], refused: usize) -> usize {
        let mut planner = Planner::new();
        assert!(planner.set_cycle_time(PERIOD));
        planner.set_limits(limits);
        planner.set_termination(TerminationCondition::Continuous { tolerance: 0.1 });
        let mut end = Axes::zeros();
        for (x, y, feed) in corners {
            end = Axes::x() * *x + Axes::y() * *y;
            planner.add_line(&end, &request(*feed)).expect("a line");
        }
        let mut positions = vec![Axes::zeros(); 4];
        while !planner.status().done {
            assert!(positions.len() < 20_000, "not done: {:?}", planner.status());
            if positions.len() < refused {
                planner.reference.refuse_all();
            }
            let status = planner.cycle(&CycleInputs::default());
            assert_eq!(status.fault, None);
            positions.push(status.position);
        }
        let cycles = positions.len();
        assert_eq!(planner.status().position, end);
        positions.extend([end; 4]);
        for window in positions.windows(4) {
            let first = (window[3] - window[2]) / PERIOD;
            let second = (window[3] - window[2] * 2.0 + window[1]) / PERIOD.powi(2);
            let third =
                (window[3] - window[2] * 3.0 + window[1] * 3.0 - window[0]) / PERIOD.powi(3);
            let over = |value: &Axes, limit: &Axes| value.component_div(limit).amax();
            assert!(over(&first, &limits.velocity) <= 1.0001, "{refused}");
            assert!(over(&second, &limits.acceleration) <= 1.0001, "{refused}");
            assert!(over(&third, &limits.jerk) <= JERK_KEPT, "{refused}");
        }
        cycles
    }

    #[test]
    fn what_is_refused_is_crept_along() {
        for jerk in [2e4, f64::INFINITY] {
            with_room(move || {
                let limits = equal_limits(jerk);
                let planned = run(&limits, &CORNERS, 0);
                let crept = run(&limits, &CORNERS, usize::MAX);
                assert!(planned < crept && crept < 10 * planned, "{planned} {crept}");
            });
        }
    }

    /// The machine rests anywhere then, also in the middle of a corner, the more so where one axis is soft.
    #[test]
    fn where_it_crept_to_a_plan_may_begin() {
        let short = [(2e-4, -3e-4, 1.0), (-0.2, -3e-4, 1.0)];
        let mut soft = equal_limits(2e4);
        soft.acceleration[1] = 10.0;
        soft.jerk[1] = 50.0;
        for (limits, corners) in [(equal_limits(2e4), &CORNERS[..]), (soft, &short[..])] {
            let corners = corners.to_vec();
            with_room(move || {
                let crept = run(&limits, &corners, usize::MAX);
                for refused in (0..crept).step_by(crept / 60) {
                    run(&limits, &corners, refused);
                }
            });
        }
    }
}
