//! Text, CSV and SVG.

use crate::support::Bench;

const PROGRAM: &str = "G21 G64 P0.05 F3000\nG1 X20\nX20 Y10 Z3\nG2 X0 Y10 I-10\nM2\n";

#[test]
fn a_row_for_each_cycle() {
    let bench = Bench::new();
    let figures = bench.figures(PROGRAM, &["--csv", "plan.csv"]);
    let text = bench.read("plan.csv");
    let mut rows = text.lines();
    let header = "time,id,line,axis.x,axis.y,axis.z,axis.a,axis.b,axis.c,axis.u,axis.v,axis.w,speed,\
                  limited_by";
    assert_eq!(rows.next(), Some(header));
    let xs: Vec<f64> = rows
        .map(|row| row.split(',').nth(3).expect("x").parse().expect("a number"))
        .collect();
    let cycles = figures["cycles"].as_u64().expect("a count") as usize;
    assert!((cycles..cycles + 30).contains(&xs.len()));
    assert_eq!(xs.last(), Some(&0.0));
    let greatest = xs.iter().copied().fold(0.0, f64::max);
    assert!((greatest - 20.0).abs() < 1e-2, "{greatest}");
}

#[test]
fn the_text_is_ascii_and_aligned() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    let output = bench.plan(&["part.ngc", "part.ngc"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.stderr.is_empty() && text.is_ascii());
    assert_eq!(text.matches("Where the time goes").count(), 2);
    for part in [
        "Time  ",
        "Nearest to P",
        "Slowest places",
        "Peaks of the axes",
    ] {
        assert!(text.contains(part), "{part}:\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 150));
}

#[test]
fn the_drawing_is_whole_and_labelled() {
    let bench = Bench::new();
    bench.write("a <b>.ngc", PROGRAM);
    let output = bench.plan(&["a <b>.ngc", "--svg", "plan.svg"]);
    assert!(output.status.success());
    let svg = bench.read("plan.svg");
    assert!(svg.starts_with("<svg xmlns") && svg.ends_with("</svg>\n"));
    assert!(svg.contains(">a &lt;b&gt;.ngc<") && !svg.contains("NaN") && !svg.contains("inf"));
    for label in [
        "speed along the path (mm/s)",
        "time (s)",
        "speed (mm/s)",
        ">X<",
        ">Y<",
        ">Z<",
        "box ",
    ] {
        assert!(svg.contains(label), "{label}");
    }
    let opened = svg.matches("<text").count() + svg.matches("<path").count();
    assert_eq!(
        svg.matches("</text>").count() + svg.matches("/>").count(),
        opened + 1
    );
}
