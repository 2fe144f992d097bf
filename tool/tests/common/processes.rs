//! Processes that a test has started, and what they leave behind.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longer than anything takes on a busy machine.
const SOON: Duration = Duration::from_secs(60);

/// A program that never ends, and never moves a second time.
pub const ENDLESS: &str = "G21\nG0 X1\n#1=0\no1 while [1]\n#1=[#1+1]\no1 endwhile\nM2\n";

/// Starts a command of `framepath` in `folder`, which has to be there, with its temporary files in `folder/tmp`.
pub fn start(folder: &Path, arguments: &[&str]) -> Child {
    let room = folder.join("tmp");
    std::fs::create_dir_all(&room).expect("a folder");
    Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(folder)
        .env("TMPDIR", &room)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs")
}

/// How many processes read the program `part.ngc` of this folder by its whole name: LinuxCNC's interpreter does.
pub fn interpreters(folder: &Path) -> usize {
    let wanted = std::fs::canonicalize(folder)
        .expect("a folder")
        .join("part.ngc");
    let wanted = wanted.to_str().expect("text").as_bytes();
    let processes = std::fs::read_dir("/proc").expect("processes").flatten();
    let lines = processes.filter_map(|process| std::fs::read(process.path().join("cmdline")).ok());
    lines
        .filter(|line| line.split(|byte| *byte == 0).any(|word| word == wanted))
        .count()
}

/// Waits until it is so.
#[track_caller]
pub fn await_that(what: &str, so: impl Fn() -> bool) {
    let begun = Instant::now();
    while !so() {
        assert!(begun.elapsed() < SOON, "{what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Sends a signal.
pub fn signal(child: &Child, signal: &str) {
    let killed = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(killed.is_ok_and(|status| status.success()));
}
