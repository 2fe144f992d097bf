//! The words of one block, evaluated and sorted by address. What uses a word takes it away; what is left
//! at the end has no meaning there, and is refused.

use super::syntax::Word;
use super::values::{InWord, Lookup, value};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::dialects::control::Done;
use crate::dialects::control::words::{AXES, At, set};
use crate::dialects::expression::{Expression, ExpressionKind};
use crate::source::Span;

/// All words of a block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlockWords {
    /// G numbers, times ten.
    pub g: Vec<At<u32>>,
    /// M numbers.
    pub m: Vec<At<u32>>,
    /// X Y Z A B C U V W.
    pub axes: [Option<At<f64>>; 9],
    /// I J K.
    pub centre: [Option<At<f64>>; 3],
    /// R.
    pub radius: Option<At<f64>>,
    /// P, and how many digits it has if it has no point.
    pub p: Option<At<(f64, Option<u32>)>>,
    /// Whether P is neither a number nor one with a sign.
    pub p_is_worked_out: bool,
    /// Q.
    pub q: Option<At<f64>>,
    /// L.
    pub l: Option<At<f64>>,
    /// E.
    pub rounding: Option<At<f64>>,
    /// F.
    pub feed: Option<At<f64>>,
    /// S.
    pub speed: Option<At<f64>>,
    /// T, and how many digits it has if it has no point.
    pub tool: Option<At<(f64, Option<u32>)>>,
    /// D.
    pub d: Option<At<f64>>,
    /// H.
    pub h: Option<At<f64>>,
    /// `,R` (`true`) or `,C`.
    pub corner: Option<At<(bool, f64)>>,
    /// The addresses of lengths and angles whose values are plain numbers without a point, other than 0; ,R and
    /// ,C are [`CORNER`].
    pub pointless: Vec<(char, Span)>,
}

/// The addresses of lengths and angles.
const LENGTHS: &str = "XYZABCUVWEIJKQR";

/// What stands for the addresses ,R and ,C.
pub const CORNER: char = ',';

impl BlockWords {
    /// Evaluates the words in their order. `length_step`: the least increment of lengths. `None` when something was wrong with one of them; what is
    /// wrong goes to `diagnostics`.
    pub fn collect(
        words: &[Word],
        lookup: &dyn Lookup,
        length_step: f64,
        diagnostics: &mut Diagnostics,
    ) -> Option<BlockWords> {
        let mut block = BlockWords::default();
        let mut failed = false;
        for word in words {
            if let Err(diagnostic) = block.add(word, lookup, length_step) {
                diagnostics.push(diagnostic);
                failed = true;
            }
        }
        (!failed).then_some(block)
    }

    fn add(&mut self, word: &Word, lookup: &dyn Lookup, length_step: f64) -> Done {
        let span = word.span;
        let letter = word.letter;
        // A word whose value is vacant is not there.
        let step = match letter {
            'A' | 'B' | 'C' if !word.comma => Some(0.001),
            _ if LENGTHS.contains(letter) => Some(length_step),
            'F' => None,
            _ => Some(1.0),
        };
        let Some(value) = value(&word.value, &InWord { lookup, step })? else {
            return Ok(());
        };
        let is_pointless = word.pointless.is_some() && value != 0.0;
        if word.comma {
            if is_pointless {
                self.pointless.push((CORNER, span));
            }
            return match letter {
                'R' | 'C' => set(
                    &mut self.corner,
                    (letter == 'R', value),
                    span,
                    format!(",{letter}"),
                ),
                _ => Err(
                    Diagnostic::error(span, format!(",{letter} is not supported"))
                        .help("write ,R5. for a rounding, ,C5. for a chamfer"),
                ),
            };
        }
        if LENGTHS.contains(letter) && is_pointless {
            self.pointless.push((letter, span));
        }
        if let Some(axis) = AXES.iter().position(|axis| axis.starts_with(letter)) {
            return set(&mut self.axes[axis], value, span, letter);
        }
        if let Some(axis) = ['I', 'J', 'K'].iter().position(|axis| *axis == letter) {
            return set(&mut self.centre[axis], value, span, letter);
        }
        match letter {
            'G' => {
                let value = code(value * 10.0, 9999.0, span)?;
                self.g.push(At { value, span });
                Ok(())
            }
            'M' => {
                let value = code(value, 99_999.0, span)?;
                self.m.push(At { value, span });
                Ok(())
            }
            'R' => set(&mut self.radius, value, span, letter),
            'P' => {
                self.p_is_worked_out = is_worked_out(&word.value);
                set(&mut self.p, (value, word.pointless), span, letter)
            }
            'Q' => set(&mut self.q, value, span, letter),
            'L' => set(&mut self.l, value, span, letter),
            'E' => set(&mut self.rounding, value, span, letter),
            'F' => set(&mut self.feed, value, span, letter),
            'S' => set(&mut self.speed, value, span, letter),
            'T' => set(&mut self.tool, (value, word.pointless), span, letter),
            'D' => set(&mut self.d, value, span, letter),
            'H' => set(&mut self.h, value, span, letter),
            'N' => Err(Diagnostic::error(
                span,
                "the block number stands at the beginning of the block",
            )
            .help("write N10 G1 X10.")),
            _ => Err(unknown_address(letter, span)),
        }
    }

    /// Forgets the missing points of words that are neither lengths nor angles: K beside a cycle is how
    /// often, Q can be an order or a switch.
    pub fn forget_counts(&mut self, in_cycle: bool) {
        let look_ahead = self.has_g(50) || self.has_g(51) || self.has_g(80);
        let order = self.has_g(682);
        // L counts the holes of a circle, whose K is an angle.
        let in_cycle = in_cycle && !self.has_g(710);
        self.pointless.retain(|(letter, _)| match letter {
            'K' => !in_cycle,
            'Q' => !look_ahead && !order,
            'R' => !look_ahead,
            _ => true,
        });
    }

