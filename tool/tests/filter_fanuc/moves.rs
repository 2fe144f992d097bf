//! Motions and modes: what LinuxCNC does with a translated program is what it does with the same job in
//! its own language.

use crate::path::{assert_pair, translated};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

#[test]
fn motions_are_those_of_linuxcnc() {
    for (program, linuxcnc) in [
        // The beginning of a program as posts write it.
        (
            "%\nO1000 (PART)\nN10 G21\nN20 G0 G17 G40 G49 G80 G90\nN30 T1 M6\nN40 G0 G90 G54 X10. Y-5.5 S2000 M3\n\
             N50 G43 H1 Z50. M8\nN60 G1 Z-2. F300.\nN70 X20.\nM9\nM30\n%\n",
            "T1 M6\nG0 X10 Y-5.5 S2000 M3\nG43 H1 Z50 M8\nG1 Z-2 F300\nX20\nM30\n",
        ),
        // The end of one, with the number that posts write where none is given.
        (
            "%\nO0000(T-1)\n(DATE=DD-MM-YY - 01-02-24 TIME=HH:MM - 10:00)\nG21\nG0G17G40G49G80G90\nG91G28Z0.\nT31M6\n\
             G0G90G54X-98.263Y-11.821A0.S3500M3\nG43H31Z20.M8\nZ-5.764\nG1Z-5.964F500.\nX10.\nG0Z20.\nM5\nG91G28Z0.M9\n\
             G28X0.Y0.A0.\nM01\nM30\n%\n",
            "G53 G0 Z0\nT31 M6\nG0 X-98.263 Y-11.821 A0 S3500 M3\nG43 H31 Z20\nZ-5.764\nG1 Z-5.964 F500\nX10\nG0 Z20\nM5\n\
             G53 G0 Z0\nG53 G0 X0 Y0 A0\nM30\n",
        ),
        (
            "G0 X0 Y0 Z0\nG1 G91 X5. F100.\nY5.\nG90 X1.\nM30\n",
            "G0 X0 Y0 Z0\nG1 X5 F100\nY5\nX1\nM30\n",
        ),
        // The length that is in force already, and one behind which Z is absolute, leave increments as they are.
        (
            "G49 G0 X0 Y0 Z9.\nG91 Z1.\nG90 G43 H1 Z5.\nG91 G43 H1 Z1.\nZ1.\nG49 X1.\nG28 Z0\nM30\n",
            "G49 G0 X0 Y0 Z9\nZ10\nG43 H1 Z5\nZ6\nZ7\nG49\nG91 G0 X1\nG90 G53 G0 Z0\nM30\n",
        ),
        // Arcs by centre and radius, more than half a circle, whole ones, helices, the other planes.
        (
            "G0 X10. Y0 Z0\nG3 X0 Y10. I-10. F200.\nG2 X10. Y0 R10.\nG3 X0 Y10. R-10.\nG2 J-10.\nG3 Y-10. J-10. Z-2.\nM30\n",
            "G0 X10 Y0 Z0\nG3 X0 Y10 I-10 J0 F200\nG2 X10 Y0 R10\nG3 X0 Y10 R-10\nG2 I0 J-10\nG3 X0 Y-10 I0 J-10 Z-2\nM30\n",
        ),
        (
            "G0 X10. Y0 Z0\nG18 G3 X0 Z10. I-10. K0 F200.\nG19 G2 Y10. Z0 R10.\nM30\n",
            "G0 X10 Y0 Z0\nG18 G3 X0 Z10 I-10 K0 F200\nG19 G2 Y10 Z0 R10\nM30\n",
        ),
        // Inch, dwells, inverse time, feed a turn.
        (
            "G20 G0 X1. Y1. Z0\nG1 X2. F10.\nG4 X1.5\nG4 P500\nG4 U2.\n#1=250\nG4 P#1\nG4 P[#1*3]\nM30\n",
            "G0 X25.4 Y25.4 Z0\nG1 X50.8 F254\nG4 P1.5\nG4 P.5\nG4 P2\nG4 P.25\nG4 P.75\nM30\n",
        ),
        (
            "G0 X0 Y0 Z0\nG93 G1 X10. F2.\nG94 X20. F100.\nM30\n",
            "G0 X0 Y0 Z0\nG93 G1 X10 F2\nG94 X20 F100\nM30\n",
        ),
        // Every path mode has its tolerance, and G9 holds for its block.
        (
            "G0 X0 Y0 Z0\nG64 G1 X1. F100.\nG61 X2.\nG64 G9 X3.\nX4.\nM30\n",
            "G0 X0 Y0 Z0\nG64 P.01 G1 X1 F100\nG61.1 X2\nX3\nG64 P.01 X4\nM30\n",
        ),
        // Compensation with a row of its own.
        (
            "G0 X0 Y0 Z0\nG41 D31 G1 X20. Y0 F100.\nX40.\nY20.\nG40 X60.\nM30\n",
            "G0 X0 Y0 Z0\nG41 D31 G1 X20 Y0 F100\nX40\nY20\nG40 X60\nM30\n",
        ),
        // A rapid beside the modal feed motion, and home over a place.
        (
            "G1 X0 Y0 Z0 F100.\nG53 Z-1.\nX5.\nG91 G28 Z0\nG90 G28 X7.\nM30\n",
            "G1 X0 Y0 Z0 F100\nG53 G0 Z-1\nG1 X5\nG53 G0 Z0\nG0 X7\nG53 G0 X0\nM30\n",
        ),
    ] {
        assert_pair(program, linuxcnc);
    }
}

