//! Motions in coordinates of the machine.

use super::line::{Lines, Rank};
use super::modes::Modes;
use super::number::coordinate;
use super::words::LETTERS;
use crate::program::moves::{Coordinate, Move, MoveKind};

/// Adds a motion in machine coordinates; `false` for any other motion. LinuxCNC's G53 leaves the tool out: where
/// the tip is to go there, its length is added.
///
/// LinuxCNC keeps the lengths of the tool in the spindle in #5401 to #5409. Of an offset that comes from another
/// row of the tool table, or that an earlier tool has left in force, it has no parameters: lines of their own work
/// it out.
pub fn add_machine_move(lines: &mut Lines, motion: &Move, modes: &Modes) -> bool {
    let MoveKind::Machine { rapid, tool_length } = motion.kind else {
        return false;
    };
    let tool_length = tool_length && modes.tool_length != Some(false);
    let of_another = tool_length && modes.tool_length == Some(true) && !modes.length_of_spindle;
    let targets = motion.target.iter().enumerate();
    let targets = targets.filter_map(|(axis, target)| match target {
        Coordinate::At(value) => Some((axis, coordinate(*value))),
        Coordinate::Keep | Coordinate::By(_) => None,
    });
    let targets: Vec<(usize, String)> = targets.collect();
    if of_another {
        lines.flush();
        for (axis, _) in &targets {
            lines.line(&format!(
                "{} = [{}]",
                offset_name(*axis),
                offset_in_force(*axis)
            ));
        }
    }
    let mut words = vec![
        "G53".to_string(),
        if rapid { "G0" } else { "G1" }.to_string(),
    ];
    for (axis, value) in targets {
        let letter = LETTERS[axis];
        words.push(match (tool_length, of_another) {
            (false, _) => format!("{letter}{value}"),
            (true, false) => format!("{letter}[{value}+#{}]", 5401 + axis),
            (true, true) => format!("{letter}[{value}+{}]", offset_name(axis)),
        });
    }
    lines.add(Rank::Motion, words.join(" "));
    true
}

/// The parameter that the offset of the tool along an axis is worked out in.
fn offset_name(axis: usize) -> String {
    format!("#<_frame_tool_{}>", LETTERS[axis].to_lowercase())
}

/// The offset of the tool along an axis as it is in force: where the axis is in coordinates of the machine, less
/// where the tip is there, which work offset, its rotation about Z, G92 and the coordinate of the program say.
fn offset_in_force(axis: usize) -> String {
    let origin = |axis: usize| format!("#[{}+20*#5220]", 5201 + axis);
    let shifted = |axis: usize| format!("[#{}+#5210*#{}]", 5420 + axis, 5211 + axis);
    const ANGLE: &str = "[#[5210+20*#5220]]";
    let in_offset = match axis {
        0 => format!("-{}*COS{ANGLE}+{}*SIN{ANGLE}", shifted(0), shifted(1)),
        1 => format!("-{}*COS{ANGLE}-{}*SIN{ANGLE}", shifted(1), shifted(0)),
        _ => format!("-{}", shifted(axis)),
    };
    let letter = LETTERS[axis].to_lowercase();
    format!("#<_abs_{letter}>-{}{in_offset}", origin(axis))
}
