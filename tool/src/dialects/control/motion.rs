//! From the axis words of a block to a move with explicit coordinates.

use super::modal::{Modal, Motion};
use super::words::{AXES, At, Dimension, MotionWords};
use super::{Control, Done};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::settings::{IncrementBase, Settings};
use crate::program::arc::{ArcError, centre_from_radius, checked_centre};
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::program::trace::frame_arc;
use crate::program::{Action, Compensation, Plane};
use crate::source::Span;
use nalgebra::Vector3;

/// Coordinates that differ by less are the same place.
const SAME_PLACE: f64 = 1e-9;

impl Control<'_> {
    /// Where an axis is, in units of the program, if that is known ahead of time.
    pub fn present(&self, axis: usize) -> Option<f64> {
        let factor = length_factor(axis, &self.modal) * written_factor(axis, &self.modal);
        self.modal
            .position
            .get(axis)
            .map(|position| position / factor)
    }

    /// The motion of a block with axis words, or with the centre of a full circle, by the modal G0 to
    /// G3. `block`: the text of the block, for errors. `own_feed`: whether the block has an F.
    pub fn motion(
        &mut self,
        words: &MotionWords,
        block: Span,
        own_feed: bool,
        exact_stop: bool,
    ) -> Done {
        let span = words.first_axis().unwrap_or(block);
        let Some(motion) = self.modal.motion else {
            return Err(
                Diagnostic::error(span, "no G0, G1, G2 or G3 before the first motion")
                    .help("say how the axes are to move: G0 rapid, G1 with feed"),
            );
        };
        if motion != Motion::Rapid {
            self.check_feed(own_feed, span)?;
        }
        let mut path = path_move(
            words,
            motion,
            &self.modal,
            self.settings,
            span,
            self.diagnostics,
        )?;
        path.exact_stop = exact_stop;
        self.add_move(path, span)
    }

    /// Moves one axis to an absolute coordinate, units of the program, rapid or with the feed in force:
    /// a step of a cycle.
    pub fn move_axis(&mut self, axis: usize, value: f64, rapid: bool, span: Span) -> Done {
        let mut words = MotionWords::default();
        words.axes[axis] = Some(At {
            value: (value, Dimension::Absolute),
            span,
        });
        let motion = if rapid { Motion::Rapid } else { Motion::Line };
        let before = self.modal.motion.replace(motion);
        let done = self.motion(&words, span, false, false);
        self.modal.motion = before;
        done
    }

    /// A motion whose coordinates are worked out.
    pub fn add_move(&mut self, mut path: Move, span: Span) -> Done {
        if self.modal.compensation != Compensation::Off && path.depends_on_position() {
            return Err(Diagnostic::unknown_place(
                span,
                "under cutter compensation, from a place that is not known ahead of time",
            )
            .help("program the axes of the plane absolute before G41 or G42"));
        }
        path.exact_stop |= self.stops_under_compensation();
        self.modal.tangent = end_direction(&path, self.modal.plane, self.settings);
        carry_out(&path, &mut self.modal);
        self.actions.push(Action::Move(path));
        Ok(())
    }
}

/// The targets of all axes.
pub(super) fn targets(
    words: &MotionWords,
    modal: &Modal,
    settings: &Settings,
    diagnostics: &mut Diagnostics,
) -> Result<[Coordinate; 9], Diagnostic> {
    let mut targets = [Coordinate::Keep; 9];
    for (axis, word) in words.axes.iter().enumerate() {
        let Some(At {
            value: (value, dimension),
            span,
        }) = *word
        else {
            continue;
        };
        let factor = length_factor(axis, modal) * written_factor(axis, modal);
        let value = value * factor;
        targets[axis] = if !modal.is_incremental(dimension) {
            Coordinate::At(value)
        } else {
            match increment_base(axis, span, modal, settings, diagnostics)? {
                Some(base) => Coordinate::At(base + value),
                None => Coordinate::By(value),
            }
        };
    }
    Ok(targets)
}

/// Rotary axes are in degrees whatever the unit of length.
pub(super) fn length_factor(axis: usize, modal: &Modal) -> f64 {
    match AXES[axis] {
        "A" | "B" | "C" => 1.0,
        _ => modal.length_factor,
    }
}

/// X Y Z are mirrored and scaled by the frame, the other axes as they are written.
fn written_factor(axis: usize, modal: &Modal) -> f64 {
    match axis {
        0..3 => 1.0,
        _ => modal.axis_factors[axis],
    }
}

