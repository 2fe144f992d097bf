//! Limits of jerk that `configure` writes where an axis has no acceleration, or no section at all.

use crate::bench::framepath;
use std::fs;
use std::path::Path;
use std::process::Output;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// Configures a sample of LinuxCNC by itself: what is said, and the INI and HAL files that are written.
fn configured(sample: &str, options: &[&str]) -> (Output, String, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let source = Path::new(STOCK).join(sample);
    let beside = source.parent().expect("a folder");
    for entry in fs::read_dir(beside).expect("a folder") {
        let entry = entry.expect("an entry");
        if entry.path().is_file() {
            fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("copied");
        }
    }
    fs::copy(&source, folder.path().join("mill.ini")).expect("copied");
    let output = framepath(
        folder.path(),
        &[&["configure", "mill.ini"], options].concat(),
    );
    let [ini, hal] = ["mill-framepath.ini", "mill-framepath.hal"]
        .map(|name| fs::read_to_string(folder.path().join(name)).unwrap_or_default());
    (output, ini, hal)
}

#[test]
fn an_axis_without_a_section_gets_its_limit_in_the_hal_file() {
    for (jerk, limit, is_warned) in [
        ("unlimited", 0, false),
        ("100", 100, false),
        ("20A", 20, true),
    ] {
        let (output, ini, hal) = configured("extrajoints/1extrajoint.ini", &["--jerk", jerk]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{jerk}: {said}");
        for axis in ["X", "Y", "Z"] {
            let warning = format!(
                "warning: mill.ini: [AXIS_{axis}]MAX_ACCELERATION is missing: LinuxCNC takes 1 in/s2 then, and so does this"
            );
            assert_eq!(said.contains(&warning), is_warned, "{jerk}: {said}");
            let axis = axis.to_lowercase();
            let line = format!("setp blendtp.axis.{axis}.max-jerk {limit}\n");
            assert!(hal.contains(&line), "{hal}");
        }
        // LinuxCNC would check such a section against the limits of the joint.
        assert!(!ini.contains("[AXIS_"), "{ini}");
    }
}

#[test]
fn an_axis_without_an_acceleration_has_that_of_linuxcnc() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = fs::read_to_string(Path::new(STOCK).join("axis_mm.ini")).expect("a text");
    let (before, axes) = text.split_once("[AXIS_X]").expect("there");
    let axes = axes.replacen("MAX_ACCELERATION = 508", "", 1);
    let ini = folder.path().join("mill.ini");
    fs::write(&ini, format!("{before}[AXIS_X]{axes}")).expect("written");
    for name in ["sim_mm.tbl", "cooling.hal"] {
        let file = Path::new(STOCK).join(name);
        if file.exists() {
            fs::copy(file, folder.path().join(name)).expect("copied");
        }
    }
    let output = framepath(folder.path(), &["configure", "mill.ini"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains("[AXIS_X]MAX_ACCELERATION is missing: LinuxCNC takes 1 mm/s2 then"),
        "{said}"
    );
    let new = fs::read_to_string(folder.path().join("mill-framepath.ini")).expect("a text");
    assert!(new.contains("\nMAX_JERK = 20\n"), "{new}");
    assert!(new.contains("\nMAX_JERK = 10160\n"), "{new}");
    let options = ["configure", "mill.ini", "--force", "--jerk", "unlimited"];
    let output = framepath(folder.path(), &options);
    assert!(output.status.success());
    assert!(!String::from_utf8_lossy(&output.stderr).contains("takes 1"));
}
