//! Writes G-code.

use super::Options;
use std::fmt::Write;

/// A program in the making.
pub(super) struct Text {
    text: String,
    decimals: usize,
}

impl Text {
    /// Starts a program: metric, absolute, G64 with P (0 for none), F.
    pub(super) fn start(about: &str, options: &Options, tolerance: f64, decimals: usize) -> Text {
        let mut text = Text {
            text: format!("({about})\nG21 G90 G17 G40 G49 G94\n"),
            decimals,
        };
        if tolerance > 0.0 {
            text.block(&format!("G64 P{tolerance}"));
        } else {
            text.block("G64");
        }
        text.block(&format!("F{}", options.feed));
        text
    }

    /// A block as it stands.
    pub(super) fn block(&mut self, block: &str) {
        self.text.push_str(block);
        self.text.push('\n');
    }

    /// A straight move at feed: letters with values.
    pub(super) fn line(&mut self, words: &[(char, f64)]) {
        self.words("G1", words);
    }

    /// Any move.
    pub(super) fn words(&mut self, code: &str, words: &[(char, f64)]) {
        self.text.push_str(code);
        for (letter, value) in words {
            // No minus in front of zero.
            let scale = 10f64.powi(self.decimals as i32);
            let value = (value * scale).round() / scale + 0.0;
            // Writing to a string does not fail.
            let _ = write!(self.text, " {letter}{value:.*}", self.decimals);
        }
        self.text.push('\n');
    }

    /// The end of the program.
    pub(super) fn end(mut self) -> String {
        self.block("M2");
        self.text
    }
}
