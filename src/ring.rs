//! A ring: the last things of a sequence that is numbered without end.

/// The last `N` things of a sequence, each in the slot that its number leads to; `N` is a power of two.
///
/// Whoever has a ring knows which numbers are in it: any number leads to a slot, so that nothing here can be out
/// of bounds, and a thing takes the place of the one that came `N` before it.
#[derive(Clone, Debug)]
pub struct Ring<T, const N: usize> {
    slots: [T; N],
}

impl<T, const N: usize> Ring<T, N> {
    /// What is left of a number when whole rounds are taken away.
    const MASK: u64 = {
        assert!(N.is_power_of_two(), "a masked number is in range");
        N as u64 - 1
    };

    /// All slots alike.
    pub const fn filled_with(thing: T) -> Self
    where
        T: Copy,
    {
        Self { slots: [thing; N] }
    }

    /// The thing with this number.
    #[inline(always)]
    pub const fn at(&self, number: u64) -> &T {
        &self.slots[(number & Self::MASK) as usize]
    }

    /// The same, to be changed.
    #[inline(always)]
    pub const fn at_mut(&mut self, number: u64) -> &mut T {
        &mut self.slots[(number & Self::MASK) as usize]
    }

    /// The things with `count` numbers from `first` on, in their order: up to where the slots end, and from where they begin.
    /// Quicker than one by one, since only the first number has to be led to its slot.
    #[inline(always)]
    pub fn row(&self, first: u64, count: u64) -> [&[T]; 2] {
        let (before, behind) = self.slots.split_at((first & Self::MASK) as usize);
        let count = count as usize;
        match behind.get(..count) {
            Some(row) => [row, &[]],
            None => [behind, before.get(..count - behind.len()).unwrap_or(before)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_leads_to_its_slot_until_a_round_later() {
        let mut ring = Ring::<u64, 8>::filled_with(0);
        let start = u64::MAX - 20;
        for number in (0..40).map(|k| start.wrapping_add(k)) {
            *ring.at_mut(number) = number;
            for back in 0..8 {
                let before = number.wrapping_sub(back);
                let known = before.wrapping_sub(start) < 40;
                assert!(!known || *ring.at(before) == before);
            }
            for count in 0..=8u64.min(number.wrapping_sub(start) + 1) {
                let first = number.wrapping_sub(count).wrapping_add(1);
                let row = ring.row(first, count).concat();
                let expected = (0..count).map(|k| first.wrapping_add(k));
                assert!(row.into_iter().eq(expected));
            }
        }
    }
}
