//! Canned cycles, against the moves they stand for.

use crate::expected::Path;
use framepath_tool::dialects::Dialect;

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Fagor, &[("part.pim", program)], program);
}

#[test]
fn drilling_at_several_places() {
    let program = "\
G90 G0 X0 Y0 Z20
G99 G81 X10 Y0 Z2 I-8 K50 F100
X20
G98 G81 X30 Y5 Z2 I-8
G80
G0 X0 Y0
M30
";
    let expected = Path::from([0., 0., 20.])
        .rapid([10., 0., 20.])
        .rapid([10., 0., 2.])
        .line([10., 0., -8.])
        .rapid([10., 0., 2.])
        .rapid([20., 0., 2.])
        .line([20., 0., -8.])
        .rapid([20., 0., 2.])
        // The second cycle is defined here: its starting plane is where the tool is.
        .rapid([30., 5., 2.])
        .line([30., 5., -8.])
        .rapid([30., 5., 2.])
        .rapid([0., 0., 2.]);
    check(program, &expected);
    let dwells = super::translate(program, &[]);
    assert_eq!(dwells.iter().filter(|line| *line == "G4 P0.5").count(), 2);
}

#[test]
fn incremental_cycles_repeat() {
    let program = "\
G90 G0 X0 Y0 Z10
G91 G98 G82 X5 Z-8 I-6 F100
X5 N2
X5 N0
G80
M30
";
    let mut expected = Path::from([0., 0., 10.]);
    for x in [5., 10., 15.] {
        expected = expected
            .rapid([x, 0., 10.])
            .rapid([x, 0., 2.])
            .line([x, 0., -4.])
            .rapid([x, 0., 2.])
            .rapid([x, 0., 10.]);
    }
    check(program, &expected.rapid([20., 0., 10.]));
}

/// G98 is in force in the beginning, and G99 until the next G98, with cycles and without.
#[test]
fn withdrawals_outlast_a_cycle() {
    let program = "\
G17 G40 G80 G90 G98
G0 X0 Y0 Z10
G81 X5 Y0 Z2 I-3 F100
G80 G99
G81 X6 Z2 I-3
G80
G0 Z10
G81 X7 Z2 I-3
M30
";
    let hole = |path: Path, x: f64| {
        path.rapid([x, 0., 2.])
            .line([x, 0., -3.])
            .rapid([x, 0., 2.])
    };
    let path = hole(Path::from([0., 0., 10.]).rapid([5., 0., 10.]), 5.);
    let path = hole(path.rapid([5., 0., 10.]).rapid([6., 0., 10.]), 6.);
    check(
        program,
        &hole(path.rapid([6., 0., 10.]).rapid([7., 0., 10.]), 7.),
    );
}

#[test]
fn deep_holes_in_steps() {
    let program = "G90 G0 X0 Y0 Z10\nG99 G83 X5 Y0 Z2 I-5 J3 F100\nG80\nM30\n";
    let expected = Path::from([0., 0., 10.])
        .rapid([5., 0., 10.])
        .rapid([5., 0., 2.])
        .line([5., 0., -3.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -2.])
        .line([5., 0., -8.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -7.])
        .line([5., 0., -13.])
        .rapid([5., 0., 2.]);
    check(program, &expected);
}

#[test]
fn places_may_be_polar_and_withdrawals_change_on_the_way() {
    let program = "G90 G0 X0 Y0 Z10\nG99 G81 R5 Q0 Z2 I-1 F100\nG98 Q90\nG84 R5 Q180 Z2 I-1\nM30\n";
    let mut expected = Path::from([0., 0., 10.]);
    for (x, y) in [(5., 0.), (0., 5.), (-5., 0.)] {
        expected = expected.rapid([x, y, if x == 0. { 2. } else { 10. }]);
        expected = expected.rapid([x, y, 2.]).line([x, y, -1.]);
        expected = match x < 0. {
            true => expected.line([x, y, 2.]),
            false => expected.rapid([x, y, 2.]),
        };
        if x <= 0. {
            expected = expected.rapid([x, y, 10.]);
        }
    }
    check(program, &expected);
}

