//! `framepath configure`: from configurations of LinuxCNC to such with blendtp and framekins, which `check` finds clean.

use crate::bench::{Bench, framepath, samples};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

const STOCK: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim/axis";

/// A folder with LinuxCNC's axis_mm.
fn stock() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["axis_mm.ini", "sim_mm.tbl", "cooling.hal"] {
        let file = Path::new(STOCK).join(name);
        // LinuxCNC 2.9.0 has no such HAL file, and names none
        if name != "cooling.hal" || file.exists() {
            fs::copy(file, folder.path().join(name)).expect("copied");
        }
    }
    folder
}

fn subroutines() -> String {
    samples().join("subroutines").display().to_string()
}

/// Configures axis_mm with frames, over what is there.
fn again_with_frames(folder: &Path) -> Output {
    let options = ["--frames", "--force", "--subroutines", &subroutines()];
    framepath(
        folder,
        &[&["configure", "axis_mm.ini"], &options[..]].concat(),
    )
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("a text")
}

/// What a difference writes anew, without what is around it: that depends on LinuxCNC's version.
fn written(difference: &str) -> String {
    let lines = difference.lines();
    let written = lines.filter(|line| line.starts_with(['+', '-']));
    written.map(|line| format!("{line}\n")).collect()
}

/// Configures axis_mm with a change of its INI file.
fn changed(from: &str, to: &str, options: &[&str]) -> (tempfile::TempDir, Output) {
    let folder = stock();
    let file = folder.path().join("axis_mm.ini");
    let before = fs::read_to_string(&file).expect("a text");
    let after = before.replacen(from, to, 1);
    assert!(from.is_empty() || before != after, "{from} is not there");
    fs::write(&file, after).expect("written");
    let mut arguments = vec!["configure", "axis_mm.ini"];
    arguments.extend_from_slice(options);
    let output = framepath(folder.path(), &arguments);
    (folder, output)
}

