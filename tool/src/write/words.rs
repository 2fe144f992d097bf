//! The words that all backends write in the same way.

use super::comment::message;
use super::line::{Lines, Rank};
use super::number::coordinate;
use crate::program::moves::{Centre, Coordinate, Move};
use crate::program::{Action, Compensation, Coolant, FeedMode, PathControl, Plane, Spindle};

/// The axes of LinuxCNC.
pub const LETTERS: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];

/// LinuxCNC's parameters #5420 to #5428: where the axes are, in coordinates of the program.
fn present_position(axis: usize) -> String {
    format!("#{}", 5420 + axis)
}

/// Writes an action that does not depend on the frame. Motions, frames, feeds, compensation and
/// subprogram marks are left to the backend: `false`.
pub fn common_action(action: &Action, lines: &mut Lines) -> bool {
    match action {
        Action::Plane(plane) => lines.add(Rank::Plane, plane_word(*plane)),
        Action::FeedMode(mode) => lines.add(Rank::FeedMode, feed_mode_word(*mode)),
        Action::SpindleSpeed(speed) => lines.add(Rank::Speed, format!("S{}", coordinate(*speed))),
        Action::Spindle(spindle) => lines.add(
            Rank::Spindle,
            match spindle {
                Spindle::Clockwise => "M3",
                Spindle::Counterclockwise => "M4",
                Spindle::Stop => "M5",
            },
        ),
        Action::Tool(tool) => lines.add(Rank::Tool, format!("T{tool}")),
        Action::ToolChange => lines.add(Rank::ToolChange, "M6"),
        Action::ToolLength(on) => lines.add(Rank::ToolLength, if *on { "G43" } else { "G49" }),
        Action::ToolOffset(row) => lines.add(Rank::ToolLength, format!("G43 H{row}")),
        Action::Coolant(coolant) => lines.add(
            Rank::Coolant,
            match coolant {
                Coolant::Mist => "M7",
                Coolant::Flood => "M8",
                Coolant::Off => "M9",
            },
        ),
        Action::WorkOffset(system) => lines.add(Rank::WorkOffset, work_offset_word(*system)),
        Action::PathControl(control) => lines.add(Rank::PathControl, path_control_words(*control)),
        Action::Dwell(seconds) => {
            // Beside an arc its P would be a number of turns.
            lines.flush();
            lines.add(Rank::Dwell, format!("G4 P{}", coordinate(*seconds)));
            lines.flush();
        }
        Action::Pause { optional } => lines.add(Rank::Stop, if *optional { "M1" } else { "M0" }),
        Action::OtherM(number) => lines.add(Rank::Coolant, format!("M{number}")),
        Action::Message(text) => {
            // LinuxCNC obeys the last comment of a line only: nothing may follow.
            lines.flush();
            lines.raw(&message(text));
        }
        Action::Preset(values) | Action::LocalOffset(values) => {
            let words = values.iter().enumerate().filter_map(|(axis, value)| {
                value.map(|value| format!("{}{}", LETTERS[axis], coordinate(value)))
            });
            let words: Vec<String> = words.collect();
            let code = match action {
                Action::Preset(_) => "G92",
                _ => "G52",
            };
            lines.add(Rank::Motion, format!("{code} {}", words.join(" ")));
        }
        Action::PresetOff => lines.add(Rank::Motion, "G92.1"),
        Action::Feed(_)
        | Action::Compensation(_)
        | Action::ToolNormal
        | Action::Frame(_)
        | Action::Move(_)
        | Action::Enter { .. }
        | Action::Leave { .. }
        | Action::End { .. } => return false,
    }
    true
}

fn plane_word(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "G17",
        Plane::Zx => "G18",
        Plane::Yz => "G19",
    }
}

fn feed_mode_word(mode: FeedMode) -> &'static str {
    match mode {
        FeedMode::InverseTime => "G93",
        FeedMode::PerMinute => "G94",
        FeedMode::PerRevolution => "G95",
    }
}