#[test]
fn deep_holes_whose_steps_grow_shorter() {
    let head = "G90 G0 X0 Y0 Z10\n";
    let path = || {
        Path::from([0., 0., 10.])
            .rapid([5., 0., 10.])
            .rapid([5., 0., 2.])
    };
    // Without H the tool comes out after each step; C is 1.
    let out = path()
        .line([5., 0., -3.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -2.])
        .line([5., 0., -6.])
        .rapid([5., 0., 2.]);
    check(
        &format!("{head}G99 G69 X5 Y0 Z2 I-6 B3 D2 F100\nM30\n"),
        &out,
    );
    check(
        &format!("{head}G99 G69 X5 Y0 Z2 I-6 B3 D2 J1 H0.5 F100\nM30\n"),
        &out,
    );
    // Steps of 4, 2 and at least 1.5; out after two of them.
    let shorter = path()
        .line([5., 0., -4.])
        .rapid([5., 0., -3.5])
        .line([5., 0., -6.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -5.])
        .line([5., 0., -7.5])
        .rapid([5., 0., -7.])
        .line([5., 0., -8.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., 10.]);
    let cycle = "G69 X5 Y0 Z2 I-8 B4 D2 H0.5 J2 R0.5 L1.5 F100\n";
    check(&format!("{head}{cycle}M30\n"), &shorter);
    // Polar coordinates: R is the radius; G79 changes the depth of the hole after it.
    let polar = Path::from([0., 0., 10.])
        .rapid([5., 0., 10.])
        .rapid([5., 0., 2.])
        .line([5., 0., -3.])
        .rapid([5., 0., 2.])
        .rapid([0., 5., 2.])
        .line([0., 5., -1.])
        .rapid([0., 5., 2.]);
    let program = format!("{head}G99 G69 R5 Q0 Z2 I-3 B9 F100\nG79 I-1\nG0 X0 Y5\nG80\nM30\n");
    check(&program, &polar);
    for (block, text) in [
        ("G69 X5 Z2 I-8 F100", "needs B"),
        ("G69 X5 Z2 I-8 B3 R1.5 F100", "R out of range"),
        ("G69 X5 Z2 I-8 B3 J1.5 F100", "no number of steps"),
        ("G69 X5 Z2 I-8 B3 C0 F100", "C0"),
        ("G69 X5 Z2 I-8 B3 R0.1 F100", "too small"),
    ] {
        let shown = super::errors(&format!("{head}{block}\nM30\n"), &[]);
        assert!(shown.contains(text), "{block}\n{shown}");
    }
}

#[test]
fn boring_comes_back_with_feed_or_with_the_spindle_at_rest() {
    for g in [85, 89] {
        let program = format!("G90 G0 X0 Y0 Z10\nG{g} X5 Y0 Z2 I-5 F100\nG80\nM30\n");
        let expected = Path::from([0., 0., 10.])
            .rapid([5., 0., 10.])
            .rapid([5., 0., 2.])
            .line([5., 0., -5.])
            .line([5., 0., 2.])
            .rapid([5., 0., 10.]);
        check(&program, &expected);
    }
    let program = "M4 S100\nG90 G0 X0 Y0 Z10\nG86 X5 Y0 Z2 I-5 F100\nG80\nM30\n";
    assert_eq!(
        super::translate(program, &[]),
        [
            "S100 M4",
            "G0 X0 Y0 Z10",
            "G0 X5 Y0 F100",
            "G0 Z2",
            "G1 Z-5",
            "G0 Z2 M5",
            "G0 Z10",
            "M4",
            "M30"
        ]
    );
}

#[test]
fn a_cycle_is_changed_and_mirrored() {
    let program = "\
G90 G0 X0 Y0 Z10
G11
G99 G81 X5 Y0 Z2 I-5 F100
G79 I-6
X8
G80
M30
";
    let expected = Path::from([0., 0., 10.])
        .rapid([-5., 0., 10.])
        .rapid([-5., 0., 2.])
        .line([-5., 0., -5.])
        .rapid([-5., 0., 2.])
        .rapid([-8., 0., 2.])
        .line([-8., 0., -6.])
        .rapid([-8., 0., 2.]);
    check(program, &expected);
}

