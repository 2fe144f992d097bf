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

/// Lines of Fanuc-like programs.
const FANUC: [&str; 54] = [
    "#1=3",
    "#100=#1+[2*3]",
    "G1 X#1 Y[#100]",
    "IF[#1 EQ 3]GOTO7",
    "IF[#1 GT 3]THEN #2=1",
    "GOTO 3",
    "WHILE[#2 LT 3]DO1",
    "#2=#2+1",
    "END1",
    "M98 P2 L2",
    "G65 P2 X1.",
    "G66 P2 X1.",
    "G67",
    "M99",
    "G68 X0 Y0 R30.",
    "G69",
    "G51.1 X0",
    "G50.1 X0",
    "G52 X1.",
    "G98 G81 X5. Z-5. R2.",
    "G43 H1 Z50.",
    "G5.1 Q1",
    "G1 X5. ,R1.",
    "/2 G1 X3.",
    "N7 G0 Z9.",
    "N3 G1 X4. F100.",
    "G91",
    "G90",
    "X5 Y6",
    "G1 X7. F200.",
    "G80",
    "G2 X10. Y10. R50.",
    "G17",
    "G64",
    "G61",
    "(text)",
    "G20",
    "G21",
    "#1=#0",
    "G41 D1",
    "G40",
    "S500 M3",
    "T1 M6",
    "G1 X5. (text) Y3.",
    "G1X5.Y6.",
    "N9X1.Y2.",
    "IF[#100 LT 3]GOTO9",
    "#100=#100+1",
    "GOTO9",
    "G1 X.5 Y-.5",
    "G53 Z0",
    "G28 Z9.",
    "M8",
    "M9",
];

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
        "GOTOF N7",
        "GOTOB A",
        "IF R1==5 GOTOF B",
        "IF R1==5",
        "ELSE",
        "ENDIF",
        "B: G1 X7",
        "FOR R1=1 TO 3",
        "ENDFOR",
        "REPEAT A P=2",
        "REPEATB A",
        "%_N_L1_SPF",
        "L1",
        "M17",
        "(RPT N3,N7) N2",
        "(IF P1 EQ 3 GOTO N3)",
        "N3 G1 X4",
        "N7",
        "(SUB 1)",
        "(RET)",
        "(CALL 1)",
        "$FOR P1=1,3,1",
        "$ENDFOR",
        "$IF P1 == 3",
        "$ELSE",
        "$GOTO N3",
        "$GOTO [B]",
        "[B] G1 X8",
        "%L UP",
        "LL UP",
        "#VAR",
        "V.L.A = 3",
        "#ENDVAR",
        "G1 XV.L.A",
        "#COMMENT BEGIN",
        "#COMMENT END",
        "#CS ON [1,2,3,0,0,30]",
        "#CS OFF",
        "M29",
        "G79",
        "O2",
        ":3",
        "(one ( two)",
    ];
    let fixed = [&fixed[..], &FANUC].concat();
    prop_oneof![
        5 => (place(), place(), place()).prop_map(|(x, y, z)| {
            format!("G1 X{} Y{} Z{}", f64::from(x) / 8.0, f64::from(y) / 100.0, f64::from(z))
        }),
        3 => (0..99_u32, place(), 1..5000_u32).prop_map(|(n, x, f)| format!("N{n} X{x}. F{f}")),
        2 => (place(), place()).prop_map(|(x, a)| format!("g01x{x}a{a}")),
        1 => (place(), place()).prop_map(|(x, z)| format!("G0 X+{} Z{z}", x.abs())),
        4 => prop::sample::select(fixed).prop_map(String::from),
    ]
}

fn program() -> impl Strategy<Value = String> {
    (prop::collection::vec(line(), 0..30), any::<bool>()).prop_map(|(lines, ends)| {
        let end = if ends { "\nM30\n" } else { "" };
        format!("G0 X0 Y0 Z5\nG1 F100 X1\n{}{end}", lines.join("\n"))
    })
}

fn fanuc_program() -> impl Strategy<Value = String> {
    let line = prop_oneof![
        1 => prop::sample::select(&FANUC[..]).prop_map(String::from),
        1 => (-500..500_i32, -500..500_i32).prop_map(|(x, y)| format!("X{}.5 Y{}.", x, y)),
    ];
    (prop::collection::vec(line, 0..20)).prop_map(|lines| {
        let head = "%\nO1\n#1=3\n#100=1\n#2=0\nG0 X0 Y0 Z5.\nG1 F100. X1.\n";
        let tail = "N7 X3.\nN9 X4.\nM30\nO2\nG1 X2. Y[#100]\nM99\n%\n";
        format!("{head}{}\n{tail}", lines.join("\n"))
    })
}

