//! Words that LinuxCNC would obey in silence, as something else. LinuxCNC's own interpreter reads what
//! the filter makes of them, with work offsets that show the difference.

use crate::linuxcnc::{interpret, positions};
use crate::rs274::{self, numbers};
use crate::shop::Shop;
use framepath_tool::dialects::Dialect;

/// The words of the output without comments and the first lines.
fn code(output: &str) -> String {
    let lines = output
        .lines()
        .filter(|line| !line.starts_with("G21 G8 G17 G40"));
    lines
        .map(|line| line.split('(').next().unwrap_or(""))
        .collect::<Vec<&str>>()
        .join("\n")
}

/// The positions of all motions in LinuxCNC, in machine coordinates: G54 is (100, 200, 10), G55 is
/// (1000, 0, 0).
fn machine_positions(shop: &Shop, backend: &str) -> Vec<[f64; 3]> {
    let output = shop.accepted(&["--backend", backend]);
    let offsets = "G10 L2 P1 X100 Y200 Z10\nG10 L2 P2 X1000 Y0 Z0\n";
    let canon = interpret(shop, &format!("{offsets}{output}"));
    positions(&canon)
}

/// To LinuxCNC, G20 and G21 are inch and millimetre.
#[test]
fn isg_g20_and_g21_are_mirrors() {
    let shop = Shop::with(
        Dialect::Isg,
        "G54\nG21\nG01 X10 Y20 Z0 F100\nG20\nX10 Y20\nM30\n",
    );
    let output = shop.accepted(&["--backend", "program"]);
    assert!(
        !code(&output).contains("G20") && !code(&output).contains("G21"),
        "{output}"
    );
    let wanted = [[90.0, 220.0, 10.0], [110.0, 220.0, 10.0]];
    assert_eq!(machine_positions(&shop, "program"), wanted);
    let framed = shop.accepted(&["--backend", "kinematics"]);
    assert!(
        !code(&framed).contains("G20") && !code(&framed).contains("G21"),
        "{framed}"
    );
    assert!(framed.contains("o<mirror> call [1] [0] [0]") && framed.contains("o<frame_off> call"));
}

/// To LinuxCNC, G92 gives the present place these coordinates, and keeps that when the program is over.
#[test]
fn isg_g92_is_an_offset() {
    let shop = Shop::with(
        Dialect::Isg,
        "G54\nG01 X7 Y7 Z0 F100\nG92 X60 Y40\nX10 Y20\nG91 X1\nG90 G92 X0 Y0\nX10\nM30\n",
    );
    let output = shop.accepted(&["--backend", "program"]);
    assert!(!code(&output).contains("G92"), "{output}");
    let wanted = [
        [107.0, 207.0, 10.0],
        [170.0, 260.0, 10.0],
        [171.0, 260.0, 10.0],
        [110.0, 260.0, 10.0],
    ];
    assert_eq!(machine_positions(&shop, "program"), wanted);
    let framed = shop.accepted(&["--backend", "kinematics"]);
    assert!(!code(&framed).contains("G92"), "{framed}");
}

/// To LinuxCNC, G53 holds for its own line: the lines after it would run in G54.
#[test]
fn modal_g53_holds_on() {
    let program =
        "G54\nG01 X1 Y1 Z1 F100\nG53\nX10 Y20\nZ5\nG91 X5\nG90 G00 X2\nG55\nG01 X1\nM30\n";
    let wanted = [
        [101.0, 201.0, 11.0],
        [10.0, 20.0, 11.0],
        [10.0, 20.0, 5.0],
        [15.0, 20.0, 5.0],
        [2.0, 20.0, 5.0],
        [1001.0, 20.0, 5.0],
    ];
    for dialect in [Dialect::Isg, Dialect::Mefi] {
        let shop = Shop::with(dialect, program);
        for backend in ["program", "kinematics"] {
            assert_eq!(
                machine_positions(&shop, backend),
                wanted,
                "{dialect:?} {backend}"
            );
        }
    }
}

/// With a mirror and an offset of the program: they act without the work offset too.
#[test]
fn modal_g53_leaves_mirror_and_shift_in_force() {
    let isg = "G54\nG92 X1 Y2\nG21\nG53\nG01 X10 Y20 F100\nG91 Y1\nM30\n";
    let mefi = "G54\nG37 X1 Y2\nG35 X0\nG36 X2\nG53\nG01 X10 Y20 F100\nG91 Y1\nM30\n";
    let ends = |dialect, program| -> Vec<[f64; 2]> {
        let shop = Shop::with(dialect, program);
        let positions = machine_positions(&shop, "program");
        positions.iter().map(|[x, y, _]| [*x, *y]).collect()
    };
    assert_eq!(ends(Dialect::Isg, isg), [[-9.0, 22.0], [-9.0, 23.0]]);
    assert_eq!(ends(Dialect::Mefi, mefi), [[-19.0, 42.0], [-19.0, 44.0]]);
}

