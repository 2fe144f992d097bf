//! The least time on the executed path, time to rest, and lengths of the queue.

use crate::support::{Bench, STOCK, assert_near, json, number};
use serde_json::Value;

#[test]
fn the_stock_planner_on_a_line() {
    let bench = Bench::new();
    let line = "G21 G64 P0.1 F6000\nG1 X40\nM2\n";
    let figures = bench.measure(line, STOCK.as_ref(), &["--optimum"]);
    let optimum = &figures["optimum"];
    // 100 mm/s, 1000 mm/s2; it has no limit of jerk.
    assert_near(&optimum["time"], 0.5, 5e-4);
    assert_near(&optimum["without_jerk_limit"], 0.5, 5e-4);
    let ratio = number(&figures["motion"]["time"]) / 0.5;
    assert_near(&optimum["ratio"], ratio, 2e-3);
    assert!(number(&optimum["supply"]) <= 0.001);
    assert_eq!(optimum["limited_by_supply"], false);
    assert_eq!(optimum["not_solved"], 0);
}

#[test]
fn exact_stops_and_waiting_are_no_fault_of_the_planner() {
    let bench = Bench::new();
    let program = "G21 G61.1 F3000\nG1 X10\nG4 P0.5\nY10\nX0\nM2\n";
    let figures = bench.measure(program, STOCK.as_ref(), &["--optimum"]);
    let optimum = &figures["optimum"];
    assert_eq!(optimum["stretches"], 3);
    // Three times 10 mm at 50 mm/s.
    assert_near(&optimum["time"], 3.0 * 0.25, 2e-3);
    // The dwell does not count.
    let executed = number(&figures["motion"]["time"]) - 0.5;
    assert_near(&optimum["executed"], executed, 0.01);
}

#[test]
fn without_the_option_there_is_none() {
    let bench = Bench::new();
    let figures = bench.measure("G21 F600\nG1 X1\nM2\n", STOCK.as_ref(), &[]);
    assert_eq!(figures["optimum"], Value::Null);
}

#[test]
fn random_holds() {
    let bench = Bench::new();
    let line = "G21 G64 P0.1 F6000\nG1 X200\nM2\n";
    let figures = bench.measure(line, STOCK.as_ref(), &["--holds", "8"]);
    let holds = &figures["holds"];
    assert_eq!(holds["not_at_rest"], 0);
    assert!((1.0..=8.0).contains(&number(&holds["count"])), "{holds}");
    // It slows down with half the acceleration in G64.
    assert!(
        (1.8..=2.1).contains(&number(&holds["mean_ratio"])),
        "{holds}"
    );
    assert!(number(&holds["worst_ratio"]) >= number(&holds["mean_ratio"]));
    // The run without holds is what is timed.
    assert!(number(&figures["motion"]["time"]) < 3.0);
}

#[test]
fn lengths_of_the_queue() {
    let bench = Bench::new();
    let mut program = "G21 G64 P0.1 F6000\n".to_owned();
    for line in 1..=60 {
        program += &format!("G1 X{line} Y{}\n", line % 2);
    }
    program += "M2\n";
    let file = bench.write("program.ngc", &program);
    let report = json(&bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        STOCK,
        "--queue",
        "5,50",
        "--json",
    ]));
    let runs = report["programs"][0]["runs"].as_array().expect("runs");
    let names: Vec<&str> = runs
        .iter()
        .filter_map(|run| run["module"].as_str())
        .collect();
    assert_eq!(names, ["tpmod.so queue 5", "tpmod.so queue 50"]);
    let longest: Vec<f64> = runs.iter().map(|run| number(&run["most_queued"])).collect();
    // A move may bring an arc of the stock planner's own with it.
    assert!((5.0..=6.0).contains(&longest[0]), "{longest:?}");
    assert!((50.0..=51.0).contains(&longest[1]), "{longest:?}");
}

#[test]
fn not_together_with_an_operator() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", "G21 F600\nG1 X1\nM2\n");
    let file = file.to_str().expect("text");
    for option in [&["--optimum"][..], &["--holds", "3"]] {
        let mut arguments = vec![file, "--operator", "1"];
        arguments.extend(option);
        let says = bench.refused(&arguments);
        assert!(
            says.contains(option[0]) && says.contains("--operator"),
            "{says}"
        );
    }
    let says = bench.refused(&[file, "--holds", "0"]);
    assert!(says.contains("--holds"), "{says}");
}
