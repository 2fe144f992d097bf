//! Threads, taps, spindle angles and surface speeds of the Sinumerik-like dialect; diameters, ways of
//! rotary axes, repeated parts.

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

#[test]
fn threads_keep_their_pitch() {
    let program = "G0 X20 Y0 Z5\nS500 M3\nG33 Z-20 K2\nG33 Z-60 X50 K2\nG0 Z5\nM30\n";
    assert_eq!(
        lines(program),
        [
            "G0 X20 Y0 Z5",
            "S500 M3",
            "G33 Z-20 K2",
            // The pitch along the path: 50 for 40.
            "G33 X50 Z-60 K2.5",
            "G0 Z5",
            "M30",
        ]
    );
    let canon = interpreted(program);
    let threads = canon
        .iter()
        .filter(|call| call.contains("START_SPEED_FEED_SYNC("));
    assert_eq!(threads.count(), 2, "{canon:?}");
    for (program, words) in [
        (
            "G0 X0 Y0 Z0\nG33 Z-20 K2\nM30\n",
            "the spindle does not turn",
        ),
        ("G0 Z0\nS1 M3\nG33 Z-20\nM30\n", "needs its pitch"),
        (
            "S1 M3\nG33 Z-20 X5 K2\nM30\n",
            "the slope of this thread is not known",
        ),
        ("G0 X0 Y0 Z0\nS1 M3\nG33 Z-20 K0\nM30\n", "no pitch"),
        (
            "G0 X0 Y0 Z0\nS1 M3\nSCALE X2\nG33 Z-20 K1\nM30\n",
            "a thread under a scale",
        ),
        (
            "G0 X0 Y0 Z0\nS1 M3\nG34 Z-20 K1\nM30\n",
            "G34 is not supported",
        ),
    ] {
        assert!(
            errors(program).contains(words),
            "{program}{}",
            errors(program)
        );
    }
}

/// G33, G331 and G332 hold as G0 and G1 do; the pitch belongs to its block.
#[test]
fn threads_and_taps_hold_until_another_motion() {
    let begin = "S500 M3\nG0 X0 Y0 Z10\n";
    let program = format!("{begin}G33\nZ-20 K2\nZ-30 K3\nM8\nG1 X5 F100\nX6\nM30\n");
    assert_eq!(
        lines(&program)[2..],
        [
            "G33 Z-20 K2",
            "G33 Z-30 K3",
            "M8",
            "G1 X5 F100",
            "G1 X6",
            "M30"
        ]
    );
    let taps = "G331 Z-5 K1\nG332 Z10 K1\n";
    for (program, place, words) in [
        ("G33 Z-20 K2\nZ-30\n", "4:1", "a thread needs its pitch"),
        ("G33 Z-20 K2\nX24 Z-22\n", "4:1", "a thread needs its pitch"),
        ("G33 K2\nZ-20\n", "3:1", "no axis moves"),
        (
            "G33 Z-20 K2\nG53 Z0\n",
            "4:1",
            "only G0 and G1 can move in machine",
        ),
        (taps.trim_end(), "", ""),
        (
            &format!("{taps}X10"),
            "5:1",
            "while G331 or G332 is in force",
        ),
    ] {
        let program = format!("{begin}{program}\nM30\n");
        match words {
            "" => drop(lines(&program)),
            _ => {
                let shown = errors(&program);
                assert!(shown.contains(words), "{program}{shown}");
                assert!(shown.contains(&format!("part.mpf:{place}")), "{shown}");
            }
        }
    }
}

#[test]
fn rigid_taps_go_in_and_out() {
    let program = "G0 X10 Y10 Z2\nSPOS=0\nG331 Z-15 K1.25 S400\nG332 Z2 K1.25\nG0 Z50\n\
                   G0 Z2\nG331 Z=IC(-10) K-1 S300\nG332 Z=IC(10) K-1\nM30\n";
    assert_eq!(
        lines(program),
        [
            "G0 X10 Y10 Z2",
            "M19 R0",
            "S400",
            "M3",
            "G33.1 Z-15 K1.25",
            "M5",
            "G0 Z50",
            "G0 Z2",
            "S300",
            "M4",
            "G33.1 Z-8 K1",
            "M5",
            "M30",
        ]
    );
    let canon = interpreted(program);
    let taps = canon.iter().filter(|call| call.contains("RIGID_TAP"));
    assert_eq!(taps.count(), 2, "{canon:?}");
    for (program, words) in [
        (
            "G0 X0 Y0 Z2\nG331 Z-15 K1 S400\nG0 Z2\nM30\n",
            "does not come out next",
        ),
        (
            "G0 X0 Y0 Z2\nG331 Z-15 K1 S400\nG332 Z1 K1\nM30\n",
            "does not come back to where it began",
        ),
        ("G0 X0 Y0 Z2\nG332 Z5 K1\nM30\n", "G332 without a G331"),
        (
            "G331 Z-15 K1 S400\nG332 Z5 K1\nM30\n",
            "where the tap begins is not known",
        ),
        (
            "G0 X0 Y0 Z2\nG331 Z-15 K1\nG332 Z2 K1\nM30\n",
            "no spindle speed",
        ),
    ] {
        assert!(
            errors(program).contains(words),
            "{program}{}",
            errors(program)
        );
    }
}

