//! The moves that wait and the one that runs, in order.

use super::near_limit::NearLimit;
use super::queued_move::Move;
use super::shape::Shape;
use super::{MotionType, StateTag, SynchronisedOutputs, TerminationCondition};
use crate::ring::Ring;

/// From this length on the queue reports itself full.
pub const CAPACITY: usize = 2000;

/// What is above [`CAPACITY`] remembers moves that have left the queue, and is the margin for moves that were on
/// their way when the queue reported itself full.
const SLOTS: usize = 4096;

/// There is no room left, not even in the margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueueFull;

/// A ring of moves, first in, first out. The last ones that have left are remembered, so that a
/// run may go back to them.
///
/// Each move has a serial number, counted from the start of the machine, that stays valid however
/// the queue is consumed.
#[derive(Debug)]
pub struct MoveQueue {
    slots: Ring<Move, SLOTS>,
    /// Serial number of the oldest move that waits or runs.
    first: u64,
    /// Serial number of the next move to come; at most `SLOTS` above `first`.
    next: u64,
    /// No move with a lower serial number is remembered.
    cleared: u64,
    /// Serial number of the first move that must not run yet.
    released: u64,
    /// Serial number of the first move that has not begun.
    begun: u64,
    /// How long all moves before each one take at their feeds, seconds.
    seconds_before: Ring<f64, SLOTS>,
    /// The same before the next move to come.
    seconds: f64,
}

const VACANT: Move = Move {
    id: 0,
    tag: StateTag::EMPTY,
    motion_type: MotionType::Traverse,
    shape: Shape::VACANT,
    feed: 0.0,
    feed_word: None,
    max_velocity: 0.0,
    axis_jerk: f64::INFINITY,
    enables: 0,
    wait_for_spindle: false,
    synchronisation: None,
    indexer_joint: None,
    termination: TerminationCondition::Stop,
    near_limit: NearLimit::NONE,
    outputs: SynchronisedOutputs::NONE,
};

impl MoveQueue {
    /// An empty queue.
    pub const fn new() -> Self {
        Self {
            slots: Ring::filled_with(VACANT),
            first: 0,
            next: 0,
            cleared: 0,
            released: 0,
            begun: 0,
            seconds_before: Ring::filled_with(0.0),
            seconds: 0.0,
        }
    }

    /// How many moves there are, the running one included.
    pub fn len(&self) -> usize {
        self.next.wrapping_sub(self.first) as usize
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.next == self.first
    }

    /// Whether no more should be sent: from [`CAPACITY`] on, while there is still a margin.
    pub fn is_full(&self) -> bool {
        self.len() >= CAPACITY
    }

    /// Serial number of the oldest move, or of the next one to come if there is none.
    pub fn first_serial(&self) -> u64 {
        self.first
    }

    /// Serial number of the oldest move that is remembered, or of the oldest one there is.
    pub fn oldest(&self) -> u64 {
        self.cleared.max(self.next.saturating_sub(SLOTS as u64))
    }

    /// The move with this serial number, also if it has left; `None` if it is not remembered any
    /// more or has not come yet.
    pub fn get(&self, serial: u64) -> Option<&Move> {
        (self.oldest() <= serial && serial < self.next).then(|| self.slots.at(serial))
    }

    /// The oldest move that has not left.
    pub fn front(&self) -> Option<&Move> {
        self.get(self.first)
    }

    /// The same, to be changed.
    pub fn front_mut(&mut self) -> Option<&mut Move> {
        (!self.is_empty()).then(|| self.slots.at_mut(self.first))
    }

    /// Appends a move. Refused only when the margin above [`CAPACITY`] is used up too.
    pub fn push(&mut self, queued: Move) -> Result<(), QueueFull> {
        if self.len() >= SLOTS {
            return Err(QueueFull);
        }
        *self.seconds_before.at_mut(self.next) = self.seconds;
        self.seconds += queued.seconds_at_feed();
        *self.slots.at_mut(self.next) = queued;
        self.next += 1;
        Ok(())
    }

    /// How long the moves from `serial` on take at their feeds, seconds; of those that are remembered.
    pub fn seconds_at_feed_from(&self, serial: u64) -> f64 {
        if serial < self.next {
            self.seconds - *self.seconds_before.at(serial.max(self.oldest()))
        } else {
            0.0
        }
    }

    /// Drops the oldest move, if there is one; it is remembered.
    pub fn pop(&mut self) {
        if !self.is_empty() {
            self.first += 1;
        }
    }

    /// Takes back the moves from `serial` on that have left; does nothing if that one is not
    /// remembered.
    pub fn return_to(&mut self, serial: u64) {
        if self.oldest() <= serial && serial < self.first {
            self.first = serial;
        }
    }

    /// Whether the oldest move has begun.
    pub fn has_begun(&self) -> bool {
        self.first < self.begun
    }

    /// The oldest move begins, or goes on after a run back. It, and whether this is the first time.
    pub fn begin_front(&mut self) -> Option<(&Move, bool)> {
        let first_time = self.first >= self.begun;
        if !self.is_empty() {
            self.begun = self.begun.max(self.first + 1);
        }
        self.front().map(|front| (front, first_time))
    }

