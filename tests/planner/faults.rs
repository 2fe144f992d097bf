//! A fault of the planner itself: the machine comes to rest on its path, and nothing that follows runs.

use crate::common::{Machine, at, equal_limits, feed_move, with_machine, with_room};
use framepath::axes::Axes;
use framepath::cycle::JERK_KEPT;
use framepath::moves::TerminationCondition;
use framepath::planner::{AddError, CycleInputs, Fault, Planner, Status};

const FAULTS: [Fault; 6] = [
    Fault::CellRefused,
    Fault::Starved,
    Fault::LimitsRefused,
    Fault::SettingsRefused,
    Fault::MoveRefused,
    Fault::NoPlan,
];

const TOLERANCE: f64 = 0.1;

/// Corners of the program, which comes back to where it began.
const CORNERS: [[f64; 2]; 5] = [[6.0, 0.0], [6.0, 5.0], [3.0, 4.0], [3.0, 2.0], [0.0, 0.0]];

/// Servo periods at rest in which nothing may begin.
const RESTED: usize = 20;

/// Servo periods after which a program of this size has come to an end in any case.
const LONG: usize = 3000;

/// Distance of a position from the program.
fn distance(position: &Axes) -> f64 {
    let ends = CORNERS.map(|[x, y]| at(x, y));
    let starts = std::iter::once(Axes::zeros()).chain(ends);
    let legs = starts.zip(ends);
    legs.map(|(start, end)| {
        let along = end - start;
        let share = (position - start).dot(&along) / along.norm_squared();
        (start + along * share.clamp(0.0, 1.0) - position).norm()
    })
    .fold(f64::INFINITY, f64::min)
}

fn queue_program(machine: &mut Machine) {
    let blended = TerminationCondition::Continuous {
        tolerance: TOLERANCE,
    };
    machine.planner.set_termination(blended);
    for [x, y] in CORNERS {
        machine.line(at(x, y), &feed_move(80.0)).expect("a line");
    }
}

/// One cycle in which a fault may be reported.
fn cycle(machine: &mut Machine) -> Status {
    let status = *machine.planner.cycle(&CycleInputs::default());
    machine.positions.push(status.position);
    status
}

/// Queues and runs the program with a fault in front of one of its servo periods. Answers how many of
/// them it has without one, if that is less.
fn runs_with(fault: Fault, period: usize) -> Option<usize> {
    let mut ended = None;
    let test = |ended: &mut Option<usize>| {
        let mut machine = Machine::new(equal_limits(20_000.0));
        queue_program(&mut machine);
        for number in 0..period {
            if cycle(&mut machine).done {
                *ended = Some(number);
                return;
            }
        }
        machine.planner.inject(fault);
        let far = at(100.0, 100.0);
        let mut rested = 0;
        for number in 0..LONG {
            // Task sends what is next in the program, and motion gives it up.
            let next = machine.line(far, &feed_move(100.0));
            assert_eq!(next, Err(AddError::Tripped), "{number} periods later");
            machine.planner.stop();
            let status = cycle(&mut machine);
            assert_eq!(status.fault, Some(fault));
            assert!(machine.planner.is_stopped_for_error());
            assert!(distance(&status.position) < 1.005 * TOLERANCE);
            rested += usize::from(status.done);
            if rested > RESTED {
                break;
            }
        }
        let status = machine.planner.status();
        assert!(status.done && status.current_velocity == 0.0);
        assert!(status.queue_depth == 0);
        let extremes = machine.extremes();
        assert!(
            extremes.velocity < 1.001 && extremes.acceleration < 1.001 && extremes.jerk < JERK_KEPT,
            "{extremes:?}"
        );
        // The operator, or task, aborts: from here on all is as always.
        machine.planner.abort();
        let status = cycle(&mut machine);
        assert_eq!((status.fault, status.done), (None, true));
        machine.line(far, &feed_move(100.0)).expect("a line");
        machine.run(LONG);
        assert_eq!(machine.planner.status().position, far);
    };
    with_room(|| test(&mut ended));
    ended
}

#[test]
fn a_fault_in_any_period_stops_on_the_path_and_holds_until_an_abort() {
    // Each kind of fault in other periods, all of them in each sixth one of a whole program.
    let ends = |number: usize| {
        let mut periods = (number..LONG).step_by(FAULTS.len());
        let ended = periods.find_map(|period| runs_with(FAULTS[number], period));
        assert!(ended.is_some_and(|periods| periods > 200), "{ended:?}");
    };
    std::thread::scope(|scope| {
        for number in 0..FAULTS.len() {
            scope.spawn(move || ends(number));
        }
    });
}

#[test]
fn the_first_of_several_faults_is_reported() {
    with_machine(|machine| {
        queue_program(machine);
        machine.planner.inject(Fault::Starved);
        machine.planner.inject(Fault::NoPlan);
        assert_eq!(machine.planner.status().fault, Some(Fault::Starved));
    });
}

#[test]
fn a_new_position_and_the_end_of_a_program_lift_an_error_too() {
    let lifted: [fn(&mut Planner); 2] = [
        |planner| planner.clear(),
        |planner| planner.set_position(&Axes::zeros()).expect("a position"),
    ];
    for lift in lifted {
        with_machine(|machine| {
            machine.planner.inject(Fault::NoPlan);
            cycle(machine);
            assert!(machine.planner.is_stopped_for_error());
            lift(&mut machine.planner);
            assert!(!machine.planner.is_stopped_for_error());
            assert_eq!(machine.planner.status().fault, None);
            machine
                .line(at(1.0, 0.0), &feed_move(10.0))
                .expect("a line");
            machine.run(LONG);
        });
    }
}
