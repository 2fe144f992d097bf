//! `framepath check` as a user calls it.

mod bench;
mod findings;
mod left_out;
mod random;
mod samples;
mod text;
