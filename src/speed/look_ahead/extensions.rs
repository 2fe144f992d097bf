//! When the plan is to be extended, how far, and from where on.

use super::candidate_plan::{MOST_INTERVALS, MOST_URGENT_INTERVALS};

/// Seconds behind the frozen part at which a candidate leaves the plan: more after each one that the
/// machine has overtaken.
const SHORTEST_LEAD: f64 = 16e-3;
/// See [`SHORTEST_LEAD`].
const LONGEST_LEAD: f64 = 128e-3;

/// Intervals that an extension is meant to add.
const EXTENSION: f64 = 90.0;

/// Lengths with which an extension is tried in turn: whole, a half, a third, and then half as much in each further round, since what
/// follows may be finer than anything before. What is refused once is refused again
/// from there. In programs that run undisturbed a shorter one hardly ever helps; where an operator raises an override
/// it does: arcspiral takes 2 to 13 % longer without.
const EXTENSION_LENGTHS: u32 = 3;

/// Intervals by which an extension leaves the plan earlier than it wants to, behind one that was refused; twice as many
/// behind each more. A plan that comes to its end as fast as it may is at times too fast for whatever goes on behind
/// that: there no length helps.
const EARLIER: usize = 8;
/// It was doubled, or the length halved, so often at most: that is all of a plan.
const MOST_DOUBLINGS: u32 = 8;

/// An extension by fewer intervals than this waits for more, but no longer than [`PATIENCE`].
const WORTHWHILE: f64 = 8.0;
/// Slices.
const PATIENCE: u32 = 8;

/// The attempts at extensions of a plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extensions {
    /// How often one was refused since one was adopted.
    failures: u32,
    /// Slices until the next one may be tried.
    pause: u32,
    /// Slices since the last one was begun.
    waited: u32,
    /// The length of the intervals of the last candidate, in the mean.
    spacing: f64,
    lead: f64,
}

/// How far an extension is to lead.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExtensionReach {
    /// Where it is to come to rest, as s.
    pub end: f64,
    /// Intervals that it adds at most.
    pub intervals: usize,
}

impl Extensions {
    pub const NONE: Self = Self {
        failures: 0,
        pause: 0,
        waited: 0,
        spacing: 0.0,
        lead: SHORTEST_LEAD,
    };

    /// Seconds behind the frozen part at which a candidate leaves the plan at the earliest.
    pub fn lead(&self) -> f64 {
        self.lead
    }

    /// How many intervals earlier than it wants to a candidate leaves the plan.
    pub fn earlier(&self) -> usize {
        match self.failures.checked_sub(1) {
            Some(more) => EARLIER << more.min(MOST_DOUBLINGS),
            None => 0,
        }
    }

    /// A slice begins.
    pub fn pass_slice(&mut self) {
        self.pause = self.pause.saturating_sub(1);
        self.waited = self.waited.saturating_add(1);
    }

    /// Whether one that gains this length of the path is to be made now; `complete`: whether it is all that
    /// will become known.
    pub fn is_wanted(&self, gain: f64, complete: bool) -> bool {
        let enough = complete || gain >= WORTHWHILE * self.spacing || self.waited >= PATIENCE;
        gain > 0.0 && enough && self.pause == 0
    }

    /// Begins one of a plan that ends at `plan_end`. The less time there is, the shorter: what is short is
    /// found soon.
    pub fn begin(&mut self, plan_end: f64, known_end: f64, urgent: bool) -> ExtensionReach {
        self.waited = 0;
        let (hurry, intervals) = if urgent {
            (0.5, MOST_URGENT_INTERVALS)
        } else {
            (1.0, MOST_INTERVALS)
        };
        let length = EXTENSION / f64::from(1 + self.failures % EXTENSION_LENGTHS);
        let rounds = (self.failures / EXTENSION_LENGTHS).min(MOST_DOUBLINGS);
        let step = hurry * length * self.spacing / f64::from(1 << rounds);
        let end = if known_end - plan_end > 1.5 * step {
            plan_end + step
        } else {
            known_end
        };
        ExtensionReach { end, intervals }
    }

    /// The machine has overtaken a candidate.
    pub fn note_overtaken(&mut self) {
        self.lead = (2.0 * self.lead).min(LONGEST_LEAD);
    }

    pub fn note_refusal(&mut self) {
        self.failures = self.failures.saturating_add(1);
        self.pause = PATIENCE;
    }

    /// There is a plan whose new intervals have this length in the mean.
    pub fn note_adopted(&mut self, spacing: f64) {
        self.spacing = spacing;
        self.failures = 0;
        self.lead = SHORTEST_LEAD;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: f64 = 0.5;

    fn adopted() -> Extensions {
        let mut extensions = Extensions::NONE;
        extensions.note_adopted(SPACING);
        extensions
    }

    #[test]
    fn what_is_refused_is_tried_shorter_and_then_from_half_the_length_on() {
        let mut extensions = adopted();
        for parts in [1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 4.0] {
            let reach = extensions.begin(0.0, 1e3, false);
            assert!((reach.end * parts / (EXTENSION * SPACING) - 1.0).abs() < 1e-12);
            assert_eq!(reach.intervals, MOST_INTERVALS);
            extensions.note_refusal();
        }
        let mut extensions = adopted();
        let reach = extensions.begin(0.0, 1e3, true);
        assert_eq!(reach.end, 0.5 * EXTENSION * SPACING);
        assert_eq!(reach.intervals, MOST_URGENT_INTERVALS);
        // What would be left is taken along.
        assert_eq!(extensions.begin(0.0, 40.0, false).end, 40.0);
    }

    #[test]
    fn little_gain_waits_and_so_does_what_was_refused() {
        let mut extensions = adopted();
        let little = 0.9 * WORTHWHILE * SPACING;
        extensions.begin(0.0, 1e3, false);
        assert!(!extensions.is_wanted(little, false) && !extensions.is_wanted(0.0, true));
        assert!(extensions.is_wanted(little, true));
        assert!(extensions.is_wanted(WORTHWHILE * SPACING, false));
        extensions.note_refusal();
        for _ in 0..PATIENCE {
            assert!(!extensions.is_wanted(1e3, true) && !extensions.is_wanted(little, false));
            extensions.pass_slice();
        }
        assert!(extensions.is_wanted(1e3, true) && extensions.is_wanted(little, false));
    }

    #[test]
    fn what_was_refused_leaves_the_plan_earlier() {
        let mut extensions = adopted();
        for earlier in [0, 1, 2, 4] {
            assert_eq!(extensions.earlier(), earlier * EARLIER);
            extensions.note_refusal();
        }
        (0..100).for_each(|_| extensions.note_refusal());
        assert_eq!(extensions.earlier(), EARLIER << MOST_DOUBLINGS);
        extensions.note_adopted(SPACING);
        assert_eq!(extensions.earlier(), 0);
    }

    #[test]
    fn the_lead_grows_until_one_is_adopted() {
        let mut extensions = adopted();
        for times in [1.0, 2.0, 4.0, 8.0, 8.0] {
            assert_eq!(extensions.lead(), times * SHORTEST_LEAD);
            extensions.note_overtaken();
        }
        extensions.note_adopted(SPACING);
        assert_eq!(extensions.lead(), SHORTEST_LEAD);
    }
}
