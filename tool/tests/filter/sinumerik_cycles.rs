//! Cycles of the Sinumerik-like dialect, against paths written down by hand.

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

#[test]
fn drilling_cycles_once_and_modal() {
    let program = "\
G0 X0 Y0 Z20
F100 S600 M3
CYCLE81(10,0,2,-5)
MCALL CYCLE82(10,0,2,,6,0.5)
X10 Y0
HOLES1(20,0,90,5,10,2)
MCALL
G0 X0 Y0
CYCLE85(10,0,2,-3,,-10)
M30
";
    let mut expected = Path::from([0., 0., 20.])
        .rapid([0., 0., 2.])
        .line([0., 0., -5.])
        .rapid([0., 0., 10.]);
    for (x, y) in [(10., 0.), (20., 5.), (20., 15.)] {
        expected = expected
            .rapid([x, y, 10.])
            .rapid([x, y, 2.])
            .line([x, y, -6.])
            .rapid([x, y, 10.]);
    }
    let expected = expected
        .rapid([0., 0., 10.])
        .rapid([0., 0., 2.])
        .line([0., 0., -3.])
        .line([0., 0., 2.])
        .rapid([0., 0., 10.]);
    check(program, &expected);
    let dwells = commands(&translate(program, &[]));
    assert_eq!(dwells.iter().filter(|line| *line == "G4 P0.5").count(), 3);
    // Ten revolutions at 600 in a minute.
    assert_eq!(dwells.iter().filter(|line| *line == "G4 P1").count(), 1);
}

#[test]
fn deep_holes_and_holes_on_a_circle() {
    let program = "\
G0 X0 Y0 Z20
F100
MCALL CYCLE83(10,0,2,-12,,-5,,0,0,0,1,1)
HOLES2(0,0,10,90,0,2)
MCALL
CYCLE83(10,0,2,-8,,,5,0,0,0,1,0)
M30
";
    let mut expected = Path::from([0., 0., 20.]);
    let mut above = 20.;
    for y in [10., -10.] {
        expected = expected
            .rapid([0., y, above])
            .rapid([0., y, 2.])
            .line([0., y, -5.])
            .rapid([0., y, 2.])
            .rapid([0., y, -4.4])
            .line([0., y, -10.])
            .rapid([0., y, 2.])
            .rapid([0., y, -9.4])
            .line([0., y, -12.])
            .rapid([0., y, 10.]);
        above = 10.;
    }
    let expected = expected
        .rapid([0., -10., 2.])
        .line([0., -10., -5.])
        .line([0., -10., -4.])
        .line([0., -10., -8.])
        .rapid([0., -10., 10.]);
    check(program, &expected);
    for (cycle, text) in [
        ("CYCLE81(10,0,2,5)", "not in the order"),
        ("CYCLE81(10,0,2)", "needs a depth"),
        ("CYCLE81(,0,2,-5)", "needs RTP"),
        (
            "CYCLE81(10,0,2,-5,,0,1)",
            "_GMODE = 1 of CYCLE81 is not supported",
        ),
        ("CYCLE83(10,0,2,-5,,-2,,0,0,0,1.5,1)", "FRF = 1.5"),
        ("CYCLE83(10,0,2,-5,,-2,,0,0,0,1,2)", "VARI = 2"),
        ("HOLES1(0,0,0,0,5,3)", "without a modal cycle"),
    ] {
        let shown = errors(&format!("G0 X0 Y0 Z20 F100\n{cycle}\nM30\n"));
        assert!(shown.contains(text), "{cycle}\n{shown}");
    }
}

