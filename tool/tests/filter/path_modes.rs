//! How corners are passed: modes, their tolerance, and the exact path of cycles.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, commands, refused, translate};
use std::process::Command;

/// The words that set a path mode, in their order.
fn modes(output: &str) -> Vec<String> {
    let lines = commands(output).into_iter();
    let modes = lines.filter(|line| !line.starts_with("(MSG"));
    let mode = |line: String| {
        let words: Vec<&str> = line.split(' ').collect();
        let at = words.iter().position(|word| word.starts_with("G6"))?;
        let end = at + 1 + usize::from(words[at] == "G64");
        Some(words[at..end].join(" "))
    };
    modes.filter_map(mode).collect()
}

/// The mode of the header, and what comes back after a block with a stop of its own.
#[test]
fn the_path_mode_holds_until_the_program_changes_it() {
    let program = "G0 X0 Y0 Z0\nG9 G1 X1 F200\nX2\nG64\nG9 X3\nX4\nM30\n";
    for (arguments, header, mode, rounded) in [
        (&[][..], "G94 G61\n", "G61", "G64 P0.01"),
        (&["--path-mode", "G61"], "G94 G61\n", "G61", "G64 P0.01"),
        (
            &["--path-mode", "g64"],
            "G94 G64 P0.01\n",
            "G64 P0.01",
            "G64 P0.01",
        ),
        (
            &["--path-mode", "0.05"],
            "G94 G64 P0.05\n",
            "G64 P0.05",
            "G64 P0.01",
        ),
        (
            &["--path-mode", "g64", "--tolerance", "0.5"],
            "G94 G64 P0.5\n",
            "G64 P0.5",
            "G64 P0.5",
        ),
        (
            &[
                "--machine-in-inch",
                "--path-mode",
                "0.0254",
                "--tolerance",
                "2.54",
            ],
            "G94 G64 P0.001\n",
            "G64 P0.001",
            "G64 P0.1",
        ),
    ] {
        for backend in ["program", "kinematics"] {
            let output = translate(program, &[&["--backend", backend], arguments].concat());
            assert!(output.contains(header), "{output}");
            let said = format!(
                "of its own: P{}, option",
                rounded.rsplit_once('P').expect("a P").1
            );
            assert_eq!(output.matches(&said).count(), 1, "{output}");
            let given: Vec<String> = commands(&output)
                .into_iter()
                .filter(|line| line.starts_with("G6"))
                .collect();
            let stop = |x: u32, feed: &str| format!("G61.1 G1 X{x}{feed}");
            assert_eq!(
                given,
                [&stop(1, " F200"), mode, rounded, &stop(3, ""), rounded],
                "{arguments:?}"
            );
        }
    }
    // Where every move ends at rest anyway, G9 adds nothing.
    let output = translate("G0 X0\nG9 G1 X1 F200\nM30\n", &["--path-mode", "G61.1"]);
    assert_eq!(output.matches("G61.1").count(), 1, "{output}");
    assert!(output.contains("G94 G61.1\n"), "{output}");
}

#[test]
fn tolerances_that_are_none_are_refused() {
    let shop = Shop::new(&[("part.mpf", b"M30\n")]);
    // LinuxCNC would take G64 P0 for no limit at all.
    for value in [
        "0", "-1", "0.0001", "11", "nan", "inf", "G62", "G64P0.1", "",
    ] {
        for option in ["--path-mode", "--tolerance"] {
            let output = shop.run("part.mpf", &[&format!("{option}={value}")]);
            assert_eq!(output.status.code(), Some(2), "{option} {value}");
            assert!(output.stdout.is_empty(), "{option} {value}");
        }
    }
}

