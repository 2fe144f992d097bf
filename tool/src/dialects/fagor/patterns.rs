//! A canned cycle at many places: in a row (G60), along a parallelogram (G61), on a grid (G62), around a
//! circle (G63), along an arc (G64). The place of the block before is the first of them; the cycle has
//! been there. (Fagor, CNC 8055 Programming Manual, "Multiple machining".)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// How many places a row may have.
const MOST_PLACES: f64 = 9999.0;

/// How far from a whole number a number of steps may be.
const WHOLE: f64 = 1e-6;

type Places = Result<Vec<[f64; 2]>, Box<Diagnostic>>;

/// The parameters of a pattern, which share their letters with axes and offsets.
struct Parameters<'a> {
    words: &'a BlockWords,
    code: u32,
    span: Span,
}

impl Interpreter<'_> {
    /// A block with one of G60 to G64.
    pub(super) fn pattern(&mut self, words: &BlockWords, code: u32, span: Span) -> Done {
        if self.cycle.is_none() {
            return Err(Box::new(
                Diagnostic::error(
                    span,
                    format!("G{code} repeats a canned cycle, and none is active"),
                )
                .help("define it in the block before, at the first place: G81 X10 Y10 Z2 I-5 F100"),
            ));
        }
        let parameters = Parameters { words, code, span };
        let places = parameters.places()?;
        let [first, second, _] = self.control.modal.plane.axes();
        let (Some(x), Some(y)) = (self.control.present(first), self.control.present(second)) else {
            return Err(Box::new(
                Diagnostic::error(
                    span,
                    "the first place of this pattern is not known ahead of time",
                )
                .help("program it absolute in the block of the cycle"),
            ));
        };
        let before = self.control.modal.motion.replace(Motion::Rapid);
        let mut last = [0.0, 0.0];
        let mut done = Ok(());
        for place in places {
            let value = match self.control.modal.incremental {
                true => [place[0] - last[0], place[1] - last[1]],
                false => [x + place[0], y + place[1]],
            };
            last = place;
            let mut words = BlockWords::default();
            for (axis, value) in [first, second].into_iter().zip(value) {
                words.axes[axis] = Some(At {
                    value: Some(value),
                    span,
                });
            }
            done = self.cycle_block(&words, span);
            if done.is_err() {
                break;
            }
        }
        self.control.modal.motion = before;
        done
    }
}

