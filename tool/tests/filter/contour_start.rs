//! Where a compensated contour turns towards the tool at its start, LinuxCNC begins it beside its start, as the other
//! controls do. The machine is one in inches, as LinuxCNC's interpreter is without a machine: the numbers of its tool
//! table are those of the programs.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, commands, refused};

/// A tool of the radius 4.
const TOOLS: &str = "T1 P1 Z1 D8\nT7 P7 Z1 D8\n";

/// Where the tool goes with feed.
fn feeds(dialect: &str, program: &str, backend: &str) -> Vec<[f64; 3]> {
    let ini = "[EMCIO]\nTOOL_TABLE = tool.tbl\n[TRAJ]\nLINEAR_UNITS = inch\n";
    let files = [("part", program), ("machine.ini", ini), ("tool.tbl", TOOLS)];
    let shop = Shop::new(&files.map(|(name, text)| (name, text.as_bytes())));
    let options = [
        "--machine-in-inch",
        "--ini",
        "machine.ini",
        "--backend",
        backend,
    ];
    let output = accepted(&shop.run_in(dialect, "part", &options));
    let canon = rs274::interpret(&shop.path(""), TOOLS, &output);
    let ends = canon
        .iter()
        .filter_map(|line| numbers(line, "STRAIGHT_FEED"));
    ends.map(|end| [end[0], end[1], end[2]]).collect()
}

fn assert_begins(found: &[[f64; 3]], expected: &[[f64; 3]], what: &str) {
    let mut near = found.iter().zip(expected);
    let same = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3);
    assert!(
        found.len() >= expected.len() && near.all(same),
        "{what}\n{found:?}\n{expected:?}"
    );
}

/// The motions with feed of a Sinumerik program that leads onto a contour.
fn contour(way: &str, backend: &str) -> Vec<[f64; 3]> {
    let program = format!("T1 M6 D1\nG70 F300\n{way}\nG40 X60 Y-60\nM30\n");
    feeds("sinumerik", &program, backend)
}

/// From behind, from beside, from ahead of the start: always straight to beside it.
#[test]
fn the_tool_comes_straight_to_beside_the_start() {
    for (from, onto, first, expected) in [
        (
            "X-10 Y-10",
            "G41",
            "Y20",
            [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]],
        ),
        (
            "X-20 Y15",
            "G41",
            "Y20",
            [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]],
        ),
        (
            "X-30 Y10",
            "G41",
            "Y40",
            [[-4.0, 0.0, 5.0], [-4.0, 40.0, 5.0]],
        ),
        (
            "X-10 Y30",
            "G41",
            "Y20",
            [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]],
        ),
        (
            "X-10 Y0",
            "G41",
            "Y20",
            [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]],
        ),
        (
            "X10 Y-10",
            "G42",
            "Y20",
            [[4.0, 0.0, 5.0], [4.0, 16.0, 5.0]],
        ),
        // An arc, onto which a short line leads.
        (
            "X-10 Y-10",
            "G41",
            "G2 X20 Y20 I20 J0",
            [[-4.0, -0.001, 5.0], [-4.0, 0.0, 5.0]],
        ),
        // Down beside the start.
        (
            "X-10 Y-10",
            "G41",
            "Z-5\nM8\nY20",
            [[-4.0, 0.0, 5.0], [-4.0, 0.0, -5.0]],
        ),
    ] {
        for backend in ["program", "kinematics"] {
            let way = format!("G0 {from} Z5\nG1 {onto} X0 Y0\n{first}\nG1 X60");
            assert_begins(&contour(&way, backend), &expected, &way);
        }
    }
}

