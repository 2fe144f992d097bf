//! What is refused, and with which words.

use super::errors;
use crate::one_error::assert_one_error;

/// Checks that a program has exactly one error, at this line and column, with this text in it.
fn one_error(program: &str, place: &str, text: &str) {
    let shown = errors(program, &["--backend", "program"]);
    assert_one_error(&shown, program, &format!("part.pim:{place}"), text);
}

#[test]
fn words() {
    one_error("G0 X1.2.3\nM30\n", "1:5", "two decimal points");
    one_error("G0 X1 ?\nM30\n", "1:7", "the character `?` has no meaning");
    one_error("G0 X\nM30\n", "1:4", "the value of X is missing");
    one_error("G0 X-\nM30\n", "1:6", "the value of X is missing");
    one_error("G0 X1 X2\nM30\n", "1:7", "X is in this block twice");
    one_error("G0 H5\nM30\n", "1:4", "the address H is not supported");
    one_error("G0 X1 L5\nM30\n", "1:7", "L is the pitch of a thread");
    one_error("G33 Z-5\nM30\n", "1:1", "a thread needs one of X, Y and Z");
    one_error("G33 Z-5 L1\nM30\n", "1:1", "the spindle does not turn");
    one_error("G0 G1 X1\nM30\n", "1:4", "G0 and G1 exclude each other");
    one_error("M77\nM30\n", "1:1", "M77 is not defined");
    one_error("P1=5\nM30\n", "1:1", "without an address");
    one_error(
        "G0 X1 (MSG \"a\")\nM30\n",
        "1:7",
        "stands alone in its block",
    );
    one_error("(MSG \"a)\nM30\n", "1:6", "this text does not end");
    one_error("G0 X1 N3\nM30\n", "1:7", "at the beginning of the block");
    one_error(
        "%A,MX--,\nG0 X1\n%B,MX--,\nM30\n",
        "3:1",
        "a second program begins",
    );
}

#[test]
fn functions_that_mean_something_else_to_linuxcnc_or_nothing() {
    for (g, text) in [
        (20, "inch and millimetre"),
        (21, "work zones"),
        (58, "added to G54"),
        (59, "added to G54"),
        (52, "up to a stop"),
        (74, "reference search"),
        (67, "G66 R200 F300"),
        (68, "an operation of an irregular pocket"),
        (77, "slaved"),
        (100, "is not supported"),
    ] {
        one_error(
            &format!("G{g}\nM30\n"),
            "1:1",
            &format!("G{g} is not supported"),
        );
        one_error(&format!("G{g}\nM30\n"), "1:1", text);
    }
}

#[test]
fn e_belongs_to_irregular_pockets_and_to_g51() {
    one_error("G0 X1 E5\nM30\n", "1:7", "the address E is not supported");
}

