//! Rounds parallel to all walls, side by side, from the deepest places outwards.

use super::pieces::SAME;
use super::region::Region;
use super::rests::{nearest, rests};
use super::{Cut, Trouble, Way};
use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{PlineSource, PlineVertex, Polyline};

/// The longest way at depth from one round to the next, over the radius of the tool.
const LONGEST_LINK: f64 = 4.0;

/// The tool that clears.
#[derive(Clone, Copy, Debug)]
pub struct Tool {
    /// Its radius.
    pub radius: f64,
    /// What it leaves at the walls.
    pub allowance: f64,
    /// How far two rounds are apart, above 0 and at most the diameter.
    pub step: f64,
}

impl Tool {
    /// The least distance of its centre from a wall.
    fn clearance(&self) -> f64 {
        self.radius + self.allowance
    }
}

/// All rounds.
#[derive(Debug, Default)]
struct Rounds {
    /// The outermost first.
    lines: Vec<Polyline>,
    /// The next one towards the walls of each.
    outer: Vec<Option<usize>>,
}

/// The ways that clear a region, in their order. `go_on` is asked before each round whether there may be more.
///
/// # Errors
///
/// See [`Trouble`].
pub fn clear(
    region: &Region,
    tool: &Tool,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Cut>, Trouble> {
    let rounds = Rounds::lay(region, tool, go_on)?;
    match rounds.lines.is_empty() {
        true => Err(Trouble::Unfit),
        false => rounds.link(region, tool),
    }
}

impl Rounds {
    fn lay(
        region: &Region,
        tool: &Tool,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Rounds, Trouble> {
        let mut rounds = Rounds::default();
        let mut layer = 0..0;
        for number in 0.. {
            if !go_on() {
                return Err(Trouble::Endless);
            }
            let depth = tool.clearance() + f64::from(number) * tool.step;
            let loops = region.loops(depth);
            let further = match layer.is_empty() {
                true => Vec::new(),
                false => rests(region, tool, depth - tool.step, &loops, go_on)?,
            };
            let first = rounds.lines.len();
            let count = loops.len();
            for line in loops.into_iter().chain(further) {
                let outer = rounds.lines.get(layer.clone());
                let outer = nearest(outer.unwrap_or(&[]), line.at(0).pos());
                rounds.outer.push(outer.map(|at| layer.start + at));
                rounds.lines.push(line);
            }
            if count == 0 {
                break;
            }
            layer = first..first + count;
        }
        Ok(rounds)
    }

    /// Joins rounds, each behind those that it goes round, to ways.
    fn link(&self, region: &Region, tool: &Tool) -> Result<Vec<Cut>, Trouble> {
        let mut inside = vec![0_usize; self.lines.len()];
        for outer in self.outer.iter().flatten() {
            inside[*outer] += 1;
        }
        let mut ready: Vec<usize> = (0..inside.len()).filter(|at| inside[*at] == 0).collect();
        let mut cuts = Vec::new();
        let mut way: Option<Way> = None;
        while let Some((at, line)) = self.next(&mut ready, way.as_ref().map(Way::end)) {
            let start = line.at(0).pos();
            let linked = way.take();
            let mut on = match linked {
                Some(mut on) if may_link(on.end(), start, region, tool) => {
                    on.go(start, 0.0);
                    on
                }
                linked => {
                    let done = linked.map(|done| done.finish(region, tool.clearance()));
                    cuts.extend(done.transpose()?);
                    Way::at(start)
                }
            };
            on.go_round(&line);
            way = Some(on);
            if let Some(outer) = self.outer[at] {
                inside[outer] -= 1;
                ready.extend((inside[outer] == 0).then_some(outer));
            }
        }
        let done = way.map(|done| done.finish(region, tool.clearance()));
        cuts.extend(done.transpose()?);
        Ok(cuts)
    }

    /// Takes the round that is next to a place, or the deepest one, and begins it there.
    fn next(&self, ready: &mut Vec<usize>, place: Option<Vector2>) -> Option<(usize, Polyline)> {
        let Some(place) = place else {
            let at = ready.pop()?;
            return Some((at, self.lines[at].clone()));
        };
        let found = (0..ready.len()).filter_map(|index| {
            let found = self.lines[ready[index]].closest_point(place, SAME)?;
            Some((index, found))
        });
        let (index, found) = found.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance))?;
        let at = ready.swap_remove(index);
        let line = &self.lines[at];
        let begun = line.rotate_start(found.seg_start_index, found.seg_point, super::NEAR);
        Some((at, begun.unwrap_or_else(|| line.clone())))
    }
}

fn may_link(from: Vector2, to: Vector2, region: &Region, tool: &Tool) -> bool {
    let vertex = |place: Vector2| PlineVertex::new(place.x, place.y, 0.0);
    (to - from).length() <= LONGEST_LINK * tool.radius
        && region.is_clear(
            (vertex(from), vertex(to)),
            tool.clearance() - super::INEXACT,
        )
}
