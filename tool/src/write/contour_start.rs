//! The move onto a compensated contour that turns towards the tool at its start.
//!
//! LinuxCNC ends such a move where the paths beside it and beside the first element meet. The element therefore
//! begins as far behind the start of the contour as lets them meet beside that start: the tool comes there in a
//! straight line, as on the other controls. How far that is depends on the radius of the tool. With the start as
//! origin, d the direction of the element, h and b how far the tool comes from beside and behind it, and r the
//! radius, the circle of the tool beside the start touches the line of the move, from (-b, h) to (-l, 0), where
//! l = r h / (sqrt(b² + h² - 2 r h) + b).

use super::line::{Lines, Rank};
use super::number::{coordinate, factor};
use super::words::{LETTERS, push_axis_words};
use crate::diagnostics::Diagnostic;
use crate::program::Plane;
use crate::program::contour_start::ContourStart;
use crate::program::moves::Coordinate;
use crate::source::Span;

/// How much further back an element begins that leads to the start of an arc, machine units: it must not end where
/// the tool begins on it.
const BEFORE_ARC: f64 = 0.001;

/// What takes the place of the words of the plane in the move onto the contour.
pub struct Onto {
    /// Both axes of the plane, with their words.
    words: [(usize, String); 2],
    /// The line that leads to the start of the contour behind it.
    then: Option<String>,
}

impl Onto {
    /// Works it out for a start in coordinates of LinuxCNC. Where the radius is known to LinuxCNC only, the lines that
    /// work it out there are written.
    ///
    /// # Errors
    ///
    /// The tool comes from too near for its diameter, where that is known.
    pub fn begin(
        start: &ContourStart,
        plane: Plane,
        lines: &mut Lines,
        span: Span,
    ) -> Result<Onto, Diagnostic> {
        let [first, second, _] = plane.axes();
        let [along, across] = start.along;
        let apart = [start.from[0] - start.to[0], start.from[1] - start.to[1]];
        let side = if start.left { 1.0 } else { -1.0 };
        let beside = (apart[1] * along - apart[0] * across) * side;
        let behind = -(apart[0] * along + apart[1] * across);
        let square = beside.powi(2) + behind.powi(2);
        // The move has to come from behind the tool beside the start, or from more than its diameter beside the contour.
        // From further behind than beside, what is left of the way must still be longer than the radius: LinuxCNC
        // refuses it else.
        let further = if start.straight { 0.0 } else { BEFORE_ARC };
        let most = match behind > 0.0 {
            true if behind > beside => longest_diameter(beside, behind) - 2.0 * further,
            true => square / beside,
            false => beside,
        };
        let back = match start.diameter {
            Some(diameter) if diameter >= most => return Err(too_near(most, diameter, span)),
            Some(diameter) => {
                let root = (square - diameter * beside).sqrt();
                Back::Known(diameter / 2.0 * beside / (root + behind) + further)
            }
            None => {
                write_back(lines, [beside, behind, square], most, further);
                Back::Worked
            }
        };
        let word = |axis: usize, place: f64, step: f64| (axis, back.word(axis, place, step));
        Ok(Onto {
            words: [
                word(first, start.to[0], along),
                word(second, start.to[1], across),
            ],
            then: (!start.straight).then(|| {
                let mut text = String::new();
                let mut targets = [Coordinate::Keep; 9];
                targets[first] = Coordinate::At(start.to[0]);
                targets[second] = Coordinate::At(start.to[1]);
                push_axis_words(&mut text, &targets);
                text
            }),
        })
    }

    /// Appends the words of the axes.
    pub fn push_axis_words(&self, text: &mut String, targets: &[Coordinate; 9]) {
        for axis in 0..targets.len() {
            if let Some((_, word)) = self.words.iter().find(|(own, _)| *own == axis) {
                text.push(' ');
                text.push_str(word);
                continue;
            }
            let mut other = [Coordinate::Keep; 9];
            other[axis] = targets[axis];
            push_axis_words(text, &other);
        }
    }

    /// Adds what follows the move with this code.
    pub fn end(&self, code: &str, lines: &mut Lines) {
        if let Some(then) = &self.then {
            lines.add(Rank::Motion, format!("{code}{then}"));
        }
    }
}

/// The diameter of the tool whose way from (-`behind`, `beside`) to where the element begins is as long as its radius;
/// `behind` > `beside`, machine units.
///
/// With t the tangent of half the angle between that way and the element, the radius is b t + h (1 - t²) / 2. The way
/// is longer where h (t³ + t² - t + 1) > 2 b t². In what is divided by h, from t = b / h, the tool with which the way
/// just leads there, to the t of no tool, the difference of both sides is convex and changes its sign once.
fn longest_diameter(beside: f64, behind: f64) -> f64 {
    let ratio = behind / beside;
    let is_longer = |t: f64| ((t + 1.0 - 2.0 * ratio) * t - 1.0) * t + 1.0 > 0.0;
    let (mut short, mut long) = (ratio, ratio + ratio.hypot(1.0));
    for _ in 0..60 {
        let middle = f64::midpoint(short, long);
        if is_longer(middle) {
            long = middle;
        } else {
            short = middle;
        }
    }
    2.0 * behind * long + beside * (1.0 - long * long)
}

/// How far back the first element begins.
enum Back {
    Known(f64),
    /// It is in a parameter.
    Worked,
}

impl Back {
    /// A coordinate of the place from which the element begins; `step`: its direction along this axis.
    fn word(&self, axis: usize, place: f64, step: f64) -> String {
        let letter = LETTERS[axis];
        let text = factor(step.abs());
        match self {
            Back::Known(back) => format!("{letter}{}", coordinate(place - step * back)),
            Back::Worked if text == "0" => format!("{letter}{}", coordinate(place)),
            Back::Worked => {
                let sign = if step > 0.0 { '-' } else { '+' };
                let times = if text == "1" {
                    String::new()
                } else {
                    format!("{text}*")
                };
                format!("{letter}[{}{sign}{times}#<back>]", coordinate(place))
            }
        }
    }
}

/// The lines in which LinuxCNC works out how far back the element begins.
fn write_back(lines: &mut Lines, [beside, behind, square]: [f64; 3], most: f64, further: f64) {
    lines.flush();
    let label = lines.condition();
    lines.raw(&format!("o{label} if [#5410 GE {}]", coordinate(most)));
    lines.raw(&format!(
        "(abort, the way onto this contour begins too near: it takes tools of less than {})",
        coordinate(most)
    ));
    lines.raw(&format!("o{label} endif"));
    let [half, beside, square] = [beside / 2.0, beside, square].map(coordinate);
    let distance = match coordinate(behind.abs()).as_str() {
        "0" => String::new(),
        text if behind < 0.0 => format!("-{text}"),
        text => format!("+{text}"),
    };
    let further = if further > 0.0 {
        format!("+{}", coordinate(further))
    } else {
        String::new()
    };
    lines.raw(&format!(
        "#<back>=[#5410*{half}/[SQRT[{square}-#5410*{beside}]{distance}]{further}]"
    ));
}

fn too_near(most: f64, diameter: f64, span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        format!(
            "the way onto this contour begins too near: it takes tools of less than {}, and this one has {}",
            coordinate(most),
            coordinate(diameter)
        ),
    )
    .help("let it begin behind the start of the contour, or more than the diameter of the tool beside it")
}
