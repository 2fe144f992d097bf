//! The operator's panel under another screen than AXIS.

use crate::bench::Bench;
use serde_json::Value;

const SAMPLE: &str = "framepath-sim";

const TAB: &str =
    "EMBED_TAB_COMMAND = gladevcp -x {XID} -c pyvcp -H ../../panel/panel.hal ../../panel/panel.ui";

/// A machine with A and C, and its tab.
const TABLE: &str = "framepath-xyzac";
const TAB_OF_A_TABLE: &str = "EMBED_TAB_COMMAND = gladevcp -x {XID} -c pyvcp -H ../../panel/panel_ui_xyzac.hal ../../panel/panel.ui";

/// The findings that speak of it.
fn of(words: &str, findings: Vec<Value>) -> Vec<Value> {
    let speak = |finding: &Value| finding.to_string().contains(words);
    findings.into_iter().filter(speak).collect()
}

#[test]
fn only_axis_has_that_of_pyvcp() {
    let bench = Bench::new();
    for (from, to, help) in [
        ("DISPLAY = axis", "DISPLAY = gmoccapy", TAB),
        (
            "DISPLAY = axis",
            "DISPLAY = qtvcp qtdragon",
            "POSTGUI_HALFILE = ../../panel/panel_window.hal in place of this line",
        ),
        (
            "DISPLAY = axis",
            "DISPLAY = touchy",
            "remove this line and [DISPLAY]PYVCP, or set",
        ),
        (
            "PYVCP = ../../panel/panel.xml",
            "",
            "remove this line and [DISPLAY]PYVCP, or set",
        ),
    ] {
        let of_panel = of(
            "links pins of pyvcp",
            bench.changed(SAMPLE, "ini", from, to),
        );
        assert_eq!(of_panel.len(), 1, "{to}: {of_panel:?}");
        let ini = bench.read(SAMPLE, "ini");
        let line = 1 + ini
            .lines()
            .position(|line| line.starts_with("POSTGUI_HALFILE"))
            .expect("a line");
        assert_eq!(of_panel[0]["line"], line, "{:?}", of_panel[0]);
        let text = of_panel[0].to_string();
        assert!(text.contains(help), "{to}: {text}");
    }
}

#[test]
fn a_machine_with_rotary_axes_has_lamps_for_them() {
    let bench = Bench::new();
    for (screen, help) in [
        ("gmoccapy", TAB_OF_A_TABLE),
        (
            "qtvcp",
            "POSTGUI_HALFILE = ../../panel/panel_window_xyzac.hal in place of this line",
        ),
    ] {
        let findings = bench.changed(
            TABLE,
            "ini",
            "DISPLAY = axis",
            &format!("DISPLAY = {screen}"),
        );
        let of_panel = of("links pins of pyvcp", findings);
        assert_eq!(of_panel.len(), 2, "{screen}: {of_panel:?}");
        for finding in of_panel {
            assert!(finding.to_string().contains(help), "{screen}: {finding}");
        }
    }
    let before = sample_in_gmoccapy(TABLE, "");
    assert_eq!(sample_in_gmoccapy(TABLE, TAB_OF_A_TABLE), before);
    let found = of("no lamps of A and C", sample_in_gmoccapy(TABLE, TAB));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["level"], "note", "{found:?}");
    assert_eq!(found[0]["remedy"]["line"], TAB_OF_A_TABLE, "{found:?}");
    assert_eq!(
        of("no lamps of A and C", in_gmoccapy(TAB)),
        Vec::<Value>::new()
    );
}

/// The findings in a sample with the panel in gmoccapy, with this line.
fn in_gmoccapy(line: &str) -> Vec<Value> {
    sample_in_gmoccapy(SAMPLE, line)
}

fn sample_in_gmoccapy(sample: &str, line: &str) -> Vec<Value> {
    let bench = Bench::new();
    let ini = bench
        .read(sample, "ini")
        .replace("DISPLAY = axis", &format!("DISPLAY = gmoccapy\n{line}"))
        .replace("frame_axis.py", "frame_gmoccapy.py")
        .replace("PYVCP = ", "# ")
        .replace("POSTGUI_HALFILE = ", "# ");
    bench.write(sample, "ini", &ini);
    bench.findings(sample)
}

#[test]
fn a_tab_has_all_that_it_needs() {
    let before = in_gmoccapy("");
    assert_eq!(in_gmoccapy(TAB), before);
    // another panel is none of ours
    assert_eq!(
        in_gmoccapy("EMBED_TAB_COMMAND = gladevcp -x {XID} pump.ui"),
        before
    );
    for (from, to, words) in [
        ("-c pyvcp ", "", "without -c pyvcp"),
        ("-c pyvcp", "-c frames", "without -c pyvcp"),
        ("-H ../../panel/panel.hal ", "", "without -H"),
        ("panel.hal", "gone.hal", "gone.hal is not there"),
        (
            " ../../panel/panel.ui",
            " ../gone/panel.ui",
            "../gone/panel.ui is not there",
        ),
    ] {
        let found = of(words, in_gmoccapy(&TAB.replace(from, to)));
        assert_eq!(found.len(), 1, "{to}: {found:?}");
        assert_eq!(found[0]["remedy"]["action"], "replace", "{found:?}");
        assert_eq!(found[0]["remedy"]["line"], TAB, "{found:?}");
    }
}
