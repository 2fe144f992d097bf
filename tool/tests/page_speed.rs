//! The page of a long plan in headless Chromium: how long it takes to open and to turn. The number of
//! moves is that of the environment variable FRAMEPATH_PAGE_MOVES, 50,000 without it.

#[path = "common/browser.rs"]
mod browser;
#[path = "common/surface.rs"]
mod surface;

use std::process::Command;
use std::time::{Duration, Instant};
use surface::surface;

const MOVES: usize = 50_000;

/// Longest time from the beginning of the load until everything is drawn.
const OPENED: Duration = Duration::from_secs(5);

/// Longest time of a frame while the drawing is turned: 20 frames a second, drawn by the processor.
const FRAME: Duration = Duration::from_millis(50);

/// Measures while the page is being loaded, so that the browser waits for it, and puts what it finds
/// into the title. Reading a point of the picture makes the browser finish drawing it. Of all frames
/// the fastest counts: they cost nearly the same, and the computer may have other things to do.
const PROBE: &str = r#"
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
"#;

#[test]
fn the_page_of_a_long_plan_opens_and_turns_smoothly() {
    let moves = std::env::var("FRAMEPATH_PAGE_MOVES").map_or(MOVES, |moves| {
        moves.parse().expect("FRAMEPATH_PAGE_MOVES is a number")
    });
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("long.ngc"), surface(moves)).expect("room for the program");
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
    let found = browser::probe(folder.path(), &[], &page, PROBE);
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
