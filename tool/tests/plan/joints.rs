//! Joints with limits of their own, behind a table of framekins.

use crate::support::{Bench, number};
use crate::table::{TURN, table};
use serde_json::Value;

/// The figures of half a turn of the table.
fn planned(units: &str, millimetres: f64, more: &[&str]) -> Value {
    let bench = Bench::new();
    table(&bench, units, millimetres);
    bench.figures(TURN, &[&["--ini", "table.ini", "--check"], more].concat())
}

#[test]
fn joints_stand_beside_the_axes() {
    for (units, millimetres) in [("mm", 1.0), ("inch", 25.4)] {
        let figures = planned(units, millimetres, &["--jerk", "20A"]);
        let joints = figures["joints"].as_array().expect("joints");
        let names: Vec<&str> = joints
            .iter()
            .filter_map(|joint| joint["name"].as_str())
            .collect();
        assert_eq!(names, ["joint.0", "joint.1", "joint.4"]);
        // 50 mm from C over and back, as fast as joint 0 may be.
        assert!((number(&joints[0]["from"]) * millimetres + 100.0).abs() < 1e-6);
        assert!((number(&joints[1]["to"]) * millimetres - 50.0).abs() < 1e-3);
        let velocity = &joints[0]["peaks"][0];
        assert!((number(&velocity["limit"]) * millimetres - 40.0).abs() < 1e-9);
        assert!(
            (0.99..=1.001).contains(&number(&velocity["share"])),
            "{velocity}"
        );
        assert_eq!(joints[2]["unit"], "deg");
        assert_eq!(joints[2]["letter"], "C");
        assert_eq!(figures["axes"][0]["peaks"][1]["limit"], Value::Null);
    }
}

#[test]
fn an_option_of_jerk_is_one_of_joints() {
    let time = |jerk: &str| number(&planned("inch", 25.4, &["--jerk", jerk])["time"]);
    let [unlimited, limited, same] = ["unlimited", "5A", "3000"].map(time);
    assert!(limited > unlimited + 0.1, "{limited} {unlimited}");
    // C alone counts here, whose acceleration is 600 degrees/s2.
    assert!((limited - same).abs() < 0.01, "{limited} {same}");
}

#[test]
fn the_text_has_a_table_of_joints() {
    let bench = Bench::new();
    table(&bench, "mm", 1.0);
    bench.write("turn.ngc", TURN);
    let plan = bench.plan(&["turn.ngc", "--ini", "table.ini"]);
    let text = String::from_utf8(plan.stdout).expect("text");
    let (_, joints) = text.split_once("\nPeaks of the joints\n").expect("a table");
    let row = joints.lines().nth(1).expect("a row");
    let words: Vec<&str> = row.split_whitespace().take(5).collect();
    assert_eq!(
        [words[0], words[1], words[3], words[4]],
        ["0", "velocity", "40", "mm/s"]
    );
    let without = bench.plan(&["turn.ngc"]);
    let text = String::from_utf8(without.stdout).expect("text");
    assert!(!text.contains("Peaks of the joints"), "{text}");
}

/// As blendtp refuses every move with them.
#[test]
fn limits_that_blendtp_refuses_are_refused() {
    let bench = Bench::new();
    table(&bench, "mm", 1.0);
    bench.write("turn.ngc", TURN);
    let hal = bench.read("table.hal");
    for (quantity, value) in [
        ("velocity", "0"),
        ("velocity", "-1"),
        ("acceleration", "0"),
        ("acceleration", "inf"),
    ] {
        let pin = format!("blendtp.joint.2.max-{quantity}");
        bench.write("table.hal", &format!("{hal}setp {pin} {value}\n"));
        let error = bench.refused(&["turn.ngc", "--ini", "table.ini"]);
        let key = quantity.to_uppercase();
        assert!(
            error.contains(&format!("{pin} is {value}: "))
                && error.contains(&format!("[JOINT_2]MAX_{key}")),
            "{error}"
        );
    }
    bench.write(
        "table.hal",
        &format!("{hal}setp blendtp.joint.2.max-velocity inf\n"),
    );
    assert!(
        bench
            .plan(&["turn.ngc", "--ini", "table.ini"])
            .status
            .success()
    );
}
