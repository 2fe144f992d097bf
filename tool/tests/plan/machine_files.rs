//! The configuration as LinuxCNC reads it: lines that it passes over, files that it does not find.

use crate::support::{Bench, MILL, number};
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

const PROGRAM: &str = "G21 G90 F5000\nG1 X10\nM2\n";

/// What is not understood is told, and nothing more.
#[test]
fn lines_that_linuxcnc_passes_over_are_warnings() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write("part.mpf", "G1 X1 F100\nM30\n");
    let mark = "\u{feff}";
    for (ini, line) in [
        (format!("{MILL}stray line\n"), 33),
        (format!("{mark}# mill\n{MILL}"), 1),
        (format!("{MILL}#INCLUDE nowhere.inc\n"), 33),
        (format!("{MILL}#INCLUDE\n"), 33),
    ] {
        bench.write("mill.ini", &ini);
        let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
        let told = String::from_utf8(output.stderr).expect("text");
        assert!(output.status.success(), "{told}");
        assert!(
            told.starts_with(&format!("warning: mill.ini:{line}: "))
                && told.contains("LinuxCNC passes over this line"),
            "{told}"
        );
        let filtered = Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(bench.path())
            .env("INI_FILE_NAME", "mill.ini")
            .args(["filter", "--dialect", "sinumerik", "part.mpf"])
            .output()
            .expect("the program runs");
        let told = String::from_utf8(filtered.stderr).expect("text");
        assert!(filtered.status.success(), "{told}");
        assert!(
            told.contains(&format!("warning: mill.ini:{line}: ")),
            "{told}"
        );
    }
}

/// The machine has the jerk of its HAL files, by whatever statement, and the plan that of its INI file.
#[test]
fn another_jerk_of_a_hal_file_is_a_warning() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write("mill.ini", &format!("{MILL}[HAL]\nHALFILE = mill.hal\n"));
    for (lines, warning) in [
        ("setp blendtp.axis.x.max-jerk [AXIS_X]MAX_JERK\n", None),
        ("setp blendtp.axis.x.max-jerk 0x4e20\n", None),
        (
            "setp blendtp.axis.x.max-jerk 2000\n",
            Some(
                "blendtp.axis.x.max-jerk is set to 2000, and the plan is with [AXIS_X]MAX_JERK = 20000",
            ),
        ),
        (
            "net jerk blendtp.axis.z.max-jerk\nsets jerk 0\n",
            Some(
                "blendtp.axis.z.max-jerk is set to 0, and the plan is with [AXIS_Z]MAX_JERK = 5000",
            ),
        ),
    ] {
        bench.write("mill.hal", lines);
        let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
        let told = String::from_utf8(output.stderr).expect("text");
        assert!(output.status.success(), "{told}");
        let is_told =
            |words: &str| told.contains(&format!("mill.hal:{}:1: {words}", lines.lines().count()));
        assert_eq!(
            warning.is_some_and(is_told),
            warning.is_some(),
            "{lines}: {told}"
        );
        assert_eq!(
            told.contains("max-jerk"),
            warning.is_some(),
            "{lines}: {told}"
        );
        let given = bench.plan(&["part.ngc", "--ini", "mill.ini", "--jerk", "20A"]);
        let told = String::from_utf8(given.stderr).expect("text");
        assert!(!told.contains("max-jerk"), "{lines}: {told}");
    }
}

/// It may have limits.
#[test]
fn an_include_that_only_a_shell_understands_is_refused() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write("mill.ini", &format!("{MILL}#INCLUDE $(ls)\n"));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with("mill.ini:33: #INCLUDE $(ls): "),
        "{error}"
    );
}

