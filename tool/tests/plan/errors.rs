//! What is refused, and how it is said.

use crate::bench::refusal;
use crate::support::{Bench, MILL, number};
use std::process::Command;

#[test]
fn ini_files_that_cannot_be_used() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F100\nG1 X1\nM2\n");
    let missing = bench.refused(&["part.ngc", "--ini", "nowhere.ini"]);
    assert!(missing.contains("nowhere.ini: cannot be read"), "{missing}");
    for (taken, named) in [
        ("SERVO_PERIOD = 1000000", "[EMCMOT]SERVO_PERIOD"),
        ("LINEAR_UNITS = mm", "[TRAJ]LINEAR_UNITS"),
    ] {
        bench.write("mill.ini", &MILL.replace(taken, ""));
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        assert!(
            error.contains("mill.ini") && error.contains(named),
            "{error}"
        );
        assert!(error.contains("is missing"), "{error}");
    }
    for units in ["radian", "grad"] {
        let line = format!("[TRAJ]\nANGULAR_UNITS = {units}\n");
        bench.write("mill.ini", &MILL.replace("[TRAJ]\n", &line));
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        let named = format!("[TRAJ]ANGULAR_UNITS = {units}: angles are in degrees here");
        assert!(error.contains(&named), "{error}");
    }
    let negative = MILL.replace("MAX_JERK = 5000", "MAX_JERK = -5");
    bench.write("mill.ini", &negative);
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(error.contains("[AXIS_Z]MAX_JERK = -5"), "{error}");
    bench.write(
        "mill.ini",
        &MILL.replace("[TRAJ]\n", "[TRAJ]\nMAX_LINEAR_VELOCITY = 0\n"),
    );
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("[TRAJ]MAX_LINEAR_VELOCITY = 0: nothing moves with it"),
        "{error}"
    );
    let with_table = MILL.to_owned() + "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    bench.write("mill.ini", &with_table);
    bench.write("tools.tbl", "T1 P1\nT2 P2 Znan\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(error.contains("tools.tbl:2: `Znan`"), "{error}");
    let database = with_table.replace("TOOL_TABLE = tools.tbl", "DB_PROGRAM = ./tools.py");
    bench.write("mill.ini", &database);
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(error.contains("[EMCIO]DB_PROGRAM"), "{error}");
    bench.write("mill.ini", &with_table);
    bench.write("tools.tbl", "T1 P1\nT2 Z20 ;no pocket\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("tools.tbl:2: LinuxCNC does not find this tool: the line has no P"),
        "{error}"
    );
}

/// A table with columns, which LinuxCNC took before there were letters: it skips its lines, and has no tools.
#[test]
fn lines_of_a_tool_table_that_linuxcnc_skips_are_told() {
    let bench = Bench::new();
    let table =
        "TOOLNO POCKET  LENGTH  DIAMETER  COMMENT\n\n  1  1  +0.511000  0.125000  1/8 end mill\n";
    bench.write("tools.tbl", table);
    bench.write(
        "mill.ini",
        &(MILL.to_owned() + "[EMCIO]\nTOOL_TABLE = tools.tbl\n"),
    );
    bench.write("part.ngc", "G21 F6000\nG1 X2\nM2\n");
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{told}");
    assert!(
        told.contains(
            "tools.tbl:1: LinuxCNC skips this line, and line 3: `TOOLNO` is no word of a tool table"
        ),
        "{told}"
    );
    bench.write("part.ngc", "G21 F6000\nT1 M6\nG1 X2\nM2\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("tool 1 not found in the tool table"),
        "{error}"
    );
}

