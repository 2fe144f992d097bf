//! Moves wait until it is known that the joints stay within their soft limits on the way.

use crate::common::{
    Machine, PERIOD, at, equal_limits, feed_move, joints_at, with_machine, with_room,
};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::machine::JOINT_COUNT;
use framepath::moves::TerminationCondition;
use framepath::moves::shape::Circle;
use framepath::planner::range::{Finding, JointRange, JointSolver, Joints};
use framepath::planner::{AddError, Status};
use nalgebra::Vector3;

/// A machine whose joints are its axes, with what it was asked.
struct Solver {
    calls_a_cycle: usize,
    keeps_lines: bool,
    calls: usize,
    begun: Vec<(Axes, Joints)>,
    furthest: f64,
}

impl Solver {
    fn new(calls_a_cycle: usize) -> Self {
        Self {
            calls_a_cycle,
            keeps_lines: false,
            calls: 0,
            begun: Vec::new(),
            furthest: f64::NEG_INFINITY,
        }
    }
}

impl JointSolver for Solver {
    fn begin(&mut self, position: &Axes, joints: &Joints) {
        self.begun.push((*position, *joints));
    }

    fn solve(&mut self, position: &Axes, _near: &Joints) -> Option<Joints> {
        self.calls += 1;
        self.furthest = self.furthest.max(position[0]);
        Some(joints_at(position))
    }

    fn calls_a_cycle(&self) -> usize {
        self.calls_a_cycle
    }

    fn keeps_lines(&self) -> bool {
        self.keeps_lines
    }
}

fn range(reach: f64) -> JointRange {
    JointRange {
        least: [-reach; JOINT_COUNT],
        greatest: [reach; JOINT_COUNT],
        count: 3,
        ..JointRange::NONE
    }
}

/// One cycle with a look along the moves before it.
fn cycle(
    machine: &mut Machine,
    range: &JointRange,
    solver: &mut Solver,
) -> (Status, Option<Finding>) {
    let joints = joints_at(&machine.planner.status().position);
    let finding = machine.planner.check_range(range, &joints, solver);
    (machine.cycle(), finding)
}

/// Half a circle above the way from where the last move ends to `x`.
fn half_circle(machine: &mut Machine, x: f64) {
    let start = machine.planner.goal()[0];
    let circle = Circle {
        center: Vector3::new(0.5 * (start + x), 0.0, 0.0),
        normal: Vector3::z(),
        revolutions: -1,
    };
    machine
        .circle(at(x, 0.0), &circle, &feed_move(50.0))
        .expect("an arc");
}

#[test]
fn a_move_waits_until_all_of_it_has_been_looked_at() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        half_circle(machine, 40.0);
        let mut solver = Solver::new(1);
        let mut waited = 0;
        let status = loop {
            let (status, finding) = cycle(machine, &range(100.0), &mut solver);
            assert!(finding.is_none());
            if status.position != Axes::zeros() {
                break status;
            }
            waited += 1;
            assert!(waited < 100 && !status.done, "{status:?}");
        };
        assert!(status.active_depth == 1);
        assert_eq!(solver.furthest, 40.0);
        assert!(waited + 1 >= solver.calls && solver.calls >= 9);
        // Nothing more is asked, and the move runs to its end.
        let asked = solver.calls;
        while !cycle(machine, &range(100.0), &mut solver).0.done {}
        assert_eq!(solver.calls, asked);
        assert_eq!(machine.planner.status().position, at(40.0, 0.0));
    });
}

