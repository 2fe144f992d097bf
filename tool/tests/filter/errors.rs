//! What is refused, and with which words.

use crate::one_error::assert_one_error;
use crate::shop::{Shop, refused};

/// Runs a program that must be refused and returns the error text.
fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &["--backend", "kinematics"]))
}

/// Checks that a program has exactly one error, at this line and column, with this text in it.
fn one_error(program: &str, place: &str, text: &str) {
    let shown = errors(program);
    assert_one_error(&shown, program, &format!("part.mpf:{place}"), text);
}

/// What a user sees of several errors: each with its place, the line and what is marked in it.
#[test]
fn each_refusal_shows_its_line_and_marks_the_words() {
    let shown = errors("N10 TRANZ X10\nG0 G1 X1 F1\n\tG0 X1 ?\nG1 X1 Y2 CR=5 F100\nM30\n");
    insta::assert_snapshot!("refusals_with_their_lines", shown);
}

#[test]
fn words_that_are_none() {
    one_error("N10 TRANZ X10\nM30\n", "1:5", "did you mean TRANS?");
    one_error(
        "G0 X1 FOO\nM30\n",
        "1:7",
        "`FOO` is not a word of this dialect",
    );
    for (program, column) in [
        ("MCALL CYCLE81(10,0,2,-5) X5", 26),
        ("CYCLE81(10,0,2,-5) X5", 20),
        ("G0 X5 CYCLE81(10,0,2,-5)", 7),
    ] {
        let text = "the call of CYCLE81 stands alone in its block";
        one_error(&format!("{program}\nM30\n"), &format!("1:{column}"), text);
    }
    one_error("G641 ADISPOS=2\nM30\n", "1:6", "ADISPOS is not supported");
    one_error("G0 Q5\nM30\n", "1:4", "the address Q is not supported");
    one_error("G0 X1.2.3\nM30\n", "1:5", "two decimal points");
    one_error("G0 X=\nM30\n", "1:6", "a value is missing here");
    one_error("G0 X\nM30\n", "1:5", "the value of X is missing");
    one_error("G0 X1 X2\nM30\n", "1:7", "X is in this block twice");
    one_error("G0 X1 ?\nM30\n", "1:7", "the character `?` has no meaning");
    one_error("MSG(\"hello)\nM30\n", "1:5", "this text does not end");
    one_error(
        "%_N_TOOLS_TOA\nM30\n",
        "1:1",
        "a kind of data that is not run here",
    );
    one_error("G123\nM30\n", "1:1", "G123 is not supported");
    one_error("G0 G1 X1 F1\nM30\n", "1:4", "G0 and G1 exclude each other");
    one_error("M77\nM30\n", "1:1", "M77 is not defined");
    one_error("TRAORI\nM30\n", "1:1", "TRAORI is not supported");
    one_error(
        "CYCLE71(10,0,2,-5)\nM30\n",
        "1:1",
        "the cycle CYCLE71 is not supported",
    );
    one_error(
        "R1=$AA_IW[X]\nM30\n",
        "1:4",
        "$AA_IW cannot be evaluated ahead of time",
    );
}