/// LinuxCNC gives its interpreter the INI file with those that it includes.
#[test]
fn subroutines_of_an_included_file_are_found() {
    let bench = Bench::new();
    let (keys, include) = (
        "[RS274NGC]\nSUBROUTINE_PATH = subs\n",
        "#INCLUDE more.inc\n",
    );
    bench.write("mill.ini", &MILL.replace("[RS274NGC]\n", include));
    bench.write("more.inc", keys);
    std::fs::create_dir(bench.path().join("subs")).expect("a folder");
    bench.write(
        "subs/far.ngc",
        "o<far> sub\nG1 X100 F6000\no<far> endsub\nM2\n",
    );
    let figures = bench.figures("G21\no<far> call\nM2\n", &["--ini", "mill.ini"]);
    assert_eq!(figures["path_length"], 100.0);
}

/// What LinuxCNC does not read of an INI file is no part of the machine.
#[test]
fn lines_are_those_that_linuxcnc_has() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    let (before, axes) = MILL.split_once("[AXIS_X]").expect("there");
    bench.write("axes.inc", &format!("[AXIS_X]{axes}"));
    for end in [
        "\n  #INCLUDE axes.inc\n",
        "\n#INCLUDE axes.inc",
        "\n#INCLUDE axes.inc\r\n",
    ] {
        bench.write("mill.ini", &format!("{}{end}", before.trim_end()));
        let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
        let told = String::from_utf8(output.stderr).expect("text");
        assert!(
            told.contains("LinuxCNC passes over this line"),
            "{end:?}: {told}"
        );
        assert!(told.contains("[AXIS_X]"), "{end:?}: {told}");
    }
    bench.write("mill.ini", &MILL.replacen("100\n", "100\r\r\n", 1));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("LinuxCNC refuses the file: a carriage return"),
        "{error}"
    );
}

/// Moves of a file of subroutines have lines of that file, which are none of the program.
#[test]
fn lines_of_subroutines_are_not_those_of_the_program() {
    let bench = Bench::new();
    let keys = "[RS274NGC]\nSUBROUTINE_PATH = subs\n";
    bench.write("mill.ini", &MILL.replace("[RS274NGC]\n", keys));
    std::fs::create_dir(bench.path().join("subs")).expect("a folder");
    let corners = "o<corners> sub\nG1 X1 F6000\nY1\nX2\nY2\no<corners> endsub\nM2\n";
    bench.write("subs/corners.ngc", corners);
    let program = "G21 G61.1\n(two)\n(three)\n(four)\no<corners> call\n(six)\nM2\n";
    let figures = bench.figures(program, &["--ini", "mill.ini"]);
    let slowest = figures["slowest"].as_array().expect("places");
    let below = figures["evenness"]["below"].as_array().expect("stretches");
    assert!(!slowest.is_empty() && !below.is_empty(), "{figures}");
    for place in slowest.iter().chain(below) {
        assert_eq!(
            (&place["text"], &place["of_program"]),
            (&"".into(), &false.into()),
            "{place}"
        );
    }
    // What is called is known behind the plan; nothing is written before.
    let subs = bench.path().join("subs/corners.ngc");
    std::os::unix::fs::symlink(&subs, bench.path().join("link")).expect("a link");
    for file in ["subs/corners.ngc", "link"] {
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini", "--csv", file]);
        assert!(
            error.starts_with(&format!("{file}: this file is read")),
            "{error}"
        );
        assert_eq!(bench.read("subs/corners.ngc"), corners);
    }
}

