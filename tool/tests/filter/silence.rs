//! What once went lost without a word.

use crate::shop::{Shop, accepted, commands, refused, translate};

/// The lines behind the header, without messages.
fn lines(program: &str) -> Vec<String> {
    let lines = commands(&translate(&format!("{program}\nM30\n"), &[])).into_iter();
    lines.filter(|line| !line.starts_with("(MSG")).collect()
}

fn refusal(dialect: &str, program: &[u8], arguments: &[&str]) -> String {
    let shop = Shop::new(&[("part.nc", program)]);
    refused(&shop.run_in(dialect, "part.nc", arguments))
}

/// F beside G96 is per turn and holds on, LIMS holds from where it stands, and G96 without S goes on with
/// the cutting speed of before.
#[test]
fn words_beside_g96_hold() {
    for (program, expected) in [
        (
            "G0 X20\nG96 F0.2 S200 LIMS=3000 M4\nG1 X10\nX5",
            &[
                "G0 X20",
                "G95 F0.2 G96 D3000 S200 M4",
                "G1 X10",
                "G1 X5",
                "M30",
            ][..],
        ),
        (
            "G96 S200\nLIMS=1500",
            &["G95 G96 S200", "G96 D1500 S200", "M30"],
        ),
        (
            "G96 S200\nG97 S800\nG96",
            &["G95 G96 S200", "G97 S800", "G95 G96 S200", "M30"],
        ),
    ] {
        let found: Vec<String> = lines(program).iter().map(|line| sorted(line)).collect();
        let wanted: Vec<String> = expected.iter().map(|line| sorted(line)).collect();
        assert_eq!(found, wanted, "{program}");
    }
    let shown = refusal("sinumerik", b"S500 M3\nG96\nM30\n", &[]);
    assert!(
        shown.contains("2:1") && shown.contains("no cutting speed"),
        "{shown}"
    );
}

/// In Fanuc-like programs G92 S holds from where it stands too, and G20 counts feet.
#[test]
fn cutting_speeds_of_fanuc_programs_hold() {
    for (program, expected) in [
        ("G92 S3000\nG96 S200", &["D3000 G96 S200"][..]),
        ("G96 S200\nG92 S1500", &["G96 S200", "D1500 G96 S200"]),
        (
            "G96 S200\nG97 S800\nG96",
            &["G96 S200", "G97 S800", "G96 S200"],
        ),
        ("G20\nG96 S1000", &["G96 S304.8"]),
    ] {
        let program = format!("O1\n{program}\nM30\n");
        let shop = Shop::new(&[("part.nc", program.as_bytes())]);
        let output = accepted(&shop.run_in("fanuc", "part.nc", &[]));
        let found = commands(&output).into_iter();
        let found = found.filter(|line| line.contains("G96") || line.contains("G97"));
        let found: Vec<String> = found.map(|line| sorted(&line)).collect();
        assert_eq!(found, expected, "{program}");
    }
    for program in ["G96", "G92 S1000 X5.", "G96 G92 S1000"] {
        let program = format!("O1\n{program}\nM30\n");
        assert!(refusal("fanuc", program.as_bytes(), &[]).contains("part.nc:2:"));
    }
}

fn sorted(line: &str) -> String {
    let mut words: Vec<&str> = line.split(' ').collect();
    words.sort_unstable();
    words.join(" ")
}

/// LinuxCNC begins a rigid tap at the index of the spindle.
#[test]
fn a_tap_begins_at_the_angle_zero_or_is_refused() {
    let program =
        |angle: &str| format!("G0 X0 Y0 Z9\nCYCLE84(5,0,2,-7,,0,3,,1,{angle},300,300)\nM30\n");
    for angle in ["", "0", "360"] {
        assert!(
            translate(&program(angle), &[]).contains("G33.1 Z-7 K1"),
            "{angle}"
        );
    }
    let shown = refusal("sinumerik", program("90").as_bytes(), &[]);
    assert!(shown.contains("2:26") && shown.contains("POSS"), "{shown}");
}

#[test]
fn a_floating_tap_needs_its_axis() {
    let shown = refusal("sinumerik", b"G0 X0\nG63 F300\nM30\n", &[]);
    assert!(
        shown.contains("2:1") && shown.contains("G63 needs the axis"),
        "{shown}"
    );
}

/// M functions that LinuxCNC defines itself would do something else: they are neither suggested nor passed on.
#[test]
fn m_functions_of_linuxcnc_are_not_passed_on() {
    for (m, own) in [
        (50, true),
        (62, true),
        (66, true),
        (98, true),
        (21, false),
        (101, false),
    ] {
        for dialect in ["sinumerik", "fagor", "mefi", "isg", "fanuc"] {
            // There it calls a subprogram.
            if (dialect, m) == ("fanuc", 98) {
                continue;
            }
            let shown = refusal(dialect, format!("M{m}\nM30\n").as_bytes(), &[]);
            assert_eq!(shown.contains("of its own"), own, "{shown}");
            assert_eq!(shown.contains(&format!("--pass-m {m}")), !own, "{shown}");
        }
        let program = format!("M{m}\nM30\n");
        let shop = Shop::new(&[("part.nc", program.as_bytes())]);
        let output = shop.run("part.nc", &["--pass-m", &m.to_string()]);
        match own {
            true => assert_eq!(output.status.code(), Some(2), "{m}"),
            false => assert!(accepted(&output).contains(&format!("M{m}")), "{m}"),
        }
    }
}

