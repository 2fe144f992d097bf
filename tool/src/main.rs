//! The command line of the tool.

use clap::{Parser, Subcommand, ValueEnum};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::filter::{FilterArguments, contour, filter};
use framepath_tool::program::trace::Setup;
use framepath_tool::report::{self, ReportArguments};
use std::io::Write;
use std::process::ExitCode;

/// Frames and smooth motion for LinuxCNC.
#[derive(Debug, Parser)]
#[command(name = "framepath", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Translate a part program of another control to LinuxCNC G-code on standard output
    Filter(FilterArguments),
    /// Show what the planner did with a program, from a recording
    Report(ReportArguments),
}

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Filter(arguments) => run_filter(&arguments),
        Command::Report(arguments) => match run_report(&arguments) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("{}", error.to_string().trim_end());
                ExitCode::FAILURE
            }
        },
    }
}

fn run_filter(arguments: &FilterArguments) -> ExitCode {
    let mut progress = |percent: u32| eprintln!("FILTER_PROGRESS={percent}");
    match filter(arguments, &mut progress) {
        Ok(text) => match std::io::stdout().lock().write_all(text.as_bytes()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("error: the program cannot be written: {error}");
                ExitCode::FAILURE
            }
        },
        Err(refused) => {
            eprint!("{}", refused.0);
            ExitCode::FAILURE
        }
    }
}

/// With a dialect, the recording is compared with the path of the program in that dialect. Where the
/// work offsets are is not in the recording: the path is that without any.
fn run_report(arguments: &ReportArguments) -> Result<(), Box<dyn std::error::Error>> {
    let dialect = arguments.dialect.as_deref();
    let dialect = dialect.and_then(|name| Dialect::from_str(name, true).ok());
    match (dialect, &arguments.program) {
        (Some(dialect), Some(program)) => {
            let moves = contour(dialect, program, &Settings::default(), &Setup::default())?;
            Ok(report::run_along(arguments, &moves)?)
        }
        _ => Ok(report::run(arguments)?),
    }
}