#[test]
fn the_tapping_cycle_is_a_rigid_tap() {
    let program = "S2000 M3\nG0 X0 Y0 Z10\nMCALL CYCLE84(10,0,2,-12,,,3,,1.25,0,300,600)\nG0 X20\n\
                   MCALL\nCYCLE84(10,0,2,,12,,5,8,,0,300,300)\nM30\n";
    let text = lines(program).join("\n");
    assert!(
        text.contains("G0 Z2\nS300 M3\nG33.1 Z-12 K1.25 I2\nM5\nG0 Z10 S2000 M3\n")
            || text.contains("G0 Z2\nS300\nM3\nG33.1 Z-12 K1.25 I2\nM5\nG0 Z10 S2000 M3\n"),
        "{text}"
    );
    // The size M8 has a pitch of 1.25.
    assert!(
        text.ends_with("G33.1 Z-12 K1.25\nM5\nG0 Z10 S2000\nM30"),
        "{text}"
    );
    assert_eq!(
        interpreted(program)
            .iter()
            .filter(|call| call.contains("RIGID_TAP"))
            .count(),
        2
    );
    let shown = errors("G0 Z10\nCYCLE84(10,0,2,-12,,,3,,,0,300,300)\nM30\n");
    assert!(shown.contains("CYCLE84 needs a pitch"), "{shown}");
}

#[test]
fn reaming_and_boring_cycles() {
    let program = "S500 M3\nG0 X0 Y0 Z10 F100\nCYCLE85(10,0,2,-5,,0.5,50,80)\nG1 X5\n\
                   CYCLE88(10,0,2,-5,,1,3)\nM30\n";
    let text = lines(program).join("\n");
    let ream = "G0 Z2\nF50\nG1 Z-5\nG4 P0.5\nF80\nG1 Z2\nF100\nG0 Z10\nG1 X5";
    let text = text
        .replace("G1 Z-5 F50", "F50\nG1 Z-5")
        .replace("G1 Z2 F80", "F80\nG1 Z2");
    let text = text.replace("\nG0 Z10 F100", "\nF100\nG0 Z10");
    assert!(text.contains(ream), "{text}");
    assert!(
        text.contains("G1 Z-5\nG4 P1\nM5\nM0\nG0 Z10") || text.contains("M5 M0\nG0 Z10"),
        "{text}"
    );
}

#[test]
fn a_chuck_that_gives_way_needs_no_overrides() {
    let program = "S300 M3\nG0 X0 Y0 Z2\nG63 Z-10 F300\nM4\nG63 Z2\nM3\nM30\n";
    let text = lines(program).join("\n");
    assert!(
        text.contains("M49\nG1 Z-10\nM48\nM4\nM49\nG1 Z2\nM48\nM3"),
        "{text}"
    );
    interpreted(program);
    let shown = errors("S300 M3\nG0 X0 Y0 Z2\nG41 G1 X9 F300\nG63 Z-10\nM30\n");
    assert!(shown.contains("part.mpf:4:1"), "{shown}");
    assert!(
        shown.contains("a tap while cutter compensation is on"),
        "{shown}"
    );
}

#[test]
fn surface_speeds_and_diameters() {
    let program = "G18 DIAMON\nG0 X50 Z2\nLIMS=3000\nG96 S200 M4\nG1 X40 F0.2\nZ-30\nG91 X4\nG90\n\
                   DIAM90\nX40\nG91 X2\nG90 DIAMOF\nG97 S500\nG94 G0 X50\nM30\n";
    let text = lines(program).join("\n");
    assert!(text.contains("G0 X25 Z2"), "{text}");
    assert!(text.contains("G96 D3000 S200 M4"), "{text}");
    assert!(text.contains("G1 X20 F0.2\nG1 Z-30\nG1 X22\n"), "{text}");
    // Increments are radii with DIAM90.
    assert!(text.contains("G1 X20\nG1 X22\n"), "{text}");
    assert!(
        text.contains("G97\nS500") || text.contains("G97 S500"),
        "{text}"
    );
    let canon = interpreted(program);
    assert!(
        canon.iter().any(|call| call.contains("SET_SPINDLE_MODE")),
        "{canon:?}"
    );
    let shown = errors("G96 S200 M3\nG97\nM30\n");
    assert!(
        shown.contains("G97 keeps a speed that is not known"),
        "{shown}"
    );
}

