//! The generated programs.

use crate::support::{Bench, STOCK, json};
use framepath_tool::canon::{Call, read_text};
use framepath_tool::generated;
use std::process::Command;

fn print(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .arg("generate")
        .args(arguments)
        .output()
        .expect("the program runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn are_listed_and_printed_the_same_every_time() {
    let list = print(&[]);
    for name in generated::names() {
        assert!(list.contains(name));
        let text = print(&[name]);
        assert_eq!(Some(&text), generated::program(name).as_ref());
        assert_eq!(text, print(&[name]));
        assert!(text.lines().all(|line| line.len() < 255));
    }
}

#[test]
fn another_seed_is_another_program() {
    for name in ["polyline", "arcs"] {
        assert_ne!(print(&[name, "--seed", "2"]), print(&[name]));
    }
}

#[test]
fn tolerance_and_feed_can_be_chosen() {
    assert!(print(&["zigzag", "--tolerance", "0.2"]).contains("G64 P0.2\n"));
    assert!(print(&["zigzag", "--tolerance", "0"]).contains("G64\n"));
    assert!(print(&["zigzag", "--feed", "123"]).contains("F123\n"));
}

#[test]
fn an_unknown_name_is_refused() {
    let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .args(["generate", "circle"])
        .output()
        .expect("the program runs");
    assert!(!output.status.success());
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("circle") && message.contains("zigzag"),
        "{message}"
    );
}

/// Moves of a program: straight ones, arcs.
fn count(name: &str) -> (usize, usize) {
    let text = generated::program(name).expect("a program");
    let calls = read_text(name, &text, &[0.0; 9]).expect("the interpreter takes it");
    let straight = calls
        .iter()
        .filter(|call| matches!(call, Call::Feed { .. }))
        .count();
    let arcs = calls
        .iter()
        .filter(|call| matches!(call, Call::Arc { .. }))
        .count();
    (straight, arcs)
}

#[test]
fn have_the_moves_that_they_promise() {
    assert_eq!(count("dense"), (10_000, 0));
    assert_eq!(count("trochoidal"), (3000, 0));
    assert_eq!(count("squares-p.05"), (60, 0));
    let (straight, arcs) = count("arcs");
    assert_eq!(straight + arcs, 300);
    assert!(arcs > 150);
}

#[test]
fn the_stock_planner_comes_through_all_of_them() {
    let output = Bench::new().compare(&["--generated", "all", "--with", STOCK, "--json"]);
    let report = json(&output);
    let programs = report["programs"].as_array().expect("programs");
    assert_eq!(programs.len(), generated::compared().len());
    for program in programs {
        let run = &program["runs"][0];
        assert_eq!(run["state"], "complete", "{}", program["program"]);
        assert!(run["motion"]["time"].as_f64() > Some(1.0));
    }
}
