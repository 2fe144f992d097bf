//! What the outputs of all backends have in common: the first lines, the marks of subprograms, and
//! the remarks from which the line of the source is read.

use super::comment::{comment, message};
use super::line::{Lines, Rank};
use super::number::coordinate;
use super::words::path_control_words;
use super::{Backend, WriteSettings, file_name};
use crate::program::{Action, Block};
use crate::source::Sources;

/// Keeps whether X was a diameter (G7): the program takes it as a radius, M2 and M30 leave it so, and what is
/// entered or runs next counts on what the startup code of a lathe says. In a global parameter, for
/// o<on_abort> reads it where the program does not come to its end.
const DIAMETERS_BEFORE: &str = "#<_frame_diameters> = #<_lathe_diameter_mode>";

/// G7 where [`DIAMETERS_BEFORE`] is 1, else G8.
const DIAMETERS_AGAIN: &str = "G[8-#<_frame_diameters>] #<_frame_diameters> = 0";

/// The lines before the first block: what the program is, what the operator should know, and the
/// modes in which the dialect begins.
pub fn header(
    backend: Backend,
    settings: &WriteSettings,
    sources: &Sources,
    warnings: &[String],
) -> String {
    let source = file_name(&sources.file(0).name);
    let dialect = settings.dialect;
    let purpose = match backend {
        Backend::Kinematics => "for the frame kinematics",
        Backend::Program => "with frames worked into its coordinates",
    };
    let unit = if settings.machine_in_inch {
        "G20"
    } else {
        "G21"
    };
    // Without it LinuxCNC would cut corners by as much as its feed asks for.
    let path_mode = path_control_words(settings.path_mode);
    let first = comment(&format!(
        "{source}: {dialect} program, written by framepath filter {purpose}"
    ));
    let messages = warnings.iter().map(|warning| message(warning));
    let tolerance = comment(&format!(
        "corners that the program rounds without a tolerance of its own: P{}, option --tolerance",
        coordinate(settings.tolerance)
    ));
    let before = settings
        .diameters_before
        .then(|| DIAMETERS_BEFORE.to_string());
    // Whatever X is in the source, it is written as a radius.
    let modes = format!("{unit} G8 G17 G40 G80 G90 G91.1 G94 {path_mode}");
    let lines = [first, tolerance]
        .into_iter()
        .chain(messages)
        .chain(before)
        .chain([modes]);
    lines.map(|line| line + "\n").collect()
}

/// Begins a block of the source. `false` for the mark of a subprogram, which is then written.
pub fn begin(lines: &mut Lines, block: &Block, sources: &Sources) -> bool {
    if let Some(mark) = block
        .actions
        .iter()
        .find_map(|action| mark(action, block, sources))
    {
        lines.raw(&comment(&mark));
        return false;
    }
    let origin = block.origin;
    let frame = block.frame_text.as_deref().map(without_number);
    let comment = block.comment.as_deref().filter(|text| !text.is_empty());
    let mut remark = String::new();
    for text in [frame, comment].into_iter().flatten() {
        remark.push_str(": ");
        remark.push_str(text);
    }
    lines.begin_block(origin.number, origin.line, &remark);
    true
}

/// The end of the program, in the mode of X that was there before it.
pub fn end(lines: &mut Lines, rewind: bool, diameters_before: bool) {
    if diameters_before {
        lines.flush();
        lines.line(DIAMETERS_AGAIN);
    }
    lines.add(Rank::Stop, if rewind { "M30" } else { "M2" });
}

/// What is said where a subprogram begins or ends.
fn mark(action: &Action, block: &Block, sources: &Sources) -> Option<String> {
    match action {
        Action::Enter {
            name,
            file,
            pass,
            passes,
        } => {
            let pass = match passes {
                1 => String::new(),
                _ => format!(", pass {pass} of {passes}"),
            };
            Some(format!("--- {name} in {}{pass} ---", file_name(file)))
        }
        Action::Leave { name } => {
            let caller = file_name(&sources.file(block.origin.file).name);
            Some(format!("--- end of {name}, back in {caller} ---"))
        }
        _ => None,
    }
}

fn without_number(block: &str) -> &str {
    match block.strip_prefix(['N', 'n']) {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => rest
            .trim_start_matches(|c: char| c.is_ascii_digit())
            .trim_start(),
        _ => block,
    }
}
