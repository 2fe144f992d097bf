//! LinuxCNC's own planner, where its time is known.

use crate::support::{Bench, STOCK, assert_near, number};

/// Two cycles: the first one starts, the last one ends somewhere within.
const CYCLES: f64 = 0.0021;

fn stock(program: &str, more: &[&str]) -> serde_json::Value {
    Bench::new().measure(program, STOCK.as_ref(), more)
}

#[test]
fn a_long_line_with_a_stop() {
    // v / a + d / v
    let figures = stock("G21 G61.1 F6000\nG1 X100\nM2\n", &[]);
    assert_eq!(figures["state"], "complete");
    assert_near(&figures["motion"]["time"], 1.1, CYCLES);
    assert_near(&figures["motion"]["velocity"]["ratio"], 1.0, 1e-6);
    assert_near(&figures["motion"]["acceleration"]["ratio"], 1.0, 1e-3);
    assert_near(&figures["deviation"]["largest"], 0.0, 1e-9);
    assert_near(&figures["final_error"], 0.0, 1e-9);
    assert_eq!(figures["heap_calls"], 0);
}

#[test]
fn a_short_line_with_a_stop_at_other_limits_and_periods() {
    // 2 sqrt(d / a)
    for period in ["0.0005", "0.001", "0.002"] {
        let more = ["--limits", "V=200,A=2500", "--period", period];
        let figures = stock("G21 G61.1 F60000\nG1 X10\nM2\n", &more);
        let within = 2.1 * period.parse::<f64>().expect("a number");
        assert_near(
            &figures["motion"]["time"],
            2.0 * (10.0f64 / 2500.0).sqrt(),
            within,
        );
    }
}

#[test]
fn the_feed_and_what_raises_it() {
    let program = "G20 G61.1\nF10 G1 X1\nM2\n";
    // 10 inches a minute
    let slow = stock(program, &[]);
    let feed = 254.0 / 60.0;
    assert_near(&slow["motion"]["time"], 25.4 / feed + feed / 1000.0, CYCLES);
    let raised = stock(program, &["--feed-at-least", "3000"]);
    assert_near(
        &raised["motion"]["time"],
        25.4 / 50.0 + 50.0 / 1000.0,
        CYCLES,
    );
}

/// It follows the spindle beyond its ends, and is on the path there.
#[test]
fn a_tap_is_on_the_path() {
    let program = "G21 G61 F600\nG0 Z5\nM3 S600\nG33.1 Z-5 K1\nM5\nG1 X5\nM2\n";
    let figures = stock(program, &[]);
    assert_eq!(figures["state"], "complete");
    assert_eq!(figures["deviation"]["exceeds"], false, "{figures}");
}

/// It comes back to where it began, and what it waits for there are no rests.
#[test]
fn a_program_may_end_with_a_tap() {
    let program =
        "G21 G90 G64 P0.02\nG97 S600 M3\nG0 X0 Z2\nG33.1 Z-6 K1\nG0 X10\nG33.1 Z-6 K1\nM2\n";
    let figures = stock(program, &[]);
    assert_eq!(figures["state"], "complete");
    assert_near(&figures["final_error"], 0.0, 1e-6);
    assert_eq!(figures["rests"]["count"], 0, "{figures}");
}

#[test]
fn a_thread_waits_for_its_index() {
    let program = "G21 G90 G18 G95 G64 P0.02\nG97 S600 M3\nG0 X10 Z2\nG33 Z-15 K1.5\nG0 X14\nG0 Z2\n\
                   G0 X9.7\nG33 Z-15 K1.5\nG0 X14\nM2\n";
    let figures = stock(program, &[]);
    assert_eq!(figures["state"], "complete");
    assert_eq!(figures["rests"]["count"], 0, "{figures}");
}

#[test]
fn a_slow_feed_is_no_rest() {
    let program = "G21 G90 G64 P0.02\nG1 X10 F600\nG1 X11 F20\nG1 X20 F600\nM2\n";
    let figures = stock(program, &[]);
    assert_eq!(figures["rests"]["count"], 0, "{figures}");
}

#[test]
fn corners_stay_within_the_tolerance() {
    let bench = Bench::new();
    let text = bench.compare(&["--generated", "squares-p.05", "--with", STOCK, "--json"]);
    let report = crate::support::json(&text);
    let figures = &report["programs"][0]["runs"][0];
    assert!(number(&figures["deviation"]["ratio"]) <= 1.0);
    assert!(number(&figures["missed"]["ratio"]) <= 1.01);
    assert_eq!(figures["missed"]["exceeds"], false);
    // Measured in a real LinuxCNC 2.9.
    assert_near(&figures["motion"]["time"], 8.31, 0.5e-2 * 8.31);
}

#[test]
fn several_moves_a_cycle() {
    let one = stock("G21 G61.1 F6000\nG1 X1\nX2\nX3\nM2\n", &[]);
    let all = stock(
        "G21 G61.1 F6000\nG1 X1\nX2\nX3\nM2\n",
        &["--adds-per-cycle", "3"],
    );
    assert_near(
        &one["motion"]["time"],
        number(&all["motion"]["time"]),
        CYCLES,
    );
}