#[test]
fn roundings_and_chamfers_stand_between_their_lines() {
    assert_pair(
        "G0 X0 Y0 Z0\nG1 X10. ,R2. F100.\nY10. ,C1.\nX0\nM30\n",
        "G0 X0 Y0 Z0\nG1 X8 F100\nG3 X10 Y2 I0 J2\nG1 Y9\nX9 Y10\nX0\nM30\n",
    );
}

#[test]
fn numbers_without_a_point_are_whole_units_or_increments() {
    let program = "G0 X100 Y-20 Z0\nG1 A90 F100\nG3 X100 Y-20 I5\nM30\n";
    let whole = translated(Dialect::Fanuc, program, &[]);
    let pointed = translated(
        Dialect::Fanuc,
        "G0 X100. Y-20. Z0\nG1 A90. F100\nG3 X100. Y-20. I5.\nM30\n",
        &[],
    );
    assert_eq!(whole, pointed);
    let increments = translated(Dialect::Fanuc, program, &["--decimal-point", "increments"]);
    let small = translated(
        Dialect::Fanuc,
        "G0 X.1 Y-.02 Z0\nG1 A.09 F100\nG3 X.1 Y-.02 I.005\nM30\n",
        &[],
    );
    assert_eq!(increments, small);
    let shop = Shop::with(Dialect::Fanuc, "G0 X1.\nX100\nX200\nM30\n");
    let written = shop.accepted(&[]);
    assert_eq!(
        written.matches("without a decimal point").count(),
        1,
        "{written}"
    );
    assert!(
        written.contains("line 2: X without a decimal point"),
        "{written}"
    );
    let pointed = Shop::with(Dialect::Fanuc, "G0 X1. Y0\nX100.\nM30\n").accepted(&[]);
    assert!(!pointed.contains("decimal point"), "{pointed}");
}

