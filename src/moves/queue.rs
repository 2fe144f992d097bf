//! The moves that wait and the one that runs, in order.

use super::{MotionType, Move, StateTag, SynchronisedOutputs, TerminationCondition};
use crate::path::Shape;

/// From this length on the queue reports itself full.
pub const CAPACITY: usize = 2000;

/// A power of two, so that a masked index is in range for the compiler too. What is above
/// [`CAPACITY`] is the margin for moves that were on their way when the queue reported itself
/// full.
const SLOTS: usize = 2048;

/// There is no room left, not even in the margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueueFull;

/// A ring of moves, first in, first out.
///
/// Each move has a serial number, counted from the start of the machine, that stays valid however
/// the queue is consumed.
#[derive(Debug)]
pub struct MoveQueue {
    slots: [Move; SLOTS],
    /// Serial number of the oldest move.
    first: u64,
    /// Serial number of the next move to come; at most `SLOTS` above `first`.
    next: u64,
}

const VACANT: Move = Move {
    id: 0,
    tag: StateTag::EMPTY,
    motion_type: MotionType::Traverse,
    shape: Shape::VACANT,
    feed: 0.0,
    max_velocity: 0.0,
    enables: 0,
    wait_for_spindle: false,
    synchronisation: None,
    indexer_joint: None,
    termination: TerminationCondition::Stop,
    outputs: SynchronisedOutputs::NONE,
};

const fn slot(serial: u64) -> usize {
    serial as usize & (SLOTS - 1)
}

impl MoveQueue {
    /// An empty queue.
    pub const fn new() -> Self {
        Self {
            slots: [VACANT; SLOTS],
            first: 0,
            next: 0,
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

    /// The move with this serial number, `None` if it has left or has not come yet.
    pub fn get(&self, serial: u64) -> Option<&Move> {
        (self.first <= serial && serial < self.next).then(|| &self.slots[slot(serial)])
    }

    /// The oldest move.
    pub fn front(&self) -> Option<&Move> {
        self.get(self.first)
    }

    /// The same, to be changed.
    pub fn front_mut(&mut self) -> Option<&mut Move> {
        (!self.is_empty()).then(|| &mut self.slots[slot(self.first)])
    }

    /// Appends a move. Refused only when the margin above [`CAPACITY`] is used up too.
    pub fn push(&mut self, queued: Move) -> Result<(), QueueFull> {
        if self.len() >= SLOTS {
            return Err(QueueFull);
        }
        self.slots[slot(self.next)] = queued;
        self.next += 1;
        Ok(())
    }

    /// Drops the oldest move, if there is one.
    pub fn pop(&mut self) {
        if !self.is_empty() {
            self.first += 1;
        }
    }

    /// Drops all moves. Serial numbers go on.
    pub fn clear(&mut self) {
        self.first = self.next;
    }
}

impl Default for MoveQueue {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A queue is too large for the stack of a test.
    fn with_queue(test: fn(&mut MoveQueue)) {
        std::thread::Builder::new()
            .stack_size(64 << 20)
            .spawn(move || test(&mut MoveQueue::new()))
            .expect("a thread")
            .join()
            .expect("the test itself");
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
            assert!(queue.get(first - 1).is_none());
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
            queue.pop();
            assert_eq!(queue.len(), 0);
        });
    }
}
