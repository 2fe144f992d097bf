//! What LinuxCNC's interpreter does with a program: its moves with their feeds and path modes.

use crate::rs274::{interpret, numbers};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// The modes in which the filter begins.
const HEADER: &str = "G21 G8 G17 G40 G80 G90 G91.1 G94 G61\n";

/// Tools of 10 and 20 mm, in inch.
const TOOLS: &str = "T1 P1 D0.393700787\nT2 P2 D0.787401575\nT31 P31 D0.393700787\n";

/// One thing that LinuxCNC does: its kind, and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    kind: String,
    numbers: Vec<f64>,
}

/// Moves with their feed, dwells, and the spindle.
pub fn steps(canon: &[String]) -> Vec<Step> {
    let mut list: Vec<Step> = Vec::new();
    let (mut feed, mut mode) = (0.0, String::new());
    let mut at = Vec::new();
    for line in canon {
        if let Some(values) = numbers(line, "SET_FEED_RATE") {
            feed = values[0];
        }
        if let Some((_, rest)) = line.split_once("SET_MOTION_CONTROL_MODE(") {
            mode = rest.trim_end_matches(')').to_string();
        }
        let mut add = |kind: &str, mut numbers: Vec<f64>, feed: Option<f64>| {
            numbers.extend(feed);
            let kind = kind.to_string();
            list.push(Step { kind, numbers });
        };
        if let Some(end) = numbers(line, "STRAIGHT_TRAVERSE") {
            if at != end {
                add("traverse", end.clone(), None);
            }
            at = end;
        } else if let Some(end) = numbers(line, "STRAIGHT_FEED") {
            if at != end {
                add(&format!("feed {mode}"), end.clone(), Some(feed));
            }
            at = end;
        } else if let Some(arc) = numbers(line, "ARC_FEED") {
            add(&format!("arc {mode}"), arc.clone(), Some(feed));
            at = Vec::new();
        } else if let Some(seconds) = numbers(line, "DWELL") {
            add("dwell", seconds, None);
        } else if let Some((_, rest)) = line.split_once("RIGID_TAP(") {
            let values = rest.trim_end_matches(')').split(',');
            add(
                "tap",
                values
                    .filter_map(|value| value.trim().parse().ok())
                    .collect(),
                None,
            );
        } else {
            for spindle in [
                "START_SPINDLE_CLOCKWISE",
                "START_SPINDLE_COUNTERCLOCKWISE",
                "STOP_SPINDLE",
            ] {
                if line.contains(spindle) {
                    add(spindle, Vec::new(), None);
                }
            }
        }
    }
    list
}

/// What LinuxCNC does with what the filter writes for a program.
pub fn translated(dialect: Dialect, program: &str, arguments: &[&str]) -> Vec<Step> {
    let shop = Shop::with(dialect, program);
    let output = shop.accepted(arguments);
    steps(&interpret(&shop.path(""), TOOLS, &output))
}

/// What LinuxCNC does with a program of its own language.
pub fn plain(program: &str) -> Vec<Step> {
    let shop = Shop::with(Dialect::Fanuc, "M30\n");
    steps(&interpret(
        &shop.path(""),
        TOOLS,
        &format!("{HEADER}{program}"),
    ))
}

/// Fails unless both are the same to the fourth decimal.
pub fn assert_same(given: &[Step], wanted: &[Step], what: &str) {
    for (index, (a, b)) in given.iter().zip(wanted).enumerate() {
        let near = a
            .numbers
            .iter()
            .zip(&b.numbers)
            .all(|(a, b)| (a - b).abs() < 1.5e-4);
        let same = a.kind == b.kind && a.numbers.len() == b.numbers.len() && near;
        assert!(same, "{what}: step {index}: {a:?}, not {b:?}\n{given:#?}");
    }
    assert_eq!(
        given.len(),
        wanted.len(),
        "{what}: {given:?}, not {wanted:?}"
    );
}

/// Fails unless LinuxCNC does the same with both programs.
pub fn assert_pair(program: &str, linuxcnc: &str) {
    let given = translated(Dialect::Fanuc, program, &["--backend", "program"]);
    assert_same(&given, &plain(linuxcnc), program);
}
