//! What `framepath filter` writes, compared as text.

use crate::shop::{Shop, accepted, commands, refused, translate};

const PART: &str = "\
N10 G17 G54 ;plane X/Y, work offset
N20 TRANS X20 Y10 ;absolute
N30 L10
N40 TRANS X55 Y35
N50 AROT RPL=45 ;in the plane
N60 L10 ;call
N70 TRANS X20 Y40
;(cancels what was before)
N80 AROT RPL=60
N90 L10
N100 G0 X100 Y100 ;away
N110 M30 ;end
";

const CONTOUR: &str = "\
; triangle with a round corner
G0 X0 Y0
G1 X10 F300
G3 X10 Y10 CR=5
G1 X0
Y0
M17
";

fn part() -> Shop {
    Shop::new(&[
        ("part.mpf", PART.as_bytes()),
        ("l10.SPF", CONTOUR.as_bytes()),
    ])
}

#[test]
fn kinematics_keeps_the_moves_and_calls_the_frames() {
    let output = accepted(&part().run("part.mpf", &["--backend", "kinematics"]));
    // A snapshot does not tell how many lines are empty at the end.
    assert!(output.ends_with("\nM30\n"));
    insta::assert_snapshot!("moves_stay_and_frames_become_calls", output);
}

#[test]
fn rewriting_works_the_frames_into_the_coordinates() {
    let output = accepted(&part().run("part.mpf", &["--backend", "program"]));
    // (10, 0) -> (62.0711, 42.0711) and (25, 48.6603); (0, 10) -> (47.9289, 42.0711) and (11.3397, 45).
    assert_eq!(
        commands(&output),
        [
            "G17 G54",
            "G0 X20 Y10",
            "G1 X30 F300",
            "G3 X30 Y20 I0 J5",
            "G1 X20",
            "G1 Y10",
            "G0 X55 Y35",
            "G1 X62.071068 Y42.071068 F300",
            "G3 X55 Y49.142136 I-3.535534 J3.535534",
            "G1 X47.928932 Y42.071068",
            "G1 X55 Y35",
            "G0 X20 Y40",
            "G1 X25 Y48.660254 F300",
            "G3 X16.339746 Y53.660254 I-4.330127 J2.5",
            "G1 X11.339746 Y45",
            "G1 X20 Y40",
            "G0 X-16.60254 Y176.60254",
            "M30",
        ]
    );
}

#[test]
fn auto_rewrites_what_it_can_and_leaves_tilted_planes_to_the_kinematics() {
    let flat = translate("TRANS X5\nG0 X0 Y0 Z0\nM30\n", &[]);
    assert_eq!(commands(&flat), ["G0 X5 Y0 Z0", "M30"]);
    let tilted = translate("ROT X30\nG0 X0 Y0 Z0\nM30\n", &[]);
    assert!(tilted.contains("o<rot> call [30] [0] [0]"));
    let reason = "(MSG, needs the frame kinematics: line 1: this frame tilts the tool axis)";
    assert!(tilted.contains(reason));
    // A frame that an aborted program left is cleared even where none is set.
    let plain = translate("G0 X1\nM30\n", &["--backend", "kinematics"]);
    assert_eq!(commands(&plain), ["o<frame_off> call", "G0 X1", "M30"]);
}

/// Each command and the call that it becomes. The frame is set to TRANS Z1 before.
#[test]
fn every_frame_command_has_its_call() {
    for (command, call) in [
        ("TRANS X1 Y-2.5", "o<trans> call [1] [-2.5] [0]"),
        ("ATRANS Z=3*2", "o<atrans> call [0] [0] [6]"),
        ("ROT X30 Y20 Z10", "o<rot> call [30] [20] [10]"),
        ("AROT Z-50", "o<arot> call [0] [0] [-50]"),
        ("ROT RPL=-50", "o<rot_rpl> call [-50]"),
        ("AROT RPL=ATAN2(1,1)", "o<arot_rpl> call [45]"),
        ("ROTS X30 Y20", "o<rots_xy> call [30] [20]"),
        ("AROTS Z15 X25", "o<arots_zx> call [15] [25]"),
        ("AROTS X25 Z15", "o<arots_zx> call [15] [25]"),
        ("ROTS Y12 Z13", "o<rots_yz> call [12] [13]"),
        ("ROTS X20", "o<rot> call [20] [0] [0]"),
        ("SCALE X2 Y2", "o<scale> call [2] [2] [1]"),
        ("ASCALE X.7 Y.7", "o<ascale> call [0.7] [0.7] [1]"),
        ("ASCALE", "o<ascale_off> call"),
        ("MIRROR X0 Y100", "o<mirror> call [1] [1] [0]"),
        ("AMIRROR Z1", "o<amirror> call [0] [0] [1]"),
        ("TRANS", "o<frame_off> call"),
        ("ROT", "o<frame_off> call"),
        ("SCALE", "o<frame_off> call"),
        ("MIRROR", "o<frame_off> call"),
        ("trans x7", "o<trans> call [7] [0] [0]"),
    ] {
        let program = format!("TRANS Z1\n{command}\nG0 X1\nM30\n");
        let lines = commands(&translate(&program, &["--backend", "kinematics"]));
        assert_eq!(lines[0], "o<frame_off> call");
        assert_eq!(lines[1], "o<trans> call [0] [0] [1]");
        assert_eq!(lines[2], call, "{command}");
        assert_eq!(lines[3], "G0 X1", "{command}");
        assert_eq!(lines.last().unwrap(), "M30");
    }
}

