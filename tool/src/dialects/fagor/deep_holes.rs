//! Deep holes whose steps grow shorter (G69).
//!
//! `G69 X Y Z I B C D H J K L R`: B is the first step, each further one R times the one before and at
//! least L; C how far before the last bottom the rapid motion back in ends; D how far the surface lies
//! behind the reference plane; H how far the tool draws back after a step, out to the reference plane
//! if it is left out, and after every J steps in any case; K the dwell after a step. With polar
//! coordinates R is that of the place. (Fagor, CNC 8055 Programming Manual, "Deep hole drilling canned
//! cycle with variable peck".)

use super::block_words::BlockWords;
use super::cycles::Cycle;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use crate::program::moves::MoveKind;

/// The default of C, millimetres.
const APPROACH: f64 = 1.0;

/// Steps below this make no hole, machine units.
const LEAST_STEP: f64 = 1e-4;

/// A deep hole that is in force; lengths in machine units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    first: f64,
    approach: f64,
    surface: f64,
    relief: f64,
    /// After how many steps the tool comes out whatever H says.
    out_after: u32,
    least: f64,
    factor: f64,
}

impl Steps {
    /// Takes the words of a deep hole out of its block, whose letters mean something else elsewhere.
    /// `factor`: units of the program times this are machine units; `millimetre`: one in machine units.
    pub fn take(
        words: &mut BlockWords,
        g: At<u32>,
        old: Option<Steps>,
        [factor, millimetre]: [f64; 2],
    ) -> Result<Steps, Diagnostic> {
        let value = |word: Option<At<f64>>| word.map(|word| word.value);
        let mut axis = |axis: usize| words.axes[axis].take().and_then(|word| word.value);
        let (first, approach) = (axis(4), axis(5));
        let surface = value(words.offset.take());
        let relief = value(words.finish_feed.take());
        let least = value(words.pitch.take());
        let out_after = value(words.centre[1].take());
        // The radius of polar coordinates stays in its place.
        let ratio = match words.angle {
            Some(_) => None,
            None => value(words.radius.take()),
        };
        let length = |value: Option<f64>| value.map(|value| value * factor);
        let wrong = |what: &str, help: &str| {
            Diagnostic::error(g.span, format!("G{} {what}", g.value)).help(help)
        };
        let steps = Steps {
            first: length(first).unwrap_or(old.map_or(0.0, |old| old.first)),
            approach: length(approach)
                .unwrap_or(old.map_or(APPROACH * millimetre, |old| old.approach)),
            surface: length(surface).unwrap_or(old.map_or(0.0, |old| old.surface)),
            relief: length(relief).unwrap_or(old.map_or(0.0, |old| old.relief)),
            out_after: match out_after {
                None => old.map_or(0, |old| old.out_after),
                Some(count) if count.fract() == 0.0 && (0.0..=9999.0).contains(&count) => {
                    count as u32
                }
                Some(_) => {
                    return Err(wrong(
                        "with a J that is no number of steps",
                        "J1 comes out to the reference plane after each step",
                    ));
                }
            },
            least: length(least).unwrap_or(old.map_or(0.0, |old| old.least)),
            factor: ratio.unwrap_or(old.map_or(1.0, |old| old.factor)),
        };
        if steps.first <= 0.0 {
            return Err(wrong(
                "needs B, the first step, above 0",
                "write G69 X10 Y10 Z2 I-30 B5 F100",
            ));
        }
        if !(steps.factor > 0.0 && steps.factor <= 1.0) {
            return Err(wrong(
                "with R out of range",
                "R is what each step is of the one before: R0.8, from above 0 to 1",
            ));
        }
        let negative = [steps.approach, steps.surface, steps.relief, steps.least];
        if steps.approach == 0.0 || negative.iter().any(|length| *length < 0.0) {
            return Err(wrong(
                "with a length below 0, or with C0",
                "C, D, H and L are lengths; C is above 0",
            ));
        }
        Ok(steps)
    }
}

impl Interpreter<'_> {
    /// The steps of a deep hole from the reference plane to its bottom.
    pub(super) fn drill_steps(&mut self, cycle: &Cycle, steps: Steps) -> Done {
        let (reference, bottom) = cycle.depths();
        let down = (bottom - reference).signum();
        let surface = reference + steps.surface * down;
        let total = (bottom - surface) * down;
        let at = |depth: f64| surface + depth * down;
        let mut depth = 0.0;
        let mut step = steps.first;
        for number in 1.. {
            if !self.control.count_block(cycle.span()) {
                return Ok(());
            }
            let last = depth;
            depth = total.min(last + step);
            if total - depth < LEAST_STEP {
                depth = total;
            }
            if number > 1 {
                let out = steps.relief == 0.0
                    || (steps.out_after > 0 && (number - 1) % steps.out_after == 0);
                let back = match out {
                    true => reference,
                    false => at(last - steps.relief),
                };
                self.to(back, &MoveKind::Rapid, cycle)?;
                if out || steps.relief > steps.approach {
                    self.to(at(last - steps.approach), &MoveKind::Rapid, cycle)?;
                }
            }
            self.to(at(depth), &MoveKind::Line, cycle)?;
            self.wait(cycle);
            if depth >= total {
                return Ok(());
            }
            step = (step * steps.factor).max(steps.least);
            if step < LEAST_STEP {
                return Err(Diagnostic::error(
                    cycle.span(),
                    "the steps of this hole become too small",
                )
                .help("give their least length with L"));
            }
        }
        Ok(())
    }
}