#[test]
fn what_an_ini_file_does_not_say_is_as_linuxcnc_has_it_and_told() {
    let bench = Bench::new();
    let part = "G21 F6000\nG1 Z2\nM2\n";
    bench.write("part.ngc", part);
    let no_table = MILL.to_owned() + "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    bench.write("mill.ini", &no_table);
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{told}");
    assert!(
        told.contains("mill.ini:34: [EMCIO]TOOL_TABLE = tools.tbl: there is no such file"),
        "{told}"
    );
    let velocity = "MAX_VELOCITY = 50\nMAX_ACCELERATION = 500\nMAX_JERK";
    bench.write("mill.ini", &MILL.replace(velocity, "MAX_JERK"));
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(
        told.contains("warning: mill.ini: [AXIS_Z]MAX_VELOCITY is missing: LinuxCNC takes 1 mm/s")
            && told.contains("[AXIS_Z]MAX_ACCELERATION is missing: LinuxCNC takes 1 mm/s2"),
        "{told}"
    );
    let time = number(&bench.figures(part, &["--ini", "mill.ini"])["time"]);
    // 1 s to a velocity of 1 mm/s, 1 s at it, 1 s to rest; jerk is high
    assert!((time - 3.0).abs() < 0.01, "{time}");
}

#[test]
fn programs_that_cannot_be_planned() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    let refused = |program: &str| {
        bench.write("part.ngc", program);
        bench.refused(&["part.ngc", "--ini", "mill.ini"])
    };
    let syntax = refused("G21 F100\nG1 X1\nG1 X2 Q?\nG1 X3\nM2\n");
    assert!(
        syntax.starts_with("part.ngc:3: ") && syntax.contains("G1 X2 Q?"),
        "{syntax}"
    );
    let no_feed = refused("G21\nG1 X1\nM2\n");
    assert!(no_feed.starts_with("part.ngc:2: "), "{no_feed}");
    for spline in [
        "G5.1 X3 Y3 I1 J1",
        "G5.2 X3 Y3 P1 L3\nX4 Y4 P1\nX5 Y6 P1\nG5.3",
    ] {
        let error = refused(&format!("G21 F100\nG1 X1\n{spline}\nM2\n"));
        assert!(error.contains("write arcs or short lines"), "{error}");
    }
    let nothing = refused("G21\nM2\n");
    assert!(nothing.contains("part.ngc: nothing moves"), "{nothing}");
    let startup = MILL.replace("G61.1 G21", "G61.1 G999");
    bench.write("mill.ini", &startup);
    bench.write("part.ngc", "G1 X1 F100\nM2\n");
    let code = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        code.starts_with("part.ngc: [RS274NGC]RS274NGC_STARTUP_CODE: "),
        "{code}"
    );
    assert!(code.contains("G61.1 G999"), "{code}");
    let missing = bench.refused(&["nothing.ngc"]);
    assert!(missing.contains("nothing.ngc: cannot be read"), "{missing}");
}

#[test]
fn programs_without_an_end() {
    let bench = Bench::new();
    let made = Command::new("mkfifo")
        .arg(bench.path().join("pipe.ngc"))
        .status();
    assert!(made.is_ok_and(|status| status.success()));
    std::fs::create_dir(bench.path().join("folder.ngc")).expect("a folder");
    bench.write("long.ngc", "G21 F100\nG1 X1\nM2\n");
    bench.write("silent.ngc", "o1 while [1]\n#1=1\no1 endwhile\nM2\n");
    bench.write(
        "moving.ngc",
        "F1000\no1 while [1]\nG1 X1\nG1 X0\no1 endwhile\nM2\n",
    );
    bench.write("slow.ngc", "G21 F.00001\nG1 X1000\nM2\n");
    for (file, said) in [
        ("/dev/zero", "it is a pipe or a device"),
        ("pipe.ngc", "it is a pipe or a device"),
        ("folder.ngc", "it is a folder"),
        ("long.ngc", "more than 5 bytes; --most-bytes raises"),
        ("silent.ngc", "--most-seconds raises"),
        ("moving.ngc", "--most-seconds raises"),
        ("slow.ngc", "--most-seconds raises"),
    ] {
        let bytes = if file == "long.ngc" { "5" } else { "1000" };
        let options = [file, "--most-seconds", "1", "--most-bytes", bytes];
        let shown = bench.refused(&options);
        assert!(shown.starts_with(file) && shown.contains(said), "{shown}");
    }
}

