//! The path that the machine follows where it may leave the programmed one: G64.
//!
//! One mechanism rounds corners, smooths dense code and eases the way between lines and arcs. The
//! path is that of the program plus smooth functions of narrow support, one for each vertex:
//!
//! ```text
//! q(s) = p(s) + sum over vertices of tangent_jump * w * phi(|s - s_i| / w) + curvature_jump * ...
//! ```
//!
//! with s the arc length of the programmed path. Whatever the widths, second derivatives are
//! continuous, third derivatives jump only where those of the program do at the ends of arcs, and
//! kernels may overlap any number of vertices: then they average out the rounding of coordinates.
//! The tolerance is kept by evaluation of q - p, not by a search for the nearest point. As s is the
//! distance of the program, the number of the running move and the distance to go are monotone,
//! and every q(s) belongs to one move.
//!
//! What may be changed depends on the mode:
//!
//! - G64 P: everything within P. A corner that stands alone uses all of it, with a kernel that is
//!   flat where acceleration limits the speed in it and peaked where jerk does, and swings out to use
//!   it on the outer side as well.
//! - G64 without P: every move is touched. A corner is rounded as wide as its slower feed needs,
//!   by acceleration and jerk, up to half of the shorter move (on an arc up to a radian), without
//!   a tolerance. Where that is not enough to keep the feed, as in dense code, kernels may be wider
//!   as long as they leave what is so rounded by no more than the default tolerance.
//! - G61: nothing at a corner, where the machine stops. Where moves meet in a tangent (a hundredth
//!   of a radian, for the rounding of coordinates) it passes without a stop: an easement leaves the
//!   program by no more than a micrometre on either side of the point and by nothing in it, a
//!   remaining turn of the direction by less than half of that.
//!
//! The order of the parts: a move becomes a `leg`, short ones after the `line_merger` has joined
//! them; `fairing` moves runs of lines a little off the program, a `shift`; legs meet in a `vertex` and lie in a `chain`, with
//! the `contribution` of each vertex to the path; the `optimizer` gives the vertices of a
//! `window` their `widths`, beginning with the `base_width` (at `equal_widths` of all that overlap), on a `curve` for what it allows, and a
//! `lone_corner` swings out, and one of `unlike_axes` stands alone; the
//! `deviation` is checked, what is to `blame` is narrowed, and `hardening` stands behind it all.
//! [`BlendedPath`] is what the rest of the planner sees.

mod base_width;
mod blame;
mod blended_path;
mod chain;
mod chords;
mod coarse_curve;
mod contribution;
mod curve;
mod deviation;
mod easement;
mod equal_widths;
mod error;
mod fairing;
mod hardening;
mod jump;
mod kernel;
mod kernel_lanes;
mod leg;
mod leg_check;
mod legs_and_vertices;
mod line_merger;
mod linear_axes;
mod lone_corner;
mod metric;
mod narrowed;
mod nearly_linear;
mod orientation;
mod path_sums;
mod reaching;
mod reversal;
mod settings;
mod shift;
mod shrinkage;
mod tapering;
mod trial_kernel;
mod unlike_axes;
mod vertex;
mod vertex_widths;
mod views;
mod width_optimizer;
mod widths;
mod window;

pub use blended_path::BlendedPath;
pub use error::BlendError;
pub use leg::ProgrammedMove;
pub use orientation::{GREATEST_TURN, Orientation};
pub use settings::BlendSettings;
pub use views::{LegView, MoveProgress, VertexView};
pub use width_optimizer::GREATEST_EXCESS;