/// What the planner refuses, and what it is warned of, in a file of subroutines has the line of that file beside it.
#[test]
fn lines_of_subroutines_are_told_with_their_file() {
    let bench = Bench::new();
    let keys = "[RS274NGC]\nSUBROUTINE_PATH = subs\n";
    let limited = MILL.replace("[JOINT_0]\n", "[JOINT_0]\nMAX_LIMIT = 30\n");
    bench.write("mill.ini", &limited.replace("[RS274NGC]\n", keys));
    std::fs::create_dir(bench.path().join("subs")).expect("a folder");
    let local = "o<local> sub\n(two)\nG1 X1\no<local> endsub\n";
    let program = format!("{local}G21 F600 M3 S600 G1 Y1\no<called> call\no<local> call\nM2\n");
    bench.write("part.ngc", &program);
    let folder = std::fs::canonicalize(bench.path()).expect("a folder");
    let called = folder.join("subs/called.ngc").display().to_string();
    let told = |line: &str| {
        let text = format!("o<called> sub\n(two)\nX2\n{line}\nG1 X3\no<called> endsub\nM2\n");
        bench.write("subs/called.ngc", &text);
        String::from_utf8(bench.plan(&["part.ngc", "--ini", "mill.ini"]).stderr).expect("text")
    };
    for (line, said) in [
        ("G33 Z-10 K20", "the planner stops the motion: "),
        (
            "G1 Y1000000000000000000000",
            "the planner refuses the move: ",
        ),
        ("G1 X40", "joint 0 goes to 40.000, beyond"),
    ] {
        let told = told(line);
        assert!(told.contains(&format!("{called}:4: {said}")), "{told}");
    }
    // One of the program itself is none of another file.
    bench.write("part.ngc", &program.replace("X1", "X40"));
    let told = told("X5");
    assert!(
        told.contains("part.ngc:3: joint 0 goes to") && !told.contains(&called),
        "{told}"
    );
}

#[test]
fn a_file_of_a_remap_that_is_not_there_is_named() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    let remap = "[RS274NGC]\nSUBROUTINE_PATH = subs\nREMAP = M6 modalgroup=6 ngc=change\n";
    bench.write("mill.ini", &MILL.replace("[RS274NGC]\n", remap));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with("mill.ini:12: [RS274NGC]REMAP = M6") && error.contains("change.ngc"),
        "{error}"
    );
    std::fs::create_dir(bench.path().join("subs")).expect("a folder");
    bench.write(
        "subs/change.ngc",
        "o<change> sub\no<change> endsub [1]\nM2\n",
    );
    assert!(
        bench
            .plan(&["part.ngc", "--ini", "mill.ini"])
            .status
            .success()
    );
}

#[test]
fn remaps_that_want_more_than_the_interpreter_are_told_with_their_reason() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    let python = "[PYTHON]\nPATH_PREPEND = .\nTOPLEVEL = top.py\n";
    let remap = "[RS274NGC]\nREMAP = M471 modalgroup=10 python=m471\n";
    let ini = MILL.replace("[RS274NGC]\n", remap);
    bench.write("mill.ini", &format!("{ini}{python}"));
    for (module, help) in [
        (
            "emccanon",
            "which only LinuxCNC's own task has: plan with a copy of the INI file without [PYTHON]",
        ),
        (
            "glue_that_is_nowhere",
            "which is in no folder of [PYTHON]PATH_PREPEND and PATH_APPEND",
        ),
    ] {
        bench.write("top.py", &format!("import {module}\n"));
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        let cause = format!("No module named '{module}'");
        assert!(error.contains(&cause) && error.contains(help), "{error}");
    }
}

