//! Canned cycles: what LinuxCNC does with them is what it does with its own.

use crate::one_error::assert_one_error;
use crate::path::assert_pair;
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// Behind this, both programs are at Z50 with S and F in force.
const BEFORE: &str = "G0 X0 Y0 Z50.\nS500 M3\nF100.\n";

fn pair(program: &str, linuxcnc: &str) {
    assert_pair(
        &format!("{BEFORE}{program}\nM30\n"),
        &format!("{BEFORE}{linuxcnc}\nM30\n"),
    );
}

#[test]
fn drilling_is_that_of_linuxcnc() {
    for (program, linuxcnc) in [
        (
            "G99 G81 X10. Y10. Z-5. R2.\nX20.\nG80 G0 X0",
            "G99 G81 X10 Y10 Z-5 R2\nX20\nG80\nG0 X0",
        ),
        (
            "G98 G82 X10. Z-5. R2. P500\nX20.\nG80",
            "G98 G82 X10 Z-5 R2 P.5\nX20\nG80",
        ),
        (
            "G99 G83 X10. Z-12. R1. Q5.\nG80",
            "G99 G83 X10 Z-12 R1 Q5\nG80",
        ),
        (
            "G99 G73 X10. Z-12. R1. Q5.\nG80",
            "G99 G73 X10 Z-12 R1 Q5\nG80",
        ),
        (
            "#1=500\nG98 G82 X10. Z-5. R2. P#1\nG80",
            "G98 G82 X10 Z-5 R2 P.5\nG80",
        ),
        ("G98 G85 X10. Z-12. R1.\nG80", "G98 G85 X10 Z-12 R1\nG80"),
        (
            "G98 G86 X10. Z-12. R1. P100\nG80",
            "G98 G86 X10 Z-12 R1 P.1\nG80",
        ),
        (
            "G99 G89 X10. Z-12. R1. P1000\nG80",
            "G99 G89 X10 Z-12 R1 P1\nG80",
        ),
        // Increments: R from the initial level, Z from R.
        (
            "G91 G99 G81 X5. Z-7. R-48. K3\nG80 G90",
            "G91 G99 G81 X5 Z-7 R-48 L3\nG80 G90",
        ),
        // Levels change, and hold from one cycle to the next.
        (
            "G99 G81 X10. Z-5. R2.\nX20. Z-7.\nG82 X30. P200\nG80",
            "G99 G81 X10 Z-5 R2\nX20 Z-7\nG82 X30 Z-7 R2 P.2\nG80",
        ),
        // K0 keeps the data; a block without a place does nothing.
        (
            "G99 G81 X10. Z-5. R2. K0\nG4 P500\nF50.\nX20.\nG80",
            "G4 P.5\nF50\nG99 G81 X20 Z-5 R2\nG80",
        ),
        (
            "G0 Y20.\nG18 G99 G81 X10. Z5. Y-5. R2.\nG80 G17",
            "G0 Y20\nG18 G99 G81 X10 Z5 Y-5 R2\nG80 G17",
        ),
        // A motion ends the cycle.
        (
            "G99 G81 X10. Z-5. R2.\nG0 X20.\nX30.",
            "G99 G81 X10 Z-5 R2\nG80\nG0 X20\nX30",
        ),
    ] {
        pair(program, linuxcnc);
    }
}

/// P of one cycle is that of those behind it only where they have a dwell.
#[test]
fn a_dwell_is_left_behind_by_cycles_that_have_none() {
    for (program, dwells) in [
        (
            "G99 G82 X1. Z-5. R2. P500\nG85 X5.\nG86 X6.\nG83 X7. Q4.\nG73 X8.",
            1,
        ),
        ("G99 G82 X1. Z-5. R2. P500\nX2.\nG89 X5.", 3),
        ("G99 G82 X1. Z-5. R2. P500\nG85 X5.\nG82 X6.", 2),
        ("G99 G86 X1. Z-5. R2. P500\nX2.\nG86 X3.\nG85 X4.", 3),
    ] {
        let program = format!("{BEFORE}{program}\nG80\nM30\n");
        let output = Shop::with(Dialect::Fanuc, &program).accepted(&[]);
        assert_eq!(output.matches("G4 P0.5").count(), dwells, "{output}");
    }
}

