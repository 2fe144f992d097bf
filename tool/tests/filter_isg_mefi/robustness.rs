//! No input makes the front ends panic, hang or fill the memory.

use crate::front_end::{run_all, run_with};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use proptest::prelude::*;
use std::time::{Duration, Instant};

/// Pieces of programs, so that much of what is made gets past the parser.
fn piece(fixed: &'static [&'static str]) -> impl Strategy<Value = String> {
    prop_oneof![
        4 => prop::sample::select(fixed).prop_map(str::to_string),
        3 => ("[XYZIJRABCUVW]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}{value}")),
    ]
}

const MEFI: &[&str] = &[
    "G0", "G1", "G2", "G3", "G4", "G17", "G18", "G23", "G34", "G35", "G36", "G37", "G40", "G41",
    "G42", "G53", "G54", "G55", "G70", "G71 L1", "G79 L1", "G90", "G91", "G92", "G94", "G95",
    "F100", "S500", "T1", "D1", "D0", "M0", "M3", "M6", "M30", "Q2", "L1", "\"c", "“c", "%1", "/",
    "N5", ".", "-", "\n", "\n", "\n", "\n",
];

const ISG: &[&str] = &[
    "G00",
    "G01",
    "G02",
    "G03",
    "G04",
    "G17",
    "G19",
    "G20",
    "G21",
    "G22",
    "G23",
    "G351",
    "G40",
    "G41",
    "G53",
    "G54",
    "G159=2",
    "G60",
    "G61",
    "G261",
    "G260",
    "G70",
    "G90",
    "G91",
    "G92",
    "G93",
    "G94",
    "G161",
    "G162",
    "F100",
    "S500",
    "T1",
    "D1",
    "M3",
    "M6",
    "M17",
    "M29",
    "M30",
    "LL A",
    "L b.nc",
    "%L A\n",
    "%MAIN\n",
    "P1=1",
    "P1=P1+1",
    "XP1",
    "Y[P1*2]",
    "V.L.A=3",
    "ZV.L.A",
    "SIN[30]",
    "#CS ON [1,2,3,10]",
    "#CS OFF",
    "#ROTATION ON [ANGLE=30]",
    "#ROTATION OFF",
    "#HSC ON [CONTERROR 0.1]",
    "#HSC OFF",
    "#MSG [\"a %f\", 1]",
    "#VAR",
    "#ENDVAR",
    "V.L.B[2] : SGN32 = [1,2]",
    "#COMMENT BEGIN",
    "#COMMENT END",
    "$IF P1",
    "$ELSEIF 1",
    "$ELSE",
    "$ENDIF",
    "$FOR P1=1,3,1",
    "$ENDFOR",
    "$DO",
    "$ENDDO 0",
    "$REPEAT",
    "$UNTIL 1",
    "$SWITCH 1",
    "$CASE 1",
    "$DEFAULT",
    "$BREAK",
    "$CONTINUE",
    "$ENDSWITCH",
    "$GOTO [A]",
    "[A]",
    "[",
    "]",
    "(",
    ")",
    ";c",
    "\\",
    "\"",
    "=",
    ",",
    "\n",
    "\n",
    "\n",
    "\n",
    "\n",
];

/// Whole blocks that are right by themselves.
fn block(dialect: Dialect) -> BoxedStrategy<String> {
    let number = -20.0..20.0_f64;
    let common = prop_oneof![
        (number.clone(), number.clone(), number.clone())
            .prop_map(|(x, y, z)| format!("G1 X{x} Y{y} Z{z} F100")),
        (number.clone(), number.clone()).prop_map(|(x, y)| format!("G2 X{x} Y{y} R40 F100")),
        (number.clone(), number.clone()).prop_map(|(i, j)| format!("G3 I{i} J{j} F100")),
        number.clone().prop_map(|x| format!("G91 G1 X{x} F50\nG90")),
        Just("G53 G0 X0".to_string()),
        Just("G54".to_string()),
    ];
    match dialect {
        Dialect::Mefi => prop_oneof![
            common,
            Just("G35 X0".to_string()),
            Just("G35 Y0 C0".to_string()),
            Just("G34".to_string()),
            (0.1..3.0_f64).prop_map(|k| format!("G36 X{k}")),
            (number.clone(), number).prop_map(|(x, y)| format!("G37 X{x} Y{y}")),
        ]
        .boxed(),
        _ => prop_oneof![
            common,
            prop::sample::select(vec!["G20", "G21", "G22", "G23", "G351 X-1", "G351 X1 Z-1"])
                .prop_map(str::to_string),
            (number.clone(), number.clone()).prop_map(|(x, y)| format!("G92 X{x} Y{y}")),
            number
                .clone()
                .prop_map(|angle| format!("#ROTATION ON [ANGLE={angle}]")),
            (number.clone(), number).prop_map(|(x, a)| format!("#CS ON [{x},0,0,{a},0,{a}]")),
            Just("#CS OFF ALL".to_string()),
        ]
        .boxed(),
    }
}