/// G40, G41, G42; with the row of the tool table that has the radius, if it is not that of the tool.
pub fn compensation_words(compensation: Compensation, row: Option<u32>) -> String {
    let word = match compensation {
        Compensation::Off => return "G40".to_string(),
        Compensation::Left => "G41",
        Compensation::Right => "G42",
    };
    match row {
        Some(row) => format!("{word} D{row}"),
        None => word.to_string(),
    }
}

/// The row of the tool table that G41 and G42 take the radius from after an action, if it is not
/// that of the tool in the spindle.
pub fn radius_row(action: &Action, before: Option<u32>) -> Option<u32> {
    match action {
        Action::ToolOffset(row) => Some(*row),
        Action::ToolChange | Action::ToolLength(_) => None,
        _ => before,
    }
}

fn work_offset_word(system: u8) -> String {
    match system {
        1..=6 => format!("G{}", 53 + system),
        _ => format!("G59.{}", system.saturating_sub(6)),
    }
}

/// G61.1, G61 or G64.
pub fn path_control_words(control: PathControl) -> String {
    match control {
        // LinuxCNC takes P0 for no limit at all.
        PathControl::Continuous {
            tolerance: Some(tolerance),
        } if coordinate(tolerance) == "0" => "G61".to_string(),
        PathControl::ExactStop => "G61.1".to_string(),
        PathControl::ExactPath => "G61".to_string(),
        PathControl::Continuous { tolerance: None } => "G64".to_string(),
        PathControl::Continuous {
            tolerance: Some(tolerance),
        } => {
            format!("G64 P{}", coordinate(tolerance))
        }
    }
}

/// The word of an axis that goes somewhere; `None` for one that keeps its place.
pub fn axis_word(axis: usize, target: Coordinate) -> Option<String> {
    let letter = LETTERS[axis];
    match target {
        Coordinate::Keep => None,
        Coordinate::At(value) => Some(format!("{letter}{}", coordinate(value))),
        Coordinate::By(step) => Some(format!(
            "{letter}[{}{}]",
            present_position(axis),
            signed(step)
        )),
    }
}

/// The words of a motion in machine coordinates. LinuxCNC's G53 leaves the tool out; where the tip is
/// to go there, its length is added.
pub fn machine_move_words(motion: &Move, rapid: bool, tool_length: bool) -> String {
    let mut words = vec![
        "G53".to_string(),
        if rapid { "G0" } else { "G1" }.to_string(),
    ];
    for (axis, target) in motion.target.iter().enumerate() {
        if let Coordinate::At(value) = target {
            let letter = LETTERS[axis];
            let value = coordinate(*value);
            words.push(match tool_length {
                true => format!("{letter}[{value}+#{}]", 5401 + axis),
                false => format!("{letter}{value}"),
            });
        }
    }
    words.join(" ")
}

/// I, J, K or R, and P for several turns.
pub fn centre_words(centre: Centre, extra_turns: u32, plane: Plane) -> String {
    const LETTERS: [&str; 3] = ["I", "J", "K"];
    let [first, second, _] = plane.axes();
    let mut words: Vec<(usize, String)> = match centre {
        Centre::Offset(offset) => [first, second]
            .into_iter()
            .zip(offset)
            .map(|(axis, offset)| (axis, format!("{}{}", LETTERS[axis], coordinate(offset))))
            .collect(),
        Centre::Point(point) => [first, second]
            .into_iter()
            .zip(point)
            .map(|(axis, point)| {
                let letter = LETTERS[axis];
                let word = match point {
                    Coordinate::Keep => format!("{letter}0"),
                    Coordinate::By(offset) => format!("{letter}{}", coordinate(offset)),
                    Coordinate::At(value) => {
                        format!("{letter}[{}-{}]", coordinate(value), present_position(axis))
                    }
                };
                (axis, word)
            })
            .collect(),
        Centre::Radius(radius) => vec![(0, format!("R{}", coordinate(radius)))],
    };
    words.sort();
    if extra_turns > 0 {
        words.push((3, format!("P{}", extra_turns + 1)));
    }
    let words: Vec<String> = words.into_iter().map(|(_, word)| word).collect();
    words.join(" ")
}

fn signed(value: f64) -> String {
    let text = coordinate(value);
    match text.starts_with('-') {
        true => text,
        false => format!("+{text}"),
    }
}