#[test]
fn frames() {
    one_error(
        "TRANS X10 G0 Z5\nM30\n",
        "1:11",
        "G cannot stand in one block with TRANS",
    );
    one_error(
        "G0 X5 TRANS\nM30\n",
        "1:7",
        "TRANS stands alone in its block",
    );
    one_error("SCALE X0\nM30\n", "1:7", "a scale factor of 0");
    one_error("ASCALE X-1\nM30\n", "1:8", "cannot be negative");
    one_error("SCALE X=1/0\nM30\n", "1:11", "division by zero");
    one_error("ROT X200\nM30\n", "1:5", "200 degrees is out of range");
    one_error("ROT Y91\nM30\n", "1:5", "91 degrees is out of range");
    one_error(
        "ROTS X1 Y2 Z3\nM30\n",
        "1:12",
        "two solid angles determine the plane",
    );
    one_error("ROTS X90 Y20\nM30\n", "1:6", "a solid angle of 90 degrees");
    one_error("ROTS RPL=30\nM30\n", "1:6", "ROTS has no RPL");
    one_error(
        "ROT RPL=30 X5\nM30\n",
        "1:5",
        "RPL cannot stand in one block with axes",
    );
    one_error("TRANS A5\nM30\n", "1:7", "acts on X, Y and Z only");
    one_error("TRANS X=IC(5)\nM30\n", "1:7", "AC and IC have no meaning");
    one_error(
        "G41 G1 X1 Y1 F100\nTRANS X5\nM30\n",
        "2:1",
        "the frame changes while cutter compensation is on",
    );
    one_error(
        "G19\nG41 G1 Y1 F100\nM30\n",
        "2:1",
        "cutter compensation in the plane of G19",
    );
    one_error(
        "SCALE X2 Y2\nG41 G1 X1 Y1 F100\nM30\n",
        "2:1",
        "cutter compensation under SCALE",
    );
    one_error(
        "TRANS X1\nG92 X0\nM30\n",
        "2:1",
        "G92 while a frame is active",
    );
}

#[test]
fn motion() {
    one_error("G0 X0 Y0\nG1 X10\nX20\nM30\n", "2:4", "no F is in force");
    one_error("G94 F100\nG95\nG1 X10\nM30\n", "3:4", "no F is in force");
    one_error(
        "X10\nM30\n",
        "1:1",
        "no G0, G1, G2 or G3 before the first motion",
    );
    one_error("G1 X1 F0\nM30\n", "1:7", "the feed must be above 0");
    one_error(
        "G0 X0 Y0\nG2 X10 Y0 I4 F100\nM30\n",
        "2:4",
        "the radius is 4.0000 at the start of this arc and 6.0000 at its end",
    );
    one_error(
        "G0 X0 Y0\nG2 X10 Y0 CR=4 F100\nM30\n",
        "2:11",
        "the radius 4.0000 does not reach the end: at least 5.0000",
    );
    one_error(
        "G0 X0 Y0\nG2 X0 Y0 CR=4 F100\nM30\n",
        "2:10",
        "a full circle by its radius",
    );
    one_error(
        "G2 X1 Y0 F100\nM30\n",
        "1:4",
        "neither a centre nor a radius",
    );
    one_error(
        "G2 X1 Y1 K1 F100\nM30\n",
        "1:10",
        "K is not in the plane that is active",
    );
    one_error(
        "G2 X1 I1 CR=3 F100\nM30\n",
        "1:7",
        "a centre or a radius, not both",
    );
    one_error("G1 X1 I5 F100\nM30\n", "1:4", "belong to arcs");
    one_error(
        "G500\nG2 X5 I5 F100\nM30\n",
        "2:4",
        "an arc while the work offset is off",
    );
    one_error("G4 X1\nM30\n", "1:1", "G4 stands alone");
    one_error(
        "G2 SUPA X1 F1\nM30\n",
        "1:4",
        "only G0 and G1 can move in machine coordinates",
    );
    one_error("T=\"MILL\" M6\nM30\n", "1:1", "no tool is called \"MILL\"");
    one_error("D3\nM30\n", "1:1", "a tool has one offset");
}

#[test]
fn calls() {
    one_error("N30 L99\nM30\n", "1:5", "the subprogram L99 was not found");
    one_error(
        "N30 HOUSING\nM30\n",
        "1:5",
        "`HOUSING` is neither a word of this dialect nor a subprogram that can be found",
    );
    one_error(
        "CALL 5\nM30\n",
        "1:6",
        "CALL needs the name of a subprogram as a text",
    );
    one_error("G0 X1 L10\nM30\n", "1:7", "a subprogram call stands alone");
    let recursion = "%_N_PART_MPF\nL1\nM30\n%_N_L1_SPF\nL2\nM17\n%_N_L2_SPF\nL1\nM17\n";
    one_error(recursion, "8:1", "L1 calls itself");
    assert!(errors(recursion).contains("PART > L1 > L2 > L1"));
    one_error(
        "%_N_A_MPF\nL1 P0\nM30\n%_N_L1_SPF\nM17\n",
        "2:5",
        "at least 1 is needed",
    );
}

