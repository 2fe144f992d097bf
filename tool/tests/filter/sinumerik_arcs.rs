//! Arcs outside of the plane that is active, helices, and the first words of a motion: against paths
//! written down by hand, and against plain LinuxCNC code.

use crate::expected::Path;
use crate::pairs::assert_pair;
use crate::shop::{Shop, accepted, commands, refused, translate};
use framepath_tool::dialects::Dialect;

const ZX: [usize; 2] = [2, 0];
const YZ: [usize; 2] = [1, 2];

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Sinumerik, &[("part.mpf", program)], program);
}

fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &["--backend", "program"]))
}

/// The lead-ins that CAM posts write in G17, in every frame that keeps the tool upright.
#[test]
fn arcs_lie_in_the_plane_of_their_words() {
    let start = Path::from([10., 5., 1.]).feed(300.);
    // Seen from +Y, with Z to the right and X up.
    let clockwise = start.arc_in(ZX, [11., 5., 0.], [1., 11.], true);
    for arc in [
        "G2 X11 Z0 I1 K0",
        "G2 X11 Z0 I1",
        "G2 X11 Z0 I1 J0 K0",
        "G2 X11 Y5 Z0 I1 K0",
        "G2 X11 Z0 I=AC(11) K=AC(1)",
        "G91 G2 X1 Z-1 I1 K0",
        "G2 X11 Z0 CR=1",
    ] {
        let program = format!("G17 G0 X10 Y5 Z1\nF300\n{arc}\nM30\n");
        check(&program, &clockwise);
    }
    let program = "G17 G0 X3 Y0 Z0\nF100\nG3 Y2 Z2 J0 K2\nG1 X9\nG2 X10 Y3 I1 J0\nM30\n";
    let expected = Path::from([3., 0., 0.])
        .feed(100.)
        .arc_in(YZ, [3., 2., 2.], [0., 2.], false)
        .lines(&[(9., 2.)])
        .cw([10., 3., 2.], (10., 2.));
    check(program, &expected);
}

/// Mirrored in one axis of the arc, G2 becomes G3.
#[test]
fn arcs_in_another_plane_follow_the_frame() {
    let arc = "G17 G0 X10 Y5 Z1\nF300\nG2 X11 Z0 I1 K0\nM30\n";
    let mirrored = Path::from([0., 0., 0.])
        .rapid([-10., 5., 1.])
        .feed(300.)
        .arc_in(ZX, [-11., 5., 0.], [1., -11.], false);
    check(&format!("G0 X0 Y0 Z0\nMIRROR X0\n{arc}"), &mirrored);
    let across = Path::from([0., 0., 0.])
        .rapid([10., -5., 1.])
        .feed(300.)
        .arc_in(ZX, [11., -5., 0.], [1., 11.], true);
    check(&format!("G0 X0 Y0 Z0\nMIRROR Y0\n{arc}"), &across);
    let shifted = Path::from([0., 0., 0.])
        .rapid([20., 10., 3.])
        .feed(300.)
        .arc_in(ZX, [22., 10., 1.], [3., 22.], true);
    check(
        &format!("G0 X0 Y0 Z0\nTRANS Z1\nASCALE X2 Y2 Z2\n{arc}"),
        &shifted,
    );
    // A turn about Z tilts the plane of the arc: that is for the frame kinematics.
    let turned = format!("G0 X0 Y0 Z0\nROT RPL=30\n{arc}");
    let shop = Shop::new(&[("part.mpf", turned.as_bytes())]);
    let written = accepted(&shop.run("part.mpf", &["--backend", "kinematics"]));
    assert!(written.contains("G18 G2 X11 Z0 I1 K0"), "{written}");
    assert!(refused(&shop.run("part.mpf", &["--backend", "program"])).contains("tilts"));
}

/// A post of a CAM system: ramp in, contour, ramp out.
#[test]
fn a_lead_in_and_a_lead_out_are_those_of_plain_code() {
    assert_pair(
        "G17 G90\nG0 X-29 Y3 Z2\nG1 Z-.4 F100\nG2 X-28.4 Z-1 I0.6 K0\nG1 X10 F400\nG3 X15 Y8 I0 J5\n\
         G2 Y8.6 Z-.4 J0 K0.6\nG0 Z10\nM30\n",
        "G21 G17 G90\nG0 X-29 Y3 Z2\nG1 Z-.4 F100\nG18 G2 X-28.4 Z-1 I0.6 K0\nG17 G1 X10 F400\n\
         G3 X15 Y8 I0 J5\nG19 G2 Y8.6 Z-.4 J0 K0.6\nG17 G0 Z10\nM2\n",
    );
}

#[test]
fn the_rise_of_a_helix_says_nothing_new() {
    let helix =
        |words: &str| format!("G17 G0 X10 Y0 Z0\nF200\nG3 X10 Y0 Z-5 I-10 J0 {words}\nM30\n");
    let plain = "G21 G17 G0 X10 Y0 Z0\nF200\nG3 X10 Y0 Z-5 I-10 J0\nM2\n";
    for words in ["", "K0", "K5", "K-5", "K=AC(-5)", "TURN=0 K5"] {
        assert_pair(&helix(words), plain);
    }
    assert_pair(
        &helix("TURN=4 K1"),
        "G21 G17 G0 X10 Y0 Z0\nF200\nG3 X10 Y0 Z-5 I-10 J0 P5\nM2\n",
    );
    let shown = errors(&helix("K1"));
    assert!(shown.contains("is not the rise of its helix"), "{shown}");
    assert!(shown.contains("TURN="), "{shown}");
}

