//! The canonical calls of a program: what the interpreter asks of the machine.

use crate::path::Position;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The plane of an arc (G17, G19, G18).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// G17.
    Xy,
    /// G19.
    Yz,
    /// G18.
    Zx,
}

impl Plane {
    /// Index of the axis that is normal to the plane.
    pub fn normal_axis(self) -> usize {
        match self {
            Plane::Xy => 2,
            Plane::Yz => 0,
            Plane::Zx => 1,
        }
    }
}

/// How moves end (G61.1, G61, G64).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PathMode {
    /// Stop at the end of each move.
    ExactStop,
    /// Through the end of each move.
    ExactPath,
    /// Blended within the tolerance.
    Continuous,
}

/// The state of the interpreter that travels with a move, as LinuxCNC's `state_tag_t` has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tag {
    /// G64 P, program units.
    pub path_tolerance: f64,
    /// G64 Q, program units.
    pub naive_cam_tolerance: f64,
    /// F, program units per minute.
    pub feed: f64,
    /// S, revolutions per minute.
    pub speed: f64,
    /// The flags in their packed form.
    pub flags: u64,
    /// Line number, motion mode, plane and others.
    pub fields: [i32; 8],
    /// The file of the line: 0 is the program, n the nth file of subroutines that is read. LinuxCNC's tag has no name.
    pub file: usize,
}

/// What M66 asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Input {
    /// An analog input (E) or a digital one (P).
    pub analog: bool,
    /// Its number.
    pub number: i32,
    /// L: 0 looks at it, 1 waits until it goes on, 2 off, 3 until it is on, 4 off.
    pub mode: i32,
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = if self.analog { 'E' } else { 'P' };
        write!(f, "M66 {letter}{} L{}", self.number, self.mode)
    }
}

/// One call. Lengths are millimetres, angles degrees, unless it says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum Call {
    /// A rapid move.
    Traverse {
        /// Line of the program.
        line: i32,
        /// Where to.
        end: Position,
    },
    /// A straight move at feed.
    Feed {
        /// Line of the program.
        line: i32,
        /// Where to.
        end: Position,
    },
    /// A probing move.
    Probe {
        /// Line of the program.
        line: i32,
        /// Where to.
        end: Position,
    },
    /// Rigid tapping to the end and back.
    Tap {
        /// Line of the program.
        line: i32,
        /// The bottom.
        end: Position,
    },
    /// An arc or a helix.
    Arc {
        /// Line of the program.
        line: i32,
        /// Where to.
        end: Position,
        /// Centre.
        centre: [f64; 3],
        /// Normal of the plane.
        normal: [f64; 3],
        /// Turns begun: positive counter-clockwise about the normal, negative clockwise, 0 for a line.
        turns: i32,
        /// The plane.
        plane: Plane,
        /// Whether G10 L2 R rotates the axes.
        rotated: bool,
    },
    /// F, program units per minute (per revolution in that mode).
    Rate(f64),
    /// Feed per revolution (G95).
    PerRevolution(bool),
    /// Millimetres of one program unit of length.
    Unit(f64),
    /// Path mode with its tolerance (P; 0 for none).
    Mode(PathMode, f64),
    /// Tolerance of the merging of short lines (Q).
    NaiveCam(f64),
    /// The tag of the moves to come.
    Tag(Tag),
    /// Motion follows the spindle; 0 ends it.
    Synchronise {
        /// Millimetres per revolution.
        per_revolution: f64,
        /// Only the speed follows (G95), not the position (G33).
        velocity_mode: bool,
    },
    /// How S counts in the calls of the spindle that follow.
    Surface {
        /// Constant surface speed (G96) with at most so many revolutions per minute; 0: none.
        greatest: f64,
        /// Where the work turns about: X of the machine.
        centre: f64,
    },
    /// The spindle is switched.
    Spindle {
        /// Revolutions per minute; millimetres per minute with a constant surface speed.
        speed: f64,
        /// 1 clockwise, -1 counter-clockwise, 0 off.
        direction: i32,
    },
    /// S, as in [`Call::Spindle`].
    Speed(f64),
    /// Length of the tool along Z from here on, mm.
    ToolLength(f64),
    /// Waits for the end of motion, then as many seconds.
    Dwell(f64),
    /// What comes next waits for the end of motion.
    Wait,
    /// Waits for the end of motion, then for a program of the machine: M100 to M199.
    UserCode(u32),
    /// M66 that waits for an input, or whose answer the program looks at; motion has come to its end before.
    Input(Input),
    /// A block that begins with a slash is carried out, the first of them.
    OptionalBlock,
    /// Ends the merging of short lines.
    Flush,
}

