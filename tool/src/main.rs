//! The command line of the tool.

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use framepath_tool::check::{self, CheckArguments};
#[cfg(feature = "linuxcnc")]
use framepath_tool::compare::{self, CompareArguments};
use framepath_tool::completions::{self, CompletionsArguments};
use framepath_tool::configure::{self, ConfigureArguments};
use framepath_tool::filter::{FilterArguments, Told, filter};
use framepath_tool::generate::{self, GenerateArguments};
use framepath_tool::output::tell;
#[cfg(feature = "linuxcnc")]
use framepath_tool::plan::{self, PlanArguments};
use framepath_tool::record::{self, RecordArguments};
use framepath_tool::report::{self, ReportArguments};
use std::fmt::Display;
use std::io::{ErrorKind, Write};
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
    /// Record what a running LinuxCNC does, for report
    Record(RecordArguments),
    /// Show what the planner did with a program, from a recording
    Report(ReportArguments),
    /// Show what the planner will do with a program: time, limits, slow places
    #[cfg(feature = "linuxcnc")]
    Plan(PlanArguments),
    /// Not in this build: it needs LinuxCNC
    #[cfg(not(feature = "linuxcnc"))]
    #[command(disable_help_flag = true)]
    Plan(NotBuilt),
    /// Drive planner modules with the same programs and compare what they do
    #[cfg(feature = "linuxcnc")]
    Compare(CompareArguments),
    /// Not in this build: it needs LinuxCNC
    #[cfg(not(feature = "linuxcnc"))]
    #[command(disable_help_flag = true)]
    Compare(NotBuilt),
    /// Look at the INI and HAL files of a machine: what is missing, contradictory or unwise
    Check(CheckArguments),
    /// Write a configuration with blendtp, and with framekins, beside one that LinuxCNC runs
    Configure(ConfigureArguments),
    /// Print a G-code program that shows what a planner does
    Generate(GenerateArguments),
    /// Print what bash, zsh or fish need to complete commands and options
    Completions(CompletionsArguments),
    /// Drive a planner module in a process of its own
    #[cfg(feature = "linuxcnc")]
    #[command(hide = true)]
    CompareHost,
}

/// Whatever follows the name of a command that this build does not have.
#[cfg(not(feature = "linuxcnc"))]
#[derive(Debug, clap::Args)]
struct NotBuilt {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    arguments: Vec<std::ffi::OsString>,
}

#[cfg(not(feature = "linuxcnc"))]
impl NotBuilt {
    fn refuse(&self, command: &str) -> ExitCode {
        let asked: Vec<_> = self
            .arguments
            .iter()
            .map(|text| text.display().to_string())
            .collect();
        tell(format_args!(
            "framepath {command}: this framepath was built without LinuxCNC, whose interpreter runs the program\n\
             help: apt-get install linuxcnc-uspace linuxcnc-uspace-dev libclang-dev g++, build with \
             `cargo install --locked --path tool`, then run: framepath {command} {}",
            asked.join(" ")
        ));
        ExitCode::FAILURE
    }
}

/// The command line. A number below 0 behind an option is its value, and refused as such.
fn command_line() -> clap::Command {
    let commands = Arguments::command();
    let names: Vec<String> = commands
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    names.into_iter().fold(commands, |commands, name| {
        commands.mut_subcommand(name, |command| {
            command.mut_args(|argument| {
                let takes_value = argument.get_action().takes_values();
                let is_option = argument.get_long().is_some() && takes_value;
                match is_option {
                    true => argument.allow_negative_numbers(true),
                    false => argument,
                }
            })
        })
    })
}

/// Help, version, or what is wrong with the arguments. Whoever closes the pipe of a help has read enough of it.
fn answer(told: &clap::Error) -> ExitCode {
    let written = told.print().and_then(|()| std::io::stdout().flush());
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) if !told.use_stderr() => {
            finish(Err(format!("standard output: cannot be written: {error}")))
        }
        _ => ExitCode::from(u8::try_from(told.exit_code()).unwrap_or(1)),
    }
}

fn main() -> ExitCode {
    let matches = command_line().try_get_matches();
    match matches.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => run(arguments.command),
        Err(told) => answer(&told),
    }
}

fn run(command: Command) -> ExitCode {
    match command {
        Command::Filter(arguments) => run_filter(&arguments),
        Command::Record(arguments) => finish(record::run(&arguments)),
        Command::Report(arguments) => finish(report::run(&arguments)),
        #[cfg(feature = "linuxcnc")]
        Command::Plan(arguments) => finish(plan::run(&arguments)),
        #[cfg(feature = "linuxcnc")]
        Command::Compare(arguments) => finish(compare::run(&arguments)),
        #[cfg(not(feature = "linuxcnc"))]
        Command::Plan(asked) => asked.refuse("plan"),
        #[cfg(not(feature = "linuxcnc"))]
        Command::Compare(asked) => asked.refuse("compare"),
        Command::Check(arguments) => run_check(&arguments),
        Command::Configure(arguments) => finish(configure::run(&arguments)),
        Command::Generate(arguments) => finish(generate::run(&arguments)),
        Command::Completions(arguments) => {
            let done = completions::run(arguments, &Arguments::command());
            finish(done.map_err(|error| format!("standard output: cannot be written: {error}")))
        }
        #[cfg(feature = "linuxcnc")]
        Command::CompareHost => compare::serve_as_host(),
    }
}

