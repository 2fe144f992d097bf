//! The rest of the language of MEFI controls.

use crate::machine::{self, Machine};
use crate::path::{Step, assert_same, clockwise, counterclockwise, line, steps};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

fn shop(program: &str) -> Shop {
    Shop::with(Dialect::Mefi, program)
}

/// The path of a program, which both backends must give.
fn path(program: &str) -> Vec<Step> {
    machine::path_of(&shop(program))
}

#[test]
fn arcs_by_centre_and_radius() {
    assert_same(
        &path("G1 X10 Y0 F100\nG3 X0 Y10 I-10\nG2 X10 Y20 R10\nG3 X20 R-5.0001\nG2 I-5 J0\nM30\n")
            [..3],
        &[
            line(10.0, 0.0),
            counterclockwise(0.0, 10.0, [0.0, 0.0]),
            clockwise(10.0, 20.0, [10.0, 10.0]),
        ],
        "arcs",
    );
}

#[test]
fn increments_count_from_where_the_tool_is() {
    assert_same(
        &path("G1 X10 Y20 F100\nG35 X0\nG91 X5 Y5\nG36 X2\nX5 Y5\nG90 X0 Y0\nM30\n"),
        &[
            line(10.0, 20.0),
            // X is -10 in the mirrored frame: -10 + 5, mirrored
            line(5.0, 25.0),
            line(-5.0, 35.0),
            line(0.0, 0.0),
        ],
        "increments",
    );
}

#[test]
fn subprograms_are_found_in_the_file_and_beside_it() {
    let files = [
        (
            "part.nc",
            "G0 X1\nG71 L5\nG71 L7 Q2\nM30\nG79 L5\nX2\nG70\n",
        ),
        ("L7.NC", "G91 G1 X1 F100\nG90\nG70\n"),
    ];
    let shop = Shop::new(Dialect::Mefi, &files);
    let output = shop.accepted(&["--backend", "program"]);
    let ends: Vec<f64> = machine::run(&output)
        .iter()
        .map(|step| step.end()[0])
        .collect();
    assert_eq!(ends, [1.0, 2.0, 3.0, 4.0]);
    assert!(output.contains("(MSG, line 3: Q is taken as the number of passes: 2)"));
    assert!(output.contains("(--- L7 in L7.NC, pass 2 of 2 ---)"));
    let with_p = [("part.nc", "G71 L7 P2\nM30\n"), files[1]];
    let output = Shop::new(Dialect::Mefi, &with_p).accepted(&["--backend", "program"]);
    assert!(output.contains("(--- L7 in L7.NC, pass 2 of 2 ---)"));
    assert!(!output.contains("(MSG"), "{output}");
    let shop = Shop::new(
        Dialect::Mefi,
        &[
            ("part.nc", "G71 L8\nM30\n"),
            ("l8.nc", "%8\nM30\nG79 L8\nG0 X8\nG70\n"),
        ],
    );
    assert_same(&steps(&shop.contour()), &[line(8.0, 0.0)], "L8");
}

#[test]
fn compensation_uses_the_row_that_d_selects() {
    let program = "G0 X0 Y0\nG71 L1 D4\nM30\nG79 L1\nG1 X10 F100 G41\nX20\nG40 X0\nG70\n";
    let output = shop(program).accepted(&[]);
    assert!(output.contains("G43 H4"), "{output}");
    assert!(output.contains("G41 D4 G1 X10"), "{output}");
    assert!(
        output.contains("(MSG, line 2: D4 runs as G43 H4"),
        "{output}"
    );
    assert!(!output.contains("without a D"), "{output}");
    let without = shop(&program.replace(" D4", "")).accepted(&[]);
    assert!(
        without.contains("this takes the radius of the tool in the spindle, and not its length"),
        "{without}"
    );
    let mirrored = program.replace("G71 L1 D4", "G35 Y0\nG71 L1 D4");
    let output = shop(&mirrored).accepted(&["--backend", "program"]);
    assert!(output.contains("G42 D4 G1 X10"), "{output}");
}

