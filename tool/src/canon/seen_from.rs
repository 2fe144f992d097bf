//! The calls of a program with its zero elsewhere.

use super::call::Call;
use crate::path::Position;

/// The same call as seen from this place, mm and degrees: planners know of no zero, and motion begins at one of its own.
pub fn seen_from(call: Call, origin: &Position) -> Call {
    let place = |end: Position| std::array::from_fn(|axis| end[axis] - origin[axis]);
    match call {
        Call::Traverse { line, end } => Call::Traverse {
            line,
            end: place(end),
        },
        Call::Feed { line, end } => Call::Feed {
            line,
            end: place(end),
        },
        Call::Probe { line, end } => Call::Probe {
            line,
            end: place(end),
        },
        Call::Tap { line, end } => Call::Tap {
            line,
            end: place(end),
        },
        Call::Arc {
            line,
            end,
            centre,
            normal,
            turns,
            plane,
            rotated,
        } => Call::Arc {
            line,
            end: place(end),
            centre: std::array::from_fn(|axis| centre[axis] - origin[axis]),
            normal,
            turns,
            plane,
            rotated,
        },
        Call::Surface { greatest, centre } => Call::Surface {
            greatest,
            centre: centre - origin[0],
        },
        // No places: named one by one, since one that is added may have some.
        Call::Rate(..)
        | Call::PerRevolution(..)
        | Call::Unit(..)
        | Call::Mode(..)
        | Call::NaiveCam(..)
        | Call::Tag(..)
        | Call::Synchronise { .. }
        | Call::Spindle { .. }
        | Call::Speed(..)
        | Call::ToolLength(..)
        | Call::Dwell(..)
        | Call::Wait
        | Call::UserCode(..)
        | Call::Input(..)
        | Call::OptionalBlock
        | Call::Flush => call,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: Position = [1.0, -2.0, 3.0, 10.0, 20.0, 30.0, 0.0, 0.0, 0.5];

    #[test]
    fn places_are_moved_and_nothing_else() {
        let moved = |text: &str| seen_from(Call::parse(text).expect("a call"), &ORIGIN);
        let end = "5 5 5 10 20 30 0 0 1";
        let seen = "4 7 2 0 0 0 0 0 0.5";
        for kind in ["TRAVERSE", "FEED", "PROBE", "TAP"] {
            let expected = Call::parse(&format!("{kind} 7 {seen}")).expect("a call");
            assert_eq!(moved(&format!("{kind} 7 {end}")), expected);
        }
        let arc = |end: &str, centre: &str| format!("ARC 7 {end} {centre} 0 0 1 -1 0 1");
        let expected = Call::parse(&arc(seen, "1 1 -1")).expect("a call");
        assert_eq!(moved(&arc(end, "2 -1 2")), expected);
        let expected = Call::parse("SURFACE 2500 3").expect("a call");
        assert_eq!(moved("SURFACE 2500 4"), expected);
        for other in ["RATE 100", "UNIT 25.4", "SYNC 1.5 0"] {
            assert_eq!(moved(other), Call::parse(other).expect("a call"));
        }
    }
}
