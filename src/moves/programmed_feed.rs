//! The F of the program, where the feed that LinuxCNC hands over with an arc is less.
//!
//! LinuxCNC's canon slows an arc down to what leaves room for the acceleration towards its centre, sqrt(.866 A R), and hands over
//! no other feed (emccanon, `ARC_FEED`). A planner that keeps the acceleration of each axis, and may leave the arc by a tolerance,
//! can be faster. No move is handed over with more than F: as long as F is the same an arc may be as fast as any move with it was to be.
//!
//! That F is the same tells the state tag of the moves, by its number and its units. The number alone is no feed: LinuxCNC takes an F
//! in the block of a G20 for one in the units before, and a G20 behind an F changes the units of the tag alone.

/// Flags of LinuxCNC's `state_tag_t` (`state_tag.h`): G20, G93, G94.
pub const INCHES: u64 = 1 << 0;
/// See [`INCHES`].
pub const INVERSE_TIME: u64 = 1 << 6;
/// See [`INCHES`].
pub const UNITS_PER_MINUTE: u64 = 1 << 7;

/// An F for a minute (G94), as the state tag has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedWord {
    number: f64,
    inches: bool,
}

impl FeedWord {
    /// That of a tag with this number and these flags; `None` if it is no feed for a minute.
    pub fn of_tag(number: f64, flags: impl Into<u64>) -> Option<Self> {
        let flags = flags.into();
        let per_minute = flags & (INVERSE_TIME | UNITS_PER_MINUTE) == UNITS_PER_MINUTE;
        let inches = flags & INCHES != 0;
        per_minute.then_some(Self { number, inches })
    }
}

/// What is known of F.
#[derive(Clone, Copy, Debug)]
pub struct ProgrammedFeed {
    word: Option<FeedWord>,
    /// The greatest feed that was handed over with it, in the units of the moves.
    greatest: f64,
}

impl ProgrammedFeed {
    /// Nothing.
    pub const UNKNOWN: Self = Self {
        word: None,
        greatest: 0.0,
    };

    /// Feed and greatest velocity of the next move at feed that F counts X, Y and Z of, as they were handed over with its `word`:
    /// both are F, as far as that is known, for an arc that has been slowed down. No override makes it faster than that.
    pub fn of_move(
        &mut self,
        is_arc: bool,
        [feed, greatest]: [f64; 2],
        word: Option<FeedWord>,
    ) -> [f64; 2] {
        if word.is_none() {
            return [feed, greatest];
        }
        if self.word != word {
            *self = Self {
                word,
                greatest: 0.0,
            };
        }
        // What is no feed is refused later, and says nothing of F.
        if feed.is_finite() {
            self.greatest = self.greatest.max(feed);
        }
        if is_arc && feed >= greatest && self.greatest > feed {
            [self.greatest; 2]
        } else {
            [feed, greatest]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn f(number: f64, flags: u64) -> Option<FeedWord> {
        FeedWord::of_tag(number, flags | UNITS_PER_MINUTE)
    }

    #[test]
    fn an_arc_is_as_fast_as_another_move_with_the_same_f() {
        let mut known = ProgrammedFeed::UNKNOWN;
        let word = f(3000.0, 0);
        assert_eq!(known.of_move(true, [20.0, 20.0], word), [20.0, 20.0]);
        assert_eq!(known.of_move(false, [50.0, 100.0], word), [50.0, 100.0]);
        assert_eq!(known.of_move(false, [30.0, 30.0], word), [30.0, 30.0]);
        assert_eq!(known.of_move(true, [20.0, 20.0], word), [50.0, 50.0]);
        // That move is refused.
        known.of_move(false, [f64::INFINITY, f64::INFINITY], word);
        assert_eq!(known.of_move(true, [20.0, 20.0], word), [50.0, 50.0]);
        // At its F already.
        assert_eq!(known.of_move(true, [20.0, 30.0], word), [20.0, 30.0]);
    }

    #[test]
    fn another_f_is_unknown_and_so_are_other_units() {
        for other in [f(1500.0, 0), f(3000.0, INCHES), f(f64::NAN, 0)] {
            let mut known = ProgrammedFeed::UNKNOWN;
            known.of_move(false, [50.0, 100.0], f(3000.0, 0));
            assert_eq!(known.of_move(true, [20.0, 20.0], other), [20.0, 20.0]);
        }
    }

    #[test]
    fn feeds_of_other_kinds_are_left_as_they_are() {
        for flags in [0u64, INVERSE_TIME, INVERSE_TIME | UNITS_PER_MINUTE] {
            let mut known = ProgrammedFeed::UNKNOWN;
            let word = FeedWord::of_tag(3000.0, flags);
            assert_eq!(word, None);
            known.of_move(false, [50.0, 100.0], word);
            assert_eq!(known.of_move(true, [20.0, 20.0], word), [20.0, 20.0]);
        }
    }
}