#[test]
fn tapping_with_and_without_a_chuck_that_gives_way() {
    let program = "G90 G94 G0 X0 Y0 Z20 S500 M3\nG98 G84 X10 Y0 Z2 I-8 K50 F500\nG80\n\
                   G98 G84 X20 Y0 Z2 I-8 F500 R1\nG80\nM30\n";
    let text = super::translate(program, &[]).join("\n");
    let floating = "G0 Z2\nM49\nG1 Z-8\nG4 P0.5\nG1 Z2 M4\nM48\nG0 Z20 M3";
    assert!(text.contains(floating), "{text}");
    // The pitch is the feed over the speed.
    assert!(
        text.contains("G0 Z2\nM3\nG33.1 Z-8 K1\nM5\nG0 Z20 M3"),
        "{text}"
    );
    let oriented = super::translate(&program.replace("R1", "R2"), &[]);
    assert_eq!(oriented, super::translate(program, &[]));
    let floats = super::translate(&program.replace("R1", "R0"), &[]).join("\n");
    assert!(!floats.contains("G33.1"), "{floats}");
    let waits = program.replace("R1", "R1 K50");
    let text = super::translate(&waits, &[]).join("\n");
    assert!(text.contains("the dwell [K] of a rigid tap"), "{text}");
    let shown = super::errors("G0 X0 Y0 Z20 M3\nG84 X1 Z2 I-8 F100 R1\nM30\n", &[]);
    assert!(
        shown.contains("a rigid tap needs F in mm/min and S"),
        "{shown}"
    );
}

/// 100 times .29 is no whole number to a machine.
#[test]
fn times_may_be_worked_out_from_parameters() {
    let program = "(P1 = 0.29 * 100)\nG0 X0 Y0 Z20\nG4 KP1\nG81 X10 Z2 I-8 KP1 F100\nG80\nM30\n";
    let text = super::translate(program, &[]).join("\n");
    assert_eq!(text.matches("G4 P0.29\n").count(), 2, "{text}");
}

#[test]
fn threads_and_feeds_of_the_cutting_edge() {
    let program = "G90 G0 X0 Y0 Z5 S300 M3\nG33 Z-20 L1.5\nG96 G1 X5 F100\nG97 X6\nM30\n";
    let text = super::translate(program, &[]).join("\n");
    assert!(text.contains("G33 Z-20 K1.5\n"), "{text}");
    assert!(
        text.contains("G96 keeps the feed of the cutting edge"),
        "{text}"
    );
}

/// A hole of 10 at the first place, and at each of the others.
fn drilled(places: &[(f64, f64)]) -> Path {
    let mut path = Path::from([0., 0., 20.]);
    let mut above = 20.;
    for (x, y) in places {
        path = path
            .rapid([*x, *y, above])
            .rapid([*x, *y, 2.])
            .line([*x, *y, -8.])
            .rapid([*x, *y, 2.]);
        above = 2.;
    }
    path
}

