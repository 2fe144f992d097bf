//! Memory does not grow with the program.

use crate::support::Bench;
use crate::surface::surface;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Greatest resident memory while a program is planned, MB, and the output.
fn plan(bench: &Bench, moves: usize) -> (f64, String) {
    bench.write("long.ngc", &surface(moves));
    let mut child = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(bench.path())
        .args(["plan", "long.ngc", "--html", "long.html"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let status = format!("/proc/{}/status", child.id());
    let mut greatest: f64 = 0.0;
    while child.try_wait().expect("a child").is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
        greatest = greatest.max(kilobytes.unwrap_or(0.0) / 1024.0);
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().expect("output");
    assert!(output.status.success());
    (greatest, String::from_utf8(output.stdout).expect("text"))
}

/// Behind a terminal: `script` makes one.
#[test]
fn the_bar_says_at_once_what_it_counts() {
    let bench = Bench::new();
    bench.write("long.ngc", &surface(50_000));
    let command = format!("{} plan long.ngc", env!("CARGO_BIN_EXE_framepath"));
    let output = Command::new("script")
        .current_dir(bench.path())
        .args(["-qec", &command, "/dev/null"])
        .env("TERM", "xterm")
        .output()
        .expect("script of bsdutils runs");
    let text = String::from_utf8(output.stdout).expect("text");
    let bars: Vec<&str> = text
        .split(['\r', '\n', '\x1b'])
        .filter(|line| line.contains(" of the machine's time"))
        .collect();
    assert!(!bars.is_empty(), "{text}");
    for bar in &bars {
        let named = bar.trim_start_matches("[2K").starts_with("long.ngc ");
        assert!(named && bar.contains(" of 50,004, "), "{bar}");
        assert!(
            !bar.contains(" line 0 of") && !bar.contains(" 0s left"),
            "{bar}"
        );
    }
}

#[test]
fn memory_and_page_stay_small() {
    let bench = Bench::new();
    let (short, _) = plan(&bench, 1000);
    let (long, text) = plan(&bench, 25_000);
    assert!(text.contains("25,001"), "{text}");
    assert!(short > 5.0 && long < short + 40.0, "{short} {long} MB");
    assert!(bench.read("long.html").len() < 6_000_000);
}
