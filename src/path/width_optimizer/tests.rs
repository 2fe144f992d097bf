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

/// The widths of the kernels between all chords when all is settled. `given_up`: the first trial is that knows so many legs.
fn kernels(given_up: Option<u64>) -> Vec<f64> {
    with_room(move || {
        let settings = BlendSettings::DEFAULT;
        let metric = Metric::new(settings.rotary_weight());
        let mut chain = Chain::new();
        let mut optimizer = WidthOptimizer::new();
        optimizer.restart(&chain);
        lines(&chords(), &settings, &mut chain);
        let mut given_up = given_up;
        while !optimizer.is_settled(&chain) {
            optimizer.step(&mut chain, &settings, &metric, true, 1);
            let checks = matches!(optimizer.phase, OptimizerPhase::Check(_));
            if checks && given_up.is_some_and(|next| optimizer.window.next >= next) {
                optimizer.give_up(&mut chain);
                given_up = None;
            }
        }
        assert_eq!(given_up, None);
        let kernel = |number| chain.vertex(number).stored().kernel;
        (1..chain.next()).map(kernel).collect()
    })
}

#[test]
fn the_next_trial_widens_what_one_that_was_given_up_left_narrow() {
    let undisturbed = kernels(None);
    // There are 16 new vertices in a trial: the last one is repeated, since no more of the path comes.
    for (known, new) in [(1, 0), (20, 16), (40, 32)] {
        let kernels = kernels(Some(known));
        // The first one is that of vertex 1.
        let new = usize::max(new, 1) - 1;
        assert_eq!(kernels[new..], undisturbed[new..], "{known}");
    }
}
