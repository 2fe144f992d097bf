//! Irregular pockets with islands (G66), drilled (G69, G81 to G83), roughed (G67) and finished (G68).
//!
//! `G66 D H R C F K S E`: the labels of the first and the last block of drilling (D, H), roughing (R, C),
//! finishing (F, K) and of the contours (S, E); H, C and K are left out where it is one block. Q, another program with
//! the contours, is refused. The largest contour is the pocket, the others are islands; one inside of another island
//! says nothing. Contours that cross (K of G67 and G68 says what they make) are refused. The places of the holes
//! are those where roughing plunges. Behind the cycle G0, G40 and G90 are in force. (Fagor, CNC 8055 Programming
//! Manual, "Irregular pocket canned cycle", 2D pockets.)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::pocket_contours::Contours;
use super::pocket_operations::Milling;
use super::routine::Routine;
use super::syntax::{Block, Label, Statement, Word};
use crate::diagnostics::Diagnostic;
use crate::dialects::clearing::Cut;
use crate::dialects::clearing::arrange::{Arranged, arrange};
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::run::Next;
use crate::source::Span;
use std::rc::Rc;

/// A block with its words, evaluated.
pub struct WordsBlock {
    /// The block.
    pub block: Rc<Block>,
    /// Its words.
    pub words: BlockWords,
}

/// The blocks of one operation.
pub struct Operation {
    /// All of them, in their order.
    pub blocks: Vec<WordsBlock>,
    /// The index of the one with the G function.
    pub main: usize,
}

/// The words of G66.
struct Labels {
    span: Span,
    list: Vec<(char, Label)>,
}

/// A pocket that is about to be made; machine units.
pub struct IrregularPocket {
    /// G66.
    pub span: Span,
    /// Where the tool is above the plane before and behind each operation.
    pub start: f64,
    /// Its contours.
    pub contours: Contours,
    /// Which of them is what.
    pub arranged: Arranged,
}

impl Labels {
    fn take(&self, letter: char) -> Option<Label> {
        let mut list = self.list.iter();
        list.find(|(found, _)| *found == letter)
            .map(|(_, label)| *label)
    }

    /// First and last block of an operation.
    fn range(&self, first: char, last: char) -> Result<Option<[Label; 2]>, Diagnostic> {
        match (self.take(first), self.take(last)) {
            (Some(first), last) => Ok(Some([first, last.unwrap_or(first)])),
            (None, None) => Ok(None),
            (None, Some(label)) => Err(Diagnostic::error(
                label.span,
                format!("G66 has the last block {last} and not the first one, {first}"),
            )
            .help(format!("write {first} with the number of the first block"))),
        }
    }
}

