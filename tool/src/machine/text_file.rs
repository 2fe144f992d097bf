//! Files of a configuration, as text.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// No INI or HAL file is longer, bytes.
const LONGEST: u64 = 16 << 20;

/// The text of an ordinary file; what is no UTF-8 becomes U+FFFD.
///
/// # Errors
/// What the operating system says, a file that is a folder or a device, and one that is too long.
pub(crate) fn read(path: &Path) -> io::Result<String> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("this is no ordinary file"));
    }
    let mut bytes = Vec::new();
    let length = File::open(path)?
        .take(LONGEST + 1)
        .read_to_end(&mut bytes)?;
    match length as u64 > LONGEST {
        true => Err(io::Error::other("it is longer than 16 MB")),
        false => Ok(String::from_utf8_lossy(&bytes).into_owned()),
    }
}
