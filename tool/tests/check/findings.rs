//! What is contradictory or unwise, each with its place and what to write.

use crate::bench::Bench;
use serde_json::Value;

/// A change of a sample, and what is found: level, line of the file, a part of the words, what to write.
struct Case {
    sample: &'static str,
    ending: &'static str,
    from: &'static str,
    to: &'static str,
    level: &'static str,
    found: &'static str,
    write: &'static str,
}

const fn case(
    (ending, from, to): (&'static str, &'static str, &'static str),
    level: &'static str,
    found: &'static str,
    write: &'static str,
) -> Case {
    Case {
        sample: "framepath-sim",
        ending,
        from,
        to,
        level,
        found,
        write,
    }
}

const CASES: [Case; 45] = [
    case(
        ("ini", "DISPLAY = axis", "DISPLAY = gmoccapy"),
        "warning",
        "frame_axis.py has no word of gmoccapy_frames",
        "frame_gmoccapy.py",
    ),
    case(
        ("ini", "DISPLAY = axis", "DISPLAY = qtvcp qtdragon"),
        "warning",
        "frame_axis.py has no word of qtvcp_frames",
        "frame_qtvcp.py",
    ),
    case(
        ("ini", "/frame_axis.py", "/nowhere.py"),
        "warning",
        "nowhere.py cannot be read",
        "frame_axis.py",
    ),
    case(
        ("hal", " num_aio=16", ""),
        "error",
        "4 analog outputs",
        "num_aio=16",
    ),
    case(
        ("hal", "num_aio=16", "num_aio=8"),
        "error",
        "motion.analog-out-00 to 08",
        "num_aio=16",
    ),
    case(
        ("ini", "ANALOG_OUTPUT = 0", "ANALOG_OUTPUT = 10"),
        "error",
        "motion.analog-out-10 to 18",
        "num_aio=19",
    ),
    case(
        ("hal", "motion.analog-out-02 =>", "motion.analog-out-12 =>"),
        "error",
        "framekins.value.2 is linked to motion.analog-out-12",
        "motion.analog-out-02",
    ),
    case(
        ("hal", "motion.teleop-mode", "motion.coord-mode"),
        "error",
        "motion.teleop-mode is needed",
        "net motion-teleop motion.teleop-mode",
    ),
    case(
        ("hal", "framekins.value.3", "framekins.valu.3"),
        "error",
        "no pin framekins.valu.3",
        "man framekins",
    ),
    case(
        ("hal", "framekins.value.3", "framekins.x-rot-point"),
        "error",
        "tilting table only",
        "machine=xyzac",
    ),
    case(
        ("hal", "blendtp.axis.x.max-jerk", "blendtp.axis.x.jerk"),
        "error",
        "no pin blendtp.axis.x.jerk",
        "man blendtp",
    ),
    case(
        (
            "hal",
            "addf motion-controller servo-thread\n",
            "addf motion-controller servo-thread 1\n",
        ),
        "error",
        "before motion-command-handler",
        "behind",
    ),
    case(
        (
            "hal",
            "addf framekins servo-thread",
            "addf framekins servo-thread 1",
        ),
        "error",
        "before motion-controller",
        "behind",
    ),
    case(
        (
            "hal",
            "addf framekins servo-thread",
            "addf framekins base-thread",
        ),
        "error",
        "thread base-thread",
        "addf framekins servo-thread",
    ),
    case(
        (
            "hal",
            "addf framekins servo-thread",
            "addf framekins servo-thread\naddf framekins servo-thread",
        ),
        "error",
        "added already",
        "remove",
    ),
    case(
        (
            "hal",
            "loadrt [KINS]KINEMATICS",
            "loadrt [KINS]KINEMATICS\nloadrt tpmod",
        ),
        "warning",
        "tpmod is loaded beside",
        "remove",
    ),
    case(
        (
            "hal",
            "loadrt [KINS]KINEMATICS",
            "loadrt [KINS]KINEMATICS\nloadrt blendtp",
        ),
        "error",
        "loaded already",
        "remove",
    ),
    case(
        (
            "hal",
            "loadrt [KINS]KINEMATICS",
            "loadrt trivkins\nloadrt [KINS]KINEMATICS",
        ),
        "error",
        "trivkins is loaded already",
        "remove",
    ),
    case(
        ("hal", "loadrt [KINS]KINEMATICS", "loadrt trivkins"),
        "error",
        "loads trivkins",
        "loadrt [KINS]KINEMATICS",
    ),
    case(
        (
            "hal",
            "loadrt [KINS]KINEMATICS",
            "loadrt framekins coordinates=XZY",
        ),
        "error",
        "coordinates=XZY is loaded",
        "loadrt [KINS]KINEMATICS",
    ),
    case(
        ("hal", "-Wn frame-guard", ""),
        "error",
        "does not wait",
        "-Wn frame-guard",
    ),
    case(
        (
            "hal",
            "subroutines/frame_guard.py",
            "elsewhere/frame_guard.py",
        ),
        "error",
        "is not there",
        "frame_guard.py",
    ),
    case(
        (
            "hal",
            "framekins.hold => motion.feed-inhibit",
            "framekins.hold => motion.feed-hold",
        ),
        "error",
        "motion.feed-inhibit is not linked",
        "net frame-hold => motion.feed-inhibit",
    ),
    case(
        ("hal", "net estop-loop", "net estop-loop framekins.value.1"),
        "error",
        "signal frame-value-1 already",
        "signal frame-value-1",
    ),
    case(
        (
            "hal",
            "setp spindle.0.at-speed 1",
            "spind spindle.0.at-speed 1",
        ),
        "error",
        "`spind` is no command",
        "correct",
    ),
    case(
        (
            "hal",
            "setp spindle.0.at-speed 1",
            "setp spindle.0.at-speed \"1",
        ),
        "error",
        "quotation mark",
        "close",
    ),
    case(
        ("ini", "TPMOD = blendtp", "TPMOD = tpmod"),
        "error",
        "TPMOD loads tpmod",
        "TPMOD = blendtp",
    ),
    case(
        ("ini", "coordinates=XYZ", "coordinates=XY"),
        "error",
        "names 2 joints",
        "a letter for each joint",
    ),
    case(
        ("ini", "coordinates=XYZ", "coordinates=XYQ"),
        "error",
        "letter 3 is none of",
        "framekins coordinates=",
    ),
    case(
        ("ini", "coordinates=XYZ", "coordinates=XYZ machine=xyzac"),
        "error",
        "needs the axis A",
        "framekins coordinates=",
    ),
    case(
        (
            "ini",
            "KINEMATICS = framekins coordinates=XYZ",
            "KINEMATICS = trivkins",
        ),
        "error",
        "needs framekins",
        "KINEMATICS = framekins coordinates=XYZ",
    ),
    case(
        ("ini", "MAX_JERK = 20000", "MAX_JERK = 100"),
        "error",
        "refuses every move",
        "MAX_JERK = 20000",
    ),
    case(
        ("ini", "MAX_JERK = 20000", "MAX_JERK = 2000"),
        "warning",
        "an abort at 100 mm/s takes 22.4 mm",
        "MAX_JERK = 10000",
    ),
    case(
        ("ini", "MAX_JERK = 20000", "MAX_JERK = 20000 # much"),
        "error",
        "takes a pin and a value, 4 words",
        "no comment",
    ),
    case(
        ("ini", "MAX_JERK = 20000", "MAX_JERK = 2e9"),
        "note",
        "nothing is limited",
        "MAX_JERK = 20000",
    ),
    case(
        (
            "ini",
            "MAX_LINEAR_VELOCITY = 100\n# The",
            "MAX_LINEAR_VELOCITY = 0\n# The",
        ),
        "error",
        "above 0",
        "MAX_LINEAR_VELOCITY = 100",
    ),
    case(
        (
            "ini",
            "MAX_LINEAR_VELOCITY = 100\n# The",
            "MAX_LINEAR_VELOCITY = 80\n# The",
        ),
        "warning",
        "keeps Z from",
        "MAX_LINEAR_VELOCITY = 100",
    ),
    case(
        (
            "ini",
            "MAX_VELOCITY = 100\nMAX_ACCELERATION = 1000\nMAX_JERK",
            "MAX_VELOCITY = 100\nMAX_ACCELERATION = 1200\nMAX_JERK",
        ),
        "warning",
        "asks more of the joint",
        "MAX_ACCELERATION = 1000",
    ),
    case(
        ("ini", "--dialect sinumerik", "--dialect sinumeric"),
        "error",
        "'sinumeric'",
        "man framepath",
    ),
    case(
        ("ini", "mpf = framepath", "mpf = nowhere/framepath"),
        "error",
        "nowhere/framepath is not found",
        "make install",
    ),
    case(
        ("ini", "ngc=code_trans", "ngc=code_rot"),
        "warning",
        "belongs to G77.2",
        "G77.2",
    ),
    case(
        ("ini", "CLEAR_AT_START = 1", "CLEAR_AT_START = yes"),
        "error",
        "frame_guard does not start",
        "0 or 1",
    ),
    case(
        (
            "ini",
            "PARAMETER_FILE = framepath-sim.var",
            "PARAMETER_FILE = nowhere/framepath-sim.var",
        ),
        "warning",
        "is not there",
        "mkdir",
    ),
    case(
        (
            "hal",
            "addf framekins servo-thread",
            "addf framekins servo-thread\nsetp axis.z.eoffset-enable 1\nnet off axis.z.eoffset",
        ),
        "warning",
        "axis.z.eoffset is an external offset that framekins is not told of",
        "net off => framekins.external-offset.z",
    ),
    Case {
        sample: "framepath-xyzac",
        ..case(
            ("ini", "JOINTS = 5", "JOINTS = 10"),
            "error",
            "limits of joints are set, and there are 10 joints: with more than 9 blendtp refuses every move",
            "set none of blendtp.joint.*",
        )
    },
];

#[test]
fn each_is_found_and_answered() {
    let bench = Bench::new();
    for case in &CASES {
        let findings = bench.changed(case.sample, case.ending, case.from, case.to);
        let fits = |finding: &&Value| {
            finding["level"] == case.level
                && finding["found"]
                    .as_str()
                    .is_some_and(|text| text.contains(case.found))
                && finding["remedy"]
                    .to_string()
                    .replace("\\\"", "\"")
                    .contains(case.write)
        };
        let found = findings.iter().find(fits);
        assert!(
            found.is_some(),
            "{} -> {}: {findings:#?}",
            case.from,
            case.to
        );
    }
}

#[test]
fn the_place_is_that_of_the_word() {
    let bench = Bench::new();
    let findings = bench.changed(
        "framepath-sim",
        "hal",
        "framekins.value.3",
        "framekins.valu.3",
    );
    let text = bench.read("framepath-sim", "hal");
    let line = text
        .lines()
        .position(|line| line.contains("framekins.value.3"))
        .expect("there");
    let column = text
        .lines()
        .nth(line)
        .and_then(|line| line.find("framekins.value.3"))
        .expect("there");
    let found = findings
        .iter()
        .find(|finding| finding["found"].to_string().contains("valu.3"));
    let found = found.expect("a finding");
    assert_eq!(
        (found["line"].as_u64(), found["column"].as_u64()),
        (Some(line as u64 + 1), Some(column as u64 + 1))
    );
    assert_eq!(found["file"], "./framepath-sim.hal");
}

#[test]
fn what_was_not_read_may_see_to_it() {
    let bench = Bench::new();
    let name = "framepath-sim";
    let ini = bench.read(name, "ini").replace(
        "HALFILE = framepath-sim.hal",
        "HALFILE = framepath-sim.hal\nHALFILE = more.tcl",
    );
    bench.write(name, "ini", &ini);
    std::fs::write(bench.sample(name).join("more.tcl"), "exit\n").expect("written");
    let findings = bench.changed(name, "hal", "addf framekins servo-thread\n", "");
    let levels: Vec<&str> = findings
        .iter()
        .filter_map(|finding| finding["level"].as_str())
        .collect();
    assert_eq!(levels, ["warning", "note"], "{findings:#?}");
    assert!(
        findings[0]["found"]
            .to_string()
            .contains("unless more.tcl, which is not read here")
    );
    assert!(findings[1]["found"].to_string().contains("Tcl"));
}

#[test]
fn included_files_and_sourced_files_are_read() {
    let bench = Bench::new();
    let name = "framepath-sim";
    let (ini, hal) = (bench.read(name, "ini"), bench.read(name, "hal"));
    let (before, axes) = ini.split_once("[AXIS_X]").expect("there");
    bench.write(name, "ini", &format!("{before}#INCLUDE axes.inc\n"));
    std::fs::write(
        bench.sample(name).join("axes.inc"),
        format!("[AXIS_X]{axes}"),
    )
    .expect("written");
    bench.write(name, "hal", "source own.hal\n");
    std::fs::write(bench.sample(name).join("own.hal"), hal).expect("written");
    assert_eq!(bench.findings(name), Vec::<Value>::new());
}

#[test]
fn a_second_section_of_the_same_name_is_not_read() {
    let bench = Bench::new();
    let findings = bench.changed(
        "framepath-sim",
        "ini",
        "# The planner.\n",
        "[KINS]\n[TRAJ]\n",
    );
    let found = findings.iter().find(|finding| {
        finding["found"]
            .to_string()
            .contains("does not read this section")
    });
    assert!(found.is_some(), "{findings:#?}");
    assert!(
        findings
            .iter()
            .any(|finding| finding["remedy"]["lines"][0] == "TPMOD = blendtp"),
        "{findings:#?}"
    );
}
