//! Tests of `framepath filter` for programs of ISG kernels (TwinCAT CNC) and of MEFI controls.

mod errors;
mod examples;
mod isg;
mod linuxcnc;
mod machine;
mod mefi;
mod path;
mod random;
mod robustness;
mod shop;
mod silence;
