//! The look-ahead: what it keeps, and how near it comes to the least time.

mod jumps;
mod limits;
mod routes;
mod time;
