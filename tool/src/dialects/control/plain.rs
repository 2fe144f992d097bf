//! Blocks that are nothing but a straight motion: `N10 G1 X10 Y-2.5 F300`. Programs of CAM systems
//! consist of millions of them, and all dialects write them in the same way: they are read here
//! without tokens and syntax trees, and mean what the parsers of the dialects make of them.

use super::modal::Motion;
use super::words::AXES;
use super::{Control, Place};
use crate::program::moves::{Coordinate, Move, MoveKind};
use crate::program::{Action, FeedMode};
use crate::source::Span;

/// The most digits of a number that is read here: all such numbers are exact in a double.
const DIGITS: u32 = 15;

/// A block with G0 or G1 or neither, axes and perhaps F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlainBlock {
    /// `N10`.
    pub number: Option<u32>,
    /// G0 or G1.
    pub motion: Option<Motion>,
    /// X Y Z A B C U V W, as they are written.
    pub axes: [Option<f64>; 9],
    /// F.
    pub feed: Option<f64>,
    /// Whether an axis has a number other than 0 that is written without a decimal point.
    pub pointless: bool,
    /// Where its words begin and end in its line.
    pub range: [usize; 2],
}

impl PlainBlock {
    /// Reads a line; `None` where it is anything else, or written in an unusual way.
    pub fn read(line: &[u8]) -> Option<PlainBlock> {
        let mut reader = Reader { line, at: 0 };
        reader.blanks();
        let start = reader.at;
        let mut block = PlainBlock {
            number: None,
            motion: None,
            axes: [None; 9],
            feed: None,
            pointless: false,
            range: [start, start],
        };
        let mut moves = false;
        while let Some(letter) = reader.next() {
            let axis = match letter.to_ascii_uppercase() {
                b'X' => 0,
                b'Y' => 1,
                b'Z' => 2,
                b'G' if block.motion.is_none() => {
                    block.motion = Some(reader.motion()?);
                    block.range[1] = reader.at;
                    reader.blanks();
                    continue;
                }
                b'N' if reader.at == start + 1 => {
                    block.number = Some(reader.block_number()?);
                    block.range[1] = reader.at;
                    reader.blanks();
                    continue;
                }
                b'F' if block.feed.is_none() => {
                    block.feed = Some(reader.number()?);
                    block.range[1] = reader.at;
                    reader.blanks();
                    continue;
                }
                b'A' => 3,
                b'B' => 4,
                b'C' => 5,
                b'U' => 6,
                b'V' => 7,
                b'W' => 8,
                _ => return None,
            };
            let place = &mut block.axes[axis];
            if place.is_some() {
                return None;
            }
            let start = reader.at;
            let value = reader.number()?;
            *place = Some(value);
            let digits = line.get(start..reader.at).unwrap_or(&[]);
            block.pointless |= value != 0.0 && !digits.contains(&b'.');
            moves = true;
            block.range[1] = reader.at;
            reader.blanks();
        }
        moves.then_some(block)
    }
}

/// A place in a line.
struct Reader<'a> {
    line: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    fn next(&mut self) -> Option<u8> {
        let next = self.peek()?;
        self.at += 1;
        Some(next)
    }

    fn blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    fn digit(&mut self) -> Option<u64> {
        let digit = self.peek().map(|byte| byte.wrapping_sub(b'0'))?;
        (digit < 10).then(|| {
            self.at += 1;
            u64::from(digit)
        })
    }

    /// `0`, `00`, `1`, `01`, and nothing that would make another number of it.
    fn motion(&mut self) -> Option<Motion> {
        let mut code = self.digit()?;
        if code == 0
            && let Some(second) = self.digit()
        {
            code = second;
        }
        let ends = !matches!(self.peek(), Some(b'0'..=b'9' | b'.'));
        match code {
            0 if ends => Some(Motion::Rapid),
            1 if ends => Some(Motion::Line),
            _ => None,
        }
    }

    fn block_number(&mut self) -> Option<u32> {
        let mut number = self.digit()?;
        let mut digits = 1;
        while let Some(digit) = self.digit() {
            number = number.wrapping_mul(10).wrapping_add(digit);
            digits += 1;
        }
        if digits > 9 || self.peek() == Some(b'.') {
            return None;
        }
        u32::try_from(number).ok()
    }

    /// A decimal number with or without a sign. Its digits and the power of ten are exact, so that the
    /// quotient is rounded once, as by any other correct reader (Clinger, "How to read floating point
    /// numbers accurately", PLDI 1990).
    fn number(&mut self) -> Option<f64> {
        const POWERS: [f64; DIGITS as usize + 1] = [
            1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
        ];
        let negative = match self.peek()? {
            b'-' => {
                self.at += 1;
                true
            }
            b'+' => {
                self.at += 1;
                false
            }
            _ => false,
        };
        let mut mantissa: u64 = 0;
        let mut digits = 0;
        while let Some(digit) = self.digit() {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(digit);
            digits += 1;
        }
        let mut decimals = 0;
        if self.peek() == Some(b'.') {
            self.at += 1;
            while let Some(digit) = self.digit() {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(digit);
                decimals += 1;
            }
        }
        digits += decimals;
        // A letter, a blank or the end must follow; not another point, an exponent or an equals sign.
        let ends = match self.peek() {
            None | Some(b' ' | b'\t') => true,
            Some(byte) => byte.is_ascii_alphabetic() && !byte.eq_ignore_ascii_case(&b'E'),
        };
        if digits == 0 || digits > DIGITS || !ends {
            return None;
        }
        let value = mantissa as f64 / POWERS.get(decimals as usize)?;
        Some(if negative { -value } else { value })
    }
}

