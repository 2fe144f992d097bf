//! G52 and G92 at the end of the program: LinuxCNC keeps both.

use crate::rs274::interpret;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// 2.54 mm: the way to the contour is longer.
const TOOLS: &str = "T1 P1 D0.1\n";

const WARNING: &str = "G92 stays in force in LinuxCNC behind the end of the program";

fn translated(program: &str) -> String {
    Shop::with(Dialect::Fanuc, program).accepted(&["--backend", "program"])
}

#[test]
fn the_end_of_the_program_takes_g52_back() {
    for (program, back) in [
        ("G52 X10. Y10.\nG0 X0 Y0\nM30\n", Some("G52 X0 Y0")),
        ("G52 X10. Z5.\nG52 Z0\nG0 X0\nM2\n", Some("G52 X0")),
        ("G52 X10.\nM98 P2\nM30\nO2\nG0 X0\nM30\n", Some("G52 X0")),
        (
            "G52 X10.\nG68 X0 Y0 R30.\nG0 X1. Y1.\nM30\n",
            Some("G52 X0"),
        ),
        // M30 is missing; compensation is on.
        (
            "G52 X10.\nG41 D1 G1 X20. Y20. F100.\nY60.\n",
            Some("G52 X0"),
        ),
        ("G52 X10.\nG52 X0\nM30\n", None),
        ("G0 X0 Y0\nG52 X10.\nG92 X5.\nM30\n", None),
    ] {
        let shop = Shop::with(
            Dialect::Fanuc,
            &format!("O1\nG90 G54 G0 X0 Y0 Z50.\n{program}"),
        );
        let output = shop.accepted(&["--backend", "program"]);
        let end = output.lines().rev().find(|line| !line.starts_with('('));
        let taken = end.and_then(|line| back.map(|words| line.contains(words)));
        assert_eq!(taken, back.map(|_| true), "{output}");
        let at_end = end.is_some_and(|line| line.contains("G52"));
        assert_eq!(at_end, back.is_some(), "{output}");
        let canon = interpret(&shop.path(""), TOOLS, &output);
        let shifts = canon
            .iter()
            .rev()
            .find(|line| line.contains("SET_G92_OFFSET"));
        let shifts = shifts.expect("a shift").split_once('(').expect("numbers").1;
        let zero = shifts.trim_end_matches(')').split(", ");
        let zero = zero
            .filter_map(|number| number.parse().ok())
            .all(|number: f64| number == 0.0);
        assert_eq!(zero, !program.contains("G92"), "{output}");
    }
}

#[test]
fn what_stays_of_g92_is_said() {
    let program = "O1\nG90 G54 G0 X0 Y0 Z50.\nG92 X10. Y10.\nG0 X0 Y0\nM30\n";
    assert!(translated(program).contains(&format!("(MSG, line 3: {WARNING}")));
    // A limit of the spindle speed is none.
    let program = "O1\nG90 G54 G0 X0 Y0 Z50.\nG92 S2000\nM30\n";
    assert!(!translated(program).contains(WARNING));
}
