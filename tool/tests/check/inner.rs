//! framekins before the kinematics of another module: what has to be loaded in which order, and what is linked.

use crate::bench::Bench;
use serde_json::Value;

const SAMPLE: &str = "framepath-sim";

/// The net of the samples, and the one that chooses a type of the kinematics.
const SWITCH: &str = "net frame-switch framekins.switchkins-type => motion.switchkins-type";
const SELECT: &str = "net kinstype-select motion.analog-out-03 => framekins.inner-type";

/// The sample with LinuxCNC's own kinematics behind framekins, changed further: what is found of it.
fn found(from: &str, to: &str) -> Vec<(String, String)> {
    let bench = Bench::new();
    let ini = bench.read(SAMPLE, "ini");
    let plain = "KINEMATICS = trivkins coordinates=XYZ kinstype=BOTH";
    bench.write(
        SAMPLE,
        "ini",
        &ini.replacen("KINEMATICS = framekins coordinates=XYZ", plain, 1)
            .replacen("ANALOG_OUTPUT = 0", "ANALOG_OUTPUT = 4", 1),
    );
    let mut hal = bench.read(SAMPLE, "hal");
    for output in (0..9).rev() {
        let names = [output, output + 4].map(|number| format!("motion.analog-out-{number:02}"));
        hal = hal.replacen(&names[0], &names[1], 1);
    }
    let load = "loadrt [KINS]KINEMATICS";
    let behind = format!("loadrt framekins inner=trivkins\n{load}");
    let hal = hal
        .replacen(load, &behind, 1)
        .replacen(SWITCH, &format!("{SWITCH}\n{SELECT}"), 1);
    let changed = hal.replacen(from, to, 1);
    assert!(from.is_empty() || changed != hal, "{from} is not there");
    bench.write(SAMPLE, "hal", &changed);
    let text = |value: &Value| value.as_str().unwrap_or("").to_owned();
    bench
        .findings(SAMPLE)
        .iter()
        .map(|finding| (text(&finding["level"]), finding.to_string()))
        .collect()
}

#[test]
fn a_configuration_that_is_right_has_no_findings() {
    assert_eq!(found("", ""), []);
}

/// What is changed, and what is said of it.
const CASES: [(&str, &str, &str, &str, &str); 12] = [
    (
        "inner=trivkins",
        "inner=trivkins coordinates=XYZ",
        "error",
        "inner=trivkins and coordinates= exclude each other",
        "loadrt framekins inner=trivkins",
    ),
    (
        "inner=trivkins",
        "inner=trivkins tool_length=machine",
        "error",
        "inner=trivkins and tool_length= exclude each other",
        "loadrt framekins inner=trivkins",
    ),
    (
        "inner=trivkins",
        "inner=trivkins tool_types=x",
        "error",
        "tool_types=x is no list of types",
        "tool_types=0,2",
    ),
    (
        "inner=trivkins",
        "inner=trivkins tool_axes=B,C",
        "error",
        "tool_axes=B,C names no axes of A B C that could turn a tool",
        "tool_axes=C,B",
    ),
    (
        "inner=trivkins",
        "inner=scarakins",
        "warning",
        "framekins is loaded before scarakins, and [KINS]KINEMATICS is trivkins",
        "KINEMATICS = scarakins",
    ),
    (
        "inner=trivkins",
        "inner=scarakins",
        "error",
        "nothing loads scarakins, and framekins finds no kinematics",
        "loadrt [KINS]KINEMATICS",
    ),
    (
        "loadrt framekins inner=trivkins\nloadrt [KINS]KINEMATICS\n",
        "loadrt [KINS]KINEMATICS\nloadrt framekins inner=trivkins\n",
        "error",
        "trivkins is loaded before framekins",
        "first loadrt framekins inner=trivkins, then",
    ),
    (
        "loadrt [KINS]KINEMATICS\n",
        "",
        "error",
        "nothing loads trivkins",
        "loadrt [KINS]KINEMATICS",
    ),
    (
        "framekins.switchkins-type => motion.switchkins-type\nnet kinstype-select motion.analog-out-03 => framekins.inner-type",
        "motion.analog-out-03 => motion.switchkins-type",
        "error",
        "chooses the kinematics past framekins",
        "net inner-type motion.analog-out-03 => framekins.inner-type",
    ),
    (
        SELECT,
        "net frame-value-1 => framekins.inner-type",
        "error",
        "chooses the kinematics and carries a part of each frame",
        "ANALOG_OUTPUT = 6",
    ),
    (
        SELECT,
        "net kinstype-select motion.analog-out-13 => framekins.inner-type",
        "warning",
        "G43.4 chooses the kinematics by output 3, and is refused since 13 is linked",
        "TYPE_OUTPUT = 13",
    ),
    (
        "loadrt framekins inner=trivkins\nloadrt [KINS]KINEMATICS",
        "loadrt framekins coordinates=XYZ",
        "error",
        "framekins.inner-type is there with inner= only",
        "loadrt framekins inner=",
    ),
];

#[test]
fn what_is_wrong_is_said_with_what_to_write() {
    for (from, to, level, words, remedy) in CASES {
        let all = found(from, to);
        let fits = |(found, text): &(String, String)| {
            found == level && text.contains(words) && text.contains(remedy)
        };
        assert!(all.iter().any(fits), "{to}: {words}: {all:#?}");
    }
}

/// Where nobody tells which axis tilts the tool, the tolerance is one of each axis.
#[test]
fn a_tolerance_of_rotary_axes_is_none_of_the_tool_axis() {
    let said = |inner: &str, tolerance: &str| {
        let lines = format!("inner={inner}\nsetp blendtp.rotary-tolerance {tolerance}");
        let all = found("inner=trivkins", &lines);
        let of_axis =
            |(_, text): &&(String, String)| text.contains("for each rotary axis by itself");
        all.iter().find(of_axis).cloned()
    };
    let (level, text) = said("xyzab_tdr_kins", "0.05").expect("a finding");
    assert_eq!(level, "note");
    let half = "write half of what the tool axis may lean";
    for part in [
        half,
        "xyzab_tdr_kins",
        "is 0.05 degrees",
        "framepath-sim.hal",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("loadrt framekins"), "{text}");
    // framekins finds it out
    assert_eq!(said("xyzbc-trt-kins", "0.05"), None);
    assert_eq!(said("5axiskins", "0"), None);
    assert_eq!(said("trivkins", "0.05"), None);
}

#[test]
fn motion_before_the_kinematics_is_found() {
    let motion = "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS num_aio=16";
    let load = "loadrt [KINS]KINEMATICS";
    let all = found(&format!("{load}\n{motion}"), &format!("{motion}\n{load}"));
    let said = "motmod is loaded before trivkins, and framekins finds no kinematics";
    assert!(all.iter().any(|(_, text)| text.contains(said)), "{all:#?}");
}
