//! Frames beside TWOPASS: what has to change before it can be removed.

use crate::bench::{framepath, samples};
use std::fs;
use std::path::Path;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// What is said of a machine with TWOPASS and these HAL files.
fn said(files: &[(&str, &str)]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let text = fs::read_to_string(Path::new(STOCK).join("axis_mm.ini")).expect("a text");
    let mut lines = "TWOPASS = on\n".to_owned();
    for (name, content) in files {
        fs::write(folder.path().join(name), content).expect("written");
        lines.push_str(&format!("HALFILE = {name}\n"));
    }
    let (before, rest) = text.split_once("[HAL]\n").expect("there");
    fs::write(
        folder.path().join("mill.ini"),
        format!("{before}[HAL]\n{lines}{rest}"),
    )
    .expect("written");
    let subroutines = samples().join("subroutines").display().to_string();
    let options = [
        "configure",
        "mill.ini",
        "--frames",
        "--subroutines",
        &subroutines,
    ];
    let output = framepath(folder.path(), &options);
    assert_eq!(output.status.code(), Some(1));
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn what_asks_for_the_pass_is_named() {
    let tcl = "# ::tp::passnumber tells the pass\nif [::tp::passnumber] {\n  puts twice\n}\n";
    let said = said(&[("own.tcl", tcl)]);
    assert!(
        said.contains("own.tcl:2:5: error: ::tp:: is there with TWOPASS only\n  help: write it without this call before TWOPASS"),
        "{said}"
    );
}

#[test]
fn modules_that_twopass_loads_by_several_lines_are_named() {
    let said = said(&[
        ("a.hal", "loadrt and2 names=one\n"),
        ("b.hal", "loadrt and2 names=two\n"),
    ]);
    let help = "help: remove TWOPASS, and load each module by one loadrt line: and2 (./a.hal:1:1, ./b.hal:1:1), since LinuxCNC joins";
    assert!(said.contains(help), "{said}");
    assert!(!said.contains("::tp::"), "{said}");
}