/// G94 and G95 end the cutting speed as G97 does; what the speed is then has to be said before it matters.
#[test]
fn cutting_speeds_end_with_the_other_feeds() {
    let begin = "G18 G95 F0.1\nG0 X20 Z0\nG96 S200 LIMS=3000 M4\nG1 Z-1\n";
    for (program, wanted) in [
        ("G94 F100\nS500\nG1 Z-2", "G94 F100 G97 S500 G1 Z-2"),
        ("G94 F100 S500\nG1 Z-2", "G94 F100 G97 S500 G1 Z-2"),
        ("G95 S300\nG1 Z-2", "G97 S300 G1 Z-2"),
        // Whatever the speed is, it does not matter to a rapid motion and to a spindle that stands.
        ("G94 G0 Z5\nM5\nG1 X9 F50", "G94 G0 Z5 M5 G1 X9 F50"),
    ] {
        let text = lines(&format!("{begin}{program}\nM30\n")).join(" ");
        assert!(
            text.ends_with(&format!("{wanted} M30")),
            "{program}\n{text}"
        );
    }
    for program in [
        "G94 F100\nG1 Z-2",
        "G95\nG33 Z-2 K1",
        "G95\nCYCLE81(10,0,2,-5)",
    ] {
        let shown = errors(&format!("{begin}{program}\nM30\n"));
        assert!(shown.contains("part.mpf:5:1"), "{program}\n{shown}");
        assert!(shown.contains("the end of G96 keeps a speed"), "{shown}");
        let advice = format!("the speed beside it: {} S1000", &program[..3]);
        assert!(shown.contains(&advice), "{shown}");
    }
}

/// LIMS counts with G96 and G97; with G93 to G95 S is what it is.
#[test]
fn speeds_keep_to_their_limit() {
    for (program, wanted) in [
        ("LIMS=1000\nG97 S3000 M3", &["S1000"][..]),
        (
            "G97 S3000 M3\nLIMS=1000\nLIMS=2000",
            &["S3000", "S1000", "S2000"],
        ),
        (
            "S3000 M3\nLIMS=1000\nG97\nG94",
            &["S3000", "S1000", "S3000"],
        ),
        ("LIMS=1000\nG97 S300 M3\nG95 S2000", &["S300", "S2000"]),
    ] {
        let all = lines(&format!("{program}\nM30\n"));
        let words = all.iter().flat_map(|line| line.split(' '));
        let speeds: Vec<&str> = words.filter(|word| word.starts_with('S')).collect();
        assert_eq!(speeds, wanted, "{program}");
    }
    let shown = errors("G97 S100 LIMS=0 M3\nM30\n");
    assert!(shown.contains("the limit of the spindle speed"), "{shown}");
}

/// In inches S of G96 is in feet per minute, which LinuxCNC takes as they are with G20.
#[test]
fn cutting_speeds_are_in_the_unit_of_the_program() {
    for (unit, arguments, wanted) in [
        ("G700", &[][..], "S60.96"),
        ("G70", &[], "S60.96"),
        ("G710", &[], "S200"),
        ("G700", &["--machine-in-inch"], "S200"),
        ("G710", &["--machine-in-inch"], "S656.167979"),
    ] {
        let arguments = [&["--backend", "program"], arguments].concat();
        let text = translate(&format!("{unit}\nG96 S200 M4\nM30\n"), &arguments);
        assert!(text.contains(&format!("{wanted} ")), "{unit}\n{text}");
    }
}

#[test]
fn g97_counts_the_feed_per_turn() {
    let program = "G0 X20 Z2\nG97 S500 M4\nG1 Z-10 F0.2\nM30\n";
    let text = lines(program).join("\n");
    assert!(text.contains("G95\nG97 S500 M4\nG1 Z-10 F0.2"), "{text}");
    // F in mm/min does not go on as mm per turn.
    let shown = errors("G94 F100\nG0 X20 Z2\nG97 S500 M4\nG1 Z-10\nM30\n");
    assert!(
        shown.contains("part.mpf:4:4") && shown.contains("no F is in force"),
        "{shown}"
    );
}

