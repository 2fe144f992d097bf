//! What Haas mills have of their own: circular pockets, holes on a circle, the rounding of corners, subprograms in the
//! same program, dwells in seconds.

use crate::one_error::assert_one_error;
use crate::path::{assert_pair, assert_same, plain, steps};
use crate::rs274;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

const BEFORE: &str = "G0 X10. Y20. Z5.\nS500 M3\nF200.\n";

/// Both programs do the same, at F200.
fn pair(program: &str, linuxcnc: &str) {
    assert_pair(
        &format!("O1\n{BEFORE}{program}\nM30\n"),
        &format!("{BEFORE}{linuxcnc}\nM30\n"),
    );
}

#[test]
fn a_circular_pocket_is_milled_from_its_middle() {
    // Along the radius without a tool, and back to the middle, at the depth.
    let round = "G3 X15 Y20 I2.5 J0\nG3 X15 Y20 I-5 J0\nG3 X10 Y20 I-2.5 J0";
    pair("G13 D0 I5. Z-3.", &format!("G1 Z-3\n{round}"));
    pair("G13 D0 I5.", round);
    pair(
        "G12 D0 I5. Z-3. F100.",
        &format!("F100 G1 Z-3\n{}", round.replace("G3", "G2")),
    );
    // Rounds from I to K, Q apart, the last one nearer.
    pair(
        "G13 D0 I4. K9. Q3. Z-1.\nG0 Z5.",
        "G1 Z-1\nG3 X14 I2 J0\nG3 X14 Y20 I-4 J0\nG3 X3 I-5.5 J0\nG3 X3 Y20 I7 J0\nG3 X19 I8 J0\n\
         G3 X19 Y20 I-9 J0\nG3 X10 I-4.5 J0\nG0 Z5",
    );
    // Deeper each time.
    let deeper = format!("G1 Z3\n{round}\nG1 Z1\n{round}\nG0 Z5");
    pair("G91 G13 D0 I5. Z-2. L2\nG90 G0 Z5.", &deeper);
    // A block without a motion of its own goes on with the motion before.
    pair("G1 X10.\nG13 D0 I5.\nX0", &format!("{round}\nG1 X0"));
}

#[test]
fn the_radius_of_the_cutter_keeps_it_off_the_wall() {
    let program = format!("O1\n{BEFORE}G13 D2 I5. Z-3.\nM30\n");
    let files = [
        ("part.nc", program.as_str()),
        ("mill.ini", "[EMCIO]\nTOOL_TABLE = mill.tbl\n"),
        ("mill.tbl", "T2 P2 D4\n"),
    ];
    let shop = Shop::new(Dialect::Fanuc, &files);
    let output = shop.accepted(&["--backend", "program", "--ini", "mill.ini"]);
    let given = steps(&rs274::interpret(&shop.path(""), "", &output));
    let round = "G3 X13 Y20 I1.5 J0\nG3 X13 Y20 I-3 J0\nG3 X10 Y20 I-1.5 J0";
    assert_same(
        &given,
        &plain(&format!("{BEFORE}G1 Z-3\n{round}\nM30\n")),
        &output,
    );
}

#[test]
fn holes_lie_on_a_circle_round_the_tool() {
    let ways = "G99 G81 X12 Y20 Z-5 R2\nX10 Y22\nX8 Y20\nX10 Y18\nG80";
    pair("G99 G81 Z-5. R2. L0\nG70 I2. J0 L4\nG80", ways);
    let ways = "G99 G81 X10 Y22 Z-5 R2\nX8 Y20\nG80";
    pair("G99 G81 Z-5. R2. L0\nG71 I2. J90. K90. L2\nG80", ways);
    let ways = "G99 G81 X10 Y22 Z-5 R2\nX12 Y20\nG80";
    pair("G91 G99 G81 Z-7. R-3. L0\nG71 I2. J90. K-90. L2\nG80", ways);
}

#[test]
fn corners_are_rounded_by_as_much_as_is_said() {
    for (program, linuxcnc) in [
        // Until G187 stands alone: the mode of before.
        (
            "G187 P3 E.05\nG1 X20.\nG187\nX30.",
            "G64 P.05 G1 X20\nG61 X30",
        ),
        (
            "G187 E.05\nG1 X20.\nG187 P2\nX30.",
            "G64 P.05 G1 X20\nG61 X30",
        ),
        (
            "G64\nG187 E.05\nG1 X20.\nG187\nX30.",
            "G64 P.05 G1 X20\nG64 P.01 X30",
        ),
        // G61 goes on, and G64 rounds by E.
        (
            "G61\nG187 E.05\nG1 X20.\nG64 X30.",
            "G61.1 G1 X20\nG64 P.05 X30",
        ),
        ("G20 G187 E.002\nG21 G1 X20.", "G64 P.0508 G1 X20"),
        ("G187 P1\nG1 X20.", "G1 X20"),
        ("G187\nG1 X20.", "G1 X20"),
    ] {
        pair(program, linuxcnc);
    }
}

