//! Variables of the control, #1000 and up: those whose values the program itself has set can be read.
//! (Fanuc, Series 30i, User's Manual, "Custom macro: system variables".)

use super::interpreter::Interpreter;
use super::values::{Lookup, Reading};
use super::variables::{Place, place};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::program::{Action, Compensation, FeedMode, Plane};
use crate::source::Span;

impl Lookup for Interpreter<'_> {
    fn read(&self, number: f64, span: Span) -> Reading {
        match place(number, span)? {
            Place::System(number) => self.system_variable(number, span).map(Some),
            place => self.variables.get(place, span),
        }
    }
}

impl Interpreter<'_> {
    fn system_variable(&self, number: u32, span: Span) -> Result<f64, Diagnostic> {
        let modal = &self.control.modal;
        let known = match number {
            4001 => modal.motion.map(|motion| match motion {
                Motion::Rapid => 0.0,
                Motion::Line => 1.0,
                Motion::Clockwise => 2.0,
                Motion::Counterclockwise => 3.0,
            }),
            4002 => Some(match modal.plane {
                Plane::Xy => 17.0,
                Plane::Zx => 18.0,
                Plane::Yz => 19.0,
            }),
            4003 => Some(if modal.incremental { 91.0 } else { 90.0 }),
            4005 => Some(match modal.feed_mode {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            }),
            4006 => Some(if self.inch { 20.0 } else { 21.0 }),
            4007 => Some(match modal.compensation {
                Compensation::Off => 40.0,
                Compensation::Left => 41.0,
                Compensation::Right => 42.0,
            }),
            4008 => self
                .offsets
                .length_on
                .map(|on| if on { 43.0 } else { 49.0 }),
            4009 => Some(
                self.cycle
                    .as_ref()
                    .map_or(80.0, |cycle| f64::from(cycle.code) / 10.0),
            ),
            4010 => Some(if self.to_return_level { 99.0 } else { 98.0 }),
            4012 => Some(if self.modal_macro.is_some() {
                66.0
            } else {
                67.0
            }),
            4014 => self.work_offset,
            4107 => self.offsets.radius_row.map(f64::from),
            4109 => modal.feed.map(|feed| feed / modal.feed_factor),
            4111 => self.offsets.length_row.map(f64::from),
            4119 => modal.spindle_speed,
            4120 => self.tool,
            // Where the tool is, and with the compensation of its length and radius.
            5041..=5049 if self.is_compensated() => return Err(compensated(number, span)),
            5001..=5009 | 5041..=5049 if modal.frame.is_empty() => {
                self.control.present((number % 10) as usize - 1)
            }
            _ => None,
        };
        known.ok_or_else(|| unknown(number, span))
    }

    fn is_compensated(&self) -> bool {
        self.offsets.length_on == Some(true) || self.control.modal.compensation != Compensation::Off
    }

    /// Gives any variable a value.
    pub(super) fn assign(
        &mut self,
        number: f64,
        value: Option<f64>,
        span: Span,
        text: &str,
    ) -> Done {
        let number = match place(number, span)? {
            Place::System(number) => number,
            place => return self.variables.set(place, value, span),
        };
        match number {
            3000 => Err(Diagnostic::error(
                span,
                format!(
                    "the program stops itself here with alarm {}: {text}",
                    value.unwrap_or(0.0)
                ),
            )
            .help("the values that lead here are in the program or were given with --set")),
            3006 => {
                if !text.is_empty() {
                    self.control.actions.push(Action::Message(text.to_string()));
                }
                self.control.pause(false, span, "#3006")
            }
            // The clock of milliseconds, that of hours, and what the operator may switch.
            3001..=3004 => {
                self.control.note(&format!("#{number}"), span);
                Ok(())
            }
            _ => Err(
                Diagnostic::error(span, format!("#{number} cannot be assigned")).help(
                    "offsets and tools are set at the machine; #3000 raises an alarm, #3006 stops \
                     with a message",
                ),
            ),
        }
    }
}

fn compensated(number: u32, span: Span) -> Diagnostic {
    Diagnostic::error(
        span,
        format!("#{number} while G43, G41 or G42 is in force: it has the length and the radius of the tool"),
    )
    .help(format!(
        "read #{}, the end of the block as it is programmed, or write G49 and G40 before",
        number - 40
    ))
}

fn unknown(number: u32, span: Span) -> Diagnostic {
    let reason = match number {
        2001..=2999 | 10_001..=19_999 => "tools are measured at the machine",
        3001 | 3002 | 3011 | 3012 => "time passes while the program runs",
        5001..=5009 | 5041..=5049 => {
            "program the axis absolute before; under G51, G51.1, G68 and G68.2 it cannot be read"
        }
        5021..=5029 | 5061..=5069 => {
            "where the machine or a probe is, is not known ahead of time: write the coordinates"
        }
        5201..=5349 | 7001..=7999 => "work offsets are set at the machine",
        4001 | 4008 | 4014 | 4107 | 4109 | 4111 | 4119 | 4120 => "program it before it is read",
        4001..=4130 => {
            "of the modes #4001 to #4003, #4005 to #4010, #4012 and #4014 can be read, of the words #4107 (D), #4109 \
             (F), #4111 (H), #4119 (S) and #4120 (T): write its value instead"
        }
        _ => "write its value instead, or a variable with --set '#500=VALUE'",
    };
    Diagnostic::error(span, format!("#{number} cannot be evaluated ahead of time")).help(reason)
}
