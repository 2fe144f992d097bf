//! `framepath completions`: what a shell needs to complete the commands and options of framepath.

use clap::{Command, ValueEnum};
use clap_complete::Shell;
use std::io::{self, Write};

/// What is completed.
const NAME: &str = "framepath";

/// The shells that Debian has a place for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CompletedShell {
    /// GNU bash, with bash-completion.
    Bash,
    /// The Z shell.
    Zsh,
    /// fish.
    Fish,
}

/// Arguments of `framepath completions`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum, value_name = "SHELL")]
    pub shell: CompletedShell,
}

/// Prints them on standard output; commands that are hidden are left out.
///
/// # Errors
/// An output that cannot be written.
pub fn run(arguments: CompletionsArguments, command: &Command) -> io::Result<()> {
    let shell = match arguments.shell {
        CompletedShell::Bash => Shell::Bash,
        CompletedShell::Zsh => Shell::Zsh,
        CompletedShell::Fish => Shell::Fish,
    };
    let shown = command
        .get_subcommands()
        .filter(|known| !known.is_hide_set());
    let mut shown = Command::new(NAME)
        .version(env!("CARGO_PKG_VERSION"))
        .subcommands(shown.cloned());
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut shown, NAME, &mut text);
    let mut output = io::stdout().lock();
    output.write_all(&text)?;
    output.flush()
}
