//! The configuration as LinuxCNC reads it: lines that it passes over, files that it does not find.

use crate::support::{Bench, MILL, number};
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
    bench.write("top.py", "import emccanon_that_is_not_here\n");
    let error = bench.refused(&["part.ngc", "--ini", "mill.ini"]);
    assert!(
        error.contains("No module named 'emccanon_that_is_not_here'")
            && error.contains("copy of the INI file without [PYTHON]"),
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
