//! The programs and subprograms of a file.

use super::clean::{block_comment, is_continued};
use super::parser::{head_line, lines, parse_blocks};
use super::structure::Structure;
use super::syntax::{Block, Command, Flow, Jump, Routine, Statement, Target};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::{Blocks, Lines};
use crate::dialects::outline::{Notable, notable_lines};
use crate::source::{Sources, Span, Text};
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::rc::Rc;

/// Whether a line begins a program, leads elsewhere, or belongs together with others.
fn is_notable(line: &[u8]) -> bool {
    let mut bytes = line.iter();
    if bytes.any(|byte| matches!(byte, b'%' | b'$' | b'#' | b'\\')) {
        return true;
    }
    // `[NAME]` at the beginning, behind a number.
    let before = |byte: &&u8| !byte.is_ascii_alphabetic() || matches!(byte, b'N' | b'n');
    let mut beginning = line.iter().take_while(before);
    beginning.any(|byte| *byte == b'[')
}

/// What is known of a file when its lines have been looked at.
#[derive(Default)]
struct Outline {
    /// Lines that must be parsed together.
    joined: Vec<Range<usize>>,
    /// Lines with control statements or labels.
    notable: Vec<usize>,
    heads: Vec<Head>,
    /// Where `#COMMENT BEGIN` stands without its end so far.
    in_comment: Option<usize>,
    /// The same of `#VAR`.
    declaring: Option<usize>,
}

/// A line with `%`.
struct Head {
    line: usize,
    /// The name of the subprogram, or `None` where a program begins.
    name: Option<String>,
    /// Whether a subprogram begins that nothing can call, since it has no name.
    lost: bool,
    span: Span,
}

impl Outline {
    fn line(&mut self, line: usize, text: Text, diagnostics: &mut Diagnostics) {
        match (block_comment(text.text), self.in_comment) {
            (Some(true), None) => {
                self.in_comment = Some(line);
                return;
            }
            (Some(false), Some(first)) => {
                self.in_comment = None;
                self.join(first..line + 1);
                return;
            }
            (Some(_), _) | (None, Some(_)) => return,
            (None, None) => {}
        }
        if text.text.contains('\\') && is_continued(text.text) {
            self.join(line..line + 2);
        }
        let beginning = text.text.trim_start_matches([' ', '\t', '\u{a0}', '\0']);
        if beginning.starts_with('%') {
            let (name, span) = head_line(text, diagnostics);
            let lost = name.is_err();
            let name = name.unwrap_or_else(|diagnostic| {
                diagnostics.push(diagnostic);
                None
            });
            self.heads.push(Head {
                line,
                name,
                lost,
                span,
            });
            return;
        }
        if text.text.contains('#') {
            self.declaration(line, text);
        }
        self.notable.push(line);
    }

    fn declaration(&mut self, line: usize, text: Text) {
        let mut declaring = self.declaring.map(|_| Span::start_of(text.file));
        // What is wrong with the line is said when it is parsed with those that belong to it.
        lines(text, &mut declaring, &mut Diagnostics::default());
        match (declaring, self.declaring) {
            (Some(_), None) => self.declaring = Some(line),
            (None, Some(first)) => {
                self.declaring = None;
                self.join(first..line + 1);
            }
            _ => {}
        }
    }

    /// These lines belong together, and with others that they share lines with.
    fn join(&mut self, mut lines: Range<usize>) {
        while let Some(last) = self.joined.pop_if(|last| last.end > lines.start) {
            lines.start = lines.start.min(last.start);
            lines.end = lines.end.max(last.end);
        }
        self.joined.push(lines);
    }
}

