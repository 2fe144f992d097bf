//! What the operator does while a program runs.

use crate::support::{Bench, STOCK, assert_near, number};

/// 1 s at 100 mm/s.
const LINE: &str = "G21 G64 P0.1 F6000\nG1 X100\nM2\n";

fn made_up(more: &[&str]) -> serde_json::Value {
    let bench = Bench::new();
    bench.measure(LINE, &bench.module(""), more)
}

#[test]
fn feed_override_and_pause_take_their_time() {
    assert_near(&made_up(&[])["motion"]["time"], 1.0, 1e-9);
    let half = made_up(&["--feed-override", "0.5:0.5"]);
    assert_near(&half["motion"]["time"], 1.5, 0.0011);
    let and_back = made_up(&["--feed-override", "0.2:0.5", "--feed-override", "0.4:2"]);
    // 20 mm + 10 mm, then 70 mm at 200 mm/s
    assert_near(&and_back["motion"]["time"], 0.75, 0.0021);
    assert_near(&and_back["motion"]["velocity"]["ratio"], 2.0, 1e-6);
    let paused = made_up(&["--pause", "0.5:0.25"]);
    assert_near(&paused["motion"]["time"], 1.25, 0.0011);
    assert_eq!(paused["rests"]["count"], 0, "a pause explains the rest");
}

#[test]
fn holds_of_the_stock_planner() {
    let bench = Bench::new();
    let figures = bench.measure(LINE, STOCK.as_ref(), &["--pause", "0.5:0.5"]);
    assert_eq!(figures["holds"]["count"], 1);
    assert_eq!(figures["holds"]["not_at_rest"], 0);
    // It slows down with half the acceleration in G64: 0.2 s in place of 0.1 s.
    assert_near(&figures["holds"]["longest"], 0.2, 0.0021);
    assert_near(&figures["holds"]["mean_ratio"], 2.0, 0.03);
    assert_near(&figures["holds"]["drift"], 0.0, 1e-9);
}

#[test]
fn velocity_slider() {
    let bench = Bench::new();
    let figures = bench.measure(LINE, STOCK.as_ref(), &["--max-velocity", "0:20"]);
    assert_near(&figures["motion"]["velocity"]["value"], 20.0, 1e-6);
    assert_near(
        &figures["motion"]["time"],
        100.0 / 20.0 + 20.0 / 500.0,
        0.0021,
    );
}

#[test]
fn abort() {
    let bench = Bench::new();
    let figures = bench.measure(LINE, STOCK.as_ref(), &["--abort", "0.5"]);
    assert_eq!(figures["state"], "aborted");
    let time = number(&figures["motion"]["time"]);
    assert!((0.6..0.72).contains(&time), "{time}");
    // The program was not to be finished: nothing is missed.
    assert_near(&figures["missed"]["largest"], 0.0, 0.0);
}

#[test]
fn a_random_operator_is_the_same_for_the_same_number() {
    let run = |seed| {
        let bench = Bench::new();
        let line = LINE.replace("X100", "X1000");
        let figures = bench.measure(&line, &bench.module(""), &["--operator", seed]);
        assert_eq!(figures["state"], "complete");
        number(&figures["motion"]["time"])
    };
    let first = run("1");
    assert!((first - 10.0).abs() > 0.01, "the operator does something");
    assert!((run("1") - first).abs() < 1e-12);
    assert!((run("2") - first).abs() > 0.001);
}
