//! How even the speed is in cutting: the time near the programmed feed, and the stretches below it.

use super::cause::Cause;
use super::dip::Dip;
use super::places::Pace;
use std::collections::BTreeMap;

/// From this share of the feed on the speed counts as even.
const NEAR: f64 = 0.95;

/// Feeds are told apart by so many digits, so that the feeds of G93 and G95 stay few.
const DIGITS: i32 = 3;

/// Stretches that are kept.
const MOST_STRETCHES: usize = 20;

/// Time of cutting.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CuttingTime {
    /// s.
    pub all: f64,
    /// Within 5 % of the feed, s.
    pub near: f64,
}

impl CuttingTime {
    fn add(&mut self, duration: f64, near: bool) {
        self.all += duration;
        if near {
            self.near += duration;
        }
    }
}

/// Lines in succession that are run below the feed, around one place where that is slowest.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Where it is slowest.
    pub line: i32,
    /// Whether that is a line of the program, not of a file of subroutines.
    pub of_program: bool,
    /// First line.
    pub first_line: i32,
    /// Last line.
    pub last_line: i32,
    /// When it is slowest, s.
    pub time: f64,
    /// How long it takes, s.
    pub duration: f64,
    /// Speed over feed where it is slowest.
    pub least_share: f64,
    /// What keeps the machine below the feed for most of it.
    pub cause: Cause,
}

/// A stretch under way.
#[derive(Clone, Debug)]
struct Begun {
    stretch: Stretch,
    dip: Dip,
    /// s.
    by_cause: [f64; Cause::COUNT],
}

/// Takes in the cycles of cutting.
#[derive(Clone, Debug, Default)]
pub struct Evenness {
    total: CuttingTime,
    /// By feed, machine units a minute, as a number of its last digit and that digit's power of ten.
    feeds: BTreeMap<(i32, i64), CuttingTime>,
    stretch: Option<Begun>,
    /// The longest first.
    found: Vec<Stretch>,
}

impl Evenness {
    /// The next cycle; `feed` is that of a cutting move, machine units a minute, and `None` else.
    pub fn note(&mut self, pace: &Pace, feed: Option<f64>) {
        let Some(feed) = feed.filter(|feed| *feed > 0.0) else {
            self.close();
            return;
        };
        let near = pace.share_of_feed >= NEAR;
        self.total.add(pace.duration, near);
        let time = self.feeds.entry(rounded(feed)).or_default();
        time.add(pace.duration, near);
        if near {
            self.close();
        } else {
            self.extend(pace);
        }
    }

    fn extend(&mut self, pace: &Pace) {
        let begun = self.stretch.as_ref();
        if begun.is_some_and(|begun| begun.dip.is_passed(pace.share_of_feed)) {
            self.close();
        }
        let Begun {
            stretch,
            dip,
            by_cause,
        } = self.stretch.get_or_insert(Begun {
            stretch: Stretch {
                line: pace.line,
                of_program: pace.of_program,
                first_line: pace.line,
                last_line: pace.line,
                time: pace.time,
                duration: 0.0,
                least_share: f64::INFINITY,
                cause: pace.cause,
            },
            dip: Dip::BEGUN,
            by_cause: [0.0; Cause::COUNT],
        });
        stretch.duration += pace.duration;
        stretch.last_line = pace.line;
        by_cause[pace.cause.index()] += pace.duration;
        if dip.note(pace.share_of_feed) {
            stretch.least_share = pace.share_of_feed;
            stretch.line = pace.line;
            stretch.of_program = pace.of_program;
            stretch.time = pace.time;
        }
    }

    fn close(&mut self) {
        let Some(begun) = self.stretch.take() else {
            return;
        };
        let Begun {
            mut stretch,
            by_cause,
            ..
        } = begun;
        let causes = by_cause.iter().enumerate();
        let most = causes.max_by(|a, b| a.1.total_cmp(b.1));
        stretch.cause = most.map_or(stretch.cause, |(index, _)| Cause::at(index));
        let longer = |other: &Stretch| other.duration >= stretch.duration;
        let at = self.found.partition_point(longer);
        if at < MOST_STRETCHES {
            self.found.insert(at, stretch);
            self.found.truncate(MOST_STRETCHES);
        }
    }

