//! The path and its blends.

mod common;
mod modes;
mod random;
mod shapes;
mod tool_axis;
