//! Which control statements belong together.

use super::syntax::{Block, Flow, Statement};
use crate::diagnostics::{Diagnostic, Diagnostics};

/// For each block with a control statement, the blocks that belong to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Structure {
    links: Vec<Links>,
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
struct Open {
    kind: Kind,
    branches: Vec<usize>,
    leaving: Vec<usize>,
}

impl Structure {
    /// Looks for all partners; reports those that are missing. Where a block was not understood, it may
    /// be the partner: then nothing is said.
    pub fn of(blocks: &[Block], diagnostics: &mut Diagnostics) -> Structure {
        let invalid = |block: &Block| block.statement == Statement::Invalid;
        let mut unheard = Diagnostics::default();
        let diagnostics = match blocks.iter().any(invalid) {
            true => &mut unheard,
            false => diagnostics,
        };
        let mut links = vec![Links::default(); blocks.len()];
        let mut open: Vec<Open> = Vec::new();
        for (index, block) in blocks.iter().enumerate() {
            let Statement::Flow(flow) = &block.statement else {
                continue;
            };
            let mut lost = |what: String| diagnostics.push(Diagnostic::error(block.span, what));
            match role(flow) {
                Role::None => {}
                Role::Begins(kind) => open.push(Open {
                    kind,
                    branches: vec![index],
                    leaving: Vec::new(),
                }),
                Role::Branches(kind) => match open.last_mut() {
                    Some(top) if top.kind == kind => top.branches.push(index),
                    Some(top) => lost(format!("{} is missing before this", top.kind.end())),
                    None => lost("the beginning that belongs to this is missing".to_string()),
                },
                Role::Ends(kind) => match open.pop() {
                    Some(top) if top.kind == kind => connect(&mut links, &top, index),
                    Some(top) => {
                        lost(format!("{} is missing before this", top.kind.end()));
                        open.push(top);
                    }
                    None => lost("the beginning that belongs to this is missing".to_string()),
                },
                Role::LeavesLoopOrSwitch => {
                    let left = open.iter_mut().rev().find(|open| open.kind != Kind::If);
                    match left {
                        Some(left) => left.leaving.push(index),
                        None => lost("$BREAK outside of a loop and a $SWITCH".to_string()),
                    }
                }
                Role::LeavesLoop => {
                    let is_loop = |open: &&mut Open| !matches!(open.kind, Kind::If | Kind::Switch);
                    match open.iter_mut().rev().find(is_loop) {
                        Some(left) => left.leaving.push(index),
                        None => lost("$CONTINUE outside of a loop".to_string()),
                    }
                }
            }
        }
        for rest in open {
            if let Some(block) = rest.branches.first().and_then(|first| blocks.get(*first)) {
                diagnostics.push(Diagnostic::error(
                    block.span,
                    format!("the {} that belongs to this is missing", rest.kind.end()),
                ));
            }
        }
        Structure { links }
    }

    /// The blocks that belong to a control statement.
    pub fn links(&self, block: usize) -> Links {
        self.links.get(block).copied().unwrap_or_default()
    }
}

fn connect(links: &mut [Links], open: &Open, end: usize) {
    let first = open.branches.first().copied();
    let next = open.branches.iter().skip(1).copied().chain([end]);
    for (&branch, next) in open.branches.iter().zip(next) {
        links[branch] = Links {
            first,
            next: Some(next),
            last: Some(end),
        };
    }
    for &index in open.leaving.iter().chain([&end]) {
        links[index] = Links {
            first,
            next: None,
            last: Some(end),
        };
    }
}
