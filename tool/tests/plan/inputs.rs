//! M66: inputs of the machine, which nobody knows before it runs.

use crate::support::{Bench, number};

/// Moves behind an input, and looks at what it says.
fn program(code: &str, end: &str) -> String {
    format!("G21 G90 F600 G61\nG1 Y1\n{code}\nG1 X{end}\nM2\n")
}

#[test]
fn what_is_waited_for_comes_at_once_and_what_is_looked_at_is_0() {
    let bench = Bench::new();
    let time = |code: &str, end: &str| {
        let figures = bench.figures(&program(code, end), &[]);
        number(&figures["time"])
    };
    for (code, answer, told) in [
        ("M66 P0 L3 Q1.5", 1, "waits for (M66 P0 L3)"),
        ("M66 P0 L1 Q1.5", 1, "waits for (M66 P0 L1)"),
        ("M66 P2 L2 Q1.5", 0, "waits for (M66 P2 L2)"),
        ("M66 P2 L4 Q1.5", 0, "waits for (M66 P2 L4)"),
        ("M66 P1 L0", 0, "looks at (M66 P1 L0)"),
        ("M66 P1", 0, "looks at (M66 P1 L0)"),
        ("M66 E3 L0", 0, "looks at (M66 E3 L0)"),
        ("M66 P0 L3 Q1\nM66 E3", 0, "looks at (M66 E3 L0)"),
    ] {
        // It takes no time, and goes on from rest.
        let expected = time("G4 P0", &format!("{}", 5 + answer));
        let found = time(code, "[5 + # 5399]");
        assert!((found - expected).abs() < 0.002, "{code}: {found}");
        bench.write("part.ngc", &program(code, "[5+#5399]"));
        let output = bench.plan(&["part.ngc"]);
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(
            said.contains("warning: part.ngc: ") && said.contains(told),
            "{code}: {said}"
        );
    }
}

#[test]
fn waiting_is_told_without_a_look_and_looking_is_not() {
    let bench = Bench::new();
    for (code, is_told) in [
        ("M66 P0 L3 Q1", true),
        ("M66 P0 L0", false),
        ("M66 E0", false),
    ] {
        bench.write("part.ngc", &program(code, "5 (#5398)"));
        let output = bench.plan(&["part.ngc"]);
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(said.contains("warning"), is_told, "{code}: {said}");
    }
}
