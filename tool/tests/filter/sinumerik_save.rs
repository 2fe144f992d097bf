//! Subprograms with SAVE: what they change of the modes is as before where the program that called goes on.

use crate::shop::{Shop, accepted, commands, refused};

fn output(main: &str, body: &str) -> String {
    let program = program(main, body);
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    accepted(&shop.run("part.mpf", &["--backend", "program"]))
}

fn program(main: &str, body: &str) -> String {
    format!("%_N_PART_MPF\n{main}\nM30\n%_N_FLIP_SPF\nPROC FLIP SAVE DISPLOF\n{body}\nRET\n")
}

/// The moves and modes behind the call, in one line.
fn behind(main: &str, call: &str, rest: &str, body: &str) -> String {
    let output = output(&format!("{main}\n{call}\n{rest}"), body);
    let (_, behind) = output.split_once("end of FLIP").expect("it was called");
    let (_, behind) = behind.split_once('\n').expect("more lines");
    commands(behind).join(" ")
}

#[test]
fn modes_and_frames_of_the_caller_are_in_force_again() {
    let begin = "G54\nG0 X0 Y0 Z0\nG1 X1 F100";
    for (body, rest, wanted) in [
        ("G91\nTRANS X100", "X20 Y20", "G1 X20 Y20 M30"),
        ("G0 X5\nAROT RPL=90", "X20 Y2", "G1 X20 Y2 M30"),
        ("G18", "G2 X5 Y0 CR=2", "G17 G2 X5 Y0 I2 J0 M30"),
        ("G55", "X20 Y2", "G54 G1 X20 Y2 M30"),
        ("G500", "X20 Y2", "G54 G1 X20 Y2 M30"),
        ("G700", "X20", "G1 X20 M30"),
        ("DIAMON", "X20", "G1 X20 M30"),
        ("CT", "X20", "G1 X20 M30"),
        ("G0\nG41 X5 Y5 D1\nX9", "X20 Y2", "G40 G1 X20 Y2 M30"),
        // F goes with its mode, as where G94 stands.
        ("G95", "X20 F50", "G94 G1 X20 F50 M30"),
        ("G96 S200 M3", "X20 F50 S300", "G94 F50 G97 G1 X20 S300 M30"),
        // What is no G function stays.
        ("S700 F30\nR1=7", "X=R1", "G1 X7 M30"),
    ] {
        let found = behind(begin, "FLIP", rest, body);
        assert_eq!(found, wanted, "{body}");
    }
    // Corners are passed as before.
    let found = behind("G0 X0 F100\nG60", "FLIP", "G1 X5", "G64\nG1 X3");
    assert!(found.starts_with("G61.1 "), "{found}");
    // The frame of before, as it was put together.
    let framed = behind(
        "G0 X0 Y0 Z0\nTRANS X10\nAROT RPL=90\nG58 Y5",
        "FLIP",
        "ATRANS X1\nG0 X1 Y0",
        "SCALE X2 Y2\nG0 X1\nTRANS",
    );
    let plain = behind(
        "G0 X0 Y0 Z0\nTRANS X10\nAROT RPL=90\nG58 Y5",
        "FLIP",
        "ATRANS X1\nG0 X1 Y0",
        "G0 X1",
    );
    assert_eq!(framed, plain);
}

/// Each pass, and each subprogram inside of another one, brings back its own.
#[test]
fn passes_and_nested_calls_bring_back_their_own() {
    let main = "G0 X0 Y0 Z0\nFLIP P2\nX30";
    let found = commands(&output(main, "G91\nX5\nTRANS X100"));
    assert_eq!(found, ["G0 X0 Y0 Z0", "G0 X5", "G0 X10", "G0 X30", "M30"]);
}

#[test]
fn without_save_they_stay() {
    let program = program("G0 X0\nFLIP\nX5", "G91 X1").replace(" SAVE", "");
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let found = commands(&accepted(&shop.run("part.mpf", &["--backend", "program"])));
    assert_eq!(found, ["G0 X0", "G0 X1", "G0 X6", "M30"]);
}

#[test]
fn what_was_in_force_has_to_be_known() {
    for (main, body, place, words) in [
        ("G0 X0\nFLIP", "G55", "3:1", "brings back the work offset"),
        (
            "G54\nG0 X0 Y0\nTRANS X5\nFLIP",
            "TRANS X0\nG41 G1 X5 Y5 F10 D1",
            "",
            "",
        ),
        (
            "G0 X0 Y0\nG41 G1 X5 Y5 F10 D1\nFLIP",
            "G40 X9\nG42 X12",
            "4:1",
            "the other side while cutter compensation is on",
        ),
        (
            "G0 X0 Y0 Z0\nG96 S100 M3\nFLIP\nG1 X5 F9",
            "G97 S100",
            "",
            "",
        ),
        (
            "G94 M3\nG0 X0\nFLIP\nG1 X5 F9",
            "G96 S100",
            "4:1",
            "the end of G96 keeps a speed",
        ),
    ] {
        let program = program(main, body);
        let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
        let run = shop.run("part.mpf", &[]);
        if words.is_empty() {
            accepted(&run);
            continue;
        }
        let shown = refused(&run);
        assert!(shown.contains(words), "{program}{shown}");
        assert!(
            shown.contains(&format!("part.mpf:{place}")),
            "{program}{shown}"
        );
    }
}
