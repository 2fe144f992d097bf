//! What LinuxCNC cannot do while it compensates the radius of the cutter: another path mode, overrides, cycles.

use crate::rs274;
use crate::shop::{Shop, accepted, commands, refused};

const SINUMERIK: &str = "T1 D1 M6\nG17 G90 G94 G0 X-20 Y-20 Z10 F500\n";
const FAGOR: &str =
    "%X,MX--,\nN1 G90 G17 G71 G94 G40\nN2 T1 D1 M6\nN3 G43 F100\nN4 G0 X-20 Y-20 Z10\n";
const FANUC: &str = "O1\nG21 G90 G17 T1 M6\nG0 G54 X-20. Y-20. F100.\nG43 H1 Z10.\n";
const ISG: &str = "N1 G17 G90 G94 F500\nN2 T1 D1 M6\nN3 G0 X-20 Y-20 Z10\n";

/// A contour of these blocks in a program, with the compensation around it.
fn program(dialect: &str, before: &str, contour: &str) -> String {
    let (head, begin) = match dialect {
        "sinumerik" => (SINUMERIK, "G41 G1 X0 Y0\n"),
        "fagor" => (FAGOR, "G41 G1 X0 Y0\n"),
        "fanuc" => (FANUC, "G41 D1 G1 X0. Y0.\n"),
        _ => (ISG, "G41 G1 X0 Y0\n"),
    };
    format!("{head}{before}\n{begin}{contour}\nG40 X60. Y60.\nX70.\nM30\n")
}

/// The lines from G41 on, which LinuxCNC's interpreter has understood.
fn written(dialect: &str, before: &str, contour: &str) -> Vec<String> {
    let text = program(dialect, before, contour);
    let shop = Shop::new(&[("part", text.as_bytes())]);
    let output = accepted(&shop.run_in(dialect, "part", &["--backend", "program"]));
    rs274::interpret(&shop.path(""), "T1 P1 Z0.4 D0.2\n", &output);
    let lines = commands(&output).into_iter();
    lines
        .skip_while(|line| !line.contains("G41"))
        .skip(1)
        .collect()
}

#[test]
fn an_exact_stop_is_a_dwell_of_no_time() {
    for (dialect, before, contour, expected) in [
        (
            "sinumerik",
            "G64",
            "X20\nG9 X30\nX40",
            &["G1 X20", "G1 X30", "G4 P0", "G1 X40"][..],
        ),
        // The mode that comes back is the one in which the compensation began.
        (
            "sinumerik",
            "G641 ADIS=0.5",
            "G60 X20\nX30 RND=5\nY40\nG641 Y50",
            &[
                "G1 X20",
                "G4 P0",
                "G1 X25 Y0",
                "G4 P0",
                "G3 X30 Y5 I0 J5",
                "G4 P0",
                "G1 X30 Y40",
                "G4 P0",
                "G1 Y50",
            ],
        ),
        (
            "fagor",
            "G5",
            "X20\nG7 X40\nG5 Y20",
            &["G1 X20", "G1 X40", "G4 P0", "G1 Y20"],
        ),
        (
            "fanuc",
            "G64",
            "X20.\nG9 X30.\nG61\nX40.\nG64\nY20.",
            &["G1 X20", "G1 X30", "G4 P0", "G1 X40", "G4 P0", "G1 Y20"],
        ),
        (
            "isg",
            "",
            "X20\nG60 X30\nX40",
            &["G1 X20", "G1 X30", "G4 P0", "G1 X40"],
        ),
        // Where every motion ends at rest anyway, nothing is to be done.
        ("sinumerik", "G60", "X20\nG9 X30", &["G1 X20", "G1 X30"]),
    ] {
        let lines = written(dialect, before, contour);
        assert_eq!(lines[..expected.len()], *expected, "{dialect} {contour}");
        assert!(lines[expected.len()].starts_with("G40"), "{lines:?}");
    }
}

/// The mode that the program has asked for last is in force when the compensation has ended.
#[test]
fn the_path_mode_follows_the_end_of_the_compensation() {
    for (before, contour, mode) in [("G64", "X20\nG60 X30", "G61.1"), ("G60", "X20", "")] {
        let lines = written("sinumerik", before, contour);
        let end = lines.iter().find(|line| line.contains("G40"));
        let end = end.expect("the end of the compensation");
        assert_eq!(end.contains("G6"), !mode.is_empty(), "{end}");
        assert!(end.contains(mode), "{end}");
    }
    // Beside G41 a mode is set before, and beside G40 behind it.
    for (dialect, end) in [
        ("sinumerik", "G641 G40 X30"),
        ("fagor", "G5 G40 X30"),
        ("fanuc", "G64 G40 X30."),
    ] {
        let lines = written(dialect, "", &format!("X20.\n{end}"));
        assert!(lines[1].contains("G40"), "{lines:?}");
        assert!(lines[1].contains("G64 P0.01"), "{lines:?}");
    }
}

#[test]
fn another_path_mode_is_refused() {
    let words = "another way to pass corners while cutter compensation is on";
    for (dialect, before, contour, line) in [
        ("sinumerik", "", "X20\nG64 X30", "6:1"),
        ("sinumerik", "", "X20\nG60 X25\nG642 X30", "7:1"),
        ("sinumerik", "", "CYCLE832(0.1,1)", "5:1"),
        ("sinumerik", "G64", "CTOL=0.05 X30", "5:1"),
        ("fagor", "", "X20\nG5 X30", "9:1"),
        ("fagor", "", "G50 X30", "8:1"),
        ("fagor", "", "G51 A50 E0.02", "8:1"),
        ("fanuc", "", "X20.\nG64\nX30.", "8:1"),
        ("isg", "", "#HSC ON [CONTERROR 0.05]", "6:1"),
        ("isg", "", "G261 X30", "6:1"),
        ("isg", "", "G61 X30", "6:1"),
    ] {
        let text = program(dialect, before, contour);
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part", &[]));
        assert!(shown.contains(words), "{dialect} {contour}\n{shown}");
        assert!(
            shown.contains(&format!("part:{line}")),
            "{contour}\n{shown}"
        );
    }
}

