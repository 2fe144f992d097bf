//! The words of one block, evaluated and sorted by address.

use super::syntax::Word;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::words::{AXES, At, set};
use crate::dialects::expression::Variables;
use crate::source::Span;

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G numbers.
    pub g: Vec<At<u32>>,
    /// M numbers.
    pub m: Vec<At<u32>>,
    /// X Y Z A B C U V W; without a value where an axis is only named.
    pub axes: [Option<At<Option<f64>>>; 9],
    /// I J K.
    pub centre: [Option<At<f64>>; 3],
    /// R.
    pub radius: Option<At<f64>>,
    /// R behind one of G36 to G39, which another R may follow.
    pub corner_radius: Option<At<f64>>,
    /// Whether one of G36 to G39 was there, and its R not yet.
    awaits_corner: bool,
    /// P to V of a pattern: the places that are left out, from one to another.
    pub left_out: Vec<At<[u32; 2]>>,
    /// E, which only functions have that are not supported.
    pub further: Option<At<f64>>,
    /// Q.
    pub angle: Option<At<f64>>,
    /// F.
    pub feed: Option<At<f64>>,
    /// S.
    pub speed: Option<At<f64>>,
    /// T, and the offset behind its point.
    pub tool: Option<At<(f64, Option<u32>)>>,
    /// D.
    pub offset: Option<At<f64>>,
    /// L: the pitch of a thread.
    pub pitch: Option<At<f64>>,
    /// E: the contour error of G51.
    pub contour_error: Option<At<f64>>,
    /// H: the feed of the last round of a pocket, or how far a deep hole cycle draws back.
    pub finish_feed: Option<At<f64>>,
    /// N at the end of the block: how often it is repeated.
    pub times: Option<At<f64>>,
}

/// The letters that leave places of a pattern out.
const LEFT_OUT: &str = "PQRSTUV";

impl BlockWords {
    /// Evaluates the words in their order. `None` when something was wrong with one of them; that has
    /// been reported.
    pub fn collect(
        words: &[Word],
        variables: &dyn Variables,
        diagnostics: &mut Diagnostics,
    ) -> Option<BlockWords> {
        let mut block = BlockWords::default();
        let mut failed = false;
        let pattern = words.iter().any(Word::is_pattern);
        for word in words {
            let done = match pattern && LEFT_OUT.contains(word.letter) {
                true => block.leave_out(word),
                false => block.add(word, variables),
            };
            if let Err(diagnostic) = done {
                diagnostics.push(diagnostic);
                failed = true;
            }
        }
        (!failed).then_some(block)
    }

    /// `P4` leaves place 4 out, `P6.009` those from 6 to 9.
    fn leave_out(&mut self, word: &Word) -> Result<(), Diagnostic> {
        let (first, last) = word.digits.split_once('.').unwrap_or((&word.digits, ""));
        let range = match (first.parse(), last.len(), last.parse()) {
            (Ok(first), 0, _) => Some([first, first]),
            (Ok(first), 3, Ok(last)) if first <= last => Some([first, last]),
            _ => None,
        };
        let Some(value) = range else {
            return Err(
                Diagnostic::error(word.span, "this does not name places of the pattern").help(
                    "P4 leaves the fourth place out, P6.009 those from the sixth to the ninth",
                ),
            );
        };
        let span = word.span;
        self.left_out.push(At { value, span });
        Ok(())
    }

