//! G40 takes effect with the next motion in the plane, as on the other controls: LinuxCNC would leave the compensated
//! path sideways on the way up.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, refused};

/// A contour with its tool on the left that ends at X0 Y20 in the depth.
const CONTOUR: &str =
    "T1 M6 D1\nG70 F300 G0 X0 Y-30 Z5\nG1 Z-20\nG41 X0 Y0\nY40\nX40\nY0\nX0\nY20\n";

/// Where the tool goes behind the contour, rapid or not.
fn behind(exit: &str, backend: &str) -> Vec<[f64; 3]> {
    let program = format!("{CONTOUR}{exit}\nM30\n");
    let shop = Shop::new(&[("part", program.as_bytes())]);
    let output = accepted(&shop.run("part", &["--machine-in-inch", "--backend", backend]));
    let canon = rs274::interpret(&shop.path(""), "T1 P1 Z1 D8\n", &output);
    let moves = canon.iter().filter_map(|line| {
        let ends = numbers(line, "STRAIGHT_FEED").or(numbers(line, "STRAIGHT_TRAVERSE"))?;
        Some([ends[0], ends[1], ends[2]])
    });
    let at_end = |end: &[f64; 3]| *end == [-4.0, 20.0, -20.0];
    moves.skip_while(|end| !at_end(end)).skip(1).collect()
}

#[test]
fn the_tool_goes_straight_up_first() {
    for (exit, expected) in [
        (
            "G40\nG0 Z50\nX100",
            &[[-4.0, 20.0, 50.0], [100.0, 20.0, 50.0]][..],
        ),
        (
            "G40 G0 Z50\nX100 Y0",
            &[[-4.0, 20.0, 50.0], [100.0, 0.0, 50.0]],
        ),
        (
            "G40\nM9\nG1 Z5\nM5\nG0 Z50\nY90",
            &[[-4.0, 20.0, 5.0], [-4.0, 20.0, 50.0], [0.0, 90.0, 50.0]],
        ),
        ("G40 X-30", &[[-30.0, 20.0, -20.0]]),
        // The path mode and the overrides that LinuxCNC takes behind G40 only.
        (
            "G40 G64\nG0 Z50\nX100",
            &[[-4.0, 20.0, 50.0], [100.0, 20.0, 50.0]],
        ),
        ("G40\nG0 Z50", &[[-4.0, 20.0, 50.0]]),
        (
            "G40\nG0 Z50\nT1 M6\nG0 X5 Y5",
            &[[-4.0, 20.0, 50.0], [5.0, 5.0, 50.0]],
        ),
        (
            "G40\nG0 Z50\nTRANS X1\nG0 X5 Y5",
            &[[-4.0, 20.0, 50.0], [6.0, 5.0, 50.0]],
        ),
    ] {
        assert_eq!(behind(exit, "program"), expected, "{exit}");
    }
    assert_eq!(
        behind("G40\nG0 Z50\nX100", "kinematics"),
        [[-4.0, 20.0, 50.0], [100.0, 20.0, 50.0]]
    );
}

#[test]
fn a_way_sideways_in_the_depth_is_refused() {
    for (exit, line) in [
        ("G40\nSUPA G0 Z0", "11:1"),
        ("G40\nG54\nG0 Z50", "11:1"),
        ("G40\nTRANS X1\nG0 Z50", "11:1"),
    ] {
        let program = format!("{CONTOUR}{exit}\nM30\n");
        let shop = Shop::new(&[("part", program.as_bytes())]);
        let shown = refused(&shop.run("part", &["--backend", "program"]));
        assert!(
            shown.contains("would go sideways into the contour"),
            "{exit}\n{shown}"
        );
        assert!(shown.contains(&format!("part:{line}")), "{exit}\n{shown}");
    }
}

/// An arc stays refused, with a way up between.
#[test]
fn an_arc_behind_the_way_up_is_refused() {
    let program = format!("{CONTOUR}G40\nG0 Z50\nG2 X20 Y40 I20 J0\nM30\n");
    let shop = Shop::new(&[("part", program.as_bytes())]);
    let shown = refused(&shop.run("part", &[]));
    assert!(
        shown.contains("an arc is the first motion behind the end"),
        "{shown}"
    );
}

/// LinuxCNC reads no place while it leaves the path.
#[test]
fn an_increment_from_an_unknown_place_is_refused_with_g40() {
    for exit in ["G91 G40 X10. Z5.", "G40\nG91 Z5.\nX10."] {
        let program =
            format!("O1\nT1 M6\nG90 G54 G0 X0 Y0\nG41 D1 G1 X20. F100.\nY50.\n{exit}\nM30\n");
        let shop = Shop::new(&[("part", program.as_bytes())]);
        let shown = refused(&shop.run_in("fanuc", "part", &["--machine-in-inch"]));
        let words = "where cutter compensation ends, from a place that is not known";
        assert!(shown.contains(words), "{exit}\n{shown}");
    }
}