#[test]
fn bare_additive_commands_do_nothing_and_say_so() {
    for command in ["ATRANS", "AROT", "AROTS", "AMIRROR"] {
        let output = translate(&format!("{command}\nG0 X1\nM30\n"), &[]);
        assert_eq!(
            commands(&output),
            [
                format!("(MSG, line 1: {command} without axes does nothing)"),
                "G0 X1".to_string(),
                "M30".to_string()
            ]
        );
    }
}

#[test]
fn after_a_change_of_frame_every_known_coordinate_is_named() {
    let program = "G0 X10 Y20 Z30\nTRANS X5\nG0 X0\nG0 Y1\nROT Z90\nG1 F100 X2\nM30\n";
    assert_eq!(
        commands(&translate(program, &["--backend", "kinematics"])),
        [
            "o<frame_off> call",
            "G0 X10 Y20 Z30",
            "o<trans> call [5] [0] [0]",
            "G0 X0 Y20 Z30",
            "G0 Y1",
            "o<rot> call [0] [0] [90]",
            // X5 Y1 of the work offset is X1 Y-5 in the turned frame.
            "G1 X2 Y-5 Z30 F100",
            "o<frame_off> call",
            "M30",
        ]
    );
}

#[test]
fn offsets_and_machine_coordinates_take_the_frame_off_for_a_while() {
    let program = "\
TRANS X10
AROT Z30
T3 M6
G0 SUPA Z0 D0
G55
G18
G0 X1 Y2 Z3
M30
";
    assert_eq!(
        commands(&translate(program, &["--backend", "kinematics"])),
        [
            "o<frame_off> call",
            "o<trans> call [10] [0] [0]",
            "o<arot> call [0] [0] [30]",
            "o<frame_off> call",
            "T3 M6 G43",
            "G49",
            "o<frame_refresh> call",
            "G53 G0 Z0",
            "G55",
            "G18",
            "o<trans> call [10] [0] [0]",
            "o<arot> call [0] [0] [30]",
            "G0 X1 Y2 Z3",
            "o<frame_off> call",
            "M30",
        ]
    );
}

#[test]
fn the_feed_is_that_on_the_part_whatever_the_scale() {
    let program = "SCALE X2 Y2 Z2\nG0 X0 Y0 Z0\nG1 X10 F100\nG1 Y10\nSCALE\nG1 X0\nM30\n";
    assert_eq!(
        commands(&translate(program, &["--backend", "kinematics"])),
        [
            "o<frame_off> call",
            "o<scale> call [2] [2] [2]",
            "G0 X0 Y0 Z0",
            "G1 X10 F50",
            "G1 Y10",
            "o<frame_off> call",
            "G1 X0 Y20 Z0 F100",
            "M30",
        ]
    );
}

#[test]
fn mirrors_exchange_directions_and_sides() {
    let program = "\
MIRROR X0
G0 X40 Y10 Z5
G41 G1 Y0 F200
G2 X20 Y0 I-10 J0
G40 G1 X0
M30
";
    assert_eq!(
        commands(&translate(program, &["--backend", "program"])),
        [
            "G0 X-40 Y10 Z5",
            "G42 G1 Y0 F200",
            "G3 X-20 Y0 I10 J0",
            "G40 G1 X0",
            "M30",
        ]
    );
}

