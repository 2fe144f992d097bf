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
        }
    }
}