impl Interpreter<'_> {
    /// A block with G66.
    pub(super) fn irregular_pocket(
        &mut self,
        words: &[Word],
        routine: &Rc<Routine>,
        block: &Block,
        at: usize,
    ) -> Next {
        self.control.begin_cycle();
        let done = self.make_pocket(words, routine, block, at);
        if let Err(diagnostic) = done {
            self.control.fail(diagnostic);
        }
        self.control.end_cycle();
        self.control.finish_marker(&block.place);
        Next::Block(at + 1)
    }

    fn make_pocket(
        &mut self,
        words: &[Word],
        routine: &Rc<Routine>,
        block: &Block,
        at: usize,
    ) -> Done {
        let labels = self.labels(words)?;
        let span = labels.span;
        self.refuse_in_pocket_state(span)?;
        let [_, _, normal] = self.control.modal.plane.axes();
        let start = self.control.modal.position.get(normal).ok_or_else(|| {
            Diagnostic::unknown_place(
                span,
                "a pocket, and where the tool is above the plane is not known ahead of time",
            )
            .help("program the axis of the tool absolute before G66")
        })?;
        let geometry = labels
            .range('S', 'E')?
            .filter(|_| labels.take('E').is_some());
        let Some(geometry) = geometry else {
            return Err(
                Diagnostic::error(span, "G66 needs S and E, the contours of the pocket")
                    .help("write G66 R200 F300 S400 E500: the contours stand from N400 to N500"),
            );
        };
        let mut operation = |first, last| match labels.range(first, last)? {
            Some(range) => self.operation(routine, range, at, first).map(Some),
            None => Ok(None),
        };
        let drilling = operation('D', 'H')?;
        let roughing = operation('R', 'C')?;
        let finishing = operation('F', 'K')?;
        let blocks = self.words_between(routine, geometry, at)?;
        let contours = self.read_contours(&blocks)?;
        let pocket = self.arrange_pocket(contours, span, start)?;
        self.control.finish_block(&block.place);
        self.make_parts(&pocket, [drilling, roughing, finishing])
    }

    /// Drilling, roughing and finishing, as far as they are there.
    fn make_parts(&mut self, pocket: &IrregularPocket, parts: [Option<Operation>; 3]) -> Done {
        let [drilling, roughing, finishing] = parts;
        let factor = self.control.modal.length_factor;
        let rough = roughing
            .map(|operation| Milling::rough(operation, factor))
            .transpose()?;
        let depths = rough.as_ref().map(|rough| rough.depths);
        let finish = finishing
            .map(|operation| Milling::finish(operation, depths, factor))
            .transpose()?;
        if rough.is_none() && finish.is_none() {
            return Err(
                Diagnostic::error(pocket.span, "G66 has neither roughing nor finishing")
                    .help("write R with the block of G67, F with the block of G68, or both"),
            );
        }
        let allowance = finish.as_ref().map_or(0.0, |finish| finish.allowance);
        if let Some(rough) = &rough {
            let Some((radius, cuts)) = self.rough_cuts(pocket, rough, allowance)? else {
                return Ok(());
            };
            if let Some(drilling) = &drilling {
                self.drill_places(pocket, drilling, &cuts)?;
            }
            self.mill_rough(pocket, rough, radius, &cuts)?;
        } else if let Some(drilling) = &drilling {
            let span = drilling.blocks[drilling.main].block.place.span;
            return Err(
                Diagnostic::error(span, "holes for a pocket that is not roughed")
                    .help("the holes lie where roughing plunges: add R to G66, or leave D out"),
            );
        }
        if let Some(finish) = &finish {
            self.mill_finish(pocket, finish)?;
        }
        self.control.modal.motion = Some(Motion::Rapid);
        self.thread = None;
        self.control.modal.incremental = false;
        Ok(())
    }

    fn arrange_pocket(
        &mut self,
        contours: Contours,
        span: Span,
        start: f64,
    ) -> Result<IrregularPocket, Diagnostic> {
        let lines: Vec<_> = contours.list.iter().map(|one| one.line.clone()).collect();
        let arranged = arrange(&lines).map_err(|fault| contours.error(fault))?;
        for hidden in &arranged.hidden {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    contours.list[*hidden].span,
                    "this contour lies inside of an island and says nothing",
                )
                .help("leave it out"),
            );
        }
        Ok(IrregularPocket {
            span,
            start,
            contours,
            arranged,
        })
    }

    /// The words of G66, each with the number of a block.
    fn labels(&mut self, words: &[Word]) -> Result<Labels, Diagnostic> {
        let mut labels = Labels {
            span: words[0].span,
            list: Vec::new(),
        };
        for word in words {
            let Some(value) = &word.value else {
                return Err(super::block_words::missing(word.letter, word.span));
            };
            let number = value.whole(&self.parameters, 0)?;
            let span = word.span;
            match word.letter {
                'G' if number == 66 => labels.span = span,
                'Q' => {
                    return Err(Diagnostic::error(
                        span,
                        "the contours of a pocket in another program are not supported",
                    )
                    .help("put the blocks from S to E into this program and leave Q out"));
                }
                'D' | 'H' | 'R' | 'C' | 'F' | 'K' | 'S' | 'E'
                    if labels.take(word.letter).is_none() =>
                {
                    labels.list.push((word.letter, Label { number, span }));
                }
                letter => {
                    return Err(Diagnostic::error(
                        span,
                        format!("the address {letter} does not belong here, beside G66"),
                    )
                    .help("G66 has one D, H, R, C, F, K, S and E, and stands alone otherwise"));
                }
            }
        }
        Ok(labels)
    }

    /// G66 needs a control that does nothing else at the time.
    fn refuse_in_pocket_state(&self, span: Span) -> Done {
        self.control.refuse_compensation(span, "a pocket")?;
        if self.cycle.is_some() {
            return Err(
                Diagnostic::error(span, "G66 while a canned cycle is in force")
                    .help("end the cycle with G80 before"),
            );
        }
        if self.modal_call.is_some() {
            return Err(
                Diagnostic::error(span, "G66 while a modal subroutine is in force")
                    .help("end it with (MDOFF) before"),
            );
        }
        Ok(())
    }

    /// The blocks of an operation, of which `letter` names the first.
    fn operation(
        &mut self,
        routine: &Routine,
        range: [Label; 2],
        at: usize,
        letter: char,
    ) -> Result<Operation, Diagnostic> {
        let (codes, name): (&[u32], &str) = match letter {
            'D' => (&[69, 81, 82, 83], "G69, G81, G82 or G83"),
            'R' => (&[67], "G67"),
            _ => (&[68], "G68"),
        };
        let blocks = self.words_between(routine, range, at)?;
        let is_main = |block: &WordsBlock| block.words.g.iter().any(|g| codes.contains(&g.value));
        let mut found = (0..blocks.len()).filter(|index| is_main(&blocks[*index]));
        let main = found.next();
        if let Some(second) = found.next() {
            return Err(Diagnostic::error(
                blocks[second].block.place.span,
                format!("a second {name} in one operation of G66"),
            )
            .help("two passes, and the semi-finishing of 3D pockets, are not supported"));
        }
        match main {
            Some(main) => Ok(Operation { blocks, main }),
            None => Err(Diagnostic::error(
                range[0].span,
                format!("{name} does not stand in the blocks that {letter} of G66 names"),
            )
            .help(format!("name the block with {name}"))),
        }
    }

    /// The blocks with words from one label to another.
    fn words_between(
        &mut self,
        routine: &Routine,
        labels: [Label; 2],
        at: usize,
    ) -> Result<Vec<WordsBlock>, Diagnostic> {
        let [first, last] = labels.map(|label| self.find_label(routine, label, at));
        let (first, last) = (first?, last?);
        if last < first {
            return Err(Diagnostic::error(
                labels[1].span,
                "the last block stands before the first one",
            )
            .help("name the block first that comes first"));
        }
        let mut blocks = Vec::new();
        for at in first..=last {
            let Some(block) = self.control.block(&routine.blocks, at) else {
                continue;
            };
            if block.skip && self.control.settings.skip_blocks {
                continue;
            }
            if !self.control.count_block(block.place.span) {
                break;
            }
            let words = match &block.statement {
                Statement::Empty | Statement::Invalid => continue,
                Statement::Words(words) => words,
                _ => {
                    return Err(Diagnostic::error(
                        block.place.span,
                        "a statement in parentheses inside of a pocket",
                    )
                    .help(
                        "the blocks that G66 names have no loops, calls and parameters to assign",
                    ));
                }
            };
            let words = BlockWords::collect(words, &self.parameters, self.control.diagnostics);
            if let Some(words) = words {
                blocks.push(WordsBlock { block, words });
            }
        }
        Ok(blocks)
    }

    /// Drills where the ways of roughing begin.
    fn drill_places(
        &mut self,
        pocket: &IrregularPocket,
        drilling: &Operation,
        cuts: &[Cut],
    ) -> Done {
        for (index, WordsBlock { block, words }) in drilling.blocks.iter().enumerate() {
            let span = block.place.span;
            if index != drilling.main {
                self.run_tool_words(words, span)?;
                self.control.finish_block(&block.place);
                continue;
            }
            let [first, second, _] = self.control.modal.plane.axes();
            let (tool, cycle) = split_drilling(words, [first, second], span)?;
            self.run_tool_words(&tool, span)?;
            for (number, cut) in cuts.iter().enumerate() {
                self.above(pocket, cut.start, span)?;
                match number {
                    0 => self.run_words(&cycle, span).map(|_| ())?,
                    _ => self.run_cycle()?,
                }
            }
            self.end_cycle();
            self.normal_way(pocket.start, Motion::Rapid, span)?;
            self.control.finish_block(&block.place);
        }
        Ok(())
    }

    /// In rapid motion above a place of the plane.
    pub(super) fn above(&mut self, pocket: &IrregularPocket, place: [f64; 2], span: Span) -> Done {
        self.normal_way(pocket.start, Motion::Rapid, span)?;
        self.plane_way(place, Motion::Rapid, None, span)
    }

    /// T, D, M, S and F of an operation.
    pub(super) fn run_tool_words(&mut self, words: &BlockWords, span: Span) -> Done {
        let mut rest = words.clone();
        rest.g.retain(|g| !matches!(g.value, 43 | 44));
        rest.m.retain(|m| !matches!(m.value, 0..=2 | 30));
        let ends = rest.m.len() != words.m.len();
        rest.m.clear();
        (rest.tool, rest.offset, rest.speed, rest.feed) = (None, None, None, None);
        if ends || rest != BlockWords::default() {
            return Err(Diagnostic::error(span, "a word that does not belong to this operation")
                .help("beside the words of G67, G68 or the holes there are T, D, S, F, M, G43 and G44"));
        }
        self.run_words(words, span).map(|_| ())
    }
}

/// The block of drilling, as what changes the tool and as the cycle.
fn split_drilling(
    words: &BlockWords,
    plane: [usize; 2],
    span: Span,
) -> Result<(BlockWords, BlockWords), Diagnostic> {
    let mut cycle = words.clone();
    if plane.iter().any(|axis| words.axes[*axis].is_some()) || words.angle.is_some() {
        return Err(
            Diagnostic::error(span, "a place beside the holes of a pocket")
                .help("leave it out: the holes lie where roughing plunges"),
        );
    }
    let has_own_d = words.g.iter().any(|g| g.value == 69);
    let mut tool = BlockWords::default();
    tool.m = std::mem::take(&mut cycle.m);
    tool.tool = cycle.tool.take();
    tool.speed = cycle.speed.take();
    tool.feed = cycle.feed.take();
    // D of G69 is the way from the reference plane to the surface.
    tool.offset = cycle.offset.take_if(|_| !has_own_d);
    Ok((tool, cycle))
}
