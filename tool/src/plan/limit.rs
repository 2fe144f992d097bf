//! How long a program may be, and how long its plan may take.

use super::PlanArguments;
use super::error::PlanError;
use super::lines::Line;
use crate::canon::CanonError;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Servo cycles between two looks at the clock.
const CYCLES: u32 = 4096;

/// The limits of one plan.
#[derive(Debug)]
pub struct Limit {
    file: PathBuf,
    most_time: Duration,
    begun: Instant,
    cycles: u32,
    stop: Arc<AtomicBool>,
}

impl Limit {
    /// From now on, for a file of a length that is allowed.
    ///
    /// # Errors
    /// What is no file on a disk: it is read more than once. A file that is too long.
    pub fn check(
        file: &Path,
        arguments: &PlanArguments,
        stop: &Arc<AtomicBool>,
    ) -> Result<Limit, PlanError> {
        let unfit = |problem: String| PlanError::Unfit {
            file: file.to_owned(),
            problem,
        };
        // That there is no such file is said by whoever opens it.
        if let Ok(metadata) = std::fs::metadata(file) {
            if metadata.is_dir() {
                return Err(unfit(
                    "it is a folder, and a program is one file".to_owned(),
                ));
            }
            if !metadata.is_file() {
                let problem = "it is a pipe or a device, and a plan reads its program twice: copy it into a file";
                return Err(unfit(problem.to_owned()));
            }
            if metadata.len() > arguments.most_bytes {
                let most = arguments.most_bytes;
                return Err(unfit(format!(
                    "it has more than {most} bytes; --most-bytes raises the limit"
                )));
            }
        }
        Ok(Limit {
            file: file.to_owned(),
            most_time: Duration::from_secs(arguments.most_seconds),
            begun: Instant::now(),
            cycles: 0,
            stop: Arc::clone(stop),
        })
    }

    /// How long the plan may take.
    pub fn most_time(&self) -> Duration {
        self.most_time
    }

    /// # Errors
    /// When the process was asked to stop.
    pub fn go_on(&self) -> Result<(), PlanError> {
        match self.stop.load(Ordering::Relaxed) {
            true => Err(CanonError::Stopped(self.file.clone()).into()),
            false => Ok(()),
        }
    }

    /// A servo cycle has been planned, in which this line runs.
    ///
    /// # Errors
    /// When the plan has taken too long, or is not wanted any more.
    pub fn note<'a>(&mut self, runs: impl FnOnce() -> &'a Line) -> Result<(), PlanError> {
        self.go_on()?;
        self.cycles += 1;
        if !self.cycles.is_multiple_of(CYCLES) || self.begun.elapsed() <= self.most_time {
            return Ok(());
        }
        let runs = runs();
        Err(PlanError::Slow {
            file: runs.file.to_path_buf(),
            line: runs.number,
            seconds: self.most_time.as_secs(),
        })
    }
}
