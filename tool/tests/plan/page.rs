//! The page: needs nothing from anywhere, and works in a browser.

use crate::browser::{open, probe};
use crate::pages::{assert_needs_nothing, click_on_line};
use crate::support::{Bench, MILL};
use serde_json::Value;

const PROGRAM: &str =
    "G21 G64 P0.05 F3000\nG1 X20 </script>\nX20 Y10 Z3\nG2 X0 Y10 I-10\nG0 X0 Y0 Z0\nM2\n";

fn page(bench: &Bench) -> String {
    bench.write("part.ngc", &PROGRAM.replace(" </script>", " (</script>)"));
    let output = bench.plan(&["part.ngc", "--html", "plan.html"]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    bench.read("plan.html")
}

#[test]
fn the_page_needs_nothing_from_anywhere() {
    let page = page(&Bench::new());
    assert_needs_nothing(&page);
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    let data: serde_json::Value =
        serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("valid JSON");
    assert_eq!(data["listing"]["lines"][1][1], "G1 X20 (</script>)");
}

/// Turns the drawing in space and looks at everything that must not overlap; what it finds becomes the
/// title of the page.
const PROBE: &str = r##"
window.addEventListener("error", (event) => (document.title = "error: " + event.message));
window.addEventListener("load", () => setTimeout(() => {
  try {
    const space = document.getElementById("space");
    const place = space.getBoundingClientRect();
    const send = (type, x) => space.dispatchEvent(new PointerEvent(type, {
      clientX: place.left + x, clientY: place.top + 150, bubbles: true, pointerId: 1 }));
    space.setPointerCapture = () => {};
    const before = space.firstChild.toDataURL();
    send("pointerdown", 100);
    const begin = performance.now();
    for (let k = 1; k <= 20; k++) send("pointermove", 100 + 5 * k);
    const frame = (performance.now() - begin) / 20;
    send("pointerup", 200);
    const turned = space.firstChild.toDataURL() !== before;
    const boxes = [...document.querySelectorAll(".figure, h2, .canvas, table, .legend, .profile-title, footer")]
      .map((e) => [e, e.getBoundingClientRect()]).filter(([, b]) => b.width * b.height > 0);
    let overlaps = 0;
    boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
      if (a.contains(b) || b.contains(a)) return;
      if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) overlaps++;
    }));
    const wide = document.documentElement.scrollWidth - innerWidth;
    const rows = document.querySelectorAll("#places tbody tr").length;
    const choice = document.querySelector("[value=cause]");
    choice.click();
    const kinds = document.querySelectorAll("#legend .swatch").length;
    document.title = JSON.stringify({ turned, frame, overlaps, wide, rows, kinds,
      curves: document.querySelectorAll(".profile").length });
  } catch (error) {
    document.title = "error: " + error;
  }
}, 200));
"##;

/// Time of the browser that the script may take, ms.
const TIME: &str = "--virtual-time-budget=6000";

#[test]
fn the_page_turns_and_nothing_overlaps() {
    let bench = Bench::new();
    let page = page(&bench);
    let found = probe(bench.path(), &[TIME], &page, PROBE);
    assert_eq!(found["turned"], true, "{found}");
    assert_eq!(found["overlaps"], 0, "{found}");
    assert!(found["wide"].as_f64().expect("a number") <= 0.0, "{found}");
    assert!(
        found["rows"].as_u64() > Some(0) && found["kinds"].as_u64() > Some(2),
        "{found}"
    );
    // Three axes, speed and distance.
    assert_eq!(found["curves"], 11, "{found}");
    let picture = format!("--screenshot={}", bench.path().join("page.png").display());
    open(bench.path(), &[TIME, &picture], "plan.html");
    let size = std::fs::metadata(bench.path().join("page.png")).map_or(0, |file| file.len());
    assert!(size > 50_000, "{size}");
}

