//! What is refused, where, and with which words.

use crate::one_error::assert_one_error;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// Checks that a program has exactly one error, at this line and column, with this text in it.
fn one_error(program: &str, place: &str, text: &str) {
    let shown = Shop::with(Dialect::Fanuc, program).refused(&["--backend", "kinematics"]);
    assert_one_error(&shown, program, &format!("part.nc:{place}"), text);
}

#[test]
fn words_and_blocks() {
    for (program, place, text) in [
        ("G1 X\nM30\n", "1:5", "the value of X is missing"),
        ("G0 X1.2.3\nM30\n", "1:5", "two decimal points"),
        ("G0 X1. X2.\nM30\n", "1:8", "X is in this block twice"),
        ("G0 X--1.\nM30\n", "1:5", "the value of X is missing"),
        ("G0 X1. ?\nM30\n", "1:8", "the character `?` has no meaning"),
        ("G0 X1. (a\nM30\n", "1:8", "this comment does not end"),
        ("G0 X1.; G1 Y2.\nM30\n", "1:7", "a block ends here"),
        ("G0 XSIN[30]\nM30\n", "1:5", "the value of X is missing"),
        ("G0 E5.\nM30\n", "1:4", "the address E is not supported"),
        ("G0 X1. /Y2.\nM30\n", "1:8", "/ stands at the beginning"),
        (
            "G0 X1. N5\nM30\n",
            "1:8",
            "stands at the beginning of the block",
        ),
        ("G0 X1. ,A5.\nM30\n", "1:8", ",A is not supported"),
        ("G0 X1. P5\nM30\n", "1:8", "P has no meaning in this block"),
        ("G0 X1. Q5.\nM30\n", "1:8", "Q has no meaning in this block"),
        ("G90 R5.\nM30\n", "1:1", "no G0, G1, G2 or G3"),
        ("O\nM30\n", "1:1", "a program begins with O"),
        ("O1\nM30\nO1\nM99\n", "3:1", "O1 is in this file twice"),
        (
            "O1\nG0 X1.\nM30\n%\nG0 X2.\n",
            "5:1",
            "behind the % that ends",
        ),
        (
            "G0 G1 X1. F1.\nM30\n",
            "1:4",
            "G0 and G1 exclude each other",
        ),
        ("G1 X1.\nM30\n", "1:4", "no F is in force"),
        ("M77\nM30\n", "1:1", "M77 is not defined"),
        ("M198 P5\nM30\n", "1:1", "write M98 P and its number"),
        ("G4\nM30\n", "1:1", "G4 needs one time"),
        ("#1=2.5\nG4 P#1\nM30\n", "2:4", "thousandths of a second"),
        ("EN1\nM30\n", "1:2", "the name END with all its letters"),
        ("GO 10\nM30\n", "1:2", "the name GOTO with all its letters"),
        ("G9\nM30\n", "1:1", "G9 needs a motion"),
        ("G92\nM30\n", "1:1", "G92 needs axes"),
        ("G5 P10001\nM30\n", "1:4", "not known what G5 does"),
        ("G5.1\nM30\n", "1:1", "not known what G5.1 does"),
        ("G8 P2\nM30\n", "1:4", "not known what G8 does"),
        ("G0 G5.1 Q1 X5.\nM30\n", "1:12", "a motion beside G5.1"),
        ("G0 G8 P1 X5.\nM30\n", "1:10", "a motion beside G8"),
    ] {
        one_error(program, place, text);
    }
}

#[test]
fn functions_that_are_not_supported() {
    for code in [
        "G7.1", "G10.1", "G12.1", "G22", "G27", "G29", "G31", "G33", "G37", "G45", "G40.2",
        "G41.1", "G51.2", "G53.2", "G53.6", "G60", "G63", "G68.3", "G68.4", "G77", "G81.1", "G87",
        "G88", "G92.1", "G43.4", "G44", "G100",
    ] {
        one_error(
            &format!("{code}\nM30\n"),
            "1:1",
            &format!("{code} is not supported"),
        );
    }
    one_error(
        "G10\nM30\n",
        "1:1",
        "G10 is not supported without L2 or L20",
    );
    one_error("G31 Z-5.\nM30\n", "1:1", "measure at the machine");
    one_error("G30 P2 X0\nM30\n", "1:1", "second reference position");
    one_error("G66.1 P1\nM30\n", "1:1", "G66.1 is not supported");
}

