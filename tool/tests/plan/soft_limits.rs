//! Where the INI file has soft limits the path keeps to the inner side near them.

use crate::support::{Bench, MILL};

/// A corner at X 40 of the work offset, Y 40.
const CORNER: &str = "G21 G64 P0.05 F3000\nG1 X20 Y20\nX40\nY40\nX20\nM2\n";

/// The mill with a greatest position of X.
fn mill(limit: f64) -> String {
    MILL.replace(
        "[JOINT_0]\n",
        &format!("[JOINT_0]\nMIN_LIMIT = -1\nMAX_LIMIT = {limit}\n"),
    )
}

/// How far a program leads to X, machine coordinates.
fn greatest_x(ini: &str, program: &str, options: &[&str]) -> f64 {
    let bench = Bench::new();
    bench.write("mill.ini", ini);
    let to_file = ["--ini", "mill.ini", "--csv", "plan.csv"];
    bench.figures(program, &[&to_file, options].concat());
    let text = bench.read("plan.csv");
    let x = |row: &str| row.split(',').nth(3)?.parse::<f64>().ok();
    text.lines().filter_map(x).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn corners_at_a_soft_limit_do_not_swing_out() {
    let beyond = |limit: f64| greatest_x(&mill(limit), CORNER, &[]) - 40.0;
    assert!((0.01..0.05).contains(&beyond(50.0)), "{}", beyond(50.0));
    assert!(beyond(40.0) < 1e-6, "{}", beyond(40.0));
    // Without one, and without an INI file, nothing holds them back.
    assert!(greatest_x(MILL, CORNER, &[]) - 40.0 > 0.01);
}

#[test]
fn corners_inside_do_not_swing_out() {
    assert!(greatest_x(MILL, CORNER, &["--corners-inside"]) - 40.0 < 1e-6);
}

#[test]
fn limits_are_those_of_the_machine() {
    let moved = format!("G10 L2 P1 X10\nG54\n{CORNER}");
    let beyond = |limit: f64| greatest_x(&mill(limit), &moved, &[]) - 50.0;
    assert!(beyond(50.0) < 1e-6, "{}", beyond(50.0));
    assert!(beyond(60.0) > 0.01, "{}", beyond(60.0));
}

#[test]
fn what_goes_beyond_a_soft_limit_is_told_once() {
    let bench = Bench::new();
    bench.write("mill.ini", &mill(30.0));
    bench.write("part.ngc", &format!("{CORNER}\n").replace("M2", "X40\nM2"));
    let output = bench.plan(&["part.ngc", "--ini", "mill.ini"]);
    assert!(output.status.success());
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        "warning: part.ngc:3: joint 0 goes to 40.000, beyond [JOINT_0]MAX_LIMIT = 30: LinuxCNC refuses the program (is the work \
         offset set?); planned without that limit\n"
    );
}

#[test]
fn what_goes_beyond_a_soft_limit_is_planned_all_the_same() {
    assert!(greatest_x(&mill(30.0), CORNER, &[]) > 40.0);
    let arc = "G21 G64 P0.05 F3000\nG1 X20 Y20\nG3 X20 Y40 I0 J10\nG1 X0\nM2\n";
    assert!((greatest_x(&mill(25.0), arc, &[]) - 30.0).abs() < 0.05);
    let tables = mill(25.0).replace("trivkins", "framekins");
    assert!((greatest_x(&tables, arc, &[]) - 30.0).abs() < 0.05);
}
