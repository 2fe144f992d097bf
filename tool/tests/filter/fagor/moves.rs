//! Every form of motion, against paths worked out by hand.

use crate::expected::Path;
use framepath_tool::dialects::Dialect;

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Fagor, &[("part.pim", program)], program);
}

/// The examples of the control's manual: three ways to say the same two arcs.
#[test]
fn arcs_in_rectangular_and_polar_coordinates() {
    let expected = Path::from([60., 40., 0.])
        .ccw([110., 90., 0.], (60., 90.))
        .ccw([160., 40., 0.], (160., 90.));
    for arcs in [
        "G90 G17 G03 X110 Y90 I0 J50 F100\nX160 Y40 I50 J0",
        "G90 G17 G03 Q0 I0 J50 F100\nQ-90 I50 J0",
        "G93 I60 J90\nG03 Q0 F100\nG93 I160 J90\nQ-90",
        "G90 G17 G03 X110 Y90 R50 F100\nX160 Y40 R50",
        "G06 G03 X110 Y90 I60 J90 F100\nG06 X160 Y40 I160 J90",
        "G91 G03 X50 Y50 I0 J50 F100\nX50 Y-50 I50 J0",
        "G91 G03 Q90 I0 J50 F100\nQ90 I50 J0",
    ] {
        check(&format!("G90 G0 X60 Y40 Z0\n{arcs}\nM30\n"), &expected);
    }
}

#[test]
fn full_circles() {
    let expected = Path::from([170., 80., 0.]).cw([170., 80., 0.], (120., 80.));
    for circle in [
        "G90 G17 G02 X170 Y80 I-50 J0 F100",
        "G90 G17 G02 I-50 J0 F100",
        "G90 G17 G02 Q360 I-50 J0 F100",
        "G93 I120 J80\nG02 Q360 F100",
    ] {
        check(&format!("G90 G0 X170 Y80 Z0\n{circle}\nM30\n"), &expected);
    }
}

#[test]
fn places_in_polar_coordinates() {
    let program = "\
G90 G0 X0 Y0 Z0
G93 I35 J30
G90 G01 R25 Q0 F100
G03 Q90
G01 X0 Y0
G01 R10 Q180 Z3
G91 R5 Q90
G90 Q0
M30
";
    let expected = Path::from([0.0; 3])
        .lines(&[(60., 30.)])
        .ccw([35., 55., 0.], (35., 30.))
        .lines(&[(0., 0.)])
        .line([25., 30., 3.])
        .lines(&[(35., 15.), (50., 30.)]);
    check(program, &expected);
    for radius in ["R-5", "R-5 Q0"] {
        let along = format!("G90 G0 X0 Y0 Z0\nG1 R10 Q90 F100\nG91 {radius}\nM30\n");
        check(&along, &Path::from([0.0; 3]).lines(&[(0., 10.), (0., 5.)]));
    }
    let here = "G90 G0 X10 Y0 Z0\nG93\nG1 R10 Q90 F100\nM30\n";
    check(here, &Path::from([10., 0., 0.]).lines(&[(10., 10.)]));
}

#[test]
fn helices_and_long_arcs() {
    let program = "G90 G0 X0 Y0 Z0\nG2 X10 Y10 R-10 Z-4 F100\nM30\n";
    // Three quarters of a turn: clockwise, the centre is on the left of the chord.
    let expected = Path::from([0.0; 3]).cw([10., 10., -4.], (0., 10.));
    check(program, &expected);
}

#[test]
fn tangent_arcs() {
    let program = "\
G90 G0 X0 Y0 Z0
G1 X10 F100
G8 X10 Y20
G8 X0 Y10
X-5
M30
";
    // Half a circle about (10, 10) that ends westwards; from there a quarter about the same centre.
    let expected = Path::from([0.0; 3])
        .lines(&[(10., 0.)])
        .ccw([10., 20., 0.], (10., 10.))
        .ccw([0., 10., 0.], (10., 10.))
        .lines(&[(-5., 10.)]);
    check(program, &expected);
    let straight = "G90 G0 X0 Y0 Z0\nG1 X10 F100\nG8 X20 Y0\nM30\n";
    check(
        straight,
        &Path::from([0.0; 3]).lines(&[(10., 0.), (20., 0.)]),
    );
}

