//! Reading a part program: its encoding, its language, and whether it is held as a whole.

use super::{FilterArguments, Refused, refusal};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::Dialect;
use crate::dialects::guess::{guess, undecided};
use crate::dialects::straight::Survey;
use crate::encoding::{Encoding, Pieces, Words, decode_as};
use crate::source::{Sources, Span};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// A part program, ready to be run.
pub(super) struct Opened {
    name: String,
    /// Its language.
    pub dialect: Dialect,
    /// Its length, bytes.
    pub length: u64,
    /// How language and encoding were guessed.
    pub notes: Vec<String>,
    held: Held,
}

enum Held {
    Whole(String),
    Pieces(Pieces),
}

/// Opens a program: in pieces where it is long and can be run so.
pub(super) fn open(arguments: &FilterArguments) -> Result<Opened, Refused> {
    let path = &arguments.file;
    let metadata = std::fs::metadata(path).map_err(|error| unreadable(path, &error))?;
    if metadata.is_file() && metadata.len() > arguments.longest_whole {
        let pieces = in_pieces(arguments).map_err(|error| unreadable(path, &error))?;
        if let Some((pieces, dialect, notes)) = pieces {
            return Ok(Opened {
                name: path.display().to_string(),
                dialect,
                length: metadata.len(),
                notes,
                held: Held::Pieces(pieces),
            });
        }
    }
    Opened::whole(arguments.dialect, path, arguments.encoding.0)
}

impl Opened {
    /// Holds the whole program.
    pub fn whole(
        dialect: Dialect,
        path: &Path,
        encoding: Option<Encoding>,
    ) -> Result<Opened, Refused> {
        let bytes = std::fs::read(path).map_err(|error| unreadable(path, &error))?;
        let name = path.display().to_string();
        let decoded = decode_as(&bytes, encoding).map_err(|at| not_utf_8(&name, &bytes, at))?;
        let mut diagnostics = Diagnostics::default();
        if let Some(guessed) = decoded.guessed {
            diagnostics.note_encoding(&name, guessed);
        }
        let mut notes = diagnostics.notes().to_vec();
        let guessed = language(dialect, path, &decoded.text);
        let (dialect, note) = guessed.ok_or_else(|| {
            let mut sources = Sources::default();
            sources.add(name.clone(), decoded.text.clone());
            diagnostics.push(undecided());
            refusal(&diagnostics, &sources)
        })?;
        notes.extend(note);
        Ok(Opened {
            name,
            dialect,
            length: bytes.len() as u64,
            notes,
            held: Held::Whole(decoded.text),
        })
    }

    /// The program as the only file, from its beginning.
    pub fn sources(&self) -> Result<Sources, Refused> {
        let mut sources = Sources::default();
        match &self.held {
            Held::Whole(text) => sources.add(self.name.clone(), text.clone()),
            Held::Pieces(pieces) => {
                let again = pieces.again();
                let again = again.map_err(|error| unreadable(Path::new(&self.name), &error))?;
                sources.add_windowed(self.name.clone(), again)
            }
        };
        Ok(sources)
    }
}

type InPieces = Option<(Pieces, Dialect, Vec<String>)>;

/// Looks through a file; `None` where it must be held as a whole.
fn in_pieces(arguments: &FilterArguments) -> io::Result<InPieces> {
    let mut file = File::open(&arguments.file)?;
    let mut mark = [0; 3];
    let length = file.read(&mut mark)?;
    let marked = mark.get(..length).and_then(Encoding::of_mark);
    let mut diagnostics = Diagnostics::default();
    let name = arguments.file.display().to_string();
    let encoding = match arguments.encoding.0.or(marked) {
        Some(encoding) => encoding,
        None => {
            let guessed = likeliest(&file, arguments.piece)?;
            if guessed != Encoding::Utf8 {
                diagnostics.note_encoding(&name, guessed);
            }
            guessed
        }
    };
    // A line end may be a half of another character there.
    if matches!(encoding, Encoding::Utf16Low | Encoding::Utf16High) {
        return Ok(None);
    }
    let pieces = Pieces::new(file, encoding, arguments.piece)?;
    let mut notes = diagnostics.notes().to_vec();
    let mut first = String::new();
    let mut reader = pieces.again()?;
    while first.len() < HEAD {
        match reader.next_text() {
            Ok(Some(text)) => first.push_str(&text),
            Ok(None) => break,
            // Where it is not, is said when the whole is read.
            Err(_) => return Ok(None),
        }
    }
    let Some((dialect, note)) = language(arguments.dialect, &arguments.file, &first) else {
        return Ok(None);
    };
    notes.extend(note);
    let mut survey = Survey::new(dialect);
    let mut reader = pieces.again()?;
    while let Some(bytes) = reader.next_bytes()? {
        let readable = encoding != Encoding::Utf8 || std::str::from_utf8(&bytes).is_ok();
        if !readable || !survey.look(&bytes) {
            return Ok(None);
        }
    }
    Ok(Some((pieces, dialect, notes)))
}

/// How much of a program is looked at for its language, bytes.
const HEAD: usize = 1 << 16;

fn likeliest(file: &File, piece: usize) -> io::Result<Encoding> {
    let mut pieces = Pieces::new(file.try_clone()?, Encoding::Windows1252, piece)?;
    let mut words = Words::default();
    let mut utf_8 = true;
    while let Some(bytes) = pieces.next_bytes()? {
        utf_8 &= std::str::from_utf8(&bytes).is_ok();
        words.collect(&bytes);
    }
    Ok(match utf_8 {
        true => Encoding::Utf8,
        false => words.likeliest(),
    })
}

/// The dialect that is meant, and how it was guessed if it was.
fn language(dialect: Dialect, path: &Path, text: &str) -> Option<(Dialect, Option<String>)> {
    if dialect != Dialect::Auto {
        return Some((dialect, None));
    }
    let guess = guess(path, text)?;
    let because = match guess.line {
        Some(line) => format!("because of line {line}"),
        None => "because of the ending of its file".to_string(),
    };
    let name = guess.dialect.name();
    let note = format!("note: taken as a {name} program, {because}; --dialect says otherwise");
    Some((guess.dialect, Some(note)))
}

fn unreadable(path: &Path, error: &io::Error) -> Refused {
    Refused(format!(
        "error: {} cannot be read: {error}\n",
        path.display()
    ))
}

fn not_utf_8(name: &str, bytes: &[u8], at: usize) -> Refused {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let mut sources = Sources::default();
    let file = sources.add(name.to_string(), text);
    let mut diagnostics = Diagnostics::default();
    let span = Span {
        file,
        start: at,
        end: at + char::REPLACEMENT_CHARACTER.len_utf8(),
    };
    diagnostics.push(
        Diagnostic::error(span, "this is not UTF-8")
            .help("leave --encoding out, or name the encoding of the file"),
    );
    refusal(&diagnostics, &sources)
}
