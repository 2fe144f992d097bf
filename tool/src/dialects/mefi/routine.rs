//! The programs and subprograms of a file.

use super::parser::{Line, lines, parse_blocks};
use super::syntax::{Block, Routine, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::{Blocks, Lines};
use crate::dialects::outline::{Notable, notable_lines};
use crate::source::{Sources, Text};
use std::ops::Range;

/// Whether a line may begin or end a program or a subprogram: `%`, G79 L100, G70, M30.
fn is_notable(line: &[u8]) -> bool {
    let is_end = |byte: &u8| matches!(byte, b'%' | b'L' | b'l' | b'M' | b'm');
    line.iter().any(is_end) || has_bound(line)
}

/// Whether a line has G70 or G79.
fn has_bound(line: &[u8]) -> bool {
    let mut words = line.split(|byte| matches!(byte, b'G' | b'g'));
    words.next();
    words.any(|word| {
        let zeros = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'0' | b'+' | 0);
        let rest = word.get(word.iter().take_while(zeros).count()..);
        rest.is_some_and(|rest| rest.starts_with(b"70") || rest.starts_with(b"79"))
    })
}

/// Some lines of a file.
struct Section {
    name: String,
    main: bool,
    lines: Vec<Range<usize>>,
}

/// What is known of a file when its lines have been looked at.
struct Outline<'a> {
    file: usize,
    stem: &'a str,
    sources: &'a Sources,
    mains: Vec<Section>,
    subprograms: Vec<Section>,
    in_subprogram: bool,
    /// The first line that belongs to the section that has begun.
    next: usize,
    /// Whether the program that stood last has an end.
    ended: bool,
}

impl Outline<'_> {
    fn section(name: &str, main: bool) -> Section {
        Section {
            name: name.to_string(),
            main,
            lines: Vec::new(),
        }
    }

    /// The lines up to `line` belong to the section that has begun; what follows begins at `next`.
    fn cut(&mut self, line: usize, next: usize) {
        let sections = match self.in_subprogram {
            true => &mut self.subprograms,
            false => &mut self.mains,
        };
        if let Some(section) = sections.last_mut() {
            section.lines.push(self.next..line);
        }
        self.next = next;
    }

    fn line(&mut self, line: usize, text: Text, diagnostics: &mut Diagnostics) {
        for one in lines(text, diagnostics) {
            let block = match one {
                Line::Program => {
                    self.cut(line, line + 1);
                    self.in_subprogram = false;
                    if self.has_content(diagnostics) {
                        self.mains.push(Self::section(self.stem, true));
                        self.ended = false;
                    }
                    continue;
                }
                Line::Block(block) => block,
            };
            if let Some(begin) = block.function('G', 79.0) {
                self.begin(&block, begin, line, diagnostics);
                continue;
            }
            let returns = block.function('G', 70.0).is_some();
            let ends = |number| block.function('M', number).is_some();
            if self.in_subprogram && returns {
                self.cut(line + 1, line + 1);
                self.in_subprogram = false;
            } else if !self.in_subprogram {
                self.ended |= returns || ends(2.0) || ends(30.0);
            }
        }
    }

    fn begin(&mut self, block: &Block, begin: &Word, line: usize, diagnostics: &mut Diagnostics) {
        self.cut(line, line + 1);
        self.check_begin(block, begin, diagnostics);
        let number = block.word('L').map_or(0.0, |word| word.value);
        let name = format!("L{number}");
        if self.subprograms.iter().any(|known| known.name == name) {
            diagnostics.push(
                Diagnostic::error(begin.span, format!("{name} is in this file twice"))
                    .help("give one of them another number"),
            );
        }
        self.subprograms.push(Self::section(&name, false));
        self.in_subprogram = true;
    }

    /// A subprogram begins with `G79 L100` alone, after the end of the program and of the subprogram
    /// before it: the control would run into it otherwise.
    fn check_begin(&self, block: &Block, begin: &Word, diagnostics: &mut Diagnostics) {
        let is_label =
            |word: &Word| word.value.fract() == 0.0 && (0.0..=999_999.0).contains(&word.value);
        let label = block.word('L').filter(|word| is_label(word));
        if label.is_none() || block.words.len() != 2 {
            diagnostics.push(
                Diagnostic::error(
                    begin.span,
                    "G79 needs the number of the subprogram, and nothing else",
                )
                .help("write G79 L100 in a block of its own"),
            );
        }
        if self.in_subprogram {
            diagnostics.push(
                Diagnostic::error(begin.span, "the subprogram before this one has no end")
                    .help("end it with G70"),
            );
            return;
        }
        if !self.ended && self.has_content(diagnostics) {
            diagnostics.push(
                Diagnostic::error(begin.span, "the program would run into this subprogram")
                    .help("end the program with M30 before its subprograms"),
            );
        }
    }

    /// Whether the program that stood last does anything.
    fn has_content(&self, diagnostics: &mut Diagnostics) -> bool {
        let ranges = self
            .mains
            .last()
            .map_or(Vec::new(), |main| main.lines.clone());
        let blocks = self.blocks(ranges);
        blocks.find(self.sources, diagnostics, says).is_some()
    }

    fn blocks(&self, ranges: Vec<Range<usize>>) -> Blocks<Block> {
        let lines = Lines {
            file: self.file,
            ranges,
            ..Lines::default()
        };
        Blocks::new(lines, parse_blocks)
    }

    fn into_routines(self, diagnostics: &mut Diagnostics) -> Vec<Routine> {
        let sections = self.subprograms.iter().chain(&self.mains);
        let routine = |section: &Section| {
            let blocks = self.blocks(section.lines.clone());
            let first = blocks.find(self.sources, diagnostics, says);
            Routine {
                name: section.name.clone(),
                main: section.main,
                file: self.file,
                blocks,
                first: first.map(|block| block.place.span),
            }
        };
        let mut routines: Vec<Routine> = sections.map(routine).collect();
        // A file of subprograms only has no program of its own. A file beside the program may be named
        // after the subprogram in it: that one is meant.
        if !self.subprograms.is_empty() {
            routines.retain(|routine| !routine.main || routine.first.is_some());
        }
        routines
    }
}