/// The edge is taken off the wall before the tool leaves the hole.
#[test]
fn boring_with_a_spindle_that_stops_at_an_angle() {
    let program = "G0 X10 Y5 Z20\nF100 S600\nCYCLE86(10,0,2,-5,,0.5,3,-1,0.5,1,90)\nM30\n";
    assert_eq!(
        commands(&translate(program, &["--backend", "program"])),
        [
            "G0 X10 Y5 Z20",
            "F100 S600",
            "G0 Z2",
            "G1 Z-5 M3",
            "G4 P0.5",
            // LinuxCNC waits for the spindle before it moves.
            "G0 X9 Y5.5 Z-4 M19 R90",
            "G0 Z2",
            "G0 X10 Y5 Z10",
            "M30",
        ]
    );
    let turned = format!("G0 X0 Y0 Z0\nTRANS X20\nAROT RPL=90\n{program}");
    let path = Path::from([0., 0., 0.])
        .rapid([15., 10., 20.])
        .rapid([15., 10., 2.])
        .line([15., 10., -5.])
        .rapid([14.5, 9., -4.])
        .rapid([14.5, 9., 2.])
        .rapid([15., 10., 10.]);
    check(&turned, &path);
    for (cycle, text) in [
        ("CYCLE86(10,0,2,-5,,0,0,0,0,0,0)", "needs SDIR"),
        ("CYCLE86(10,0,2,-5,,0,3,0,0,0,0,1)", "_GMODE = 1 of CYCLE86"),
    ] {
        let shown = errors(&format!("G0 X0 Y0 Z20 F100 S100\n{cycle}\nM30\n"));
        assert!(shown.contains(text), "{cycle}\n{shown}");
    }
    let unknown = errors("G91 G0 X5 Z20\nG90 Z20 F100 S100\nCYCLE86(10,0,2,-5,,0,3)\nM30\n");
    assert!(unknown.contains("where this hole is"), "{unknown}");
}

/// A chuck that gives way: the feed of the pitch, overrides off, the spindle turns back at the bottom.
#[test]
fn tapping_with_a_chuck_that_gives_way() {
    let tap = |cycle: &str| {
        let program = format!("G0 X0 Y0 Z20\nF100 S500 M3\n{cycle}\nG1 X5\nM30\n");
        commands(&translate(&program, &["--backend", "program"]))[2..].to_vec()
    };
    // M8 has a pitch of 1.25.
    assert_eq!(
        tap("CYCLE840(10,0,2,-15,,0,4,3,0,8,0)"),
        [
            "G0 Z2",
            "F625",
            "M49",
            "G1 Z-15",
            "G1 Z2 M4",
            "M48",
            "G0 Z10 F100 M3",
            "G1 X5",
            "M30",
        ]
    );
    assert_eq!(
        tap("CYCLE840(10,0,2,-15,,1,0,5,1)"),
        [
            "G0 Z2",
            "M49",
            "G1 Z-15",
            "G4 P1",
            "G1 Z2 M4",
            "M48",
            "G0 Z10 M3",
            "G1 X5",
            "M30",
        ]
    );
    for (program, text) in [
        ("S500 M3\nCYCLE840(10,0,2,-5)", "they give its feed"),
        ("S500\nCYCLE840(10,0,2,-5,,0,0,0,0,0,1)", "does not turn"),
        ("S500 M3\nCYCLE840(10,0,2,-5,,0,0,0,7)", "ENC = 7"),
        (
            "S500 M3\nCYCLE840(10,0,2,-5,,0,0,0,0,9)",
            "M9 is not a metric thread",
        ),
    ] {
        let shown = errors(&format!("G0 X0 Y0 Z20 F100\n{program}\nM30\n"));
        assert!(shown.contains(text), "{program}\n{shown}");
    }
}

/// The pitch of a tap is in the unit of G70 and G71, its feed in that of the machine.
#[test]
fn the_feed_of_a_tap_is_in_the_unit_of_the_machine() {
    for (unit, place, feed, machine) in [
        ("G71", "1,0,1,-8,,0,4,3,0,,1.27", "F635", ""),
        ("G70", "1,0,.1,-.8,,0,4,3,0,,.05", "F635", ""),
        ("G700", "1,0,.1,-.8,,0,4,3,0,,.05", "F635", ""),
        ("G70", "1,0,.1,-.8,,0,4,3,0,8,0", "F625", ""),
        ("G71", "1,0,1,-8,,0,4,3,0,,1.27", "F25", "--machine-in-inch"),
        (
            "G710",
            "1,0,1,-8,,0,4,3,0,,1.27",
            "F25",
            "--machine-in-inch",
        ),
        (
            "G70",
            "1,0,.1,-.8,,0,4,3,0,,.05",
            "F25",
            "--machine-in-inch",
        ),
    ] {
        let program = format!("{unit}\nS500 M3\nG0 X0 Y0 Z1\nCYCLE840({place})\nM30\n");
        let arguments: Vec<&str> = [machine]
            .into_iter()
            .filter(|word| !word.is_empty())
            .collect();
        let written = commands(&translate(&program, &arguments));
        let has = |line: &String| line.split(' ').any(|word| word == feed);
        assert!(written.iter().any(has), "{unit} {machine} {written:?}");
    }
}
