//! Canned cycles, against the moves they stand for.

use crate::expected::Path;
use framepath_tool::dialects::Dialect;

fn check(program: &str, expected: &Path) {
    expected.check(Dialect::Fagor, &[("part.pim", program)], program);
}

#[test]
fn drilling_at_several_places() {
    let program = "\
G90 G0 X0 Y0 Z20
G99 G81 X10 Y0 Z2 I-8 K50 F100
X20
G98 G81 X30 Y5 Z2 I-8
G80
G0 X0 Y0
M30
";
    let expected = Path::from([0., 0., 20.])
        .rapid([10., 0., 20.])
        .rapid([10., 0., 2.])
        .line([10., 0., -8.])
        .rapid([10., 0., 2.])
        .rapid([20., 0., 2.])
        .line([20., 0., -8.])
        .rapid([20., 0., 2.])
        // The second cycle is defined here: its starting plane is where the tool is.
        .rapid([30., 5., 2.])
        .line([30., 5., -8.])
        .rapid([30., 5., 2.])
        .rapid([0., 0., 2.]);
    check(program, &expected);
    let dwells = super::translate(program, &[]);
    assert_eq!(dwells.iter().filter(|line| *line == "G4 P0.5").count(), 2);
}

#[test]
fn incremental_cycles_repeat() {
    let program = "\
G90 G0 X0 Y0 Z10
G91 G98 G82 X5 Z-8 I-6 F100
X5 N2
X5 N0
G80
M30
";
    let mut expected = Path::from([0., 0., 10.]);
    for x in [5., 10., 15.] {
        expected = expected
            .rapid([x, 0., 10.])
            .rapid([x, 0., 2.])
            .line([x, 0., -4.])
            .rapid([x, 0., 2.])
            .rapid([x, 0., 10.]);
    }
    check(program, &expected.rapid([20., 0., 10.]));
}

#[test]
fn deep_holes_in_steps() {
    let program = "G90 G0 X0 Y0 Z10\nG99 G83 X5 Y0 Z2 I-5 J3 F100\nG80\nM30\n";
    let expected = Path::from([0., 0., 10.])
        .rapid([5., 0., 10.])
        .rapid([5., 0., 2.])
        .line([5., 0., -3.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -2.])
        .line([5., 0., -8.])
        .rapid([5., 0., 2.])
        .rapid([5., 0., -7.])
        .line([5., 0., -13.])
        .rapid([5., 0., 2.]);
    check(program, &expected);
}

#[test]
fn boring_comes_back_with_feed_or_with_the_spindle_at_rest() {
    for g in [85, 89] {
        let program = format!("G90 G0 X0 Y0 Z10\nG{g} X5 Y0 Z2 I-5 F100\nG80\nM30\n");
        let expected = Path::from([0., 0., 10.])
            .rapid([5., 0., 10.])
            .rapid([5., 0., 2.])
            .line([5., 0., -5.])
            .line([5., 0., 2.])
            .rapid([5., 0., 10.]);
        check(&program, &expected);
    }
    let program = "M4 S100\nG90 G0 X0 Y0 Z10\nG86 X5 Y0 Z2 I-5 F100\nG80\nM30\n";
    assert_eq!(
        super::translate(program, &[]),
        [
            "S100 M4",
            "G0 X0 Y0 Z10",
            "G0 X5 Y0 F100",
            "G0 Z2",
            "G1 Z-5",
            "G0 Z2 M5",
            "G0 Z10",
            "M4",
            "M30"
        ]
    );
}

#[test]
fn a_cycle_is_changed_and_mirrored() {
    let program = "\
G90 G0 X0 Y0 Z10
G11
G99 G81 X5 Y0 Z2 I-5 F100
G79 I-6
X8
G80
M30
";
    let expected = Path::from([0., 0., 10.])
        .rapid([-5., 0., 10.])
        .rapid([-5., 0., 2.])
        .line([-5., 0., -5.])
        .rapid([-5., 0., 2.])
        .rapid([-8., 0., 2.])
        .line([-8., 0., -6.])
        .rapid([-8., 0., 2.]);
    check(program, &expected);
}

#[test]
fn tapping_with_and_without_a_chuck_that_gives_way() {
    let program = "G90 G94 G0 X0 Y0 Z20 S500 M3\nG98 G84 X10 Y0 Z2 I-8 K50 F500\nG80\n\
                   G98 G84 X20 Y0 Z2 I-8 F500 R1\nG80\nM30\n";
    let text = super::translate(program, &[]).join("\n");
    let floating = "G0 Z2\nM49\nG1 Z-8\nG4 P0.5\nG1 Z2 M4\nM48\nG0 Z20 M3";
    assert!(text.contains(floating), "{text}");
    // The pitch is the feed over the speed.
    assert!(
        text.contains("G0 Z2\nM3\nG33.1 Z-8 K1\nM5\nG0 Z20 M3"),
        "{text}"
    );
    let shown = super::errors("G0 X0 Y0 Z20 M3\nG84 X1 Z2 I-8 F100 R1\nM30\n", &[]);
    assert!(
        shown.contains("a rigid tap needs F in mm/min and S"),
        "{shown}"
    );
}

#[test]
fn threads_and_feeds_of_the_cutting_edge() {
    let program = "G90 G0 X0 Y0 Z5 S300 M3\nG33 Z-20 L1.5\nG96 G1 X5 F100\nG97 X6\nM30\n";
    let text = super::translate(program, &[]).join("\n");
    assert!(text.contains("G33 Z-20 K1.5\n"), "{text}");
    assert!(
        text.contains("G96 keeps the feed of the cutting edge"),
        "{text}"
    );
}
