//! Irregular pockets: against plain LinuxCNC code, and against the material that they must take away.

use super::pockets::{ARGUMENTS, HEAD, assert_same_program, distance, shop, translated};
use crate::one_error::assert_one_error;
use crate::shop::{commands, refused};
use proptest::prelude::*;

const SQUARE: &str = "N400 G0 G90 X0 Y0 Z0\nG1 X40\nY40\nX0\nN500 Y0\n";

const ROUGH: &str = "N200 G67 B4 C7 I-6 R2 V80 F300";

/// A pocket of these operations and contours, with the labels of the manual.
fn program(labels: &str, operations: &str, contours: &str) -> String {
    format!("G66 {labels} S400 E500\nG0 X0 Y0\nM30\n{operations}\n{contours}")
}

/// Roughing of the square, seen from its corner, in rounds that lie so far from the wall.
fn rough_square([x, y]: [f64; 2], rounds: [f64; 3]) -> String {
    let inner = rounds[0];
    let lines = rounds.map(|from| {
        let [left, right] = [x + from, x + 40. - from];
        let [below, above] = [y + from, y + 40. - from];
        let link = match from == inner {
            true => String::new(),
            false => format!("Y{below}\n"),
        };
        format!(
            "{link}X{right} Y{below}\nY{above}\nX{left}\nY{below}\nX{}\n",
            x + inner
        )
    });
    let layer = |near: f64, floor: f64| {
        let (x, y) = (x + inner, y + inner);
        format!(
            "G0 X{x} Y{y}\nZ{near}\nG1 Z{floor} F80\nF300\n{}G0 Z2\n",
            lines.concat()
        )
    };
    format!("F300\n{}{}Z20\n", layer(2., -3.), layer(-2., -6.))
}

/// Rounds 6 and 13 mm from the wall, and one at 18, as behind 13 + 5 the tool would leave the middle.
const ROUNDS: [f64; 3] = [18., 13., 6.];

#[test]
fn a_square_is_roughed_from_the_middle_and_finished_along_its_wall() {
    let rough = rough_square([0., 0.], ROUNDS);
    let plain = format!(
        "{rough}F150\nX15 Y10\nZ2\nG1 Z-6 F50\nG3 X20 Y5 I5 J0 F150\nG1 X35\nY35\nX5\nY5\nX20\n\
         G3 X25 Y10 I0 J5\nG0 Z2\nZ20\n"
    );
    let operations = format!("{ROUGH}\nN300 G68 B0 L1 V50 F150");
    assert_same_program(&program("R200 F300", &operations, SQUARE), &plain);
    // Q1 goes round the other way; the blocks of an operation may be several.
    let operations = "N200 S1000\nG67 B4 C7 I-6 R2 V80 F300\nN210 M8\nN300 G68 L-1 Q1 I-5 V50 F150";
    let plain = format!(
        "{rough}F150\nG0 X25 Y10\nZ2\nG1 Z-5 F50\nG2 X20 Y5 I-5 J0 F150\nG1 X5\nY35\nX35\nY5\nX20\n\
         G2 X15 Y10 I0 J5\nG0 Z2\nZ20\n"
    );
    assert_same_program(&program("R200 C210 F300", operations, SQUARE), &plain);
}

#[test]
fn holes_lie_where_roughing_plunges() {
    // Above the hole, roughing goes down at once.
    let rough = rough_square([0., 0.], [19., 12., 5.]).replacen("G0 X19 Y19\n", "G0 ", 1);
    let plain = format!("F90\nX19 Y19\nZ2\nG1 Z-7\nG0 Z2\nZ20\n{rough}");
    let operations = format!("N100 G81 G99 Z2 I-7 F90\n{ROUGH}");
    assert_same_program(&program("D100 R200", &operations, SQUARE), &plain);
}

