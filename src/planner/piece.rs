//! The pieces of a reference that were handed out and are not yet behind the machine.

use crate::speed::JerkLimitedProfile;

/// A stretch of a move, run by one profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Serial number of the move.
    pub serial: u64,
    /// Where in the move the profile starts, in its measure.
    pub start: f64,
    pub profile: JerkLimitedProfile,
    /// How long the piece lasts: as long as its profile, less if another piece took over.
    pub duration: f64,
    /// The cap on the velocity that it was planned with.
    pub cap: f64,
}

impl Piece {
    const VACANT: Self = Self {
        serial: 0,
        start: 0.0,
        profile: JerkLimitedProfile::NONE,
        duration: 0.0,
        cap: 0.0,
    };
}

/// A power of two, so that a masked index is in range for the compiler too. Enough for 100 ms of
/// a servo period of 1 ms with two short moves in each.
const SLOTS: u32 = 256;

/// A ring of pieces in the order of the reference.
#[derive(Debug)]
pub(super) struct Pieces {
    slots: [Piece; SLOTS as usize],
    first: u32,
    count: u32,
}

const fn slot(number: u32) -> usize {
    (number & (SLOTS - 1)) as usize
}

impl Pieces {
    pub const fn new() -> Self {
        Self {
            slots: [Piece::VACANT; SLOTS as usize],
            first: 0,
            count: 0,
        }
    }

    pub fn clear(&mut self) {
        self.count = 0;
    }

    pub fn len(&self) -> u32 {
        self.count
    }

    pub fn is_full(&self) -> bool {
        self.count >= SLOTS
    }

    pub fn front(&self) -> Option<&Piece> {
        (self.count > 0).then(|| &self.slots[slot(self.first)])
    }

    pub fn back(&self) -> Option<&Piece> {
        (self.count > 0).then(|| &self.slots[slot(self.last())])
    }

    pub fn back_mut(&mut self) -> Option<&mut Piece> {
        (self.count > 0).then(|| &mut self.slots[slot(self.last())])
    }

    /// Appends a piece; does nothing if the ring is full.
    pub fn push(&mut self, piece: Piece) {
        if !self.is_full() {
            self.count += 1;
            self.slots[slot(self.last())] = piece;
        }
    }

    pub fn pop(&mut self) {
        if self.count > 0 {
            self.first = self.first.wrapping_add(1);
            self.count -= 1;
        }
    }

    /// Number of the last piece; only asked for if there is one.
    fn last(&self) -> u32 {
        self.first.wrapping_add(self.count).wrapping_sub(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_first_in_first_out_and_bounded() {
        let mut pieces = Pieces::new();
        assert!(pieces.front().is_none() && pieces.back().is_none());
        for serial in 0..u64::from(SLOTS) + 10 {
            pieces.push(Piece {
                serial,
                ..Piece::VACANT
            });
        }
        assert!(pieces.is_full());
        for serial in 0..u64::from(SLOTS) {
            assert_eq!(pieces.front().map(|piece| piece.serial), Some(serial));
            assert_eq!(
                pieces.back().map(|piece| piece.serial),
                Some(u64::from(SLOTS) - 1)
            );
            pieces.pop();
        }
        pieces.pop();
        assert_eq!(pieces.len(), 0);
    }
}
