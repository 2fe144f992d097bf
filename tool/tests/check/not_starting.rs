//! What LinuxCNC does not start with, and what it takes.

use crate::bench::{Bench, framepath};
use serde_json::Value;

/// The levels and words of what is found in a changed sample.
fn found(from: &str, to: &str) -> Vec<(String, String)> {
    let bench = Bench::new();
    let folder = bench.sample("framepath-sim");
    let file = folder.join("framepath-sim.ini");
    let before = std::fs::read_to_string(&file).expect("a text");
    let after = before.replacen(from, to, 1);
    assert_ne!(before, after, "{from} is not there");
    std::fs::write(&file, after).expect("written");
    let output = framepath(&folder, &["check", "framepath-sim.ini", "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let text = |value: &Value| value.as_str().expect("a text").to_owned();
    let findings = report["findings"].as_array().expect("a list").iter();
    findings
        .map(|finding| (text(&finding["level"]), text(&finding["found"])))
        .collect()
}

#[test]
fn what_is_no_number_or_no_parameter_is_an_error() {
    for (from, to, words) in [
        (
            "SERVO_PERIOD = 1000000",
            "SERVO_PERIOD = text",
            "[EMCMOT]SERVO_PERIOD = text",
        ),
        (
            "JOINTS = 3",
            "JOINTS = text",
            "[KINS]JOINTS = text is no whole number",
        ),
        (
            "JOINTS = 3",
            "JOINTS = 3.5",
            "[KINS]JOINTS = 3.5 is no whole number",
        ),
        (
            "coordinates=XYZ",
            "coordinates=XYZ colour=red",
            "it has no parameter colour=",
        ),
        (
            "[TRAJ]",
            "[TRAJ]\nMAX_LINEAR_VELOCITY = text",
            "MAX_LINEAR_VELOCITY = text is no number",
        ),
        (
            "SERVO_PERIOD = 1000000",
            "SERVO_PERIOD = 1000000 # ns",
            "[EMCMOT]SERVO_PERIOD = 1000000 # ns is no whole number",
        ),
        (
            "JOINTS = 3",
            "JOINTS = 3 # axes",
            "[KINS]JOINTS = 3 # axes is no whole number",
        ),
        (
            "MAX_VELOCITY = 100",
            "MAX_VELOCITY = 50,5",
            "[AXIS_X]MAX_VELOCITY = 50,5 is no number",
        ),
        (
            "MAX_VELOCITY = 100",
            "MAX_VELOCITY = 1e400",
            "[AXIS_X]MAX_VELOCITY = 1e400 is no number",
        ),
        (
            "MAX_VELOCITY = 100",
            "MAX_VELOCITY = 50 # mm/s",
            "[AXIS_X]MAX_VELOCITY = 50 # mm/s is no number",
        ),
        (
            "MAX_JERK = 20000",
            "MAX_JERK = 20000 # much",
            "[AXIS_X]MAX_JERK = 20000 # much is no number",
        ),
        (
            "[JOINT_0]",
            "[JOINT_0]\nFERROR = 1 # mm",
            "[JOINT_0]FERROR = 1 # mm is no number",
        ),
        (
            "[JOINT_0]",
            "[JOINT_0]\nHOME_SEQUENCE = 1.0",
            "[JOINT_0]HOME_SEQUENCE = 1.0 is no whole number",
        ),
        (
            "TPMOD = blendtp",
            "TPMOD = blendtp foo=1",
            "blendtp has no parameter foo=1",
        ),
        (
            "TASK = milltask",
            "",
            "LinuxCNC does not start without [TASK]TASK",
        ),
        (
            "\nDISPLAY = ",
            "\nSCREEN = ",
            "LinuxCNC does not start without [DISPLAY]DISPLAY",
        ),
        (
            "LINEAR_UNITS = mm",
            "LINEAR_UNITS =",
            "LinuxCNC does not start without [TRAJ]LINEAR_UNITS",
        ),
        (
            "ANGULAR_UNITS = degree",
            "",
            "LinuxCNC does not start without [TRAJ]ANGULAR_UNITS",
        ),
        (
            "ANGULAR_UNITS = degree",
            "ANGULAR_UNITS =\rdegree",
            "LinuxCNC refuses the file: a carriage return stands",
        ),
        (
            "framepath filter",
            "framepath filter --tool A=1 --tool a=2",
            "--tool A= is given twice",
        ),
        (
            "ngc=frame_tool_change",
            "ngc=frame_tool_changed",
            "frame_tool_changed.ngc is in no folder",
        ),
    ] {
        let found = found(from, to);
        let error = |(level, said): &(String, String)| level == "error" && said.contains(words);
        assert!(found.iter().any(error), "{to}: {found:?}");
    }
}

#[test]
fn angles_of_another_unit_than_the_degree_are_an_error() {
    for (units, is_error) in [("radian", true), ("gon", true), ("deg", false)] {
        let found = found(
            "ANGULAR_UNITS = degree",
            &format!("ANGULAR_UNITS = {units}"),
        );
        let words = format!("[TRAJ]ANGULAR_UNITS = {units}: angles are in degrees");
        let error = |(level, said): &(String, String)| level == "error" && said.contains(&words);
        assert_eq!(found.iter().any(error), is_error, "{found:?}");
    }
}

#[test]
fn endings_are_translated_in_capitals_and_without() {
    let words = "nothing translates programs with the ending .";
    for (line, ending) in [
        ("\nMPF = framepath filter --dialect sinumerik", "MPF,"),
        ("\nspf = framepath filter --dialect sinumerik", "spf,"),
    ] {
        let found = found(line, "");
        let told = |(level, said): &(String, String)| {
            level == "warning" && said.contains(&format!("{words}{ending}"))
        };
        assert!(found.iter().any(told), "{found:?}");
    }
    let found = found("# LinuxCNC looks for an ending", "# It looks for an ending");
    assert!(
        !found.iter().any(|(_, said)| said.contains(words)),
        "{found:?}"
    );
}

#[test]
fn lengths_of_another_unit_than_millimetre_and_inch_are_told() {
    for (units, level) in [
        ("0.001", Some("warning")),
        ("1", None),
        ("metric", None),
        ("cm", Some("error")),
        ("1/25.4", Some("error")),
    ] {
        let found = found("LINEAR_UNITS = mm", &format!("LINEAR_UNITS = {units}"));
        let told = found
            .iter()
            .find(|(_, said)| said.contains("LINEAR_UNITS"))
            .map(|(level, _)| level.as_str());
        assert_eq!(told, level, "{units}: {found:?}");
    }
}

#[test]
fn comments_behind_texts_are_errors() {
    for (key, value) in [
        ("VERSION", "1.1"),
        ("LINEAR_UNITS", "mm"),
        ("COORDINATES", ""),
        ("SUBROUTINE_PATH", ""),
        ("PARAMETER_FILE", ""),
        ("TOOL_TABLE", ""),
        ("ON_ABORT_COMMAND", "o<frame_abort> call"),
    ] {
        let found = found_at(key, " # c");
        let words = "reads the comment as a part of the value: [";
        let told = |(level, said): &(String, String)| {
            level == "error"
                && said.contains(words)
                && said.contains(&format!("]{key} = {value}"))
                && said.ends_with(" # c")
        };
        assert!(found.iter().any(told), "{key}: {found:?}");
    }
    // G code may have one; a title and others may have the mark
    for (key, behind) in [
        ("ON_ABORT_COMMAND", " ; c"),
        ("MACHINE", " #2"),
        ("CYCLE_TIME", " # s"),
    ] {
        let found = found_at(key, behind);
        assert!(
            !found.iter().any(|(level, _)| level == "error"),
            "{key}: {found:?}"
        );
    }
}

/// What is found with this behind the value of a key.
fn found_at(key: &str, behind: &str) -> Vec<(String, String)> {
    let bench = Bench::new();
    let ini = bench.read("framepath-sim", "ini");
    let line = ini
        .lines()
        .find(|line| line.starts_with(&format!("{key} =")));
    let line = line.unwrap_or_else(|| panic!("{key} is not there"));
    found(&format!("{line}\n"), &format!("{line}{behind}\n"))
}

#[test]
fn infinite_limits_are_no_errors() {
    for limit in [
        "MAX_VELOCITY = 100",
        "MAX_ACCELERATION = 1000",
        "MAX_JERK = 20000",
    ] {
        let (key, _) = limit.split_once(" = ").expect("a key");
        let found = found(limit, &format!("{key} = inf"));
        let error = found.iter().find(|(level, _)| level == "error");
        assert_eq!(error, None, "{key}");
    }
}

#[test]
fn what_is_no_ini_file_is_an_error() {
    let utf_16: Vec<u8> = "\u{feff}[EMC]\nVERSION = 1.1\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    for bytes in [
        Vec::new(),
        vec![0x7f, b'E', b'L', b'F', 0, 1, 2, 255],
        utf_16,
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("mill.ini"), bytes).expect("written");
        let output = framepath(folder.path(), &["check", "mill.ini"]);
        let said = String::from_utf8(output.stdout).expect("text");
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("this is no INI file of LinuxCNC"), "{said}");
    }
}

#[test]
fn a_screen_that_ends_with_framekins_is_an_error() {
    for screen in ["touchy", "gscreen"] {
        let found = found("DISPLAY = axis", &format!("DISPLAY = {screen}"));
        let words = format!("{screen} ends at its start with framekins");
        assert!(
            found
                .iter()
                .any(|(level, found)| level == "error" && found.contains(&words)),
            "{found:?}"
        );
    }
}
