//! Runs a program while an operator acts, and judges every servo period of it.

use std::slice;

use framepath::axes::Axes;
use framepath::planner::Status;
use proptest::prelude::*;

use super::feed::FeedWatch;
use super::operator::Operator;
use super::queue::queue;
use super::rests::{Rests, Supplied};
use super::{Event, Program, Programmed};
use crate::common::path_check::{self, Place, Wanted};
use crate::common::{Extremes, Machine};

/// How a program ran.
#[derive(Clone, Copy, Debug)]
pub struct Ran {
    /// The greatest values over the limits.
    pub extremes: Extremes,
    /// Servo periods to the end.
    pub periods: usize,
}

/// Runs a program to its end.
///
/// # Errors
/// What is not as it is asked.
pub fn run(program: &Program) -> Result<Ran, TestCaseError> {
    run_on(program, &mut Machine::new(program.limits))
}

/// The same on a machine with these limits, of which the planner knows more.
///
/// # Errors
/// What is not as it is asked.
pub fn run_on(program: &Program, machine: &mut Machine) -> Result<Ran, TestCaseError> {
    let mut running = Running::new(program, machine);
    let last_event = program.events.last().map_or(0, |(period, _)| *period);
    let never = last_event + program.asked.most_periods();
    for period in 0.. {
        prop_assert!(
            period < never,
            "not done: {:?}",
            running.machine.planner.status()
        );
        if running.period(period)? {
            return running.judged(period + 1);
        }
    }
    unreachable!("periods without an end");
}

struct Running<'a> {
    program: &'a Program,
    machine: &'a mut Machine,
    operator: Operator,
    moves: slice::Iter<'a, Programmed>,
    events: slice::Iter<'a, (usize, Event)>,
    /// Counts the aborts.
    generation: usize,
    /// Of the move that is queued next.
    id: i32,
    last_id: i32,
    wanted: Vec<Wanted>,
    places: Vec<Place>,
    rests: Rests,
    feed: FeedWatch,
}

impl<'a> Running<'a> {
    fn new(program: &'a Program, machine: &'a mut Machine) -> Self {
        if let Some(velocity) = program.slider {
            machine.planner.set_velocity_limit(velocity);
        }
        machine.planner.set_termination(program.mode);
        Self {
            program,
            machine,
            operator: Operator::new(program.slider),
            moves: program.moves.iter(),
            events: program.events.iter(),
            generation: 0,
            id: 1,
            last_id: 0,
            wanted: Vec::new(),
            places: vec![Place {
                position: Axes::zeros(),
                id: 0,
                generation: 0,
            }],
            rests: Rests::new(program.asked.rests, &program.limits, program.max_velocity),
            feed: FeedWatch::new(),
        }
    }

    /// One servo period; whether it was the last.
    fn period(&mut self, period: usize) -> Result<bool, TestCaseError> {
        while let Some((at, event)) = self.events.as_slice().first()
            && *at == period
        {
            self.operator.act(self.machine, *event);
            self.events.next();
        }
        self.supply(period);
        let aborting = self.machine.planner.status().aborting;
        let status = self.machine.scaled_cycle(self.operator.adaptive);
        self.generation += usize::from(aborting && !status.aborting);
        let stepping = self.machine.inputs.stepping;
        self.rests.look(&status, period, aborting, stepping)?;
        self.look(&status)?;
        self.operator.end_step(self.machine);
        Ok(status.done && self.moves.len() == 0 && self.events.len() == 0)
    }

    fn supply(&mut self, period: usize) {
        if self.machine.planner.status().aborting {
            return;
        }
        match self.program.supply {
            0 => (0..self.moves.len()).for_each(|_| self.queue_next(period)),
            supply if period.is_multiple_of(supply) => self.queue_next(period),
            _ => {}
        }
    }

    fn queue_next(&mut self, period: usize) {
        self.machine.planner.set_id(self.id);
        let Some(programmed) = self.moves.next() else {
            return;
        };
        let (added, shape) = queue(self.machine, programmed, self.program.max_velocity);
        let termination = self.machine.planner.termination();
        self.wanted.extend(shape.map(|shape| Wanted {
            id: self.id,
            shape,
            tolerance: Wanted::tolerance_of(termination),
            generation: self.generation,
        }));
        self.feed.supply(programmed, added);
        self.rests.supply(Supplied {
            period,
            termination,
            wait_for_spindle: programmed.wait_for_spindle,
        });
        self.id += 1;
    }

    fn look(&mut self, status: &Status) -> Result<(), TestCaseError> {
        self.places.push(Place {
            position: status.position,
            id: status.exec_id,
            generation: self.generation,
        });
        self.feed.look(status);
        if status.exec_id != 0 {
            prop_assert!(status.exec_id >= self.last_id, "ids go back");
            self.last_id = status.exec_id;
        }
        prop_assert!(status.current_velocity >= 0.0 && status.current_velocity.is_finite());
        prop_assert!(status.distance_to_go >= 0.0 && status.distance_to_go.is_finite());
        Ok(())
    }

    /// What is asked of the whole.
    fn judged(&self, periods: usize) -> Result<Ran, TestCaseError> {
        let asked = &self.program.asked;
        let planner = &self.machine.planner;
        prop_assert_eq!(planner.status().position, *planner.goal());
        if asked.path {
            let fault = path_check::fault(&self.wanted, &self.places);
            prop_assert!(fault.is_none(), "{fault:?}");
        }
        let fastest = self.feed.fastest();
        prop_assert!(
            asked.feed.is_none_or(|most| fastest <= most),
            "{fastest} of F"
        );
        let extremes = self.machine.extremes();
        asked.of_limits(&extremes)?;
        Ok(Ran { extremes, periods })
    }
}