/// Frames that are worked into the coordinates, the other plane, and KONT.
#[test]
fn frames_and_planes_have_it_too() {
    for (way, expected) in [
        (
            "ROT RPL=90\nG0 X-10 Y-10 Z5\nG1 G41 X0 Y0\nY20\nX60",
            [[0.0, -4.0, 5.0], [-20.0, -4.0, 5.0]],
        ),
        (
            "MIRROR X0\nG0 X-10 Y-10 Z5\nG1 G41 X0 Y0\nY20\nX60",
            [[4.0, 0.0, 5.0], [4.0, 20.0, 5.0]],
        ),
        (
            "SCALE X2 Y2\nG0 X-10 Y-10 Z5\nG1 G41 X0 Y0\nY20\nX60",
            [[-4.0, 0.0, 5.0], [-4.0, 40.0, 5.0]],
        ),
        (
            "KONT\nG0 X-10 Y-10 Z5\nG1 G41 X0 Y0\nY20\nX60",
            [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]],
        ),
        (
            "G18 G0 Z-10 X-10 Y5\nG1 G41 Z0 X0\nX20\nZ60",
            [[0.0, 5.0, -4.0], [20.0, 5.0, -4.0]],
        ),
    ] {
        let program = format!("T1 M6 D1\nG70 F300\n{way}\nG40 X90\nM30\n");
        assert_begins(&feeds("sinumerik", &program, "program"), &expected, way);
    }
}

#[test]
fn all_dialects_begin_there() {
    for (dialect, program) in [
        (
            "fagor",
            "%X,MX--,\nN1 G90 G17 G70 G94 G40\nN2 T1 D1 M6\nN3 G43 F100\nN4 G0 X-10 Y-10 Z5\nN5 G41 G1 X0 Y0\n\
             N6 Y20\nN7 X60\nN8 G40 Y-60\nN9 M30\n",
        ),
        (
            "fanuc",
            "O1\nG20 G90 G17 T1 M6\nG0 G54 X-10. Y-10. F100.\nZ5.\nG41 D1 G1 X0. Y0.\nY20.\nX60.\nG40 Y-60.\nM30\n",
        ),
        // The diameter in another row is read from the tool table.
        (
            "fanuc",
            "O1\nG20 G90 G17 T1 M6\nG0 G54 X-10. Y-10. F100.\nZ5.\nG41 D7 G1 X0. Y0.\nY20.\nX60.\nG40 Y-60.\nM30\n",
        ),
        (
            "isg",
            "N1 G17 G90 G94 F500\nN2 T1 D1 M6\nN3 G0 X-10 Y-10 Z5\nN4 G41 G1 X0 Y0\nN5 Y20\nN6 X60\nN7 G40 Y-60\nN8 M30\n",
        ),
        (
            "mefi",
            "T1 M6\nD1\nF100\nG00 X-10 Y-10 Z5\nG01 X0 Y0 G41\nG01 X0 Y20\nG01 X60 Y20\nG01 X60 Y-60 G40\nM30\n",
        ),
    ] {
        let expected = [[-4.0, 0.0, 5.0], [-4.0, 20.0, 5.0]];
        assert_begins(&feeds(dialect, program, "program"), &expected, program);
    }
}

/// Where the contour turns away from the tool, LinuxCNC goes round its start.
#[test]
fn other_contours_are_written_as_they_are() {
    for from in ["X10 Y-10", "X0 Y-10", "X10 Y10"] {
        let program = format!("T1 M6 D1\nF300 G0 {from} Z5\nG1 G41 X0 Y0\nY20\nG40 X-60\nM30\n");
        let shop = Shop::new(&[("part", program.as_bytes())]);
        let output = accepted(&shop.run("part", &["--backend", "program"]));
        assert!(
            commands(&output).contains(&"G41 G1 X0 Y0".to_string()),
            "{output}"
        );
        assert!(!output.contains("#5410"), "{output}");
    }
}

/// Too near for the tool in the spindle: LinuxCNC says so before anything moves there.
#[test]
fn a_way_from_too_near_is_an_error_of_the_program() {
    for from in ["X-7 Y0", "X-7 Y2"] {
        let program = format!("T1 M6 D1\nF300 G0 {from}\nG1 G41 X0 Y0\nY20\nG40 X-60\nM30\n");
        let shop = Shop::new(&[("part", program.as_bytes())]);
        let output = accepted(&shop.run("part", &["--machine-in-inch", "--backend", "program"]));
        rs274::run(&shop.path(""), TOOLS, &output);
        let said = std::fs::read_to_string(shop.path("errors.txt")).expect("a file");
        let words = "begins too near: it takes tools of less than 7";
        assert!(said.contains(words), "{said}");
    }
}

