use super::*;
use crate::canon::call::{PathMode, Tag};
use crate::layer::program::{MotionType, Move, Shape};

/// In X and Z, mm, through these places, each move with a line of its own.
fn moves(places: &[[f64; 2]]) -> Vec<Handed> {
    let at = |[x, z]: [f64; 2]| [x, 0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let ends = places.windows(2).enumerate();
    let handed = ends.map(|(index, ends)| {
        let line = index as i32 + 1;
        let piece = Piece {
            segment: Segment::line(at(ends[0]), at(ends[1])),
            line,
            move_index: index,
            mode: PathMode::Continuous,
            tolerance: 0.01,
            merged_within: 0.0,
            turns_left_away: 0,
            stops: false,
        };
        let a_move = Move {
            index,
            line,
            shape: Shape::Line,
            end: at(ends[1]),
            motion_type: MotionType::Feed,
            velocity: 1.0,
            greatest_velocity: 1.0,
            acceleration: 1.0,
            at_speed: false,
            tag: Tag::default(),
        };
        let pieces = vec![piece];
        Handed { a_move, pieces }
    });
    handed.collect()
}

/// Follows a machine that is exactly on the program, but off by `off` in X on the move with this number.
fn followed(moves: &[Handed], (wrong, off): (usize, f64)) -> Deviation {
    let mut follower = Follower::new(0.0, None);
    for handed in moves {
        follower.add(handed);
    }
    for handed in moves {
        for n in 0..50 {
            let mut place = handed.pieces[0].segment.point(f64::from(n) / 50.0);
            let index = handed.a_move.index;
            place[0] += if index == wrong { off } else { 0.0 };
            follower.step(&place, Some(index));
        }
    }
    let end = moves.last().expect("moves").a_move.end;
    follower.step(&end, Some(moves.len() - 1));
    follower.finish()
}

/// A cycle for threads whose last passes are as deep as each other, and the way off.
fn thread() -> Vec<Handed> {
    let mut places = vec![[20.0, 5.0]];
    for depth in [0.5, 0.8, 1.0, 1.0, 1.0] {
        let inside = 11.0 - depth;
        places.extend([[11.0, 6.0], [inside, 6.0], [inside, -15.0], [11.0, -15.0]]);
    }
    places.push([20.0, 5.0]);
    moves(&places)
}

#[test]
fn passes_along_each_other_are_no_deviation() {
    let found = followed(&thread(), (usize::MAX, 0.0));
    assert!(found.planned.distance < 1e-9, "{found:?}");
    assert!(found.programmed.distance < 1e-9, "{found:?}");
    assert!(found.beyond.is_none());
}

/// The same places, so many pieces merged to each move.
fn merged(places: &[[f64; 2]], counts: &[usize]) -> Vec<Handed> {
    let mut rest = moves(places).into_iter();
    let handed = counts.iter().enumerate().map(|(index, &count)| {
        let mut one = rest.next().expect("a move");
        one.a_move.index = index;
        one.pieces
            .extend(rest.by_ref().take(count - 1).flat_map(|next| next.pieces));
        for piece in &mut one.pieces {
            piece.move_index = index;
        }
        one
    });
    handed.collect()
}

/// Follows a machine along X at these places, each with the move that runs.
fn followed_along_x(moves: &[Handed], places: impl Iterator<Item = (f64, usize)>) -> Deviation {
    let mut follower = Follower::new(0.0, None);
    for handed in moves {
        follower.add(handed);
    }
    for (x, running) in places {
        let place = [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        follower.step(&place, Some(running));
    }
    follower.finish()
}

#[test]
fn a_hook_in_a_merged_move_is_no_deviation() {
    // Behind X0 a hook that leads back, and the way on, handed over as one move along X.
    let hook = [
        [0.0, 0.008],
        [-0.004, 0.008],
        [-0.004, 0.004],
        [-0.008, 0.004],
    ];
    let places = [&[[-1.0, 0.0], [0.0, 0.0]], &hook[..], &[[1.0, 0.0]]].concat();
    let ways = (0..=200).map(|n| (f64::from(n - 100) * 0.01, usize::from(n > 100)));
    let found = followed_along_x(&merged(&places, &[1, 5]), ways);
    assert!(found.planned.distance < 0.005, "{found:?}");
    assert!(found.beyond.is_none(), "{found:?}");
}

#[test]
fn a_tip_between_two_cycles_is_no_deviation() {
    let there_and_back = [[-3.0, 0.0], [1.0, 0.0], [-3.0, 0.0]];
    // Under an acceleration that takes 0.05 off in half a cycle.
    let x = |n: i32| 1.0 - 0.05 * f64::from(2 * n + 1).powi(2);
    let ways = (-5..5).map(|n| (x(n), usize::from(n >= 0)));
    let found = followed_along_x(&merged(&there_and_back, &[1, 1]), ways);
    assert!(found.programmed.distance < 1e-3, "{found:?}");
}

#[test]
fn pieces_that_a_cycle_passes_are_no_deviation() {
    // Pieces of 5 micrometres, merged to two moves; 20 of them in a cycle.
    let places: Vec<[f64; 2]> = (0..=200).map(|n| [f64::from(n) * 0.005, 0.0]).collect();
    let ways = (0..=11).map(|n| (f64::from(n) * 0.1 - 0.05).clamp(0.0, 1.0));
    let ways = ways.map(|x| (x, usize::from(x > 0.5)));
    let found = followed_along_x(&merged(&places, &[100, 100]), ways);
    assert!(found.programmed.distance < 1e-9, "{found:?}");
}

#[test]
fn what_merging_took_counts_beside_a_merged_move() {
    let mut handed = moves(&[[0.0, 0.0], [0.0, 1.0], [0.0, 1.01], [0.0, 2.0]]);
    assert!(followed(&handed, (2, 0.015)).beyond.is_some());
    handed[0].pieces[0].merged_within = 0.01;
    let found = followed(&handed, (2, 0.015));
    assert!(found.beyond.is_none(), "{found:?}");
}

#[test]
fn a_pass_beside_its_place_is_found_with_its_line() {
    // the second pass, to the outside
    let found = followed(&thread(), (6, 0.1));
    let beyond = found.beyond.expect("a deviation");
    assert!((beyond.distance - 0.1).abs() < 1e-9, "{beyond:?}");
    assert_eq!(beyond.line, 7);
}

/// A line along X in G61, and in G64 P0.5 a short step and the way back beside it.
fn there_and_back() -> Vec<Handed> {
    let mut handed = moves(&[[0.0, 0.0], [20.0, 0.0], [20.0, 0.02], [5.0, 0.02]]);
    for (index, one) in handed.iter_mut().enumerate() {
        let piece = &mut one.pieces[0];
        (piece.mode, piece.tolerance) = match index {
            0 => (PathMode::ExactPath, 0.0),
            _ => (PathMode::Continuous, 0.5),
        };
    }
    handed
}

/// Follows a machine that is off by `off` in Z in the middle of the move with this number.
fn followed_beside(moves: &[Handed], (wrong, off): (usize, f64)) -> Deviation {
    let mut follower = Follower::new(0.0, None);
    moves.iter().for_each(|handed| follower.add(handed));
    for handed in moves {
        for n in 0..=50 {
            let mut place = handed.pieces[0].segment.point(f64::from(n) / 50.0);
            let index = handed.a_move.index;
            place[2] += if index == wrong && n == 25 { off } else { 0.0 };
            follower.step(&place, Some(index));
        }
    }
    follower.finish()
}

#[test]
fn a_place_is_judged_by_the_move_that_runs() {
    let program = there_and_back();
    // Nearer to the line in G61, which has been left.
    let found = followed_beside(&program, (2, -0.25));
    assert!(found.beyond.is_none(), "{found:?}");
    assert!(found.exact.distance < 1e-9, "{found:?}");
    assert!((found.tightest.distance - 0.25).abs() < 1e-9, "{found:?}");
    // Near a line to come, which has nothing to do with it.
    let found = followed_beside(&program, (0, -0.25));
    let beyond = found.beyond.expect("a deviation");
    assert_eq!((beyond.line, beyond.tolerance), (1, Some(0.0)));
    // Farther than the tolerance of either.
    let found = followed_beside(&program, (2, -0.6));
    assert!(found.beyond.is_some(), "{found:?}");
}