#[test]
fn statements() {
    one_error("(PIEZA 1)\nM30\n", "1:2", "not a statement that is known");
    one_error("(GOT N10)\nM30\n", "1:2", "did you mean (GOTO ..)?");
    one_error(
        "(TOR1=5, TOI1=0)\nM30\n",
        "1:2",
        "enter tools into LinuxCNC's tool table",
    );
    one_error("(MGS \"a\")\nM30\n", "1:2", "did you mean (MSG ..)?");
    one_error("N10 GOTO N10\nM30\n", "1:5", "did you mean (GOTO ..)?");
    one_error("(P1 = SNI 30)\nM30\n", "1:7", "did you mean SIN?");
    one_error(
        "(P1 = 5)\n(IF P1 GRT 3 GOTO N10)\nN10 M30\n",
        "2:8",
        "did you mean GT?",
    );
    one_error("(P1 = 5 MDO 3)\nM30\n", "1:9", "did you mean MOD?");
    one_error("(DIGIT 1,2)\nM30\n", "1:2", "(DIGIT ..) is not supported");
    one_error(
        "(P1 = POSX)\nM30\n",
        "1:7",
        "POSX cannot be evaluated ahead of time",
    );
    one_error("(P1 = 1/0)\nM30\n", "1:9", "division by zero");
    one_error("(P400 = 1)\nM30\n", "1:3", "there is no parameter P400");
    one_error("G0 XP7\nM30\n", "1:5", "P7 has no value here");
    one_error(
        "(IF P1 GOTO N10)\nM30\n",
        "1:5",
        "a comparison is needed here",
    );
    one_error("(GOTO N77)\nM30\n", "1:7", "there is no block N77 here");
    one_error(
        "(RPT N20,N10)\nN10\nN20\nM30\n",
        "1:10",
        "stands before the first one",
    );
    one_error(
        "N10 G0 X1\nN20 (RPT N10,N20)\nM30\n",
        "2:5",
        "contain the repetition itself",
    );
    one_error("(CALL 5)\nM30\n", "1:2", "the subroutine 5 was not found");
    one_error(
        "(SUB 5)\nG0 X1\nM30\n",
        "1:1",
        "this subroutine does not end",
    );
    one_error("(SUB 5)\n(SUB 6)\n(RET)\nM30\n", "2:1", "inside of another");
    one_error(
        "M30\n(SUB 5)\nG0 X1\n(RET)\n(SUB 5)\n(RET)\n",
        "5:1",
        "SUB 5 is in this file twice",
    );
    one_error(
        "(P1=1, P2=FUP -1.5, P3=2)\nG0 XP1 YP3\nM30\n",
        "1:11",
        "towards 0 or away from it",
    );
    one_error("(RET)\nM30\n", "1:2", "outside of a subroutine");
    one_error(
        "(CALL 1)\nM30\n(SUB 1)\n(CALL 1)\n(RET)\n",
        "4:2",
        "SUB 1 calls itself",
    );
    one_error("(ERROR 5, \"no stock\")\nM30\n", "1:2", "error 5: no stock");
    one_error("N10 (GOTO N10)\nM30\n", "1:1", "the program does not end");
    one_error(
        "(GOTO N5)\nN10 G0 X1\n(GOTO N30)\nN20 X2\nN5 (RPT N10,N20)\nN30 M30\n",
        "3:1",
        "leaves the blocks that are repeated",
    );
}

#[test]
fn transforms() {
    one_error("G72 S0\nM30\n", "1:5", "the scale factor 0 is out of range");
    one_error(
        "G72 S-1\nM30\n",
        "1:5",
        "the scale factor -1 is out of range",
    );
    one_error("G72\nM30\n", "1:1", "G72 needs either S or axes");
    one_error("G72 A2\nM30\n", "1:5", "a factor for A alone");
    one_error("G72 S2 G0\nM30\n", "1:8", "G72 stands alone");
    one_error("G73 I5\nM30\n", "1:5", "needs the angle Q");
    one_error("G73 Q30 X5\nM30\n", "1:9", "G73 has Q, I and J only");
    one_error("G73 Q30\nG73 Q30 I5\nM30\n", "2:1", "about another centre");
    one_error("G14\nM30\n", "1:1", "G14 needs axes");
    one_error("G14 X5\nM30\n", "1:5", "axes without values");
    one_error("G14 X G0\nM30\n", "1:7", "G14 stands alone");
    one_error(
        "G73 Q30\nG92 X5\nM30\n",
        "2:1",
        "a scale or a rotation is in force",
    );
    one_error(
        "G90 G0 X0 Y0 Z0\nG41 G1 X1 F100\nG11\nM30\n",
        "3:1",
        "the frame changes while cutter compensation is on",
    );
    one_error(
        "G90 G0 X0 Y0 Z0\nG19 G41 G1 Y1 F100\nM30\n",
        "2:5",
        "cutter compensation in the plane of G19",
    );
}

#[test]
fn motion() {
    one_error(
        "G90 G0 X0 Y0\nG1 X10\nX20\nM30\n",
        "2:4",
        "no F is in force",
    );
    one_error("X10\nM30\n", "1:1", "no G0, G1, G2 or G3 before");
    one_error(
        "G0 X0 Y0\nG2 X10 Y0 I4 F100\nM30\n",
        "2:4",
        "the radius is 4.0000",
    );
    one_error(
        "G0 X0 Y0\nG6 G2 X10 Y0 I4 F100\nM30\n",
        "2:14",
        "needs both coordinates",
    );
    one_error(
        "G1 X5 R3 F100\nM30\n",
        "1:7",
        "R beside axes belongs to arcs",
    );
    one_error("G1 R5 Q30 X3 F100\nM30\n", "1:11", "polar and rectangular");
    one_error(
        "G8 X5 Y5 F100\nM30\n",
        "1:4",
        "where this arc begins is not known",
    );
    one_error(
        "G0 X0 Y0 Z0\nG72 S2\nG8 X5 Y5 F100\nM30\n",
        "3:4",
        "the direction before it",
    );
    one_error(
        "G0 X0 Y0\nG9 X10 Y0 I5 J0 F100\nM30\n",
        "2:4",
        "do not lie on a circle",
    );
    one_error("G53\nM30\n", "1:1", "G53 needs axes");
    one_error(
        "G91 G53 G0 X1\nM30\n",
        "1:5",
        "an increment in machine coordinates",
    );
    one_error("G4\nM30\n", "1:1", "G4 needs a time");
    one_error(
        "G4 K1.5\nM30\n",
        "1:4",
        "the time K is no whole number: it is in hundredths of a second",
    );
    one_error("G36 X5\nM30\n", "1:1", "G36 needs R");
    one_error(
        "G0 X0 Y0 Z0\nG36 R5 G1 X3 F100\nY9\nM30\n",
        "2:1",
        "does not fit between",
    );
    one_error(
        "G0 X0 Y0 Z0\nG36 R5 G1 X30 F100\nG11\nY9\nM30\n",
        "2:1",
        "no motion follows",
    );
}