/// The coordinate that an increment counts from; `None` when it is not known ahead of time.
fn increment_base(
    axis: usize,
    span: Span,
    modal: &Modal,
    settings: &Settings,
    diagnostics: &mut Diagnostics,
) -> Result<Option<f64>, Diagnostic> {
    if axis == 2 && modal.length_undecided {
        return Err(Diagnostic::error(
            span,
            "an increment in Z behind another length of the tool (G43, G49): a parameter of the control (5006) says \
             whether the change is travelled too",
        )
        .help("program Z once with G90, in the block of G43 or G49 or behind it"));
    }
    let position = modal.position.get(axis);
    let Some(carried) = modal.carried.get(axis).copied().flatten() else {
        return Ok(position);
    };
    if !modal.follows_setting {
        return Ok(position);
    }
    let unchanged = match (carried, position) {
        (Some(carried), Some(position)) => (carried - position).abs() < SAME_PLACE,
        _ => false,
    };
    if unchanged {
        return Ok(position);
    }
    let letter = AXES[axis];
    let change = "a change of the frame, the offset or the tool";
    let advice = format!("program {letter} absolute once after it has changed");
    match settings.increment_after_frame {
        IncrementBase::Position => {
            diagnostics.push(
                Diagnostic::warning(
                    span,
                    format!(
                        "increment in {letter} after {change}: it counts from where the tool is"
                    ),
                )
                .help(format!("{advice}, or see --increment-after-frame")),
            );
            Ok(position)
        }
        IncrementBase::Programmed => match carried {
            Some(carried) => {
                diagnostics.push(
                    Diagnostic::warning(
                        span,
                        format!(
                            "increment in {letter} after {change}: \
                             the change is travelled too, from {letter}{carried} as it counts now"
                        ),
                    )
                    .help(format!("{advice}, or see --increment-after-frame")),
                );
                Ok(Some(carried))
            }
            None => Err(Diagnostic::unknown_place(
                span,
                format!(
                    "increment in {letter} after {change}, \
                         and where {letter} was before is not known ahead of time"
                ),
            )
            .help(format!(
                "{advice}, or give --increment-after-frame position"
            ))),
        },
    }
}

/// The move of a block with axis words, or with the centre of a full circle.
fn path_move(
    words: &MotionWords,
    motion: Motion,
    modal: &Modal,
    settings: &Settings,
    span: Span,
    diagnostics: &mut Diagnostics,
) -> Result<Move, Diagnostic> {
    let mut result = Move {
        kind: MoveKind::Rapid,
        target: targets(words, modal, settings, diagnostics)?,
        start: modal.position.coordinates(),
        exact_stop: false,
        corner: None,
    };
    let clockwise = match motion {
        Motion::Rapid | Motion::Line => {
            if words.names_a_centre() || words.turns.is_some() {
                return Err(
                    Diagnostic::error(span, "centres, radii and turns belong to arcs")
                        .help("write G2 (clockwise) or G3 (counterclockwise) in this block"),
                );
            }
            if motion == Motion::Line {
                result.kind = MoveKind::Line;
            }
            return Ok(result);
        }
        Motion::Clockwise => true,
        Motion::Counterclockwise => false,
    };
    let centre = arc_centre(words, &mut result, clockwise, modal, settings, span)?;
    result.kind = MoveKind::Arc(Arc {
        clockwise,
        centre,
        extra_turns: extra_turns(words)?,
    });
    Ok(result)
}

fn extra_turns(words: &MotionWords) -> Result<u32, Diagnostic> {
    match words.turns {
        None => Ok(0),
        Some(turns) if turns.value.fract() == 0.0 && (0.0..=999.0).contains(&turns.value) => {
            Ok(turns.value as u32)
        }
        Some(turns) => Err(Diagnostic::error(
            turns.span,
            "TURN takes whole numbers from 0 to 999",
        )),
    }
}

