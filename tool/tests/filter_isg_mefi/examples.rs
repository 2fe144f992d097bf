//! The examples of the manuals, listing by listing, against paths worked out by hand. Every one runs
//! through both backends.

use crate::machine;
use crate::path::{Step, assert_same, clockwise, counterclockwise, line, steps};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// The contour that the MEFI examples call: `G79 L100`.
const L100: &str = "\
N1000 G79 L100    “Подпрограмма L100”
N1010 G01 X0 Y0
N1020 G01 X30 Y20 G41 D3
N1030 G02 X50 Y24.849 I16.641 J-24.962
N1040 G03 X30 Y73.484 I3.359 J29.811
N1050 G01 X20 Y61.075
N1060 G01 X30 Y20
N1070 G01 X0 Y0 G40
N1080 G70
";

/// The centre of the arc of an example: its coordinates are rounded, so that it is not equally far
/// from both ends. The nearest point that is.
fn centre(start: [f64; 2], end: [f64; 2], offset: [f64; 2]) -> [f64; 2] {
    let chord = [end[0] - start[0], end[1] - start[1]];
    let middle = [0.5 * chord[0], 0.5 * chord[1]];
    let off = ((offset[0] - middle[0]) * chord[0] + (offset[1] - middle[1]) * chord[1])
        / (chord[0] * chord[0] + chord[1] * chord[1]);
    [
        start[0] + offset[0] - off * chord[0],
        start[1] + offset[1] - off * chord[1],
    ]
}

/// L100 by hand: signs for mirrored axes, a factor, a shift. Begins at its (30, 20): the way to its
/// (0, 0) depends on where the tool is.
fn contour(signs: [f64; 2], factor: f64, shift: [f64; 2]) -> Vec<Step> {
    let at = |[x, y]: [f64; 2]| {
        [
            shift[0] + signs[0] * factor * x,
            shift[1] + signs[1] * factor * y,
        ]
    };
    let to = |x: f64, y: f64| {
        let [x, y] = at([x, y]);
        line(x, y)
    };
    let (a, b, c) = ([30.0, 20.0], [50.0, 24.849], [30.0, 73.484]);
    let first = at(centre(a, b, [16.641, -24.962]));
    let second = at(centre(b, c, [3.359, 29.811]));
    let mirrored = signs[0] * signs[1] < 0.0;
    let arc = |[x, y]: [f64; 2], centre, left: bool| match left != mirrored {
        true => counterclockwise(x, y, centre),
        false => clockwise(x, y, centre),
    };
    vec![
        to(30.0, 20.0),
        arc(at(b), first, false),
        arc(at(c), second, true),
        to(20.0, 61.075),
        to(30.0, 20.0),
        to(0.0, 0.0),
    ]
}

struct Example {
    name: &'static str,
    dialect: Dialect,
    program: String,
    path: Vec<Step>,
    /// Scaling under cutter compensation is for the backend that rewrites.
    kinematics: bool,
}

