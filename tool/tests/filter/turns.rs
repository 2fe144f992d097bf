//! Arcs of several turns under G64: LinuxCNC would leave the turns away where the rest of the arc is flat.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, commands, refused, translate};

/// A thread that is milled with a little more than two turns.
const THREAD: &str = "G3 X2.9886 Y0.2615 Z-5 I=AC(0) J=AC(0) TURN=2";

fn program(words: &str, arc: &str) -> String {
    format!("G17 G90 {words}\nF1000\nG0 X3 Y0 Z0\nG1 Z-1\n{arc}\nG1 X0\nM30\n")
}

/// End, centre, turns and height of each arc that LinuxCNC makes of a program, with a tool of 2 mm.
fn arcs(program: &str, arguments: &[&str]) -> Vec<[f64; 6]> {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", arguments));
    let canon = rs274::interpret(&shop.path(""), "T1 P1 Z0.5 D0.0787402\n", &output);
    let arcs = canon.iter().filter_map(|line| numbers(line, "ARC_FEED"));
    arcs.map(|found| found[..6].try_into().expect("an arc"))
        .collect()
}

#[test]
fn whole_turns_are_an_arc_of_their_own_where_the_rest_is_flat() {
    for backend in ["program", "kinematics"] {
        let found = arcs(&program("G64", THREAD), &["--backend", backend]);
        let [turns, rest] = &found[..] else {
            panic!("{found:?}");
        };
        let expected = [3.0, 0.0, 0.0, 0.0, 2.0];
        let apart = turns.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-3, "{backend}: {turns:?}");
        // Two turns of 720 and 5 degrees.
        assert!((turns[5] + 1.0 + 4.0 * 720.0 / 725.0).abs() < 1e-3);
        assert_eq!(rest[..2], [2.9886, 0.2615], "{backend}");
        assert_eq!(rest[4..], [1.0, -5.0], "{backend}");
    }
}

#[test]
fn arcs_that_linuxcnc_runs_with_their_turns_stay_one() {
    let half = "G2 X-3 Y0 Z-5 I-3 J0 TURN=2";
    let whole = "G3 X3 Y0 Z-5 I-3 J0 TURN=2";
    for (words, arc) in [
        ("G60", THREAD),
        ("G64", half),
        ("G64", whole),
        ("G64", &format!("G9 {THREAD}")),
        ("G64", "G18 G3 X2.9886 Z-0.7385 Y5 I-3 K0 TURN=2"),
    ] {
        let output = translate(&program(words, arc), &[]);
        let lines = commands(&output);
        let arcs = lines.iter().filter(|line| line.contains(" P3"));
        assert_eq!(arcs.count(), 1, "{output}");
    }
}

/// How large the arc of the tool is, depends on the tool.
#[test]
fn under_compensation_whole_turns_are_always_an_arc_of_their_own() {
    let program = "T1 D1 M6\nG17 G90 G64\nF1000\nG0 X3 Y-5 Z0\nG41 G1 X3 Y0\n\
                   G3 X0 Y3 Z-5 I-3 J0 TURN=2\nG1 X-5\nG40 G1 X-9\nM30\n";
    let found = arcs(program, &[]);
    let turns: Vec<f64> = found.iter().map(|arc| arc[4]).collect();
    assert_eq!(turns, [2.0, 1.0], "{found:?}");
    assert!((found[0][0] - 2.0).abs() < 1e-3 && found[0][1].abs() < 1e-3);
}

#[test]
fn a_rest_that_is_next_to_nothing_is_a_line() {
    let arc = "G3 X3 Y0.0001 Z-5 I-3 J0 TURN=2";
    let found = arcs(&program("G64", arc), &[]);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0][4], 2.0);
}

#[test]
fn turns_that_cannot_be_written_apart_are_refused() {
    for (program, reason) in [
        (
            format!("G17 G64\nF1000\n{THREAD}\nM30\n"),
            "its start is not known ahead of time",
        ),
        (
            program("G64", &format!("G93 F2 {THREAD}\nG94 F1000")),
            "feed in inverse time",
        ),
    ] {
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(shown.contains(reason), "{shown}");
    }
}
