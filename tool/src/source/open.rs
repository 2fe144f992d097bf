//! Opening the file of a program or subprogram: its encoding, and whether it is held as a whole.

use super::Sources;
use crate::encoding::{Encoding, Pieces, Words, decode_as};
use crate::output::in_temporary_folder;
use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;

/// Files up to this length, bytes, are held as a whole.
pub const LONGEST_WHOLE: u64 = 1 << 18;

/// How much of a longer one is read at once, bytes.
pub const PIECE: usize = 1 << 18;

/// The longest program, bytes.
pub const MOST_BYTES: u64 = 1_000_000_000;

/// The longest time that a translation may take, seconds.
pub const MOST_SECONDS: u64 = 600;

/// How programs are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// The encoding of all files; `None`: the likeliest of each.
    pub encoding: Option<Encoding>,
    /// Files up to this length, bytes, are held as a whole.
    pub longest_whole: u64,
    /// How much of a longer one is read at once, bytes.
    pub piece: usize,
    /// The longest file that is read, bytes.
    pub most_bytes: u64,
    /// How long may be waited for a pipe or a device, and for the whole translation.
    pub most_time: Duration,
}

impl Default for Reading {
    fn default() -> Self {
        Reading {
            encoding: None,
            longest_whole: LONGEST_WHOLE,
            piece: PIECE,
            most_bytes: MOST_BYTES,
            most_time: Duration::from_secs(MOST_SECONDS),
        }
    }
}

/// A file that can be read.
#[derive(Debug)]
pub struct Opened {
    /// Its text.
    pub content: Content,
    /// The encoding that was taken, where nobody named it and it is not UTF-8.
    pub guessed: Option<Encoding>,
    /// Its length, bytes.
    pub length: u64,
}

/// The text of a file.
#[derive(Debug)]
pub enum Content {
    /// Held as a whole, with plain line ends.
    Whole(String),
    /// To be read in pieces.
    Pieces(Pieces),
}

impl Content {
    /// Adds the file to `sources`; see [`Sources::add`].
    ///
    /// # Errors
    ///
    /// Where the system has no room for it.
    pub fn add_to(&self, sources: &mut Sources, name: String) -> io::Result<usize> {
        Ok(match self {
            Content::Whole(text) => sources.add(name, text.clone()),
            Content::Pieces(pieces) => sources.add_windowed(name, pieces.again()?),
        })
    }
}

/// Why a file cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The system says why.
    #[error("{0}")]
    System(#[from] io::Error),
    /// A folder.
    #[error("it is a folder, and a program is one file")]
    Folder,
    /// A file that is longer than allowed.
    #[error("it has more than {0} bytes; --most-bytes raises the limit")]
    Long(u64),
    /// Nothing, or not the end, came through a pipe.
    #[error("its end did not come within {} s; --most-seconds raises the limit", .0.as_secs())]
    Slow(Duration),
    /// The byte with this index is not UTF-8, which the settings name.
    #[error("byte {} is not UTF-8", .0 + 1)]
    NotUtf8(u64),
}

/// Opens a file. What is no file on a disk is copied into one first, and what is longer than a piece and in
/// UTF-16, into one in UTF-8.
///
/// # Errors
///
/// Where it cannot be read, or is too long.
pub fn open(path: &Path, reading: &Reading) -> Result<Opened, OpenError> {
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(OpenError::Folder);
    }
    let mut file = match metadata.is_file() {
        true => File::open(path)?,
        false => copied(path, reading)?,
    };
    let length = file.metadata()?.len();
    if length > reading.most_bytes {
        return Err(OpenError::Long(reading.most_bytes));
    }
    if length > reading.longest_whole {
        return in_pieces(file, reading, length);
    }
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    // Some files that the system makes up have no length.
    file.take(reading.most_bytes).read_to_end(&mut bytes)?;
    let decoded =
        decode_as(&bytes, reading.encoding).map_err(|at| OpenError::NotUtf8(at as u64))?;
    Ok(Opened {
        content: Content::Whole(decoded.text),
        guessed: decoded.guessed,
        length: bytes.len() as u64,
    })
}

