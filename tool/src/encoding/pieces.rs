//! A file that is read in pieces of whole lines, so that it need not fit into the memory.

use super::{Encoding, with_plain_line_ends};
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

/// A file in an encoding in which no line end is a part of another character.
#[derive(Debug)]
pub struct Pieces {
    file: File,
    encoding: Encoding,
    /// How many bytes a piece has at most, unless a line is longer.
    length: usize,
    /// Bytes behind the last line end that was found.
    rest: Vec<u8>,
    at_start: bool,
    ended: bool,
    read: u64,
}

impl Pieces {
    /// From the beginning of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read from its beginning.
    pub fn new(mut file: File, encoding: Encoding, length: usize) -> io::Result<Pieces> {
        file.seek(SeekFrom::Start(0))?;
        Ok(Pieces {
            file,
            encoding,
            length: length.max(1),
            rest: Vec::new(),
            at_start: true,
            ended: false,
            read: 0,
        })
    }

    /// The same file from its beginning again.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read a second time.
    pub fn again(&self) -> io::Result<Pieces> {
        Pieces::new(self.file.try_clone()?, self.encoding, self.length)
    }

    /// How many bytes have been read.
    pub fn bytes_read(&self) -> u64 {
        self.read
    }

    /// The bytes of the next lines; `None` at the end of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn next_bytes(&mut self) -> io::Result<Option<Vec<u8>>> {
        let mut piece = std::mem::take(&mut self.rest);
        while !self.ended {
            let before = piece.len();
            let mut part = self.file.by_ref().take(self.length as u64);
            match part.read_to_end(&mut piece)? {
                0 => self.ended = true,
                length => {
                    self.read += length as u64;
                    if let Some(end) = last_line_end(&piece, before) {
                        self.rest = piece.split_off(end);
                        break;
                    }
                }
            }
        }
        if std::mem::take(&mut self.at_start) && piece.starts_with(self.encoding.mark()) {
            piece.drain(..self.encoding.mark().len());
        }
        Ok((!piece.is_empty() || !self.ended).then_some(piece))
    }

    /// The text of the next lines, with plain line ends; `None` at the end of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read, or has bytes that do not belong to its encoding.
    pub fn next_text(&mut self) -> io::Result<Option<String>> {
        let Some(bytes) = self.next_bytes()? else {
            return Ok(None);
        };
        let text = match self.encoding {
            Encoding::Utf8 => String::from_utf8(bytes)
                .map_err(|error| io::Error::new(ErrorKind::InvalidData, error.utf8_error()))?,
            encoding => encoding
                .decode(&bytes)
                .map_err(|_| io::Error::from(ErrorKind::InvalidData))?,
        };
        Ok(Some(with_plain_line_ends(text)))
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

    proptest! {
        #[test]
        fn the_pieces_are_the_whole(
            bytes in prop::collection::vec(prop::sample::select(b"ab\r\n\xe9".to_vec()), 0..60),
            length in 1_usize..20,
        ) {
            let mut file = tempfile::tempfile().unwrap();
            file.write_all(&bytes).unwrap();
            let mut pieces = Pieces::new(file, Encoding::Windows1252, length).unwrap();
            let mut joined = String::new();
            while let Some(text) = pieces.next_text().unwrap() {
                joined.push_str(&text);
            }
            let whole = super::super::decode_as(&bytes, Some(Encoding::Windows1252));
            prop_assert_eq!(Ok(joined), whole.map(|decoded| decoded.text));
        }
    }
}
