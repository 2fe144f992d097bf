//! Which place of the course belongs to which point of a motion: in order, and as near as possible.

use super::course::{Course, Place};
use crate::path::pieces::Point;

/// The legs are cut into so many cells altogether, and one for each leg.
const CELLS: f64 = 2500.0;

/// A part of a leg.
struct Cell {
    leg: usize,
    from: f64,
    to: f64,
}

fn cells(course: &Course) -> Vec<Cell> {
    let size = (course.whole_length() / CELLS).max(course.least_radius());
    let mut cells = Vec::new();
    for leg in 0..course.legs.len() {
        let length = course.length(leg);
        let count = (length / size).ceil().max(1.0);
        let at = |index: f64| length * index / count;
        cells.extend((0..count as usize).map(|index| Cell {
            leg,
            from: at(index as f64),
            to: at(index as f64 + 1.0),
        }));
    }
    cells
}

/// A place for each point, none before the one of the point before: of all such places those whose
/// distances, as shares of the radius and in their sixth powers, have the least sum.
///
/// The first point belongs to the first leg, the last one to the last.
pub(super) fn places(course: &Course, points: &[Point]) -> Vec<Place> {
    let cells = cells(course);
    let cost = |point: Point, cell: &Cell| {
        let (far, place) = course.nearest(point, cell.leg, cell.from, cell.to);
        ((far / course.legs[cell.leg].radius).powi(6), place.along)
    };
    let mut costs = vec![f64::INFINITY; cells.len()];
    costs[0] = 0.0;
    // For each point and cell: the cell of the point before.
    let mut before: Vec<u32> = Vec::with_capacity(points.len() * cells.len());
    for point in points {
        let mut least = (f64::INFINITY, 0);
        for (index, cell) in cells.iter().enumerate() {
            if costs[index] < least.0 {
                least = (costs[index], index);
            }
            costs[index] = least.0 + cost(*point, cell).0;
            before.push(u32::try_from(least.1).unwrap_or(u32::MAX));
        }
    }
    let mut index = cells.len() - 1;
    let mut found = vec![Place::default(); points.len()];
    for (k, point) in points.iter().enumerate().rev() {
        let (leg, along) = (cells[index].leg, cost(*point, &cells[index]).1);
        found[k] = Place { leg, along };
        index = before[k * cells.len() + index] as usize;
    }
    in_order(&mut found);
    found
}

/// Within a cell a point may be nearest to a place before that of the point before.
fn in_order(places: &mut [Place]) {
    for k in 1..places.len() {
        if places[k] < places[k - 1] {
            places[k] = places[k - 1];
        }
    }
}