#[test]
fn variables_and_flow() {
    for (program, place, text) in [
        ("G0 X#1\nM30\n", "1:5", "#1 has no value here"),
        ("G0 X#500\nM30\n", "1:5", "--set '#500=5'"),
        ("G0 X#50\nM30\n", "1:5", "there is no variable #50"),
        (
            "G0 X#5021\nM30\n",
            "1:5",
            "#5021 cannot be evaluated ahead of time",
        ),
        (
            "G0 X#2001\nM30\n",
            "1:5",
            "tools are measured at the machine",
        ),
        ("G0 X#4014\nM30\n", "1:5", "program it before it is read"),
        ("G0 X#4016\nM30\n", "1:5", "#4012 and #4014 can be read"),
        (
            "G43 H1 G0 X1.\n#1=#5041\nM30\n",
            "2:4",
            "#5041 while G43, G41 or G42 is in force",
        ),
        (
            "G0 X0 Y0\nG41 D1 G1 X9. F1.\n#1=#5042\nG40 X20.\nM30\n",
            "3:4",
            "read #5002",
        ),
        ("#0=1\nM30\n", "1:1", "#0 is always vacant"),
        ("#5221=1\nM30\n", "1:1", "#5221 cannot be assigned"),
        ("##1=5\nM30\n", "1:2", "stands in brackets here"),
        ("#1=1/0\nM30\n", "1:6", "division by zero"),
        ("#1=1.5AND2\nM30\n", "1:4", "1.5 has no bits"),
        (
            "G1 X1. F[ROUND[5.5]]\nM30\n",
            "1:10",
            "what ROUND rounds to",
        ),
        ("#1=BIN[5]\nM30\n", "1:4", "BIN cannot be evaluated"),
        ("#1=[1+2\nM30\n", "1:8", "`]` is missing"),
        ("#1=1 #2=2\nM30\n", "1:6", "nothing more may stand"),
        ("#3000=2(NO TOOL)\nM30\n", "1:1", "alarm 2: NO TOOL"),
        ("IF[1EQ1]X1.\nM30\n", "1:9", "GOTO or THEN is missing"),
        ("IF[1EQ1]GOTO99\nM30\n", "1:9", "there is no block N99"),
        ("GOTO N10\nN10 M30\n", "1:6", "without N here"),
        (
            "GOTO10\nWHILE[1EQ1]DO1\nN10 G0 X1.\nEND1\nM30\n",
            "1:1",
            "inside of a loop",
        ),
        ("WHILE[1EQ1]\nM30\n", "1:12", "DO is missing"),
        ("WHILE[1EQ1]DO4\nM30\n", "1:14", "1, 2 or 3"),
        ("DO1\nM30\n", "1:1", "END1 is missing"),
        ("END1\nM30\n", "1:1", "END1 without a DO1"),
        ("DO1\nDO2\nEND1\nEND2\nM30\n", "3:1", "END1 inside of DO2"),
        ("N1 GOTO1\nM30\n", "1:1", "the program does not end"),
        (
            "M98\nM30\n",
            "1:1",
            "the number of the subprogram is missing",
        ),
        ("M98 P9\nM30\n", "1:1", "the program O9 was not found"),
        ("M98 P9 L0\nM30\n", "1:8", "a whole number from 1 to 9999"),
        (
            "O1\nM98 P2\nM30\nO2\nM98 P2\nM99\n",
            "5:1",
            "O2 calls itself",
        ),
        (
            "O1\nM98 P2\nM30\nO2\nM99 P7\n",
            "5:5",
            "there is no block N7",
        ),
        ("G0 X1.\nM99\n", "2:1", "begins it again, for ever"),
        ("M98 P1 M30\n", "1:8", "exclude each other"),
        (
            "G65 A1.\nM30\n",
            "1:1",
            "the number of the macro is missing",
        ),
        ("G65 P1 N5\nM30\n", "1:8", "N is no argument"),
        ("G65 P1 A1. A2.\nM30\n", "1:12", "#1 gets a second value"),
        (
            "O1\nG66 P2\nG66 P2\nM30\nO2\nM99\n",
            "3:1",
            "end it with G67",
        ),
    ] {
        one_error(program, place, text);
    }
}

