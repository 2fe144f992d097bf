//! The examples of the control's manual, and paths worked out from them by hand.

use crate::expected::Path;
use framepath_tool::dialects::Dialect;

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Fagor, &[("part.pim", program)], program);
}

/// One contour four times: as it is, mirrored in X, in Y, and in both. Two mirrors exchange G2 and G3
/// twice.
#[test]
fn mirror_images() {
    let program = "\
%PIEZA,MX--,
G90 G00 X0 Y0 Z0
(CALL 1)\t; Mecaniza \"a\".
G11\t; Imagen espejo en eje X.
(CALL 1)\t; Mecaniza \"b\".
G10 G12\t; Imagen espejo en eje Y.
(CALL 1)\t; Mecaniza \"c\".
G11\t; Imagen espejo en los ejes X e Y.
(CALL 1)\t; Mecaniza \"d\".
M30\t; Fin de programa
(SUB 1)
G91 G01 X30 Y30 F100
Y60
X20 Y-20
X40
G02 X0 Y-40 I0 J-20
G01 X-60
X-30 Y-30
(RET)
";
    let expected = Path::from([0.0; 3])
        .feed(100.0)
        .lines(&[(30., 30.), (30., 90.), (50., 70.), (90., 70.)])
        .cw([90., 30., 0.], (90., 50.))
        .lines(&[(30., 30.), (0., 0.)])
        .lines(&[(-30., 30.), (-30., 90.), (-50., 70.), (-90., 70.)])
        .ccw([-90., 30., 0.], (-90., 50.))
        .lines(&[(-30., 30.), (0., 0.)])
        .lines(&[(30., -30.), (30., -90.), (50., -70.), (90., -70.)])
        .ccw([90., -30., 0.], (90., -50.))
        .lines(&[(30., -30.), (0., 0.)])
        .lines(&[(-30., -30.), (-30., -90.), (-50., -70.), (-90., -70.)])
        .cw([-90., -30., 0.], (-90., -50.))
        .lines(&[(-30., -30.), (0., 0.)]);
    check(program, &expected);
}

/// The second part lies about (60, 30) and is twice as large.
#[test]
fn scale_about_a_zero_that_was_preset() {
    let program = "\
G90 G00 X-30 Y10 Z0
(CALL 1)
G92 X-79 Y-30      ; Preselección de cotas
                   ; (traslado de origen de coordenadas)
G72 S2             ; Aplica factor de escala de 2.
(CALL 1)
G72 S1             ; Anular factor de escala
M30                ; Fin de programa
(SUB 1)
G90 X-19 Y0
G01 X0 Y10 F150
G02 X0 Y-10 I0 J-10
G01 X-19 Y0
(RET)
";
    let expected = Path::from([-30., 10., 0.])
        .rapid([-19., 0., 0.])
        .feed(150.0)
        .lines(&[(0., 10.)])
        .cw([0., -10., 0.], (0., 0.))
        .lines(&[(-19., 0.)])
        .lines(&[(22., 30.), (60., 50.)])
        .cw([60., 10., 0.], (60., 30.))
        .lines(&[(22., 30.)]);
    check(program, &expected);
}

/// To LinuxCNC `(RPT N10,20)` is a comment: the second part would be missing without a word.
#[test]
fn repeated_blocks_at_half_the_size() {
    let program = "\
G90 G00 X0 Y0 Z0
N10 G91 G01 X20 Y10 F100
Y10
X-10
N20 X-10 Y-20
;Factor de escala
G72 S0.5
;Repite del bloque 10 al bloque 20
(RPT N10,20)
M30
";
    let expected = Path::from([0.0; 3])
        .feed(100.0)
        .lines(&[(20., 10.), (20., 20.), (10., 20.), (0., 0.)])
        .lines(&[(10., 5.), (10., 10.), (5., 10.), (0., 0.)]);
    check(program, &expected);
    let program = "\
G90 G00 X20 Y20 Z0
N10 G91 G01 X-10 F100
X-10 Y-20
X20 Y10
N20 Y10
G72 S0.5
(RPT N10,N20)
M30
";
    let expected = Path::from([20., 20., 0.])
        .feed(100.0)
        .lines(&[(10., 20.), (0., 0.), (20., 10.), (20., 20.)])
        .lines(&[(15., 20.), (10., 10.), (20., 15.), (20., 20.)]);
    check(program, &expected);
}

/// The listing of the manual has no F: the control takes the one it had.
#[test]
fn a_feed_from_before_the_program() {
    let program = "G90 G00 X0 Y0 Z0\nN10 G91 G01 X20 Y10\nG72 S0.5\n(RPT N10,N10)\nM30\n";
    let commands = super::translate(program, &["--feed", "250"]);
    assert_eq!(
        commands,
        ["G0 X0 Y0 Z0", "G1 X20 Y10 F250", "G1 X30 Y15", "M30"]
    );
    assert!(super::errors(program, &[]).contains("no F is in force"));
}

