//! Lines as long as those of a recording may be: what has no end of line is not gathered until memory is used up.
//! Each ends with LF, whatever the file has: the CSV reader counts a line that ends with CR LF when it has begun the next.

use std::error::Error;
use std::fmt;
use std::io::{self, Read};

/// No row is longer, bytes: sixteen joints and nine axes take less than a kilobyte.
const LONGEST: usize = 1 << 16;

/// Hands on what it reads, up to a line that is too long.
pub struct ShortLines<R> {
    from: R,
    /// The line that is read, from 1.
    line: u64,
    /// How long it is so far, bytes.
    length: usize,
    /// The byte before was CR: it has ended a line.
    after_return: bool,
}

impl<R: Read> ShortLines<R> {
    /// From its beginning.
    pub fn new(from: R) -> ShortLines<R> {
        ShortLines {
            from,
            line: 1,
            length: 0,
            after_return: false,
        }
    }

    /// Makes CR LF and CR to LF; returns how many bytes are left.
    fn end_lines(&mut self, bytes: &mut [u8]) -> usize {
        let mut kept = 0;
        for index in 0..bytes.len() {
            let byte = bytes[index];
            let ended = std::mem::replace(&mut self.after_return, byte == b'\r');
            if byte == b'\n' && ended {
                continue;
            }
            bytes[kept] = if byte == b'\r' { b'\n' } else { byte };
            kept += 1;
        }
        kept
    }
}

impl<R: Read> Read for ShortLines<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let length = loop {
            let read = self.from.read(into)?;
            let kept = self.end_lines(&mut into[..read]);
            // Nothing is left of a lone LF, and nothing would be the end.
            if kept > 0 || read == 0 {
                break kept;
            }
        };
        for piece in into[..length].split_inclusive(|&byte| byte == b'\n') {
            self.length += piece.len();
            if self.length > LONGEST {
                return Err(io::Error::other(TooLong(self.line)));
            }
            if piece.ends_with(b"\n") {
                self.line += 1;
                self.length = 0;
            }
        }
        Ok(length)
    }
}

/// A line that is too long.
#[derive(Debug)]
struct TooLong(u64);

impl fmt::Display for TooLong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a line of more than {LONGEST} bytes: this is no recording"
        )
    }
}

impl Error for TooLong {}

/// The line of which this error tells.
pub fn line_of(error: &io::Error) -> Option<u64> {
    let told = error.get_ref()?.downcast_ref::<TooLong>()?;
    Some(told.0)
}