    /// Serial number of the first move since the queue was last cleared, come or to come.
    pub fn cleared(&self) -> u64 {
        self.cleared
    }

    /// The move with this serial number as [`Self::get`] has it, if it may run.
    pub fn released(&self, serial: u64) -> Option<&Move> {
        self.get(serial).filter(|_| serial < self.released)
    }

    /// Allows the moves before `serial` to run.
    pub fn release(&mut self, serial: u64) {
        self.released = self.released.max(serial.min(self.next));
    }

    /// Allows the move with this serial number to run as well, the next one in turn, and takes note which of its ends are near
    /// a soft limit.
    pub fn release_near_limit(&mut self, serial: u64, near_limit: NearLimit) {
        if self.get(serial).is_some() {
            self.slots.at_mut(serial).near_limit = near_limit;
        }
        self.release(serial + 1);
    }

    /// Allows all moves to run that have come.
    pub fn release_all(&mut self) {
        self.released = self.next;
    }

    /// Drops all moves and remembers none. Serial numbers go on.
    pub fn clear(&mut self) {
        self.first = self.next;
        self.cleared = self.next;
        self.released = self.next;
        self.seconds = 0.0;
    }
}

impl Default for MoveQueue {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::Line9;
    use super::*;
    use crate::axes::Axes;
    use crate::test_room::with_room;

    /// A queue is too large for the stack of a test.
    fn with_queue(test: fn(&mut MoveQueue)) {
        with_room(move || test(&mut MoveQueue::new()));
    }

    #[test]
    fn is_first_in_first_out_beyond_one_round() {
        with_queue(|queue| {
            let mut expected = 0;
            for id in 0..3 * SLOTS as i32 {
                queue.push(Move { id, ..VACANT }).expect("room");
                if queue.len() > 100 {
                    assert_eq!(queue.front().map(|m| m.id), Some(expected));
                    queue.pop();
                    expected += 1;
                }
            }
            assert_eq!(queue.len(), 100);
            let first = queue.first_serial();
            assert_eq!(
                queue.get(first + 99).map(|m| m.id),
                Some(3 * SLOTS as i32 - 1)
            );
            assert!(queue.get(first + 100).is_none());
            let oldest = queue.oldest();
            assert_eq!(queue.get(first - 1).map(|m| m.id), Some(expected - 1));
            assert_eq!(queue.get(oldest).map(|m| m.id), Some(oldest as i32));
            assert!(queue.get(oldest - 1).is_none());
            queue.return_to(oldest - 1);
            assert_eq!(queue.first_serial(), first);
            queue.return_to(oldest);
            assert_eq!(queue.len(), SLOTS);
            assert_eq!(queue.front().map(|m| m.id), Some(oldest as i32));
        });
    }

    #[test]
    fn the_time_at_feed_is_that_of_the_moves_behind() {
        with_queue(|queue| {
            let mut end = Axes::zeros();
            for k in 0..3 * SLOTS {
                let start = end;
                end[0] += 3.0;
                let feed = if k % 2 == 0 { 6.0 } else { 60.0 };
                let queued = Move {
                    shape: Shape::Line(Line9::new(&start, &end).expect("a line")),
                    feed,
                    max_velocity: 12.0,
                    ..VACANT
                };
                queue.push(queued).expect("room");
                if queue.len() > 1000 {
                    queue.pop();
                }
            }
            let first = queue.first_serial();
            assert!((queue.seconds_at_feed_from(first) - 375.0).abs() < 1e-9);
            assert!((queue.seconds_at_feed_from(first + 1) - 374.5).abs() < 1e-9);
            assert_eq!(queue.seconds_at_feed_from(first + 1000), 0.0);
        });
    }

    #[test]
    fn a_move_begins_once() {
        with_queue(|queue| {
            assert!(queue.begin_front().is_none() && !queue.has_begun());
            for id in 0..3 {
                queue.push(Move { id, ..VACANT }).expect("room");
            }
            for _ in 0..2 {
                assert!(!queue.has_begun());
                assert!(
                    queue
                        .begin_front()
                        .is_some_and(|(_, first_time)| first_time)
                );
                assert!(queue.has_begun());
                queue.pop();
            }
            queue.return_to(0);
            assert!(queue.has_begun());
            let again = queue.begin_front().map(|(front, first)| (front.id, first));
            assert_eq!(again, Some((0, false)));
            queue.clear();
            assert!(!queue.has_begun());
        });
    }

    #[test]
    fn reports_itself_full_before_it_refuses() {
        with_queue(|queue| {
            for id in 0..SLOTS as i32 {
                assert_eq!(queue.is_full(), id as usize >= CAPACITY);
                queue.push(Move { id, ..VACANT }).expect("room");
            }
            assert_eq!(queue.push(VACANT), Err(QueueFull));
            assert_eq!(queue.len(), SLOTS);
            queue.clear();
            assert!(queue.is_empty() && !queue.is_full() && queue.front().is_none());
            queue.return_to(0);
            queue.pop();
            assert_eq!(queue.len(), 0);
        });
    }
}