#[test]
fn arcs_over_three_points() {
    for (over, expected) in [
        (
            "G9 X10 Y0 I5 J5",
            Path::from([0.0; 3]).cw([10., 0., 0.], (5., 0.)),
        ),
        (
            "G9 X10 Y0 I5 J-5",
            Path::from([0.0; 3]).ccw([10., 0., 0.], (5., 0.)),
        ),
        (
            "G91 G9 X10 Y0 I5 J5",
            Path::from([0.0; 3]).cw([10., 0., 0.], (5., 0.)),
        ),
    ] {
        check(&format!("G90 G0 X0 Y0 Z0\nF100\n{over}\nM30\n"), &expected);
    }
}

#[test]
fn other_planes() {
    // G18: the first axis is Z. A quarter from (Z0, X10) to (Z10, X0) about the origin runs from X to Z:
    // against the positive direction, that is clockwise.
    let program = "G90 G0 X10 Y0 Z0\nG18 G2 X0 Z10 I-10 K0 F100\nM30\n";
    let commands = super::translate(program, &[]);
    assert_eq!(commands[1], "G18 G2 X0 Z10 I-10 K0 F100");
    let turned = "G90 G0 X10 Y0 Z0\nG18\nG73 Q90\nG1 X0 Z10 F100\nM30\n";
    // In the ZX plane (10, 0) turns by 90 degrees to (0, 10): X10.
    assert_eq!(
        super::translate(turned, &["--backend", "program"])[2],
        "G1 X10 Z0 F100"
    );
    assert!(super::errors(turned, &["--backend", "kinematics"]).contains("would tilt the tool"));
}

#[test]
fn rounded_and_chamfered_corners() {
    let program = "\
G90 G0 X0 Y0 Z0
G36 R5 G1 X20 Y0 F100
G39 R3 Y20
X0
M30
";
    let expected = Path::from([0.0; 3])
        .feed(100.0)
        .lines(&[(15., 0.)])
        .ccw([20., 5., 0.], (15., 5.))
        .lines(&[(20., 17.), (17., 20.), (0., 20.)]);
    check(program, &expected);
}

#[test]
fn a_corner_before_an_arc() {
    // The arc about (30, 0) begins at (20, 0) towards the north; the corner of 90 degrees to the left is
    // rounded by 2. The centre lies at height 2, 12 from (30, 0): at 30 - sqrt(140).
    let program = "\
G90 G0 X0 Y0 Z0
G36 R2 G1 X20 F100
G2 X30 Y10 I10 J0
M30
";
    let x = 30.0 - 140.0_f64.sqrt();
    let (end_x, end_y) = (30.0 + (x - 30.0) * 10.0 / 12.0, 2.0 * 10.0 / 12.0);
    let expected = Path::from([0.0; 3])
        .lines(&[(x, 0.)])
        .ccw([end_x, end_y, 0.], (x, 2.))
        .cw([30., 10., 0.], (30., 0.));
    check(program, &expected);
}

#[test]
fn tangential_entry_and_exit() {
    // The path runs along X from the origin to (30, 0). It is entered from (-5, 10) by an arc of 5 about
    // (0, 5) that is tangent to the vertical x = -5, and left to (35, 10) the same way.
    let program = "\
G90 G0 X-5 Y10 Z0
G37 R5 G1 X0 Y0 F100
G38 R5 X30
X35 Y10
M30
";
    let expected = Path::from([-5., 10., 0.])
        .lines(&[(-5., 5.)])
        .ccw([0., 0., 0.], (0., 5.))
        .lines(&[(30., 0.)])
        .ccw([35., 5., 0.], (30., 5.))
        .lines(&[(35., 10.)]);
    check(program, &expected);
}

