//! Joints with limits of their own, behind a table of framekins.

use crate::bench::refusal;
use crate::support::{Bench, STOCK, assert_near, json, number};
use crate::table::{TURN, table};
use serde_json::Value;

/// The first run of a module on the table.
fn run(bench: &Bench, module: &str, more: &[&str]) -> Value {
    let arguments = ["turn.ngc", "--ini", "table.ini", "--with", module, "--json"];
    let output = bench.compare(&[&arguments, more].concat());
    let mut report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report["programs"][0]["runs"][0].take()
}

#[test]
fn the_stock_planner_moves_a_joint_faster_than_it_may_be() {
    let bench = Bench::new();
    bench.write("turn.ngc", TURN);
    for (units, millimetres) in [("mm", 1.0), ("inch", 25.4)] {
        table(&bench, units, millimetres);
        let motion = &run(&bench, STOCK, &[])["motion"];
        // 50 mm from C at 60 degrees/s.
        let ratio = 60f64.to_radians() * 50.0 / 40.0;
        assert_near(&motion["joints"]["velocity"]["ratio"], ratio, 1e-4);
        assert_eq!(motion["joints"]["velocity"]["joint"], 0);
        assert_near(&motion["joints"]["acceleration"]["ratio"], 1.0, 1e-3);
        assert_eq!(motion["joints"]["acceleration"]["joint"], 4);
        assert_near(&motion["velocity"]["ratio"], 1.0, 1e-6);
        assert_eq!(motion["velocity"]["axis"], 5);
        // Axes keep their velocities alone.
        assert_eq!(motion["acceleration"]["ratio"], 0.0);
    }
}

