//! From the text of a MEFI part program to blocks, and from blocks to subprograms.

use super::syntax::{Block, Routine, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::scanner::Scanner;
use crate::source::{Sources, Span, Text};

/// Marks that begin a comment: the quotation mark of the control, and what word processors make of it.
const COMMENT: [char; 9] = ['"', '“', '”', '„', '‟', '«', '»', '″', '‶'];

/// Letters that begin a word.
const ADDRESSES: &str = "ABCDFGIJKLMNQRSTUVWXYZ";

/// The programs and subprograms of a file; see [`crate::dialects::library::Parse`].
pub fn parse(text: Text, stem: &str, _: &Sources, diagnostics: &mut Diagnostics) -> Vec<Routine> {
    let file = text.file;
    let routine = |name: String, main: bool| Routine {
        name,
        main,
        file,
        blocks: Vec::new(),
    };
    let mut mains = vec![routine(stem.to_string(), true)];
    let mut subprograms: Vec<Routine> = Vec::new();
    let mut in_subprogram = false;
    let mut reader = Reader {
        scanner: Scanner::new(text),
    };
    while reader.scanner.peek().is_some() {
        match reader.line(diagnostics) {
            Line::Program => {
                in_subprogram = false;
                if mains.last().is_some_and(has_content) {
                    mains.push(routine(stem.to_string(), true));
                }
            }
            Line::Block(block) => {
                if let Some(begin) = block.function('G', 79.0) {
                    check_begin(&block, begin, in_subprogram, &mains, diagnostics);
                    let number = block.word('L').map_or(0.0, |word| word.value);
                    let name = format!("L{number}");
                    if subprograms.iter().any(|known| known.name == name) {
                        diagnostics.push(
                            Diagnostic::error(begin.span, format!("{name} is in this file twice"))
                                .help("give one of them another number"),
                        );
                    }
                    subprograms.push(routine(name, false));
                    in_subprogram = true;
                    continue;
                }
                let ends = block.function('G', 70.0).is_some();
                let target = match in_subprogram {
                    true => subprograms.last_mut(),
                    false => mains.last_mut(),
                };
                if let Some(target) = target {
                    target.blocks.push(block);
                }
                in_subprogram &= !ends;
            }
        }
    }
    // A file of subprograms only has no program of its own. A file beside the program may be named
    // after the subprogram in it: that one is meant.
    if !subprograms.is_empty() {
        mains.retain(has_content);
    }
    subprograms.extend(mains);
    subprograms
}

fn has_content(routine: &Routine) -> bool {
    routine.blocks.iter().any(|block| !block.is_empty())
}

/// A subprogram begins with `G79 L100` alone, after the end of the program and of the subprogram
/// before it: the control would run into it otherwise.
fn check_begin(
    block: &Block,
    begin: &Word,
    in_subprogram: bool,
    mains: &[Routine],
    diagnostics: &mut Diagnostics,
) {
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
    if in_subprogram {
        diagnostics.push(
            Diagnostic::error(begin.span, "the subprogram before this one has no end")
                .help("end it with G70"),
        );
        return;
    }
    let runs_into = mains.last().is_some_and(|main| {
        let mut blocks = main.blocks.iter();
        let ended = blocks.any(|block| {
            let ends = |number| block.function('M', number).is_some();
            ends(2.0) || ends(30.0) || block.function('G', 70.0).is_some()
        });
        has_content(main) && !ended
    });
    if runs_into {
        diagnostics.push(
            Diagnostic::error(begin.span, "the program would run into this subprogram")
                .help("end the program with M30 before its subprograms"),
        );
    }
}

enum Line {
    /// `%1`: a program begins.
    Program,
    Block(Block),
}

struct Reader<'a> {
    scanner: Scanner<'a>,
}

