//! What an increment counts from when the frame, an offset or the tool has changed.

use crate::shop::{Shop, commands, refused, translate};

/// The commands of a program that begins at X6 Y0 Z5, and whether a warning speaks of an increment.
fn written(blocks: &str, arguments: &[&str]) -> (Vec<String>, bool) {
    let program = format!("G54 G90 G71 F500\nT1 M6 D1\nG0 X6 Y0 Z5\n{blocks}\nM30\n");
    let output = translate(&program, &[&["--backend", "program"], arguments].concat());
    let warns = output.contains("increment in");
    let lines = commands(&output).into_iter();
    let lines = lines.filter(|line| !line.contains("(MSG,")).collect();
    (lines, warns)
}

#[test]
fn increments_after_a_change_of_frame_follow_the_setting() {
    let program = "G0 X10 Y0 Z0\nTRANS X5\nG91 G0 X1\nG0 X1\nM30\n";
    let programmed = translate(program, &["--backend", "kinematics"]);
    assert_eq!(
        commands(&programmed)[4..6],
        ["G0 X11 Y0 Z0".to_string(), "G0 X12".to_string()]
    );
    assert!(programmed.contains("(MSG, line 3: increment in X after a change of the frame"));
    let arguments = [
        "--backend",
        "kinematics",
        "--increment-after-frame",
        "position",
    ];
    let position = translate(program, &arguments);
    assert_eq!(
        commands(&position)[4..6],
        ["G0 X6 Y0 Z0".to_string(), "G0 X7".to_string()]
    );
}

#[test]
fn what_changes_behind_a_frame_does_not_take_its_change_away() {
    for between in [
        "",
        "G54",
        "G55",
        "G55\nG54",
        "D0\nD1",
        "T2 M6",
        "$P_UIFR[1]=CTRANS(X,10)\nG54",
    ] {
        let (lines, warns) = written(&format!("TRANS X100\n{between}\nG91 X1"), &[]);
        assert!(
            lines.contains(&"G0 X107".to_string()),
            "{between}\n{lines:?}"
        );
        assert!(warns, "{between}");
    }
}

#[test]
fn changes_of_offset_and_tool_follow_the_setting() {
    for (blocks, programmed, position) in [
        ("G55\nG91 X1", "G0 X7", "G0 X[#5420+1]"),
        ("T2 M6\nD1\nG91 Z-2", "G0 Z3", "G0 Z[#5422-2]"),
        ("D0\nZ=IC(1)", "G0 Z6", "G0 Z[#5422+1]"),
        ("G500\nG0 Z100\nG54\nG91 X1", "G0 X7", "G0 X[#5420+1]"),
        ("A5\nG55\nG91 A10", "G0 A15", "G0 A[#5423+10]"),
    ] {
        for (expected, way) in [(programmed, "programmed"), (position, "position")] {
            let (lines, warns) = written(blocks, &["--increment-after-frame", way]);
            assert!(lines.contains(&expected.to_string()), "{blocks}\n{lines:?}");
            assert!(warns, "{blocks}");
        }
    }
    // Nothing changes with the offset that acts already, and nothing is known of what has moved by itself.
    for (blocks, expected) in [
        ("G54\nG91 X1", "G0 X7"),
        ("G55\nG90 X8\nG91 X1", "G0 X9"),
        ("G0 SUPA Z0\nG91 X1", "G0 X7"),
        ("TRANS X1 Y1 Z1\nG0 X5 Y5 Z5\nSUPA Z0\nG91 X1", "G0 X7"),
        ("G0 SUPA Z0\nG91 Z1", "G0 Z[#5422+1]"),
    ] {
        let (lines, warns) = written(blocks, &[]);
        assert!(lines.contains(&expected.to_string()), "{blocks}\n{lines:?}");
        assert!(!warns, "{blocks}");
    }
}

#[test]
fn an_increment_from_an_unknown_place_in_another_frame_is_refused() {
    for between in ["G0 SUPA Z0", "G500\nG0 Z100\nG54"] {
        let program = format!("G54 G90\nG0 X6 Y0 Z5\nTRANS X100\n{between}\nG91 X1\nM30\n");
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains("where X was before is not known"), "{shown}");
    }
}
