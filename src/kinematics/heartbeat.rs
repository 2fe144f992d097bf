//! Whether the guard lives: the user-space program that looks after frames where the kinematics cannot see.
//!
//! It changes a number again and again. Patience is counted in the time of the servo thread, so that a thread that is
//! late itself does not blame the guard: a machine without real-time rights that stood still for a second makes up for
//! it in a burst of a thousand periods, in which nobody else had a turn.

/// Without a beat for so long (s) the machine is held: what comes to rest now is at rest before the guard is given up.
pub const LATE: f64 = 1.0;

/// Without a beat for so long (s) the guard is given up: what does not obey a hold (M49, threads, jogs) ends then.
pub const LOST: f64 = 1.9;

/// What a servo thread may be late (s) and make up for, and it still counts.
const MOST_CREDIT: f64 = 0.05;

/// What is known of the guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// It has never been heard of.
    Never,
    /// It beats.
    Lives,
    /// It has not been heard of for [`LATE`].
    Late,
    /// It has not been heard of for [`LOST`].
    Lost,
}

/// Listens to the guard.
#[derive(Clone, Copy, Debug)]
pub struct Heartbeat {
    last: u32,
    /// s since the last beat
    silent: f64,
    heard: bool,
    /// the clock in the period before, ns
    clock: i64,
    /// s that the clock is ahead of the periods, at most [`MOST_CREDIT`]
    credit: f64,
}

impl Heartbeat {
    /// Nothing has been heard yet.
    pub const fn new() -> Self {
        Self {
            last: 0,
            silent: 0.0,
            heard: false,
            clock: 0,
            credit: 0.0,
        }
    }

    /// One servo period of `period` s, begun at `clock` ns of a clock that runs on, with this number on the pin, 0 if
    /// nobody has ever beaten.
    pub fn listen(&mut self, beat: u32, period: f64, clock: i64) {
        let real = clock.saturating_sub(self.clock).max(0) as f64 * 1e-9;
        self.clock = clock;
        self.credit = (self.credit + real).min(MOST_CREDIT.max(period));
        let counted = period.min(self.credit);
        self.credit -= counted;
        if beat == self.last {
            self.silent += counted;
        } else {
            self.last = beat;
            self.silent = 0.0;
            self.heard = true;
        }
    }

    /// What is known of the guard now.
    pub fn guard(&self) -> Guard {
        match self.silent {
            _ if !self.heard => Guard::Never,
            silent if silent < LATE => Guard::Lives,
            silent if silent < LOST => Guard::Late,
            _ => Guard::Lost,
        }
    }
}

impl Default for Heartbeat {
    fn default() -> Self {
        Self::new()
    }
}