impl Control<'_> {
    /// Runs a block whose words stand at `span`. `false`, with nothing done, where the state of the
    /// control asks for more than a straight motion; what only the dialect knows it has looked at
    /// itself.
    pub fn plain_motion(&mut self, block: &PlainBlock, span: Span) -> bool {
        let Some(path) = self.plain_move(block) else {
            return false;
        };
        self.actions = Vec::with_capacity(1 + usize::from(block.feed.is_some()));
        if let Some(feed) = block.feed {
            self.modal.has_feed = true;
            self.modal.feed = Some(feed * self.modal.feed_factor);
            self.actions
                .push(Action::Feed(feed * self.modal.feed_factor));
        }
        self.modal.motion = Some(match path.kind {
            MoveKind::Rapid => Motion::Rapid,
            _ => Motion::Line,
        });
        if let Err(diagnostic) = self.add_move(path, span) {
            self.fail(diagnostic);
        }
        self.finish_block(&Place {
            span,
            number: block.number,
            comment: None,
        });
        true
    }

    fn plain_move(&self, block: &PlainBlock) -> Option<Move> {
        let modal = &self.modal;
        let kind = match block.motion.or(modal.motion)? {
            Motion::Rapid => MoveKind::Rapid,
            Motion::Line => MoveKind::Line,
            Motion::Clockwise | Motion::Counterclockwise => return None,
        };
        let has_feed = match block.feed {
            Some(feed) => feed > 0.0,
            None => modal.has_feed || kind == MoveKind::Rapid,
        };
        if !has_feed || modal.feed_mode == FeedMode::InverseTime {
            return None;
        }
        let mut path = Move {
            kind,
            target: [Coordinate::Keep; 9],
            start: modal.position.coordinates(),
            exact_stop: false,
            corner: None,
        };
        for (axis, word) in block.axes.iter().enumerate() {
            let Some(value) = *word else {
                continue;
            };
            let factor = match AXES[axis] {
                "A" | "B" | "C" => 1.0,
                _ => modal.length_factor,
            };
            if axis >= 3 && modal.axis_factors[axis] != 1.0 {
                return None;
            }
            let value = value * factor;
            let value = match modal.incremental {
                false => value,
                true => match (path.start[axis], modal.carried.get(axis)) {
                    (Some(start), None | Some(None)) => start + value,
                    _ => return None,
                },
            };
            path.target[axis] = Coordinate::At(value);
        }
        Some(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_blocks_are_read() {
        let block = PlainBlock::read(b" N10 G01X-.5 y2.25Z3. F300 ").expect("plain");
        assert_eq!(block.number, Some(10));
        assert_eq!(block.motion, Some(Motion::Line));
        assert_eq!(block.axes[..3], [Some(-0.5), Some(2.25), Some(3.0)]);
        assert_eq!(block.feed, Some(300.0));
        assert_eq!(block.range, [1, 26]);
    }

    #[test]
    fn all_else_is_left_to_the_parsers() {
        for line in [
            "",
            "G1",
            "F100",
            "N5",
            "G2 X1 I1",
            "G1 X1 ;a",
            "X=5",
            "X1.2.3",
            "X1EX2",
            "XR1",
            "X1 X2",
            "G1 G0 X1",
            "G1.5 X1",
            "G10 X1",
            "G001 X1",
            "X1 N5",
            "N55555555555555555555555555 X1",
            "N1.5 X1",
            "X",
            "X-",
            "X.",
            "X 1",
            "X1234567890.123456",
            "/X1",
            "%",
            "G1 X1 M8",
            "X1,",
            "X--1",
        ] {
            assert_eq!(PlainBlock::read(line.as_bytes()), None, "{line}");
        }
    }
}