#[test]
fn overrides_and_cycles_are_refused() {
    let overrides = "the overrides are switched while cutter compensation is on";
    let cycle = "a canned cycle while cutter compensation is on";
    for (dialect, contour, words) in [
        ("fanuc", "X20.\nM49\nX30.", overrides),
        ("fanuc", "G81 X30. Z-5. R2.", cycle),
        ("fagor", "G81 X30 Y0 Z2 I-5\nG80", cycle),
        ("fagor", "G83 X30 Y0 Z2 I-5 J2\nG80", cycle),
        ("fagor", "G84 X30 Y0 Z2 I-5 K5\nG80", cycle),
        ("fagor", "G69 X30 Y0 Z2 I-5 B1\nG80", cycle),
    ] {
        let text = program(dialect, "", contour);
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part", &[]));
        assert!(shown.contains(words), "{dialect} {contour}\n{shown}");
    }
    // Nothing is switched where nothing changes.
    let lines = written("fanuc", "", "X20.\nM48\nX30.");
    assert_eq!(lines[..2], ["G1 X20", "G1 X30"]);
}

/// G93: F is the time of a block, and not that of its parts.
#[test]
fn corners_with_feed_in_inverse_time_are_refused() {
    let words = "a rounding or chamfer with feed in inverse time";
    for (dialect, text) in [
        ("sinumerik", "G0 X0 Y0\nG93\nG1 X10 F2 RND=1\nY10 F2\nM30\n"),
        ("sinumerik", "G0 X0 Y0\nG93\nG1 X10 F2 CHF=1\nY10 F2\nM30\n"),
        (
            "sinumerik",
            "G0 X0 Y0\nG93 RNDM=1\nG1 X10 F2\nY10 F2\nM30\n",
        ),
        (
            "fanuc",
            "O1\nG0 X0 Y0\nG93 G1 X10. ,R1. F2.\nY10. F2.\nM30\n",
        ),
        (
            "fanuc",
            "O1\nG0 X0 Y0\nG93 G1 X10. ,C1. F2.\nY10. F2.\nM30\n",
        ),
    ] {
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part", &[]));
        assert!(shown.contains(words), "{text}\n{shown}");
        assert!(shown.contains("part:3:1"), "{text}\n{shown}");
    }
}

/// LinuxCNC ends the compensated path before a stop, as if nothing followed.
#[test]
fn stops_are_refused() {
    for (dialect, stop, place) in [
        ("sinumerik", "Y20 M0", "part:5:5"),
        ("sinumerik", "M1", "part:5:1"),
        ("fagor", "Y20 M0", "part:8:5"),
        ("fagor", "M1", "part:8:1"),
        ("fanuc", "M0", "part:7:1"),
        ("fanuc", "Y20. M01", "part:7:6"),
        ("fanuc", "#3006=1(TURN)", "part:7:1"),
        ("isg", "Y20 M0", "part:6:5"),
    ] {
        let text = program(dialect, "", stop);
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part", &[]));
        let words = "while cutter compensation is on: LinuxCNC ends the compensated path there";
        assert!(shown.contains(words), "{dialect} {stop}\n{shown}");
        assert!(shown.contains(place), "{dialect} {stop}\n{shown}");
    }
    // What LinuxCNC keeps in the order of the path.
    for beside in ["M8", "M3", "S600", "G4 P100"] {
        written("fanuc", "", &format!("Y20.\n{beside}\nX20."));
    }
}

/// Nothing is beside a contour until the first motion in the plane, with which G41 is written.
#[test]
fn stops_before_the_first_motion_in_the_plane_are_kept() {
    for (dialect, begin, stop, kept) in [
        ("sinumerik", "G41", "M1", "M1"),
        ("sinumerik", "G41", "M0", "M0"),
        ("fanuc", "G41 D1", "M01", "M1"),
        ("fanuc", "G41 D1", "G1 Z5. F100. M0", "M0"),
        ("fanuc", "G41 D1", "#3006=1(TURN)", "M0"),
        ("fagor", "G41", "M1", "M1"),
        ("isg", "G41", "M0", "M0"),
    ] {
        let text = program(dialect, &format!("{begin}\n{stop}"), "X20.");
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let output = accepted(&shop.run_in(dialect, "part", &["--backend", "program"]));
        rs274::interpret(&shop.path(""), "T1 P1 Z0.4 D0.2\n", &output);
        let lines = commands(&output);
        let at = |word: &str| lines.iter().position(|line| line.contains(word));
        assert!(at(kept) < at("G41") && at(kept).is_some(), "{output}");
    }
    // Behind G40 and G41 again, as at first; behind a contour that has begun not.
    for (dialect, before, stop) in [
        ("fanuc", "G41 D1\nG1 X-10. Y0.\nG40 X-20.\nG41 D1 M1", ""),
        ("fanuc", "G41 D1\nM1\nG1 X-10. Y0.", "M1"),
    ] {
        let text = program(dialect, before, stop);
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let output = shop.run_in(dialect, "part", &[]);
        match stop.is_empty() {
            true => assert!(accepted(&output).contains("M1")),
            false => assert!(refused(&output).contains("M1 while cutter compensation is on")),
        }
    }
}