#[test]
fn mirror_then_rotation_whatever_came_first() {
    // The centre (10, 0) is mirrored to (-10, 0); (20, 0) becomes (-20, 0), then turns to (-10, -10).
    for (first, second) in [("G11", "G73 Q90 I10 J0"), ("G73 Q90 I10 J0", "G11")] {
        let program = format!("G90 G0 X0 Y0 Z0\n{first}\n{second}\nG1 X20 Y0 F100\nM30\n");
        check(
            &program,
            &Path::from([0.0; 3]).feed(100.0).lines(&[(-10., -10.)]),
        );
    }
}

#[test]
fn angles_of_rotations_add_up() {
    let program = "\
G90 G0 X0 Y0 Z0
N10 G1 X10 Y0 F100
N20 G73 Q45
(RPT N10,N20) N3
G73
G1 X0 Y0
M30
";
    let diagonal = 10.0 * 0.5_f64.sqrt();
    let expected = Path::from([0.0; 3])
        .feed(100.0)
        .lines(&[
            (10., 0.),
            (diagonal, diagonal),
            (0., 10.),
            (-diagonal, diagonal),
        ])
        .lines(&[(0., 0.)]);
    check(program, &expected);
}

#[test]
fn mirror_scale_and_rotation_together() {
    // (6, 2) is mirrored and doubled to (12, -4); seen from the centre (4, -2) that is (8, -2), which
    // turns by 90 degrees to (2, 8): (6, 6).
    let program = "G90 G0 X0 Y0 Z0\nG12\nG72 S2\nG73 Q90 I2 J1\nG1 X6 Y2 F100\nM30\n";
    check(
        program,
        &Path::from([0.0; 3]).feed(100.0).lines(&[(6., 6.)]),
    );
}

#[test]
fn presets_are_not_mirrored() {
    // At X10 the zero goes to 10 - 50 = -40, and X60 mirrored lies at -100.
    let program = "G90 G0 X10 Y0 Z0\nG11\nG92 X50\nG90 X60\nM30\n";
    check(program, &Path::from([10., 0., 0.]).rapid([-100., 0., 0.]));
}

#[test]
fn a_zero_offset_ends_a_preset() {
    let program = "G54\nG90 G0 X10 Y0 Z0\nG92 X50 Y5\nG0 X51\nG54\nG0 X1 Y1\nM30\n";
    let expected = Path::from([10., 0., 0.])
        .rapid([11., 0., 0.])
        .rapid([1., 1., 0.]);
    check(program, &expected);
}

#[test]
fn single_axes_are_mirrored_and_all_at_once() {
    assert_eq!(
        super::translate(
            "G14 W\nG0 X1 W5\nG91 W1\nG10\nW1\nM30\n",
            &["--backend", "program"]
        ),
        ["G0 X1 W-5", "G0 W-6", "G0 W-5", "M30"]
    );
    assert_eq!(
        super::translate(
            "G14 X Z A B\nG0 X1 Y1 Z1 A30 B-5\nM30\n",
            &["--backend", "program"]
        ),
        ["G0 X-1 Y1 Z-1 A-30 B5", "M30"]
    );
    let several = "G90 G0 X0 Y0 Z0\nG11 G12 G13\nG0 X1 Y2 Z3\nM30\n";
    check(several, &Path::from([0.0; 3]).rapid([-1., -2., -3.]));
}

/// Factors for single axes act on the finished path and on the feed with it.
#[test]
fn factors_for_single_axes() {
    let program = "\
G90 G0 X0 Y0 Z0
G72 X2
G1 X10 F100
Y5
X15 Y10
G72 X1
X0
M30
";
    let diagonal = 100.0 * (10.0_f64.powi(2) + 5.0_f64.powi(2)).sqrt() / 50.0_f64.sqrt();
    let expected = Path::from([0.0; 3])
        .feed(200.0)
        .lines(&[(20., 0.)])
        .feed(100.0)
        .lines(&[(20., 5.)])
        .feed(diagonal)
        .lines(&[(30., 10.)])
        .feed(100.0)
        .lines(&[(0., 10.)]);
    check(program, &expected);
}

#[test]
fn both_kinds_of_scale_multiply() {
    let program = "G90 G0 X0 Y0 Z0\nG72 S3\nG72 X2\nG1 X10 F100\nY10\nG72 S1\nX0\nM30\n";
    let expected = Path::from([0.0; 3])
        .feed(200.0)
        .lines(&[(60., 0.)])
        .feed(100.0)
        .lines(&[(60., 30.)])
        .feed(200.0)
        .lines(&[(0., 30.)]);
    check(program, &expected);
}

/// Equal factors in the plane keep arcs, as the program backend writes them, and their feed grows.
#[test]
fn equal_factors_keep_arcs() {
    let program = "G90 G0 X10 Y0 Z0\nG72 X2 Y2\nG3 X0 Y10 I-10 J0 F100\nM30\n";
    // From (10, 0), which is (5, 0) of the program, the arc about (-5, 0) would not end at (0, 10).
    assert!(super::errors(program, &[]).contains("the radius is"));
    let program = "G90 G0 X0 Y0 Z0\nG72 X2 Y2\nG1 X10 F100\nG3 X0 Y10 I-10 J0\nM30\n";
    let expected = Path::from([0.0; 3])
        .feed(200.0)
        .lines(&[(20., 0.)])
        .ccw([0., 20., 0.], (0., 0.));
    check(program, &expected);
}
