//! Programs as LinuxCNC's own interpreter reads them, with all digits.
//!
//! `rs274` prints the canonical calls of a program with four decimals, and the Python module
//! `gcode` passes on neither G64's tolerances nor the state tags. So this folder has a canon of
//! its own: a small C++ program (`interpreter/`), linked with LinuxCNC's interpreter library
//! (librs274) against LinuxCNC's headers, that prints each call with 17 digits. The build script
//! compiles it and puts it into the executable; it runs in a process of its own, from memory. Without
//! an INI file it has an empty file of numbered parameters and a tool table in which every number is
//! a tool without length and radius.
//!
//! [`call`] are the calls, [`interpreter`] runs a program, and [`refusal`] explains what it refuses;
//! [`surroundings`] are what it finds around it: INI file, [`parameters`], [`tool_table`]. [`seen_from`] moves the
//! calls to another zero.

pub mod call;
pub mod interpreter;
pub mod parameters;
mod refusal;
mod seen_from;
pub mod surroundings;
mod timed;
pub mod tool_table;

pub use call::{Call, Input};
pub use interpreter::{CallStream, CanonError, read_program, read_text, stream_program};
pub use seen_from::seen_from;
pub use surroundings::Surroundings;
