//! The spindle: what the canonical layer makes of its calls, and which speed the motion controller commands.
//!
//! Behaviour read in LinuxCNC 2.9 (`emccanon.cc`, `motion/command.c`, `motion/control.c`).

use super::Layer;
use super::program::Operation;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Constant surface speed (G96).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Surface {
    /// Of the work under the tool, mm a minute, negative in reverse.
    pub speed: f64,
    /// Where the work turns about: X of the machine, mm.
    pub centre: f64,
}

/// What the motion controller is told of the spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpindleCommand {
    /// Turns a minute, negative in reverse, 0 for off; with a constant surface speed the greatest.
    pub speed: f64,
    pub surface: Option<Surface>,
}

impl SpindleCommand {
    /// Turns a minute that are commanded with the machine at this X, mm.
    pub(crate) fn at(&self, x: f64) -> f64 {
        let Some(surface) = self.surface else {
            return self.speed;
        };
        let radius = (surface.centre - x).abs();
        if radius > 0.0 {
            let most = self.speed.abs();
            (surface.speed / (TAU * radius)).clamp(-most, most)
        } else {
            self.speed
        }
    }
}

/// The spindle as far as the program has come.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spindle {
    /// S: turns a minute, or mm a minute where `greatest` is not 0.
    speed: f64,
    /// 1 clockwise, -1 counter-clockwise, 0 off.
    direction: i32,
    /// Turns a minute at most with a constant surface speed; 0 without.
    greatest: f64,
    /// X, mm.
    centre: f64,
    /// The speed that was commanded last depends on X.
    follows_x: bool,
}

impl Spindle {
    fn command(&self) -> SpindleCommand {
        let forth = f64::from(self.direction);
        if self.greatest == 0.0 {
            return SpindleCommand {
                speed: forth * self.speed,
                surface: None,
            };
        }
        SpindleCommand {
            speed: forth * self.greatest,
            surface: Some(Surface {
                speed: forth * self.speed,
                centre: self.centre,
            }),
        }
    }
}

impl Layer<'_> {
    /// How S counts from here on. Nothing is commanded before the next S, M3 or M4.
    pub(super) fn surface(&mut self, greatest: f64, centre: f64) {
        self.spindle.greatest = greatest;
        self.spindle.centre = centre;
    }

    /// M3, M4 or M5.
    pub(super) fn switch_spindle(&mut self, speed: f64, direction: i32) {
        self.spindle.direction = direction;
        if direction == 0 {
            self.spindle.speed = speed;
            self.command_spindle();
        } else {
            self.spindle_speed(speed);
        }
    }

    /// S.
    pub(super) fn spindle_speed(&mut self, speed: f64) {
        self.spindle.speed = speed;
        let turns = self.spindle.direction != 0;
        self.spindle.follows_x = turns && self.spindle.greatest != 0.0;
        self.command_spindle();
        // With each new speed the next move at feed waits for it: not one that merging has held back.
        self.at_speed_next |= turns;
    }

    fn command_spindle(&mut self) {
        self.wait();
        let command = self.spindle.command();
        self.builder.operation(Operation::Spindle(command));
    }

    /// Behind a rapid the diameter is another one: the next move at feed waits for the spindle.
    pub(super) fn await_new_diameter(&mut self) {
        self.at_speed_next |= self.spindle.follows_x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_follows_the_diameter_up_to_the_greatest() {
        let forth = SpindleCommand {
            speed: 2500.0,
            surface: Some(Surface {
                speed: 240_000.0,
                centre: 5.0,
            }),
        };
        // 240 m/min at a diameter of 40 mm, on either side
        for x in [25.0, -15.0] {
            assert!((forth.at(x) - 1_909.859_317).abs() < 1e-6);
        }
        assert_eq!((forth.at(6.0), forth.at(5.0)), (2500.0, 2500.0));
        let back = SpindleCommand {
            speed: -2500.0,
            surface: forth.surface.map(|surface| Surface {
                speed: -surface.speed,
                ..surface
            }),
        };
        assert_eq!((back.at(6.0), back.at(5.0)), (-2500.0, -2500.0));
        assert!((back.at(25.0) + 1_909.859_317).abs() < 1e-6);
    }
}
