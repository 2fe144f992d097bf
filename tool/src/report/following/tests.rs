use super::*;
use crate::path::pieces::tests::{arc, line};

/// Points along a contour, `step` apart at most, moved by `shift(arc length)`.
fn executed(contour: &[ContourMove], step: f64, shift: impl Fn(f64, Point) -> Point) -> Vec<Point> {
    let mut length = 0.0;
    let mut points = Vec::new();
    for m in contour {
        let own = length_bound(&m.shape);
        let count = (own / step).ceil().max(1.0) as usize;
        for index in 0..=count {
            let t = index as f64 / count as f64;
            points.push(shift(length + t * own, m.shape.point(t)));
        }
        length += own;
    }
    points
}

fn compared(points: &[Point], contour: &[ContourMove]) -> Following {
    compare(points, contour, 0.05)
        .expect("rows and moves")
        .expect("the path is followed")
}

fn square() -> Vec<ContourMove> {
    vec![
        line(1, [0.0; 3], [10.0, 0.0, 0.0]),
        line(2, [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]),
        arc(3, [5.0, 10.0, 0.0], [5.0, 5.0], std::f64::consts::PI, 0.0),
        line(4, [0.0, 10.0, 0.0], [0.0; 3]),
    ]
}

#[test]
fn an_exact_run_has_no_distance() {
    let contour = square();
    let found = compared(&executed(&contour, 0.1, |_, p| p), &contour);
    assert!(found.executed.distance < 1e-13, "{:?}", found.executed);
    // The middle of a chord of the arc: h^2 / 8 r.
    assert!(found.programmed.distance < 0.1f64.powi(2) / 39.0);
    assert!(found.not_reached == 0.0 && found.final_position_error < 1e-14);
    assert_eq!(found.moves.first(), Some(&0));
    assert_eq!(found.moves.last(), Some(&3));
}

#[test]
fn five_micrometres_are_found_with_their_place() {
    let contour = square();
    // A smooth bump of 5 um on the arc, 30 mm along the path.
    let bump = |s: f64, p: Point| {
        let x = (s - 30.0) / 3.0;
        let height = if x.abs() < 1.0 {
            0.005 * (1.0 - x * x).powi(2)
        } else {
            0.0
        };
        let radius = distance(p, [5.0, 10.0, 0.0]);
        let scale = 1.0 + height / radius;
        [
            5.0 + (p[0] - 5.0) * scale,
            10.0 + (p[1] - 10.0) * scale,
            p[2],
        ]
    };
    let points = executed(&contour, 0.05, bump);
    let found = compared(&points, &contour);
    assert!(
        (found.executed.distance - 0.005).abs() < 1e-6,
        "{:?}",
        found.executed
    );
    assert_eq!(found.executed.move_index, 2);
    assert_eq!(contour[found.programmed.move_index].line, 3);
    assert!((found.programmed.distance - 0.005).abs() < 1e-4);
    let row = found.executed.row;
    assert!((f64::from(found.distances[row]) - found.executed.distance).abs() < 1e-9);
}

#[test]
fn a_corner_that_is_cut_shows_from_the_programmed_side_only() {
    // The corner (10, 0) is rounded with radius 1: its vertex is sqrt 2 - 1 away.
    let contour = vec![
        line(1, [0.0; 3], [10.0, 0.0, 0.0]),
        line(2, [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]),
    ];
    let mut points = executed(&[line(1, [0.0; 3], [9.0, 0.0, 0.0])], 0.02, |_, p| p);
    for index in 0..=1000 {
        let angle = -std::f64::consts::FRAC_PI_2 * (1.0 - f64::from(index) / 1000.0);
        points.push([9.0 + angle.cos(), 1.0 + angle.sin(), 0.0]);
    }
    let rest = [line(2, [10.0, 1.0, 0.0], [10.0, 10.0, 0.0])];
    points.extend(executed(&rest, 0.02, |_, p| p));
    let found = compared(&points, &contour);
    let vertex = 2f64.sqrt() - 1.0;
    assert!(
        (found.programmed.distance - vertex).abs() < 1e-5,
        "{:?}",
        found.programmed
    );
    assert!((found.programmed.point[0] - 10.0).abs() < 1e-12);
    // The arc's middle is 1 - sqrt 1/2 from both legs.
    let middle = 1.0 - 0.5f64.sqrt();
    assert!(
        (found.executed.distance - middle).abs() < 1e-5,
        "{:?}",
        found.executed
    );
}

