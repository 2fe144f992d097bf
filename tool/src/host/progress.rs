//! What the driven process is doing, in memory shared with the one that watches it: it says where a
//! module crashed or hung.

use crate::memory_file::MemoryFile;
use std::fs::OpenOptions;
use std::io;
use std::os::fd::AsRawFd;
use std::os::unix::fs::FileExt;
use std::sync::atomic::{AtomicU64, Ordering};

/// What is being done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Step {
    Starting,
    Loading,
    Creating,
    Adding,
    RunCycle,
    Other,
    Finished,
}

const STEPS: [(Step, &str); 7] = [
    (Step::Starting, "before the module was loaded"),
    (Step::Loading, "while it was loaded"),
    (Step::Creating, "in tpCreate"),
    (Step::Adding, "in tpAddLine or tpAddCircle"),
    (Step::RunCycle, "in tpRunCycle"),
    (Step::Other, "in another function of tp.h"),
    (Step::Finished, "after the program"),
];

/// The side that watches.
#[derive(Debug)]
pub(crate) struct Watch(MemoryFile);

impl Watch {
    pub(crate) fn new() -> io::Result<Self> {
        Ok(Self(MemoryFile::holding("framepath-progress", &[0; 8])?))
    }

    pub(crate) fn path(&self) -> String {
        self.0.path()
    }

    /// The word as it stands; it changes as long as the process does something.
    pub(crate) fn word(&self) -> u64 {
        let mut bytes = [0; 8];
        match self.0.file().read_exact_at(&mut bytes, 0) {
            Ok(()) => u64::from_ne_bytes(bytes),
            Err(_) => 0,
        }
    }

    /// What was being done, and in which cycle.
    pub(crate) fn describe(&self) -> String {
        let word = self.word();
        let step = STEPS.get((word & 0xff) as usize).map_or("?", |step| step.1);
        match word >> 8 {
            0 => step.to_owned(),
            cycle => format!("{step}, cycle {cycle}"),
        }
    }
}

/// The side that works.
pub(crate) struct Progress(&'static AtomicU64);

impl Progress {
    pub(crate) fn open(path: &str) -> io::Result<Self> {
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        // SAFETY: a new mapping of 8 bytes of a file that has them, which is never unmapped.
        let address = unsafe {
            libc::mmap(
                std::ptr::null_mut(),
                8,
                libc::PROT_READ | libc::PROT_WRITE,
                libc::MAP_SHARED,
                file.as_raw_fd(),
                0,
            )
        };
        if address == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: aligned to a page, valid for ever, and used by atomic access only.
        Ok(Self(unsafe { AtomicU64::from_ptr(address.cast()) }))
    }

    pub(crate) fn note(&self, step: Step, cycle: u64) {
        self.0.store(cycle << 8 | step as u64, Ordering::Relaxed);
    }
}
