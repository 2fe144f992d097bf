//! Random programs for the blended path, and what is checked of all of them.

mod deviation;

use core::f64::consts::TAU;

use framepath::axes::{Axes, AxisLimits};
use framepath::moves::shape::{Arc9, Circle, Line9, PathPoint, Shape};
use framepath::moves::{FeedWord, NearLimit, TerminationCondition, UNITS_PER_MINUTE};
use framepath::path::{BlendError, BlendSettings, BlendedPath, GREATEST_EXCESS, ProgrammedMove};
use nalgebra::Vector3;
use proptest::prelude::*;

pub use deviation::{check_touched, greatest_deviation, greatest_deviation_with_tolerance};

/// Machine units per degree.
pub const ROTARY_WEIGHT: f64 = 0.1;

/// Of G64 without P, mm.
pub const DEFAULT_TOLERANCE: f64 = 0.02;

/// A machine with 1000 mm/s^2; jerk in mm/s^3.
pub fn blend_settings(jerk: f64, default_tolerance: f64) -> BlendSettings {
    let limits = AxisLimits {
        velocity: Axes::repeat(100.0),
        acceleration: Axes::repeat(1000.0),
        jerk: Axes::repeat(jerk),
    };
    BlendSettings::new(1.0, ROTARY_WEIGHT, default_tolerance, &limits).expect("sound")
}

/// The character of a random program; every number is from 0 to 1.
#[derive(Clone, Debug)]
pub struct Character {
    pub shortest: f64,
    pub longest: f64,
    pub tolerance: f64,
    pub tolerance_changes: f64,
    pub arcs: f64,
    pub turns: f64,
    pub smoothness: f64,
    pub reversals: f64,
    pub exact: f64,
    pub stops: f64,
    pub rotary: f64,
    pub rounding: f64,
    pub tiny: f64,
}

/// One move: numbers from 0 to 1 that its character turns into something.
pub type Draw = [f64; 12];

pub fn character() -> impl Strategy<Value = Character> {
    prop::array::uniform13(0.0..1.0f64).prop_map(
        |[
            shortest,
            longest,
            tolerance,
            tolerance_changes,
            arcs,
            turns,
            smoothness,
            reversals,
            exact,
            stops,
            rotary,
            rounding,
            tiny,
        ]| Character {
            shortest,
            longest,
            tolerance,
            tolerance_changes,
            arcs,
            turns,
            smoothness,
            reversals,
            exact,
            stops,
            rotary,
            rounding,
            tiny,
        },
    )
}

pub fn draws(most: usize) -> impl Strategy<Value = Vec<Draw>> {
    prop::collection::vec(prop::array::uniform12(0.0..1.0f64), 2..most)
}

/// From `least` to `greatest`, evenly by the logarithm.
fn between(least: f64, greatest: f64, share: f64) -> f64 {
    least * (greatest / least).powf(share)
}

/// 0 for G64 without P.
fn tolerance_of(share: f64) -> f64 {
    if share < 0.15 {
        0.0
    } else {
        between(0.0005, 1.0, (share - 0.15) / 0.85)
    }
}

