//! The texts of a program and its subprogram files, and places in them.
//!
//! A program may be longer than the memory: then only a window of its text is held, and places behind
//! it are looked up in the file again when somebody is to see them.

use crate::encoding::Pieces;
use std::io;
use std::ops::Range;
use std::rc::Rc;

/// A piece of the text of one source file, as byte positions in its decoded text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Span {
    /// Index of the file in [`Sources`].
    pub file: usize,
    /// First byte.
    pub start: usize,
    /// First byte that no longer belongs to it.
    pub end: usize,
}

impl Span {
    /// The beginning of a file.
    pub fn start_of(file: usize) -> Span {
        Span {
            file,
            start: 0,
            end: 0,
        }
    }

    /// From the beginning of `self` to the end of `last`, which must lie in the same file.
    pub fn to(self, last: Span) -> Span {
        Span {
            end: last.end.max(self.end),
            ..self
        }
    }
}

/// Some lines of a file, to be parsed.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// Index of the file in [`Sources`].
    pub file: usize,
    /// The lines.
    pub text: &'a str,
    /// The position of their first byte in the file.
    pub start: usize,
}

/// A file of its own.
impl<'a> From<&'a str> for Text<'a> {
    fn from(text: &'a str) -> Text<'a> {
        Text {
            file: 0,
            text,
            start: 0,
        }
    }
}

impl<'a> Text<'a> {
    /// What stands between two positions of the file; nothing where that is not in these lines.
    pub fn slice(&self, range: Range<usize>) -> &'a str {
        let local = range.start.checked_sub(self.start);
        let local = local.zip(range.end.checked_sub(self.start));
        local
            .and_then(|(start, end)| self.text.get(start..end))
            .unwrap_or("")
    }
}

/// One decoded file, or a window of it; its line ends are all `\n`.
#[derive(Debug)]
pub struct SourceFile {
    /// What messages call it, usually its path.
    pub name: String,
    text: Rc<str>,
    /// The position of the first byte of the text in the file, and its line, 1 for the first.
    start: usize,
    first_line: u32,
    /// The positions at which the lines of the text begin.
    line_starts: Vec<usize>,
    /// Where the rest of the file comes from.
    pieces: Option<Pieces>,
}

impl SourceFile {
    fn new(name: String, text: String, pieces: Option<Pieces>) -> SourceFile {
        let mut file = SourceFile {
            name,
            text: Rc::from(""),
            start: 0,
            first_line: 1,
            line_starts: vec![0],
            pieces,
        };
        file.show(text);
        file
    }

    /// Makes `text`, which follows the present text in the file, the window.
    fn show(&mut self, text: String) {
        self.first_line = self.last_line();
        self.start += self.text.len();
        self.text = Rc::from(text);
        self.line_starts.clear();
        let ends = self.text.match_indices('\n');
        self.line_starts.push(self.start);
        let start = self.start;
        self.line_starts.extend(ends.map(|(at, _)| start + at + 1));
    }

    fn last_line(&self) -> u32 {
        let ends = self.line_starts.len().saturating_sub(1);
        self.first_line
            .saturating_add(u32::try_from(ends).unwrap_or(u32::MAX))
    }

    /// The text that is held.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text that is held, for one who changes the sources meanwhile, and where it begins.
    pub fn shared_text(&self) -> (Rc<str>, usize) {
        (Rc::clone(&self.text), self.start)
    }

    /// Whether only a window of the file is held.
    pub fn is_windowed(&self) -> bool {
        self.pieces.is_some()
    }

    /// How many line ends the file has, as far as it has been read.
    pub fn lines(&self) -> usize {
        (self.last_line() as usize).saturating_sub(1)
    }

    fn line_of(&self, position: usize) -> Option<u32> {
        let ahead = self.line_starts.partition_point(|&start| start <= position);
        let at = u32::try_from(ahead.checked_sub(1)?).ok()?;
        (position <= self.start + self.text.len()).then(|| self.first_line.saturating_add(at))
    }

