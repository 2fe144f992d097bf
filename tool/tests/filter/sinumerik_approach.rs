//! Smooth approach and retraction, against plain LinuxCNC code with the same geometry.

use crate::pairs::{ARGUMENTS, assert_pair, shop};
use crate::shop::refused;

const HEAD: &str = "T1 M6\nG17 G90 G0 X0 Y0 Z5\nF300\n";
const PLAIN_HEAD: &str = "G21 G17 G90 T1 M6 G43\nG0 X0 Y0 Z5\nF300\n";

fn same(blocks: &str, plain: &str) {
    assert_pair(
        &format!("{HEAD}{blocks}\nM30\n"),
        &format!("{PLAIN_HEAD}{plain}\nM2\n"),
    );
}

#[test]
fn the_tool_comes_along_a_tangent_arc_or_line() {
    let down = "G0 Z1\nF100 G1 Z-2\nF300";
    for (block, way) in [
        (
            "G247 G341 G141",
            format!("G0 X15 Y15\n{down} G3 X20 Y10 I5 J0"),
        ),
        (
            "G247 G341 G142",
            format!("G0 X15 Y5\n{down} G2 X20 Y10 I5 J0"),
        ),
        (
            "G347 G341 G141",
            format!("G0 X20 Y20\n{down} G3 X20 Y10 I0 J-5"),
        ),
        (
            "G347 G341 G142",
            format!("G0 X20 Y0\n{down} G2 X20 Y10 I0 J5"),
        ),
        ("G147 G341 G141", format!("G0 X15 Y10\n{down} G1 X20 Y10")),
        (
            "G247 G141",
            "G0 X15 Y15\nG0 Z1\nF100 G3 X20 Y10 Z-2 I5 J0\nF300".to_string(),
        ),
    ] {
        for (words, contour) in [
            ("X20 Y10 Z-2 DISCL=3", ""),
            ("X20 Y10 Z-2 DISCL=AC(1)", ""),
            // The place where the contour begins stands in the next block.
            ("Z-2 DISCL=3", "X20 Y10\n"),
        ] {
            same(
                &format!("G1 {block} DISR=5 {words} FAD=100\n{contour}X40\nY20"),
                &format!("{way}\nG1 X40\nY20"),
            );
        }
    }
    // Without an infeed the way is slow too.
    same(
        "G1 G147 G141 DISR=5 X20 Y10 FAD=100\nX40",
        "G0 X15 Y10\nF100 G1 X20 Y10\nF300 X40",
    );
    // An arc behind it; the plane of the tool alone.
    same(
        "G1 G247 G141 DISR=5 X20 Y10\nG3 X30 Y20 I0 J10",
        "G1 X15 Y15\nG3 X20 Y10 I5 J0\nG3 X30 Y20 I0 J10",
    );
}

#[test]
fn the_tool_leaves_on_its_side() {
    let cut = "G1 X20 Y10\nX40\n";
    for (block, way) in [
        ("G248 G141", "G3 X45 Y15 I0 J5"),
        ("G248 G142", "G2 X45 Y5 I0 J-5"),
        ("G348 G141", "G3 X40 Y20 I0 J5"),
        ("G148 G142", "G1 X45 Y10"),
    ] {
        same(
            &format!("{cut}G341 G0 {block} DISR=5 DISCL=3 X0 Y0 Z20"),
            &format!("{cut}{way}\nG1 Z8\nG0 Z20\nG0 X0 Y0"),
        );
    }
    same(
        &format!("{cut}G248 G141 DISR=5 DISCL=3 Z20"),
        &format!("{cut}G3 X45 Y15 Z8 I0 J5\nG1 Z20"),
    );
}

/// DISR is the radius of the way of the tool's middle: that of the tool, 3, comes to what is programmed.
#[test]
fn compensation_counts_the_radius_of_the_tool() {
    same(
        "G0 X12 Y40\nG1 G41 G247 DISR=5 X20 Y10\nX40\nY30\nG40 G248 DISR=5 X0 Y40",
        "G0 X12 Y40\nG41 G1 X12 Y18\nG3 X20 Y10 I8 J0\nG1 X40\nY30\nG3 X32 Y38 I-8 J0\nG40 G1 X0 Y40",
    );
    same(
        "G0 X-20 Y10\nG1 G42 KONT G147 DISR=5 X20 Y10\nX40\nY-30\nG40 G148 DISR=5 X0 Y-40",
        "G0 X-20 Y10\nG42 G1 X12 Y10\nG1 X20 Y10\nG1 X40\nY-30\nG1 X40 Y-38\nG40 G1 X0 Y-40",
    );
}

#[test]
fn what_is_missing_is_named() {
    for (blocks, words) in [
        ("G1 G247 G141 X20 Y10\nX40", "without DISR"),
        ("G1 G247 DISR=5 X20 Y10\nX40", "from which side"),
        ("G1 G247 G141 DISR=5 X20 Y10", "no contour follows"),
        ("G1 G247 G141 DISR=5\nX20 Y10", "no contour follows"),
        ("G1 G247 G141 DISR=5 X20\nX40", ""),
        ("G1 G247 G141 DISR=-5 X20 Y10\nX40", "DISR must be above 0"),
        ("G2 G247 G141 DISR=5 X20 Y10\nX40", "beside an arc"),
        ("G1 X5 DISR=5", "DISR belongs to"),
        ("G0 G248 G141 DISR=5 X0", "how the contour ends"),
        (
            "G1 G247 G141 G341 DISR=5 X20 Y10 Z-2 DISCL=-3\nX40",
            "below the depth",
        ),
        ("G1 G247 G143 DISR=5 X20 Y10\nX40", "G143 is not supported"),
        (
            "G1 X20 Y10\nX40\nG248 G141 DISR=5 DISCL=3 FAD=100 Z20",
            "FAD in a retraction with G340",
        ),
        (
            "G1 G41 G147 DISR=5 X20 Y10\nX40",
            "does not come to from its side",
        ),
        (
            "G93\nG0 G41 G247 DISR=10 X20 Y10\nG1 X40 F2",
            "a smooth approach with feed in inverse time",
        ),
        (
            "G93\nG1 X40 F2\nG248 G141 DISR=10 X60 Y10 F2",
            "a smooth retraction with feed in inverse time",
        ),
    ] {
        let program = format!("T1 M6\nG17 G90 G0 Z5\nF300\nG0 X0 Y0\n{blocks}\nM30\n");
        let shown = refused(&shop(&program).run("part.mpf", &ARGUMENTS));
        assert!(shown.contains(words), "{blocks}\n{shown}");
    }
}
