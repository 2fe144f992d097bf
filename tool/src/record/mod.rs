//! `framepath record`: records a LinuxCNC that runs, into the CSV file that `framepath report` reads.
//!
//! The files in the order of the work: [`state`] is HAL as it runs, read by [`mod@halcmd`]; [`wiring`] says which pins are
//! recorded and with which lines of halcmd, [`attachment`] carries these out and takes everything away again; [`sampler`]
//! is the program that reads the samples, [`rows`] writes them, [`program_end`] says when a program has ended.

mod attachment;
mod error;
mod halcmd;
mod processes;
mod program_end;
mod rows;
mod sampler;
mod state;
mod wiring;

pub use error::RecordError;

use crate::arguments::positive;
use crate::format::grouped;
use crate::output::{OutputFile, tell};
use crate::signals::stop_on_signals;
use attachment::{Attached, recover};
use program_end::{LONG_REST, ProgramEnd};
use rows::{Sample, Table};
use sampler::{Halsampler, Printed};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use wiring::{Columns, Wiring};

/// Without a sample for so long, LinuxCNC is looked at.
const SILENCE: Duration = Duration::from_secs(2);

/// Arguments of `framepath record`.
#[derive(Clone, Debug, clap::Args)]
pub struct RecordArguments {
    /// Recording to write
    #[arg(long, value_name = "FILE.csv")]
    pub output: PathBuf,
    /// Stop when the program that runs, or the next one that is started, has ended
    #[arg(long)]
    pub until_done: bool,
    /// Stop after so long
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub seconds: Option<f64>,
    /// How long samples may wait to be read, when the computer is busy
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = buffer)]
    pub buffer: f64,
}

fn buffer(text: &str) -> Result<f64, String> {
    match positive(text)? {
        seconds if (0.01..=60.0).contains(&seconds) => Ok(seconds),
        _ => Err("seconds from 0.01 to 60 are needed".to_owned()),
    }
}

/// Records until it is asked to stop; what was recorded is told on standard output.
///
/// # Errors
/// What is not there or is in use; a recording with gaps, or one that LinuxCNC's end has cut short, is written all the
/// same.
pub fn run(arguments: &RecordArguments) -> Result<(), RecordError> {
    let stop = stop_on_signals().map_err(RecordError::Signals)?;
    let unwritable = |source| RecordError::Write {
        file: arguments.output.clone(),
        source,
    };
    let file = OutputFile::create(&arguments.output).map_err(unwritable)?;
    let wiring = prepare(arguments)?;
    let mut recording = Recording {
        table: Table::new(file, &wiring.columns, wiring.period).map_err(unwritable)?,
        columns: &wiring.columns,
        arguments,
        program_end: ProgramEnd::default(),
        overruns: 0,
        is_done: false,
    };
    let attached = Attached::attach(&wiring)?;
    let halsampler = Halsampler::start()?;
    halcmd::carry_out(&wiring.start)?;
    announce(arguments, &wiring);
    let end = recording.follow(&halsampler, &stop)?;
    if end == End::Asked {
        halsampler.finish(|line| recording.take(line))?;
        recording.overruns = overruns()?;
    } else {
        drop(halsampler);
    }
    // A recording is not given up for what stays in HAL.
    let detached = attached.detach();
    let told = recording.finish()?;
    writeln!(io::stdout(), "{told}").map_err(unwritable)?;
    detached?;
    end.reason()
        .map_or(Ok(()), |reason| Err(RecordError::Ended(reason)))
}

/// Looks at the LinuxCNC that runs, and takes away what an earlier recording has left.
fn prepare(arguments: &RecordArguments) -> Result<Wiring, RecordError> {
    let state = halcmd::state();
    // A LinuxCNC of another user may be one that cannot be seen from here at all.
    let is_hidden = state
        .as_ref()
        .is_ok_and(|state| !state.has_component("motmod"));
    if let Some((theirs, own)) = processes::other_user().filter(|_| !is_hidden) {
        return Err(RecordError::OtherUser { theirs, own });
    }
    let mut state = state?;
    if recover(&state)? {
        tell("taken away what a recording had left that was killed");
        state = halcmd::state()?;
    }
    Wiring::new(&state, std::process::id(), arguments.buffer)
}

