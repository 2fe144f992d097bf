//! Where the tool begins on a compensated contour. The other controls lead it straight to beside the start of the
//! first element. LinuxCNC lets its first compensated move end beside its own end, at right angles to itself: where
//! the contour turns towards the tool there, it shortens this move and the first element, and the beginning of the
//! contour would not be cut. Moves onto such contours are marked, so that the backends write them otherwise.
//! Where the contour turns away from the tool, LinuxCNC goes round its start.

use super::moves::{Arc, Centre, Move, MoveKind};
use super::{Action, Block, Compensation, FeedMode, Plane};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::source::Span;
use framepath::frame::AffineMap;
use nalgebra::Vector3;

/// Directions with a smaller sine of the angle between them are the same.
pub const SAME_DIRECTION: f64 = 1e-3;

/// The place of an action: its block and its index there.
type Place = [usize; 2];

/// Tells the diameter in a row of the tool table, machine units; `None` where that cannot be read, which has been
/// reported.
pub type Diameters<'a> = dyn FnMut(u32, Span) -> Result<Option<f64>, Diagnostic> + 'a;

/// The start of a contour that turns towards the tool there; places and directions along both axes of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourStart {
    /// Where the tool comes from.
    pub from: [f64; 2],
    /// Where the contour begins.
    pub to: [f64; 2],
    /// The direction of its first element there, length 1.
    pub along: [f64; 2],
    /// Whether the tool is on the left of the contour.
    pub left: bool,
    /// Whether the first element is a line, which may as well begin further back.
    pub straight: bool,
    /// The diameter of the tool, machine units; `None`: that of the tool in the spindle.
    pub diameter: Option<f64>,
}

/// Marks the moves onto contours in blocks that come one after the other. How a contour begins is known with its
/// first element: blocks wait that long.
#[derive(Debug)]
pub struct ContourStarts {
    waiting: Vec<Block>,
    /// How many of the waiting blocks have been looked at.
    seen: usize,
    /// The move onto a contour whose first element has not come yet.
    open: Option<Place>,
    plane: Plane,
    side: Compensation,
    /// Whether nothing has moved in the plane since compensation began.
    begins: bool,
    /// F is the time of a whole block (G93).
    inverse_time: bool,
    cutter: Cutter,
}

/// Where the diameter of the tool is known from.
#[derive(Debug, Default)]
struct Cutter {
    named: Option<u32>,
    in_spindle: Option<u32>,
    row: Option<u32>,
    diameter: Option<f64>,
}

impl Default for ContourStarts {
    fn default() -> Self {
        ContourStarts {
            waiting: Vec::new(),
            seen: 0,
            open: None,
            plane: Plane::Xy,
            side: Compensation::Off,
            begins: false,
            inverse_time: false,
            cutter: Cutter::default(),
        }
    }
}

impl ContourStart {
    /// The same start in the coordinates into which a map that keeps the plane leads, with the tool on the `left`
    /// or not.
    pub fn seen_from(&self, map: &AffineMap, plane: Plane, left: bool) -> ContourStart {
        let [first, second, _] = plane.axes();
        let in_plane = |place: Vector3<f64>| [place[first], place[second]];
        let along = in_plane(map.apply_to_vector(&plane.vector(self.along)));
        ContourStart {
            from: in_plane(map.apply(&plane.vector(self.from))),
            to: in_plane(map.apply(&plane.vector(self.to))),
            along: unit(along).unwrap_or(self.along),
            left,
            ..*self
        }
    }
}

impl ContourStarts {
    /// Takes the next blocks, and gives those that are finished. A start that cannot be written is reported at the
    /// move onto the contour.
    pub fn take(
        &mut self,
        blocks: Vec<Block>,
        diameters: &mut Diameters,
        diagnostics: &mut Diagnostics,
    ) -> Vec<Block> {
        self.waiting.extend(blocks);
        while self.seen < self.waiting.len() {
            if let Err(diagnostic) = self.look_at(self.seen, diameters, diagnostics) {
                diagnostics.push(diagnostic);
            }
            self.seen += 1;
        }
        let finished = self.open.map_or(self.waiting.len(), |[block, _]| block);
        let waiting = self.waiting.split_off(finished);
        self.seen = waiting.len();
        if let Some([block, _]) = &mut self.open {
            *block = 0;
        }
        std::mem::replace(&mut self.waiting, waiting)
    }