fn arc_centre(
    words: &MotionWords,
    arc: &mut Move,
    clockwise: bool,
    modal: &Modal,
    settings: &Settings,
    span: Span,
) -> Result<Centre, Diagnostic> {
    let [first, second, normal] = modal.plane.axes();
    if let Some(centre) = words.centre[normal] {
        return Err(Diagnostic::error(
            centre.span,
            format!(
                "{} is not in the plane that is active",
                ["I", "J", "K"][normal]
            ),
        )
        .help("G17 has I and J, G18 I and K, G19 J and K"));
    }
    let chord = [first, second].map(|axis| chord(arc, axis));
    let known_chord = match chord {
        [Some(a), Some(b)] => Some([a, b]),
        _ => None,
    };
    let tolerance = &settings.arc_tolerance;
    if let Some(radius) = words.radius {
        let given = words.centre[first].or(words.centre[second]);
        if let Some(centre) = given {
            return Err(Diagnostic::error(
                centre.span,
                "an arc has a centre or a radius, not both",
            )
            .help("leave out either the radius or I, J and K"));
        }
        let value = radius.value * modal.length_factor;
        if value == 0.0 {
            return Err(Diagnostic::error(radius.span, "a radius of 0 is no arc"));
        }
        return match known_chord {
            Some(chord) => centre_from_radius(chord, value, clockwise, tolerance)
                .map(Centre::Offset)
                .map_err(|error| arc_error(error, radius.span)),
            None => Ok(Centre::Radius(value)),
        };
    }
    if words.centre[first].is_none() && words.centre[second].is_none() {
        return Err(
            Diagnostic::error(span, "this arc has neither a centre nor a radius")
                .help("add I, J or K (centre from the start) or the radius"),
        );
    }
    let centre = [first, second].map(|axis| centre_coordinate(words, arc, axis, modal));
    let offset = match centre {
        [Coordinate::By(a), Coordinate::By(b)] => [a, b],
        _ => return Ok(Centre::Point(centre)),
    };
    match known_chord {
        Some(chord) => checked_centre(chord, offset, tolerance)
            .map(Centre::Offset)
            .map_err(|error| arc_error(error, span)),
        None => Ok(Centre::Offset(offset)),
    }
}

/// The end of a move relative to its start along one axis, if it is known.
fn chord(arc: &Move, axis: usize) -> Option<f64> {
    match arc.target[axis] {
        Coordinate::Keep => Some(0.0),
        Coordinate::By(step) => Some(step),
        Coordinate::At(end) => arc.start[axis].map(|start| end - start),
    }
}

/// One coordinate of the centre, from the start as far as that is possible. The centre is incremental
/// whatever G90 and G91 say.
fn centre_coordinate(words: &MotionWords, arc: &Move, axis: usize, modal: &Modal) -> Coordinate {
    let Some(At {
        value: (value, dimension),
        ..
    }) = words.centre[axis]
    else {
        return Coordinate::By(0.0);
    };
    let value = value * modal.length_factor;
    match (dimension, arc.start[axis]) {
        (Dimension::Absolute, Some(start)) => Coordinate::By(value - start),
        (Dimension::Absolute, None) => Coordinate::At(value),
        _ => Coordinate::By(value),
    }
}

/// The words for an error of the geometry.
fn arc_error(error: ArcError, span: Span) -> Diagnostic {
    match error {
        ArcError::RadiusTooSmall { radius, least } => Diagnostic::error(
            span,
            format!("the radius {radius:.4} does not reach the end: at least {least:.4} is needed"),
        )
        .help("check the radius and the end point"),
        ArcError::FullCircleByRadius => Diagnostic::error(
            span,
            "a full circle by its radius: the centre could be anywhere",
        )
        .help("give the centre with I, J or K"),
        ArcError::RadiusMismatch { start, end } => Diagnostic::error(
            span,
            format!("the radius is {start:.4} at the start of this arc and {end:.4} at its end"),
        )
        .help("check the end point and the centre; I, J and K count from the start"),
        ArcError::NoRadius => Diagnostic::error(span, "the centre of this arc is its start")
            .help("I, J and K count from the start"),
    }
}

/// The direction at the end of a move, if it is known ahead of time.
fn end_direction(path: &Move, plane: Plane, settings: &Settings) -> Option<[f64; 3]> {
    let point = |coordinates: [Option<f64>; 3]| match coordinates {
        [Some(x), Some(y), Some(z)] => Some(Vector3::new(x, y, z)),
        _ => None,
    };
    if let MoveKind::Arc(arc) = &path.kind {
        let start = point([0, 1, 2].map(|axis| path.start[axis]))?;
        let end = point([0, 1, 2].map(|axis| path.end(axis)))?;
        let shape = frame_arc(arc, start, end, plane, &settings.arc_tolerance).ok()?;
        return Some(shape.end_direction().into());
    }
    let mut direction = [0.0; 3];
    for (axis, along) in direction.iter_mut().enumerate() {
        *along = match (path.target[axis], path.start[axis]) {
            (Coordinate::Keep, _) => 0.0,
            (Coordinate::By(step), _) => step,
            (Coordinate::At(end), start) => end - start?,
        };
    }
    let moves = direction.iter().any(|along| *along != 0.0);
    moves.then_some(direction)
}

/// Takes the axes to the end of a move.
fn carry_out(result: &Move, modal: &mut Modal) {
    for axis in 0..9 {
        if result.target[axis] == Coordinate::Keep {
            continue;
        }
        modal.position.set(axis, result.end(axis));
        modal.length_undecided &= axis != 2;
        if let Some(carried) = modal.carried.get_mut(axis) {
            *carried = None;
        }
    }
}