/// Rows by two of length, step and number; both kinds of rectangle; circles by step or number; arcs.
#[test]
fn patterns_of_holes() {
    let row = [(10., 5.), (20., 5.), (30., 5.)];
    let turned = |x: f64, y: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        (10. + x * cos - y * sin, 5. + x * sin + y * cos)
    };
    // About (40, 5), 30 away.
    let around = |degrees: f64| {
        let (sin, cos) = (degrees + 180.).to_radians().sin_cos();
        (40. + 30. * cos, 5. + 30. * sin)
    };
    let frame = [
        (10., 5.),
        (20., 5.),
        (30., 5.),
        (30., 12.),
        (30., 19.),
        (20., 19.),
        (10., 19.),
        (10., 12.),
    ];
    let grid = [
        (10., 5.),
        (20., 5.),
        (30., 5.),
        (30., 12.),
        (20., 12.),
        (10., 12.),
    ];
    let skewed = [
        (10., 5.),
        turned(10., 0., 30.),
        {
            let (x, y) = turned(10., 0., 30.);
            let (sin, cos) = 90_f64.to_radians().sin_cos();
            (x + 4. * cos, y + 4. * sin)
        },
        (10., 9.),
    ];
    for (pattern, places) in [
        ("G60 X20 I10", row.to_vec()),
        ("G60 X20 K3", row.to_vec()),
        ("G60 I10 K3", row.to_vec()),
        ("G60 A30 I10 K2", vec![(10., 5.), turned(10., 0., 30.)]),
        ("G61 X20 I10 Y14 J7", frame.to_vec()),
        ("G62 X20 K3 J7 D2", grid.to_vec()),
        ("G62 A30 B60 I10 K2 J4 D2", skewed.to_vec()),
        ("G63 X30 Y0 K4", [0., 90., 180., 270.].map(around).to_vec()),
        (
            "G63 X30 Y0 I-90",
            [0., -90., -180., -270.].map(around).to_vec(),
        ),
        ("G64 X30 Y0 B60 K3 C0", [0., 30., 60.].map(around).to_vec()),
        (
            "G64 X30 Y0 B60 I-20",
            [0., -20., -40., -60.].map(around).to_vec(),
        ),
        ("G60 X20 I10 P2", vec![(10., 5.), (30., 5.)]),
        (
            "G62 X20 K3 J7 D2 P2 Q4.005",
            vec![(10., 5.), (30., 5.), (10., 12.)],
        ),
        ("G65 X30 Y0 A135", [0., -90.].map(around).to_vec()),
        ("G65 X30 Y0 A225 C0", [0., 90.].map(around).to_vec()),
        ("G65 X30 Y0 I30", [0., 60.].map(around).to_vec()),
        ("G65 X30 Y0 I-60", [0., -180.].map(around).to_vec()),
    ] {
        let program =
            format!("G90 G0 X0 Y0 Z20\nG99 G81 X10 Y5 Z2 I-8 F100\n{pattern}\nG80\nM30\n");
        check(&program, &drilled(&places));
        let increments = program.replace("F100\n", "F100\nG91\n");
        check(&increments, &drilled(&places));
    }
}

#[test]
fn the_tool_may_go_from_place_to_place_with_feed() {
    let head = "G90 G0 X0 Y0 Z20\nG99 G81 X10 Y0 Z2 I-8 F100\n";
    let first = || {
        Path::from([0., 0., 20.])
            .rapid([10., 0., 20.])
            .rapid([10., 0., 2.])
            .line([10., 0., -8.])
            .rapid([10., 0., 2.])
            .feed(50.)
    };
    let drilled = |path: Path| path.feed(100.).line([0., 10., -8.]).rapid([0., 10., 2.]);
    let around = drilled(first().ccw([0., 10., 2.], (0., 0.)));
    check(
        &format!("{head}G64 X-10 Y0 B90 I90 C3 F50\nG80\nM30\n"),
        &around,
    );
    let straight = drilled(first().line([0., 10., 2.]));
    check(
        &format!("{head}G91\nG65 X-10 Y0 A45 C1 F50\nG80\nM30\n"),
        &straight,
    );
}

#[test]
fn n_repeats_the_modal_subroutine_and_not_the_motion() {
    let program = "(SUB 1)\nG90 G1 Z-1 F100\nG0 Z0\nG91\n(RET)\nG90 G0 X0 Y0 Z0\n(MCALL 1)\nG91 X10 N3\n\
                   (MDOFF)\nG0 X5\nM30\n";
    let slot = |path: Path, x: f64| path.line([x, 0., -1.]).rapid([x, 0., 0.]);
    let mut expected = slot(Path::from([0.; 3]), 0.).rapid([10., 0., 0.]);
    for _ in 0..3 {
        expected = slot(expected, 10.);
    }
    check(program, &expected.rapid([15., 0., 0.]));
}

