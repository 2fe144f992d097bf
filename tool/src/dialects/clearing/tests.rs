//! Random regions: nothing is cut at the walls, and nothing is left that the tool reaches.

use super::arrange::arrange;
use super::pieces::{Piece, between, from_place};
use super::region::Region;
use super::rounds::{Tool, clear};
use super::testing::polygon;
use super::walls::follow;
use super::{Cut, Trouble};
use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, PlineVertex, Polyline};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Centres of the tool that may be and that are missed by the sampling.
const NEAR: f64 = 1e-3;

/// The pieces of a way, as a control would go them.
fn pieces(cut: &Cut) -> Vec<Piece> {
    let mut place = cut.start;
    let mut list = Vec::new();
    for step in &cut.steps {
        let bulge = step.arc.map_or(0.0, |(offset, clockwise)| {
            let from = [-offset[0], -offset[1]];
            let to = [0, 1].map(|axis| step.to[axis] - place[axis] - offset[axis]);
            let turn = to[1].atan2(to[0]) - from[1].atan2(from[0]);
            match clockwise {
                true => -((-turn).rem_euclid(TAU) / 4.0).tan(),
                false => (turn.rem_euclid(TAU) / 4.0).tan(),
            }
        });
        let vertex = |place: [f64; 2], bulge| PlineVertex::new(place[0], place[1], bulge);
        list.push((vertex(place, bulge), vertex(step.to, 0.0)));
        place = step.to;
    }
    list
}

/// Depth of a place: its distance from the walls, below 0 outside of the region.
fn depth(contours: &[Polyline], region: &Region, outline: usize, place: Vector2) -> f64 {
    let away = region.pieces().map(|piece| from_place(piece, place));
    let away = away.fold(f64::INFINITY, f64::min);
    let inside = contours
        .iter()
        .enumerate()
        .all(|(index, contour)| (contour.winding_number(place) != 0) == (index == outline));
    if inside { away } else { -away }
}

fn check(contours: &[Polyline], tool: Tool) -> Result<(), TestCaseError> {
    let Ok(arranged) = arrange(contours) else {
        return Ok(());
    };
    let region = &arranged.region;
    let kept: Vec<Polyline> = contours
        .iter()
        .enumerate()
        .filter(|(index, _)| !arranged.hidden.contains(index))
        .map(|(_, contour)| contour.clone())
        .collect();
    let outline = arranged.outline
        - arranged
            .hidden
            .iter()
            .filter(|hidden| **hidden < arranged.outline)
            .count();
    let clearance = tool.radius + tool.allowance;
    let cuts = match clear(region, &tool, &mut || true) {
        Ok(cuts) => cuts,
        Err(Trouble::Unfit) => Vec::new(),
        Err(trouble) => return Err(TestCaseError::fail(format!("{trouble:?}"))),
    };
    let ways: Vec<Piece> = cuts.iter().flat_map(pieces).collect();
    for way in &ways {
        for wall in region.pieces() {
            let away = between(*way, wall);
            prop_assert!(away > clearance - 2e-6, "{way:?}: {away}");
        }
    }
    let bounds = contours[arranged.outline].extents().unwrap();
    let across =
        |share: i32, from: f64, to: f64| from + (to - from) * (f64::from(share) + 0.3) / 25.0;
    for x in 0..25 {
        for y in 0..25 {
            let place = Vector2::new(
                across(x, bounds.min_x, bounds.max_x),
                across(y, bounds.min_y, bounds.max_y),
            );
            if depth(&kept, region, outline, place) < clearance + NEAR {
                continue;
            }
            let least = ways.iter().map(|way| from_place(*way, place));
            let least = least.fold(f64::INFINITY, f64::min);
            prop_assert!(least < tool.radius + 1e-6, "{place:?} is left: {least}");
        }
    }
    match follow(region, tool.radius, false, &[]) {
        Ok(_) | Err(Trouble::Unfit) => Ok(()),
        Err(trouble) => Err(TestCaseError::fail(format!("{trouble:?}"))),
    }
}

