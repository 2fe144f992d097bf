//! What can go wrong before anything is measured.

use crate::canon::CanonError;
use crate::joints::JointsError;
use crate::machine::IniError;
use crate::wiring::same_series::OtherSeries;
use std::io;
use std::path::PathBuf;

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// --optimum, --tube or --holds in a build that has no solver.
    #[error(
        "framepath compare --optimum, --tube and --holds: this framepath was built without its feature optimum: \
         cargo install --locked --path tool --features optimum"
    )]
    NoOptimum,
    /// Neither a file nor --generated was given.
    #[error(
        "nothing to compare with: name a program, or one of the generated ones with --generated ({0})"
    )]
    NoProgram(String),
    /// No generated program has this name.
    #[error("--generated {name}: there is no such program; there are {known}")]
    UnknownProgram {
        /// The name.
        name: String,
        /// All names.
        known: String,
    },
    /// The operator holds the machine, and lets it go never.
    #[error(
        "{option} {time}:0 holds the machine for good, so that no program comes to its end: write a further {option} \
         above 0 at a later time, or --abort"
    )]
    HeldForGood {
        /// The option.
        option: &'static str,
        /// Seconds.
        time: f64,
    },
    /// The program cannot be read.
    #[error(transparent)]
    Canon(#[from] CanonError),
    /// Signals cannot be waited for.
    #[error("Ctrl-C cannot be waited for: {0}")]
    Unheard(io::Error),
    /// The process was asked to stop.
    #[error("ended before it was done")]
    Stopped,
    /// The program does not move.
    #[error("{0}: the program has no moves")]
    NoMoves(String),
    /// A module file does not exist.
    #[error("{}: there is no such module{hint}", file.display())]
    NoModule {
        /// The file.
        file: PathBuf,
        /// What to do.
        hint: &'static str,
    },
    /// A module is of another LinuxCNC than this command.
    #[error(transparent)]
    OtherSeries(#[from] OtherSeries),
    /// --repeat, and a module does something else when it is run again.
    #[error(
        "{}: another run of the same program went another way, so that its calls cannot be compared: leave \
         --repeat out",
        .0.display()
    )]
    NotRepeatable(PathBuf),
    /// A module did not run a program to its end: every run of that kind, a line each.
    #[error("{}", .0.join("\n"))]
    NotDone(Vec<String>),
    /// --check, and a module does not keep what is promised. The comparison itself has been told.
    #[error("not kept: {0}")]
    NotKept(String),
    /// The INI file cannot be used.
    #[error(transparent)]
    Ini(#[from] IniError),
    /// Limits of joints cannot be used.
    #[error(transparent)]
    Joints(#[from] JointsError),
    /// The least time in the tolerance was asked for where joints have limits.
    #[error(
        "--tube: the least time in the tolerance is found for the limits of axes, and the INI file sets limits of joints: \
         take --optimum, or give the limits with --limits and leave out --ini"
    )]
    TubeOfJoints,
    /// Something that is not the module's doing.
    #[error("a module cannot be run: {0}")]
    Run(io::Error),
    /// The output cannot be written.
    #[error("the result cannot be written: {0}")]
    Write(io::Error),
}
