//! Drilling cycles and patterns with the parameter lists of current posts: the same job as in plain
//! LinuxCNC code, and each parameter that is not translated refused by its name.

use crate::pairs::assert_pair;
use crate::shop::{Shop, commands, refused, translate};

const HEAD: &str = "G17 G90 G0 X10 Y5 Z20\nS500 M3 F100\n";
const PLAIN_HEAD: &str = "G21 G17 G90 G0 X10 Y5 Z20\nS500 M3 F100\n";

fn same(cycle: &str, plain: &str) {
    assert_pair(
        &format!("{HEAD}{cycle}\nM30\n"),
        &format!("{PLAIN_HEAD}{plain}\nM2\n"),
    );
}

#[test]
#[should_panic(expected = "step 2")]
fn a_pair_that_differs_is_seen() {
    same("CYCLE81(10,0,2,-5)", "G0 Z2\nG1 Z-5.001\nG0 Z10");
}

#[test]
fn drilling_with_modes_is_drilling() {
    let drilled = "G0 Z2\nG1 Z-5\nG0 Z10";
    let waited = "G0 Z2\nG1 Z-5\nG4 P0.5\nG0 Z10";
    let revolutions = "G0 Z2\nG1 Z-5\nG4 P1.2\nG0 Z10";
    let reamed = "G0 Z2\nF80\nG1 Z-5\nG4 P0.5\nF200\nG1 Z2\nG0 Z10";
    let bored = "G0 Z2\nG1 Z-5\nG4 P0.5\nM19 R90\nG0 X9 Y5.5\nG0 Z2\nG0 X10 Y5 Z10";
    for (cycle, plain) in [
        // As Fusion's post writes it, and as the editor of the control does.
        ("CYCLE81(10,0,2,-5,,0,0,10)", drilled),
        ("CYCLE81(10,0,2,-5,,,0,0,0)", drilled),
        ("CYCLE81(10,0,2,,5,0,0,1,11)", drilled),
        ("CYCLE81(10,0,2,-5,7,0,0,1,12)", drilled),
        ("CYCLE81(10,0,2,-5,,0.5,0,1,12)", waited),
        ("CYCLE82(10,0,2,-5,,0.5,0,0,10)", waited),
        ("CYCLE82(10,0,2,-5,,10,0,0,20)", revolutions),
        ("CYCLE82(10,0,2,-5,,-10,0,0,0)", revolutions),
        ("CYCLE82(10,0,2,-5,,0.5,0,1,12,0,0,0,0,0)", waited),
        ("CYCLE85(10,0,2,-5,,0.5,80,200,0,0,0)", reamed),
        ("CYCLE85(10,0,2,,5,0.5,80,200,0,1,11)", reamed),
        ("CYCLE86(10,0,2,-5,,0.5,3,-1,0.5,0,90,0,0,10)", bored),
    ] {
        same(cycle, plain);
    }
}