fn mefi_mirror() -> Example {
    Example {
        name: "MEFI 13.2, mirror",
        dialect: Dialect::Mefi,
        program: format!(
            "\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 “Вызов подпрограммы - A
N30 G35 X0 “Отражение (переводит направление X)
N40 G71 L100 “Вызов подпрограммы - B
N50 G35 X0 Y0 “Отражение (переводит направление X, Y)
N60 G71 L100 “Вызов подпрограммы - C
N70 G35 Y0 “Отражение (переводит направление Y)
N80 G71 L100 “Вызов подпрограммы - D
N90 G35 “Отмена отражения
N99 M30
“Подпрограмма с коррекцией радиуса
{L100}"
        ),
        path: [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
            .into_iter()
            .flat_map(|signs| contour(signs, 1.0, [0.0, 0.0]))
            .collect(),
        kinematics: true,
    }
}

fn mefi_scale() -> Example {
    Example {
        name: "MEFI 13.3, scale",
        dialect: Dialect::Mefi,
        program: format!(
            "\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 D3           \"Вызов подпрограммы - А
N30 G36 X1.54 Y3.28       \"Изменение масштаба уменьшения 1.54/3.28 = 0.46951
N40 G71 L100 D4           \"Вызов подпрограммы - В
N50 G35 Y0                \"Отражение (переводит направление Y)
N50 G36 X1.27             \"Изменение масштаба увеличения 1.27
N60 G71 L100 D5           \"Вызов подпрограммы - С
N90 G35                   \"Отмена отражения
N95 G36                   \"Отмена изменения масштаба
N99 M30
{}",
            L100.replace(" D3", "")
        ),
        path: [
            contour([1.0, 1.0], 1.0, [0.0, 0.0]),
            contour([1.0, 1.0], 1.54 / 3.28, [0.0, 0.0]),
            contour([1.0, -1.0], 1.27, [0.0, 0.0]),
        ]
        .concat(),
        kinematics: false,
    }
}

fn mefi_shift() -> Example {
    Example {
        name: "MEFI 13.4, shift",
        dialect: Dialect::Mefi,
        program: format!(
            "\
%1
N10 X0 Y0 F5000 G23
N20 G71 L100 D3          \"Вызов подпрограммы - А
N30 G37 X80 Y120        \"Независимый сдвиг на (80,120)
N40 G71 L100 D4          \"Вызов подпрограммы - В
N90 G37                  \"Отмена сдвига
N99 M30
{}",
            L100.replace(" D3", "")
        ),
        path: [
            contour([1.0, 1.0], 1.0, [0.0, 0.0]),
            vec![line(80.0, 120.0)],
            contour([1.0, 1.0], 1.0, [80.0, 120.0]),
        ]
        .concat(),
        kinematics: true,
    }
}

fn isg_mirror() -> Example {
    Example {
        name: "ISG, mirror in the plane",
        dialect: Dialect::Isg,
        program: "\
%L DREIECK            (Subroutine)

N10 G90 X10 Y20       (Define the mental)
N20 G91 X10 Y-10      (Coordinates to be mirrored)
N30 X-10 Y-10    
N40 Y20    
N50 M29    

%SPIEGELUNG           (Main program)
N10 G92 G90 X60 Y40   (Reference point offset)
N20 G01 F500          (Straight line at feed 500)
N30 G21               (Mirroring in the X axis)
N40 LL DREIECK        (Call subroutine)
N60 G92 G90 X0 Y0     (Reset the reference point offset)
N70 M30
"
        .to_string(),
        path: vec![
            line(50.0, 60.0),
            line(40.0, 50.0),
            line(50.0, 40.0),
            line(50.0, 60.0),
        ],
        kinematics: true,
    }
}

fn all() -> [Example; 4] {
    [mefi_mirror(), mefi_scale(), mefi_shift(), isg_mirror()]
}

/// The programs of the examples and their paths.
pub fn listings() -> Vec<(Dialect, String, Vec<Step>)> {
    let listing = |example: Example| (example.dialect, example.program, example.path);
    all().into_iter().map(listing).collect()
}

#[test]
fn every_example_runs_along_its_path() {
    for example in all() {
        let shop = Shop::with(example.dialect, &example.program);
        let uncompensated = example.program.replace("G41", "").replace("G40", "");
        let contour = Shop::with(example.dialect, &uncompensated).contour();
        assert_same(&steps(&contour), &example.path, example.name);
        for backend in ["program", "kinematics"] {
            if backend == "kinematics" && !example.kinematics {
                let shown = shop.refused(&["--backend", backend]);
                assert!(shown.contains("cutter compensation under"), "{shown}");
                continue;
            }
            let output = shop.accepted(&["--backend", backend]);
            let path = machine::run(&output);
            assert_same(
                &path,
                &example.path,
                &format!("{}, {backend}", example.name),
            );
        }
    }
}

/// `--dialect auto` recognises each of them.
#[test]
fn the_language_is_guessed() {
    for example in all() {
        let backend = ["--backend", "program"];
        let guessed = Shop::with(Dialect::Auto, &example.program).accepted(&backend);
        assert_same(&machine::run(&guessed), &example.path, example.name);
    }
}

/// Without compensation the scaled example can go both ways.
#[test]
fn the_scaled_example_without_compensation_is_the_same_both_ways() {
    let example = mefi_scale();
    let program = example.program.replace("G41", "").replace("G40", "");
    let shop = Shop::with(example.dialect, &program);
    for backend in ["program", "kinematics"] {
        let output = shop.accepted(&["--backend", backend]);
        assert_same(&machine::run(&output), &example.path, backend);
    }
}

/// Numbers of the specification, four decimals.
#[test]
fn the_points_that_the_manuals_name() {
    let scaled = contour([1.0, 1.0], 1.54 / 3.28, [0.0, 0.0]);
    let mirrored = contour([1.0, -1.0], 1.27, [0.0, 0.0]);
    let shifted = contour([1.0, 1.0], 1.0, [80.0, 120.0]);
    for (given, wanted) in [
        (scaled[0].end(), [14.0854, 9.3902]),
        (scaled[2].end(), [14.0854, 34.5016]),
        (mirrored[0].end(), [38.1, -25.4]),
        (mirrored[2].end(), [38.1, -93.3247]),
        (shifted[0].end(), [110.0, 140.0]),
    ] {
        assert!((given[0] - wanted[0]).abs() < 6e-5 && (given[1] - wanted[1]).abs() < 6e-5);
    }
    // The first arc's centre is given in three decimals, before it is made to fit.
    let Step::Arc(_, centre, _) = shifted[1] else {
        panic!("an arc");
    };
    assert!((centre[0] - 126.641).abs() < 2e-3 && (centre[1] - 115.038).abs() < 2e-3);
    assert!(matches!(mirrored[1], Step::Arc(_, _, true)));
    assert!(matches!(mirrored[2], Step::Arc(_, _, false)));
}

/// The one-line examples of MEFI 13.2 to 13.4: where they take (10, 20).
#[test]
fn the_short_examples_of_mefi() {
    for (command, wanted) in [
        ("G35 X0", [-10.0, 20.0]),
        ("G35 Y0", [10.0, -20.0]),
        ("G35 X0 Y0", [-10.0, -20.0]),
        ("G35 Y0 U0 C0", [10.0, -20.0]),
        ("G35 X0\nG35", [10.0, 20.0]),
        ("G36 X1.27", [12.7, 25.4]),
        ("G36 Y0.38", [3.8, 7.6]),
        ("G36 X1.54 Y5.28", [2.916_666_667, 5.833_333_333]),
        ("G36 X2\nG36", [10.0, 20.0]),
        ("G37 X10.127", [20.127, 20.0]),
        ("G37 X-0.138 Y12", [9.862, 32.0]),
        ("G37 X5\nG37", [10.0, 20.0]),
        ("G35 X0\nG36 X2\nG37 X1\nG34", [10.0, 20.0]),
    ] {
        let program = format!("{command}\nG01 X10 Y20 F100\nM30\n");
        let shop = Shop::with(Dialect::Mefi, &program);
        let path = [line(wanted[0], wanted[1])];
        assert_same(&steps(&shop.contour()), &path, command);
        for backend in ["program", "kinematics"] {
            let output = shop.accepted(&["--backend", backend]);
            assert_same(&machine::run(&output), &path, command);
        }
    }
}
