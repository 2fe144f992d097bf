//! Pockets and slots: the same moves as in plain LinuxCNC code, in frames too, and what is refused.

use crate::pairs::{ARGUMENTS, assert_pair, shop};
use crate::shop::refused;

const HEAD: &str = "T1 M6\nG17 G90 G0 X0 Y0 Z20\nS500 M3 F50\n";
const PLAIN_HEAD: &str = "G21 G17 G90 T1 M6 G43\nG0 X0 Y0 Z20\nS500 M3 F50\n";

fn same(cycle: &str, plain: &str) {
    assert_pair(
        &format!("{HEAD}{cycle}\nG1 Z12\nM30\n"),
        &format!("{PLAIN_HEAD}{plain}\nF50 G1 Z12\nM2\n"),
    );
}

/// A round pocket of radius 10 at (20, 10), 4 deep, in rounds of 3 and 6.
fn round_pocket(x: f64, way: &str) -> String {
    let sign = x.signum();
    let rounds = format!(
        "F300 G1 X{}\n{way} I{}\nG1 X{}\n{way} I{}\n",
        x + 3. * sign,
        -3. * sign,
        x + 6. * sign,
        -6. * sign
    );
    format!(
        "G0 X{x} Y10\nG0 Z10\nG0 Z2\nF100 G1 Z-2\n{rounds}G0 Z0\nG0 X{x} Y10\nF100 G1 Z-4\n{rounds}G0 Z10"
    )
}

#[test]
fn round_pockets_are_cleared_from_the_middle() {
    for (values, way) in [
        ("3,11,3", "G3"),
        ("2,11,3", "G2"),
        // M3 climbs with the material on the right.
        ("0,11,3", "G3"),
        ("1,11,3", "G2"),
        ("3,11,50,0,0,0,0,0,0,0,1000,1,12", "G3"),
        ("3,11,3,0,0,0,0,0,0,0,10000,0,0", "G3"),
    ] {
        let cycle = format!("POCKET4(10,0,2,-4,10,20,10,2,1,0,300,100,{values})");
        same(&cycle, &round_pocket(20., way));
    }
    let deep = "POCKET4(10,0,2,4,10,20,10,2,1,0,300,100,3,11,3,0,0,0,0,0,0,0,0,0,1)";
    same(deep, &round_pocket(20., "G3"));
    // An allowance at the floor, and straight down in rapid motion.
    let rough = round_pocket(20., "G3")
        .replace("F100 G1 Z-2", "G0 Z-1.5")
        .replace("F100 G1 Z-4", "G0 Z-3")
        .replace("G0 Z0\n", "G0 Z0.5\n");
    same("POCKET4(10,0,2,-4,10,20,10,2,1,1,300,100,3,1,3)", &rough);
}

#[test]
fn pockets_follow_the_frame() {
    let cycle = "POCKET4(10,0,2,-4,10,20,10,2,1,0,300,100,3,11,3)";
    assert_pair(
        &format!("{HEAD}MIRROR X0\n{cycle}\nM30\n"),
        &format!("{PLAIN_HEAD}{}\nM2\n", round_pocket(-20., "G2")),
    );
    assert_pair(
        &format!("{HEAD}TRANS X15 Y8\nPOCKET4(10,0,2,-4,10,5,2,2,1,0,300,100,3,11,3)\nM30\n"),
        &format!("{PLAIN_HEAD}{}\nM2\n", round_pocket(20., "G3")),
    );
}

const RECTANGLE: &str = "F300 G1 X4\nX-4\nX4\nX7\nY2\nG3 X6 Y3 I-1 J0\nG1 X-6\nG3 X-7 Y2 I0 J-1\n\
                         G1 Y-2\nG3 X-6 Y-3 I1 J0\nG1 X6\nG3 X7 Y-2 I0 J1\nG1 Y0\n";

