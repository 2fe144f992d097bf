//! What is refused, and what is said then.

use crate::support::{Bench, STOCK, assert_near, json};

#[test]
fn a_missing_file() {
    let message = Bench::new().refused(&["nothing.ngc", "--with", STOCK]);
    assert!(
        message.starts_with("nothing.ngc: cannot be read: No such file"),
        "{message}"
    );
    let message = Bench::new().refused(&[".", "--with", STOCK]);
    assert!(
        message.starts_with(".: cannot be read: it is a folder"),
        "{message}"
    );
}

#[test]
fn a_program_that_the_interpreter_refuses() {
    let bench = Bench::new();
    bench.write("bad.ngc", "G21 G90\nG1 X10\nM2\n");
    let message = bench.refused(&["bad.ngc", "--with", STOCK]);
    assert_eq!(
        message.trim_end(),
        "bad.ngc:2: Cannot do g1 with zero feed rate\n    G1 X10"
    );
    bench.write("worse.ngc", "G0 X1\nG0 X[1\n");
    let message = bench.refused(&["worse.ngc", "--with", STOCK]);
    assert!(message.starts_with("worse.ngc:2: "), "{message}");
    bench.write("spline.ngc", "G64 F100\nG5 I0 J3 P0 Q-3 X1 Y1\nM2\n");
    let message = bench.refused(&["spline.ngc", "--with", STOCK]);
    assert!(
        message.contains("spline.ngc:2: a spline (G5, G5.1, G5.2; write arcs or short lines in its place) is not supported"),
        "{message}"
    );
}

#[test]
fn a_program_without_moves() {
    let bench = Bench::new();
    bench.write("empty.ngc", "G21\nM2\n");
    let message = bench.refused(&["empty.ngc", "--with", STOCK]);
    assert!(
        message.contains("empty.ngc: the program has no moves"),
        "{message}"
    );
}

#[test]
fn no_program_at_all() {
    let message = Bench::new().refused(&["--with", STOCK]);
    assert!(
        message.contains("--generated") && message.contains("squares-p.05"),
        "{message}"
    );
    let message = Bench::new().refused(&["--generated", "circle", "--with", STOCK]);
    assert!(
        message.contains("circle: there is no such program"),
        "{message}"
    );
}

#[test]
fn a_missing_module() {
    let message = Bench::new().refused(&["--generated", "zigzag", "--with", "none.so"]);
    assert!(
        message.starts_with("none.so: there is no such module"),
        "{message}"
    );
}

