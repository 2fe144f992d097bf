use super::*;
use crate::layer::spindle::{SpindleCommand, Surface};
use crate::path::segment::distance;

/// Lays the calls of a program that are written as the interpreter program prints them.
fn laid(calls: &str, settings: LayerSettings) -> Program {
    let calls: Vec<Call> = calls
        .lines()
        .map(|line| Call::parse(line).unwrap_or_else(|| panic!("{line}")))
        .collect();
    lay(&calls, &settings)
}

fn plain(calls: &str) -> Program {
    laid(calls, LayerSettings::default())
}

fn moves(program: &Program) -> Vec<&Move> {
    let moves = program
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Move(a_move) => Some(a_move.as_ref()),
            _ => None,
        });
    moves.collect()
}

const BLENDED: &str = "TERM 3 0.1\nNAIVECAM 0.05\nRATE 600\n";

#[test]
fn a_straight_run_becomes_one_move() {
    let program = plain(&format!(
        "{BLENDED}FEED 1 1 0 0 0 0 0 0 0 0\nFEED 2 2 0.02 0 0 0 0 0 0 0\nFEED 3 3 0 0 0 0 0 0 0 0"
    ));
    assert_eq!((program.programmed.len(), moves(&program).len()), (3, 1));
    assert_eq!(program.ranges, [(0, 2)]);
    assert_eq!(moves(&program)[0].line, 3);
    assert!((moves(&program)[0].velocity - 10.0).abs() < 1e-12);
    for piece in &program.programmed {
        assert!(
            (piece.merged_within - 0.02).abs() < 1e-9,
            "what merging took"
        );
    }
}

#[test]
fn a_corner_and_rotary_axes_are_not_merged() {
    let program = plain(&format!(
        "{BLENDED}FEED 1 1 0 0 0 0 0 0 0 0\nFEED 2 1 1 0 0 0 0 0 0 0\nFEED 3 1 2 0 0 0 0 0 0 0\n\
         FEED 4 1 3 0 5 0 0 0 0 0"
    ));
    assert_eq!(program.ranges, [(0, 0), (1, 2), (3, 3)]);
    assert!(program.other_axes);
    assert!(
        program
            .programmed
            .iter()
            .all(|piece| piece.merged_within < 1e-12)
    );
}

#[test]
fn nothing_is_merged_without_its_tolerance_or_in_exact_modes() {
    let run = "FEED 1 1 0 0 0 0 0 0 0 0\nFEED 2 2 0 0 0 0 0 0 0 0";
    let without = plain(&format!("TERM 3 0.1\nNAIVECAM 0\nRATE 600\n{run}"));
    let exact = plain(&format!("TERM 2 0\nNAIVECAM 0.05\nRATE 600\n{run}"));
    assert_eq!((moves(&without).len(), moves(&exact).len()), (2, 2));
}

#[test]
fn at_most_a_hundred_points_and_one_are_merged() {
    let mut calls = BLENDED.to_owned();
    for x in 1..=250 {
        calls += &format!("FEED {x} {x} 0 0 0 0 0 0 0 0\n");
    }
    let ends: Vec<f64> = moves(&plain(&calls))
        .iter()
        .map(|a_move| a_move.end[0])
        .collect();
    assert_eq!(ends, [101.0, 202.0, 250.0]);
}

#[test]
fn a_flat_arc_goes_over_its_middle_as_two_lines() {
    // 0.01 mm high over a chord of 2 mm
    let arc = "ARC 1 2 0 0 0 0 0 0 0 0 1 -49.995 0 0 0 1 -1 0 0";
    let merged = plain(&format!("{BLENDED}{arc}"));
    assert_eq!(moves(&merged).len(), 1);
    assert!(
        moves(&merged)
            .iter()
            .all(|a_move| a_move.shape == Shape::Line)
    );
    let kept = plain(&format!("TERM 3 0.1\nNAIVECAM 0.005\nRATE 600\n{arc}"));
    assert!(matches!(moves(&kept)[0].shape, Shape::Arc { turn: -1, .. }));
}

