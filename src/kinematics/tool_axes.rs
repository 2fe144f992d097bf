//! How a user says which axes turn the tool (`tool_axes=`), for kinematics that cannot be asked: arms.
//!
//! `C,B`: C carries B, which carries the tool. A turns about X, B about Y, C about Z, the tool against the workpiece and
//! right-handed; `-C` turns the other way round, as a table does. `B:0:1:1` turns about another line, X Y Z of a vector of
//! whole numbers. `none`: no axis turns the tool. With all axes at 0 it stands along Z.

use nalgebra::{Unit, Vector3};

use super::rotary_chain::{RotaryAxis, RotaryChain};

/// What is said of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolAxes {
    /// Nothing: the kinematics are asked.
    Unsaid,
    /// None turns the tool.
    Nothing,
    /// These do.
    Turning(RotaryChain),
}

impl ToolAxes {
    /// What a text says; `None` if it says nothing that can be.
    pub fn from_text(text: &[u8]) -> Option<Self> {
        match text {
            b"" => return Some(Self::Unsaid),
            b"none" => return Some(Self::Nothing),
            _ => {}
        }
        let mut words = text.split(|letter| *letter == b',').map(axis);
        let (first, second, more) = (words.next()??, words.next(), words.next());
        if more.is_some() {
            return None;
        }
        let chain = match second {
            None => RotaryChain {
                rotary: None,
                tilt: first,
            },
            Some(second) => RotaryChain {
                rotary: Some(first),
                tilt: second?,
            },
        };
        let is_twice = chain
            .rotary
            .is_some_and(|rotary| rotary.letter == chain.tilt.letter);
        // What turns about the tool tilts nothing.
        let tilts = chain.tilt.line.x.hypot(chain.tilt.line.y) > 0.0;
        (tilts && !is_twice).then_some(Self::Turning(chain))
    }
}

/// One axis: `C`, `-C`, `B:0:1:1`.
fn axis(word: &[u8]) -> Option<RotaryAxis> {
    let (sign, word) = match word {
        [b'-', rest @ ..] => (-1.0, rest),
        _ => (1.0, word),
    };
    let mut parts = word.split(|letter| *letter == b':');
    let (letter, line) = match parts.next()? {
        b"A" | b"a" => (0, Vector3::x()),
        b"B" | b"b" => (1, Vector3::y()),
        b"C" | b"c" => (2, Vector3::z()),
        _ => return None,
    };
    let number = |part: &[u8]| core::str::from_utf8(part).ok()?.parse::<i32>().ok();
    let line = match parts.next() {
        None => line,
        Some(x) => {
            let (x, y, z) = (number(x)?, number(parts.next()?)?, number(parts.next()?)?);
            Vector3::new(x.into(), y.into(), z.into())
        }
    };
    if parts.next().is_some() {
        return None;
    }
    Some(RotaryAxis {
        letter,
        line: Unit::try_new(sign * line, 0.5)?,
        is_of_head: true,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::RotaryAngles;

    fn chain(text: &str) -> RotaryChain {
        match ToolAxes::from_text(text.as_bytes()) {
            Some(ToolAxes::Turning(chain)) => chain,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn axes_are_read_from_the_one_that_carries_the_other() {
        let angles = RotaryAngles {
            tilt: 90.0,
            rotary: 90.0,
        };
        for (text, expected) in [
            // B lays the tool along X, C turns that to Y
            ("C,B", Vector3::y()),
            ("c,-b", -Vector3::y()),
            ("-C,B", -Vector3::y()),
            ("B", Vector3::x()),
            // about the line between Y and Z half a turn swaps these; a quarter of it lies between
            ("B:0:1:0", Vector3::x()),
            ("-B:0:-7:0", Vector3::x()),
        ] {
            let found = chain(text).direction(angles);
            assert!((found - expected).norm() < 1e-12, "{text}: {found}");
        }
        let slanting = chain("A:0:1:1").direction(RotaryAngles {
            tilt: 180.0,
            rotary: 0.0,
        });
        assert!((slanting - Vector3::y()).norm() < 1e-12, "{slanting}");
    }

    #[test]
    fn a_tilt_square_to_z_below_c_is_known() {
        for (text, tilt) in [
            ("C,B", Some(4)),
            ("-C,A", Some(3)),
            ("B", None),
            ("C:0:1:1,B", None),
            ("A:0:0:1,B", None),
            ("C,B:0:1:1", None),
        ] {
            assert_eq!(chain(text).tilt_axis_below_c(), tilt, "{text}");
        }
    }

    #[test]
    fn what_says_nothing_that_can_be_is_refused() {
        assert_eq!(ToolAxes::from_text(b""), Some(ToolAxes::Unsaid));
        assert_eq!(ToolAxes::from_text(b"none"), Some(ToolAxes::Nothing));
        for nonsense in [
            "C",
            "B,C",
            "X",
            "C,B,A",
            "B,B",
            ",B",
            "B,",
            "-",
            "B:1",
            "B:0:1",
            "B:0:0:0",
            "B:0:1:1:1",
            "B:0:.5:1",
            "B:0:0:1",
            "None",
            "CB",
        ] {
            assert_eq!(ToolAxes::from_text(nonsense.as_bytes()), None, "{nonsense}");
        }
    }
}