    /// Numbers without a point as counts of `length` and `angle`, the least increments of the control. `polar`: Y is an
    /// angle.
    pub fn count_increments(&mut self, length: f64, angle: f64, polar: bool) {
        let angles = self.has_g(680) || self.has_g(682) || self.has_g(510);
        let on_circle = self.has_g(700) || self.has_g(710);
        let dwell = self.has_g(40);
        for (letter, _) in &self.pointless {
            let step = match letter {
                'A' | 'B' | 'C' => angle,
                'I' | 'J' | 'K' | 'R' if angles => angle,
                'J' | 'K' if on_circle => angle,
                'Y' if polar => angle,
                // Thousandths of a second.
                'X' | 'U' if dwell => angle,
                _ => length,
            };
            if let (CORNER, Some(corner)) = (*letter, &mut self.corner) {
                corner.value.1 *= length;
                continue;
            }
            let axis = AXES.iter().position(|axis| axis.starts_with(*letter));
            let centre = ['I', 'J', 'K'].iter().position(|axis| axis == letter);
            let place = match (axis, centre, letter) {
                (Some(axis), _, _) => &mut self.axes[axis],
                (_, Some(axis), _) => &mut self.centre[axis],
                (_, _, 'E') => &mut self.rounding,
                (_, _, 'R') => &mut self.radius,
                _ => &mut self.q,
            };
            if let Some(word) = place {
                word.value *= step;
            }
        }
        self.pointless.clear();
    }

    /// P as a time in seconds: thousandths of a second without a point, or a whole number that was worked out; with a
    /// point it counts seconds, see [`BlockWords::dwells_in_seconds`].
    pub fn take_dwell(&mut self) -> Result<Option<f64>, Diagnostic> {
        let worked_out = self.p_is_worked_out;
        match self.p.take() {
            None => Ok(None),
            Some(At {
                value: (value, digits),
                ..
            }) if value >= 0.0 && (digits.is_some() || worked_out && value.fract() == 0.0) => {
                Ok(Some(value / 1000.0))
            }
            Some(At {
                value: (value, None),
                ..
            }) if value >= 0.0 && !worked_out => Ok(Some(value)),
            Some(At { span, .. }) => Err(Diagnostic::error(
                span,
                "P is a whole number of thousandths of a second, without a point",
            )
            .help("write P500 for half a second")),
        }
    }

    /// Where P stands, if it is a time with a decimal point. Controls that take one count seconds there. (Haas
    /// Automation, Mill Operator's Manual, "G04 Dwell".)
    pub fn dwells_in_seconds(&self) -> Option<Span> {
        let p = self.p.filter(|p| p.value.1.is_none());
        p.filter(|_| !self.p_is_worked_out).map(|p| p.span)
    }

    /// Whether this G function, times ten, is in the block.
    pub fn has_g(&self, code: u32) -> bool {
        self.g.iter().any(|g| g.value == code)
    }

    /// Where the first axis word stands.
    pub fn first_axis(&self) -> Option<Span> {
        let spans = self.axes.iter().flatten().map(|axis| axis.span);
        spans.min_by_key(|span| span.start)
    }

    /// Refuses what nothing has used.
    pub fn refuse_rest(&self) -> Done {
        if let Some(word) = self.rounding {
            return Err(unknown_address('E', word.span));
        }
        let single = [
            ("P", self.p.map(|word| word.span)),
            ("Q", self.q.map(|word| word.span)),
            ("L", self.l.map(|word| word.span)),
            ("R", self.radius.map(|word| word.span)),
            ("I", self.centre[0].map(|word| word.span)),
            ("J", self.centre[1].map(|word| word.span)),
            ("K", self.centre[2].map(|word| word.span)),
            (",R or ,C", self.corner.map(|word| word.span)),
        ];
        let axes = AXES.iter().zip(&self.axes);
        let axes = axes.map(|(name, word)| (*name, word.map(|word| word.span)));
        let rest = single.into_iter().chain(axes);
        match rest.filter_map(|(name, span)| Some((name, span?))).next() {
            None => Ok(()),
            Some((name, span)) => Err(Diagnostic::error(
                span,
                format!("{name} has no meaning in this block"),
            )
            .help("take it out, or put it beside the function that it belongs to")),
        }
    }
}

fn unknown_address(letter: char, span: Span) -> Diagnostic {
    Diagnostic::error(span, format!("the address {letter} is not supported"))
        .help("axes are X Y Z A B C U V W; a program begins with O on a line of its own")
}

fn is_worked_out(value: &Expression) -> bool {
    match &value.kind {
        ExpressionKind::Unary(_, operand) => is_worked_out(operand),
        kind => !matches!(kind, ExpressionKind::Number(_)),
    }
}

fn code(value: f64, most: f64, span: Span) -> Result<u32, Diagnostic> {
    let rounded = value.round();
    if (value - rounded).abs() > 1e-9 || !(0.0..=most).contains(&rounded) {
        return Err(Diagnostic::error(
            span,
            "this is not the number of a function",
        ));
    }
    Ok(rounded as u32)
}

/// A G number as it is written: 541 is `G54.1`.
pub fn g_name(code: u32) -> String {
    match code % 10 {
        0 => format!("G{}", code / 10),
        decimal => format!("G{}.{decimal}", code / 10),
    }
}