#[test]
fn options_that_make_no_sense() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F100\nG1 X1\nM2\n");
    for (option, value) in [("--limits", "V=fast"), ("--jerk", "-3")] {
        let output = bench.plan(&["part.ngc", &format!("{option}={value}")]);
        assert_eq!(output.status.code(), Some(2));
        let shown = refusal(output);
        assert!(
            shown.contains(option) && shown.contains("a number above 0"),
            "{shown}"
        );
    }
    for option in ["--velocity-limit", "--feed-at-least", "--jerk"] {
        for value in ["-1", "1e-308", "1e308"] {
            let output = bench.plan(&["part.ngc", option, value]);
            assert_eq!(output.status.code(), Some(2), "{option} {value}");
            let shown = refusal(output);
            assert!(
                shown.contains("invalid value") && shown.contains("a number"),
                "{shown}"
            );
        }
    }
    let nobody = bench.plan(&["part.ngc", "--limits", ":V=5"]);
    assert!(refusal(nobody).contains("names no axis before the colon"));
    let two = bench.refused(&["part.ngc", "part.ngc", "--html", "both.html"]);
    assert!(two.contains("one by one"), "{two}");
    let unwritable = bench.refused(&["part.ngc", "--svg", "no/folder.svg"]);
    assert!(
        unwritable.contains("no/folder.svg: cannot be written"),
        "{unwritable}"
    );
    assert_eq!(
        bench.plan(&["part.ngc", "--period", "0"]).status.code(),
        Some(2)
    );
    assert_eq!(bench.plan(&[]).status.code(), Some(2));
}

#[test]
fn a_spindle_that_does_not_turn_is_told() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F100\nG33 Z-5 K1\nM2\n");
    let error = bench.refused(&["part.ngc"]);
    assert!(error.contains("part.ngc:2: "), "{error}");
}

#[test]
fn a_thread_that_is_too_fast_for_the_axes_is_told() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 S6000 M3\nG33 Z-50 K10\nM2\n");
    let error = bench.refused(&["part.ngc"]);
    assert!(
        error.contains("part.ngc:2: ") && error.contains("the axes allow 100.000 units/s"),
        "{error}"
    );
}

#[test]
fn two_outputs_in_one_file_are_refused() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F1000\nG1 X1\nM2\n");
    for again in ["out", "./out"] {
        let error = bench.refused(&["part.ngc", "--svg", "out", "--csv", again]);
        assert!(
            error.starts_with(&format!("{again}: ")) && error.contains("a file of its own"),
            "{error}"
        );
    }
}

/// In cycles of the servo thread it is more than can be counted.
#[test]
fn a_dwell_of_ages_is_refused() {
    let bench = Bench::new();
    let ages = format!("G4 P1{}", "0".repeat(30));
    bench.write(
        "part.ngc",
        &format!("G21 F1000\nG1 X1\n{ages}\nG1 X2\nM2\n"),
    );
    let error = bench.refused(&["part.ngc"]);
    assert!(
        error.contains("part.ngc: behind line 2 the program dwells for 1e30 s"),
        "{error}"
    );
    bench.write("part.ngc", &format!("{ages}\nG1 X2 F1000\nM2\n"));
    let error = bench.refused(&["part.ngc"]);
    assert!(
        error.starts_with("part.ngc: before its first move the program dwells"),
        "{error}"
    );
}

/// The line of the program that called it, and file and text of the mistake.
#[test]
fn a_mistake_in_the_file_of_a_subroutine_is_told() {
    let bench = Bench::new();
    let ini = MILL.replace("[RS274NGC]\n", "[RS274NGC]\nSUBROUTINE_PATH = .\n");
    bench.write("mill.ini", &ini);
    bench.write(
        "pocket.ngc",
        "o<pocket> sub\nG1 X1\nG1 X2 Q?\no<pocket> endsub\nM2\n",
    );
    let local = "o<local> sub\nG1 Y1\no<pocket> call\no<local> endsub\n";
    bench.write("part.ngc", &format!("{local}G21 F100\no<local> call\nM2\n"));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with("part.ngc:6: ") && error.contains("    pocket.ngc: G1 X2 Q?"),
        "{error}"
    );
    bench.write(
        "pocket.ngc",
        "o<pocket> sub\nG1 X1\nG1 X2 F0\no<pocket> endsub\nM2\n",
    );
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert_eq!(
        error,
        "part.ngc:6: Cannot do g1 with zero feed rate\n    pocket.ngc, line 3: G1 X2 F0\n"
    );
}

