//! The lock of a rotary indexer: it is opened for a move, and closed behind it.

/// What the lock of an indexer was told last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Indexer {
    /// Nothing, or it has locked.
    Locked,
    /// To unlock this joint for the next move, or it is unlocked while that runs.
    Unlocking(i32),
    /// To lock a joint.
    Locking(Locking),
}

/// A joint that is to lock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Locking {
    pub joint: i32,
    /// Whether the move of the indexer is in the queue still, and over when this is done.
    pub ends_move: bool,
}

impl Indexer {
    /// Tells the lock of this joint to open, where none is being closed. Whether it was told before, so that what
    /// it answers now is an answer to that.
    pub fn unlock(&mut self, joint: i32) -> bool {
        let told = *self == Self::Unlocking(joint);
        if *self == Self::Locked {
            *self = Self::Unlocking(joint);
        }
        told
    }

    /// Behind a move of this indexer, which is over when it has locked.
    pub fn lock(&mut self, joint: i32) {
        *self = Self::Locking(Locking {
            joint,
            ends_move: true,
        });
    }

    /// The move for which it was unlocked does not come, or is forgotten: what is open is locked again.
    pub fn give_up(&mut self) {
        if let Some(joint) = self.joint() {
            *self = Self::Locking(Locking {
                joint,
                ends_move: false,
            });
        }
    }

    /// It has locked.
    pub fn has_locked(&mut self) {
        *self = Self::Locked;
    }

    /// What is to lock.
    pub fn locking(&self) -> Option<Locking> {
        match self {
            Self::Locking(locking) => Some(*locking),
            Self::Locked | Self::Unlocking(_) => None,
        }
    }

    /// The joint that may be unlocked.
    pub fn joint(&self) -> Option<i32> {
        match self {
            Self::Locked => None,
            Self::Unlocking(joint) => Some(*joint),
            Self::Locking(locking) => Some(locking.joint),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_counts_from_the_period_after_the_question() {
        let mut indexer = Indexer::Locked;
        assert!(indexer.joint().is_none() && !indexer.unlock(3));
        assert!(indexer.joint() == Some(3) && indexer.unlock(3));
        indexer.lock(3);
        let behind_a_move = Locking {
            joint: 3,
            ends_move: true,
        };
        assert!(indexer.joint() == Some(3) && indexer.locking() == Some(behind_a_move));
        assert!(!indexer.unlock(3) && indexer.locking() == Some(behind_a_move));
        indexer.has_locked();
        assert!(indexer.joint().is_none() && indexer.locking().is_none() && !indexer.unlock(3));
    }

    #[test]
    fn what_is_open_is_locked_where_its_move_is_given_up() {
        let mut indexer = Indexer::Locked;
        indexer.give_up();
        assert_eq!(indexer, Indexer::Locked);
        let given_up = Some(Locking {
            joint: 2,
            ends_move: false,
        });
        indexer.unlock(2);
        indexer.give_up();
        assert_eq!(indexer.locking(), given_up);
        indexer.lock(2);
        indexer.give_up();
        assert_eq!(indexer.locking(), given_up);
    }
}
