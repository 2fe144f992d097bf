//! A trial that is given up makes its new vertices narrow for the time being only.

use super::super::hardening::tests::lines;
use super::*;
use crate::test_room::with_room;

/// Chords of a circle with a radius of 10, and their tolerance.
fn chords() -> Vec<([f64; 3], f64)> {
    (0..40)
        .map(|chord| 0.1 * f64::from(chord))
        .map(|angle| ([angle.cos(), angle.sin(), 0.0], 0.05))
        .collect()
}

/// What becomes of lines, each given by its displacement and tolerance, when all is settled. `given_up`: the first trial is that knows
/// so many legs.
fn settled(displacements: &[([f64; 3], f64)], mut given_up: Option<u64>) -> Box<Chain> {
    let settings = BlendSettings::DEFAULT;
    let metric = Metric::new(settings.rotary_weight());
    let mut chain = Box::new(Chain::new());
    let mut optimizer = WidthOptimizer::new();
    optimizer.restart(&chain);
    lines(displacements, &settings, &mut chain);
    while !optimizer.is_settled(&chain) {
        optimizer.step(&mut chain, &settings, &metric, true, 1);
        let checks = matches!(optimizer.phase, OptimizerPhase::Check(_));
        if checks && given_up.is_some_and(|next| optimizer.window.next >= next) {
            optimizer.give_up(&mut chain);
            given_up = None;
        }
    }
    assert_eq!(given_up, None);
    chain
}

/// The widths of the kernels between all chords.
fn kernels(given_up: Option<u64>) -> Vec<f64> {
    with_room(move || {
        let chain = settled(&chords(), given_up);
        let kernel = |number| chain.vertex(number).stored().kernel;
        (1..chain.next()).map(kernel).collect()
    })
}

#[test]
fn the_next_trial_widens_what_one_that_was_given_up_left_narrow() {
    let undisturbed = kernels(None);
    // There are 32 new vertices in a trial: the last one is repeated, since no more of the path comes.
    for (known, new) in [(1, 0), (40, 32)] {
        let kernels = kernels(Some(known));
        // The first one is that of vertex 1.
        let new = usize::max(new, 1) - 1;
        assert_eq!(kernels[new..], undisturbed[new..], "{known}");
    }
}

/// Whether the corners between lines of 5 mm that turn by these angles are of a figure.
fn of_figure(turns: &[f64]) -> Vec<bool> {
    let mut angle = 0.0f64;
    let mut displacements = vec![([5.0, 0.0, 0.0], 0.05)];
    for turn in turns {
        angle += turn;
        displacements.push(([5.0 * angle.cos(), 5.0 * angle.sin(), 0.0], 0.05));
    }
    with_room(move || {
        let chain = settled(&displacements, None);
        (1..chain.next())
            .map(|number| chain.vertex(number).corner.of_figure)
            .collect()
    })
}

#[test]
fn a_corner_between_two_that_turn_to_the_same_side_is_one_of_a_figure() {
    assert_eq!(of_figure(&[0.4; 5]), [false, true, true, true, false]);
    assert_eq!(of_figure(&[0.4, -0.4, 0.4]), [false; 3]);
    assert_eq!(of_figure(&[0.4, 0.4, -0.4]), [false; 3]);
    assert_eq!(of_figure(&[0.4, 0.4, 0.1, -0.4]), [false; 4], "no corner");
}

/// Koch's curve in so short lines that dozens of kernels overlap.
fn koch() -> Vec<([f64; 3], f64)> {
    let mut sixths = vec![0];
    for _ in 0..5 {
        let turned = |by: i32| sixths.iter().map(move |direction| direction + by);
        let parts = [0, 1, -1, 0].map(|by| turned(by).collect::<Vec<_>>());
        sixths = parts.concat();
    }
    let line = |direction: i32| {
        let angle = f64::from(direction) * std::f64::consts::FRAC_PI_3;
        ([0.015 * angle.cos(), 0.015 * angle.sin(), 0.0], 0.02)
    };
    sixths.into_iter().map(line).collect()
}

/// How many kernel terms a leg of that takes, where so many come at a time, and how many trials are given up.
fn work_of_koch(at_a_time: usize) -> (usize, usize) {
    with_room(move || {
        let settings = BlendSettings::DEFAULT;
        let metric = Metric::new(settings.rotary_weight());
        let mut chain = Box::new(Chain::new());
        let mut optimizer = WidthOptimizer::new();
        optimizer.restart(&chain);
        let (mut terms, mut given_up) = (0, 0);
        for some in koch().chunks(at_a_time) {
            lines(some, &settings, &mut chain);
            while !optimizer.is_settled(&chain) {
                let was_hardened = optimizer.hardened;
                terms += optimizer.step(&mut chain, &settings, &metric, true, 1);
                given_up += usize::from(optimizer.hardened && !was_hardened);
            }
        }
        (terms / chain.next() as usize, given_up)
    })
}

/// What is final beside them left violations that no narrowing ended: 20 trials were given up.
#[test]
fn trials_beside_what_is_final_come_to_their_end() {
    let (_, given_up) = work_of_koch(16);
    assert!(given_up < 3, "{given_up}");
}

/// Where narrowing one of them leaves sixty legs to be checked again. With all of them checked each time, or 16 new vertices at a
/// time, a leg takes more than 4000 terms.
#[test]
fn trials_among_dozens_of_kernels_come_to_their_end() {
    let (terms, _) = work_of_koch(usize::MAX);
    assert!(terms < 2700, "{terms}");
}
