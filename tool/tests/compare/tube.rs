//! The least time in the tolerance of an excerpt.

use crate::support::{Bench, STOCK, json, number};
use serde_json::Value;

/// Moves before the excerpt and behind it that have no tolerance; lines 4 to 9 have one, with an arc among them.
const PROGRAM: &str = "G21 G61 F3000\nG0 X1 Y2 Z3\nG64 P0.05\nG1 X3 F2400\nY5\nX5\nG2 X7 Y3 J-2\nG1 X8\nY2\nG61\nX9\n\
                       G64 P0.1\nX10\nM2\n";

fn programs(bench: &Bench, program: &str, options: &[&str]) -> Value {
    let file = bench.write("program.ngc", program);
    let file = file.to_str().expect("text");
    let program = [file, "--json", "--with", STOCK];
    json(&bench.compare(&[&program, options].concat()))["programs"].take()
}

#[test]
fn an_excerpt_is_run_from_rest_to_rest() {
    let bench = Bench::new();
    let program = &programs(&bench, PROGRAM, &["--tube"])[0];
    assert_eq!(program["program"], "program.ngc lines 4 to 9");
    assert_eq!(program["moves"], 6);
    assert_eq!(program["excerpt"]["first_line"], 4);
    assert_eq!(program["excerpt"]["last_line"], 9);
    assert_eq!(program["excerpt"]["of_moves"], 9);
    let run = &program["runs"][0];
    assert_eq!(run["state"], "complete");
    assert!(number(&run["final_error"]) < 1e-6, "{run}");
    // 2, 3, 2, 1 and 1 mm, and a quarter of a circle.
    let length = 9.0 + std::f64::consts::PI;
    let [tube, optimum] = ["tube", "optimum"].map(|name| &run[name]);
    let (time, on_the_path) = (number(&tube["time"]), number(&optimum["time"]));
    // No faster than at the feed of 40 mm/s; the tube's motion rounds corners otherwise than LinuxCNC's planner.
    assert!(
        time > length / 40.0 && time < on_the_path,
        "{tube} {optimum}"
    );
    let ratio = number(&optimum["executed"]) / time;
    assert!((number(&tube["ratio"]) - ratio).abs() < 1e-9, "{tube}");
    assert!(number(&tube["deviation"]) <= 1.002 && number(&tube["limits"]) <= 1.002);
    assert_eq!(tube["problem"], Value::Null);
}

#[test]
fn its_middle_if_it_has_more_moves() {
    let bench = Bench::new();
    let program = &programs(&bench, PROGRAM, &["--tube=2"])[0];
    assert_eq!(program["program"], "program.ngc lines 6 to 7");
    assert_eq!(program["moves"], 2);
    let deviation = &program["runs"][0]["deviation"];
    assert!(number(&deviation["largest"]) <= 0.05, "{deviation}");
}

#[test]
fn without_a_tolerance_there_is_none_and_nothing_is_run() {
    let bench = Bench::new();
    let program = "G21 G61 F3000\nG1 X1\nG0 X2\nG64\nG1 X3\nA4\nM2\n";
    let found = &programs(&bench, program, &["--tube"])[0];
    assert_eq!(found["runs"], Value::Array(Vec::new()));
    let says = found["no_excerpt"].as_str().expect("a reason");
    for reason in [
        "1 in G0",
        "1 in G61",
        "1 in G64 without P",
        "1 with another axis",
        "G64 P",
    ] {
        assert!(says.contains(reason), "{says}");
    }
    let file = bench.write("program.ngc", program);
    let output = bench.compare(&[file.to_str().expect("text"), "--with", STOCK, "--tube"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success() && text.contains(says), "{text}");
}

#[test]
fn what_takes_too_long_is_told_beside_the_run() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", "G21 G64 P0.05 F60\nG1 X20\nM2\n");
    let file = file.to_str().expect("text");
    let text = bench.compare(&[file, "--with", STOCK, "--tube"]);
    let text = String::from_utf8(text.stdout).expect("text");
    assert!(text.contains("take fewer moves"), "{text}");
}

#[test]
fn not_together_with_an_operator_nor_without_moves() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", PROGRAM);
    let file = file.to_str().expect("text");
    let says = bench.refused(&[file, "--tube=5", "--feed-override", "1:0.5"]);
    assert!(
        says.contains("--tube") && says.contains("--feed-override"),
        "{says}"
    );
    let says = bench.refused(&[file, "--tube=0"]);
    assert!(says.contains("--tube"), "{says}");
}
