//! Polar coordinates (G16), and work offsets that a program sets (G10 L2).

use crate::one_error::assert_one_error;
use crate::path::{assert_pair, assert_same, plain, translated};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

const BEFORE: &str = "G0 X0 Y0 Z50.\nS500 M3\nF100.\n";

fn pair(program: &str, linuxcnc: &str) {
    assert_pair(
        &format!("O1\n{BEFORE}{program}\nM30\n"),
        &format!("{BEFORE}{linuxcnc}\nM30\n"),
    );
}

#[test]
fn radius_and_angle_hold_until_they_are_named_again() {
    let holes = "G99 G81 X0 Y10 Z-5 R2\nX-10 Y0\nX0 Y-10\nG80\nG0 X10 Y20";
    pair(
        "G16\nG99 G81 X10. Y90. Z-5. R2.\nY180.\nY270.\nG15 G80\nG0 X10. Y20.",
        holes,
    );
    // The angle as an increment, and as often as K says.
    pair(
        "G90 G16 G99 G81 X10. Y90. Z-5. R2.\nG91 Y90. K2\nG90 G15 G80\nG0 X10. Y20.",
        holes,
    );
    pair(
        "G16 G99 G81 X10. Y0 Z-5. R2. K0\nG91 Y90. K3\nG90 G15 G80\nG0 X10. Y20.",
        holes,
    );
    pair(
        "G16\nG1 X10. Y30.\nZ-1.\nX20.\nG0 Y60. Z5.\nG15\nX0",
        "G1 X8.660254 Y5\nZ-1\nX17.320508 Y10\nG0 X10 Y17.320508 Z5\nX0",
    );
    // Round the local zero, and in inch.
    pair(
        "G52 X5. Y5.\nG16 X1. Y90.\nG15 G52 X0 Y0",
        "G52 X5 Y5\nG0 X0 Y1\nG52 X0 Y0",
    );
    pair("G16 G20 X1. Y180.\nG21 Y90.\nG15", "G0 X-25.4 Y0\nX0 Y25.4");
}

#[test]
fn angles_count_thousandths_where_numbers_are_increments() {
    let program = format!("O1\n{BEFORE}G20 G16 X10000 Y90000\nG15 X0 Y0\nM30\n");
    let options = ["--backend", "program", "--decimal-point", "increments"];
    let given = translated(Dialect::Fanuc, &program, &options);
    let wanted = plain(&format!("{BEFORE}G0 X0 Y25.4\nX0 Y0\nM30\n"));
    assert_same(&given, &wanted, &program);
}

#[test]
fn what_polar_coordinates_could_mean_otherwise_is_refused() {
    for (block, place, words) in [
        ("G18 G16", "5:5", "G16 outside of G17"),
        ("G16 X10.", "5:5", "needs its radius and its angle"),
        ("G91 G16 X10. Y5.", "5:9", "the radius of G16 in G91"),
        ("G16 G2 X10. Y5. R5.", "5:1", "an arc in G16"),
        ("G16 G1 X10. Y5. ,R1.", "5:17", ",R or ,C in G16"),
        (
            "G68 X0 Y0 R5.\nG16 X10. Y5.",
            "6:5",
            "outside of G17, or under",
        ),
        ("G16\nG28 X0 Y0", "6:1", "G28 with X or Y in G16"),
    ] {
        refused(block, place, words);
    }
}

fn refused(block: &str, place: &str, words: &str) {
    let program = format!("O1\n{BEFORE}{block}\nM30\n");
    let shown = Shop::with(Dialect::Fanuc, &program).refused(&[]);
    assert_one_error(&shown, &program, &format!("part.nc:{place}"), words);
}

#[test]
fn work_offsets_are_set_as_they_are_written() {
    let program = "O1\nG54 G0 X1.\nG10 L2 P1 X-10. Y5.\nG20 G10 L2 P6 Z1. A10.\nG21 G10 L20 P1 X3.\nG11\nX2. Y1.\nM30\n";
    let output = Shop::with(Dialect::Fanuc, program).accepted(&["--backend", "program"]);
    for line in [
        "G10 L2 P1 X-10 Y5",
        "G10 L2 P6 Z25.4 A10",
        "G10 L2 P7 X3",
        "G0 X2 Y1",
    ] {
        assert!(output.contains(&format!("\n{line} ")), "{line}\n{output}");
    }
    assert!(
        output.contains("(MSG, line 3: G10 replaces the work offset"),
        "{output}"
    );
    // Where the tool is in the one in use is another place.
    let program = "G90 G54 G0 X1. Y1.\nG10 L2 P1 X5.\nG91 G1 X2. Y2. F100.\nM30\n";
    assert_pair(
        &format!("O1\n{program}"),
        "G90 G54 G0 X1 Y1\nG10 L2 P1 X5\nG91 G1 X2 Y2 F100\nM30\n",
    );
    for (block, place, words) in [
        (
            "G10 L10 P1 R5.",
            "5:5",
            "G10 is not supported without L2 or L20",
        ),
        ("G10 L2 P0 X5.", "5:8", "LinuxCNC has no such work offset"),
        ("G10 L2 P7 X5.", "5:8", "LinuxCNC has no such work offset"),
        ("G10 L20 P4 X5.", "5:9", "LinuxCNC has no such work offset"),
        ("G10 L2 X5.", "5:1", "LinuxCNC has no such work offset"),
        ("G10 L2 P1", "5:1", "G10 without axes"),
        ("G91 G10 L2 P1 X5.", "5:5", "G10 in G91 adds"),
        ("G68 X0 Y0 R5.\nG10 L2 P1 X5.", "6:1", "G10 while G51"),
    ] {
        refused(block, place, words);
    }
}