/// The INI file of the LinuxCNC that opens the program; an option goes before it.
#[test]
fn the_ini_file_gives_the_tolerance() {
    let ini = "[FRAMEPATH]\nTOLERANCE = 0.03\n";
    let shop = Shop::new(&[
        ("part.mpf", b"G64\nG0 X0\nM30\n"),
        ("machine.ini", ini.as_bytes()),
        ("other.ini", b"[FRAMEPATH]\nCLEAR_AT_END = 1\n"),
        ("wrong.ini", b"[FRAMEPATH]\nTOLERANCE = 0\n"),
    ]);
    let run = |ini: &str, arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(shop.path(""))
            .env("INI_FILE_NAME", shop.path(ini))
            .args(["filter", "--dialect", "sinumerik"])
            .args(arguments)
            .arg("part.mpf")
            .output()
            .expect("the tool runs")
    };
    for (ini, arguments, mode) in [
        ("machine.ini", &[][..], "G64 P0.03"),
        ("machine.ini", &["--tolerance", "0.2"], "G64 P0.2"),
        ("other.ini", &[], "G64 P0.01"),
    ] {
        assert_eq!(modes(&accepted(&run(ini, arguments))), [mode], "{ini}");
    }
    let shown = refused(&run("wrong.ini", &[]));
    assert!(
        shown.contains("wrong.ini:2") && shown.contains("[FRAMEPATH]TOLERANCE = 0"),
        "{shown}"
    );
    assert!(refused(&run("none.ini", &[])).contains("none.ini"));
}

/// The tolerance in force, whatever G64x follows: CTOL and CYCLE832 until they end, ADIS with G641.
#[test]
fn sinumerik_tolerances_hold_until_they_end() {
    for (program, expected) in [
        ("G64", &["G64 P0.01"][..]),
        ("G642\nG643\nG644\nG645", &["G64 P0.01"; 4]),
        ("CYCLE832(0.02,_FINISH,1)\nG642", &["G64 P0.02"; 2]),
        (
            "CYCLE832(0.02,1,1)\nG60\nG644",
            &["G64 P0.02", "G61.1", "G64 P0.02"],
        ),
        // It ends where it began.
        ("CYCLE832(0.02,3,1)\nCYCLE832()", &["G64 P0.02", "G61"]),
        (
            "G64\nCYCLE832(0.02,3,1)\nCYCLE832(0,0,1)",
            &["G64 P0.01", "G64 P0.02", "G64 P0.01"],
        ),
        (
            "CYCLE832(0.02,3,1)\nG645\nCYCLE832(0.02,_OFF,1)",
            &["G64 P0.02", "G64 P0.02", "G64 P0.01"],
        ),
        ("G60\nCYCLE832()", &["G61.1"]),
        (
            "G60\nCYCLE832(0.02,3,1)\nCYCLE832()",
            &["G61.1", "G64 P0.02", "G61.1"],
        ),
        ("CYCLE832(0,1,1)", &["G64 P0.01"]),
        ("CTOL=0.02 G64\nG642", &["G64 P0.02"; 2]),
        (
            "CTOL=0.02\nG60\nG645\nCTOL=-1",
            &["G61.1", "G64 P0.02", "G64 P0.01"],
        ),
        ("CTOL=0.002 G70 G642", &["G64 P0.0508"]),
        (
            "G641 ADIS=0.5\nG642\nG641",
            &["G64 P0.5", "G64 P0.01", "G64 P0.5"],
        ),
        ("ADIS=0.5\nG641\nADIS=0", &["G64 P0.5", "G64 P0.01"]),
        ("CTOL=0.02\nG641 ADIS=0.5", &["G64 P0.02"]),
        (
            "CYCLE832(0.02,1,1)\nG641 ADIS=0.005",
            &["G64 P0.02", "G64 P0.005"],
        ),
        ("CTOL=0 G64", &["G61"]),
    ] {
        let output = translate(&format!("{program}\nG0 X1\nM30\n"), &[]);
        assert_eq!(modes(&output), expected, "{program}");
    }
    let shop = Shop::new(&[("part.mpf", b"G641 ADIS=-1\nM30\n")]);
    let shown = refused(&shop.run("part.mpf", &[]));
    assert!(
        shown.contains("1:6") && shown.contains("cannot be negative"),
        "{shown}"
    );
}

