//! No input makes the front end panic.

use crate::front_end::run_all;
use framepath_tool::dialects::Dialect;
use proptest::prelude::*;

/// The error of the second line is found first where the program is read in pieces: that of the first is then left unsaid.
#[test]
fn errors_that_follow_from_others_may_be_left_out() {
    run_all(Dialect::Fagor, b"G8 R2 \n P4 G0");
}

/// Pieces of programs, so that much of what is made gets past the parser.
fn piece() -> impl Strategy<Value = String> {
    let fixed = [
        "G0",
        "G1",
        "G2",
        "G3",
        "G17",
        "G18",
        "G19",
        "G41",
        "G40",
        "G90",
        "G91",
        "G9",
        "G60",
        "G64",
        "TRANS",
        "ATRANS",
        "ROT",
        "AROT",
        "ROTS",
        "SCALE",
        "ASCALE",
        "MIRROR",
        "AMIRROR",
        "RPL=30",
        "CR=5",
        "TURN=2",
        "SUPA",
        "M6",
        "M3",
        "M30",
        "M17",
        "L10",
        "P2",
        "IF",
        "ELSE",
        "ENDIF",
        "LOOP",
        "ENDLOOP",
        "GOTOF",
        "GOTOB",
        "AA",
        "AA:",
        "R1=R1+1",
        "R1=1",
        "R1>5",
        "MSG(\"a\")",
        "DEF REAL BB",
        "BB=2",
        "F100",
        "S500",
        "T1",
        "D1",
        "D0",
        "G53",
        "G54",
        "G55",
        "G92",
        "G4",
        ";c",
        "(",
        ")",
        "[",
        "=",
        "==",
        "AND",
        "\n",
        "\n",
        "\n",
        "RND=1",
        "CHF=2",
        "RNDM=1",
        "AR=90",
        "CIP",
        "CT",
        "I1=3",
        "J1=4",
        "AP=30",
        "RP=5",
        "G110",
        "G111",
        "G500",
        "G52",
        "D2",
        "MCALL",
        "MCALL L10",
        "MCALL CYCLE81(10,0,2,-5)",
        "CYCLE83(10,0,2,-15,,-4,,1,1,1,1,1)",
        "HOLES2(0,0,10,90,0,3)",
        "CYCLE800(0,,0,57,1,2,3,0,0,30,0,0,0,1)",
        "CYCLE800()",
        "PROC L10(REAL A, VAR INT B)",
        "L10(1,R1)",
        "%_N_L10_SPF\n",
        "%_N_M_MPF\n",
    ];
    prop_oneof![
        4 => prop::sample::select(fixed.to_vec()).prop_map(str::to_string),
        3 => ("[XYZIJKABC]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}{value}")),
        1 => ("[XYZ]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}=IC({value})")),
        1 => ("[XYZIJK]", -50..50_i32).prop_map(|(axis, value)| format!("{axis}=AC({value})")),
    ]
}

/// Whole blocks that are right by themselves.
fn block() -> impl Strategy<Value = String> {
    let number = -20.0..20.0_f64;
    prop_oneof![
        (number.clone(), number.clone(), number.clone())
            .prop_map(|(x, y, z)| format!("G1 X{x} Y{y} Z{z} F100")),
        (number.clone(), number.clone()).prop_map(|(x, y)| format!("G2 X{x} Y{y} CR=40 F100")),
        (number.clone(), number.clone()).prop_map(|(i, j)| format!("G3 I{i} J{j} F100")),
        (number.clone(), number.clone(), 0.1..5.0_f64)
            .prop_map(|(x, y, r)| format!("G1 X{x} Y{y} F100 RND={r}")),
        (number.clone(), number.clone()).prop_map(|(x, y)| format!("CT X{x} Y{y} F100\nG1 X0")),
        (number.clone(), 1.0..359.0_f64).prop_map(|(x, angle)| format!("G3 X{x} AR={angle} F100")),
        (number.clone(), number.clone())
            .prop_map(|(angle, radius)| format!("G1 AP={angle} RP={radius} F100")),
        (number.clone(), number.clone()).prop_map(|(x, y)| format!("ATRANS X{x} Y{y}")),
        number.clone().prop_map(|angle| format!("AROT RPL={angle}")),
        (number.clone(), number.clone()).prop_map(|(x, y)| format!("AROT X{x} Y{y}")),
        (0.1..3.0_f64, 0.1..3.0_f64).prop_map(|(x, y)| format!("ASCALE X{x} Y{y}")),
        Just("AMIRROR X0".to_string()),
        Just("ASCALE".to_string()),
        Just("TRANS".to_string()),
        Just("G0 SUPA Z0 D0".to_string()),
        Just("G55".to_string()),
        number.prop_map(|x| format!("G91 G1 X{x} F50\nG90")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        run_all(Dialect::Sinumerik, &bytes);
    }

    #[test]
    fn any_pieces(pieces in prop::collection::vec(piece(), 0..40)) {
        let text = pieces.join(" ");
        run_all(Dialect::Sinumerik, text.as_bytes());
    }

    #[test]
    fn any_blocks(blocks in prop::collection::vec(block(), 0..30)) {
        run_all(Dialect::Sinumerik, format!("G0 X0 Y0 Z0\n{}\nM30\n", blocks.join("\n")).as_bytes());
    }
}