#[test]
fn a_pass_is_not_compared_with_its_neighbour() {
    // Three passes 0.1 mm apart. The second runs on the third: 0.1 mm wrong for 18 mm.
    let contour = vec![
        line(1, [0.0; 3], [20.0, 0.0, 0.0]),
        line(2, [20.0, 0.0, 0.0], [20.0, 0.1, 0.0]),
        line(3, [20.0, 0.1, 0.0], [0.0, 0.1, 0.0]),
        line(4, [0.0, 0.1, 0.0], [0.0, 0.2, 0.0]),
        line(5, [0.0, 0.2, 0.0], [20.0, 0.2, 0.0]),
    ];
    let points = executed(&contour, 0.05, |s, p| {
        let wrong = s > 21.1 && s < 39.1;
        [p[0], if wrong { 0.2 } else { p[1] }, p[2]]
    });
    let found = compared(&points, &contour);
    assert!(
        (found.executed.distance - 0.1).abs() < 1e-9,
        "{:?}",
        found.executed
    );
    assert_eq!(contour[found.executed.move_index].line, 3);
    assert!(
        (found.programmed.distance - 0.1).abs() < 2e-3,
        "{:?}",
        found.programmed
    );
}

#[test]
fn a_pass_is_told_from_the_one_before_when_the_radius_is_wider_than_the_way_out() {
    // .4 mm beside the first line. Then passes with .3 mm out between them: the second, on which the third lies, is .1 mm off.
    let mut contour = vec![
        line(1, [-20.0, 0.0, 0.0], [0.0; 3]),
        line(2, [0.0; 3], [20.0, 0.0, 0.0]),
    ];
    for (number, depth) in [(3, 0.0), (7, -0.1)] {
        let places = [
            [20.0, depth],
            [20.0, 0.3],
            [0.0, 0.3],
            [0.0, -0.1],
            [20.0, -0.1],
        ];
        for (number, ends) in (number..).zip(places.windows(2)) {
            let [start, end] = [ends[0], ends[1]].map(|[x, y]| [x, y, 0.0]);
            contour.push(line(number, start, end));
        }
    }
    let points = executed(&contour, 0.05, |s, p| {
        let beside = if s < 15.0 && s > 5.0 { 0.4 } else { 0.0 };
        let wrong = s > 65.7 && s < 75.7;
        [p[0], if wrong { 0.0 } else { p[1] }, beside]
    });
    let found = compared(&points, &contour);
    assert!((found.executed.distance - 0.4).abs() < 1e-9);
    let rows = |pass: u32, off: f32| {
        let all = found.distances.iter().zip(&found.moves);
        all.filter(|row| *row.1 == pass && (row.0 - off).abs() < 1e-6)
            .count()
    };
    assert!((195..=201).contains(&rows(5, 0.1)), "{}", rows(5, 0.1));
    assert_eq!(rows(1, 0.1) + rows(9, 0.1), 0);
    assert!((395..=410).contains(&rows(1, 0.0)) && (395..=410).contains(&rows(9, 0.0)));
}

#[test]
fn out_and_back_on_the_same_line_is_passed_in_order() {
    let contour = vec![
        line(1, [0.0; 3], [10.0, 0.0, 0.0]),
        line(2, [10.0, 0.0, 0.0], [0.0; 3]),
    ];
    // The run turns back at 9.9: 0.1 short of the end, and it is nowhere beside the path.
    let points: Vec<Point> = (0..=198)
        .chain((0..198).rev())
        .map(|i| [f64::from(i) * 0.05, 0.0, 0.0])
        .collect();
    let found = compared(&points, &contour);
    assert!(found.executed.distance < 1e-12);
    assert!((found.programmed.distance - 0.1).abs() < 1e-12);
    assert_eq!(found.programmed.point, [10.0, 0.0, 0.0]);
    assert_eq!(found.moves[100], 0);
    assert_eq!(found.moves[300], 1);
}

#[test]
fn a_run_cut_short_says_what_is_left() {
    let contour = square();
    let points = executed(&contour[..2], 0.1, |_, p| p);
    let found = compared(&points, &contour);
    let left = 5.0 * std::f64::consts::PI + 10.0;
    assert!(
        (found.not_reached - left).abs() < 0.3,
        "{}",
        found.not_reached
    );
    assert!((found.final_position_error - 200f64.sqrt()).abs() < 1e-12);
    assert!(found.programmed.distance < 0.25);
}

#[test]
fn a_path_that_goes_elsewhere_departs() {
    let contour = square();
    let points = executed(&contour, 0.1, |s, p| {
        [p[0], p[1], if s > 15.0 { 30.0 } else { 0.0 }]
    });
    let departure = compare(&points, &contour, 0.05)
        .expect("rows and moves")
        .expect_err("it leaves the path");
    assert_eq!(contour[departure.move_index].line, 2);
    assert!(departure.farther_than > 3.0);
}

#[test]
fn a_tip_between_two_rows_is_passed() {
    let tip = [1.0, 0.0, 0.0];
    let contour = vec![line(1, [0.0; 3], tip), line(2, tip, [0.0; 3])];
    // Under a constant acceleration that takes 0.01 off in half a cycle.
    let x = |n: i32| 1.0 - 0.01 * f64::from(2 * n + 1).powi(2);
    let points: Vec<Point> = (-6..6).map(|n| [x(n).max(0.0), 0.0, 0.0]).collect();
    let found = compared(&points, &contour);
    assert!(found.programmed.distance < 1e-3, "{:?}", found.programmed);
}
