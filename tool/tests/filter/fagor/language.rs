//! Parameters, conditions, jumps, subroutines.

use super::{errors, translate};
use crate::shop::{Shop, accepted, commands, refused};

/// The X coordinate that a program without frames ends at.
fn last_x(program: &str) -> f64 {
    let lines = translate(program, &[]);
    let line = lines.iter().rev().find(|line| line.contains('X'));
    let word = line.and_then(|line| line.split(' ').find(|word| word.starts_with('X')));
    word.expect("a move in X")[1..].parse().expect("a number")
}

#[test]
fn expressions_have_the_values_of_the_manual() {
    for (expression, value) in [
        ("3 + 4", 7.0),
        ("5 - 2", 3.0),
        ("-(2 * 3)", -6.0),
        ("9 / 2", 4.5),
        ("7 MOD 4", 3.0),
        ("2 EXP 3", 8.0),
        ("2 * 2 EXP 3 + 1", 17.0),
        ("SIN 30", 0.5),
        ("COS 30", 0.8660),
        ("TAN 30", 0.5774),
        ("ASIN 1", 90.0),
        ("ACOS 1", 0.0),
        ("ATAN 1", 45.0),
        ("ARG(-1,-2)", 243.4349),
        ("ABS -8", 8.0),
        ("LOG 100", 2.0),
        ("LN 1", 0.0),
        ("SQRT 16", 4.0),
        ("ROUND 5.83", 6.0),
        ("FIX 5.423", 5.0),
        ("FUP 5.423", 6.0),
        ("FUP 7", 7.0),
        ("2 * SIN 30 * 2", 2.0),
        ("P(1 + 1)", 42.0),
        ("P2 - P2 / 2", 21.0),
    ] {
        let program = format!("(P2 = 42)\n(P1 = {expression})\nG0 XP1\nM30\n");
        assert!((last_x(&program) - value).abs() < 1e-4, "{expression}");
    }
}

#[test]
fn parameters_stand_behind_every_address() {
    let program = "(P1=2, P2=-5, P100=1)\nGP100 X-P2 YP1 F P2 F100\nM30\n";
    assert!(errors(program, &[]).contains("F is in this block twice"));
    let program = "(P1=2, P2=-5, P100=1)\nGP100 X-P2 Y+P1 ZP2 F100\nM30\n";
    assert_eq!(translate(program, &[]), ["G1 X5 Y2 Z-5 F100", "M30"]);
    let given = translate("G0 XP5\nM30\n", &["--set", "P5=2.5"]);
    assert_eq!(given[0], "G0 X2.5");
}

#[test]
fn conditions_and_jumps() {
    for (program, value) in [
        ("(P1=1)\n(IF P1 EQ 1 P2=10 ELSE P2=20)\nG0 XP2\nM30\n", 10.0),
        ("(P1=3)\n(IF P1 EQ 1 P2=10 ELSE P2=20)\nG0 XP2\nM30\n", 20.0),
        (
            "(P1=3)\nG0 X1\n(IF P1 GT 3 GOTO N20)\nX2\nN20 Y0\nM30\n",
            2.0,
        ),
        (
            "(P1=4)\nG0 X1\n(IF P1 GT 3 GOTO N20)\nX2\nN20 Y0\nM30\n",
            1.0,
        ),
        (
            "(P1=0)\nN10 (P1=P1+1)\n(IF P1 LT 5 GOTO N10)\nG0 XP1\nM30\n",
            5.0,
        ),
        (
            "(P1=1,P2=2)\n(IF P1 EQ 1 AND P2 EQ 2 OR P1 EQ 7 P3=1 ELSE P3=0)\nG0 XP3\nM30\n",
            1.0,
        ),
        (
            "(P1=1)\n(IF NOT (P1 EQ 1) P3=1 ELSE P3=0)\nG0 XP3\nM30\n",
            0.0,
        ),
        ("G0 X1\n(GOTO N30)\nX2\nN30 Y0\nM30\n", 1.0),
        ("G0 X0\nN10 G91 X1\nN20 Y0\n(RPT N10,N20) N3\nM30\n", 4.0),
        ("(P7=2)\nG0 X0\nN10 G91 X1\n(RPT N10,10) NP7\nM30\n", 3.0),
        ("G0 X0\nN10 G91 X1\n(RPT N10,10) N0\nM30\n", 1.0),
    ] {
        assert_eq!(last_x(program), value, "{program}");
    }
}