#[test]
fn deep_holes_in_the_strokes_of_current_posts() {
    let cleared =
        "G0 Z2\nG1 Z-5\nG0 Z2\nG0 Z-4.4\nG1 Z-10\nG0 Z2\nG0 Z-9.4\nG1 Z-12\nG4 P0.5\nG0 Z10";
    let broken = "G0 Z2\nG1 Z-5\nG1 Z-4.8\nG1 Z-10\nG1 Z-9.8\nG1 Z-12\nG4 P0.5\nG0 Z10";
    let limit = "G0 Z2\nG1 Z-8\nG0 Z2\nG0 Z-6\nG1 Z-12\nG0 Z10";
    let shorter = "G0 Z2\nG1 Z-4\nG1 Z-3\nG1 Z-6\nG1 Z-5\nG1 Z-7\nG1 Z-6\nG1 Z-8\nG0 Z10";
    let slow = "G0 Z2\nF60\nG1 Z-5\nF100\nG1 Z-4\nG1 Z-8\nG0 Z10";
    for (cycle, plain) in [
        (
            "CYCLE83(10,0,2,-12,,-5,,0,,0,1,1,,5,0,0.5,0,0,0,1001110)",
            cleared,
        ),
        ("CYCLE83(10,0,2,-12,,-5,,0,,,1,1,,5,0.2,0.5,0)", cleared),
        (
            "CYCLE83(10,0,2,-12,,-5,,0,,0,1,0,,5,0.2,0.5,0,0,0,1001110)",
            broken,
        ),
        (
            "CYCLE83(10,0,2,,12,,5,0,0,0,1,0,3,5,0.2,0.5,0,0,1,11111)",
            broken,
        ),
        (
            "CYCLE83(10,0,2,-12,,99,5,100,0,0,100,0,0,5,0.2,0.5,0,0,1,2211112)",
            broken,
        ),
        ("CYCLE83(10,0,2,-12,,-8,,0,0,0,1,1,0,0,0,0,2)", limit),
        ("CYCLE83(10,0,2,-8,,-4,,-0.5,0,0,1,0,0,1,0,0,0)", shorter),
        (
            "CYCLE83(10,0,2,-8,,-4,,50,0,0,1,0,0,1,0,0,0,0,0,200000)",
            shorter,
        ),
        ("CYCLE83(10,0,2,-8,,-5,,0,0,0,0.6,0)", slow),
        (
            "CYCLE83(10,0,2,-8,,-5,,0,0,0,60,0,0,0,0,0,0,0,0,2000000)",
            slow,
        ),
    ] {
        same(cycle, plain);
    }
}

/// How a cycle is read where the manuals leave it open is told, once it counts.
#[test]
fn readings_are_told_where_they_count() {
    for (tail, told) in [
        ("-5,,0,,0,1,1,,5,0,0.5,0,0,0,1001110", None),
        (
            "-5,,80,,0,1,1,,1,0,0.5,0,0,0,1201110",
            Some("DAM by the sixth digit"),
        ),
        (
            "-5,,0,,0,50,1,,5,0,0.5,0,0,0,2001110",
            Some("FRF by the seventh digit"),
        ),
        ("-1,,0.5", None),
        ("-1,,2", Some("no stroke is longer than the first")),
    ] {
        let program = format!("{HEAD}CYCLE83(10,0,2,-12,,{tail})\nM30\n");
        let output = translate(&program, &[]);
        let found = ["digit of _AMODE", "longer than"].map(|text| output.contains(text));
        assert_eq!(found.contains(&true), told.is_some(), "{output}");
        assert!(told.is_none_or(|told| output.contains(told)), "{output}");
    }
}

#[test]
fn taps_with_the_pitch_in_every_unit() {
    let tapped = |pitch: f64| format!("G0 Z2\nS500 M3\nG33.1 Z-10 K{pitch}\nM5\nG0 Z10");
    for (values, pitch) in [
        ("3,,1.5,0,500,500,0,1,,0,,,,,,0,0,1001002", 1.5),
        (
            "3,,1.5,0,500,500,0,1,0,0,0,0,\"\",\"ISO_METRIC\",\"M10\",,1,1002",
            1.5,
        ),
        ("3,10,,0,500,500", 1.5),
        ("3,,20,0,500,500,3,2", 25.4 / 20.0),
        ("3,,0.05,0,500,500,0,3", 1.27),
        ("3,,0.5,0,500,500,0,4", std::f64::consts::PI / 2.0),
    ] {
        same(&format!("CYCLE84(10,0,2,-10,,0,{values})"), &tapped(pitch));
    }
    let left = commands(&translate(
        &format!("{HEAD}CYCLE84(10,0,2,-10,,0,4,,1.5,0,500,400,0,1,,0,,,,,,0,0,1002002)\nM30\n"),
        &["--backend", "program"],
    ));
    let at = left
        .iter()
        .position(|line| line.contains("G33.1"))
        .expect("a tap");
    assert!(left[at - 1].contains("M4"), "{left:?}");
    assert_eq!(left[at], "G33.1 Z-10 K1.5 I0.8");
}

