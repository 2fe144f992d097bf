//! Pockets, against plain LinuxCNC code and against the material that they must take away.

use crate::rs274::{self, numbers};
use crate::shop::{Shop, accepted, refused};

pub(super) const HEAD: &str = "T3 M06\nG43\nS1000 M3\nG90 G0 X0 Y0 Z20\n";

/// A shop whose machine has tools of 10 and 6 mm.
pub(super) fn shop(program: &str) -> Shop {
    Shop::new(&[
        ("part.pim", program.as_bytes()),
        ("mill.ini", b"[EMCIO]\nTOOL_TABLE = mill.tbl\n"),
        (
            "mill.tbl",
            b"T3 P3 D10 Z1 ;MILL_10\nT4 P4 D6\nT5 P5 ;no diameter\n",
        ),
    ])
}

pub(super) const ARGUMENTS: [&str; 4] = ["--ini", "mill.ini", "--backend", "program"];

/// Motions, feeds and path modes as LinuxCNC understands them, with their numbers.
fn motions(shop: &Shop, program: &str) -> Vec<(&'static str, Vec<f64>)> {
    let canon = rs274::interpret(&shop.path(""), "T3 P3 Z1 D0.4\nT4 P4 D0.25\n", program);
    let names = [
        "STRAIGHT_TRAVERSE",
        "STRAIGHT_FEED",
        "ARC_FEED",
        "SET_FEED_RATE",
        "START_SPINDLE_CLOCKWISE",
    ];
    let call = |line: &String| {
        let mut named = names
            .into_iter()
            .filter_map(|name| numbers(line, name).map(|list| (name, list)));
        named.next()
    };
    let mut list: Vec<(&str, Vec<f64>)> = canon.iter().filter_map(call).collect();
    list.dedup();
    // The header sets feed and path mode before anything moves.
    let first = list.iter().position(|(name, _)| *name != "SET_FEED_RATE");
    list.split_off(first.unwrap_or(0))
}

pub(super) fn translated(shop: &Shop) -> String {
    accepted(&shop.run_in("fagor", "part.pim", &ARGUMENTS))
}

fn assert_same(pocket: &str, plain: &str) {
    assert_same_program(&format!("{pocket}G80\nG0 X0 Y0\nM30\n"), plain);
}

/// The same with the whole rest of the program.
pub(super) fn assert_same_program(pocket: &str, plain: &str) {
    let shop = shop(&format!("{HEAD}{pocket}"));
    let given = motions(&shop, &translated(&shop));
    let plain = format!("G21 G90 G61\nT3 M6\nG43\nS1000 M3\nG0 X0 Y0 Z20\n{plain}G0 X0 Y0\nM30\n");
    let wanted = motions(&shop, &plain);
    let near = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4)
    };
    for (index, (given, wanted)) in given.iter().zip(&wanted).enumerate() {
        assert!(
            given.0 == wanted.0 && near(&given.1, &wanted.1),
            "{index}: {given:?}, not {wanted:?}\n{pocket}"
        );
    }
    assert_eq!(given.len(), wanted.len(), "{pocket}");
}

#[test]
fn a_rectangular_pocket_is_milled_from_the_middle() {
    let layer = |floor: f64, above: f64| {
        format!(
            "G1 Z{floor} F80\nX55 F300\nX45\nX55\nX59.5\nY35.5\nX40.5\nY44.5\nX59.5\nY40\n\
             X64\nY31\nX36\nY49\nX64\nY40\n\
             Y41 F150\nG2 X65 Y40 I0 J-1\nG1 Y30\nX35\nY50\nX65\nY40\nG2 X64 Y39 I-1 J0\n\
             G0 Z{above}\nX50 Y40\n"
        )
    };
    let plain = format!(
        "F300\nG0 X50 Y40\nZ2\n{}{}F300\nG0 Z2\n",
        layer(-3., -2.),
        layer(-6., -5.)
    );
    assert_same(
        "G99 G87 X50 Y40 Z2 I-6 J20 K15 B4 D2 L1 H150 V80 F300\n",
        &plain,
    );
}