#[test]
fn increments_inches_and_frames_reach_the_contours() {
    let shifted = "N400 G0 G90 X60 Y20 Z0\nG91 G1 X40\nY40\nX-40\nN500 Y-40\n";
    let plain = rough_square([60., 20.], [19., 12., 5.]);
    assert_same_program(&program("R200", ROUGH, shifted), &plain);
    let inch = "N400 G0 G90 G70 X0 Y0 Z0\nG1 X1\nY1\nX0\nN500 Y0\n";
    let output = translated(&shop(&format!("{HEAD}{}", program("R200", ROUGH, inch))));
    assert!(output.contains("G1 X20.4"), "{output}");
    let turned = format!("{HEAD}G11\n{}", program("R200", ROUGH, SQUARE));
    let output = translated(&shop(&turned));
    assert!(output.contains("G1 X-35 Y5"), "{output}");
}

#[test]
fn roundings_and_arcs_are_walls() {
    let contours = "N400 G0 G90 X0 Y0 Z0\nG1 G36 R8 X40\nG39 R6 Y40\nX0\nY0\n\
                    G0 X22 Y20\nN500 G2 G6 X22 Y20 I20 J20\n";
    let operations = format!("{ROUGH}\nN300 G68 L1 F150");
    let output = translated(&shop(&format!(
        "{HEAD}{}",
        program("R200 F300", &operations, contours)
    )));
    // The rounding, 5 mm inside; the island, 5 mm outside, by an arc of 7 mm.
    assert!(output.contains("G3 X35 Y8 I0 J3"), "{output}");
    assert!(output.contains("I-7 J"), "{output}");
}

/// Corners of contours, with the lines of the program.
fn contour_blocks(contours: &[Vec<[f64; 2]>]) -> String {
    let mut text = String::new();
    for (index, contour) in contours.iter().enumerate() {
        let (label, height) = if index == 0 {
            ("N400 ", " Z0")
        } else {
            ("", "")
        };
        let [x, y] = contour[0];
        text += &format!("{label}G0 G90 X{x:.3} Y{y:.3}{height}\n");
        for (number, [x, y]) in contour.iter().skip(1).chain(&contour[..1]).enumerate() {
            let last = index + 1 == contours.len() && number + 1 == contour.len();
            text += &format!("{}G1 X{x:.3} Y{y:.3}\n", if last { "N500 " } else { "" });
        }
    }
    text
}

/// What the tool passes at a depth: places close to each other, from one plunge to the next withdrawal.
fn ways(output: &str, floor: f64) -> Vec<Vec<[f64; 2]>> {
    let mut place = [0.0; 2];
    let mut ways: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut deep = false;
    for line in commands(output) {
        let value = |letter: char| -> Option<f64> {
            let word = line.split(' ').find(|word| word.starts_with(letter))?;
            word[1..].parse().ok()
        };
        let next = [
            value('X').unwrap_or(place[0]),
            value('Y').unwrap_or(place[1]),
        ];
        if let Some(height) = value('Z') {
            deep = (height - floor).abs() < 1e-9;
            ways.extend(deep.then(|| vec![next]));
        } else if let (true, Some(way)) = (deep, ways.last_mut()) {
            let clockwise = line.contains("G2 ");
            match (value('I'), value('J')) {
                (Some(i), Some(j)) => way.extend(arc(place, next, [i, j], clockwise)),
                _ => way.push(next),
            }
        }
        place = next;
    }
    ways
}

fn arc(from: [f64; 2], to: [f64; 2], offset: [f64; 2], clockwise: bool) -> Vec<[f64; 2]> {
    let centre = [from[0] + offset[0], from[1] + offset[1]];
    let angle = |place: [f64; 2]| (place[1] - centre[1]).atan2(place[0] - centre[0]);
    let radius = offset[0].hypot(offset[1]);
    let turn = angle(to) - angle(from);
    let turn = match clockwise {
        true => -(-turn).rem_euclid(std::f64::consts::TAU),
        false => turn.rem_euclid(std::f64::consts::TAU),
    };
    let at = |number: u32| {
        let angle = angle(from) + turn * f64::from(number) / 40.0;
        [
            centre[0] + radius * angle.cos(),
            centre[1] + radius * angle.sin(),
        ]
    };
    (1..=40).map(at).collect()
}

