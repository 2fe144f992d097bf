//! What HAL files set pins and signals to.

use crate::bench::Bench;
use serde_json::Value;

/// The findings of framepath-sim with these lines at the end of its HAL file.
fn found(lines: &str) -> Vec<Value> {
    let bench = Bench::new();
    let hal = bench.read("framepath-sim", "hal");
    bench.write("framepath-sim", "hal", &format!("{hal}\n{lines}\n"));
    bench.findings("framepath-sim")
}

#[test]
fn what_halcmd_does_not_take_is_an_error() {
    for (line, words, remedy) in [
        (
            "setp motion.probe-input yes",
            "`setp motion.probe-input yes`: halcmd takes yes for no value",
            "TRUE or FALSE",
        ),
        (
            "axis.z.eoffset-scale = 0,1",
            "takes 0,1 for no value",
            "decimal point",
        ),
        ("sets estop-loop on", "takes on for no value", "1, 0"),
        (
            "setp blendtp.axis.x.max-jerk \"20000\"",
            "takes \"20000\" for no value",
            "decimal point",
        ),
        (
            "setp blendtp.axis.x.max-jerk \\\r\n20000\r",
            "takes \\ for no value",
            "decimal point",
        ),
        (
            "setp\u{a0}blendtp.axis.x.max-jerk 20000",
            "is no command of halcmd",
            "correct or remove",
        ),
        (
            "setp spindle.0.at-speed 1.0",
            "spindle.0.at-speed is a bit, and halcmd refuses 1.0",
            "setp spindle.0.at-speed 1",
        ),
        (
            "setp framekins.mirror.a 2",
            "framekins.mirror.a is a bit",
            "setp framekins.mirror.a 1",
        ),
        (
            "setp motion.digital-in-00 0.0",
            "motion.digital-in-00 is a bit",
            "setp motion.digital-in-00 0",
        ),
        (
            "setp axis.z.eoffset-enable -1",
            "axis.z.eoffset-enable is a bit",
            "setp axis.z.eoffset-enable 1",
        ),
    ] {
        let found = found(line);
        let said = |finding: &&Value| {
            let text = finding["found"].as_str().expect("a text");
            let remedy_is = finding["remedy"].to_string().contains(remedy);
            finding["level"] == "error" && text.contains(words) && remedy_is
        };
        assert_eq!(found.iter().filter(said).count(), 1, "{line}: {found:#?}");
    }
}

#[test]
fn what_halcmd_takes_is_none() {
    let before = found("");
    let taken = "setp spindle.0.at-speed true\nsetp motion.probe-input 0\nsetp axis.z.eoffset-scale 1e-3\n\
                 sets estop-loop FALSE\nsetp joint.0.jog-scale 0x10\nsetp mux2.0.sel 2";
    assert_eq!(found(taken), before);
}

/// A limit of jerk that a signal gives its pins is one as if it were set itself.
#[test]
fn a_limit_of_jerk_may_come_by_a_signal() {
    let bench = Bench::new();
    let hal = bench.read("framepath-sim", "hal");
    let own = "setp blendtp.axis.x.max-jerk [AXIS_X]MAX_JERK\n";
    assert!(hal.contains(own), "{hal}");
    let net = "net jerk blendtp.axis.x.max-jerk\n";
    for (lines, words) in [
        (
            format!("{net}sets jerk 100\n"),
            "blendtp.axis.x.max-jerk is 100, and blendtp refuses every move",
        ),
        (
            net.replace("jerk ", "jerk near.out => "),
            "how far X runs on is not known",
        ),
    ] {
        bench.write("framepath-sim", "hal", &hal.replace(own, &lines));
        assert_said_once(&bench.findings("framepath-sim"), words);
    }
}

fn assert_said_once(findings: &[Value], words: &str) {
    let said = |finding: &&Value| {
        finding["found"]
            .as_str()
            .is_some_and(|found| found.contains(words))
    };
    assert_eq!(findings.iter().filter(said).count(), 1, "{findings:#?}");
}