/// Says what is recorded, what is not, and until when.
fn announce(arguments: &RecordArguments, wiring: &Wiring) {
    tell(announcement(arguments, wiring).join("\n"));
}

/// The sentences of it.
fn announcement(arguments: &RecordArguments, wiring: &Wiring) -> Vec<String> {
    let axes: String = wiring.columns.axes.iter().collect();
    let joints = wiring.columns.joints.len();
    let mut until = Vec::from_iter(
        arguments
            .until_done
            .then(|| "the program has ended".to_owned()),
    );
    until.extend(
        arguments
            .seconds
            .map(|seconds| format!("{seconds} s are over")),
    );
    until.push("Ctrl-C".to_owned());
    let mut sentences = vec![format!(
        "recording {joints} joints and the axes {axes} every {} ms, until {}",
        wiring.period * 1e3,
        until.join(" or ")
    )];
    let beside = wiring
        .extra_joints
        .iter()
        .map(|joint| format!("joint.{joint}"));
    let beside = Vec::from_iter(beside).join(", ");
    if !beside.is_empty() {
        sentences.push(format!(
            "not recorded: {beside}, beside the kinematics (num_extrajoints of motmod)"
        ));
    }
    if arguments.until_done && !wiring.columns.idle {
        let why = if wiring.columns.leave_room() {
            "halui is not loaded"
        } else {
            "a sampler has no pin left for what halui says"
        };
        sentences.push(format!(
            "{why}: the program counts as ended when the machine has stood for {LONG_REST} s behind a \
             move; one without a move is not noticed"
        ));
    }
    sentences
}

fn is_running() -> Result<bool, RecordError> {
    Ok(halcmd::state()?.has_component("motmod"))
}

/// Why halsampler has ended: mostly because LinuxCNC is about to end, which begins with the programs.
fn why_unread() -> Result<End, RecordError> {
    let begun = Instant::now();
    while begun.elapsed() < SILENCE {
        if !is_running()? {
            return Ok(End::Gone);
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(End::Unread)
}

/// How often a sample found no room.
fn overruns() -> Result<u64, RecordError> {
    let text = halcmd::answer(&["getp", "sampler.0.overruns"])?;
    let number = text.trim();
    number
        .parse()
        .map_err(|_| RecordError::Sampler(format!("sampler.0.overruns is `{number}`")))
}

/// Why a recording comes to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    /// By a signal, the time, or the end of the program.
    Asked,
    /// LinuxCNC is not there any more.
    Gone,
    /// LinuxCNC is there, and halsampler is not.
    Unread,
}

impl End {
    /// Why it is not the end that was asked for.
    fn reason(self) -> Option<&'static str> {
        match self {
            End::Asked => None,
            End::Gone => Some("LinuxCNC has ended"),
            End::Unread => Some("halsampler was ended by somebody else"),
        }
    }
}

/// A recording that grows.
struct Recording<'a> {
    table: Table<OutputFile>,
    columns: &'a Columns,
    arguments: &'a RecordArguments,
    program_end: ProgramEnd,
    /// How often a sample found no room.
    overruns: u64,
    /// Nothing more is taken.
    is_done: bool,
}

