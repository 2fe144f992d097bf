//! Moves that are next to nothing, between arcs: where programs take the radius of a tool into account.

use framepath::axes::Axes;
use framepath::moves::shape::Circle;
use framepath::moves::{FeedWord, TerminationCondition, UNITS_PER_MINUTE};

use crate::common::{Machine, at, feed_move, with_machine};

/// F 6000 in millimetres, as the state tag of LinuxCNC's moves has it.
fn word() -> Option<FeedWord> {
    FeedWord::of_tag(6000.0, UNITS_PER_MINUTE)
}

/// An arc with this radius and length that begins in this direction, radians; the direction at its end.
fn arc(machine: &mut Machine, direction: f64, radius: f64, length: f64) -> f64 {
    let start = *machine.planner.goal();
    let inward = |direction: f64| at(-direction.sin(), direction.cos()) * radius;
    let center: Axes = start + inward(direction);
    let circle = Circle {
        center: center.fixed_rows::<3>(0).into(),
        normal: [0.0, 0.0, 1.0].into(),
        revolutions: if radius > 0.0 { 0 } else { -1 },
    };
    let direction = direction + length / radius;
    let end = center - inward(direction);
    machine.planner.set_feed_word(word());
    let added = machine.circle(end, &circle, &feed_move(100.0));
    added.expect("an arc");
    direction
}

/// A line of so many millimetres in this direction.
fn line(machine: &mut Machine, direction: f64, feed: f64, length: f64) {
    let start = *machine.planner.goal();
    let end = start + at(direction.cos(), direction.sin()) * length;
    machine.planner.set_feed_word(word());
    machine.line(end, &feed_move(feed)).expect("a line");
}

/// Servo periods that six arcs take, behind each of them a line of so many millimetres, with this between all of them.
fn outline(
    tolerance: f64,
    lines: f64,
    between: impl Fn(&mut Machine, f64) -> f64 + Send + Sync,
) -> f64 {
    let mut periods = 0;
    with_machine(|machine| {
        machine
            .planner
            .set_termination(TerminationCondition::Continuous { tolerance });
        let mut direction = 0.0;
        for (radius, length) in [7.1, 6.5, 6.3, 6.9, 7.7, 6.3]
            .into_iter()
            .zip([1.6, 1.6, 3.2, 2.2, 0.5, 2.1])
        {
            direction = arc(machine, direction, radius, length);
            direction = between(machine, direction);
            if lines > 0.0 {
                line(machine, direction, 100.0, lines);
                direction = between(machine, direction);
            }
        }
        arc(machine, direction, 6.4, 2.2);
        periods = machine.run(5_000);
    });
    periods as f64
}

/// Arcs are rounded over no more than a share of the moves beside them. Six moves of half a micrometre made the arcs take 2.4 times
/// as long, and of 10 micrometres 1.4 times.
#[test]
fn what_is_next_to_nothing_costs_arcs_no_time() {
    for (tolerance, lines) in [(0.01, 0.0), (0.05, 0.0), (0.01, 2.5), (0.05, 2.5)] {
        let without = outline(tolerance, lines, |_, direction| direction);
        let check = |with: f64, what: &str| {
            let most = 1.06 * without + 2.0;
            assert!(
                with <= most,
                "{what}, lines {lines}, P {tolerance}: {with} of {without} periods"
            );
        };
        for length in [0.0005, 0.003, 0.01] {
            for radius in [0.5, -0.5, -2.0] {
                let with = outline(tolerance, lines, |machine, direction| {
                    arc(machine, direction, radius, length)
                });
                check(with, &format!("arcs of R {radius}, {length} mm"));
            }
            let with = outline(tolerance, lines, |machine, direction| {
                // Slower for its axes alone.
                line(machine, direction, 80.0, length);
                direction
            });
            check(with, &format!("lines of {length} mm"));
        }
    }
}
