//! `framepath generate`: prints one of the [`crate::generated`] programs.

use crate::arguments::{not_negative, positive};
use crate::generated::{GENERATORS, Generator, Options, find, names};
use std::io::Write;

/// Arguments of `framepath generate`.
#[derive(Clone, Debug, clap::Args)]
pub struct GenerateArguments {
    /// Name of the program; without it all are listed
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
    /// Other random numbers, where there are some
    #[arg(long, value_name = "SEED", default_value = "1", requires = "name")]
    pub seed: u64,
    /// G64 P in place of the program's own; 0 for a G64 without P
    #[arg(long, value_name = "MM", value_parser = not_negative, requires = "name")]
    pub tolerance: Option<f64>,
    /// F
    #[arg(long, value_name = "MM_MIN", default_value = "6000", value_parser = positive, requires = "name")]
    pub feed: f64,
}

/// Why no program was generated.
#[derive(Debug, thiserror::Error)]
pub enum GenerateError {
    /// No program has this name.
    #[error("{name}: there is no such program; there are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// All names.
        known: String,
    },
    /// Standard output cannot be written.
    #[error("the program cannot be written: {0}")]
    Write(std::io::Error),
}

/// Prints a program, or the list of all.
///
/// # Errors
/// A name that is not known, an output that cannot be written.
pub fn run(arguments: &GenerateArguments) -> Result<(), GenerateError> {
    let text = match &arguments.name {
        None => {
            let width = names().iter().map(|name| name.len()).max().unwrap_or(0);
            let line = |g: &Generator| format!("{:<width$}  {}\n", g.name, g.about);
            GENERATORS.iter().map(line).collect()
        }
        Some(name) => {
            let options = Options {
                seed: arguments.seed,
                tolerance: arguments.tolerance,
                feed: arguments.feed,
            };
            let generator = find(name).ok_or_else(|| GenerateError::Unknown {
                name: name.clone(),
                known: names().join(", "),
            })?;
            (generator.write)(&options)
        }
    };
    std::io::stdout()
        .lock()
        .write_all(text.as_bytes())
        .map_err(GenerateError::Write)
}
