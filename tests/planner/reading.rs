//! The text of programs: what is written is read again as it was, and what makes no sense is refused with its line.

use proptest::prelude::*;

use crate::common::seeded_runner::seeded_runner;
use crate::program::reader::read;
use crate::program::{Program, checked};
use crate::random_program::{any_limits, any_move, any_program};
use crate::short_program;

fn is_read_as_written(programs: impl Strategy<Value = Program>) {
    let config = ProptestConfig {
        cases: 200,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let result = seeded_runner(config).run(&programs, |program| {
        let read = read(&program.to_string()).map_err(TestCaseError::fail)?;
        prop_assert_eq!(&read, &[program]);
        Ok(())
    });
    checked(result);
}

#[test]
fn random_programs_are_read_as_they_were_written() {
    let moves = prop::collection::vec(any_move(), 1..20);
    is_read_as_written(any_program(any_limits(), moves));
}

#[test]
fn so_are_short_ones() {
    is_read_as_written(short_program::any_program());
}

/// The head of a program, of 6 lines.
const HEAD: &str =
    "velocity 60.0\nacceleration 600.0\njerk inf\nmax_velocity 250.0\nmode P0.05\nsupply 1\n";

#[test]
fn each_jerk_each_mode_and_each_period_of_a_range_is_a_program() {
    let text = format!("{HEAD}jerk 1e6\nmode G61\nline X1 F10\nat 3..5 pause\nat 9..11 gone\n");
    let programs = read(&text).expect("programs");
    let starts: Vec<_> = programs
        .iter()
        .map(|program| (program.limits.jerk[0], program.mode, program.events[1].0))
        .collect();
    assert_eq!(programs.len(), 12);
    assert!((1..12).all(|place| !starts[..place].contains(&starts[place])));
}

#[test]
fn what_makes_no_sense_is_refused_with_its_line() {
    for (lines, error) in [
        ("spline X1 F10", "line 7: spline says nothing"),
        ("line X1", "line 7: F is missing"),
        ("line X1 F1O", "line 7: 1O is no value of F1O"),
        ("line X1 Q2 F10", "line 7: Q is no axis"),
        (
            "turn center 1 2 across Z angle 1 height 0 X1 F10",
            "line 7: X1 is no word of this move",
        ),
        (
            "turn center 1 2 across Q angle 1 height 0 F10",
            "line 7: Q is no axis",
        ),
        ("arc radial 1 0 0 radius 1", "line 7: radius is not tilt"),
        ("# a comment\nat 3 wait", "line 8: wait is no event"),
        ("at 5..3 pause", "line 7: 5..3 are no periods"),
        ("at 3 pause now", "line 7: now is too much"),
        (
            "at 3..5 pause\nat 9..12 gone",
            "the ranges of events are not of one length",
        ),
        ("at 3 pause\nat 2 gone", "events are not in order"),
        ("ask haste", "line 7: haste cannot be asked"),
        ("jerk 1 2", "line 7: jerk is missing"),
    ] {
        assert_eq!(
            read(&format!("{HEAD}{lines}\n")),
            Err(error.to_owned()),
            "{lines}"
        );
    }
    assert_eq!(
        read("velocity 1"),
        Err("jerk or mode is missing".to_owned())
    );
    assert_eq!(
        read("jerk 1\nmode G61"),
        Err("velocity is missing".to_owned())
    );
}
