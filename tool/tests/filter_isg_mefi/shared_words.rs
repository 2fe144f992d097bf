//! Most words of ISG kernels are those of newer Fagor controls too, where some mean something else: they do not
//! decide in which language a program is.

use crate::one_error::assert_one_error;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

const SHARED: &str =
    "the Fagor 8060, 8065 and 8070 have this word and all others that speak for isg";

#[test]
fn words_that_other_controls_have_too_do_not_decide() {
    for (program, place) in [
        ("T5 D1 M6\n#MSG[\"OPT1: FACE\"]\nG0 X0 Y0\nM30\n", "2:1"),
        ("#MSG [\"G21, V.L. AND PATH_DEV\"]\nG0 X0 Y0\nM30\n", "1:1"),
        (
            "G0 X20 Y0\nG261\n$FOR P1=1,2,1\nG0 X5\n$ENDFOR\nM30\n",
            "2:1",
        ),
        (
            "G0 X1\n#HSC ON [CONTERROR 0.02]\nG0 X5\n#HSC OFF\nM30\n",
            "2:1",
        ),
        ("G0 X1\nV.P.DEEP = 5\nG0 X5\nM30\n", "2:1"),
        ("G0 X1\n#CS DEF [1] [MODE 1,0,0,0,0,90]\nM30\n", "2:1"),
    ] {
        let shown = Shop::with(Dialect::Auto, program).refused(&[]);
        assert_one_error(&shown, program, &format!("part.nc:{place}"), SHARED);
        assert!(shown.contains("give --dialect isg"), "{shown}");
        // What is said to be written instead.
        if !program.contains("MODE") {
            Shop::with(Dialect::Isg, program).accepted(&[]);
        }
    }
}

#[test]
fn one_word_that_they_do_not_have_does() {
    let shared = "$IF 1 == 1\nG0 X5\n$ENDIF\n#MSG [\"TEXT\"]\nG0 X6\n";
    for own in [
        "G21\nG20",
        "#VAR\nV.L.DEEP = 5\n#ENDVAR",
        "#CONTOUR MODE [DEV PATH_DEV 0.02]",
        "#CS ON [1,2,3,0,0,0]\n#CS OFF",
    ] {
        let program = format!("{shared}{own}\nG0 X7\nM30\n");
        let guessed = Shop::with(Dialect::Auto, &program).accepted(&[]);
        assert_eq!(guessed, Shop::with(Dialect::Isg, &program).accepted(&[]));
    }
}