/// The moves of a random program from the origin. 1 micrometre to 1 m, lines, arcs and helices in
/// all planes, spirals, rotary axes, reversals, changes of P, G61, G61.1, stops.
pub fn program(character: &Character, draws: &[Draw]) -> Vec<ProgrammedMove> {
    let c = character;
    let shortest = between(0.001, 100.0, c.shortest * c.shortest);
    let longest = between(shortest, 1000.0, c.longest);
    let mut tolerance = tolerance_of(c.tolerance);
    let mut heading = 0.0f64;
    let mut at = Axes::zeros();
    let mut moves = Vec::new();
    for (k, draw) in draws.iter().enumerate() {
        let [
            kind,
            size,
            turn,
            way,
            third,
            more,
            change,
            p,
            mode,
            plane,
            rotary,
            feed,
        ] = *draw;
        if change < 0.2 * c.tolerance_changes {
            tolerance = tolerance_of(p);
        }
        // What the radius of a tool leaves of a corner that hardly is one.
        let is_tiny = c.tiny < 0.5 && (0.4..0.6).contains(&more);
        let length = if is_tiny {
            tolerance.max(0.001) * between(0.01, 0.3, size)
        } else {
            between(shortest, longest, size)
        };
        let (e1, e2, normal) = match (plane * 3.0) as usize {
            _ if plane < 0.5 || c.arcs < 0.3 => (0, 1, 2),
            1 => (1, 2, 0),
            _ => (2, 0, 1),
        };
        let mut end = at;
        if c.rotary < 0.4 && rotary < 0.5 {
            end[3] += length * (rotary - 0.25) * 20.0;
            end[5] += length * (third - 0.5) * 5.0;
        }
        let shape = if kind < c.arcs * c.arcs {
            if way > 0.6 {
                heading = TAU * turn;
            }
            let radius = (length * between(0.05, 10.0, third)).clamp(0.002, 2000.0);
            let angle = if more < 0.08 {
                TAU
            } else {
                (length / radius).min(6.0)
            };
            let sign = if turn < 0.5 { 1.0 } else { -1.0 };
            let mut center = Vector3::new(at[0], at[1], at[2]);
            center[e1] -= radius * sign * heading.sin();
            center[e2] += radius * sign * heading.cos();
            heading += sign * angle;
            let spiral = if more > 0.85 { 0.6 + p } else { 1.0 };
            if angle < TAU {
                end[e1] = center[e1] + spiral * radius * sign * heading.sin();
                end[e2] = center[e2] - spiral * radius * sign * heading.cos();
            }
            if more > 0.7 {
                end[normal] += length * (p - 0.5);
            }
            let mut axis = Vector3::zeros();
            axis[normal] = 1.0;
            let circle = Circle {
                center,
                normal: axis,
                revolutions: if sign > 0.0 { 0 } else { -1 },
            };
            Arc9::new(&at, &end, &circle).ok().map(Shape::Arc)
        } else {
            if more < 0.06 * c.reversals {
                heading += 0.5 * TAU;
            } else if turn < c.turns {
                heading = if way < c.smoothness {
                    heading + 2.0 * c.smoothness * (third - 0.5)
                } else {
                    TAU * third
                };
            }
            if c.rotary > 0.06 || p > 0.3 {
                end[e1] += length * heading.cos();
                end[e2] += length * heading.sin();
                if way > 0.8 {
                    end[normal] += length * (turn - 0.5);
                }
            }
            if c.rounding < 0.3 {
                let grid = tolerance.max(0.002) * between(0.1, 2.0, c.rounding / 0.3);
                end.apply(|x| *x = (*x / grid).round() * grid);
            }
            Line9::new(&at, &end).ok().map(Shape::Line)
        };
        let Some(shape) = shape else {
            continue;
        };
        let termination = if c.exact < 0.3 && mode < 0.2 {
            TerminationCondition::Exact
        } else if mode > 1.0 - 0.03 * c.stops {
            TerminationCondition::Stop
        } else {
            TerminationCondition::Continuous { tolerance }
        };
        moves.push(ProgrammedMove {
            serial: k as u64,
            shape,
            feed: if feed < 0.1 {
                between(0.1, 500.0, 10.0 * feed)
            } else {
                80.0
            },
            feed_word: FeedWord::of_tag(4800.0, UNITS_PER_MINUTE).filter(|_| feed >= 0.1),
            greatest_feed: 500.0,
            termination,
            stop_before: mode < 0.02 * c.stops,
            separate: mode > 0.9,
            may_swing_out: true,
            near_limit: NearLimit::NONE,
        });
        at = shape.end();
    }
    moves
}

/// What a displacement counts of a tolerance, which XYZ and UVW keep each by themselves.
pub fn counted(displacement: &Axes) -> f64 {
    let mut ends = [*displacement; 2];
    ends[0].fixed_rows_mut::<3>(6).fill(0.0);
    ends[1].fixed_rows_mut::<3>(0).fill(0.0);
    norm(&ends[0]).max(norm(&ends[1]))
}

/// The length of a displacement, degrees weighted.
pub fn norm(displacement: &Axes) -> f64 {
    let mut weighted = *displacement;
    for angle in weighted.iter_mut().skip(3).take(3) {
        *angle *= ROTARY_WEIGHT;
    }
    weighted.norm()
}

/// Something of a path that must never change again.
struct Witness {
    s: f64,
    position: Axes,
    third: Axes,
}

/// Adds a move, when the work is done that has to be done before.
pub fn add(path: &mut BlendedPath, queued: &ProgrammedMove) {
    for _ in 0..10_000 {
        match path.add(queued) {
            Err(BlendError::Full) => path.step(100),
            added => return assert_eq!(added, Ok(()), "move {}", queued.serial),
        };
    }
    panic!("move {} is not taken", queued.serial);
}

/// Adds moves one at a time with a budget each, and finishes. Checks budgets, the order of the
/// three ends, and that what was called final stays.
pub fn build(
    path: &mut BlendedPath,
    settings: &BlendSettings,
    moves: &[ProgrammedMove],
    budgets: &[usize],
) {
    path.restart(settings, &Axes::zeros());
    let mut witnesses: Vec<Witness> = Vec::new();
    let mut seen = 0.0f64;
    for (k, queued) in moves.iter().enumerate() {
        add(path, queued);
        let budget = budgets[k % budgets.len()];
        let spent = path.step(budget);
        assert!(spent <= budget + GREATEST_EXCESS);
        if budget.is_multiple_of(7) {
            path.flush();
        }
        assert!(path.final_end() >= seen, "the final end went back");
        assert!(path.final_end() <= path.known_end());
        assert!(path.known_end() <= path.programmed_end());
        // Of a first arc that waits nothing is known, but that it is there.
        let shares: &[f64] = if path.programmed_end() > 0.0 {
            &[0.1, 0.5, 0.9, 1.0]
        } else {
            &[]
        };
        for share in shares {
            let s = (seen + share * (path.final_end() - seen)).min(path.final_end());
            let point = path.point_before(s);
            witnesses.push(Witness {
                s,
                position: point.position,
                third: point.third,
            });
        }
        seen = path.final_end();
    }
    path.finish();
    for _ in 0..1_000_000 {
        if path.is_settled() {
            break;
        }
        path.step(1000);
    }
    assert!(path.is_settled(), "comes to an end");
    assert_eq!(path.known_end(), path.programmed_end());
    assert_eq!(path.final_end(), path.programmed_end());
    for witness in &witnesses {
        let point = path.point_before(witness.s);
        assert_eq!(point.position, witness.position, "changed at {}", witness.s);
        assert_eq!(point.third, witness.third, "changed at {}", witness.s);
    }
}

