//! What is refused, where, and with which words.

use crate::one_error::assert_one_error;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// Checks that a program has exactly one error, at this line and column, with this text in it.
fn one_error(dialect: Dialect, program: &str, place: &str, text: &str) {
    let shown = Shop::with(dialect, program).refused(&["--backend", "kinematics"]);
    assert_one_error(&shown, program, &format!("part.nc:{place}"), text);
}

#[test]
fn mefi() {
    for (program, place, text) in [
        ("G1 X\nM30\n", "1:4", "the value of X is missing"),
        ("G1 X1.2.3 F1\nM30\n", "1:4", "two decimal points"),
        ("G1 X1 X2 F1\nM30\n", "1:7", "X is in this block twice"),
        (
            "G1 (hello) X1\nM30\n",
            "1:4",
            "comments do not begin like this",
        ),
        (
            "G1 X1 ; hello\nM30\n",
            "1:7",
            "comments begin with a quotation mark",
        ),
        ("G1 E5\nM30\n", "1:4", "the address E is not supported"),
        (
            "TRANS X10\nM30\n",
            "1:1",
            "`TRANS` is not a word of this dialect",
        ),
        ("G71 L9 P0\nM30\n", "1:8", "a whole number from 1"),
        ("G71 L9 P2 Q2\nM30\n", "1:11", "is in this block twice"),
        (
            "G1 X1 P2\nM30\n",
            "1:7",
            "belong to the call of a subprogram",
        ),
        ("G1 X1 ?\nM30\n", "1:7", "the character `?` has no meaning"),
        ("G1.5 X1\nM30\n", "1:1", "is not the number of a function"),
        ("G20\nM30\n", "1:1", "G20 is not supported"),
        ("G93\nM30\n", "1:1", "G93 is not supported"),
        ("G0 G1 X1 F1\nM30\n", "1:4", "G0 and G1 exclude each other"),
        ("M77\nM30\n", "1:1", "M77 is not defined"),
        ("N10 G1 X1\nM30\n", "1:8", "no F is in force"),
        (
            "G35 X0 F100\nM30\n",
            "1:8",
            "F cannot stand in one block with G35",
        ),
        (
            "G1 G35 X0\nM30\n",
            "1:1",
            "G1 cannot stand in one block with G35",
        ),
        (
            "G35 G36 X2\nM30\n",
            "1:5",
            "G36 cannot stand in one block with G35",
        ),
        ("G36 X0\nM30\n", "1:5", "a scale of 0 is out of range"),
        ("G36 X-1\nM30\n", "1:5", "G35 mirrors axes"),
        ("G36 X1 Y0\nM30\n", "1:8", "a scale of 0 is out of range"),
        (
            "G36 X1 Y2 Z3\nM30\n",
            "1:11",
            "one value, or two for a fraction",
        ),
        ("G36 X1E9\nM30\n", "1:7", "the address E"),
        ("G36 X100000\nM30\n", "1:5", "is out of range"),
        ("G34 X1\nM30\n", "1:5", "G34 takes no axes"),
        (
            "G0 X0 Y0\nG41 G1 X1 F100\nG35 X0\nG40\nM30\n",
            "3:1",
            "while cutter compensation is on",
        ),
        (
            "G0 X0 Y0\nG19\nG41 G1 Y1 F100\nM30\n",
            "3:1",
            "cutter compensation in the plane of G19",
        ),
        ("G71\nM30\n", "1:1", "G71 needs the number of a subprogram"),
        ("G71 L9\nM30\n", "1:5", "the subprogram L9 was not found"),
        ("G71 L9 X1\nM30\n", "1:8", "with the call of a subprogram"),
        (
            "G71 L9 Q0\nM30\nG79 L9\nG70\n",
            "1:8",
            "a whole number from 1",
        ),
        ("L9\nM30\n", "1:1", "belong to the call of a subprogram"),
        (
            "G71 L1\nM30\nG79 L1\nG71 L1\nG70\n",
            "4:5",
            "L1 calls itself",
        ),
        ("G70\nM30\n", "1:1", "G70 returns from a subprogram"),
        (
            "G0 X1\nG79 L1\nG70\n",
            "2:1",
            "would run into this subprogram",
        ),
        ("G4\nM30\n", "1:1", "G4 needs a time"),
        ("G4 F2 M3\nM30\n", "1:7", "G4 stands alone"),
        ("G4 K2\nM30\n", "1:4", "K is no time of G4 here"),
        (
            "G0 X0 Y0\nG2 X10 Y0 R4 F1\nM30\n",
            "2:11",
            "the radius 4.0000 does not reach the end",
        ),
        ("D1.5\nM30\n", "1:1", "is not a row of the offset table"),
        ("G92\nM30\n", "1:1", "G92 needs axes"),
        (
            "G92 X0 I5\nM30\n",
            "1:1",
            "G92 while a centre or a radius is in its block",
        ),
        (
            "G35 X0\nG92 X0\nM30\n",
            "2:1",
            "G92 while a recalculation of coordinates is active",
        ),
        (
            "G53\nG92 X0\nM30\n",
            "2:1",
            "G92 while the work offset is off",
        ),
    ] {
        one_error(Dialect::Mefi, program, place, text);
    }
}

