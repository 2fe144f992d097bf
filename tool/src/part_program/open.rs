//! Reading a part program: its encoding and its language.

use super::{Refused, refusal};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::Dialect;
use crate::dialects::foreign;
use crate::dialects::guess::decide;
use crate::source::open::{self, Content, OpenError, Reading};
use crate::source::{Sources, Span};
use std::path::Path;

/// How much of a program is looked at for its language, bytes.
const HEAD: usize = 1 << 16;

/// The longest file that is read again to show where it is not UTF-8, bytes.
const SHOWN: u64 = 1 << 24;

/// A part program, ready to be run.
pub(crate) struct Opened {
    name: String,
    /// Its language.
    pub dialect: Dialect,
    /// Its length, bytes.
    pub length: u64,
    /// How language and encoding were guessed.
    pub notes: Vec<String>,
    content: Content,
}

/// Opens a program.
pub(crate) fn open(dialect: Dialect, path: &Path, reading: &Reading) -> Result<Opened, Refused> {
    let name = path.display().to_string();
    let opened = open::open(path, reading).map_err(|error| match error {
        OpenError::NotUtf8(at) => not_utf_8(&name, path, at),
        error => unreadable(path, &error),
    })?;
    let mut diagnostics = Diagnostics::default();
    if let Some(guessed) = opened.guessed {
        diagnostics.note_encoding(&name, guessed);
    }
    let mut notes = diagnostics.notes().to_vec();
    let head = head(&opened.content).map_err(|error| unreadable(path, &error))?;
    let guessed = match foreign::refusal(&head) {
        Some(foreign) => Err(foreign),
        None => language(dialect, path, &head),
    };
    let (dialect, note) = guessed.map_err(|error| {
        let mut sources = Sources::default();
        sources.add(name.clone(), head);
        diagnostics.push(error);
        refusal(&diagnostics, &sources)
    })?;
    notes.extend(note);
    Ok(Opened {
        name,
        dialect,
        length: opened.length,
        notes,
        content: opened.content,
    })
}

impl Opened {
    /// The program as the only file, from its beginning.
    pub fn sources(&self) -> Result<Sources, Refused> {
        let mut sources = Sources::default();
        let added = self.content.add_to(&mut sources, self.name.clone());
        added.map_err(|error| unreadable(Path::new(&self.name), &error))?;
        Ok(sources)
    }
}

/// The beginning of a program, by which its language is guessed.
fn head(content: &Content) -> std::io::Result<String> {
    let pieces = match content {
        Content::Whole(text) => return Ok(text.clone()),
        Content::Pieces(pieces) => pieces,
    };
    let (mut pieces, mut place) = (pieces.again()?, 0);
    let mut text = String::new();
    while text.len() < HEAD
        && let Some(piece) = pieces.text_at(place)?
    {
        text.push_str(&piece.lines);
        place = piece.next;
    }
    Ok(text)
}

/// The dialect that is meant, and how it was guessed if it was.
fn language(
    dialect: Dialect,
    path: &Path,
    text: &str,
) -> Result<(Dialect, Option<String>), Diagnostic> {
    if dialect != Dialect::Auto {
        return Ok((dialect, None));
    }
    let guess = decide(path, text)?;
    let because = match guess.line {
        Some(line) => format!("because of line {line}"),
        None => "because of the ending of its file".to_string(),
    };
    let name = guess.dialect.name();
    let note = format!("note: taken as a {name} program, {because}; --dialect says otherwise");
    Ok((guess.dialect, Some(note)))
}

fn unreadable(path: &Path, error: &dyn std::fmt::Display) -> Refused {
    Refused(format!(
        "error: {} cannot be read: {error}\n",
        path.display()
    ))
}

fn not_utf_8(name: &str, path: &Path, at: u64) -> Refused {
    let length = std::fs::metadata(path).map_or(u64::MAX, |metadata| metadata.len());
    let bytes = match length <= SHOWN {
        true => std::fs::read(path).unwrap_or_default(),
        false => Vec::new(),
    };
    let start = usize::try_from(at).unwrap_or(usize::MAX);
    let mut sources = Sources::default();
    let file = sources.add(
        name.to_string(),
        String::from_utf8_lossy(&bytes).into_owned(),
    );
    let mut diagnostics = Diagnostics::default();
    let span = Span {
        file,
        start,
        end: start.saturating_add(char::REPLACEMENT_CHARACTER.len_utf8()),
    };
    let message = match bytes.is_empty() {
        true => format!("{name}: byte {} is not UTF-8", at + 1),
        false => "this is not UTF-8".to_string(),
    };
    diagnostics.push(
        Diagnostic::error(span, message)
            .help("leave --encoding out, or name the encoding of the file"),
    );
    refusal(&diagnostics, &sources)
}
