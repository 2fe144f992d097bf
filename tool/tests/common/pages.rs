//! What holds for the pages of all commands.

use crate::browser::probe;
use serde_json::Value;
use std::path::Path;

/// Clicks on a line of the program: `cursor` is then the text at the bottom of the page, `current` that
/// of the line that is marked, `figures` and `peaks` count what the page shows.
pub fn click_on_line(folder: &Path, page: &str, line: usize) -> Value {
    let script = r##"
window.addEventListener("error", (event) => (document.title = JSON.stringify({ error: event.message })));
window.addEventListener("load", () => {
  document.querySelector("#listing li[value='LINE']").click();
  const text = (place) => [...document.querySelectorAll(place)].map((e) => e.textContent).join("|");
  document.title = JSON.stringify({
    cursor: text("#cursor:not([hidden])"), current: text("#listing .current"),
    verdict: text(".verdict"), findings: text("#findings li"), legend: text("#legend"),
    figures: document.querySelectorAll(".figure").length, peaks: document.querySelectorAll("#peaks tbody tr").length });
});
"##;
    probe(
        folder,
        &[],
        page,
        &script.replace("LINE", &line.to_string()),
    )
}

/// Fails if the page asks for anything outside of its file, or was not filled in.
pub fn assert_needs_nothing(page: &str) {
    for word in [
        "http",
        "src=",
        "@import",
        "url(",
        "fetch(",
        "XMLHttpRequest",
        "<link",
        "{{",
    ] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    assert_eq!(page.matches("</script>").count(), 2);
}
