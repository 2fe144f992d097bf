//! Forms of motion and calls of the Sinumerik-like dialect, against paths written down by hand.

use crate::expected::Path;
use crate::shop::{Shop, commands, refused, translate};
use framepath_tool::dialects::Dialect;

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Sinumerik, &[("part.mpf", program)], program);
}

/// The error text of a program that must be refused.
fn errors(program: &str) -> String {
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    refused(&shop.run("part.mpf", &[]))
}

/// The contour of the seed's own examples: a triangle with a round corner.
const L10: &str = "G0 X0 Y0\nG1 X10 F300\nG3 X10 Y10 CR=5\nG1 X0\nY0\nM17\n";

/// A place of a frame with this origin and angle in the plane, scaled.
fn placed((x0, y0): (f64, f64), degrees: f64, scale: f64) -> impl Fn(f64, f64) -> (f64, f64) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |x, y| {
        (
            x0 + scale * (x * cos - y * sin),
            y0 + scale * (x * sin + y * cos),
        )
    }
}

fn contour(path: Path, at: &dyn Fn(f64, f64) -> (f64, f64)) -> Path {
    let flat = |(x, y): (f64, f64)| [x, y, 0.0];
    path.rapid(flat(at(0., 0.)))
        .feed(300.0)
        .lines(&[at(10., 0.)])
        .ccw(flat(at(10., 10.)), at(10., 5.))
        .lines(&[at(0., 10.), at(0., 0.)])
}

#[test]
fn the_seeds_shifted_and_turned_contours() {
    let program = "\
N10 G17 G54 ;Plano de trabajo X/Y, sistema coordenado de pieza en origen
N15 G0 X0 Y0 Z0
N20 TRANS X20 Y10 ;Traslación absoluta
N30 L10 ;LLamada a subprograma
N40 TRANS X55 Y35 ;Traslación absoluta
N50 AROT RPL=45 ;Rotación aditiva del sistema en el plano a 45°
N60 L10 ;LLamada a subprograma
N70 TRANS X20 Y40 ;Traslación absoluta
;(cancela transformaciones previas)
N80 AROT RPL=60 ;Rotación aditiva en el plano a 60°
N90 L10 ;LLamada a subprograma
N100 G0 X100 Y100 ;Retracción
N110 M30 ;Fin de programa
";
    let mut expected = Path::from([0.0; 3]);
    expected = contour(expected, &placed((20., 10.), 0., 1.));
    expected = contour(expected, &placed((55., 35.), 45., 1.));
    let last = placed((20., 40.), 60., 1.);
    let (x, y) = last(100., 100.);
    expected = contour(expected, &last).rapid([x, y, 0.]);
    let files = [("part.mpf", program), ("L10.spf", L10)];
    expected.check(Dialect::Sinumerik, &files, "shifted and turned");
}

#[test]
fn the_seeds_scaled_contour() {
    let program = "\
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N15 G0 X0 Y0 Z0
N20 TRANS X15 Y15 ;Traslación (cancela transformaciones previas)
N30 L10 ;Mecanizado de geometría grande
N40 TRANS X40 Y20 ;Traslación (cancela transformaciones previas)
N50 AROT RPL=35 ;Rotación en el plano 35°, aditiva
N60 ASCALE X0.7 Y0.7 ;Factor de escalado para la geometría pequeña
N70 L10 ;Mecanizado de geometría pequeña
N80G0 X300 Y100 M30 ;Retracción, fin de programa
";
    let mut expected = contour(Path::from([0.0; 3]), &placed((15., 15.), 0., 1.));
    let small = placed((40., 20.), 35., 0.7);
    let (x, y) = small(300., 100.);
    expected = contour(expected, &small).rapid([x, y, 0.]);
    let files = [("part.mpf", program), ("l10.spf", L10)];
    expected.check(Dialect::Sinumerik, &files, "scaled");
}

