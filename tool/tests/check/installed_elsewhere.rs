//! The command below another PREFIX than /usr: where its subroutines are, and where none are.

use crate::bench::samples;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// The command below `prefix`, and axis_mm to configure.
fn installed(prefix: &Path) -> impl Fn(&[&str]) -> Output {
    let bin = prefix.join("bin");
    fs::create_dir(&bin).expect("a folder");
    let program = bin.join("framepath");
    fs::copy(env!("CARGO_BIN_EXE_framepath"), &program).expect("copied");
    for name in ["axis_mm.ini", "sim_mm.tbl", "cooling.hal"] {
        let file = Path::new(STOCK).join(name);
        // LinuxCNC 2.9.0 has no such HAL file, and names none
        if name != "cooling.hal" || file.exists() {
            fs::copy(file, prefix.join(name)).expect("copied");
        }
    }
    let folder = prefix.to_owned();
    move |arguments: &[&str]| {
        Command::new(&program)
            .args(arguments)
            .current_dir(&folder)
            .output()
            .expect("framepath runs")
    }
}

#[test]
fn subroutines_are_those_that_were_installed_with_the_command() {
    let prefix = tempfile::tempdir().expect("a folder");
    let framepath = installed(prefix.path());
    let arguments = ["configure", "axis_mm.ini", "--frames"];
    let nowhere = ["--subroutines", "/nowhere"];
    let refused = framepath(&[&arguments[..], &nowhere].concat());
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    let words = "--subroutines /nowhere: /nowhere is not there";
    assert!(said.contains(words), "{said}");
    assert!(!prefix.path().join("axis_mm-framepath.ini").exists());

    let subroutines = prefix.path().join("share/framepath/subroutines");
    fs::create_dir_all(&subroutines).expect("a folder");
    for name in ["frame_guard.py", "frame_send.ngc"] {
        let file = samples().join("subroutines").join(name);
        fs::copy(file, subroutines.join(name)).expect("copied");
    }
    let output = framepath(&arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let written = String::from_utf8_lossy(&output.stdout);
    let share = prefix.path().join("share/framepath").display().to_string();
    for line in [
        format!("+SUBROUTINE_PATH = {share}/subroutines\n"),
        format!("+USER_COMMAND_FILE = {share}/preview/frame_axis.py\n"),
        format!("+loadusr -Wn frame-guard {share}/subroutines/frame_guard.py\n"),
    ] {
        assert!(written.contains(&line), "{line} in {written}");
    }
    // of these files few are there: what is named already is not what to write
    let output = framepath(&["check", "axis_mm-framepath.ini"]);
    let found = String::from_utf8_lossy(&output.stdout);
    let help = "make install; or name the folder where these files are";
    assert_eq!(found.matches(help).count(), 1, "{found}");
    for key in ["SUBROUTINE_PATH = ", "USER_COMMAND_FILE = "] {
        assert!(!found.contains(key), "{found}");
    }
}
