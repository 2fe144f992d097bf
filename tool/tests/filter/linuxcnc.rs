//! LinuxCNC's own interpreter reads what the filter writes.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::part_program::contour;
use framepath_tool::program::contour::{ContourMove, Shape};
use framepath_tool::program::trace::Setup;

/// Everything at once, in G17 so that both backends can do it.
const PROGRAM: &str = "\
N10 G17 G54 G64
T1 M6 D1
S1000 M3
G0 X0 Y0 Z10
TRANS X20 Y10
L10 P2
TRANS X55 Y35
AROT RPL=45
L10
MIRROR X0
ATRANS X10 Z1
L10
SCALE X2 Y2
ATRANS X2.5 Y18
L10
AROT Z30
AMIRROR Y0
L10
ASCALE
L10
TRANS
G0 Z50
M5
M30
%_N_L10_SPF
; a contour of lines, arcs and a helix
G0 X0 Y0 Z2
G1 Z-1 F100
G1 X10 F300
G3 X10 Y10 CR=5
G2 X0 Y10 Z-2 I-5 J0 TURN=1
G91 G1 Y-5
G90 Y0
G2 I-3 J0
M17
";

/// The canonical calls that LinuxCNC makes of a program.
fn interpret(shop: &Shop, program: &str) -> Vec<String> {
    rs274::interpret(&shop.path(""), "T1 P1 Z12.5 D6\n", program)
}

#[test]
fn both_backends_write_what_linuxcnc_accepts() {
    let shop = Shop::new(&[("part.mpf", PROGRAM.as_bytes())]);
    for backend in ["kinematics", "program"] {
        let output = accepted(&shop.run("part.mpf", &["--backend", backend]));
        let canon = interpret(&shop, &output);
        let arcs = canon
            .iter()
            .filter(|line| line.contains("ARC_FEED"))
            .count();
        // Three to a pass, seven passes.
        assert_eq!(arcs, 21, "{backend}");
    }
}

#[test]
fn every_subroutine_is_called_with_its_numbers() {
    let program = "TRANS X1 Y2 Z3\nATRANS X4\nROT X5\nAROT Y6\nROT RPL=7\nAROT RPL=8\nROTS X9 Y10\n\
                   AROTS Z11 X12\nAROTS Y13 Z14\nSCALE X15\nASCALE Y16\nASCALE\nMIRROR X0\n\
                   AMIRROR Y0\nG0 X1 Y1 Z1\nM30\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", &["--backend", "kinematics"]));
    let canon = interpret(&shop, &output);
    let called: Vec<&str> = canon
        .iter()
        .filter_map(|line| line.split_once("called ")?.1.split(' ').next())
        .collect();
    assert_eq!(
        called,
        [
            "frame_off",
            "trans",
            "atrans",
            "rot",
            "arot",
            "rot_rpl",
            "arot_rpl",
            "rots_xy",
            "arots_zx",
            "arots_yz",
            "scale",
            "ascale",
            "ascale_off",
            "mirror",
            "amirror",
            "frame_off",
        ]
    );
}

#[test]
fn coordinates_that_linuxcnc_works_out_are_understood() {
    let program = "G91 G0 X5 Z-1\nG90 G2 X10 Y0 I=AC(7.5) J=AC(0) F100\nG0 SUPA Z3 D1\nM30\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", &[]));
    let canon = interpret(&shop, &output);
    let arc = canon
        .iter()
        .find_map(|line| numbers(line, "ARC_FEED"))
        .expect("an arc");
    assert_eq!(arc[..4], [10.0, 0.0, 7.5, 0.0]);
}