/// The programs and subprograms of a file; see [`crate::dialects::library::Read`].
pub fn routines(
    file: usize,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let mut outline = Outline::default();
    let notable = Notable {
        is: is_notable,
        among_plain: |_| false,
    };
    let mut visit = |line: usize, text: Text, diagnostics: &mut Diagnostics| {
        outline.line(line, text, diagnostics)
    };
    let end = notable_lines(file, sources, diagnostics, notable, &mut visit);
    // What is not ended goes on to the end, where that is said.
    for first in [outline.in_comment, outline.declaring]
        .into_iter()
        .flatten()
    {
        outline.join(first..end);
    }
    let joined: Rc<[Range<usize>]> = outline
        .joined
        .iter()
        .map(|lines| lines.start..lines.end.min(end))
        .collect();
    let path = &sources.file(file).name;
    let file_name = path
        .rsplit(['/', '\\'])
        .next()
        .unwrap_or(path)
        .to_ascii_uppercase();
    let mut routines: Vec<Routine> = Vec::new();
    let mut add = |head: Option<&Head>, range: Range<usize>, diagnostics: &mut Diagnostics| {
        let first = outline.notable.partition_point(|line| *line < range.start);
        let last = outline.notable.partition_point(|line| *line < range.end);
        let lines = Lines {
            file,
            ranges: vec![range],
            joined: Rc::clone(&joined),
            ..Lines::default()
        };
        let notable = outline.notable.get(first..last).unwrap_or(&[]);
        let mut routine = routine(lines, notable, sources, diagnostics);
        let title = head.and_then(|head| head.name.as_ref());
        routine.name = title.map_or(stem.to_string(), |title| format!("{file}:{title}"));
        routine.main = title.is_none() && !head.is_some_and(|head| head.lost);
        routine.title = title.unwrap_or(&file_name).clone();
        if let (Some(head), Some(title)) = (head, title)
            && routines.iter().any(|known| known.name == routine.name)
        {
            let twice = format!("{title} is in this file twice");
            let error = Diagnostic::error(head.span, twice);
            diagnostics.push(error.help("give one of them another name"));
        }
        routines.push(routine);
    };
    let mut head = None;
    for next in &outline.heads {
        let first = head.map_or(0, |head: &Head| head.line + 1);
        add(head, first..next.line, diagnostics);
        head = Some(next);
    }
    let first = head.map_or(0, |head| head.line + 1);
    add(head, first..end.max(first), diagnostics);
    // The main program may have a head or not: what stands before the first head is none if empty.
    let several = routines.len() > 1;
    routines.retain(|routine| !several || !routine.main || routine.first.is_some());
    routines
}

/// A routine without its name.
fn routine(
    lines: Lines,
    notable: &[usize],
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Routine {
    let file = lines.file;
    let mut structure = Structure::default();
    let mut labels: HashMap<String, Vec<usize>> = HashMap::new();
    let mut targets = BTreeSet::new();
    let mut turns_machine = false;
    let mut blocks = Blocks::new(lines.clone(), parse_blocks);
    for line in notable {
        let Some(index) = blocks.index(*line) else {
            continue;
        };
        let Some(block) = blocks.get(index, sources, diagnostics) else {
            continue;
        };
        turns_machine |= matches!(block.statement, Statement::Command(Command::SystemOn(..)));
        if let Some(label) = &block.label {
            labels.entry(label.clone()).or_default().push(index);
        }
        if let Statement::Flow(flow) = &block.statement {
            structure.add(index, flow, block.place.span);
            if let Flow::Jump(Jump { target, .. }) | Flow::JumpIf(_, Jump { target, .. }) = flow
                && let Target::Number(number) = target
            {
                targets.insert(*number);
            }
        }
    }
    if !targets.is_empty() {
        blocks = Blocks::new(Lines { targets, ..lines }, parse_blocks);
    }
    structure.close(&blocks, sources, diagnostics);
    let first = blocks.find(sources, diagnostics, says);
    Routine {
        name: String::new(),
        title: String::new(),
        main: true,
        file,
        blocks,
        structure,
        labels,
        turns_machine,
        first: first.map(|block| block.place.span),
    }
}

fn says(block: &Block) -> bool {
    block.statement != Statement::Empty
}
