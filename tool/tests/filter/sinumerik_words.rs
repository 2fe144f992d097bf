//! Words that the control has for itself: none is a variable, each is told by name; and jumps whose target is a text.

use crate::one_error::assert_one_error;
use crate::shop::{Shop, commands, refused, translate};

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

/// IC counts from a place of the work offset, which has no coordinate of the machine.
#[test]
fn increments_are_none_in_machine_coordinates() {
    for block in [
        "G0 SUPA Z=IC(50)",
        "G0 G53 Z=IC(-5)",
        "G0 G153 X5 Z=IC(5)",
        "G1 SUPA Z=IC(5)",
        "DIAMON G0 SUPA Z=IC(5)",
        "G91 G0 SUPA Z5",
        "G91 G0 G53 X=AC(5) Z5",
    ] {
        let column = block.find('Z').expect("Z") + 1;
        one_error(block, column, "an increment in machine coordinates");
    }
    let absolute = "G91 G0 SUPA Z=AC(5)\nDIAMON G53 X=AC(8)\nM30\n";
    let written = commands(&translate(absolute, &["--backend", "program"]));
    assert_eq!(written, ["G53 G0 Z[5+#5403]", "G53 G0 X[4+#5401]", "M30"]);
}

#[test]
fn spindles_are_those_of_the_first() {
    let text = translate(
        "S1=500 M1=3\nSPOS[1]=90\nSPOSA[1]=DC(45)\nLIMS[1]=3000\nM30\n",
        &[],
    );
    for line in ["S500 M3", "M19 R90", "M19 R45"] {
        assert!(
            commands(&text).contains(&line.to_string()),
            "{line}\n{text}"
        );
    }
    for (block, column, name) in [
        ("S2=100", 1, "S2"),
        ("M2=3", 1, "M2"),
        ("T2=3", 1, "T2"),
        ("SPOS[2]=90", 6, "SPOS[2]"),
        ("G0 X1 SPOSA[R1]=90", 13, "SPOSA[..]"),
        ("LIMS[2]=90", 6, "LIMS[2]"),
    ] {
        one_error(
            block,
            column,
            &format!("{name}: only the first spindle is supported"),
        );
        one_error(block, column, "LinuxCNC's spindle 0 is that of");
    }
    one_error("WAITS(1)", 1, "write SPOS, and leave WAITS out");
}

#[test]
fn addresses_that_are_not_taken_say_what_to_write() {
    for (block, text) in [
        ("FRC=20", "F beside it"),
        ("FRCM=77", "F beside it"),
        ("OFFN=2", "add twice the allowance"),
        ("H2=5", "use an M function"),
        ("X1=5", "axes are X Y Z"),
    ] {
        one_error(block, 1, text);
    }
    for block in ["OFFN=0", "FRC=0", "FRCM=0"] {
        assert_eq!(
            commands(&translate(&format!("{block}\nM30\n"), &[])),
            ["M30"]
        );
    }
}

#[test]
fn a_subprogram_that_resembles_a_word_is_looked_for_all_the_same() {
    for (block, similar) in [("TURN1", "TURN"), ("ROTO(1)", "ROT"), ("FOO", "FOR")] {
        one_error(block, 1, &format!("did you mean {similar}"));
        one_error(block, 1, "in the folders of --subprograms");
    }
}

/// G500 is what the program wrote, not the G53 of other controls.
#[test]
fn without_a_work_offset_texts_name_what_switched_it_off() {
    for (blocks, place) in [
        ("ROT RPL=30\nG500\nX5", "4:1"),
        ("G500\nG2 X5 I5", "3:4"),
        ("G500\nG91 X5", "3:5"),
    ] {
        let program = format!("G54 G90 G1 F500\n{blocks}\nM30\n");
        let shown = errors(&program);
        assert_one_error(
            &shown,
            &program,
            &format!("part.mpf:{place}"),
            "is off (G500)",
        );
        assert!(!shown.contains("G53") && !shown.contains("G59"), "{shown}");
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

#[test]
fn the_target_of_a_jump_may_be_a_text() {
    let last = |program: &str| {
        let lines = commands(&translate(program, &[]));
        lines.iter().rfind(|line| line.contains('X')).cloned()
    };
    for (program, at) in [
        (
            "R10=100\nGOTOF \"N\"<<R10\nN90 G0 X5\nGOTOF OUT\nN100 G0 X10\nOUT: Y0\n",
            10,
        ),
        (
            "R6=2\nGOTO \"PART\"<<R6\nPART1: G0 X5\nGOTOF OUT\nPART2: G0 X10\nOUT: Y0\n",
            10,
        ),
        (
            "DEF STRING[20] GOAL=\"Part2\"\nIF 1==1 GOTOF GOAL\nG0 X5\nPART2: G0 Y0\nG0 X7\n",
            7,
        ),
        (
            "DEF STRING[9] TO_[2]=SET(\"AA_\",\"BB_\")\nGOTOF TO_[1]\nAA_: G0 X5\nBB_: G0 X6\n",
            6,
        ),
        ("G0 X1\nGOTOC \"NOWHERE\"<<1\nX2\n", 2),
        (
            "R1=0\nUP_: R1=R1+1\nIF R1<4 GOTOB (\"UP\"<<\"_\")\nG0 X=R1\n",
            4,
        ),
    ] {
        let moved = last(&format!("{program}M30\n")).unwrap_or_default();
        let word = format!("X{at}");
        assert!(
            moved.split(' ').any(|part| part == word),
            "{program}{moved}"
        );
    }
    one_error("GOTOF \"N\"<<500", 7, "the text is here N500");
    one_error("GOTOF \"GOAL\"<<5", 7, "the text is here \"GOAL5\"");
    one_error(
        "CASE 1 OF 1 GOTOF \"GOAL\"",
        19,
        "the label is missing here",
    );
    for (program, text) in [
        ("DEF INT GOAL=5\nGOTOF GOAL\nM30\n", "this is a number"),
        (
            "DEF STRING[9] GOAL=\"AA\"\nGOTOF GOAL\nAA:\nGOAL:\nM30\n",
            "GOAL is a label and a text",
        ),
    ] {
        assert_one_error(&errors(program), program, "part.mpf:2:7", text);
    }
}

#[test]
fn programs_of_heidenhain_are_told_by_name() {
    let conversational = b"0 BEGIN PGM PART MM\n1 TOOL CALL 1 Z S1910\n2 END PGM PART MM\n";
    let iso = b"%1000 G71 *\nN10 G30 G17 X+0 Y+0 Z-40*\n";
    for (name, program) in [("part.h", &conversational[..]), ("part.nc", &iso[..])] {
        let shop = Shop::new(&[(name, program)]);
        for dialect in ["auto", "sinumerik", "fagor", "mefi", "fanuc", "isg"] {
            let shown = refused(&shop.run_in(dialect, name, &[]));
            assert!(shown.contains(&format!("{name}:1:1\n")), "{shown}");
            assert!(
                shown.contains("a program of a Heidenhain control"),
                "{shown}"
            );
            assert!(shown.contains("post it for LinuxCNC"), "{shown}");
            assert!(shown.contains("1 error: nothing was written"), "{shown}");
        }
    }
}
