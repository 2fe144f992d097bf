//! Roundings and chamfers between two motions: moves that ask for a [`Corner`] are shortened, and the
//! arc or the line between them is added.

use super::fillet::{Element, Joint, JointError, chamfer_from, chamfer_of, enter, leave, round};
use super::moves::{Arc, Centre, Coordinate, Corner, Move, MoveKind};
use super::{Action, Block, Compensation, FeedMode, Plane};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Span;

/// The place of an action: its block and its index there.
type Place = [usize; 2];

/// Puts roundings and chamfers into blocks that come one after the other. A corner can be made when the
/// motion behind it is there: blocks wait that long.
#[derive(Debug)]
pub struct Corners {
    waiting: Vec<Block>,
    /// How many of the waiting blocks have been looked at.
    seen: usize,
    /// The motion that asks for a corner.
    open: Option<Place>,
    plane: Plane,
    /// F is the time of a whole motion (G93), and not that of its parts.
    inverse_time: bool,
}

impl Default for Corners {
    fn default() -> Self {
        Corners {
            waiting: Vec::new(),
            seen: 0,
            open: None,
            plane: Plane::Xy,
            inverse_time: false,
        }
    }
}

impl Corners {
    /// The next block of the program.
    pub fn push(&mut self, block: Block) {
        self.waiting.push(block);
    }

    /// How many blocks wait.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// The blocks that are finished. A corner that cannot be made is reported at the motion that asks
    /// for it.
    pub fn take_finished(&mut self, diagnostics: &mut Diagnostics) -> Vec<Block> {
        while self.seen < self.waiting.len() {
            self.look_at(self.seen, diagnostics);
            self.seen += 1;
        }
        let Some([first, _]) = &mut self.open else {
            self.seen = 0;
            return std::mem::take(&mut self.waiting);
        };
        if *first == 0 {
            return Vec::new();
        }
        let waiting = self.waiting.split_off(*first);
        *first = 0;
        self.seen = waiting.len();
        std::mem::replace(&mut self.waiting, waiting)
    }

    /// The last blocks, at the end of the program.
    pub fn take_rest(&mut self, diagnostics: &mut Diagnostics) -> Vec<Block> {
        let mut finished = self.take_finished(diagnostics);
        let within = self.rounds_within();
        if let Some([block, _]) = self.open.take().filter(|_| !within) {
            let span = self.waiting[block].origin.span;
            diagnostics.push(Diagnostic::error(
                span,
                "no motion follows that the corner could be made with",
            ));
        }
        finished.append(&mut self.waiting);
        self.seen = 0;
        finished
    }

    /// The corner that is open.
    fn open_corner(&self) -> Option<Corner> {
        let [block, index] = self.open?;
        match self.waiting.get(block)?.actions.get(index)? {
            Action::Move(motion) => motion.corner,
            _ => None,
        }
    }

    /// Whether the open corner is a tangential exit.
    fn leaves_contour(&self) -> bool {
        matches!(self.open_corner(), Some(Corner::TangentialExit(_)))
    }

    /// Whether the open corner is made within a contour only.
    fn rounds_within(&self) -> bool {
        matches!(self.open_corner(), Some(Corner::RoundWithin(_)))
    }

