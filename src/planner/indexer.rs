//! The lock of a rotary indexer: it is opened for a move, and closed behind it.

/// What the lock of an indexer was told last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Indexer {
    /// Nothing, or it has locked.
    Locked,
    /// To unlock for the next move, or it is unlocked while that runs.
    Unlocking,
    /// To lock this joint behind its move, which is over when that is done.
    Locking(i32),
}

impl Indexer {
    /// Tells the lock to open, where none is being closed. Whether it was told before, so that what it answers
    /// now is an answer to that.
    pub fn unlock(&mut self) -> bool {
        let told = *self == Self::Unlocking;
        if *self == Self::Locked {
            *self = Self::Unlocking;
        }
        told
    }

    /// Behind a move of this indexer.
    pub fn lock(&mut self, joint: i32) {
        *self = Self::Locking(joint);
    }

    /// It has locked, or what is with it is forgotten.
    pub fn reset(&mut self) {
        *self = Self::Locked;
    }

    /// The joint that is to lock.
    pub fn locking(&self) -> Option<i32> {
        match self {
            Self::Locking(joint) => Some(*joint),
            Self::Locked | Self::Unlocking => None,
        }
    }

    /// Whether a joint may be unlocked.
    pub fn is_open(&self) -> bool {
        *self != Self::Locked
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_counts_from_the_period_after_the_question() {
        let mut indexer = Indexer::Locked;
        assert!(!indexer.is_open() && !indexer.unlock());
        assert!(indexer.is_open() && indexer.unlock());
        indexer.lock(3);
        assert!(indexer.is_open() && indexer.locking() == Some(3));
        assert!(!indexer.unlock() && indexer.locking() == Some(3));
        indexer.reset();
        assert!(!indexer.is_open() && indexer.locking().is_none() && !indexer.unlock());
    }
}
