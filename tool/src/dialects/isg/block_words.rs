//! The words of one block, evaluated and sorted by address.

use super::syntax::Word;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords, named, set};
use crate::dialects::expression::Variables;
use crate::source::Span;

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G functions, in their order.
    pub g: Vec<At<u32>>,
    /// The value of `G159=2`, or the time of `G04 2.5`.
    pub g_value: Option<At<f64>>,
    /// M functions, in their order.
    pub m: Vec<At<u32>>,
    /// Axes, I J K and the radius R.
    pub motion: MotionWords,
    /// F.
    pub feed: Option<At<f64>>,
    /// S.
    pub speed: Option<At<f64>>,
    /// T.
    pub tool: Option<At<f64>>,
    /// D.
    pub offset: Option<At<f64>>,
}

impl BlockWords {
    /// Evaluates one more word.
    pub fn add(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Diagnostic> {
        let span = word.span;
        let letter = word.address;
        let value = word.value.number(variables)?;
        if letter == 'G' {
            let code = function_number('G', value, span)?;
            if let Some(second) = &word.second {
                let second = second.number(variables)?;
                if !matches!(code, 4 | 159) {
                    return Err(Diagnostic::error(span, format!("G{code} takes no value")));
                }
                set(&mut self.g_value, second, span, letter)?;
            }
            self.g.push(At { value: code, span });
            return Ok(());
        }
        if word.second.is_some() {
            return Err(Diagnostic::error(
                span,
                format!("{letter}{value} with a value is not supported"),
            )
            .help(match letter {
                'M' => "M functions with values switch something on this one machine",
                'S' => "there is one spindle: S500",
                _ => "axes are X Y Z A B C U V W",
            }));
        }
        let dimensioned = (value, Dimension::Modal);
        if let Some(axis) = AXES.iter().position(|axis| axis.starts_with(letter)) {
            return set(&mut self.motion.axes[axis], dimensioned, span, letter);
        }
        match letter {
            'I' => set(&mut self.motion.centre[0], dimensioned, span, letter),
            'J' => set(&mut self.motion.centre[1], dimensioned, span, letter),
            'K' => set(&mut self.motion.centre[2], dimensioned, span, letter),
            'R' => set(&mut self.motion.radius, value, span, letter),
            'F' => set(&mut self.feed, value, span, letter),
            'S' => set(&mut self.speed, value, span, letter),
            'T' => set(&mut self.tool, value, span, letter),
            'D' => set(&mut self.offset, value, span, letter),
            'M' => {
                let value = function_number('M', value, span)?;
                self.m.push(At { value, span });
                Ok(())
            }
            _ => Err(Diagnostic::error(span, format!("the address {letter} is not supported")).help(
                    match letter {
                        'H' => "H functions switch something on this one machine: use an M function that LinuxCNC has",
                        'E' => "a feed at the end of the block is not supported: program F",
                        'N' => "the block number stands at the beginning of the block",
                        _ => "axes are X Y Z A B C U V W",
                    },
                )),
        }
    }

    /// The G function with this number.
    pub fn function(&self, code: u32) -> Option<At<u32>> {
        self.g.iter().find(|g| g.value == code).copied()
    }

    /// The first word that is neither an axis nor one of these G functions, with its name.
    pub fn beside_axes(&self, codes: &[u32]) -> Option<(String, Span)> {
        let g = self.g.iter().filter(|g| !codes.contains(&g.value));
        let mut others: Vec<(String, Span)> =
            g.map(|g| (format!("G{}", g.value), g.span)).collect();
        others.extend(self.m.iter().map(|m| (format!("M{}", m.value), m.span)));
        let single = [
            ("R", self.motion.radius),
            ("F", self.feed),
            ("S", self.speed),
            ("T", self.tool),
            ("D", self.offset),
        ];
        others.extend(named(&single));
        others.extend(self.motion.named_centre());
        others.into_iter().min_by_key(|(_, span)| span.start)
    }
}

fn function_number(letter: char, value: f64, span: Span) -> Result<u32, Diagnostic> {
    if value.fract() == 0.0 && (0.0..=999.0).contains(&value) {
        return Ok(value as u32);
    }
    Err(Diagnostic::error(
        span,
        format!("{letter}{value} is not the number of a function"),
    ))
}
