//! A file that is read in pieces of whole lines, so that it need not fit into the memory.

use super::{Encoding, with_plain_line_ends};
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

/// The longest line that is read, bytes. A line is held as a whole, with all its words.
const LONGEST_LINE: usize = 1 << 20;

/// A file in an encoding in which no line end is a part of another character.
#[derive(Debug)]
pub struct Pieces {
    file: File,
    encoding: Encoding,
    /// How many bytes a piece has at most, unless a line is longer.
    length: usize,
}

/// Some whole lines of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece<T> {
    /// The lines: bytes, or text with plain line ends.
    pub lines: T,
    /// The place in the file at which the next piece begins, bytes.
    pub next: u64,
}

impl Pieces {
    /// Of a file in this encoding, `length` bytes at once.
    pub fn new(file: File, encoding: Encoding, length: usize) -> Pieces {
        Pieces {
            file,
            encoding,
            length: length.max(1),
        }
    }

    /// The same file once more.
    ///
    /// # Errors
    ///
    /// Where the system has no room for it.
    pub fn again(&self) -> io::Result<Pieces> {
        let file = self.file.try_clone()?;
        Ok(Pieces::new(file, self.encoding, self.length))
    }

    /// The bytes of the lines from a place on, which is 0 or that of a [`Piece::next`]; `None` at the end of the
    /// file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read, or a line is longer than 1 MB.
    pub fn bytes_at(&mut self, place: u64) -> io::Result<Option<Piece<Vec<u8>>>> {
        self.file.seek(SeekFrom::Start(place))?;
        let mut lines = Vec::new();
        loop {
            let before = lines.len();
            let mut part = self.file.by_ref().take(self.length as u64);
            if part.read_to_end(&mut lines)? == 0 {
                break;
            }
            if let Some(end) = last_line_end(&lines, before) {
                lines.truncate(end);
                break;
            }
            if lines.len() > LONGEST_LINE {
                return Err(io::Error::new(
                    ErrorKind::InvalidData,
                    "a line of more than 1 MB is no line of a part program",
                ));
            }
        }
        let next = place + lines.len() as u64;
        if place == 0 && lines.starts_with(self.encoding.mark()) {
            lines.drain(..self.encoding.mark().len());
        }
        Ok((next > place).then_some(Piece { lines, next }))
    }

    /// The text of the lines from a place on; see [`Pieces::bytes_at`].
    ///
    /// # Errors
    ///
    /// Where the file cannot be read, or has bytes that do not belong to its encoding.
    pub fn text_at(&mut self, place: u64) -> io::Result<Option<Piece<String>>> {
        let Some(Piece { lines, next }) = self.bytes_at(place)? else {
            return Ok(None);
        };
        let text = match self.encoding {
            Encoding::Utf8 => String::from_utf8(lines)
                .map_err(|error| io::Error::new(ErrorKind::InvalidData, error.utf8_error()))?,
            encoding => encoding
                .decode(&lines)
                .map_err(|_| io::Error::from(ErrorKind::InvalidData))?,
        };
        Ok(Some(Piece {
            lines: with_plain_line_ends(text),
            next,
        }))
    }
}

/// The position behind the last line end, if one lies behind `known`. A CR at the very end may be half
/// of one.
fn last_line_end(bytes: &[u8], known: usize) -> Option<usize> {
    let new = bytes.get(known.saturating_sub(1)..)?;
    let found = new.iter().rposition(|byte| *byte == b'\n').or_else(|| {
        let (_, before_last) = new.split_last()?;
        before_last.iter().rposition(|byte| *byte == b'\r')
    })?;
    Some(known.saturating_sub(1) + found + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::io::Write;

    fn pieces(bytes: &[u8], length: usize) -> Pieces {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(bytes).unwrap();
        Pieces::new(file, Encoding::Windows1252, length)
    }

    proptest! {
        #[test]
        fn the_pieces_are_the_whole(
            bytes in prop::collection::vec(prop::sample::select(b"ab\r\n\xe9".to_vec()), 0..60),
            length in 1_usize..20,
        ) {
            let mut pieces = pieces(&bytes, length);
            let (mut joined, mut place) = (String::new(), 0);
            while let Some(Piece { lines, next }) = pieces.text_at(place).unwrap() {
                joined.push_str(&lines);
                // A piece that is read again is the same.
                prop_assert_eq!(pieces.text_at(place).unwrap(), Some(Piece { lines, next }));
                place = next;
            }
            let whole = super::super::decode_as(&bytes, Some(Encoding::Windows1252));
            prop_assert_eq!(Ok(joined), whole.map(|decoded| decoded.text));
        }
    }

    #[test]
    fn a_line_without_an_end_is_not_held() {
        let mut pieces = pieces(&vec![0; 3 * LONGEST_LINE], 4096);
        assert!(pieces.bytes_at(0).is_err());
    }
}
