//! What has no end, or none that anybody waits for, and lines that nobody could look at as a whole.

use crate::shop::{Shop, accepted, refused};
use std::process::Command;
use std::time::{Duration, Instant};

/// Longer than any of these takes on a slow machine.
const SOON: Duration = Duration::from_secs(30);

#[test]
fn what_is_no_program_ends_with_the_setting() {
    let shop = Shop::new(&[
        ("loop.mpf", b"R1=1\nWHILE R1==1\nR1=1\nENDWHILE\nM30\n"),
        ("part.mpf", b"G0 X1\nM30\n"),
        ("zeros.mpf", &[0; 2_000_000]),
        (
            "while.nc",
            b"O1\n#1=1\nWHILE[#1 EQ 1]DO1\n#1=1\nEND1\nM30\n",
        ),
        ("goto.nc", b"O1\nN1 G0 X1.\nGOTO1\nM30\n"),
        (
            "repeat.nc",
            b"O1\nM98 P2 L9999\nM30\nO2\nM98 P3 L9999\nM99\nO3\nG0 X1.\nM99\n",
        ),
        ("nested.nc", b"O1\nM98 P2\nM30\nO2\nM98 P2\nM99\n"),
    ]);
    let made = Command::new("mkfifo").arg(shop.path("pipe.mpf")).status();
    assert!(made.is_ok_and(|status| status.success()));
    std::fs::create_dir(shop.path("folder.mpf")).expect("a folder");
    let begun = Instant::now();
    for (file, options, said) in [
        (
            "/dev/zero",
            &["--most-bytes", "1000000"][..],
            "more than 1000000 bytes; --most-bytes raises",
        ),
        (
            "part.mpf",
            &["--most-bytes", "5"],
            "more than 5 bytes; --most-bytes raises",
        ),
        (
            "pipe.mpf",
            &["--most-seconds", "1"],
            "not come within 1 s; --most-seconds raises",
        ),
        (
            "folder.mpf",
            &[],
            "it is a folder, and a program is one file",
        ),
        ("zeros.mpf", &[], "a line of more than 1 MB"),
        ("loop.mpf", &[], "the program does not end"),
        (
            "loop.mpf",
            &["--most-blocks", "100000000", "--most-seconds", "1"],
            "the program has not ended after 1 s",
        ),
        ("while.nc", &[], "the program does not end"),
        (
            "while.nc",
            &["--most-blocks", "100000000", "--most-seconds", "1"],
            "the program has not ended after 1 s",
        ),
        ("goto.nc", &[], "the program does not end"),
        (
            "repeat.nc",
            &["--longest-whole", "0"],
            "the program does not end",
        ),
        ("nested.nc", &[], "O2 calls itself"),
    ] {
        let dialect = match file.ends_with(".nc") {
            true => "fanuc",
            false => "sinumerik",
        };
        let shown = refused(&shop.run_in(dialect, file, options));
        assert!(shown.contains(said), "{file}: {shown}");
    }
    assert!(begun.elapsed() < SOON);
}

#[test]
fn a_program_may_come_through_a_pipe() {
    let shop = Shop::new(&[]);
    let tool = env!("CARGO_BIN_EXE_framepath");
    let piped = format!("{tool} filter --dialect sinumerik <(printf 'G0 X7\\nM30\\n')");
    let output = Command::new("bash")
        .args(["-c", &piped])
        .current_dir(shop.path(""))
        .output();
    let output = accepted(&output.expect("bash runs"));
    assert!(output.contains("G0 X7"), "{output}");
}