    /// The last blocks, at the end of the program.
    pub fn take_rest(&mut self) -> Vec<Block> {
        self.open = None;
        self.seen = 0;
        std::mem::take(&mut self.waiting)
    }

    fn look_at(
        &mut self,
        block: usize,
        diameters: &mut Diameters,
        diagnostics: &mut Diagnostics,
    ) -> Result<(), Diagnostic> {
        let mut index = 0;
        while let Some(action) = self.waiting[block].actions.get(index) {
            self.cutter.follow(action);
            match action {
                Action::Plane(plane) => self.plane = *plane,
                Action::FeedMode(mode) => self.inverse_time = *mode == FeedMode::InverseTime,
                Action::Compensation(side) => {
                    self.side = *side;
                    self.begins = *side != Compensation::Off;
                    self.open = None;
                }
                Action::Move(motion) if motion.leads_in_plane(self.plane) => {
                    if let Some(onto) = self.open.take()
                        && self.mark(onto, [block, index], diameters, diagnostics)?
                        && onto[0] == block
                    {
                        index += 1;
                    }
                    if std::mem::take(&mut self.begins) {
                        self.open = Some([block, index]);
                    }
                }
                _ => {}
            }
            index += 1;
        }
        Ok(())
    }

    /// Marks a move onto a contour, by its first element; whether an action was added.
    fn mark(
        &mut self,
        onto_place: Place,
        first_place: Place,
        diameters: &mut Diameters,
        diagnostics: &mut Diagnostics,
    ) -> Result<bool, Diagnostic> {
        let span = self.waiting[onto_place[0]].origin.span;
        let (Some(onto), Some(first)) = (self.move_at(onto_place), self.move_at(first_place))
        else {
            return Ok(false);
        };
        let directions = end_direction(onto, self.plane).zip(start_direction(first, self.plane));
        let Some((comes, along)) = directions else {
            diagnostics.push(unknown_start(span));
            return Ok(false);
        };
        let left = self.side == Compensation::Left;
        if turn_to_tool(comes, along, left) < SAME_DIRECTION {
            return Ok(false);
        }
        let straight = !matches!(first.kind, MoveKind::Arc(_));
        let Some((from, to)) = places(onto, self.plane) else {
            diagnostics.push(unknown_start(span));
            return Ok(false);
        };
        if matches!(onto.kind, MoveKind::Arc(_)) {
            return Err(arc_onto_contour(span));
        }
        if self.inverse_time && !straight {
            return Err(timed_start(span));
        }
        let diameter = self.cutter.known_diameter(diameters, span)?;
        if diameter.is_some_and(|diameter| diameter <= 0.0) {
            return Ok(false);
        }
        let start = ContourStart {
            from,
            to,
            along,
            left,
            straight,
            diameter,
        };
        self.insert(onto_place, Action::ContourStart(Box::new(start)));
        Ok(true)
    }

    fn move_at(&self, [block, index]: Place) -> Option<&Move> {
        match self.waiting.get(block)?.actions.get(index)? {
            Action::Move(motion) => Some(motion),
            _ => None,
        }
    }

    /// Puts an action before a move, and before the G41 or G42 that stands with it.
    fn insert(&mut self, [block, index]: Place, action: Action) {
        let actions = &mut self.waiting[block].actions;
        let before = actions[..index].iter().rev();
        let mut before = before.take_while(|action| !matches!(action, Action::Move(_)));
        let with_side = before.position(|action| matches!(action, Action::Compensation(_)));
        actions.insert(index - with_side.map_or(0, |steps| steps + 1), action);
    }
}

