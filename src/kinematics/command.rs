//! The commands of a program: what the numbers on the pins mean.

use nalgebra::Vector3;

use super::refusal::FrameRefusal;
use crate::frame::{LinearAxis, Operation, OperationList, RotsConvention};

/// A command's number counts in these; what is left is its code.
const NUMBER_STEP: f64 = 1000.0;

/// Added to the code of a command that adds to the frame instead of replacing it.
const ADDITIVE: i32 = 100;

/// What a command is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Code {
    /// Makes the frame of one operation, the number of its kind.
    Set(i32),
    /// Removes the frame, which needs no values and is never wrong.
    Remove,
    /// Drops the scales of the frame.
    DropScales,
    /// Takes over offsets, tool and dimensions; a frame that is suspended comes back.
    Refresh,
    /// Makes the frame of the map pins.
    MapPins,
    /// Suspends the frame.
    Suspend,
    /// Asks how the tool is turned.
    Ask,
    /// Takes over offsets, tool and dimensions, and brings nothing back.
    TakeOver,
    /// Adds one operation to the frame, the number of its kind.
    Add(i32),
    /// Nonsense.
    Unknown,
}

impl Code {
    /// The code that a number says, 0 to 999.
    fn of(number: f64) -> Self {
        let whole = number as i32;
        if f64::from(whole) != number {
            return Self::Unknown;
        }
        match whole {
            1..=8 => Self::Set(whole),
            9 => Self::Remove,
            10 => Self::DropScales,
            11 => Self::Refresh,
            12 => Self::MapPins,
            13 => Self::Suspend,
            14 => Self::Ask,
            15 => Self::TakeOver,
            _ if whole > ADDITIVE => Self::Add(whole - ADDITIVE),
            _ => Self::Unknown,
        }
    }
}

/// A command as it stands on `framekins.command`: its number times 1000, plus its code.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// Changes from command to command, so that the same command can be given twice.
    pub number: f64,
    /// What to do.
    code: Code,
}

impl Command {
    /// The command that a pin says, `None` for what cannot be one: nothing was sent yet (0), or it is
    /// negative, infinite or not a number.
    pub fn on_pin(value: f64) -> Option<Self> {
        let number = (value / NUMBER_STEP).floor();
        (number.is_finite() && number > 0.0).then_some(Self {
            number,
            code: Code::of(value - number * NUMBER_STEP),
        })
    }

    /// Whether the frame is removed, which needs no values and is never wrong.
    pub fn removes(&self) -> bool {
        self.code == Code::Remove
    }

    /// Whether the program wants to know how the kinematics of another module turn the tool, also without a frame.
    pub fn asks(&self) -> bool {
        self.code == Code::Ask
    }

    /// Whether it acts in the frame that is active, and keeps what that is made of.
    pub fn adds(&self) -> bool {
        matches!(self.code, Code::DropScales | Code::Add(_))
    }

    /// Whether it changes neither what the frame is made of nor whether it is suspended.
    pub fn keeps(&self) -> bool {
        matches!(self.code, Code::Ask | Code::TakeOver)
    }

    /// Whether the machine is to run without the frame for a while: what the frame is made of stays,
    /// and a command of its own brings it back.
    pub fn suspends(&self) -> bool {
        self.code == Code::Suspend
    }
}

/// What F is made of.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// Operations of a program.
    list: OperationList,
    /// How many commands they were.
    commands: i32,
    /// The map pins instead.
    map: bool,
}

impl Source {
    /// No frame.
    pub fn nothing() -> Self {
        Self {
            list: OperationList::new(),
            commands: 0,
            map: false,
        }
    }

    /// The map pins.
    pub fn map_pins() -> Self {
        Self {
            map: true,
            ..Self::nothing()
        }
    }

    /// The operations, `None` if the map pins are meant.
    pub fn operations(&self) -> Option<&OperationList> {
        (!self.map).then_some(&self.list)
    }

    /// How many operations the operator is shown.
    pub fn count(&self) -> i32 {
        if self.map { 1 } else { self.commands }
    }

    /// What F is made of after a command with its values. A map from the pins cannot be added to:
    /// an additive command behind it starts anew.
    ///
    /// # Errors
    ///
    /// What is wrong with the command.
    pub fn after(&self, command: &Command, values: &[f64; 3]) -> Result<Self, FrameRefusal> {
        let mut next = if self.map { Self::nothing() } else { *self };
        match command.code {
            Code::Remove => return Ok(Self::nothing()),
            Code::DropScales => {
                next.list.drop_scales()?;
                if next.list.is_empty() {
                    return Ok(Self::nothing());
                }
            }
            Code::Refresh | Code::Suspend | Code::Ask | Code::TakeOver => return Ok(*self),
            Code::MapPins => return Ok(Self::map_pins()),
            Code::Add(kind) => {
                next.list.append(&operation(kind, values)?)?;
                next.commands = next.commands.saturating_add(1);
            }
            Code::Set(kind) => {
                next.list.set(&operation(kind, values)?);
                next.commands = 1;
            }
            Code::Unknown => return Err(FrameRefusal::UnknownCommand),
        }
        Ok(next)
    }
}

/// The operation of a kind with its values.
fn operation(kind: i32, values: &[f64; 3]) -> Result<Operation, FrameRefusal> {
    if values.iter().any(|value| !value.is_finite()) {
        return Err(FrameRefusal::NotFinite);
    }
    let [a, b, c] = *values;
    let vector = Vector3::new(a, b, c);
    Ok(match kind {
        1 => Operation::translate(vector)?,
        2 => Operation::rotate_zyx(vector)?,
        3 => Operation::rotate(axis(b)?, a)?,
        4 => Operation::rotate_solid_angles(Some(a), Some(b), None, convention(c)?)?,
        5 => Operation::rotate_solid_angles(Some(b), None, Some(a), convention(c)?)?,
        6 => Operation::rotate_solid_angles(None, Some(a), Some(b), convention(c)?)?,
        7 => Operation::scale(vector)?,
        8 => Operation::mirror([a != 0.0, b != 0.0, c != 0.0]),
        _ => return Err(FrameRefusal::UnknownCommand),
    })
}

/// 0 is X, 1 is Y, 2 is Z.
fn axis(number: f64) -> Result<LinearAxis, FrameRefusal> {
    match number {
        0.0 => Ok(LinearAxis::X),
        1.0 => Ok(LinearAxis::Y),
        2.0 => Ok(LinearAxis::Z),
        _ => Err(FrameRefusal::UnknownCommand),
    }
}

/// 0 is the first convention for ROTS, 1 the second.
fn convention(number: f64) -> Result<RotsConvention, FrameRefusal> {
    match number {
        0.0 => Ok(RotsConvention::Seed),
        1.0 => Ok(RotsConvention::K2),
        _ => Err(FrameRefusal::UnknownCommand),
    }
}