#[test]
fn offsets_frames_and_cycles() {
    for (program, place, text) in [
        ("G43 Z5.\nM30\n", "1:1", "G43 without an offset"),
        (
            "G43 H1.5\nM30\n",
            "1:5",
            "is not a row of the offset memory",
        ),
        (
            "G0 X0 Y0\nG41 G1 X1. F1.\nM30\n",
            "2:1",
            "without an offset",
        ),
        (
            "G0 X0 Y0\nG41 D0 G1 X1. F1.\nM30\n",
            "2:1",
            "without an offset",
        ),
        (
            "G0 X0 Y0\nG41 D1 G1 X20. F1.\nD2 X40.\nG40\nM30\n",
            "3:1",
            "another radius",
        ),
        (
            "G0 X0 Y0\nG41 D1 G1 X20. F1.\nG42 X40.\nG40\nM30\n",
            "3:1",
            "the other side",
        ),
        ("G54.1 P7\nM30\n", "1:7", "no work offset for P7"),
        ("G54.1\nM30\n", "1:1", "needs the number of the work offset"),
        ("G51 X0 Y0 Z0\nM30\n", "1:1", "G51 needs P, or I, J and K"),
        ("G51 X0 Y0 Z0 P2\nM30\n", "1:14", "is a factor of 0.002"),
        ("G51 X0 Y0 Z0 P0.\nM30\n", "1:14", "out of range"),
        (
            "G51 P2000\nM30\n",
            "1:1",
            "where the tool is, and that is not known",
        ),
        ("G51.1\nM30\n", "1:1", "G51.1 needs axes"),
        ("G51.1 A0\nM30\n", "1:7", "only X, Y and Z"),
        (
            "G51 X0 Y0 Z0 P2000\nG51.1 X0\nM30\n",
            "2:1",
            "G51.1 inside of G51",
        ),
        (
            "G68 X0 Y0 R5.\nG51 X0 Y0 Z0 P2000\nM30\n",
            "2:1",
            "G51 inside of G68",
        ),
        (
            "G51 X0 Y0 Z0 P2000\nG68 X0 Y0 R5.\nG50\nM30\n",
            "3:1",
            "G50 inside of G68",
        ),
        (
            "G51 X0 Y0 Z0 I1000 J2000 K1000\nG68 X0 Y0 R5.\nM30\n",
            "2:1",
            "different factors",
        ),
        ("G68 X0 Y0\nM30\n", "1:1", "G68 needs the angle R"),
        ("G68 X0 Y0 I1 R5.\nM30\n", "1:11", "about an axis in space"),
        ("G68 X0 Z0 R5.\nM30\n", "1:8", "lies in the plane"),
        ("G68 X0 Y0 R5.\nG18\nM30\n", "2:1", "another plane"),
        ("G68 X0 Y0 R5.\nG55\nM30\n", "2:1", "G55 while"),
        ("G51.1 X0\nG92 X0\nM30\n", "2:1", "G92 while"),
        (
            "G92 X5.\nM6\nG52 X1. Y2.\nM30\n",
            "3:5",
            "where X is, is not known ahead of time",
        ),
        (
            "G0 X0 Y0\nG41 D1 G1 X20. F1.\nG52 X3.\nG40 X60.\nM30\n",
            "3:1",
            "G52 while cutter compensation is on",
        ),
        (
            "G0 X0 Y0\nG19 G41 D1 G1 Y20. F1.\nM30\n",
            "2:5",
            "cutter compensation in the plane of G19",
        ),
        (
            "G0 X0 Y0\nG41 D1 G1 X20. F1.\nG19\nG40 X60.\nM30\n",
            "3:1",
            "the plane changes while cutter compensation is on",
        ),
        // Which place an axis that is not named has is a setting of the control.
        (
            "G0 X5. Y5.\nG68 X0 Y0 R5.\nX1.\nM30\n",
            "3:1",
            "the first motion behind G68",
        ),
        (
            "G0 X5. Y5.\nG68 X0 Y0 R5.\nX1. Y1.\nG69\nG91 X1. Y1.\nM30\n",
            "5:5",
            "the first motion behind G69",
        ),
        (
            "G0 X0 Y0 Z0\nG51 X0 Y0 Z0 I1000 J2000 K1000\nG2 X10. I5. F1.\nM30\n",
            "3:1",
            "an arc while",
        ),
        (
            "G0 X0 Y0 Z5.\nG51 X0 Y0 Z0 P2000\nG81 X1. Z-5. R2. F1.\nG50\nM30\n",
            "4:1",
            "the frame changes in a canned cycle",
        ),
        (
            "G0 X5. Y5. Z5.\nG68 X0 Y0 R5.\nG81 X1. Z-5. R2. F1.\nM30\n",
            "3:5",
            "the first motion behind G68",
        ),
        (
            "G0 X0 Y0 Z5.\nG51.1 X9.\nG76 X1. Z-5. R2. I1. F1. S1 M3\nM30\n",
            "3:1",
            "G76 while",
        ),
        ("G53.1\nM30\n", "1:1", "G53.1 without a tilted plane"),
        (
            "G68.2 X0 Y0 Z0 J5.\nG53.1 P1\nM30\n",
            "2:7",
            "G53.1 with P1",
        ),
        ("G68.2 P2 X0\nM30\n", "1:7", "G68.2 with P2"),
        ("G68.2 P1 X0\nM30\n", "1:1", "needs Q, the order"),
        (
            "G68.2 X0 J5.\nG68 X0 Y0 R5.\nM30\n",
            "2:1",
            "in a tilted plane",
        ),
        (
            "G51.1 X0\nG68.2 X0 J5.\nM30\n",
            "2:1",
            "while G51, G51.1 or G68 is in force",
        ),
        (
            "G18 G68 X0 Z0 R5.\nG69\nG17 G68.2 X0 J5.\nM30\n",
            "3:5",
            "turns G18 or G19",
        ),
        (
            "G81 X1. Z-5. R2. F1.\nM30\n",
            "1:1",
            "where the tool is above the part",
        ),
        (
            "G0 Z5.\nG81 X1. Z-5. F1.\nM30\n",
            "2:1",
            "G81 needs the return level R",
        ),
        (
            "G0 Z5.\nG81 X1. R2. F1.\nM30\n",
            "2:1",
            "G81 needs the bottom Z",
        ),
        (
            "G0 Z5.\nG81 X1. Z5. R2. F1.\nM30\n",
            "2:1",
            "is not below R",
        ),
        (
            "G0 Z5.\nG83 X1. Z-5. R2. F1.\nM30\n",
            "2:1",
            "needs Q above 0",
        ),
        (
            "#1=.5\nG0 Z5.\nG82 X1. Z-5. R2. P#1 F1.\nM30\n",
            "3:18",
            "thousandths of a second",
        ),
        (
            "G0 Z5.\nG81 X1. Z-5. R2. K1.5 F1.\nM30\n",
            "2:18",
            "a whole number up to 9999",
        ),
        (
            "G0 Z5.\nG81 X1. Z-5. R2. K1 L1 F1.\nM30\n",
            "2:21",
            "both say how often",
        ),
        (
            "G0 Z5.\nG76 X1. Z-5. R2. Q1. F1. S1 M3\nM30\n",
            "2:18",
            "which way G76 moves",
        ),
        (
            "G0 Z5.\nG84 X1. Z-5. R2. F1.\nM30\n",
            "2:1",
            "does not turn its way",
        ),
        (
            "G0 Z5.\nM29\nG84 X1. Z-5. R2. F1.\nM30\n",
            "3:1",
            "needs F and S",
        ),
        (
            "G0 Z5.\nM29 S9\nG84 X1. Z-5. R2. Q1. F1.\nM30\n",
            "3:18",
            "tapping in steps",
        ),
        (
            "G0 Z5.\nG81 G1 X1. Z-5. R2. F1.\nM30\n",
            "2:5",
            "ends the canned cycle",
        ),
        (
            "G0 Z5.\nG81 X1. Z-5. R2. F1.\nG53 Z0\nM30\n",
            "3:1",
            "G53 in a canned cycle",
        ),
        (
            "G0 Z5.\nG81 X1. Z-5. R2. F1.\nG20\nX1.\nM30\n",
            "3:1",
            "another unit of length in a canned cycle",
        ),
        (
            "G0 X25.4\nG20 X#5001\nM30\n",
            "2:1",
            "another unit in the block of a value that depends on it",
        ),
        (
            "G0 X1. G20 Y[ROUND[1.23456]]\nM30\n",
            "1:8",
            "another unit in the block of a value that depends on it",
        ),
        (
            "G0 Z5.\nG91 G81 X1. Z-5. R-2. K0 F1.\nM30\n",
            "2:1",
            "K0 beside a place",
        ),
        (
            "G0 Z50.\nG43 H1 Z5.\nG91 G43 H2 Z1.\nM30\n",
            "3:12",
            "an increment in Z behind another length of the tool",
        ),
        (
            "G0 Z50.\nG43 H1\nG91\nX1. Z1.\nM30\n",
            "4:5",
            "program Z once with G90",
        ),
        (
            "G91 G53 Z1.\nM30\n",
            "1:5",
            "an increment in machine coordinates",
        ),
        ("G53 G1 Z1. F1.\nM30\n", "1:5", "G53 moves rapidly"),
    ] {
        one_error(program, place, text);
    }
}

#[test]
fn a_subprogram_file_that_begins_with_another_number_is_named() {
    let program = "O1\nM98 P11\nM30\n";
    let files = [("part.nc", program), ("O0011.nc", "O12\nM99\n")];
    let shown = Shop::new(Dialect::Fanuc, &files).refused(&[]);
    let words = [
        "the program O11 was not found: ",
        "O0011.nc is there, but it begins with O12",
    ];
    for words in words {
        assert!(shown.contains(words), "{shown}");
    }
}

/// In increments an argument without a point has no sure value.
#[test]
fn arguments_have_points_where_numbers_count_increments() {
    let shop = Shop::with(Dialect::Fanuc, "O1\nG65 P2 A1\nM30\nO2\nM99\n");
    let shown = shop.refused(&["--decimal-point", "increments"]);
    assert!(
        shown.contains("the argument A has no decimal point"),
        "{shown}"
    );
}
