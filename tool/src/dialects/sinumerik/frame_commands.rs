//! TRANS, ROT, ROTS, SCALE, MIRROR and their additive forms: from words to operations.

use super::syntax::{FrameKeyword, Word, WordValue};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::modal::Modal;
use crate::dialects::expression::Variables;
use crate::program::frame::{FrameCommand, FrameOperation, SolidAngles};
use crate::source::Span;
use framepath::frame::programmable::SCALE_RANGE;

/// The axes and the angle of a frame command.
#[derive(Default)]
struct FrameWords {
    axes: [Option<(f64, Span)>; 3],
    in_plane: Option<(f64, Span)>,
}

/// The command that a block gives; `Ok(None)` when it does nothing (a bare additive command), with a
/// warning.
pub fn frame_command(
    keyword: FrameKeyword,
    keyword_span: Span,
    words: &[Word],
    modal: &Modal,
    variables: &dyn Variables,
    diagnostics: &mut Diagnostics,
) -> Result<Option<FrameCommand>, Diagnostic> {
    use FrameKeyword::*;
    let name = format!("{keyword:?}").to_ascii_uppercase();
    let given = collect(&name, keyword, words, variables)?;
    let additive = matches!(keyword, Atrans | Arot | Arots | Ascale | Amirror);
    if words.is_empty() {
        if keyword == Ascale {
            return Ok(Some(FrameCommand::DropScales));
        }
        if additive {
            diagnostics.push(
                Diagnostic::warning(keyword_span, format!("{name} without axes does nothing"))
                    .help("the forms without A (TRANS, ROT, SCALE, MIRROR) clear the frame"),
            );
            return Ok(None);
        }
        return Ok(Some(FrameCommand::Cancel));
    }
    let values = given.axes.map(|axis| axis.map(|(value, _)| value));
    let operation = match keyword {
        Trans | Atrans => FrameOperation::Translate(
            values.map(|value| value.unwrap_or(0.0) * modal.length_factor),
        ),
        Rot | Arot => rotation(&given, modal, diagnostics)?,
        Rots | Arots => solid_angles(&given, modal, diagnostics)?,
        Scale | Ascale => {
            for (factor, span) in given.axes.into_iter().flatten() {
                check_factor(factor, span)?;
            }
            FrameOperation::Scale(values.map(|value| value.unwrap_or(1.0)))
        }
        Mirror | Amirror => FrameOperation::Mirror(values.map(|value| value.is_some())),
    };
    Ok(Some(match additive {
        true => FrameCommand::Additive(operation),
        false => FrameCommand::Absolute(operation),
    }))
}

fn collect(
    name: &str,
    keyword: FrameKeyword,
    words: &[Word],
    variables: &dyn Variables,
) -> Result<FrameWords, Diagnostic> {
    let mut given = FrameWords::default();
    for word in words {
        let axis = ["X", "Y", "Z"]
            .iter()
            .position(|axis| *axis == word.address);
        let rotates = matches!(keyword, FrameKeyword::Rot | FrameKeyword::Arot);
        let solid = matches!(keyword, FrameKeyword::Rots | FrameKeyword::Arots);
        let place = match (axis, word.address.as_str()) {
            (Some(axis), _) => &mut given.axes[axis],
            (None, "RPL") if rotates => &mut given.in_plane,
            (None, "RPL") if solid => {
                return Err(Diagnostic::error(word.span, format!("{name} has no RPL"))
                    .help("a rotation in the plane is ROT RPL=.. or AROT RPL=.."));
            }
            (None, "A" | "B" | "C" | "U" | "V" | "W") => {
                return Err(Diagnostic::error(
                    word.span,
                    format!("{name} acts on X, Y and Z only, not on {}", word.address),
                )
                .help("set the offset of this axis with G54 to G59.3"));
            }
            _ => {
                return Err(Diagnostic::error(
                    word.span,
                    format!("{} cannot stand in one block with {name}", word.address),
                )
                .help(format!(
                    "{name} stands alone in its block: put the rest in the next one"
                )));
            }
        };
        let WordValue::Plain(value) = &word.value else {
            return Err(Diagnostic::error(
                word.span,
                format!("AC and IC have no meaning with {name}"),
            ));
        };
        if place.is_some() {
            return Err(Diagnostic::error(
                word.span,
                format!("{} is in this block twice", word.address),
            ));
        }
        *place = Some((value.number(variables)?, word.span));
    }
    if let (Some((_, span)), true) = (given.in_plane, given.axes.iter().any(Option::is_some)) {
        return Err(
            Diagnostic::error(span, "RPL cannot stand in one block with axes")
                .help("rotate in the plane with one command and about axes with another"),
        );
    }
    Ok(given)
}