#[test]
fn the_seeds_mirrored_contours() {
    let program = "\
N10 G17 G54 ;Plano de trabajo XY, sistema de coordenada de pieza G54
N15 G0 X0 Y0 Z0
N20 L10 ;Mecanizado de la primera geometría, arriba a la derecha
N30 MIRROR X0 ;Espejado del eje X (el sentido se invierte en X)
N40 L10 ;Mecanizado de la segunda geometría, arriba a la izquierda
N50 AMIRROR Y0 ;Espejado del eje Y aditiva (el sentido también se invierte en Y)
N60 L10 ;Mecanizado de la tercer geometría, abajo a la izquierda
N70 MIRROR Y0 ;Cancela espejados previos. Espejado del eje Y
N80 L10 ;Mecanizado de la cuarta geometría, abajo a la derecha
N90 MIRROR ;Desactivar espejado
N100 G0 X300 Y100 M30 ;Retracción, fin de programa
";
    let l10 = "G0 X20 Y10\nG1 X30 F300\nG3 X30 Y20 CR=5\nG1 X20\nY10\nM17\n";
    let mut expected = Path::from([0.0; 3]);
    for (x, y) in [(1., 1.), (-1., 1.), (-1., -1.), (1., -1.)] {
        expected = expected
            .rapid([20. * x, 10. * y, 0.])
            .lines(&[(30. * x, 10. * y)]);
        let (end, centre) = ([30. * x, 20. * y, 0.], (30. * x, 15. * y));
        expected = match x * y > 0.0 {
            true => expected.ccw(end, centre),
            false => expected.cw(end, centre),
        };
        expected = expected.lines(&[(20. * x, 20. * y), (20. * x, 10. * y)]);
    }
    let files = [("part.mpf", program), ("L10.SPF", l10)];
    expected
        .rapid([300., 100., 0.])
        .check(Dialect::Sinumerik, &files, "mirrored");
}

#[test]
fn rounded_and_chamfered_corners() {
    let program = "\
G0 X0 Y0 Z0
G1 X20 F100 RND=5
Y20 CHF=2
X0 CHR=3
Y0
M30
";
    let leg = 2.0 * 0.5_f64.sqrt();
    let expected = Path::from([0.0; 3])
        .feed(100.0)
        .lines(&[(15., 0.)])
        .ccw([20., 5., 0.], (15., 5.))
        .lines(&[
            (20., 20. - leg),
            (20. - leg, 20.),
            (3., 20.),
            (0., 17.),
            (0., 0.),
        ]);
    check(program, &expected);
    let modal = "G0 X0 Y0 Z0\nRNDM=2\nG1 X20 F100\nY20\nRNDM=0 X0\nY0\nM30\n";
    let expected = Path::from([0.0; 3])
        .lines(&[(18., 0.)])
        .ccw([20., 2., 0.], (18., 2.))
        .lines(&[(20., 18.)])
        .ccw([18., 20., 0.], (18., 18.))
        .lines(&[(0., 20.), (0., 0.)]);
    check(modal, &expected);
    // The contour ends without a rounding.
    let begin = "G0 X0 Y0 Z0\nRNDM=2\nG1 X20 F100\nY20\n";
    let contour = Path::from([0.0; 3])
        .lines(&[(18., 0.)])
        .ccw([20., 2., 0.], (18., 2.))
        .lines(&[(20., 20.)]);
    for end in ["", "G0 Z9\n", "G1 Z9\n", "G0 X0\n", "G1 A9\n", "G18\n"] {
        let begin = begin.replace("Z0", "Z0 A0");
        let written = commands(&translate(&format!("{begin}{end}M30\n"), &[]));
        let until = written.iter().position(|line| line.ends_with(" Y20"));
        let until = until.unwrap_or_else(|| panic!("{end}{written:?}"));
        assert!(
            !written[until..].iter().any(|line| line.starts_with("G3")),
            "{end}"
        );
    }
    check(&format!("{begin}M30\n"), &contour);
    for end in ["G54\nG1 X0\n", "TRANS X1\nG1 X0\n"] {
        let shown = errors(&format!("{begin}{end}M30\n"));
        assert!(shown.contains("(RNDM=0)"), "{shown}");
    }
    let shown = errors("RNDM=2\nG1 X20 F100\nY20\nX0\nM30\n");
    assert!(shown.contains("RNDM=0 ends the rounding"), "{shown}");
    assert!(errors("G0 X5 RND=3\nM30\n").contains("after a rapid motion"));
    assert!(errors("G0 X0 Y0\nG1 X5 F9 RND=3\nM30\n").contains("no motion follows"));
}

