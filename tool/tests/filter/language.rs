//! Arithmetic, flow, subprograms, files: what the programs of a shop hold besides moves.

use crate::shop::{Shop, accepted, commands, translate};

/// The X coordinate that a program without frames ends at.
fn last_x(program: &str) -> f64 {
    let output = translate(program, &[]);
    let lines = commands(&output);
    let moves: Vec<&String> = lines.iter().filter(|line| line.contains('X')).collect();
    let last = moves.last().expect("a move");
    let word = last
        .split(' ')
        .find(|word| word.starts_with('X'))
        .expect("X");
    word[1..].parse().expect("a number")
}

#[test]
fn expressions_have_the_values_of_the_control() {
    for (expression, value) in [
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("-2+5", 3.0),
        ("7/2", 3.5),
        ("7 DIV 2", 3.0),
        ("-7 DIV 2", -3.0),
        ("7 MOD 4", 3.0),
        ("10-4-3", 3.0),
        ("2*SIN(30)", 1.0),
        ("COS(60)+TAN(45)", 1.5),
        ("ASIN(1)+ACOS(1)", 90.0),
        ("ATAN2(30.5,80.1)", 20.8455),
        ("SQRT(16)+POT(3)+ABS(-1)", 14.0),
        ("TRUNC(-2.7)+ROUND(2.5)", 1.0),
        ("LN(EXP(2))", 2.0),
        ("MINVAL(3,4)+MAXVAL(3,4)", 7.0),
        ("BOUND(-1,1,7)", 1.0),
        ("1.5EX3", 1500.0),
        ("25EX-1", 2.5),
        ("(1<2) AND NOT (2<1)", 1.0),
        ("(1<2) XOR TRUE", 0.0),
        ("(2>=2) + (1<>1) + (3==3)", 2.0),
        ("0.1+0.2==0.3", 1.0),
        ("R[1+1]", 42.0),
        ("LENGTHS[1,2]", 6.0),
    ] {
        let program =
            format!("DEF REAL LENGTHS[2,3]=4\nLENGTHS[1,2]=6\nR2=42\nG0 X={expression}\nM30\n");
        assert!((last_x(&program) - value).abs() < 1e-4, "{expression}");
    }
}

#[test]
fn loops_and_conditions() {
    for (program, value) in [
        ("R1=0\nWHILE R1<5\nR1=R1+2\nENDWHILE\nG0 X=R1\nM30\n", 6.0),
        (
            "R1=0\nFOR R2=1 TO 4\nR1=R1+R2\nENDFOR\nG0 X=R1\nM30\n",
            10.0,
        ),
        ("R1=5\nFOR R2=3 TO 1\nR1=0\nENDFOR\nG0 X=R1\nM30\n", 5.0),
        ("R1=0\nREPEAT\nR1=R1+1\nUNTIL R1>=3\nG0 X=R1\nM30\n", 3.0),
        (
            "R1=0\nLOOP\nR1=R1+1\nIF R1==7 GOTOF OUT\nENDLOOP\nOUT: G0 X=R1\nM30\n",
            7.0,
        ),
        (
            "R1=1\nIF R1==1\nR2=10\nELSE\nR2=20\nENDIF\nG0 X=R2\nM30\n",
            10.0,
        ),
        (
            "R1=2\nIF R1==1\nR2=10\nELSE\nR2=20\nENDIF\nG0 X=R2\nM30\n",
            20.0,
        ),
        // a line of letters that are words of motions too
        (
            "DEF BOOL FAST=TRUE\nIF FAST\nR2=10\nELSE\nIF FAST\nR2=5\nELSE\nR2=20\nENDIF\nENDIF\nG0 X=R2\nM30\n",
            10.0,
        ),
        (
            "DEF INT A_B=1, XY=0\nN1 if XY\nR2=10\nELSE\nR2=20\nENDIF\nG0 X=R2\nM30\n",
            20.0,
        ),
        (
            "R1=0\nAGAIN: R1=R1+1\nIF R1<4 GOTOB AGAIN\nG0 X=R1\nM30\n",
            4.0,
        ),
        ("G0 X1\nGOTOF N50\nX2\nN50 Y0\nM30\n", 1.0),
        ("G0 X1\nGOTOC NOWHERE\nX2\nM30\n", 2.0),
        (
            "R1=2\nCASE R1 OF 1 GOTOF AA 2 GOTOF BB DEFAULT GOTOF CC\nAA: G0 X1\nGOTOF CC\nBB: G0 X2\nCC: Y0 G0\nM30\n",
            2.0,
        ),
        (
            "DEF INT COUNT=2.6\nDEF BOOL YES=7\nG0 X=COUNT+YES\nM30\n",
            4.0,
        ),
    ] {
        assert_eq!(last_x(program), value, "{program}");
    }
}

#[test]
fn subprograms_are_sections_and_files_and_repeat() {
    let shop = Shop::new(&[
        (
            "job/part.mpf",
            b"L10 P2\nl010\nPOCKET\nEDGE P=3\nM30\n%_N_EDGE_SPF\nG91 G0 X1\nG90\nRET\n",
        ),
        ("job/L10.SPF", b"G0 X10\nM17\n"),
        ("job/l010.spf", b"G0 X11\n"),
        (
            "shared/Pocket.Spf",
            b"%_N_POCKET_SPF\n;$PATH=/_N_SPF_DIR\nG0 X12 M17\n",
        ),
    ]);
    let output = accepted(&shop.run("job/part.mpf", &["--subprograms", "shared"]));
    assert_eq!(
        commands(&output),
        [
            "(MSG, line 1: the subprogram ends without M17)",
            "G0 X10",
            "G0 X10",
            "G0 X11",
            "G0 X12",
            "G0 X13",
            "G0 X14",
            "G0 X15",
            "M30"
        ]
    );
    assert!(output.contains("(--- L10 in L10.SPF, pass 2 of 2 ---)"));
    assert!(output.contains("(--- EDGE in part.mpf, pass 3 of 3 ---)"));
    assert!(!output.contains("_N_SPF_DIR"));
}

