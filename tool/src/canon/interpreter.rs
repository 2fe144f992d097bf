//! Runs a program through LinuxCNC's interpreter, in a process of its own.

use super::call::Call;
use super::parameters::{self, ParameterError};
use super::refusal;
use super::surroundings::Surroundings;
use super::timed::Timed;
use crate::memory_file::MemoryFile;
use crate::output::in_temporary_folder;
use crate::path::Position;
use crate::wiring::same_series::{OtherSeries, check_installed};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The interpreter program, compiled by the build script.
const PROGRAM: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/interpreter"));

/// What the interpreter program says where LinuxCNC's interpreter says nothing.
const GIVES_UP: &str = "the interpreter gives up with code";

/// How many lines are shown of what it has said otherwise.
const LAST_LINES: usize = 4;

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
    #[error("{}{}: {message}\n    {text}{help}", file.display(), behind_colon(*line))]
    Refused {
        /// The file.
        file: PathBuf,
        /// Number of the line, from 1; 0 if it was none.
        line: u32,
        /// The interpreter's message.
        message: String,
        /// The line itself.
        text: String,
        /// What to do first, in a line of its own; empty where nothing is known.
        help: String,
    },
    /// The program does not end, or takes too long.
    #[error(
        "{}: the program has not ended after {seconds} s: check the conditions of its loops; --most-seconds \
         raises the limit",
        file.display()
    )]
    Slow {
        /// The file.
        file: PathBuf,
        /// How long was waited, s.
        seconds: u64,
    },
    /// The file of numbered parameters has a line that the interpreter cannot take.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// LinuxCNC is another one than when this command was built.
    #[error(transparent)]
    OtherSeries(#[from] OtherSeries),
    /// The process was asked to stop.
    #[error("{}: ended before it was done; no file is written or changed", .0.display())]
    Stopped(PathBuf),
    /// The interpreter could not be run to its end.
    #[error("{}: LinuxCNC's interpreter does not run: {problem}", file.display())]
    Interpreter {
        /// The file.
        file: PathBuf,
        /// What happened.
        problem: String,
    },
}

/// Line 0 is none: code that is in no line of the program.
fn behind_colon(line: u32) -> String {
    match line {
        0 => String::new(),
        line => format!(":{line}"),
    }
}

/// The canonical calls of a program.
///
/// # Errors
/// A file that cannot be opened, a program that the interpreter refuses (with its line and
/// message), an interpreter that cannot be run.
pub fn read_program(file: &Path, start: &Position) -> Result<Vec<Call>, CanonError> {
    stream_program(file, &Surroundings::standing_at(start))?.collect()
}

/// The canonical calls of a program one by one, while the interpreter goes on.
///
/// # Errors
/// Those of [`read_program`]; what comes up on the way is an item of the stream, its last.
pub fn stream_program(file: &Path, surroundings: &Surroundings) -> Result<CallStream, CanonError> {
    let read_error = |source| CanonError::Read {
        file: file.to_owned(),
        source,
    };
    // The interpreter's own message would not say why.
    let metadata = File::open(file).and_then(|opened| opened.metadata());
    if metadata.map_err(read_error)?.is_dir() {
        let problem = "it is a folder, and a program is one file";
        return Err(read_error(io::Error::other(problem)));
    }
    let absolute = std::fs::canonicalize(file).map_err(read_error)?;
    CallStream::start(file, &absolute, home(file)?, surroundings)
}

/// The canonical calls of a program that is in no file, with the machine at `start`; the name is for messages.
///
/// # Errors
/// Those of [`read_program`].
pub fn read_text(name: &str, text: &str, start: &Position) -> Result<Vec<Call>, CanonError> {
    let file = Path::new(name);
    let home = home(file)?;
    let written = home.path().join("program.ngc");
    std::fs::write(&written, text).map_err(|source| CanonError::Read {
        file: file.to_owned(),
        source,
    })?;
    CallStream::start(file, &written, home, &Surroundings::standing_at(start))?.collect()
}

fn home(file: &Path) -> Result<Home, CanonError> {
    Home::new().map_err(|error| failure(file, in_temporary_folder(error).to_string()))
}

fn failure(file: &Path, problem: String) -> CanonError {
    CanonError::Interpreter {
        file: file.to_owned(),
        problem,
    }
}