/// LinuxCNC's own cycles run with exact path whatever the mode: a hole reaches its bottom.
#[test]
fn holes_reach_their_bottom_in_cutting_mode() {
    pair(
        "G64\nG99 G81 X10. Z-5. R2.\nX20.\nG80\nG1 X0",
        "G61\nG99 G81 X10 Z-5 R2\nX20\nG80\nG64 P.01\nG1 X0",
    );
}

#[test]
fn taps_follow_the_spindle_behind_m29() {
    pair(
        "G0 Z2.\nM29 S500\nG99 G84 X10. Z-10. R2. F500.\nX20.\nG80",
        "G0 Z2\nX10\nS500 M3\nF500\nG33.1 Z-10 K1\nM5\nG0 X20\nM3\nG33.1 Z-10 K1\nM5",
    );
    pair(
        "M5\nG0 Z2.\nG95 M29 S500\nG99 G74 X10. Z-10. R2. F1.25\nG80",
        "M5\nG0 Z2\nX10\nM4\nG33.1 Z-10 K1.25\nM5",
    );
    pair(
        "G98 G84 X10. Z-10. R2. P500 F500.\nG80",
        "G0 X10\nZ2\nG1 Z-10 F500\nG4 P.5\nM4\nZ2\nM3\nG0 Z50",
    );
}

/// Where the program has switched the overrides off itself, a tap leaves them off.
#[test]
fn taps_keep_the_overrides_of_the_program() {
    let tap = "G84 X10. Z-10. R2. F500.\nG80";
    for (before, switches) in [
        ("", vec!["M49", "M48"]),
        ("M49\n", vec!["M49"]),
        ("M49\nM48\n", vec!["M49", "M48", "M49", "M48"]),
    ] {
        let program = format!("{BEFORE}{before}{tap}\nG0 X1.\nM30\n");
        let written = Shop::with(Dialect::Fanuc, &program).accepted(&[]);
        let words = written.lines().flat_map(str::split_whitespace);
        let found: Vec<&str> = words
            .filter(|word| matches!(*word, "M48" | "M49"))
            .collect();
        assert_eq!(found, switches, "{written}");
    }
}

#[test]
fn fine_boring_leaves_the_wall() {
    pair(
        "G98 G76 X10. Y0 Z-10. R2. I0.5 P100\nG80",
        "G0 X10\nZ2\nG1 Z-10\nG4 P.1\nM19 R0\nG0 X10.5\nZ50\nX10\nM3",
    );
}

/// Steps and lifts are not scaled, the levels are.
#[test]
fn cycles_run_in_frames() {
    pair(
        "G51 X0 Y0 Z0 P500\nG99 G83 X20. Y0 Z-24. R2. Q5.\nG80 G50",
        "F100\nG0 X10 Y0 Z50\nG99 G83 X10 Z-12 R1 Q5\nG80",
    );
    pair(
        "G68 X0 Y0 R90.\nG99 G81 X10. Y0 Z-5. R2.\nX20. Y5.\nG80 G69",
        "G99 G81 X0 Y10 Z-5 R2\nX-5 Y20\nG80",
    );
}

