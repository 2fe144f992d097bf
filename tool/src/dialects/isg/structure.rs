//! Which control statements belong together.

use super::syntax::{Block, Flow};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::blocks::Blocks;
use crate::source::{Sources, Span};
use std::collections::HashMap;

/// For each block with a control statement, the blocks that belong to it.
#[derive(Debug, Default)]
pub struct Structure {
    links: HashMap<usize, Links>,
    open: Vec<Open>,
    lost: Vec<Diagnostic>,
}

/// Indices of blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Links {
    /// The first statement: `$FOR` of an `$ENDFOR`. Of `$BREAK` and `$CONTINUE`, of what they leave.
    pub first: Option<usize>,
    /// The next branch: `$ELSE` of an `$IF`, the first `$CASE` of a `$SWITCH`.
    pub next: Option<usize>,
    /// The last statement: `$ENDIF` of an `$IF`.
    pub last: Option<usize>,
}

/// The kinds of constructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    If,
    For,
    While,
    Do,
    Repeat,
    Switch,
}

impl Kind {
    fn end(self) -> &'static str {
        match self {
            Kind::If => "$ENDIF",
            Kind::For => "$ENDFOR",
            Kind::While => "$ENDWHILE",
            Kind::Do => "$ENDDO",
            Kind::Repeat => "$UNTIL",
            Kind::Switch => "$ENDSWITCH",
        }
    }
}

/// What a statement does to the constructions that are open.
enum Role {
    Begins(Kind),
    Branches(Kind),
    Ends(Kind),
    LeavesLoopOrSwitch,
    LeavesLoop,
    None,
}

fn role(flow: &Flow) -> Role {
    match flow {
        Flow::If(_) => Role::Begins(Kind::If),
        Flow::For(..) => Role::Begins(Kind::For),
        Flow::While(_) => Role::Begins(Kind::While),
        Flow::Do => Role::Begins(Kind::Do),
        Flow::Repeat => Role::Begins(Kind::Repeat),
        Flow::Switch(_) => Role::Begins(Kind::Switch),
        Flow::ElseIf(_) | Flow::Else => Role::Branches(Kind::If),
        Flow::Case(_) | Flow::Default => Role::Branches(Kind::Switch),
        Flow::EndIf => Role::Ends(Kind::If),
        Flow::EndFor => Role::Ends(Kind::For),
        Flow::EndWhile => Role::Ends(Kind::While),
        Flow::EndDo(_) => Role::Ends(Kind::Do),
        Flow::Until(_) => Role::Ends(Kind::Repeat),
        Flow::EndSwitch => Role::Ends(Kind::Switch),
        Flow::Break => Role::LeavesLoopOrSwitch,
        Flow::Continue => Role::LeavesLoop,
        Flow::JumpIf(..) | Flow::Jump(_) => Role::None,
    }
}

/// A construction whose end has not come yet.
#[derive(Debug)]
struct Open {
    kind: Kind,
    span: Span,
    branches: Vec<usize>,
    leaving: Vec<usize>,
}

impl Structure {
    /// Takes the next statement of a routine, which is the block with this index.
    pub fn add(&mut self, index: usize, flow: &Flow, span: Span) {
        let missing = |kind: Kind| format!("{} is missing before this", kind.end());
        let lost = match role(flow) {
            Role::None => None,
            Role::Begins(kind) => {
                self.open.push(Open {
                    kind,
                    span,
                    branches: vec![index],
                    leaving: Vec::new(),
                });
                None
            }
            Role::Branches(kind) => match self.open.last_mut() {
                Some(top) if top.kind == kind => {
                    top.branches.push(index);
                    None
                }
                Some(top) => Some(missing(top.kind)),
                None => Some("the beginning that belongs to this is missing".to_string()),
            },
            Role::Ends(kind) => match self.open.pop() {
                Some(top) if top.kind == kind => {
                    connect(&mut self.links, &top, index);
                    None
                }
                Some(top) => {
                    let what = missing(top.kind);
                    self.open.push(top);
                    Some(what)
                }
                None => Some("the beginning that belongs to this is missing".to_string()),
            },
            Role::LeavesLoopOrSwitch => match self.leave(|kind| kind != Kind::If, index) {
                true => None,
                false => Some("$BREAK outside of a loop and a $SWITCH".to_string()),
            },
            Role::LeavesLoop => {
                let is_loop = |kind| !matches!(kind, Kind::If | Kind::Switch);
                match self.leave(is_loop, index) {
                    true => None,
                    false => Some("$CONTINUE outside of a loop".to_string()),
                }
            }
        };
        let lost = lost.map(|what| Diagnostic::error(span, what));
        self.lost.extend(lost);
    }

    /// A statement leaves the innermost construction of such a kind, if there is one.
    fn leave(&mut self, is: impl Fn(Kind) -> bool, index: usize) -> bool {
        let mut open = self.open.iter_mut().rev();
        let left = open.find(|open| is(open.kind));
        left.map(|left| left.leaving.push(index)).is_some()
    }

    /// All statements have been taken: partners that are missing are reported. Where a block was not understood,
    /// it may be the partner: then nothing is said.
    pub fn close(
        &mut self,
        blocks: &Blocks<Block>,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
    ) {
        for rest in self.open.drain(..) {
            let what = format!("the {} that belongs to this is missing", rest.kind.end());
            self.lost.push(Diagnostic::error(rest.span, what));
        }
        let lost = std::mem::take(&mut self.lost);
        if !lost.is_empty() && !blocks.has_invalid(sources, diagnostics) {
            lost.into_iter().for_each(|one| diagnostics.push(one));
        }
    }

    /// The blocks that belong to a control statement.
    pub fn links(&self, block: usize) -> Links {
        self.links.get(&block).copied().unwrap_or_default()
    }
}

fn connect(links: &mut HashMap<usize, Links>, open: &Open, end: usize) {
    let first = open.branches.first().copied();
    let next = open.branches.iter().skip(1).copied().chain([end]);
    for (&branch, next) in open.branches.iter().zip(next) {
        links.insert(
            branch,
            Links {
                first,
                next: Some(next),
                last: Some(end),
            },
        );
    }
    for &index in open.leaving.iter().chain([&end]) {
        links.insert(
            index,
            Links {
                first,
                next: None,
                last: Some(end),
            },
        );
    }
}