/// The calls of a program while the interpreter runs, which ends with this.
#[derive(Debug)]
pub struct CallStream {
    /// What messages call the program.
    file: PathBuf,
    child: Child,
    output: BufReader<Timed>,
    /// How long the program may take.
    most_time: Duration,
    complaints: Option<JoinHandle<String>>,
    line: Vec<u8>,
    ended: bool,
    /// The files of subroutines that were read so far, in the order of [`Tag::file`](super::call::Tag::file).
    read: Vec<Arc<Path>>,
    /// Whether there is an INI file.
    has_ini: bool,
    /// The file of numbered parameters, if there is one.
    parameters: Option<PathBuf>,
    /// The interpreter's files, there as long as it runs; after `child`, which ends first.
    _home: Home,
}

impl CallStream {
    /// Starts the interpreter on `program`; `file` is what messages call it.
    fn start(
        file: &Path,
        program: &Path,
        home: Home,
        surroundings: &Surroundings,
    ) -> Result<CallStream, CanonError> {
        check_installed()?;
        if let Some(file) = &surroundings.parameters {
            parameters::check(file)?;
        }
        let unusable = |error: io::Error| failure(file, error.to_string());
        surroundings
            .write(&home.parameters(), &home.settings())
            .map_err(|(file, source)| CanonError::Read { file, source })?;
        let ini = home.ini(surroundings).map_err(unusable)?;
        let interpreter =
            MemoryFile::holding("framepath-interpreter", PROGRAM).map_err(unusable)?;
        let mut command = Command::new(interpreter.path());
        command
            .arg(program)
            .arg(home.parameters())
            .arg(home.settings())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        match (&surroundings.ini, ini) {
            // Paths in an INI file count from its folder.
            (Some(named), Some(read)) => command
                .current_dir(named.parent().unwrap_or(Path::new("/")))
                .env("INI_FILE_NAME", read),
            _ => command
                .current_dir(home.path())
                .env("HOME", home.path())
                .env_remove("INI_FILE_NAME"),
        };
        let mut child = command.spawn().map_err(unusable)?;
        let (Some(output), Some(mut complaints)) = (child.stdout.take(), child.stderr.take())
        else {
            return Err(failure(file, "its output cannot be read".to_owned()));
        };
        let complaints = std::thread::spawn(move || {
            let mut text = Vec::new();
            // What was read before an error is all there is.
            let _ = complaints.read_to_end(&mut text);
            String::from_utf8_lossy(&text).into_owned()
        });
        Ok(CallStream {
            file: file.to_owned(),
            child,
            output: BufReader::with_capacity(1 << 16, Timed::new(output)),
            most_time: Duration::MAX,
            complaints: Some(complaints),
            line: Vec::new(),
            ended: false,
            read: Vec::new(),
            has_ini: surroundings.ini.is_some(),
            parameters: surroundings.parameters.clone(),
            _home: home,
        })
    }

    /// Ends with an error when the program has taken this time, counted from now.
    pub fn within(mut self, most_time: Duration) -> CallStream {
        self.most_time = most_time;
        self.output.get_mut().deadline = Instant::now().checked_add(most_time);
        self
    }

    /// Ends with an error when this is set.
    pub fn until(mut self, stop: Arc<AtomicBool>) -> CallStream {
        self.output.get_mut().stop = Some(stop);
        self
    }

    /// The files of subroutines that were read so far, in the order of [`Tag::file`](super::call::Tag::file).
    pub fn read(&self) -> &[Arc<Path>] {
        &self.read
    }

