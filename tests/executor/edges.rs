//! What lies at the edges: the end of the reference, refusals, starvation, odd numbers.

use crate::support::monitor::Monitor;
use crate::support::player::Player;
use crate::support::reference::{Move, Reference, Shape};
use crate::support::uniform_limits;
use framepath::axes::Axes;
use framepath::cycle::{CAPACITY, CloseError, ConfigureError, Demand, Executor, PushError};
use framepath::cycle::{JERK_KEPT, cell::Cell};

const PERIOD: f64 = 1e-3;

fn line(length: f64) -> Move {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    Move::new(Shape::Line(Axes::x()), length, 80.0, &limits, 0.999)
}

fn configured() -> Box<Executor> {
    let mut executor = Box::new(Executor::new());
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    executor.configure(&limits, PERIOD).unwrap();
    executor
}

fn cruising() -> Cell {
    Reference::new(vec![line(100.0)]).cell(0.5, PERIOD)
}

#[test]
fn limits_and_period_are_checked() {
    let good = uniform_limits(100.0, 1000.0, f64::INFINITY);
    let mut executor = Box::new(Executor::new());
    assert_eq!(executor.push(&cruising()), Err(PushError::NotConfigured));
    assert_eq!(
        executor.set_limits(&good),
        Err(ConfigureError::ServoPeriod(0.0))
    );
    for period in [0.0, -1.0, f64::INFINITY] {
        let refused = executor.configure(&good, period);
        assert_eq!(refused, Err(ConfigureError::ServoPeriod(period)));
    }
    assert!(executor.configure(&good, f64::NAN).is_err());
    for bad in [0.0, -5.0, f64::NAN] {
        let mut limits = good;
        limits.jerk[4] = bad;
        let refused = executor.configure(&limits, PERIOD);
        assert_eq!(refused, Err(ConfigureError::Limit { axis: 4 }));
    }
    assert_eq!(executor.configure(&good, PERIOD), Ok(()));
    assert_eq!(executor.set_limits(&good), Ok(()));
}

#[test]
fn an_executor_without_cells_stands() {
    for mut executor in [Box::new(Executor::new()), configured()] {
        for demand in [Demand::RUN, Demand::HOLD] {
            let step = executor.cycle(&demand);
            assert!(step.at_rest && !step.end_reached && !step.starved);
            assert_eq!(
                (step.advance, step.rate, step.rate_acceleration),
                (0.0, 0.0, 0.0)
            );
        }
    }
}

#[test]
fn cells_are_checked() {
    let mut executor = configured();
    let mut cell = cruising();
    cell.acceleration[7] = f64::NAN;
    assert_eq!(executor.push(&cell), Err(PushError::NotFinite { axis: 7 }));
    let mut cell = cruising();
    cell.path_velocity = f64::INFINITY;
    assert_eq!(executor.push(&cell), Err(PushError::Feed));
    let mut cell = cruising();
    cell.programmed_feed = 0.0;
    assert_eq!(executor.push(&cell), Err(PushError::Feed));
    assert_eq!(executor.cells_ahead(), 0);

    let mut count = 0;
    while executor.push(&cruising()).is_ok() {
        count += 1;
    }
    assert_eq!(executor.push(&cruising()), Err(PushError::Full));
    assert_eq!(executor.cells_ahead(), count);
    assert!(count > CAPACITY * 9 / 10 && count < CAPACITY);
    assert!(executor.cells_wanted() <= count);
}

#[test]
fn the_end_lies_in_the_last_cell() {
    let mut executor = configured();
    assert_eq!(executor.close(0.0), Err(CloseError::Empty));
    executor.push(&cruising()).unwrap();
    for outside in [-1e-4, 1.1 * PERIOD, f64::NAN] {
        assert_eq!(executor.close(outside), Err(CloseError::OutsideLastCell));
    }
    assert_eq!(executor.close(0.3 * PERIOD), Ok(()));
    assert_eq!(executor.close(0.3 * PERIOD), Err(CloseError::Closed));
    assert_eq!(executor.push(&cruising()), Err(PushError::Closed));
    let step = executor.cycle(&Demand::RUN);
    assert!(step.end_reached && step.at_rest);
    assert!((step.advance - 0.3 * PERIOD).abs() < 1e-15);
    executor.reset();
    assert_eq!(executor.cells_ahead(), 0);
    assert_eq!(executor.push(&cruising()), Ok(()));
}