/// LinuxCNC takes D0 for the tool that it has, and forgets a row with the tool.
#[test]
fn no_radius_and_a_row_that_outlasts_the_tool() {
    let program = "T5 M6\nD0\nG0 X0 Y0\nG1 G41 X10 Y10 F100\nX20\nG40 X40\nD5\nT6 M6\nG41 X50 Y10\nX55\n\
                   G40 X60\nM30\n";
    for dialect in [Dialect::Mefi, Dialect::Isg] {
        let output = Shop::with(dialect, program).accepted(&[]);
        assert!(output.contains("\nG41.1 D0 G1 X10 Y10 F100"), "{output}");
        assert!(output.contains("\nG41 D5 G1 X50 Y10"), "{output}");
    }
}

#[test]
fn further_axes_are_mirrored_scaled_and_shifted() {
    let program =
        "G0 U1 C10\nG35 U0 C0\nG0 U1 C10\nG36 X2\nG0 U1\nG37 U5 C3\nG0 U1 C10\nG91 U1\nM30\n";
    let output = shop(program).accepted(&["--backend", "program"]);
    let moves: Vec<&str> = output
        .lines()
        .filter(|line| line.starts_with("G0"))
        .map(|line| line.split(" (").next().unwrap_or(""))
        .collect();
    assert_eq!(
        moves,
        ["G0 C10 U1", "G0 C-10 U-1", "G0 U-2", "G0 C-7 U3", "G0 U1"]
    );
    let mut machine = Machine::new();
    machine.run(&shop(program).accepted(&["--backend", "kinematics"]));
    assert_eq!(machine.position[5..7], [-7.0, 1.0]);
    let scaled = shop("G36 X2\nG0 C10\nM30\n").accepted(&[]);
    assert!(scaled.contains("angles are not scaled"), "{scaled}");
}

#[test]
fn words_of_all_kinds() {
    let program = "/N5 T3 M6 \"tool\nN10 S500 M3 M8 G17 G90 G94\nG4 F2\nG4 X1.5\nG55\nG1 X1 F100 M0\n\
                   G95 F0.2\nX2\nG54\nM5 M9 M2\n";
    let output = shop(program).accepted(&[]);
    for wanted in [
        "T3 M6 (line 1: tool)",
        "M3 M8",
        "G4 P2",
        "G4 P1.5",
        "G55",
        "G1 X1 F100",
        "M0",
        "G95 F0.2",
        "the dwell is taken as 2 seconds",
    ] {
        assert!(output.contains(wanted), "{wanted}\n{output}");
    }
    let skipped = shop(program).accepted(&["--skip-blocks"]);
    assert!(!skipped.contains("T3"));
}

#[test]
fn presets_are_those_of_linuxcnc() {
    let output = shop("G0 X10 Y5\nG92 X0\nX1\nM30\n").accepted(&["--backend", "program"]);
    assert!(output.contains("G92 X0"), "{output}");
    assert!(output.contains("G0 X1"), "{output}");
}

#[test]
fn a_motion_without_a_name_is_taken_as_g1_and_that_is_said() {
    let output = shop("X1 F100\nG0 X2\nM30\n").accepted(&[]);
    assert!(output.contains("G1 X1 F100"), "{output}");
    assert!(
        output.contains("(MSG, line 1: no G0, G1, G2 or G3 before"),
        "{output}"
    );
}

#[test]
fn what_a_later_shift_leaves_out_is_said() {
    let output = shop("G37 X1 Y2\nG37 X3\nG0 X0 Y0\nM30\n").accepted(&["--backend", "program"]);
    assert!(output.contains("Y is not shifted any more"), "{output}");
    assert!(output.contains("G0 X3 Y0"), "{output}");
}

#[test]
fn old_encodings_and_line_ends() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let file = folder.path().join("part.nc");
    // CP1251, a lone CR, a NUL at the end
    std::fs::write(
        &file,
        b"%1\rN10 G1 X5 F100 \"\xcf\xf0\xe8\xe2\xe5\xf2\rM30\r\0",
    )
    .expect("a file");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_framepath"))
        .args(["filter", "--dialect", "mefi"])
        .arg(&file)
        .output()
        .expect("the tool runs");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(text.contains("N10 G1 X5 F100 (line 2"), "{text}");
}
