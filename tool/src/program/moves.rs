//! One motion of a program.

use super::Plane;

/// Coordinates that differ by less are the same place.
const SAME_PLACE: f64 = 1e-9;

/// Where an axis goes in a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// It is not named in the block and stays where it is.
    Keep,
    /// To this coordinate of the current frame.
    At(f64),
    /// By this much from where it is: only where the start is not known ahead of time.
    By(f64),
}

/// A motion in coordinates of the current frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// Rapid, line or arc.
    pub kind: MoveKind,
    /// Where each of X Y Z A B C U V W goes.
    pub target: [Coordinate; 9],
    /// Where each axis is before the move, as far as that is known ahead of time.
    pub start: [Option<f64>; 9],
    /// Whether this motion ends in an exact stop whatever mode is in force (G9).
    pub exact_stop: bool,
    /// What is put between this motion and the next; see [`super::corners`].
    pub corner: Option<Corner>,
}

/// What takes the place of the corner between two motions; lengths in machine units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corner {
    /// A tangent arc of this radius.
    Round(f64),
    /// The same between two motions with feed in the plane; elsewhere there is no corner to be made.
    RoundWithin(f64),
    /// A straight line that begins and ends at this distance from the corner.
    ChamferFrom(f64),
    /// A straight line of this length.
    ChamferOf(f64),
    /// Before the next motion, an arc of this radius that is tangent to it and to this line, whose
    /// direction is changed for it.
    TangentialEntry(f64),
    /// At the end of this motion, an arc of this radius that is tangent to it and to the next line, whose
    /// direction is changed for it.
    TangentialExit(f64),
}

impl Move {
    /// Whether LinuxCNC has to read where it is to carry out the move. Under cutter compensation it
    /// would read the compensated position.
    pub fn depends_on_position(&self) -> bool {
        let step = |target: &Coordinate| matches!(target, Coordinate::By(_));
        let centre = match &self.kind {
            MoveKind::Arc(arc) => matches!(arc.centre, Centre::Point(_)),
            _ => false,
        };
        centre || self.target.iter().any(step)
    }

    /// Whether it leads elsewhere in a plane, or may do so.
    pub fn leads_in_plane(&self, plane: Plane) -> bool {
        let leads = |axis: usize| match self.target[axis] {
            Coordinate::Keep => false,
            Coordinate::By(step) => step.abs() > SAME_PLACE,
            Coordinate::At(end) => {
                self.start[axis].is_none_or(|start| (end - start).abs() > SAME_PLACE)
            }
        };
        let [first, second, _] = plane.axes();
        matches!(self.kind, MoveKind::Arc(_)) || leads(first) || leads(second)
    }

    /// Whether it follows the spindle.
    pub fn follows_spindle(&self) -> bool {
        matches!(self.kind, MoveKind::Thread { .. } | MoveKind::Tap { .. })
    }

    /// Where an axis is after the move, as far as that is known ahead of time.
    pub fn end(&self, axis: usize) -> Option<f64> {
        match self.kind {
            MoveKind::Tap { .. } => self.start[axis],
            _ => self.reached(axis),
        }
    }

    /// The target of an axis, as far as that is known ahead of time: where it is after the move, or
    /// before a tap turns back.
    pub fn reached(&self, axis: usize) -> Option<f64> {
        match self.target[axis] {
            Coordinate::Keep => self.start[axis],
            Coordinate::At(value) => Some(value),
            Coordinate::By(step) => self.start[axis].map(|start| start + step),
        }
    }
}

/// The kind of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum MoveKind {
    /// G0.
    Rapid,
    /// G0 or G1 in coordinates of the machine, without frame and work offset.
    Machine {
        /// Whether this is a rapid move.
        rapid: bool,
        /// Whether the tool length counts, so that the tip goes to the coordinates.
        tool_length: bool,
    },
    /// G1.
    Line,
    /// A straight motion in step with the spindle: a thread.
    Thread {
        /// How far it goes in one revolution, machine units along its path.
        pitch: f64,
    },
    /// A rigid tap: down in step with the spindle, which then turns back, and up to the start again.
    Tap {
        /// How far it goes in one revolution, machine units along its path.
        pitch: f64,
        /// The spindle speed on the way back over that on the way in.
        back: f64,
    },
    /// G2 or G3 in the plane that is active.
    Arc(Arc),
}

/// An arc, or a helix, in the plane that is active.
#[derive(Clone, Debug, PartialEq)]
pub struct Arc {
    /// G2.
    pub clockwise: bool,
    /// Where its centre is.
    pub centre: Centre,
    /// Full turns beyond the first passage of the end point.
    pub extra_turns: u32,
}

/// How the centre of an arc is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Centre {
    /// From the start, along the first and the second axis of the plane.
    Offset([f64; 2]),
    /// The start is not known: each coordinate of the centre as it was written.
    Point([Coordinate; 2]),
    /// The start is not known: the radius, negative for more than half a circle.
    Radius(f64),
}
