//! HAL files of LinuxCNC's library that are written in Tcl: what they do, told as lines of a HAL file. Nothing is run.
//!
//! Others in Tcl are not read: only Tcl itself could say what they do.

use super::State;
use super::basic_sim;
use super::variables::HALLIB;
use crate::machine::ini::Ini;
use std::path::Path;

/// A HAL file of LinuxCNC's in Tcl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stock {
    /// A whole machine that is simulated.
    BasicSim,
    /// An offset between motion and the joints, as for a retract in a pause.
    Moveoff,
    /// Pins for a wheel that jogs.
    WheelJog,
    /// A pendant. It asks for trivkins by name, which it takes the joints from that it jogs.
    Pendant,
}

impl Stock {
    /// The one in this file; a copy of it elsewhere may be another one.
    pub fn in_file(path: &Path) -> Option<Stock> {
        let name = path.strip_prefix(HALLIB).ok()?.to_str()?;
        match name {
            "basic_sim.tcl" => Some(Stock::BasicSim),
            "hookup_moveoff.tcl" => Some(Stock::Moveoff),
            "wheeljogpins.tcl" => Some(Stock::WheelJog),
            "xhc-hb04.tcl" => Some(Stock::Pendant),
            _ => None,
        }
    }

    /// Keys without which it ends the start: section and name.
    pub fn keys(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Stock::BasicSim => &basic_sim::KEYS,
            _ => &[],
        }
    }

    /// What it does, as lines of a HAL file. `options` are those behind its name in the INI file, `before` is what is there
    /// when it runs.
    pub fn lines(self, ini: &Ini, options: &[&str], before: &State) -> String {
        match self {
            Stock::BasicSim => basic_sim::lines(ini, options),
            Stock::Moveoff => moveoff(ini, before),
            // Values of pins of axes and joints alone, as far as these are there.
            Stock::WheelJog => String::new(),
            Stock::Pendant => pendant(ini, before),
        }
    }
}

/// Its functions come directly before and behind motion's, and it is linked between motion and each joint with a `TYPE`. What
/// was linked to these is linked to it, which is not told here.
fn moveoff(ini: &Ini, before: &State) -> String {
    let joints: Vec<usize> = (0..9)
        .filter(|joint| ini.text(&format!("JOINT_{joint}"), "TYPE").is_some())
        .collect();
    let count = joints.last().map_or(0, |last| last + 1);
    let motion = |name: &str| before.functions.iter().find(|added| added.function == name);
    let thread = motion("motion-controller").map_or("servo-thread", |added| &added.thread);
    let position = |name: &str| {
        let mut of_thread = before
            .functions
            .iter()
            .filter(|added| added.thread == thread);
        of_thread.position(|added| added.function == name)
    };
    let write = position("motion-controller").map_or(1, |index| index + 2);
    let read = position("motion-command-handler").map_or(1, |index| index.max(1));
    let mut text = format!(
        "loadrt moveoff personality={count} names=mv\naddf mv.write-outputs {thread} {write}\naddf mv.read-inputs {thread} {read}\n"
    );
    for joint in joints {
        text += &format!(
            "unlinkp joint.{joint}.motor-pos-cmd\nunlinkp joint.{joint}.motor-pos-fb\n\
             net hu:pos-{joint} joint.{joint}.motor-pos-cmd => mv.pos-{joint}\n\
             net hu:minus-{joint} mv.fb-minusoffset-{joint} => joint.{joint}.motor-pos-fb\n"
        );
    }
    text
}

/// Its module, and the pins that its buttons are for; it goes on without those that it cannot link. What it links to halui
/// and to the pins for jogging is not told here.
fn pendant(ini: &Ini, before: &State) -> String {
    let thread = ini.text("XHC_HB04_CONFIG", "threadname");
    let mut text = format!(
        "loadusr -W xhc-hb04\nloadrt xhc_hb04_util names=pendant_util\naddf pendant_util {}\n",
        thread.unwrap_or("servo-thread")
    );
    let mut taken: Vec<&str> = Vec::new();
    let buttons = ini.entries().iter();
    for entry in buttons.filter(|entry| entry.is_read && entry.section == "XHC_HB04_BUTTONS") {
        let pin = entry.value.split_whitespace().next().unwrap_or("");
        // `""`, `std_start_pause` and `caution` are no pins.
        if is_pin(pin) && !taken.contains(&pin) && before.signal_of(pin).is_none() {
            taken.push(pin);
            let button = &entry.key;
            text += &format!("net pendant:{button} xhc-hb04.button-{button} => {pin}\n");
        }
    }
    text
}

