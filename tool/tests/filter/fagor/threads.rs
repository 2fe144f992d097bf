//! Threads, which go on until one of G0 to G3.

use super::{errors, translate};

const HEAD: &str = "G90 G0 X0 Y0 Z5 S500 M3 F100\n";

#[test]
fn a_thread_goes_on_in_the_blocks_after_it() {
    let program = format!("{HEAD}G33 Z-20 L1.5\nZ5\nX3 L2\nG91 Z-2\nG90 G0 Z9\nZ10\nM30\n");
    assert_eq!(
        translate(&program, &[])[1..],
        [
            "G33 Z-20 K1.5",
            "G33 Z5 K1.5",
            "G33 X3 K2",
            "G33 Z3 K2",
            "G0 Z9",
            "G0 Z10",
            "M30"
        ]
    );
    let inch = format!("{HEAD}G70\nG33 Z-1 L.05\nG71\nZ5\nM30\n");
    assert_eq!(
        translate(&inch, &[])[1..3],
        ["G33 Z-25.4 K1.27", "G33 Z5 K1.27"]
    );
}

#[test]
fn what_cannot_be_a_thread_is_refused() {
    for (block, text) in [
        ("X3 Y4", "a thread needs one of"),
        ("R5 Q30", "a thread needs one of"),
        ("G81 X10 Y0 Z2 I-5", "G33 is in force, and a canned cycle"),
        ("G53 Z0", "G53 while G33 is in force"),
    ] {
        let shown = errors(&format!("{HEAD}G33 Z-20 L1.5\n{block}\nM30\n"), &[]);
        assert!(shown.contains(text), "{shown}");
    }
}