/// Moves shorter than a servo period share cells.
#[test]
fn very_short_moves() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let moves = (1..=200)
        .map(|i| line(1e-9 * f64::from(i * i * i)))
        .collect();
    let reference = Reference::new(moves);
    assert!(reference.start(1) < PERIOD);
    for hold_every in [usize::MAX, 7, 40] {
        let mut player = Player::new(&reference, &limits, PERIOD);
        let mut monitor = Monitor::new(&limits, PERIOD, Axes::zeros());
        for i in 1..20_000 {
            let hold = i / 20 % hold_every == hold_every - 1;
            let demand = if hold { Demand::HOLD } else { Demand::RUN };
            let (step, position) = player.cycle(&demand);
            monitor.push(position);
            if step.end_reached {
                break;
            }
        }
        assert!((player.time - reference.duration()).abs() < 1e-12);
        assert!(monitor.acceleration <= 1.001 && monitor.jerk <= JERK_KEPT);
        assert_eq!(player.executor.backups_lost(), 0);
    }
}

#[test]
fn starvation_is_reported_and_survived() {
    let reference = Reference::new(vec![line(100.0)]);
    let mut executor = configured();
    for i in 0..20 {
        executor
            .push(&reference.cell(f64::from(i) * PERIOD, PERIOD))
            .unwrap();
    }
    let mut time = 0.0;
    for _ in 0..20 {
        let step = executor.cycle(&Demand::RUN);
        assert!(!step.starved);
        time += step.advance;
    }
    let step = executor.cycle(&Demand::RUN);
    assert!(step.starved && step.at_rest && step.advance == 0.0);
    let step = executor.cycle(&Demand::RUN);
    assert!(!step.starved && step.wall && step.at_rest);
    // More cells arrive: it goes on from there.
    for i in 20..60 {
        executor
            .push(&reference.cell(f64::from(i) * PERIOD, PERIOD))
            .unwrap();
    }
    for _ in 0..10 {
        time += executor.cycle(&Demand::RUN).advance;
    }
    assert!(time > 20.0 * PERIOD && time <= 30.0 * PERIOD);
}

#[test]
fn a_hold_before_the_start_costs_nothing() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let reference = Reference::new(vec![line(10.0)]);
    let mut player = Player::new(&reference, &limits, PERIOD);
    for _ in 0..10 {
        let (step, _) = player.cycle(&Demand::HOLD);
        assert!(step.at_rest && step.advance == 0.0);
    }
    let mut periods = 0;
    while !player.cycle(&Demand::RUN).0.end_reached {
        periods += 1;
    }
    assert_eq!(periods + 1, (reference.duration() / PERIOD).ceil() as usize);
}

#[test]
fn limits_lowered_under_way_stop_nothing() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let lower = uniform_limits(30.0, 300.0, 2_000.0);
    let reference = Reference::new(vec![line(20.0), line(20.0)]);
    let mut player = Player::new(&reference, &limits, PERIOD);
    let mut monitor = Monitor::new(&limits, PERIOD, Axes::zeros());
    for i in 0..20_000 {
        match i {
            100 => player.executor.set_limits(&lower).unwrap(),
            900 => player.executor.set_limits(&limits).unwrap(),
            _ => {}
        }
        let hold = (150..600).contains(&i) || (1000..1200).contains(&i);
        let demand = if hold { Demand::HOLD } else { Demand::RUN };
        let (step, position) = player.cycle(&demand);
        monitor.push(position);
        assert!(i != 599 || step.at_rest);
        if step.end_reached {
            break;
        }
    }
    // What the reference needs by itself is never more than the limits it was planned for.
    assert!((player.time - reference.duration()).abs() < 1e-12);
    assert!(monitor.acceleration <= 1.001 && monitor.jerk <= JERK_KEPT);
    assert_eq!(player.executor.backups_lost(), 0);
}

