//! Errors and warnings about a part program, and how they are shown.

use crate::source::{Sources, Span};
use codespan_reporting::diagnostic::{Diagnostic as Report, Label};
use codespan_reporting::term;

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

/// One thing that is wrong, or that a user could have meant otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
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
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity: Severity::Error,
            span,
            message: message.into(),
            label: String::new(),
            help: None,
        }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity: Severity::Warning,
            ..Diagnostic::error(span, message)
        }
    }

    /// The short text beside the mark.
    pub fn label(mut self, label: impl Into<String>) -> Diagnostic {
        self.label = label.into();
        self
    }

    /// What to write instead.
    pub fn help(mut self, help: impl Into<String>) -> Diagnostic {
        self.help = Some(help.into());
        self
    }
}

/// All that was found, in the order in which it was found, each thing once.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    errors: usize,
}

impl Diagnostics {
    /// Adds one, unless the same was said about the same place before (a block in a loop, or in a
    /// subprogram that is called twice).
    pub fn push(&mut self, diagnostic: Diagnostic) {
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
        let mut text = String::new();
        for diagnostic in ordered.into_iter().take(SHOWN) {
            let mut report = match diagnostic.severity {
                Severity::Error => Report::error(),
                Severity::Warning => Report::warning(),
            };
            let Span { file, start, end } = diagnostic.span;
            report = report
                .with_message(&diagnostic.message)
                .with_label(Label::primary(file, start..end).with_message(&diagnostic.label));
            if let Some(help) = &diagnostic.help {
                report = report.with_note(format!("help: {help}"));
            }
            // The excerpt can fail only for a span outside its file; the message must not be lost.
            if term::emit_to_string(&mut text, &config, sources, &report).is_err() {
                text.push_str(&format!("error: {}\n", diagnostic.message));
            }
        }
        if self.list.len() > SHOWN {
            text.push_str(&format!("only the first {SHOWN} are shown\n\n"));
        }
        text
    }
}
