//! Modules that crash, hang or are no planners: reported as that, and the others go on.

use crate::support::{Bench, STOCK, json};

const PROGRAM: &str = "G21 G90 G64 P0.1 F6000\nG1 X10\nY10\nX0\nM2\n";

/// State and detail of a module with this fault.
fn state(fault: &str) -> (String, String) {
    let bench = Bench::new();
    let figures = bench.measure(PROGRAM, &bench.module(fault), &["--patience", "0.5"]);
    let text = |key: &str| figures[key].as_str().unwrap_or_default().to_owned();
    (text("state"), text("detail"))
}

#[test]
fn crashes() {
    let (state, detail) = state("CRASHES");
    assert_eq!(state, "crashed");
    assert!(
        detail.contains("signal 11 in tpRunCycle, cycle 49"),
        "{detail}"
    );
}

#[test]
fn hangs() {
    let (state, detail) = state("HANGS");
    assert_eq!(state, "hung");
    assert!(detail.contains("in tpRunCycle, cycle 49"), "{detail}");
}

#[test]
fn ends_the_process() {
    let (state, detail) = state("EXITS");
    assert_eq!(state, "crashed");
    assert!(detail.contains("it ended the process"), "{detail}");
}

#[test]
fn refuses_a_move() {
    let (state, detail) = state("REFUSES");
    assert_eq!(state, "refused");
    assert!(
        detail.contains("line 4, code -7: made-up: no third move"),
        "{detail}"
    );
}

/// What task would hand over next would run on from there, with moves missing: the time of such a run
/// counts nowhere, and the exit code tells.
#[test]
fn gives_up_a_program() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", PROGRAM);
    let (gives_up, sound) = (bench.module("GIVES_UP"), bench.module(""));
    let output = bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        sound.to_str().expect("text"),
        "--with",
        gives_up.to_str().expect("text"),
    ]);
    assert_eq!(output.status.code(), Some(1));
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(
        error.trim_end(),
        "program.ngc: made-upGIVES_UP.so with jerk unlimited gives up before the end of the move of \
         line 4: made-up: an internal fault"
    );
    let table = String::from_utf8(output.stdout).expect("text");
    assert!(table.contains("GIVES UP: before the end"), "{table}");
    let (state, _) = state("GIVES_UP");
    assert_eq!(state, "gave-up");
}

#[test]
fn stands_still_for_ever() {
    let (state, detail) = state("STICKS");
    assert_eq!(state, "stuck");
    assert!(detail.contains("no motion any more"), "{detail}");
}

#[test]
fn does_not_start() {
    let (state, detail) = state("NO_START");
    assert_eq!(state, "not-usable");
    assert_eq!(detail, "rtapi_app_main returned -1: made-up: no heart");
}

#[test]
fn gives_a_position_that_is_no_number() {
    let bench = Bench::new();
    let figures = bench.measure(PROGRAM, &bench.module("NOT_A_NUMBER"), &[]);
    assert_eq!(figures["motion"]["not_finite"], true);
    let file = bench.write("program.ngc", PROGRAM);
    let module = bench.module("NOT_A_NUMBER");
    let output = bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        module.to_str().expect("text"),
    ]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("a position was not a number"), "{text}");
}

#[test]
fn goes_another_way_when_it_is_run_again() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", PROGRAM);
    let run = |fault: &str| {
        let module = bench.module(fault);
        bench.compare(&[
            file.to_str().expect("text"),
            "--with",
            module.to_str().expect("text"),
            "--repeat",
            "3",
        ])
    };
    assert!(run("").status.success());
    let refused = run("WANDERS");
    let error = String::from_utf8(refused.stderr).expect("text");
    assert!(!refused.status.success());
    assert!(
        error.contains("made-upWANDERS.so: another run of the same program went another way"),
        "{error}"
    );
}

#[test]
fn is_no_planner() {
    let bench = Bench::new();
    let source = bench.path().join("other.c");
    std::fs::write(&source, "int other(void) { return 1; }\n").expect("written");
    let other = bench.compile(source.to_str().expect("text"), "OTHER");
    let figures = bench.measure(PROGRAM, &other, &[]);
    assert_eq!(figures["state"], "not-usable");
    assert_eq!(
        figures["detail"],
        "it is not a planner: tpMotFunctions is missing"
    );

    let text = bench.write("text.so", "this is no module");
    let figures = bench.measure(PROGRAM, &text, &[]);
    assert_eq!(figures["state"], "not-usable");
    let kinematics = "/usr/lib/linuxcnc/modules/trivkins.so";
    let figures = bench.measure(PROGRAM, kinematics.as_ref(), &[]);
    assert_eq!(figures["state"], "not-usable");
}

#[test]
fn the_others_go_on() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", PROGRAM);
    let (hangs, crashes) = (bench.module("HANGS"), bench.module("CRASHES"));
    let output = bench.compare(&[
        file.to_str().expect("text"),
        "--with",
        hangs.to_str().expect("text"),
        "--with",
        crashes.to_str().expect("text"),
        "--with",
        STOCK,
        "--patience",
        "0.5",
        "--json",
    ]);
    let report = json(&output);
    let runs = report["programs"][0]["runs"].as_array().expect("runs");
    let states: Vec<_> = runs.iter().map(|run| run["state"].as_str()).collect();
    assert_eq!(states, [Some("hung"), Some("crashed"), Some("complete")]);
    let ratios = report["ratios"].as_array().expect("ratios");
    assert_eq!(ratios.len(), 2);
    for ratio in ratios {
        assert!(ratio["geometric_mean"].is_null());
        assert_eq!(ratio["not_finished"][0], "program.ngc");
    }
}
