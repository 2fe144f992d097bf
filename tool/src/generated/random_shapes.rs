//! Random lines and arcs.

use super::Options;
use super::random::Random;
use super::text::Text;
use std::f64::consts::{PI, TAU};

/// Lines in space, lengths spread evenly over their orders of magnitude, all directions.
pub(super) fn polyline(options: &Options) -> String {
    let mut text = Text::start("random polyline", options, options.tolerance_or(0.01), 6);
    let mut random = Random::new(options.seed);
    let mut at = [0.0; 3];
    for line in 0..300 {
        let length = random.between_logarithmic(0.003, 20.0);
        let direction = random.direction();
        let start = at;
        for (coordinate, part) in at.iter_mut().zip(direction) {
            *coordinate += length * part;
        }
        text.line(&[('X', at[0]), ('Y', at[1]), ('Z', at[2])]);
        // Every twentieth goes back half of the way that it came.
        if line % 20 == 19 {
            for (coordinate, from) in at.iter_mut().zip(start) {
                *coordinate = 0.5 * (*coordinate + from);
            }
            text.line(&[('X', at[0]), ('Y', at[1]), ('Z', at[2])]);
        }
    }
    text.end()
}

/// Arcs, helices and some lines, radii from 0.1 to 10 mm.
pub(super) fn arcs(options: &Options) -> String {
    // Plane, its axes, the letters of the centre, and the axis along the helix.
    const PLANES: [(&str, [usize; 3], [char; 2]); 3] = [
        ("G17", [0, 1, 2], ['I', 'J']),
        ("G18", [2, 0, 1], ['K', 'I']),
        ("G19", [1, 2, 0], ['J', 'K']),
    ];
    const LETTERS: [char; 3] = ['X', 'Y', 'Z'];
    let mut text = Text::start("random arcs", options, options.tolerance_or(0.01), 6);
    let mut random = Random::new(options.seed);
    // As the file has it, so that the radii at both ends of an arc agree.
    let round = |number: f64| (number * 1e6).round() / 1e6;
    let mut at = [0.0; 3];
    for _ in 0..300 {
        if random.below(4) == 0 {
            let length = random.between_logarithmic(0.05, 20.0);
            for (coordinate, part) in at.iter_mut().zip(random.direction()) {
                *coordinate = round(*coordinate + length * part);
            }
            text.line(&[('X', at[0]), ('Y', at[1]), ('Z', at[2])]);
            continue;
        }
        let (plane, axes, centre_letters) = PLANES[random.below(3) as usize];
        let radius = random.between_logarithmic(0.1, 10.0);
        let towards = random.between(0.0, TAU);
        let sweep = random.between(0.05, 1.9 * PI);
        let clockwise = random.below(2) == 0;
        let climb = if random.below(3) == 0 {
            random.between(-3.0, 3.0)
        } else {
            0.0
        };
        let centre = [round(radius * towards.cos()), round(radius * towards.sin())];
        let turn = if clockwise { -sweep } else { sweep };
        let (sine, cosine) = turn.sin_cos();
        let mut end = at;
        end[axes[0]] += centre[0] - (cosine * centre[0] - sine * centre[1]);
        end[axes[1]] += centre[1] - (sine * centre[0] + cosine * centre[1]);
        end[axes[2]] += climb;
        at = end.map(round);
        let code = format!("{plane} {}", if clockwise { "G2" } else { "G3" });
        let mut words: Vec<(char, f64)> = LETTERS.into_iter().zip(at).collect();
        words.extend(centre_letters.into_iter().zip(centre));
        text.words(&code, &words);
    }
    text.end()
}