    fn add(&mut self, word: &Word, variables: &dyn Variables) -> Result<(), Diagnostic> {
        let span = word.span;
        let letter = word.letter;
        let value = match &word.value {
            Some(value) => Some(value.number(variables)?),
            None => None,
        };
        if let Some(axis) = AXES.iter().position(|axis| axis.starts_with(letter)) {
            return set(&mut self.axes[axis], value, span, letter);
        }
        let value = value.ok_or_else(|| missing(letter, span))?;
        if let Some(axis) = ['I', 'J', 'K'].iter().position(|axis| *axis == letter) {
            return set(&mut self.centre[axis], value, span, letter);
        }
        match letter {
            'G' => {
                let value = code(value, span)?;
                self.awaits_corner |= (36..=39).contains(&value);
                self.g.push(At { value, span });
                Ok(())
            }
            'M' => {
                let value = code(value, span)?;
                self.m.push(At { value, span });
                Ok(())
            }
            'R' if std::mem::take(&mut self.awaits_corner) => {
                set(&mut self.corner_radius, value, span, letter)
            }
            'R' => set(&mut self.radius, value, span, letter),
            'Q' => set(&mut self.angle, value, span, letter),
            'F' => set(&mut self.feed, value, span, letter),
            'S' => set(&mut self.speed, value, span, letter),
            'D' => set(&mut self.offset, value, span, letter),
            'T' => set(&mut self.tool, tool(word, value)?, span, letter),
            'N' => set(&mut self.times, value, span, letter),
            'L' => set(&mut self.pitch, value, span, letter),
            'E' if self.g.iter().any(|g| g.value == 51) => {
                set(&mut self.contour_error, value, span, letter)
            }
            'H' => set(&mut self.finish_feed, value, span, letter),
            'E' => set(&mut self.further, value, span, letter),
            'O' => Err(
                Diagnostic::error(span, format!("the address {letter} is not supported")).help(
                    "axes are X Y Z A B C U V W; parameters are P1 and stand behind an address",
                ),
            ),
            _ => Err(Diagnostic::error(
                span,
                format!("the address {letter} is not supported"),
            )),
        }
    }

    /// Where the first axis word stands.
    pub fn first_axis(&self) -> Option<Span> {
        let spans = self.axes.iter().flatten().map(|axis| axis.span);
        spans.min_by_key(|span| span.start)
    }

    /// Where the first word stands that says more of a motion than its axes do: I, J, K, R, Q or L.
    pub fn beside_axes(&self) -> Option<Span> {
        let single = [self.radius, self.corner_radius, self.angle, self.pitch];
        let words = self.centre.iter().chain(&single).flatten();
        words.map(|word| word.span).min_by_key(|span| span.start)
    }

    /// Where the first word stands that is no G function.
    pub fn first_word(&self) -> Option<Span> {
        let single = [
            self.feed,
            self.speed,
            self.offset,
            self.contour_error,
            self.finish_feed,
            self.further,
            self.times,
        ];
        let spans = single.iter().flatten().map(|word| word.span);
        let spans = spans.chain(self.tool.map(|tool| tool.span));
        let spans = spans.chain(self.m.iter().map(|m| m.span));
        let spans = spans.chain(self.left_out.iter().map(|places| places.span));
        let spans = spans.chain(self.first_axis()).chain(self.beside_axes());
        spans.min_by_key(|span| span.start)
    }

    /// Whether any coordinate is there, of whatever kind.
    pub fn names_a_place(&self) -> bool {
        self.first_axis().is_some() || self.names_a_centre() || self.angle.is_some()
    }

    /// Whether I, J, K or R is there.
    pub fn names_a_centre(&self) -> bool {
        self.radius.is_some() || self.centre.iter().any(Option::is_some)
    }
}

/// What is said where a word has no value.
pub fn missing(letter: char, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("the value of {letter} is missing"))
        .help(format!("write {letter}10 or {letter}P1"))
}

fn code(value: f64, span: Span) -> Result<u32, Diagnostic> {
    if value.fract() != 0.0 || !(0.0..=9999.0).contains(&value) {
        return Err(Diagnostic::error(
            span,
            "this is not the number of a function",
        ));
    }
    Ok(value as u32)
}

/// `T5.10`: tool 5 with offset 10.
fn tool(word: &Word, value: f64) -> Result<(f64, Option<u32>), Diagnostic> {
    if value < 0.0 {
        return Err(Diagnostic::error(
            word.span,
            format!("{value} is not the number of a tool"),
        ));
    }
    let Some((_, offset)) = word.digits.split_once('.') else {
        return Ok((value, None));
    };
    if offset.is_empty() {
        return Ok((value.trunc(), None));
    }
    offset
        .parse()
        .map(|offset| (value.trunc(), Some(offset)))
        .map_err(|_| {
            Diagnostic::error(word.span, "this is not a tool and its offset")
                .help("write T5.3 for tool 5 with offset 3")
        })
}