#[test]
fn a_click_on_a_line_shows_its_place() {
    let bench = Bench::new();
    let found = click_on_line(bench.path(), &page(&bench), 4);
    assert_eq!(found["current"], "G2 X0 Y10 I-10", "{found}");
    let cursor = found["cursor"].as_str().expect("text");
    assert!(
        cursor.contains("line4") && cursor.contains("limited by"),
        "{found}"
    );
    assert!(cursor.ends_with("G2 X0 Y10 I-10"), "{found}");
}

/// Looks at the tables, at the rapids and at the playback. A browser without a window draws no frames while it waits, so that
/// scrolling is told by the script, and a timer stands for the frames.
const CONTROLS: &str = r##"
window.addEventListener("error", (event) => (document.title = JSON.stringify({ error: event.message })));
window.addEventListener("load", () => setTimeout(async () => {
  const get = (id) => document.getElementById(id);
  const pause = (time) => new Promise((done) => setTimeout(done, time));
  const places = get("places");
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  window.cancelAnimationFrame = clearTimeout;
  const scroll = (place) => {
    places.scrollLeft = place;
    places.dispatchEvent(new Event("scroll"));
  };
  const sides = () => ["more-left", "more-right"].filter((side) => places.classList.contains(side)).join(" ");
  const found = { hidden: places.scrollWidth - places.clientWidth, tables: [sides()] };
  scroll(60);
  found.tables.push(sides());
  scroll(1e6);
  found.tables.push(sides());
  const drawn = () => get("space").firstChild.toDataURL();
  const before = drawn();
  found.offered = !get("rapids").closest("label").hidden;
  get("rapids").click();
  found.without = drawn() !== before;
  get("rapids").click();
  found.again = drawn() === before;
  get("instant").value = 0.5;
  get("instant").dispatchEvent(new Event("input"));
  found.cursor = get("cursor").textContent;
  get("play").click();
  found.playing = get("play").textContent;
  await pause(400);
  get("play").click();
  found.paused = get("play").textContent;
  found.instant = Number(get("instant").value);
  found.shown = get("cursor").textContent;
  get("instant").value = get("instant").max;
  get("instant").dispatchEvent(new Event("input"));
  found.clock = document.querySelector("#playback output").textContent;
  document.title = JSON.stringify(found);
}, 200));
"##;

/// What [`CONTROLS`] finds in a window of this size.
fn controls(bench: &Bench, size: &str) -> Value {
    let size = format!("--window-size={size}");
    probe(bench.path(), &[TIME, &size], &page(bench), CONTROLS)
}

#[test]
fn tables_say_that_they_go_on_rapids_go_and_time_runs() {
    let found = controls(&Bench::new(), "700,1600");
    assert!(found["hidden"].as_f64() > Some(60.0), "{found}");
    let sides = ["more-right", "more-left more-right", "more-left"];
    assert_eq!(found["tables"], serde_json::json!(sides), "{found}");
    for what in ["offered", "without", "again"] {
        assert_eq!(found[what], true, "{what}: {found}");
    }
    let cursor = found["cursor"].as_str().expect("text");
    assert!(cursor.starts_with("time0.500 s"), "{found}");
    assert_eq!(found["playing"], "Pause", "{found}");
    assert_eq!(found["paused"], "Play", "{found}");
    // As fast as the machine: what the browser needs for its frames comes on top.
    let instant = found["instant"].as_f64().expect("a time");
    assert!((0.6..1.5).contains(&instant), "{found}");
    assert!(
        !found["shown"]
            .as_str()
            .expect("text")
            .starts_with("time0.500"),
        "{found}"
    );
    let clock = found["clock"].as_str().expect("text");
    let (at, end) = clock.split_once(" of ").expect("two times");
    assert_eq!(format!("{at} s"), end, "{found}");
}

#[test]
fn in_a_wide_window_no_table_goes_on() {
    let found = controls(&Bench::new(), "1400,1600");
    assert_eq!(found["tables"], serde_json::json!(["", "", ""]), "{found}");
}