/// What `check` finds in axis_mm-framepath.
fn findings(folder: &Path) -> Value {
    let output = framepath(folder, &["check", "axis_mm-framepath.ini", "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report["findings"].clone()
}

#[test]
fn a_stock_configuration_needs_eight_lines_for_blendtp() {
    let (folder, output) = changed("", "", &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).ends_with("MAX_JERK\n"));
    let lines = written(&text(&output.stdout));
    insta::assert_snapshot!("blendtp_in_axis_mm_is_eight_lines", lines);
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
    let old = fs::read(Path::new(STOCK).join("axis_mm.ini")).expect("read");
    assert_eq!(
        fs::read(folder.path().join("axis_mm.ini")).expect("read"),
        old
    );
}

#[test]
fn frames_need_no_other_change_by_hand() {
    let (folder, output) = changed("", "", &["--frames", "--subroutines", &subroutines()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
    let ini = fs::read_to_string(folder.path().join("axis_mm-framepath.ini")).expect("a text");
    for line in [
        "KINEMATICS = framekins coordinates=XYZ",
        "EMCMOT = motmod num_aio=16",
        "ANALOG_OUTPUT = 0",
        &format!(
            "USER_COMMAND_FILE = {}",
            samples().join("preview/frame_axis.py").display()
        ),
    ] {
        assert!(ini.lines().any(|known| known == line), "{line} in {ini}");
    }
}

#[test]
fn signals_and_outputs_that_are_taken_are_kept() {
    let folder = stock();
    let file = folder.path().join("axis_mm.ini");
    let ini = fs::read_to_string(&file).expect("a text");
    let ini = ini.replace(
        "HALFILE = simulated_home.hal",
        "HALFILE = simulated_home.hal\nHALFILE = own.hal",
    );
    fs::write(
        &file,
        ini.replace("EMCMOT = motmod", "EMCMOT = motmod num_dio=8"),
    )
    .expect("written");
    let own = "net laser motion.analog-out-03\nnet stands motion.in-position\nsetp axis.y.eoffset-enable TRUE\n";
    fs::write(folder.path().join("own.hal"), own).expect("written");
    let output = framepath(
        folder.path(),
        &[
            "configure",
            "axis_mm.ini",
            "--frames",
            "--subroutines",
            &subroutines(),
        ],
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
    let written = text(&output.stdout);
    for line in [
        "+net stands => framekins.in-position\n",
        "+net frame-command motion.analog-out-04 => framekins.command\n",
        "+net external-offset-y axis.y.eoffset => framekins.external-offset.y\n",
        "+ANALOG_OUTPUT = 4\n",
        "+EMCMOT = motmod num_dio=8 num_aio=16\n",
    ] {
        assert!(written.contains(line), "{line} in {written}");
    }
}

/// The sample of a linear delta, with kinematics and HAL commands changed: the folder, and what configure says.
fn delta(kinematics: &str, commands: &str) -> (tempfile::TempDir, Output) {
    let folder = tempfile::tempdir().expect("a folder");
    let ini = fs::read_to_string(Path::new(STOCK).join("ldelta.ini")).expect("a text");
    let changed = ini
        .replacen("KINEMATICS = lineardeltakins", kinematics, 1)
        .replacen("HALUI = halui", commands, 1);
    fs::write(folder.path().join("axis_mm.ini"), changed).expect("written");
    fs::copy(
        Path::new(STOCK).join("sim.tbl"),
        folder.path().join("sim.tbl"),
    )
    .expect("copied");
    let arguments = [
        "configure",
        "axis_mm.ini",
        "--frames",
        "--subroutines",
        &subroutines(),
    ];
    let output = framepath(folder.path(), &arguments);
    (folder, output)
}

#[test]
fn framekins_comes_before_kinematics_that_stay() {
    let (folder, output) = delta("KINEMATICS = lineardeltakins", "HALUI = halui");
    let written = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    // of the sample itself its velocities are said
    let found = findings(folder.path()).to_string();
    assert!(
        !found.contains("kins") && !found.contains(".hal"),
        "{found}"
    );
    for lines in [
        "+HALFILE = axis_mm-framepath-first.hal\n HALFILE = sim_ldelta.hal\n",
        "+loadrt framekins inner=lineardeltakins\n",
        "+net frame-switch framekins.switchkins-type => motion.switchkins-type\n",
        "+ANALOG_OUTPUT = 0\n",
    ] {
        assert!(written.contains(lines), "{lines} in {written}");
    }
    assert!(!written.contains("KINEMATICS ="), "{written}");
    let first = fs::read_to_string(folder.path().join("axis_mm-framepath-first.hal"));
    assert!(first.expect("a text").ends_with("inner=lineardeltakins\n"));
}

#[test]
fn what_chooses_a_type_of_the_kinematics_goes_to_framekins() {
    let table = "KINEMATICS = xyzac-trt-kins sparm=identityfirst";
    let tool = "HALCMD = net tool motion.tooloffset.z => xyzac-trt-kins.tool-offset";
    let select = "net select motion.analog-out-03 => motion.switchkins-type";
    let (folder, output) = delta(table, &format!("{tool}\nHALCMD = {select}"));
    let written = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for lines in [
        "+loadrt framekins inner=xyzac-trt-kins tool_types=1\n",
        "+HALCMD = net select motion.analog-out-03 => framekins.inner-type\n",
        "+net frame-command motion.analog-out-04 => framekins.command\n",
        "+net tool => framekins.tool-offset.z\n",
    ] {
        assert!(written.contains(lines), "{lines} in {written}");
    }
    let found = findings(folder.path()).to_string();
    assert!(!found.contains("framekins"), "{found}");
    assert!(!written.contains("TYPE_OUTPUT"), "{written}");
    // G43.4 is told of another output
    let (folder, output) = delta(
        table,
        &format!("{tool}\nHALCMD = {}", select.replace("03", "05")),
    );
    let other = text(&output.stdout);
    assert!(other.contains("+TYPE_OUTPUT = 5\n"), "{other}");
    let found = findings(folder.path()).to_string();
    assert!(!found.contains("framekins"), "{found}");
    let (folder, _) = delta(table, &format!("{tool}\nHALCMD = {select}"));
    // in a HAL file of the user's, which stays as it is
    fs::write(folder.path().join("own.hal"), format!("{select}\n")).expect("written");
    let ini = fs::read_to_string(folder.path().join("axis_mm.ini")).expect("a text");
    let ini = ini.replacen(&format!("HALCMD = {select}"), "HALFILE = own.hal", 1);
    fs::write(folder.path().join("axis_mm.ini"), ini).expect("written");
    let output = again_with_frames(folder.path());
    let written = text(&output.stdout);
    let lines = "+unlinkp motion.switchkins-type\n+net select => framekins.inner-type\n";
    assert!(written.contains(lines), "{written}{}", text(&output.stderr));
}

/// A sample of LinuxCNC's whose only HAL file is in Tcl, configured with frames: the folder, and what configure says.
fn tcl(name: &str) -> (tempfile::TempDir, Output) {
    let folder = tempfile::tempdir().expect("a folder");
    let ini = fs::read_to_string(Path::new(STOCK).join(name)).expect("a text");
    fs::write(folder.path().join("axis_mm.ini"), ini).expect("written");
    for beside in ["lathe.tbl", "lathe_postgui.hal", "sim.tbl"] {
        fs::copy(Path::new(STOCK).join(beside), folder.path().join(beside)).expect("copied");
    }
    let arguments = [
        "configure",
        "axis_mm.ini",
        "--frames",
        "--subroutines",
        &subroutines(),
    ];
    let output = framepath(folder.path(), &arguments);
    (folder, output)
}

#[test]
fn hal_files_of_linuxcncs_in_tcl_are_followed() {
    let (folder, output) = tcl("lathe.ini");
    let written = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for lines in [
        "+KINEMATICS = framekins coordinates=XZ\n",
        "+EMCMOT = motmod num_aio=16\n",
        "+net sample:enable => framekins.enabled\n",
        "+net motion-in-position motion.in-position => framekins.in-position\n",
    ] {
        assert!(written.contains(lines), "{lines} in {written}");
    }
    let found = findings(folder.path()).to_string();
    assert!(
        !found.contains("framekins") && !found.contains("Tcl"),
        "{found}"
    );
}

#[test]
fn a_pendant_that_asks_for_trivkins_keeps_them() {
    let pendant = "HALFILE = LIB:xhc-hb04.tcl\nHALUI = halui";
    let options = ["--frames", "--subroutines", &subroutines()];
    let (folder, output) = changed("HALUI = halui", pendant, &options);
    let written = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        written.contains("+loadrt framekins inner=trivkins\n"),
        "{written}"
    );
    assert!(!written.contains("+KINEMATICS"), "{written}");
    assert_eq!(findings(folder.path()), Value::Array(Vec::new()));
}

#[test]
fn a_users_own_file_in_tcl_stays_where_it_names_nothing_of_motion() {
    let folder = stock();
    let file = folder.path().join("axis_mm.ini");
    let ini = fs::read_to_string(&file).expect("a text");
    let named = "HALFILE = simulated_home.hal\nHALFILE = own.tcl";
    fs::write(&file, ini.replace("HALFILE = simulated_home.hal", named)).expect("written");
    let own = folder.path().join("own.tcl");
    let run = |text: &str| {
        fs::write(&own, text).expect("written");
        again_with_frames(folder.path())
    };
    let output = run("# what motion.enable waits for\nloadrt or2\naddf or2.0 servo-thread\n");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let output = run("set pin motion.enable\nnet ready $pin\n");
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    let line = 1 + ini
        .replace("HALFILE = simulated_home.hal", named)
        .lines()
        .position(|line| line == "HALFILE = own.tcl")
        .expect("there");
    let refusal = format!(
        "axis_mm.ini:{line}:1: error: own.tcl: it is written in Tcl, and line 1 of own.tcl names motion.\n  help: "
    );
    assert!(said.contains(&refusal), "{said}");
    assert!(said.contains("halcmd save all"), "{said}");
}

#[test]
fn other_screens_get_files_of_their_own_and_a_file_of_the_users_stays() {
    let options = ["--frames", "--subroutines", &subroutines()];
    for (screen, file) in [
        ("gmoccapy", "frame_gmoccapy.py"),
        ("qtvcp qtdragon", "frame_qtvcp.py"),
    ] {
        let to = format!("DISPLAY = {screen}");
        let (_, output) = changed("DISPLAY = axis", &to, &options);
        let written = text(&output.stdout);
        let file = samples().join("preview").join(file);
        let line = format!("+USER_COMMAND_FILE = {}\n", file.display());
        assert!(written.contains(&line), "{line} in {written}");
    }
    for to in [
        "DISPLAY = tklinuxcnc",
        "DISPLAY = axis\nUSER_COMMAND_FILE = own.py",
    ] {
        let (_, output) = changed("DISPLAY = axis", to, &options);
        let written = text(&output.stdout);
        assert!(written.contains("framekins"), "{written}");
        assert!(!written.contains("+USER_COMMAND_FILE"), "{written}");
    }
}

#[test]
fn machines_in_inches_and_other_limits_of_jerk() {
    for inch in ["inch", ".03937"] {
        let units = format!("LINEAR_UNITS = {inch}");
        let (folder, output) = changed("LINEAR_UNITS = mm", &units, &["--jerk", "50000"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let written = text(&output.stdout);
        assert!(written.contains("+MAX_JERK = 50000\n"), "{written}");
        for line in ["millimetre 0.0393700787", "default-tolerance 0.0008"] {
            assert!(
                written.contains(&format!("+setp blendtp.{line}\n")),
                "{inch}: {written}"
            );
        }
        assert_eq!(findings(folder.path()), Value::Array(Vec::new()), "{inch}");
    }
}

#[test]
fn files_that_are_there_are_replaced_by_force_only() {
    let (folder, _) = changed("", "", &[]);
    let file = folder.path().join("axis_mm-framepath.hal");
    fs::write(&file, "# mine\n").expect("written");
    let output = framepath(folder.path(), &["configure", "axis_mm.ini"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        text(&output.stderr),
        "axis_mm-framepath.ini: error: this file is there already\n  help: --force replaces it\n"
    );
    assert_eq!(fs::read_to_string(&file).expect("a text"), "# mine\n");
    assert!(
        framepath(folder.path(), &["configure", "axis_mm.ini", "--force"])
            .status
            .success()
    );
    assert!(
        fs::read_to_string(&file)
            .expect("a text")
            .contains("setp blendtp")
    );
}

/// A change of axis_mm, options, and the line that refuses it.
/// From, to, options, and what is said: LINE is that of the first line of what was written, another one in each LinuxCNC.
const REFUSED: [(&str, &str, &[&str], &str); 8] = [
    (
        "KINEMATICS = trivkins",
        "KINEMATICS =",
        &["--frames"],
        "axis_mm.ini:LINE:1: error: [KINS]KINEMATICS names no module",
    ),
    (
        "KINEMATICS = trivkins",
        "KINEMATICS = trivkins colour=red",
        &["--frames"],
        "axis_mm.ini:LINE:1: error: framekins does not know `colour=red`",
    ),
    (
        "PARAMETER_FILE = sim_mm.var",
        "REMAP = G77 modalgroup=1 ngc=own",
        &["--frames"],
        "axis_mm.ini:71:1: error: G77 is remapped already",
    ),
    (
        "LINEAR_UNITS = mm",
        "LINEAR_UNITS = mm # c",
        &[],
        "axis_mm.ini:LINE:1: error: LinuxCNC reads the comment as a part of the value: [TRAJ]",
    ),
    (
        "HALUI = halui",
        "HALCMD = net own motion.feed-inhibit",
        &["--frames"],
        "axis_mm.ini:LINE:1: error: motion.feed-inhibit is linked to own already",
    ),
    (
        "HALFILE = core_sim.hal",
        "HALFILE = nowhere.hal",
        &[],
        "axis_mm.ini:LINE:1: error: the HAL file nowhere.hal is not there",
    ),
    (
        "POSITION_FILE",
        "TPMOD = blendtp\nPOSITION_FILE",
        &[],
        "axis_mm.ini:LINE:1: error: this configuration has blendtp already",
    ),
    (
        "VERSION = 1.1",
        "VERSION = 1.0",
        &[],
        "axis_mm.ini:9:1: error: the file is for another LinuxCNC",
    ),
];

#[test]
fn what_cannot_be_configured_is_refused_by_name() {
    for (from, to, options, refusal) in REFUSED {
        let (folder, output) = changed(from, to, options);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{to}");
        let ini = fs::read_to_string(folder.path().join("axis_mm.ini")).expect("a text");
        let written = to.lines().next().expect("a line");
        let line = ini.lines().position(|line| line.starts_with(written));
        let line = line.expect("it was written") + 1;
        let refusal = refusal.replace("LINE", &line.to_string());
        assert!(
            said.contains(&refusal) && said.contains("\n  help: "),
            "{to}: {said}"
        );
        assert!(output.stdout.is_empty());
        assert!(!folder.path().join("axis_mm-framepath.ini").exists());
    }
}

#[test]
fn lines_keep_their_ends_and_a_sample_of_ours_is_refused() {
    let folder = stock();
    let file = folder.path().join("axis_mm.ini");
    let ini = fs::read_to_string(&file)
        .expect("a text")
        .replace('\n', "\r\n");
    fs::write(&file, &ini).expect("written");
    let output = framepath(folder.path(), &["configure", "axis_mm.ini"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let new = fs::read_to_string(folder.path().join("axis_mm-framepath.ini")).expect("a text");
    let kept: Vec<&str> = new
        .split('\n')
        .filter(|line| line.ends_with('\r'))
        .collect();
    assert_eq!(kept.join("\n") + "\n", ini);

    let bench = Bench::new();
    let output = framepath(
        &bench.sample("framepath-sim"),
        &["configure", "framepath-sim.ini", "--frames"],
    );
    assert!(text(&output.stderr).contains("has framekins already"));
}
