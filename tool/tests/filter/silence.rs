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
