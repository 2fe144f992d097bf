//! Frames on machines that LinuxCNC has samples of: what `configure` writes for each, and what `check` says of it.

use crate::bench::{Bench, framepath, samples};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// A sample and the files beside it, changed by (from, to) and configured with frames.
struct Configured {
    folder: tempfile::TempDir,
    name: String,
    output: Output,
}

fn configured(sample: &str, changes: &[(&str, &str)]) -> Configured {
    let source = Path::new(STOCK).join(sample);
    let folder = tempfile::tempdir().expect("a folder");
    for entry in fs::read_dir(source.parent().expect("a folder")).expect("a folder") {
        let file = entry.expect("an entry").path();
        if file.is_file() {
            let copy = folder.path().join(file.file_name().expect("a name"));
            fs::copy(&file, copy).expect("copied");
        }
    }
    let name = source.file_name().expect("a name").to_string_lossy();
    let mut text = fs::read_to_string(&source).expect("a text");
    for (from, to) in changes {
        assert!(text.contains(from), "{from} is not there");
        text = text.replacen(from, to, 1);
    }
    fs::write(folder.path().join(&*name), text).expect("written");
    let subroutines = samples().join("subroutines").display().to_string();
    let options = ["--frames", "--subroutines", &subroutines];
    let arguments = [&["configure", &*name], &options[..]].concat();
    let output = framepath(folder.path(), &arguments);
    Configured {
        name: name.into_owned(),
        output,
        folder,
    }
}

impl Configured {
    /// What is written anew.
    fn written(&self) -> String {
        let said = String::from_utf8_lossy(&self.output.stderr);
        assert!(self.output.status.success(), "{said}");
        String::from_utf8_lossy(&self.output.stdout).into_owned()
    }

    /// What is refused, with the lines to write.
    fn refused(&self) -> String {
        assert_eq!(self.output.status.code(), Some(1));
        let new = self
            .folder
            .path()
            .join(self.name.replace(".ini", "-framepath.ini"));
        assert!(!new.exists());
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }

    fn file(&self, ending: &str) -> PathBuf {
        let name = self.name.replace(".ini", ending);
        self.folder.path().join(name)
    }

    /// What `check` says of what was written.
    fn checked(&self) -> String {
        let ini = self.name.replace(".ini", "-framepath.ini");
        let output = framepath(self.folder.path(), &["check", &ini]);
        String::from_utf8_lossy(&output.stdout).into_owned()
    }
}

#[test]
fn a_hexapod_is_told_the_length_of_the_tool() {
    let hexapod = configured("vismach/hexapod-sim/hexapod.ini", &[]);
    let line = "loadrt framekins inner=genhexkins tool_types=0\n";
    let written = hexapod.written();
    assert!(written.contains(line), "{written}");
    let said = "genhexkins.tool-offset is linked, and framekins takes the tool of type 0";
    assert!(!hexapod.checked().contains(said), "{}", hexapod.checked());
    for (types, remedy) in [("", "write tool_types=0,"), (" tool_types=1", "0,1,")] {
        let changed = format!("loadrt framekins inner=genhexkins{types}\n");
        fs::write(hexapod.file("-framepath-first.hal"), changed).expect("written");
        let found = hexapod.checked();
        assert!(found.contains(said) && found.contains(remedy), "{found}");
    }
}

#[test]
fn joints_beside_those_of_the_axes_have_no_letter() {
    let sample = "extrajoints/1extrajoint.ini";
    let axes: String = ["X", "Y", "Z"]
        .map(|letter| format!("[AXIS_{letter}]\nMAX_ACCELERATION = 10\n"))
        .concat();
    let limits = ("[KINS]", &*format!("{axes}[KINS]"));
    let machine = configured(sample, &[limits]);
    let written = machine.written();
    let line = "+KINEMATICS = framekins coordinates=XYYZ\n";
    assert!(written.contains(line), "{written}");
    assert!(
        !machine.checked().contains("[KINS]JOINTS"),
        "{}",
        machine.checked()
    );
    let machine = configured(sample, &[limits, ("JOINTS = 5", "JOINTS = 6")]);
    let said = "[KINS]JOINTS is 6, 1 of them by num_extrajoints, and coordinates= names 4 joints";
    assert!(machine.refused().contains(said), "{}", machine.refused());
}

#[test]
fn the_ini_file_has_the_number_of_analog_outputs() {
    let few = ("EMCMOT = motmod", "EMCMOT = motmod num_dio=8 num_aio=4");
    let line = "EMCMOT = motmod num_dio=8 num_aio=16";
    let machine = configured("axis_mm.ini", &[few]);
    let written = machine.written();
    assert!(written.contains(&format!("+{line}\n")), "{written}");
    let ini = machine.file("-framepath.ini");
    let text = fs::read_to_string(&ini).expect("a text");
    fs::write(&ini, text.replace("num_aio=16", "num_aio=4")).expect("written");
    let found = machine.checked();
    assert!(
        found.contains(line) && !found.contains("core_sim.hal"),
        "{found}"
    );
    let bench = Bench::new();
    let hal = bench.read("framepath-sim", "hal");
    bench.write(
        "framepath-sim",
        "hal",
        &hal.replace("num_aio=16", "num_aio=[EMCMOT]NUM_AIO"),
    );
    let findings = bench.changed(
        "framepath-sim",
        "ini",
        "[EMCMOT]\n",
        "[EMCMOT]\nNUM_AIO = 4\n",
    );
    let fits = |finding: &serde_json::Value| finding["remedy"]["line"] == "NUM_AIO = 16";
    assert!(findings.iter().any(fits), "{findings:#?}");
}

