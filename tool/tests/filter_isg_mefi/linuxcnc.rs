//! LinuxCNC's own interpreter reads what the filter writes.

use crate::examples;
use crate::path::Step;
use crate::rs274::{self, numbers};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// The canonical calls that LinuxCNC makes of a program.
pub fn interpret(shop: &Shop, program: &str) -> Vec<String> {
    // 5.08 mm
    let tools = "T3 P3 D0.2\nT4 P4 D0.2\nT5 P5 D0.2\n";
    rs274::interpret(&shop.path(""), tools, program)
}

/// The ends of all straight motions, machine coordinates. The interpreter leaves out the work offset.
pub fn positions(canon: &[String]) -> Vec<[f64; 3]> {
    let mut offset = [0.0; 3];
    let mut positions = Vec::new();
    for line in canon {
        if let Some(values) = numbers(line, "SET_G5X_OFFSET") {
            offset.copy_from_slice(&values[1..4]);
        }
        let straight = numbers(line, "STRAIGHT_TRAVERSE").or(numbers(line, "STRAIGHT_FEED"));
        if let Some(end) = straight {
            positions.push(std::array::from_fn(|axis| end[axis] + offset[axis]));
        }
    }
    positions
}

/// The steps that LinuxCNC makes of a program without work offsets, four decimals.
fn canonical_steps(canon: &[String]) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut last = [0.0; 3];
    for line in canon {
        let straight = numbers(line, "STRAIGHT_TRAVERSE").or(numbers(line, "STRAIGHT_FEED"));
        if let Some(end) = straight {
            let end = [end[0], end[1], end[2]];
            if end != last {
                steps.push(Step::Line(end));
            }
            last = end;
        } else if let Some(arc) = numbers(line, "ARC_FEED") {
            // end X, end Y, centre X, centre Y, turns with sign, end Z
            last = [arc[0], arc[1], arc[5]];
            steps.push(Step::Arc(last, [arc[2], arc[3]], arc[4] > 0.0));
        }
    }
    steps
}

fn assert_near(given: &[Step], wanted: &[Step], what: &str) {
    assert_eq!(given.len(), wanted.len(), "{what}: {given:?}");
    for (given, wanted) in given.iter().zip(wanted) {
        let list = |step: &Step| match step {
            Step::Line(end) => vec![end[0], end[1], end[2]],
            Step::Arc(end, centre, left) => {
                let left = f64::from(u8::from(*left));
                vec![end[0], end[1], end[2], centre[0], centre[1], left]
            }
        };
        let (a, b) = (list(given), list(wanted));
        let near = a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1.1e-4);
        assert!(near, "{what}: {given:?}, not {wanted:?}");
    }
}

/// What was meant is what LinuxCNC understood: every example of the manuals, without compensation.
#[test]
fn linuxcnc_understands_the_examples() {
    for (dialect, program, path) in examples::listings() {
        let program = program.replace("G41", "").replace("G40", "");
        let shop = Shop::with(dialect, &program);
        let output = shop.accepted(&["--backend", "program"]);
        let canon = interpret(&shop, &output);
        assert_near(&canonical_steps(&canon), &path, &program);
        // Frames that are calls there: LinuxCNC must accept them.
        interpret(&shop, &shop.accepted(&["--backend", "kinematics"]));
    }
}

/// With a tool of 5 mm: the mirrored pieces are the mirror images of the first, offset and all.
#[test]
fn compensated_pieces_are_mirror_images() {
    let part = "\
G79 L1
G01 X0 Y0
G01 X30 Y20 G41 D3
G02 X50 Y24.849 I16.641 J-24.962
G03 X30 Y73.484 I3.359 J29.811
G01 X20 Y61.075
G01 X30 Y20
G01 X0 Y0 G40
G70
";
    let piece = |mirror: &str| -> Vec<Step> {
        let program = format!("G00 X-5 Y0 Z0\nX0\nF100\n{mirror}\nG71 L1\nM30\n{part}");
        let shop = Shop::with(Dialect::Mefi, &program);
        let output = shop.accepted(&["--backend", "program"]);
        canonical_steps(&interpret(&shop, &output)).split_off(2)
    };
    let first = piece("G34");
    assert!(first.len() >= 6, "{first:?}");
    let on_the_contour = first.iter().any(|step| {
        let [x, y, _] = step.end();
        (x - 20.0).abs() < 1e-3 && (y - 61.075).abs() < 1e-3
    });
    assert!(
        !on_the_contour,
        "the tool is not beside its contour: {first:?}"
    );
    for (mirror, [x, y]) in [
        ("G35 X0", [-1.0, 1.0]),
        ("G35 Y0", [1.0, -1.0]),
        ("G35 X0 Y0", [-1.0, -1.0]),
    ] {
        let image: Vec<Step> = first
            .iter()
            .map(|step| match step {
                Step::Line(end) => Step::Line([x * end[0], y * end[1], end[2]]),
                Step::Arc(end, centre, left) => Step::Arc(
                    [x * end[0], y * end[1], end[2]],
                    [x * centre[0], y * centre[1]],
                    *left == (x * y > 0.0),
                ),
            })
            .collect();
        assert_near(&piece(mirror), &image, mirror);
    }
}

#[test]
fn linuxcnc_accepts_all_kinds_of_words() {
    let shop = Shop::with(
        Dialect::Isg,
        "T3 D3 M6\nS500 M3\nG54 G00 X0 Y0 Z5\n#HSC ON [CONTERROR 0.01]\nG41 G01 X10 Y10 F300\nX20\nG40 X30\n#HSC OFF\n\
         G60 X31\nG61 X32\nG93 F2 X33\nG94 X34\nG04 X0.01\n#MSG [\"done (%d)\", 5]\nG53\nG00 Z0\nX0 Y0\nG54\n\
         G161 G02 X10 Y0 I5 J0\nG91 G00 X5\nG90 M0\n#CS ON [1,2,3,0,0,45]\nX0 Y0 Z0\nM5 M30\n",
    );
    for backend in ["program", "kinematics"] {
        interpret(&shop, &shop.accepted(&["--backend", backend]));
    }
}
