//! `framepath configure`: a configuration with blendtp, and with framekins, beside one that LinuxCNC runs.
//!
//! [`planner`] and [`frames`] say which lines are needed; [`edits`] has them until all is known, and
//! puts them into the text of the INI file. What is not understood is refused before anything is written.

mod edits;
mod error;
mod frames;
mod included;
mod inner;
mod planner;
mod subroutines;
mod twopass;
mod unread;

pub use error::{ConfigureError, Refusal};

use crate::hal::read_script;
use crate::machine::above_joints::AboveJoint;
use crate::machine::ini::Ini;
use crate::machine::jerk::Jerk;
use crate::output::{OutputFile, overwrites};
use crate::wiring::own_files;
use crate::wiring::subject::Subject;
use edits::{Edits, Written};
use similar::TextDiff;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Arguments of `framepath configure`.
#[derive(Clone, Debug, clap::Args)]
pub struct ConfigureArguments {
    /// INI file of the machine as it is
    #[arg(value_name = "MACHINE.ini")]
    pub ini: PathBuf,
    /// With framekins as well: programmable frames
    #[arg(long)]
    pub frames: bool,
    /// Jerk limits of axes that have none: `unlimited`, a number (machine units per second cubed), or a number of
    /// accelerations per second
    #[arg(long, value_name = "JERK", default_value = "20A")]
    pub jerk: Jerk,
    /// Folder of the subroutines for frames
    #[arg(long, value_name = "DIR", default_value_t = own_files::subroutines(), requires = "frames")]
    pub subroutines: String,
    /// Replace files that are there already
    #[arg(long)]
    pub force: bool,
}

/// Writes `NAME-framepath.ini` and `NAME-framepath.hal` beside the INI file (and `NAME-framepath-first.hal`, where framekins comes
/// before kinematics that stay), and what they change to standard output as a unified diff.
///
/// # Errors
/// What cannot be configured, with the line that is in its way; files that are there already or cannot be
/// written. Then nothing is changed.
pub fn run(arguments: &ConfigureArguments) -> Result<(), ConfigureError> {
    let text = edits::original(&arguments.ini)?;
    let (ini, problems) = Ini::parse_all(&arguments.ini, &text);
    let script = read_script(&ini, &[]);
    let subject = Subject::new(ini, problems, script);
    let [ini_file, hal_file, first_file] =
        [".ini", ".hal", "-first.hal"].map(|ending| beside(&arguments.ini, ending));
    let edited =
        |subject: &Subject, text: &str| edited(subject, text, arguments, &[&first_file, &hal_file]);
    let written = match edited(&subject, &text) {
        Err(ConfigureError::Included) => {
            let whole = included::put_in(&subject)?;
            edited(&whole, subject.ini.expanded().unwrap_or_default())?
        }
        written => written?,
    };
    let mut files = vec![(&ini_file, &written.ini), (&hal_file, &written.hal)];
    files.extend(written.first_hal.as_ref().map(|text| (&first_file, text)));
    let there = files.iter().find(|(file, _)| file.exists());
    if let Some((file, _)) = there.filter(|_| !arguments.force) {
        return Err(ConfigureError::Exists(file.to_path_buf()));
    }
    let included = subject.ini.entries().iter().map(|entry| &*entry.place.file);
    let script = subject.script.files.iter().map(PathBuf::as_path);
    let read: Vec<&Path> = [arguments.ini.as_path()]
        .into_iter()
        .chain(included)
        .chain(script)
        .collect();
    if let Some(file) = overwrites(files.iter().map(|(file, _)| file.as_path()), &read) {
        return Err(ConfigureError::Overwritten(file.to_owned()));
    }
    let begun: Result<Vec<OutputFile>, ConfigureError> =
        files.iter().map(|(file, text)| begun(file, text)).collect();
    let begun = begun?;
    let new = files.iter().skip(1);
    crate::machine::warn_of(&above_joints(&subject));
    crate::machine::warn_of(&written.warnings);
    let difference = difference(&arguments.ini, &text, &ini_file, &written.ini)
        + &new
            .map(|(file, text)| difference(Path::new("/dev/null"), "", file, text))
            .collect::<String>();
    let mut output = io::stdout().lock();
    let told = output.write_all(difference.as_bytes());
    told.and_then(|()| output.flush())
        .map_err(ConfigureError::Told)?;
    // Last of all: nothing is changed where the changes cannot be told.
    for file in begun {
        let name = file.name().to_owned();
        let finished = file.finish();
        finished.map_err(|source| ConfigureError::Write { file: name, source })?;
    }
    Ok(())
}

/// What is to be written, with the HAL files before and behind the others.
fn edited(
    subject: &Subject,
    text: &str,
    arguments: &ConfigureArguments,
    [first, last]: &[&Path; 2],
) -> Result<Written, ConfigureError> {
    let mut edits = Edits::new(&subject.ini, text);
    planner::write(subject, arguments, &mut edits);
    if arguments.frames {
        frames::write(subject, arguments, &mut edits);
    }
    edits.name_first_hal(&name_of(first));
    edits.add_last("HAL", "HALFILE", &name_of(last));
    edits.finish()
}

/// Limits of axes above those of their joints, which the new configuration has as well: `check` says the same of it.
fn above_joints(subject: &Subject) -> Vec<String> {
    let joints = subject.joints.iter().enumerate();
    let axes = joints.filter(|(_, letter)| subject.axes.contains(letter));
    axes.flat_map(|(joint, letter)| AboveJoint::of(&subject.ini, *letter, joint))
        .map(|above| above.warning(&subject.ini))
        .collect()
}

fn name_of(file: &Path) -> String {
    file.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

/// `NAME-framepathENDING` beside `NAME.ini`.
fn beside(ini: &Path, ending: &str) -> PathBuf {
    let stem = ini.file_stem().unwrap_or_default().to_string_lossy();
    ini.with_file_name(format!("{stem}-framepath{ending}"))
}

fn begun(file: &Path, text: &str) -> Result<OutputFile, ConfigureError> {
    let unwritable = |source| ConfigureError::Write {
        file: file.to_owned(),
        source,
    };
    let mut output = OutputFile::create(file).map_err(unwritable)?;
    output.write_all(text.as_bytes()).map_err(unwritable)?;
    Ok(output)
}

fn difference(old_file: &Path, old: &str, new_file: &Path, new: &str) -> String {
    let difference = TextDiff::from_lines(old, new);
    let [old_file, new_file] = [old_file, new_file].map(|file| file.display().to_string());
    difference
        .unified_diff()
        .context_radius(1)
        .header(&old_file, &new_file)
        .to_string()
}