/// Each stroke begins where the first did, and so in the same groove.
#[test]
fn taps_in_strokes() {
    let strokes = "G0 Z2\nG33.1 Z-4 K1\nG33.1 Z-8 K1\nG33.1 Z-10 K1\nG0 Z10";
    for way in ["1,4,0.5", "2,4,"] {
        let cycle = format!("CYCLE84(10,0,2,-10,,0,3,,1,0,500,500,0,1,,{way},,,,0,0,1001002)");
        same(&cycle, strokes);
    }
    let floating = "G0 Z2\nF625\nG1 Z-10\nG1 Z2\nF100\nG0 Z10";
    same(
        "CYCLE840(10,0,2,-10,,0,4,3,0,8,0,0,0,,\"\",\"\",\"\",0,1,2)",
        floating,
    );
    same("CYCLE840(10,0,2,-10,,0,4,3,11,,1.25,3,1)", floating);
}

#[test]
fn patterns_of_places() {
    let drilled = |places: &[[f64; 2]]| {
        let hole = |[x, y]: &[f64; 2]| format!("G0 X{x} Y{y}\nG0 Z2\nG1 Z-5\nG0 Z10\n");
        places.iter().map(hole).collect::<String>()
    };
    let pattern = |call: &str, places: &[[f64; 2]]| {
        let program = format!("MCALL CYCLE81(10,0,2,-5,,0,0,0,0)\n{call}\nMCALL");
        same(&program, &drilled(places));
    };
    pattern(
        "CYCLE801(20,10,0,5,4,3,2,0,0,0,0,,,1)",
        &[
            [20., 10.],
            [25., 10.],
            [30., 10.],
            [30., 14.],
            [25., 14.],
            [20., 14.],
        ],
    );
    pattern(
        "CYCLE801(20,10,90,5,4,3,1)",
        &[[20., 10.], [20., 15.], [20., 20.]],
    );
    pattern(
        "CYCLE801(0,0,0,10,10,3,3,1)",
        &[
            [0., 0.],
            [10., 0.],
            [20., 0.],
            [20., 10.],
            [20., 20.],
            [10., 20.],
            [0., 20.],
            [0., 10.],
        ],
    );
    pattern(
        "CYCLE802(111111111,111111111,1,2,3,4,,6,,,,,,,,,,,,,0,0,1)",
        &[[1., 2.], [3., 4.], [3., 6.]],
    );
    pattern(
        "CYCLE802(222222221,111111111,1,2,3,4,5,6)",
        &[[1., 2.], [4., 4.], [9., 6.]],
    );
    pattern("HOLES1(20,0,90,5,10,2,0,0,,,1)", &[[20., 5.], [20., 15.]]);
    pattern(
        "HOLES2(0,0,10,90,45,2,1000,0,,,1)",
        &[[0., 10.], [0., -10.]],
    );
    pattern(
        "HOLES2(0,0,10,90,90,2,2000,0,,,1)",
        &[[0., 10.], [-10., 0.]],
    );
}

