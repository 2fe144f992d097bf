//! Files that exist in memory only: what the build script compiled becomes one to be started or loaded.

use rustix::fs::{MemfdFlags, memfd_create};
use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsRawFd;

/// A file in memory that child processes inherit.
#[derive(Debug)]
pub(crate) struct MemoryFile(File);

impl MemoryFile {
    /// A file with this content; the name is for those who look at the process.
    pub(crate) fn holding(name: &str, content: &[u8]) -> io::Result<Self> {
        // Without flags it is left open for children.
        let mut file = File::from(memfd_create(name, MemfdFlags::empty())?);
        file.write_all(content)?;
        Ok(Self(file))
    }

    pub(crate) fn file(&self) -> &File {
        &self.0
    }

    /// A path under which this process and its children find the file.
    pub(crate) fn path(&self) -> String {
        format!("/proc/self/fd/{}", self.0.as_raw_fd())
    }
}
