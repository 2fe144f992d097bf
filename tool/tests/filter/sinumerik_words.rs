//! Words that the control has for itself: none is a variable, each is told by name.

use crate::one_error::assert_one_error;
use crate::shop::{Shop, refused};

/// The error text of a program that must be refused.
fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &[]))
}

/// Checks that a block in a program has exactly one error, in this column, with this text in it.
fn one_error(block: &str, column: usize, text: &str) {
    let program = format!("G54 G90 G94 F500\n{block}\nM30\n");
    let place = format!("part.mpf:2:{column}");
    assert_one_error(&errors(&program), &program, &place, text);
}

#[test]
fn words_of_the_control_are_no_variables() {
    for word in [
        "TOFFL", "TOFFR", "TOFF", "OVR", "OVRRAP", "OVRA", "FB", "FD", "FDA", "FL", "FZ", "SF",
        "DITS", "DITE", "SD", "PW", "PL", "PO", "LEAD", "TILT", "NUT", "THETA", "FXST", "DISC",
        "DISPR", "FP", "SPN", "DILF",
    ] {
        let text = format!("{word} is not supported");
        one_error(&format!("{word}=1"), 1, &text);
        one_error(&format!("G1 X7 {word}=50"), 7, &text);
        one_error(&format!("R1=2 {word}=50"), 6, &text);
        one_error(&format!("DEF REAL DEPTH, {word}"), 17, &text);
        one_error(&format!("PROC PART(REAL {word})"), 16, &text);
    }
    for word in ["MSG", "SIN", "TO", "GOTOF", "INT", "SUPA", "RND"] {
        let text = format!("{word} is a word of the control and cannot be a variable");
        one_error(&format!("DEF INT {word}"), 9, &text);
    }
    one_error("MSG=5", 1, "MSG is a word of the control");
    one_error("R1=RND", 4, "RND is a word of the control");
}

#[test]
fn words_that_act_beside_the_path_are_named() {
    for (block, word, text) in [
        ("POS[X]=100", "POS", "as G0 X100"),
        ("POSA[X]=100", "POSA", "positioning axes"),
        ("IDS=1 DO $AC_OVR=50", "IDS", "synchronised actions"),
        ("ID=1 WHENEVER TRUE DO M8", "ID", "synchronised actions"),
        ("MEAS=1 X5", "MEAS", "measuring"),
        ("PTP", "PTP", "transformations"),
        ("GEOAX()", "GEOAX", "axes cannot be exchanged"),
    ] {
        one_error(block, 1, &format!("{word} is not supported"));
        one_error(block, 1, text);
    }
    for (block, text) in [
        ("G74 X1=0 Z1=0", "homing"),
        ("G75 X1=0", "G0 SUPA Z0 D0"),
        ("G25 X0 Y0", "soft limits"),
        ("G26 S2000", "LIMS=2000"),
    ] {
        one_error(block, 1, &format!("{} is not supported", &block[..3]));
        one_error(block, 1, text);
    }
}

#[test]
fn statements_stand_alone_in_their_block() {
    for (block, column, word) in [
        ("G0 X10 MCALL CYCLE81(10,0,2,-5)", 8, "MCALL"),
        ("G91 MCALL CYCLE81(10,0,2,-5)", 5, "MCALL"),
        ("G0 X1 MSG(\"HELLO\")", 7, "MSG"),
        ("M5 RET", 4, "RET"),
        ("G0 X1 GOTOF END", 7, "GOTOF"),
    ] {
        let text = format!("{word} stands alone in its block");
        one_error(block, column, &text);
        assert!(!errors(&format!("{block}\nM30\n")).contains("did you mean"));
    }
    one_error("SAVE", 1, "SAVE does not begin a block");
}