/// The subroutine leaves G91 and G0 behind.
#[test]
fn patterns_repeat_modal_subroutines() {
    let subroutine = "(SUB 1)\nG90 G1 Z-1 F100\nG91 Y1\nG0 Z1\nY-1\n(RET)\n";
    let slot = |path: Path, [x, y]: [f64; 2]| {
        path.feed(100.)
            .line([x, y, -1.])
            .line([x, y + 1., -1.])
            .rapid([x, y + 1., 0.])
            .rapid([x, y, 0.])
    };
    let first = || slot(Path::from([0.; 3]).rapid([10., 0., 0.]), [10., 0.]);
    let program = |pattern: &str| {
        format!("{subroutine}G90 G0 X0 Y0 Z0\nX10\n(MCALL 1)\n{pattern}\n(MDOFF)\nM30\n")
    };
    let row = slot(first().rapid([15., 0., 0.]), [15., 0.]);
    let row = slot(row.rapid([25., 0., 0.]), [25., 0.]);
    check(&program("G60 I5 K4 P3"), &row);
    let straight = slot(first().feed(50.).line([0., 10., 0.]), [0., 10.]);
    check(&program("G64 X-10 Y0 B90 I90 C1 F50"), &straight);
}

#[test]
fn patterns_that_are_no_patterns() {
    for (program, text) in [
        ("G60 X20 I10", "none is active"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I7", "make 3.857"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 K5", "two of X, I and K"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I0", "above 0"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 Q1", "places 1 to 5"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 P4.006", "places 1 to 5"),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 P2.5",
            "does not name places",
        ),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 P4.003",
            "does not name places",
        ),
        ("G81 X0 Y0 Z2 I-8 F100\nG63 X20 Y0 K4 C2", "need F here"),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 C2 F9",
            "how the tool goes",
        ),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 F9", "feed of C1"),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG60 X20 I5 L2",
            "not supported in a block",
        ),
        ("G81 X0 Y0 Z2 I-8 F100\nG63 X20 K4", "centre are missing"),
        ("G81 X0 Y0 Z2 I-8 F100\nG60 X-20 K3", "above 0"),
        ("G81 X0 Y0 Z2 I-8 F100\nG64 X20 Y0 K4", "B, the angle"),
        ("G81 X0 Y0 Z2 I-8 F100\nG64 X20 Y0 B-60 K4", "above 0"),
        ("G81 X0 Y0 Z2 I-8 F100\nG63 X20 Y0 I0", "whole number"),
        ("G81 X0 Y0 Z2 I-8 F100\nG61 X20 I10", "two of Y, J and D"),
        ("G81 X0 Y0 Z2 I-8 F100\nG65 X20 I10", "centre are missing"),
        ("G81 X0 Y0 Z2 I-8 F100\nG65 X20 Y0", "either A or I"),
        ("G81 X0 Y0 Z2 I-8 F100\nG65 X20 Y0 A5 I5", "either A or I"),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG65 X20 Y0 I41",
            "longer than the circle",
        ),
        (
            "G81 X0 Y0 Z2 I-8 F100\nG65 X20 Y0 I4 K3",
            "not supported in a block",
        ),
    ] {
        let shown = super::errors(&format!("G90 G0 X0 Y0 Z20\n{program}\nM30\n"), &[]);
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}

/// With G99 the starting plane is not needed, and G54 again moves nothing.
#[test]
fn work_offsets_before_a_cycle() {
    let program = "G54 G90 G0 X0 Y0 Z20\nG54\nG98 G81 X10 Y0 Z2 I-8 F100\nG80\nM30\n";
    let hole = |path: Path| {
        path.rapid([10., 0., 20.])
            .rapid([10., 0., 2.])
            .line([10., 0., -8.])
            .rapid([10., 0., 2.])
    };
    check(
        program,
        &hole(Path::from([0., 0., 20.])).rapid([10., 0., 20.]),
    );
    let program = "G54 G90 G0 X0 Y0 Z20\nG55\nG99 G81 X10 Y0 Z2 I-8 F100\nG80\nM30\n";
    check(program, &hole(Path::from([0., 0., 20.])));
}
