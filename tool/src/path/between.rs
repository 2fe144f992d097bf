//! The way of the machine between servo cycles, of which nothing is known but the positions at their ends.

/// Lines as which the way of a cycle is taken: a chord of the whole of it is beside it by `a T^2 / 8`, these by a 64th of that.
const PARTS: i32 = 8;

/// The four positions around the cycle that ends at the one with this index, of so many; where there is none the last stays.
pub(crate) fn around<const N: usize>(
    count: usize,
    index: usize,
    position: impl Fn(usize) -> [f64; N],
) -> [[f64; N]; 4] {
    let before = [2, 1, 0].map(|back| index.saturating_sub(back));
    let after = (index + 1).min(count.saturating_sub(1)).max(index);
    [before[0], before[1], before[2], after].map(position)
}

/// The way along positions a cycle apart, as short lines along the two parabolas through three of them each: that is the way
/// under a constant acceleration. Where the machine turns back it leads beyond the positions, by up to `a T^2 / 8`.
pub(crate) fn way<const N: usize>(
    [first, second, third, fourth]: [[f64; N]; 4],
) -> impl Iterator<Item = [[f64; N]; 2]> {
    let parabolas = [[first, second, third], [second, third, fourth]];
    parabolas.into_iter().flat_map(|[before, middle, after]| {
        let at = move |part: i32| -> [f64; N] {
            let t = f64::from(part) / f64::from(PARTS);
            std::array::from_fn(|axis| {
                let [before, middle, after] = [before[axis], middle[axis], after[axis]];
                let (change, bend) = (after - before, after - 2.0 * middle + before);
                middle + 0.5 * t * (change + t * bend)
            })
        };
        (-PARTS..PARTS).map(move |part| [at(part), at(part + 1)])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tip_between_two_cycles_is_on_the_way() {
        // Back from 0 under an acceleration of 8, before and behind 0 s.
        let positions = [-1.5, -0.5, 0.5, 1.5].map(|t: f64| [-4.0 * t * t]);
        for index in 1..4 {
            let around = around(positions.len(), index, |index| positions[index]);
            let farthest = way(around).map(|line| line[1][0]).fold(-9.0, f64::max);
            assert_eq!(farthest, 0.0, "{index}");
        }
        let line: Vec<_> = way(positions).collect();
        assert_eq!(line.first().map(|line| line[0]), Some(positions[0]));
        assert_eq!(line.last().map(|line| line[1]), Some(positions[3]));
    }
}
