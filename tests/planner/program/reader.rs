//! Programs as text: one format for what random tests print and for what is kept in `regressions`.
//!
//! A line says one thing; behind `#` is a comment. Numbers are as Rust prints them, so that a program that is written
//! and read is the same to the last bit. In this order:
//!
//! ```text
//! velocity 60.0                  of all axes, or nine numbers, units/s
//! acceleration 600.0             units/s2
//! jerk inf                       units/s3; each further line of jerk makes one more program of the file
//! max_velocity 250.0             no move is faster
//! slider 1000.0                  where the slider of the velocity stands; without the line it was never set
//! mode P0.05                     before the first move: P with a tolerance (G64), G61 or G61.1; each further line
//!                                makes one more program
//! supply 1                       servo periods from one move to the next; 0: all come before the first period
//!
//! line X1.0 A-2.0 F10.0 P0.1     displacements, the feed in units/s, and the mode if it changes before the move
//! arc radial 1.0 0.0 0.0 tilt 0.0 0.0 1.0 radius 2.0 angle 0.5 height 0.0 revolutions -1 A1.0 F10.0 G0
//! turn center 0.1 0.2 across Z angle -3.5 height 0.0 F10.0
//!
//! at 27 feed 0.5                 what happens before a servo period, counted from 0
//! at 100..124 pause              before each of these: one more program for each; all such ranges go along together
//!
//! ask jerk 1.05
//! ```
//!
//! See [`super::Shape`] for arc and turn, where A to W are the displacements of the other axes. Behind F may stand G0
//! (a rapid move), G2 (an arc for motion), M50P0 (no feed override), `spindle` (waits until spindles are at speed).
//!
//! Events: `pause`, `resume`, `abort`, `step`, `gone` (the operator goes home and leaves everything at 100 %), `feed`,
//! `rapid`, `slider` and `adaptive` with a number, `spindles` with `on` or `off`.
//!
//! Asked, see [`Asked`]: `velocity`, `acceleration`, `jerk` and `feed` with the most over the limit or F, `path`,
//! `rests` with `explained` or `none`, `periods` with a number, `same_periods`.

use std::str::{FromStr, SplitWhitespace};

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::{MotionType, TerminationCondition};

use super::{Asked, Event, FEED_OVERRIDE_OFF, Program, Programmed, RestsAsked, Shape};

/// The letters of the axes.
pub const LETTERS: [char; 9] = ['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'];

/// What the lines of a text say.
#[derive(Default)]
struct Said {
    velocity: Option<Axes>,
    acceleration: Option<Axes>,
    jerks: Vec<Axes>,
    max_velocity: Option<f64>,
    slider: Option<f64>,
    modes: Vec<TerminationCondition>,
    supply: Option<usize>,
    moves: Vec<Programmed>,
    /// Before which periods, and what.
    events: Vec<(Vec<usize>, Event)>,
    asked: Asked,
}

/// The programs that a text stands for.
///
/// # Errors
/// The line that cannot be read, and why; or what is missing.
pub fn read(text: &str) -> Result<Vec<Program>, String> {
    let mut said = Said::default();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = Words(line.split_whitespace());
        let Some(kind) = words.0.next() else { continue };
        said.take(kind, &mut words)
            .and_then(|()| words.end())
            .map_err(|error| format!("line {}: {error}", number + 1))?;
    }
    said.programs()
}

/// The words of a line that are left.
struct Words<'a>(SplitWhitespace<'a>);

impl<'a> Words<'a> {
    fn word(&mut self, what: &str) -> Result<&'a str, String> {
        self.0.next().ok_or_else(|| format!("{what} is missing"))
    }

    fn value<T: FromStr>(&mut self, what: &str) -> Result<T, String> {
        parsed(self.word(what)?, what)
    }

    /// The value behind this word.
    fn named<T: FromStr>(&mut self, name: &str) -> Result<T, String> {
        match self.word(name)? {
            word if word == name => self.value(name),
            word => Err(format!("{word} is not {name}")),
        }
    }

    /// The values behind this word.
    fn all_named<const N: usize>(&mut self, name: &str) -> Result<[f64; N], String> {
        let mut values = [0.0; N];
        let (first, others) = values.split_first_mut().ok_or("nothing to read")?;
        *first = self.named(name)?;
        for value in others {
            *value = self.value(name)?;
        }
        Ok(values)
    }

    /// One number for all axes, or nine.
    fn axes(&mut self, what: &str) -> Result<Axes, String> {
        let first = self.value(what)?;
        if self.0.clone().next().is_none() {
            return Ok(Axes::repeat(first));
        }
        let mut axes = Axes::zeros();
        axes[0] = first;
        for value in axes.iter_mut().skip(1) {
            *value = self.value(what)?;
        }
        Ok(axes)
    }

    fn end(&mut self) -> Result<(), String> {
        match self.0.next() {
            None => Ok(()),
            Some(word) => Err(format!("{word} is too much")),
        }
    }
}

