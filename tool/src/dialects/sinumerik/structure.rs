//! Which blocks of a section belong together: IF with ELSE and ENDIF, loops with their ends.

use super::syntax::{Block, Flow};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::Blocks;
use crate::source::{Sources, Span};
use std::collections::HashMap;

/// For each block that has one, the block it belongs to: IF to ELSE or ENDIF, ELSE to ENDIF, the beginning of a
/// loop to its end and the end to its beginning.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    partners: HashMap<usize, usize>,
    open: Vec<Open>,
    lost: Vec<Diagnostic>,
}

/// A beginning whose end has not come yet.
#[derive(Clone, Debug)]
struct Open {
    index: usize,
    /// The word that ends it.
    end: &'static str,
    is_else: bool,
    span: Span,
}

impl Structure {
    /// Takes the next statement of a section, which is the block with this index.
    pub fn add(&mut self, index: usize, flow: &Flow, span: Span) {
        let (begins, ends) = match flow {
            Flow::If(_) => (Some("ENDIF"), None),
            Flow::Else => (Some("ENDIF"), Some("ENDIF")),
            Flow::EndIf => (None, Some("ENDIF")),
            Flow::While(_) => (Some("ENDWHILE"), None),
            Flow::EndWhile => (None, Some("ENDWHILE")),
            Flow::For(..) => (Some("ENDFOR"), None),
            Flow::EndFor => (None, Some("ENDFOR")),
            Flow::Loop => (Some("ENDLOOP"), None),
            Flow::EndLoop => (None, Some("ENDLOOP")),
            Flow::Repeat => (Some("UNTIL"), None),
            Flow::Until(_) => (None, Some("UNTIL")),
            Flow::JumpIf(..) | Flow::Jump(_) | Flow::Case(..) | Flow::RepeatPart(_) => return,
        };
        let is_else = *flow == Flow::Else;
        if let Some(end) = ends
            && !self.end(index, end, is_else, span)
        {
            return;
        }
        if let Some(end) = begins {
            self.partners.remove(&index);
            self.open.push(Open {
                index,
                end,
                is_else,
                span,
            });
        }
    }

    /// The end of what was begun last, if that ends so.
    fn end(&mut self, index: usize, end: &str, is_else: bool, span: Span) -> bool {
        let what = match self.open.pop() {
            Some(open) if open.end == end => {
                if is_else && open.is_else {
                    self.lost.push(Diagnostic::error(span, "a second ELSE"));
                }
                self.partners.insert(open.index, index);
                self.partners.insert(index, open.index);
                return true;
            }
            Some(open) => {
                let what = format!("{} is missing before this", open.end);
                self.open.push(open);
                what
            }
            None => "the beginning that belongs to this is missing".to_string(),
        };
        self.lost.push(Diagnostic::error(span, what));
        false
    }

    /// All statements of the section have been taken: what has no partner is reported.
    pub fn close(
        &mut self,
        blocks: &Blocks<Block>,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) {
        for open in self.open.drain(..) {
            let what = format!("the {} that belongs to this is missing", open.end);
            self.lost.push(Diagnostic::error(open.span, what));
        }
        let lost = std::mem::take(&mut self.lost);
        // A block that was not understood may be the partner that seems to be missing.
        if !lost.is_empty() && !blocks.has_invalid(sources, diagnostics) {
            lost.into_iter().for_each(|one| diagnostics.push(one));
        }
    }

    /// The partner of a block.
    pub fn partner(&self, block: usize) -> Option<usize> {
        self.partners.get(&block).copied()
    }
}