fn says(block: &Block) -> bool {
    !block.is_empty()
}

/// The programs and subprograms of a file; see [`crate::dialects::library::Read`].
pub fn routines(
    file: usize,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let mut outline = Outline {
        file,
        stem,
        sources,
        mains: vec![Outline::section(stem, true)],
        subprograms: Vec::new(),
        in_subprogram: false,
        next: 0,
        ended: false,
    };
    let notable = Notable {
        is: is_notable,
        among_plain: |_| true,
    };
    let mut visit = |line: usize, text: Text, diagnostics: &mut Diagnostics| {
        outline.line(line, text, diagnostics)
    };
    let lines = notable_lines(file, sources, diagnostics, notable, &mut visit);
    outline.cut(lines, lines);
    outline.into_routines(diagnostics)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialects::library;

    fn sources(text: &str) -> Sources {
        let mut sources = Sources::default();
        sources.add("part.nc".into(), text.into());
        sources
    }

    fn found(sources: &Sources) -> (Vec<Routine>, usize) {
        let mut diagnostics = Diagnostics::default();
        let routines = routines(0, "PART", sources, &mut diagnostics);
        for routine in &routines {
            let checked = library::Routine::check_rest(routine, sources, &mut diagnostics);
            assert!(checked.is_ok());
        }
        (routines, diagnostics.errors())
    }

    fn errors(text: &str) -> usize {
        found(&sources(text)).1
    }

    #[test]
    fn subprograms_are_cut_out_of_the_file() {
        let sources = sources(
            "%1\nN10 G71 L100 “call\nM30\n“text\nN1000 G79 L100 \"L100\"\nG01X1Y-.5\nG70\n",
        );
        let (found, errors) = found(&sources);
        assert_eq!(errors, 0);
        let names: Vec<(&str, bool, usize)> = found
            .iter()
            .map(|routine| (routine.name.as_str(), routine.main, routine.blocks.len()))
            .collect();
        assert_eq!(names, [("L100", false, 2), ("PART", true, 3)]);
        let block = |routine: usize| {
            let mut diagnostics = Diagnostics::default();
            found[routine].blocks.get(0, &sources, &mut diagnostics)
        };
        assert_eq!(block(1).and_then(|block| block.place.number), Some(10));
        let comment = block(1).and_then(|block| block.place.comment.clone());
        assert_eq!(comment.as_deref(), Some("call"));
        assert_eq!(block(0).map(|block| block.words[2].value), Some(-0.5));
    }

    #[test]
    fn programs_that_run_into_their_subprograms_are_refused() {
        assert_eq!(errors("G1 X1\nG79 L1\nG70\n"), 1);
        assert_eq!(errors("M30\nG79 L1\nG79 L2\nG70\n"), 1);
        assert_eq!(errors("M30\nG79\nG70\n"), 1);
        assert_eq!(errors("M30\nG79 L1\nG70\nG79 L1\nG70\n"), 1);
        assert_eq!(errors("M30\nG79 L1\nG70\nG79 L2\nG70\n"), 0);
    }

    #[test]
    fn one_mistake_is_one_error() {
        for text in [
            "G1 X\n",
            "G1 X1.2.3 Y\n",
            "(hello)\n",
            "G1 E3 ?\n",
            "G1 N5\n",
        ] {
            assert_eq!(errors(text), 1, "{text}");
        }
    }
}
