//! G51.1, G51, G68 and G68.2: numbers worked out by the definitions of the manual, and the same job in
//! plain code and in another dialect.

use crate::path::{assert_pair, assert_same, translated};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// Where the line of a program ends, by the contour and by both backends.
fn end_of_line(program: &str) -> [f64; 3] {
    let shop = Shop::with(Dialect::Fanuc, program);
    let contour = shop.contour();
    contour.last().expect("a motion").shape.point(1.0)
}

#[test]
fn points_go_where_the_definitions_say() {
    for (frame, point, wanted) in [
        // Turned about a centre, counterclockwise.
        ("G68 X0 Y0 R90.", "X10. Y0 Z0", [0.0, 10.0, 0.0]),
        ("G68 X10. Y10. R90.", "X20. Y10. Z0", [10.0, 20.0, 0.0]),
        (
            "G68 X10. Y10. R-30.",
            "X20. Y10. Z3.",
            [18.660254, 5.0, 3.0],
        ),
        ("G18 G68 X0 Z0 R90.", "X0 Y0 Z10.", [10.0, 0.0, 0.0]),
        ("G19 G68 Y0 Z0 R90.", "X0 Y10. Z0", [0.0, 0.0, 10.0]),
        // G90: another angle replaces the first; G91: it is added.
        (
            "G68 X0 Y0 R45.\nG68 X0 Y0 R90.",
            "X10. Y0 Z0",
            [0.0, 10.0, 0.0],
        ),
        (
            "G68 X0 Y0 R45.\nG91 G68 X0 Y0 R45.\nG90",
            "X10. Y0 Z0",
            [0.0, 10.0, 0.0],
        ),
        // Scaled about a centre, all axes alike or each by its own factor.
        ("G51 X0 Y0 Z0 P2000", "X10. Y5. Z1.", [20.0, 10.0, 2.0]),
        ("G51 X0 Y0 Z0 P.5", "X10. Y5. Z1.", [5.0, 2.5, 0.5]),
        (
            "G51 X10. Y10. Z10. P2000",
            "X20. Y10. Z0",
            [30.0, 10.0, -10.0],
        ),
        (
            "G51 X0 Y0 Z0 I2000 J500 K1000",
            "X10. Y10. Z10.",
            [20.0, 5.0, 10.0],
        ),
        (
            "G51 X5. Y0 Z0 I-1000 J1000 K1000",
            "X10. Y10. Z10.",
            [0.0, 10.0, 10.0],
        ),
        // Mirrored at an axis of symmetry; one axis after the other.
        ("G51.1 X0", "X10. Y5. Z1.", [-10.0, 5.0, 1.0]),
        ("G51.1 X50.", "X10. Y5. Z1.", [90.0, 5.0, 1.0]),
        ("G51.1 X50.\nG51.1 Y10.", "X10. Y5. Z1.", [90.0, 15.0, 1.0]),
        (
            "G51.1 X50. Y10.\nG50.1 X0",
            "X10. Y5. Z1.",
            [10.0, 15.0, 1.0],
        ),
        // Scaled first, then turned about the scaled centre: (20, 0), (40, 0) about (20, 0).
        (
            "G51 X0 Y0 Z0 P2000\nG68 X10. Y0 R90.",
            "X20. Y0 Z0",
            [20.0, 20.0, 0.0],
        ),
        // Mirrored first: the angle turns round. (-20, 0) about (-10, 0) by -90.
        (
            "G51.1 X0\nG68 X10. Y0 R90.",
            "X20. Y0 Z0",
            [-10.0, 10.0, 0.0],
        ),
        // Mirrored in both axes: the angle stays. (-20, 0) about (-10, 0) by 90.
        (
            "G51.1 X0 Y0\nG68 X10. Y0 R90.",
            "X20. Y0 Z0",
            [-10.0, -10.0, 0.0],
        ),
        // Euler angles: about Z, the new X, the new Z.
        (
            "G68.2 X1. Y2. Z3. I0 J90. K0",
            "X0 Y10. Z0",
            [1.0, 2.0, 13.0],
        ),
        (
            "G68.2 X0 Y0 Z0 I90. J90. K0",
            "X10. Y0 Z0",
            [0.0, 10.0, 0.0],
        ),
        (
            "G68.2 X0 Y0 Z0 I90. J90. K0",
            "X0 Y0 Z10.",
            [10.0, 0.0, 0.0],
        ),
        (
            "G68.2 X0 Y0 Z0 I0 J90. K90.",
            "X10. Y0 Z0",
            [0.0, 0.0, 10.0],
        ),
        // Roll, pitch, yaw about axes that stay: X first with Q123.
        (
            "G68.2 P1 Q123 X0 Y0 Z0 I90. J90. K0",
            "X0 Y10. Z0",
            [10.0, 0.0, 0.0],
        ),
        (
            "G68.2 P1 Q213 X0 Y0 Z0 I90. J90. K0",
            "X0 Y10. Z0",
            [0.0, 0.0, 10.0],
        ),
        (
            "G68.2 P1 Q321 X0 Y0 Z0 I0 J0 K90.",
            "X10. Y0 Z0",
            [0.0, 10.0, 0.0],
        ),
    ] {
        let program = format!("G0 X1. Y1. Z1.\n{frame}\nG1 {point} F100.\nM30\n");
        let end = end_of_line(&program);
        let near = end
            .iter()
            .zip(wanted)
            .all(|(given, wanted)| (given - wanted).abs() < 1e-6);
        assert!(near, "{program}: {end:?}, not {wanted:?}");
    }
}

