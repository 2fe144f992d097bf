//! The path that the machine follows where it may leave the programmed one: G64.
//!
//! One mechanism rounds corners, smooths dense code and eases the way between lines and arcs. The
//! path is that of the program plus smooth functions of narrow support, one for each vertex:
//!
//! ```text
//! q(s) = p(s) + sum over vertices of turn * w * phi(|s - s_i| / w) + jump * ...
//! ```
//!
//! with s the arc length of the programmed path. Whatever the widths, second derivatives are
//! continuous, third derivatives jump only where those of the program do at the ends of arcs, and
//! kernels may overlap any number of vertices: then they average out the rounding of coordinates.
//! The tolerance is kept by evaluation of q - p, not by a search for the nearest point. As s is the
//! distance of the program, the number of the running move and the distance to go are monotone,
//! and every q(s) belongs to one move.
//!
//! The order of the parts: a move becomes a `leg`, short lines after the `line_merger` has joined
//! them; legs meet in a `vertex` and lie in a `chain`; the `chooser` gives the vertices of a
//! `window` their widths, beginning with the `base_width`; the `deviation` is checked, and
//! `hardening` stands behind it all. [`BlendedPath`] is what the rest of the planner sees.

mod base_width;
mod blended_path;
mod chain;
mod chooser;
mod deviation;
mod easement;
mod error;
mod hardening;
mod kernel;
mod leg;
mod line_merger;
mod metric;
mod settings;
mod vertex;
mod window;

pub use blended_path::{BlendedPath, LegView, Progress, VertexView};
pub use chooser::GREATEST_EXCESS;
pub use error::BlendError;
pub use leg::ProgrammedMove;
pub use settings::BlendSettings;