fn in_pieces(mut file: File, reading: &Reading, length: u64) -> Result<Opened, OpenError> {
    let mut beginning = Vec::new();
    io::Read::by_ref(&mut file)
        .take(4096)
        .read_to_end(&mut beginning)?;
    let encoding = match reading.encoding {
        Some(Encoding::Utf8) => {
            check_utf_8(&file, reading.piece)?;
            Encoding::Utf8
        }
        Some(encoding) => encoding,
        None => match Encoding::of_beginning(&beginning) {
            Some(encoding) => encoding,
            None => likeliest(&file, reading.piece)?,
        },
    };
    let guessed = reading.encoding.is_none() && encoding != Encoding::Utf8;
    let pieces = match encoding {
        // A line end may be a half of another character there.
        Encoding::Utf16Low | Encoding::Utf16High => Pieces::new(
            transcoded(&mut file, encoding)?,
            Encoding::Utf8,
            reading.piece,
        ),
        _ => Pieces::new(file, encoding, reading.piece),
    };
    Ok(Opened {
        content: Content::Pieces(pieces),
        guessed: guessed.then_some(encoding),
        length,
    })
}

fn likeliest(file: &File, piece: usize) -> io::Result<Encoding> {
    let mut words = Words::default();
    let mut utf_8 = true;
    for_each_piece(file, piece, |bytes, _| {
        utf_8 &= std::str::from_utf8(bytes).is_ok();
        words.collect(bytes);
        Ok(())
    })?;
    Ok(match utf_8 {
        true => Encoding::Utf8,
        false => words.likeliest(),
    })
}

fn check_utf_8(file: &File, piece: usize) -> Result<(), OpenError> {
    let mut wrong = None;
    for_each_piece(file, piece, |bytes, place| {
        if let (None, Err(error)) = (wrong, std::str::from_utf8(bytes)) {
            wrong = Some(place + error.valid_up_to() as u64);
        }
        Ok(())
    })?;
    wrong.map_or(Ok(()), |at| Err(OpenError::NotUtf8(at)))
}

/// Shows the bytes of each piece, and where they stand in the file.
fn for_each_piece(
    file: &File,
    piece: usize,
    mut show: impl FnMut(&[u8], u64) -> io::Result<()>,
) -> io::Result<()> {
    let mut pieces = Pieces::new(file.try_clone()?, Encoding::Windows1252, piece);
    let mut place = 0;
    while let Some(piece) = pieces.bytes_at(place)? {
        show(&piece.lines, place)?;
        place = piece.next;
    }
    Ok(())
}

/// The same text in UTF-8.
fn transcoded(file: &mut File, encoding: Encoding) -> io::Result<File> {
    let mut decoder = encoding.decoder();
    let made = tempfile::tempfile().map_err(in_temporary_folder)?;
    let mut written = io::BufWriter::new(made);
    file.seek(SeekFrom::Start(0))?;
    let mut bytes = vec![0; 1 << 16];
    loop {
        let length = file.read(&mut bytes)?;
        let mut text = String::with_capacity(2 * (1 << 16));
        let part = bytes.get(..length).unwrap_or(&[]);
        // Three bytes for every two are the most.
        let _ = decoder.decode_to_string(part, &mut text, length == 0);
        written.write_all(text.as_bytes())?;
        if length == 0 {
            return Ok(written.into_inner()?);
        }
    }
}

/// A temporary file with what comes through a pipe or from a device.
fn copied(path: &Path, reading: &Reading) -> Result<File, OpenError> {
    let (sender, receiver) = mpsc::channel();
    let (path, most) = (path.to_path_buf(), reading.most_bytes);
    // Already to open a pipe may take for ever. The thread ends with the process.
    std::thread::spawn(move || {
        let copy = || -> io::Result<(File, u64)> {
            let mut file = tempfile::tempfile().map_err(in_temporary_folder)?;
            let mut from = File::open(path)?.take(most.saturating_add(1));
            let length = io::copy(&mut from, &mut file)?;
            Ok((file, length))
        };
        // Nobody listens any more where it took too long.
        let _ = sender.send(copy());
    });
    let copied = receiver.recv_timeout(reading.most_time);
    let (file, length) = copied.map_err(|_| OpenError::Slow(reading.most_time))??;
    match length > most {
        true => Err(OpenError::Long(most)),
        false => Ok(file),
    }
}