#[test]
fn what_g53_cannot_carry_is_refused() {
    for (program, text) in [
        (
            "G53\nG02 X10 Y0 R5 F100\nM30\n",
            "an arc while the work offset is off",
        ),
        ("G53\nG91 G00 X1\nM30\n", "where X is there is not known"),
        (
            "D1\nG53\nG41 G01 X1 F100\nM30\n",
            "while cutter compensation is on",
        ),
        (
            "G53\n#ROTATION ON [ANGLE=30]\nG00 X1\nM30\n",
            "a rotation is active",
        ),
        ("#CS ON [1]\nM30\n", "is not defined"),
        ("#CS ON [1,2]\nG53\nM30\n", "while #CS is active"),
    ] {
        let shown = Shop::with(Dialect::Isg, program).refused(&["--backend", "kinematics"]);
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}

/// LinuxCNC works out the expressions of a line before it executes the offsets that stand in it.
#[test]
fn places_are_read_behind_the_offsets_of_their_block() {
    let blocks = "G54 G90 G00 X0 Y0 Z50\nG55 X5\nG54 G91 X1\nX1\nM30\n";
    let wanted = [
        [100.0, 200.0, 60.0],
        [1005.0, 200.0, 60.0],
        [1006.0, 200.0, 60.0],
        [1007.0, 200.0, 60.0],
    ];
    for (dialect, head) in [
        (Dialect::Isg, ""),
        (Dialect::Mefi, ""),
        (Dialect::Fanuc, ""),
        (Dialect::Fagor, "%PART,MX--,\n"),
    ] {
        let shop = Shop::with(dialect, &format!("{head}{blocks}"));
        for backend in ["program", "kinematics"] {
            let given = machine_positions(&shop, backend);
            assert_eq!(given, wanted, "{dialect:?} {backend}");
        }
    }
    let arc = "G55 G90 G01 X-900 Y200 Z50 F100\nG161\nG54 G02 X10 Y0 I5 J0\nM30\n";
    let shop = Shop::with(Dialect::Isg, arc);
    let offsets = "G10 L2 P1 X100 Y200 Z10\nG10 L2 P2 X1000 Y0 Z0\n";
    let canon = interpret(&shop, &format!("{offsets}{}", shop.accepted(&[])));
    let arc = canon.iter().find_map(|line| numbers(line, "ARC_FEED"));
    assert_eq!(arc.expect("an arc")[..4], [10.0, 0.0, 5.0, 0.0]);
}

/// The tools of the next tests, lengths in inch.
const LENGTHS: &str = "T1 P1 Z1\nT2 P2 Z3 X0.5 Y0.25\n";

#[test]
fn increments_beside_a_row_count_from_the_tool() {
    for dialect in [Dialect::Isg, Dialect::Mefi] {
        let program = "G54 G90 G00 X0 Y0 Z5 D1\nG91 D2 Z1\nZ1\nM30\n";
        let shop = Shop::with(dialect, program);
        let output = shop.accepted(&["--machine-in-inch"]);
        let canon = rs274::interpret(&shop.path(""), LENGTHS, &output);
        let heights: Vec<f64> = positions(&canon).iter().map(|[_, _, z]| *z).collect();
        // The tool of row 2 is longer by two.
        assert_eq!(heights, [5.0, 4.0, 5.0], "{output}");
    }
}

/// To LinuxCNC, #5403 is the length of the tool in the spindle, whatever row is in force.
#[test]
fn modal_g53_brings_the_tip_of_the_row_in_force_there() {
    for (dialect, tools) in [
        (Dialect::Isg, "T1 M6 D2\nG53 X1 Y2 Z0"),
        (Dialect::Isg, "T1 M6 D1\nG53 X1 Y2 Z0"),
        (Dialect::Isg, "G53 X1 Y2 Z0 D2"),
        (Dialect::Mefi, "T1 M6\nD2\nG53\nX1 Y2 Z0"),
        (Dialect::Mefi, "T1 M6 D1\nT2 M6\nG53\nX1 Y2 Z0"),
        (Dialect::Mefi, "T2 M6\nG53\nX1 Y2 Z0 D2"),
        (Dialect::Mefi, "T1 M6\nD2\nD0\nG53\nX1 Y2 Z0"),
    ] {
        let shop = Shop::with(dialect, &format!("G54 G90 G00 X3 Y4 Z5\n{tools}\nM30\n"));
        for backend in ["program", "kinematics"] {
            let output = shop.accepted(&["--machine-in-inch", "--backend", backend]);
            let offsets = "G20\nG10 L2 P1 X1 Y2 Z3 R30\n";
            let canon = rs274::interpret(&shop.path(""), LENGTHS, &format!("{offsets}{output}"));
            let end = positions(&canon).pop().expect("a motion");
            let wanted = [1.0, 2.0, 0.0];
            let near = end.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-3);
            assert!(near, "{dialect:?} {tools:?} {end:?}\n{output}");
        }
    }
    // Where the program has loaded the tool of the row, one line is enough.
    let shop = Shop::with(Dialect::Isg, "T1 M6\nG53 G00 Z0 D1\nM30\n");
    let output = shop.accepted(&[]);
    assert!(
        code(&output).contains("G43 H1 \nG53 G0 Z[0+#5403]"),
        "{output}"
    );
}
