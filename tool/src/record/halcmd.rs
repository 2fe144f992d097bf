//! halcmd, LinuxCNC's command for HAL: the only way by which a recording reaches it.

use super::error::RecordError;
use super::state::State;
use std::io::Write;
#[cfg(unix)]
use std::os::unix::process::CommandExt;
use std::process::{Command, Output, Stdio};

/// A program of LinuxCNC. A Ctrl-C at the terminal is for us alone: what we have begun we end ourselves.
pub fn program(name: &str) -> Command {
    let mut command = Command::new(name);
    #[cfg(unix)]
    command.process_group(0);
    command
}

fn run(arguments: &[&str], input: &str) -> Result<Output, RecordError> {
    let failed = |source| RecordError::Program {
        program: "halcmd",
        source,
    };
    let mut child = program("halcmd")
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    if let Some(mut stdin) = child.stdin.take() {
        // Where it ends before it has read everything it says why.
        let _ = stdin.write_all(input.as_bytes());
    }
    child.wait_with_output().map_err(failed)
}

/// What it prints for `arguments`.
///
/// # Errors
/// [`RecordError::Program`]; [`RecordError::Halcmd`] with its own words.
pub fn answer(arguments: &[&str]) -> Result<String, RecordError> {
    let output = run(arguments, "")?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(refused(&output)),
    }
}

/// Carries out lines, up to the first that is refused.
///
/// # Errors
/// As [`answer`].
pub fn carry_out(lines: &[String]) -> Result<(), RecordError> {
    let output = run(&["-f"], &script(lines))?;
    match output.status.success() {
        true => Ok(()),
        false => Err(refused(&output)),
    }
}

/// Carries out lines, those behind a refused one, too.
///
/// # Errors
/// [`RecordError::Program`].
pub fn carry_out_all(lines: &[String]) -> Result<(), RecordError> {
    run(&["-k", "-f"], &script(lines)).map(drop)
}

fn script(lines: &[String]) -> String {
    lines.iter().map(|line| format!("{line}\n")).collect()
}

fn refused(output: &Output) -> RecordError {
    let text = [&output.stderr, &output.stdout].map(|bytes| String::from_utf8_lossy(bytes));
    let said: Vec<&str> = text
        .iter()
        .flat_map(|text| text.lines())
        .map(str::trim)
        .collect();
    let said: Vec<&str> = said.into_iter().filter(|line| !line.is_empty()).collect();
    RecordError::Halcmd(said.join("; "))
}

/// HAL as it is now.
///
/// # Errors
/// As [`answer`].
pub fn state() -> Result<State, RecordError> {
    let show = |what: &str| answer(&["-s", "show", what]);
    Ok(State::parse(
        &show("comp")?,
        &show("pin")?,
        &show("sig")?,
        &show("thread")?,
    ))
}

/// Bytes of HAL's memory that nobody has taken yet.
///
/// # Errors
/// As [`answer`].
pub fn free_memory() -> Result<Option<u64>, RecordError> {
    Ok(free_of(&answer(&["status", "mem"])?))
}

/// `used/total shared memory:   21432/262000`.
fn free_of(text: &str) -> Option<u64> {
    let line = text.lines().find(|line| line.contains("used/total"))?;
    let (used, total) = line.rsplit(' ').next()?.split_once('/')?;
    let number = |text: &str| text.trim().parse::<u64>().ok();
    Some(number(total)?.saturating_sub(number(used)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_memory_is_read() {
        let text = "HAL memory status\n  used/total shared memory:   21432/262000\n  active/recycled components: 9/0\n";
        assert_eq!(free_of(text), Some(240_568));
        assert_eq!(free_of("something else"), None);
    }
}