#[test]
fn what_joints_do_not_keep_is_shown_and_an_exit_status() {
    let bench = Bench::new();
    bench.write("turn.ngc", TURN);
    table(&bench, "mm", 1.0);
    let arguments = ["turn.ngc", "--ini", "table.ini", "--with", STOCK, "--check"];
    let output = bench.compare(&arguments);
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        said.trim_end(),
        "not kept: turn.ngc: tpmod.so with jerk unlimited: velocity of joint 0 is 1.309 times its limit at 1.549 s"
    );
    let text = String::from_utf8(output.stdout).expect("text");
    for part in [
        "limits of joints as its HAL files set them behind machine=xyzac with the tool centre point",
        "  joint v/V  ",
        "  1.309!  ",
        "joint       the same of a joint",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// In its joints it is faster than it may be, so that the least time is longer.
#[test]
fn the_least_time_is_that_of_the_joints() {
    let bench = Bench::new();
    bench.write("turn.ngc", TURN);
    table(&bench, "mm", 1.0);
    let found = run(&bench, STOCK, &["--optimum"]);
    let free = run(&bench, STOCK, &["--optimum", "--limits", "C:V=90"]);
    // From where sin C is 40/52.36 on C is as slow as joint 0 may be.
    let from = (40.0 / (60f64.to_radians() * 50.0)).asin();
    let at_c = 2.0 * from.to_degrees() / 60.0;
    let at_joint = 50.0 * 2.0 * from.cos() / 40.0;
    let ramps = 60.0 / 600.0;
    assert_near(&found["optimum"]["time"], at_c + at_joint + ramps, 0.01);
    assert_near(&found["motion"]["time"], 3.1, 0.01);
    assert!(free["optimum"]["time"].as_f64() < found["optimum"]["time"].as_f64());
}

/// Kinematics, jets and limits are those that blendtp would find in LinuxCNC.
#[test]
fn a_module_finds_kinematics_and_limits() {
    let bench = Bench::new();
    bench.write("turn.ngc", "G21 F6000\nG1 X0 C90\nM2\n");
    table(&bench, "mm", 1.0);
    let module = bench.module("ASKS").display().to_string();
    let limited = run(&bench, &module, &["--jerk", "20A"]);
    assert_eq!(limited["state"], "refused");
    assert_eq!(
        limited["detail"],
        "the move of line 2, code -9: at -50.000 50.000, along -1.000 0.000, back 0.000, axis 5, tilt 3, type 4, joints 5, \
         limits 40 1000 20000"
    );
    let plain = ["turn.ngc", "--with", &module, "--json"];
    let output = bench.compare(&plain);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(
        report["programs"][0]["runs"][0]["detail"],
        "the move of line 2, code -9: at 0.000 0.000, along 0.000 0.000, back 0.000, axis -1, tilt -1, type 1, joints 9, \
         limits 0 0 0"
    );
}

#[test]
fn limits_that_make_no_sense_and_kinematics_that_are_not_known() {
    let bench = Bench::new();
    bench.write("turn.ngc", TURN);
    table(&bench, "mm", 1.0);
    let hal = std::fs::read_to_string(bench.path().join("table.hal")).expect("a text");
    let arguments = ["turn.ngc", "--ini", "table.ini", "--with", STOCK];
    for (value, refusal) in [
        ("0", "blendtp.joint.4.max-velocity is 0: since a limit"),
        ("-1", "blendtp.joint.4.max-velocity is -1: since a limit"),
    ] {
        let changed = hal.replace("[JOINT_4]MAX_VELOCITY", value);
        bench.write("table.hal", &changed);
        let said = bench.refused(&arguments);
        assert!(said.starts_with(refusal), "{said}");
    }
    bench.write(
        "table.hal",
        &format!("{hal}setp blendtp.joint.2.max-jerk 1\n"),
    );
    let said = bench.refused(&arguments);
    assert!(
        said.starts_with("blendtp.joint.2.max-jerk is 1: "),
        "{said}"
    );
    bench.write(
        "table.hal",
        &format!("loadrt framekins inner=nokins\n{hal}"),
    );
    let output = bench.compare(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("behind nokins ("), "{text}");
    assert!(text.contains(") do NOT hold here"), "{text}");
    assert!(!text.contains("joint v/V"), "{text}");
    assert!(json(&bench.compare(&[&arguments[..], &["--json"]].concat()))["joints"].is_null());
}

/// The samples turn it on in programs.
#[test]
fn the_tool_centre_point_of_an_option() {
    let bench = Bench::new();
    bench.write("turn.ngc", TURN);
    table(&bench, "mm", 1.0);
    let hal = std::fs::read_to_string(bench.path().join("table.hal")).expect("a text");
    let off = hal.replace("setp framekins.tool-centre-point 1\n", "");
    assert_ne!(hal, off);
    bench.write("table.hal", &off);
    let ratio = |more: &[&str]| {
        let velocity = &run(&bench, STOCK, more)["motion"]["joints"]["velocity"];
        (velocity["joint"].clone(), number(&velocity["ratio"]))
    };
    let (joint, without) = ratio(&[]);
    assert!(
        joint == 4 && (without - 1.0).abs() < 1e-6,
        "{joint} {without}"
    );
    let (joint, with) = ratio(&["--tool-centre-point"]);
    assert!(joint == 0 && with > 1.3, "{joint} {with}");
    // C may turn at 60 degrees/s, and joint 0 is slower.
    let plan = |more: &[&str]| {
        let arguments = ["turn.ngc", "--ini", "table.ini", "--json"];
        let plan = json(&bench.run("plan", &[&arguments, more].concat()));
        number(&plan["programs"][0]["time"])
    };
    assert!(plan(&["--tool-centre-point"]) > plan(&[]) + 0.2);
    bench.write("table.hal", &off.replace("setp blendtp", "# setp blendtp"));
    let arguments = ["turn.ngc", "--ini", "table.ini", "--tool-centre-point"];
    for refused in [bench.compare(&arguments), bench.run("plan", &arguments)] {
        assert_eq!(
            refusal(refused).trim_end(),
            "--tool-centre-point: the HAL files of table.ini set no limits of joints (blendtp.joint.*) behind a table of \
             framekins (machine=xyzac or machine=xyzbc)"
        );
    }
}
