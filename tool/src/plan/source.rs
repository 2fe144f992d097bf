//! The operations of the task controller, read as they are needed: from the interpreter through the
//! canonical layer.

use super::error::PlanError;
use super::setup::Setup;
use crate::canon::{Call, CallStream, Input, stream_program};
use crate::layer::program::{Move, Operation, Piece, Shape};
use crate::layer::stream::{Laid, LayerStream};
use std::collections::{BTreeSet, VecDeque};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Millimetres (degrees): travel of an axis below it counts as none.
const NO_TRAVEL: f64 = 1e-9;

/// The share of the normal of an arc from which on an axis stands normal to its plane.
const ALONG: f64 = 1.0 - 1e-9;

/// A program that is being read.
pub struct Source<'a> {
    file: Arc<Path>,
    setup: &'a Setup,
    calls: CallStream,
    layer: LayerStream<'a>,
    waiting: VecDeque<Laid>,
    ended: bool,
    /// Moves read so far.
    pub moves: usize,
    /// The programs of the machine, M100 to M199, that were called so far.
    user_codes: BTreeSet<u32>,
    /// The inputs of the machine on which the program depends so far.
    inputs: BTreeSet<Input>,
    /// A block that begins with a slash was carried out.
    has_optional_blocks: bool,
}

impl<'a> Source<'a> {
    /// `most_time` is how long the program may take, `stop` is set when it is not wanted any more.
    ///
    /// # Errors
    /// A program that cannot be opened.
    pub fn open(
        file: &Path,
        setup: &'a Setup,
        layer: LayerStream<'a>,
        most_time: Duration,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, PlanError> {
        Ok(Source {
            file: Arc::from(file),
            setup,
            calls: stream_program(file, &setup.surroundings)?
                .within(most_time)
                .until(Arc::clone(stop)),
            layer,
            waiting: VecDeque::new(),
            ended: false,
            moves: 0,
            user_codes: BTreeSet::new(),
            inputs: BTreeSet::new(),
            has_optional_blocks: false,
        })
    }

    /// The next operation, left where it is; `None` at the end of the program.
    ///
    /// # Errors
    /// What the interpreter refuses, an axis that the machine does not have.
    pub(super) fn peek(&mut self) -> Result<Option<&Operation>, PlanError> {
        while self.waiting.is_empty() && !self.ended {
            let call = self.calls.next().transpose()?;
            self.ended = call.is_none();
            match call {
                Some(Call::UserCode(code)) => drop(self.user_codes.insert(code)),
                Some(Call::Input(input)) => drop(self.inputs.insert(input)),
                Some(Call::OptionalBlock) => self.has_optional_blocks = true,
                _ => {}
            }
            let waiting = &mut self.waiting;
            self.layer
                .take(call.as_ref(), |laid| waiting.push_back(laid));
            self.check()?;
        }
        Ok(self.waiting.front().map(|laid| &laid.operation))
    }

    /// Takes the operation that was looked at, with the pieces of a move.
    pub(super) fn take(&mut self) -> Option<(Operation, Vec<Piece>)> {
        let laid = self.waiting.pop_front()?;
        Some((laid.operation, laid.pieces))
    }

    /// The files of subroutines that were read so far.
    pub(super) fn read(&self) -> impl Iterator<Item = &Path> {
        self.calls.read().iter().map(AsRef::as_ref)
    }

    /// The file that the line of a move stands in.
    pub(super) fn file_of(&self, a_move: &Move) -> &Arc<Path> {
        let of_subroutine = a_move.tag.file.checked_sub(1);
        let of_subroutine = of_subroutine.and_then(|index| self.calls.read().get(index));
        of_subroutine.unwrap_or(&self.file)
    }

    /// What the user is to be told of the program, when it has been read.
    pub(super) fn warnings(&self) -> Vec<String> {
        let file = self.file.display();
        let mut warnings = Vec::new();
        if self.has_optional_blocks {
            warnings.push(format!(
                "{file}: blocks that begin with a slash are planned as if block delete were off; it is on when LinuxCNC starts, until \
                 a screen switches it off: --skip-blocks leaves them out"
            ));
        }
        if let Some(codes) = listed(self.user_codes.iter().map(|code| format!("M{code}"))) {
            warnings.push(format!(
                "{file}: what the programs of the machine do that it calls ({codes}) is not known here: they count as 0 s"
            ));
        }
        let (waited, looked): (Vec<&Input>, Vec<&Input>) =
            self.inputs.iter().partition(|input| input.mode != 0);
        if let Some(inputs) = listed(waited) {
            warnings.push(format!(
                "{file}: when the inputs come that it waits for ({inputs}) is not known here: each comes at once, in 0 s, and \
                 #5399 is never -1"
            ));
        }
        if let Some(inputs) = listed(looked) {
            warnings.push(format!(
                "{file}: what the inputs are that it looks at ({inputs}) is not known here: #5399 is 0"
            ));
        }
        warnings
    }

    fn check(&mut self) -> Result<(), PlanError> {
        for laid in &self.waiting {
            let Operation::Move(a_move) = &laid.operation else {
                continue;
            };
            self.moves = self.moves.max(a_move.index + 1);
            let Some(piece) = laid.pieces.last() else {
                continue;
            };
            let (start, end) = (&piece.segment.start, &piece.segment.end);
            for axis in 0..end.len() {
                let ends_elsewhere = (end[axis] - start[axis]).abs() > NO_TRAVEL;
                let travels = ends_elsewhere || is_in_plane(&a_move.shape, axis);
                let there = self.setup.axes[axis];
                if travels
                    && !there
                    && let Some(ini) = &self.setup.ini
                {
                    return Err(PlanError::NoAxis {
                        file: self.file_of(a_move).to_path_buf(),
                        line: a_move.line,
                        letter: framepath::axes::AXIS_LETTERS[axis],
                        ini: ini.clone(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// Whether an arc goes to and fro in an axis.
fn is_in_plane(shape: &Shape, axis: usize) -> bool {
    let Shape::Arc { normal, .. } = shape else {
        return false;
    };
    normal.get(axis).is_some_and(|along| along.abs() < ALONG)
}

/// The texts, parted by commas; `None` if there are none.
fn listed(texts: impl IntoIterator<Item = impl ToString>) -> Option<String> {
    let texts: Vec<String> = texts.into_iter().map(|text| text.to_string()).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}