    fn look_at(&mut self, block: usize, diagnostics: &mut Diagnostics) {
        let mut index = 0;
        while let Some(action) = self.waiting[block].actions.get_mut(index) {
            // A place that is said again is no corner of a modal rounding.
            if let Action::Move(motion) = action
                && goes_nowhere(motion)
                && motion.corner.is_none_or(is_within)
            {
                motion.corner = None;
                if self.rounds_within() {
                    // The joint of the corner comes in its place.
                    self.waiting[block].actions.remove(index);
                    continue;
                }
            }
            let action = &self.waiting[block].actions[index];
            // The contour ends with the plane and with the program.
            let ends_contour = match action {
                Action::Plane(next) => std::mem::replace(&mut self.plane, *next) != *next,
                Action::End { .. } => true,
                _ => false,
            };
            if let Action::FeedMode(mode) = action {
                self.inverse_time = *mode == FeedMode::InverseTime;
            }
            let is_move = matches!(action, Action::Move(_));
            let ends = self.open.is_some() && !is_move && {
                // A tangential exit leads to the line on which the compensation ends.
                let leaves = matches!(action, Action::Compensation(Compensation::Off))
                    && self.leaves_contour();
                interrupts(action) && !leaves
            };
            let has_corner = matches!(action, Action::Move(motion) if motion.corner.is_some());
            let within = self.rounds_within();
            if ends
                && let Some(first) = self.open.take()
                && !(within && ends_contour)
            {
                let span = self.waiting[first[0]].origin.span;
                let help = match within {
                    true => {
                        "the next motion must follow in the same plane and frame: end the rounding before (RNDM=0)"
                    }
                    false => "the next motion must follow in the same plane and frame",
                };
                diagnostics.push(
                    Diagnostic::error(span, "no motion follows that the corner could be made with")
                        .help(help),
                );
            }
            if is_move {
                if let Some(first) = self.open.take() {
                    let second = [block, index];
                    let span = self.waiting[first[0]].origin.span;
                    let (blocks, timed) = (&mut self.waiting, self.inverse_time);
                    match join(blocks, first, second, self.plane, timed, span) {
                        Err(diagnostic) => diagnostics.push(diagnostic),
                        // The joint stands in the block of the first motion, which may be this one.
                        Ok(true) if first[0] == block => index += 1,
                        Ok(_) => {}
                    }
                }
                self.open = has_corner.then_some([block, index]);
            }
            index += 1;
        }
    }
}

/// Whether coordinates before and after an action do not belong together.
fn interrupts(action: &Action) -> bool {
    !matches!(
        action,
        Action::Feed(_)
            | Action::SpindleSpeed(_)
            | Action::SurfaceSpeed(_)
            | Action::Spindle(_)
            | Action::Orient(..)
            | Action::Overrides(_)
            | Action::Coolant(_)
            | Action::Message(_)
            | Action::PathControl(_)
            | Action::OtherM(_)
            | Action::Enter { .. }
            | Action::Leave { .. }
    )
}

/// Makes the corner between two moves; whether a joint was added.
fn join(
    blocks: &mut [Block],
    first_place: Place,
    second_place: Place,
    plane: Plane,
    inverse_time: bool,
    span: Span,
) -> Result<bool, Diagnostic> {
    let (Some(first), Some(second)) = (
        move_at(blocks, first_place).cloned(),
        move_at(blocks, second_place).cloned(),
    ) else {
        return Ok(false);
    };
    let Some(corner) = first.corner else {
        return Ok(false);
    };
    let within = matches!(corner, Corner::RoundWithin(_));
    if within
        && [&first, &second]
            .iter()
            .any(|motion| leaves_plane(motion, plane))
    {
        if let Some(motion) = move_at(blocks, first_place) {
            motion.corner = None;
        }
        return Ok(false);
    }
    if inverse_time {
        return Err(timed_corner(span));
    }
    // The arc of an exit is over where the tool hurries away.
    let exit = matches!(corner, Corner::TangentialExit(_));
    let elements = [(&first, false), (&second, exit)];
    let [a, b] = elements.map(|(motion, may_be_rapid)| element(motion, plane, may_be_rapid));
    let a = a.map_err(|unfit| unfit_error(unfit, "this motion", within, span))?;
    let b = b.map_err(|unfit| unfit_error(unfit, "the motion behind it", within, span))?;
    let joint = match corner {
        Corner::Round(radius) | Corner::RoundWithin(radius) => round(&a, &b, radius),
        Corner::ChamferFrom(distance) => chamfer_from(&a, &b, distance),
        Corner::ChamferOf(length) => chamfer_of(&a, &b, length),
        Corner::TangentialEntry(radius) => enter(&a, &b, radius).map(Some),
        Corner::TangentialExit(radius) => leave(&a, &b, radius).map(Some),
    };
    let joint = joint.map_err(|error| joint_error(error, span))?;
    if let Some(motion) = move_at(blocks, first_place) {
        motion.corner = None;
    }
    let Some(joint) = joint else {
        return Ok(false);
    };
    if let Some(motion) = move_at(blocks, second_place) {
        begin_at(motion, &b, &joint, plane);
    }
    if let Some(motion) = move_at(blocks, first_place) {
        end_at(motion, joint.start, plane);
    }
    let mut between = joint_move(&first, &joint, plane);
    // Where every motion ends at rest, this one does too.
    between.exact_stop = first.exact_stop && second.exact_stop;
    let [block, index] = first_place;
    blocks[block]
        .actions
        .insert(index + 1, Action::Move(between));
    Ok(true)
}

