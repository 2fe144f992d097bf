//! What is written into one line: each of LinuxCNC's words keeps its own numbers there, as in lines of
//! their own.

use crate::rs274;
use crate::shop::{Shop, accepted, commands, translate};

/// What LinuxCNC makes of a program, its tool with a diameter; in the order of the alphabet.
fn calls(program: &str) -> Vec<String> {
    let head = "G17 G95 F0.2\nT1 D1 M6\nS100 M3\nG0 X0 Y0 Z0\n";
    let program = format!("{head}{program}\nM30\n");
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let output = accepted(&shop.run("part.mpf", &["--backend", "program"]));
    let canon = rs274::interpret(&shop.path(""), "T1 P1 Z0 D0.1\nT2 P2 Z0 D0.1\n", &output);
    let of_call = |line: &String| {
        let (_, call) = line.split_once(" N")?;
        let call = call.trim_start_matches(|c: char| c == '.' || c.is_ascii_digit());
        let call = call.trim().to_string();
        let silent = call.starts_with("COMMENT") || call.starts_with("SET_XY_ROTATION");
        (!silent).then_some(call)
    };
    let mut calls: Vec<String> = canon.iter().filter_map(of_call).collect();
    calls.sort();
    calls
}

#[test]
fn words_keep_their_numbers() {
    let modes = [
        "G641 ADIS=2",
        "G96 S100 LIMS=1000",
        "G97 S50",
        "SPOS=90",
        "M19",
        "M4",
        "M8",
        "G41",
        "G18",
        "G55",
        "T2",
        "F3",
    ];
    let motions = [
        "G1 X30",
        "G2 X10 Y0 I5 J0",
        "G2 X10 Y0 Z-1 I5 J0 TURN=1",
        "G3 X10 Y0 CR=5",
    ];
    let exclude = [
        // The order matters.
        ["SPOS=90", "M19"],
        ["SPOS=90", "M4"],
        ["M19", "M4"],
        ["G96 S100 LIMS=1000", "G97 S50"],
        // They cannot follow each other.
        ["G41", "G18"],
        ["G41", "G55"],
    ];
    for (at, mode) in modes.into_iter().enumerate() {
        let others = modes[at + 1..].iter();
        for other in others.filter(|other| !exclude.contains(&[mode, other])) {
            let together = calls(&format!("{mode} {other}"));
            assert_eq!(
                together,
                calls(&format!("{mode}\n{other}")),
                "{mode} {other}"
            );
        }
        let arcs = !matches!(mode, "G18" | "G41");
        for motion in motions.iter().take(if arcs { 4 } else { 1 }) {
            let together = calls(&format!("{mode} {motion}"));
            assert_eq!(
                together,
                calls(&format!("{mode}\n{motion}")),
                "{mode} {motion}"
            );
        }
    }
}

/// P of G64 and of an arc would go to the M function of a user.
#[test]
fn functions_of_the_user_get_no_numbers_of_others() {
    let program = "G0 X0 Y0 Z0\nF100\nG64 M101 X5\nG2 X15 Y0 I5 J0 TURN=1 M101\nSPOS=9 M101\nM30\n";
    for backend in ["program", "kinematics"] {
        let output = translate(program, &["--backend", backend, "--pass-m", "101"]);
        let lines = commands(&output);
        let alone = lines.iter().filter(|line| *line == "M101").count();
        assert_eq!(alone, 3, "{output}");
    }
}

/// LinuxCNC wants F of G93 in the line of its motion.
#[test]
fn the_feed_of_inverse_time_stays_with_its_motion() {
    for (dialect, block, expected) in [
        (
            "sinumerik",
            "G64 G2 X30 I5 J0 F5",
            &["G64 P0.01", "G2 X30 I5 J0 F5"][..],
        ),
        (
            "fanuc",
            "G64 G2 X30. I5. F5.",
            &["G64 P0.01", "G2 X30 I5 J0 F5"],
        ),
        (
            "fanuc",
            "G91 G55 G1 X10. F5.",
            &["G55", "G1 X[#5420+10] F5"],
        ),
        ("fanuc", "M49 G1 X30. F5.", &["M49", "G1 X30 F5"]),
    ] {
        let program = format!("G54 G90 G0 X0 Y0\nG93\nG1 X20. F5.\n{block}\nM30\n");
        let shop = Shop::new(&[("part", program.as_bytes())]);
        let output = accepted(&shop.run_in(dialect, "part", &["--backend", "program"]));
        rs274::interpret(&shop.path(""), "", &output);
        let lines = commands(&output);
        let begin = lines.iter().position(|line| line == expected[0]);
        let found = begin.map(|begin| &lines[begin..begin + expected.len()]);
        assert_eq!(
            found,
            Some(
                &expected
                    .iter()
                    .map(|line| line.to_string())
                    .collect::<Vec<_>>()[..]
            ),
            "{output}"
        );
    }
}
