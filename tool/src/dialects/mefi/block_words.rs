//! The words of one block, sorted by address.

use super::syntax::{Block, Word};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::words::{AXES, At, Dimension, MotionWords, named, set};
use crate::source::Span;

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G functions, in their order.
    pub g: Vec<At<u32>>,
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
    /// L: the number of a subprogram.
    pub label: Option<At<f64>>,
    /// P or Q: the number of passes.
    pub passes: Option<At<f64>>,
    /// Whether it is Q, of which the manual says nothing.
    pub passes_by_q: bool,
}

impl BlockWords {
    /// `None` when something was wrong with one of the words; that has been reported.
    pub fn collect(block: &Block, diagnostics: &mut Diagnostics) -> Option<BlockWords> {
        let mut words = BlockWords::default();
        let mut failed = false;
        for word in &block.words {
            if let Err(diagnostic) = words.add(word) {
                diagnostics.push(diagnostic);
                failed = true;
            }
        }
        (!failed).then_some(words)
    }

    fn add(&mut self, word: &Word) -> Result<(), Diagnostic> {
        let Word {
            letter,
            value,
            span,
        } = *word;
        let dimensioned = (value, Dimension::Modal);
        let axis = AXES.iter().position(|axis| axis.starts_with(letter));
        if let Some(axis) = axis {
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
            'L' => set(&mut self.label, value, span, letter),
            'P' | 'Q' => {
                self.passes_by_q = letter == 'Q';
                set(&mut self.passes, value, span, "the number of passes")
            }
            'G' | 'M' => {
                if value.fract() != 0.0 || !(0.0..=999.0).contains(&value) {
                    return Err(Diagnostic::error(
                        span,
                        format!("{letter}{value} is not the number of a function"),
                    ));
                }
                let list = if letter == 'G' {
                    &mut self.g
                } else {
                    &mut self.m
                };
                let value = value as u32;
                list.push(At { value, span });
                Ok(())
            }
            _ => Err(
                Diagnostic::error(span, format!("the address {letter} is not supported"))
                    .help("axes are X Y Z A B C U V W"),
            ),
        }
    }

    /// The G function with this number.
    pub fn function(&self, code: u32) -> Option<At<u32>> {
        self.g.iter().find(|g| g.value == code).copied()
    }

    /// The first word that is neither an axis nor this G function, with its name.
    pub fn beside_axes(&self, code: u32) -> Option<(String, Span)> {
        let functions = |letter: char, list: &[At<u32>]| -> Vec<(String, Span)> {
            let others = list.iter().filter(|f| letter != 'G' || f.value != code);
            others
                .map(|f| (format!("{letter}{}", f.value), f.span))
                .collect()
        };
        let mut others = functions('G', &self.g);
        // The same function twice is one too many.
        let again = self.g.iter().filter(|g| g.value == code).skip(1);
        others.extend(again.map(|g| (format!("another G{code}"), g.span)));
        others.extend(functions('M', &self.m));
        let single = [
            ("R", self.motion.radius),
            ("F", self.feed),
            ("S", self.speed),
            ("T", self.tool),
            ("D", self.offset),
            ("L", self.label),
            ("P", self.passes),
        ];
        others.extend(named(&single));
        others.extend(self.motion.named_centre());
        others.into_iter().min_by_key(|(_, span)| span.start)
    }
}