#[test]
fn a_circular_pocket_goes_round_the_other_way_below_0() {
    let plain = "F200\nG0 X10 Y10\nZ1\n\
                 G1 Z-2 F100\nX13.5 F200\nG3 X13.5 Y10 I-3.5 J0\nG1 X17\nG3 X17 Y10 I-7 J0\n\
                 G0 Z-1\nX10 Y10\n\
                 G1 Z-3 F100\nX13.5 F200\nG3 X13.5 Y10 I-3.5 J0\nG1 X17\nG3 X17 Y10 I-7 J0\n\
                 G0 Z-2\nX10 Y10\nZ1\nZ20\n";
    // Steps of 2 mm in depth and a rest of 1; 7 mm in two rounds.
    assert_same("G88 G98 X10 Y10 Z1 I-3 J-12 B-2 C4 D1 F200\n", plain);
}

#[test]
fn pockets_repeat_at_other_places_and_in_patterns() {
    let pocket = |x: f64| {
        format!(
            "G0 X{x} Y0\nZ1\nG1 Z-2 F50\nX{} F100\nG2 X{} Y0 I-2 J0\nG0 Z-1\nX{x} Y0\nZ1\n",
            x + 2.,
            x + 2.
        )
    };
    let plain = format!("F100\n{}{}{}", pocket(10.), pocket(40.), pocket(70.));
    let first = "G99 G88 X10 Y0 Z1 I-2 J7 B9 F100\n";
    assert_same(&format!("{first}X40\nX70\n"), &plain);
    let other = "G99 G88 X10 Y0 Z1 I-2 J7 B9 F100\nG79 I-1 J-6.5 D0.5\nX40\nG79 I-2 J7 D0\nX70\n";
    let changed = pocket(40.)
        .replace("G1 Z-2", "G1 Z-1")
        .replace("G0 Z-1", "G0 Z0")
        .replace("G2 X42 Y0 I-2", "G3 X41.5 Y0 I-1.5")
        .replace("X42 ", "X41.5 ");
    let plain_changed = format!("F100\n{}{changed}{}", pocket(10.), pocket(70.));
    assert_same(other, &plain_changed);
    assert_same(&format!("{first}G60 X60 K3\n"), &plain);
}

/// The straight cuts at the last depth, from the output itself.
fn cuts(output: &str, floor: &str) -> Vec<[[f64; 2]; 2]> {
    let mut place = [0.0; 2];
    let mut cuts = Vec::new();
    let mut deep = false;
    for line in crate::shop::commands(output) {
        let value = |letter: char| -> Option<f64> {
            let word = line.split(' ').find(|word| word.starts_with(letter))?;
            word[1..].parse().ok()
        };
        deep = (deep && value('Z').is_none()) || line.contains(floor);
        let next = [
            value('X').unwrap_or(place[0]),
            value('Y').unwrap_or(place[1]),
        ];
        if deep {
            cuts.push([place, next]);
        }
        place = next;
    }
    cuts
}