#[test]
fn what_changes_the_meaning_is_refused_by_its_name() {
    for (cycle, words) in [
        ("CYCLE81(10,0,2,-5,,0,10,1,11)", "_GMODE = 10 of CYCLE81"),
        ("CYCLE82(10,0,2,-5,,0,10)", "_GMODE = 10 of CYCLE82"),
        ("CYCLE82(10,0,2,-5,,0,0,0,0,1)", "_VARI = 1 of CYCLE82"),
        ("CYCLE81(10,0,2,-5,,0,0,2,0)", "_DMODE = 2 of CYCLE81"),
        ("CYCLE81(10,0,2,-5,,0,0,0,100)", "_AMODE = 100 of CYCLE81"),
        ("CYCLE81(10,0,2,-5,,0,0,0,3)", "_AMODE = 3 of CYCLE81"),
        ("CYCLE81(10,0,2,-5,,0,0,0,1)", "give DPR"),
        ("CYCLE81(10,0,2,,5,0,0,0,2)", "give DP (absolute)"),
        ("CYCLE81(10,0,2,-5,,-1,0,0,10)", "cannot be negative"),
        (
            "CYCLE81(10,0,2,-5,,0,0,0,0,0)",
            "takes 9 values, and 10 are given",
        ),
        ("CYCLE81(10,0,\"2\",-5)", "SDIS of CYCLE81 is a number"),
        (
            "CYCLE83(10,0,2,-12,,-5,,0,1,1,1,1,1)",
            "_AXN = 1 of CYCLE83",
        ),
        (
            "CYCLE83(10,0,2,-12,,-5,,0,1,1,1,1,,,,1,,0,0,1210)",
            "give all dwells in one unit",
        ),
        ("CYCLE83(10,0,2,-12,,-5,,-2)", "DAM = -2 of CYCLE83"),
        ("CYCLE83(10,0,2,-12,,-5,,0,0,0,90,1)", "FRF = 90 of CYCLE83"),
        ("CYCLE83(10,0,2,-12,,-5,,0,0,0,1,2)", "VARI = 2 of CYCLE83"),
        (
            "CYCLE83(10,0,2,-12,,-5,,0,0,0,1,1,,,,,,1)",
            "_GMODE = 1 of CYCLE83",
        ),
        ("CYCLE84(10,0,2,-12,,0,3,,1,45,500)", "POSS = 45 of CYCLE84"),
        (
            "CYCLE84(10,0,2,-12,,0,3,,1,0,500,500,0,5)",
            "_PITA = 5 of CYCLE84",
        ),
        (
            "CYCLE84(10,0,2,-12,,0,3,,1,0,500,500,0,1,0,1)",
            "needs _DAM",
        ),
        (
            "CYCLE84(10,0,2,-12,,0,3,,1,0,500,500,0,1,0,3,1)",
            "_VARI = 3 of CYCLE84",
        ),
        (
            "CYCLE84(10,0,2,-12,,0,3,,1,0,500,500,0,1,0,0,,,,,,0,0,10)",
            "_AMODE = 10 of CYCLE84",
        ),
        ("CYCLE840(10,0,2,-12,,0,0,0,7,0,1)", "ENC = 7 of CYCLE840"),
        ("HOLES2(0,0,10,0,0,4,10)", "_VARI = 10 of HOLES2"),
        ("HOLES1(0,0,0,5,5,4,0,0,\"2\")", "_HIDE = \"2\" of HOLES1"),
        ("CYCLE801(0,0,0,5,5,2,2,2)", "_VARI = 2 of CYCLE801"),
        ("CYCLE801(0,0,0,5,5,2,2,0,0,15)", "_ANG1 = 15 of CYCLE801"),
        ("CYCLE801(0,0,0,5,5,0,2)", "_NUM1 = 0 is not a number"),
        ("CYCLE801(0,0,0,5,5,2000,2000)", "at most 10000"),
        ("CYCLE802(112111111,0,1,2)", "_XA = 112111111 of CYCLE802"),
        ("CYCLE802(0,0,1)", "needs _Y0"),
        ("CYCLE802(0,0)", "needs _X0"),
    ] {
        let program = format!("{HEAD}{cycle}\nM30\n");
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &["--backend", "program"]));
        assert!(shown.contains(words), "{cycle}\n{shown}");
    }
}

/// The spindle that the cycle stopped turns again at the next hole.
#[test]
fn boring_with_a_stop_turns_the_spindle_again() {
    let written = commands(&translate(
        &format!("{HEAD}MCALL CYCLE88(10,0,2,-5,,0.5,3)\nX20\nX30\nMCALL\nM30\n"),
        &["--backend", "program"],
    ));
    let spindle: Vec<&str> = written
        .iter()
        .flat_map(|line| line.split(' '))
        .filter(|word| matches!(*word, "M3" | "M5" | "M0"))
        .collect();
    assert_eq!(spindle, ["M3", "M5", "M0", "M3", "M5", "M0"], "{written:?}");
}
