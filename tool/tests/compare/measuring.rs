//! What is measured, with a made-up planner whose figures can be worked out by hand: 100 mm/s from the
//! first cycle on, along the lines.

use crate::support::{Bench, assert_near, number};

/// Four legs of 10 mm around a square, then one of 20 mm; 0.6 s at 100 mm/s.
const LEGS: &str = "G21 G90 G64 P0.1 F6000
G1 X10
Y10
X0
Y0
Z20
M2
";

#[test]
fn time_velocity_acceleration_and_jerk() {
    let bench = Bench::new();
    let figures = bench.measure(LEGS, &bench.module(""), &[]);
    assert_eq!(figures["state"], "complete");
    assert_near(&figures["motion"]["time"], 0.6, 1e-9);
    assert_near(&figures["motion"]["velocity"]["ratio"], 1.0, 1e-6);
    // From 0 to 100 mm/s in a cycle: 1e5 mm/s2 in one cycle, 1e8 mm/s3.
    assert_near(&figures["motion"]["acceleration"]["ratio"], 100.0, 1e-3);
    assert_near(&figures["motion"]["jerk_in_accelerations"], 1e5, 10.0);
    assert_near(&figures["deviation"]["largest"], 0.0, 1e-9);
    assert_near(&figures["missed"]["largest"], 0.0, 1e-9);
    assert_near(&figures["final_error"], 0.0, 1e-9);
    assert_eq!(figures["rests"]["count"], 0);
    assert_eq!(figures["heap_calls"], 0);
    assert_eq!(figures["takes_jerk"], false);
    assert_eq!(figures["add"]["calls"], 5);
    assert_eq!(figures["run"]["calls"], 600);
    assert!(number(&figures["run"]["max"]) >= number(&figures["run"]["mean"]));
}

#[test]
fn single_axes_have_limits_of_their_own() {
    let bench = Bench::new();
    let limits = ["--limits", "V=100,A=1000;Y:V=200,A=1000;Z:V=50,A=500"];
    let figures = bench.measure(LEGS, &bench.module(""), &limits);
    // Z goes at 50 mm/s, Y at the feed.
    assert_near(&figures["motion"]["time"], 0.8, 1e-9);
    assert_near(&figures["motion"]["velocity"]["ratio"], 1.0, 1e-6);
}

#[test]
fn a_jump_is_a_deviation_and_more() {
    let bench = Bench::new();
    let figures = bench.measure(
        "G21 G64 P0.1 F6000 G1 X20\nM2\n",
        &bench.module("JUMPS"),
        &[],
    );
    assert_near(&figures["deviation"]["largest"], 0.3, 1e-9);
    assert_near(&figures["deviation"]["ratio"], 3.0, 1e-6);
    assert_eq!(figures["deviation"]["exceeds"], true);
    assert_near(&figures["motion"]["velocity"]["ratio"], 3.0, 1e-6);
    assert_near(&figures["motion"]["velocity"]["time"], 0.05, 0.0021);
    assert_eq!(figures["motion"]["velocity"]["axis"], 1);
}

#[test]
fn what_is_left_out_is_missed() {
    let bench = Bench::new();
    let figures = bench.measure(LEGS, &bench.module("SKIPS"), &[]);
    // The corner (10, 10) is 10 / sqrt(2) from the short cut, the shortcut 10 / sqrt(2) from it.
    assert_near(&figures["missed"]["largest"], 50f64.sqrt(), 1e-6);
    assert_near(&figures["missed"]["ratio"], 50f64.sqrt() / 0.1, 1e-4);
    assert!(number(&figures["deviation"]["largest"]) > 4.9);
}

/// As a V-carved corner is written: up out of the groove and back over the same points. What runs back is
/// as near to the way out, and the way back was taken for missed.
#[test]
fn what_runs_back_over_itself_is_not_missed() {
    let bench = Bench::new();
    let mut program = String::from("G21 G90 G64 P0.1 Q0 F6000\n");
    for x in (1..=8).chain((0..8).rev()) {
        program += &format!("G1 X{x} Z{}\n", 0.5 * f64::from(x));
    }
    program += "Y10\nM2\n";
    let figures = bench.measure(&program, &bench.module(""), &[]);
    assert_eq!(figures["add"]["calls"], 17);
    assert_near(&figures["missed"]["largest"], 0.0, 1e-9);
    assert_near(&figures["deviation"]["largest"], 0.0, 1e-9);
}

