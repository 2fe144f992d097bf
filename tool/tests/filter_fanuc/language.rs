//! Variables, jumps, loops, subprograms and macros.

use crate::one_error::assert_one_error;
use crate::path::{assert_pair, assert_same, plain, steps};
use crate::rs274;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::guess::guess;
use std::path::Path;

/// The X coordinates that a program moves to.
fn places(files: &[(&str, &str)], arguments: &[&str]) -> Vec<f64> {
    let shop = Shop::new(Dialect::Fanuc, files);
    let output = shop.accepted(arguments);
    let canon = rs274::interpret(&shop.path(""), "", &output);
    let moves = canon
        .iter()
        .filter_map(|line| rs274::numbers(line, "STRAIGHT_TRAVERSE"));
    moves.map(|end| end[0]).collect()
}

#[test]
fn arithmetic_has_the_values_of_the_control() {
    for (expression, value) in [
        ("1.+2.*3.", 7.0),
        ("[1.+2.]*3.", 9.0),
        ("-SIN[30.]", -0.5),
        ("COS[60]+TAN[45]", 1.5),
        ("ASIN[.5]+ACOS[.5]", 90.0),
        ("ASIN[-.5]", 330.0),
        ("ATAN[1]/[-1]", 135.0),
        ("ATAN[-1]/[1]", 315.0),
        ("ATAN[1,-1]", 135.0),
        ("AT[1]/[1]+RO[1.2]+SQ[4]+FI[1.5]+fu [1.5]", 51.2),
        ("ATAN[-1]", -45.0),
        ("SQRT[16]+ABS[-2]", 6.0),
        ("FIX[-1.7]+FUP[-1.2]+FUP[1.2]", -1.0),
        // In a word ROUND rounds to thousandths.
        ("ROUND[1.23456]", 1.235),
        ("LN[EXP[2]]", 2.0),
        ("POW[2,3]", 8.0),
        ("17MOD5", 2.0),
        ("12AND10", 8.0),
        ("12OR3", 15.0),
        ("12XOR10", 6.0),
        ("2EQ2", 1.0),
        ("[1LT2]AND[2LT1]", 0.0),
        ("#[10+#11]", 5.0),
        ("10-#0", 10.0),
    ] {
        let program = format!("#11=2\n#12=5\nG0 X[{expression}]\nM30\n");
        let found = places(&[("part.nc", &program)], &[]);
        assert!((found[0] - value).abs() < 1e-4, "{expression}: {found:?}");
    }
}

#[test]
fn flow_goes_where_the_control_goes() {
    for (program, wanted) in [
        (
            "#1=1\nWHILE[#1LE3]DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n",
            vec![1.0, 2.0, 3.0],
        ),
        (
            "#1=1\nWHILE[#1LE2]DO1\n#2=1\nWHILE[#2LE2]DO2\nG0 X[10*#1+#2]\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n",
            vec![11.0, 12.0, 21.0, 22.0],
        ),
        (
            "#1=0\nDO1\n#1=#1+1\nG0 X#1\nIF[#1EQ3]GOTO5\nEND1\nN5 G0 X9.\nM30\n",
            vec![1.0, 2.0, 3.0, 9.0],
        ),
        (
            "GOTO20\nN10 G0 X1.\nM30\nN20 G0 X2.\nGOTO10\n",
            vec![2.0, 1.0],
        ),
        (
            "#1=10\nGOTO#1\nG0 X1.\nN10 G0 X2.\nGOTO[#1+1]\nN11 M30\n",
            vec![2.0],
        ),
        (
            "#1=1\nWH[#1LE2]DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n",
            vec![1.0, 2.0],
        ),
        // Downwards first.
        ("N5 G0 X1.\nGOTO5\nG0 X2.\nN5 G0 X3.\nM30\n", vec![1.0, 3.0]),
        (
            "#1=3\nIF[#1GT2]THEN#1=7\nIF[#1LT2]THEN#1=8\nG0 X#1\nM30\n",
            vec![7.0],
        ),
        (
            "#1=ROUND[2.5]\nG0 X#1\n#2=ROUND[-1.4]\nX#2\nM30\n",
            vec![3.0, -1.0],
        ),
        // A vacant value takes its word away.
        (
            "#1=#0\nG0 X5. Y#1\nX#1\nIF[#1EQ#0]GOTO5\nX6.\nN5 IF[#1EQ0]GOTO6\nX7.\nN6 M30\n",
            vec![5.0, 7.0],
        ),
    ] {
        assert_eq!(places(&[("part.nc", program)], &[]), wanted, "{program}");
    }
}

