//! From the axis words of a block to a move with explicit coordinates.

use super::block_words::{AXES, At, BlockWords, Dimension};
use super::modal::{Modal, Motion};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::settings::{IncrementBase, Settings};
use crate::program::arc::{ArcError, centre_from_radius, checked_centre};
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::source::Span;

/// Coordinates that differ by less are the same place.
const SAME_PLACE: f64 = 1e-9;

/// The targets of all axes.
pub fn targets(
    words: &BlockWords,
    modal: &Modal,
    settings: &Settings,
    diagnostics: &mut Diagnostics,
) -> Result<[Coordinate; 9], Box<Diagnostic>> {
    let mut targets = [Coordinate::Keep; 9];
    for (axis, word) in words.axes.iter().enumerate() {
        let Some(At {
            value: (value, dimension),
            span,
        }) = *word
        else {
            continue;
        };
        let factor = length_factor(axis, modal);
        let incremental = match dimension {
            Dimension::Modal => modal.incremental,
            Dimension::Absolute => false,
            Dimension::Incremental => true,
        };
        let value = value * factor;
        targets[axis] = if !incremental {
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
fn length_factor(axis: usize, modal: &Modal) -> f64 {
    match AXES[axis] {
        "A" | "B" | "C" => 1.0,
        _ => modal.length_factor,
    }
}

/// The coordinate that an increment counts from; `None` when it is not known ahead of time.
fn increment_base(
    axis: usize,
    span: Span,
    modal: &Modal,
    settings: &Settings,
    diagnostics: &mut Diagnostics,
) -> Result<Option<f64>, Box<Diagnostic>> {
    let position = modal.position.get(axis);
    let Some(carried) = modal.carried.get(axis).copied().flatten() else {
        return Ok(position);
    };
    let unchanged = match (carried, position) {
        (Some(carried), Some(position)) => (carried - position).abs() < SAME_PLACE,
        _ => false,
    };
    if unchanged {
        return Ok(position);
    }
    let letter = AXES[axis];
    let advice = format!("program {letter} absolute once after the frame has changed");
    match settings.increment_after_frame {
        IncrementBase::Position => {
            diagnostics.push(
                Diagnostic::warning(
                    span,
                    format!(
                        "increment in {letter} after a change of the frame: it counts from where the tool is"
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
                            "increment in {letter} after a change of the frame: \
                             the change is travelled too, from {letter}{carried} in the new frame"
                        ),
                    )
                    .help(format!("{advice}, or see --increment-after-frame")),
                );
                Ok(Some(carried))
            }
            None => Err(Box::new(
                Diagnostic::error(
                    span,
                    format!(
                        "increment in {letter} after a change of the frame, \
                         and where {letter} was before is not known ahead of time"
                    ),
                )
                .help(format!(
                    "{advice}, or give --increment-after-frame position"
                )),
            )),
        },
    }
}

/// The move of a block with axis words, or with the centre of a full circle.
pub fn path_move(
    words: &BlockWords,
    motion: Motion,
    modal: &Modal,
    settings: &Settings,
    span: Span,
    diagnostics: &mut Diagnostics,
) -> Result<Move, Box<Diagnostic>> {
    let mut result = Move {
        kind: MoveKind::Rapid,
        target: targets(words, modal, settings, diagnostics)?,
        start: modal.position.coordinates(),
        exact_stop: false,
    };
    let clockwise = match motion {
        Motion::Rapid | Motion::Line => {
            if words.names_a_centre() || words.turns.is_some() {
                return Err(Box::new(
                    Diagnostic::error(span, "I, J, K, CR and TURN belong to arcs")
                        .help("write G2 (clockwise) or G3 (counterclockwise) in this block"),
                ));
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

fn extra_turns(words: &BlockWords) -> Result<u32, Box<Diagnostic>> {
    match words.turns {
        None => Ok(0),
        Some(turns) if turns.value.fract() == 0.0 && (0.0..=999.0).contains(&turns.value) => {
            Ok(turns.value as u32)
        }
        Some(turns) => Err(Box::new(Diagnostic::error(
            turns.span,
            "TURN takes whole numbers from 0 to 999",
        ))),
    }
}

fn arc_centre(
    words: &BlockWords,
    arc: &mut Move,
    clockwise: bool,
    modal: &Modal,
    settings: &Settings,
    span: Span,
) -> Result<Centre, Box<Diagnostic>> {
    let [first, second, normal] = modal.plane.axes();
    if let Some(centre) = words.centre[normal] {
        return Err(Box::new(
            Diagnostic::error(
                centre.span,
                format!(
                    "{} is not in the plane that is active",
                    ["I", "J", "K"][normal]
                ),
            )
            .help("G17 has I and J, G18 I and K, G19 J and K"),
        ));
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
            return Err(Box::new(
                Diagnostic::error(centre.span, "an arc has a centre or a radius, not both")
                    .help("leave out either CR or I, J and K"),
            ));
        }
        let value = radius.value * modal.length_factor;
        if value == 0.0 {
            return Err(Box::new(Diagnostic::error(
                radius.span,
                "a radius of 0 is no arc",
            )));
        }
        return match known_chord {
            Some(chord) => centre_from_radius(chord, value, clockwise, tolerance)
                .map(Centre::Offset)
                .map_err(|error| arc_error(error, radius.span)),
            None => Ok(Centre::Radius(value)),
        };
    }
    if words.centre[first].is_none() && words.centre[second].is_none() {
        return Err(Box::new(
            Diagnostic::error(span, "this arc has neither a centre nor a radius")
                .help("add I, J or K (centre from the start) or CR=radius"),
        ));
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
fn centre_coordinate(words: &BlockWords, arc: &Move, axis: usize, modal: &Modal) -> Coordinate {
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
fn arc_error(error: ArcError, span: Span) -> Box<Diagnostic> {
    let error = match error {
        ArcError::RadiusTooSmall { radius, least } => Diagnostic::error(
            span,
            format!("the radius {radius:.4} does not reach the end: at least {least:.4} is needed"),
        )
        .help("check CR= and the end point"),
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
            .help("I, J and K count from the start; absolute centres are I=AC(..)"),
    };
    Box::new(error)
}

/// Takes the axes to the end of a move.
pub fn carry_out(result: &Move, modal: &mut Modal) {
    for axis in 0..9 {
        if result.target[axis] == Coordinate::Keep {
            continue;
        }
        modal.position.set(axis, result.end(axis));
        if let Some(carried) = modal.carried.get_mut(axis) {
            *carried = None;
        }
    }
}