#[test]
fn plain_code_cuts_the_same() {
    for (program, linuxcnc) in [
        // A mirror of one axis exchanges the arcs and the side of the compensation.
        (
            "G0 X-10. Y0 Z0\nG51.1 X0\nG41 D1 G1 X20. Y0 F100.\nG3 X30. Y10. R10.\nG40 G1 X50.\nG50.1 X0\nM30\n",
            "G0 X-10 Y0 Z0\nG42 D1 G1 X-20 Y0 F100\nG2 X-30 Y10 R10\nG40 G1 X-50\nM30\n",
        ),
        // Scaling leaves the radius of the tool as it is.
        (
            "G0 X-10. Y0 Z0\nG51 X0 Y0 Z0 P2000\nG41 D1 G1 X20. Y0 F100.\nX40.\nG40 X60.\nG50\nM30\n",
            "G0 X-10 Y0 Z0\nG41 D1 G1 X40 Y0 F100\nX80\nG40 X120\nM30\n",
        ),
        (
            "G0 X0 Y0 Z0\nG68 X0 Y0 R90.\nG1 X10. Y0 F100.\nG3 X0 Y10. I-10.\nG69 G0 X1. Y1.\nM30\n",
            "G0 X0 Y0 Z0\nG1 Y10 F100\nG3 X-10 Y0 I0 J-10\nG0 X1 Y1\nM30\n",
        ),
        // Increments behind G68 begin where the tool is.
        (
            "G0 X10. Y5. Z0\nG68 X0 Y0 R90.\nG91 G1 X10. F100.\nG90 X0 Y0\nG69\nM30\n",
            "G0 X10 Y5 Z0\nG1 Y15 F100\nX0 Y0\nM30\n",
        ),
        // At the centre of the rotation one axis is enough.
        (
            "G0 X0 Y0 Z0\nG68 X0 Y0 R90.\nG1 X10. F100.\nM30\n",
            "G0 X0 Y0 Z0\nG1 Y10 F100\nM30\n",
        ),
    ] {
        assert_pair(program, linuxcnc);
    }
}

#[test]
fn other_dialects_cut_the_same() {
    for (fanuc, sinumerik) in [
        ("G68 X0 Y0 R30.", "ROT RPL=30"),
        ("G51.1 X0", "MIRROR X0"),
        ("G51 X0 Y0 Z0 P1500", "SCALE X1.5 Y1.5 Z1.5"),
        (
            "G68.2 X10. Y20. Z5. I0 J30. K0\nG53.1",
            "CYCLE800(0,,0,57,10,20,5,30,0,0,0,0,0,1)",
        ),
        (
            "G68.2 X0 Y0 Z0 I90. J20. K-90.\nG53.1",
            "CYCLE800(0,,0,57,0,0,0,0,20,0,0,0,0,1)",
        ),
    ] {
        let body = "G1 X10 Y0 Z2 F100\nX20\nG3 X30 Y10 {R}10\nG1 X0 Y0 Z0\nM30\n";
        let fanuc_program = format!("G0 X0 Y0 Z0\n{fanuc}\n{}", body.replace("{R}", "R"));
        let sinumerik_program = format!("G0 X0 Y0 Z0\n{sinumerik}\n{}", body.replace("{R}", "CR="));
        let points = |dialect, program: &str| -> Vec<[f64; 3]> {
            let contour = Shop::with(dialect, program).contour();
            let ends = contour
                .iter()
                .flat_map(|step| [0.3, 1.0].map(|part| step.shape.point(part)));
            ends.collect()
        };
        let given = points(Dialect::Fanuc, &fanuc_program);
        let wanted = points(Dialect::Sinumerik, &sinumerik_program);
        assert_eq!(given.len(), wanted.len(), "{fanuc}");
        for (a, b) in given.iter().zip(&wanted) {
            let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near, "{fanuc}: {a:?}, not {b:?}");
        }
        if !fanuc.contains("G53.1") {
            let arguments = ["--backend", "program"];
            let given = translated(Dialect::Fanuc, &fanuc_program, &arguments);
            let wanted = translated(Dialect::Sinumerik, &sinumerik_program, &arguments);
            assert_same(&given, &wanted, fanuc);
        }
    }
}

/// The rotary axes turn where CYCLE800 turns them, and the frame is off at the end.
#[test]
fn the_tool_turns_with_the_kinematics() {
    let program =
        "G0 X0 Y0 Z0\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nG43 H1 X0 Y0 Z50.\nG69\nM30\n";
    let shop = Shop::with(Dialect::Fanuc, program);
    let written = shop.accepted(&["--backend", "kinematics"]);
    let calls: Vec<&str> = written
        .lines()
        .filter_map(|line| Some(line.split_once("o<")?.1))
        .collect();
    let wanted = [
        "frame_off> call",
        "trans> call [10] [20] [5]",
        "arot> call [30] [0] [0]",
        "tool_normal> call",
        "frame_off> call",
        "trans> call [10] [20] [5]",
        "arot> call [30] [0] [0]",
        "frame_off> call",
    ];
    for (call, wanted) in calls.iter().zip(wanted) {
        assert!(call.starts_with(wanted), "{call}, not {wanted}\n{written}");
    }
    assert_eq!(calls.len(), wanted.len(), "{written}");
    let shown = shop.refused(&["--backend", "program"]);
    assert!(shown.contains("--backend kinematics"), "{shown}");
}