/// Everything that a Fagor program has at once; LinuxCNC would take half of it for comments.
const FAGOR: &str = "\
%PIEZA,MX--,
T1 M6
G43
G90 G0 X0 Y0 Z10 S1000 M3
(P1=0)
N10 (P1=P1+1)
(CALL 1)
G11
G73 Q30 I5 J5
G72 S1.5
(CALL 1)
G10
G73
G72 S1
(RPT N20,N30) N2
(IF P1 LT 3 GOTO N10)
N20 G90 G0 X5 Y5
N30 G91 G1 X1 F200
G90
G93 I10 J10
G1 R5 Q0
G3 Q180
G9 X10 Y0 I8 J3
G8 X20 Y10
G36 R2 G1 X40
G39 R1 Y20
X0
G0 Z10
G99 G81 X5 Y5 Z2 I-3 K20
X15
G80
G92 X0
G0 X3
G54
G53 G0 Z0
M30
(SUB 1)
G90 G1 X10 Y0 Z-1 F100
G3 X10 Y10 R5
G2 X0 Y10 Z-2 I-5 J0
G91 G1 Y-5
G90 Y0
G2 I-3 J0
(RET)
";

#[test]
fn fagor_programs_are_read_as_they_are_meant() {
    let shop = Shop::new(&[("part.pim", FAGOR.as_bytes())]);
    for backend in ["kinematics", "program"] {
        let output = accepted(&shop.run_in("fagor", "part.pim", &["--backend", backend]));
        let canon = interpret(&shop, &output);
        let arcs = canon.iter().filter(|line| line.contains("ARC_FEED"));
        // Three to a call, six calls; the polar arc, that over three points, the tangent, the rounding.
        assert_eq!(arcs.count(), 22, "{backend}");
        assert!(
            canon.iter().any(|line| line.contains("DWELL(0.2")),
            "{backend}"
        );
    }
}

/// What LinuxCNC drives for the rewritten program is the contour, move for move.
#[test]
fn rewritten_moves_are_the_contour() {
    compare_with_contour(Dialect::Sinumerik, "part.mpf", PROGRAM);
    // Without offsets, which LinuxCNC's canonical calls leave out.
    let fagor = FAGOR.replace("G92 X0\n", "").replace("G53 G0 Z0\n", "");
    compare_with_contour(Dialect::Fagor, "part.pim", &fagor);
}

fn compare_with_contour(dialect: Dialect, name: &str, program: &str) {
    let shop = Shop::new(&[(name, program.as_bytes())]);
    let output = accepted(&shop.run_in(dialect.name(), name, &["--backend", "program"]));
    let canon = interpret(&shop, &output);
    let moves: Vec<ContourMove> = contour(
        dialect,
        &shop.path(name),
        &Settings::default(),
        &Setup::default(),
    )
    .expect("a contour");
    let mut moves = moves.iter();
    let mut compared = 0;
    for line in &canon {
        let straight = numbers(line, "STRAIGHT_TRAVERSE").or(numbers(line, "STRAIGHT_FEED"));
        if let Some(end) = straight {
            let expected = moves.next().expect("as many moves");
            let Shape::Line {
                end: contour_end, ..
            } = expected.shape
            else {
                panic!("a line where the contour has an arc");
            };
            for axis in 0..3 {
                assert!(
                    (end[axis] - contour_end[axis]).abs() < 1e-4,
                    "{line} {expected:?}"
                );
            }
            assert_eq!(expected.rapid, line.contains("TRAVERSE"));
            compared += 1;
        } else if let Some(arc) = numbers(line, "ARC_FEED") {
            let expected = moves.next().expect("as many moves");
            let Shape::Arc { centre, sweep, .. } = expected.shape else {
                panic!("an arc where the contour has a line");
            };
            let end = expected.shape.point(1.0);
            // end X, end Y, centre X, centre Y, turns with sign, end Z
            let given = [arc[0], arc[1], arc[2], arc[3], arc[5]];
            let wanted = [end[0], end[1], centre[0], centre[1], end[2]];
            for (given, wanted) in given.iter().zip(wanted) {
                assert!((given - wanted).abs() < 1e-4, "{line} {expected:?}");
            }
            let turns = (sweep / std::f64::consts::TAU - 1e-9).ceil();
            assert_eq!(arc[4].abs(), turns, "{line} {expected:?}");
            compared += 1;
        }
    }
    assert!(compared > 50, "only {compared} moves were compared");
    assert_eq!(moves.next(), None);
}
