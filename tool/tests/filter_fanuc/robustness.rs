//! No input makes the front end panic, hang or fill the memory.

use crate::front_end::{run_all, run_with};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::{DecimalPoint, Settings};
use proptest::prelude::*;
use std::time::{Duration, Instant};

const PIECES: &[&str] = &[
    "G0",
    "G1",
    "G2",
    "G3",
    "G4",
    "G9",
    "G5.1",
    "G17",
    "G18",
    "G19",
    "G20",
    "G28",
    "G40",
    "G41",
    "G43",
    "G49",
    "G50",
    "G51",
    "G51.1",
    "G50.1",
    "G52",
    "G53",
    "G53.1",
    "G54",
    "G54.1",
    "G61",
    "G64",
    "G65 P1",
    "G66 P1",
    "G67",
    "G68",
    "G68.2",
    "G69",
    "G73",
    "G74",
    "G76",
    "G80",
    "G81",
    "G83",
    "G84",
    "G86",
    "G90",
    "G91",
    "G92",
    "G94",
    "G95",
    "G96",
    "G97",
    "G98",
    "G99",
    "F100",
    "S500",
    "T1",
    "D1",
    "H1",
    "M0",
    "M3",
    "M6",
    "M19",
    "M29",
    "M98 P1",
    "M99",
    "M30",
    "P1000",
    "P1",
    "Q2.",
    "K2",
    "L2",
    "R5.",
    "O1\n",
    "O2\n",
    "%\n",
    "/",
    "N5",
    "#1=1",
    "#1=#1+1",
    "X#1",
    "Y[#1*2]",
    "Z#100",
    "#100=SIN[30]",
    "#[#1]",
    "IF[#1EQ2]",
    "GOTO5",
    "THEN#1=3",
    "WHILE[#1LT5]",
    "DO1",
    "END1",
    "DO2",
    "END2",
    "#3000=1",
    "(c)",
    "(",
    ")",
    "[",
    "]",
    "=",
    ",R1.",
    ";",
    "#",
    "AND",
    "ATAN[1]/[2]",
    "DPRNT[A]",
    ".",
    "-",
    "\n",
    "\n",
    "\n",
    "\n",
    "\n",
];

fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => prop::sample::select(PIECES).prop_map(str::to_string),
        3 => ("[XYZIJKRABCUVWQ]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}{value}.")),
    ]
}

/// Whole blocks that are right by themselves.
fn block() -> impl Strategy<Value = String> {
    let number = -20.0..20.0_f64;
    let two = (number.clone(), number.clone());
    prop_oneof![
        (number.clone(), number.clone(), number.clone())
            .prop_map(|(x, y, z)| format!("G1 X{x:.3} Y{y:.3} Z{z:.3} F100.")),
        two.clone()
            .prop_map(|(x, y)| format!("G2 X{x:.3} Y{y:.3} R40. F100.")),
        two.clone()
            .prop_map(|(i, j)| format!("G3 I{i:.3} J{j:.3} F100.")),
        number
            .clone()
            .prop_map(|x| format!("G91 G1 X{x:.3} F50.\nG90")),
        two.clone()
            .prop_map(|(x, y)| format!("G99 G83 X{x:.3} Y{y:.3} Z-30. R-21. Q3.\nX1.\nG80")),
        two.clone()
            .prop_map(|(x, r)| format!("G68 X{x:.3} Y0 R{r:.3}\nG0 X0 Y0")),
        two.prop_map(|(x, y)| format!("G51.1 X{x:.3} Y{y:.3}")),
        (0.1..3.0_f64).prop_map(|factor| format!("G51 X0 Y0 Z0 P{factor:.3}")),
        number
            .prop_map(|angle| format!("G68.2 X1. Y2. Z3. I{angle:.3} J10. K0\nG53.1\nG0 X0 Y0 Z0")),
        Just("G69 G0 X0 Y0".to_string()),
        Just("G50".to_string()),
        Just("G50.1 X0 Y0".to_string()),
        Just("G53 Z0".to_string()),
        Just("G91 G28 Z0\nG90 G0 Z5.".to_string()),
        Just("G55".to_string()),
        Just("G65 P2 A1.".to_string()),
    ]
}

/// How long the filter may take for a program that never ends.
const LONGEST: Duration = Duration::from_secs(60);

#[test]
fn loops_that_never_end_are_stopped() {
    for program in [
        "DO1\n#1=1\nEND1\nM30\n",
        "N10 GOTO10\nM30\n",
        "O1\nM98 P2 L9999\nM30\nO2\nM98 P3 L9999\nM99\nO3\n#1=1\nM99\n",
        "G0 Z50.\nG81 X1. Z-1. R1. K9999 F1.\nX2. K9999\nX3. K9999\nM30\n",
        "G0 Z50.\nG83 X1. Z-1000. R1. Q.0001 F1.\nM30\n",
    ] {
        let begun = Instant::now();
        run_with(&Settings::default(), Dialect::Fanuc, program.as_bytes());
        assert!(begun.elapsed() < LONGEST, "{program}");
    }
}

#[test]
fn what_is_nested_too_deep_is_an_error() {
    let deep = "[".repeat(100_000);
    run_all(Dialect::Fanuc, format!("G0 X{deep}").as_bytes());
    let signs = "-".repeat(100_000);
    run_all(Dialect::Fanuc, format!("#1={signs}1").as_bytes());
    let indirect = "#[".repeat(100_000);
    run_all(Dialect::Fanuc, format!("G0 X{indirect}1").as_bytes());
    let calls: String = (1..100)
        .map(|n| format!("O{n}\nM98 P{}\nM99\n", n + 1))
        .collect();
    run_all(Dialect::Fanuc, calls.as_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        run_all(Dialect::Fanuc, &bytes);
    }

    #[test]
    fn any_pieces(pieces in prop::collection::vec(piece(), 0..40)) {
        let program = pieces.join(" ");
        run_all(Dialect::Fanuc, program.as_bytes());
        let settings = Settings {
            most_blocks: 5000,
            decimal_point: DecimalPoint::Increments,
            ..Settings::default()
        };
        run_with(&settings, Dialect::Fanuc, program.as_bytes());
    }

    #[test]
    fn any_blocks(blocks in prop::collection::vec(block(), 0..30)) {
        let program = format!("O1\nG0 X0 Y0 Z0\n{}\nM30\nO2\nG0 X#1\nM99\n", blocks.join("\n"));
        run_all(Dialect::Fanuc, program.as_bytes());
    }
}