#[test]
fn a_first_move_that_leaves_is_refused_before_anything_moves() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        machine.planner.set_id(7);
        half_circle(machine, 40.0);
        let mut solver = Solver::new(2);
        let finding = loop {
            let (status, finding) = cycle(machine, &range(19.0), &mut solver);
            assert_eq!(status.position, Axes::zeros());
            if let Some(finding) = finding {
                break finding;
            }
            assert!(solver.calls < 1000);
        };
        let Finding::Leaves { found, id } = finding else {
            panic!("{finding:?}");
        };
        // X goes to 40 in the end, but Y comes to 20 first
        assert_eq!((id, found.limit), (7, 19.0));
        assert!(found.joint < 2 && found.position > 19.0, "{found:?}");
        // What comes behind is not taken before an abort.
        let (status, finding) = cycle(machine, &range(19.0), &mut solver);
        assert!(status.done && finding.is_none());
        let more = machine.line(at(1.0, 0.0), &feed_move(50.0));
        assert_eq!(more, Err(AddError::Tripped));
        machine.planner.abort();
        cycle(machine, &range(19.0), &mut solver);
        machine
            .line(at(1.0, 0.0), &feed_move(50.0))
            .expect("a move after the abort");
        while !cycle(machine, &range(19.0), &mut solver).0.done {}
        assert_eq!(machine.planner.status().position, at(1.0, 0.0));
    });
}

#[test]
fn a_later_move_that_leaves_stops_the_machine_before_it() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.5 });
        for k in 1..=5 {
            machine
                .line(at(3.0 * f64::from(k), 0.0), &feed_move(90.0))
                .expect("a line");
        }
        half_circle(machine, 75.0);
        let mut narrow = range(100.0);
        narrow.greatest[1] = 29.9;
        // so slow that the machine runs meanwhile
        let mut solver = Solver::new(1);
        let mut found = None;
        for _ in 0..1000 {
            let (status, finding) = cycle(machine, &narrow, &mut solver);
            assert!(status.position[1].abs() < 1e-12, "{}", status.position[1]);
            assert!(status.position[0] <= 15.0 + 1e-12);
            found = found.or(finding);
            if found.is_some() && status.done {
                break;
            }
        }
        let Some(Finding::Leaves { found, .. }) = found else {
            panic!("{found:?}");
        };
        assert_eq!((found.joint, found.limit), (1, 29.9));
        assert!((found.position - 30.0).abs() < 1e-6, "{found:?}");
        assert!(machine.planner.status().position[0] > 0.0);
        let extremes = machine.extremes();
        assert!(extremes.velocity <= 1.001 && extremes.acceleration <= 1.001);
        assert!(extremes.jerk <= JERK_KEPT, "{extremes:?}");
    });
}

/// Short moves, one in each period, run as they do without a look.
#[test]
fn dense_moves_do_not_wait() {
    let trace = |looks: bool| {
        let mut machine = Machine::new(equal_limits(20_000.0));
        machine.planner.wait_for_range_check(looks);
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance: 0.01 });
        let mut solver = Solver::new(16);
        let mut position = Axes::zeros();
        for k in 0..3000 {
            if k < 600 {
                let angle = f64::from(k) * 0.01;
                position += Axes::from([
                    0.05 * angle.cos(),
                    0.05 * angle.sin(),
                    0.0,
                    0.02,
                    0.0,
                    0.05,
                    0.0,
                    0.0,
                    0.0,
                ]);
                machine.line(position, &feed_move(50.0)).expect("a line");
            }
            if looks {
                assert!(cycle(&mut machine, &range(200.0), &mut solver).1.is_none());
            } else {
                machine.cycle();
            }
            if machine.planner.status().done {
                break;
            }
        }
        assert!(machine.planner.status().done);
        // Beside the program ten times for each 2 mm.
        let most = 5 + 4 * 600 + 10 * 16;
        assert!(!looks || solver.calls <= most, "{}", solver.calls);
        machine.positions
    };
    with_room(|| assert_eq!(trace(true), trace(false)));
}

