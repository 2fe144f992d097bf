//! What a plan is made from is not written to.

use crate::support::{Bench, MILL};
use std::os::unix::fs::symlink;

const PROGRAM: &str = "G21 F1000\nG1 X1\nM2\n";

#[test]
fn files_that_are_read_are_not_overwritten() {
    let bench = Bench::new();
    let tools = "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    bench.write("mill.ini", &format!("{MILL}{tools}#INCLUDE more.inc\n"));
    bench.write("more.inc", "[HAL]\nTWOPASS =\n");
    bench.write("tools.tbl", "T1 P1\n");
    bench.write("arrivals", "0 1 1\n");
    bench.write("part.ngc", PROGRAM);
    symlink("part.ngc", bench.path().join("link")).expect("a link");
    for (option, file) in [
        ("--csv", "part.ngc"),
        ("--html", "./part.ngc"),
        ("--svg", "link"),
        ("--times", "mill.ini"),
        ("--csv", "more.inc"),
        ("--csv", "tools.tbl"),
        ("--svg", "arrivals"),
    ] {
        let before = bench.read(file);
        let machine = ["part.ngc", "--ini", "mill.ini", "--arrivals", "arrivals"];
        let error = bench.refused(&[&machine[..], &[option, file]].concat());
        assert!(
            error.starts_with(&format!("{file}: ")) && error.contains("a file of its own"),
            "{error}"
        );
        assert_eq!(bench.read(file), before);
    }
}

#[test]
fn a_link_to_an_output_is_the_same_output() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write("out", "");
    symlink("out", bench.path().join("link")).expect("a link");
    let error = bench.refused(&["part.ngc", "--csv", "out", "--svg", "link"]);
    assert!(error.starts_with("out: two of --html"), "{error}");
}
