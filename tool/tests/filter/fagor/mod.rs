//! Programs of the Fagor dialect.

mod cycles;
mod errors;
mod irregular_pockets;
mod language;
mod lathe;
mod moves;
mod pockets;
mod random;
mod seeds;
mod spindle;
mod threads;
mod tools;

use crate::shop::{Shop, accepted, commands, refused};

/// The commands that the filter writes for a program.
fn translate(program: &str, arguments: &[&str]) -> Vec<String> {
    let shop = Shop::new(&[("part.pim", program.as_bytes())]);
    commands(&accepted(&shop.run_in("fagor", "part.pim", arguments)))
}

/// Runs a program that must be refused and returns the error text.
fn errors(program: &str, arguments: &[&str]) -> String {
    let shop = Shop::new(&[("part.pim", program.as_bytes())]);
    refused(&shop.run_in("fagor", "part.pim", arguments))
}
