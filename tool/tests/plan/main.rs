//! `framepath plan` as its users run it.

mod arrivals;
mod errors;
mod figures;
mod files;
mod long_programs;
mod page;
mod support;