/// What is left of a flat way must be longer than the radius, which is 4: LinuxCNC would stop in the middle of the
/// program.
#[test]
fn a_way_whose_rest_is_shorter_than_the_radius_is_one_from_too_near() {
    let way = |from: &str| format!("T1 M6 D1\nF300 G0 {from}\nG1 G41 X0 Y0\nY20\nG40 X-60\nM30\n");
    let arc = |from: &str| way(from).replace("\nY20", "\nG3 X-40 Y0 I-20 J0\nG1 Y-20");
    let mut refusals = 0;
    for behind in [1.0, 3.0, 5.0, 8.0, 10.0, 14.0, 20.0] {
        for beside in [0.5, 1.0, 1.9, 3.0, 4.5, 6.0, 9.0] {
            for program in [
                way(&format!("X-{beside} Y-{behind}")),
                arc(&format!("X-{beside} Y-{behind}")),
            ] {
                let shop = Shop::new(&[("part", program.as_bytes())]);
                let output =
                    accepted(&shop.run("part", &["--machine-in-inch", "--backend", "program"]));
                rs274::run(&shop.path(""), TOOLS, &output);
                let said = std::fs::read_to_string(shop.path("errors.txt")).unwrap_or_default();
                // rs274 by itself goes on behind an error.
                let refused = said.contains("begins too near");
                refusals += usize::from(refused);
                assert!(refused || !said.contains("entry move"), "{program}{said}");
            }
        }
    }
    assert!((1..98).contains(&refusals), "{refusals}");
}

#[test]
fn what_cannot_be_written_is_refused() {
    let head = "O1\nG21 G90 G17 T1 M6\nG0 G54 X-10. Y-10. F100.\nZ5.\n";
    for (onto, first, words, line) in [
        (
            "G41 D7 G1 X0. Y0.",
            "Y20.",
            "the way onto this contour needs the diameter of T7",
            "5:1",
        ),
        (
            "G93 G41 D1 G1 X0. Y0. F5.",
            "G2 X20. Y20. R20. F5.",
            "feed in inverse time (G93)",
            "5:1",
        ),
        (
            "G41 D1 G2 X0. Y0. R10.",
            "X20. Y20. R20.",
            "an arc leads onto the contour",
            "5:1",
        ),
    ] {
        let text = format!("{head}{onto}\n{first}\nG40 G1 X60. F5.\nM30\n");
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in("fanuc", "part", &["--backend", "program"]));
        assert!(shown.contains(words), "{text}\n{shown}");
        assert!(shown.contains(&format!("part:{line}")), "{text}\n{shown}");
    }
}

/// Posts lead the tool over the start before they switch its length on, which moves Z alone on mills.
#[test]
fn the_length_of_the_tool_leaves_the_start_known() {
    for way in [
        "G0 X0 Y-10\nD1 Z5\nG41 G1 Y0\nX-20\nY60",
        "AROT Z90\nG0 X-10 Y0\nD1 Z5\nG41 G1 X0\nY20\nX60",
    ] {
        let program = format!("T1 M6\nG70 F300\n{way}\nG40 X90 Y90\nM30\n");
        let found = feeds("sinumerik", &program, "program");
        assert_begins(&found, &[[0.0, -4.0, 5.0], [-20.0, -4.0, 5.0]], way);
    }
}

/// Where the tool comes from may not be known ahead of time.
#[test]
fn an_unknown_start_is_told() {
    let program = "T1 M6 D1\nF300\nG1 G41 X0 Y0\nY20\nG40 X-60\nM30\n";
    let shop = Shop::new(&[("part", program.as_bytes())]);
    let output = accepted(&shop.run("part", &["--backend", "program"]));
    let words = "line 3: whether LinuxCNC begins this contour beside its start is not known";
    assert!(output.contains(words), "{output}");
}
