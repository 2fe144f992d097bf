//! A canned cycle at many places: in a row (G60), along a parallelogram (G61), on a grid (G62), around a
//! circle (G63), along an arc (G64), at the end of a chord (G65). The place of the block before is the first of them; the cycle, or
//! the modal subroutine, has been there. (Fagor, CNC 8055 Programming Manual, "Multiple machining".)

use super::block_words::BlockWords;
use super::g_functions::OneShot;
use super::interpreter::Interpreter;
use super::syntax::Block;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::dialects::run::Next;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// How many places a row may have.
const MOST_PLACES: f64 = 9999.0;

/// How far from a whole number a number of steps may be.
const WHOLE: f64 = 1e-6;

type Places = Result<Vec<[f64; 2]>, Diagnostic>;

/// The parameters of a pattern, which share their letters with axes and offsets.
struct Parameters<'a> {
    words: &'a BlockWords,
    code: u32,
    span: Span,
}

/// The places of a pattern behind its first, units of the program, and the way between them.
struct Plan {
    first: [f64; 2],
    places: Vec<[f64; 2]>,
    way: Way,
    /// Of the circle, where the way is one.
    centre: Option<[f64; 2]>,
}

impl Interpreter<'_> {
    /// A block with one of G60 to G65, while a canned cycle is in force.
    pub(super) fn pattern(&mut self, words: &BlockWords, code: u32, span: Span) -> Done {
        if self.cycle.is_none() {
            return Err(Diagnostic::error(
                span,
                format!("G{code} repeats a canned cycle or a modal subroutine, and none is active"),
            )
            .help("define it in the block before, at the first place: G81 X10 Y10 Z2 I-5 F100"));
        }
        let plan = self.plan(words, code, span)?;
        let before = self.control.modal.motion;
        let feed = self.control.modal.feed;
        let mut last = plan.first;
        let mut done = Ok(());
        for place in plan.places {
            let words = self.way_to(place, last, plan.centre, span);
            last = place;
            self.control.modal.motion = Some(plan.way.motion);
            done = match plan.way.feed {
                None => self.cycle_block(&words, &OneShot::default(), span),
                Some(between) => self.cycle_with_feed(&words, between, feed, span),
            };
            if done.is_err() {
                break;
            }
        }
        self.control.modal.motion = before;
        done
    }

    /// The same while a subroutine is modal and no cycle is in force: it runs at each place.
    pub(super) fn modal_pattern(
        &mut self,
        words: &BlockWords,
        g: At<u32>,
        block: &Block,
        at: usize,
    ) -> Result<Next, Diagnostic> {
        let plan = self.plan(words, g.value, g.span)?;
        let [first, second, _] = self.control.modal.plane.axes();
        let mut next = Next::Block(at + 1);
        let mut last = plan.first;
        for place in plan.places {
            if !self.control.count_block(g.span) {
                return Ok(Next::Abort);
            }
            // The subroutine may have moved on, and left other modes behind.
            let now = [first, second].map(|axis| self.control.present(axis));
            if let [Some(x), Some(y)] = now {
                last = [x, y];
            }
            let mut words = self.way_to(place, last, plan.centre, g.span);
            words.feed = plan.way.feed;
            last = place;
            self.control.modal.motion = Some(plan.way.motion);
            self.thread = None;
            next = self.run_block_words(&words, None, block, at);
            if !matches!(next, Next::Block(_)) {
                break;
            }
        }
        Ok(next)
    }

    fn plan(&self, words: &BlockWords, code: u32, span: Span) -> Result<Plan, Diagnostic> {
        let parameters = Parameters { words, code, span };
        let places = parameters.places()?;
        let kept = parameters.kept(places.len())?;
        let way = parameters.way()?;
        let [first, second, _] = self.control.modal.plane.axes();
        let (Some(x), Some(y)) = (self.control.present(first), self.control.present(second)) else {
            return Err(Diagnostic::unknown_place(
                span,
                "the first place of this pattern is not known ahead of time",
            )
            .help("program it absolute in the block of the cycle"));
        };
        let centre = parameters.centre_of_arc().filter(|_| way.is_arc());
        let absolute = |[i, j]: [f64; 2]| [x + i, y + j];
        let kept = places.into_iter().zip(kept).filter(|(_, kept)| *kept);
        Ok(Plan {
            first: [x, y],
            places: kept.map(|(place, _)| absolute(place)).collect(),
            way,
            centre: centre.map(absolute),
        })
    }

    /// The words of a motion to a place, from the last one; `centre` of an arc.
    fn way_to(
        &self,
        place: [f64; 2],
        last: [f64; 2],
        centre: Option<[f64; 2]>,
        span: Span,
    ) -> BlockWords {
        let [first, second, _] = self.control.modal.plane.axes();
        let mut words = BlockWords::default();
        for (index, axis) in [first, second].into_iter().enumerate() {
            let value = match self.control.modal.incremental {
                true => place[index] - last[index],
                false => place[index],
            };
            words.axes[axis] = Some(At {
                value: Some(value),
                span,
            });
            words.centre[axis] = centre.map(|centre| At {
                value: centre[index] - last[index],
                span,
            });
        }
        words
    }

    /// To the next place with a feed of its own, and the cycle there.
    fn cycle_with_feed(
        &mut self,
        words: &BlockWords,
        between: At<f64>,
        feed: Option<f64>,
        span: Span,
    ) -> Done {
        if !self.control.count_block(span) {
            return Ok(());
        }
        self.control.feed(between)?;
        self.motion(words, &OneShot::default(), span)?;
        if let Some(feed) = feed {
            let value = feed / self.control.modal.feed_factor;
            self.control.feed(At { value, span })?;
        }
        self.run_cycle()
    }
}