#[test]
fn subprograms_are_called_by_text_and_may_have_a_head() {
    let program = "%_N_PART_MPF\nCALL \"Edge\"\nM30\n\
                   %_N_EDGE_SPF\nPROC EDGE DISPLOF\nG0 X3\nRET\n";
    assert_eq!(last_x(program), 3.0);
    // The length of a text does not matter.
    let program = "%_N_PART_MPF\nEDGE(\"abc\",3)\nM30\n\
                   %_N_EDGE_SPF\nPROC EDGE(STRING[20] TXT, REAL PLACE)\nMSG(TXT)\nG0 X=PLACE\nRET\n";
    assert_eq!(last_x(program), 3.0);
}

#[test]
fn variables_of_a_subprogram_are_its_own_and_r_parameters_are_not() {
    let program = "%_N_PART_MPF\nDEF REAL DEPTH=1\nR1=5\nL1\nG0 X=R1+DEPTH\nM30\n\
                   %_N_L1_SPF\nDEF REAL DEPTH=100\nR1=R1+DEPTH\nM17\n";
    assert_eq!(last_x(program), 106.0);
    let given = translate("G0 X=R5\nM30\n", &["--set", "R5=2.5"]);
    assert_eq!(commands(&given)[0], "G0 X2.5");
}

#[test]
fn skipped_blocks_follow_the_setting() {
    let program = "/G0 X1\n/3 N20 G0 X2\nM30\n";
    assert_eq!(
        commands(&translate(program, &[])),
        ["G0 X1", "G0 X2", "M30"]
    );
    assert_eq!(commands(&translate(program, &["--skip-blocks"])), ["M30"]);
}

#[test]
fn encodings_and_line_ends() {
    let shop = Shop::new(&[
        ("cp1252.mpf", b"G0 X1 ; Pa\xf1o\r\nM30\r\n"),
        ("utf8.mpf", "G0 X1 ; Paño\rM30\r".as_bytes()),
        ("mark.mpf", b"\xef\xbb\xbfG0 X1 ; Pa\xc3\xb1o\nM30"),
        ("tape.mpf", b"\0\0%\nG0 X1 ; Pa\xf1o\nM30\n\0\0\x1a"),
    ]);
    for name in ["cp1252.mpf", "utf8.mpf", "mark.mpf", "tape.mpf"] {
        let output = accepted(&shop.run(name, &[]));
        assert_eq!(commands(&output), ["G0 X1", "M30"], "{name}");
        assert!(output.contains("Paño"), "{name}");
    }
}

#[test]
fn comments_and_messages_are_harmless() {
    let program =
        "; DEBUG,#1 (nested)\nMSG(\"Tool \"<<2+1<<\" (left)\")\nG0 X1 ; MSG, no\nMSG()\nM30\n";
    let output = translate(program, &[]);
    assert!(output.contains("(line 1: DEBUG,#1 [nested])"));
    assert!(output.contains("(MSG, Tool 3 [left])"));
    assert!(output.contains("G0 X1 (line 3: MSG, no)"));
    let long = format!("G0 X1 ;{}\nM30\n", "é".repeat(400));
    assert!(translate(&long, &[]).lines().all(|line| line.len() < 255));
}

#[test]
fn progress_goes_to_standard_error() {
    let shop = Shop::new(&[("part.mpf", b"G0 X1\nM30\n")]);
    let output = shop.run("part.mpf", &[]);
    let progress = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(progress.starts_with("FILTER_PROGRESS=0\n"));
    assert!(progress.ends_with("FILTER_PROGRESS=100\n"));
    assert!(
        progress
            .lines()
            .all(|line| line.starts_with("FILTER_PROGRESS="))
    );
}

/// How a widespread post begins and ends its programs for this control.
#[test]
fn a_program_of_a_cam_system() {
    let program = "\
; %_N_1001_MPF
N10 G54
N11 G17 G710 G90 G94
N12 WORKPIECE(,\"\",,\"BOX\",112,0,-51,,50,25,-50,-25)
N13 G64
N14 G0 SUPA Z0 D0
N15 MSG (\"2D-Contour\")
N16 T3
N17 M6
N18 D1
N19 S5000 M3
N20 G54
N21 CYCLE832(0.01,1,1)
N22 G0 X-51 Y32.65
N23 Z15
N24 G1 Z-2 F333
N25 G3 X-47 Y28.65 CR=4
N26 CYCLE832()
N27 M9
N28 M5
N29 G0 SUPA Z0 D0
N30 CYCLE800()
N31 M30
";
    assert_eq!(
        commands(&translate(program, &[])),
        [
            "(MSG, line 4: WORKPIECE tunes the other control and is left out)",
            "(MSG, line 22: CYCLE800[] tunes the other control and is left out)",
            "G54",
            "G94 G17",
            "G64 P0.01",
            "G53 G0 Z0 G49",
            "(MSG, 2D-Contour)",
            "T3",
            "M6 G43",
            "G43",
            "S5000 M3",
            "G54",
            "G64 P0.01",
            "G0 X-51 Y32.65",
            "G0 Z15",
            "G1 Z-2 F333",
            "G3 X-47 Y28.65 I4 J0",
            "G64 P0.01",
            "M9",
            "M5",
            "G53 G0 Z0 G49",
            "M30",
        ]
    );
}
