//! The texts of a program and its subprogram files, and places in them.
//!
//! A program may be longer than the memory: then only some pages of its text are held, and the others are read
//! again when a block of them runs, or somebody is to see them.

mod excerpt;
mod file;
pub mod open;
mod page;

pub use excerpt::Excerpt;
pub use file::SourceFile;
pub use page::Page;

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

/// All files that a program is made of; 0 is the program itself.
#[derive(Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a decoded file and returns its index.
    pub fn add(&mut self, name: String, text: String) -> usize {
        self.files.push(SourceFile::whole(name, text));
        self.files.len() - 1
    }

    /// Adds a file of which some pages are held, and returns its index.
    pub fn add_windowed(&mut self, name: String, pieces: Pieces) -> usize {
        self.files.push(SourceFile::windowed(name, pieces));
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

    /// The page in which a span begins; `None` where it lies outside of its file, or that cannot be read again.
    fn page_of(&self, span: Span) -> Option<Rc<Page>> {
        let page = self.files.get(span.file)?.page_at(span.start);
        page.ok().flatten()
    }

    /// A page with all lines of a span, as far as they can be read again.
    fn page_with(&self, span: Span) -> Option<Rc<Page>> {
        let page = self.page_of(span)?;
        let end = span.end.saturating_sub(1);
        if end < page.end() {
            return Some(page);
        }
        let last = self.page_of(Span { start: end, ..span });
        let Some(last) = last else {
            return Some(page);
        };
        let lines = page.line_of(span.start)..last.line_of(end.min(last.end())) + 1;
        self.lines(span.file, lines).ok().or(Some(page))
    }

    /// A page with all of these lines, which must be some of the file.
    ///
    /// # Errors
    ///
    /// Where the file cannot be read.
    pub fn lines(&self, file: usize, lines: Range<usize>) -> io::Result<Rc<Page>> {
        let nothing = || Rc::new(Page::new(String::new(), 0, lines.start));
        let Some(source) = self.files.get(file) else {
            return Ok(nothing());
        };
        let Some(page) = source.page_of_line(lines.start)? else {
            return Ok(nothing());
        };
        let end = |page: &Page| page.first_line() + page.lines();
        if lines.end <= end(&page) {
            return Ok(page);
        }
        let (first, mut behind) = (page.first_line(), end(&page));
        let mut text = page.text().to_string();
        while behind < lines.end {
            let Some(next) = source
                .page_of_line(behind)?
                .filter(|next| end(next) > behind)
            else {
                break;
            };
            text.push_str(next.text());
            behind = end(&next);
        }
        Ok(Rc::new(Page::new(text, page.start(), first)))
    }

    /// The text of a span; empty where it cannot be read again.
    pub fn slice(&self, span: Span) -> String {
        let page = self.page_with(span);
        page.map_or(String::new(), |page| {
            page.slice(span.start, span.end).to_string()
        })
    }

    /// The line, 1 for the first, in which a span begins.
    pub fn line(&self, span: Span) -> u32 {
        let page = self.page_of(span);
        let line = page.map_or(usize::MAX, |page| page.line_of(span.start));
        u32::try_from(line.saturating_add(1)).unwrap_or(u32::MAX)
    }

    /// The lines of a span; `None` where it lies outside of its file, or that cannot be read again.
    pub fn excerpt(&self, span: Span) -> Option<Excerpt> {
        let file = self.files.get(span.file)?;
        self.page_with(span)?.excerpt(&file.name, span)
    }
}