impl Recording<'_> {
    /// Takes samples until there is a reason to stop.
    fn follow(&mut self, halsampler: &Halsampler, stop: &AtomicBool) -> Result<End, RecordError> {
        let mut heard = Instant::now();
        while !self.is_done && !stop.load(Ordering::Relaxed) {
            match halsampler.next() {
                Printed::Line(line) => {
                    self.take(&line)?;
                    heard = Instant::now();
                }
                Printed::End => return why_unread(),
                Printed::Nothing if heard.elapsed() > SILENCE => {
                    if !is_running()? {
                        return Ok(End::Gone);
                    }
                    heard = Instant::now();
                }
                Printed::Nothing => {}
            }
        }
        Ok(End::Asked)
    }

    /// A line of halsampler.
    fn take(&mut self, line: &str) -> Result<(), RecordError> {
        let Some(sample) = Sample::parse(line, self.columns)? else {
            return Ok(());
        };
        let time = self.table.time(&sample);
        if self.is_done || self.arguments.seconds.is_some_and(|most| time > most) {
            self.is_done = true;
            return Ok(());
        }
        let moves = self.table.moves(&sample);
        let has_ended = self.program_end.has_come(&sample, time, moves);
        self.is_done = self.arguments.until_done && has_ended;
        self.table
            .write(sample)
            .map_err(|source| self.unwritable(source))
    }

    fn unwritable(&self, source: io::Error) -> RecordError {
        RecordError::Write {
            file: self.arguments.output.clone(),
            source,
        }
    }

    /// Puts the file in its place; what is in it.
    fn finish(self) -> Result<String, RecordError> {
        let Recording {
            table, arguments, ..
        } = self;
        if table.rows == 0 {
            return Err(RecordError::Nothing);
        }
        let told = told(&arguments.output, &table);
        let (count, first) = (table.lost.max(self.overruns), table.first_lost);
        let finished = table.into_output().finish();
        finished.map_err(|source| RecordError::Write {
            file: arguments.output.clone(),
            source,
        })?;
        match count {
            0 => Ok(told),
            _ => Err(RecordError::Lost { told, count, first }),
        }
    }
}

/// `run.csv: 12,345 servo cycles`.
fn told(file: &Path, table: &Table<OutputFile>) -> String {
    let rows = usize::try_from(table.rows).unwrap_or(usize::MAX);
    format!("{}: {} servo cycles", file.display(), grouped(rows))
}

#[cfg(test)]
mod tests {
    use super::state::Pin;
    use super::*;

    #[test]
    fn what_is_not_recorded_or_not_noticed_is_said() {
        let arguments = |until_done| RecordArguments {
            output: PathBuf::from("run.csv"),
            until_done,
            seconds: Some(20.0),
            buffer: 10.0,
        };
        let mut state = state::tests::mill();
        let wiring = Wiring::new(&state, 77, 10.0).expect("a machine");
        assert_eq!(
            announcement(&arguments(false), &wiring),
            ["recording 2 joints and the axes xy every 1 ms, until 20 s are over or Ctrl-C"]
        );
        state.pins.push(Pin {
            owner: "motmod".to_owned(),
            name: "joint.1.posthome-cmd".to_owned(),
            value: "0".to_owned(),
            signal: None,
        });
        let wiring = Wiring::new(&state, 77, 10.0).expect("a machine");
        assert_eq!(
            announcement(&arguments(true), &wiring),
            [
                "recording 1 joints and the axes xy every 1 ms, until the program has ended or 20 s are over or Ctrl-C",
                "not recorded: joint.1, beside the kinematics (num_extrajoints of motmod)",
                "halui is not loaded: the program counts as ended when the machine has stood for 5 s behind a move; one \
                 without a move is not noticed",
            ]
        );
        let mut many = state::tests::mill();
        many.pins.extend((2..17).map(|joint| Pin {
            owner: "motmod".to_owned(),
            name: format!("joint.{joint}.pos-cmd"),
            value: "0".to_owned(),
            signal: None,
        }));
        let wiring = Wiring::new(&many, 77, 10.0).expect("a machine");
        assert!(
            announcement(&arguments(true), &wiring)[1]
                .starts_with("a sampler has no pin left for what halui says: the program counts")
        );
    }
}