/// What only a part of the words of a block uses leaves no other word without effect.
#[test]
fn words_that_nothing_uses_are_refused() {
    for (block, place, word) in [
        ("G4 F1 SPOS=90", "2:7", "SPOS"),
        ("G4 F1 LIMS=1000", "2:7", "LIMS"),
        ("G4 F1 RNDM=2", "2:7", "RNDM"),
        ("G4 F1 CTOL=0.5 G64", "2:7", "CTOL"),
        ("G4 F1 AP=30 RP=5", "2:7", "AP"),
        ("G4 F1 ADIS=1", "2:7", "ADIS"),
        ("G4 F1 G9", "2:7", "G9"),
        ("G4 F1 SUPA", "2:7", "SUPA"),
        ("G4 F1 G111", "2:7", "G111"),
        ("G111 X5 Y5 RNDM=3", "2:12", "RNDM"),
        ("G110 X5 Y5 CR=4 AR=3", "2:12", "CR"),
        ("G112 X5 Y5 ANG=5", "2:12", "ANG"),
        ("G111 X5 Y5 K2", "2:12", "K"),
        ("G111 X5 Y5 G53", "2:1", "G111"),
        ("G53 G1 X10 RND=2", "2:12", "RND"),
        ("SUPA G0 X10 CHF=2", "2:13", "CHF"),
        ("G153 G0 X10 G9", "2:13", "G9"),
        ("G52 X10 RNDM=2", "2:9", "RNDM"),
        ("G92 X10 AP=20", "2:9", "AP"),
        ("G33 Z-5 K1 RND=2", "2:12", "RND"),
        ("G33 Z-5 K1 G9", "2:12", "G9"),
        ("G63 Z-5 F100 CR=3", "2:14", "CR"),
        ("G331 Z-5 K1 CHR=1", "2:13", "CHR"),
        ("G41 G247 DISR=5 X10 Y10 RND=1", "2:25", "RND"),
    ] {
        let shown = refusal(
            "sinumerik",
            format!("S100 M3 G0 X0 Y0 Z5 F100\n{block}\nM30\n").as_bytes(),
            &[],
        );
        let wanted = format!("{word} has no meaning beside G");
        assert!(shown.contains(&wanted), "{block}\n{shown}");
        assert!(
            shown.contains(&format!("part.nc:{place}")),
            "{block}\n{shown}"
        );
    }
    for (block, word) in [
        ("X10 FAD=200", "FAD"),
        ("X10 DISCL=3", "DISCL"),
        ("DISR=3", "DISR"),
    ] {
        let program = format!("G1 X0 Y0 F100\n{block}\nM30\n");
        let shown = refusal("sinumerik", program.as_bytes(), &[]);
        let wanted = format!("{word} belongs to a smooth approach");
        assert!(shown.contains(&wanted), "{block}\n{shown}");
    }
    // Modes beside a dwell are set.
    assert_eq!(lines("G4 F1 G64\nG1 X1 F9")[..2], ["G64 P0.01", "G4 P1"]);
    for word in ["F100", "S500", "D1", "R5"] {
        let program = format!("G0 X0\nG4 K100 {word}\nM30\n");
        let shown = refusal("fagor", program.as_bytes(), &[]);
        assert!(
            shown.contains("G4 stands alone in its block"),
            "{word}\n{shown}"
        );
    }
}

/// A tool that T selects and no M6 changes to is not that of the lengths that D takes.
#[test]
fn tools_without_a_change_are_named() {
    let said = |program: &str| {
        let output = translate(&format!("{program}\nM30\n"), &[]);
        output.matches("is selected and not changed to").count()
    };
    assert_eq!(said("T1 D1\nG0 X0\nX5\nT2 D1\nX6"), 1);
    for program in [
        "T1 M6\nD1\nG0 X0",
        "T1 D1\nM6\nG0 X0",
        "T1\nG0 X0",
        "T1 D0\nG0 X0",
    ] {
        assert_eq!(said(program), 0, "{program}");
    }
}

/// NULs before and behind lines are fillers of tapes; inside of one something was lost.
#[test]
fn nul_bytes_are_errors_with_a_place() {
    for dialect in ["sinumerik", "fagor", "mefi", "isg", "fanuc"] {
        for options in [&[][..], &["--longest-whole", "0", "--piece", "5"]] {
            for program in [
                &b"G0 X1\nG0 X1\x000\nM30\n"[..],
                b"G0 X1\nG0 X\x0010\nM30\n",
            ] {
                let shown = refusal(dialect, program, options);
                assert!(
                    shown.contains("part.nc:2:") && shown.contains("NUL"),
                    "{shown}"
                );
            }
            let shown = refusal(dialect, &[0; 100], options);
            assert!(
                shown.contains("part.nc:1:1") && shown.contains("nothing but NUL"),
                "{shown}"
            );
        }
    }
    let shop = Shop::new(&[("part.mpf", b"L10\nM30\n"), ("l10.spf", &[0; 40])]);
    let shown = refused(&shop.run("part.mpf", &[]));
    assert!(shown.contains("l10.spf:1:1"), "{shown}");
}