#[test]
fn a_machine_that_is_never_homed_has_no_frames() {
    let unhomed = |value: u8| format!("[TRAJ]\nNO_FORCE_HOMING = {value}");
    let machine = configured("axis_mm.ini", &[("[TRAJ]", &unhomed(1))]);
    let said = machine.refused();
    for words in ["before it is homed", "NO_FORCE_HOMING = 0"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    configured("axis_mm.ini", &[("[TRAJ]", &unhomed(0))]).written();
    // joints that are no axes are homed first without frames, too
    let kinematics = (
        "KINEMATICS = trivkins",
        "KINEMATICS = trivkins kinstype=BOTH",
    );
    configured("axis_mm.ini", &[("[TRAJ]", &unhomed(1)), kinematics]).written();
    let bench = Bench::new();
    for (value, warned) in [(1, true), (0, false)] {
        let findings = bench.changed("framepath-sim", "ini", "[TRAJ]", &unhomed(value));
        let said = |finding: &serde_json::Value| {
            finding["level"] == "warning"
                && finding["found"].to_string().contains("NO_FORCE_HOMING")
        };
        assert_eq!(findings.iter().any(said), warned, "{findings:#?}");
    }
}

#[test]
fn frames_with_another_planner_are_warned_of() {
    let bench = Bench::new();
    let (name, warning) = ("framepath-sim", "tpmod does not see frames");
    let warned = |findings: &[Value]| -> Vec<Value> {
        let is_it = |finding: &&Value| finding["found"].to_string().contains(warning);
        findings.iter().filter(is_it).cloned().collect()
    };
    assert!(warned(&bench.findings(name)).is_empty());
    let hal: Vec<String> = bench
        .read(name, "hal")
        .lines()
        .filter(|line| !line.contains("blendtp") && !line.contains("operator.hal"))
        .map(str::to_owned)
        .collect();
    bench.write(name, "hal", &(hal.join("\n") + "\n"));
    let ini: Vec<String> = bench
        .read(name, "ini")
        .replace("TPMOD = blendtp", "TPMOD = tpmod")
        .lines()
        .filter(|line| !line.contains("operator.hal") && !line.contains("panel.hal"))
        .map(str::to_owned)
        .collect();
    bench.write(name, "ini", &(ini.join("\n") + "\n"));
    let found = warned(&bench.findings(name));
    assert_eq!(found.len(), 1, "{:#?}", bench.findings(name));
    assert_eq!(found[0]["level"], "warning");
    assert_eq!(found[0]["remedy"]["line"], "TPMOD = blendtp");
}

#[test]
fn axes_that_turn_the_tool_keep_within_their_limits() {
    let table = "vismach/5axis/table-rotary-tilting/xyzac-trt.ini";
    let (joint, axis) = ("[JOINT_3]MIN_LIMIT", "[AXIS_A]MIN_LIMIT");
    let narrow = (
        "MIN_LIMIT = -100\n       MAX_LIMIT =   50",
        "MIN_LIMIT = -90\nMAX_LIMIT = 50",
    );
    for (sample, changes, tilt, rotary) in [
        (table, vec![], joint, "[JOINT_4]MIN_LIMIT"),
        (table, vec![narrow], axis, "[JOINT_4]MIN_LIMIT"),
        // joints by coordinates=
        (
            "vismach/5axis/bridgemill/5axis.ini",
            vec![],
            joint,
            "[JOINT_4]MIN_LIMIT",
        ),
        (
            "vismach/5axis/bridgemill/5axis.ini",
            vec![("=xyzbcwy", "=xyzwcby")],
            "[JOINT_5]MIN_LIMIT",
            "[JOINT_4]MIN_LIMIT",
        ),
        // B carries A: seen from the workpiece B carries the tool
        (
            "vismach/5axis/table-dual-rotary/xyzab-tdr.ini",
            vec![],
            "[JOINT_4]MIN_LIMIT",
            joint,
        ),
    ] {
        let machine = configured(sample, &changes);
        let written = machine.written();
        for (name, value) in [("tilt", tilt), ("rotary", rotary)] {
            for end in ["MIN", "MAX"] {
                let line = format!("setp framekins.{name}-{} ", end.to_ascii_lowercase());
                assert!(written.contains(&line), "{line}: {written}");
            }
            let line = format!("setp framekins.{name}-min {value}\n");
            assert!(written.contains(&line), "{line}: {written}");
        }
        assert!(!machine.checked().contains("knows no limit"));
        let file = machine.file("-framepath.hal");
        let hal = fs::read_to_string(&file).expect("a text");
        let line = format!("setp framekins.tilt-min {tilt}\n");
        fs::write(&file, hal.replacen(&line, "", 1)).expect("written");
        let said = machine.checked();
        let found = "warning: nothing sets framekins.tilt-min: o<tool_normal> knows no limit";
        assert!(
            said.contains(found) && said.contains(line.trim_end()),
            "{said}"
        );
    }
}

#[test]
fn an_arm_has_the_limits_of_the_axes_that_its_user_names() {
    let machine = configured("vismach/puma/puma560.ini", &[]);
    assert!(!machine.written().contains("tilt-min"));
    let file = machine.file("-framepath-first.hal");
    let first = fs::read_to_string(&file).expect("a text");
    let said = first.replacen("inner=genserkins", "inner=genserkins tool_axes=C,B", 1);
    fs::write(&file, said).expect("written");
    let said = machine.checked();
    for line in ["tilt-max [AXIS_B]MAX_LIMIT", "rotary-min [AXIS_C]MIN_LIMIT"] {
        assert!(said.contains(line), "{line}: {said}");
    }
}
