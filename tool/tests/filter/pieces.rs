//! Programs that are read piece by piece: what is written, and what is said, is that of the whole.

use crate::shop::{Shop, accepted, refused};
use clap::Parser;
use framepath_tool::filter::{FilterArguments, Told, filter};
use proptest::prelude::*;
use std::process::Command;

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    arguments: FilterArguments,
}

/// The output, or the error text.
fn translated(shop: &Shop, dialect: &str, options: &[&str]) -> Result<String, String> {
    let file = shop.path("part.nc").display().to_string();
    let fixed = ["filter", "--dialect", dialect];
    let line = fixed.iter().chain(options).copied().chain([file.as_str()]);
    let Line { arguments } = Line::try_parse_from(line).expect("options");
    let mut percent = 0;
    let mut tell = |told: Told| {
        if let Told::Progress(share) = told {
            assert!(share >= percent && share <= 100, "{percent} {share}");
            percent = share;
        }
    };
    let translated = filter(&arguments, &mut tell).map_err(|refused| refused.0)?;
    let mut text = Vec::new();
    translated.write_to(&mut text).expect("memory");
    Ok(String::from_utf8(text).expect("UTF-8"))
}

/// Lines that mean the same in all dialects, and many that do not.
fn line() -> impl Strategy<Value = String> {
    let place = || -500..500_i32;
    let fixed = [
        "G90",
        "G91",
        "G0",
        "G1",
        "G17",
        "G18",
        "G40",
        "M3 S500",
        "M8",
        "M5",
        "",
        " ",
        "G54",
        "F300",
        "G2 X10 Y10 I3 J4",
        "G3 X1 Y0 R50",
        "N7 G1 X1.5 F1e",
        "G1 X1..2",
        "; text",
        "\"text",
        "(text)",
        "T1",
        "M6",
        "G41",
        "G42",
        "G94",
        "G95",
        "TRANS X10 Y5",
        "AROT RPL=30",
        "MIRROR X0",
        "TRANS",
        "G1 X5 RND=1",
        "RNDM=2",
        "RNDM=0",
        "MCALL CYCLE81(10,0,2,-5)",
        "MCALL",
        "G11",
        "G10",
        "G73 Q30",
        "G72 S2",
        "G81 X5 Z2 I-3",
        "G80",
        "(P1=3)",
        "XP1",
        "G35 X0",
        "G36 X2",
        "G37 X5",
        "G34",
        "G21",
        "G20",
        "G351 X-1",
        "G60",
        "G61",
        "#HSC ON [CONTERROR 0.1]",
        "#HSC OFF",
        "#MSG [\"a\"]",
        "G161",
        "G53",
        "G92 X1",
        "M30",
        "%",
        "%A",
        "IF R1>3 GOTOF A",
        "A:",
        "(GOTO N7)",
        "$IF 1",
        "$ENDIF",
        "G71 L100",
        "G79 L100",
        "G70",
        "R1=5",
        "X=R1",
        "DIAMON",
        "G500",
        "G4 F1",
        "G4 K100",
        "G04 X1",
        "/G1 X3",
        "G1 X5 \\",
    ];
    prop_oneof![
        5 => (place(), place(), place()).prop_map(|(x, y, z)| {
            format!("G1 X{} Y{} Z{}", f64::from(x) / 8.0, f64::from(y) / 100.0, f64::from(z))
        }),
        3 => (0..99_u32, place(), 1..5000_u32).prop_map(|(n, x, f)| format!("N{n} X{x}. F{f}")),
        2 => (place(), place()).prop_map(|(x, a)| format!("g01x{x}a{a}")),
        1 => (place(), place()).prop_map(|(x, z)| format!("G0 X+{} Z{z}", x.abs())),
        4 => prop::sample::select(fixed.to_vec()).prop_map(String::from),
    ]
}

fn program() -> impl Strategy<Value = String> {
    (prop::collection::vec(line(), 0..30), any::<bool>()).prop_map(|(lines, ends)| {
        let end = if ends { "\nM30\n" } else { "" };
        format!("G0 X0 Y0 Z5\nG1 F100 X1\n{}{end}", lines.join("\n"))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn pieces_make_what_the_whole_makes(text in program(), piece in 1_usize..200, which in 0_usize..4) {
        let dialect = ["sinumerik", "fagor", "mefi", "isg"][which];
        let shop = Shop::new(&[("part.nc", text.as_bytes())]);
        let piece = piece.to_string();
        let whole = translated(&shop, dialect, &["--backend", "program"]);
        let options = ["--backend", "program", "--longest-whole", "0", "--piece", piece.as_str()];
        prop_assert_eq!(&translated(&shop, dialect, &options), &whole, "{}", text);
    }
}

/// A program of plain motions with this line in the middle.
fn long(lines: usize, middle: &str) -> String {
    let mut text = String::from("G17 G90\nG0 X0 Y0 Z0\nG1 F1000 X1\n");
    for at in 0..lines {
        if at == lines / 2 {
            text.push_str(middle);
        }
        text.push_str(&format!("N{at} G1 X{} Y{}.125 Z-1.5\n", at % 300, at % 77));
    }
    text + "M30\n"
}

#[test]
fn an_error_in_a_long_program_is_shown_where_it_is() {
    let text = long(200_000, "G1 X5 QUATSCH\n");
    let shop = Shop::new(&[("part.nc", text.as_bytes())]);
    let shown = refused(&shop.run("part.nc", &[]));
    assert!(shown.contains("part.nc:100004:7"), "{shown}");
    assert!(shown.contains("100004 | G1 X5 QUATSCH"), "{shown}");
    assert!(shown.contains("1 error: nothing was written"), "{shown}");
}

#[test]
fn a_frame_that_only_the_kinematics_can_do_is_found_in_a_long_program() {
    let text = long(200_000, "TRANS X10\nAROT Y30\n");
    let shop = Shop::new(&[("part.nc", text.as_bytes())]);
    let output = accepted(&shop.run("part.nc", &[]));
    let message = "(MSG, needs the frame kinematics: line 100005: this frame tilts the tool axis)";
    assert!(output.contains(message), "{}", &output[..500]);
    assert!(output.contains("o<arot> call [0] [30] [0] (line 100005: AROT Y30)"));
    assert_eq!(
        output.matches("\nG1 X").count() + output.matches(" G1 X").count(),
        200_001
    );
}

/// Twenty times the program fits into the same memory: held as a whole it would take a gigabyte.
#[test]
fn the_length_of_a_program_takes_no_memory() {
    let text = long(1_000_000, "");
    let shop = Shop::new(&[("part.nc", text.as_bytes())]);
    let tool = env!("CARGO_BIN_EXE_framepath");
    let file = shop.path("part.nc");
    let limited = format!(
        "ulimit -v 150000; exec {tool} filter --dialect sinumerik {} | tail -n 1",
        file.display()
    );
    let output = Command::new("bash")
        .args(["-o", "pipefail", "-c", &limited])
        .output();
    let output = output.expect("bash runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        "M30 (line 1000004)\n"
    );
}