#[test]
fn blocks_of_the_same_program_are_called() {
    let program = "O1\nG0 X0 Y0 Z0\nM97 P100 L2\nG90 X50.\nM97 P200\nM30\n\
                   N100 G91 X1.\nM97 P200\nM99\nN200 Y5.\nM99\n";
    assert_pair(
        program,
        "G0 X0 Y0 Z0\nG91 X1\nY5\nX1\nY5\nG90 X50\nY5\nM30\n",
    );
    for (program, place, words) in [
        (
            "O1\nM97\nM30\n",
            "part.nc:2:1",
            "the number of the block is missing",
        ),
        (
            "O1\nM97 P5\nM30\n",
            "part.nc:2:5",
            "there is no block N5 in O1",
        ),
        (
            "O1\nM97 P5\nM30\nN5 M97 P5\nM99\n",
            "part.nc:4:8",
            "N5 of O1 calls itself",
        ),
        (
            "O1\nM97 P1.5\nM30\n",
            "part.nc:2:5",
            "1.5 is not the number of a block",
        ),
    ] {
        let shown = Shop::with(Dialect::Fanuc, program).refused(&[]);
        assert_one_error(&shown, program, place, words);
    }
}

#[test]
fn a_dwell_with_a_point_counts_seconds() {
    pair("G4 P1.5\nG4 P2.\nG4 P500", "G4 P1.5\nG4 P2\nG4 P.5");
    pair("G99 G82 X0 Z-5. R2. P.5\nG80", "G99 G82 X0 Z-5 R2 P.5\nG80");
    let output = Shop::with(Dialect::Fanuc, "O1\nG4 P.5\nM30\n").accepted(&[]);
    assert!(
        output.contains("with a decimal point counts seconds"),
        "{output}"
    );
}

#[test]
fn what_is_not_known_of_them_is_refused() {
    for (block, column, words) in [
        ("G13 I5.", 1, "G13 without D"),
        ("G13 D0", 1, "the radius I is missing"),
        ("G13 D0 I0", 8, "I is not above the radius of the tool"),
        ("G13 D0 I5. K9.", 12, "K and Q belong together"),
        ("G13 D0 I5. K4. Q1.", 12, "K is not above I"),
        ("G13 D0 I5. K9. Q0", 16, "Q is the step from round to round"),
        ("G13 D0 I5. X0", 12, "a place beside G13"),
        ("G13 D0 I5. Z-1. L2", 17, "L beside a pocket in G90"),
        ("G18 G13 D0 I5.", 5, "outside of G17"),
        ("G13 D5 I5.", 1, "needs the diameter of T5"),
        ("G93 G13 D0 I5. F1.", 5, "inverse time"),
        ("G150 P5 I1. Z-1.", 1, "G150 is not supported"),
        ("G70 I5. J0 L4", 1, "G70 is not supported"),
        ("G187 E0", 6, "E beside G187 is above 0"),
        ("G187 P4", 6, "P beside G187 is 1, 2 or 3"),
        ("#1=#3001", 4, "time passes while the program runs"),
    ] {
        let program = format!("O1\n{BEFORE}{block}\nM30\n");
        let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
        assert_one_error(&shown, &program, &format!("part.nc:5:{column}"), words);
    }
    for (block, column, words) in [
        ("G72 I5. J0 L4", 1, "of holes in a line"),
        ("G70 J0 L4", 1, "I is missing"),
        ("G70 I5. L4", 1, "J is missing"),
        ("G70 I5. J0", 1, "L is missing"),
        ("G71 I5. J0 L4", 1, "K is missing"),
        ("G70 I5. J0 K9. L4", 12, "K belongs to G71"),
        ("G70 I5. J0 L2.5", 12, "L is how many holes"),
        ("G70 X5. I5. J0 L4", 5, "a place beside it"),
    ] {
        let program = format!("O1\n{BEFORE}G81 Z-5. R2. L0\n{block}\nM30\n");
        let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
        assert_one_error(&shown, &program, &format!("part.nc:6:{column}"), words);
    }
    // Where the tool is in X behind L0 beside a place is not known.
    let program = format!("O1\n{BEFORE}G81 X5. Y5. Z-5. R2. L0\nG70 I5. J0 L4\nM30\n");
    let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
    assert_one_error(
        &shown,
        &program,
        "part.nc:6:1",
        "where the tool is in X and Y",
    );
}

#[test]
fn further_work_offsets_have_a_number_of_their_own() {
    pair("G154 P2\nX0 Y0\nG103 P1\nG103", "G59.2\nX0 Y0");
    let program = "O1\nG154 P9\nM30\n";
    let shown = Shop::with(Dialect::Fanuc, program).refused(&[]);
    assert_one_error(&shown, program, "part.nc:2:6", "no work offset for P9");
}

/// Times are counted while a program runs: that they begin again changes nothing where they are not read.
#[test]
fn clocks_may_be_set() {
    let output = Shop::with(Dialect::Fanuc, "O1\n#3001=0\n#3002=0\nG4 P500\nM30\n").accepted(&[]);
    assert!(
        output.contains("#3001 tunes the other control and is left out"),
        "{output}"
    );
}