/// The path is not broken where legs meet: position, first and second derivative are continuous
/// but at stops, the third too between lines.
pub fn check_joints(path: &BlendedPath, moves: &[ProgrammedMove]) {
    let is_line = |serial: u64| {
        moves
            .iter()
            .any(|queued| queued.serial == serial && matches!(queued.shape, Shape::Line(_)))
    };
    let mut line_before = false;
    for vertex in path.vertices(0.0) {
        let line_after = is_line(path.leg(vertex.s).expect("a leg").serial);
        let (before, after) = (path.point_before(vertex.s), path.point(vertex.s));
        let jump = |of: fn(&PathPoint) -> Axes| (of(&before) - of(&after)).amax();
        assert!(jump(|point| point.position) <= 1e-9, "{vertex:?}");
        if vertex.stop {
            assert_eq!(vertex.reach, 0.0);
        } else {
            let bend = 1.0 + before.second.amax();
            assert!(jump(|point| point.first) < 1e-7, "{vertex:?}");
            assert!(jump(|point| point.second) < 1e-5 * bend, "{vertex:?}");
            if line_before && line_after {
                let change = 1.0 + before.third.amax();
                assert!(jump(|point| point.third) < 1e-6 * change, "{vertex:?}");
            }
        }
        line_before = line_after;
    }
}

/// Runs a test where there is room for a path.
pub fn with_path<T: Send + 'static>(
    test: impl FnOnce(&mut BlendedPath) -> T + Send + 'static,
) -> T {
    std::thread::Builder::new()
        .stack_size(32 << 20)
        .spawn(move || test(&mut BlendedPath::new()))
        .expect("a thread")
        .join()
        .unwrap_or_else(|reason| std::panic::resume_unwind(reason))
}

/// A line in XY.
pub fn line(serial: u64, from: (f64, f64), to: (f64, f64), tolerance: f64) -> ProgrammedMove {
    let at = |(x, y): (f64, f64)| Axes::from([x, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    ProgrammedMove {
        serial,
        shape: Shape::Line(Line9::new(&at(from), &at(to)).expect("a line")),
        feed: 100.0,
        feed_word: None,
        greatest_feed: 100.0,
        termination: TerminationCondition::Continuous { tolerance },
        stop_before: false,
        separate: false,
        may_swing_out: true,
        near_limit: NearLimit::NONE,
    }
}

/// A smooth contour as lines, rounded to a grid.
pub fn contour(step: f64, count: usize, tolerance: f64, grid: f64) -> Vec<ProgrammedMove> {
    let round = |x: f64| {
        if grid > 0.0 {
            (x / grid).round() * grid
        } else {
            x
        }
    };
    let (mut heading, mut x, mut y) = (0.0f64, 0.0f64, 0.0f64);
    let mut from = (0.0, 0.0);
    let mut moves = Vec::new();
    for k in 0..count {
        for j in 0..100 {
            let s = step * (k as f64 + 0.01 * f64::from(j));
            heading += 0.01 * step * (0.08 + 0.22 * (0.11 * s).sin() * (0.037 * s + 1.0).cos());
            x += 0.01 * step * heading.cos();
            y += 0.01 * step * heading.sin();
        }
        let to = (round(x), round(y));
        if to != from {
            moves.push(line(k as u64, from, to, tolerance));
            from = to;
        }
    }
    moves
}

pub fn settings() -> BlendSettings {
    blend_settings(20_000.0, DEFAULT_TOLERANCE)
}

pub fn fill(path: &mut BlendedPath, moves: &[ProgrammedMove]) {
    path.restart(&settings(), &Axes::zeros());
    for queued in moves {
        assert_eq!(path.add(queued), Ok(()));
        path.step(20_000);
    }
}

pub fn complete(path: &mut BlendedPath, moves: &[ProgrammedMove]) {
    fill(path, moves);
    path.finish();
    path.step(1_000_000);
    assert!(path.is_settled());
}

/// Where the machine comes to rest.
pub fn stops(path: &BlendedPath) -> Vec<f64> {
    path.vertices(0.0)
        .filter(|vertex| vertex.stop)
        .map(|vertex| vertex.s)
        .collect()
}
