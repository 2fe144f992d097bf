//! Text, CSV and SVG.

use crate::bench::json;
use crate::fields::assert_documented;
use crate::support::{Bench, MILL};
use crate::table::table;

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
    // Corners swing out by P at most.
    assert!((19.99..20.05).contains(&greatest), "{greatest}");
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

/// What README shows is drawn by the command that stands below it.
#[test]
fn the_picture_of_the_readme_is_of_today() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let readme = std::fs::read_to_string(format!("{root}/README.md")).expect("a file");
    let ini = "hal-component/configs/framepath-sim/framepath-sim.ini";
    let command = format!("`framepath plan docs/outline.ngc --ini {ini} --svg outline.svg`");
    assert!(readme.contains(&command));
    let bench = Bench::new();
    let [program, ini] = ["docs/outline.ngc", ini].map(|file| format!("{root}/{file}"));
    let output = bench.plan(&[&program, "--ini", &ini, "--svg", "outline.svg"]);
    assert!(output.status.success(), "{output:?}");
    let shown = std::fs::read_to_string(format!("{root}/docs/outline.svg")).expect("a file");
    let words = |drawing: &str| -> Vec<String> {
        let texts = drawing.lines().filter(|line| line.starts_with("<text"));
        texts.map(str::to_owned).collect()
    };
    assert_eq!(
        words(&shown),
        words(&bench.read("outline.svg")),
        "copy it to docs"
    );
}

/// What is refused leaves no file, and what was there as it was; also where rows were written already.
#[test]
fn a_refused_plan_writes_nothing() {
    let bench = Bench::new();
    let outputs = [
        "--csv",
        "plan.csv",
        "--svg",
        "plan.svg",
        "--html",
        "plan.html",
        "--times",
        "part.ngc.times",
    ];
    let refused = |program: &str, more: &[&str]| {
        bench.write("part.ngc", program);
        bench.refused(&[&["part.ngc"], &outputs[..], more].concat())
    };
    let files = || {
        let entries = std::fs::read_dir(bench.path()).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = names
            .map(|name| name.into_string().expect("text"))
            .collect();
        names.sort();
        names
    };
    // Behind 50 s of motion, more rows than any buffer holds.
    let late = "G21 F600\nG1 X500\nG4 P1\nG33 Z-50 K10\nM2\n";
    let error = refused(late, &[]);
    assert!(error.starts_with("part.ngc:4: "), "{error}");
    assert_eq!(files(), ["part.ngc"]);
    let nothing = refused("G21\nM2\n", &[]);
    assert!(nothing.contains("nothing moves"), "{nothing}");
    assert_eq!(files(), ["part.ngc"]);

    bench.write("plan.csv", "of yesterday");
    refused(late, &[]);
    assert_eq!(files(), ["part.ngc", "plan.csv"]);
    assert_eq!(bench.read("plan.csv"), "of yesterday");

    bench.write("part.ngc", PROGRAM);
    let output = bench.plan(&[&["part.ngc"], &outputs[..]].concat());
    assert!(output.status.success(), "{output:?}");
    let written = [
        "part.ngc",
        "part.ngc.times",
        "plan.csv",
        "plan.html",
        "plan.svg",
    ];
    assert_eq!(files(), written);
    assert!(bench.read("plan.csv").starts_with("time,"));
}

/// In a straight line between the rows: when the machine is where in which move, to half a servo period.
#[test]
fn times_by_line_are_those_of_the_plan() {
    let bench = Bench::new();
    let program = "G21 G64 P0.05 F3000\nG1 X40\nY40\nG4 P0.5\nG1 X0 F900\nM2\n";
    let figures = bench.figures(program, &["--times", "part.ngc.times"]);
    let text = bench.read("part.ngc.times");
    let mut lines = text.lines();
    let sum = program.bytes().fold((1u32, 0u32), |(low, high), byte| {
        let low = (low + u32::from(byte)) % 65_521;
        (low, (high + low) % 65_521)
    });
    let head = format!(
        "framepath times,1,{},{:04x}{:04x}",
        program.len(),
        sum.1,
        sum.0
    );
    assert_eq!(lines.next(), Some(head.as_str()));
    assert_eq!(lines.next(), Some("time,line,move,to_go"));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let time = |row: &Vec<&str>| -> f64 { row[0].parse().expect("a time") };
    assert!(rows.windows(2).all(|pair| time(&pair[0]) <= time(&pair[1])));
    let whole = figures["time"].as_f64().expect("a number");
    assert!((time(rows.last().expect("an end")) - whole).abs() < 0.01);
    // The dwell, with what it takes to notice the end of motion.
    let rest = rows
        .iter()
        .position(|row| row[2] == "2" && row[3].is_empty());
    let rest = rest.expect("a dwell");
    let dwell = time(&rows[rest + 1]) - time(&rows[rest]);
    assert!((0.5..0.51).contains(&dwell), "{dwell}");
    // At 900 mm/min a quarter of the way of 40 mm takes .667 s.
    let last: Vec<_> = rows
        .iter()
        .filter(|row| row[1] == "5" && !row[3].is_empty())
        .collect();
    let at = |to_go: f64| {
        let place = |row: &Vec<&str>| -> f64 { row[3].parse().expect("a length") };
        let pair = last
            .windows(2)
            .find(|pair| place(pair[1]) <= to_go)
            .expect("there");
        let share = (place(pair[0]) - to_go) / (place(pair[0]) - place(pair[1]));
        time(pair[0]) + share * (time(pair[1]) - time(pair[0]))
    };
    assert!((at(15.0) - at(25.0) - 10.0 / 15.0).abs() < 2.5e-3);
}

