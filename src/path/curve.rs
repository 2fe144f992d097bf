//! How wide kernels have to be on a curve made of short lines: its turning limits the speed, whatever the
//! program asks for.
//!
//! Wider ones gain nothing there, and cost: what does not fit is narrowed step by step, and where that takes
//! too long the vertices are hardened. Without this such curves took up to twice as long at a greater feed.

use super::chain::{Chain, NEIGHBOURS};
use super::leg::Leg;
use super::metric::Metric;
use super::settings::BlendSettings;
use crate::moves::shape::Shape;

/// Of the speed that a curve allows, what kernels are wide enough for: its turning is not known exactly, and
/// where it ends the machine is faster.
const RESERVE: f64 = 2.5;

/// On a curve the turns of the direction add up to at least this share of their sizes: more of them lead back
/// where coordinates are rounded.
const EVEN: f64 = 0.7;

/// And none is more than this share of them all: a corner is no curve.
const GREATEST_SHARE: f64 = 0.6;

/// Radians of a curve that are looked at, at most.
const GREATEST_TURN: f64 = 1.0;

/// A leg that is about to come at the end of the chain, with the design width for the speed at which the curve can
/// be run that it ends, if it ends one and that is less.
pub(super) fn with_its_width(
    leg: Leg,
    chain: &Chain,
    settings: &BlendSettings,
    metric: &Metric,
) -> Leg {
    let mut leg = Leg {
        start: chain.end(),
        ..leg
    };
    if let Some(width) = design_width(chain, &leg, settings, metric) {
        leg.design_width = leg.design_width.min(width);
        leg.ends_curve = true;
    }
    leg
}

/// The design width for the curve that ends with `leg`, machine units; `None` where it ends none.
///
/// Looks back over as much as it is wide, no farther than kernels reach.
fn design_width(
    chain: &Chain,
    leg: &Leg,
    settings: &BlendSettings,
    metric: &Metric,
) -> Option<f64> {
    if !is_line(leg) {
        return None;
    }
    let direction = leg.direction_at_start();
    let middle = leg.start + 0.5 * leg.length;
    let (mut later, mut sum, mut greatest) = (direction, 0.0, 0.0f64);
    let mut found: Option<f64> = None;
    for number in (chain.first()..chain.next())
        .rev()
        .take(NEIGHBOURS as usize)
    {
        let before = chain.leg(number);
        if !is_line(before) {
            break;
        }
        let earlier = before.direction_at_start();
        let turn = metric.norm(&(later - earlier));
        sum += turn;
        greatest = greatest.max(turn);
        later = earlier;
        let whole = direction - earlier;
        let size = metric.norm(&whole);
        let length = middle - before.start - 0.5 * before.length;
        // A single turn says nothing.
        if number + 1 < chain.next() {
            if size < EVEN * sum || greatest > GREATEST_SHARE * size {
                return None;
            }
            let speed = RESERVE * settings.curve_speed(&whole, size, length);
            let width = settings.design_width(speed);
            found = Some(width);
            if length > leg.design_width.min(width) && number + 2 < chain.next() {
                break;
            }
        }
        if size > GREATEST_TURN || chain.vertex(number).wall {
            break;
        }
    }
    found
}

/// Pieces of an arc that vertices are moved on turn as little as chords do.
fn is_line(leg: &Leg) -> bool {
    matches!(leg.shape, Shape::Line(_)) || leg.length < leg.whole
}

#[cfg(test)]
mod tests {
    use super::super::hardening::tests::lines;
    use super::*;
    use crate::axes::{Axes, AxisLimits};
    use crate::test_room::with_room;

    /// The design width of the last of 60 legs of .02 mm with these directions, radians, at 50 mm/s, and with which
    /// settings.
    fn last_width(angle: fn(usize) -> f64) -> (f64, BlendSettings) {
        const LENGTH: f64 = 0.02;
        let limits = AxisLimits {
            velocity: Axes::repeat(100.0),
            acceleration: Axes::repeat(1000.0),
            jerk: Axes::repeat(20_000.0),
        };
        let settings = BlendSettings::new(1.0, 0.1, 0.02, &limits).expect("sound");
        let width = with_room(move || {
            let [mut before, mut whole] = [Chain::new(), Chain::new()];
            let legs: Vec<_> = (0..60)
                .map(angle)
                .map(|angle| ([LENGTH * angle.cos(), LENGTH * angle.sin(), 0.0], 0.05))
                .collect();
            lines(&legs[..59], &settings, &mut before);
            lines(&legs, &settings, &mut whole);
            let last = *whole.last().expect("a leg");
            let metric = Metric::new(settings.rotary_weight());
            with_its_width(last, &before, &settings, &metric).design_width
        });
        (width, settings)
    }

    #[test]
    fn a_curve_of_chords_wants_what_its_turning_allows() {
        // A circle with a radius of .2 mm: jerk allows 9.28 mm/s.
        let (width, settings) = last_width(|leg| 0.1 * leg as f64);
        let expected = settings.design_width(RESERVE * (20_000.0 * 0.04f64).cbrt());
        assert!(
            (0.95..1.2).contains(&(width / expected)),
            "{width} {expected}"
        );
    }

    #[test]
    fn a_corner_or_rounded_coordinates_are_no_curve() {
        let corner = |leg: usize| if leg < 55 { 0.0 } else { 1.5 };
        let rounded = |leg: usize| if leg.is_multiple_of(2) { 0.05 } else { -0.05 };
        for angle in [corner, rounded] {
            let (width, settings) = last_width(angle);
            assert!(
                (width / settings.design_width(50.0) - 1.0).abs() < 1e-12,
                "{width}"
            );
        }
    }
}
