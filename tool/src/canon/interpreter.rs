//! Runs a program through LinuxCNC's interpreter, in a process of its own.

use super::call::Call;
use crate::compare::host::memory_file::MemoryFile;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The interpreter program, compiled by the build script.
const PROGRAM: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/interpreter"));

/// Why a program could not be read.
#[derive(Debug, thiserror::Error)]
pub enum CanonError {
    /// The file cannot be opened.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The interpreter refused a line.
    #[error("{}:{line}: {message}\n    {text}", file.display())]
    Refused {
        /// The file.
        file: PathBuf,
        /// Number of the line, from 1; 0 if it was none.
        line: u32,
        /// The interpreter's message.
        message: String,
        /// The line itself.
        text: String,
    },
    /// The interpreter could not be run to its end.
    #[error("{}: LinuxCNC's interpreter does not run: {problem}", file.display())]
    Interpreter {
        /// The file.
        file: PathBuf,
        /// What happened.
        problem: String,
    },
}

/// The canonical calls of a program.
///
/// # Errors
/// A file that cannot be opened, a program that the interpreter refuses (with its line and
/// message), an interpreter that cannot be run.
pub fn read_program(file: &Path) -> Result<Vec<Call>, CanonError> {
    let read_error = |source| CanonError::Read {
        file: file.to_owned(),
        source,
    };
    // The interpreter's own message would not say why.
    File::open(file).map_err(read_error)?;
    let absolute = std::fs::canonicalize(file).map_err(read_error)?;
    let home = home(file)?;
    interpret(file, &absolute, &home)
}

/// The canonical calls of a program that is in no file; the name is for messages.
///
/// # Errors
/// Those of [`read_program`].
pub fn read_text(name: &str, text: &str) -> Result<Vec<Call>, CanonError> {
    let file = Path::new(name);
    let home = home(file)?;
    let written = home.folder.join("program.ngc");
    std::fs::write(&written, text).map_err(|source| CanonError::Read {
        file: file.to_owned(),
        source,
    })?;
    interpret(file, &written, &home)
}

fn home(file: &Path) -> Result<Home, CanonError> {
    Home::new().map_err(|error| CanonError::Interpreter {
        file: file.to_owned(),
        problem: error.to_string(),
    })
}

/// Runs the interpreter on `program`; `file` is what messages call it.
fn interpret(file: &Path, program: &Path, home: &Home) -> Result<Vec<Call>, CanonError> {
    let failed = |problem: String| CanonError::Interpreter {
        file: file.to_owned(),
        problem,
    };
    let unusable = |error: io::Error| failed(error.to_string());

    let interpreter = MemoryFile::holding("framepath-interpreter", PROGRAM).map_err(unusable)?;
    let mut child = Command::new(interpreter.path())
        .arg(program)
        .arg(home.parameters())
        .current_dir(&home.folder)
        .env("HOME", &home.folder)
        .env_remove("INI_FILE_NAME")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(unusable)?;
    let (Some(output), Some(mut complaints)) = (child.stdout.take(), child.stderr.take()) else {
        return Err(failed("its output cannot be read".to_owned()));
    };
    let complaints = std::thread::spawn(move || {
        let mut text = String::new();
        // What is not text is no message.
        let _ = complaints.read_to_string(&mut text);
        text
    });
    let outcome = read_calls(file, BufReader::new(output)).map_err(unusable)?;
    let status = child.wait().map_err(unusable)?;
    let complaints = complaints.join().unwrap_or_default();
    match outcome {
        Outcome::Complete(calls) => Ok(calls),
        Outcome::Refused(error) => Err(error),
        Outcome::Broken(line) => {
            let text = if line.is_empty() { complaints } else { line };
            Err(failed(format!("it ended with {status}: {}", text.trim())))
        }
    }
}

enum Outcome {
    Complete(Vec<Call>),
    Refused(CanonError),
    /// It printed something else, or stopped in the middle.
    Broken(String),
}

fn read_calls(file: &Path, output: impl BufRead) -> io::Result<Outcome> {
    let mut calls = Vec::new();
    let mut refusal: Option<(u32, String)> = None;
    for line in output.split(b'\n') {
        let line = String::from_utf8_lossy(&line?).into_owned();
        if line == "END" {
            return Ok(Outcome::Complete(calls));
        }
        if let Some(rest) = line.strip_prefix("REFUSED ") {
            let (number, message) = rest.split_once(' ').unwrap_or((rest, ""));
            refusal = Some((number.parse().unwrap_or(0), message.to_owned()));
        } else if let (Some(text), Some((line, message))) =
            (line.strip_prefix("SOURCE "), refusal.as_ref())
        {
            return Ok(Outcome::Refused(CanonError::Refused {
                file: file.to_owned(),
                line: *line,
                message: message.clone(),
                text: text.trim_end().to_owned(),
            }));
        } else if let Some(call) = Call::parse(&line) {
            calls.push(call);
        } else {
            return Ok(Outcome::Broken(line));
        }
    }
    Ok(Outcome::Broken(String::new()))
}

/// A folder for what the interpreter writes, removed at the end.
struct Home {
    folder: PathBuf,
}

impl Home {
    fn new() -> io::Result<Home> {
        let base = std::env::temp_dir();
        let process = std::process::id();
        for attempt in 0..1000 {
            let folder = base.join(format!("framepath-{process}-{attempt}"));
            match std::fs::create_dir(&folder) {
                Ok(()) => {
                    let home = Home { folder };
                    File::create(home.parameters())?;
                    return Ok(home);
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(io::Error::other("no name is free for a temporary folder"))
    }

    fn parameters(&self) -> PathBuf {
        self.folder.join("parameters.var")
    }
}

impl Drop for Home {
    fn drop(&mut self) {
        // Left behind at worst: a few lines in the folder for temporary files.
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}