#[test]
fn unequal_scales_make_chords_within_the_tolerance() {
    let program = "SCALE X2\nG0 X10 Y0 Z0\nG3 X-10 Y0 I-10 F100\nM30\n";
    let output = translate(
        program,
        &["--backend", "program", "--chord-tolerance", "0.01"],
    );
    let points: Vec<(f64, f64)> = commands(&output)
        .iter()
        .filter(|line| line.starts_with("G1") || line.starts_with("G0"))
        .map(|line| {
            let value = |letter| {
                let word = line
                    .split(' ')
                    .find(|word| word.starts_with(letter))
                    .unwrap();
                word[1..].parse::<f64>().unwrap()
            };
            (value('X'), value('Y'))
        })
        .collect();
    assert!(points.len() > 10);
    for (x, y) in &points {
        assert!(((x / 20.0).powi(2) + (y / 10.0).powi(2) - 1.0).abs() < 1e-6);
    }
    for pair in points.windows(2) {
        // The ellipse is farthest from a chord in the middle of the parameter.
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let middle = ((y0 / 10.0).atan2(x0 / 20.0) + (y1 / 10.0).atan2(x1 / 20.0)) / 2.0;
        let (x, y) = (20.0 * middle.cos(), 10.0 * middle.sin());
        let (dx, dy) = (x1 - x0, y1 - y0);
        let off = ((x - x0) * dy - (y - y0) * dx).abs() / dx.hypot(dy);
        assert!(off <= 0.01, "{off}");
    }
    assert_eq!(points.last(), Some(&(-20.0, 0.0)));
}

#[test]
fn what_is_not_known_ahead_of_time_is_left_to_linuxcnc() {
    // No absolute coordinate is known at the start, nor after a tool change.
    let program = "G91 G0 X5\nG1 Y=IC(-2) F100\nG90 X7\nG91 X1\nM30\n";
    assert_eq!(
        commands(&translate(program, &[])),
        [
            "G0 X[#5420+5]",
            "G1 Y[#5421-2] F100",
            "G1 X7",
            "G1 X8",
            "M30"
        ]
    );
    let arc = "G2 G17 X10 Y0 I=AC(5) J=AC(0) F100\nM30\n";
    assert_eq!(
        commands(&translate(arc, &[]))[0],
        "G17 G2 X10 Y0 I[5-#5420] J[0-#5421] F100"
    );
    let radius = "G3 X10 Y0 CR=-8 F100\nM30\n";
    assert_eq!(commands(&translate(radius, &[]))[0], "G3 X10 Y0 R-8 F100");
}

#[test]
fn modes_speeds_and_stops_keep_their_meaning() {
    let program = "\
N5 G54 G17 G90 G94 G64
T12 M6 D1
S5000 M3 M8
G4 F2.5
G4 S500
G9 G1 X1 F200
G60
G59.2
G95 F0.1
M0
M1
M9 M5
M2
";
    assert_eq!(
        commands(&translate(program, &[])),
        [
            "G94 G17 G54 G64 P0.01",
            "T12 M6 G43",
            "S5000 M3 M8",
            "G4 P2.5",
            "G4 P6",
            "G61.1 G1 X1 F200",
            "G64 P0.01",
            "G61.1",
            "G59.2",
            "G95 F0.1",
            "M0",
            "M1",
            "M5 M9",
            "M2",
        ]
    );
}

#[test]
fn inches_are_converted() {
    let program = "G70\nTRANS X1\nG0 X1 Y2 Z0 A90\nG1 X0 F100\nG71\nG1 X0\nG700\nG1 X1 F10\nM30\n";
    assert_eq!(
        commands(&translate(program, &["--backend", "program"])),
        [
            "(MSG, line 4: G70 is for lengths only: F stays in millimetres, the unit of this machine; G700 is for both)",
            "G0 X50.8 Y50.8 Z0 A90",
            "G1 X25.4 F100",
            "G1 X25.4",
            "G1 X50.8 F254",
            "M30"
        ]
    );
}

#[test]
fn a_program_that_does_not_end_is_stopped_where_the_user_says() {
    let shop = Shop::new(&[("part.mpf", b"LOOP\nENDLOOP\nM30\n")]);
    let shown = refused(&shop.run("part.mpf", &["--most-blocks", "100"]));
    assert!(shown.contains("106 blocks have run"), "{shown}");
    assert!(shown.contains("--most-blocks"), "{shown}");
    let program = "R1=0\nAA: R1=R1+1\nIF R1<100 GOTOB AA\nM30\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &["--most-blocks", "50"]));
    accepted(&shop.run("part.mpf", &["--most-blocks", "250"]));
    for limit in ["0", "-1", "100000001", "many"] {
        let output = shop.run("part.mpf", &[&format!("--most-blocks={limit}")]);
        assert_eq!(output.status.code(), Some(2), "{limit}");
    }
}