/// A bare G64 would round corners without a limit; G61 stops at each.
#[test]
fn fanuc_path_modes() {
    for (program, options, expected) in [
        ("G64", &[][..], &["G64 P0.01"][..]),
        ("G64", &["--tolerance", "0.5"], &["G64 P0.5"]),
        ("G61\nG64", &[], &["G61.1", "G64 P0.01"]),
        (
            "G64\nG9 G1 X1. F100.",
            &[],
            &["G64 P0.01", "G61.1", "G64 P0.01"],
        ),
        ("G61\nG9 G1 X1. F100.", &[], &["G61.1"]),
    ] {
        let shop = Shop::new(&[("part.nc", format!("O1\n{program}\nM30\n").as_bytes())]);
        let output = accepted(&shop.run_in("fanuc", "part.nc", options));
        assert_eq!(modes(&output), expected, "{program}");
    }
}

#[test]
fn fagor_tolerances() {
    for (program, expected) in [
        ("G05\nG07\nG50", &["G64 P0.01", "G61.1", "G64 P0.01"][..]),
        ("G51 E0.02\nG05", &["G64 P0.02", "G64 P0.01"]),
        // A is no axis there.
        ("G07\nG51 A50 E0.02 B175\nG0 X1", &["G61.1", "G64 P0.02"]),
        ("G51", &["G64 P0.01"]),
    ] {
        let shop = Shop::new(&[("part.pim", format!("{program}\nM30\n").as_bytes())]);
        let output = accepted(&shop.run_in("fagor", "part.pim", &[]));
        assert_eq!(modes(&output), expected, "{program}");
        assert!(!output.contains("A50"), "{output}");
    }
    for (program, place) in [
        ("G51 E0.02 X1", "1:1"),
        ("G01 F100 E0.02 X1", "1:10"),
        ("G51 E-1", "1:5"),
    ] {
        let shop = Shop::new(&[("part.pim", format!("{program}\nM30\n").as_bytes())]);
        let shown = refused(&shop.run_in("fagor", "part.pim", &[]));
        assert!(shown.contains(place), "{shown}");
    }
}

/// P of the frame kinematics counts in the coordinates of the program, as F does: the tolerance over the
/// greatest stretch of the frame, again where that changes. Coordinates that are rewritten are those of
/// the machine.
#[test]
fn the_tolerance_is_that_on_the_part_whatever_the_scale() {
    let full = ["G64 P0.05"];
    for (program, programmed, framed) in [
        (
            "G642 CTOL=0.05\nSCALE X10 Y10 Z10\nG0 X1 Y1 Z1\nSCALE\nG0 X1",
            &full[..],
            &["G64 P0.05", "G64 P0.005", "G64 P0.05"][..],
        ),
        (
            "SCALE X10 Y10 Z10\nG642 CTOL=0.05\nG0 X1 Y1 Z1",
            &full,
            &["G64 P0.005", "G64 P0.05"],
        ),
        (
            "SCALE X2 Y2 Z2\nCTOL=0.05 G64\nG0 X1 Y1 Z1\nASCALE X5 Y5 Z5\nG0 X1\nASCALE\nX2",
            &full,
            &["G64 P0.025", "G64 P0.005", "G64 P0.05"],
        ),
        // The default; the greatest of unequal factors; turns, shifts and mirrors are none.
        (
            "SCALE X2 Y0.5 Z4\nG64\nG0 X1 Y1 Z1\nAROT Z30\nATRANS X5\nAMIRROR X1\nX2",
            &["G64 P0.01"],
            &["G64 P0.0025", "G64 P0.01"],
        ),
        (
            "CTOL=0.05 G64\nROT Z30\nATRANS X5\nAMIRROR X1\nG0 X1 Y1 Z1",
            &full,
            &full,
        ),
        // Where the frame is off for a while.
        (
            "CTOL=0.05 G64\nSCALE X10 Y10 Z10\nG0 X1 Y1 Z1\nSUPA X0\nX1 Y1 Z1",
            &full,
            &[
                "G64 P0.05",
                "G64 P0.005",
                "G64 P0.05",
                "G64 P0.005",
                "G64 P0.05",
            ],
        ),
        // After a block with a stop of its own, and after a cycle.
        (
            "CTOL=0.05 G64\nSCALE X10 Y10 Z10\nG0 X1 Y1 Z9\nG9 G1 X2 F100\nCYCLE81(5,0,1,-7)",
            &["G64 P0.05", "G61.1", "G64 P0.05", "G61", "G64 P0.05"],
            &[
                "G64 P0.05",
                "G64 P0.005",
                "G61.1",
                "G64 P0.005",
                "G61",
                "G64 P0.005",
                "G64 P0.05",
            ],
        ),
        // Other axes share P, and no frame stretches them.
        (
            "CTOL=0.05 G64\nSCALE X0.1 Y0.1 Z0.1\nG0 X1 Y1 Z1\nX2\nA3 X3\nX4",
            &full,
            &["G64 P0.05", "G64 P0.5", "G64 P0.05"],
        ),
        // Without a tolerance nothing is written.
        (
            "G60\nSCALE X10 Y10 Z10\nG0 X1 Y1 Z1",
            &["G61.1"],
            &["G61.1"],
        ),
    ] {
        for (backend, expected) in [("program", programmed), ("kinematics", framed)] {
            let program = format!("{program}\nM30\n");
            let output = translate(&program, &["--backend", backend]);
            assert_eq!(modes(&output), expected, "{backend}: {program}{output}");
        }
    }
    // The mode of the header is scaled too.
    let program = "SCALE X10 Y10 Z10\nG0 X1 Y1 Z1\nM30\n";
    let arguments = ["--path-mode", "0.05", "--backend", "kinematics"];
    let output = translate(program, &arguments);
    assert_eq!(modes(&output), ["G64 P0.005", "G64 P0.05"], "{output}");
}

