//! Pages in headless Chromium.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn browser() -> &'static str {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let is_there = |name: &&str| Path::new("/usr/bin").join(name).exists();
    let found = names.into_iter().find(is_there);
    found.expect("a browser: ./prerequisites browser installs chromium")
}

/// Opens a page of the folder; what the browser prints.
pub fn open(folder: &Path, more: &[&str], file: &str) -> Output {
    Command::new(browser())
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--window-size=1400,2400",
        ])
        .args(more)
        .arg(format!(
            "--user-data-dir={}",
            folder.join("browser").display()
        ))
        .arg(format!("file://{}", folder.join(file).display()))
        .output()
        .expect("the browser runs")
}

/// What a script that is put at the end of a page finds; it writes it into the title as JSON.
pub fn probe(folder: &Path, more: &[&str], page: &str, script: &str) -> Value {
    let probed = page.replace("</body>", &format!("<script>{script}</script></body>"));
    std::fs::write(folder.join("probed.html"), probed).expect("room for the page");
    let output = open(folder, &[more, &["--dump-dom"]].concat(), "probed.html");
    let dom = String::from_utf8_lossy(&output.stdout);
    let title = dom
        .split_once("<title>")
        .and_then(|(_, rest)| rest.split_once("</title>"));
    let (found, _) = title.expect("a page with a title");
    serde_json::from_str(found).expect(found)
}