#[test]
fn rectangular_pockets_keep_their_corners() {
    same(
        "POCKET3(10,0,2,-2,20,12,4,0,0,0,0,0,0,300,100,3,11)",
        &format!("G0 Z10\nG0 Z2\nF100 G1 Z-2\n{RECTANGLE}G0 Z10"),
    );
    // Turned by 90 degrees, and corners sharper than the tool.
    same(
        "POCKET3(10,0,2,-2,20,12,1,0,0,90,5,0,0,300,100,3,11)",
        "G0 Z10\nG0 Z2\nF100 G1 Z-2\nF300 G1 Y4\nY-4\nY4\nY7\nX-3\nY-7\nX3\nY7\nX0\nG0 Z10",
    );
    // The wall alone: onto it and off it on a quarter of a circle, then on the next floor.
    let round = "G3 X7 Y0 I0 J2\nG1 Y2\nG3 X6 Y3 I-1 J0\nG1 X-6\nG3 X-7 Y2 I0 J-1\n\
                 G1 Y-2\nG3 X-6 Y-3 I1 J0\nG1 X6\nG3 X7 Y-2 I0 J1\nG1 Y0\nG3 X5 Y2 I-2 J0\n";
    same(
        "POCKET3(10,0,2,-2,20,12,4,0,0,0,1,0.5,0,300,100,3,14)",
        &format!(
            "G0 X5 Y-2\nG0 Z10\nG0 Z2\nF100 G1 Z-1\nF300 {round}G1 X5 Y-2\nF100 G1 Z-2\nF300 {round}\
             G0 Z2\nG0 Z10"
        ),
    );
    same(
        "POCKET3(10,0,2,-2,20,12,4,0,0,0,0,0.5,0.5,300,100,3,12)",
        &format!(
            "G0 X5 Y-2\nG0 Z10\nG0 Z2\nF100 G1 Z-2\nF300 {round}G0 Z2\nG0 Z10\nG0 X0 Y0\nG0 Z2\n\
             F100 G1 Z-2\n{RECTANGLE}G0 Z10"
        ),
    );
}

#[test]
fn slots_on_a_circle() {
    same(
        "LONGHOLE(10,0,2,-4,,2,16,0,0,10,0,90,100,300,2)",
        "G0 X13 Y0\nG0 Z10\nG0 Z2\nF100 G1 Z-2\nF300 G1 X23\nF100 G1 Z-4\nF300 G1 X13\nG0 Z10\n\
         G0 X0 Y13\nG0 Z2\nF100 G1 Z-2\nF300 G1 Y23\nF100 G1 Z-4\nF300 G1 Y13\nG0 Z10",
    );
    let rough = "G0 X20 Y0\nG0 Z10\nG0 Z2\nF100 G1 Z-2\nF300 G1 X25\nX15\nX25\nX26.5\n\
                 G3 X25 Y1.5 I-1.5 J0\nG1 X15\nG3 X13.5 Y0 I0 J-1.5\nG3 X15 Y-1.5 I1.5 J0\n\
                 G1 X25\nG3 X26.5 Y0 I0 J1.5\n";
    same(
        "SLOT1(10,0,2,-2,,1,20,10,0,0,10,0,0,100,300,0,3,0.5,11)",
        &format!("{rough}G0 Z10"),
    );
    let fine = "G0 Z2\nG0 Z10\nG0 X25 Y0\nG0 Z2\nF100 G1 Z-2\nF200 G1 X27\n\
                G3 X25 Y2 I-2 J0\nG1 X15\nG3 X13 Y0 I0 J-2\nG3 X15 Y-2 I2 J0\nG1 X25\nG3 X27 Y0 I0 J2\n";
    same(
        "SLOT1(10,0,2,,2,1,20,10,0,0,10,0,0,100,300,0,3,0.5,10,0,200,800)",
        &format!("{rough}{fine}G0 Z10"),
    );
}