/// A contour round a place, some of whose pieces are arcs.
fn star(size: f64) -> impl Strategy<Value = Polyline> {
    let corner = (0.4..1.0f64, prop_oneof![Just(0.0), -0.3..0.5f64]);
    (prop::collection::vec(corner, 3..9), 0.0..TAU).prop_map(move |(corners, turn)| {
        let mut line = Polyline::new_closed();
        let count = corners.len() as f64;
        for (index, (share, bulge)) in corners.into_iter().enumerate() {
            let angle = turn + TAU * index as f64 / count;
            let [x, y] = [angle.cos(), angle.sin()].map(|value| value * share * size);
            line.add((x * 1e3).round() / 1e3, (y * 1e3).round() / 1e3, bulge);
        }
        line
    })
}

fn rectangle() -> impl Strategy<Value = Polyline> {
    (20..60i32, 20..60i32).prop_map(|(x, y)| {
        let [x, y] = [x, y].map(f64::from);
        polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]])
    })
}

fn island() -> impl Strategy<Value = Polyline> {
    let shape = prop_oneof![
        (1..12i32, 1..12i32).prop_map(|(x, y)| {
            let [x, y] = [x, y].map(f64::from);
            polygon(&[[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]])
        }),
        star(9.0),
    ];
    (shape, -40..40i32, -40..40i32).prop_map(|(mut line, x, y)| {
        line.translate_mut(f64::from(x), f64::from(y));
        line
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]
    #[test]
    fn nothing_is_left_and_nothing_is_cut_beyond(
        outline in prop_oneof![rectangle(), star(60.0)],
        islands in prop::collection::vec(island(), 0..5),
        radius in 1.0..8.0f64,
        allowance in prop_oneof![Just(0.0), 0.1..2.0f64],
        share in prop_oneof![Just(1.5), Just(2.0), 0.3..2.0f64],
    ) {
        let mut contours = vec![outline];
        for island in islands {
            contours.push(island);
            if arrange(&contours).is_err() {
                contours.pop();
            }
        }
        check(&contours, Tool { radius, allowance, step: share * radius })?;
    }
}

/// Corners on a grid, so that pieces touch, cover each other and are as wide as the tool.
fn on_grid() -> impl Strategy<Value = Polyline> {
    let bulge =
        prop_oneof![4 => Just(0.0), 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(0.4142135623730951)];
    prop::collection::vec((0..12i32, 0..12i32, bulge), 3..9).prop_map(|corners| {
        let mut line = Polyline::new_closed();
        for (x, y, bulge) in corners {
            line.add(2.0 * f64::from(x), 2.0 * f64::from(y), bulge);
        }
        line.remove_repeat_pos(1e-9).unwrap_or(line)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]
    #[test]
    fn contours_on_a_grid_are_cleared_or_refused(
        contours in prop::collection::vec(on_grid(), 1..4),
        radius in prop_oneof![Just(0.5), Just(1.0), Just(2.0)],
        share in prop_oneof![Just(1.0), Just(1.5), Just(2.0)],
    ) {
        let mut kept: Vec<Polyline> = Vec::new();
        for contour in contours.into_iter().filter(|contour| contour.vertex_count() > 1) {
            kept.push(contour);
            if arrange(&kept).is_err() {
                kept.pop();
            }
        }
        check(&kept, Tool { radius, allowance: 0.0, step: share * radius })?;
    }
}

#[test]
fn a_tool_that_is_too_large_fits_nowhere() {
    let square = polygon(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]);
    let region = Region::new(square, Vec::new());
    let tool = Tool {
        radius: 5.0,
        allowance: 0.0,
        step: 1.0,
    };
    assert_eq!(clear(&region, &tool, &mut || true), Err(Trouble::Unfit));
}

#[test]
fn rounds_come_to_an_end_when_they_must() {
    let square = polygon(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]);
    let region = Region::new(square, Vec::new());
    let tool = Tool {
        radius: 1.0,
        allowance: 0.0,
        step: 1e-6,
    };
    let mut rounds = 0;
    let found = clear(&region, &tool, &mut || {
        rounds += 1;
        rounds < 20
    });
    assert_eq!(found, Err(Trouble::Endless));
}
