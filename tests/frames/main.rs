//! Frames, machines and what framekins does with them.

mod common;
mod control;
mod guard;
mod inner_kinematics;
mod inner_tool;
mod inner_types;
mod machine_control;
mod machine_kinematics;
mod properties;
mod retraction;
mod sinumerik;
mod tool;