#[test]
fn another_plane_is_refused_under_compensation() {
    let shown = errors("G17 G0 X0 Y0 Z1\nG41 G1 X10 F100\nG2 X11 Z0 I1 K0\nM30\n");
    assert!(shown.contains("an arc in another plane"), "{shown}");
}

#[test]
fn an_edge_that_is_chosen_already_may_stand_beside_the_compensation() {
    let written = |program: &str| commands(&translate(program, &["--backend", "program"]));
    assert_eq!(
        written("T1 M6\nD1\nG0 X0 Y0 Z5\nG1 G41 D1 X20 Y20 F100\nX40\nG1 G40 D1 X50\nM30\n"),
        [
            "T1 M6 G43",
            "G43",
            "G0 X0 Y0 Z5",
            "G41 G1 X20 Y20 F100",
            "G1 X40",
            "G40 G1 X50",
            "M30"
        ]
    );
    assert_eq!(
        written("T1 M6\nG0 D0\nG0 X0 Y0 Z5\nG1 G42 D1 X20 Y20 F100\nG40 X0\nM30\n"),
        [
            "T1 M6 G43",
            "G49",
            "G0 X0 Y0 Z5",
            "F100 G43",
            "G42 G1 X20 Y20",
            "G40 G1 X0",
            "M30"
        ]
    );
    let shown = errors("T1 M6\nG0 X0 Y0\nG41 G1 X5 F100\nD0 X9\nM30\n");
    assert!(shown.contains("the tool offset changes while"), "{shown}");
}

#[test]
fn the_first_rotary_move_goes_to_its_angle() {
    let shop = Shop::new(&[("part.mpf", b"G0 A0 C=DC(30)\nG0 C=DC(350)\nM30\n")]);
    let output = shop.run("part.mpf", &["--backend", "program"]);
    assert_eq!(
        commands(&accepted(&output)),
        [
            "(MSG, line 1: where C is, is not known ahead of time: it goes to 30 as LinuxCNC counts its turns)",
            "G0 A0 C30",
            "G0 C-10",
            "M30"
        ]
    );
    for program in ["G0 C=ACP(30)\nM30\n", "G1 C=DC(30) F100\nM30\n"] {
        assert!(errors(program).contains("which way this axis turns"));
    }
}

/// CIP and CT are modes as G1 is: they hold from a block on in which nothing moves.
#[test]
fn tangent_arcs_and_arcs_over_a_point_hold() {
    let begin = "G0 X0 Y0 Z0\nG1 X10 F100\n";
    for (alone, beside) in [
        ("CT\nX20 Y10\nX30 Y0", "CT X20 Y10\nCT X30 Y0"),
        ("CIP\nX30 Y0 I1=20 J1=10", "CIP X30 Y0 I1=20 J1=10"),
        ("CIP F50\nCT\nX20 Y10\nG1 X30", "F50\nCT X20 Y10\nG1 X30"),
    ] {
        let of = |form: &str| commands(&translate(&format!("{begin}{form}\nM30\n"), &[]));
        let ends = |form: &str| of(form).join(" ").replace("F50 ", "").replace(" F50", "");
        assert_eq!(ends(alone), ends(beside), "{alone}");
        assert!(ends(alone).contains("G2") || ends(alone).contains("G3"));
    }
    for (program, place, words) in [
        ("G1 CT X20 Y10", "3:4", "G1 and CT exclude each other"),
        ("CIP CT X20 Y10", "3:5", "CIP and CT exclude each other"),
        ("G1 I1=3", "3:4", "belong to CIP"),
        ("CT\nG53 X20", "4:1", "only G0 and G1 can move in machine"),
        (
            "G500\nCT X20 Y10",
            "4:4",
            "an arc while the work offset is off",
        ),
        (
            "G500\nG1 X20 AR=30",
            "4:8",
            "an arc while the work offset is off",
        ),
    ] {
        let shop = Shop::new(&[("part.mpf", format!("{begin}{program}\nM30\n").as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains(words), "{program}\n{shown}");
        assert!(
            shown.contains(&format!("part.mpf:{place}")),
            "{program}\n{shown}"
        );
    }
}

/// Behind DC, ACP or ACN an angle lies in the turn in which the axis is: nothing is unwound.
#[test]
fn angles_stay_in_the_turn_of_the_axis() {
    let written = |program: &str| commands(&translate(program, &["--backend", "program"]));
    let program = "G0 X0 C350\nG1 X10 C=DC(10) F9\nX20 C20\nC=AC(0)\nC=ACN(350)\nC20\nC=IC(5)\nC=ACP(0)\nC7\nM30\n";
    assert_eq!(
        written(program),
        [
            "G0 X0 C350",
            "G1 X10 C370 F9",
            "G1 X20 C380",
            "G1 C360",
            "G1 C350",
            "G1 C20",
            "G1 C25",
            "G1 C360",
            "G1 C367",
            "M30",
        ]
    );
    // An axis that has not been programmed so keeps what is written, and so does a shift.
    assert_eq!(
        written("G0 A350 C350\nC=DC(10)\nA20\nG52 C20\nC=AC(30)\nM30\n")[..5],
        [
            "(MSG, line 5: where C is, is not known ahead of time: it goes to 30 as LinuxCNC counts its turns)",
            "G0 A350 C350",
            "G0 C370",
            "G0 A20",
            "G52 C20"
        ]
    );
    for (block, words) in [
        ("C-10", "counts within one turn"),
        ("C=AC(400)", "counts within one turn"),
        ("T1 M6\nG1 C20 F9", "which way this axis turns is not known"),
    ] {
        let program = format!("G0 C350\nC=DC(10)\n{block}\nM30\n");
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains(words), "{block}\n{shown}");
    }
}
