//! Which blocks of a section belong together: IF with ELSE and ENDIF, loops with their ends.

use super::syntax::{Block, Flow, Section, Statement};
use crate::diagnostics::{Diagnostic, Diagnostics};

/// For each block the block it belongs to: IF to ELSE or ENDIF, ELSE to ENDIF, the beginning of a
/// loop to its end and the end to its beginning.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Structure {
    partners: Vec<Option<usize>>,
}

impl Structure {
    /// Matches the blocks of a section; what has no partner is reported.
    pub fn of(section: &Section, diagnostics: &mut Diagnostics) -> Structure {
        let mut partners = vec![None; section.blocks.len()];
        // A block that was not understood may have been the partner that seems to be missing.
        let unclear = |block: &Block| block.statement == Statement::Invalid;
        let mut unheard = Diagnostics::default();
        let diagnostics = match section.blocks.iter().any(unclear) {
            true => &mut unheard,
            false => diagnostics,
        };
        let mut open: Vec<(usize, &'static str)> = Vec::new();
        for (index, block) in section.blocks.iter().enumerate() {
            let Statement::Flow(flow) = &block.statement else {
                continue;
            };
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
                Flow::JumpIf(..) | Flow::Jump(_) | Flow::Case(..) | Flow::RepeatPart(_) => {
                    (None, None)
                }
            };
            if let Some(end) = ends {
                match open.pop() {
                    Some((beginning, expected)) if expected == end => {
                        let second_else = *flow == Flow::Else
                            && section.blocks[beginning].statement == Statement::Flow(Flow::Else);
                        if second_else {
                            diagnostics.push(Diagnostic::error(block.span, "a second ELSE"));
                        }
                        partners[beginning] = Some(index);
                        partners[index] = Some(beginning);
                    }
                    other => {
                        diagnostics.push(Diagnostic::error(
                            block.span,
                            match other {
                                Some((_, expected)) => format!("{expected} is missing before this"),
                                None => "the beginning that belongs to this is missing".to_string(),
                            },
                        ));
                        open.extend(other);
                        continue;
                    }
                }
            }
            if let Some(end) = begins {
                partners[index] = None;
                open.push((index, end));
            }
        }
        for (index, end) in open {
            diagnostics.push(Diagnostic::error(
                section.blocks[index].span,
                format!("the {end} that belongs to this is missing"),
            ));
        }
        Structure { partners }
    }

    /// The partner of a block.
    pub fn partner(&self, block: usize) -> Option<usize> {
        self.partners.get(block).copied().flatten()
    }
}
