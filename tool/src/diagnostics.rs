//! Errors and warnings about a part program, and how they are shown.

use crate::encoding::Encoding;
use crate::source::{Excerpt, Sources, Span};
use codespan_reporting::diagnostic::{Diagnostic as Report, Label};
use codespan_reporting::files::{Error, Files, column_index, line_starts};
use codespan_reporting::term;
use std::ops::{Deref, Range};

/// How many are shown before the rest is only counted.
const SHOWN: usize = 50;

/// How many diagnostics are kept at all.
const KEPT: usize = 1000;

/// Whether the program can still be run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Nothing is written.
    Error,
    /// The program is written and the text becomes a message in it.
    Warning,
}

/// One thing that is wrong, or that a user could have meant otherwise. No larger than a pointer, because every result that
/// can be an error carries one.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic(Box<Details>);

/// What a [`Diagnostic`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct Details {
    /// Whether it stops the translation.
    pub severity: Severity,
    /// The word that is marked.
    pub span: Span,
    /// What is wrong.
    pub message: String,
    /// A short text beside the mark.
    pub label: String,
    /// What to write instead.
    pub help: Option<String>,
    /// Whether it may only follow from an error before it.
    follows: bool,
}

impl Deref for Diagnostic {
    type Target = Details;

    fn deref(&self) -> &Details {
        &self.0
    }
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Severity::Error, span, message.into())
    }

    /// An error at `span`, because it is not known ahead of time where something is. Behind another error it is
    /// left out: where the axes are after a block that could not be carried out is not known either.
    pub fn unknown_place(span: Span, message: impl Into<String>) -> Diagnostic {
        let mut diagnostic = Diagnostic::error(span, message);
        diagnostic.0.follows = true;
        diagnostic
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Severity::Warning, span, message.into())
    }

    fn new(severity: Severity, span: Span, message: String) -> Diagnostic {
        Diagnostic(Box::new(Details {
            severity,
            span,
            message,
            label: String::new(),
            help: None,
            follows: false,
        }))
    }

    /// Whether nothing is written.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// The short text beside the mark.
    pub fn label(mut self, label: impl Into<String>) -> Diagnostic {
        self.0.label = label.into();
        self
    }

    /// What to write instead.
    pub fn help(mut self, help: impl Into<String>) -> Diagnostic {
        self.0.help = Some(help.into());
        self
    }
}

/// All that was found, in the order in which it was found, each thing once.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    errors: usize,
    notes: Vec<String>,
}

impl Diagnostics {
    /// Adds one, unless the same was said about the same place before (a block in a loop, or in a
    /// subprogram that is called twice).
    pub fn push(&mut self, diagnostic: Diagnostic) {
        if diagnostic.follows && self.errors > 0 {
            return;
        }
        // Whoever gives a picture instead of a program must not wait for each of its bytes.
        if self.list.len() >= KEPT {
            self.errors += usize::from(diagnostic.severity == Severity::Error);
            return;
        }
        let known = self
            .list
            .iter()
            .any(|old| old.span == diagnostic.span && old.message == diagnostic.message);
        if !known {
            self.errors += usize::from(diagnostic.severity == Severity::Error);
            self.list.push(diagnostic);
        }
    }

    /// A file is not UTF-8, and its encoding was guessed.
    pub fn note_encoding(&mut self, file: &str, encoding: Encoding) {
        let note =
            format!("note: {file} is not UTF-8, taken as {encoding}; --encoding says otherwise");
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// What the user should know and the operator of the machine need not.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// How many errors there are.
    pub fn errors(&self) -> usize {
        self.errors
    }

    /// Whether so many errors are known that looking for more helps nobody.
    pub fn is_full(&self) -> bool {
        self.errors >= SHOWN
    }

    /// All diagnostics.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Takes over what others found.
    pub fn append(&mut self, others: Diagnostics) {
        others.list.into_iter().for_each(|one| self.push(one));
    }

    /// The warnings only.
    pub fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.iter()
            .filter(|diagnostic| diagnostic.severity == Severity::Warning)
    }

    /// The diagnostics as text for a terminal or a window: file, line, column, the line itself with
    /// the word marked, and the advice. Ordered by file and position.
    pub fn render(&self, sources: &Sources) -> String {
        let config = term::Config {
            chars: term::Chars::ascii(),
            ..term::Config::default()
        };
        let mut ordered: Vec<&Diagnostic> = self.list.iter().collect();
        ordered.sort_by_key(|diagnostic| (diagnostic.span.file, diagnostic.span.start));
        ordered.truncate(SHOWN);
        let mut text = String::new();
        for diagnostic in ordered {
            let excerpt = sources.excerpt(diagnostic.span);
            let mut report = match diagnostic.severity {
                Severity::Error => Report::error(),
                Severity::Warning => Report::warning(),
            };
            report = report.with_message(&diagnostic.message);
            if let Some(help) = &diagnostic.help {
                report = report.with_note(format!("help: {help}"));
            }
            // Only a file that was changed or removed meanwhile has no lines to show.
            let shown = excerpt.is_some_and(|excerpt| {
                let mark = Label::primary((), excerpt.marked.clone());
                let report = report.with_label(mark.with_message(&diagnostic.label));
                let shown = Shown::new(&excerpt);
                term::emit_to_string(&mut text, &config, &shown, &report).is_ok()
            });
            if !shown {
                let severity = match diagnostic.severity {
                    Severity::Error => "error",
                    Severity::Warning => "warning",
                };
                text.push_str(&format!("{severity}: {}\n", diagnostic.message));
            }
        }
        if self.list.len() > SHOWN {
            text.push_str(&format!("only the first {SHOWN} are shown\n\n"));
        }
        text
    }
}

/// Lines as the renderer wants them: a file that begins with another line than its first.
struct Shown<'a> {
    excerpt: &'a Excerpt,
    line_starts: Vec<usize>,
}

impl<'a> Shown<'a> {
    fn new(excerpt: &'a Excerpt) -> Shown<'a> {
        Shown {
            excerpt,
            line_starts: line_starts(&excerpt.text).collect(),
        }
    }
}

impl<'a> Files<'a> for Shown<'_> {
    type FileId = ();
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(&self.excerpt.name)
    }

    fn source(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(&self.excerpt.text)
    }

    fn line_index(&'a self, (): (), byte: usize) -> Result<usize, Error> {
        let ahead = self.line_starts.partition_point(|&start| start <= byte);
        Ok(ahead.saturating_sub(1))
    }

    fn line_number(&'a self, (): (), index: usize) -> Result<usize, Error> {
        Ok(self.excerpt.line as usize + index)
    }

    fn column_number(&'a self, (): (), index: usize, byte: usize) -> Result<usize, Error> {
        let line = self.line_range((), index)?;
        let column = column_index(&self.excerpt.text, line, byte);
        Ok(self.excerpt.left_out + column + 1)
    }

    fn line_range(&'a self, (): (), line: usize) -> Result<Range<usize>, Error> {
        let start = self.line_starts.get(line).ok_or(Error::LineTooLarge {
            given: line,
            max: self.line_starts.len().saturating_sub(1),
        })?;
        let end = self.line_starts.get(line + 1);
        Ok(*start..end.copied().unwrap_or(self.excerpt.text.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_whose_line_is_gone_is_still_a_warning() {
        let mut diagnostics = Diagnostics::default();
        diagnostics.push(Diagnostic::warning(Span::start_of(0), "mind the gap"));
        let shown = diagnostics.render(&Sources::default());
        assert_eq!(shown, "warning: mind the gap\n");
    }
}
