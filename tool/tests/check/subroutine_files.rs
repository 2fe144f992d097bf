//! Which files LinuxCNC takes for framepath's subroutines, and what it calls when something is aborted.

use crate::bench::{Bench, framepath, samples};
use std::fs;
use std::path::Path;
use std::process::Output;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

const CALLS: &str =
    "o<on_abort> sub\n  (as LinuxCNC says)\n  o<frame_abort> call\no<on_abort> endsub\nM2\n";
const DOES_NOT: &str = "o<on_abort> sub\n  (o<frame_abort> call)\n  M5\no<on_abort> endsub\nM2\n";

/// LinuxCNC's axis_mm with lines under `[RS274NGC]` and files beside it, configured with frames.
fn configured(
    lines: &str,
    files: &[(&str, &str)],
    subroutines: &str,
) -> (tempfile::TempDir, Output) {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["axis_mm.ini", "sim_mm.tbl", "cooling.hal"] {
        let file = Path::new(STOCK).join(name);
        // LinuxCNC 2.9.0 has no such HAL file, and names none
        if name != "cooling.hal" || file.exists() {
            fs::copy(file, folder.path().join(name)).expect("copied");
        }
    }
    let file = folder.path().join("axis_mm.ini");
    let ini = fs::read_to_string(&file).expect("a text");
    let section = format!("[RS274NGC]\n{lines}");
    fs::write(&file, ini.replacen("[RS274NGC]\n", &section, 1)).expect("written");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
    }
    let arguments = [
        "configure",
        "axis_mm.ini",
        "--frames",
        "--subroutines",
        subroutines,
    ];
    let output = framepath(folder.path(), &arguments);
    (folder, output)
}

fn own() -> String {
    samples().join("subroutines").display().to_string()
}

/// What is said where nothing is written.
fn refused(lines: &str, files: &[(&str, &str)], subroutines: &str) -> String {
    let (folder, output) = configured(lines, files, subroutines);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(output.stdout.is_empty());
    assert!(!folder.path().join("axis_mm-framepath.ini").exists());
    said
}

#[test]
fn an_abort_reaches_framepath_beside_a_subroutine_of_the_users() {
    let command = "ON_ABORT_COMMAND=O <on_abort> call \n";
    for (lines, text, written) in [
        ("", DOES_NOT, true),
        (command, CALLS, false),
        ("ON_ABORT_COMMAND = o<on_abort> call\n", CALLS, false),
    ] {
        let (folder, output) = configured(lines, &[("on_abort.ngc", text)], &own());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{lines}{said}");
        let difference = String::from_utf8_lossy(&output.stdout).into_owned();
        let line = "+ON_ABORT_COMMAND = o<frame_abort> call\n";
        assert_eq!(difference.contains(line), written, "{difference}");
        let output = framepath(folder.path(), &["check", "axis_mm-framepath.ini"]);
        let found = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(found.contains(": 0 errors, 0 warnings"), "{found}");
        // without the call
        fs::write(folder.path().join("on_abort.ngc"), DOES_NOT).expect("written");
        let output = framepath(folder.path(), &["check", "axis_mm-framepath.ini"]);
        let found = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.success(), written, "{found}");
        assert!(
            written || found.contains("on_abort.ngc does not call o<frame_abort>"),
            "{found}"
        );
    }
}

