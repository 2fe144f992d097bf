//! `framepath report` as a user calls it.

#[path = "common/browser.rs"]
mod browser;
#[path = "common/fields.rs"]
mod fields;
#[path = "common/pages.rs"]
mod pages;

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

const INI: &str = "\
[EMC]
MACHINE = Bench
[EMCMOT]
SERVO_PERIOD = 1000000
[TRAJ]
LINEAR_UNITS = mm
[KINS]
KINEMATICS = trivkins coordinates=X
[AXIS_X]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
MAX_JERK = 20000
[JOINT_0]
MAX_VELOCITY = 100
MAX_ACCELERATION = 1000
";

/// A move of X with four phases of 40 ms of `jerk`, then 40 ms of rest; line 7.
fn constant_jerk_run(jerk: f64) -> String {
    let mut text = "time,id,line,joint.0,axis.x\n".to_owned();
    for row in 0..=200 {
        let mut left = f64::from(row) * 0.001;
        let [mut x, mut v, mut a] = [0.0; 3];
        for j in [jerk, -jerk, -jerk, jerk] {
            let t = left.min(0.04);
            x += t * (v + t * (a / 2.0 + t * j / 6.0));
            v += t * (a + t * j / 2.0);
            a += t * j;
            left -= t;
        }
        writeln!(text, "{:.3},4,7,{x:.12},{x:.12}", f64::from(row) * 0.001).expect("a string");
    }
    text
}

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(recording: &str, ini: &str) -> Bench {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("run.csv"), recording).expect("written");
        std::fs::write(folder.path().join("bench.ini"), ini).expect("written");
        Bench { folder }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Runs the report in the folder of the files.
    fn report(&self, more: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_framepath"))
            .current_dir(self.path())
            .args(["report", "--recording", "run.csv", "--ini", "bench.ini"])
            .args(more)
            .output()
            .expect("the program runs")
    }

    /// The figures of a run.
    fn json(&self, more: &[&str]) -> Value {
        let output = self.report(&[&["--json"], more].concat());
        assert!(output.status.success(), "{output:?}");
        serde_json::from_slice(&output.stdout).expect("JSON")
    }

    /// The message of a run that is refused, without any output.
    fn refused(&self, more: &[&str]) -> String {
        let output = self.report(&[&["--html", "out.html"], more].concat());
        assert!(!output.status.success());
        assert!(output.stdout.is_empty(), "nothing on standard output");
        assert!(!self.path().join("out.html").exists());
        String::from_utf8(output.stderr).expect("text")
    }
}

#[test]
fn text_json_and_page_agree() {
    let bench = Bench::new(&constant_jerk_run(20000.0), INI);
    std::fs::write(bench.path().join("part.ngc"), "G21\nG0 X2\n").expect("written");
    let output = bench.report(&["--html", "out.html", "part.ngc"]);
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.is_ascii() && text.starts_with("part\n"), "{text}");
    assert!(
        text.ends_with("Result: PASS, all within limits\nPage: out.html\n"),
        "{text}"
    );

    let report = bench.json(&["part.ngc"]);
    assert_eq!(report["verdict"], "pass");
    assert_eq!(report["machine"], "Bench");
    assert_eq!(report["length_unit"], "mm");
    assert_eq!(report["rows"], 201);
    assert_eq!(report["moves"]["ids_seen"], 1);
    assert!(report["moves"]["programmed"].is_null() && report["path"].is_null());
    let near = |value: &Value, expected: f64, allowed: f64| {
        let number = value.as_f64().expect("a number");
        assert!((number - expected).abs() <= allowed, "{number} {expected}");
    };
    // x = 2 j t^3 for four phases of t: 20000 * 0.04^3 * 2.
    near(&report["path_length"], 2.56, 1e-9);
    near(&report["time"]["total"], 0.2, 1e-9);
    near(&report["time"]["in_motion"], 0.16, 1.5e-3);
    let joint = &report["joints"][0];
    assert_eq!(
        (joint["name"].as_str(), joint["letter"].as_str()),
        (Some("joint.0"), Some("X"))
    );
    assert_eq!(joint["peaks"][2]["quantity"], "jerk");
    assert_eq!(joint["peaks"][2]["judgement"], "within");
    assert_eq!(joint["peaks"][2]["line"], 7);
    near(&joint["peaks"][2]["peak"], 20000.0, 0.02);
    near(&joint["peaks"][2]["limit"], 20000.0, 0.0);
    near(&joint["peaks"][0]["peak"], 32.0, 0.01);
    near(&joint["peaks"][0]["time"], 0.08, 1e-3);

    let page = std::fs::read_to_string(bench.path().join("out.html")).expect("the file");
    assert!(page.contains("<title>part</title>") && page.contains("G0 X2"));
    assert!(!page.contains("http"));
}

