//! `framepath record` where there is nothing to record; what it does in a LinuxCNC is in tests/linuxcnc/test_record.py.
#![cfg(unix)]

use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

/// Runs it with `folder` as the only place for programs.
fn record(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(folder)
        .env("PATH", folder)
        .args(["record", "--output", "run.csv"])
        .args(arguments)
        .output()
        .expect("framepath runs")
}

/// What is said where it is refused; nothing is left behind.
fn refused(folder: &Path, arguments: &[&str], status: i32) -> String {
    let output = record(folder, arguments);
    assert_eq!(output.status.code(), Some(status), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
    let files = folder.read_dir().expect("a folder");
    let mut names = files.map(|file| file.expect("a file").file_name());
    assert!(names.all(|name| name == "halcmd"), "something is left");
    String::from_utf8(output.stderr).expect("text")
}

/// A halcmd that does this.
fn halcmd(folder: &Path, script: &str) {
    let file = folder.join("halcmd");
    std::fs::write(&file, format!("#!/bin/sh\n{script}\n")).expect("written");
    std::fs::set_permissions(&file, PermissionsExt::from_mode(0o755)).expect("set");
}

#[test]
fn without_linuxcnc_it_says_what_is_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = refused(folder.path(), &[], 1);
    assert!(
        said.starts_with("halcmd cannot be run: No such file"),
        "{said}"
    );
    assert!(said.contains("install linuxcnc-uspace"), "{said}");
    // HAL is there as soon as anybody looks at it, and has nothing in it.
    halcmd(folder.path(), "echo");
    let said = refused(folder.path(), &["--seconds", "1"], 1);
    assert_eq!(
        said,
        "no LinuxCNC is running here: start it, then call framepath record\n"
    );
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for (option, value, why) in [
        ("--seconds", "0", "a number above 0"),
        ("--buffer", "100", "seconds from 0.01 to 60"),
    ] {
        let said = refused(folder.path(), &[option, value], 2);
        assert!(said.contains(why), "{said}");
    }
}
