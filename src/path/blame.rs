//! Which vertices are narrowed where a trial leaves the tolerance.
//!
//! A vertex is to blame by how much of the deviation there is its own, times its reach: of two that add the same
//! the wider one loses less. To narrow all that reach the place made vertices narrow that had nothing to do with
//! it: dense code with sharp turns took 3 % longer in the mean.

use super::chain::{Chain, NEIGHBOURS};
use super::jump::JumpSum;
use super::metric::Metric;
use super::vertex::Vertex;
use super::window::Window;

/// Vertices with at least this share of the greatest blame are narrowed.
const BLAMED: f64 = 0.5;

/// The most vertices that reach a leg.
const MOST: usize = 2 * NEIGHBOURS as usize;

/// Marks the open vertices that are to blame for the deviation at `s` on a leg. `near_end`: it may be due to the
/// end of what is known. Answers the kernel terms that it took.
pub(super) fn mark(
    chain: &mut Chain,
    leg: u64,
    s: f64,
    near_end: bool,
    window: &Window,
    metric: &Metric,
) -> usize {
    let from = leg
        .saturating_sub(NEIGHBOURS - 1)
        .max(window.open)
        .max(chain.first());
    let to = leg.saturating_add(1 + NEIGHBOURS).min(window.next);
    let mut total = JumpSum::ZERO;
    for number in from..to {
        let vertex = chain.vertex(number);
        vertex.add_deviation(&vertex.counted, s - vertex.s, &mut total);
    }
    let total = total.axes();
    let mut blames = [0.0; MOST];
    let mut greatest = 0.0;
    for (blame, number) in blames.iter_mut().zip(from..to) {
        let vertex = chain.vertex(number);
        let mut own = JumpSum::ZERO;
        vertex.add_deviation(&vertex.counted, s - vertex.s, &mut own);
        *blame = vertex.counted.reach() * metric.product(&own.axes(), &total);
        greatest = f64::max(greatest, *blame);
    }
    for (blame, number) in blames.into_iter().zip(from..to) {
        let vertex = chain.vertex_mut(number);
        if blame >= BLAMED * greatest && reaches(vertex, s) {
            vertex.marked = true;
            vertex.marked_temporarily |= near_end;
        }
    }
    2 * to.saturating_sub(from) as usize
}

fn reaches(vertex: &Vertex, s: f64) -> bool {
    (vertex.s - s).abs() < vertex.counted.reach()
}