#[test]
fn subprograms_come_from_the_file_and_from_the_folder() {
    let main = "%\nO1\nG90 G0 X1.\nM98 P2000 L2\nM98 P00020030\nM98 P31\nM98 P0032\nM98 P33\nM30\nO2000\nG91 G0 X1.\nM99\n%\n";
    let step = "G91 G0 X10.\nM99\n";
    let found = places(
        &[
            ("part.nc", main),
            ("O0030.nc", &format!("%\nO0030\n{step}%\n")),
            ("31.tap", &step.replace("10.", "100.")),
            ("o32", &format!("O32(A)\n{}", step.replace("10.", "1000."))),
            ("0033.NC", &format!("O33\n{}", step.replace("10.", "2000."))),
        ],
        &[],
    );
    assert_eq!(found, [1.0, 2.0, 3.0, 13.0, 23.0, 123.0, 1123.0, 3123.0]);
}

#[test]
fn a_subprogram_can_return_to_a_block() {
    let program = "O1\nM98 P2\nG0 X1.\nN50 G0 X2.\nM30\nO2\nG0 X9.\nM99 P50\n";
    assert_eq!(places(&[("part.nc", program)], &[]), [9.0, 2.0]);
}

#[test]
fn macros_have_variables_of_their_own() {
    for (program, wanted) in [
        (
            "O1\n#1=7\nG65 P2 A1. B2.5\nG0 X#1\nM30\nO2\nG0 X[#1+#2]\n#1=9\nM99\n",
            vec![3.5, 7.0],
        ),
        (
            "O1\nG65 P2 L2 X3. Y4.\nM30\nO2\nG0 X[#24*#25]\nM99\n",
            vec![12.0, 12.0],
        ),
        // The second form of the arguments: A1 B2 C3 I4 J5 K6 I7 J8 K9 I10.
        (
            "O1\nG65 P2 A1. B2. C3. I4. J5. K6. I7. J8. K9. I10.\nM30\nO2\n#33=1\nWHILE[#33LE10]DO1\nG0 X[#33*100+#[#33]]\n#33=#33+1\nEND1\nM99\n",
            (1..=10).map(|n| f64::from(n) * 101.0).collect(),
        ),
        // What was not given is vacant.
        (
            "O1\nG65 P2 A5.\nM30\nO2\nIF[#2NE#0]GOTO9\nG0 X#1\nN9 M99\n",
            vec![5.0],
        ),
        // M98 keeps the variables of its caller.
        ("O1\n#1=4\nM98 P2\nM30\nO2\nG0 X#1\nM99\n", vec![4.0]),
        // Common variables come back.
        ("O1\nG65 P2\nG0 X#100\nM30\nO2\n#100=6\nM99\n", vec![6.0]),
        // G66 after each motion, with variables that last.
        (
            "O1\nG66 P2 A1.\nG0 X10.\nF5.\nX20.\nG67\nX30.\nM30\nO2\nG91 G0 X#1\n#1=#1+1\nG90\nM99\n",
            vec![10.0, 11.0, 20.0, 22.0, 30.0],
        ),
    ] {
        assert_eq!(places(&[("part.nc", program)], &[]), wanted, "{program}");
    }
}