#[test]
fn what_is_not_milled_is_refused_by_its_name() {
    let pocket = "POCKET4(10,0,2,-4,10,20,10,2,1,0,300,100,3";
    for (cycle, words) in [
        (format!("{pocket},21,3)"), "a helix is not translated"),
        (format!("{pocket},31,3)"), "to and fro is not translated"),
        (format!("{pocket},15,3)"), "_VARI = 15 of POCKET4"),
        (format!("{pocket},111,3)"), "_VARI = 111 of POCKET4"),
        (format!("{pocket},11,3,4)"), "_AP1 = 4 of POCKET4"),
        (
            format!("{pocket},11,3,0,0,0,0,0,0,0,2000)"),
            "_GMODE = 2000 of POCKET4",
        ),
        (
            "POCKET4(10,0,2,-4,2.5,0,0,2,0,0,300,100,3,11)".into(),
            "does not fit here",
        ),
        (
            "POCKET4(10,0,2,-4,10,0,0,2,8,0,300,100,3,11)".into(),
            "does not fit here",
        ),
        (
            "POCKET4(10,0,2,-4,10,0,0,2,0,5,300,100,3,11)".into(),
            "_FALD = 5 of POCKET4",
        ),
        (
            "POCKET4(10,0,2,-4,10,0,0,2,0,0,300,100,4,11)".into(),
            "_CDIR = 4 of POCKET4",
        ),
        (
            "POCKET4(10,0,2,4,10,0,0,2,0,0,300,100,3,11)".into(),
            "not in the order",
        ),
        (
            "POCKET4(10,0,2,-4,10,0,0,0.0000001,0,0,300,100,3,11)".into(),
            "too many layers",
        ),
        ("POCKET3(10,0,2,-4)".into(), "POCKET3 needs _LENG"),
        (
            "LONGHOLE(10,0,2,-4,,2,5,0,0,10)".into(),
            "does not fit here",
        ),
        (
            "LONGHOLE(10,0,2,-4,,0,16,0,0,10)".into(),
            "NUM = 0 of LONGHOLE",
        ),
        ("SLOT1(10,0,2,-4,,1,8,10)".into(), "WID = 10 of SLOT1"),
        (
            "SLOT1(10,0,2,-4,,1,20,10,0,0,10,0,0,1,1,0,3,0,21)".into(),
            "VARI = 21 of SLOT1",
        ),
        ("MCALL POCKET4(10,0,2,-4,10)".into(), "as a modal cycle"),
        (
            "SLOT2(10,0,2,-4)".into(),
            "the cycle SLOT2 is not supported",
        ),
        (
            "G41 G1 X5\nPOCKET4(10,0,2,-4,10)".into(),
            "a milling cycle while",
        ),
        (
            "T2 M6\nPOCKET4(10,0,2,-4,10)".into(),
            "needs the diameter of T2",
        ),
    ] {
        let shown = refused(&shop(&format!("{HEAD}{cycle}\nM30\n")).run("part.mpf", &ARGUMENTS));
        assert!(shown.contains(words), "{cycle}\n{shown}");
    }
}

/// A corner of a part, from left to right and up, with the approach and the retraction given.
fn contour(cycle: &str) -> String {
    format!(
        "%_N_PART_MPF\n{HEAD}{cycle}\nG1 Z12\nM30\n%_N_CORNER_SPF\nG0 X20 Y10\nG1 X40\nG3 X45 Y15 I0 J5\nG1 Y30\nM17\n"
    )
}

#[test]
fn contours_are_milled_in_layers() {
    let pair = |cycle: &str, plain: &str| {
        assert_pair(
            &contour(cycle),
            &format!("{PLAIN_HEAD}{plain}\nG0 Z10\nF50 G1 Z12\nM2\n"),
        );
    };
    // Climbing: 3 and the allowance of 1 come to the radius of the approach, the tool to the left.
    let layer = "G41.1 D8 G1 X11 Y19\nG3 X20 Y10 I9 J0\nG1 X40\nG3 X45 Y15 I0 J5\nG1 Y30\n\
                 G3 X36 Y39 I-9 J0\nG40 G1 X31.6 Y39\n";
    pair(
        "CYCLE72(\"CORNER\",10,0,2,-4,2,1,0,300,100,11,41,2,5,0,2,5)",
        &format!(
            "G0 X11 Y23.4\nG0 Z10\nG0 Z2\nF100 G1 Z-2\nF300 {layer}G0 Z10\nG1 X11 Y23.4\nF100 G1 Z-4\nF300 {layer}"
        ),
    );
    let fine = "G41 G1 X12 Y10\nG1 X20 Y10\nG1 X40\nG3 X45 Y15 I0 J5\nG1 Y30\nG3 X29 Y30 I-8 J0\n\
                G40 G1 X29 Y26.7\n";
    pair(
        "CYCLE72(\"corner.spf\",10,0,2,-4,0,1,1,300,100,2,41,1,5,0,3,5)",
        &format!("G0 X8.7 Y10\nG0 Z10\nG0 Z2\nF100 G1 Z-4\nF300 {fine}"),
    );
    // On the contour, with an allowance at the floor, and in rapid motion from layer to layer.
    let middle = "G1 X20\nX40\nG3 X45 Y15 I0 J5\nG1 Y30\nY32\n";
    pair(
        "CYCLE72(\"CORNER\",10,0,2,-4,2,0,1,300,100,201,40,1,5,0,1,2)",
        &format!(
            "G0 X15 Y10\nG0 Z10\nG0 Z2\nF100 G1 Z-1.5\nF300 {middle}G0 Z0.5\nG0 X15 Y10\n\
             F100 G1 Z-3\nF300 {middle}"
        ),
    );
}

