//! How far each axis runs on from its greatest velocity until it stands, by an abort or a feed hold.

use super::finding::{Findings, advice};
use crate::hal::number;
use crate::machine::configuration::is_rotary;
use crate::machine::length_unit::INCH;
use crate::machine::place::Place;
use crate::wiring::blendtp::{is_refused_jerk, jerk_pin, least_jerk};
use crate::wiring::subject::Subject;
use serde::Serialize;

/// A stop that the limit of jerk makes longer by more than this is told, mm or degrees.
const MUCH_LONGER: f64 = 5.0;

/// The stop of an axis, in machine units (degrees) and seconds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stop {
    /// Its letter.
    pub axis: char,
    /// `mm`, `in` or `deg`.
    pub unit: &'static str,
    /// The greatest one: that of the axis, or that along the path.
    pub velocity: f64,
    /// Its greatest acceleration.
    pub acceleration: f64,
    /// Its greatest jerk; `None`: not limited.
    pub jerk: Option<f64>,
    /// From that velocity to rest.
    pub distance: f64,
    /// The same without a limit of jerk.
    pub distance_without_jerk: f64,
    /// Seconds.
    pub time: f64,
}

/// Distance and time from `velocity` at no acceleration to rest: the acceleration builds up, stays if it gets that far,
/// and fades. All above 0.
fn braking(velocity: f64, acceleration: f64, jerk: Option<f64>) -> (f64, f64) {
    let time = match jerk {
        None => velocity / acceleration,
        Some(jerk) if velocity * jerk >= acceleration * acceleration => {
            velocity / acceleration + acceleration / jerk
        }
        Some(jerk) => 2.0 * (velocity / jerk).sqrt(),
    };
    // The velocity falls as much before the middle as behind it.
    (velocity * time / 2.0, time)
}

/// The stops of all axes whose limits are there and taken.
pub fn stops(subject: &Subject) -> Vec<Stop> {
    let of = |letter: &char| -> Option<Stop> {
        let section = format!("AXIS_{letter}");
        let positive =
            |section: &str, key: &str| subject.number(section, key).filter(|number| *number > 0.0);
        let path = match is_rotary(*letter) {
            true => "MAX_ANGULAR_VELOCITY",
            false => "MAX_LINEAR_VELOCITY",
        };
        let own = positive(&section, "MAX_VELOCITY")?;
        let velocity = positive("TRAJ", path).map_or(own, |path| own.min(path));
        let acceleration = positive(&section, "MAX_ACCELERATION")?;
        if jerk_comes_from(subject, *letter).is_some() {
            return None;
        }
        let set = subject.state.settings.get(&jerk_pin(*letter));
        let jerk: Option<f64> = set.and_then(|setting| number(&setting.value));
        // No move is taken, so there is none to stop.
        if subject.has_planner()
            && jerk.is_some_and(|jerk| is_refused_jerk(jerk, least_jerk(acceleration)))
        {
            return None;
        }
        let jerk = jerk.filter(|jerk| jerk.is_finite() && *jerk > 0.0 && subject.has_planner());
        let (distance, time) = braking(velocity, acceleration, jerk);
        Some(Stop {
            axis: *letter,
            unit: unit(subject, *letter),
            velocity,
            acceleration,
            jerk,
            distance,
            distance_without_jerk: braking(velocity, acceleration, None).0,
            time,
        })
    };
    subject.axes.iter().filter_map(of).collect()
}

/// Where the pin of the jerk of an axis is linked to a signal whose value another component says: it is not known.
fn jerk_comes_from(subject: &Subject, letter: char) -> Option<&Place> {
    let (state, pin) = (&subject.state, jerk_pin(letter));
    let pins = state.signals.get(state.signal_of(&pin)?)?;
    let (_, place) = pins.iter().find(|(other, _)| *other == pin)?;
    (!state.settings.contains_key(&pin)).then_some(place)
}

fn unit(subject: &Subject, letter: char) -> &'static str {
    match (is_rotary(letter), subject.is_in_inches()) {
        (true, _) => "deg",
        (false, true) => "in",
        (false, false) => "mm",
    }
}

/// Tells of those that the jerk makes much longer, and of axes whose jerk is not known.
pub fn look(subject: &Subject, stops: &[Stop], findings: &mut Findings) {
    for letter in &subject.axes {
        if let Some(place) = jerk_comes_from(subject, *letter) {
            let pin = jerk_pin(*letter);
            let found = format!(
                "how far {letter} runs on is not known: {pin} gets its value when the machine runs"
            );
            findings.note(place, found, advice(format!("halcmd getp {pin} shows it")));
        }
    }
    for stop in stops {
        let much = if stop.unit == "in" {
            MUCH_LONGER / INCH
        } else {
            MUCH_LONGER
        };
        let longer = stop.distance - stop.distance_without_jerk;
        if longer <= much {
            continue;
        }
        let found = format!(
            "an abort at {} {}/s takes {:.1} {}, {longer:.1} more than without a limit of jerk",
            stop.velocity, stop.unit, stop.distance, stop.unit
        );
        // Of two digits, so that it looks like what somebody writes.
        let enough = stop.velocity * stop.acceleration / (2.0 * much);
        let step = 10f64.powf(enough.log10().floor() - 1.0);
        let enough = (enough / step).ceil() * step;
        let section = format!("AXIS_{}", stop.axis);
        let remedy = advice(format!(
            "MAX_JERK = {enough} or more under [{section}], or less velocity"
        ));
        findings.warning(&subject.place_of(&section, "MAX_JERK"), found, remedy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braking_is_the_sum_of_its_three_phases() {
        // By steps: the acceleration builds up to the limit, stays, and fades.
        let cases = [
            (100.0, 1000.0, 20_000.0),
            (100.0, 1000.0, 3000.0),
            (5.0, 1000.0, 20_000.0),
        ];
        for (velocity, acceleration, jerk) in cases {
            let (distance, time) = braking(velocity, acceleration, Some(jerk));
            let rise = (acceleration / jerk).min(time / 2.0);
            let (mut v, mut s, step) = (velocity, 0.0, time / 2e5);
            for n in 0..200_000 {
                let t = (f64::from(n) + 0.5) * step;
                let a = jerk * t.min(rise).min(time - t);
                s += v * step;
                v -= a * step;
            }
            assert!(v.abs() < 1e-3 * velocity, "{v}");
            assert!((s / distance - 1.0).abs() < 1e-3, "{s} {distance}");
        }
        assert_eq!(braking(100.0, 1000.0, None), (5.0, 0.1));
    }
}