fn move_at(blocks: &mut [Block], [block, index]: Place) -> Option<&mut Move> {
    match blocks.get_mut(block)?.actions.get_mut(index)? {
        Action::Move(motion) => Some(motion),
        _ => None,
    }
}

/// Whether a move is known to be none with feed in the plane.
fn leaves_plane(motion: &Move, plane: Plane) -> bool {
    let [_, _, normal] = plane.axes();
    let moves = |axis: usize| match motion.target[axis] {
        Coordinate::Keep => false,
        Coordinate::By(step) => step != 0.0,
        Coordinate::At(end) => motion.start[axis].is_some_and(|start| start != end),
    };
    let with_feed = matches!(motion.kind, MoveKind::Line | MoveKind::Arc(_));
    !with_feed || moves(normal) || (3..9).any(moves)
}

/// Whether a corner is made within a contour only.
fn is_within(corner: Corner) -> bool {
    matches!(corner, Corner::RoundWithin(_))
}

/// Whether a move is known to be a line without length.
fn goes_nowhere(motion: &Move) -> bool {
    let stays = |(axis, target): (usize, &Coordinate)| match *target {
        Coordinate::Keep => true,
        Coordinate::By(step) => step == 0.0,
        Coordinate::At(end) => motion.start[axis] == Some(end),
    };
    motion.kind == MoveKind::Line && motion.target.iter().enumerate().all(stays)
}

/// Why a motion has no part in a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unfit {
    /// It is rapid.
    Rapid,
    /// It goes in coordinates of the machine, or in step with the spindle.
    OtherKind,
    /// Another axis moves, or may move.
    LeavesPlane,
    /// Where it begins or ends is not known.
    Unknown,
    /// It goes nowhere.
    Nowhere,
    /// It makes more turns than one.
    Turns,
}

/// A move as a motion of the plane.
fn element(motion: &Move, plane: Plane, may_be_rapid: bool) -> Result<Element, Unfit> {
    let [first, second, normal] = plane.axes();
    let known = |place: Option<f64>| place.ok_or(Unfit::Unknown);
    let start = || Ok([known(motion.start[first])?, known(motion.start[second])?]);
    let arc = match &motion.kind {
        MoveKind::Line => None,
        MoveKind::Rapid if may_be_rapid => None,
        MoveKind::Rapid => return Err(Unfit::Rapid),
        MoveKind::Arc(Arc { extra_turns, .. }) if *extra_turns != 0 => return Err(Unfit::Turns),
        MoveKind::Arc(Arc {
            clockwise,
            centre: Centre::Offset(offset),
            ..
        }) => {
            let [x, y] = start()?;
            Some(([x + offset[0], y + offset[1]], *clockwise))
        }
        MoveKind::Arc(_) => return Err(Unfit::Unknown),
        _ => return Err(Unfit::OtherKind),
    };
    let stays = |axis: usize| match motion.target[axis] {
        Coordinate::Keep => true,
        _ => motion.start[axis].is_some() && motion.start[axis] == motion.end(axis),
    };
    if !stays(normal) || !(3..9).all(stays) {
        return Err(Unfit::LeavesPlane);
    }
    let start = start()?;
    let end = [known(motion.end(first))?, known(motion.end(second))?];
    match arc.is_some() || start != end {
        true => Ok(Element { start, end, arc }),
        false => Err(Unfit::Nowhere),
    }
}

