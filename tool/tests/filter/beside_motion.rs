//! M functions beside a motion: what waits until it is over, and what is refused.

use crate::one_error::assert_one_error;
use crate::shop::{Shop, accepted, commands, refused};

fn lines(dialect: &str, program: &str) -> Vec<String> {
    let shop = Shop::new(&[("part.nc", program.as_bytes())]);
    let mut lines = commands(&accepted(&shop.run_in(dialect, "part.nc", &[])));
    lines.retain(|line| !line.starts_with("(MSG"));
    lines
}

#[test]
fn spindle_and_coolant_run_until_the_motion_is_over() {
    for (dialect, program, wanted) in [
        (
            "fanuc",
            "G1 X10. F100. M5\nM3 G1 X20. M5\nG1 X30. M8 M9\nG91 G28 Z0 M19\nM5 G4 P500\nG90 G1 X40. M5 M0\nG3 X50. R5. M9\n\
             G4 P500 M9",
            &[
                "G1 X10 F100",
                "M5",
                "G1 X20 M3",
                "M5",
                "G1 X30 M8",
                "M9",
                "G53 G0 Z0",
                "M19 R0",
                "M5",
                "G4 P0.5",
                "G1 X40",
                "M5 M0",
                "G3 X50 I5 J0",
                "M9",
                "M9",
                "G4 P0.5",
            ][..],
        ),
        // They take nothing from the corner, and nothing from the compensation.
        (
            "fanuc",
            "G1 X10. ,R2. F100. M5\nY10. ,C1. M19\nX20. M9\nG41 D1 X40. Y20.\nX60. M5\nY40.\nG40 X80. M9",
            &[
                "G1 X8 Y0 F100",
                "G3 X10 Y2 I0 J2",
                "M5",
                "G1 X10 Y9",
                "G1 X11 Y10",
                "M19 R0",
                "G1 X20 Y10",
                "M9",
                "G41 D1 G1 X40 Y20",
                "G1 X60",
                "M5",
                "G1 Y40",
                "G40 G1 X80",
                "M9",
            ],
        ),
        // M functions of a canned cycle act on the way to the first place, those behind it do not.
        (
            "fanuc",
            "G81 X10. Z-5. R2. F100. M9\nG80 X20. M9",
            &[
                "G0 X10 F100 M9",
                "G0 Z2",
                "G1 Z-5",
                "G0 Z50",
                "G0 X20",
                "M9",
            ],
        ),
        (
            "fagor",
            "G1 X10 F100 M5\nM3\nG1 X20 M9\nG53 Z0 M5\nM3\nG0 X0 Y0 Z5\nG33 Z-20 L1 M5\nG0 X5",
            &[
                "G1 X10 F100",
                "M5",
                "M3",
                "G1 X20",
                "M9",
                "G53 G1 Z0",
                "M5",
                "M3",
                "G0 X0 Y0 Z5",
                "G33 Z-20 K1",
                "M5",
                "G0 X5",
            ],
        ),
        (
            "isg",
            "G01 X10 F100 M05\nG01 X20 M09",
            &["G1 X10 F100", "M5", "G1 X20", "M9"],
        ),
        (
            "mefi",
            "G1 X10 F100 M5\nG1 X20 M9",
            &["G1 X10 F100", "M5", "G1 X20", "M9"],
        ),
        // This control stops the spindle before.
        (
            "sinumerik",
            "G1 X10 F100 M5\nG1 X20 M9\nSUPA G0 Z0 D0 M19",
            &["G1 X10 F100 M5", "G1 X20", "M9", "G53 G0 Z0 G49", "M19 R0"],
        ),
    ] {
        let head = "G90 G54 G0 X0 Y0 Z50 S500 M3\n";
        let shown = lines(dialect, &format!("{head}{program}\nM30\n"));
        let behind: Vec<&String> = shown.iter().skip(1).collect();
        let wanted: Vec<&str> = wanted.iter().copied().chain(["M30"]).collect();
        assert_eq!(behind, wanted, "{dialect}: {program}");
    }
}

#[test]
fn tools_are_changed_behind_a_retraction() {
    for (dialect, program, wanted) in [
        (
            "fanuc",
            "G1 Z-5. F100.\nG91 G28 Z0 M6 T2 M3 M8\nG90 G53 Z0 M6 T3\nG0 X5.",
            &[
                "G1 Z-5 F100",
                "G53 G0 Z0 T2",
                "M6 M3 M8",
                "G53 G0 Z0 T3",
                "M6",
                "G0 X5",
            ][..],
        ),
        // The length in force before is that of the tool before.
        (
            "fagor",
            "T1 M6\nG43\nG0 X1\nG53 Z0 M6 T3\nG0 X5",
            &["T1 M6", "G43", "G0 X1", "G53 G0 Z0 T3", "M6 G43", "G0 X5"],
        ),
        (
            "sinumerik",
            "T2 M6\nSUPA G0 Z0 M6 T3\nG0 X5",
            &["T2 M6 G43", "G53 G0 Z[0+#5403] T3", "M6 G43", "G0 X5"],
        ),
        // Beside what is no motion nothing changes.
        ("isg", "T2 M06 M03 S100\nG04 2", &["S100 T2 M6 M3", "G4 P2"]),
    ] {
        let head = "G90 G54 G0 X0 Y0 Z50\n";
        let shown = lines(dialect, &format!("{head}{program}\nM30\n"));
        let behind: Vec<&String> = shown.iter().skip(1).collect();
        let wanted: Vec<&str> = wanted.iter().copied().chain(["M30"]).collect();
        assert_eq!(behind, wanted, "{dialect}: {program}");
    }
}

#[test]
fn tools_are_not_changed_beside_other_motions() {
    for (dialect, block, column, name) in [
        ("fanuc", "G0 Z100. M6 T4", 10, "a rapid motion"),
        ("fanuc", "T4 M6 G1 X5. F100.", 4, "a motion with feed"),
        (
            "fanuc",
            "G53 Z0 M6 T2 G43 H2",
            8,
            "a tool offset and a motion in machine coordinates",
        ),
        ("fagor", "G0 Z50 M6 T1", 8, "a rapid motion"),
        ("fagor", "G2 X10 Y0 I5 J0 F100 M6", 22, "an arc"),
        ("isg", "G00 Z50 M06", 9, "a rapid motion"),
        ("mefi", "G0 Z50 M6", 8, "a rapid motion"),
        ("sinumerik", "G0 Z50 T1 M6", 11, "a rapid motion"),
        (
            "sinumerik",
            "SUPA G0 Z0 D0 T1 M6",
            18,
            "a tool offset and a motion in machine coordinates",
        ),
    ] {
        let program = format!("G90 G54 G0 X0 Y0 Z50\n{block}\nM30\n");
        let shop = Shop::new(&[("part.nc", program.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part.nc", &[]));
        let words = format!("M6 beside {name}: which of them");
        assert_one_error(&shown, &program, &format!("part.nc:2:{column}"), &words);
        assert!(shown.contains("write two blocks"), "{shown}");
    }
}
