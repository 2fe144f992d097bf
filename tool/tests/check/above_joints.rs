//! What `check` says of limits of axes above those of their joints, `configure` has said before.

use crate::bench::framepath;
use std::fs;
use std::path::Path;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

#[test]
fn configure_warns_of_axes_above_their_joints() {
    let folder = tempfile::tempdir().expect("a folder");
    // LinuxCNC 2.9.4 has one of its HAL files beside it.
    for entry in fs::read_dir(STOCK).expect("a folder") {
        let file = entry.expect("an entry").path();
        if file.extension().is_some_and(|ending| ending == "hal") {
            let name = file.file_name().expect("a name");
            fs::copy(&file, folder.path().join(name)).expect("copied");
        }
    }
    let stock = Path::new(STOCK).join("axis_mm.ini");
    let ini = fs::read_to_string(stock).expect("a text");
    let y = "[AXIS_Y]\nMAX_VELOCITY = 30.48\nMAX_ACCELERATION = ";
    let above = ini.replacen(&format!("{y}508"), &format!("{y}600"), 1);
    fs::write(folder.path().join("mill.ini"), &above).expect("written");
    let output = framepath(folder.path(), &["configure", "mill.ini"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{told}");
    let line = 1 + above
        .lines()
        .position(|line| line == "MAX_ACCELERATION = 600")
        .expect("a line");
    let words = "[AXIS_Y]MAX_ACCELERATION = 600 asks more of the joint than [JOINT_1]MAX_ACCELERATION = 508";
    assert_eq!(
        told,
        format!("warning: mill.ini:{line}:1: {words}: write MAX_ACCELERATION = 508\n")
    );
    let output = framepath(folder.path(), &["check", "mill-framepath.ini"]);
    let checked = String::from_utf8(output.stdout).expect("text");
    assert!(
        checked.contains(&format!("warning: {words}\n")),
        "{checked}"
    );
    fs::write(folder.path().join("mill.ini"), &ini).expect("written");
    let output = framepath(folder.path(), &["configure", "mill.ini", "--force"]);
    assert!(output.status.success() && output.stderr.is_empty());
}