/// As LinuxCNC has it: files are beside the link.
#[test]
fn files_are_looked_for_beside_a_link_to_the_ini_file() {
    let bench = Bench::new();
    let keys = "[RS274NGC]\nSUBROUTINE_PATH = subs\n";
    let tools = "[EMCIO]\nTOOL_TABLE = tools.tbl\n";
    let machine = bench.path().join("machine");
    std::fs::create_dir(&machine).expect("a folder");
    std::fs::create_dir(bench.path().join("subs")).expect("a folder");
    bench.write(
        "machine/mill.ini",
        &(MILL.replace("[RS274NGC]\n", keys) + tools),
    );
    bench.write("machine/tools.tbl", "T1 P1\n");
    bench.write("tools.tbl", "T5 P5\n");
    bench.write(
        "subs/there.ngc",
        "o<there> sub\nG1 X3\no<there> endsub\nM2\n",
    );
    bench.write(
        "part.ngc",
        "G21 G90 F500\no<there> call\nT5 M6\nG1 X10\nM2\n",
    );
    std::os::unix::fs::symlink("machine/mill.ini", bench.path().join("mill.ini")).expect("a link");
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn numbers_that_linuxcnc_does_not_take_are_refused() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    for (from, to, line) in [
        ("MAX_VELOCITY = 100", "MAX_VELOCITY = 50 # c", 13),
        ("MAX_VELOCITY = 100", "MAX_VELOCITY = 50,5", 13),
        ("MAX_VELOCITY = 100", "MAX_VELOCITY = 1e400", 13),
        ("MAX_JERK = 20000", "MAX_JERK = 20000 # c", 15),
        ("SERVO_PERIOD = 1000000", "SERVO_PERIOD = 1e6", 4),
        ("SERVO_PERIOD = 1000000", "SERVO_PERIOD = 1000000 # ns", 4),
        ("[KINS]\n", "[KINS]\nJOINTS = 3 # axes\n", 9),
    ] {
        bench.write("mill.ini", &MILL.replacen(from, to, 1));
        let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
        let value = to.trim_end().rsplit('\n').next().expect("a line");
        assert!(
            error.starts_with(&format!("mill.ini:{line}: ")) && error.contains(value),
            "{error}"
        );
    }
}

/// Whether they run the operator decides.
#[test]
fn blocks_with_a_slash_are_told_or_left_out() {
    let bench = Bench::new();
    let program = "G21 F6000\nG1 X1\n / G1 X5\nG1 X2\nM2\n";
    let greatest = |options: &[&str]| number(&bench.figures(program, options)["axes"][0]["to"]);
    assert!((greatest(&[]) - 5.0).abs() < 1e-3);
    assert!((greatest(&["--skip-blocks"]) - 2.0).abs() < 1e-3);
    let told = |options: &[&str]| {
        let output = bench.plan(&[&["part.ngc"], options].concat());
        String::from_utf8(output.stderr).expect("text")
    };
    assert!(told(&[]).contains("part.ngc: blocks that begin with a slash are planned"));
    assert_eq!(told(&["--skip-blocks"]), "");
}

/// LinuxCNC reads no word of an axis that it does not have, not even where nothing would move; and an arc needs none to move one.
#[test]
fn axes_that_the_machine_does_not_have_are_refused() {
    let bench = Bench::new();
    let lathe = MILL.replace("COORDINATES = XYZ", "COORDINATES = XZ");
    bench.write(
        "lathe.ini",
        &lathe.replace("coordinates=XYZ", "coordinates=XZ"),
    );
    let refused = |line: &str| {
        bench.write(
            "part.ngc",
            &format!("G21 F600 G17\nG1 X5\n{line}\nG1 X9\nM2\n"),
        );
        bench.refused(&["part.ngc", "--ini", "lathe.ini"])
    };
    for line in ["G1 Y0", "G1 X6 A5", "G10 L2 P1 U0"] {
        let told = refused(line);
        let axis = line
            .chars()
            .find(|c| matches!(c, 'Y' | 'A' | 'U'))
            .expect("one");
        let said = format!(
            "part.ngc:3: Bad character '{}' used: the machine has no such axis",
            axis.to_ascii_lowercase()
        );
        assert!(told.starts_with(&said), "{told}");
    }
    for line in ["G2 X7 I1", "G2 I5"] {
        let told = refused(line);
        assert!(
            told.starts_with("part.ngc:3: axis Y moves, which the machine does not have"),
            "{told}"
        );
    }
    let arc = "G21 F600 G18\nG1 X5\nG2 X7 Z-2 I2\nG2 I5\nM2\n";
    bench.figures(arc, &["--ini", "lathe.ini"]);
}

