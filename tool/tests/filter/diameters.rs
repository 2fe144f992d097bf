//! X of what is written is a radius, on lathes whose startup code makes a diameter of it (G7), too.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted};

/// X of each rapid move that LinuxCNC makes of the program behind G7 or G8.
fn rapids(shop: &Shop, before: &str, program: &str) -> Vec<f64> {
    let canon = rs274::interpret(
        &shop.path(""),
        "T1 P1 D6\n",
        &format!("{before}\n{program}"),
    );
    let ends = canon
        .iter()
        .filter_map(|line| numbers(line, "STRAIGHT_TRAVERSE"));
    ends.map(|end| end[0]).collect()
}

#[test]
fn diameters_that_are_in_force_before_halve_nothing() {
    for (dialect, program, x) in [
        ("sinumerik", "DIAMON\nG0 X40 Z5\nM30\n", 20.0),
        ("sinumerik", "G0 X40 Z5\nM30\n", 40.0),
        ("fagor", "G0 X40 Z5\nM30\n", 40.0),
        ("mefi", "G0 X40 Z5\nM30\n", 40.0),
        ("isg", "G0 X40 Z5\nM30\n", 40.0),
        ("fanuc", "G0 X40. Z5.\nM30\n", 40.0),
    ] {
        let shop = Shop::new(&[("part.nc", program.as_bytes())]);
        for backend in ["kinematics", "program"] {
            let output = accepted(&shop.run_in(dialect, "part.nc", &["--backend", backend]));
            for before in ["G7", "G8"] {
                assert_eq!(rapids(&shop, before, &output), [x], "{dialect}, {before}");
            }
        }
    }
}

#[test]
fn what_x_was_before_it_is_again_at_the_end_on_machines_with_diameters() {
    let startup = |codes: &str| format!("[RS274NGC]\nRS274NGC_STARTUP_CODE = {codes}\n");
    let mill = "[TRAJ]\nCOORDINATES = X Y Z\n";
    for (ini, has_diameters) in [
        ("[TRAJ]\nCOORDINATES = X Z\n".to_string(), true),
        ("[DISPLAY]\nLATHE = 1\n".to_string(), true),
        (mill.to_string() + &startup("G21 g07 G90"), true),
        (mill.to_string() + &startup("G7F100"), true),
        (mill.to_string() + &startup("G21 G73.1 G70 G8 G90"), false),
        (mill.to_string(), false),
    ] {
        let program = "DIAMON\nG0 X40 Z5\nM30\n".as_bytes();
        let shop = Shop::new(&[("part.mpf", program), ("shop.ini", ini.as_bytes())]);
        for backend in ["kinematics", "program"] {
            let output =
                accepted(&shop.run("part.mpf", &["--backend", backend, "--ini", "shop.ini"]));
            // Behind the end of the program nothing is read: another move stands in its place.
            let goes_on = output.replace("M30", "G0 X10\nM2");
            assert_ne!(goes_on, output);
            let behind = if has_diameters { 5.0 } else { 10.0 };
            assert_eq!(rapids(&shop, "G7", &goes_on), [20.0, behind], "{ini}");
            assert_eq!(rapids(&shop, "G8", &goes_on), [20.0, 10.0], "{ini}");
        }
    }
}
