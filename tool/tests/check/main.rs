//! `framepath check` and `framepath configure` as a user calls them.

mod above_joints;
mod bench;
mod configure;
mod configure_includes;
mod configure_limits;
mod configure_refusals;
mod configure_twopass;
#[path = "../common/fields.rs"]
mod fields;
mod findings;
mod frames_of_machines;
mod hal_values;
mod inner;
mod installed_elsewhere;
mod left_out;
mod modules;
mod not_starting;
mod panel;
mod random;
mod samples;
mod subroutine_files;
mod text;