/// The words of a line, one after the other.
struct Words<'a>(std::str::SplitAsciiWhitespace<'a>);

impl Words<'_> {
    fn number<T: std::str::FromStr>(&mut self) -> Option<T> {
        self.0.next()?.parse().ok()
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number()?;
        }
        Some(numbers)
    }

    fn flag(&mut self) -> Option<bool> {
        Some(self.number::<i32>()? != 0)
    }
}

impl Call {
    /// Reads a line that the interpreter program printed; `None` if it is not such a line.
    pub fn parse(text: &str) -> Option<Call> {
        let mut words = Words(text.split_ascii_whitespace());
        let call = match words.0.next()? {
            "TRAVERSE" => Call::Traverse {
                line: words.number()?,
                end: words.numbers()?,
            },
            "FEED" => Call::Feed {
                line: words.number()?,
                end: words.numbers()?,
            },
            "PROBE" => Call::Probe {
                line: words.number()?,
                end: words.numbers()?,
            },
            "TAP" => Call::Tap {
                line: words.number()?,
                end: words.numbers()?,
            },
            "ARC" => Call::Arc {
                line: words.number()?,
                end: words.numbers()?,
                centre: words.numbers()?,
                normal: words.numbers()?,
                turns: words.number()?,
                plane: match words.number::<i32>()? {
                    0 => Plane::Xy,
                    1 => Plane::Yz,
                    2 => Plane::Zx,
                    _ => return None,
                },
                rotated: words.flag()?,
            },
            "RATE" => Call::Rate(words.number()?),
            "FEEDMODE" => Call::PerRevolution(words.flag()?),
            "UNIT" => Call::Unit(words.number()?),
            "TERM" => {
                let mode = match words.number::<i32>()? {
                    1 => PathMode::ExactStop,
                    2 => PathMode::ExactPath,
                    3 => PathMode::Continuous,
                    _ => return None,
                };
                Call::Mode(mode, words.number()?)
            }
            "NAIVECAM" => Call::NaiveCam(words.number()?),
            "TAG" => Call::Tag(tag(&mut words)?),
            "SYNC" => Call::Synchronise {
                per_revolution: words.number()?,
                velocity_mode: words.flag()?,
            },
            "SURFACE" => Call::Surface {
                greatest: words.number()?,
                centre: words.number()?,
            },
            "SPINDLE" => Call::Spindle {
                speed: words.number()?,
                direction: words.number()?,
            },
            "SPEED" => Call::Speed(words.number()?),
            "LENGTH" => Call::ToolLength(words.number()?),
            "DWELL" => Call::Dwell(words.number()?),
            "WAIT" => Call::Wait,
            "USER" => Call::UserCode(words.number()?),
            "INPUT" => Call::Input(Input {
                analog: words.flag()?,
                number: words.number()?,
                mode: words.number()?,
            }),
            "SLASH" => Call::OptionalBlock,
            "FLUSH" => Call::Flush,
            _ => return None,
        };
        words.0.next().is_none().then_some(call)
    }
}

fn tag(words: &mut Words) -> Option<Tag> {
    let [path_tolerance, naive_cam_tolerance, feed, speed] = words.numbers()?;
    let flags = words.number()?;
    let mut fields = [0; 8];
    for field in &mut fields {
        *field = words.number()?;
    }
    Some(Tag {
        path_tolerance,
        naive_cam_tolerance,
        feed,
        speed,
        flags,
        fields,
        file: words.number()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_every_digit() {
        let call = Call::parse("FEED 7 0.10000000000000001 -2 3 0 0 0 0 0 1e-300");
        let end = [0.1, -2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-300];
        assert_eq!(call, Some(Call::Feed { line: 7, end }));
    }

    #[test]
    fn refuses_what_is_too_short_too_long_or_unknown() {
        assert_eq!(Call::parse("RATE"), None);
        assert_eq!(Call::parse("RATE 1 2"), None);
        assert_eq!(Call::parse("TERM 4 0"), None);
        assert_eq!(Call::parse("Traceback (most recent call last):"), None);
    }
}
