//! Why a frame is refused.

/// Why a frame, or a part of one, cannot be used. The words for it are made where it is shown.
///
/// An `axis` is an index into [`AXIS_LETTERS`](crate::axes::AXIS_LETTERS).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameError {
    /// A number is infinite or not a number.
    NotFinite,
    /// A scale factor is zero (or so small that it became zero).
    ZeroScale {
        /// The axis with the factor.
        axis: usize,
    },
    /// A shift is beyond [`MAX_TRANSLATION`](crate::frame::affine::MAX_TRANSLATION).
    TranslationTooLarge {
        /// The axis that is shifted.
        axis: usize,
        /// The shift, machine units or degrees.
        value: f64,
    },
    /// The program alternates between scales and other operations more often than a list holds.
    TooManyOperations {
        /// How many groups of operations a list holds.
        capacity: usize,
    },
    /// ROTS without an angle.
    NoAngles,
    /// ROTS with three angles: two already define the plane.
    TooManyAngles,
    /// No plane meets the two planes of ROTS at these angles.
    ImpossibleSolidAngles {
        /// Angle of the first rotation, degrees.
        first: f64,
        /// Angle which the second rotation would have to form, degrees.
        second: f64,
    },
    /// The frame flattens space: it cannot be undone.
    Singular,
    /// Lengths in different directions change too unequally for an exact inverse.
    IllConditioned {
        /// Greatest over smallest scale.
        condition: f64,
    },
    /// The frame enlarges or shrinks too much to be meant.
    ScaleOutOfRange {
        /// Smallest scale in any direction.
        smallest: f64,
        /// Greatest scale in any direction.
        greatest: f64,
    },
    /// The axes said to be mirrored do not fit the map: an even number of mirrors keeps
    /// right-handed coordinates right-handed, an odd number does not.
    MirrorMismatch,
}
