//! Modules that are missing, or built for another LinuxCNC.

use crate::bench::{Bench, VERSION, build_module, framepath_with, linuxcnc};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// `framepath check` of framepath-sim under this LinuxCNC: its findings, and whether it ended with an error.
fn check(bench: &Bench, linuxcnc: &Path) -> (Vec<Value>, bool) {
    let arguments = ["check", "framepath-sim.ini", "--json"];
    let output = framepath_with(linuxcnc, &bench.sample("framepath-sim"), &arguments);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let findings = report["findings"].as_array().expect("findings").clone();
    (findings, output.status.code() == Some(1))
}

/// The line of a file of framepath-sim that begins like this, from 1.
fn line(bench: &Bench, ending: &str, start: &str) -> usize {
    let text = bench.read("framepath-sim", ending);
    1 + text
        .lines()
        .position(|line| line.starts_with(start))
        .expect(start)
}

/// Fails unless exactly one thing is found: at the line that loads the module, with these words.
fn assert_found(bench: &Bench, linuxcnc: &Path, module: &str, level: &str, words: &str) {
    let (findings, is_error) = check(bench, linuxcnc);
    let [finding] = findings.as_slice() else {
        panic!("{findings:#?}");
    };
    let (file, number) = match module {
        "blendtp" => ("framepath-sim.ini", line(bench, "ini", "TPMOD = ")),
        _ => (
            "framepath-sim.hal",
            line(bench, "hal", "loadrt [KINS]KINEMATICS"),
        ),
    };
    assert_eq!(finding["level"], level, "{finding}");
    assert_eq!(is_error, level == "error");
    assert!(
        finding["file"].as_str().expect("a file").ends_with(file),
        "{finding}"
    );
    assert_eq!(finding["line"], number, "{finding}");
    let found = finding["found"].as_str().expect("a text");
    let path = linuxcnc.join(format!("{module}.so"));
    assert!(found.starts_with(&path.display().to_string()), "{found}");
    assert!(found.contains(words), "{found}");
    let remedy = finding["remedy"]["text"].as_str().expect("a text");
    assert!(remedy.contains("make install"), "{remedy}");
}

#[test]
fn each_is_found_where_it_is_loaded() {
    let bench = Bench::new();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for module in ["blendtp", "framekins"] {
        linuxcnc(folder);
        assert_eq!(check(&bench, folder), (Vec::new(), false));
        for other in ["2.10.0~pre1", "2.8.4", "3.9.4"] {
            build_module(folder, module, other);
            let words =
                format!("is built for LinuxCNC {other}, and {VERSION} is installed: it refuses");
            assert_found(&bench, folder, module, "error", &words);
        }
        build_module(folder, module, "2.9.0~pre1");
        assert_found(&bench, folder, module, "note", "of the same series");
        build_module(folder, module, "");
        assert_eq!(check(&bench, folder), (Vec::new(), false));
        let file = folder.join(format!("{module}.so"));
        fs::remove_file(&file).expect("removed");
        assert_found(
            &bench,
            folder,
            module,
            "error",
            "is not there, and LinuxCNC does not start",
        );
        fs::create_dir(&file).expect("a folder");
        assert_found(&bench, folder, module, "error", "cannot be read");
        fs::remove_dir(&file).expect("removed");
    }
}

#[test]
fn one_of_others_that_is_missing_is_an_error_where_modules_are_known() {
    let bench = Bench::new();
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    linuxcnc(folder);
    let file = bench.sample("framepath-sim").join("framepath-sim.hal");
    let hal = fs::read_to_string(&file).expect("a text");
    fs::write(&file, format!("{hal}\nloadrt and2\nloadrt andd2\n")).expect("written");
    assert_eq!(check(&bench, folder), (Vec::new(), false));
    for module in ["motmod", "and2"] {
        fs::write(folder.join(format!("{module}.so")), "").expect("written");
    }
    let (findings, is_error) = check(&bench, folder);
    let [finding] = findings.as_slice() else {
        panic!("{findings:#?}");
    };
    assert!(is_error);
    assert_eq!(finding["level"], "error");
    assert_eq!(finding["line"], line(&bench, "hal", "loadrt andd2"));
    let found = finding["found"].as_str().expect("a text");
    assert!(found.contains("LinuxCNC has no module andd2"), "{found}");
    let path = folder.join("andd2.so");
    assert!(found.contains(&path.display().to_string()), "{found}");
}

#[test]
fn without_a_linuxcnc_nothing_is_said() {
    let bench = Bench::new();
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(
        folder.path().join("linuxcnc"),
        "#!/bin/sh\nexec elsewhere\n",
    )
    .expect("written");
    assert_eq!(check(&bench, folder.path()), (Vec::new(), false));
}
