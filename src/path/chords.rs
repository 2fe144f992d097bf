//! Small arcs are run as their chords.
//!
//! An arc that is small for its tolerance and limits the speed is a corner that its program has rounded, and the blended path rounds
//! it better: chords use the tolerance on both sides and are [moved](super::fairing) as those of any curve are. As an arc it has two
//! jumps of its curvature, and the [easements](super::easement) of those use little of the tolerance.
//!
//! That pays where jerk limits the speed. What acceleration limits takes as long on an arc, or less, unless the arc is no more than a
//! few tolerances.
//!
//! The chords leave the arc by a small part of the tolerance, which is taken off theirs.

use super::leg::Leg;
use super::settings::{Allowance, BlendSettings};
use crate::moves::shape::{Arc9, Line9, Shape};

/// The radius of a small arc, tolerances: a larger one is run as it is, which takes as long.
const SMALL: f64 = 20.0;

/// And of one that is run as its chords whatever limits its speed.
const TINY: f64 = 4.5;

/// How many times the third derivative that jerk allows at its speed an arc has whose chords take no longer than itself.
const HELD_UP: f64 = 5.7;

/// That speed is the feed, but no more than the square root of so many times acceleration and radius.
const OF_RADIUS: f64 = 8.0;

/// The share of its way that an arc at least makes around its axis: chords of a steep helix take longer than itself.
const FLAT: f64 = 0.9;

/// The most chords of an arc: one that needs more is run as it is.
pub(super) const MOST_CHORDS: usize = 10;

/// How far an arc is left by its chords at most, share of the tolerance.
const SAGITTA: f64 = 0.06;

/// Radians that a chord stands for at most.
const LONGEST: f64 = 1.0;

/// An arc, divided into chords.
pub(super) struct Chords<'a> {
    leg: &'a Leg,
    arc: &'a Arc9,
    count: usize,
    /// How far the chords go together, path distance.
    length: f64,
    allowance: Allowance,
}

impl<'a> Chords<'a> {
    /// Those of a leg that is a small arc; `None` if it is none, or is run as it is.
    pub fn of(leg: &'a Leg, settings: &BlendSettings) -> Option<Self> {
        let (Shape::Arc(arc), Allowance::Tolerance(tolerance)) = (&leg.shape, leg.allowance) else {
            return None;
        };
        let limits = leg.turning * leg.turning > settings.even_third(leg.speed);
        if !leg.is_free() || !limits {
            return None;
        }
        let radius = arc.point(0.0).second.norm() / (leg.turning * leg.turning);
        let is_flat = radius * leg.turning >= FLAT;
        let is_tiny = radius <= TINY * tolerance;
        let gains = is_tiny || jerk_holds_up(arc, leg, settings);
        if !is_flat || radius > SMALL * tolerance || !gains {
            return None;
        }
        let by_tolerance = (sagitta(arc, leg.length) / (SAGITTA * tolerance)).sqrt();
        let count = by_tolerance.max(arc.angle() / LONGEST).ceil();
        if !(count >= 1.0 && count <= MOST_CHORDS as f64) {
            return None;
        }
        let chords = Self {
            leg,
            arc,
            count: count as usize,
            length: 0.0,
            allowance: Allowance::Tolerance(tolerance - sagitta(arc, leg.length / count)),
        };
        let mut length = 0.0;
        for number in 0..chords.count {
            length += chords.line(number)?.length();
        }
        Some(Self { length, ..chords })
    }

    /// The chords as legs, in order.
    pub fn legs(&self) -> impl Iterator<Item = Leg> + '_ {
        (0..self.count).scan(0.0, |before, number| {
            let line = self.line(number)?;
            let behind = *before + line.length();
            let chord = self.leg_of(number, line, *before, self.length - behind);
            *before = behind;
            Some(chord)
        })
    }

    /// One of them, with what lies of its move before and behind it, path distance.
    fn leg_of(&self, number: usize, line: Line9, before: f64, after: f64) -> Leg {
        let length = line.length();
        let is_last = number + 1 == self.count;
        Leg {
            shape: Shape::Line(line),
            length,
            whole: length,
            before,
            after: if is_last { 0.0 } else { after },
            turning: 0.0,
            allowance: self.allowance,
            stop_before: self.leg.stop_before && number == 0,
            stop_after: self.leg.stop_after && is_last,
            ..*self.leg
        }
    }

    fn line(&self, number: usize) -> Option<Line9> {
        let place = |number: usize| number as f64 / self.count as f64 * self.arc.length();
        let end = if number + 1 == self.count {
            self.arc.end()
        } else {
            self.arc.position(place(number + 1))
        };
        Line9::new(&self.arc.position(place(number)), &end).ok()
    }
}

/// Whether it is jerk that an arc is slow for, and not its acceleration: its easements are too narrow then, and there is something
/// to be gained.
fn jerk_holds_up(arc: &Arc9, leg: &Leg, settings: &BlendSettings) -> bool {
    let start = arc.point(0.0);
    let across = start.second / start.second.norm();
    let shares = start
        .first
        .zip_map(&across, |along, across| along.hypot(across));
    let acceleration = settings.acceleration_of(&shares);
    let per_square = (leg.speed * leg.speed).recip() + leg.turning / (OF_RADIUS * acceleration);
    let speed = per_square.sqrt().recip();
    let even = settings.jerk_of(&shares, leg.speed) * per_square / speed;
    leg.turning * leg.turning > HELD_UP * even
}

