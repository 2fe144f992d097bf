//! The words that all backends write in the same way.

use super::comment::message;
use super::line::{Lines, Rank};
use super::modes::Modes;
use super::number::{coordinate, push_coordinate};
use crate::diagnostics::Diagnostic;
use crate::program::moves::{Centre, Coordinate, MoveKind};
use crate::program::{
    Action, Compensation, Coolant, FeedMode, OrientWay, PathControl, Plane, Spindle,
};
use crate::source::Span;

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
        Action::FeedMode(mode) => {
            lines.add(Rank::FeedMode, feed_mode_word(*mode));
            lines.feed_goes_with_motion(*mode == FeedMode::InverseTime);
        }
        Action::SpindleSpeed(speed) => lines.add(Rank::Speed, format!("S{}", coordinate(*speed))),
        Action::Spindle(spindle) => lines.add(
            Rank::Spindle,
            match spindle {
                Spindle::Clockwise => "M3",
                Spindle::Counterclockwise => "M4",
                Spindle::Stop => "M5",
            },
        ),
        Action::SurfaceSpeed(Some(surface)) => {
            let limit = surface
                .limit
                .map_or(String::new(), |limit| format!(" D{}", coordinate(limit)));
            let speed = coordinate(surface.speed);
            lines.add(Rank::Speed, format!("G96{limit} S{speed}"));
        }
        Action::SurfaceSpeed(None) => lines.add(Rank::FeedMode, "G97"),
        Action::Orient(angle, way) => {
            // Without P it is the shorter way.
            let way = match way {
                OrientWay::Shorter => "",
                OrientWay::Clockwise => " P1",
                OrientWay::Counterclockwise => " P2",
            };
            lines.add(Rank::Spindle, format!("M19 R{}{way}", coordinate(*angle)));
        }
        Action::Overrides(on) => {
            // It must not wait for the motion beside it.
            lines.flush();
            lines.add(Rank::Coolant, if *on { "M48" } else { "M49" });
            lines.flush();
        }
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
            let words = axis_values(values);
            let code = match action {
                Action::Preset(_) => "G92",
                _ => "G52",
            };
            lines.add(Rank::Motion, format!("{code} {}", words.join(" ")));
        }
        Action::SystemValues(values) => {
            let mut words = axis_values(&values.axes);
            if let Some(rotation) = values.rotation {
                words.push(format!("R{}", coordinate(rotation)));
            }
            // Its axes must not stand beside those of a motion.
            lines.flush();
            let words = words.join(" ");
            lines.add(
                Rank::WorkOffset,
                format!("G10 L2 P{} {words}", values.system),
            );
            lines.flush();
        }
        // It is written with the compensation.
        Action::CutterDiameter(_) => {}
        Action::PresetOff => lines.add(Rank::Motion, "G92.1"),
        // It is written with the compensation.
        Action::RadiusRow(_) => {}
        Action::Feed(_)
        | Action::Compensation(_)
        | Action::ToolNormal
        | Action::RotaryZero
        | Action::Retract(_)
        | Action::Frame(_)
        | Action::ContourStart(_)
        | Action::Move(_)
        | Action::Enter { .. }
        | Action::Leave { .. }
        | Action::End { .. } => return false,
    }
    true
}

/// `X10`, for the axes that have a value.
fn axis_values(values: &[Option<f64>; 9]) -> Vec<String> {
    let words = values.iter().enumerate().filter_map(|(axis, value)| {
        value.map(|value| format!("{}{}", LETTERS[axis], coordinate(value)))
    });
    words.collect()
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

/// G40, G41, G42; with the row of the tool table that has the radius, if it is not that of the tool, or with
/// a diameter of their own.
pub fn compensation_words(compensation: Compensation, modes: &Modes) -> String {
    let word = match compensation {
        Compensation::Off => return "G40".to_string(),
        Compensation::Left => "G41",
        Compensation::Right => "G42",
    };
    match (modes.cutter_diameter, modes.radius_row) {
        (Some(diameter), _) => format!("{word}.1 D{}", coordinate(diameter)),
        (None, Some(row)) => format!("{word} D{row}"),
        (None, None) => word.to_string(),
    }
}

fn work_offset_word(system: u8) -> String {
    match system {
        1..=6 => format!("G{}", 53 + system),
        _ => format!("G59.{}", system.saturating_sub(6)),
    }
}

/// A dwell of no time, for which LinuxCNC waits until the machine rests.
pub const STOPPING_DWELL: &str = "G4 P0";

/// G61.1, G61 or G64 with its P.
pub fn path_control_words(control: PathControl) -> String {
    match control {
        // LinuxCNC takes P0 for no limit at all.
        PathControl::Continuous { tolerance } if coordinate(tolerance) == "0" => "G61".to_string(),
        PathControl::ExactStop => "G61.1".to_string(),
        PathControl::ExactPath => "G61".to_string(),
        PathControl::Continuous { tolerance } => format!("G64 P{}", coordinate(tolerance)),
    }
}

/// Appends the words of the axes that go somewhere, each with a blank before it.
pub fn push_axis_words(text: &mut String, targets: &[Coordinate; 9]) {
    for (axis, target) in targets.iter().enumerate() {
        let letter = LETTERS[axis];
        match *target {
            Coordinate::Keep => {}
            Coordinate::At(value) => {
                text.push(' ');
                text.push_str(letter);
                push_coordinate(text, value);
            }
            Coordinate::By(step) => {
                let present = present_position(axis);
                text.push_str(&format!(" {letter}[{present}{}]", signed(step)));
            }
        }
    }
}

/// Appends the words of a motion that follows the spindle; the axes are those of `targets`. `false` for
/// any other motion.
pub fn push_spindle_motion(text: &mut String, kind: &MoveKind, targets: &[Coordinate; 9]) -> bool {
    let (code, pitch, back) = match *kind {
        MoveKind::Thread { pitch } => ("G33", pitch, 1.0),
        MoveKind::Tap { pitch, back } => ("G33.1", pitch, back),
        _ => return false,
    };
    text.push_str(code);
    push_axis_words(text, targets);
    text.push_str(" K");
    push_coordinate(text, pitch);
    if back != 1.0 {
        text.push_str(" I");
        push_coordinate(text, back);
    }
    true
}

/// Why a motion that follows the spindle cannot be written under a frame that scales.
pub fn scaled_thread(span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        "a thread under a scale: its pitch would be scaled too",
    )
    .help("end the scale before the thread")
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