fn is_pin(word: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "._-:".contains(c);
    word.contains('.') && word.chars().all(is_part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hal::{Script, read_script};
    use std::fs;
    use std::path::PathBuf;
    use std::process::Command;

    const SAMPLES: &str = "/usr/share/doc/linuxcnc/examples/sample-configs/sim";

    /// Runs the library's file by Tcl itself, for one INI file after another, with commands of HAL that print what they
    /// were told.
    const RECORDER: &str = r#"
        set recorder {
            package require Linuxcnc
            foreach command {loadrt loadusr addf net unlinkp delsig} {
                proc $command args "puts \"hal: $command \[join \$args\]\""
            }
            proc setp {pin value} {
                puts "hal: setp $pin $value"
                set ::values($pin) $value
            }
            proc getp pin {
                return [expr {[info exists ::values($pin)] ? $::values($pin) : 1}]
            }
            proc hal {save what file} {
                set saved [open $file w]
                puts $saved nothing
                close $saved
            }
            set ::env(INI_FILE_NAME) $ini
            set ::env(HALLIB_DIR) $library
            parse_ini $ini
            source [file join $library basic_sim.tcl]
        }
        foreach {ini options} [lrange $argv 1 end] {
            puts "ini: $ini"
            set machine [interp create]
            $machine eval [list set library [lindex $argv 0]]
            $machine eval [list set ini $ini]
            $machine eval [list set argv $options]
            $machine eval $recorder
            interp delete $machine
        }
    "#;

    /// What the library's file does for each INI file, with options behind its name.
    fn by_tcl(folder: &Path, machines: &[(&Path, &str)]) -> Vec<Vec<String>> {
        let recorder = folder.join("recorder.tcl");
        fs::write(&recorder, RECORDER).expect("written");
        let mut tcl = Command::new("tclsh");
        tcl.current_dir(folder).arg(&recorder).arg(HALLIB);
        for (ini, options) in machines {
            tcl.arg(ini).arg(options);
        }
        let output = tcl.output().expect("Tcl, which LinuxCNC needs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let commands = |part: &str| {
            let lines = part.lines().filter_map(|line| line.strip_prefix("hal: "));
            lines.map(str::to_owned).collect()
        };
        text.split("ini: ").skip(1).map(commands).collect()
    }

    fn told(script: &Script) -> Vec<String> {
        let words = |statement: &crate::hal::Statement| {
            let words = statement.words.iter().map(|word| word.text.as_str());
            words.collect::<Vec<_>>().join(" ")
        };
        script.statements.iter().map(words).collect()
    }

    /// The script of an INI file, which is written to a folder.
    fn script(folder: &Path, text: &str) -> (PathBuf, Script) {
        let file = folder.join("m.ini");
        fs::write(&file, text).expect("written");
        let (ini, _) = Ini::parse_all(&file, text);
        let script = read_script(&ini, &[]);
        (file, script)
    }

    fn machine(changes: &[(&str, &str)], options: &str) -> String {
        let mut text = format!(
            "[HAL]\nHALFILE = LIB:basic_sim.tcl {options}\n[KINS]\nKINEMATICS = trivkins\nJOINTS = 3\n\
             [TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\n[EMCMOT]\nEMCMOT = motmod\nSERVO_PERIOD = 1000000\n\
             [JOINT_0]\nTYPE = LINEAR\n[JOINT_1]\nTYPE = LINEAR\n[JOINT_2]\nTYPE = LINEAR\n"
        );
        for (from, to) in changes {
            assert!(text.contains(from), "{from}");
            text = text.replacen(from, to, 1);
        }
        text
    }

    #[test]
    fn basic_sim_does_what_tcl_does() {
        let gantry = [
            ("trivkins", "trivkins coordinates=xyyz kinstype=both"),
            ("X Y Z", "xyyz"),
            ("JOINTS = 3", "JOINTS = 4"),
            (
                "EMCMOT = motmod",
                "EMCMOT = motmod num_dio=8 num_aio=16\nBASE_PERIOD = 50000",
            ),
        ];
        let homing = [
            ("LINEAR_UNITS = mm", "LINEAR_UNITS = inch"),
            (
                "[JOINT_1]\nTYPE = LINEAR",
                "[JOINT_1]\nTYPE = ANGULAR\nHOME_SEARCH_VEL = -5",
            ),
            (
                "[JOINT_2]\nTYPE = LINEAR",
                "[JOINT_2]\nTYPE = LINEAR\nHOME_SEARCH_VEL = -5\nHOME_USE_INDEX = YES",
            ),
        ];
        let metric = [(
            "[JOINT_0]\nTYPE = LINEAR",
            "[JOINT_0]\nTYPE = LINEAR\nHOME_SEARCH_VEL = -5",
        )];
        let frames = [("trivkins", "framekins coordinates=XYZ")];
        let all = "-no_make_ddts -NO_simulated_home -no_use_hal_manualtoolchange -no_sim_spindle";
        for (changes, options) in [
            (&[][..], ""),
            (&gantry, "-no_sim_spindle"),
            (&homing, "-no_use_hal_manualtoolchange"),
            (&metric, "-no_make_ddts"),
            (&frames, "-no_simulated_home"),
            (&[], all),
        ] {
            let folder = tempfile::tempdir().expect("a folder");
            let (file, script) = script(folder.path(), &machine(changes, options));
            let tcl = &by_tcl(folder.path(), &[(&file, options)])[0];
            assert!(tcl.len() > 40, "{tcl:?}");
            assert_eq!(&told(&script), tcl, "{changes:?} {options:?}");
            assert_eq!((script.problems, script.unread), (Vec::new(), Vec::new()));
        }
    }

    fn configurations(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() && !path.is_symlink() {
                configurations(&path, found);
            } else if path.extension().is_some_and(|ending| ending == "ini") {
                found.push(path);
            }
        }
    }

    #[test]
    fn basic_sim_of_linuxcncs_samples_does_what_tcl_does() {
        let mut files = Vec::new();
        configurations(Path::new(SAMPLES), &mut files);
        let mut machines = Vec::new();
        for file in files {
            let text = String::from_utf8_lossy(&fs::read(&file).expect("read")).into_owned();
            let line = text.lines().find(|line| line.contains("basic_sim.tcl"));
            // Tcl reads no included files: LinuxCNC hands it one in which they are included already.
            let (Some(line), false) = (line, text.contains("#INCLUDE")) else {
                continue;
            };
            let (_, named) = line.split_once(".tcl").expect("its name");
            let (ini, _) = Ini::parse_all(&file, &text);
            machines.push((file, named.to_owned(), told(&read_script(&ini, &[]))));
        }
        assert!(machines.len() > 30, "{} samples", machines.len());
        let folder = tempfile::tempdir().expect("a folder");
        let named: Vec<(&Path, &str)> = machines
            .iter()
            .map(|(file, options, _)| (file.as_path(), options.as_str()))
            .collect();
        let all = by_tcl(folder.path(), &named);
        assert_eq!(all.len(), machines.len());
        for ((file, _, commands), tcl) in machines.iter().zip(all) {
            assert_eq!(commands[..tcl.len()], tcl, "{}", file.display());
        }
    }

    #[test]
    fn what_ends_the_start_is_said_at_the_line_that_names_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let text = machine(&[("SERVO_PERIOD", "OTHER")], "");
        let (_, script) = script(folder.path(), &text);
        assert_eq!(script.problems.len(), 1);
        let problem = &script.problems[0];
        assert_eq!((problem.place.line, problem.place.column), (2, 1));
        assert_eq!(
            problem.found,
            "LIB:basic_sim.tcl needs [EMCMOT]SERVO_PERIOD"
        );
    }

    #[test]
    fn moveoff_stands_between_motion_and_the_joints() {
        let folder = tempfile::tempdir().expect("a folder");
        let text = machine(&[("-no\n", "\nHALFILE = hookup_moveoff.tcl\n")], "-no");
        let (_, script) = script(folder.path(), &text);
        let state = State::run(&script.statements);
        let functions: Vec<&str> = state
            .functions
            .iter()
            .map(|added| added.function.as_str())
            .collect();
        assert_eq!(
            functions[..4],
            [
                "mv.read-inputs",
                "motion-command-handler",
                "motion-controller",
                "mv.write-outputs"
            ]
        );
        assert_eq!(state.signal_of("joint.2.motor-pos-fb"), Some("hu:minus-2"));
        assert_eq!((state.problems, script.unread), (Vec::new(), Vec::new()));
        assert_eq!(script.stock, [Stock::BasicSim, Stock::Moveoff]);
    }

    #[test]
    fn buttons_of_a_pendant_are_linked_where_nothing_else_is() {
        let folder = tempfile::tempdir().expect("a folder");
        let own = "net held motion.feed-hold\n";
        fs::write(folder.path().join("own.hal"), own).expect("written");
        let buttons = "[XHC_HB04_BUTTONS]\nstop = halui.program.stop\nreset = motion.feed-hold\nrewind = \"\"\n\
                       start-pause = std_start_pause\nmacro-1 = motion.feed-inhibit\nmacro-2 = motion.feed-inhibit\n";
        let text = format!("[HAL]\nHALFILE = own.hal\nHALFILE = LIB:xhc-hb04.tcl\n{buttons}");
        let (_, script) = script(folder.path(), &text);
        let state = State::run(&script.statements);
        assert_eq!(
            state.signal_of("motion.feed-inhibit"),
            Some("pendant:macro-1")
        );
        assert_eq!(state.signal_of("motion.feed-hold"), Some("held"));
        assert!(state.module("xhc_hb04_util").is_some());
        assert_eq!(state.problems, Vec::new());
    }

    #[test]
    fn a_copy_is_not_taken_for_the_librarys() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("basic_sim.tcl"), "exit\n").expect("written");
        let (_, script) = script(folder.path(), "[HAL]\nHALFILE = basic_sim.tcl\n");
        assert_eq!(script.unread[0].name, "basic_sim.tcl");
        assert!(script.statements.is_empty());
    }
}