/// How far an arc is from any chord of this length at most.
pub(super) fn sagitta(arc: &Arc9, length: f64) -> f64 {
    let bend = |s: f64| arc.point(s).second.norm();
    0.125 * length * length * bend(0.0).max(bend(arc.length()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::moves::shape::Circle;
    use crate::moves::{NearLimit, TerminationCondition};
    use crate::path::ProgrammedMove;
    use crate::path::metric::Metric;

    const TOLERANCE: f64 = 0.05;

    fn at(x: f64, y: f64, z: f64) -> Axes {
        Axes::from([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// 1000 mm/s2 and 20000 mm/s3.
    fn settings() -> BlendSettings {
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound")
    }

    /// An arc that turns by `angle`, radians, and is this high, from one radius to the other, at F6000.
    fn arc_in_space(radii: [f64; 2], angle: f64, height: f64) -> ProgrammedMove {
        let circle = Circle {
            center: at(0.0, 0.0, 0.0).fixed_rows::<3>(0).into(),
            normal: [0.0, 0.0, 1.0].into(),
            revolutions: 0,
        };
        let [start, end] = [
            at(radii[0], 0.0, 0.0),
            at(radii[1] * angle.cos(), radii[1] * angle.sin(), height),
        ];
        ProgrammedMove {
            serial: 1,
            shape: Shape::Arc(Arc9::new(&start, &end, &circle).expect("an arc")),
            feed: 100.0,
            feed_word: None,
            greatest_feed: 100.0,
            termination: TerminationCondition::Continuous {
                tolerance: TOLERANCE,
            },
            stop_before: true,
            separate: false,
            may_swing_out: true,
            near_limit: NearLimit::NONE,
        }
    }

    /// A right angle, by `growth` wider at its end.
    fn arc(radius: f64, growth: f64) -> ProgrammedMove {
        arc_in_space([radius, radius + growth], FRAC_PI_2, 0.2 * radius)
    }

    fn chords(programmed: &ProgrammedMove) -> Vec<Leg> {
        let leg = Leg::new(programmed, &settings(), &Metric::new(0.1));
        Chords::of(&leg, &settings()).map_or(Vec::new(), |chords| chords.legs().collect())
    }

    #[test]
    fn chords_are_within_the_tolerance_and_know_where_they_lie() {
        for (radius, growth) in [(0.05, 0.0), (0.5, 0.0), (0.5, 0.01)] {
            let programmed = arc(radius, growth);
            let chords = chords(&programmed);
            assert!((2..=MOST_CHORDS).contains(&chords.len()), "R {radius}");
            let whole: f64 = chords.iter().map(|chord| chord.length).sum();
            let mut before = 0.0;
            let mut end = programmed.shape.position(0.0);
            for (number, chord) in chords.iter().enumerate() {
                assert!((chord.before - before).abs() < 1e-12 && chord.whole == chord.length);
                assert!((chord.after - (whole - before - chord.length)).abs() < 1e-12);
                assert_eq!(chord.shape.position(0.0), end);
                assert_eq!(chord.stop_before, number == 0);
                // The arc at equal shares of both is no nearer to the chord than its nearest place.
                let left = (1..100).map(|k| {
                    let share = (number as f64 + f64::from(k) / 100.0) / chords.len() as f64;
                    let on_arc = programmed.shape.position(share * programmed.shape.length());
                    (on_arc - chord.shape.position(chord.length * f64::from(k) / 100.0)).norm()
                });
                let left = left.fold(0.0, f64::max);
                assert!(
                    left > 0.0 && left <= TOLERANCE - chord.tolerance() + 1e-3 * radius,
                    "{left}"
                );
                assert!(chord.tolerance() >= (1.0 - SAGITTA) * TOLERANCE);
                before += chord.length;
                end = chord.shape.end();
            }
            assert_eq!(end, programmed.shape.end());
            assert_eq!(chords.last().expect("chords").after, 0.0);
        }
    }

    #[test]
    fn other_arcs_are_run_as_they_are() {
        assert!(!chords(&arc(0.5, 0.0)).is_empty());
        let refused = [
            // Not small for its tolerance, so many chords would be needed, a steep helix.
            arc_in_space([1.1, 1.1], 1.0, 0.0),
            arc(0.99, 0.0),
            arc_in_space([0.5, 0.5], FRAC_PI_2, 0.5),
            ProgrammedMove {
                termination: TerminationCondition::Exact,
                ..arc(0.5, 0.0)
            },
            // A thread, and beside a soft limit.
            ProgrammedMove {
                may_swing_out: false,
                ..arc(0.5, 0.0)
            },
            ProgrammedMove {
                near_limit: NearLimit {
                    end: true,
                    ..NearLimit::NONE
                },
                ..arc(0.5, 0.0)
            },
            // It does not limit the speed.
            ProgrammedMove {
                feed: 10.0,
                ..arc(0.5, 0.0)
            },
        ];
        for (number, programmed) in refused.iter().enumerate() {
            assert!(chords(programmed).is_empty(), "{number}");
        }
    }
}