fn rotation(
    given: &FrameWords,
    modal: &Modal,
    diagnostics: &mut Diagnostics,
) -> Result<FrameOperation, Diagnostic> {
    if let Some((angle, span)) = given.in_plane {
        check_angle(angle, span, 360.0)?;
        return Ok(FrameOperation::RotateInPlane(modal.plane, angle));
    }
    for (axis, limit) in [(0, 180.0), (1, 90.0), (2, 180.0)] {
        if let Some((angle, span)) = given.axes[axis] {
            check_angle(angle, span, limit)?;
            if axis == 1 && angle.abs() == 90.0 {
                diagnostics.push(
                    Diagnostic::warning(
                        span,
                        "at Y = 90 degrees the rotations about X and Z act about the same axis",
                    )
                    .help("the angles are taken as they are: Rz Ry Rx"),
                );
            }
        }
    }
    let angle = |axis: Option<(f64, Span)>| axis.map_or(0.0, |(angle, _)| angle);
    Ok(FrameOperation::Rotate(given.axes.map(angle)))
}

fn solid_angles(
    given: &FrameWords,
    modal: &Modal,
    diagnostics: &mut Diagnostics,
) -> Result<FrameOperation, Diagnostic> {
    let (which, first, second) = match given.axes {
        [Some(x), Some(y), None] => (SolidAngles::XThenY, x, y),
        [Some(x), None, Some(z)] => (SolidAngles::ZThenX, z, x),
        [None, Some(y), Some(z)] => (SolidAngles::YThenZ, y, z),
        [Some(_), Some(_), Some((_, span))] => {
            return Err(Diagnostic::error(
                span,
                "two solid angles determine the plane: a third is too much",
            )
            .help("leave one of X, Y and Z out"));
        }
        _ => return rotation(given, modal, diagnostics),
    };
    for (angle, span) in [first, second] {
        if angle.abs() >= 90.0 {
            return Err(Diagnostic::error(
                span,
                format!("a solid angle of {angle} degrees has no plane"),
            )
            .help("solid angles lie between -90 and 90 degrees"));
        }
    }
    Ok(FrameOperation::RotateBySolidAngles(
        which,
        [first.0, second.0],
    ))
}

fn check_angle(angle: f64, span: Span, limit: f64) -> Result<(), Diagnostic> {
    if angle.abs() <= limit {
        return Ok(());
    }
    Err(
        Diagnostic::error(span, format!("{angle} degrees is out of range"))
            .help(format!("angles go from -{limit} to {limit} degrees here")),
    )
}

fn check_factor(factor: f64, span: Span) -> Result<(), Diagnostic> {
    let [least, largest] = SCALE_RANGE;
    if factor == 0.0 {
        return Err(
            Diagnostic::error(span, "a scale factor of 0 makes everything vanish")
                .help("leave an axis out to keep its scale; SCALE alone ends scaling"),
        );
    }
    if factor < 0.0 {
        return Err(Diagnostic::error(span, "a scale factor cannot be negative")
            .help("MIRROR and AMIRROR negate axes"));
    }
    if !(least..=largest).contains(&factor) {
        return Err(
            Diagnostic::error(span, format!("the scale factor {factor} is out of range"))
                .help(format!("factors go from {least} to {largest}")),
        );
    }
    Ok(())
}
