//! What ran before has no influence on a program, to the last digit.

use crate::common::{Machine, equal_limits, feed_move, with_room};
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;

const JERK: f64 = 20_000.0;

/// `count` places on a curve in space from the origin on, .2 mm apart.
fn curve(count: u32) -> Vec<Axes> {
    (1..=count)
        .map(|n| {
            let way = 0.2 * f64::from(n);
            Axes::from([
                20.0 * (way / 20.0).sin(),
                12.0 * (1.0 - (way / 9.0).cos()),
                2.0 * (way / 5.0).sin(),
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ])
        })
        .collect()
}

/// `count` corners, then back to the origin. `axes` of them move, 2 to 9.
fn corners(count: u32, axes: usize) -> Vec<Axes> {
    let mut points: Vec<Axes> = (1..=count)
        .map(|n| {
            Axes::from_fn(|axis, _| match axis {
                0 => 0.5 * f64::from(n),
                _ if axis < axes => f64::from(n % 2),
                _ => 0.0,
            })
        })
        .collect();
    points.push(Axes::zeros());
    points
}

/// Runs programs one after the other, one move in each cycle: the positions of the last one. It comes to
/// rest at these of its places, counted from 0.
fn run(programs: &[&[Axes]], stops: &[usize]) -> Vec<Axes> {
    with_room(|| {
        let mut machine = Machine::new(equal_limits(JERK));
        let mut from = 0;
        for (left, program) in (0..programs.len()).rev().zip(programs) {
            from = machine.positions.len();
            for (number, point) in program.iter().enumerate() {
                machine
                    .planner
                    .set_termination(if left == 0 && stops.contains(&number) {
                        TerminationCondition::Stop
                    } else {
                        TerminationCondition::Continuous { tolerance: 0.01 }
                    });
                machine.line(*point, &feed_move(60.0)).expect("a line");
                machine.cycle();
            }
            machine.run(100_000);
        }
        machine.positions.split_off(from)
    })
}

/// Whether a program runs as it does alone, to the last digit, after others.
fn runs_as_alone(program: &[Axes], stops: &[usize]) {
    let alone = run(&[program], stops);
    // Short ones, of even and odd numbers of periods, and one that goes round the rings in which
    // everything is kept.
    for (count, axes) in [(1, 2), (2, 2), (3, 2), (20, 9), (300, 3)] {
        let after = run(&[&corners(count, axes), program], stops);
        let differs = alone.iter().zip(&after).position(|(a, b)| a != b);
        assert_eq!(differs, None, "after {count} corners of {axes} axes");
        assert_eq!(alone.len(), after.len());
    }
}

#[test]
fn what_ran_before_has_no_influence() {
    runs_as_alone(&curve(400), &[]);
}

/// Two parts of a program are planned at a time: which of them comes first must not depend on it either.
#[test]
fn nor_where_the_program_stops_within() {
    runs_as_alone(&curve(200), &[100]);
}

/// Each is given when the last one has ended, as steps and lines of MDI are: no sign of a queue that takes no more than one.
#[test]
fn nor_have_single_moves() {
    let program = corners(3, 2);
    let alone = run(&[&program], &[]);
    let single = [1.0, 3.0, 4.0, 7.0, 9.0, 14.0, 15.0, 19.0, 0.0].map(|x| {
        let mut point = Axes::zeros();
        point[0] = x;
        point
    });
    let mut programs: Vec<&[Axes]> = single.chunks(1).collect();
    programs.push(&program);
    assert_eq!(run(&programs, &[]), alone);
}
