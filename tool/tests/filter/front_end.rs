//! Everything that the filter does with a program, in this process: for tests with any text.

use framepath_tool::diagnostics::Diagnostics;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::dialects::{Dialect, evaluate};
use framepath_tool::encoding::decode;
use framepath_tool::program::trace::{Setup, contour};
use framepath_tool::source::Sources;
use framepath_tool::write::{Backend, WriteSettings, write};
use std::path::Path;

/// Programs of the tests that run more blocks never end.
const MOST_BLOCKS: usize = 5_000;

/// From the bytes to both outputs, the contour and the rendered messages.
pub fn run_all(dialect: Dialect, bytes: &[u8]) {
    let settings = Settings {
        most_blocks: MOST_BLOCKS,
        ..Settings::default()
    };
    run_with(&settings, dialect, bytes);
}

/// The same with other settings.
pub fn run_with(settings: &Settings, dialect: Dialect, bytes: &[u8]) {
    let mut sources = Sources::default();
    let mut diagnostics = Diagnostics::default();
    sources.add("part.nc".to_string(), decode(bytes));
    // The path lies nowhere: no subprogram file can be found.
    let path = Path::new("/nonexistent/part.nc");
    let program = evaluate(dialect, path, settings, &mut sources, &mut diagnostics);
    let shown = diagnostics.render(&sources);
    assert_eq!(shown.is_empty(), diagnostics.iter().next().is_none());
    if diagnostics.errors() > 0 {
        return;
    }
    let write_settings = WriteSettings {
        dialect: dialect.name(),
        machine_in_inch: false,
        path_mode: settings.path_mode,
        chord_tolerance: 0.01,
        arc_tolerance: &settings.arc_tolerance,
    };
    for backend in [Backend::Kinematics, Backend::Program] {
        let (text, _) = write(backend, &program, &write_settings, &sources, &[]).expect("memory");
        assert!(text.lines().all(|line| line.len() < 255));
        assert!(!text.contains("NaN") && !text.contains("inf"));
    }
    let _ = contour(&program, &Setup::default(), &settings.arc_tolerance);
}