impl Cutter {
    fn follow(&mut self, action: &Action) {
        match action {
            Action::Tool(tool) => self.named = Some(*tool),
            Action::ToolChange => {
                self.in_spindle = self.named;
                (self.row, self.diameter) = (None, None);
            }
            Action::ToolLength(_) => (self.row, self.diameter) = (None, None),
            Action::ToolOffset(row) => (self.row, self.diameter) = (Some(*row), None),
            Action::RadiusRow(row) => self.row = *row,
            Action::CutterDiameter(diameter) => self.diameter = *diameter,
            _ => {}
        }
    }

    /// The diameter, machine units, where it is not that of the tool in the spindle; 0 where it cannot be read, which
    /// has been reported.
    fn known_diameter(
        &self,
        diameters: &mut Diameters,
        span: Span,
    ) -> Result<Option<f64>, Diagnostic> {
        let other = self.row.filter(|row| Some(*row) != self.in_spindle);
        match (self.diameter, other) {
            (Some(diameter), _) => Ok(Some(diameter)),
            (None, Some(row)) => Ok(Some(diameters(row, span)?.unwrap_or(0.0))),
            (None, None) => Ok(None),
        }
    }
}

/// The sine of the angle by which the tool turns to the side on which it runs, from one direction in the plane to the next,
/// both of length 1.
pub fn turn_to_tool(comes: [f64; 2], goes: [f64; 2], left: bool) -> f64 {
    let turn = comes[0] * goes[1] - comes[1] * goes[0];
    if left { turn } else { -turn }
}

/// Both ends of a motion in the plane, if they are known.
fn places(motion: &Move, plane: Plane) -> Option<([f64; 2], [f64; 2])> {
    let [first, second, _] = plane.axes();
    let start = [motion.start[first]?, motion.start[second]?];
    Some((start, [motion.end(first)?, motion.end(second)?]))
}

fn start_direction(motion: &Move, plane: Plane) -> Option<[f64; 2]> {
    let MoveKind::Arc(arc) = &motion.kind else {
        return line_direction(motion, plane);
    };
    let Centre::Offset([a, b]) = arc.centre else {
        return None;
    };
    along_circle([-a, -b], arc)
}

fn end_direction(motion: &Move, plane: Plane) -> Option<[f64; 2]> {
    let MoveKind::Arc(arc) = &motion.kind else {
        return line_direction(motion, plane);
    };
    let Centre::Offset([a, b]) = arc.centre else {
        return None;
    };
    let (start, end) = places(motion, plane)?;
    along_circle([end[0] - start[0] - a, end[1] - start[1] - b], arc)
}

fn line_direction(motion: &Move, plane: Plane) -> Option<[f64; 2]> {
    let (start, end) = places(motion, plane)?;
    unit([end[0] - start[0], end[1] - start[1]])
}

/// The direction of an arc at a place of its circle, which is given from the centre.
fn along_circle([a, b]: [f64; 2], arc: &Arc) -> Option<[f64; 2]> {
    match arc.clockwise {
        true => unit([b, -a]),
        false => unit([-b, a]),
    }
}

fn unit([a, b]: [f64; 2]) -> Option<[f64; 2]> {
    let length = a.hypot(b);
    (length > 0.0).then(|| [a / length, b / length])
}

fn unknown_start(span: Span) -> Diagnostic {
    Diagnostic::warning(
        span,
        "whether LinuxCNC begins this contour beside its start is not known ahead of time",
    )
    .help(
        "it does not where the contour turns towards the tool there: program both axes of the plane behind the last \
         change of tool, offset or frame, and before G41 or G42",
    )
}

fn arc_onto_contour(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "an arc leads onto the contour, which turns towards the tool there: LinuxCNC would not cut its beginning",
    )
    .help("lead onto it on a straight line (G1), or on an arc that is tangent to its first element")
}

fn timed_start(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "a contour that begins with an arc and turns towards the tool at its start, with feed in inverse time (G93)",
    )
    .help("the way onto it becomes two motions, and F is the time of one: write G94 and a feed per minute before")
}
