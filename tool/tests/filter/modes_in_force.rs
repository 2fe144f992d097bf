//! Modes that are in force already, and the end of cutter compensation.

use crate::one_error::assert_one_error;
use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, refused};

/// The program of each dialect, with its line of a tool in front and its end behind.
fn programs(body: &str) -> [(&'static str, &'static str, String); 5] {
    let fanuc = body.replace("G41", "G41 D1").replace("G42", "G42 D1");
    [
        ("sinumerik", "part.mpf", format!("T1 D1 M6\n{body}M30\n")),
        ("fagor", "part.pim", format!("T1 D1 M6\n{body}M30\n")),
        ("mefi", "part.nc", format!("T1 D1 M6\n{body}M30\n")),
        ("isg", "part.nc", format!("T1 D1 M6\n{body}M30\n")),
        ("fanuc", "part.nc", format!("T1 M6\n{fanuc}M30\n")),
    ]
}

/// Where LinuxCNC moves to with feed, of each dialect.
fn ends(body: &str) -> Vec<(String, Vec<[f64; 2]>)> {
    let run = |(dialect, name, program): (&str, &str, String)| {
        let shop = Shop::new(&[(name, program.as_bytes())]);
        let output = accepted(&shop.run_in(dialect, name, &["--backend", "program"]));
        let canon = rs274::interpret(&shop.path(""), "T1 P1 Z0 D0.1\n", &output);
        let end = |line: &String| numbers(line, "STRAIGHT_FEED").map(|end| [end[0], end[1]]);
        (program, canon.iter().filter_map(end).collect())
    };
    programs(body).into_iter().map(run).collect()
}

/// LinuxCNC forgets F with each G94.
#[test]
fn the_feed_stays_where_its_mode_is_said_again() {
    let body = "G90 G94 F100.\nG0 X0. Y0. Z0.\nG1 X1.\nG94\nX2.\nG94 G1 X3.\n";
    for (program, ends) in ends(body) {
        assert_eq!(ends, [[1.0, 0.0], [2.0, 0.0], [3.0, 0.0]], "{program}");
    }
}

/// LinuxCNC cannot switch on a compensation that is on.
#[test]
fn compensation_is_switched_on_once() {
    let begin = "G90 G94 F100.\nG0 X0. Y0. Z0.\nG41 G1 X20. Y0.\n";
    for (program, ends) in ends(&format!("{begin}G41 X40.\nG40 X60.\n")) {
        assert_eq!(ends, [[20.0, 1.27], [40.0, 1.27], [60.0, 0.0]], "{program}");
    }
    for (dialect, name, program) in programs(&format!("{begin}G42 X60. Y10.\nG40 X100.\n")) {
        let shop = Shop::new(&[(name, program.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, name, &["--backend", "program"]));
        assert!(shown.contains("the other side while cutter"), "{shown}");
        assert!(shown.contains("G40 before"), "{shown}");
        assert!(shown.contains(&format!("{name}:5:1")), "{shown}");
    }
}

/// LinuxCNC leaves the compensated path on a straight line.
#[test]
fn no_arc_is_the_first_motion_behind_compensation() {
    let begin = "G90 G94 F100.\nG0 X0. Y0. Z0.\nG41 G1 X20. Y0.\nX40.\n";
    let arc = "G2 X60. Y0. I10. J0.";
    for (end, line) in [
        (format!("G40 {arc}"), 6),
        (format!("G40\n{arc}"), 7),
        (format!("G40\nM8\nF50.\n{arc}"), 9),
    ] {
        for (dialect, name, program) in programs(&format!("{begin}{end}\n")) {
            let shop = Shop::new(&[(name, program.as_bytes())]);
            for backend in ["program", "kinematics"] {
                let shown = refused(&shop.run_in(dialect, name, &["--backend", backend]));
                let place = format!("{name}:{line}:1");
                assert_one_error(&shown, &program, &place, "an arc is the first motion");
            }
        }
    }
    let straight = "G40 G1 X50.\nG2 X60. Y0. I5. J0.\nG1 X70.\n";
    for (program, ends) in ends(&format!("{begin}{straight}")) {
        assert_eq!(ends.last(), Some(&[70.0, 0.0]), "{program}");
    }
}