#[test]
fn turns_that_a_flat_arc_loses_are_noted_and_widen_no_tolerance() {
    // Two whole turns and 5 degrees of radius 3; then radius 0.01, where a whole turn is as flat.
    let arc = "ARC 1 2.9886 0.2615 -4 0 0 0 0 0 0 0 0 0 0 0 1 3 0 0";
    let start = "FEED 1 3 0 0 0 0 0 0 0 0\n";
    let small = "ARC 1 0.009962 0.000872 -4 0 0 0 0 0 0 0 0 0 0 0 1 3 0 0";
    let left_away = |calls: &str| {
        let program = plain(calls);
        let last = *program.programmed.last().expect("an arc");
        let lines = moves(&program)
            .iter()
            .all(|a_move| a_move.shape == Shape::Line);
        (lines, last.turns_left_away, last.merged_within < 0.05)
    };
    assert_eq!(
        left_away(&format!("{BLENDED}{start}{arc}")),
        (true, 2, true)
    );
    assert_eq!(
        left_away(&format!("{BLENDED}FEED 1 0.01 0 0 0 0 0 0 0 0\n{small}")).1,
        0
    );
    for kept in [
        "TERM 3 0.1\nNAIVECAM 0\nRATE 600\n",
        "TERM 1 0\nNAIVECAM 0.05\nRATE 600\n",
    ] {
        assert_eq!(left_away(&format!("{kept}{start}{arc}")), (false, 0, true));
    }
}

#[test]
fn an_arc_is_limited_by_its_radius() {
    // A full circle of radius 1 in G18, F 6000.
    let program = plain("TERM 2 0\nRATE 6000\nARC 1 0 0 0 0 0 0 0 0 0 1 0 0 0 1 0 1 2 0");
    let circle = moves(&program)[0];
    let expected = (1000.0 * 0.75f64.sqrt()).sqrt();
    assert!((circle.velocity - expected).abs() < 1e-9);
    assert!((circle.acceleration - 1000.0).abs() < 1e-9);
    assert_eq!(circle.motion_type, MotionType::Arc);
}

#[test]
fn rapid_rotary_and_raised_feeds() {
    let calls = "RATE 60\nTRAVERSE 1 3 4 0 0 0 0 0 0 0\nFEED 2 3 4 0 90 0 0 0 0 0\nFEED 3 4 4 0 180 0 0 0 0 0";
    let velocities = |settings| -> Vec<f64> {
        moves(&laid(calls, settings))
            .iter()
            .map(|a_move| a_move.velocity)
            .collect()
    };
    let as_programmed = velocities(LayerSettings::default());
    assert_eq!(as_programmed, [125.0, 1.0, 1.0]);
    let raised = LayerSettings {
        feed_at_least: Some(6000.0),
        ..LayerSettings::default()
    };
    // The last one is limited by A: 90 degrees at 100 degrees per second, for 1 mm.
    let raised = velocities(raised);
    assert_eq!(raised[..2], [125.0, 100.0]);
    assert!((raised[2] - 1.0 / 0.9).abs() < 1e-12);
}

#[test]
fn what_waits_for_the_end_of_motion() {
    let program = plain(
        "RATE 60\nFEED 1 1 0 0 0 0 0 0 0 0\nWAIT\nDWELL 2\nSPINDLE 1000 1\nFEED 2 2 0 0 0 0 0 0 0 0",
    );
    let kinds: Vec<&str> = program
        .operations
        .iter()
        .map(|operation| match operation {
            Operation::Move(a_move) if a_move.at_speed => "move at speed",
            Operation::Move(_) => "move",
            Operation::WaitForMotion => "wait",
            Operation::Dwell(_) => "dwell",
            Operation::ToolLength(_) => "tool length",
            Operation::Spindle(_) => "spindle",
            Operation::Termination(..) => "mode",
            Operation::Synchronise { .. } => "synchronise",
        })
        .collect();
    let expected = [
        "mode",
        "move",
        "wait",
        "dwell",
        "wait",
        "spindle",
        "move at speed",
    ];
    assert_eq!(kinds, expected);
    assert!(program.handed[0].stops && !program.handed[1].stops);
}

