//! The spindle of the plan: it has its commanded speed at once.

use crate::layer::spindle::SpindleCommand;
use crate::machine::IniError;
use crate::machine::ini::Ini;
use framepath::planner::{SpindleInputs, Status};

/// The speeds that the INI file allows, turns a minute, in either direction the least and the greatest.
#[derive(Clone, Copy, Debug)]
pub struct SpeedLimits {
    forward: [f64; 2],
    reverse: [f64; 2],
}

impl Default for SpeedLimits {
    /// Any.
    fn default() -> Self {
        SpeedLimits {
            forward: [0.0, f64::INFINITY],
            reverse: [0.0, f64::INFINITY],
        }
    }
}

impl SpeedLimits {
    /// Of the first spindle; what is said of forward only holds in reverse, too, as in LinuxCNC.
    ///
    /// # Errors
    /// A value that is no number.
    pub fn from_ini(ini: &Ini) -> Result<SpeedLimits, IniError> {
        let mut limits = SpeedLimits::default();
        for (index, forward, reverse) in [
            (0, "MIN_FORWARD_VELOCITY", "MIN_REVERSE_VELOCITY"),
            (1, "MAX_FORWARD_VELOCITY", "MAX_REVERSE_VELOCITY"),
        ] {
            if let Some(speed) = ini.number("SPINDLE_0", forward)? {
                limits.forward[index] = speed;
                limits.reverse[index] = speed;
            }
            if let Some(speed) = ini.number("SPINDLE_0", reverse)? {
                limits.reverse[index] = speed.abs();
            }
        }
        Ok(limits)
    }

    /// The speed that comes out where this one is asked for, turns a minute, negative in reverse.
    fn apply(&self, speed: f64) -> f64 {
        let [least, greatest] = match speed < 0.0 {
            true => self.reverse,
            false => self.forward,
        };
        if speed == 0.0 {
            return speed;
        }
        speed.abs().max(least).min(greatest).copysign(speed)
    }
}

/// A spindle that turns as it is told.
#[derive(Clone, Copy, Debug)]
pub struct Spindle {
    limits: SpeedLimits,
    command: SpindleCommand,
    /// Turns a second as commanded at the end of the last period, negative in reverse.
    speed: f64,
    /// Commanded by the program to turn in reverse; what a tap does is no change of it.
    reverse: bool,
    /// Turns since the start.
    turns: f64,
    /// Where the encoder's count is 0.
    zero: f64,
    awaits_index: bool,
    /// The least and the greatest speed with a constant surface speed, turns a minute.
    surface_speeds: Option<[f64; 2]>,
}

impl Spindle {
    /// One that stands, whose speed has these limits.
    pub fn new(limits: SpeedLimits) -> Spindle {
        Spindle {
            limits,
            command: SpindleCommand::default(),
            speed: 0.0,
            reverse: false,
            turns: 0.0,
            zero: 0.0,
            awaits_index: false,
            surface_speeds: None,
        }
    }

    /// What the program commands.
    pub(super) fn command(&mut self, command: SpindleCommand) {
        self.command = SpindleCommand {
            speed: self.limits.apply(command.speed),
            ..command
        };
        if command.speed != 0.0 {
            self.reverse = command.speed < 0.0;
        }
    }

    /// One servo period, seconds. The index is at whole turns.
    pub fn turn(&mut self, period: f64) -> SpindleInputs {
        let before = self.turns;
        self.turns += self.speed * period;
        if self.awaits_index && before.floor() != self.turns.floor() {
            self.zero = before.floor().max(self.turns.floor());
            self.awaits_index = false;
        }
        SpindleInputs {
            turns: self.turns - self.zero,
            speed: self.speed,
            commanded: self.command.speed.abs() / 60.0,
            reverse: self.reverse,
            awaits_index: self.awaits_index,
        }
    }

    /// What the planner asks of it after a period, with the machine at this X, mm.
    pub fn obey(&mut self, status: &Status, x: f64) {
        if status.index_request == Some(0) {
            self.awaits_index = true;
        }
        if let Some((0, factor)) = status.spindle_factor {
            self.command.speed *= factor;
        }
        self.follow(x);
        if self.command.surface.is_some() && self.speed != 0.0 && !status.done {
            let speed = 60.0 * self.speed.abs();
            let [least, greatest] = self.surface_speeds.unwrap_or([speed; 2]);
            self.surface_speeds = Some([least.min(speed), greatest.max(speed)]);
        }
    }

    /// Its speed from here on, with the machine at this X, mm.
    fn follow(&mut self, x: f64) {
        self.speed = self.limits.apply(self.command.at(x)) / 60.0;
    }

    /// Turns a second, whatever the direction.
    pub fn speed(&self) -> f64 {
        self.speed.abs()
    }

    /// The least and the greatest speed in motion with a constant surface speed, turns a minute.
    pub fn surface_speeds(&self) -> Option<[f64; 2]> {
        self.surface_speeds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning(speed: f64, limits: SpeedLimits) -> Spindle {
        let mut spindle = Spindle::new(limits);
        let surface = None;
        spindle.command(SpindleCommand { speed, surface });
        spindle.follow(0.0);
        spindle
    }

    #[test]
    fn the_index_sets_the_count_to_zero() {
        let mut spindle = turning(-600.0, SpeedLimits::default());
        for _ in 0..250 {
            spindle.turn(0.001);
        }
        spindle.awaits_index = true;
        let mut inputs = spindle.turn(0.001);
        while inputs.awaits_index {
            inputs = spindle.turn(0.001);
        }
        assert!(inputs.reverse && inputs.turns <= 0.0 && inputs.turns > -0.02);
    }

    #[test]
    fn the_ini_file_limits_the_speed() {
        let limits = SpeedLimits {
            forward: [120.0, 1200.0],
            reverse: [0.0, 600.0],
        };
        for (asked, found) in [
            (0.0, 0.0),
            (60.0, 120.0),
            (900.0, 900.0),
            (5000.0, 1200.0),
            (-60.0, -60.0),
            (-900.0, -600.0),
        ] {
            let mut spindle = turning(asked, limits);
            assert_eq!(spindle.turn(1.0).speed * 60.0, found, "{asked}");
        }
    }
}
