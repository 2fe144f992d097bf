//! Shapes of the path and its rates: [`segment`]s in the nine axes of the machine, [`pieces`] of a
//! programmed contour, velocity, acceleration and jerk as [`rates`] of recorded positions and as
//! [`differences`] of positions that go by; the way [`between`] two of them; what counts as [`exceeded`].

pub(crate) mod between;
#[cfg(feature = "linuxcnc")]
pub(crate) mod differences;
#[cfg(feature = "linuxcnc")]
pub(crate) mod exceeded;
pub(crate) mod pieces;
pub(crate) mod rates;
#[cfg(feature = "linuxcnc")]
pub(crate) mod segment;

/// Position of the nine axes x y z a b c u v w, in millimetres and degrees of the machine.
#[cfg(feature = "linuxcnc")]
pub type Position = [f64; 9];