fn parsed<T: FromStr>(word: &str, what: &str) -> Result<T, String> {
    word.parse()
        .map_err(|_| format!("{word} is no value of {what}"))
}

impl Said {
    fn take(&mut self, kind: &str, words: &mut Words) -> Result<(), String> {
        match kind {
            "velocity" => self.velocity = Some(words.axes(kind)?),
            "acceleration" => self.acceleration = Some(words.axes(kind)?),
            "jerk" => self.jerks.push(words.axes(kind)?),
            "max_velocity" => self.max_velocity = Some(words.value(kind)?),
            "slider" => self.slider = Some(words.value(kind)?),
            "mode" => self.modes.push(mode(words.word(kind)?)?),
            "supply" => self.supply = Some(words.value(kind)?),
            "line" | "arc" | "turn" => self.moves.push(programmed(kind, words)?),
            "at" => self.events.push(event(words)?),
            "ask" => ask(&mut self.asked, words)?,
            other => return Err(format!("{other} says nothing")),
        }
        Ok(())
    }

    fn programs(self) -> Result<Vec<Program>, String> {
        let shifts = self.shifts()?;
        let mut programs = Vec::new();
        for jerk in &self.jerks {
            for mode in &self.modes {
                for shift in 0..shifts {
                    programs.push(self.program(*jerk, *mode, shift)?);
                }
            }
        }
        if programs.is_empty() {
            return Err("jerk or mode is missing".to_owned());
        }
        Ok(programs)
    }

    /// How many periods the ranges of events have.
    fn shifts(&self) -> Result<usize, String> {
        let mut ranges = self.events.iter().map(|(periods, _)| periods.len());
        let shifts = self.events.iter().map(|(periods, _)| periods.len()).max();
        let shifts = shifts.unwrap_or(1);
        if ranges.any(|length| length != 1 && length != shifts) {
            return Err("the ranges of events are not of one length".to_owned());
        }
        Ok(shifts)
    }

    fn program(
        &self,
        jerk: Axes,
        mode: TerminationCondition,
        shift: usize,
    ) -> Result<Program, String> {
        let missing = |what: &str| format!("{what} is missing");
        let events: Vec<_> = self
            .events
            .iter()
            .map(|(periods, event)| (periods[shift.min(periods.len() - 1)], *event))
            .collect();
        if !events.is_sorted_by_key(|(period, _)| *period) {
            return Err("events are not in order".to_owned());
        }
        Ok(Program {
            limits: AxisLimits {
                velocity: self.velocity.ok_or_else(|| missing("velocity"))?,
                acceleration: self.acceleration.ok_or_else(|| missing("acceleration"))?,
                jerk,
            },
            max_velocity: self.max_velocity.ok_or_else(|| missing("max_velocity"))?,
            slider: self.slider,
            mode,
            supply: self.supply.ok_or_else(|| missing("supply"))?,
            moves: self.moves.clone(),
            events,
            asked: self.asked,
        })
    }
}

fn mode(word: &str) -> Result<TerminationCondition, String> {
    match (word, word.strip_prefix('P')) {
        ("G61.1", _) => Ok(TerminationCondition::Stop),
        ("G61", _) => Ok(TerminationCondition::Exact),
        (_, Some(tolerance)) => Ok(TerminationCondition::Continuous {
            tolerance: parsed(tolerance, "P")?,
        }),
        _ => Err(format!("{word} is no mode")),
    }
}

