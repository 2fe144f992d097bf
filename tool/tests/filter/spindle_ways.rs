//! How the spindle of the Sinumerik-like dialect turns: the way to its angle, the speeds into a tap and out of it.

use crate::rs274;
use crate::shop::{Shop, accepted, commands, refused, translate};

fn lines(program: &str) -> Vec<String> {
    commands(&translate(program, &["--backend", "program"]))
}

fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &["--backend", "program"]))
}

/// LinuxCNC takes it without an error.
fn interpreted(program: &str) -> Vec<String> {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", &["--backend", "program"]));
    rs274::interpret(&shop.path(""), "T1 P1 D6\n", &output)
}

/// ACP turns as M3 does, ACN as M4; where no way is named it is the shorter one.
#[test]
fn the_spindle_turns_to_its_angle_the_way_that_is_meant() {
    let program = "SPOS=ACP(10)\nSPOS[1]=ACN(370)\nSPOSA=DC(10)\nSPOS=AC(10)\nSPOS=10\nG64 SPOS=ACP(5)\nM30\n";
    assert_eq!(
        lines(program),
        [
            "M19 R10 P1",
            "M19 R10 P2",
            "M19 R10",
            "M19 R10",
            "M19 R10",
            "M19 R5 P1",
            "G64 P0.01",
            "M30"
        ]
    );
    let canon = interpreted(program);
    let ways = canon.iter().filter(|call| call.contains("ORIENT_SPINDLE("));
    assert_eq!(ways.count(), 6, "{canon:?}");
    let shown = errors("SPOS=IC(90)\nM30\n");
    assert!(
        shown.contains("an angle from zero of the spindle"),
        "{shown}"
    );
}

/// S of G332, or before it, is the speed of the way out, and of all that follows.
#[test]
fn taps_come_out_at_a_speed_of_their_own() {
    let begin = "G0 X0 Y0 Z5\nG331 Z-10 K1 S400\n";
    for (program, wanted) in [
        (
            "G332 Z5 K1 S600",
            &["S400", "S400 M3", "G33.1 Z-10 K1 I1.5", "M5", "S600", "M30"][..],
        ),
        (
            "S200\nG332 Z5 K1\nG331 Z-8 K1\nG332 Z5 K1",
            &[
                "S400",
                "S200",
                "S400 M3",
                "G33.1 Z-10 K1 I0.5",
                "M5",
                "S200",
                "M3",
                "G33.1 Z-8 K1",
                "M5",
                "M30",
            ],
        ),
        (
            "G332 Z5 K1 S400",
            &["S400", "S400 M3", "G33.1 Z-10 K1", "M5", "M30"],
        ),
    ] {
        let program = format!("{begin}{program}\nM30\n");
        assert_eq!(lines(&program)[1..], *wanted, "{program}");
        let canon = interpreted(&program);
        assert!(canon.iter().any(|call| call.contains("RIGID_TAP")));
    }
    let shown = errors("G0 X0 Y0 Z5\nG331 Z-10 K1\nG332 Z5 K1 S400\nM30\n");
    assert!(shown.contains("no spindle speed"), "{shown}");
    assert!(shown.contains("part.mpf:2:1"), "{shown}");
}

/// LinuxCNC taps back to where G331 began; what is further out is a motion of its own.
#[test]
fn a_tap_may_come_further_out_than_it_began() {
    for (plane, out, back, on) in [
        (
            "G17\nG0 X0 Y0 Z2\nG331 Z-50 K-4 S200",
            "G332 Z3 K-4",
            "G33.1 Z-50 K4",
            "G0 Z3 M5",
        ),
        (
            "G17\nG0 X0 Y0 Z-2\nG331 Z50 K4 S200",
            "G332 Z=IC(-53) K4",
            "G33.1 Z50 K4",
            "G0 Z-3 M5",
        ),
    ] {
        let program = format!("{plane}\n{out}\nM30\n");
        let written = lines(&program);
        let tap = written.iter().position(|line| line == back).expect("a tap");
        assert_eq!(written[tap + 1..], [on, "M30"], "{written:?}");
        interpreted(&program);
    }
    for out in ["G332 Z1.9 K4", "G332 Z-55 K4", "G332 Z3 K3"] {
        let shown = errors(&format!("G0 X0 Y0 Z2\nG331 Z-50 K4 S200\n{out}\nM30\n"));
        assert!(shown.contains("does not come back"), "{out}\n{shown}");
    }
}
