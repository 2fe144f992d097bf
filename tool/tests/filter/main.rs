//! Tests of `framepath filter` as a user runs it.

mod contours;
mod errors;
mod language;
mod linuxcnc;
mod output;
mod robustness;
mod shop;
