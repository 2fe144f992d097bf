//! Tests of `framepath filter` as a user runs it.

mod contours;
mod errors;
mod expected;
mod fagor;
mod language;
mod linuxcnc;
mod output;
mod robustness;
mod shop;
mod simulator;
mod sinumerik_forms;
