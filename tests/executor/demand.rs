//! What the executor makes of feed hold, overrides and the greatest velocity.

use crate::support::player::Player;
use crate::support::reference::{Move, Reference, Shape, path_speed};
use crate::support::uniform_limits;
use framepath::axes::{Axes, AxisLimits};
use framepath::cycle::Demand;
use proptest::prelude::*;

const PERIOD: f64 = 1e-3;

fn along(axis: usize) -> Axes {
    Axes::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 })
}

fn line(length: f64, feed: f64, limits: &AxisLimits) -> Move {
    Move::new(Shape::Line(along(0)), length, feed, limits, 0.999)
}

fn override_of(feed_override: f64) -> Demand {
    Demand {
        feed_override,
        ..Demand::RUN
    }
}

/// The feed at the present reference time.
fn feed(player: &Player, rate: f64) -> f64 {
    rate * path_speed(&player.reference.at(player.time)[1])
}

/// Runs to the end and answers with the number of periods.
fn run_to_end(player: &mut Player, demand: &Demand) -> usize {
    for count in 1..1_000_000 {
        if player.cycle(demand).0.end_reached {
            return count;
        }
    }
    panic!("no end");
}

#[test]
fn full_speed_costs_nothing() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let reference = Reference::new(vec![
        line(30.0, 80.0, &limits),
        Move::new(Shape::circle(10.0), 60.0, 80.0, &limits, 0.999),
        line(0.01, 80.0, &limits),
        line(0.00001, 80.0, &limits),
        line(10.0, 20.0, &limits),
    ]);
    let mut player = Player::new(&reference, &limits, PERIOD);
    let mut periods = 0;
    loop {
        let (step, _) = player.cycle(&Demand::RUN);
        periods += 1;
        if step.end_reached {
            assert!(step.at_rest && step.rate == 0.0);
            break;
        }
        assert_eq!(
            (step.advance, step.rate, step.rate_acceleration),
            (PERIOD, 1.0, 0.0)
        );
        assert!(!step.at_rest);
    }
    assert_eq!(periods, (reference.duration() / PERIOD).ceil() as usize);
    assert!((player.time - reference.duration()).abs() < 1e-12);
    // It stays there.
    let (step, position) = player.cycle(&Demand::RUN);
    assert!(step.end_reached && step.at_rest && step.advance == 0.0);
    assert_eq!(position, reference.at(reference.duration())[0]);
}

/// What a limit leaves along a line that moves one axis.
fn ideal_stop(velocity: f64, acceleration: f64, jerk: f64) -> f64 {
    if acceleration * acceleration / jerk >= velocity {
        2.0 * (velocity / jerk).sqrt()
    } else {
        velocity / acceleration + acceleration / jerk
    }
}

/// What the moves under a cap are programmed with.
const CAPPED_FEED: f64 = 60.0;

/// Runs a line and a circle with a demand that leaves this part of the programmed feed.
fn judge_cap(
    scale: f64,
    acceleration: f64,
    jerk: f64,
    radius: f64,
    demand: &Demand,
) -> Result<(), TestCaseError> {
    let limits = uniform_limits(100.0, acceleration, jerk);
    for shape in [Shape::Line(along(1)), Shape::circle(radius)] {
        let made = Move::new(shape, 120.0, CAPPED_FEED, &limits, 0.999);
        let reference = Reference::new(vec![made]);
        let duration = reference.duration();
        let cruise = path_speed(&reference.at(0.5 * duration)[1]);
        let cap = scale * CAPPED_FEED;
        let mut player = Player::new(&reference, &limits, PERIOD);
        loop {
            let (step, _) = player.cycle(demand);
            if step.end_reached {
                break;
            }
            let feed = feed(&player, step.rate);
            prop_assert!(feed <= 1.02 * cap + 0.3, "{} above {}", feed, cap);
            // In the middle of the move everything has settled.
            if (0.45..0.55).contains(&(player.time / duration)) {
                let expected = cap.min(cruise);
                prop_assert!(
                    (feed / expected - 1.0).abs() < 0.02,
                    "{} {}",
                    feed,
                    expected
                );
            }
        }
        prop_assert_eq!(player.executor.backups_lost(), 0);
    }
    Ok(())
}

/// The reference, at a rate of exactly 1, uses all of the jerk in the periods in which the cap is
/// reached: the one period before, in which braking is possible, must not be missed.
#[test]
fn a_cap_is_braked_for_before_the_reference_needs_all_the_jerk() {
    let (scale, acceleration, jerk, radius) = (
        0.970_034_500_082_805_8,
        835.807_666_339_539_3,
        195_712.232_273_695_38,
        17.524_203_066_203_945,
    );
    judge_cap(scale, acceleration, jerk, radius, &override_of(scale)).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    #[test]
    fn hold_and_resume_take_what_the_limits_ask_for(
        velocity in 20.0..300.0,
        acceleration in 200.0..3000.0,
        jerk in 5_000.0..200_000.0,
        start in 0.0..1.0,
    ) {
        let ideal = ideal_stop(velocity, acceleration, jerk);
        let limits = uniform_limits(velocity, acceleration, jerk);
        let reference = Reference::new(vec![line(velocity * ideal * 8.0, velocity, &limits)]);
        let mut player = Player::new(&reference, &limits, PERIOD);
        while player.time < ideal * (1.1 + 2.0 * start) {
            player.cycle(&Demand::RUN);
        }
        let greatest = (1.4 * ideal).max(ideal + 0.025);
        for target in [0.0, 1.0] {
            let demand = if target == 0.0 { Demand::HOLD } else { Demand::RUN };
            let mut periods = 0;
            loop {
                let (step, _) = player.cycle(&demand);
                periods += 1;
                if step.rate == target && step.rate_acceleration == 0.0 {
                    prop_assert_eq!(step.at_rest, target == 0.0);
                    break;
                }
                prop_assert!((periods as f64) * PERIOD < greatest, "to rate {}", target);
            }
            if target == 0.0 {
                for _ in 0..3 {
                    let (step, _) = player.cycle(&demand);
                    prop_assert!(step.at_rest && step.advance == 0.0);
                }
            }
        }
        run_to_end(&mut player, &Demand::RUN);
        prop_assert_eq!(player.executor.backups_lost(), 0);
    }

    #[test]
    fn a_cap_holds_the_feed_and_is_used(
        scale in 0.02..0.98,
        acceleration in 200.0..3000.0,
        jerk in 5_000.0..200_000.0,
        radius in 0.5..50.0,
        by_velocity in any::<bool>(),
    ) {
        let demand = if by_velocity {
            Demand { max_velocity: scale * CAPPED_FEED, ..Demand::RUN }
        } else {
            override_of(scale)
        };
        judge_cap(scale, acceleration, jerk, radius, &demand)?;
    }
}

