//! Programs of lathes are refused: their words would become something else.

use crate::one_error::assert_one_error;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

const NOT_TRANSLATED: &str = "programs of lathes of this control are not translated";

#[test]
fn words_that_a_lathe_gives_a_meaning_are_refused() {
    let begin = "O1\nG21 G97 S500 M3\nG0 X52. Z2.\n";
    for dialect in [Dialect::Fanuc, Dialect::Auto] {
        for (program, place, words) in [
            (
                "G90 X48. Z-30. F0.2\nX44.\nG92 X43. Z-20. F1.5\nX42.5\n",
                "6:16",
                "F beside G92 is the pitch of a lathe's thread",
            ),
            (
                "G50 S2000\nT0101\nG92 X43. Z-20. F1.5\n",
                "4:5",
                "S beside G50 is the limit of the speed of a lathe",
            ),
            (
                "T0101\nG90 X48. Z-30. F0.2\nT0303\n",
                "4:1",
                "T with four digits, and no M6 in the program",
            ),
        ] {
            let program = format!("{begin}{program}M30\n");
            let shown = Shop::with(dialect, &program).refused(&[]);
            assert_one_error(&shown, &program, &format!("part.nc:{place}"), words);
            assert!(shown.contains(NOT_TRANSLATED), "{shown}");
        }
    }
}

#[test]
fn cycles_of_lathes_are_called_so() {
    for code in ["G32", "G70", "G71", "G72", "G75"] {
        let shown = Shop::with(Dialect::Fanuc, &format!("{code} P10 Q20\nM30\n")).refused(&[]);
        assert!(
            shown.contains(&format!("{code} is not supported")),
            "{shown}"
        );
        assert!(shown.contains(NOT_TRANSLATED), "{shown}");
    }
}

#[test]
fn programs_of_mills_are_not() {
    for program in [
        "T0101 M6\nG0 X1.\nM30\n",
        "T1001\nM6\nT1002\nG0 X1.\nM30\n",
        "T12\nG0 X1.\nM30\n",
        "G50\nS2000 M3\nG92 S2000\nG0 X1.\nF100.\nG92 X0\nM30\n",
    ] {
        Shop::with(Dialect::Fanuc, program).accepted(&[]);
    }
}

#[test]
fn on_a_lathe_no_program_is_taken() {
    let program = "G0 X1. Z2.\nM30\n";
    for (ini, is_lathe) in [
        ("[DISPLAY]\nLATHE = 1\n", true),
        (
            "[DISPLAY]\nLATHE = yes\n[TRAJ]\nCOORDINATES = X Y Z\n",
            true,
        ),
        ("[TRAJ]\nCOORDINATES = X Z\n", true),
        ("[DISPLAY]\nLATHE = 0\n[TRAJ]\nCOORDINATES = X Y Z\n", false),
        ("[DISPLAY]\nDISPLAY = axis\n", false),
    ] {
        let shop = Shop::new(
            Dialect::Fanuc,
            &[("part.nc", program), ("machine.ini", ini)],
        );
        let arguments = ["--ini", "machine.ini"];
        if is_lathe {
            let shown = shop.refused(&arguments);
            assert!(shown.contains("the INI file is that of a lathe"), "{shown}");
            assert!(shown.contains(NOT_TRANSLATED), "{shown}");
        } else {
            shop.accepted(&arguments);
        }
    }
}