fn assert_same_in_pieces(dialect: &str, text: &str, piece: usize) -> Result<(), TestCaseError> {
    let shop = Shop::new(&[("part.nc", text.as_bytes())]);
    let piece = piece.to_string();
    let common = [
        "--backend",
        "program",
        "--most-blocks",
        "500",
        "--set",
        "R1=5",
        "--set",
        "P1=3",
    ];
    let whole = translated(&shop, dialect, &common);
    let options = [
        &common[..],
        &["--longest-whole", "0", "--piece", piece.as_str()],
    ]
    .concat();
    prop_assert_eq!(&translated(&shop, dialect, &options), &whole, "{}", text);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn pieces_make_what_the_whole_makes(text in program(), piece in 1_usize..200, which in 0_usize..5) {
        let dialect = ["sinumerik", "fagor", "mefi", "isg", "fanuc"][which];
        assert_same_in_pieces(dialect, &text, piece)?;
    }

    /// Among lines of other languages few of its programs come far.
    #[test]
    fn pieces_of_fanuc_programs(text in fanuc_program(), piece in 1_usize..200) {
        assert_same_in_pieces("fanuc", &text, piece)?;
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

/// What leads through a long program, in each language: what stands before it, in its middle and behind it.
const LEADING: [(&str, &str, &str, &str); 15] = [
    ("sinumerik", "", "", ""),
    ("sinumerik", "", "IF R1==5\nG1 X1\nENDIF\n", ""),
    (
        "sinumerik",
        "GOTOF START\nSTART:\n",
        "IF R1==5 GOTOF N999999\n",
        "",
    ),
    ("sinumerik", "FOR R1=1 TO 1\n", "", "ENDFOR\n"),
    (
        "sinumerik",
        "%_N_PART_MPF\n",
        "L1\n",
        "M30\n%_N_L1_SPF\nG1 X2\nM17\n",
    ),
    ("fagor", "", "(IF P1 GT 3 GOTO N999999)\nG1 X1\n", ""),
    (
        "fagor",
        "(SUB 1)\nG1 X1\n(RET)\n",
        "(CALL 1)\n(RPT N5,N7) N3\n",
        "",
    ),
    ("mefi", "", "G71 L100\n", "M30\nG79 L100\nG1 X1\nG70\n"),
    ("isg", "", "$IF P1 == 5\nG1 X1\n$ENDIF\n", ""),
    ("isg", "", "$GOTO [W]\nG1 X5\n[W] G1 X6\n", ""),
    ("isg", "%L UP\nG1 X1 F100\nM29\n%MAIN\n", "LL UP\n", ""),
    ("isg", "", "#CS ON [1,2,3,0,0,30]\nG1 X5\n#CS OFF\n", ""),
    ("fanuc", "O1\n", "IF[#5001 EQ 5]GOTO999999\nG1 X1.\n", ""),
    ("fanuc", "%\nO1\n", "M98 P2\n", "M30\nO2\nG1 X2.\nM99\n%\n"),
    (
        "fanuc",
        "O1\n#1=0\nWHILE[#1 LT 1]DO1\n#1=#1+1\n",
        "",
        "END1\n",
    ),
];

/// Runs the filter with little memory and returns the last line of the program.
fn last_line_with_little_memory(shop: &Shop, file: &str, options: &str) -> String {
    let tool = env!("CARGO_BIN_EXE_framepath");
    let file = shop.path(file);
    let limited = format!(
        "ulimit -v 150000; exec {tool} filter {options} {} | tail -n 1",
        file.display()
    );
    let output = Command::new("bash")
        .args(["-o", "pipefail", "-c", &limited])
        .output();
    let output = output.expect("bash runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{options}: {errors}");
    String::from_utf8_lossy(&output.stdout).to_string()
}

/// Twenty times the program fits into the same memory: parsed as a whole it would take a gigabyte.
#[test]
fn the_length_of_a_program_takes_no_memory() {
    for (dialect, head, middle, tail) in LEADING {
        let plain = long(600_000, middle);
        let body = plain.strip_suffix("M30\n").unwrap_or(&plain);
        let text = format!("{head}{body}{tail}N999999 M30\n");
        let text = match tail.contains("M30") {
            true => format!("{head}{body}{tail}"),
            false => text,
        };
        let shop = Shop::new(&[("part.nc", text.as_bytes())]);
        let options = format!("--dialect {dialect} --feed 1000 --set R1=5 --set P1=5");
        let last = last_line_with_little_memory(&shop, "part.nc", &options);
        assert!(
            last.starts_with("M30 (line 600"),
            "{dialect} {middle}: {last}"
        );
    }
}

/// Subprogram files of any length, however the path to them is written.
#[test]
fn a_subprogram_from_outside_takes_no_memory() {
    let sub = long(600_000, "").replace("M30\n", "M17\n");
    for call in [
        "EXTCALL \"ROUGH\"",
        "EXTCALL(\"rough.spf\")",
        "EXTCALL \"LOCAL_DRIVE:/JOB/ROUGH.SPF\"",
        "DEF STRING[20] PLACE=\"JOB\"\nEXTCALL(PLACE << \"/ROUGH\")",
        "CALL \"/_N_WKS_DIR/_N_JOB_WPD/_N_ROUGH_SPF\"",
    ] {
        let main = format!("G0 X0 Y0 Z0\n{call}\nM30\n");
        let shop = Shop::new(&[("part.mpf", main.as_bytes()), ("ROUGH.SPF", sub.as_bytes())]);
        let last = last_line_with_little_memory(&shop, "part.mpf", "--dialect sinumerik");
        assert!(last.starts_with("M30"), "{call}: {last}");
    }
}

#[test]
fn a_subprogram_lies_where_its_path_says() {
    let shop = Shop::new(&[
        (
            "part.mpf",
            b"EXTCALL \"R:\\JOB\\EDGE.MPF\"\nEXTCALL \"EDGE\"\nM30\n",
        ),
        ("edge.spf", b"G0 X1\nM17\n"),
    ]);
    std::fs::create_dir(shop.path("job.wpd")).expect("a folder");
    std::fs::write(shop.path("job.wpd/Edge.mpf"), "G0 X2\nM17\n").expect("a file");
    let output = accepted(&shop.run("part.mpf", &[]));
    let first = output.find("G0 X2").expect("the file of the path");
    assert!(output[first..].contains("G0 X1"), "{output}");
    let lost = Shop::new(&[("part.mpf", b"EXTCALL \"A/LOST.SPF\"\nM30\n")]);
    let shown = refused(&lost.run("part.mpf", &[]));
    assert!(shown.contains("part.mpf:1:9"), "{shown}");
    assert!(
        shown.contains("the subprogram LOST was not found"),
        "{shown}"
    );
    assert!(shown.contains("as lost.spf beside it"), "{shown}");
}