#[test]
fn a_lowered_override_settles_and_a_raised_one_returns() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let reference = Reference::new(vec![line(400.0, 80.0, &limits)]);
    let mut player = Player::new(&reference, &limits, PERIOD);
    for _ in 0..500 {
        player.cycle(&Demand::RUN);
    }
    for (scale, expected) in [
        (0.5, 40.0),
        (0.1, 8.0),
        (0.75, 60.0),
        (1.0, 80.0),
        (1.5, 80.0),
    ] {
        // From any of these feeds to any other takes 130 ms at the limits.
        let mut rate = 0.0;
        for _ in 0..160 {
            rate = player.cycle(&override_of(scale)).0.rate;
        }
        for _ in 0..50 {
            rate = player.cycle(&override_of(scale)).0.rate;
            let feed = feed(&player, rate);
            assert!((feed / expected - 1.0).abs() < 0.02, "{scale}: {feed}");
        }
        if scale >= 1.0 {
            assert_eq!(rate, 1.0);
        }
    }
}

#[test]
fn moves_below_the_cap_are_not_slowed() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    // Too short to reach half of the feed.
    let reference = Reference::new((0..60).map(|_| line(1.0, 80.0, &limits)).collect());
    let mut player = Player::new(&reference, &limits, PERIOD);
    let periods = run_to_end(&mut player, &override_of(0.5));
    assert_eq!(periods, (reference.duration() / PERIOD).ceil() as usize);

    // The same after a long move that has to be slowed down.
    let mut moves = vec![line(40.0, 80.0, &limits)];
    moves.extend((0..60).map(|_| line(1.0, 80.0, &limits)));
    let mixed = Reference::new(moves);
    let mut player = Player::new(&mixed, &limits, PERIOD);
    while player.time < mixed.start(1) + 0.05 {
        player.cycle(&override_of(0.5));
    }
    let left = mixed.duration() - player.time;
    let periods = run_to_end(&mut player, &override_of(0.5));
    assert!(
        periods as f64 * PERIOD < left + 0.003,
        "{periods} for {left}"
    );
}

#[test]
fn each_override_has_its_moves() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let feed_move = || line(30.0, 80.0, &limits);
    let rapid = Move {
        rapid: true,
        ..feed_move()
    };
    let fixed = Move {
        override_enabled: false,
        ..feed_move()
    };
    let reference = Reference::new(vec![feed_move(), rapid, fixed]);
    let demand = Demand {
        feed_override: 0.5,
        rapid_override: 0.25,
        ..Demand::RUN
    };
    let peaks = |demand: &Demand| {
        let mut player = Player::new(&reference, &limits, PERIOD);
        let mut peaks = [0.0_f64; 3];
        loop {
            let (step, _) = player.cycle(demand);
            if step.end_reached {
                return peaks;
            }
            let peak = &mut peaks[reference.index(player.time)];
            *peak = peak.max(feed(&player, step.rate));
        }
    };
    let near = |found: [f64; 3], expected: [f64; 3]| {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        }
    };
    near(peaks(&demand), [40.0, 20.0, 80.0]);
    let slider = Demand {
        max_velocity: 30.0,
        ..demand
    };
    near(peaks(&slider), [30.0, 20.0, 30.0]);
}

#[test]
fn override_zero_stops_the_moves_that_it_applies_to() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let rapid = Move {
        rapid: true,
        ..line(30.0, 80.0, &limits)
    };
    let reference = Reference::new(vec![rapid, line(30.0, 80.0, &limits)]);
    for zero in [0.0, -1.0, f64::NAN] {
        let mut player = Player::new(&reference, &limits, PERIOD);
        for _ in 0..3000 {
            player.cycle(&override_of(zero));
        }
        // The rapid move has run, and the feed move has not moved to speak of.
        assert!(player.time >= reference.start(1));
        let moved = reference.at(player.time)[0][0] - reference.at(reference.start(1))[0][0];
        assert!(moved < 0.01, "{moved}");
        let (step, _) = player.cycle(&override_of(zero));
        assert!(step.at_rest && !step.end_reached);
        run_to_end(&mut player, &Demand::RUN);
    }
    for demand in [
        Demand {
            max_velocity: 0.0,
            ..Demand::RUN
        },
        Demand {
            max_velocity: f64::NAN,
            ..Demand::RUN
        },
        Demand {
            rapid_override: f64::NEG_INFINITY,
            ..Demand::RUN
        },
    ] {
        let mut player = Player::new(&reference, &limits, PERIOD);
        for _ in 0..100 {
            player.cycle(&Demand::RUN);
        }
        for _ in 0..200 {
            player.cycle(&demand);
        }
        assert!(player.cycle(&demand).0.at_rest, "{demand:?}");
    }
}