/// The arc of an exit has the feed of the contour, whatever leads on from it.
#[test]
fn a_tangential_exit_may_lead_to_a_rapid_motion() {
    let program = "G0 X0 Y30 Z0 F100\nG90 G1 X40\nG2 G38 R5 X80 I20 J0\nG0 X120\nM30\n";
    let lines = super::translate(program, &["--backend", "program"]);
    let with_feed = super::translate(&program.replace("G0 X120", "G1 X120"), &[]);
    let place = |lines: &[String]| lines.iter().position(|line| line.contains("X120"));
    let (at, of_feed) = (
        place(&lines).expect("the end"),
        place(&with_feed).expect("it"),
    );
    assert_eq!(lines[..at], with_feed[..of_feed]);
    assert_eq!(lines[at], "G0 X120 Y30", "{lines:?}");
    assert!(lines[at - 1].starts_with("G3 X"), "{lines:?}");
}

#[test]
fn compensation_begins_at_the_entry_and_ends_behind_the_exit() {
    let program = "T1 D1 M6\nG90 G0 X-5 Y10 Z0\nG43 G0 Z1\nG37 R5 G41 G1 X0 Y0 F100\nG38 R5 X30\nG40 X35 Y10\nM30\n";
    let lines = super::translate(program, &["--backend", "program"]);
    let wanted = [
        "G41 G1 X-5 Y5 F100",
        "G3 X0 Y0 I5 J0",
        "G1 X30 Y0",
        "G3 X35 Y5 I0 J5",
        "G40 G1 X35 Y10",
    ];
    let begin = lines.iter().position(|line| line.contains("G41"));
    let given = &lines[begin.expect("G41")..][..wanted.len()];
    assert_eq!(given, wanted, "{lines:?}");
}

#[test]
fn a_corner_and_the_arc_before_it_have_a_radius_each() {
    let program =
        |centre: &str| format!("G90 G0 X0 Y0 Z0\nG3 G36 R2 X10 Y10 {centre} F100\nG1 X0\nM30\n");
    let by_centre = super::translate(&program("I0 J10"), &[]);
    assert!(by_centre.iter().filter(|line| line.contains("G3 ")).count() == 2);
    assert_eq!(super::translate(&program("R10"), &[]), by_centre);
    let before = program("R10").replace("G36 R2 X10 Y10 R10", "X10 Y10 R10 G36 R2");
    assert_eq!(super::translate(&before, &[]), by_centre);
}

/// K is the pitch; LinuxCNC's P counts the passages of the end.
#[test]
fn helices_of_several_turns() {
    let head = "G90 G0 X25 Y0 Z0\n";
    for (helix, written) in [
        ("X25 Y0 I-25 J0 Z-15 K5", "G2 X25 Y0 Z-15 I-25 J0 P3"),
        ("I-25 J0 Z-15 K5", "G2 X25 Y0 Z-15 I-25 J0 P3"),
        ("X0 Y-25 I-25 J0 Z-5 K4", "G2 X0 Y-25 Z-5 I-25 J0 P2"),
        ("I-25 J0 Z-5 K4", "G2 X0 Y-25 Z-5 I-25 J0 P2"),
        ("G91 I-25 J0 Z-5 K4", "G2 X0 Y-25 Z-5 I-25 J0 P2"),
        ("Q-90 I-25 J0 Z-5 K4", "G2 X0 Y-25 Z-5 I-25 J0 P2"),
        ("X0 Y-25 I-25 J0 Z-1 K4", "G2 X0 Y-25 Z-1 I-25 J0"),
    ] {
        let lines = super::translate(&format!("{head}G2 {helix} F100\nM30\n"), &[]);
        let found = lines.iter().find(|line| line.starts_with("G2"));
        let found = found.expect("an arc").replace(" F100", "");
        assert_eq!(found, written, "{helix}");
    }
    for (helix, text) in [
        ("X0 Y-25 I-25 J0 Z-6 K4", "makes 1.5 turns"),
        ("X0 Y-25 R25 Z-6 K4", "not both R and K"),
        ("X0 Y-25 I-25 J0 K4", "a way along its axis"),
        ("X0 Y-25 I-25 J0 Z-5 K-4", "K above 0"),
    ] {
        let shown = super::errors(&format!("{head}G2 {helix} F100\nM30\n"), &[]);
        assert!(shown.contains(text), "{shown}");
    }
}