/// How long they take nobody knows here.
#[test]
fn programs_of_the_machine_are_told_and_take_no_time() {
    let bench = Bench::new();
    let path = "[RS274NGC]\nUSER_M_PATH = nowhere:codes\n";
    bench.write("mill.ini", &MILL.replace("[RS274NGC]\n", path));
    std::fs::create_dir(bench.path().join("codes")).expect("a folder");
    for (name, mode) in [("M101", 0o755), ("M102", 0o644)] {
        let file = bench.path().join("codes").join(name);
        std::fs::write(&file, "#!/bin/sh\n").expect("written");
        let permissions = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&file, permissions).expect("changed");
    }
    let program = |code: &str| format!("G21 G90 F600 G64 P1\nG1 X5\n{code}\nG1 Y5\nM2\n");
    let time = |code: &str| {
        let figures = bench.figures(&program(code), &["--ini", "mill.ini"]);
        number(&figures["time"])
    };
    // Motion comes to its end before.
    assert!((time("M101 P1") - time("G4 P0")).abs() < 0.002);
    assert!(time("M101 P1") > time("") + 0.01);
    bench.write("part.ngc", &program("M101 P1"));
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(
        told.contains("warning: part.ngc: ") && told.contains("(M101)") && told.contains("0 s"),
        "{told}"
    );
    bench.write("part.ngc", &program("M102"));
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with("part.ngc:3: ")
            && error.contains("no file that may be run has this name"),
        "{error}"
    );
    let error = bench.refused(&["part.ngc"]);
    assert!(error.contains("M102: it is a program of the machine") && error.contains("--ini"));
}

#[test]
fn pins_of_hal_are_refused_by_name() {
    let bench = Bench::new();
    bench.write(
        "part.ngc",
        "G21 F600\n#1=[#<_hal[motion.in-position]>]\nG1 X5\nM2\n",
    );
    let error = bench.refused(&["part.ngc"]);
    assert!(
        error.starts_with("part.ngc:2: Named parameter #<_hal[motion.in-position]> not defined: it is a pin of HAL"),
        "{error}"
    );
}

#[test]
fn a_jerk_with_which_blendtp_refuses_every_move_is_refused() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    bench.write(
        "mill.ini",
        &MILL.replace("MAX_JERK = 5000", "MAX_JERK = 99"),
    );
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.starts_with("mill.ini:23: [AXIS_Z]MAX_JERK = 99: ")
            && error.contains("at least 100, a fifth"),
        "{error}"
    );
    let other = ["part.ngc", "--ini", "mill.ini", "--jerk"];
    assert!(
        bench
            .plan(&[&other[..], &["20A"]].concat())
            .status
            .success()
    );
    for machine in [
        &["--jerk", "1"][..],
        &["--ini", "mill.ini", "--jerk", "0.1A"],
    ] {
        let error = bench.refused(&[&["part.ngc"], machine].concat());
        assert!(
            error.starts_with("--jerk ") && error.contains("less than 200 mm/s3"),
            "{error}"
        );
    }
}

/// As LinuxCNC and blendtp take them.
#[test]
fn infinite_limits_are_none() {
    let bench = Bench::new();
    let without = MILL.replace("MAX_JERK = 20000", "MAX_JERK = 0");
    let infinite = MILL
        .replace("MAX_JERK = 20000", "MAX_JERK = inf")
        .replace("[TRAJ]\n", "[TRAJ]\nMAX_LINEAR_VELOCITY = inf\n");
    let time = |ini: &str| number(&bench.figures_on(ini, PROGRAM)["time"]);
    assert_eq!(time(&infinite), time(&without));
    let fast = MILL.replacen("MAX_VELOCITY = 100", "MAX_VELOCITY = inf", 1);
    assert_eq!(time(&fast), time(MILL));
    let hard = MILL.replace("MAX_ACCELERATION = 1000", "MAX_ACCELERATION = inf");
    assert!(time(&hard) < time(MILL));
}