#[test]
fn nothing_counts_from_the_place_of_k0() {
    let head = "G90 G0 X0 Y0 Z50.\nS500 M3\nF100.\n";
    for (program, place, axis) in [
        ("G81 X10. Y10. Z-5. R2. K0\nX20.\nG80\nM30\n", "5:1", "Y"),
        (
            "G81 X10. Y10. Z-5. R2. K0\nG91 X10. K2\nG80\nM30\n",
            "5:1",
            "X",
        ),
        ("G81 X10. Z-5. R2. K0\nR3.\nG80\nM30\n", "5:1", "X"),
        ("G81 X10. Z-5. R2. K0\nG80\nG0 Z60.\nM30\n", "6:1", "X"),
        (
            "G81 X10. Y10. Z-5. R2. K0\nG80\nG2 X20. Y10. I5. J0\nM30\n",
            "6:1",
            "X",
        ),
        ("G81 X10. Z-5. R2. K0\nG80\nG92 X0\nM30\n", "6:1", "X"),
        (
            "G81 X10. Z-5. R2. K0\nG80\nG91 G28 X5. Z0\nM30\n",
            "6:5",
            "X",
        ),
    ] {
        let program = format!("{head}{program}");
        let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
        let words = format!("where {axis} is behind K0 beside a place");
        assert_one_error(&shown, &program, &format!("part.nc:{place}"), &words);
    }
    for (program, linuxcnc) in [
        (
            "G99 G81 X10. Y10. Z-5. R2. K0\nX20. Y5.\nX30.\nG80",
            "G99 G81 X20 Y5 Z-5 R2\nX30\nG80",
        ),
        // A retraction leaves the place alone.
        (
            "G81 X10. Z-5. R2. K0\nG80\nG91 G28 Z0\nG90 G0 X5.\nG91 X5.",
            "G53 G0 Z0\nX5\nX10",
        ),
        (
            "G81 X10. Z-5. R2. K0\nG80\nG91 G28 X0\nG90 G0 Z5.",
            "G53 G0 X0\nZ5",
        ),
    ] {
        pair(program, linuxcnc);
    }
}

/// Where P stands, not the cycle in whose block it need not be.
#[test]
fn the_dwell_of_a_rigid_tap_is_left_out_where_it_stands() {
    let program = "G90 G0 X0 Y0 Z50.\nM29 S500\nG84 X10. Z-10. R5. F500\nX20. P500\nG80\nM30\n";
    let output = Shop::with(Dialect::Fanuc, program).accepted(&[]);
    assert!(output.contains("(MSG, line 4: the dwell"), "{output}");
}

/// The initial level is asked for only where it is used.
#[test]
fn the_same_holes_at_several_work_offsets() {
    for (program, linuxcnc) in [
        (
            "G54 G0 Z50.\nG99 G81 X10. Y10. Z-5. R2.\nX20.\nG80\nG55 G0 X0\nG99 G81 X10. Y10. Z-5. R2.\nG80 G0 Z50.",
            "G54 G0 Z50\nG99 G81 X10 Y10 Z-5 R2\nX20\nG80\nG55 G0 X0\nG0 X10 Y10\nZ2\nG1 Z-5\nG0 Z2\nZ50",
        ),
        // G54 again moves nothing.
        (
            "G54 G0 Z50.\nG98 G81 X10. Z-5. R2.\nG80\nG54 G0 X5.\nG98 G81 X6. Z-5. R2.\nG80",
            "G54 G0 Z50\nG98 G81 X10 Z-5 R2\nG80\nG54 G0 X5\nG98 G81 X6 Z-5 R2\nG80",
        ),
    ] {
        pair(program, linuxcnc);
    }
    let text = "where the tool is above the part is not known";
    for (cycle, place) in [
        ("G55\nG98 G81 X10. Z-5. R2.", "4:5"),
        ("G55\nG91 G99 G81 X10. Z-7. R-48.", "4:9"),
        ("G98 G81 X10. Z-5. R2.\nG55 X20.", "3:5"),
        // G92 has moved the zero points of all.
        ("G54 G92 Z9.\nG54\nG98 G81 X10. Z-5. R2.", "5:5"),
    ] {
        let program = format!("G54 G0 X0 Y0 Z50.\nF100.\n{cycle}\nG80\nM30\n");
        let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
        assert_one_error(&shown, &program, &format!("part.nc:{place}"), text);
    }
}
