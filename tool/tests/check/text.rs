//! What a user sees.

use crate::bench::{Bench, framepath};
use crate::fields::assert_documented;
use std::path::Path;

#[test]
fn the_text_has_file_line_column_and_the_line_to_write() {
    let bench = Bench::new();
    let name = "framepath-sim";
    let hal = bench.read(name, "hal");
    let hal = hal.replace(
        "net frame-value-1 motion.analog-out-01 => framekins.value.1\n",
        "",
    );
    bench.write(
        name,
        "hal",
        &hal.replace("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n", ""),
    );
    let ini = bench.read(name, "ini");
    let jerk_of_y = ini
        .lines()
        .enumerate()
        .skip_while(|(_, line)| !line.starts_with("[AXIS_Y]"))
        .find(|(_, line)| line.starts_with("MAX_JERK"))
        .expect("its limit")
        .0;
    let output = bench.check(name, &[]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).expect("a text");
    // Which line of the sample that is, is no matter of the text.
    let place = format!("framepath-sim.ini:{}:1", jerk_of_y + 1);
    assert!(text.starts_with(&place), "{text}");
    let text = text.replace(&place, "framepath-sim.ini:LINE:1");
    assert!(text.ends_with("0 notes\n"));
    insta::assert_snapshot!("errors_say_what_to_write_where", text);
}

#[test]
fn an_ini_file_that_cannot_be_read_is_an_error() {
    let output = framepath(Path::new("/"), &["check", "nowhere.ini"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty());
    let text = String::from_utf8(output.stderr).expect("a text");
    assert!(text.starts_with("nowhere.ini: cannot be read"), "{text}");
}

#[test]
fn without_errors_the_exit_code_is_0() {
    let bench = Bench::new();
    let output = bench.check("framepath-xyzac", &[]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).expect("a text");
    assert!(
        text.contains("  C: 4.5 deg in 0.15 s (60 deg/s, 600 deg/s2, 12000 deg/s3)\n"),
        "{text}"
    );
}

#[test]
fn an_axis_with_which_every_move_is_refused_has_no_stop() {
    for jerk in ["-20000", "1", "nan"] {
        let bench = Bench::new();
        let ini = bench.read("framepath-xyzac", "ini");
        let (before, axis) = ini.split_once("[AXIS_C]").expect("its section");
        let axis = axis.replacen("MAX_JERK = 12000", &format!("MAX_JERK = {jerk}"), 1);
        let changed = format!("{before}[AXIS_C]{axis}");
        bench.write("framepath-xyzac", "ini", &changed);
        let output = bench.check("framepath-xyzac", &[]);
        let text = String::from_utf8(output.stdout).expect("a text");
        assert!(text.contains("blendtp refuses every move"), "{text}");
        assert!(text.contains("  A: "), "{text}");
        assert!(!text.contains("  C: "), "{text}");
    }
}

#[test]
fn fields_of_the_json_are_documented() {
    let bench = Bench::new();
    let name = "framepath-sim";
    let ini = bench.read(name, "ini");
    let hal = bench.read(name, "hal");
    // To remove, to replace, something else to do, and to add.
    let ini = ini.replace(
        "CLEAR_AT_END = 1",
        "CLEAR_AT_START = 1\nTOOL_LENGTHS = frame",
    );
    let ini = ini.replace("mpf = framepath filter", "mpf = framepath check");
    let hal = hal.replace("setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK\n", "");
    bench.write(name, "ini", &ini);
    bench.write(name, "hal", &hal);
    let output = bench.check(name, &["--json"]);
    let report = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_documented("check", &[report]);
}
