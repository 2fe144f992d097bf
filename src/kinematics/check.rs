//! The check that travels with a frame command: a net that is missing or swapped must not be a wrong frame.
//!
//! Eight numbers go over eight nets, and their weighted sum over a ninth. The weights are square roots of different
//! primes: no combination of them with whole factors is 0, so that no exchange of decimal values keeps the sum, as
//! one of whole weights would (1 3 0 for 3 0 1 with 2, 3 and 5).

use super::pins::FrameInputs;

/// How far, for each unit of the largest part, the sum may be off: both sides add with rounding.
const ROUNDING: f64 = 2e-14;

/// The first of the primes is that of the command, then come the values, the work offset and its rotation.
const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];

/// The sum that belongs to what is on the pins.
pub fn check_sum(inputs: &FrameInputs) -> f64 {
    parts(inputs).iter().sum()
}

/// Whether the pins say what was sent; true as well if a value is not finite, which has no sum.
pub fn is_whole(inputs: &FrameInputs) -> bool {
    let largest = parts(inputs)
        .iter()
        .fold(0.0_f64, |most, part| most.max(part.abs()));
    let sum = check_sum(inputs);
    // A value that is not finite is refused by its own name. A check that is no number does not pass.
    !sum.is_finite() || (inputs.check - sum).abs() <= ROUNDING * largest
}

fn parts(inputs: &FrameInputs) -> [f64; 8] {
    let [a, b, c] = inputs.value;
    let [x, y, z] = inputs.work_offset;
    let sent = [inputs.command, a, b, c, x, y, z, inputs.work_rotation];
    core::array::from_fn(|k| PRIMES[k].sqrt() * sent[k])
}