/// One file that cannot be written, and there is none.
#[test]
fn a_file_that_cannot_be_written_is_told_before_the_plan_begins() {
    let bench = Bench::new();
    bench.write("part.ngc", "G21 F600\nG1 X5 Q?\nM2\n");
    let error = bench.refused(&["part.ngc", "--csv", "plan.csv", "--svg", "no/folder.svg"]);
    assert!(
        error.contains("no/folder.svg: cannot be written"),
        "{error}"
    );
    assert!(!bench.path().join("plan.csv").exists());
}

#[test]
fn fields_of_the_json_are_documented() {
    let bench = Bench::new();
    bench.write("mill.ini", MILL);
    bench.write("part.ngc", PROGRAM);
    bench.write("exact.ngc", "G21 G61.1 F600\nG1 X5\nG64 P0.1\nX9\nY4\nM2\n");
    let plans = bench.plan(&["part.ngc", "exact.ngc", "--ini", "mill.ini", "--json"]);
    let unlimited = bench.plan(&["exact.ngc", "--jerk", "unlimited", "--json"]);
    bench.write("turned.ngc", "G21 G18 F600\nG96 D900 S100 M3\nG1 X5\nM2\n");
    let turned = bench.plan(&["turned.ngc", "--json"]);
    table(&bench, "mm", 1.0);
    let joints = bench.plan(&["exact.ngc", "--ini", "table.ini", "--json"]);
    let all = [plans, unlimited, turned, joints].map(|plan| json(&plan));
    assert_documented("plan", &all);
}

#[test]
fn what_is_not_kept_is_an_exit_status() {
    let bench = Bench::new();
    bench.write("part.ngc", PROGRAM);
    let kept = bench.plan(&["part.ngc", "--check"]);
    assert!(kept.status.success(), "{kept:?}");
    assert!(kept.stderr.is_empty(), "{kept:?}");
    // In a tenth of a second the machine passes a corner by more than P.
    let coarse = bench.plan(&["part.ngc", "--check", "--period", "0.1", "--json"]);
    assert_eq!(coarse.status.code(), Some(1));
    let said = String::from_utf8(coarse.stderr).expect("text");
    assert!(said.starts_with("not kept: part.ngc: "), "{said}");
    assert!(
        said.contains("off the programmed path by") && said.lines().count() == 1,
        "{said}"
    );
    let plan: serde_json::Value = serde_json::from_slice(&coarse.stdout).expect("JSON");
    let findings = plan["programs"][0]["findings"].as_array().expect("a list");
    assert!(
        findings
            .iter()
            .all(|finding| said.contains(finding.as_str().expect("text")))
    );
    let without = bench.plan(&["part.ngc", "--period", "0.1"]);
    assert!(without.status.success());
    let text = String::from_utf8(without.stdout).expect("text");
    assert!(text.contains("\nNot kept\n  "), "{text}");
}

/// What is left of the helix without its turns is flat: LinuxCNC runs it as lines.
#[test]
fn turns_that_linuxcnc_leaves_away_are_not_kept() {
    let bench = Bench::new();
    let program = |words: &str| {
        format!("G21 G17 G90 F1000\nG1 X3 Y0 Z0\n{words}\nG3 X2.9886 Y0.2615 Z-5 I-3 J0 P3\nM2\n")
    };
    for (words, line) in [("G64 P0.01", true), ("G64 P0.01 Q0", false), ("G61", false)] {
        bench.write("part.ngc", &program(words));
        let plan = bench.plan(&["part.ngc", "--check"]);
        let said = String::from_utf8(plan.stderr).expect("text");
        let told = said.contains("LinuxCNC leaves 2 whole turns of the arc at line 4 away");
        assert_eq!(
            (told, plan.status.success()),
            (line, !line),
            "{words}: {said}"
        );
    }
}
