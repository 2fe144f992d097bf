//! What `--json` prints.

use crate::fields::assert_documented;
use crate::support::{Bench, STOCK, json};
use crate::table::table;

/// Short and with rests: G61.1 and G64 with P.
const PROGRAM: &str = "G21 G61.1 F3000\nG1 X4\nG64 P0.1\nY4\nX8\nM2\n";

/// What is left of the helices without their turns is flat: LinuxCNC runs it as lines.
const HELIX: &str = "G21 G17 G90 F1000\nG1 X3 Y0 Z0\nG64 P0.01\nG3 X2.9886 Y0.2615 Z-5 I-3 J0 P3\nG1 X3 Y0\n\
                     G3 X2.9886 Y0.2615 Z-9 I-3 J0 P2\nM2\n";

#[test]
fn turns_that_linuxcnc_leaves_away_have_a_field() {
    let bench = Bench::new();
    let left_away = |program: &str| {
        let figures = bench.measure(program, STOCK.as_ref(), &[]);
        figures.get("turns_left_away").cloned()
    };
    let found = left_away(HELIX).expect("turns that are left away");
    assert_eq!(found, serde_json::json!({"arcs": 2, "line": 4, "turns": 2}));
    assert_eq!(left_away(PROGRAM), None);
}

#[test]
fn fields_are_documented() {
    let bench = Bench::new();
    let file = bench.write("program.ngc", PROGRAM);
    let modules = [
        bench.module("TAKES_JERK"),
        bench.module("STANDS"),
        bench.write("none.so", "this is no module"),
    ];
    let [file, takes_jerk, stands, none] = std::array::from_fn(|index| {
        let path = [&file].into_iter().chain(&modules).nth(index);
        path.expect("a path").display().to_string()
    });
    let all = |options: &[&str]| {
        let program = [file.as_str(), "--json", "--with", STOCK];
        json(&bench.compare(&[&program, options].concat()))
    };
    let jerk = "unlimited,20000,20A";
    let with = ["--with", &takes_jerk, "--with", &stands, "--with", &none];
    let modules = all(&[&with[..], &["--jerk", jerk]].concat());
    let optimum = all(&["--optimum", "--holds", "1"]);
    let rests = bench.write("rests.ngc", "G21 G61.1 F3000\nG1 X4\nM2\n");
    let tube = all(&["--tube", &rests.display().to_string()]);
    let helix = bench.write("helix.ngc", HELIX).display().to_string();
    let turns = all(&[helix.as_str()]);
    let operator = all(&[
        "--feed-at-least",
        "600",
        "--feed-override",
        "0.1:0.5",
        "--pause",
        "0.2:0.1",
        "--max-velocity",
        "0.3:10",
        "--abort",
        "0.4",
    ]);
    table(&bench, "mm", 1.0);
    let ini = bench.path().join("table.ini");
    let joints = all(&["--ini", ini.to_str().expect("text")]);
    assert_documented(
        "compare",
        &[modules, optimum, tube, turns, operator, joints],
    );
}