#[test]
fn without_a_tolerance_there_is_no_ratio() {
    let bench = Bench::new();
    let program = LEGS.replace(" P0.1", "");
    let figures = bench.measure(&program, &bench.module("JUMPS"), &[]);
    assert_near(&figures["deviation"]["largest"], 0.3, 1e-9);
    assert!(figures["deviation"]["ratio"].is_null());
    assert_eq!(figures["deviation"]["exceeds"], false);
    let exact = LEGS.replace("G64 P0.1", "G61");
    let figures = bench.measure(&exact, &bench.module("JUMPS"), &[]);
    assert_near(&figures["deviation"]["exact"], 0.3, 1e-9);
    assert_eq!(figures["deviation"]["exceeds"], true);
}

#[test]
fn a_rest_that_nothing_explains() {
    let bench = Bench::new();
    let figures = bench.measure(LEGS, &bench.module("STANDS"), &[]);
    assert_eq!(figures["rests"]["count"], 1);
    assert_eq!(figures["rests"]["cycles"], 20);
    assert_near(&figures["rests"]["first"], 0.05, 0.0011);
    assert_near(&figures["motion"]["time"], 0.62, 1e-9);
}

#[test]
fn a_rest_that_the_program_explains() {
    let bench = Bench::new();
    let program = LEGS.replace("Y10\n", "G4 P0.1\nY10\n");
    let figures = bench.measure(&program, &bench.module(""), &[]);
    assert_eq!(figures["rests"]["count"], 0);
    assert_near(&figures["motion"]["time"], 0.7, 0.0031);
}

#[test]
fn calls_of_the_heap() {
    let bench = Bench::new();
    let figures = bench.measure(LEGS, &bench.module("ALLOCATES"), &[]);
    // malloc and free in every tenth cycle with motion.
    assert_eq!(figures["heap_calls"], 120);
}

#[test]
fn a_module_with_a_limit_of_jerk_runs_with_each() {
    let bench = Bench::new();
    let file = bench.write("legs.ngc", LEGS);
    let (plain, with_pin) = (bench.module(""), bench.module("TAKES_JERK"));
    let output = bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        plain.to_str().expect("text"),
        "--with",
        with_pin.to_str().expect("text"),
        "--jerk",
        "unlimited,20A",
        "--json",
    ]);
    let report = crate::support::json(&output);
    let runs = report["programs"][0]["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), 3);
    // From standstill to 100 mm/s in a cycle: 1e8 mm/s3, over 20,000.
    assert_near(&runs[2]["motion"]["jerk"]["ratio"], 5e3, 1.0);
    let ratios = report["ratios"].as_array().expect("ratios");
    assert_eq!(ratios.len(), 2);
    for ratio in ratios {
        assert_near(&ratio["geometric_mean"], 1.0, 1e-9);
        // The first module breaks the limits itself.
        assert_eq!(ratio["mean_only"].as_array().map(Vec::len), Some(1));
        assert!(ratio["worst"].is_null());
    }
}

#[test]
fn the_table_marks_what_is_exceeded() {
    let bench = Bench::new();
    let file = bench.write("legs.ngc", LEGS);
    let module = bench.module("JUMPS");
    let output = bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        module.to_str().expect("text"),
    ]);
    let text = String::from_utf8(output.stdout).expect("text");
    let mut rows = text.lines().filter(|line| line.contains("made-upJUMPS.so"));
    let row = rows.next().expect("a row");
    let cells: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(
        cells[..5],
        ["made-upJUMPS.so", "-", "0.600", "3.000!", "600!"]
    );
    assert_eq!(cells[6..8], ["0.3000", "3.000!"]);
}

#[test]
fn the_headline_says_what_the_modules_were_held_to() {
    let bench = Bench::new();
    bench.write("legs.ngc", LEGS);
    let module = bench.module("");
    let headline = |more: &[&str]| {
        let named = ["legs.ngc", "--with", module.to_str().expect("text")];
        let output = bench.compare(&[&named, more].concat());
        assert!(output.status.success());
        let text = String::from_utf8(output.stdout).expect("text");
        text.lines().next().expect("a headline").to_owned()
    };
    let plain = "V=100,A=1000; F as programmed; servo period 1 ms, 1 move handed over in each";
    assert_eq!(headline(&[]), plain);
    let limited = headline(&["--velocity-limit", "80", "--max-feed-override", "1.1"]);
    assert_eq!(
        limited,
        format!("{plain}; at most 80 mm/s along the path; feed override up to 110 %")
    );
}
