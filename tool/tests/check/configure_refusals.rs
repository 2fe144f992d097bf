//! What `configure` does not write, since nothing would move with it or LinuxCNC would not find it.

use crate::bench::{framepath, samples};
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// LinuxCNC's axis_mm under this name.
fn stock(name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (file, copy) in [
        ("axis_mm.ini", name),
        ("sim_mm.tbl", "sim_mm.tbl"),
        ("cooling.hal", "cooling.hal"),
    ] {
        let file = Path::new(STOCK).join(file);
        // LinuxCNC 2.9.0 has no such HAL file, and names none
        if copy != "cooling.hal" || file.exists() {
            fs::copy(file, folder.path().join(copy)).expect("copied");
        }
    }
    folder
}

/// What is said, where nothing is written.
fn refused(folder: &Path, output: &Output) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    let mut entries = fs::read_dir(folder).expect("a folder");
    let written = |name: &str| name.contains("-framepath.") || name.starts_with(".framepath");
    assert!(!entries.any(|entry| written(&entry.expect("an entry").file_name().to_string_lossy())));
    said
}

#[test]
fn a_jerk_with_which_nothing_moves() {
    let folder = stock("mill.ini");
    let output = framepath(folder.path(), &["configure", "mill.ini", "--jerk", "1"]);
    let said = refused(folder.path(), &output);
    assert!(
        said.contains("--jerk 1 lets nothing move") && said.contains("at least"),
        "{said}"
    );
    let ini = folder.path().join("mill.ini");
    let text = fs::read_to_string(&ini).expect("a text");
    fs::write(&ini, text.replace("[AXIS_X]", "[AXIS_X]\nMAX_JERK = 1")).expect("written");
    let output = framepath(folder.path(), &["configure", "mill.ini"]);
    let said = refused(folder.path(), &output);
    assert!(
        said.contains("[AXIS_X]MAX_JERK = 1 lets nothing move"),
        "{said}"
    );
}

#[test]
fn limits_with_which_linuxcnc_does_not_start() {
    let folder = stock("mill.ini");
    let ini = folder.path().join("mill.ini");
    let text = fs::read_to_string(&ini).expect("a text");
    let (before, axis) = text.split_once("[AXIS_X]").expect("an axis");
    let changed = format!("{before}[AXIS_X]\nMAX_ACCELERATION = 508 # mm{axis}");
    fs::write(&ini, changed).expect("written");
    let output = framepath(folder.path(), &["configure", "mill.ini"]);
    let said = refused(folder.path(), &output);
    assert!(
        said.contains("error: [AXIS_X]MAX_ACCELERATION = 508 # mm is no number above 0"),
        "{said}"
    );
    let changed = format!("{before}[AXIS_X]\nMAX_JERK = 20000 # c{axis}");
    fs::write(&ini, changed).expect("written");
    let output = framepath(folder.path(), &["configure", "mill.ini"]);
    let said = refused(folder.path(), &output);
    assert!(
        said.contains("[AXIS_X]MAX_JERK = 20000 # c is no number"),
        "{said}"
    );
}

#[test]
fn units_that_linuxcnc_or_blendtp_does_not_know() {
    let folder = stock("mill.ini");
    let ini = folder.path().join("mill.ini");
    let text = fs::read_to_string(&ini).expect("a text");
    for (line, found, help) in [
        (
            "ANGULAR_UNITS = radian",
            "[TRAJ]ANGULAR_UNITS = radian: angles are in degrees",
            "ANGULAR_UNITS = degree",
        ),
        (
            "NO_UNITS =",
            "[TRAJ]ANGULAR_UNITS is missing",
            "ANGULAR_UNITS = degree",
        ),
        (
            "LINEAR_UNITS = cm",
            "[TRAJ]LINEAR_UNITS = cm: mm or inch",
            "LINEAR_UNITS = mm, or inch",
        ),
        (
            "LINEAR_UNITS = .5",
            "[TRAJ]LINEAR_UNITS = .5: mm or inch",
            "LINEAR_UNITS = mm, or inch",
        ),
        (
            "LINEAR_UNITS =",
            "[TRAJ]LINEAR_UNITS is missing",
            "LINEAR_UNITS = mm, or inch",
        ),
    ] {
        let key = match help.starts_with("LINEAR") {
            true => "LINEAR_UNITS = mm",
            false => "ANGULAR_UNITS = degree",
        };
        assert!(text.contains(key), "{text}");
        fs::write(&ini, text.replace(key, line)).expect("written");
        let output = framepath(folder.path(), &["configure", "mill.ini"]);
        let said = refused(folder.path(), &output);
        assert!(said.contains(found) && said.contains(help), "{said}");
    }
}

#[test]
fn screens_that_end_with_framekins() {
    let folder = stock("mill.ini");
    let ini = folder.path().join("mill.ini");
    let text = fs::read_to_string(&ini).expect("a text");
    for (line, screen) in [
        ("DISPLAY = touchy", "touchy"),
        ("DISPLAY = /usr/bin/gscreen -c industrial", "gscreen"),
    ] {
        let changed = text.replace("DISPLAY = axis", line);
        fs::write(&ini, changed).expect("written");
        let subroutines = samples().join("subroutines").display().to_string();
        let options = [
            "configure",
            "mill.ini",
            "--frames",
            "--subroutines",
            &subroutines,
        ];
        let output = framepath(folder.path(), &options);
        let said = refused(folder.path(), &output);
        assert!(
            said.contains(&format!(
                ":1: error: {screen} ends at its start with framekins"
            )) && said.contains("DISPLAY = axis, gmoccapy or qtvcp"),
            "{said}"
        );
        let output = framepath(folder.path(), &options[..2]);
        assert!(output.status.success(), "blendtp alone takes {screen}");
        for written in ["mill-framepath.ini", "mill-framepath.hal"] {
            fs::remove_file(folder.path().join(written)).expect("removed");
        }
    }
}

#[test]
fn a_name_with_a_blank() {
    let folder = stock("a b.ini");
    let output = framepath(folder.path(), &["configure", "a b.ini"]);
    let said = refused(folder.path(), &output);
    assert!(
        said.contains("has a blank") && said.contains("call the file a-b.ini"),
        "{said}"
    );
}

#[test]
fn changes_that_cannot_be_told() {
    let folder = stock("mill.ini");
    let full = File::options()
        .write(true)
        .open("/dev/full")
        .expect("a device");
    let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .args(["configure", "mill.ini"])
        .current_dir(folder.path())
        .stdout(full)
        .stderr(Stdio::piped())
        .output()
        .expect("framepath runs");
    let said = refused(folder.path(), &output);
    assert!(
        said.starts_with("standard output: error: ") && said.contains("nothing is changed"),
        "{said}"
    );
}

#[test]
fn a_file_that_the_configuration_reads() {
    let folder = stock("mill.ini");
    let ini = folder.path().join("mill.ini");
    std::os::unix::fs::symlink(&ini, folder.path().join("mill-framepath.hal")).expect("a link");
    let before = fs::read(&ini).expect("a file");
    let output = framepath(folder.path(), &["configure", "mill.ini", "--force"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("the configuration itself reads this file"),
        "{said}"
    );
    assert_eq!(fs::read(&ini).expect("a file"), before);
}