#[test]
fn corners_between_motions_that_have_no_part_in_one() {
    for (corner, next, text) in [
        (
            "G36 R1 G1 X30",
            "Z9",
            "behind it moves an axis outside of the plane",
        ),
        (
            "G36 R1 G1 X30 Z9",
            "Y9",
            "this motion moves an axis outside of the plane",
        ),
        ("G36 R1 G1 X30", "G0 Y9", "behind it is rapid"),
        ("G39 R1 G1 X30", "G0 Y9", "behind it is rapid"),
        ("G37 R1 G0 X30", "G1 Y9", "this motion is rapid"),
        ("G38 R1 G0 X30", "G1 Y9", "this motion is rapid"),
        (
            "G36 R1 G1 X30",
            "G53 G1 Y9",
            "behind it is none of G1, G2 and G3",
        ),
        ("G36 R1 G1 X30", "X30", "behind it goes nowhere"),
        (
            "G36 R1 G91 G1 B3",
            "Y9",
            "this motion moves an axis outside of the plane",
        ),
    ] {
        let program = format!("G0 X0 Y0 Z0 F100\n{corner}\n{next}\nM30\n");
        let between = "a corner is made between two motions with feed in the plane";
        one_error(&program, "2:1", between);
        let shown = errors(&program, &["--backend", "program"]);
        assert!(shown.contains(text), "{program}{shown}");
    }
    let program = "G0 X0 Z0 F100\nG36 R1 G1 X30\nY9\nM30\n";
    one_error(program, "2:1", "begins or ends where is not known");
    let rapid = errors("G0 X0 Y0 F100\nG36 R1 G1 X30\nG0 Y9\nM30\n", &[]);
    assert!(rapid.contains("write G1 in place of G0"), "{rapid}");
}

#[test]
fn cycles() {
    one_error(
        "G0 X0 Y0 Z5\nG81 X5 Z2 F100\nM30\n",
        "2:1",
        "G81 needs the depth I",
    );
    one_error(
        "G0 X0 Y0 Z5\nG81 X5 Z2 I-5 K1.5 F100\nM30\n",
        "2:15",
        "the time K is no whole number: it is in hundredths of a second",
    );
    one_error(
        "G0 X0 Y0 Z5\nG84 X5 Z2 I-5 F100 S100 R7.5\nM30\n",
        "2:25",
        "R of G84 is the kind of the tap: 0, 1 or 2",
    );
    one_error(
        "G0 X0 Y0\nG81 X5 Z2 I-5 F100\nM30\n",
        "2:1",
        "above the plane is not known",
    );
    one_error(
        "G0 X0 Y0 Z5\nG83 X5 Z2 I-5 F100\nM30\n",
        "2:1",
        "G83 needs J",
    );
    one_error(
        "G0 X0 Y0 Z5\nG81 X5 Z2 I8 F100\nM30\n",
        "2:1",
        "does not lie beyond",
    );
    one_error("G79 Z5\nM30\n", "1:1", "none is active");
    for (word, column) in [
        ("G79 X5 I-6", 5),
        ("G79 Z2 Y5", 8),
        ("G79 I-6 Q9", 9),
        ("G79 I-6 N3", 9),
    ] {
        let program = format!("S300 M3\nF200\nG0 X0 Y0 Z9\nG81 X0 Y0 Z1 I-5\n{word}\nM30\n");
        let text = "has no use for this word";
        one_error(&program, &format!("5:{column}"), text);
    }
    one_error(
        "G0 X0 Y0 Z5\nG81 X5 Z2 I-5 F100\nZ3\nM30\n",
        "3:1",
        "the axis of the tool moves",
    );
}

