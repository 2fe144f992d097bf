//! How the spindle of the Sinumerik-like dialect turns: the speeds into a tap and out of it.

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
