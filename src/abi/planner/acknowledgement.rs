//! When task learns that motion has taken a move.
//!
//! motmod acknowledges a command when it begins with it; what follows from it is in the status only at the end of the
//! servo period, and until then task may not be able to read the status at all. A task that sees the acknowledgement
//! meanwhile goes on with the status of before: the queue is empty and the machine in position, so its move is done. It
//! gives up the program after a probe ("Queue is not empty after probing", LinuxCNC's issues 263, 662 and 3650), or
//! changes the tool while the move before is about to begin. Therefore the acknowledgement of a move is held back until
//! motmod, at the end of the period, asks whether there is room for more.

use core::sync::atomic::{AtomicI32, AtomicU8, Ordering};

/// What task reads of motmod's status to know what motion has done with its commands. It copies the whole from the
/// front to the back, and believes the copy if the count of changes at the front is the same as the one at the back.
pub(super) struct Answer<'a> {
    /// The number of the last command that is acknowledged.
    pub(super) command: &'a AtomicI32,
    /// The count of changes at the front; motmod copies it to the back when it is done with a change.
    pub(super) changes: &'a AtomicU8,
}

/// The acknowledgement of the last move.
#[derive(Debug)]
pub(super) struct Acknowledgement {
    /// The number of its command, while it is held back.
    held: Option<i32>,
}

impl Acknowledgement {
    pub(super) const NONE: Self = Self { held: None };

    /// Holds back the acknowledgement of a move that has been queued.
    pub(super) fn hold(&mut self, answer: &Answer) {
        let last = answer.command.load(Ordering::Relaxed);
        if self.is_held(last) {
            return;
        }
        self.held = Some(last);
        answer
            .command
            .store(last.wrapping_sub(1), Ordering::Relaxed);
        // Who has read the front before this has seen the acknowledgement. That copy must not fit the back.
        answer.changes.fetch_add(1, Ordering::Release);
    }

    /// Gives what is held back.
    pub(super) fn give(&mut self, answer: &Answer) {
        let last = answer.command.load(Ordering::Relaxed);
        if self.is_held(last) {
            answer
                .command
                .store(last.wrapping_add(1), Ordering::Relaxed);
        }
        self.held = None;
    }

    /// Whether motmod hands over once more the move whose acknowledgement is held back, since a period has ended
    /// without its question. The move is in the queue, and its acknowledgement has to stand.
    pub(super) fn is_repeated(&self, answer: &Answer) -> bool {
        self.held == Some(answer.command.load(Ordering::Relaxed))
    }

    /// Whether the last number is the one that `hold` left there.
    fn is_held(&self, last: i32) -> bool {
        self.held.map(|number| number.wrapping_sub(1)) == Some(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// motmod's side.
    struct MotionStatus {
        command: AtomicI32,
        changes: AtomicU8,
    }

    impl MotionStatus {
        fn new(command: i32) -> Self {
            Self {
                command: command.into(),
                changes: 0.into(),
            }
        }

        fn answer(&self) -> Answer<'_> {
            Answer {
                command: &self.command,
                changes: &self.changes,
            }
        }

        fn take(&self, command: i32) {
            self.command.store(command, Ordering::Relaxed);
        }

        fn acknowledged(&self) -> i32 {
            self.command.load(Ordering::Relaxed)
        }
    }

    #[test]
    fn is_given_at_the_end_of_the_period() {
        for number in [7, 0, i32::MIN, i32::MAX] {
            let (mut acknowledgement, status) = (Acknowledgement::NONE, MotionStatus::new(number));
            acknowledgement.hold(&status.answer());
            assert_ne!(status.acknowledged(), number);
            for _ in 0..2 {
                acknowledgement.give(&status.answer());
                assert_eq!(status.acknowledged(), number);
            }
        }
    }

    #[test]
    fn spoils_the_copy_that_was_begun_before() {
        let (mut acknowledgement, status) = (Acknowledgement::NONE, MotionStatus::new(7));
        acknowledgement.hold(&status.answer());
        assert_eq!(status.changes.load(Ordering::Relaxed), 1);
    }

    #[test]
    fn knows_a_move_that_comes_again() {
        let (mut acknowledgement, status) = (Acknowledgement::NONE, MotionStatus::new(7));
        assert!(!acknowledgement.is_repeated(&status.answer()));
        acknowledgement.hold(&status.answer());
        status.take(7); // the next period, which takes the command for a new one
        assert!(acknowledgement.is_repeated(&status.answer()));
        acknowledgement.give(&status.answer());
        assert_eq!(status.acknowledged(), 7);
        assert!(!acknowledgement.is_repeated(&status.answer()));
    }

    #[test]
    fn is_not_taken_back_twice_where_nobody_acknowledges() {
        let (mut acknowledgement, status) = (Acknowledgement::NONE, MotionStatus::new(7));
        for _ in 0..3 {
            assert!(!acknowledgement.is_repeated(&status.answer()));
            acknowledgement.hold(&status.answer());
            assert_eq!(status.acknowledged(), 6);
        }
        acknowledgement.give(&status.answer());
        assert_eq!(status.acknowledged(), 7);
    }

    #[test]
    fn of_another_command_is_left_alone() {
        let (mut acknowledgement, status) = (Acknowledgement::NONE, MotionStatus::new(7));
        acknowledgement.hold(&status.answer());
        status.take(8); // a command that is no move, in the same period
        acknowledgement.give(&status.answer());
        assert_eq!(status.acknowledged(), 8);
        acknowledgement.hold(&status.answer());
        assert_eq!(status.acknowledged(), 7);
    }
}