/// Factors for the finished path stretch what corners are cut by as any others do.
#[test]
fn the_tolerance_is_that_on_the_part_under_factors_of_the_machine() {
    let shop = Shop::new(&[(
        "part.pim",
        b"G51 E0.05\nG72 X4\nG0 X1 Y1 Z1\nG1 X2 F100\nM30\n",
    )]);
    for (backend, expected) in [
        ("program", &["G64 P0.05"][..]),
        ("kinematics", &["G64 P0.05", "G64 P0.0125", "G64 P0.05"]),
    ] {
        let output = accepted(&shop.run_in("fagor", "part.pim", &["--backend", backend]));
        assert_eq!(modes(&output), expected, "{backend}: {output}");
    }
}

/// The modes in which LinuxCNC makes its moves, one after the other, `E` for the exact path; and where
/// along Z the moves end.
fn moves(dialect: &str, name: &str, program: &str) -> (String, Vec<f64>) {
    let shop = Shop::new(&[(name, program.as_bytes())]);
    let output = accepted(&shop.run_in(dialect, name, &["--backend", "program"]));
    let canon = rs274::interpret(&shop.path(""), "T1 P1 Z0 D6\n", &output);
    let (mut mode, mut made, mut depths) = ('?', String::new(), Vec::new());
    for line in &canon {
        if line.contains("SET_MOTION_CONTROL_MODE") {
            mode = match line {
                line if line.contains("EXACT_PATH") => 'E',
                line if line.contains("EXACT_STOP") => 'S',
                _ => 'C',
            };
        }
        let ends = ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "RIGID_TAP"];
        if let Some(end) = ends.iter().find_map(|name| numbers(line, name)) {
            if !made.ends_with(mode) {
                made.push(mode);
            }
            depths.push(end[2]);
        }
    }
    (made, depths)
}

