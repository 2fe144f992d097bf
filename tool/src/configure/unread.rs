//! HAL files that were not read, before frames are wired: those in Tcl that name nothing of what frames need may stay.

use super::edits::Edits;
use crate::hal::Unread;
use crate::machine::text_file;
use crate::wiring::subject::Subject;
use std::path::Path;

/// Names without which a file in Tcl loads no kinematics and no motmod, and links none of motion's pins; the module of
/// `[KINS]KINEMATICS` comes to them. By the last two it would run what is not looked at.
const NAMES: [&str; 9] = [
    "motion.",
    "motmod",
    "EMCMOT",
    "KINS",
    "framekins",
    "blendtp",
    "TWOPASS",
    "source",
    "halcmd",
];

/// Of LinuxCNC's library: procedures only.
const PROCEDURES: [&str; 3] = ["hal_procs_lib.tcl", "util_lib.tcl", "sim_lib.tcl"];

/// What a user writes instead.
const HELP: &str = "frames need to know what it loads and links: write it as a HAL file (halcmd save all machine.hal writes \
                    what is there while LinuxCNC runs, but for loadusr), or do without --frames";

/// Refuses each file that may load or link what frames need.
pub fn refuse(subject: &Subject, edits: &mut Edits) {
    for unread in &subject.script.unread {
        if let Some(reason) = in_the_way(subject, unread) {
            edits.refuse(&unread.place, format!("{}: {reason}", unread.name), HELP);
        }
    }
}

fn in_the_way(subject: &Subject, unread: &Unread) -> Option<String> {
    let Some(file) = &unread.tcl else {
        return Some(unread.reason.clone());
    };
    let text = match text_file::read(file) {
        Ok(text) => text,
        Err(error) => return Some(format!("it cannot be read: {error}")),
    };
    let (line, name) = first_name(&text, subject.kinematics())?;
    let file = file.file_name().unwrap_or(file.as_os_str());
    Some(format!(
        "it is written in Tcl, and line {line} of {} names {name}",
        Path::new(file).display()
    ))
}

/// The first line, from 1, with one of the names.
fn first_name<'a>(text: &str, kinematics: &'a str) -> Option<(usize, &'a str)> {
    let names = || {
        let module = Some(kinematics).filter(|module| !module.is_empty());
        NAMES.into_iter().chain(module)
    };
    let lines = text.lines().map(str::trim).enumerate();
    let mut code = lines.filter(|(_, line)| !line.starts_with('#'));
    code.find_map(|(index, line)| {
        let of_library = PROCEDURES.iter().any(|file| line.contains(file));
        let mut found = names().filter(|name| line.contains(name));
        let name = found.find(|name| *name != "source" || !of_library)?;
        Some((index + 1, name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_frames_need_are_found_in_code() {
        for (text, found) in [
            ("setp mux.0.in1 5 ;# nothing\n", None),
            ("# motion.enable\nsetp a 1", None),
            ("source [file join $::env(HALLIB_DIR) util_lib.tcl]", None),
            ("set a 1\nnet x motion.enable", Some((2, "motion."))),
            ("net x $pins\n  source other.tcl", Some((2, "source"))),
            ("eval loadrt $::KINS(KINEMATICS)", Some((1, "KINS"))),
            ("loadrt corexykins", Some((1, "corexykins"))),
        ] {
            assert_eq!(first_name(text, "corexykins"), found, "{text}");
        }
    }
}