#[test]
fn lines_by_their_angle_and_one_coordinate() {
    let program =
        "G90 G0 X0 Y0 Z0\nG1 X10 Q45 F100\nG36 R1 Y20 Q-45\nY0 Q-90\nG91 X-10 Q180\nM30\n";
    let plain = "G90 G0 X0 Y0 Z0\nG1 X10 Y10 F100\nG36 R1 X0 Y20\nX0 Y0\nG91 X-10 Y0\nM30\n";
    assert_eq!(super::translate(program, &[]), super::translate(plain, &[]));
    for (block, text) in [
        ("G1 X0 Q45 F100", "does not lead to this coordinate"),
        ("G1 X10 Q90 F100", "does not lead to this coordinate"),
        ("G1 X10 Y10 Q45 F100", "polar and rectangular"),
    ] {
        let shown = super::errors(&format!("G90 G0 X0 Y0 Z0\n{block}\nM30\n"), &[]);
        assert!(shown.contains(text), "{shown}");
    }
}

#[test]
fn corners_under_a_mirror() {
    let program = "G90 G0 X0 Y0 Z0\nG11\nG36 R5 G1 X20 Y0 F100\nY20\nM30\n";
    let expected = Path::from([0.0; 3])
        .lines(&[(-15., 0.)])
        .cw([-20., 5., 0.], (-15., 5.))
        .lines(&[(-20., 20.)]);
    check(program, &expected);
}

#[test]
fn inches() {
    let program = "G70\nG90 G0 X1 Y0 Z0\nG72 S2\nG1 X1 F10\nG71\nG1 X0\nM30\n";
    let expected = Path::from([0.0; 3])
        .rapid([25.4, 0., 0.])
        .feed(254.0)
        .lines(&[(50.8, 0.), (0., 0.)]);
    check(program, &expected);
}

#[test]
fn tools_offsets_and_machine_coordinates() {
    let program = "\
N10 T5 D5 M06
G43 G54
S1200 M03 M08
G90 G0 X0 Y0 Z10
T6.8
M6
G44
G53 G0 Z0
G5
G7
G97 G94
G4 K250
M41
M0
M05 M09
M30
";
    assert_eq!(
        super::translate(program, &[]),
        [
            "(MSG, line 13: M41 tunes the other control and is left out)",
            "T5 M6",
            "G54 G43",
            "S1200 M3 M8",
            "G0 X0 Y0 Z10",
            "T6",
            "M6 G43 H8",
            "G49",
            "G53 G0 Z0",
            "G64 P0.01",
            "G61.1",
            "G94",
            "G4 P2.5",
            "M0",
            "M5 M9",
            "M30",
        ]
    );
    let row = "T5 M6\nG43 D9\nG90 G0 X0 Y0 Z0\nG41 G1 X10 F100\nG40 X20\nM30\n";
    let commands = super::translate(row, &[]);
    assert_eq!(commands[1], "G43 H9");
    assert_eq!(commands[3], "G41 D9 G1 X10 F100");
}

/// A path under compensation is mirrored and scaled before compensation, so that the sides change.
#[test]
fn compensation_under_mirror_and_scale() {
    let program = "G90 G0 X0 Y0 Z0\nG11\nG72 S2\nG41 G1 X10 F100\nY20\nG40 X0\nM30\n";
    assert_eq!(
        super::translate(program, &["--backend", "program"]),
        [
            "G0 X0 Y0 Z0",
            "F100",
            "o1 if [#5410 GE 20]",
            "o1 endif",
            "#<back>=[#5410*10/[SQRT[400-#5410*20]]]",
            "G42 G1 X-20 Y[0-#<back>]",
            "G1 Y40",
            "G40 G1 X0",
            "M30"
        ]
    );
    assert!(super::errors(program, &["--backend", "kinematics"]).contains("under SCALE"));
    // The factor for one axis acts after compensation: that is what the kinematics does.
    let after = "G90 G0 X0 Y0 Z0\nG72 X2\nG41 G1 X10 F100\nY20\nG40 X0\nM30\n";
    assert!(
        super::errors(after, &["--backend", "program"]).contains("act after cutter compensation")
    );
    let kinematics = super::translate(after, &[]);
    assert!(kinematics.contains(&"o<scale> call [2] [1] [1]".to_string()));
    assert!(
        kinematics.contains(&"G41 G1 X10 Y[0-#<back>] Z0".to_string()),
        "{kinematics:?}"
    );
}
