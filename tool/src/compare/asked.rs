//! What each move of a program asks for beside its path: a speed, and to be in step with the spindle.

use crate::host::job::Job;
use crate::host::operator::Action;
use crate::layer::program::{Operation, Shape};
use crate::layer::spindle::SpindleCommand;

/// Whether a move is where the angle of the spindle says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Coupling {
    /// At its feed, a time or a turn.
    None,
    /// Of a thread, G33.
    Thread,
    /// G33.1.
    Tap,
}

/// What a move asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Asked {
    /// The slowest that it is to be run at without an override, mm/s, or degrees per second where nothing but
    /// rotary axes moves.
    pub speed: f64,
    pub coupling: Coupling,
}

/// Of each move of a job, in its order.
pub(crate) fn asked(job: &Job) -> Vec<Asked> {
    let slider = job.events.iter().fold(job.velocity_limit, |least, event| {
        if let Action::MaxVelocity(velocity) = event.action {
            return least.min(velocity);
        }
        least
    });
    let mut spindle = SpindleCommand::default();
    let mut following = None;
    let mut x = 0.0;
    let mut found = Vec::new();
    for operation in &job.operations {
        match *operation {
            Operation::Spindle(command) => spindle = command,
            Operation::Synchronise {
                per_revolution,
                velocity_mode,
            } => following = (per_revolution != 0.0).then_some((per_revolution, velocity_mode)),
            Operation::Move(ref a_move) => {
                let feed = a_move.velocity.min(a_move.greatest_velocity).min(slider);
                // With a constant surface speed the spindle is the slower, the larger the diameter is.
                let turns = |x: f64| spindle.at(x).abs() / 60.0;
                let slowest = turns(x).min(turns(a_move.end[0]));
                let by_spindle = following.map(|(per_turn, _)| per_turn * slowest);
                let coupling = match following {
                    _ if a_move.shape == Shape::Tap => Coupling::Tap,
                    Some((_, false)) => Coupling::Thread,
                    _ => Coupling::None,
                };
                if coupling != Coupling::Tap {
                    x = a_move.end[0];
                }
                found.push(Asked {
                    speed: by_spindle.map_or(feed, |speed| speed.min(feed)),
                    coupling,
                });
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canon::Call;
    use crate::host::job::tests::job;
    use crate::host::operator::Event;
    use crate::layer::{LayerSettings, lay};

    fn of(text: &str, events: Vec<Event>) -> Vec<(f64, Coupling)> {
        let calls: Vec<Call> = text.lines().filter_map(Call::parse).collect();
        let job = Job {
            events,
            operations: lay(&calls, &LayerSettings::default()).operations,
            ..job()
        };
        let rounded = |asked: Asked| ((asked.speed * 1e9).round() / 1e9, asked.coupling);
        asked(&job).into_iter().map(rounded).collect()
    }

    #[test]
    fn feed_and_slider() {
        let text = "RATE 600\nFEED 1 1 0 0 0 0 0 0 0 0\nTRAVERSE 2 2 0 0 0 0 0 0 0 0";
        let none = Coupling::None;
        assert_eq!(of(text, Vec::new()), [(10.0, none), (100.0, none)]);
        let slider = |velocity: f64| Event {
            time: 1.0,
            action: Action::MaxVelocity(velocity),
        };
        let slowed = of(text, vec![slider(4.0), slider(50.0)]);
        assert_eq!(slowed, [(4.0, none), (4.0, none)]);
    }

    #[test]
    fn a_feed_per_turn_a_thread_and_a_tap() {
        let text = "SPINDLE 60 1\nRATE 600\nSYNC 0.5 1\nFEED 1 1 0 0 0 0 0 0 0 0\nSYNC 1.5 0\n\
                    FEED 2 2 0 0 0 0 0 0 0 0\nTAP 3 2 0 -9 0 0 0 0 0 0\nSYNC 0 0\nFEED 4 3 0 0 0 0 0 0 0 0";
        let expected = [
            (0.5, Coupling::None),
            (1.5, Coupling::Thread),
            (1.5, Coupling::Tap),
            (10.0, Coupling::None),
        ];
        assert_eq!(of(text, Vec::new()), expected);
    }
}