#[test]
fn an_abort_that_does_not_reach_framepath_is_refused() {
    for (lines, words) in [
        (
            "ON_ABORT_COMMAND=O <on_abort> call\n",
            "on_abort.ngc does not call o<frame_abort>: frames stay behind an abort\n  help: o<frame_abort> call as the first line",
        ),
        (
            "ON_ABORT_COMMAND = o<my_abort> call\n",
            "my_abort.ngc is in none of the folders",
        ),
        (
            "ON_ABORT_COMMAND = M5\n",
            "`M5` is called, and not o<frame_abort>",
        ),
    ] {
        let said = refused(lines, &[("on_abort.ngc", DOES_NOT)], &own());
        assert!(
            said.contains("axis_mm.ini:") && said.contains(words),
            "{said}"
        );
    }
    // by another one
    let other = (
        "my_abort.ngc",
        "o<my_abort> sub\no<on_abort> call [#1]\no<my_abort> endsub\nM2\n",
    );
    let files = [other, ("on_abort.ngc", CALLS)];
    let (_, output) = configured("ON_ABORT_COMMAND = o<my_abort> call\n", &files, &own());
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn files_that_linuxcnc_finds_before_framepaths_are_errors() {
    let words = "LinuxCNC finds rot.ngc, trans.ngc in ";
    let files = [
        ("rot.ngc", "M2\n"),
        ("trans.ngc", "M2\n"),
        ("mine.ngc", "M2\n"),
    ];
    let said = refused("", &files, &own());
    assert!(said.contains(words), "{said}");
    let bench = Bench::new();
    let sample = bench.sample("framepath-sim");
    fs::create_dir(sample.join("mine")).expect("a folder");
    for name in ["rot.ngc", "trans.ngc"] {
        fs::write(sample.join("mine").join(name), "M2\n").expect("written");
    }
    for (from, to, is_found) in [
        ("PROGRAM_PREFIX = ", "PROGRAM_PREFIX = mine\nOTHER = ", true),
        ("SUBROUTINE_PATH = ", "SUBROUTINE_PATH = mine:", true),
        ("/subroutines\n", "/subroutines:mine\n", false),
    ] {
        let found = bench.changed("framepath-sim", "ini", from, to);
        let hidden = found.iter().find(|finding| {
            finding["found"]
                .as_str()
                .is_some_and(|found| found.contains(words))
        });
        assert_eq!(hidden.is_some(), is_found, "{to}: {found:?}");
        assert!(
            hidden.is_none_or(|finding| finding["level"] == "error" && finding["line"].is_u64())
        );
    }
}

#[test]
fn a_folder_that_is_not_framepaths_is_refused() {
    for (folder, words) in [
        ("/opt/my subs", "--subroutines /opt/my subs has a blank"),
        ("/opt/a:b", "has `:`"),
        (
            "/opt/nowhere",
            "--subroutines /opt/nowhere: /opt/nowhere is not there",
        ),
        ("/usr", "--subroutines /usr has no frame_guard.py"),
    ] {
        let said = refused("", &[], folder);
        assert!(
            said.contains(words) && said.contains("\n  help: "),
            "{said}"
        );
    }
}

#[test]
fn calls_of_framepaths_subroutines_without_framekins_are_errors() {
    let bench = Bench::new();
    let name = "framepath-sim";
    let hal = bench.read(name, "hal");
    let hal: Vec<&str> = hal
        .lines()
        .filter(|line| !line.contains("framekins"))
        .collect();
    bench.write(name, "hal", &(hal.join("\n") + "\n"));
    let ini = bench.read(name, "ini");
    let named = |line: &&str| !line.contains("HALFILE = ../../panel/");
    let ini: Vec<&str> = ini.lines().filter(named).collect();
    bench.write(name, "ini", &(ini.join("\n") + "\n"));
    let from = "KINEMATICS = framekins";
    let found = bench.changed(name, "ini", from, "KINEMATICS = trivkins");
    for words in [
        "M6 calls frame_tool_change, and no tool can be changed: framekins",
        "G77.1 calls code_trans, and the code ends the program",
        "`o<frame_abort> call` fails at each abort",
        "frame_guard does not come up",
    ] {
        let is_told = |finding: &&serde_json::Value| {
            finding["level"] == "error"
                && finding["found"]
                    .as_str()
                    .is_some_and(|found| found.contains(words))
        };
        assert!(
            found.iter().any(|finding| is_told(&finding)),
            "{words}: {found:?}"
        );
    }
}