/// The plan would be that of a program without its frame.
#[test]
fn frames_are_refused() {
    let bench = Bench::new();
    let ini = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../hal-component/configs/framepath-sim/framepath-sim.ini"
    );
    for frame in [
        "o<trans> call [10] [0] [0]",
        "G77.2 Z30",
        "o<amirror> call [1] [0] [0]",
    ] {
        bench.write(
            "part.ngc",
            &format!("G21 F1000 G61.1\n{frame}\nG1 X5\nM2\n"),
        );
        let error = bench.refused(&["part.ngc", "--ini", ini]);
        let (place, what) = error.split_once(": a ").expect("a place");
        assert!(
            place.starts_with("part.ngc:2: in frame_send.ngc, line "),
            "{frame}: {error}"
        );
        assert!(what.starts_with("programmed frame (framekins)"), "{error}");
    }
    bench.write("part.ngc", "G21 F1000 G61.1\nG77\nG1 X5\nM2\n");
    assert!(bench.plan(&["part.ngc", "--ini", ini]).status.success());
}

/// A remap as LinuxCNC's samples have it: what does not find the pin ends the program.
fn switch_to(kind: u8) -> String {
    format!(
        "o<type_{kind}> sub\no1 if [EXISTS[#<_hal[motion.switchkins-type]>]]\no1 else\nM2\no1 endif\nM68 E3 Q{kind}\nM66 E0 L0\n\
         o<type_{kind}> endsub\n"
    )
}

/// Limits of axes hold with each type; but the machine stands elsewhere in the coordinates of another one.
#[test]
fn moves_behind_a_switch_of_the_kinematics_are_refused() {
    let bench = Bench::new();
    let remaps = "[RS274NGC]\nHAL_PIN_VARS = 1\nSUBROUTINE_PATH = .\nREMAP = M428 modalgroup=10 ngc=type_1\n\
                  REMAP = M429 modalgroup=10 ngc=type_0\n";
    let net = "[HAL]\nHALCMD = net kinds motion.analog-out-03 => motion.switchkins-type\n";
    let ini = MILL.replace("[RS274NGC]\n", remaps);
    bench.write("mill.ini", &format!("{ini}{net}"));
    for kind in [0, 1] {
        bench.write(&format!("type_{kind}.ngc"), &switch_to(kind));
    }
    let moves = |program: &str| {
        bench.write("part.ngc", program);
        bench.plan(&["part.ngc", "--ini", "mill.ini"]).status
    };
    assert!(moves("G21 F6000\nM428\nG1 X5\nX9\nM429\nM2\n").success());
    bench.write("part.ngc", "G21 F6000\nG1 X5\nM428\nX9\nM2\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with(
            "part.ngc:4: a move with kinematics of type 1 behind moves with type 0 (plan the part with each type by itself)"
        ),
        "{error}"
    );
    bench.write("mill.ini", &ini);
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with(
            "part.ngc:3: in type_1.ngc, line 2: a program that asks for the type of the kinematics"
        ),
        "{error}"
    );
}

#[test]
fn a_switch_of_the_tool_centre_point_says_what_to_write() {
    let bench = Bench::new();
    let ini = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../hal-component/configs/framepath-xyzac/framepath-xyzac.ini"
    );
    for switch in ["G43.4 H1", "o<tool_centre_off> call"] {
        bench.write("part.ngc", &format!("G21 F1000\nG1 X5\n{switch}\nX9\nM2\n"));
        let error = bench.refused(&["part.ngc", "--ini", ini]);
        assert!(
            error.starts_with("part.ngc:3: in frame_send.ngc, line 1: a switch of the tool centre point (write G43 "),
            "{error}"
        );
    }
}