    /// The line or the lines of a span; `None` where they are not in the window.
    fn excerpt(&self, span: Span) -> Option<Excerpt> {
        let line = self.line_of(span.start)?;
        let first = self
            .line_starts
            .partition_point(|&start| start <= span.start)
            - 1;
        let first = *self.line_starts.get(first)?;
        let before = |next: &usize| *next <= span.start || *next < span.end;
        let behind = self
            .line_starts
            .get(self.line_starts.partition_point(before));
        let end = behind.map_or(self.start + self.text.len(), |next| next - 1);
        let text = self.text.get(first - self.start..end - self.start)?;
        Some(Excerpt {
            name: self.name.clone(),
            text: text.to_string(),
            line,
            marked: span.start - first..span.end.clamp(span.start, end) - first,
        })
    }
}

/// Lines of a file with a piece of them marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// What the file is called.
    pub name: String,
    /// The whole lines.
    pub text: String,
    /// The number of the first one.
    pub line: u32,
    /// The marked piece, byte positions in the text.
    pub marked: Range<usize>,
}

/// All files that a program is made of; 0 is the program itself.
#[derive(Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a decoded file and returns its index.
    pub fn add(&mut self, name: String, text: String) -> usize {
        self.files.push(SourceFile::new(name, text, None));
        self.files.len() - 1
    }

    /// Adds a file of which a window is held, empty at first, and returns its index.
    pub fn add_windowed(&mut self, name: String, pieces: Pieces) -> usize {
        self.files
            .push(SourceFile::new(name, String::new(), Some(pieces)));
        self.files.len() - 1
    }

    /// The file with this index, as [`Sources::add`] returned it.
    pub fn file(&self, index: usize) -> &SourceFile {
        &self.files[index]
    }

    /// All files, in the order of their indices.
    pub fn iter(&self) -> impl Iterator<Item = &SourceFile> {
        self.files.iter()
    }

    /// The text that is held of a file.
    pub fn text(&self, file: usize) -> Text<'_> {
        let source = &self.files[file];
        Text {
            file,
            text: &source.text,
            start: source.start,
        }
    }

    /// Moves the window of a file to the lines behind it; `false` at the end of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn advance(&mut self, file: usize) -> io::Result<bool> {
        let Some(source) = self.files.get_mut(file) else {
            return Ok(false);
        };
        let next = match &mut source.pieces {
            Some(pieces) => pieces.next_text()?,
            None => None,
        };
        let goes_on = next.is_some();
        next.into_iter().for_each(|text| source.show(text));
        Ok(goes_on)
    }

    /// How many bytes of a windowed file have been read.
    pub fn bytes_read(&self, file: usize) -> u64 {
        let pieces = self.files.get(file).and_then(|file| file.pieces.as_ref());
        pieces.map_or(0, Pieces::bytes_read)
    }

    /// The line, 1 for the first, in which a span of the window begins.
    pub fn line(&self, span: Span) -> u32 {
        if let Some(line) = self.files[span.file].line_of(span.start) {
            return line;
        }
        let again = self.excerpts(&[span]).into_iter().flatten().next();
        again.map_or(u32::MAX, |excerpt| excerpt.line)
    }

    /// The lines of each span, wherever they are; `None` for a span outside of its file, or where the
    /// file cannot be read again.
    pub fn excerpts(&self, spans: &[Span]) -> Vec<Option<Excerpt>> {
        let mut found: Vec<Option<Excerpt>> = spans
            .iter()
            .map(|span| self.files.get(span.file)?.excerpt(*span))
            .collect();
        for (index, file) in self.files.iter().enumerate() {
            let missing = |(span, excerpt): (&Span, &Option<Excerpt>)| {
                span.file == index && excerpt.is_none()
            };
            if spans.iter().zip(&found).any(missing) {
                // A file that cannot be read a second time has its messages without their lines.
                let _ = file.look_again(index, spans, &mut found);
            }
        }
        found
    }
}

impl SourceFile {
    /// Finds the lines of spans that the window has left behind.
    fn look_again(
        &self,
        index: usize,
        spans: &[Span],
        found: &mut [Option<Excerpt>],
    ) -> io::Result<()> {
        let Some(pieces) = &self.pieces else {
            return Ok(());
        };
        let mut again = SourceFile::new(self.name.clone(), String::new(), None);
        let mut pieces = pieces.again()?;
        while let Some(text) = pieces.next_text()? {
            again.show(text);
            let end = again.start + again.text.len();
            for (span, excerpt) in spans.iter().zip(found.iter_mut()) {
                let here = span.file == index && (again.start..end).contains(&span.start);
                if here && excerpt.is_none() {
                    *excerpt = again.excerpt(*span);
                }
            }
        }
        Ok(())
    }
}
