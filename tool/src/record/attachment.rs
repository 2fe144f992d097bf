//! A recording in a HAL that runs: attached, and taken away again however it ends.

use super::error::RecordError;
use super::halcmd;
use super::processes;
use super::state::State;
use super::wiring::{MARK, Wiring, unwire};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// From the last call of a function in a thread to the end of its module: many servo periods, also where a computer
/// without real-time rights lets the thread wait.
const LAST_CALL: Duration = Duration::from_millis(200);

/// How long a halsampler of a recording that was killed is waited for.
const HALSAMPLER_ENDS: Duration = Duration::from_secs(2);

/// HAL keeps the memory of a component that is unloaded: less than this is not touched, bytes.
const LEAST_MEMORY: u64 = 32_000;

/// How long the process with which halcmd has asked LinuxCNC's may take to end on a busy computer.
const MESSENGER_ENDS: Duration = Duration::from_secs(1);

/// Whether there are more processes with threads of a LinuxCNC than before, and not only for a moment.
fn another_stays(before: usize) -> bool {
    let begin = Instant::now();
    while processes::own_real_time() > before {
        if begin.elapsed() > MESSENGER_ENDS {
            return true;
        }
        sleep(Duration::from_millis(10));
    }
    false
}

/// Taken away when it is dropped, or before by [`Attached::detach`], which tells what is wrong.
#[derive(Debug)]
pub struct Attached {
    is_there: bool,
}

impl Attached {
    /// Loads and links; nothing is sampled yet.
    ///
    /// # Errors
    /// What halcmd refuses; then nothing of it stays.
    pub fn attach(wiring: &Wiring) -> Result<Attached, RecordError> {
        if let Some(free) = halcmd::free_memory()?
            && free < LEAST_MEMORY
        {
            return Err(RecordError::LittleMemory(free));
        }
        let processes = processes::own_real_time();
        let attached = Attached { is_there: true };
        halcmd::carry_out(&wiring.load)?;
        if another_stays(processes) {
            return Err(RecordError::OtherProcess);
        }
        halcmd::carry_out(&wiring.link)?;
        Ok(attached)
    }

    /// Takes it away.
    ///
    /// # Errors
    /// What stays all the same.
    pub fn detach(mut self) -> Result<(), RecordError> {
        self.is_there = false;
        take_away(&halcmd::state()?)
    }
}

impl Drop for Attached {
    fn drop(&mut self) {
        if self.is_there {
            // What went wrong before is told; this is found by the next recording.
            let _ = halcmd::state().and_then(|state| take_away(&state));
        }
    }
}

/// Takes away what a recording has left that was killed; whether there was one.
///
/// # Errors
/// One that still runs; what stays all the same.
pub fn recover(state: &State) -> Result<bool, RecordError> {
    let Some(mark) = state.signal(MARK) else {
        return Ok(false);
    };
    let process = mark.value.parse().unwrap_or(0);
    if processes::is_framepath(process) {
        return Err(RecordError::Busy(process));
    }
    wait_for_halsampler()?;
    take_away(&halcmd::state()?)?;
    Ok(true)
}

/// It ends by itself when nobody reads what it prints.
fn wait_for_halsampler() -> Result<(), RecordError> {
    let begun = Instant::now();
    loop {
        let state = halcmd::state()?;
        let mut components = state.components.iter();
        let Some(left) = components.find(|known| known.name.starts_with("halsampler")) else {
            return Ok(());
        };
        if begun.elapsed() > HALSAMPLER_ENDS {
            left.process.into_iter().for_each(processes::end);
            return Ok(());
        }
        sleep(Duration::from_millis(50));
    }
}

fn take_away(state: &State) -> Result<(), RecordError> {
    let [stop, remove] = unwire(state);
    if remove.is_empty() {
        return Ok(());
    }
    halcmd::carry_out_all(&stop)?;
    sleep(LAST_CALL);
    halcmd::carry_out_all(&remove)?;
    let [stop, remove] = unwire(&halcmd::state()?);
    match remove.is_empty() {
        true => Ok(()),
        false => Err(RecordError::LeftBehind([stop, remove].concat().join(", "))),
    }
}
