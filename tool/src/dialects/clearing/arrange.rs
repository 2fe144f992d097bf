//! Which of some closed contours is the outline of a region, and which are its islands.

use super::region::Region;
use cavalier_contours::polyline::{PlineContainsResult, PlineSource, Polyline};

/// Contours whose area is below this are none.
const LEAST_AREA: f64 = 1e-6;

/// What is wrong with contours, by their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It encloses nothing.
    Flat(usize),
    /// It crosses or touches itself.
    Tangled(usize),
    /// The second one lies outside of the first, which is the outline.
    Outside(usize, usize),
    /// They cross or touch each other.
    Crossing(usize, usize),
}

/// Contours in their places.
#[derive(Debug)]
pub struct Arranged {
    /// The index of the outline: the contour with the largest area.
    pub outline: usize,
    /// Those that lie inside of an island, and say nothing therefore.
    pub hidden: Vec<usize>,
    /// What lies between outline and islands.
    pub region: Region,
}

/// Finds the outline of the contours, and checks that the others are islands in it.
///
/// # Errors
///
/// See [`Fault`].
pub fn arrange(contours: &[Polyline]) -> Result<Arranged, Fault> {
    for (index, contour) in contours.iter().enumerate() {
        if contour.area().abs() < LEAST_AREA {
            return Err(Fault::Flat(index));
        }
        if contour.scan_for_self_intersect() {
            return Err(Fault::Tangled(index));
        }
    }
    let area = |index: &usize| contours[*index].area().abs();
    let larger = |a: &usize, b: &usize| area(a).total_cmp(&area(b));
    let outline = (0..contours.len()).max_by(larger).ok_or(Fault::Flat(0))?;
    let others: Vec<usize> = (0..contours.len()).filter(|at| *at != outline).collect();
    for &island in &others {
        match contours[outline].contains(&contours[island]) {
            PlineContainsResult::Pline2InsidePline1 => {}
            PlineContainsResult::Intersected => return Err(Fault::Crossing(outline, island)),
            _ => return Err(Fault::Outside(outline, island)),
        }
    }
    let mut hidden = Vec::new();
    for (at, &one) in others.iter().enumerate() {
        for &other in &others[at + 1..] {
            match contours[one].contains(&contours[other]) {
                PlineContainsResult::Intersected => return Err(Fault::Crossing(one, other)),
                PlineContainsResult::Pline1InsidePline2 => hidden.push(one),
                PlineContainsResult::Pline2InsidePline1 => hidden.push(other),
                _ => {}
            }
        }
    }
    hidden.sort_unstable();
    hidden.dedup();
    let islands = others.iter().filter(|island| !hidden.contains(island));
    let islands = islands.map(|island| contours[*island].clone());
    let region = Region::new(contours[outline].clone(), islands.collect());
    Ok(Arranged {
        outline,
        hidden,
        region,
    })
}

#[cfg(test)]
mod tests {
    use super::{Fault, arrange};
    use crate::dialects::clearing::testing::polygon;

    #[test]
    fn the_largest_contour_is_the_outline() {
        let square = |x: f64, size: f64| {
            let y = x;
            polygon(&[[x, y], [x + size, y], [x + size, y + size], [x, y + size]])
        };
        let found = arrange(&[square(10., 5.), square(0., 50.), square(11., 2.)]).unwrap();
        assert_eq!((found.outline, found.hidden), (1, vec![2]));
        for (contours, fault) in [
            (vec![square(0., 9.), square(20., 5.)], Fault::Outside(0, 1)),
            (vec![square(0., 9.), square(5., 5.)], Fault::Crossing(0, 1)),
            (
                vec![square(0., 50.), square(5., 9.), square(8., 9.)],
                Fault::Crossing(1, 2),
            ),
            (
                vec![polygon(&[[0., 0.], [9., 9.], [9., 0.], [0., 5.]])],
                Fault::Tangled(0),
            ),
            (vec![square(0., 50.), square(5., 0.)], Fault::Flat(1)),
        ] {
            let found = arrange(&contours).map(|arranged| arranged.outline);
            assert_eq!(found.unwrap_err(), fault);
        }
    }
}
