//! Bytes as choices.

/// What nobody should say.
const STRANGE: [f64; 18] = [
    0.0,
    -0.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    1e-300,
    -1e-9,
    1e-12,
    f64::EPSILON,
    1e9,
    1e15,
    1e154,
    1e300,
];

const STRANGE_INTEGERS: [i32; 8] = [-1, 0, 7, 64, 2001, i32::MAX, i32::MIN, i32::MIN + 1];

/// Out of 256 values, how many are strange in a case.
const HOSTILITY: [u8; 6] = [0, 0, 0, 2, 12, 60];

/// Reads choices from bytes; when they are used up, every choice is the first one.
pub struct Choices<'a> {
    bytes: &'a [u8],
    hostility: u8,
}

impl<'a> Choices<'a> {
    /// The first byte says how hostile the others are.
    pub fn new(bytes: &'a [u8]) -> Self {
        let mut choices = Self {
            bytes,
            hostility: 0,
        };
        choices.hostility = HOSTILITY[choices.below(HOSTILITY.len())];
        choices
    }

    /// Whether all values are such as a machine and its operator give them.
    pub fn is_plausible(&self) -> bool {
        self.hostility == 0
    }

    pub fn is_spent(&self) -> bool {
        self.bytes.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.bytes.split_first() else {
            return 0;
        };
        self.bytes = rest;
        *first
    }

    /// One of `count`, 256 at most.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn one_of<T: Copy, const N: usize>(&mut self, values: [T; N]) -> T {
        values[self.below(N)]
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// True once in `times`.
    pub fn rarely(&mut self, times: usize) -> bool {
        self.below(times) == times - 1
    }

    /// From 0 to 1.
    pub fn share(&mut self) -> f64 {
        let pair = [self.byte(), self.byte()];
        f64::from(u16::from_be_bytes(pair)) / f64::from(u16::MAX)
    }

    pub fn between(&mut self, least: f64, greatest: f64) -> f64 {
        let share = self.share();
        self.or_strange(least + share * (greatest - least))
    }

    /// All orders of magnitude alike.
    pub fn magnitude(&mut self, least: f64, greatest: f64) -> f64 {
        let share = self.share();
        self.or_strange(least * (greatest / least).powf(share))
    }

    /// A number, or one that nobody should say.
    pub fn or_strange(&mut self, plausible: f64) -> f64 {
        if !self.is_strange() {
            return plausible;
        }
        match self.below(STRANGE.len() + 2) {
            index if index < STRANGE.len() => STRANGE[index],
            _ => f64::from_bits(u64::from_be_bytes(std::array::from_fn(|_| self.byte()))),
        }
    }

    /// A whole number, or one that nobody should say.
    pub fn integer(&mut self, plausible: i32) -> i32 {
        if self.is_strange() {
            self.one_of(STRANGE_INTEGERS)
        } else {
            plausible
        }
    }

    /// Whether something nobody should do is done.
    pub fn is_strange(&mut self) -> bool {
        u8::MAX - self.byte() < self.hostility
    }
}