impl Parameters<'_> {
    /// The places behind the first, seen from it.
    fn places(&self) -> Places {
        self.check()?;
        let angle = self.axis(3).unwrap_or(0.0);
        let row = |count: usize, step: f64, angle: f64| -> Vec<[f64; 2]> {
            let (sin, cos) = sin_cos_degrees(angle);
            let along = (1..count).map(|number| step * number as f64);
            along.map(|way| [way * cos, way * sin]).collect()
        };
        let (count, step) = match self.code {
            63 | 64 => return self.around(),
            _ => self.row(
                ["X", "I", "K"],
                self.axis(0),
                self.centre(0),
                self.centre(2),
            )?,
        };
        let first = row(count, step, angle);
        if self.code == 60 {
            return Ok(first);
        }
        let offset = self.words.offset.map(|word| word.value);
        let (rows, pitch) = self.row(["Y", "J", "D"], self.axis(1), self.centre(1), offset)?;
        let second = row(rows, pitch, angle + self.axis(4).unwrap_or(90.0));
        let end = |line: &[[f64; 2]]| line.last().copied().unwrap_or_default();
        let (corner, other) = (end(&first), end(&second));
        let backwards = |line: &[[f64; 2]]| -> Vec<[f64; 2]> {
            // From the last but one to the first place of all.
            let mut line: Vec<[f64; 2]> = line.iter().rev().skip(1).copied().collect();
            line.push([0.0, 0.0]);
            line
        };
        let moved = |line: &[[f64; 2]], by: [f64; 2]| -> Vec<[f64; 2]> {
            line.iter().map(|p| [p[0] + by[0], p[1] + by[1]]).collect()
        };
        let mut places = first.clone();
        if self.code == 61 {
            places.extend(moved(&second, corner));
            places.extend(moved(&backwards(&first), other));
            let mut home = backwards(&second);
            home.pop();
            places.extend(home);
            return Ok(places);
        }
        for (number, base) in second.iter().enumerate() {
            let mut line = vec![[0.0, 0.0]];
            line.extend(&first);
            if number % 2 == 0 {
                line.reverse();
            }
            places.extend(moved(&line, *base));
        }
        Ok(places)
    }

    /// Number of places and step of a row, by two of its length, its step and its number of places.
    fn row(
        &self,
        [long, wide, many]: [&str; 3],
        length: Option<f64>,
        step: Option<f64>,
        count: Option<f64>,
    ) -> Result<(usize, f64), Box<Diagnostic>> {
        if length.into_iter().chain(step).any(|value| value <= 0.0) {
            return Err(self.wrong(
                &format!("{long} and {wide} must be above 0"),
                "A, and with G61 and G62 B, say which way the row goes",
            ));
        }
        let (count, step) = match (length, step, count) {
            (Some(length), Some(step), None) => (length / step + 1.0, step),
            (Some(length), None, Some(count)) => (count, length / (count - 1.0)),
            (None, Some(step), Some(count)) => (count, step),
            _ => {
                return Err(self.wrong(
                    &format!("a row is given by two of {long}, {wide} and {many}"),
                    &format!("{long} is its length, {wide} the step, {many} the number of places"),
                ));
            }
        };
        Ok((self.whole(count, many)?, step))
    }

    /// G63 and G64: X and Y lead to the centre.
    fn around(&self) -> Places {
        let (Some(x), Some(y)) = (self.axis(0), self.axis(1)) else {
            return Err(self.wrong(
                "X and Y of the centre are missing",
                "seen from the first place",
            ));
        };
        let (step, count) = (self.centre(0), self.centre(2));
        let (count, step) = match (self.code, step, count) {
            (63, Some(step), None) => ((360.0 / step).abs(), step),
            (63, None, Some(count)) => (count, 360.0 / count),
            (64, step, count) => {
                let Some(travel) = self.axis(4).filter(|travel| *travel > 0.0) else {
                    return Err(self.wrong(
                        "it needs B, the angle of the arc, above 0",
                        "the sign of I says which way round",
                    ));
                };
                match (step, count) {
                    (Some(step), None) => ((travel / step).abs() + 1.0, step),
                    (None, Some(count)) => (count, travel / (count - 1.0)),
                    _ => return Err(self.wrong("I or K is needed, and not both", STEP_OR_COUNT)),
                }
            }
            _ => return Err(self.wrong("I or K is needed, and not both", STEP_OR_COUNT)),
        };
        let count = self.whole(count, "K")?;
        let turned = (1..count).map(|number| {
            let (sin, cos) = sin_cos_degrees(step * number as f64);
            // From the centre to the first place is (-x, -y).
            [x - x * cos + y * sin, y - x * sin - y * cos]
        });
        Ok(turned.collect())
    }

    /// A number of places that is one.
    fn whole(&self, count: f64, letter: &str) -> Result<usize, Box<Diagnostic>> {
        let nearest = count.round();
        match (count - nearest).abs() < WHOLE && (2.0..=MOST_PLACES).contains(&nearest) {
            true => Ok(nearest as usize),
            false => Err(self.wrong(
                &format!("these values make {count} places"),
                &format!(
                    "length and step must give a whole number above 1; {letter} says it itself"
                ),
            )),
        }
    }

    /// What must not be in the block.
    fn check(&self) -> Done {
        let words = self.words;
        let known: &[usize] = match self.code {
            60 => &[0, 3],
            61 | 62 => &[0, 1, 3, 4],
            63 => &[0, 1, 5],
            _ => &[0, 1, 4, 5],
        };
        let axes = words.axes.iter().enumerate();
        let strange = axes.filter(|(axis, _)| !known.contains(axis));
        let strange = strange.filter_map(|(_, word)| word.map(|word| word.span));
        let numbers = [
            words.radius,
            words.angle,
            words.speed,
            words.pitch,
            words.times,
        ];
        let mut strange: Vec<Span> = strange
            .chain(numbers.into_iter().flatten().map(|word| word.span))
            .chain(words.tool.map(|word| word.span))
            .chain(words.feed.map(|word| word.span))
            .chain(words.m.first().map(|word| word.span))
            .chain(words.g.iter().skip(1).map(|word| word.span))
            .collect();
        if !matches!(self.code, 61 | 62) {
            strange.extend(words.centre[1].map(|word| word.span));
            strange.extend(words.offset.map(|word| word.span));
        }
        if let Some(span) = strange.into_iter().min_by_key(|span| span.start) {
            return Err(Box::new(
                Diagnostic::error(span, format!("this is not supported in a block with G{}", self.code))
                    .help(
                        "places that are left out (P to V) are not, nor ways with feed (C1 to C3, F); other \
                         functions stand in another block",
                    ),
            ));
        }
        match self.axis(5) {
            None | Some(0.0) => Ok(()),
            Some(_) => Err(self.wrong(
                "only C0, rapid motion between the places, is supported",
                "write C0",
            )),
        }
    }

    fn axis(&self, axis: usize) -> Option<f64> {
        self.words.axes[axis].and_then(|word| word.value)
    }

    fn centre(&self, letter: usize) -> Option<f64> {
        self.words.centre[letter].map(|word| word.value)
    }

    fn wrong(&self, what: &str, help: &str) -> Box<Diagnostic> {
        Box::new(Diagnostic::error(self.span, format!("G{}: {what}", self.code)).help(help))
    }
}

const STEP_OR_COUNT: &str =
    "I is the angle of a step, K the number of places, the first one included";
