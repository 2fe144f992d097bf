//! Tests of `framepath filter` as a user runs it.

mod contours;
mod encodings;
mod errors;
mod expected;
mod fagor;
mod front_end;
mod language;
mod linuxcnc;
mod one_error;
mod output;
mod pieces;
mod random;
mod robustness;
mod rs274;
mod shop;
mod simulator;
mod sinumerik_cycles;
mod sinumerik_forms;
mod spindle;
