//! A panel of AXIS under another screen.

use crate::bench::Bench;

const SAMPLE: &str = "framepath-sim";

#[test]
fn only_axis_has_it() {
    let bench = Bench::new();
    for (from, to) in [
        ("DISPLAY = axis", "DISPLAY = gmoccapy"),
        ("PYVCP = ../../panel/panel.xml", ""),
    ] {
        let findings = bench.changed(SAMPLE, "ini", from, to);
        let of_panel: Vec<_> = findings
            .iter()
            .filter(|finding| finding.to_string().contains("links pins of pyvcp"))
            .collect();
        assert_eq!(of_panel.len(), 1, "{findings:?}");
        let ini = bench.read(SAMPLE, "ini");
        let line = 1 + ini
            .lines()
            .position(|line| line.starts_with("POSTGUI_HALFILE"))
            .expect("a line");
        assert_eq!(of_panel[0]["line"], line, "{:?}", of_panel[0]);
        let text = of_panel[0].to_string();
        assert!(
            text.contains("remove this line and [DISPLAY]PYVCP"),
            "{text}"
        );
    }
}