#[test]
fn isg() {
    for (program, place, text) in [
        ("G01 X\nM30\n", "1:5", "the value of X is missing"),
        ("G01 X=\nM30\n", "1:5", "the value of X is missing"),
        ("G01 X1.2.3 F1\nM30\n", "1:6", "two decimal points"),
        (
            "G00 FOO\nM30\n",
            "1:5",
            "`FOO` is not a word of this dialect",
        ),
        ("G00 X1 X2\nM30\n", "1:8", "X is in this block twice"),
        ("G00 H5\nM30\n", "1:5", "the address H is not supported"),
        ("G00 X1=5\nM30\n", "1:5", "X1 with a value is not supported"),
        ("G00 XP1\nM30\n", "1:6", "P1 has no value here"),
        (
            "G00 XV.G.WORLD\nM30\n",
            "1:6",
            "cannot be evaluated ahead of time",
        ),
        (
            "G00 XV.L.DEPTH\nM30\n",
            "1:6",
            "V.L.DEPTH has no value here",
        ),
        ("G00 X[1+2\nM30\n", "1:10", "`]` is missing"),
        ("G00 X=SINUS[3]\nM30\n", "1:7", "`SINUS` is not a function"),
        ("G00 X=SIN[3,4]\nM30\n", "1:7", "SIN needs 1 value"),
        ("G00 X=1/0\nM30\n", "1:9", "division by zero"),
        ("G00 X=-2**2\nM30\n", "1:7", "a sign before a power"),
        ("G00 X=\"NAME\"\nM30\n", "1:7", "macros are not supported"),
        ("G00 X1 ?\nM30\n", "1:8", "an address is missing here"),
        ("G331 Z1 K1\nM30\n", "1:1", "write G63 Z-20 F300 S200"),
        ("G80\nM30\n", "1:1", "G80 is not supported"),
        (
            "G805[1,2]\nM30\n",
            "1:1",
            "a subprogram of the other control",
        ),
        ("G803\nM30\n", "1:1", "cycles are subprograms"),
        (
            "G00 G01 X1 F1\nM30\n",
            "1:5",
            "G0 and G1 exclude each other",
        ),
        ("M77\nM30\n", "1:1", "M77 is not defined"),
        ("M63=5\nM30\n", "1:1", "M63 with a value is not supported"),
        ("G01 X1\nM30\n", "1:5", "no F is in force"),
        ("X1\nM30\n", "1:1", "no G0, G1, G2 or G3"),
        ("G351\nM30\n", "1:1", "G351 needs axes"),
        ("G351 X2\nM30\n", "1:6", "2 has no meaning with G351"),
        (
            "G351 X-1 G01\nM30\n",
            "1:10",
            "G1 cannot stand in one block with G351",
        ),
        (
            "G21 G351 X-1\nM30\n",
            "1:5",
            "G21 and G351 exclude each other",
        ),
        ("G92\nM30\n", "1:1", "G92 needs axes"),
        ("G92 X1 I5\nM30\n", "1:1", "G92 takes axes only"),
        (
            "D1 G00 X0 Y0\nG41 G01 X1 F100\nG21\nG40\nM30\n",
            "3:1",
            "while cutter compensation is on",
        ),
        (
            "D1 G00 X0 Y0\nG19 G41 G01 Y1 F100\nM30\n",
            "2:5",
            "cutter compensation in the plane of G19",
        ),
        ("#CS ON [1,2]\nG92 X1\nM30\n", "2:1", "while #CS is active"),
        ("#CS ON [1,2]\nG55\nM30\n", "2:1", "while #CS is active"),
        ("#CS ON [1,2]\nG351 X-1\nM30\n", "2:1", "G351 and #CS"),
        ("G351 X-1\n#CS ON [1,2]\nM30\n", "2:1", "G351 and #CS"),
        ("#CS OFF\nM30\n", "1:1", "no coordinate system is active"),
        ("#CS ON\nM30\n", "1:1", "is not defined"),
        ("#CS ON [1,2,3,4,5,6,7]\nM30\n", "1:23", "six values"),
        ("#CS\nM30\n", "1:4", "#CS needs ON, OFF or DEF"),
        ("#TRAFO ON\nM30\n", "1:1", "#TRAFO is not supported"),
        ("#RTCP ON\nM30\n", "1:1", "#RTCP is not supported"),
        ("#KIN ID [9]\nM30\n", "1:1", "#KIN is not supported"),
        ("#MSSG [\"a\"]\nM30\n", "1:1", "did you mean #MSG?"),
        ("MSG [\"a\"]\nM30\n", "1:1", "did you mean #MSG?"),
        ("IF P1 > 3\nM30\n", "1:1", "did you mean $IF?"),
        ("$FRO P1=1,2\nM30\n", "1:1", "did you mean $FOR?"),
        ("G00 X=CSO[3]\nM30\n", "1:7", "did you mean COS?"),
        ("#MSG [\"a %d\"]\nM30\n", "1:1", "as many values are needed"),
        ("#MSG [\"a]\nM30\n", "1:7", "this text does not end"),
        (
            "#HSC ON [OPMODE 2]\nM30\n",
            "1:10",
            "splines through the points",
        ),
        (
            "#HSC ON [CONTERROR]\nM30\n",
            "1:10",
            "CONTERROR needs a value",
        ),
        (
            "#HSC ON [NONSENSE=1]\nM30\n",
            "1:10",
            "NONSENSE is not a parameter",
        ),
        (
            "#ROTATION ON [ANGLE=1 CENTER1=5]\nM30\n",
            "1:23",
            "a centre of rotation",
        ),
        ("#HSC OFF G01\nM30\n", "1:10", "nothing more may stand"),
        ("$WHIL 1\nM30\n", "1:1", "did you mean $WHILE?"),
        (
            "%L A\nM29\n%L A\nM29\n%MAIN\nM30\n",
            "3:1",
            "A is in this file twice",
        ),
        (
            "$IF 1\nM30\n",
            "1:1",
            "the $ENDIF that belongs to this is missing",
        ),
        (
            "$ENDFOR\nM30\n",
            "1:1",
            "the beginning that belongs to this is missing",
        ),
        ("$BREAK\nM30\n", "1:1", "$BREAK outside of a loop"),
        ("$CONTINUE\nM30\n", "1:1", "$CONTINUE outside of a loop"),
        ("$IF 1 G00\n$ENDIF\nM30\n", "1:7", "nothing more may stand"),
        ("$GOTO N99\nM30\n", "1:7", "there is no such block"),
        ("$GOTO N1\nN1 G90\nN1 G90\nM30\n", "1:7", "several blocks"),
        ("$FOR P1=1,5,0\n$ENDFOR\nM30\n", "1:13", "with a step of 0"),
        (
            "P1=1\n$SWITCH P1\n$CASE 1\nG90\n$CASE 2\n$ENDSWITCH\nM30\n",
            "5:1",
            "the $CASE before this one does not end",
        ),
        ("N10 $GOTO N10\nM30\n", "1:1", "the program does not end"),
        (
            "LL NOWHERE\nM30\n",
            "1:4",
            "the subprogram NOWHERE was not found",
        ),
        (
            "L nowhere.nc\nM30\n",
            "1:3",
            "the subprogram NOWHERE.NC was not found",
        ),
        ("L a/b.nc\nM30\n", "1:3", "a subprogram with a path"),
        (
            "L CYCLE [NAME=x]\nM30\n",
            "1:3",
            "the call of CYCLE is not supported",
        ),
        (
            "%L A\nLL A\nM29\n%MAIN\nLL A\nM30\n",
            "2:4",
            "A calls itself",
        ),
        (
            "%L\tA B\nM29\n%MAIN\nM30\n",
            "1:6",
            "nothing more may stand",
        ),
        (
            "#VAR\nV.L.A : STRING = 1\n#ENDVAR\nM30\n",
            "2:9",
            "of the type STRING",
        ),
        (
            "#VAR\nV.L.A : SGN32 = 1.5\n#ENDVAR\nM30\n",
            "2:1",
            "does not fit into a variable",
        ),
        ("#VAR\nG00 X1\n#ENDVAR\nM30\n", "2:1", "only declarations"),
        (
            "#COMMENT\nM30\n",
            "1:1",
            "write #COMMENT BEGIN in a line before",
        ),
        ("G11\nM30\n", "1:1", "write G10, and F for that path"),
        (
            "%1\nL SUB1\nM30\n%L SUB1\nM17\n",
            "2:3",
            "write LL SUB1 for %L SUB1 of this file",
        ),
        (
            "#COMMENT BEGIN\nM30\n",
            "1:1",
            "the #COMMENT END that belongs to this is missing",
        ),
        (
            "G161 G02 X10 I5 F1\nM30\n",
            "1:14",
            "needs both coordinates",
        ),
        ("G04\nM30\n", "1:1", "G04 needs a time"),
        ("G04 Y2\nM30\n", "1:5", "G04 stands alone"),
        ("G04 K2\nM30\n", "1:5", "K is no time of G04 here"),
        ("G04 F2\nM30\n", "1:5", "F is no time of G04 here"),
        ("G04 10 X2\nM30\n", "1:8", "G04 has its time twice"),
        (
            "T5 M6\nG00 X0 Y0\nG41 G01 X5 F100\nM30\n",
            "3:1",
            "G41, and no D before it",
        ),
        (
            "#VAR\nV.P.A : UNS08 = -1\n#ENDVAR\nM30\n",
            "2:1",
            "whole numbers from 0 to 255",
        ),
        (
            "#VAR\nV.P.A : BOOLEAN = 5\n#ENDVAR\nM30\n",
            "2:1",
            "5 does not fit into a variable for whole numbers from 0 to 1",
        ),
        (
            "#VAR\nV.P.A : SGN08 = -128\n#ENDVAR\nV.P.A = 128\nM30\n",
            "4:1",
            "whole numbers from -128 to 127",
        ),
        (
            "#VAR\nV.P.A : UNS32 = 4294967296\n#ENDVAR\nM30\n",
            "2:1",
            "does not fit into a variable",
        ),
        (
            "#VAR\nV.P.A : SGN = 1\n#ENDVAR\nM30\n",
            "2:9",
            "of the type SGN",
        ),
        ("G04 S10\nM30\n", "1:5", "a spindle without speed"),
        ("G60\nM30\n", "1:1", "this acts in its block only"),
        ("G93 F0\nM30\n", "1:5", "must be above 0"),
        ("G159=2.5\nM30\n", "1:1", "G159 needs the number"),
        ("G159=12\nM30\n", "1:1", "LinuxCNC has no work offset 12"),
    ] {
        one_error(Dialect::Isg, program, place, text);
    }
}

#[test]
fn several_errors_in_one_run() {
    let program = "G01 X F100\nG80\nFOO\nG00 X1\nM30\n";
    let shown = Shop::with(Dialect::Isg, program).refused(&[]);
    assert!(shown.contains("\n3 errors: nothing was written"), "{shown}");
}

#[test]
fn the_mark_ends_with_the_word() {
    let shown = Shop::with(Dialect::Isg, "N10 G00 M77   (a)\nM30\n").refused(&[]);
    assert!(shown.contains("^^^\n"), "{shown}");
    assert!(!shown.contains("^^^^"), "{shown}");
}

#[test]
fn the_mark_is_under_the_word() {
    let shown = Shop::with(Dialect::Isg, "N10 G01 X10 (a) FOO\nM30\n").refused(&[]);
    assert!(shown.contains("N10 G01 X10 (a) FOO"), "{shown}");
    let lines: Vec<&str> = shown.lines().collect();
    let text = lines
        .iter()
        .position(|line| line.contains("(a) FOO"))
        .expect("the line");
    let under = lines[text + 1];
    let column = lines[text].find("FOO").expect("the word");
    assert_eq!(
        under.get(column..).map(str::trim_end),
        Some("^^^"),
        "{shown}"
    );
}