/// After an abort the look begins anew, with the joints where the machine has come to rest.
#[test]
fn an_abort_is_a_new_beginning() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let mut solver = Solver::new(16);
        for k in 1..=20 {
            machine
                .line(at(3.0 * f64::from(k), 0.0), &feed_move(90.0))
                .expect("a line");
        }
        for _ in 0..200 {
            cycle(machine, &range(100.0), &mut solver);
        }
        machine.planner.abort();
        while !cycle(machine, &range(100.0), &mut solver).0.done {}
        let rest = machine.planner.status().position;
        assert!(rest[0] > 1.0 && rest[0] < 50.0);
        assert_eq!(solver.begun, [(Axes::zeros(), [0.0; JOINT_COUNT])]);
        machine
            .line(at(0.0, 0.0), &feed_move(90.0))
            .expect("a line");
        while !cycle(machine, &range(100.0), &mut solver).0.done {}
        assert_eq!(solver.begun[1..], [(rest, joints_at(&rest))]);
        assert_eq!(machine.planner.status().position, Axes::zeros());
    });
}

/// Limits that become narrower hold for what has been looked at before.
#[test]
fn limits_that_change_are_looked_at_again() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let mut solver = Solver::new(16);
        for k in 1..=20 {
            machine
                .line(at(3.0 * f64::from(k), 0.0), &feed_move(60.0))
                .expect("a line");
        }
        for _ in 0..300 {
            assert!(cycle(machine, &range(100.0), &mut solver).1.is_none());
        }
        assert!(machine.planner.status().position[0] < 20.0);
        let mut finding = None;
        for _ in 0..1000 {
            let (status, now) = cycle(machine, &range(50.0), &mut solver);
            finding = finding.or(now);
            if status.done {
                break;
            }
        }
        let Some(Finding::Leaves { found, .. }) = finding else {
            panic!("{finding:?}");
        };
        assert_eq!((found.joint, found.position, found.limit), (0, 51.0, 50.0));
        assert!(machine.planner.status().position[0] < 50.0);
    });
}

/// Back and forward again over what has been looked at, and on over what comes then.
#[test]
fn a_reverse_run_goes_over_what_has_been_looked_at() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let mut solver = Solver::new(16);
        for k in 1..=6 {
            machine
                .line(at(3.0 * f64::from(k), 0.0), &feed_move(60.0))
                .expect("a line");
        }
        while machine.planner.status().position[0] < 10.0 {
            cycle(machine, &range(100.0), &mut solver);
        }
        let turn = |machine: &mut Machine, backwards: bool| {
            for _ in 0..1000 {
                if machine.planner.run_backwards(backwards).is_ok() {
                    return;
                }
                machine.scaled_cycle(0.0);
            }
            panic!("does not turn");
        };
        turn(machine, true);
        for _ in 0..3000 {
            cycle(machine, &range(100.0), &mut solver);
        }
        assert_eq!(machine.planner.status().position, Axes::zeros());
        let asked = solver.calls;
        turn(machine, false);
        half_circle(machine, 38.0);
        while !cycle(machine, &range(100.0), &mut solver).0.done {}
        assert_eq!(machine.planner.status().position, at(38.0, 0.0));
        assert!(solver.calls > asked && solver.begun.len() == 1);
    });
}

#[test]
fn lines_of_a_machine_that_keeps_them_are_not_looked_into() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let mut solver = Solver::new(16);
        solver.keeps_lines = true;
        machine
            .line(at(30.0, 0.0), &feed_move(60.0))
            .expect("a line");
        while !cycle(machine, &range(10.0), &mut solver).0.done {}
        assert_eq!(solver.calls, 0);
        assert_eq!(machine.planner.status().position, at(30.0, 0.0));
        half_circle(machine, 60.0);
        let found = (0..100).find_map(|_| cycle(machine, &range(14.0), &mut solver).1);
        assert!(matches!(found, Some(Finding::Leaves { .. })), "{found:?}");
    });
}