fn finish<E: Display>(result: Result<(), E>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(error.to_string().trim_end());
            ExitCode::FAILURE
        }
    }
}

fn run_check(arguments: &CheckArguments) -> ExitCode {
    match check::run(arguments, &refusal_of_filter) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => finish(Err(error)),
    }
}

/// What `framepath filter` says to these arguments: the line behind "error: ".
fn refusal_of_filter(words: &[String]) -> Result<(), String> {
    /// As if it were a program of its own.
    #[derive(Debug, Parser)]
    struct Alone {
        #[command(flatten)]
        arguments: FilterArguments,
    }
    let error = match Alone::try_parse_from(words) {
        Ok(alone) => return alone.arguments.contradiction(),
        Err(error) => error,
    };
    let text = error.to_string();
    let line = text.lines().next().unwrap_or("");
    Err(line.trim_start_matches("error: ").to_owned())
}

fn run_filter(arguments: &FilterArguments) -> ExitCode {
    let mut say = |told: Told| match told {
        Told::Progress(percent) => tell(format_args!("FILTER_PROGRESS={percent}")),
        Told::Note(note) => tell(note),
    };
    match filter(arguments, &mut say) {
        Ok(translated) => match translated.write_to(&mut std::io::stdout().lock()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                tell(format_args!(
                    "error: the program cannot be written: {error}"
                ));
                ExitCode::FAILURE
            }
        },
        Err(refused) => {
            tell(refused.0.trim_end_matches('\n'));
            ExitCode::FAILURE
        }
    }
}

/// The manual page has each command and each option, and no other.
#[cfg(all(test, feature = "linuxcnc"))]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const PAGE: &str = include_str!("../framepath.1");

    /// A section of the page, without what roff puts between its words.
    fn section(title: &str) -> String {
        let plain = PAGE.replace("\\-", "-");
        let mut sections = plain.split("\n.SH ");
        let found = sections.find(|text| text.starts_with(&format!("{title}\n")));
        found
            .unwrap_or_else(|| panic!("no section {title}"))
            .to_owned()
    }

    /// The options that a text names.
    fn named(text: &str) -> BTreeSet<String> {
        let ends = |c: char| !c.is_ascii_lowercase() && c != '-' && !c.is_ascii_digit();
        let names = text.split("--").skip(1).map(|rest| rest.split(ends).next());
        let names = names.flatten().filter(|name| !name.is_empty());
        names
            .map(|name| name.trim_end_matches('-').to_owned())
            .collect()
    }

    /// Those that a text explains: they stand in the line behind .TP.
    fn explained(text: &str) -> BTreeSet<String> {
        let behind = text.split(".TP\n").skip(1);
        let heads = behind.filter_map(|part| part.lines().next());
        heads.flat_map(named).collect()
    }

    fn options(command: &clap::Command) -> BTreeSet<String> {
        let shown = command
            .get_arguments()
            .filter(|option| !option.is_hide_set());
        shown
            .filter_map(clap::Arg::get_long)
            .map(str::to_owned)
            .collect()
    }

    fn commands() -> Vec<clap::Command> {
        let all = Arguments::command();
        let shown = all
            .get_subcommands()
            .filter(|command| !command.is_hide_set());
        shown.cloned().collect()
    }

    #[test]
    fn each_option_is_explained_where_its_command_is() {
        let mut count = 0;
        for command in commands() {
            let name = command.get_name().to_uppercase();
            let explained = explained(&section(&format!("FRAMEPATH {name}")));
            assert_eq!(
                explained,
                options(&command),
                "framepath {}",
                command.get_name()
            );
            count += explained.len();
        }
        assert!(count > 80, "{count} options");
    }

    #[test]
    fn each_option_that_is_named_is_there() {
        let of_commands = commands();
        let of_commands = of_commands.iter().flat_map(options);
        let known: BTreeSet<String> = of_commands
            .chain(["help", "version"].map(str::to_owned))
            .collect();
        let unknown: Vec<String> = named(&PAGE.replace("\\-", "-"))
            .difference(&known)
            .cloned()
            .collect();
        assert!(unknown.is_empty(), "{unknown:?}");
    }

    #[test]
    fn each_command_has_examples_and_an_exit_status() {
        let synopsis = section("SYNOPSIS").replace("\n.RB", "");
        for command in commands() {
            let name = format!("framepath {}", command.get_name());
            assert!(synopsis.contains(&name), "{name} in SYNOPSIS");
            let examples = section("EXAMPLES");
            assert!(
                examples.lines().any(|line| line.starts_with(&name)),
                "{name} in EXAMPLES"
            );
            let status = section("EXIT STATUS");
            assert!(
                status.contains(&format!(".B {name}\n")),
                "{name} in EXIT STATUS"
            );
        }
    }
}
