//! Arcs of several turns that LinuxCNC would not run as such.
//!
//! Under G64, in the plane of X and Y, it takes an arc for two lines over its middle where it is flat: no higher over its chord
//! than Q, which is P where there is no Q. Its turns do not count there: where what is left of it without them is flat, they are
//! left away. The whole turns are then written as an arc of their own, which ends where it begins; its height is its diameter.

use super::modes::Modes;
use super::number::coordinate;
use crate::diagnostics::Diagnostic;
use crate::program::arc::sweep;
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::program::{Compensation, FeedMode, PathControl, Plane};
use crate::source::Span;
use std::f64::consts::TAU;

/// An arc no higher than so many tolerances is written in two: LinuxCNC sees rounded coordinates.
const FLAT: f64 = 1.1;

/// What is left of an arc up to this angle, radians, is a line: LinuxCNC takes one of up to 1e-5 for a whole turn, and its
/// coordinates are rounded.
const NEXT_TO_NOTHING: f64 = 1e-4;

/// The whole turns of an arc, and what is left of it; `None` where it stays one.
pub type Apart = Option<[Move; 2]>;

/// The whole turns of an arc and what is left of it, where LinuxCNC would leave the turns away; `None` where the arc may be written
/// as it is. `control`: the path mode that is in force, with its tolerance as it is written; `scale`: how much larger the arc is
/// written.
///
/// # Errors
/// Where the turns have to be written apart, and the place in which they end is not known.
pub fn whole_turns(
    motion: &Move,
    modes: &Modes,
    (control, scale): (PathControl, f64),
    span: Span,
) -> Result<Apart, Diagnostic> {
    let (MoveKind::Arc(arc), PathControl::Continuous { tolerance }) = (&motion.kind, control)
    else {
        return Ok(None);
    };
    if arc.extra_turns == 0 || modes.plane != Plane::Xy || coordinate(tolerance) == "0" {
        return Ok(None);
    }
    let Some((radius, rest)) = radius_and_rest(motion, arc) else {
        return Err(not_known(span));
    };
    // How large LinuxCNC makes the arc under cutter compensation depends on the tool.
    let is_compensated = modes.compensation != Compensation::Off;
    let height = scale * radius * (1.0 - (rest / 2.0).cos());
    if !is_compensated && height > FLAT * tolerance && rest > NEXT_TO_NOTHING {
        return Ok(None);
    }
    if modes.feed_mode == FeedMode::InverseTime {
        return Err(Diagnostic::error(
            span,
            "an arc of several turns with feed in inverse time that has to be written in two",
        )
        .help("use G94"));
    }
    parts(motion, arc, rest)
        .map(Some)
        .ok_or_else(|| not_known(span))
}

fn not_known(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "an arc of several turns under G64, and its start is not known ahead of time",
    )
    .help("program the start of the arc, with all axes that it moves, in a block of its own before it")
}

/// The radius, and the angle without the whole turns, radians.
fn radius_and_rest(motion: &Move, arc: &Arc) -> Option<(f64, f64)> {
    let Centre::Offset([x, y]) = arc.centre else {
        return None;
    };
    let end = [step(motion, 0)? - x, step(motion, 1)? - y];
    let rest = sweep([-x, -y], end, arc.clockwise, 0);
    Some((x.hypot(y), rest))
}

/// How far an axis goes.
fn step(motion: &Move, axis: usize) -> Option<f64> {
    match motion.target[axis] {
        Coordinate::Keep => Some(0.0),
        Coordinate::By(step) => Some(step),
        Coordinate::At(end) => motion.start[axis].map(|start| end - start),
    }
}

fn parts(motion: &Move, arc: &Arc, rest: f64) -> Option<[Move; 2]> {
    let mut turns = Move {
        kind: MoveKind::Arc(Arc {
            extra_turns: arc.extra_turns - 1,
            ..arc.clone()
        }),
        corner: None,
        ..motion.clone()
    };
    let mut left = Move {
        kind: match rest > NEXT_TO_NOTHING {
            true => MoveKind::Arc(Arc {
                extra_turns: 0,
                ..arc.clone()
            }),
            false => MoveKind::Line,
        },
        ..motion.clone()
    };
    let round = TAU * f64::from(arc.extra_turns);
    let share = round / (round + rest);
    for axis in 0..motion.target.len() {
        if axis < 2 {
            turns.target[axis] = Coordinate::Keep;
            continue;
        }
        let on = share * step(motion, axis)?;
        let between = motion.start[axis].map(|start| start + on);
        left.start[axis] = between;
        (turns.target[axis], left.target[axis]) = match motion.target[axis] {
            Coordinate::Keep => continue,
            Coordinate::At(_) => (Coordinate::At(between?), motion.target[axis]),
            Coordinate::By(step) => (Coordinate::By(on), Coordinate::By(step - on)),
        };
    }
    Some([turns, left])
}