/// Words that nothing uses.
#[test]
fn words_that_would_be_lost() {
    for (block, column, text) in [
        ("G4 K100 F20", 9, "G4 stands alone"),
        ("G4 K100 S500", 9, "G4 stands alone"),
        ("G4 K100 D3", 9, "G4 stands alone"),
        ("G4 K100 I5", 9, "G4 stands alone"),
        ("G4 K100 Q5", 9, "G4 stands alone"),
        ("G4 K100 G36 R5", 13, "G4 stands alone"),
        ("G4 K100 G43", 9, "G4 stands alone"),
        ("G4 K100 G53", 9, "G4 stands alone"),
        ("G93 I0 J0 S500", 11, "G93 stands alone"),
        ("G93 I5 J0 Q30", 11, "G93 stands alone"),
        ("G93 I5 J0 R3", 11, "G93 stands alone"),
        ("G73 Q45 S500", 9, "G73 stands alone"),
        ("G73 S700", 5, "G73 stands alone"),
        ("G72 S2 L5", 8, "G72 stands alone"),
        ("G14 X L5", 7, "G14 stands alone"),
        ("G53 X10 I5", 9, "beside G53"),
        ("G53 X10 L3", 9, "beside G53"),
        ("G53 Y5 R3", 8, "beside G53"),
        ("G53 Q30 X5", 5, "beside G53"),
        ("G53 G36 R5 X10", 5, "beside G53"),
        ("G53 G81 X10", 5, "beside G53"),
        ("G92 X5 I3", 8, "beside G92"),
        ("G92 X5 G36 R2", 8, "beside G92"),
        ("G1 G6 X10 Y0", 4, "G6 without an arc"),
        ("G6", 1, "G6 needs a motion"),
        ("G8 G6 X10 Y5", 4, "G6 without an arc"),
        ("G2 G6 X10 Y0 R5", 4, "G6 without an arc"),
        ("G33 Z-20 L1.5 G36 R5", 15, "a thread needs one of"),
        ("G33 Z-20 L1.5 R5", 15, "a thread needs one of"),
        (
            "G33 G81 X5 Z2 I-5",
            1,
            "G33 is in force, and a canned cycle",
        ),
        ("G0 G33 Z-20 L1.5", 4, "G0 and G33 exclude each other"),
        ("G81 G36 R2 X10 Z2 I-5", 5, "G36 while a canned cycle"),
        ("G81 G8 X10 Z2 I-5", 5, "G8 while a canned cycle"),
    ] {
        let program = format!("G90 G0 X0 Y0 Z10 F100 S100 M3\n{block}\nM30\n");
        one_error(&program, &format!("2:{column}"), text);
    }
    let head = "G90 G0 X0 Y0 Z10 F100 S100 M3\nG81 X10 Y0 Z2 I-5\n";
    for block in ["G36 R3 X20", "G39 R3 Y10", "G8 X20 Y0", "G9 X20 Y0 I15 J5"] {
        let program = format!("{head}{block}\nM30\n");
        one_error(&program, "3:1", "while a canned cycle is in force");
    }
}

/// The planes of a cycle belong to the zero point, mirrors and scales with which it was defined.
#[test]
fn nothing_moves_the_planes_of_a_cycle() {
    let head = "G54 G90 G0 X0 Y0 Z20 F100 S100 M3\nG99 G81 X10 Y0 Z2 I-5\n";
    let frame = "a mirror or a scale of the tool's axis changes in a canned cycle";
    for (block, text) in [
        ("G92 Z10", "G92 in a canned cycle"),
        ("G55 X20", "G55 in a canned cycle"),
        ("G72 S2", frame),
        ("G13", frame),
    ] {
        let program = format!("{head}{block}\nX15\nG80\nM30\n");
        one_error(&program, "3:1", text);
    }
    for (block, place) in [
        ("G55\nG98 G81 X10 Z2 I-5", "3:5"),
        ("G55\nG91 G99 G81 X10 Z-8 I-5", "3:9"),
        ("G55\nG99 G81 X10 Z2 I5", "3:5"),
    ] {
        let program = format!("G54 G90 G0 X0 Y0 Z20 F100 S100 M3\n{block}\nG80\nM30\n");
        one_error(&program, place, "above the plane is not known");
    }
}