#[test]
fn a_feed_move_behind_the_start_of_a_spindle_begins_at_rest() {
    let program = plain(
        "RATE 60\nSPINDLE 1000 1\nTRAVERSE 1 1 0 0 0 0 0 0 0 0\nTRAVERSE 2 2 0 0 0 0 0 0 0 0\n\
         FEED 3 3 0 0 0 0 0 0 0 0\nFEED 4 4 0 0 0 0 0 0 0 0",
    );
    let stops: Vec<bool> = program.handed.iter().map(|piece| piece.stops).collect();
    assert_eq!(stops, [false, true, false, false]);
}

#[test]
fn a_feed_move_waits_for_each_new_speed_of_the_spindle() {
    let waits = |calls: &str| -> Vec<bool> {
        let program = plain(&format!("RATE 60\n{calls}"));
        moves(&program)
            .iter()
            .map(|a_move| a_move.at_speed)
            .collect()
    };
    let run = "TRAVERSE 1 1 0 0 0 0 0 0 0 0\nFEED 2 2 0 0 0 0 0 0 0 0\nFEED 3 3 0 0 0 0 0 0 0 0\n\
               TRAVERSE 4 4 0 0 0 0 0 0 0 0\nFEED 5 5 0 0 0 0 0 0 0 0\n";
    let turning = format!("SPINDLE 1000 1\n{run}");
    assert_eq!(waits(&turning), [false, true, false, false, false]);
    let faster = waits(&format!("{turning}SPEED 2000\n{run}"));
    assert_eq!(faster[5..], [false, true, false, false, false]);
    let standing = waits(&format!("SPINDLE 0 0\nSPEED 2000\n{run}"));
    assert!(!standing.contains(&true));
    // Behind a rapid the diameter is another one, as long as the speed follows it.
    let surface = format!("SURFACE 2500 4\nSPINDLE 1e5 1\n{run}");
    assert_eq!(waits(&surface), [false, true, false, false, true]);
    let back = waits(&format!("{surface}SURFACE 0 4\nSPEED 500\n{run}"));
    assert_eq!(back[5..], [false, true, false, false, false]);
}

#[test]
fn a_constant_surface_speed_is_commanded_with_the_next_speed() {
    let program = plain("SPINDLE 1000 -1\nSURFACE 2500 4\nSPEED 1e5\nSPINDLE 1e5 0");
    let commands: Vec<SpindleCommand> = program
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Spindle(command) => Some(*command),
            _ => None,
        })
        .collect();
    let surface = |speed| Some(Surface { speed, centre: 4.0 });
    let expected = [
        (-1000.0, None),
        (-2500.0, surface(-1e5)),
        (0.0, surface(0.0)),
    ];
    assert_eq!(
        commands,
        expected.map(|(speed, surface)| SpindleCommand { speed, surface })
    );
}

#[test]
fn feed_per_revolution_does_not_hold_for_rapids() {
    let program =
        plain("FEEDMODE 1\nRATE 0.5\nTRAVERSE 1 1 0 0 0 0 0 0 0 0\nFEED 2 2 0 0 0 0 0 0 0 0");
    let synchronised: Vec<f64> = program
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Synchronise { per_revolution, .. } => Some(*per_revolution),
            _ => None,
        })
        .collect();
    assert_eq!(synchronised, [0.5, 0.0, 0.5]);
}

#[test]
fn tapping_goes_down_and_back() {
    let program = plain("RATE 60\nTAP 1 0 0 -10 0 0 0 0 0 0\nFEED 2 1 0 0 0 0 0 0 0 0");
    assert_eq!(program.ranges, [(0, 1), (2, 2)]);
    assert_eq!(moves(&program)[0].shape, Shape::Tap);
    assert!(distance(&program.handed[1].segment.start, &[0.0; 9]) < 1e-12);
    assert_eq!(program.end()[0], 1.0);

    let at_the_end = plain("RATE 60\nFEED 1 1 0 2 0 0 0 0 0 0\nTAP 2 1 0 -10 0 0 0 0 0 0");
    assert_eq!(at_the_end.end()[..3], [1.0, 0.0, 2.0]);
}