    /// The next line that the interpreter prints, `None` at the end of its output.
    fn read_line(&mut self) -> io::Result<Option<Cow<'_, str>>> {
        self.line.clear();
        if self.output.read_until(b'\n', &mut self.line)? == 0 {
            return Ok(None);
        }
        let line = self.line.strip_suffix(b"\n").unwrap_or(&self.line);
        Ok(Some(String::from_utf8_lossy(line)))
    }

    fn next_call(&mut self) -> Result<Option<Call>, CanonError> {
        let line = match self.read_line() {
            Ok(Some(line)) => line.into_owned(),
            Ok(None) => return Err(self.broken("")),
            Err(error) if error.kind() == io::ErrorKind::TimedOut => {
                return Err(CanonError::Slow {
                    file: self.file.clone(),
                    seconds: self.most_time.as_secs(),
                });
            }
            Err(error) => return Err(failure(&self.file, error.to_string())),
        };
        if let Some(call) = Call::parse(&line) {
            return Ok(Some(call));
        }
        if line == "END" {
            return Ok(None);
        }
        if let Some(file) = line.strip_prefix("READ ") {
            self.read.push(Arc::from(Path::new(file)));
            return self.next_call();
        }
        match line.strip_prefix("REFUSED ") {
            Some(refused) => Err(self.refused(refused)),
            None => Err(self.broken(&line)),
        }
    }

    /// What is behind the number of a line and a message of the interpreter.
    fn refused(&mut self, refused: &str) -> CanonError {
        let (number, message) = refused.split_once(' ').unwrap_or((refused, ""));
        let source = match self.read_line() {
            Ok(Some(source)) => source.into_owned(),
            _ => String::new(),
        };
        let text = source.strip_prefix("SOURCE ").unwrap_or_default();
        let line = number.parse().unwrap_or(0);
        if line == 0
            && message == refusal::NO_SUCH_PARAMETER
            && let Some(error) = self.parameters.as_deref().and_then(parameters::too_high)
        {
            return error.into();
        }
        let mut message = message.to_owned();
        // The program is there: it is another file that cannot be opened then.
        if message.contains(GIVES_UP) || (line == 0 && message == refusal::NO_FILE) {
            message += &self.reasons();
        }
        message += refusal::behind(&message, self.has_ini);
        CanonError::Refused {
            file: self.file.clone(),
            line,
            message,
            text: text.trim_end().to_owned(),
            help: refusal::of_another_control(&self.file),
        }
    }

    /// Why the interpreter gave up, as it has said beside its refusal, and what to do.
    fn reasons(&mut self) -> String {
        let said = self.complaints();
        let lines: Vec<&str> = said
            .lines()
            .filter(|line| !line.trim().is_empty())
            .collect();
        let last: String = lines[lines.len().saturating_sub(LAST_LINES)..]
            .iter()
            .map(|line| format!("\n    {}", line.trim_end()))
            .collect();
        let help = refusal::behind_words(&said);
        match last.is_empty() {
            true => String::new(),
            false => format!(", having said:{last}{help}"),
        }
    }

    /// All that the interpreter says beside its output, when it has ended.
    fn complaints(&mut self) -> String {
        let complaints = self.complaints.take().map(JoinHandle::join);
        complaints.and_then(Result::ok).unwrap_or_default()
    }

    /// It printed something else, or stopped in the middle.
    fn broken(&mut self, line: &str) -> CanonError {
        let status = match self.child.wait() {
            Ok(status) => status.to_string(),
            Err(error) => error.to_string(),
        };
        let complaints = self.complaints();
        let text = if line.is_empty() { &complaints } else { line };
        failure(
            &self.file,
            format!("it ended with {status}: {}", text.trim()),
        )
    }
}

impl Iterator for CallStream {
    type Item = Result<Call, CanonError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let mut next = self.next_call().transpose();
        // Ctrl-C ends the interpreter as well.
        if matches!(next, Some(Err(_))) && self.output.get_ref().is_stopped() {
            next = Some(Err(CanonError::Stopped(self.file.clone())));
        }
        self.ended = !matches!(next, Some(Ok(_)));
        next
    }
}

impl Drop for CallStream {
    fn drop(&mut self) {
        // It has ended already unless its calls were not wanted to the end.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A folder for what the interpreter reads and writes, removed at the end; left behind at worst.
#[derive(Debug)]
struct Home(TempDir);

impl Home {
    fn new() -> io::Result<Home> {
        let folder = tempfile::Builder::new().prefix("framepath-").tempdir()?;
        Ok(Home(folder))
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// The INI file that the interpreter reads: with those that it includes, as the script `linuxcnc` hands it over.
    fn ini(&self, surroundings: &Surroundings) -> io::Result<Option<PathBuf>> {
        let Some(text) = &surroundings.expanded_ini else {
            return Ok(surroundings.ini.clone());
        };
        let file = self.path().join("machine.ini.expanded");
        std::fs::write(&file, text)?;
        Ok(Some(file))
    }

    fn parameters(&self) -> PathBuf {
        self.path().join("parameters.var")
    }

    fn settings(&self) -> PathBuf {
        self.path().join("settings")
    }
}
