//! How many moves a host hands over before it waits for the machine.
//!
//! A host with a short queue hands over the next move when one has left it. Whoever waits for more then, with the queue
//! full, waits for himself: nothing comes before the machine moves.

/// Moves of a queue that is called short: with more than this the end of what is known hardly matters.
const SHORT: usize = 16;

/// Servo periods within which a move comes that comes because another has left.
const WAKE: u32 = 2;

/// So many moves came like this, one after another, before it is believed ..
const CONVINCING: u32 = 6;
/// .. and the times between them differ by so many servo periods at least: moves that come at regular times may happen to
/// come when others leave.
const LEAST_SPREAD: u32 = 3;

/// What is to be expected of whoever sends the moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Expected {
    /// Nothing is known of it.
    Anything,
    /// A move has left: the next one is on its way.
    OneAtOnce,
    /// The queue is full.
    NothingBeforeOneLeaves,
}

/// What was seen of the queue.
#[derive(Debug)]
pub(super) struct SupplyDepth {
    /// Serial numbers of the first move in the queue, and behind the last one.
    first: u64,
    next: u64,
    /// Servo periods since a move left, and since one came.
    since_left: u32,
    since_came: u32,
    /// The most moves that were queued since it was empty.
    most: usize,
    /// How many moves came in a row because another had left.
    followed: u32,
    /// Shortest and longest time between them, servo periods.
    shortest: u32,
    longest: u32,
}

impl SupplyDepth {
    pub const fn new() -> Self {
        Self {
            first: 0,
            next: 0,
            since_left: 0,
            since_came: 0,
            most: 0,
            followed: 0,
            shortest: u32::MAX,
            longest: 0,
        }
    }

    /// Looks at the queue, once in each servo period in which there is a path: the serial number of its first move, and how
    /// many there are.
    pub fn look(&mut self, first: u64, length: usize) {
        let next = first + length as u64;
        let (left, came) = (first != self.first, next != self.next);
        // Where all have left that were there, it was empty: single moves, one given when another has ended, are no short queue.
        if length == 0 || first >= self.next {
            *self = Self::new();
        }
        (self.first, self.next) = (first, next);
        self.since_left = if left {
            0
        } else {
            self.since_left.saturating_add(1)
        };
        self.since_came = self.since_came.saturating_add(1);
        if came {
            self.note(length);
            self.since_came = 0;
        }
    }

    /// Moves came, and so many are queued now.
    fn note(&mut self, length: usize) {
        if length < self.most {
            return;
        }
        if length > self.most || self.since_left > WAKE {
            self.most = length;
            (self.followed, self.shortest, self.longest) = (0, u32::MAX, 0);
            return;
        }
        self.followed = self.followed.saturating_add(1);
        self.shortest = self.shortest.min(self.since_came);
        self.longest = self.longest.max(self.since_came);
    }

    /// What is to be expected now.
    pub fn expected(&self) -> Expected {
        let spread = self.longest - self.shortest.min(self.longest);
        if self.most > SHORT || self.followed < CONVINCING || spread < LEAST_SPREAD {
            Expected::Anything
        } else if self.next - self.first >= self.most as u64 {
            Expected::NothingBeforeOneLeaves
        } else if self.since_left <= 2 * WAKE {
            Expected::OneAtOnce
        } else {
            Expected::Anything
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A host with a queue of five, and a machine that takes a move after each of these times, servo periods. What is expected
    /// before a move leaves, and in the period in which it has.
    fn serve(depth: &mut SupplyDepth, times: &[u32]) -> Vec<(Expected, Expected)> {
        let mut seen = Vec::new();
        for length in 1..=5 {
            depth.look(0, length);
        }
        for (first, time) in times.iter().enumerate() {
            for _ in 0..*time {
                depth.look(first as u64, 5);
            }
            let before = depth.expected();
            depth.look(first as u64 + 1, 4);
            seen.push((before, depth.expected()));
        }
        seen
    }

    const UNEVEN: [u32; 9] = [9, 4, 7, 4, 4, 12, 5, 6, 7];

    #[test]
    fn a_short_queue_is_known_after_some_moves() {
        let seen = serve(&mut SupplyDepth::new(), &UNEVEN);
        assert_eq!(seen[5], (Expected::Anything, Expected::Anything));
        let known = (Expected::NothingBeforeOneLeaves, Expected::OneAtOnce);
        assert_eq!(seen[7..], [known; 2]);
    }

    #[test]
    fn moves_at_regular_times_are_no_sign_of_it() {
        let seen = serve(&mut SupplyDepth::new(), &[10; 50]);
        assert!(
            seen.iter()
                .all(|seen| *seen == (Expected::Anything, Expected::Anything))
        );
    }

    #[test]
    fn single_moves_are_no_sign_of_it() {
        let mut depth = SupplyDepth::new();
        for (first, time) in UNEVEN.into_iter().enumerate() {
            for _ in 0..time {
                depth.look(first as u64, 1);
                assert_eq!(depth.expected(), Expected::Anything);
            }
        }
    }

    #[test]
    fn one_move_more_and_the_end_of_the_moves_refute_it() {
        let mut longer = SupplyDepth::new();
        serve(&mut longer, &UNEVEN);
        longer.look(9, 5);
        longer.look(9, 6);
        assert_eq!(longer.expected(), Expected::Anything);
        let mut ended = SupplyDepth::new();
        serve(&mut ended, &UNEVEN);
        for _ in 0..2 * WAKE + 1 {
            ended.look(9, 4);
        }
        assert_eq!(ended.expected(), Expected::Anything);
    }
}
