//! Programmable frames: shifts, rotations, scales and mirrors that a part program lays over the
//! work offset (TRANS, ROT, ROTS, SCALE, MIRROR and their relatives in other dialects).
//!
//! A program position `p` (tip of the tool, in coordinates of the work offset) becomes the position
//! of the tip on the machine by
//!
//! ```text
//! tip = W ( F ( p ) )      W: the work offset      F: the programmable frame
//! ```
//!
//! The way through this folder: an [`Operation`] is one command, an [`OperationList`] what the
//! program has built up from them, a [`ProgrammableFrame`] the checked map they fold into, and an
//! [`ActiveFrame`] that map joined with [`WorkOffset`] and tool, ready for the servo thread.
//! Everything is checked while it is built; applying an [`ActiveFrame`] cannot fail.

pub mod active;
pub mod affine;
pub mod angle;
pub mod error;
pub mod matrix;
pub mod operation;
pub mod operation_list;
pub mod plane;
pub mod programmable;
pub mod rotation;
pub mod singular_values;
pub mod work_offset;

pub use active::{ActiveFrame, ToolLength};
pub use affine::AffineMap;
pub use error::FrameError;
pub use operation::{Operation, OperationKind};
pub use operation_list::OperationList;
pub use plane::{Handedness, LinearAxis, Plane};
pub use programmable::ProgrammableFrame;
pub use rotation::RotsConvention;
pub use work_offset::WorkOffset;
