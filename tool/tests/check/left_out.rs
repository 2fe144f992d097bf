//! Each line of ours that is left out of a sample is named, with the very line to write.

use crate::bench::{Bench, SAMPLES};
use serde_json::Value;

/// Keys whose values are the user's: what is to be written has another one.
const OWN_VALUES: [&str; 7] = [
    "X_ROT_POINT",
    "Y_ROT_POINT",
    "Z_ROT_POINT",
    "Y_OFFSET",
    "Z_OFFSET",
    "RETRACT_Z",
    "LINEAR_UNITS",
];

fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Lines of HAL files that ours need.
fn is_ours_in_hal(line: &str) -> bool {
    let parts = [
        "blendtp",
        "framekins",
        "frame_guard",
        "loadrt [",
        "addf motion",
    ];
    !line.starts_with('#') && parts.iter().any(|part| line.contains(part))
}

/// Lines of INI files that ours need, in this section.
fn is_ours_in_ini(section: &str, line: &str) -> bool {
    let keys = [
        "TPMOD",
        "KINEMATICS",
        "JOINTS",
        "MAX_JERK",
        "SUBROUTINE_PATH",
        "OWORD_NARGS",
        "ON_ABORT_COMMAND",
        "REMAP",
        "PROGRAM_EXTENSION",
        "LINEAR_UNITS",
        "USER_COMMAND_FILE",
    ];
    let key = line.split('=').next().unwrap_or("").trim();
    let own = matches!(section, "[FRAMEPATH]" | "[TABLE]")
        || line.contains("framepath filter")
        || keys.contains(&key);
    own && line.contains('=') && !line.starts_with('#')
}

/// Whether a finding asks for this line.
fn asks_for(finding: &Value, line: &str) -> bool {
    let lines = finding["remedy"]["lines"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    lines.iter().filter_map(Value::as_str).any(|asked| {
        let (asked, line) = (words(asked), words(line));
        match line[0] {
            key if OWN_VALUES.contains(&key) => asked[0] == key,
            // Another language may be meant.
            _ if line.contains(&"--dialect") => asked[..4] == line[..4],
            // What the screen calls the programs is up to the user.
            "PROGRAM_EXTENSION" => asked[..3] == line[..3],
            _ => asked == line,
        }
    })
}

/// Leaves out one line after another; how many there were.
fn leave_out(
    bench: &Bench,
    name: &str,
    ending: &str,
    is_ours: impl Fn(&str, &str) -> bool,
) -> usize {
    let text = bench.read(name, ending);
    let lines: Vec<&str> = text.lines().collect();
    let (mut section, mut count) = ("", 0);
    for (index, line) in lines.iter().enumerate() {
        if line.starts_with('[') {
            section = line;
        }
        if !is_ours(section, line) {
            continue;
        }
        count += 1;
        let mut rest = lines.clone();
        rest.remove(index);
        bench.write(name, ending, &rest.join("\n"));
        let findings = bench.findings(name);
        assert!(
            findings.iter().any(|finding| asks_for(finding, line)),
            "{name}.{ending} without `{line}`: {findings:#?}"
        );
    }
    bench.write(name, ending, &text);
    count
}

#[test]
fn every_line_of_a_hal_file() {
    let bench = Bench::new();
    for name in SAMPLES {
        let count = leave_out(&bench, name, "hal", |_, line| is_ours_in_hal(line));
        assert!(count > 25, "{name}: {count}");
    }
}

#[test]
fn every_line_of_an_ini_file() {
    let bench = Bench::new();
    for name in SAMPLES {
        let count = leave_out(&bench, name, "ini", is_ours_in_ini);
        assert!(count > 30, "{name}: {count}");
    }
}

#[test]
fn the_headings_of_sections_of_ours() {
    let bench = Bench::new();
    for (name, heading) in [
        ("framepath-sim", "[FRAMEPATH]"),
        ("framepath-xyzac", "[TABLE]"),
    ] {
        let findings = bench.changed(name, "ini", &format!("{heading}\n"), "");
        let asks = |finding: &Value| {
            finding["remedy"]["into"] == heading || finding["remedy"]["lines"][0] == heading
        };
        assert!(findings.iter().any(asks), "{name}: {findings:#?}");
    }
}