/// How long the filter may take for a program that never ends.
const LONGEST: Duration = Duration::from_secs(60);

#[test]
fn loops_that_never_end_are_stopped() {
    for program in [
        "$WHILE 1\nP1=1\n$ENDWHILE\nM30\n",
        "N10 $GOTO N10\nM30\n",
        "$DO\n$ENDDO 1\nM30\n",
        "G00\nP1=0\nN5 P1=P1+1\nXP1\n$GOTO N5\nM30\n",
    ] {
        let begun = Instant::now();
        run_with(&Settings::default(), Dialect::Isg, program.as_bytes());
        assert!(begun.elapsed() < LONGEST, "{program}");
    }
}

#[test]
fn what_is_nested_too_deep_is_an_error() {
    let deep = "[".repeat(100_000);
    run_all(Dialect::Isg, format!("G00 X{deep}").as_bytes());
    let signs = "-".repeat(100_000);
    run_all(Dialect::Isg, format!("G00 X{signs}1").as_bytes());
    let indirect = "P".repeat(100_000);
    run_all(Dialect::Isg, format!("G00 X{indirect}1").as_bytes());
    let calls: String = (0..100)
        .map(|n| format!("%L A{n}\nLL A{}\nM29\n", n + 1))
        .collect();
    run_all(
        Dialect::Isg,
        format!("{calls}%MAIN\nLL A0\nM30\n").as_bytes(),
    );
    let passes = "G71 L1 Q9999\nM30\nG79 L1\nG71 L2 Q9999\nG70\nG79 L2\nG91 G0 X1\nG70\n";
    run_all(Dialect::Mefi, passes.as_bytes());
    run_all(Dialect::Isg, b"#VAR\nV.L.A[100000][100000]\n#ENDVAR\nM30\n");
}

/// Lines that belong together may go on where another program begins.
#[test]
fn declarations_and_comments_without_an_end() {
    for begin in ["#VAR", "#COMMENT BEGIN", "G0 X0 \\"] {
        for rest in [
            "%L UP\nG1 X1\nM29\n%MAIN\nG1 X2\n",
            "%A\nG1 X1 ?\nM30\n%L B\n$IF 1\n",
        ] {
            run_all(
                Dialect::Isg,
                format!("{rest}{begin}\n{rest}{rest}").as_bytes(),
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        run_all(Dialect::Mefi, &bytes);
        run_all(Dialect::Isg, &bytes);
    }

    #[test]
    fn any_pieces_of_mefi(pieces in prop::collection::vec(piece(MEFI), 0..40)) {
        run_all(Dialect::Mefi, pieces.join(" ").as_bytes());
    }

    #[test]
    fn any_pieces_of_isg(pieces in prop::collection::vec(piece(ISG), 0..40)) {
        run_all(Dialect::Isg, pieces.join(" ").as_bytes());
    }

    #[test]
    fn any_blocks(
        mefi in prop::collection::vec(block(Dialect::Mefi), 0..30),
        isg in prop::collection::vec(block(Dialect::Isg), 0..30),
    ) {
        for (dialect, blocks) in [(Dialect::Mefi, mefi), (Dialect::Isg, isg)] {
            run_all(dialect, format!("G0 X0 Y0 Z0\n{}\nM30\n", blocks.join("\n")).as_bytes());
        }
    }
}