#[test]
fn a_long_line_is_shown_round_the_error() {
    let long = "R1=1 ".repeat(40_000);
    let comment = "Ñ".repeat(100_000);
    for (dialect, text, place) in [
        ("sinumerik", format!("{long}? {long}\n"), "part.nc:1:200001"),
        (
            "sinumerik",
            format!("; {comment}\nG1 QUATSCH ; {comment}\n"),
            "part.nc:2:4",
        ),
        (
            "fanuc",
            format!("({comment})\nG1 ({comment}) ? ({comment})\n"),
            "part.nc:2:100007",
        ),
    ] {
        let shop = Shop::new(&[("part.nc", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part.nc", &[]));
        assert!(shown.contains(place), "{shown}");
        assert!(shown.len() < 2000, "{}", shown.len());
    }
}

#[test]
fn utf_16_is_read_without_a_mark() {
    let long = "N5 G1 X1.5 F100 ; Größe\r\n".repeat(20_000);
    let fanuc = "N5 G1 X1.5 F100. (Größe)\r\n".repeat(20_000);
    for (dialect, text) in [
        ("sinumerik", "G0 X1\nIF 1==1\nG0 X2\nENDIF\nM30\n"),
        ("sinumerik", &format!("{long}IF 1==1\nG0 X2\nENDIF\nM30\n")),
        ("fanuc", "O1\nIF[1 EQ 1]GOTO7\nG0 X1.\nN7 G0 X2.\nM30\n"),
        (
            "fanuc",
            &format!("%\nO1\n{fanuc}IF[1 EQ 1]GOTO7\nG0 X1.\nN7 G0 X2.\nM30\n%\n"),
        ),
    ] {
        let translated = |bytes: &[u8]| {
            let shop = Shop::new(&[("part.nc", bytes)]);
            shop.run_in(dialect, "part.nc", &[])
        };
        let expected = accepted(&translated(text.as_bytes()));
        for (order, name) in [([0, 1], "low"), ([1, 0], "high")] {
            let bytes: Vec<u8> = text
                .encode_utf16()
                .flat_map(|unit| {
                    let bytes = unit.to_le_bytes();
                    order.map(|at| bytes[at])
                })
                .collect();
            let output = translated(&bytes);
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(
                said.contains(&format!("UTF-16, {name} byte first")),
                "{said}"
            );
            assert!(accepted(&output) == expected, "{name}");
        }
    }
}

/// What walks through a sum goes as deep as it is long.
#[test]
fn a_long_sum_is_refused() {
    for (dialect, begins, ends) in [
        ("sinumerik", "G90 G54\nR1=", ""),
        ("fagor", "(P1=", ")"),
        ("fanuc", "O1\n#1=", ""),
        ("isg", "N10 P1=", ""),
    ] {
        let sum = |count: usize| format!("{begins}1{}{ends}\nG0 X1\nM30\n", "+1".repeat(count));
        let text = sum(50_000);
        let shop = Shop::new(&[("part.nc", text.as_bytes())]);
        let shown = refused(&shop.run_in(dialect, "part.nc", &[]));
        assert!(
            shown.contains("a block with more than 1000 operators"),
            "{dialect}: {shown}"
        );
        let lines = begins.lines().count();
        let column = begins.lines().last().map_or(0, str::len) + 2003;
        let place = format!("part.nc:{lines}:{column}");
        assert!(shown.contains(&place), "{dialect}: {place}: {shown}");
        let shop = Shop::new(&[("part.nc", sum(1000).as_bytes())]);
        accepted(&shop.run_in(dialect, "part.nc", &[]));
    }
}

#[test]
fn a_folder_for_temporary_files_that_is_not_there_is_named() {
    let shop = Shop::new(&[("part.mpf", b"G0 X7\nM30\n")]);
    let tool = env!("CARGO_BIN_EXE_framepath");
    let piped = format!("{tool} filter --dialect sinumerik <(cat part.mpf)");
    let output = Command::new("bash")
        .args(["-c", &piped])
        .env("TMPDIR", "/nothing/here")
        .current_dir(shop.path(""))
        .output();
    let shown = refused(&output.expect("bash runs"));
    assert!(
        shown.contains("/nothing/here: ") && shown.contains("set TMPDIR"),
        "{shown}"
    );
}