fn walls(contours: &[Vec<[f64; 2]>]) -> Vec<[[f64; 2]; 2]> {
    let closed = contours.iter().flat_map(|contour| {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(a, b)| [*a, *b])
    });
    closed.collect()
}

fn least(lines: &[[[f64; 2]; 2]], place: [f64; 2]) -> f64 {
    let away = lines.iter().map(|line| distance(*line, place));
    away.fold(f64::INFINITY, f64::min)
}

/// Whether a place lies inside of a contour.
fn inside(contour: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crossed = walls(&[contour.to_vec()]).into_iter().filter(|[a, b]| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// All that the tool reaches is gone, and nothing at the walls and islands.
fn check(contours: &[Vec<[f64; 2]>], more: &str, allowance: f64) -> Result<(), TestCaseError> {
    const RADIUS: f64 = 5.0;
    let rough = format!("N200 G67 B9 I-4 R2 F300 {more}");
    let finish = format!("N300 G68 L{allowance} F150");
    let (labels, operations) = match allowance > 0.0 {
        true => ("R200 F300", format!("{rough}\n{finish}")),
        false => ("R200", rough),
    };
    let text = program(labels, &operations, &contour_blocks(contours));
    let shop = shop(&format!("{HEAD}{text}"));
    let output = translated(&shop);
    let walls = walls(contours);
    let ways = ways(&output, -4.0);
    prop_assert!(!ways.is_empty());
    for place in ways.iter().flatten() {
        let away = least(&walls, *place);
        prop_assert!(away > RADIUS - 3e-6, "{place:?} {away}\n{text}");
    }
    let lines = ways
        .iter()
        .flat_map(|way| way.windows(2).map(|line| [line[0], line[1]]));
    let lines: Vec<_> = lines.collect();
    for x in -30..=30 {
        for y in -30..=30 {
            let place = [f64::from(x) * 1.7, f64::from(y) * 1.7];
            let within = contours
                .iter()
                .enumerate()
                .all(|(index, contour)| inside(contour, place) == (index == 0));
            if within && least(&walls, place) > RADIUS + allowance + 1e-3 {
                let left = least(&lines, place);
                prop_assert!(left < RADIUS + 1e-2, "{place:?} is left: {left}\n{text}");
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    /// A polygon round the middle with rectangular islands that keep away from it and from each other.
    #[test]
    fn nothing_is_left_and_no_wall_is_cut(
        corners in prop::collection::vec(38..50i32, 5..9),
        islands in prop::collection::vec((any::<bool>(), 1..9i32, 1..9i32), 4),
        more in prop_oneof![Just(""), Just("C9.9"), Just("C3"), Just("A30")],
        allowance in prop_oneof![Just(0.0), Just(0.7)],
    ) {
        let count = corners.len() as f64;
        let outline = corners.into_iter().enumerate().map(|(index, out)| {
            let angle = std::f64::consts::TAU * index as f64 / count;
            [angle.cos(), angle.sin()].map(|value| (value * f64::from(out) * 1e3).round() / 1e3)
        });
        let mut contours = vec![outline.collect::<Vec<_>>()];
        for ([x, y], (there, width, height)) in [[-15., -15.], [7., -14.], [7., 8.], [-14., 7.]].into_iter().zip(islands) {
            let [right, above] = [x + f64::from(width), y + f64::from(height)];
            let island = vec![[x, y], [x, above], [right, above], [right, y]];
            contours.extend(there.then_some(island));
        }
        check(&contours, more, allowance)?;
    }
}

#[test]
fn the_operator_hears_of_tools_angles_and_hidden_contours() {
    let contours = format!(
        "{}G0 X15 Y15\nG1 X25\nY25\nX15\nY15\nG0 X18 Y18\nG1 X20\nY20\nN500 X18 Y18\n",
        SQUARE
            .replace("N500 ", "")
            .replace("40", "90")
            .replace("N900", "N400")
    );
    let operations = "N200 G67 A30 B4 I-6 R2 F300\nN300 G68 L1 F150";
    let output = translated(&shop(&format!(
        "{HEAD}{}",
        program("R200 F300", operations, &contours)
    )));
    for text in [
        "G67 is milled with the diameter 10 of T3 in the tool table",
        "G68 is milled with the diameter 10 of T3 in the tool table",
        "A asks for parallel cuts",
        "this contour lies inside of an island",
    ] {
        assert!(output.contains(text), "{text}\n{output}");
    }
}

/// One error at this line, counted from G66 as 5, with this text.
fn one_error(text: &str, place: &str, words: &str) {
    let text = format!("{HEAD}{text}");
    let shown = refused(&shop(&text).run_in("fagor", "part.pim", &ARGUMENTS));
    assert_one_error(&shown, &text, &format!("part.pim:{place}"), words);
}

#[test]
fn words_that_are_refused() {
    let with = |labels: &str, operations: &str| program(labels, operations, SQUARE);
    for (labels, place, words) in [
        ("R200 Q7", "5:10", "in another program"),
        ("R200 X5", "5:10", "the address X does not belong here"),
        ("R200 R210", "5:10", "the address R does not belong here"),
        ("C200", "5:5", "has the last block C and not the first one"),
        ("R250", "5:5", "there is no block N250"),
        ("R500", "5:5", "G67 does not stand in the blocks"),
        ("R200 C190", "5:10", "the last block stands before"),
        ("", "5:1", "neither roughing nor finishing"),
        ("R1.5", "5:6", "a whole number"),
    ] {
        one_error(&with(labels, &format!("N190 T3\n{ROUGH}")), place, words);
    }
    for (rough, words) in [
        ("G67 C7 I-6 R2 F300", "G67 needs B"),
        ("G67 B4 C7 R2 F300", "G67 needs I"),
        ("G67 B4 C7 I-6 F300", "G67 needs R"),
        ("G67 B4 C7 I-6 R2", "no F is in force"),
        ("G67 B4 C11 I-6 R2 F300", "wider than the tool"),
        ("G67 B4 C-3 I-6 R2 F300", "the step C is below 0"),
        ("G67 B4 I6 R2 F300", "the bottom I below the surface"),
        ("G67 B4 I-6 R22 F300", "the tool above R"),
        ("G67 B4 I-6 R2 Q30 F300", "plunging at an angle"),
        ("G67 B4 I-6 R2 K2 F300", "K is 0 or 1"),
        ("G67 B4 I-6 R2 X3 F300", "does not belong to this operation"),
        (
            "G67 B4 I-6 R2 F300 M30",
            "does not belong to this operation",
        ),
        ("G67 B4 I-6 R2 F300 T5 M6", "needs the diameter of T5"),
    ] {
        let text = with("R200", &format!("N200 {rough}"));
        let shown =
            refused(&shop(&format!("{HEAD}{text}")).run_in("fagor", "part.pim", &ARGUMENTS));
        assert!(
            shown.contains(words) && shown.contains("part.pim:8:"),
            "{rough}\n{shown}"
        );
        assert!(shown.contains("\n1 error: "), "{rough}\n{shown}");
    }
    for (finish, words) in [
        ("G68 B0 I-6 R2 F300", "G68 needs L"),
        ("G68 L1 R2 F300", "G68 needs I"),
        ("G68 L1 I-6 R2 J3 F300", "J belongs to 3D pockets"),
        ("G68 L1 I-6 R2 Q2 F300", "Q of G68 is 0 or 1"),
    ] {
        let text = with("F300", &format!("N300 {finish}"));
        let shown =
            refused(&shop(&format!("{HEAD}{text}")).run_in("fagor", "part.pim", &ARGUMENTS));
        assert!(
            shown.contains(words) && shown.contains("part.pim:8:"),
            "{finish}\n{shown}"
        );
        assert!(shown.contains("\n1 error: "), "{finish}\n{shown}");
    }
    let twice = format!("{ROUGH}\nN210 G67 B4 I-6 R2");
    one_error(&with("R200 C210", &twice), "9:1", "a second G67");
    let drill = format!("N100 G81 X3 Y3 Z2 I-7\n{ROUGH}");
    one_error(
        &with("D100 R200", &drill),
        "8:1",
        "a place beside the holes",
    );
    one_error(
        &format!("G81 X1 Y2 Z2 I-5 F100\n{}", with("R200", ROUGH)),
        "6:1",
        "G80",
    );
    one_error(
        &format!("G1 G41 X1 Y2 F100\n{}", with("R200", ROUGH)),
        "6:1",
        "G40",
    );
}

#[test]
fn contours_that_are_refused() {
    let square = |size: f64, x: f64| {
        let end = x + size;
        format!("G1 X{end}\nY{end}\nX{x}\nY{x}\n")
    };
    let big = format!("N400 G0 G90 X0 Y0 Z0\n{}", square(60., 0.));
    let end = "N500\n";
    for (contours, place, words) in [
        (
            format!("N400 G0 X0 Y0\n{}{end}", square(60., 0.)),
            "9:1",
            "where the surface of the part is",
        ),
        (
            "N400 G1 X0 Y0\nN500 X9 Y9\n".into(),
            "9:1",
            "no contour has begun",
        ),
        (
            "N400 G0 X0 Y0 Z0\nG1 X40\nN500 Y40\n".into(),
            "11:1",
            "the contour ends at",
        ),
        (
            format!("{big}G0 X5 Y5\n{end}"),
            "14:1",
            "no contour follows on this G0",
        ),
        (
            format!("{big}G0 X70 Y70\n{}{end}", square(9., 70.)),
            "14:1",
            "lies outside of the largest one",
        ),
        (
            format!("{big}G0 X55 Y55\n{}{end}", square(9., 55.)),
            "14:1",
            "crosses or touches another one",
        ),
        (
            "N400 G0 X0 Y0 Z0\nG1 X40 Y40\nX40 Y0\nX0 Y30\nN500 X0 Y0\n".into(),
            "9:1",
            "crosses or touches itself",
        ),
        (
            "N400 G0 X0 Y0 Z0\nG1 X40\nN500 X0\n".into(),
            "9:1",
            "encloses nothing",
        ),
        (
            format!("{big}G0 X5 Y5 Z1\n{end}"),
            "14:1",
            "at another height",
        ),
        (format!("{big}G1 Z-3\n{end}"), "14:1", "leaves the plane"),
        (format!("{big}F30\n{end}"), "14:1", "more than a motion"),
        (format!("{big}G11\n{end}"), "14:1", "G11 in a contour"),
        (format!("{big}(P1=3)\n{end}"), "14:1", "in parentheses"),
        (
            format!("N400 G0 X0 Y0 Z0\n{}{end}", square(9.5, 0.)),
            "8:6",
            "does not fit into this pocket",
        ),
    ] {
        one_error(&program("R200", ROUGH, &contours), place, words);
    }
    // Where the finishing tool cannot follow.
    let narrow = "N400 G0 X0 Y0 Z0\nG1 X40\nY16\nX60\nY24\nX40\nY40\nX0\nN500 Y0\n";
    let finish = "N300 G68 L1 I-6 R2 F300";
    one_error(
        &program("F300", finish, narrow),
        "12:1",
        "does not come to this wall",
    );
}
