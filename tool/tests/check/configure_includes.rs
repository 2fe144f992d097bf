//! INI files that include others: where lines of these change, they are written into the new file, and stay as they are.

use crate::bench::framepath;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// LinuxCNC's axis_mm, cut in two before this section; its rest is that of the file `machine.inc` in the same folder.
fn cut(section: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["sim_mm.tbl", "cooling.hal"] {
        let file = Path::new(STOCK).join(name);
        // LinuxCNC 2.9.0 has no such HAL file, and names none
        if file.exists() {
            fs::copy(file, folder.path().join(name)).expect("copied");
        }
    }
    let text = fs::read_to_string(Path::new(STOCK).join("axis_mm.ini")).expect("a text");
    let (before, behind) = text.split_once(section).expect("there");
    let included = format!("{section}{behind}");
    fs::write(folder.path().join("machine.inc"), included).expect("written");
    (folder, before.to_owned())
}

/// What configure says of this INI file, and the file that it writes.
fn configured(folder: &Path, ini: &str) -> (Output, String) {
    fs::write(folder.join("mill.ini"), ini).expect("written");
    let output = framepath(folder, &["configure", "mill.ini"]);
    let new = fs::read_to_string(folder.join("mill-framepath.ini"));
    (output, new.unwrap_or_default())
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What `check` finds in the new configuration.
fn findings(folder: &Path) -> Value {
    let output = framepath(folder, &["check", "mill-framepath.ini", "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report["findings"].clone()
}

#[test]
fn files_whose_lines_change_are_written_into_the_new_one() {
    let (folder, before) = cut("[AXIS_X]");
    let file = folder.path().join("machine.inc");
    // LinuxCNC takes this line for a comment where it is, and would include the file from the new INI file.
    let included = format!(
        "{}#INCLUDE other.inc\n",
        fs::read_to_string(&file).expect("a text")
    );
    fs::write(&file, &included).expect("written");
    fs::write(
        folder.path().join("other.inc"),
        "[AXIS_X]\nMAX_VELOCITY = 1\n",
    )
    .expect("written");
    let ini = format!("{before}#INCLUDE machine.inc\n#INCLUDE nowhere.inc\n");
    let (output, new) = configured(folder.path(), &ini);
    assert!(output.status.success(), "{}", said(&output));
    let warning = "#INCLUDE nowhere.inc: nowhere.inc cannot be read";
    assert!(said(&output).contains(warning), "{}", said(&output));
    assert_eq!(fs::read_to_string(&file).expect("a text"), included);
    assert!(
        !new.lines().any(|line| line.starts_with("#INCLUDE")),
        "{new}"
    );
    assert!(
        new.contains("#*** End   #INCLUDE file: machine.inc\n"),
        "{new}"
    );
    assert_eq!(new.matches("\nMAX_JERK = 10160\n").count(), 3, "{new}");
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
}

#[test]
fn a_file_that_several_sections_include_gets_the_lines_of_each() {
    let (folder, before) = cut("[AXIS_X]");
    let rest = fs::read_to_string(folder.path().join("machine.inc")).expect("a text");
    let limits =
        "MAX_VELOCITY = 30.48\nMAX_ACCELERATION = 508\nMIN_LIMIT = -254\nMAX_LIMIT = 254\n";
    fs::write(folder.path().join("limits.inc"), limits).expect("written");
    let rest = rest.replacen(limits, "#INCLUDE limits.inc\n", 2);
    let (output, new) = configured(folder.path(), &format!("{before}{rest}"));
    assert!(output.status.success(), "{}", said(&output));
    for axis in ["X", "Y", "Z"] {
        let (_, section) = new.split_once(&format!("[AXIS_{axis}]\n")).expect("there");
        let section = section.split("\n[").next().unwrap_or("");
        assert_eq!(
            section.matches("MAX_JERK = 10160").count(),
            1,
            "{axis}: {new}"
        );
    }
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
}

#[test]
fn a_file_whose_lines_stay_is_included_still() {
    let (folder, before) = cut("[JOINT_0]");
    let (output, new) = configured(folder.path(), &format!("{before}#INCLUDE machine.inc\n"));
    assert!(output.status.success(), "{}", said(&output));
    assert!(new.contains("\n#INCLUDE machine.inc\n"), "{new}");
    assert!(!new.contains("[JOINT_0]"), "{new}");
}

#[test]
fn a_file_that_the_shell_has_to_find_is_refused_where_lines_change() {
    let (folder, before) = cut("[AXIS_X]");
    let ini = format!("{before}#INCLUDE machine.inc\n#INCLUDE $(ls *.inc)\n");
    let (output, new) = configured(folder.path(), &ini);
    assert_eq!(output.status.code(), Some(1));
    let line = ini.lines().count();
    let refusal = format!("mill.ini:{line}: error: #INCLUDE $(ls *.inc): ");
    assert!(said(&output).contains(&refusal), "{}", said(&output));
    assert!(new.is_empty());
}

#[test]
fn a_line_of_an_included_file_that_goes_on_is_refused_by_its_place() {
    let (folder, before) = cut("[EMC]");
    let file = folder.path().join("machine.inc");
    let text = fs::read_to_string(&file).expect("a text");
    let text = text.replacen("\nLINEAR_UNITS", "\nTPMOD = \\\n  tpmod\nLINEAR_UNITS", 1);
    fs::write(&file, &text).expect("written");
    let line = text.lines().position(|line| line.starts_with("TPMOD"));
    let (output, _) = configured(folder.path(), &format!("{before}#INCLUDE machine.inc\n"));
    assert_eq!(output.status.code(), Some(1));
    let line = line.expect("there") + 1;
    let refusal = format!("machine.inc:{line}:1: error: TPMOD goes on in the next line");
    assert!(said(&output).contains(&refusal), "{}", said(&output));
}