#[test]
fn a_contour_may_stand_between_labels_or_block_numbers_of_the_program() {
    let blocks = "G0 X20 Y10\nG1 X40\nG3 X45 Y15 I0 J5\n";
    for (name, begin, end) in [
        ("CORNER:CORNER_E", "CORNER:", "G1 Y30\nCORNER_E:"),
        ("corner:corner_e", "CORNER:", "CORNER_E: G1 Y30"),
        ("N100:N200", "N100", "N200 G1 Y30"),
    ] {
        let cycle = format!("CYCLE72(\"{name}\",10,0,2,-4,0,0,0,300,100,2,41,1,5,0,1,5)");
        let plain = format!(
            "{PLAIN_HEAD}G0 X8.7 Y10\nG0 Z10\nG0 Z2\nF100 G1 Z-4\nF300 G41 G1 X12 Y10\nX20\nX40\nG3 X45 Y15 I0 J5\n\
             G1 Y30\nY38\nG40 G1 Y41.3\nG0 Z10\nF50 G1 Z12\nM2\n"
        );
        let behind = format!("{HEAD}{cycle}\nG1 Z12\nM30\n{begin}\n{blocks}{end}\n");
        assert_pair(&behind, &plain);
        // Passed over before.
        let before = format!("GOTOF GO\n{begin}\n{blocks}{end}\nGO:\n{HEAD}{cycle}\nG1 Z12\nM30\n");
        assert_pair(&before, &plain);
    }
}

#[test]
fn contours_follow_a_mirror() {
    assert_pair(
        &contour("MIRROR X0\nCYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,41,1,5,0,1,5)"),
        &format!(
            "{PLAIN_HEAD}G0 X-8.7 Y10\nG0 Z10\nG0 Z2\nF100 G1 Z-4\nF300 G42 G1 X-12\nX-20\nX-40\n\
             G2 X-45 Y15 I0 J5\nG1 Y30\nY38\nG40 G1 Y41.3\nG0 Z10\nF50 G1 Z12\nM2\n"
        ),
    );
}

#[test]
fn what_is_not_a_contour_is_refused() {
    for (cycle, words) in [
        ("CYCLE72(,10,0,2,-4)", "_RL = 0 of CYCLE72"),
        ("CYCLE72(,10,0,2,-4,0,0,0,300,100,2,41)", "needs _KNAME"),
        (
            "CYCLE72(\"A:B\",10,0,2,-4,0,0,0,300,100,2,41)",
            "there is no contour from A to B in this program",
        ),
        (
            "HERE: CYCLE72(\"HERE:HERE\",10,0,2,-4,0,0,0,300,100,2,41,1,5)",
            "this cycle is among the blocks of its contour",
        ),
        (
            "CYCLE72(\"CORNER:A:B\",10,0,2,-4,0,0,0,300,100,2,41)",
            "_KNAME = \"CORNER:A:B\"",
        ),
        ("CYCLE72(\"NONE\",10,0,2,-4,0,0,0,300,100,2,41)", "NONE"),
        (
            "CYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,5,41)",
            "_VARI = 5",
        ),
        (
            "CYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,41,12,5)",
            "_AS1 = 12",
        ),
        (
            "CYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,40,2,5)",
            "_AS1 = 2",
        ),
        (
            "CYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,41,2,0)",
            "_LP1 = 0",
        ),
        (
            "CYCLE72(\"CORNER\",10,0,2,-4,0,0,5,300,100,1,41,2,5)",
            "_FALD = 5",
        ),
    ] {
        let shown = refused(&shop(&contour(cycle)).run("part.mpf", &ARGUMENTS));
        assert!(shown.contains(words), "{cycle}\n{shown}");
    }
    // LinuxCNC compensates in two planes only.
    let upright = contour("G19\nCYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,41,1,5,0,1,5)")
        .replace("G0 X20 Y10", "G0 Y20 Z10")
        .replace("G1 X40\nG3 X45 Y15 I0 J5\nG1 Y30", "G1 Y40\nZ30");
    let shown = refused(&shop(&upright).run("part.mpf", &ARGUMENTS));
    assert!(shown.contains("in the plane of G19"), "{shown}");
    for blocks in ["G1 X5 Z3", "S100 G1 X5", "G0 X5 Y5", ""] {
        let program = contour("CYCLE72(\"CORNER\",10,0,2,-4,0,0,0,300,100,2,41,1,5,0,1,5)")
            .replace("G1 Y30", blocks)
            .replace(
                "G1 X40\nG3 X45 Y15 I0 J5\n",
                if blocks.is_empty() { "" } else { "G1 X40\n" },
            );
        let shown = refused(&shop(&program).run("part.mpf", &ARGUMENTS));
        assert!(shown.contains("is not a contour"), "{blocks}\n{shown}");
    }
}