/// An absolute centre is a diameter as the end of the arc is, one from the start is a radius.
#[test]
fn absolute_centres_are_diameters() {
    let begin = "G18 G95 F0.1\nG0 X20 Z0\n";
    let wanted = "G3 X20 Z-20 I0 K-10";
    for program in [
        "DIAMON\nG0 X40\nG3 X40 Z-20 I=AC(40) K=AC(-10)",
        "DIAM90\nG0 X40\nG3 X40 Z-20 I=AC(40) K=AC(-10)",
        "DIAMON\nG0 X40\nG3 X40 Z-20 I0 K-10",
        "G3 X20 Z-20 I=AC(20) K=AC(-10)",
        "DIAMON\nG0 X40\nCIP X40 Z-20 I1=AC(60) K1=AC(-10)",
        "DIAM90\nG0 X40\nCIP X40 Z-20 I1=AC(60) K1=AC(-10)",
        "DIAM90\nG0 X40\nCIP X40 Z-20 I1=IC(10) K1=AC(-10)",
    ] {
        let text = lines(&format!("{begin}{program}\nM30\n")).join("\n");
        let side = text.replace("G2 X20 Z-20 I0 K-10", wanted);
        assert!(side.contains(wanted), "{program}\n{text}");
    }
    let shown = errors(&format!(
        "{begin}DIAMON\nCIP X40 Z-20 I1=IC(10) K1=IC(-10)\nM30\n"
    ));
    assert!(shown.contains("part.mpf:4:14"), "{shown}");
}

#[test]
fn rotary_axes_turn_the_way_that_is_meant() {
    let program = "G0 A350\nA=DC(10)\nA=ACN(10)\nA=ACN(0)\nA=ACP(0)\nA=ACP(90)\nA=DC(300)\nM30\n";
    let angles = [
        "G0 A350", "G0 A370", "G0 A370", "G0 A360", "G0 A360", "G0 A450", "G0 A300",
    ];
    assert_eq!(lines(program)[..7], angles);
    for (program, words) in [
        (
            "G1 A=DC(10) F9\nM30\n",
            "which way this axis turns is not known",
        ),
        ("G0 X=DC(10)\nM30\n", "belong to rotary axes"),
    ] {
        assert!(errors(program).contains(words), "{}", errors(program));
    }
}

#[test]
fn parts_are_repeated() {
    let program =
        "G0 X0 Y0\nG91\nAA: X1\nBB: Y1\nREPEAT AA BB P=2\nREPEATB AA P=3\nREPEAT BB\nM30\n";
    let ends = |wanted: &str| {
        let all = lines(program);
        all.iter().filter(|line| line.as_str() == wanted).count()
    };
    let all = lines(program);
    let moves: Vec<&str> = all
        .iter()
        .skip(1)
        .map(String::as_str)
        .filter(|line| line.starts_with("G0"))
        .collect();
    // REPEAT BB runs all from BB up to itself, with the repetitions in between.
    let x = |n: u32| format!("G0 X{n}");
    let y = |n: u32| format!("G0 Y{n}");
    let wanted = [
        x(1),
        y(1),
        x(2),
        y(2),
        x(3),
        y(3),
        x(4),
        x(5),
        x(6),
        y(4),
        x(7),
        y(5),
        x(8),
        y(6),
        x(9),
        x(10),
        x(11),
    ];
    assert_eq!(moves, wanted);
    assert_eq!(ends("M30"), 1);
    // The block of the end label belongs to what is repeated.
    let end = "G0 X0 Y0\nG91\nAA: X1\nENDLABEL: Y1\nREPEAT AA P=2\nM30\n";
    assert_eq!(
        lines(end)[1..],
        [x(1), y(1), x(2), y(2), x(3), y(3), "M30".to_string()]
    );
    for (program, words) in [
        (
            "G0 X1\nREPEAT NOWHERE P=2\nM30\n",
            "there is no label for this repetition",
        ),
        (
            "AA: G0 X1\nREPEAT AA P=99999\nM30\n",
            "more than the control allows",
        ),
        ("REPEAT AA P=2\nAA: G0 X1\nM30\n", "there is no ENDLABEL"),
        (
            "AA: G0 X1\nIF 1==1 GOTOF DD\nBB: X2\nCC: X3\nDD: X4\nREPEAT AA BB\nM30\n",
            "this jump leaves the blocks",
        ),
        (
            "SETAL(65000, \"too deep\")\nM30\n",
            "stops itself here with alarm 65000: too deep",
        ),
    ] {
        assert!(
            errors(program).contains(words),
            "{program}{}",
            errors(program)
        );
    }
}