fn programmed(kind: &str, words: &mut Words) -> Result<Programmed, String> {
    let shape = match kind {
        "arc" => Shape::Arc {
            radial: words.all_named("radial")?,
            tilt: words.all_named("tilt")?,
            radius: words.named("radius")?,
            angle: words.named("angle")?,
            height: words.named("height")?,
            revolutions: words.named("revolutions")?,
            others: [0.0; 6],
        },
        "turn" => Shape::Turn {
            center: words.all_named("center")?,
            across: axis(words.named("across")?)?,
            angle: words.named("angle")?,
            height: words.named("height")?,
            others: [0.0; 6],
        },
        _ => Shape::Line(Axes::zeros()),
    };
    let mut programmed = Programmed::feed(shape, f64::NAN);
    for word in words.0.by_ref() {
        take_word(&mut programmed, word)?;
    }
    if programmed.feed.is_nan() {
        return Err("F is missing".to_owned());
    }
    Ok(programmed)
}

/// The number of an axis.
fn axis(letter: char) -> Result<usize, String> {
    LETTERS
        .iter()
        .position(|axis| *axis == letter)
        .ok_or_else(|| format!("{letter} is no axis"))
}

/// A word of a move behind its kind.
fn take_word(programmed: &mut Programmed, word: &str) -> Result<(), String> {
    match word {
        "G0" => programmed.motion_type = MotionType::Traverse,
        "G2" => programmed.motion_type = MotionType::Arc,
        "M50P0" => programmed.enables = FEED_OVERRIDE_OFF,
        "spindle" => programmed.wait_for_spindle = true,
        "G61" | "G61.1" => programmed.mode = Some(mode(word)?),
        _ => take_letter(programmed, word)?,
    }
    Ok(())
}

fn take_letter(programmed: &mut Programmed, word: &str) -> Result<(), String> {
    let unknown = || format!("{word} is no word of this move");
    let letter = word.chars().next().ok_or_else(unknown)?;
    let value = || parsed(&word[letter.len_utf8()..], word);
    match letter {
        'P' => programmed.mode = Some(mode(word)?),
        'F' => programmed.feed = value()?,
        _ => {
            let axis = axis(letter)?;
            let place = match &mut programmed.shape {
                Shape::Line(displacement) => displacement.get_mut(axis),
                Shape::Arc { others, .. } | Shape::Turn { others, .. } => {
                    axis.checked_sub(3).and_then(|other| others.get_mut(other))
                }
            };
            *place.ok_or_else(unknown)? = value()?;
        }
    }
    Ok(())
}

fn event(words: &mut Words) -> Result<(Vec<usize>, Event), String> {
    let periods = periods(words.word("a period")?)?;
    let event = match words.word("an event")? {
        "pause" => Event::Pause,
        "resume" => Event::Resume,
        "abort" => Event::Abort,
        "step" => Event::Step,
        "gone" => Event::Gone,
        "feed" => Event::FeedOverride(words.value("feed")?),
        "rapid" => Event::RapidOverride(words.value("rapid")?),
        "slider" => Event::Slider(words.value("slider")?),
        "adaptive" => Event::Adaptive(words.value("adaptive")?),
        "spindles" => Event::Spindles(match words.word("on or off")? {
            "on" => true,
            "off" => false,
            other => return Err(format!("{other} is neither on nor off")),
        }),
        other => return Err(format!("{other} is no event")),
    };
    Ok((periods, event))
}

/// A period, or each from the first to the last of a range.
fn periods(word: &str) -> Result<Vec<usize>, String> {
    let (first, last) = word.split_once("..").unwrap_or((word, word));
    let periods = parsed(first, "a period")?..=parsed(last, "a period")?;
    if periods.is_empty() {
        return Err(format!("{word} are no periods"));
    }
    Ok(periods.collect())
}

fn ask(asked: &mut Asked, words: &mut Words) -> Result<(), String> {
    match words.word("what is asked")? {
        "velocity" => asked.velocity = Some(words.value("velocity")?),
        "acceleration" => asked.acceleration = Some(words.value("acceleration")?),
        "jerk" => asked.jerk = Some(words.value("jerk")?),
        "feed" => asked.feed = Some(words.value("feed")?),
        "path" => asked.path = true,
        "rests" => {
            asked.rests = match words.word("explained or none")? {
                "explained" => RestsAsked::Explained,
                "none" => RestsAsked::None,
                other => return Err(format!("{other} is neither explained nor none")),
            }
        }
        "periods" => asked.periods = Some(words.value("periods")?),
        "same_periods" => asked.same_periods = true,
        other => return Err(format!("{other} cannot be asked")),
    }
    Ok(())
}
