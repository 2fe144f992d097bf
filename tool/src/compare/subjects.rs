//! What the modules are compared with: programs, or an excerpt of each.

use super::CompareArguments;
use super::error::CompareError;
use super::excerpt::{Excerpt, excerpt};
use crate::arguments::file_name;
use crate::canon::call::Call;
use crate::canon::{Surroundings, read_text, seen_from, stream_program};
use crate::generated;
use crate::layer::program::Program;
use crate::layer::{LayerSettings, lay};
use crate::machine::limits::Limits;
use crate::path::Position;
use crate::signals::StopForAWhile;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// A program that is run.
pub(super) struct Subject {
    pub name: String,
    pub program: Program,
    /// What it is of the program of this name.
    pub excerpt: Option<Excerpt>,
    /// Why it is not run.
    pub no_excerpt: Option<String>,
}

impl Subject {
    fn new(name: String, program: Program, tube: Option<u16>) -> Subject {
        let whole = |program, no_excerpt| Subject {
            name: name.clone(),
            program,
            excerpt: None,
            no_excerpt,
        };
        let Some(most) = tube else {
            return whole(program, None);
        };
        match excerpt(&program, usize::from(most)) {
            Ok((place, excerpt)) => Subject {
                name: format!("{name} lines {} to {}", place.first_line, place.last_line),
                program: excerpt,
                excerpt: Some(place),
                no_excerpt: None,
            },
            Err(none) => whole(program, Some(none.to_string())),
        }
    }

    /// How many axes it moves.
    pub(super) fn moving_axes(&self) -> usize {
        (0..9)
            .filter(|&axis| {
                self.program.handed.iter().any(|piece| {
                    let segment = &piece.segment;
                    segment.start[axis] != segment.end[axis] || (axis < 3 && segment.arc.is_some())
                })
            })
            .count()
    }
}

/// The calls of a program that may take `most_time`, read until `stop` is set.
fn calls(
    file: &Path,
    start: &Position,
    most_time: Duration,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<Call>, CompareError> {
    let stream = stream_program(file, &Surroundings::standing_at(start))?;
    let stream = stream.within(most_time).until(Arc::clone(stop));
    Ok(stream.collect::<Result<_, _>>()?)
}

/// Reads all programs, with the machine at `start`, mm and degrees, so that one that cannot be read is known before anything runs.
pub(super) fn subjects(
    arguments: &CompareArguments,
    limits: Limits,
    start: &Position,
) -> Result<Vec<Subject>, CompareError> {
    let settings = LayerSettings {
        limits,
        feed_at_least: arguments.feed_at_least,
    };
    let names = generated_names(&arguments.generated)?;
    if arguments.files.is_empty() && names.is_empty() {
        return Err(CompareError::NoProgram(generated::names().join(", ")));
    }
    // Planners begin at zero.
    let program = |calls: Vec<Call>| {
        let calls = calls.into_iter().map(|call| seen_from(call, start));
        lay(&calls.collect::<Vec<_>>(), &settings)
    };
    let mut programs = Vec::new();
    // The interpreter has a folder of its own while it runs, which a signal would leave behind.
    let signals = StopForAWhile::new().map_err(CompareError::Unheard)?;
    let most_time = Duration::from_secs(arguments.most_seconds);
    for file in &arguments.files {
        let name = file_name(file);
        let calls = calls(file, start, most_time, signals.stop())?;
        programs.push((name, program(calls)));
    }
    for name in names {
        let text = generated::program(&name).unwrap_or_default();
        let calls = read_text(&name, &text, start)?;
        programs.push((name, program(calls)));
    }
    if signals.end() {
        return Err(CompareError::Stopped);
    }
    for (name, program) in &programs {
        if program.handed.is_empty() {
            return Err(CompareError::NoMoves(name.clone()));
        }
    }
    let subject = |(name, program)| Subject::new(name, program, arguments.tube);
    Ok(programs.into_iter().map(subject).collect())
}

fn generated_names(asked: &[String]) -> Result<Vec<String>, CompareError> {
    let known = generated::names();
    let mut names = Vec::new();
    for name in asked {
        if name == "all" {
            names.extend(generated::compared().into_iter().map(str::to_owned));
        } else if known.contains(&name.as_str()) {
            names.push(name.clone());
        } else {
            return Err(CompareError::UnknownProgram {
                name: name.clone(),
                known: known.join(", "),
            });
        }
    }
    Ok(names)
}
