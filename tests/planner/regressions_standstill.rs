//! Programs that once came to a standstill for good, found by random ones.

use crate::common::with_room;
use crate::random_program::Event;
use crate::random_program::run::run;
use crate::random_program::text::program;
use framepath::axes::{Axes, AxisLimits};
use framepath::moves::MotionType;

/// A feed override of 0 catches a rapid in its first periods, without a limit of jerk.
#[test]
fn a_move_that_is_held_as_it_begins_goes_on() {
    let limits = AxisLimits {
        velocity: Axes::repeat(60.0),
        acceleration: Axes::from([
            600.0, 829.5066, 1105.7663, 600.0, 600.0, 600.0, 600.0, 600.0, 600.0,
        ]),
        jerk: Axes::repeat(f64::INFINITY),
    };
    let mut moves = program(
        "
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 -0.1960028141541715 0 0 0 9.974182454814718
line 0 0 -0.5135388137562152 0 0 0 0 0 0 9.974182454814718
line 0 -0.6792362949548992 0.9413307695950006 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 -0.2626102802285772 9.974182454814718",
    );
    moves[8].motion_type = MotionType::Traverse;
    let events = [
        (93, Event::FeedOverride(0.0)),
        (387, Event::Pause),
        (391, Event::Adaptive(0.0)),
        (249, Event::Pause),
        (174, Event::Pause),
        (213, Event::Pause),
        (318, Event::Pause),
        (115, Event::FeedOverride(0.0)),
        (285, Event::Abort),
        (3, Event::Adaptive(0.24622653735726102)),
    ];
    with_room(|| run(limits, &moves, &events, 243)).expect("an end");
}

/// An arc that is raised to twice its feed and paused just then.
#[test]
fn an_arc_that_is_paused_as_it_is_raised_goes_on() {
    let limits = AxisLimits {
        velocity: Axes::repeat(60.0),
        acceleration: Axes::from([
            760.6915034813552,
            1695.3239673318787,
            600.0,
            600.0,
            600.0,
            600.0,
            600.0,
            600.0,
            600.0,
        ]),
        jerk: Axes::repeat(f64::INFINITY),
    };
    let moves = program(
        "
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
line 0 0 0 0 0 0 0 0 0 9.974182454814718
arc 0.35701900332835473 -0.01722296092475559 0 0 -0.6872264263598868 0 4.775888214705427 5.732312178994296 0 -2 0 0 0 0 0 0 10.167604198347368",
    );
    let events = [
        (325, Event::FeedOverride(0.0)),
        (236, Event::FeedOverride(2.0)),
        (227, Event::Pause),
        (28, Event::RapidOverride(0.0)),
        (1, Event::Pause),
    ];
    with_room(|| run(limits, &moves, &events, 1)).expect("an end");
}
