//! G58 and G59 of Sinumerik programs: they shift zero and move nothing.

use crate::shop::{Shop, commands, refused, translate};

/// Where a program goes with `point` at its end, in coordinates of the work offset.
fn place(program: &str, point: &str) -> Vec<String> {
    let program = format!("G0 X0 Y0 Z0\n{program}\nG1 {point} F100\nM30\n");
    let output = translate(&program, &["--backend", "program"]);
    let lines = commands(&output).into_iter();
    let moves = lines.filter(|line| !line.starts_with("(MSG"));
    moves.skip(1).collect()
}

#[test]
fn the_absolute_and_the_additive_part_are_replaced_axis_by_axis() {
    let zero = "X0 Y0 Z0";
    for (program, expected) in [
        // The example of the control's manual, line by line.
        ("TRANS X10 Y10 Z10\nATRANS X5 Y5", "G1 X15 Y15 Z10 F100"),
        (
            "TRANS X10 Y10 Z10\nATRANS X5 Y5\nG58 X20",
            "G1 X25 Y15 Z10 F100",
        ),
        (
            "TRANS X10 Y10 Z10\nATRANS X5 Y5\nG58 X20\nG59 X10 Y10",
            "G1 X30 Y20 Z10 F100",
        ),
        ("G58 Z-20", "G1 X0 Y0 Z-20 F100"),
        ("G58 Z-20\nG59 X2", "G1 X2 Y0 Z-20 F100"),
        ("G59 X2\nG59 X3", "G1 X3 Y0 Z0 F100"),
        ("ATRANS X2\nG58 X10", "G1 X12 Y0 Z0 F100"),
        ("ATRANS X2\nG59 X10", "G1 X10 Y0 Z0 F100"),
        ("G58 X10\nG59 X2\nTRANS Y1", "G1 X0 Y1 Z0 F100"),
        ("G58 X10\nG59 X2\nTRANS", "G1 X0 Y0 Z0 F100"),
        ("G58 X10\nG58 X0", "G1 X0 Y0 Z0 F100"),
        ("G70 G58 X1\nG71", "G1 X25.4 Y0 Z0 F100"),
        ("DIAMON\nG58 X10\nDIAMOF", "G1 X10 Y0 Z0 F100"),
        // Another work offset is another zero, on which they stand.
        ("G58 X10\nG55", "G1 X10 Y0 Z0 F100"),
    ] {
        let lines = place(&program.replace("G70 G58", "G70\nG58"), zero);
        let moves: Vec<&String> = lines.iter().filter(|line| line.starts_with("G1")).collect();
        assert_eq!(moves, [expected], "{program}");
        assert!(
            !lines
                .iter()
                .any(|line| line.contains("G58") || line.contains("G59")),
            "{lines:?}"
        );
        assert!(
            !lines.iter().any(|line| line.starts_with("G0")),
            "{lines:?}"
        );
    }
}

/// The shift comes before the rotations, scales and mirrors of the frame.
#[test]
fn they_shift_the_frame_and_are_not_turned_by_it() {
    for (program, expected) in [
        ("ROT RPL=90\nG58 X10", "G1 X10 Y1 Z0 F100"),
        (
            "TRANS X3\nAROT RPL=90\nG58 X10\nG59 Y5",
            "G1 X10 Y6 Z0 F100",
        ),
        ("ROT RPL=90\nATRANS X5\nG58 X10", "G1 X10 Y6 Z0 F100"),
        ("SCALE X2 Y2\nG59 X10", "G1 X12 Y0 Z0 F100"),
        ("MIRROR X0\nG58 X10", "G1 X9 Y0 Z0 F100"),
    ] {
        assert_eq!(place(program, "X1 Y0 Z0"), [expected, "M30"], "{program}");
    }
    let program = "ROT RPL=90\nG58 X10\nG59 Y2\nG0 X1\nM30\n";
    let lines = commands(&translate(program, &["--backend", "kinematics"]));
    assert_eq!(
        lines[3..7],
        [
            "o<arot_rpl> call [90]",
            "o<trans> call [10] [0] [0]",
            "o<atrans> call [0] [2] [0]",
            "o<arot_rpl> call [90]"
        ]
    );
}

#[test]
fn what_they_cannot_do_is_refused() {
    for (program, place, says) in [
        ("G58", "1:1", "G58 needs axes"),
        ("G59", "1:1", "G59 needs axes"),
        ("G58 X1 F100", "1:1", "stands alone"),
        ("G58 G0 X1", "1:1", "stands alone"),
        ("G58 A5", "1:1", "stands alone"),
        ("G58 X=IC(1)", "1:5", "increment"),
        ("ROT RPL=30\nATRANS X1\nG59 X2", "3:1", "ATRANS"),
        ("T1 D1 M6\nG41 G1 X1 Y1 F10\nG58 X1", "3:1", "compensation"),
    ] {
        let shop = Shop::new(&[("part.mpf", format!("{program}\nM30\n").as_bytes())]);
        let shown = refused(&shop.run("part.mpf", &[]));
        assert!(
            shown.contains(place) && shown.contains(says),
            "{program}: {shown}"
        );
    }
}