#[test]
fn arcs_of_every_form() {
    let quarter = Path::from([10., 0., 0.]).ccw([0., 10., 0.], (0., 0.));
    for arc in [
        "G3 X0 Y10 I-10 J0",
        "G3 X0 Y10 I=AC(0) J=AC(0)",
        "G3 X0 Y10 CR=10",
        "G3 X0 Y10 AR=90",
        "G3 I-10 J0 AR=90",
        "G91 G3 X-10 Y10 AR=90",
        "CIP X0 Y10 I1=6 J1=8",
        "CIP X0 Y10 I1=IC(-4) J1=8",
        "CIP X0 Y10 Z0 I1=6 J1=8 K1=0",
        "CIP X0 Y10 I1=6 J1=8 K1=IC(0)",
        "G111 X0 Y0\nG3 AP=90 RP=10",
        "G110 X-10 Y0\nG3 AP=90 RP=10",
    ] {
        check(&format!("G0 X10 Y0 Z0\nF100\n{arc}\nM30\n"), &quarter);
    }
    let tangent = "G0 X0 Y0 Z0\nG1 X10 F100\nCT X10 Y20\nX0 Y10\nG1 X-5\nM30\n";
    let expected = Path::from([0.0; 3])
        .lines(&[(10., 0.)])
        .ccw([10., 20., 0.], (10., 10.))
        .ccw([0., 10., 0.], (10., 10.))
        .lines(&[(-5., 10.)]);
    check(tangent, &expected);
    for (program, text) in [
        ("G0 X0 Y0\nG2 AR=90 F9\nM30\n", "AR needs either"),
        ("G0 X0 Y0\nG2 X5 AR=400 F9\nM30\n", "an arc of 400 degrees"),
        ("G0 X0 Y0\nG1 X5 AR=40 F9\nM30\n", "AR belongs to arcs"),
        ("G0 X0 Y0\nCIP X5 I1=2 F9\nM30\n", "both coordinates"),
        (
            "G0 X0 Y0 Z0\nCIP X5 I1=2 J1=2 K1=4 F9\nM30\n",
            "an intermediate point outside of the plane",
        ),
        (
            "G0 X0 Y0 Z0\nCIP X5 Z1 I1=2 J1=2 K1=0 F9\nM30\n",
            "leaves the plane behind its intermediate point",
        ),
        (
            "G0 X0 Y0\nCIP X5 I1=2 J1=2 K1=4 F9\nM30\n",
            "where this arc begins along Z is not known",
        ),
        ("G0 X0 Y0\nCT X5 I2 F9\nM30\n", "neither centre nor radius"),
        ("G0 X0 Y0\nG1 X5 I1=2 F9\nM30\n", "belong to CIP"),
    ] {
        let shown = errors(program);
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}

#[test]
fn polar_coordinates() {
    let program = "\
G0 X0 Y0 Z0
G111 X35 Y30
G1 AP=0 RP=25 F100
AP=IC(90)
RP=10
G112 X0 Y-30
AP=180 RP=35 Z2
G110 AP=0 RP=5
G1 AP=90 RP=3
M30
";
    let expected = Path::from([0.0; 3])
        .lines(&[(60., 30.), (35., 55.), (35., 40.)])
        .line([0., 0., 2.])
        .line([5., 3., 2.]);
    check(program, &expected);
    assert!(errors("G1 AP=30 F9\nM30\n").contains("RP has no value yet"));
    // A new pole and another plane take the angle away, the plane that is active anyway does not.
    let begin = "G0 X0 Y0 Z0\nG1 AP=90 RP=10 F100\n";
    for between in ["G111 X0 Y0", "G110 X1 Y1", "G18", "G18\nG17"] {
        let shown = errors(&format!("{begin}{between}\nG1 RP=13\nM30\n"));
        assert!(shown.contains("AP has no value yet"), "{between}\n{shown}");
    }
    let expected = Path::from([0.0; 3]).lines(&[(0., 10.), (0., 13.)]);
    check(&format!("{begin}G17\nG1 RP=13\nM30\n"), &expected);
    assert!(errors("G1 AP=30 RP=5 X3 F9\nM30\n").contains("polar and rectangular"));
}

#[test]
fn subprograms_with_parameters() {
    let program = "\
%_N_PART_MPF
DEF REAL RESULT
DEF INT COUNT=2
POCKET(10, COUNT, RESULT)
G0 X=RESULT
POCKET(1, , RESULT)
G0 X=RESULT
M30
%_N_POCKET_SPF
PROC POCKET(REAL DEPTH, INT TIMES=5, VAR REAL SUM) SAVE
SUM=DEPTH*TIMES
DEPTH=0
M17
";
    assert_eq!(
        commands(&translate(program, &[])),
        ["G0 X20", "G0 X5", "M30"]
    );
    let with = |call: &str| program.replace("POCKET(1, , RESULT)", call);
    assert!(errors(&with("POCKET(1,2,3)")).contains("a variable is needed here"));
    assert!(errors(&with("POCKET(1,2,RESULT,4)")).contains("takes 3 values, and 4 are given"));
    assert!(errors(&with("POCKET(\"A\",2,RESULT)")).contains("a text and a number"));
}

#[test]
fn modal_subprograms() {
    let program = "\
%_N_PART_MPF
G0 X0 Y0 Z10
MCALL HOLE(-3)
X10
S500
Y10
MCALL
X0
M30
%_N_HOLE_SPF
PROC HOLE(REAL DEPTH)
G1 Z=DEPTH F100
G0 Z10
M17
";
    assert_eq!(
        commands(&translate(program, &[])),
        [
            "G0 X0 Y0 Z10",
            "G0 X10",
            "G1 Z-3 F100",
            "G0 Z10",
            "S500",
            "G0 Y10",
            "G1 Z-3 F100",
            "G0 Z10",
            "G0 X0",
            "M30"
        ]
    );
}

#[test]
fn edges_of_a_tool_are_rows_of_the_table() {
    let program = "T3 M6\nD2\nG0 X0 Y0\nG41 G1 X5 F100\nG40 X9\nD1\nM30\n";
    assert_eq!(
        commands(&translate(program, &["--edge", "3.2=13"])),
        [
            "T3 M6 G43",
            "G43 H13",
            "G0 X0 Y0",
            "G41 D13 G1 X5 F100",
            "G40 G1 X9",
            "G43",
            "M30"
        ]
    );
    assert!(errors(program).contains("--edge 3.2=ROW"));
    assert!(errors("D10\nM30\n").contains("D10 is not an edge"));
}

#[test]
fn local_and_suppressed_offsets() {
    let local = "G0 X0 Y0 Z0\nG52 X10 Y5\nG0 X1 Y1\nG52 X0 Y0\nG0 X1\nY1\nM30\n";
    let expected = Path::from([0.0; 3])
        .rapid([11., 6., 0.])
        .rapid([1., 6., 0.])
        .rapid([1., 1., 0.]);
    check(local, &expected);
    assert!(errors("TRANS X5\nG52 X1\nM30\n").contains("G52 while a frame is active"));
    let none = "G500\nG0 X5 Y5\nTRANS X10\nG0 X1\nTRANS\nG54\nG0 X2\nM30\n";
    assert_eq!(
        commands(&translate(none, &["--backend", "program"])),
        [
            "G53 G0 X[5+#5401] Y[5+#5402]",
            "G53 G0 X[11+#5401]",
            "G54",
            "G0 X2",
            "M30"
        ]
    );
}

#[test]
fn swivelled_planes() {
    let program = "\
CYCLE800(0,\"TABLE\",0,57,10,20,30,0,30,45,1,0,0,-1)
TRANS X5
G0 X0 Y0 Z0
TRANS
G0 X1 Y1 Z1
CYCLE800()
G0 X0 Y0 Z0
M30
";
    assert_eq!(
        commands(&translate(program, &[])),
        [
            "(MSG, needs the frame kinematics: line 1: this frame tilts the tool axis)",
            "o<frame_off> call",
            "o<trans> call [10] [20] [30]",
            "o<arot> call [0] [30] [0]",
            "o<arot> call [0] [0] [45]",
            "o<atrans> call [1] [0] [0]",
            "o<tool_normal> call",
            "o<trans> call [10] [20] [30]",
            "o<arot> call [0] [30] [0]",
            "o<arot> call [0] [0] [45]",
            "o<atrans> call [1] [0] [0]",
            "o<atrans> call [5] [0] [0]",
            "G0 X0 Y0 Z0",
            "o<trans> call [10] [20] [30]",
            "o<arot> call [0] [30] [0]",
            "o<arot> call [0] [0] [45]",
            "o<atrans> call [1] [0] [0]",
            "G0 X1 Y1 Z1",
            "o<frame_off> call",
            "G0 X0 Y0 Z0",
            "M30"
        ]
    );
    // About Z, then Y, then X.
    let other = translate(
        "CYCLE800(0,,0,27,0,0,0,10,20,30,0,0,0,0)\nG0 X0 Y0 Z0\nM30\n",
        &[],
    );
    let calls: Vec<&str> = other.lines().filter(|line| line.contains("rot>")).collect();
    assert!(calls[0].starts_with("o<rot> call [0] [0] [10]"));
    assert!(calls[1].starts_with("o<arot> call [0] [20] [0]"));
    assert!(calls[2].starts_with("o<arot> call [30] [0] [0]"));
    assert!(!other.contains("tool_normal"));
    assert!(errors("CYCLE800(0,,0,192,0,0,0,10,0,0)\nM30\n").contains("MODE = 192"));
}

/// The values of a modal call are those of its MCALL, whatever becomes of its variables, and whoever moves.
#[test]
fn modal_calls_keep_their_values() {
    let program = "\
%_N_PART_MPF
DEF REAL DEPTH=5
DEF STRING[8] NAME
R1=2
F100
G0 X0 Y0 Z10
MCALL CYCLE81(10,0,R1,-DEPTH)
PLACES
R1=7 DEPTH=9
G0 X30
MCALL HOLE(R1) P=R1-5
R1=1
X40
MCALL
M30
%_N_PLACES_SPF
PROC PLACES
DEF REAL DEPTH=20
G0 X10
M17
%_N_HOLE_SPF
PROC HOLE(REAL DEPTH)
G1 Z=-DEPTH
M17
";
    let program = program
        .replace("DEF STRING[8] NAME\n", "")
        .replace(" P=R1-5", "");
    assert_eq!(
        commands(&translate(&program, &["--backend", "program"])),
        [
            "F100",
            "G0 X0 Y0 Z10",
            "G0 X10",
            "G0 Z2",
            "G1 Z-5",
            "G0 Z10",
            "G0 X30",
            "G0 Z2",
            "G1 Z-5",
            "G0 Z10",
            "G0 X40",
            "G1 Z-7",
            "M30"
        ]
    );
    let returns = program
        .replace("PROC HOLE(REAL", "PROC HOLE(VAR REAL")
        .replace("HOLE(R1)", "HOLE(DEPTH)");
    let shown = errors(&returns);
    assert!(
        shown.contains("a modal call, and DEPTH returns a value"),
        "{shown}"
    );
}
