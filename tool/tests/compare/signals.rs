//! A comparison that is not wanted any more, or does not end, leaves nothing behind.

use crate::processes::{ENDLESS, await_that, interpreters, signal, start};
use crate::support::{Bench, STOCK};

#[test]
fn a_comparison_that_is_ended_leaves_nothing() {
    for sent in ["-TERM", "-INT", "-HUP"] {
        let bench = Bench::new();
        bench.write("part.ngc", ENDLESS);
        let mut compare = start(bench.path(), &["compare", "part.ngc", "--with", STOCK]);
        await_that("it reads", || interpreters(bench.path()) == 1);
        signal(&compare, sent);
        assert_eq!(compare.wait().expect("an end").code(), Some(1), "{sent}");
        assert_eq!(interpreters(bench.path()), 0, "{sent}");
        let room = std::fs::read_dir(bench.path().join("tmp")).expect("a folder");
        assert_eq!(room.count(), 0, "{sent}");
    }
}

/// With nothing to be cleaned up a signal ends the process as if nobody had waited for it.
#[test]
fn a_comparison_that_runs_modules_ends_at_once() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F100\nG1 X20\nM2\n");
    let hanging = bench.module("HANGS");
    let hanging = hanging.to_str().expect("text");
    let arguments = [
        "compare",
        "part.ngc",
        "--with",
        hanging,
        "--patience",
        "1000",
    ];
    let mut compare = start(bench.path(), &arguments);
    let id = compare.id();
    let is_host = |process: &str| {
        let line = std::fs::read(format!("/proc/{process}/cmdline")).unwrap_or_default();
        String::from_utf8_lossy(&line).contains("compare-host")
    };
    let host = || {
        let children = std::fs::read_to_string(format!("/proc/{id}/task/{id}/children"));
        let children = children.expect("a process");
        children
            .split_whitespace()
            .find(|child| is_host(child))
            .map(str::to_owned)
    };
    await_that("a module runs", || host().is_some());
    let host = host().expect("a process");
    // Until it is in the call that hangs.
    std::thread::sleep(std::time::Duration::from_secs(1));
    signal(&compare, "-TERM");
    assert_eq!(compare.wait().expect("an end").code(), None);
    await_that("the module ends with it", || !is_host(&host));
}

#[test]
fn a_program_without_an_end_is_told() {
    let bench = Bench::new();
    bench.write("part.ngc", ENDLESS);
    let error = bench.refused(&["part.ngc", "--with", STOCK, "--most-seconds", "1"]);
    assert!(
        error.starts_with("part.ngc: the program has not ended after 1 s")
            && error.contains("--most-seconds raises"),
        "{error}"
    );
}

#[test]
fn python_in_a_program_is_refused() {
    let bench = Bench::new();
    let made = bench.path().join("made");
    let python = format!(";py,open('{}','w')", made.display());
    bench.write("part.ngc", &format!("G21\n{python}\nG0 X1\nM2\n"));
    let error = bench.refused(&["part.ngc", "--with", STOCK]);
    assert!(
        error.starts_with("part.ngc:2: Python in a program"),
        "{error}"
    );
    assert!(!made.exists());
}