#[test]
fn values_can_be_given_and_modes_be_read() {
    assert_eq!(
        places(&[("part.nc", "G0 X#500\nM30\n")], &["--set", "#500=12.5"]),
        [12.5]
    );
    let program = "G0 G91 G17 X2. Y3.\n#1=#4003\n#2=#4001\nG90 G1 F50. X1.\nG#1 G#2 X#5001\nX[#5042+#4109]\nM30\n";
    assert_eq!(
        places(
            &[(
                "part.nc",
                &program
                    .replace("G91 G17 X2.", "G90 X2.")
                    .replace("#4003", "91")
            )],
            &[]
        )
        .len(),
        3
    );
}

#[test]
fn modes_are_those_that_the_program_has_set() {
    for (blocks, variable, value) in [
        ("G55", 4014, 55.0),
        ("G54 P2", 4014, 54.1),
        ("G43 H3", 4008, 43.0),
        ("G43 H3", 4111, 3.0),
        ("G43 H3\nG49", 4008, 49.0),
        ("D5", 4107, 5.0),
        ("", 4009, 80.0),
        ("G0 Z5.\nG82 X1. Z-1. R1. F9.", 4009, 82.0),
        ("", 4012, 67.0),
        ("G43 H3 G0 X7.", 5001, 7.0),
        ("G43 H3\nG49 G0 X7.", 5041, 7.0),
    ] {
        let program = format!("{blocks}\n#1=#{variable}\nG80 G0 X[100+#1]\nM30\n");
        let written = Shop::with(Dialect::Fanuc, &program).accepted(&[]);
        let place = format!("G0 X{} ", 100.0 + value);
        assert!(written.contains(&place), "{program}{written}");
    }
}

#[test]
fn a_stop_shows_its_message_and_an_alarm_ends() {
    let shop = Shop::with(Dialect::Fanuc, "G0 X1.\n#3006=1(TURN THE PART)\nM30\n");
    let written = shop.accepted(&[]);
    assert!(
        written.contains("(MSG, TURN THE PART)") && written.contains("M0"),
        "{written}"
    );
    let shown = Shop::with(Dialect::Fanuc, "G0 X1.\n#3000=5(TOO LONG)\nM30\n").refused(&[]);
    assert!(shown.contains("alarm 5: TOO LONG"), "{shown}");
}

#[test]
fn blocks_can_be_left_out() {
    let program = "G0 X1.\n/X2.\n/3 N5 X3.\nN6 / X4.\nX5.\nM30\n";
    assert_eq!(
        places(&[("part.nc", program)], &[]),
        [1.0, 2.0, 3.0, 4.0, 5.0]
    );
    assert_eq!(
        places(&[("part.nc", program)], &["--skip-blocks"]),
        [1.0, 5.0]
    );
}

#[test]
fn what_tunes_the_control_is_noted() {
    assert_pair(
        "G5.1 Q1\nG8 P1\nG5 P10000\nG62 G0 X1. Y0 Z0\nDPRNT[X#1[35]]\nM41\nG5.1 Q0\nM30\n",
        "G0 X1 Y0 Z0\nM30\n",
    );
    // The axes beside Q3 are no motion; the ends of modes that are not there stand in one block.
    assert_pair(
        "G15 G13.1 G40.1 G50.2 G67\nG1 X1. Y2. Z3. F100.\nG5.1 Q3 X0 Y0 Z0\nX5.\nG5.1 Q2 X0\nM30\n",
        "G1 X1 Y2 Z3 F100\nX5\nM30\n",
    );
}

