//! What is read of a program, against what LinuxCNC's own `rs274` prints of it.

use framepath_tool::canon::call::{PathMode, Plane};
use framepath_tool::canon::{Call, read_program, read_text};
use framepath_tool::generated;
use std::path::Path;
use std::process::Command;

/// Moves and settings as `rs274` prints them: the name of the call and its numbers.
fn printed(program: &Path) -> Vec<(String, Vec<f64>)> {
    let home = tempfile::tempdir().expect("a folder");
    let output = Command::new("rs274")
        .args(["-n", "2", "-g"])
        .arg(program)
        .env("HOME", home.path())
        .current_dir(home.path())
        .output()
        .expect("rs274 runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.lines().filter_map(parse).collect()
}

fn parse(line: &str) -> Option<(String, Vec<f64>)> {
    let (head, rest) = line.split_once('(')?;
    let name = head.split_whitespace().last()?;
    let numbers = rest.trim_end_matches(')').split(',');
    let numbers = numbers
        .filter_map(|word| word.trim().parse().ok())
        .collect();
    Some((name.to_owned(), numbers))
}

/// The same from our reading, in program units and four decimals. Without offsets the machine's
/// coordinates are those of the program.
fn read(calls: &[Call]) -> Vec<(String, Vec<f64>)> {
    let mut unit = 1.0;
    let mut read = Vec::new();
    for call in calls {
        match call {
            Call::Unit(length) => unit = *length,
            Call::Traverse { end, .. } | Call::Feed { end, .. } => {
                let name = match call {
                    Call::Traverse { .. } => "STRAIGHT_TRAVERSE",
                    _ => "STRAIGHT_FEED",
                };
                let scaled = (0..6).map(|axis| end[axis] / if axis < 3 { unit } else { 1.0 });
                read.push((name.to_owned(), scaled.collect()));
            }
            Call::Arc {
                end,
                centre,
                turns,
                plane,
                ..
            } => {
                let [first, second, third] = match plane {
                    Plane::Xy => [0, 1, 2],
                    Plane::Yz => [1, 2, 0],
                    Plane::Zx => [2, 0, 1],
                };
                let numbers = vec![
                    end[first] / unit,
                    end[second] / unit,
                    centre[first] / unit,
                    centre[second] / unit,
                    f64::from(*turns),
                    end[third] / unit,
                ];
                read.push(("ARC_FEED".to_owned(), numbers));
            }
            _ => {}
        }
    }
    read
}

/// Asserts that both have the same moves.
fn assert_same(program: &Path) -> usize {
    let moves = ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"];
    let mut expected = printed(program);
    expected.retain(|(name, _)| moves.contains(&name.as_str()));
    let found = read(&read_program(program, &[0.0; 9]).expect("the interpreter takes it"));
    assert!(!expected.is_empty());
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.0, expected.0);
        for (a, b) in found.1.iter().zip(&expected.1) {
            assert!((a - b).abs() <= 0.500001e-4, "{found:?} {expected:?}");
        }
    }
    found.len()
}

#[test]
fn generated_programs_as_rs274_reads_them() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["arcs", "polyline", "blade", "abc"] {
        let file = folder.path().join(format!("{name}.ngc"));
        std::fs::write(&file, generated::program(name).expect("a program")).expect("written");
        assert!(assert_same(&file) >= 100);
    }
}

#[test]
fn programs_of_linuxcnc_as_rs274_reads_them() {
    for name in ["3D_Chips", "tort", "arcspiral", "daisy", "cds", "spiral"] {
        let file = format!("/usr/share/linuxcnc/ncfiles/{name}.ngc");
        assert!(assert_same(file.as_ref()) >= 50, "{name}");
    }
}

#[test]
fn all_digits_and_all_axes() {
    let calls = read_text(
        "t",
        "G21 F100\nG1 X[1/3] A[2/3] U[1/7] V1 W2\nM2\n",
        &[0.0; 9],
    )
    .expect("read");
    let moves: Vec<_> = calls
        .iter()
        .filter(|call| matches!(call, Call::Feed { .. }))
        .collect();
    let end = [
        1.0 / 3.0,
        0.0,
        0.0,
        2.0 / 3.0,
        0.0,
        0.0,
        1.0 / 7.0,
        1.0,
        2.0,
    ];
    assert_eq!(moves, [&Call::Feed { line: 2, end }]);
}

#[test]
fn offsets_are_applied() {
    let program = "G21 G90 F100
G10 L2 P1 X10 Y20 Z30 R90
G54
G92 X0 Y0
G1 X1 Y2 Z3
G91 X1
M2
";
    let calls = read_text("t", program, &[0.0; 9]).expect("read");
    let ends: Vec<_> = calls
        .iter()
        .filter_map(|call| match call {
            Call::Feed { end, .. } => Some(*end),
            _ => None,
        })
        .collect();
    // The machine stands at zero, and G92 calls that X0 Y0: X of the program is Y of the machine.
    for (end, expected) in ends.iter().zip([[-2.0, 1.0, 33.0], [-2.0, 2.0, 33.0]]) {
        for axis in 0..3 {
            assert!((end[axis] - expected[axis]).abs() < 1e-12, "{ends:?}");
        }
    }
    assert_eq!(ends.len(), 2);
}

#[test]
fn modes_tolerances_and_tags() {
    let program = "G20 G64 P0.01 Q0.002 F10\nG1 X1\nG61\nX2\nG61.1\nX3\nG4 P1.5\nM2\n";
    let calls = read_text("t", program, &[0.0; 9]).expect("read");
    let modes: Vec<_> = calls
        .iter()
        .filter_map(|call| match call {
            Call::Mode(mode, tolerance) => Some((*mode, *tolerance)),
            _ => None,
        })
        .collect();
    assert!(modes.contains(&(PathMode::Continuous, 0.01 * 25.4)));
    assert!(modes.contains(&(PathMode::ExactPath, 0.0)));
    assert!(modes.contains(&(PathMode::ExactStop, 0.0)));
    assert!(calls.contains(&Call::NaiveCam(0.002 * 25.4)));
    assert!(calls.contains(&Call::Dwell(1.5)));
    let tag = calls.iter().rev().find_map(|call| match call {
        Call::Tag(tag) if tag.fields[0] == 2 => Some(*tag),
        _ => None,
    });
    let tag = tag.expect("the tag of line 2");
    assert!((tag.path_tolerance - 0.01).abs() < 1e-9);
    assert!((tag.naive_cam_tolerance - 0.002).abs() < 1e-9);
}

#[test]
fn what_a_program_prints_is_not_taken_for_a_call() {
    let program = "(PRINT,FEED 1 1 1 1 1 1 1 1 1 1)\nG0 X1\nM2\n";
    let calls = read_text("t", program, &[0.0; 9]).expect("read");
    assert!(!calls.iter().any(|call| matches!(call, Call::Feed { .. })));
    assert!(
        calls
            .iter()
            .any(|call| matches!(call, Call::Traverse { .. }))
    );
}