/// A reference on the limits exactly, with bounds that are a little beyond them.
#[test]
fn a_reference_on_the_limit_can_be_held_and_released() {
    let limits = uniform_limits(100.0, 1000.0, 20_000.0);
    let exact = Move::new(Shape::Line(Axes::x()), 60.0, 100.0, &limits, 1.0);
    let reference = Reference::new(vec![exact]);
    let claimed = uniform_limits(100.0, 999.0, 19_990.0);
    for hold_at in (1..560).step_by(13) {
        let mut player = Player::new(&reference, &claimed, PERIOD);
        let mut monitor = Monitor::new(&limits, PERIOD, Axes::zeros());
        let mut rested = false;
        for i in 0..5000 {
            let hold = (hold_at..hold_at + 250).contains(&i);
            let demand = if hold { Demand::HOLD } else { Demand::RUN };
            let (step, position) = player.cycle(&demand);
            monitor.push(position);
            rested |= hold && step.at_rest;
            if step.end_reached {
                break;
            }
        }
        assert!(rested, "{hold_at}");
        assert!(monitor.acceleration <= 1.001, "{}", monitor.acceleration);
        assert!(monitor.jerk <= JERK_KEPT, "{}", monitor.jerk);
        assert!((player.time - reference.duration()).abs() < 1e-12);
    }
}

/// Cells that claim infinite or contradictory bounds must not lead to anything that is not finite.
#[test]
fn nonsense_stays_finite() {
    let reference = Reference::new(vec![line(100.0)]);
    let worst = [
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        1e300,
        -1e300,
        1e-300,
    ];
    for (seed, bad) in worst.into_iter().enumerate() {
        let mut executor = configured();
        let mut last = 0.0;
        for i in 0..600 {
            let mut cell = reference.cell(f64::from(i) * PERIOD, PERIOD);
            let axis = (i as usize + seed) % 9;
            match i % 5 {
                0 => cell.jerk_max[axis] = bad,
                1 => cell.jerk_min[axis] = bad,
                2 => cell.acceleration_max[axis] = bad,
                3 => cell.acceleration_min[axis] = bad,
                _ => cell.velocity[axis] = if bad.is_finite() { bad } else { 0.0 },
            }
            executor.push(&cell).unwrap();
            let demand = Demand {
                hold: i % 37 < 9,
                feed_override: if i % 50 < 25 { bad } else { 0.7 },
                rapid_override: bad,
                turns: bad,
                follow: (i % 70 < 20).then_some(framepath::cycle::Follow {
                    error: bad,
                    velocity: 20.0,
                    acceleration: bad,
                    jerk: bad,
                    greatest_acceleration: bad,
                }),
                max_velocity: if i % 60 < 30 { bad } else { 20.0 },
            };
            let step = executor.cycle(&demand);
            assert!((0.0..=PERIOD).contains(&step.advance));
            assert!((0.0..=1.0).contains(&step.rate));
            assert!(step.rate_acceleration.is_finite());
            last += step.advance;
        }
        assert!(last.is_finite());
    }
}

/// Precision does not fade: however many periods have passed, a period is a period.
#[test]
fn long_runs_keep_their_precision() {
    let mut executor = configured();
    let cell = cruising();
    let mut cells = 0_u64;
    for _ in 0..100_000 {
        while executor.cells_ahead() < executor.cells_wanted() {
            executor.push(&cell).unwrap();
            cells += 1;
        }
        assert_eq!(executor.cycle(&Demand::RUN).advance, PERIOD);
    }
    assert_eq!(cells, 100_000 + executor.cells_ahead() as u64);
}

#[test]
fn no_more_cells_are_wanted_than_there_is_room_for() {
    let mut executor = Box::new(Executor::new());
    let limits = uniform_limits(100.0, 1000.0, f64::MIN_POSITIVE);
    executor.configure(&limits, PERIOD).unwrap();
    executor.push(&cruising()).unwrap();
    let slowed = Demand {
        feed_override: 0.5,
        ..Demand::RUN
    };
    executor.cycle(&slowed);
    assert!(executor.cells_wanted() < CAPACITY);
}
