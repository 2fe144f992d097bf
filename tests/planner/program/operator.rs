//! Does what the events of a program say.

use super::Event;
use crate::common::Machine;

/// What of the operator the planner does not hold.
pub struct Operator {
    /// Where the slider is left.
    slider: Option<f64>,
    pub adaptive: f64,
    paused: bool,
    /// The move that a single step began on.
    step_from: Option<i32>,
}

impl Operator {
    pub fn new(slider: Option<f64>) -> Self {
        Self {
            slider,
            adaptive: 1.0,
            paused: false,
            step_from: None,
        }
    }

    pub fn act(&mut self, machine: &mut Machine, event: Event) {
        match event {
            Event::Pause => {
                machine.planner.pause();
                self.paused = true;
            }
            Event::Resume => {
                machine.planner.resume();
                self.paused = false;
            }
            Event::Abort => machine.planner.abort(),
            Event::FeedOverride(scale) => machine.inputs.feed_scale = scale,
            Event::RapidOverride(scale) => machine.inputs.rapid_scale = scale,
            Event::Slider(velocity) => machine.planner.set_velocity_limit(velocity),
            Event::Adaptive(scale) => self.adaptive = scale,
            Event::Spindles(at_speed) => machine.inputs.spindles_at_speed = at_speed,
            Event::Step => self.step(machine),
            Event::Gone => self.go(machine),
        }
    }

    fn step(&mut self, machine: &mut Machine) {
        if self.paused {
            self.step_from = Some(machine.planner.status().exec_id);
            machine.inputs.stepping = true;
            machine.planner.resume();
        }
    }

    fn go(&mut self, machine: &mut Machine) {
        machine.planner.resume();
        if let Some(velocity) = self.slider {
            machine.planner.set_velocity_limit(velocity);
        }
        machine.inputs.feed_scale = 1.0;
        machine.inputs.rapid_scale = 1.0;
        machine.inputs.spindles_at_speed = true;
        machine.inputs.stepping = false;
        self.step_from = None;
        self.adaptive = 1.0;
    }

    /// Behind a single step the machine is paused again.
    pub fn end_step(&mut self, machine: &mut Machine) {
        let running = machine.planner.status().exec_id;
        if self.step_from.is_some_and(|from| from != running) {
            machine.planner.pause();
            machine.inputs.stepping = false;
            self.step_from = None;
        }
    }
}
