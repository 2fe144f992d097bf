//! The command line of the tool.

use clap::{Parser, Subcommand, ValueEnum};
use framepath_tool::compare::{self, CompareArguments};
use framepath_tool::dialects::Dialect;
use framepath_tool::dialects::settings::Settings;
use framepath_tool::filter::{FilterArguments, Told, contour, filter};
use framepath_tool::generate::{self, GenerateArguments};
use framepath_tool::plan::{self, PlanArguments};
use framepath_tool::program::trace::Setup;
use framepath_tool::report::{self, ReportArguments};
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
    /// Show what the planner will do with a program: time, limits, slow places
    Plan(PlanArguments),
    /// Drive planner modules with the same programs and compare what they do
    Compare(CompareArguments),
    /// Print a G-code program that shows what a planner does
    Generate(GenerateArguments),
    /// Drive a planner module in a process of its own
    #[command(hide = true)]
    CompareHost,
}

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Filter(arguments) => run_filter(&arguments),
        Command::Report(arguments) => finish(run_report(&arguments)),
        Command::Plan(arguments) => finish(plan::run(&arguments)),
        Command::Compare(arguments) => finish(compare::run(&arguments)),
        Command::Generate(arguments) => finish(generate::run(&arguments).map_err(Into::into)),
        Command::CompareHost => compare::serve_as_host(),
    }
}

fn finish(result: Result<(), Box<dyn std::error::Error>>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}", error.to_string().trim_end());
            ExitCode::FAILURE
        }
    }
}

fn run_filter(arguments: &FilterArguments) -> ExitCode {
    let mut tell = |told: Told| match told {
        Told::Progress(percent) => eprintln!("FILTER_PROGRESS={percent}"),
        Told::Note(note) => eprintln!("{note}"),
    };
    match filter(arguments, &mut tell) {
        Ok(translated) => match translated.write_to(&mut std::io::stdout().lock()) {
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
