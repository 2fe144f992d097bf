//! framepath: the command line tool.

fn main() {}
