//! G41 and G42 take effect with the first motion that leads elsewhere in the plane: LinuxCNC would begin with a plunge,
//! and stop.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, refused};

/// Where the tool, of the radius 4, goes with feed.
fn feeds(dialect: &str, program: &str, backend: &str) -> Vec<[f64; 3]> {
    let shop = Shop::new(&[("part", program.as_bytes())]);
    let options = ["--machine-in-inch", "--backend", backend];
    let output = accepted(&shop.run_in(dialect, "part", &options));
    let canon = rs274::interpret(&shop.path(""), "T1 P1 Z0 D8\n", &output);
    let ends = canon
        .iter()
        .filter_map(|line| numbers(line, "STRAIGHT_FEED"));
    ends.map(|end| [end[0], end[1], end[2]]).collect()
}

/// A contour along X20, with what stands between G41 and the way onto it.
fn program(dialect: &str, between: &str) -> String {
    let head = match dialect {
        "fanuc" => "O1\nT1 M6\n",
        "isg" => "%M\nG70\nT1 M6\nD1\n",
        "mefi" => "%1\nT1 M6\nD1\n",
        "sinumerik" => "T1 M6\nD1\nG70\n",
        _ => "%P,MX--,\nT1 D1 M6\nG43\n",
    };
    format!("{head}G90 G54 G0 X0 Y0 Z20\nF100\n{between}\nG1 X20 Y0\nX40 Y-30\nX60\nG40 X80\nM30\n")
}

#[test]
fn a_plunge_comes_before_the_way_onto_the_contour() {
    let betweens = [
        "G41\nG0 Z2\nG1 Z-5",
        "G41 G1 Z-5",
        "G41 G1 X0 Y0\nZ-5",
        "G1 Z-5\nG41",
    ];
    for dialect in ["sinumerik", "isg", "mefi", "fanuc"] {
        for backend in ["program", "kinematics"] {
            for between in betweens {
                let mut text = program(dialect, between);
                if dialect == "fanuc" {
                    text = text.replace("G41", "G41 D1");
                    for number in ["X20", "X40", "Y-30", "X60", "X80", "Z-5", "Z20", "Z2\n"] {
                        let pointed = format!("{}.", number.trim_end());
                        text = text.replace(number, &number.replace(number.trim_end(), &pointed));
                    }
                }
                let mut found = feeds(dialect, &text, backend);
                found.retain(|end| *end != [0.0, 0.0, 20.0]);
                assert_eq!(found[0], [0.0, 0.0, -5.0], "{text}\n{found:?}");
                // Round the start, which turns away from the tool: beside it, at right angles to the way onto it.
                assert_eq!(found[1], [20.0, 4.0, -5.0], "{text}\n{found:?}");
            }
        }
    }
}

/// What has not begun ends without a trace: an arc may follow.
#[test]
fn without_a_motion_in_the_plane_nothing_is_compensated() {
    for way in ["G1 X20", "G2 X10 I5 J0\nG1 X20"] {
        let program =
            format!("T1 M6\nD1\nG70 G90 G54 G0 X0 Y0 Z20\nG41\nG1 Z-5 F100\nG40\n{way}\nM30\n");
        let found = feeds("sinumerik", &program, "program");
        assert_eq!(found, [[0.0, 0.0, -5.0], [20.0, 0.0, -5.0]], "{way}");
    }
}

/// A Fagor steps aside where the tool stands.
#[test]
fn fagor_is_refused() {
    for between in ["G41\nG0 Z2\nG1 Z-5", "G41 G1 Z-5", "G41 G1 X0 Y0"] {
        let text = program("fagor", between);
        let shop = Shop::new(&[("part", text.as_bytes())]);
        let shown = refused(&shop.run_in("fagor", "part", &["--machine-in-inch"]));
        assert!(
            shown.contains(
                "the first motion behind G41 or G42 does not lead elsewhere in the plane"
            ),
            "{text}\n{shown}"
        );
    }
}
