//! Where one slow place ends and the next one begins.

/// Speed over feed has to rise and fall by this factor between two places.
const HYSTERESIS: f64 = 1.3;

/// Below this share of the feed all is slow.
const SLOW: f64 = 0.02;

/// Speed over feed since a slow place began.
#[derive(Clone, Copy, Debug)]
pub struct Dip {
    /// The least, infinite before the first.
    least: f64,
    /// The greatest behind the least.
    greatest: f64,
}

impl Dip {
    /// Nothing is known yet.
    pub const BEGUN: Dip = Dip {
        least: f64::INFINITY,
        greatest: 0.0,
    };

    /// Whether a speed, over the feed, belongs to the next place: it rose behind the least one, and has fallen again.
    pub fn is_passed(&self, share: f64) -> bool {
        let differ = |fast: f64, slow: f64| fast + SLOW > HYSTERESIS * (slow + SLOW);
        differ(self.greatest, self.least) && differ(self.greatest, share)
    }

    /// Notes the next speed, and says whether it is the least so far.
    pub fn note(&mut self, share: f64) -> bool {
        let least = share < self.least;
        if least {
            // only what comes behind the slowest cycle ends the place
            *self = Dip {
                least: share,
                greatest: share,
            };
        }
        self.greatest = self.greatest.max(share);
        least
    }
}