/// The error of a corner that one of its motions has no part in: this one, or that behind it.
fn unfit_error(unfit: Unfit, which: &str, within: bool, span: Span) -> Diagnostic {
    let (what, help) = match unfit {
        Unfit::Rapid => ("is rapid", "write G1 in place of G0"),
        Unfit::OtherKind => (
            "is none of G1, G2 and G3",
            "put a line or an arc with feed before and behind it",
        ),
        Unfit::LeavesPlane => (
            "moves an axis outside of the plane, or may do so",
            "name the axes of the plane only in these two blocks",
        ),
        Unfit::Unknown => (
            "begins or ends where is not known ahead of time",
            "program both axes of the plane absolute before",
        ),
        Unfit::Nowhere => (
            "goes nowhere",
            "leave its block out, or the rounding or chamfer",
        ),
        Unfit::Turns => (
            "makes more than one turn",
            "write the last turn as an arc of its own",
        ),
    };
    let ends = if within {
        "; RNDM=0 ends the rounding"
    } else {
        ""
    };
    Diagnostic::error(
        span,
        format!("a corner is made between two motions with feed in the plane, and {which} {what}"),
    )
    .help(format!("{help}{ends}"))
}

fn end_at(motion: &mut Move, place: [f64; 2], plane: Plane) {
    let [first, second, _] = plane.axes();
    motion.target[first] = Coordinate::At(place[0]);
    motion.target[second] = Coordinate::At(place[1]);
}

fn begin_at(motion: &mut Move, element: &Element, joint: &Joint, plane: Plane) {
    let [first, second, _] = plane.axes();
    end_at(motion, element.end, plane);
    motion.start[first] = Some(joint.end[0]);
    motion.start[second] = Some(joint.end[1]);
    if let (MoveKind::Arc(arc), Some((centre, _))) = (&mut motion.kind, element.arc) {
        arc.centre = Centre::Offset([centre[0] - joint.end[0], centre[1] - joint.end[1]]);
    }
}

fn joint_move(before: &Move, joint: &Joint, plane: Plane) -> Move {
    let [first, second, _] = plane.axes();
    let mut motion = Move {
        kind: match joint.arc {
            None => MoveKind::Line,
            Some((centre, clockwise)) => MoveKind::Arc(Arc {
                clockwise,
                centre: Centre::Offset([centre[0] - joint.start[0], centre[1] - joint.start[1]]),
                extra_turns: 0,
            }),
        },
        target: [Coordinate::Keep; 9],
        start: std::array::from_fn(|axis| before.end(axis)),
        exact_stop: false,
        corner: None,
    };
    motion.start[first] = Some(joint.start[0]);
    motion.start[second] = Some(joint.start[1]);
    end_at(&mut motion, joint.end, plane);
    motion
}

fn timed_corner(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "a rounding or chamfer with feed in inverse time (G93)",
    )
    .help("F is the time of a whole block there: write G94 and a feed per minute before")
}

fn joint_error(error: JointError, span: Span) -> Diagnostic {
    let (message, help) = match error {
        JointError::DoesNotFit => (
            "the rounding or chamfer does not fit between these two motions",
            "make it smaller, or the motions longer",
        ),
        JointError::Reversal => (
            "the next motion leads straight back: there is no corner to make",
            "leave the rounding or chamfer out",
        ),
        JointError::NeedsLine => (
            "a chamfer is made between two lines, a tangential entry or exit with a line",
            "round the corner instead",
        ),
    };
    Diagnostic::error(span, message).help(help)
}
