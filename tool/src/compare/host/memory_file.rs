//! Files that exist in memory only: what the build script compiled becomes one to be started or loaded.

use std::ffi::CString;
use std::fs::File;
use std::io::{self, Write};
use std::os::fd::{AsRawFd, FromRawFd};

/// A file in memory that child processes inherit.
#[derive(Debug)]
pub(crate) struct MemoryFile(File);

impl MemoryFile {
    /// An empty file; the name is for those who look at the process.
    pub(crate) fn new(name: &str) -> io::Result<Self> {
        let name = CString::new(name)?;
        // SAFETY: a string that ends with 0; without flags the file is left open for children.
        let descriptor = unsafe { libc::memfd_create(name.as_ptr(), 0) };
        if descriptor < 0 {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: a descriptor that was just opened and belongs to nobody else.
        Ok(Self(unsafe { File::from_raw_fd(descriptor) }))
    }

    /// A file with this content.
    pub(crate) fn holding(name: &str, content: &[u8]) -> io::Result<Self> {
        let mut file = Self::new(name)?;
        file.0.write_all(content)?;
        Ok(file)
    }

    pub(crate) fn file(&self) -> &File {
        &self.0
    }

    /// A path under which this process and its children find the file.
    pub(crate) fn path(&self) -> String {
        format!("/proc/self/fd/{}", self.0.as_raw_fd())
    }
}