#[test]
fn far_from_the_program_the_page_says_what_to_write() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 G64 F6000\nG1 X20\nY20\nX0\nM2\n");
    let output = bench.plan(&["part.ngc", "--html", "plan.html"]);
    let text = String::from_utf8_lossy(&output.stdout);
    let advice = "G64 P0.05 keeps it within 0.05 mm";
    assert!(
        text.contains(&format!("(G64 without P: {advice})")),
        "{text}"
    );
    let script = r#"window.addEventListener("load", () => {
      document.title = JSON.stringify(document.getElementById("figures").textContent);
    });"#;
    let found = probe(bench.path(), &[TIME], &bench.read("plan.html"), script);
    assert!(found.as_str().expect("text").contains(advice), "{found}");
}

/// What the page shows of a program on a machine with this INI file.
fn shown(ini: &str, program: &str, script: &str) -> Value {
    let bench = Bench::new();
    bench.write("machine.ini", ini);
    bench.write("part.ngc", program);
    let output = bench.plan(&["part.ngc", "--ini", "machine.ini", "--html", "plan.html"]);
    assert!(output.status.success(), "{output:?}");
    probe(bench.path(), &[TIME], &bench.read("plan.html"), script)
}

/// All that is written, in the page and in its drawings: these are drawn before the script runs, and once more.
const WRITTEN: &str = r#"window.addEventListener("load", () => {
  const written = [];
  const write = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...more) {
    written.push(`[${this.canvas.parentElement.id}: ${text}]`);
    write.call(this, text, ...more);
  };
  window.dispatchEvent(new Event("resize"));
  document.title = JSON.stringify(document.querySelector("main").innerText + written.join(" "));
});"#;

#[test]
fn a_lathe_is_drawn_in_its_plane_and_x_is_a_radius() {
    let lathe = MILL
        .replace("COORDINATES = XYZ", "COORDINATES = XZ")
        .replace("coordinates=XYZ", "coordinates=XZ");
    let program = "G21 G18 G7 G61\nG0 X20 Z0\nG1 X10 F600\nZ-30\nM2\n";
    let found = shown(&lathe, program, WRITTEN);
    let text = found.as_str().expect("text");
    for words in [
        "X over Z",
        "X is a radius",
        "[plan: X, a radius (mm)]",
        "[plan: Z (mm)]",
        "[plan: \u{2212}30]",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(!text.contains("Seen from above"), "{text}");
    let shown_as_one = MILL.to_owned() + "[DISPLAY]\nLATHE = 1\n";
    let found = shown(&shown_as_one, program, WRITTEN);
    assert!(
        found.as_str().expect("text").contains("[plan: Z (mm)]"),
        "{found}"
    );
    let found = shown(MILL, program, WRITTEN);
    let text = found.as_str().expect("text");
    assert!(
        text.contains("[plan: Y (mm)]") && text.contains("Seen from above"),
        "{text}"
    );
    assert!(!text.contains("radius"), "{text}");
}

#[test]
fn what_only_turns_is_shown_in_degrees() {
    let table = MILL
        .replace("COORDINATES = XYZ", "COORDINATES = XYA")
        .replace("coordinates=XYZ", "coordinates=XYA")
        .replace("AXIS_Z", "AXIS_A");
    let found = shown(&table, "G21 G64 P0.01\nG1 A90 F360\nG1 A0\nM2\n", WRITTEN);
    let text = found.as_str().expect("text");
    for words in [
        "speed along the path (deg/s)",
        "Slowest (deg/s)",
        "0.010000 deg",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(!text.contains("mm/s") && !text.contains('\u{b5}'), "{text}");
    // What is off by nothing but rounding has one mark, 0; behind it stands that of the time.
    let of_distance = "G21 G61\nG1 X20 F600\nM2\n";
    let found = shown(MILL, of_distance, WRITTEN);
    let text = found.as_str().expect("text");
    assert!(
        text.contains("distance (\u{b5}m)") && !text.contains("[: 0] [: 0] [: 0]"),
        "{text}"
    );
}
