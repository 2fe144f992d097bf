//! halsampler, which prints what the sampler in the servo thread has put aside.

use super::error::RecordError;
use super::{halcmd, processes};
use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStdout, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// How long is waited for a line before the caller looks at something else.
const PATIENCE: Duration = Duration::from_millis(50);

/// How long it may take to print what is left at the end.
const LAST_LINES: Duration = Duration::from_secs(10);

/// What comes from it.
#[derive(Debug, PartialEq)]
pub enum Printed {
    /// A line.
    Line(String),
    /// Nothing yet.
    Nothing,
    /// It has ended.
    End,
}

/// The process; it ends when this is dropped.
#[derive(Debug)]
pub struct Halsampler {
    child: Child,
    lines: Receiver<String>,
}

impl Halsampler {
    /// Starts it; the sampler has to be loaded.
    ///
    /// # Errors
    /// It is not there.
    pub fn start() -> Result<Halsampler, RecordError> {
        let mut child = halcmd::program("halsampler")
            .arg("-t")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|source| RecordError::Program {
                program: "halsampler",
                source,
            })?;
        let (sender, lines) = channel();
        if let Some(output) = child.stdout.take() {
            std::thread::spawn(move || {
                let send = |line| sender.send(line).is_ok();
                read_lines(output, send);
            });
        }
        Ok(Halsampler { child, lines })
    }

    /// The next line, if it comes soon.
    pub fn next(&self) -> Printed {
        match self.lines.recv_timeout(PATIENCE) {
            Ok(line) => Printed::Line(line),
            Err(RecvTimeoutError::Timeout) => Printed::Nothing,
            Err(RecvTimeoutError::Disconnected) => Printed::End,
        }
    }

    /// Ends the sampling and hands over what is left.
    ///
    /// # Errors
    /// What halcmd refuses, and what `take` does.
    pub fn finish(
        self,
        mut take: impl FnMut(&str) -> Result<(), RecordError>,
    ) -> Result<(), RecordError> {
        halcmd::answer(&["setp", "sampler.0.enable", "0"])?;
        let begun = Instant::now();
        // The servo thread has to see it first.
        let mut empty = 0;
        while empty < 3 && begun.elapsed() < LAST_LINES {
            let waiting = halcmd::answer(&["getp", "sampler.0.curr-depth"])?;
            empty = if waiting.trim() == "0" { empty + 1 } else { 0 };
            if let Printed::Line(line) = self.next() {
                take(&line)?;
            }
        }
        processes::end(self.child.id().cast_signed());
        loop {
            match self.next() {
                Printed::Line(line) => take(&line)?,
                Printed::Nothing if begun.elapsed() < LAST_LINES => {}
                Printed::Nothing | Printed::End => return Ok(()),
            }
        }
    }
}

impl Drop for Halsampler {
    fn drop(&mut self) {
        processes::end(self.child.id().cast_signed());
        let begun = Instant::now();
        while matches!(self.child.try_wait(), Ok(None)) {
            if begun.elapsed() > Duration::from_secs(2) {
                let _ = self.child.kill();
                let _ = self.child.wait();
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

/// Hands over lines until there are none, or nobody takes them.
fn read_lines(output: ChildStdout, mut take: impl FnMut(String) -> bool) {
    let mut lines = BufReader::new(output).lines();
    while let Some(Ok(line)) = lines.next() {
        if !take(line) {
            return;
        }
    }
}