pub(super) fn distance([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let from = [point[0] - a[0], point[1] - a[1]];
    let squared = way[0] * way[0] + way[1] * way[1];
    let share = match squared == 0.0 {
        true => 0.0,
        false => ((way[0] * from[0] + way[1] * from[1]) / squared).clamp(0.0, 1.0),
    };
    (from[0] - share * way[0]).hypot(from[1] - share * way[1])
}

/// All that the tool reaches without crossing the wall is gone, and nothing beyond.
#[test]
fn nothing_is_left_and_nothing_is_cut_beyond() {
    const RADIUS: f64 = 5.0;
    for (j, k, more) in [
        (20., 15., ""),
        (-33., 12., "L2"),
        (12., 40., "C10"),
        (25., 25., "C-9.5 L0.5"),
        (5., 30., ""),
        (30., 5.5, "C1"),
    ] {
        let (length, width): (f64, f64) = (f64::abs(j), k);
        let program = format!("{HEAD}G87 X0 Y0 Z1 I-4 J{j} K{k} B5 {more} F300\nG80\nM30\n");
        let cuts = cuts(&translated(&shop(&program)), "Z-4");
        for place in cuts.iter().flatten() {
            let beyond =
                (place[0].abs() - (length - RADIUS)).max(place[1].abs() - (width - RADIUS));
            assert!(beyond < 1e-4, "{place:?}: {program}");
        }
        let steps = |half: f64| (-40..=40).map(move |step| half * f64::from(step) / 40.0);
        for x in steps(length) {
            for y in steps(width) {
                let corner = [
                    (x.abs() - (length - RADIUS)).max(0.0),
                    (y.abs() - (width - RADIUS)).max(0.0),
                ];
                if corner[0].hypot(corner[1]) > RADIUS - 1e-3 {
                    continue;
                }
                let least = cuts.iter().map(|cut| distance(*cut, [x, y]));
                let least = least.fold(f64::INFINITY, f64::min);
                assert!(least < RADIUS + 1e-4, "{x} {y} is left: {least}\n{program}");
            }
        }
    }
}

#[test]
fn the_operator_hears_of_the_diameter() {
    let program = format!("{HEAD}G88 X10 Y0 Z1 I-2 J7 B9 F100\nG80\nM30\n");
    let output = translated(&shop(&program));
    assert!(
        output.contains("G88 is milled with the diameter 10 of T3 in the tool table"),
        "{output}"
    );
}

#[test]
fn mirrored_pockets_are_mirror_images() {
    let program = format!("{HEAD}G11\nG99 G87 X50 Y40 Z2 I-6 J20 K15 B9 L1 F300\nG80\nM30\n");
    let output = translated(&shop(&program));
    assert!(output.contains("G3 X-65 Y40"), "{output}");
}

/// G72 S makes the pocket larger and not the tool; G72 X stretches the finished path with its offset.
#[test]
fn scaled_pockets_keep_their_tool() {
    for (scale, wall) in [
        ("S2", "G1 X35 Y-25"),
        ("S0.5", "G1 X5 Y-2.5"),
        ("X2", "G1 X30 Y-10"),
    ] {
        let program =
            format!("{HEAD}G72 {scale}\nG99 G87 X0 Y0 Z2 I-6 J20 K15 B9 C2 F300\nG80\nM30\n");
        let output = translated(&shop(&program));
        assert!(output.contains(wall), "{scale}\n{output}");
    }
}

#[test]
fn a_pocket_in_endless_steps_ends_with_an_error() {
    for step in ["B0.000000001", "B4 C0.0000001"] {
        let program = format!("{HEAD}G88 X0 Y0 Z2 I-600 J500 {step} F300\nM30\n");
        let shown = refused(&shop(&program).run_in("fagor", "part.pim", &ARGUMENTS));
        assert!(shown.contains("the program does not end"), "{shown}");
    }
}

#[test]
fn pockets_that_cannot_be_milled() {
    for (block, text) in [
        ("G87 X0 Y0 Z2 I-6 K15 B4 F300", "G87 needs J"),
        ("G87 X0 Y0 Z2 I-6 J15 B4 F300", "G87 needs K"),
        ("G88 X0 Y0 Z2 I-6 J15 F300", "G88 needs B"),
        ("G88 X0 Y0 Z2 I-6 J15 K3 B4 F300", "J is the radius"),
        ("G88 X0 Y0 Z2 J15 B4 F300", "needs the depth I"),
        (
            "G88 X0 Y0 Z2 I-6 J4 B4 F300",
            "does not fit into this pocket",
        ),
        (
            "G88 X0 Y0 Z2 I-6 J8 L4 B4 F300",
            "does not fit into this pocket",
        ),
        ("G88 X0 Y0 Z2 I-6 J15 B4 C11 F300", "wider than the tool"),
        ("G88 X0 Y0 Z2 I-6 J15 B4 C0 F300", "leave C out"),
        ("G88 X0 Y0 Z2 I-6 J15 B4 D-1 F300", "D below 0"),
        ("G88 X0 Y0 Z2 I-6 J15 B4", "no F is in force"),
        (
            "T5 M6\nG0 X0 Y0 Z20\nG88 X0 Y0 Z2 I-6 J15 B4 F300",
            "needs the diameter of T5",
        ),
        ("G88 X0 Y0 Z2 I-6 J15 B4 F300\nG79 K12", "J is the radius"),
        ("G81 X0 Y0 Z2 I-6 H5 F300", "the address H"),
    ] {
        let shop = shop(&format!("{HEAD}{block}\nM30\n"));
        let shown = refused(&shop.run_in("fagor", "part.pim", &ARGUMENTS));
        assert!(shown.contains(text), "{block}\n{shown}");
        assert!(shown.contains("\n1 error: "), "{block}\n{shown}");
    }
    let program = "G90 G0 X0 Y0 Z20\nG88 X0 Y0 Z2 I-6 J15 B4 F300\nM30\n";
    let shown = refused(&shop(program).run_in("fagor", "part.pim", &ARGUMENTS));
    assert!(
        shown.contains("select and change the tool before"),
        "{shown}"
    );
    let shown = super::errors(&format!("{HEAD}{program}"), &[]);
    assert!(shown.contains("--ini FILE names the INI file"), "{shown}");
}
