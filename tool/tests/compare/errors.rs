//! What is refused, and what is said then.

use crate::support::{Bench, STOCK};

#[test]
fn a_missing_file() {
    let message = Bench::new().refused(&["nothing.ngc", "--with", STOCK]);
    assert!(
        message.starts_with("nothing.ngc: cannot be read: No such file"),
        "{message}"
    );
}

#[test]
fn a_program_that_the_interpreter_refuses() {
    let bench = Bench::new();
    bench.write("bad.ngc", "G21 G90\nG1 X10\nM2\n");
    let message = bench.refused(&["bad.ngc", "--with", STOCK]);
    assert_eq!(
        message.trim_end(),
        "bad.ngc:2: Cannot do g1 with zero feed rate\n    G1 X10"
    );
    bench.write("worse.ngc", "G0 X1\nG0 X[1\n");
    let message = bench.refused(&["worse.ngc", "--with", STOCK]);
    assert!(message.starts_with("worse.ngc:2: "), "{message}");
    bench.write("spline.ngc", "G64 F100\nG5 I0 J3 P0 Q-3 X1 Y1\nM2\n");
    let message = bench.refused(&["spline.ngc", "--with", STOCK]);
    assert!(
        message.contains("spline.ngc:2: a spline (G5, G5.2) is not supported"),
        "{message}"
    );
}

#[test]
fn a_program_without_moves() {
    let bench = Bench::new();
    bench.write("empty.ngc", "G21\nM2\n");
    let message = bench.refused(&["empty.ngc", "--with", STOCK]);
    assert!(
        message.contains("empty.ngc: the program has no moves"),
        "{message}"
    );
}

#[test]
fn no_program_at_all() {
    let message = Bench::new().refused(&["--with", STOCK]);
    assert!(
        message.contains("--generated") && message.contains("squares-p.05"),
        "{message}"
    );
    let message = Bench::new().refused(&["--generated", "circle", "--with", STOCK]);
    assert!(
        message.contains("circle: there is no such program"),
        "{message}"
    );
}

#[test]
fn a_missing_module() {
    let message = Bench::new().refused(&["--generated", "zigzag", "--with", "none.so"]);
    assert!(
        message.starts_with("none.so: there is no such module"),
        "{message}"
    );
}

#[test]
fn values_that_make_no_sense() {
    let bench = Bench::new();
    for (arguments, expected) in [
        (["--limits", "V=0"], "a number above 0"),
        (["--limits", "Q:V=1"], "`Q` is none of the axes"),
        (["--jerk", "-5"], "`-5`"),
        (["--period", "1"], "0.00001 to 0.1"),
        (["--adds-per-cycle", "0"], "0 is not in 1.."),
        (["--pause", "3"], "TIME:VALUE"),
        (["--velocity-limit", "0"], "a number above 0"),
        (["--feed-at-least", "0"], "a number above 0"),
        (["--patience", "0"], "a number above 0"),
        (["--max-feed-override", "0.5"], "a number from 1 up"),
    ] {
        let mut all = vec!["--generated=zigzag", "--with", STOCK];
        let joined = arguments.join("=");
        all.push(&joined);
        let message = bench.refused(&all);
        assert!(message.contains(expected), "{message}");
    }
}
