//! What the outputs of all backends have in common: the first lines, the marks of subprograms, and
//! the remarks from which the line of the source is read.

use super::comment::{comment, message};
use super::line::Lines;
use super::words::path_control_words;
use super::{WriteSettings, file_name};
use crate::program::{Action, Block};

/// The lines before the first block: what the program is, what the operator should know, and the
/// modes in which the dialect begins.
pub fn header(lines: &mut Lines, settings: &WriteSettings, purpose: &str) {
    let source = file_name(&settings.sources.file(0).name);
    let dialect = settings.dialect;
    lines.raw(&comment(&format!(
        "{source}: {dialect} program, written by framepath filter {purpose}"
    )));
    for warning in settings.warnings {
        lines.raw(&message(warning));
    }
    let unit = if settings.machine_in_inch {
        "G20"
    } else {
        "G21"
    };
    // Without it LinuxCNC would cut corners by as much as its feed asks for.
    let path_mode = path_control_words(settings.path_mode);
    lines.raw(&format!("{unit} G17 G40 G80 G90 G91.1 G94 {path_mode}"));
}

/// Begins a block of the source. `false` for the mark of a subprogram, which is then written.
pub fn begin(lines: &mut Lines, block: &Block, settings: &WriteSettings) -> bool {
    let origin = block.origin;
    let mark = block.actions.iter().find_map(|action| match action {
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
            let caller = file_name(&settings.sources.file(origin.file).name);
            Some(format!("--- end of {name}, back in {caller} ---"))
        }
        _ => None,
    });
    if let Some(mark) = mark {
        lines.raw(&comment(&mark));
        return false;
    }
    let mut remark = format!("line {}", origin.line);
    // A frame command may leave nothing else behind.
    let is_frame = |action: &Action| matches!(action, Action::Frame(_));
    if !block.actions.is_empty() && block.actions.iter().all(is_frame) {
        let file = settings.sources.file(origin.span.file);
        let source = file
            .text
            .get(origin.span.start..origin.span.end)
            .unwrap_or("");
        remark.push_str(&format!(": {}", without_number(source)));
    }
    if let Some(text) = block.comment.as_ref().filter(|text| !text.is_empty()) {
        remark.push_str(&format!(": {text}"));
    }
    lines.begin_block(origin.number, Some(remark));
    true
}

fn without_number(block: &str) -> &str {
    match block.strip_prefix(['N', 'n']) {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => rest
            .trim_start_matches(|c: char| c.is_ascii_digit())
            .trim_start(),
        _ => block,
    }
}
