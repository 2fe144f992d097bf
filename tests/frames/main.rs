//! Frames, machines and what framekins does with them.

mod common;
mod control;
mod guard;
mod machine_control;
mod machine_kinematics;
mod properties;
mod sinumerik;
mod tool;