#[test]
fn calls_nest_eleven_deep_and_no_deeper() {
    let program = |depth: u32| {
        let mut text = "%_N_PART_MPF\nL1\nM30\n".to_string();
        for level in 1..=depth {
            let next = if level < depth {
                format!("L{}", level + 1)
            } else {
                "G0 X1".into()
            };
            text.push_str(&format!("%_N_L{level}_SPF\n{next}\nM17\n"));
        }
        text
    };
    assert!(crate::shop::translate(&program(11), &[]).contains("G0 X1"));
    assert!(errors(&program(12)).contains("more than 11 subprograms inside each other"));
}

#[test]
fn flow() {
    one_error("GOTOF NOWHERE\nM30\n", "1:7", "there is no such label");
    one_error(
        "AA:\nG0 X1\nGOTOF AA\nM30\n",
        "3:7",
        "GOTOB towards the beginning",
    );
    one_error(
        "IF R1>0\nM30\n",
        "1:1",
        "the ENDIF that belongs to this is missing",
    );
    one_error(
        "ENDWHILE\nM30\n",
        "1:1",
        "the beginning that belongs to this is missing",
    );
    one_error("G0 X=R7\nM30\n", "1:6", "R7 has no value here");
    one_error("G0 X=DEPTH\nM30\n", "1:6", "`DEPTH` is not declared");
    one_error("R1=1 G0 X5\nM30\n", "1:6", "cannot stand in one block");
    one_error(
        "R1=2 R2=5\nIF R1>5 AND R2<3\nENDIF\nM30\n",
        "2:7",
        "comparisons bind weaker",
    );
    one_error("LOOP\nENDLOOP\nM30\n", "1:1", "the program does not end");
    one_error(
        "R1=SQRT(-1)\nM30\n",
        "1:4",
        "has no value for these arguments",
    );
    one_error("R1=SQRT(-1)\nM30\n", "1:4", "a root is of a number");
    one_error(
        "DEF INT LIST[3]\nLIST[3]=5\nM30\n",
        "2:1",
        "the index 3 is outside 0 to 2",
    );
}

#[test]
fn several_errors_are_shown_in_one_run() {
    let shown = errors("N10 TRANZ X1\nN20 SCALE X0\nN30 L5\nN40 G999\nM30\n");
    assert!(shown.contains("4 errors: nothing was written"), "{shown}");
    let marked = "2 | N20 SCALE X0\n  |           ^^\n";
    assert!(shown.contains(marked), "{shown}");
}

#[test]
fn a_flood_of_errors_is_cut_short() {
    let shown = errors(&"?\n".repeat(3000));
    assert!(shown.contains("only the first 50 are shown"));
    assert!(shown.contains("3000 errors: nothing was written"));
    assert!(shown.lines().count() < 500);
}

#[test]
fn files_that_cannot_be_read() {
    let shop = Shop::new(&[]);
    assert!(refused(&shop.run("none.mpf", &[])).contains("none.mpf cannot be read"));
}

#[test]
fn rewriting_refuses_what_it_would_get_wrong() {
    for (program, text) in [
        ("ROT X30\nG0 X1 Y1 Z1\nM30\n", "tilts the tool axis"),
        (
            "ROT Z30\nG0 X1\nM30\n",
            "where Y is in this frame is not known",
        ),
        (
            "ROT Z30\nG0 X1 Y1 Z1\nG18 G2 X3 I1 F1\nM30\n",
            "an arc in a plane that the frame tilts",
        ),
        (
            "SCALE X2\nG0 X0 Y0 Z0\nG41 G1 X1 F9\nG2 X3 I1\nM30\n",
            "an arc under unequal scales with cutter",
        ),
        ("SCALE X2\nG2 X3 I1 F9\nM30\n", "its start is not known"),
    ] {
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &["--backend", "program"]));
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}
