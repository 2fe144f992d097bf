//! How the spindle turns where a canned cycle needs it.

use super::{errors, translate};

/// The lines that switch the spindle or tap.
fn switched(program: &str) -> Vec<String> {
    let lines = translate(program, &[]);
    let word = |line: &String| {
        let mut words = line.split(' ');
        let found = words.find(|word| ["M3", "M4", "M5", "G33.1"].contains(word));
        found.map(str::to_string)
    };
    lines.iter().filter_map(word).collect()
}

#[test]
fn cycles_switch_on_a_spindle_that_stands() {
    let place = "G90 G0 X0 Y0 Z50 F100 S500";
    for (cycle, back) in [
        ("G81 X10 Y0 Z2 I-5", &[][..]),
        ("G82 X10 Y0 Z2 I-5 K50", &[]),
        ("G83 X10 Y0 Z2 I-5 J2", &[]),
        ("G69 X10 Y0 Z2 I-5 B3", &[]),
        ("G85 X10 Y0 Z2 I-5", &[]),
        ("G84 X10 Y0 Z2 I-5", &["M4", "M3"]),
        ("G86 X10 Y0 Z2 I-5", &["M5", "M3"]),
    ] {
        for (head, first) in [
            ("T1 M6\nG43", &["M3"][..]),
            ("M4\nM5\nT1 M6\nG43", &["M4", "M5", "M3"]),
            ("M3\nT1 M6\nG43", &["M3", "M3"]),
            ("T1 M6\nG43\nM3", &["M3"]),
        ] {
            let program = format!("{head}\n{place}\n{cycle}\nX20\nG80\nM30\n");
            let wanted = [first, back, back].concat();
            assert_eq!(switched(&program), wanted, "{program}");
        }
    }
    let turned = "M4\nT1 M6\nG43\nG90 G0 X0 Y0 Z50 F100 S500\nG81 X10 Y0 Z2 I-5\nX20\nG80\nM30\n";
    assert_eq!(switched(turned), ["M4", "M4"]);
}

/// Nor does the spindle turn that was switched on before.
#[test]
fn a_thread_after_a_tool_change_needs_the_spindle() {
    let shown = errors("S500 M3\nT1 M6\nG43\nG0 X0 Y0 Z5\nG33 Z-5 L1\nM30\n", &[]);
    assert!(shown.contains("the spindle does not turn"), "{shown}");
}