impl Reader<'_> {
    fn line(&mut self, diagnostics: &mut Diagnostics) -> Line {
        self.blanks();
        let start = self.scanner.position();
        let empty = self.scanner.span_from(start);
        let mut block = Block {
            span: empty,
            number: None,
            skip: false,
            words: Vec::new(),
            invalid: false,
            comment: None,
        };
        if self.scanner.peek() == Some('%') {
            self.finish_line();
            return Line::Program;
        }
        block.skip = self.scanner.take("/");
        let mut end = self.scanner.position();
        loop {
            self.blanks();
            let Some(next) = self.scanner.peek().filter(|next| *next != '\n') else {
                break;
            };
            if COMMENT.contains(&next) {
                block.comment = Some(self.comment());
                break;
            }
            match self.word(next) {
                Ok(word) => add(&mut block, word, diagnostics),
                Err(diagnostic) => {
                    diagnostics.push(*diagnostic);
                    block.invalid = true;
                    self.scanner.take_while(|c| c != '\n');
                    end = self.scanner.position();
                    break;
                }
            }
            end = self.scanner.position();
        }
        self.finish_line();
        block.span = Span { end, ..empty };
        Line::Block(block)
    }

    fn finish_line(&mut self) {
        self.scanner.take_while(|c| c != '\n');
        self.scanner.take("\n");
    }

    fn blanks(&mut self) {
        // Programs that were sent over a serial line begin and end with NULs and other fillers.
        self.scanner.take_while(|c| {
            matches!(
                c,
                ' ' | '\t' | '\u{a0}' | '\0' | '\u{1a}' | '\u{11}' | '\u{13}'
            )
        });
    }

    /// The comment, without the marks at its beginning and its end.
    fn comment(&mut self) -> String {
        let text = self.scanner.take_while(|c| c != '\n');
        let mark = |c: char| COMMENT.contains(&c) || c.is_whitespace();
        text.trim_matches(mark).to_string()
    }

    fn word(&mut self, first: char) -> Result<Word, Box<Diagnostic>> {
        let start = self.scanner.position();
        let letter = first.to_ascii_uppercase();
        self.scanner.advance();
        if !ADDRESSES.contains(letter) {
            return Err(Box::new(self.unknown(start, first)));
        }
        self.blanks();
        let sign = match (self.scanner.take("-"), self.scanner.take("+")) {
            (true, _) => -1.0,
            _ => 1.0,
        };
        let number = self
            .scanner
            .decimal()
            .and_then(|text| text.parse::<f64>().ok());
        let span = self.scanner.span_from(start);
        let Some(number) = number.filter(|number| number.is_finite()) else {
            return Err(Box::new(
                Diagnostic::error(
                    span,
                    format!("the value of {letter} is missing or not a number"),
                )
                .help(format!("write {letter}10")),
            ));
        };
        if self.scanner.peek() == Some('.') {
            return Err(Box::new(Diagnostic::error(
                span,
                "a number with two decimal points",
            )));
        }
        Ok(Word {
            letter,
            value: sign * number,
            span,
        })
    }

    fn unknown(&self, start: usize, character: char) -> Diagnostic {
        let span = self.scanner.span_from(start);
        match character {
            '(' | ';' => Diagnostic::error(span, "comments do not begin like this in this dialect")
                .help("comments begin with a quotation mark: \""),
            'A'..='Z' | 'a'..='z' => {
                Diagnostic::error(span, format!("the address {character} is not supported"))
                    .help("axes are X Y Z A B C U V W")
            }
            _ => Diagnostic::error(
                span,
                format!(
                    "the character `{}` has no meaning in a part program",
                    character.escape_default()
                ),
            )
            .help("a block consists of words such as G1 or X10; comments begin with \""),
        }
    }
}

fn add(block: &mut Block, word: Word, diagnostics: &mut Diagnostics) {
    if word.letter != 'N' {
        block.words.push(word);
        return;
    }
    let whole = word.value.fract() == 0.0 && (0.0..=9_999_999.0).contains(&word.value);
    if block.number.is_some() || !block.words.is_empty() || !whole {
        diagnostics.push(Diagnostic::error(
            word.span,
            "a whole block number stands once, at the beginning of the block",
        ));
        block.invalid = true;
        return;
    }
    block.number = Some(word.value as u32);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn routines(text: &str) -> (Vec<Routine>, usize) {
        let mut sources = Sources::default();
        let mut diagnostics = Diagnostics::default();
        let file = sources.add("part.nc".into(), text.into());
        let routines = parse(sources.text(file), "PART", &sources, &mut diagnostics);
        (routines, diagnostics.errors())
    }

    #[test]
    fn subprograms_are_cut_out_of_the_file() {
        let (found, errors) = routines(
            "%1\nN10 G71 L100 “call\nM30\n“text\nN1000 G79 L100 \"L100\"\nG01X1Y-.5\nG70\n",
        );
        assert_eq!(errors, 0);
        let names: Vec<(&str, bool, usize)> = found
            .iter()
            .map(|routine| (routine.name.as_str(), routine.main, routine.blocks.len()))
            .collect();
        assert_eq!(names, [("L100", false, 2), ("PART", true, 3)]);
        assert_eq!(found[1].blocks[0].number, Some(10));
        assert_eq!(found[1].blocks[0].comment.as_deref(), Some("call"));
        assert_eq!(found[0].blocks[0].words[2].value, -0.5);
    }

    #[test]
    fn programs_that_run_into_their_subprograms_are_refused() {
        assert_eq!(routines("G1 X1\nG79 L1\nG70\n").1, 1);
        assert_eq!(routines("M30\nG79 L1\nG79 L2\nG70\n").1, 1);
        assert_eq!(routines("M30\nG79\nG70\n").1, 1);
        assert_eq!(routines("M30\nG79 L1\nG70\nG79 L1\nG70\n").1, 1);
        assert_eq!(routines("M30\nG79 L1\nG70\nG79 L2\nG70\n").1, 0);
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
            assert_eq!(routines(text).1, 1, "{text}");
        }
    }
}