#[test]
fn values_that_make_no_sense() {
    let bench = Bench::new();
    for (arguments, expected) in [
        (["--limits", "V=0"], "a number above 0"),
        (["--limits", "Q:V=1"], "`Q` is none of the axes"),
        (["--jerk", "-5"], "`-5`"),
        (["--period", "1"], "0.00001 to 0.1"),
        (["--adds-per-cycle", "0"], "0 is not in 1.."),
        (["--pause", "3"], "TIME:VALUE"),
        (["--velocity-limit", "0"], "a number above 0"),
        (["--feed-at-least", "0"], "a number above 0"),
        (["--patience", "0"], "a number above 0"),
        (["--max-feed-override", "0.5"], "a number from 1 up"),
    ] {
        let mut all = vec!["--generated=zigzag", "--with", STOCK];
        let joined = arguments.join("=");
        all.push(&joined);
        let message = bench.refused(&all);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn an_operator_who_holds_the_machine_for_good() {
    let bench = Bench::new();
    let refused =
        |more: &[&str]| bench.refused(&[&["--generated=zigzag", "--with", STOCK], more].concat());
    for option in ["--feed-override", "--max-velocity"] {
        let message = refused(&["--pause", "0.1:0.1", option, "0.2:0"]);
        let start = format!("{option} 0.2:0 holds the machine for good");
        assert!(message.starts_with(&start), "{message}");
    }
    let file = bench.write("program.ngc", "G21 G64 P0.1 F6000\nG1 X20\nM2\n");
    let file = file.display().to_string();
    for more in [
        &["--feed-override", "0.1:0", "--feed-override", "0.2:1"][..],
        &["--max-velocity", "0.1:0", "--abort", "0.3"],
    ] {
        let output = bench.compare(&[&[file.as_str(), "--with", STOCK], more].concat());
        assert!(output.status.success(), "{output:?}");
    }
}

/// The first of several modules is what the others are compared with, and is not judged.
#[test]
fn what_a_module_does_not_keep_is_an_exit_status() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", "G21 G64 P0.1 F6000\nG1 X20\nM2\n");
    let [file, jumps] = [file, bench.module("JUMPS")].map(|path| path.display().to_string());
    let checked = |modules: &[&str]| {
        let with = modules.iter().flat_map(|module| ["--with", module]);
        let arguments: Vec<&str> = [file.as_str(), "--check"].into_iter().chain(with).collect();
        let output = bench.compare(&arguments);
        assert!(String::from_utf8_lossy(&output.stdout).contains("a limit is exceeded by more"));
        let said = String::from_utf8(output.stderr).expect("text");
        (output.status.code(), said)
    };
    let (status, said) = checked(&[STOCK, &jumps]);
    assert_eq!((status, said.lines().count()), (Some(1), 1), "{said}");
    let start =
        "not kept: program.ngc: made-upJUMPS.so with jerk unlimited: velocity is 3 times its limit";
    assert!(said.starts_with(start), "{said}");
    assert!(
        said.contains("the executed path is off the program by more than its tolerance"),
        "{said}"
    );
    assert_eq!(checked(&[&jumps]).0, Some(1));
    assert_eq!(checked(&[STOCK]), (Some(0), String::new()));
    assert_eq!(checked(&[&jumps, STOCK]), (Some(0), String::new()));
}

/// What the INI file of a machine says, in mm whatever its unit is, and an option goes first.
#[test]
fn the_conditions_are_those_of_a_machine() {
    let bench = Bench::new();
    bench.write("program.ngc", "G20 G64 P0.1 F600\nG1 X1\nM2\n");
    let ini = "[EMC]\nMACHINE = inches\n[EMCMOT]\nSERVO_PERIOD = 2000000\n[DISPLAY]\nMAX_FEED_OVERRIDE = 1.5\n\
               [TRAJ]\nLINEAR_UNITS = inch\nANGULAR_UNITS = degree\nMAX_LINEAR_VELOCITY = 3\n[KINS]\nKINEMATICS = trivkins coordinates=XC\n\
               [AXIS_X]\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 20\n[AXIS_C]\nMAX_VELOCITY = 90\nMAX_ACCELERATION = 900\n\
               [JOINT_0]\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 20\n[JOINT_1]\nMAX_VELOCITY = 90\n\
               MAX_ACCELERATION = 900\n";
    bench.write("machine.ini", ini);
    let machine = ["program.ngc", "--with", STOCK, "--ini", "machine.ini"];
    let report = |more: &[&str]| json(&bench.compare(&[&machine, more, &["--json"]].concat()));
    let of_machine = report(&[]);
    assert_near(&of_machine["limits"]["velocity"][0], 50.8, 1e-9);
    assert_near(&of_machine["limits"]["acceleration"][0], 508.0, 1e-9);
    assert_near(&of_machine["limits"]["velocity"][5], 90.0, 0.0);
    assert_near(&of_machine["velocity_limit"], 76.2, 1e-9);
    assert_near(&of_machine["max_feed_override"], 1.5, 0.0);
    assert_near(&of_machine["period"], 0.002, 1e-12);
    let changed = report(&[
        "--limits",
        "X:V=10",
        "--period",
        "0.001",
        "--max-feed-override",
        "1",
    ]);
    assert_near(&changed["limits"]["velocity"][0], 10.0, 0.0);
    assert_near(&changed["limits"]["acceleration"][0], 508.0, 1e-9);
    assert_near(&changed["max_feed_override"], 1.0, 0.0);
    let lower = ini.replace(
        "[JOINT_0]\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 20",
        "[JOINT_0]\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 10",
    );
    bench.write("machine.ini", &lower);
    let told = String::from_utf8(bench.compare(&machine).stderr).expect("text");
    assert!(
        told.starts_with("warning: machine.ini:15:1: [AXIS_X]MAX_ACCELERATION = 20 asks more of the joint than [JOINT_0]"),
        "{told}"
    );
    assert_near(&changed["period"], 0.001, 0.0);
    let text = bench.compare(&machine);
    let text = String::from_utf8(text.stdout).expect("text");
    assert!(
        text.starts_with("limits of machine.ini; F as programmed; servo period 2 ms"),
        "{text}"
    );
    let refused = bench.refused(&["program.ngc", "--with", STOCK, "--ini", "nowhere.ini"]);
    assert!(
        refused.starts_with("nowhere.ini: cannot be read"),
        "{refused}"
    );
}
