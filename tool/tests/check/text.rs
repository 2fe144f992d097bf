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
    let wanted = format!(
        "\
framepath-sim.ini:{}:1: error: nothing sets blendtp.axis.y.max-jerk, so that the jerk of Y is not limited, although the INI file has a limit
  write into ./framepath-sim.hal:
    setp blendtp.axis.y.max-jerk [AXIS_Y]MAX_JERK

./framepath-sim.hal:2:1: error: framekins.value.1 is not linked: every frame is refused, since what arrives is not what was sent
  write into ./framepath-sim.hal:
    net frame-value-1 motion.analog-out-01 => framekins.value.1

from its greatest velocity to rest, by an abort or a feed hold:
  X: 7.5 mm in 0.15 s (100 mm/s, 1000 mm/s2, 20000 mm/s3)
  Y: 5 mm in 0.1 s (100 mm/s, 1000 mm/s2, jerk not limited)
  Z: 7.5 mm in 0.15 s (100 mm/s, 1000 mm/s2, 20000 mm/s3)
framepath-sim.ini: 2 errors, 0 warnings, 0 notes
",
        jerk_of_y + 1
    );
    let text = String::from_utf8(output.stdout).expect("a text");
    assert_eq!(text, wanted);
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
