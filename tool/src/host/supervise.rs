//! Runs a module in a process of its own and waits for it, whatever it does.

use super::drive::PROGRESS_VARIABLE;
use super::job::Job;
use super::progress::Watch;
use super::recording::{Ending, Recording};
use crate::loaded::stubs::STUBS;
use crate::memory_file::MemoryFile;
use std::io::{self, Read, Write};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Hidden command of this program that a driven process runs.
pub(crate) const HOST_COMMAND: &str = "compare-host";

/// How often the watched process is looked at.
const LOOK_EVERY: Duration = Duration::from_millis(2);

/// How a run went.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// The process came to its end; how the program ended is in the recording.
    Ended,
    /// It crashed: the signal, and where.
    Crashed(String),
    /// It did nothing any more, and was ended.
    Hung(String),
}

/// Runs the job. A module that does not finish a call within `patience` hangs.
///
/// # Errors
/// Only what is not the module's doing: no process, no pipe.
pub(crate) fn run(job: &Job, patience: Duration) -> io::Result<(Outcome, Recording)> {
    let stubs = MemoryFile::holding("framepath-stubs", STUBS)?;
    let watch = Watch::new()?;
    let mut child = Command::new("/proc/self/exe")
        .arg(HOST_COMMAND)
        .env("LD_PRELOAD", stubs.path())
        .env(PROGRESS_VARIABLE, watch.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let bytes = postcard::to_stdvec(job).map_err(io::Error::other)?;
    let input = child.stdin.take();
    let feeder = thread::spawn(move || {
        // A process that is gone does not listen; its end tells why.
        input.map(|mut input| input.write_all(&bytes))
    });
    let records = reader(child.stdout.take());
    let complaints = reader(child.stderr.take());
    let status = wait(&mut child, &watch, patience)?;
    let _ = feeder.join();
    let recording = Recording::parse(&records.join().unwrap_or_default());
    let complaints = complaints.join().unwrap_or_default();
    let outcome = match status {
        None => Outcome::Hung(watch.describe()),
        Some(status) => judge(status, &recording, &watch, &complaints),
    };
    Ok((outcome, recording))
}

fn reader(pipe: Option<impl Read + Send + 'static>) -> JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            // What came before a failure counts.
            let _ = pipe.read_to_end(&mut bytes);
        }
        bytes
    })
}

/// `None` if the process had to be ended.
fn wait(child: &mut Child, watch: &Watch, patience: Duration) -> io::Result<Option<ExitStatus>> {
    let mut word = watch.word();
    let mut changed = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        let now = watch.word();
        if now != word {
            word = now;
            changed = Instant::now();
        } else if changed.elapsed() > patience {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        thread::sleep(LOOK_EVERY);
    }
}

fn judge(status: ExitStatus, recording: &Recording, watch: &Watch, complaints: &[u8]) -> Outcome {
    if let Some(signal) = status.signal() {
        return Outcome::Crashed(format!("signal {signal} {}", watch.describe()));
    }
    if recording.ending == Ending::Missing {
        let text = String::from_utf8_lossy(complaints);
        let text = text.lines().last().unwrap_or_default();
        return Outcome::Crashed(format!(
            "it ended the process ({status}) {}: {text}",
            watch.describe()
        ));
    }
    Outcome::Ended
}