/// Remapped codes and calls lead the interpreter elsewhere.
#[test]
fn the_line_of_a_mistake_is_that_of_the_program() {
    let bench = Bench::new();
    let remap = "[RS274NGC]\nSUBROUTINE_PATH = .\nREMAP = M6 modalgroup=6 ngc=change\n";
    let tools = "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    bench.write("mill.ini", &(MILL.replace("[RS274NGC]\n", remap) + tools));
    bench.write("tools.tbl", "T1 P1\n");
    bench.write(
        "change.ngc",
        "o<change> sub\nM6\no<change> endsub [1]\nM2\n",
    );
    for (mistake, said) in [
        ("T999 M6", "part.ngc:3: Requested tool 999 not found"),
        ("o<nosuch> call", "part.ngc:3: "),
    ] {
        let program = format!("G21 G90 F500\nG1 X1\n{mistake}\nX2\nX3\nM2\n");
        bench.write("part.ngc", &program);
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        assert!(error.starts_with(said), "{error}");
        assert!(error.trim_end().ends_with(mistake), "{error}");
    }
}

/// LinuxCNC's own words would not say that it is another language.
#[test]
fn programs_of_other_controls_are_told_from_mistakes() {
    let bench = Bench::new();
    bench.write("part.mpf", "%_N_PART_MPF\nTRANS X10\nG0 X1\nM30\n");
    let error = bench.refused(&["part.mpf"]);
    let help = "\n  help: taken as sinumerik: framepath filter part.mpf > part.ngc first\n";
    assert!(error.ends_with(help), "{error}");
    bench.write("call.ngc", "G90\n(P1 = 3)\n(CALL 5)\nG0 XP1\nM30\n");
    let error = bench.refused(&["call.ngc"]);
    let help = "taken as fagor: framepath filter call.ngc > call.filtered.ngc first\n";
    assert!(error.ends_with(help), "{error}");
    // LinuxCNC has these words, too, and what speaks for others stands in comments.
    for program in [
        "#1 = 5\n#2 = 6\nG43 H1\nG0 X[#1\nM2\n",
        "(MSG, CR=1)\n(D=6. CR=0. TRANS ROT MIRROR)\n(V.P. V.L. G161)\nG0 X[1\nM2\n",
    ] {
        bench.write("part.ngc", program);
        let error = bench.refused(&["part.ngc"]);
        assert!(!error.contains("help"), "{error}");
    }
}

/// The words of the interpreter do not say how, and the line of the startup code is none of the program.
#[test]
fn a_program_without_an_end_is_told_how_to_end() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    for (program, place) in [
        ("", "part.ngc: "),
        ("\n\n", "part.ngc: "),
        ("G21 F100\nG1 X1\n", "part.ngc:2: "),
    ] {
        bench.write("part.ngc", program);
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        assert!(
            error.starts_with(place) && error.contains("end it with a line M2"),
            "{error}"
        );
        assert!(!error.contains("G61.1"), "{error}");
    }
    // What cannot be carried out of the startup code is named as that, with its text.
    bench.write("mill.ini", &MILL.replace("G61.1 G21", "G21 G3333"));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("RS274NGC_STARTUP_CODE") && error.contains("G3333"),
        "{error}"
    );
}

/// The planner stops in the fourth line, with moves of the lines behind it in its queue.
#[test]
fn what_stops_behind_the_spindle_is_told_with_its_line() {
    let bench = Bench::new();
    for (line, told) in [
        (
            "G95 F.1 M5\nG1 X1",
            "it follows the turns of a spindle that stands (M5, or S0)",
        ),
        ("F600\nG33 Z-10 K20", "to follow the spindle takes 200.0"),
    ] {
        bench.write(
            "part.ngc",
            &format!("G21 M3 S600\nG0 Z5\n{line}\nG1 X2\nX3\nX4\nM2\n"),
        );
        let error = bench.refused(&["part.ngc"]);
        let at = "part.ngc:4: the planner stops the motion: ";
        assert!(error.contains(&format!("{at}{told}")), "{error}");
    }
}