/// How the tool goes from place to place.
struct Way {
    motion: Motion,
    /// None for rapid motion.
    feed: Option<At<f64>>,
}

impl Way {
    fn is_arc(&self) -> bool {
        matches!(self.motion, Motion::Clockwise | Motion::Counterclockwise)
    }
}

impl Parameters<'_> {
    /// Which of the places behind the first are not left out. The first is place 1.
    fn kept(&self, behind: usize) -> Result<Vec<bool>, Diagnostic> {
        let mut kept = vec![true; behind];
        for At { value, span } in &self.words.left_out {
            let [first, last] = value.map(|place| place as usize);
            if first < 2 || last > behind + 1 {
                return Err(Diagnostic::error(
                    *span,
                    format!("the pattern has places 1 to {}", behind + 1),
                )
                .help("the first one has been machined in the block of the cycle"));
            }
            kept[first - 2..last - 1].fill(false);
        }
        Ok(kept)
    }

    /// C: 0 rapid, 1 straight, 2 and 3 along the circle, all but 0 with F.
    fn way(&self) -> Result<Way, Diagnostic> {
        let around = matches!(self.code, 63..=65);
        let motion = match self.axis(5) {
            None | Some(0.0) => Motion::Rapid,
            Some(1.0) => Motion::Line,
            Some(2.0) if around => Motion::Clockwise,
            Some(3.0) if around => Motion::Counterclockwise,
            Some(_) => {
                return Err(self.wrong(
                    "C says how the tool goes from place to place",
                    "C0 is rapid, C1 straight with F, C2 and C3 with G63 to G65 along the circle",
                ));
            }
        };
        match (motion, self.words.feed) {
            (Motion::Rapid, Some(_)) => Err(self.wrong(
                "F is the feed of C1, C2 and C3",
                "leave it out, or write C1",
            )),
            (Motion::Rapid, None) => Ok(Way { motion, feed: None }),
            (_, None) => Err(self.wrong(
                "C1, C2 and C3 need F here",
                "without it the control goes as fast as a parameter of the machine says",
            )),
            (_, feed) => Ok(Way { motion, feed }),
        }
    }

    /// Where the centre of the circle is, seen from the first place.
    fn centre_of_arc(&self) -> Option<[f64; 2]> {
        let around = matches!(self.code, 63..=65);
        let centre = self.axis(0).zip(self.axis(1)).filter(|_| around);
        centre.map(|(x, y)| [x, y])
    }

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
            65 => return self.chord(),
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
    ) -> Result<(usize, f64), Diagnostic> {
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
        let turned = (1..count).map(|number| around_centre([x, y], step * number as f64));
        Ok(turned.collect())
    }

    /// G65: from the first place along a chord of the circle about X and Y. A is the angle of the
    /// middle of the chord, seen from the centre; I its length, above 0 counterclockwise.
    fn chord(&self) -> Places {
        let (Some(x), Some(y)) = (self.axis(0), self.axis(1)) else {
            return Err(self.wrong(
                "X and Y of the centre are missing",
                "seen from the first place",
            ));
        };
        let radius = x.hypot(y);
        let turned = match (self.axis(3), self.centre(0)) {
            // From the centre to the first place is (-x, -y); the end lies on the other side of the middle.
            (Some(middle), None) => 2.0 * (middle - (-y).atan2(-x).to_degrees()),
            (None, Some(chord)) if chord.abs() <= 2.0 * radius => {
                2.0 * (chord / (2.0 * radius)).asin().to_degrees()
            }
            (None, Some(_)) => {
                return Err(self.wrong(
                    "the chord I is longer than the circle is wide",
                    "X and Y lead from the first place to the centre",
                ));
            }
            _ => {
                return Err(self.wrong(
                    "either A or I is needed",
                    "A is the angle of the middle of the chord seen from the centre, I its length",
                ));
            }
        };
        if radius == 0.0 {
            return Err(self.wrong("the centre is the first place", "check X and Y"));
        }
        Ok(vec![around_centre([x, y], turned)])
    }

    /// A number of places that is one.
    fn whole(&self, count: f64, letter: &str) -> Result<usize, Diagnostic> {
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
            60 => &[0, 3, 5],
            61 | 62 => &[0, 1, 3, 4, 5],
            63 => &[0, 1, 5],
            65 => &[0, 1, 3, 5],
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
            words.finish_feed,
        ];
        let mut strange: Vec<Span> = strange
            .chain(numbers.into_iter().flatten().map(|word| word.span))
            .chain(words.tool.map(|word| word.span))
            .chain(words.m.first().map(|word| word.span))
            .chain(words.g.iter().skip(1).map(|word| word.span))
            .collect();
        if !matches!(self.code, 61 | 62) {
            strange.extend(words.centre[1].map(|word| word.span));
            strange.extend(words.offset.map(|word| word.span));
        }
        if self.code == 65 {
            strange.extend(words.centre[2].map(|word| word.span));
        }
        if let Some(span) = strange.into_iter().min_by_key(|span| span.start) {
            return Err(Diagnostic::error(
                span,
                format!("this is not supported in a block with G{}", self.code),
            )
            .help("other functions stand in another block"));
        }
        Ok(())
    }

    fn axis(&self, axis: usize) -> Option<f64> {
        self.words.axes[axis].and_then(|word| word.value)
    }

    fn centre(&self, letter: usize) -> Option<f64> {
        self.words.centre[letter].map(|word| word.value)
    }

    fn wrong(&self, what: &str, help: &str) -> Diagnostic {
        Diagnostic::error(self.span, format!("G{}: {what}", self.code)).help(help)
    }
}

/// The first place, which is the origin, turned about a centre by degrees.
fn around_centre([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos_degrees(angle);
    // From the centre to the first place is (-x, -y).
    [x - x * cos + y * sin, y - x * sin - y * cos]
}

const STEP_OR_COUNT: &str =
    "I is the angle of a step, K the number of places, the first one included";