#[test]
fn subroutines_share_or_have_parameters() {
    let program = "\
(P1=1, P100=5)
(CALL 7)
G0 XP1
(PCALL 8, A=3, P2=4)
G0 YP1 ZP101
M30
(SUB 7)
(P1=P1+P100)
(RET)
(SUB 8)
(P1=P0*10+P2, P101=P1)
(RET)
";
    let lines = translate(program, &[]);
    assert_eq!(lines, ["G0 X6", "G0 Y6 Z34", "M30"]);
}

#[test]
fn modal_subroutines_run_at_once_and_after_each_motion() {
    let program = "\
G90 G0 X0 Y0 Z10
(MCALL 1, Z=-2)
X10
S500
Y10
(MDOFF)
X20
M30
(SUB 1)
G1 ZP25 F100
G0 Z10
(RET)
";
    assert_eq!(
        translate(program, &[]),
        [
            "G0 X0 Y0 Z10",
            "G1 Z-2 F100",
            "G0 Z10",
            "G0 X10",
            "G1 Z-2 F100",
            "G0 Z10",
            "S500",
            "G0 Y10",
            "G1 Z-2 F100",
            "G0 Z10",
            "G0 X20",
            "M30"
        ]
    );
}

/// The parameters are those of the call in the first pass only.
#[test]
fn modal_subroutines_run_as_often_as_n_says() {
    let program = "\
G90 G0 X0 Y0 Z10
(MCALL 1, A=3)
X10 N2
X20 N0
M30
(SUB 1)
(P0=P0+1)
G0 ZP0
(RET)
";
    let wanted = [
        "G0 X0 Y0 Z10",
        "G0 Z4",
        "G0 X10",
        "G0 Z4",
        "G0 Z5",
        "G0 X20",
        "M30",
    ];
    assert_eq!(translate(program, &[]), wanted);
    let head = "G90 G0 X0 Y0 Z10\n(MCALL 1)\n";
    let end = "M30\n(SUB 1)\nG0 Y5\n(RET)\n";
    for (block, text) in [
        ("S500 N2", "N without a motion"),
        ("G81 X10 Z2 I-5 F100 N2", "both are in force"),
    ] {
        let shown = errors(&format!("{head}{block}\n{end}"), &[]);
        assert!(shown.contains(text), "{shown}");
    }
    let inside = "(SUB 1)\nG91 X1 N3\n(RET)\nG90 G0 X0 Y0\n(MCALL 1)\nM30\n";
    assert!(errors(inside, &[]).contains("none is active"));
}

#[test]
fn subroutines_are_found_in_the_files_beside_the_program() {
    let shop = Shop::new(&[
        ("job/part.pim", b"(CALL 10)\n(CALL 20)\nM30\n"),
        (
            "job/other.PIM",
            b"%OTHER,MX--,\nG0 X99 ?\nM30\n(SUB 11)\n(RET)\n",
        ),
        (
            "job/tools.pim",
            b"%TOOLS,MX--,\nM30\n(SUB 10)\nG0 X10\n(RET)\n",
        ),
        ("shared/more.nc", b"(SUB 0020)\nG0 X20\n(RET)\n"),
    ]);
    let output = accepted(&shop.run_in("fagor", "job/part.pim", &["--subprograms", "shared"]));
    assert_eq!(commands(&output), ["G0 X10", "G0 X20", "M30"]);
    assert!(output.contains("(--- SUB 10 in tools.pim ---)"));
    let twice = Shop::new(&[
        ("part.pim", b"G0 X1\n(CALL 10)\nM30\n"),
        ("a.pim", b"(SUB 10)\n(RET)\n"),
        ("b.pim", b"(SUB 10)\n(RET)\n"),
    ]);
    let shown = refused(&twice.run_in("fagor", "part.pim", &[]));
    assert!(shown.contains("SUB 10 is defined in"), "{shown}");
    assert!(shown.contains("part.pim:2:2"), "{shown}");
}

