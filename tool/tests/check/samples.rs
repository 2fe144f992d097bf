//! Samples as they are shipped: ours are clean, and LinuxCNC's own have no errors but those that they do have.

use crate::bench::{Bench, SAMPLES, framepath};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// LinuxCNC's sample configurations.
const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs";

/// What is wrong with some of them in LinuxCNC 2.9.0 and 2.9.4: the end of the path, and what is found.
const FAULTY: [(&str, &str); 6] = [
    (
        "qtdragon/qtdragon_xyyz.ini",
        "the HAL file simulated-xyyz-home.hal is not there",
    ),
    (
        "qtdragon_multi_joint/qtdragon_xyyz.ini",
        "the HAL file simulated-xyyz-home.hal is not there",
    ),
    ("dallur-thc/dallur-advanced.ini", " already"),
    // its SUBROUTINE_PATH has three points where a folder should be
    (
        "woodpecker/woodpecker_auto_tool_probe.ini",
        "qt_auto_probe_tool.ngc is in no folder",
    ),
    // of panels, not of machines
    ("panelui-demo/_panelui.ini", "no INI file of LinuxCNC"),
    ("craftsman/cnc_settings.ini", "no INI file of LinuxCNC"),
];

#[test]
fn ours_are_clean() {
    let bench = Bench::new();
    for name in SAMPLES {
        assert_eq!(bench.findings(name), Vec::<Value>::new(), "{name}");
    }
}

fn configurations(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() && !path.is_symlink() {
            configurations(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "ini") {
            found.push(path);
        }
    }
}

#[test]
fn those_of_linuxcnc_have_no_false_errors() {
    let mut all = Vec::new();
    configurations(Path::new(STOCK), &mut all);
    assert!(all.len() > 200, "{} in {STOCK}", all.len());
    for file in all {
        let name = file.display().to_string();
        let output = framepath(Path::new("/"), &["check", &name, "--json"]);
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let errors = report["findings"].as_array().expect("findings").iter();
        for error in errors.filter(|finding| finding["level"] == "error") {
            let found = error["found"].as_str().expect("a text");
            let known = FAULTY
                .iter()
                .any(|(end, words)| name.ends_with(end) && found.contains(words));
            assert!(known, "{name}: {error}");
        }
    }
}
