//! Tests of `framepath filter` for programs of ISG kernels (TwinCAT CNC) and of MEFI controls.

mod errors;
mod examples;
#[path = "../filter/front_end.rs"]
mod front_end;
mod isg;
mod linuxcnc;
mod machine;
mod mefi;
#[path = "../filter/one_error.rs"]
mod one_error;
mod path;
mod random;
mod robustness;
#[path = "../filter/rs274.rs"]
mod rs274;
mod shared_words;
mod shop;
mod silence;
mod spindle;
