//! The texts of a program and its subprogram files, and places in them.

use codespan_reporting::files::{Error, Files};
use std::ops::Range;

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

/// One decoded file; its line ends are all `\n`.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// What messages call it, usually its path.
    pub name: String,
    /// The decoded text.
    pub text: String,
    line_starts: Vec<usize>,
}

/// All files that a program is made of; 0 is the program itself.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a decoded file and returns its index.
    pub fn add(&mut self, name: String, text: String) -> usize {
        let line_starts = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
        self.files.push(SourceFile {
            name,
            text,
            line_starts,
        });
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

    /// The line, 1 for the first, in which the span begins.
    pub fn line(&self, span: Span) -> u32 {
        let starts = &self.files[span.file].line_starts;
        let line = starts.partition_point(|&start| start <= span.start);
        u32::try_from(line).unwrap_or(u32::MAX)
    }
}

impl<'a> Files<'a> for Sources {
    type FileId = usize;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: usize) -> Result<&'a str, Error> {
        let file = self.files.get(id).ok_or(Error::FileMissing)?;
        Ok(&file.name)
    }

    fn source(&'a self, id: usize) -> Result<&'a str, Error> {
        let file = self.files.get(id).ok_or(Error::FileMissing)?;
        Ok(&file.text)
    }

    fn line_index(&'a self, id: usize, byte: usize) -> Result<usize, Error> {
        let file = self.files.get(id).ok_or(Error::FileMissing)?;
        Ok(file
            .line_starts
            .partition_point(|&start| start <= byte)
            .saturating_sub(1))
    }

    fn line_range(&'a self, id: usize, line: usize) -> Result<Range<usize>, Error> {
        let file = self.files.get(id).ok_or(Error::FileMissing)?;
        let start = file.line_starts.get(line).ok_or(Error::LineTooLarge {
            given: line,
            max: file.line_starts.len().saturating_sub(1),
        })?;
        let end = file
            .line_starts
            .get(line + 1)
            .copied()
            .unwrap_or(file.text.len());
        Ok(*start..end)
    }
}