/// Only the files that define a subroutine are of any concern.
#[test]
fn files_that_are_looked_through_for_subroutines() {
    let shop = Shop::new(&[
        ("part.pim", b"(CALL 10)\nM30\n"),
        ("a.pim", b"; Fr\xe4ser\nM30\n"),
        ("b.pim", b"(SUB 10)\nG0 X10\n(RET)\n"),
    ]);
    let output = shop.run_in("fagor", "part.pim", &["--encoding", "utf-8"]);
    assert_eq!(commands(&accepted(&output)), ["G0 X10", "M30"]);
    let guessed = shop.run_in("fagor", "part.pim", &[]);
    let said = String::from_utf8_lossy(&guessed.stderr).to_string();
    assert!(!said.contains("a.pim"), "{said}");
    // It could define the subroutine a second time.
    std::os::unix::fs::symlink("nowhere.pim", shop.path("c.pim")).expect("a link");
    let output = shop.run_in("fagor", "part.pim", &[]);
    let warned = accepted(&output) + &String::from_utf8_lossy(&output.stderr);
    assert!(
        warned.contains("c.pim cannot be read, whether it defines"),
        "{warned}"
    );
}

#[test]
fn messages_comments_and_skipped_blocks() {
    let program = "(MSG \"load part\")\n/G0 X1 ; only if\n/2 N10 X2\nG0 X3\nM30\n";
    assert_eq!(
        translate(program, &["--skip-blocks"]),
        ["(MSG, load part)", "G0 X3", "M30"]
    );
    assert!(errors("/4 G0 X1\nM30\n", &[]).contains("/1, /2 and /3"));
}

#[test]
fn the_language_is_guessed_and_said() {
    let shop = Shop::new(&[
        ("part.nc", b"%PART,MX--,\nG0 X1\nM30\n"),
        ("part.mpf", b"G0 X1\nM30\n"),
        ("plain.nc", b"G0 X1\nM30\n"),
    ]);
    let output = shop.run_in("auto", "part.nc", &[]);
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert!(
        said.contains("taken as a fagor program, because of line 1"),
        "{said}"
    );
    assert!(accepted(&output).starts_with("(part.nc: fagor program"));
    let output = shop.run_in("auto", "part.mpf", &[]);
    let said = String::from_utf8_lossy(&output.stderr).to_string();
    assert!(
        said.contains("sinumerik program, because of the ending"),
        "{said}"
    );
    // As without the option.
    let guessed = shop.run_without_dialect("part.mpf");
    assert_eq!(guessed, output);
    let shown = refused(&shop.run_in("auto", "plain.nc", &[]));
    assert_eq!(refused(&shop.run_without_dialect("plain.nc")), shown);
    assert!(shown.contains("in which language"), "{shown}");
    assert!(shown.contains("1 error: nothing was written"), "{shown}");
}

/// It is not left out: corners are rounded from there on.
#[test]
fn the_note_of_g50_says_what_is_done() {
    let shop = Shop::new(&[("part.pim", b"%X,MX--,\nG7 G1 X10 F100\nG50\nY10\nM30\n")]);
    let output = accepted(&shop.run_in("fagor", "part.pim", &[]));
    assert!(
        output.contains("(MSG, line 3: G50 rounds corners"),
        "{output}"
    );
    assert!(output.contains("G64 P0.01 (line 3)"), "{output}");
    assert!(!output.contains("left out"), "{output}");
}