#[test]
fn the_page_needs_nothing_and_shows_the_place_of_a_line() {
    let bench = Bench::new(&constant_jerk_run(20000.0), INI);
    std::fs::write(
        bench.path().join("part.ngc"),
        "G21\n(a)\n".repeat(3) + "G0 X2\n",
    )
    .expect("written");
    let output = bench.report(&["--html", "out.html", "part.ngc"]);
    assert!(output.status.success(), "{output:?}");
    let page = std::fs::read_to_string(bench.path().join("out.html")).expect("the file");
    // What was recorded is line 7.
    pages::assert_needs_nothing(&page);
    let found = pages::click_on_line(bench.path(), &page, 7);
    assert_eq!(found["current"], "G0 X2", "{found}");
    let cursor = found["cursor"].as_str().expect("text");
    assert!(
        cursor.contains("line7") && cursor.ends_with("G0 X2"),
        "{found}"
    );
    assert_eq!(found["verdict"], "Within all limits", "{found}");
    assert_eq!(found["figures"], 5, "{found}");
    // Velocity, acceleration and jerk of a joint and of an axis.
    assert_eq!(found["peaks"], 6, "{found}");
}

#[test]
fn a_broken_limit_is_said_in_words() {
    let bench = Bench::new(&constant_jerk_run(22000.0), INI);
    let output = bench.report(&["--title", "Too hard"]);
    assert!(output.status.success(), "a report was made: {output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("OVER LIMIT"), "{text}");
    assert!(
        text.contains("joint.0: jerk is 1.1 times its limit (22000 of 20000 mm/s3) at"),
        "{text}"
    );
    assert!(text.ends_with("Result: FAIL, see above\n"), "{text}");
}

/// The exit status with --check, and what is said on standard error.
fn checked(recording: &str, more: &[&str]) -> (Option<i32>, String) {
    let output = Bench::new(recording, INI).report(&[&["--check"], more].concat());
    assert!(String::from_utf8_lossy(&output.stdout).contains("Result: "));
    let said = String::from_utf8(output.stderr).expect("text");
    (output.status.code(), said)
}

#[test]
fn what_is_not_kept_is_an_exit_status() {
    assert_eq!(
        checked(&constant_jerk_run(20000.0), &[]),
        (Some(0), String::new())
    );
    let (status, said) = checked(&constant_jerk_run(22000.0), &[]);
    assert_eq!((status, said.lines().count()), (Some(1), 1));
    let of_joint = "not kept: joint.0: jerk is 1.1 times its limit (22000 of 20000 mm/s3)";
    assert!(said.starts_with(of_joint), "{said}");
    assert!(said.contains("; axis.x: jerk is 1.1 times"), "{said}");
    // A gap is no pass either: nobody knows what happened there.
    let run = constant_jerk_run(20000.0);
    let rows = run.lines().filter(|line| !line.starts_with("0.190,"));
    let gap: String = rows.map(|line| format!("{line}\n")).collect();
    let (status, said) = checked(&gap, &[]);
    assert_eq!(status, Some(1));
    let unknown = "not all could be checked: The recording lacks servo cycles in 1 place(s)";
    assert!(said.starts_with(unknown), "{said}");
}

#[test]
fn too_few_decimals_are_not_passed_over() {
    let rounded: String = constant_jerk_run(20000.0)
        .lines()
        .map(|line| {
            let fields: Vec<String> = line
                .split(',')
                .map(|field| {
                    field
                        .get(..8)
                        .filter(|_| field.len() > 10)
                        .unwrap_or(field)
                        .to_owned()
                })
                .collect();
            fields.join(",") + "\n"
        })
        .collect();
    let output = Bench::new(&rounded, INI).report(&[]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("jerk cannot be judged"), "{text}");
    assert!(
        text.ends_with("Result: INCOMPLETE, not all could be checked\n"),
        "{text}"
    );
}

#[test]
fn a_missing_limit_is_the_one_that_linuxcnc_takes() {
    let no_limit = INI.replace("MAX_ACCELERATION = 1000\nMAX_JERK", "MAX_JERK");
    let output = Bench::new(&constant_jerk_run(20000.0), &no_limit).report(&[]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert!(
        told.contains(
            "bench.ini: [AXIS_X]MAX_ACCELERATION is missing: LinuxCNC takes 1 mm/s2 then"
        ),
        "{told}"
    );
}

#[test]
fn unusable_files_are_refused_with_file_line_and_remedy() {
    let good = constant_jerk_run(20000.0);
    let damaged = good.replacen("0.100,4,7,", "0.100,4,", 1);
    assert!(
        Bench::new(&damaged, INI)
            .refused(&[])
            .contains("run.csv:102: 4 fields, but the header has 5")
    );
    let other_period = INI.replace("1000000", "2000000");
    assert!(
        Bench::new(&good, &other_period)
            .refused(&[])
            .contains("the rows are 1 ms apart, [EMCMOT]SERVO_PERIOD is 2 ms")
    );
    let two_joints = format!(
        "{}[JOINT_1]\nMAX_VELOCITY = 1\nMAX_ACCELERATION = 1\n",
        INI.replace("coordinates=X", "coordinates=XX")
    );
    assert!(
        Bench::new(&good, &two_joints)
            .refused(&[])
            .contains("1 joints are recorded, [KINS]KINEMATICS names 2")
    );
    let other_axis = good.replacen("axis.x", "axis.y", 1);
    assert!(
        Bench::new(&other_axis, INI)
            .refused(&[])
            .contains("the axes `y` are recorded")
    );

    let bench = Bench::new(&good, INI);
    assert!(
        bench
            .refused(&["missing.mpf"])
            .contains("missing.mpf: cannot be read")
    );
    assert!(
        bench
            .refused(&["--tolerance", "-1"])
            .contains("a number above 0")
    );
    assert!(
        bench
            .refused(&["--dialect", "none", "run.csv"])
            .contains("'none' for '--dialect <DIALECT>'")
    );
    // Without the path of the program nothing is compared with it.
    for more in [
        &["--tolerance", "1", "--check"][..],
        &["--tolerance", "1", "run.csv"],
    ] {
        let said = bench.refused(more);
        assert!(said.contains("--dialect <DIALECT>"), "{said}");
    }
    std::fs::remove_file(bench.path().join("bench.ini")).expect("removed");
    assert!(bench.refused(&[]).contains("bench.ini: cannot be read"));
}

/// As `framepath filter` takes it on the machine: in its unit, with its tools, and with the same options.
#[test]
fn a_program_in_its_dialect_is_read_as_it_was_filtered() {
    let run = constant_jerk_run(20000.0);
    let compared = |bench: &Bench, program: &str, more: &[&str]| {
        std::fs::write(bench.path().join("part.mpf"), program).expect("written");
        let options = ["--tolerance", "0.001", "--dialect"];
        bench.json(&[&options[..], more, &["part.mpf"]].concat())
    };
    let follows = |bench: &Bench, program: &str, more: &[&str]| {
        let figures = compared(bench, program, more);
        assert_eq!(figures["verdict"], "pass", "{figures}");
    };
    let bench = Bench::new(&run, INI);
    follows(
        &bench,
        "G1 F6000 X=R5\nM2\n",
        &["sinumerik", "--set", "R5=2.56"],
    );
    let increments = ["fanuc", "--decimal-point", "increments"];
    follows(&bench, "G1 F6000 X2560\nM2\n", &increments);
    let inches = INI.replace("LINEAR_UNITS = mm", "LINEAR_UNITS = inch");
    let inches = inches + "[EMCIO]\nTOOL_TABLE = tool.tbl\n";
    let bench = Bench::new(&run, &inches);
    std::fs::write(bench.path().join("tool.tbl"), "T4 P4 D1 ;MILL_6\n").expect("written");
    follows(
        &bench,
        "G70\nT=\"MILL_6\"\nM6\nG1 F60 X2.56\nM2\n",
        &["sinumerik"],
    );

    std::fs::write(bench.path().join("part.mpf"), "G1 F9\nG41 D1 X9\nG40\nM2\n").expect("written");
    let said = bench.refused(&["--dialect", "sinumerik", "part.mpf"]);
    assert!(
        said.contains("part.mpf:2:") && said.contains("leave --dialect"),
        "{said}"
    );
    let said = bench.refused(&["--set", "R5=1", "part.mpf"]);
    assert!(said.contains("need --dialect"), "{said}");
}

#[test]
fn a_report_that_cannot_be_written_leaves_nothing() {
    let bench = Bench::new(&constant_jerk_run(20000.0), INI);
    let output = bench.report(&["--json", "--html", "no/out.html"]);
    assert!(!output.status.success() && output.stdout.is_empty());
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(said.contains("no/out.html: cannot be written"), "{said}");
}

#[test]
fn a_page_does_not_take_the_place_of_what_is_read() {
    let bench = Bench::new(&constant_jerk_run(20000.0), INI);
    std::os::unix::fs::symlink("run.csv", bench.path().join("link")).expect("a link");
    std::fs::write(bench.path().join("part.ngc"), "G1 X1\n").expect("written");
    for file in ["bench.ini", "./run.csv", "link", "part.ngc"] {
        let before = std::fs::read(bench.path().join(file)).expect("a file");
        let output = bench.report(&["--html", file, "part.ngc"]);
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.starts_with(&format!("{file}: this file is read")),
            "{said}"
        );
        assert_eq!(
            std::fs::read(bench.path().join(file)).expect("a file"),
            before
        );
    }
}

#[test]
fn what_is_no_recording_is_told_with_its_line() {
    let zeros = "\0".repeat(1 << 20);
    let quoted = format!("{}\"", constant_jerk_run(20000.0)) + &"x\n".repeat(1 << 17);
    for (recording, said) in [
        (zeros, "run.csv:1: a line of more than 65536 bytes"),
        (
            constant_jerk_run(20000.0) + &"1".repeat(1 << 17),
            "run.csv:203: a line of more",
        ),
        (quoted, "run.csv:203: "),
    ] {
        let bench = Bench::new(&recording, INI);
        let output = bench.report(&[]);
        let told = String::from_utf8(output.stderr).expect("text");
        assert!(!output.status.success() && told.starts_with(said), "{told}");
    }
    let bench = Bench::new("", INI);
    std::fs::remove_file(bench.path().join("run.csv")).expect("removed");
    std::fs::create_dir(bench.path().join("run.csv")).expect("a folder");
    let told = String::from_utf8(bench.report(&[]).stderr).expect("text");
    assert!(
        told.starts_with("run.csv: cannot be read: it is a folder"),
        "{told}"
    );
}

/// The same run with another frame from row 180 on, and without row 190.
fn with_frame_change_and_gap(run: &str) -> String {
    let mut text = String::new();
    for (number, line) in run.lines().enumerate() {
        let (before, x) = line.rsplit_once(',').expect("fields");
        match number {
            190 => {}
            180.. => {
                let x: f64 = x.parse().expect("a number");
                writeln!(text, "{before},{:.12}", x + 12.5).expect("a string");
            }
            _ => writeln!(text, "{line}").expect("a string"),
        }
    }
    text
}

#[test]
fn fields_are_documented() {
    let hard = constant_jerk_run(22000.0);
    let bench = Bench::new(&hard, INI);
    let compared = |target: &str| {
        let program = format!("G1 F6000 {target}\nM2\n");
        std::fs::write(bench.path().join("part.mpf"), program).expect("written");
        let options = ["--dialect", "sinumerik", "--tolerance", "0.1", "part.mpf"];
        bench.json(&options)
    };
    let (followed, departed) = (compared("X2.816"), compared("Y5"));
    assert_eq!(followed["path"]["result"], "followed", "{followed}");
    assert_eq!(departed["path"]["result"], "departed", "{departed}");
    let changed = with_frame_change_and_gap(&hard);
    std::fs::write(bench.path().join("run.csv"), changed).expect("written");
    fields::assert_documented("report", &[followed, departed, bench.json(&[])]);
}

#[test]
fn an_axis_whose_limit_is_above_that_of_its_joint_is_named() {
    let ini = INI.replacen("MAX_ACCELERATION = 1000", "MAX_ACCELERATION = 2000", 1);
    let bench = Bench::new(&constant_jerk_run(30_000.0), &ini.replace("20000", "40000"));
    let output = bench.report(&["--check"]);
    let told = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(
        told.contains("joint.0: acceleration is 1.19 times its limit (1190 of 1000 mm/s2)")
            && told.contains(", line 7: [AXIS_X]MAX_ACCELERATION = 2000 is above it"),
        "{told}"
    );
}