/// In pieces and as a whole a program is the same, with its header and its end.
#[test]
fn long_programs_are_read_in_pieces() {
    let mut program = "%\n(A PART)\nO1000\nG0 X0 Y0 Z5.\nG1 F1000.\n".to_string();
    for row in 0..200 {
        program += &format!("N{row} X{row}.5 Y.25\n");
    }
    program += "G98 G81 X1. Z-1. R1.\nX2.\nG80\nM30\n%\n";
    let shop = Shop::with(Dialect::Fanuc, &program);
    let whole = shop.accepted(&[]);
    let pieces = shop.accepted(&["--longest-whole", "100", "--piece", "300"]);
    assert_eq!(whole, pieces);
    let canon = rs274::interpret(&shop.path(""), "", &pieces);
    let wanted: String = program
        .lines()
        .skip(3)
        .filter(|line| *line != "%")
        .map(|line| format!("{line}\n"))
        .collect();
    assert_same(&steps(&canon), &plain(&wanted), "pieces");
}

#[test]
fn the_dialect_is_guessed() {
    for text in [
        "%\nO1234 (PART)\nG0 X1.\n",
        ":1234\nG0 X1.\n",
        "G90 G54\nG43 H1 Z50.\n",
        "N10 #1=5\nG0 X#1\n",
        "G0 X1.\nM98 P1000\n",
        "IF [#1 EQ 5] GOTO 10\n",
    ] {
        let found = guess(Path::new("part.nc"), text).map(|guess| guess.dialect);
        assert_eq!(found, Some(Dialect::Fanuc), "{text}");
    }
}

#[test]
fn comments_speak_for_no_dialect() {
    let guessed = |text: &str| guess(Path::new("part.nc"), text).map(|guess| guess.dialect);
    for text in [
        "(T1  D=1. CR=0. - ZMIN=-0.4 - FLAT END MILL)\nG90\n",
        "N10 (T1 CR=0.)\nG0 X10. (CR=1.)\nM6(CR=2.)\n",
        "(T1 1/4\" ENDMILL)\nG0 X1 ; 1/2\" DRILL\n",
        "(P1 = FIRST PASS)\n(CALL THE OPERATOR)\n(IF BROKEN, STOP)\n(RETURN)\n",
        "(V.P. IS THE STOCK, G161)\nG0 X1 ; V.P.\n",
    ] {
        assert_eq!(guessed(text), None, "{text}");
        let headed = format!("%\nO1001\n{}", text.repeat(9));
        assert_eq!(guessed(&headed), Some(Dialect::Fanuc), "{headed}");
    }
    for (text, dialect) in [
        ("MCALL CYCLE81 (R[1],0,2)\n", Dialect::Sinumerik),
        ("G1 X=(R[2]+1)*(R[3])\n", Dialect::Sinumerik),
        ("IF (R[1]==2) GOTOF END\n", Dialect::Sinumerik),
        ("N10 (P1 = P2 + 3)\n", Dialect::Fagor),
        ("(IF P1 EQ 2 GOTO N10)\n", Dialect::Fagor),
        ("G1 X1 \"SLOT (P1)\n", Dialect::Mefi),
        ("#HSC ON (SMOOTH)\n", Dialect::Isg),
    ] {
        assert_eq!(guessed(text), Some(dialect), "{text}");
    }
}

/// Behind an error the position is not known, which is no second error.
#[test]
fn one_error_is_not_followed_by_those_that_come_of_it() {
    let program = "O1\nG90 G54 G0 X0 Y0 Z50.\nG76 X60. Z-5. R2. I0.2 J0 F50.\nG91 X5. L2\nG80 G90\nM3 S100\n\
                   G81 X1. Y1. Z-1. R1. F100.\nG80\nM30\n";
    let shown = Shop::with(Dialect::Fanuc, program).refused(&[]);
    assert_one_error(&shown, program, "part.nc:3:1", "the spindle does not turn");
}

#[test]
fn a_jump_behind_then_is_told_how_it_is_written() {
    let program = "O1\nIF[1EQ1]THEN GOTO 10\nN10 M30\n";
    let shown = Shop::with(Dialect::Fanuc, program).refused(&[]);
    let words = "write IF[..]GOTO 10, without THEN";
    assert_one_error(&shown, program, "part.nc:2:14", words);
}
