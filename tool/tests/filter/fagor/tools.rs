//! Tools, and the rows of the tool table that their lengths and radii come from.

use super::{errors, translate};

/// The lines in which compensation begins.
fn compensations(program: &str) -> Vec<String> {
    let lines = translate(program, &[]);
    let begins = |line: &String| line.starts_with("G41") || line.starts_with("G42");
    lines.into_iter().filter(begins).collect()
}

#[test]
fn the_offset_beside_the_compensation_is_selected_before_it() {
    for (offset, written) in [("D1", "G41 G1 X5 Y0"), ("D4", "G41 D4 G1 X5 Y0")] {
        let program = format!(
            "T1 D1 M6\nG43\nG90 G0 X0 Y0 Z0\nG1 G41 X5 Y0 {offset} F100\nX9\nG40 X0\nM30\n"
        );
        let lines = translate(&program, &["--backend", "program"]);
        assert!(
            lines.iter().any(|line| line.starts_with(written)),
            "{lines:?}"
        );
    }
}

#[test]
fn a_tool_without_a_word_about_its_length_is_said() {
    let said = translate("T1 M6\nG0 Z5\nM30\n", &[]);
    assert!(said[0].contains("neither G43 nor G44"));
    let silent = translate("T1 M6\nG43\nG0 Z5\nM30\n", &[]);
    assert_eq!(silent[0], "T1 M6");
}

/// LinuxCNC takes D0 for the tool that it has; a diameter of 0 is no radius.
#[test]
fn d0_is_no_radius() {
    let path = "G90 G0 X0 Y0 Z50\nD0\nG41 G1 X10 Y10 F100\nX20\nG40 X30\n";
    for (head, back, after) in [
        ("T5 M6\nG43\n", "D5", "G41 G1 X50 Y10"),
        ("T5 M6\n", "D7", "G41 D7 G1 X50 Y10"),
        ("", "T6.8 M6", "G41 D8 G1 X50 Y10"),
    ] {
        let program = format!("{head}{path}{back}\nG41 X50 Y10\nX55\nG40 X60\nM30\n");
        let begun = compensations(&program);
        assert_eq!(begun, ["G41.1 D0 G1 X10 Y10 F100", after], "{program}");
    }
}

#[test]
fn a_radius_is_that_of_the_row_whatever_the_length_is() {
    let path = "G90 G0 X0 Y0 Z50\nG42 G1 X10 Y10 F100\nY20\nG40 X30\nM30\n";
    for (tool, begin) in [
        ("T5 D5", "G42 D5 G1 X10 Y10 F100"),
        ("T5 D7 M6", "G42 D7 G1 X10 Y10 F100"),
        ("T5 D5 M6", "G42 G1 X10 Y10 F100"),
        ("T5 M6\nD7\nD5", "G42 G1 X10 Y10 F100"),
    ] {
        assert_eq!(compensations(&format!("{tool}\n{path}")), [begin], "{tool}");
    }
    let beside = "G90 G0 X0 Y0\nG41 T1 D3 G1 X5 Y1 F100\nX9\nG40 X0\nM30\n";
    assert_eq!(compensations(beside), ["G41 D3 G1 X5 Y1 F100"]);
    let shown = errors("T5 M6\nG0 X0 Y0\nG41 G1 X5 Y1 F100\nD7\nM30\n", &[]);
    assert!(shown.contains("the tool offset changes while"), "{shown}");
}

#[test]
fn a_tool_that_is_never_changed_to_is_told() {
    let told = |change: &str, uses: &str| {
        let program = format!("T7 D7 {change}\n{uses}\nG90 G0 X0 Y0 Z0\nM30\n");
        let lines = translate(&program, &[]);
        let tells = |line: &&String| line.contains("T7 is selected and not changed to");
        lines.iter().filter(tells).count()
    };
    let radius = "G90 G0 X0 Y0\nG41 G1 X5 Y1 F100\nX9\nG40 X0";
    assert_eq!((told("", "G43"), told("M06", "G43")), (1, 0));
    assert_eq!((told("", radius), told("M06", radius)), (1, 0));
    assert_eq!(told("", &format!("G43\n{radius}")), 1);
}

/// What T has selected is not what is in the spindle, until M06.
#[test]
fn an_offset_counts_for_the_tool_in_the_spindle() {
    let program = "T4.9 M6\nG43\nG90 G0 X0 Y0 Z50\nT5\nG41 G1 X10 Y10 F100\nG40 X20\nD5\n\
                   G41 X30 Y9\nG40 X20\nM6\nD4\nT6.4\nD6\nM6\nM30\n";
    assert_eq!(
        translate(program, &[]),
        [
            "T4 M6",
            "G43 H9",
            "G0 X0 Y0 Z50",
            "T5",
            "G41 D9 G1 X10 Y10 F100",
            "G40 G1 X20",
            "G43 H5",
            "G41 D5 G1 X30 Y9",
            "G40 G1 X20",
            "M6 G43",
            "G43 H4",
            "T6",
            "G43 H6",
            "M6 G43",
            "M30"
        ]
    );
}
