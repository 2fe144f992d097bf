//! The operator's panel under another screen than AXIS.

use crate::bench::Bench;
use serde_json::Value;

const SAMPLE: &str = "framepath-sim";

const TAB: &str =
    "EMBED_TAB_COMMAND = gladevcp -x {XID} -c pyvcp -H ../../panel/panel.hal ../../panel/panel.ui";

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

/// The findings in a sample with the panel in gmoccapy, with this line.
fn in_gmoccapy(line: &str) -> Vec<Value> {
    let bench = Bench::new();
    let ini = bench
        .read(SAMPLE, "ini")
        .replace("DISPLAY = axis", &format!("DISPLAY = gmoccapy\n{line}"))
        .replace("frame_axis.py", "frame_gmoccapy.py")
        .replace("PYVCP = ../../panel/panel.xml", "")
        .replace("POSTGUI_HALFILE = ../../panel/panel.hal", "");
    bench.write(SAMPLE, "ini", &ini);
    bench.findings(SAMPLE)
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
