//! Why a frame does not take effect: the numbers that operators see.

use crate::frame::FrameError;

/// Why a frame was refused. The numbers are those of the pin `framekins.refusal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum FrameRefusal {
    /// The code of the command is not one of those there are.
    UnknownCommand = 1,
    /// A value is infinite or not a number.
    NotFinite = 2,
    /// A scale factor is zero.
    ZeroScale = 3,
    /// A shift is too large to be meant.
    TranslationTooLarge = 4,
    /// The program adds more operations than there is room for.
    TooManyOperations = 5,
    /// No plane meets the two angles.
    ImpossibleAngles = 6,
    /// The frame flattens space.
    Singular = 7,
    /// The scales of the frame are too unequal.
    IllConditioned = 8,
    /// The frame enlarges or shrinks too much.
    ScaleOutOfRange = 9,
    /// The machine moves.
    Moving = 10,
    /// Motion is in teleop mode, in which a switch would make the joints jump.
    Teleop = 11,
    /// Motion did not switch: motion.switchkins-type is not linked.
    NotSwitched = 12,
    /// Motion asked for a slot other than 0, 1 and 2.
    UnknownType = 13,
    /// The frame moves an axis X, Y or Z that the machine does not have.
    MissingAxis = 14,
    /// A dimension of the machine is infinite, not a number, or too large to be meant.
    MachineParameters = 15,
    /// The values on the pins are not those that the command was sent with.
    WrongCheck = 16,
    /// Nobody would remove the frame again.
    Unguarded = 17,
    /// The inner kinematics do not have this type.
    UnknownInnerType = 18,
    /// The inner kinematics lead back from where the machine is to other joints.
    OtherJoints = 19,
    /// The command adds to a frame that is suspended.
    Suspended = 20,
    /// External offsets move the axes.
    OffsetsMove = 21,
    /// A pin is not the external offset of its axis.
    UnknownOffset = 22,
}

impl From<FrameError> for FrameRefusal {
    fn from(error: FrameError) -> Self {
        match error {
            FrameError::NotFinite => Self::NotFinite,
            FrameError::ZeroScale { .. } => Self::ZeroScale,
            FrameError::TranslationTooLarge { .. } => Self::TranslationTooLarge,
            FrameError::TooManyOperations { .. } => Self::TooManyOperations,
            FrameError::NoAngles
            | FrameError::TooManyAngles
            | FrameError::ImpossibleSolidAngles { .. } => Self::ImpossibleAngles,
            FrameError::Singular | FrameError::MirrorMismatch => Self::Singular,
            FrameError::IllConditioned { .. } => Self::IllConditioned,
            FrameError::ScaleOutOfRange { .. } => Self::ScaleOutOfRange,
        }
    }
}
