//! Everything that the filter does with a program, in this process: for tests with any text.

use framepath_tool::diagnostics::{Diagnostic, Diagnostics};
use framepath_tool::dialects::settings::Settings;
use framepath_tool::dialects::{Dialect, evaluate};
use framepath_tool::encoding::{Encoding, Pieces, decode};
use framepath_tool::program::Program;
use framepath_tool::program::trace::{Setup, contour};
use framepath_tool::source::Sources;
use framepath_tool::write::{Backend, WriteSettings, write};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;

/// Programs of the tests that run more blocks never end.
const MOST_BLOCKS: usize = 5_000;

/// Longer texts are many pages of one line.
const LONGEST_IN_PIECES: usize = 4_000;

/// From the bytes to both outputs, the contour and the rendered messages.
pub fn run_all(dialect: Dialect, bytes: &[u8]) {
    let settings = Settings {
        most_blocks: MOST_BLOCKS,
        ..Settings::default()
    };
    run_with(&settings, dialect, bytes);
}

/// What is said about which place. That a place is not known is left unsaid behind another error, and which of them is
/// found first depends on the pieces.
fn places(diagnostics: &Diagnostics) -> BTreeSet<(usize, usize, String)> {
    let place = |one: &Diagnostic| (one.span.start, one.span.end, one.message.clone());
    let sure = |one: &&Diagnostic| !one.message.contains("not known ahead of time");
    diagnostics.iter().filter(sure).map(place).collect()
}

/// The same of a file of which some pages are held, each a line long or little more.
fn in_pieces(settings: &Settings, dialect: Dialect, text: &str) -> (Program, Diagnostics) {
    let mut file = tempfile::tempfile().expect("a temporary file");
    file.write_all(text.as_bytes()).expect("room for the text");
    let pieces = Pieces::new(file, Encoding::Utf8, 1 + text.len() % 40);
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    sources.add_windowed("part.nc".to_string(), pieces);
    let path = Path::new("/nonexistent/part.nc");
    let program = evaluate(dialect, path, settings, &mut sources, &mut diagnostics);
    diagnostics.render(&sources);
    (program, diagnostics)
}

/// The same with other settings.
pub fn run_with(settings: &Settings, dialect: Dialect, bytes: &[u8]) {
    let text = decode(bytes);
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    sources.add("part.nc".to_string(), text.clone());
    // The path lies nowhere: no subprogram file can be found.
    let path = Path::new("/nonexistent/part.nc");
    let program = evaluate(dialect, path, settings, &mut sources, &mut diagnostics);
    let shown = diagnostics.render(&sources);
    assert_eq!(shown.is_empty(), diagnostics.iter().next().is_none());
    // A file may begin with a byte order mark, which is none of its text.
    if text.len() <= LONGEST_IN_PIECES && !text.starts_with('\u{feff}') {
        let (in_pieces, said) = in_pieces(settings, dialect, &text);
        // With so many errors the rest is not looked for.
        assert!(
            said.is_full() || places(&said) == places(&diagnostics),
            "{said:?} {diagnostics:?}"
        );
        // What was made of a program before an error is of no use.
        assert!(said.errors() > 0 || in_pieces == program, "{in_pieces:?}");
    }
    if diagnostics.errors() > 0 {
        return;
    }
    let write_settings = WriteSettings {
        dialect: dialect.name(),
        machine_in_inch: false,
        diameters_before: true,
        path_mode: settings.path_mode,
        tolerance: settings.tolerance,
        chord_tolerance: 0.01,
        arc_tolerance: &settings.arc_tolerance,
    };
    for backend in [Backend::Kinematics, Backend::Program] {
        let (text, _) = write(backend, &program, &write_settings, &sources, &[]).expect("memory");
        assert!(text.lines().all(|line| line.len() < 255));
        let code = |line: &str| line.split('(').next().map(str::to_string);
        // A comment may say so: it has the line of the program.
        let no_number = |line: String| line.contains("NaN") || line.contains("inf");
        assert!(!text.lines().filter_map(code).any(no_number));
        let bare = |line: String| line.contains("G64") && !line.contains("G64 P");
        let mut code = text.lines().filter_map(code);
        assert!(!code.any(bare), "LinuxCNC would round as it likes");
    }
    let _ = contour(&program, &Setup::default(), &settings.arc_tolerance);
}
