//! The places where most time is lost: stretches between two places where the machine is fast.

use super::cause::{Cause, Phase};
use super::dip::Dip;
use crate::path::Position;

/// Places that are kept.
pub const MOST_PLACES: usize = 20;

/// A cycle as far as places need it.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// End of the cycle, s.
    pub time: f64,
    /// Its duration, s.
    pub duration: f64,
    /// Speed over feed, 0 to 1.
    pub share_of_feed: f64,
    /// Machine units per second, degrees where it turns.
    pub speed: f64,
    /// Whether only rotary axes move.
    pub turns: bool,
    /// Line of the program.
    pub line: i32,
    /// Whether that is a line of the program, not of a file of subroutines.
    pub of_program: bool,
    /// Where the machine is.
    pub position: Position,
    /// What the machine does.
    pub phase: Phase,
    /// What keeps it from being faster.
    pub cause: Cause,
}

/// A place where the machine is slow.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Lines of the program, the slowest and the range.
    pub line: i32,
    /// Whether the slowest is a line of the program, not of a file of subroutines.
    pub of_program: bool,
    /// First line.
    pub first_line: i32,
    /// Last line.
    pub last_line: i32,
    /// When it is slowest, s.
    pub time: f64,
    /// How long it takes, s.
    pub duration: f64,
    /// Time that would be saved at feed, s.
    pub lost: f64,
    /// Speed over feed where it is slowest.
    pub least_share: f64,
    /// The least speed.
    pub least_speed: f64,
    /// Whether only rotary axes move there.
    pub turns: bool,
    /// Where it is slowest.
    pub position: Position,
    /// What the machine does most of the lost time.
    pub phase: Phase,
    /// What costs most of the lost time.
    pub cause: Cause,
}

/// A stretch under way.
#[derive(Clone, Debug)]
struct Stretch {
    place: Place,
    dip: Dip,
    lost_by_cause: [f64; Cause::COUNT],
    lost_by_phase: [f64; Phase::COUNT],
}

/// Finds the places.
#[derive(Clone, Debug, Default)]
pub struct Places {
    stretch: Option<Stretch>,
    /// The worst first.
    found: Vec<Place>,
}

impl Places {
    /// The next cycle.
    pub fn note(&mut self, pace: &Pace) {
        let share = pace.share_of_feed;
        let before = self.stretch.as_ref();
        if before.is_some_and(|stretch| stretch.dip.is_passed(share)) {
            self.close();
        }
        let stretch = self.stretch.get_or_insert(Stretch {
            place: Place {
                line: pace.line,
                of_program: pace.of_program,
                first_line: pace.line,
                last_line: pace.line,
                time: pace.time,
                duration: 0.0,
                lost: 0.0,
                least_share: f64::INFINITY,
                least_speed: 0.0,
                turns: pace.turns,
                position: pace.position,
                phase: pace.phase,
                cause: pace.cause,
            },
            dip: Dip::BEGUN,
            lost_by_cause: [0.0; Cause::COUNT],
            lost_by_phase: [0.0; Phase::COUNT],
        });
        // At feed nothing is lost, and no place begins: the little that a long move is below it would count for more than the
        // start that is looked for.
        let lost = match pace.phase {
            Phase::AtFeed => 0.0,
            _ => pace.duration * (1.0 - share),
        };
        let place = &mut stretch.place;
        if lost > 0.0 {
            if place.lost == 0.0 {
                place.first_line = pace.line;
            }
            place.last_line = pace.line;
            place.duration += pace.duration;
        }
        place.lost += lost;
        stretch.lost_by_cause[pace.cause.index()] += lost;
        stretch.lost_by_phase[pace.phase as usize] += lost;
        if stretch.dip.note(share) {
            place.least_share = share;
            place.least_speed = pace.speed;
            place.turns = pace.turns;
            place.line = pace.line;
            place.of_program = pace.of_program;
            place.time = pace.time;
            place.position = pace.position;
        }
    }

    /// The worst places, the worst first.
    pub fn finish(mut self) -> Vec<Place> {
        self.close();
        self.found
    }

    fn close(&mut self) {
        let Some(mut stretch) = self.stretch.take() else {
            return;
        };
        let greatest = |values: &[f64]| {
            let pairs = values.iter().enumerate();
            pairs
                .max_by(|a, b| a.1.total_cmp(b.1))
                .map_or(0, |(i, _)| i)
        };
        stretch.place.cause = Cause::at(greatest(&stretch.lost_by_cause));
        stretch.place.phase = Phase::ALL[greatest(&stretch.lost_by_phase)];
        let place = stretch.place;
        if place.lost <= 0.0 {
            return;
        }
        let at = self.found.partition_point(|other| other.lost >= place.lost);
        if at < MOST_PLACES {
            self.found.insert(at, place);
            self.found.truncate(MOST_PLACES);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_corners_are_two_places() {
        let mut places = Places::default();
        for k in 0..1000 {
            // Slow at 300 and slower, for longer, at 700.
            let near = |at: i32, width: f64| (f64::from(k - at).abs() / width).min(1.0);
            let share = (0.4 + 0.6 * near(300, 50.0)).min(0.1 + 0.9 * near(700, 100.0));
            places.note(&Pace {
                time: f64::from(k) * 0.001,
                duration: 0.001,
                share_of_feed: share,
                speed: 100.0 * share,
                turns: false,
                line: 1 + k / 100,
                of_program: true,
                position: [0.0; 9],
                phase: if share < 0.995 {
                    Phase::Turning
                } else {
                    Phase::AtFeed
                },
                cause: if share < 0.995 {
                    Cause::Between
                } else {
                    Cause::Feed
                },
            });
        }
        let found = places.finish();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].line, found[1].line), (8, 4));
        assert!((found[0].lost - 0.09).abs() < 0.005, "{found:?}");
        assert!((found[0].time - 0.7).abs() < 1e-9);
        assert_eq!((found[0].first_line, found[0].last_line), (7, 8));
    }

    /// A start of 0.05 s, then a minute a little below the feed.
    #[test]
    fn a_long_move_at_feed_is_not_what_a_start_costs() {
        let mut places = Places::default();
        for k in 0..60_000 {
            let share = (f64::from(k) / 50.0).min(0.998);
            let starts = k < 50;
            places.note(&Pace {
                time: f64::from(k) * 0.001,
                duration: 0.001,
                share_of_feed: share,
                speed: 6.0 * share,
                turns: true,
                line: 2,
                of_program: true,
                position: [0.0; 9],
                phase: if starts {
                    Phase::ChangingSpeed
                } else {
                    Phase::AtFeed
                },
                cause: if starts { Cause::Between } else { Cause::Feed },
            });
        }
        let found = places.finish();
        assert_eq!(found.len(), 1);
        assert_eq!(
            (found[0].phase, found[0].cause),
            (Phase::ChangingSpeed, Cause::Between)
        );
        assert!(
            (found[0].lost - 0.0255).abs() < 1e-9 && found[0].turns,
            "{found:?}"
        );
    }
}