/// Roundings and chamfers are lengths as all others; F is as it is written.
#[test]
fn roundings_without_a_point_are_whole_units_or_increments() {
    let program = "G0 X0 Y0 Z0\nG1 X10000 F100 ,R2000\nY10000 ,C1000\nX0\nG93 X5000 F2\nM30\n";
    let pointed = "G0 X0 Y0 Z0\nG1 X10. F100 ,R2.\nY10. ,C1.\nX0\nG93 X5. F2\nM30\n";
    let increments = translated(Dialect::Fanuc, program, &["--decimal-point", "increments"]);
    assert_eq!(increments, translated(Dialect::Fanuc, pointed, &[]));
    let program = "G0 X0 Y0 Z0\nG1 X10. F100 ,R2\nY10.\nM30\n";
    let written = Shop::with(Dialect::Fanuc, program).accepted(&[]);
    assert!(
        written.contains("line 2: ,R or ,C without a decimal point"),
        "{written}"
    );
}

/// G20 and G21 are the unit of all of their block.
#[test]
fn increments_beside_a_unit_are_counted_in_it() {
    for (program, pointed) in [
        ("G20 G0 X10000 Y5000\nM30\n", "G20\nG0 X1. Y.5\nM30\n"),
        (
            "G20\nG0 Z0\nG21 X10000\nM30\n",
            "G20\nG0 Z0\nG21\nX10.\nM30\n",
        ),
        (
            "G0 X0 Y0\nG20 G52 X10000\nG0 X0\nM30\n",
            "G0 X0 Y0\nG20\nG52 X1.\nG0 X0\nM30\n",
        ),
    ] {
        let increments = translated(Dialect::Fanuc, program, &["--decimal-point", "increments"]);
        assert_eq!(increments, translated(Dialect::Fanuc, pointed, &[]));
    }
}

#[test]
fn work_offsets_have_their_systems() {
    let shop = Shop::with(
        Dialect::Fanuc,
        "G54 G0 X1.\nG55 X1.\nG59 X1.\nG54.1 P1 X1.\nG54 P3 X1.\nM30\n",
    );
    let written = shop.accepted(&[]);
    let systems = ["G54 ", "G55 ", "G59 ", "G59.1 ", "G59.3 "];
    for system in systems {
        let line = format!("{system}G0 X1");
        assert!(
            written
                .lines()
                .any(|found| found.contains(&line) || found.contains(system)),
            "{system}\n{written}"
        );
    }
}

#[test]
fn shifts_of_the_zero_are_those_of_linuxcnc() {
    let program = "G52 X10. Y5.\nG0 X1.\nG52 X0 Y0\nG92 X5. Z1.\nG20 G52 X1. Y1.\nM30\n";
    let written = Shop::with(Dialect::Fanuc, program).accepted(&[]);
    for shift in [
        "G52 X10 Y5",
        "G52 X0 Y0",
        "G92 X5 Z1",
        "G52 Y25.4",
        "G92 X-20.4",
    ] {
        assert!(written.contains(shift), "{shift}\n{written}");
    }
}

/// On the control G52 and G92 shift zero one after the other; LinuxCNC keeps them in one place.
#[test]
fn a_local_offset_leaves_g92_in_force() {
    let begin = "G0 X0 Y0 Z0\n";
    for (program, ends) in [
        ("G92 X5.\nG52 X0 Y0 Z0\nG0 X5.", [0.0, 0.0]),
        ("G92 X5.\nG52 X2.\nG0 X5. Y1.", [2.0, 1.0]),
        ("G92 X5.\nG52 X2. Y3.\nG52 X0\nG0 X5. Y1.", [0.0, 4.0]),
        (
            "G52 X2.\nG0 X1.\nG92 X0\nG0 X1.\nG52 X0\nG0 X0 Y0",
            [3.0, 0.0],
        ),
        ("G92 X5.\nG52 X2.\nG0 X5.\nG92 X1.\nG0 X0 Y0", [1.0, 0.0]),
    ] {
        let program = format!("{begin}{program}\nG0 Z1.\nM30\n");
        let contour = Shop::with(Dialect::Fanuc, &program).contour();
        let end = contour.last().expect("a move").shape.point(1.0);
        assert!(
            (0..2).all(|axis| (end[axis] - ends[axis]).abs() < 1e-9),
            "{program}{end:?}"
        );
    }
}