/// How far a corner leads beyond X 10, its place, and the corner behind it beyond Y 5.
fn beyond(range: &JointRange) -> [f64; 2] {
    let mut greatest = [0.0f64; 2];
    let mut solver = Solver::new(16);
    solver.keeps_lines = true;
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let tolerance = TerminationCondition::Continuous { tolerance: 0.05 };
        machine.planner.set_termination(tolerance);
        for end in [at(10.0, 0.0), at(10.0, 5.0), at(0.0, 5.0)] {
            machine.line(end, &feed_move(60.0)).expect("a line");
        }
        loop {
            let (status, finding) = cycle(machine, range, &mut solver);
            assert!(finding.is_none(), "{finding:?}");
            greatest[0] = greatest[0].max(status.position[0] - 10.0);
            greatest[1] = greatest[1].max(status.position[1] - 5.0);
            if status.done {
                break;
            }
        }
    });
    greatest
}

#[test]
fn a_corner_at_a_limit_does_not_swing_out_beyond_it() {
    let apart = |x: f64, y: f64| {
        let mut range = range(100.0);
        (range.greatest[0], range.greatest[1]) = (x, y);
        beyond(&range)
    };
    let [x, y] = apart(100.0, 100.0);
    assert!(
        (0.02..0.05).contains(&x) && (0.02..0.05).contains(&y),
        "{x} {y}"
    );
    // Both corners lie on X 10, one of them on Y 5.
    let [x, y] = apart(10.0, 100.0);
    assert!(x <= 0.0 && y <= 0.0, "{x} {y}");
    let [x, y] = apart(100.0, 5.0);
    assert!((0.02..0.05).contains(&x) && y <= 0.0, "{x} {y}");
    // The tolerance fits in between.
    let [x, y] = apart(10.3, 5.3);
    assert!(x > 0.02 && y > 0.02, "{x} {y}");
}

#[test]
fn a_corner_does_not_swing_out_over_the_next_one_to_a_limit() {
    let mut greatest = 0.0f64;
    let mut solver = Solver::new(16);
    solver.keeps_lines = true;
    let mut range = range(100.0);
    range.greatest[0] = 7.0;
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let tolerance = TerminationCondition::Continuous { tolerance: 0.01 };
        machine.planner.set_termination(tolerance);
        for end in [at(6.0, 0.0), at(6.0, 4.0), at(7.0, 5.0), at(7.0, 15.0)] {
            machine.line(end, &feed_move(60.0)).expect("a line");
        }
        loop {
            let (status, _) = cycle(machine, &range, &mut solver);
            greatest = greatest.max(status.position[0] - 7.0);
            if status.done {
                break;
            }
        }
    });
    assert!(greatest <= 1e-12, "{greatest}");
}

/// The machine stands still for as long as the look takes, and not longer.
#[test]
fn the_first_period_of_a_short_look_is_the_first_of_the_move() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        let mut solver = Solver::new(16);
        machine
            .line(at(30.0, 0.0), &feed_move(60.0))
            .expect("a line");
        let (status, _) = cycle(machine, &range(100.0), &mut solver);
        assert!(status.position[0] > 0.0, "{}", status.position[0]);
        let first = 20_000.0 / 6.0 * PERIOD.powi(3);
        assert!(status.position[0] <= 1.01 * first);
    });
}

/// Where the machine stands beyond a limit, the limit itself is named and not the place.
#[test]
fn the_limit_is_named_also_where_the_move_begins_beyond_it() {
    with_machine(|machine| {
        machine.planner.wait_for_range_check(true);
        machine
            .planner
            .set_position(&at(12.0, 0.0))
            .expect("finite");
        machine
            .line(at(13.0, 0.0), &feed_move(60.0))
            .expect("a line");
        let mut solver = Solver::new(16);
        let (_, finding) = cycle(machine, &range(10.0), &mut solver);
        let Some(Finding::Leaves { found, .. }) = finding else {
            panic!("{finding:?}");
        };
        assert_eq!((found.joint, found.position, found.limit), (0, 13.0, 10.0));
    });
}