/// G64 would round the bottom of a hole away: each motion of a cycle is made on the exact path, the
/// ones between its places too where it is modal, and corners are rounded again behind it.
#[test]
fn cycles_run_on_the_exact_path() {
    let mut cases: Vec<(&str, &str, String, &str)> = Vec::new();
    for cycle in [
        "CYCLE81(5,0,1,-7)",
        "CYCLE82(5,0,1,-7,,1)",
        "CYCLE83(5,0,1,-7,,-3,,0,0,0,1,1)",
        "CYCLE84(5,0,1,-7,,0,3,,1,0,300,300)",
        "CYCLE840(5,0,1,-7,,0,4,3,0,,1)",
        "CYCLE85(5,0,1,-7,,0,100,200)",
        "CYCLE86(5,0,1,-7,,0,3,1,1,1,0)",
        "CYCLE87(5,0,1,-7)",
        "CYCLE88(5,0,1,-7)",
        "CYCLE89(5,0,1,-7,,1)",
    ] {
        let head = "T1 M6\nS300 M3\nF200\nG64\nG0 X0 Y0 Z9\n";
        let tail = "G1 X9 Y9\nM30\n";
        cases.push((
            "sinumerik",
            "part.mpf",
            format!("{head}{cycle}\n{tail}"),
            "CEC",
        ));
        cases.push((
            "sinumerik",
            "part.mpf",
            format!("{head}MCALL {cycle}\nX3\nG64 X4\nMCALL\n{tail}"),
            "CEC",
        ));
        cases.push((
            "sinumerik",
            "part.mpf",
            format!("{head}G60\n{cycle}\n{tail}"),
            "CS",
        ));
    }
    for cycle in [
        "G81 X0 Y0 Z1 I-7",
        "G82 X0 Y0 Z1 I-7 K10",
        "G83 X0 Y0 Z1 I-4 J2",
        "G84 X0 Y0 Z1 I-7",
        "G84 R1 X0 Y0 Z1 I-7",
        "G85 X0 Y0 Z1 I-7",
        "G86 X0 Y0 Z1 I-7",
        "G89 X0 Y0 Z1 I-7",
    ] {
        cases.push((
            "fagor",
            "part.pim",
            format!(
                "T1 M6\nS300 M3\nF200\nG05\nG0 X1 Y1 Z9\n{cycle}\nX3\nG05 X4\nG80\nG1 X9 Y9\nM30\n"
            ),
            "CEC",
        ));
    }
    for cycle in [
        "G73 X0 Y0 Z-7. R1. Q3.",
        "M4\nG74 X0 Y0 Z-7. R1. F300.",
        "G76 X0 Y0 Z-7. R1. I.5 J0",
        "G81 X0 Y0 Z-7. R1.",
        "G82 X0 Y0 Z-7. R1. P1000",
        "G83 X0 Y0 Z-7. R1. Q3.",
        "G84 X0 Y0 Z-7. R1. F300.",
        "M29 S300\nG84 X0 Y0 Z-7. R1. F300.",
        "G84.2 X0 Y0 Z-7. R1. F300. S300",
        "G85 X0 Y0 Z-7. R1.",
        "G86 X0 Y0 Z-7. R1.",
        "G89 X0 Y0 Z-7. R1. P1000",
    ] {
        let head = "O1\nT1 M6\nS300 M3\nF200.\nG64\nG0 X1. Y1. Z9.\n";
        for (between, expected) in [
            ("X3.\nG80", "CEC"),
            ("X3.\nG64 X4.\nG80", "CEC"),
            ("G61 X3.\nG80", "CES"),
        ] {
            cases.push((
                "fanuc",
                "part.nc",
                format!("{head}{cycle}\n{between}\nG1 X9. Y9. F200.\nM30\n"),
                expected,
            ));
        }
    }
    cases.push((
        "sinumerik",
        "part.mpf",
        "S300 M3\nG64\nG0 X0 Y0 Z9\nG63 Z-7 F300\nG1 X9\nM30\n".to_string(),
        "CEC",
    ));
    for (dialect, name, program, expected) in cases {
        let (made, depths) = moves(dialect, name, &program);
        assert_eq!(made, expected, "{program}");
        assert!(depths.contains(&-7.0), "{program}: {depths:?}");
    }
}
