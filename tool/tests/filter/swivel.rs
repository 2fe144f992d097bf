//! CYCLE800 back to zero, and its retraction.

use crate::rs274;
use crate::shop::{Shop, accepted, commands, refused, translate};
use std::process::Command;

/// The lines behind those of the header.
fn lines(program: &str, arguments: &[&str]) -> Vec<String> {
    let lines = commands(&translate(&format!("{program}\nM30\n"), arguments)).into_iter();
    lines.filter(|line| !line.starts_with("(MSG")).collect()
}

const TILT: &str = "CYCLE800(0,\"TC\",0,57,0,0,0,30,0,0,0,0,0,-1)";

/// With its angles 0 the frame goes and the rotary axes move to zero, unless DIR says that they stay.
#[test]
fn angles_of_zero_swivel_back() {
    let zero = "0,0,0";
    for (retraction, state, shift, angles, direction, expected) in [
        (
            0,
            0,
            zero,
            zero,
            -1,
            &[
                "o<frame_off> call",
                "o<rotary_zero> call",
                "o<frame_off> call",
            ][..],
        ),
        (
            0,
            0,
            "10,0,5",
            zero,
            1,
            &[
                "o<frame_off> call",
                "o<rotary_zero> call",
                "o<trans> call [10] [0] [5]",
            ],
        ),
        (0, 0, zero, zero, 0, &["o<frame_off> call"]),
        // Added to a plane that is turned it stays turned.
        (0, 1, zero, zero, -1, &["o<tool_normal> call"]),
        // The tool goes off the part along the frame that is in force.
        (
            1,
            0,
            zero,
            zero,
            -1,
            &[
                "o<retract> call [120]",
                "o<frame_off> call",
                "o<rotary_zero> call",
                "o<frame_off> call",
            ],
        ),
        (
            1,
            0,
            zero,
            "0,20,0",
            -1,
            &[
                "o<retract> call [120]",
                "o<rot> call [0] [20] [0]",
                "o<tool_normal> call",
            ],
        ),
    ] {
        let call =
            format!("CYCLE800({retraction},\"TC\",{state},57,{shift},{angles},0,0,0,{direction})");
        let program = format!("{TILT}\n{call}\nG0 X1");
        let arguments = ["--backend", "kinematics", "--retract-z", "120"];
        let found = lines(&program, &arguments);
        let end = found
            .iter()
            .position(|line| line.starts_with("G0 X1"))
            .expect("a move");
        assert_eq!(&found[3..end], expected, "{call}");
    }
}

/// A new plane and CYCLE800() end the frame of TRANS and its like with the plane of before; a plane is not
/// turned on while there is one.
#[test]
fn frames_of_the_program_end_with_the_plane() {
    let zero = "CYCLE800(0,\"TC\",0,57,0,0,0,0,0,0,0,0,0,0)";
    let notes = |program: &str| {
        translate(&format!("{program}\nM30\n"), &[])
            .matches("left out")
            .count()
    };
    for end in ["CYCLE800()", zero] {
        for plane in ["", TILT] {
            let program = format!("{plane}\nTRANS X7\n{end}\nG0 X1");
            let found = lines(&program, &["--backend", "kinematics"]);
            let end_of_frame = found.iter().rposition(|line| line == "o<frame_off> call");
            let shift = found
                .iter()
                .rposition(|line| line.ends_with("trans> call [7] [0] [0]"));
            assert!(
                shift.is_some() && end_of_frame > shift,
                "{program}\n{found:?}"
            );
            assert_eq!(notes(&program), 0, "{program}");
        }
        // There is nothing that it could end.
        assert_eq!(notes(end), 1, "{end}");
    }
    let more = "CYCLE800(0,\"TC\",1,57,0,0,0,0,0,20,0,0,0,1)";
    let turned = lines(&format!("{TILT}\nTRANS X7\nTRANS\n{more}"), &[]);
    assert!(
        turned.contains(&"o<arot> call [0] [0] [20]".to_string()),
        "{turned:?}"
    );
    for frame in ["TRANS X7", "ATRANS X7\nAROT Z15", "G58 X7"] {
        for plane in ["", TILT] {
            let program = format!("{plane}\n{frame}\n{more}\nM30\n");
            let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
            let shown = refused(&shop.run("part.mpf", &[]));
            assert!(
                shown.contains("CYCLE800 with ST = 1 while a frame of TRANS"),
                "{shown}"
            );
            assert!(
                shown.contains("give what is left of it as X0, Y0, Z0"),
                "{shown}"
            );
        }
    }
}

/// Without the frame kinematics only those axes turn that are not at zero: a machine need not have any.
#[test]
fn rotary_axes_that_are_not_at_zero_turn_back_on_any_machine() {
    let back = "CYCLE800(0,\"TC\",0,57,0,0,0,0,0,0,0,0,0,-1)";
    for (before, turned) in [
        ("G0 X1", &[][..]),
        ("G0 X1 A30 C40", &["A", "C"]),
        ("G0 B5", &["B"]),
    ] {
        let program = format!("{before}\n{back}\nG0 X2\n{back}\nG0 Y3\nM30\n");
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let output = accepted(&shop.run("part.mpf", &[]));
        let canon = rs274::interpret(&shop.path(""), "T1 P1\n", &output);
        let ends: Vec<Vec<f64>> = canon
            .iter()
            .filter_map(|line| rs274::numbers(line, "STRAIGHT_TRAVERSE"))
            .collect();
        // As many moves as there are axes to turn, once, besides the three of the program.
        assert_eq!(ends.len(), 3 + turned.len(), "{before}: {ends:?}");
        assert_eq!(ends.last().expect("a move")[3..6], [0.0; 3], "{before}");
    }
}

#[test]
fn the_retraction_is_done_or_refused() {
    let call =
        |retraction: &str| format!("CYCLE800({retraction},\"TC\",0,57,0,0,0,0,0,0,0,0,0,-1)");
    for (arguments, place) in [
        (&["--retract-z", "120"][..], "120"),
        (&["--retract-z", "-12.7"], "-12.7"),
        (&["--retract-z", "25.4", "--machine-in-inch"], "1"),
    ] {
        let found = lines(&call("1"), &[&["--backend", "program"], arguments].concat());
        assert_eq!(found[0], format!("G53 G0 Z{place}"));
    }
    for (program, arguments, says) in [
        (call("1"), &[][..], "--retract-z 120"),
        (call("2"), &["--retract-z", "120"], "FR = 2"),
        (call("4"), &[], "FR = 4"),
        (
            format!("SCALE X2\n{}", call("1")),
            &["--retract-z", "120"],
            "a scale or a mirror",
        ),
        (
            format!("MIRROR X0\n{}", call("1")),
            &["--retract-z", "120"],
            "a scale or a mirror",
        ),
    ] {
        let shop = Shop::new(&[("part.mpf", format!("{program}\nM30\n").as_bytes())]);
        let shown = refused(&shop.run("part.mpf", arguments));
        assert!(shown.contains(says), "{shown}");
    }
    let shop = Shop::new(&[
        ("part.mpf", format!("{}\nM30\n", call("1")).as_bytes()),
        ("machine.ini", b"[FRAMEPATH]\nRETRACT_Z = 77\n"),
    ]);
    let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(shop.path(""))
        .env("INI_FILE_NAME", shop.path("machine.ini"))
        .args(["filter", "--dialect", "sinumerik", "part.mpf"])
        .output()
        .expect("the tool runs");
    assert!(accepted(&output).contains("G53 G0 Z77"));
}
