//! What a program writes into the settable offsets: they act, as on the control, from the next G54 to G599
//! on, and are kept.

use super::interpreter::Interpreter;
use super::syntax::{OffsetPart, SettableOffset};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::program::{Action, SystemValues};

/// The turn about Z.
const ABOUT_Z: usize = 2;

impl Interpreter<'_> {
    /// `$P_UIFR[..] = ..`.
    pub(super) fn settable_offset(&mut self, offset: &SettableOffset) -> Done {
        let number = offset.number.whole(&self.variables, 0)?;
        let Some(system) = u8::try_from(number).ok().filter(|n| (1..=9).contains(n)) else {
            return Err(Diagnostic::error(
                offset.span,
                format!("LinuxCNC has no work offset for $P_UIFR[{number}]"),
            )
            .help("1 to 4 are G54 to G57, 5 to 9 are G505 to G509"));
        };
        let mut values = SystemValues {
            system,
            axes: [None; 9],
            rotation: None,
        };
        if offset.replaces {
            values.axes[..3].fill(Some(0.0));
            values.rotation = Some(0.0);
        }
        for (part, list) in &offset.parts {
            // What stands before a part of the chain turns it.
            let turned = values.rotation.unwrap_or(0.0);
            for (axis, value) in list {
                let value = value.number(&self.variables)?;
                match part {
                    OffsetPart::Rotation if *axis == ABOUT_Z => {
                        values.rotation = Some(turned + value);
                    }
                    OffsetPart::Rotation if value == 0.0 => {}
                    OffsetPart::Rotation => {
                        return Err(Diagnostic::error(
                            offset.span,
                            "a settable offset that turns about X or Y",
                        )
                        .help("LinuxCNC's work offsets turn about Z: turn the frame with ROT"));
                    }
                    OffsetPart::Fine if !offset.replaces => {
                        return Err(Diagnostic::error(
                            offset.span,
                            "the fine part of a settable offset alone: LinuxCNC has one value",
                        )
                        .help("set the whole: $P_UIFR[1]=CTRANS(..):CFINE(..)"));
                    }
                    _ => {
                        let factor = match axis {
                            3..6 => 1.0,
                            _ => self.control.modal.length_factor,
                        };
                        add_shift(&mut values.axes, *axis, value * factor, turned);
                    }
                }
            }
        }
        self.control
            .refuse_compensation(offset.span, "a work offset is set")?;
        self.waiting_offsets.push(values);
        // One that is not in use can be set at once.
        if self.system.is_some_and(|active| active != system) {
            self.set_offsets();
        }
        Ok(())
    }

    /// Sets the offsets that wait for the next G54 to G599.
    pub(super) fn set_offsets(&mut self) {
        for values in std::mem::take(&mut self.waiting_offsets) {
            let values = Box::new(values);
            self.control.actions.push(Action::SystemValues(values));
        }
    }
}

/// Adds a shift along an axis that is turned by this angle about Z, degrees.
fn add_shift(axes: &mut [Option<f64>; 9], axis: usize, value: f64, turned: f64) {
    let mut add = |axis: usize, value: f64| {
        axes[axis] = Some(axes[axis].unwrap_or(0.0) + value);
    };
    if axis > 1 || turned == 0.0 {
        return add(axis, value);
    }
    let (sin, cos) = turned.to_radians().sin_cos();
    add(axis, value * cos);
    match axis {
        0 => add(1, value * sin),
        _ => add(0, -value * sin),
    }
}
