//! The programs and subprograms of a file.

use super::lexer::tokens;
use super::parser::{parse_blocks, section_name};
use super::structure::Structure;
use super::syntax::{Block, Flow, Statement, Target};
use super::token::SectionName;
use crate::diagnostics::Diagnostics;
use crate::dialects::blocks::{self, Blocks, Lines};
use crate::dialects::control::Place;
use crate::dialects::library;
use crate::dialects::outline::{Notable, has_word, notable_lines};
use crate::source::{Sources, Span, Text};
use std::collections::{BTreeSet, HashMap};
use std::io;
use std::ops::Range;

/// Endings of subprogram files; a subprogram file comes before a main program of the same name.
pub const EXTENSIONS: [&str; 2] = ["spf", "mpf"];

/// Words that lead elsewhere.
const FLOW: [&str; 18] = [
    "IF", "ELSE", "ENDIF", "WHILE", "ENDWHILE", "FOR", "ENDFOR", "LOOP", "ENDLOOP", "REPEAT",
    "REPEATB", "UNTIL", "GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS", "CASE",
];

/// A program or subprogram, ready to run.
#[derive(Debug)]
pub struct Routine {
    /// Its name in upper case.
    pub name: String,
    /// The file it was found in.
    pub file: usize,
    /// Its blocks.
    pub blocks: Blocks<Block>,
    /// Which blocks of it belong together.
    pub structure: Structure,
    main: bool,
    /// The first block that says something, if there is one.
    first: Option<Span>,
    labels: HashMap<String, Vec<usize>>,
}

impl Routine {
    /// Whether a block has this label.
    pub fn has_label(&self, label: &str) -> bool {
        self.labels.contains_key(label)
    }

    /// The blocks that a jump can mean, in their order.
    pub fn targets(
        &self,
        target: &Target,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Vec<usize> {
        match target {
            Target::Label(label) => self.labels.get(label).cloned().unwrap_or_default(),
            Target::Number(number) => {
                let found = self.blocks.numbered(*number, sources, diagnostics);
                found.to_vec()
            }
            // What it names is worked out before.
            Target::Text(_) => Vec::new(),
        }
    }
}

/// Whether a line begins a section, has a label, or leads elsewhere.
fn is_notable(line: &[u8]) -> bool {
    let text = String::from_utf8_lossy(line).to_ascii_uppercase();
    let code = text.split(';').next().unwrap_or("");
    code.contains(['%', ':']) || has_word(code, &FLOW)
}

/// `IF FAST` has only letters of ordinary words; every other word that leads elsewhere has more.
fn has_if(line: &[u8]) -> bool {
    // every line of a long program comes here: without an early end the compiler takes many bytes at once
    line.windows(2).fold(false, |found, two| {
        found | ((two[0] | 0x20 == b'i') & (two[1] | 0x20 == b'f'))
    })
}

/// What is known of a section when its lines have been looked at.
struct Section {
    name: SectionName,
    lines: Range<usize>,
    structure: Structure,
    labels: HashMap<String, Vec<usize>>,
    numbers: BTreeSet<u32>,
}

impl Section {
    fn new(name: SectionName, first: usize) -> Section {
        Section {
            name,
            lines: first..first,
            structure: Structure::default(),
            labels: HashMap::new(),
            numbers: BTreeSet::new(),
        }
    }

    fn add(&mut self, index: usize, block: Block) {
        if let Some(label) = block.label {
            self.labels.entry(label).or_default().push(index);
        }
        if let Statement::Flow(flow) = block.statement {
            self.structure.add(index, &flow, block.place.span);
            let numbers = targets(&flow)
                .into_iter()
                .filter_map(|target| match target {
                    Target::Number(number) => Some(*number),
                    Target::Label(_) | Target::Text(_) => None,
                });
            self.numbers.extend(numbers);
        }
    }

    fn into_routine(
        self,
        file: usize,
        stem: &str,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) -> Routine {
        let lines = Lines {
            file,
            ranges: vec![self.lines],
            targets: self.numbers,
            ..Lines::default()
        };
        let blocks = Blocks::new(lines, parse_blocks);
        let says = |block: &Block| block.statement != Statement::Empty;
        let first = blocks.find(sources, diagnostics, says);
        let mut structure = self.structure;
        structure.close(&blocks, sources, diagnostics);
        Routine {
            name: match self.name.name.is_empty() {
                true => stem.to_string(),
                false => self.name.name,
            },
            file,
            first: first.map(|block| block.place.span),
            blocks,
            structure,
            main: self.name.main,
            labels: self.labels,
        }
    }
}

/// Where a statement may lead.
fn targets(flow: &Flow) -> Vec<&Target> {
    match flow {
        Flow::JumpIf(_, jump) | Flow::Jump(jump) => vec![&jump.target],
        Flow::Case(_, cases, default) => {
            let cases = cases.iter().map(|(_, jump)| &jump.target);
            cases
                .chain(default.as_ref().map(|jump| &jump.target))
                .collect()
        }
        Flow::RepeatPart(part) => std::iter::once(&part.first).chain(&part.last).collect(),
        _ => Vec::new(),
    }
}

/// The routines of a file; see [`library::Read`]. A file without archive lines is one section without a name.
pub fn routines(
    file: usize,
    stem: &str,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Vec<Routine> {
    let unnamed = SectionName {
        name: String::new(),
        main: true,
    };
    let mut sections = vec![Section::new(unnamed, 0)];
    let notable = Notable {
        is: is_notable,
        among_plain: has_if,
    };
    let mut visit = |line: usize, text: Text, diagnostics: &mut Diagnostics| {
        let tokens = tokens(text, diagnostics);
        let Some(section) = sections.last_mut() else {
            return;
        };
        if let Some(name) = section_name(&tokens) {
            section.lines.end = line;
            sections.push(Section::new(name.clone(), line + 1));
            return;
        }
        let index = line - section.lines.start;
        let blocks = parse_blocks(text, diagnostics).into_iter();
        blocks.for_each(|block| section.add(index, block));
    };
    let lines = notable_lines(file, sources, diagnostics, notable, &mut visit);
    if let Some(last) = sections.last_mut() {
        last.lines.end = lines.max(last.lines.start);
    }
    let sections = sections.into_iter();
    let mut routines: Vec<Routine> = sections
        .map(|section| section.into_routine(file, stem, sources, diagnostics))
        .collect();
    if routines.len() > 1 && library::Routine::is_empty(&routines[0]) {
        routines.remove(0);
    }
    routines
}

impl blocks::Block for Block {
    fn place(&self) -> &Place {
        &self.place
    }

    fn is_blank(&self) -> bool {
        false
    }

    fn is_invalid(&self) -> bool {
        self.statement == Statement::Invalid
    }
}

impl library::Routine for Routine {
    fn check_rest(&self, sources: &Sources, diagnostics: &mut Diagnostics) -> io::Result<()> {
        self.blocks.check_rest(sources, diagnostics)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn is_main(&self) -> bool {
        self.main
    }

    fn is_empty(&self) -> bool {
        self.first.is_none()
    }

    fn first_span(&self) -> Span {
        self.first.unwrap_or(Span::start_of(self.file))
    }
}
