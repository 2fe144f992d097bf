//! The page of a long plan in headless Chromium: how long it takes to open and to turn. The number of
//! moves is that of the environment variable FRAMEPATH_PAGE_MOVES, 50,000 without it.

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

const MOVES: usize = 50_000;

/// Longest time from the beginning of the load until everything is drawn.
const OPENED: Duration = Duration::from_secs(5);

/// Longest time of a frame while the drawing is turned: 20 frames a second, drawn by the processor.
const FRAME: Duration = Duration::from_millis(50);

/// Measures while the page is being loaded, so that the browser waits for it, and puts what it finds
/// into the title. Reading a point of the picture makes the browser finish drawing it. Of all frames
/// the fastest counts: they cost nearly the same, and the computer may have other things to do.
const PROBE: &str = r##"<script>
window.addEventListener("error", (event) => (document.title = "error: " + event.message));
window.addEventListener("load", () => {
  const space = document.getElementById("space");
  const picture = space.querySelector("canvas");
  const finish = () => picture.getContext("2d").getImageData(0, 0, 1, 1);
  finish();
  const opened = performance.now();
  const place = space.getBoundingClientRect();
  const send = (type, x, y) => space.dispatchEvent(new PointerEvent(type, {
    clientX: place.left + x, clientY: place.top + y, bubbles: true, pointerId: 1 }));
  space.setPointerCapture = () => {};
  const before = picture.toDataURL();
  let frame = Infinity;
  send("pointerdown", 100, 150);
  for (let k = 1; k <= 60; k++) {
    const begin = performance.now();
    send("pointermove", 100 + 5 * k, 150 + k);
    finish();
    frame = Math.min(frame, performance.now() - begin);
  }
  send("pointerup", 400, 210);
  document.title = JSON.stringify({ opened, frame, turned: picture.toDataURL() !== before });
});
</script>"##;

/// Lines of 0.2 mm over a wavy surface.
fn surface(moves: usize) -> String {
    let mut text = "G21 G90 G64 P0.01 Q0\nG0 Z10\nF6000\n".to_owned();
    for k in 0..moves {
        let (row, place) = (k / 1000, k % 1000);
        let x = 0.2 * if row % 2 == 0 { place } else { 999 - place } as f64;
        let z = 4.0 * (x / 15.0).sin() + 0.5 * (x / 3.1).sin();
        let y = 0.3 * row as f64;
        writeln!(text, "G1 X{x:.4} Y{y:.4} Z{z:.4}").expect("a string");
    }
    text + "M2\n"
}

fn browser() -> &'static str {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let is_there = |name: &&str| Path::new("/usr/bin").join(name).exists();
    let found = names.into_iter().find(is_there);
    found.expect("a browser: ./prerequisites browser installs chromium")
}

fn open(folder: &Path, more: &str, file: &str) -> Output {
    Command::new(browser())
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--window-size=1400,2400",
            more,
        ])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("browser").display()
        ))
        .arg(format!("file://{}", folder.join(file).display()))
        .output()
        .expect("the browser runs")
}

#[test]
fn the_page_of_a_long_plan_opens_and_turns_smoothly() {
    let moves = std::env::var("FRAMEPATH_PAGE_MOVES").map_or(MOVES, |moves| {
        moves.parse().expect("FRAMEPATH_PAGE_MOVES is a number")
    });
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("room for the page");
    };
    write("long.ngc", &surface(moves));
    let begun = Instant::now();
    let planned = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(folder.path())
        .args(["plan", "long.ngc", "--html", "long.html"])
        .output()
        .expect("the program runs");
    let planning = begun.elapsed();
    let complaints = String::from_utf8_lossy(&planned.stderr);
    assert!(planned.status.success(), "{complaints}");
    let page = std::fs::read_to_string(folder.path().join("long.html")).expect("a page");
    write(
        "probed.html",
        &page.replace("</body>", &format!("{PROBE}</body>")),
    );
    let output = open(folder.path(), "--dump-dom", "probed.html");
    let dom = String::from_utf8_lossy(&output.stdout);
    let title = dom
        .split_once("<title>")
        .and_then(|(_, rest)| rest.split_once("</title>"));
    let (found, _) = title.expect("a page with a title");
    let found: serde_json::Value = serde_json::from_str(found).expect(found);
    let milliseconds = |name: &str| {
        let value = found[name].as_f64().expect("a number");
        Duration::from_secs_f64(value * 1e-3)
    };
    println!(
        "{moves} moves: planned in {planning:.1?}, a page of {:.1} MB, opened in {:.0?}, {:.1?} a frame",
        page.len() as f64 * 1e-6,
        milliseconds("opened"),
        milliseconds("frame"),
    );
    assert_eq!(found["turned"], true, "{found}");
    assert!(milliseconds("opened") < OPENED, "{found}");
    assert!(milliseconds("frame") < FRAME, "{found}");
}