    /// No more cycles come.
    pub fn finish(mut self) -> Found {
        self.close();
        let feed = |(power, digits): (i32, i64)| digits as f64 * 10_f64.powi(power);
        let feeds = self.feeds.into_iter();
        let mut by_feed: Vec<_> = feeds.map(|(key, time)| (feed(key), time)).collect();
        by_feed.sort_by(|a, b| b.1.all.total_cmp(&a.1.all));
        Found {
            total: self.total,
            by_feed,
            stretches: self.found,
        }
    }
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// All of cutting.
    pub total: CuttingTime,
    /// By feed, machine units a minute; the one that takes most time first.
    pub by_feed: Vec<(f64, CuttingTime)>,
    /// The longest first.
    pub stretches: Vec<Stretch>,
}

/// A feed with few digits: the power of ten of the last of them, and how many of these it has.
fn rounded(feed: f64) -> (i32, i64) {
    let power = feed.log10().floor() as i32 + 1 - DIGITS;
    (power, (feed / 10_f64.powi(power)).round() as i64)
}

#[cfg(test)]
mod tests {
    use super::super::cause::Phase;
    use super::*;

    /// A period, its speed over the feed, and its line.
    fn at(period: i32, share_of_feed: f64, line: i32) -> Pace {
        Pace {
            time: f64::from(period) * 0.001,
            duration: 0.001,
            share_of_feed,
            speed: 10.0 * share_of_feed,
            turns: false,
            line,
            of_program: true,
            position: [0.0; 9],
            phase: Phase::Turning,
            cause: Cause::Between,
        }
    }

    #[test]
    fn time_near_the_feed_and_what_is_below() {
        let mut evenness = Evenness::default();
        for k in 0..1000 {
            let share = match k {
                300..350 => 0.5,
                700..800 => 0.94,
                _ => 0.96,
            };
            let pace = Pace {
                cause: if k < 500 { Cause::Between } else { Cause::Feed },
                ..at(k, share, 1 + k / 100)
            };
            // 100 cycles of a rapid at the end, and two feeds before it.
            let feed = if k < 400 { 1500.04 } else { 600.0 };
            evenness.note(&pace, (k < 900).then_some(feed));
        }
        let found = evenness.finish();
        assert!((found.total.all - 0.9).abs() < 1e-9);
        assert!((found.total.near - 0.75).abs() < 1e-9);
        let feeds: Vec<f64> = found.by_feed.iter().map(|(feed, _)| *feed).collect();
        assert_eq!(feeds, [600.0, 1500.0]);
        assert!((found.by_feed[0].1.near - 0.4).abs() < 1e-9);
        let [long, short] = found.stretches[..] else {
            panic!("{found:?}");
        };
        assert_eq!((long.first_line, long.last_line), (8, 8));
        assert_eq!((long.cause, short.cause), (Cause::Feed, Cause::Between));
        assert_eq!((short.line, short.least_share), (4, 0.5));
        assert!((short.duration - 0.05).abs() < 1e-9);
    }

    #[test]
    fn dense_code_is_a_stretch_for_each_slow_place() {
        let mut evenness = Evenness::default();
        for k in 0..300 {
            // slowest at 50, 150 and 250, and never near the feed
            let from_slowest = f64::from(k % 100 - 50).abs() / 50.0;
            let share = 0.3 + 0.3 * from_slowest;
            evenness.note(&at(k, share, 1 + k / 10), Some(600.0));
        }
        let mut lines: Vec<i32> = evenness
            .finish()
            .stretches
            .iter()
            .map(|found| found.line)
            .collect();
        lines.sort_unstable();
        assert_eq!(lines, [6, 16, 26]);
    }
}
