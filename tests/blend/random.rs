//! Random programs of all kinds: the blended path keeps its promises on every one.

use crate::common::*;
use framepath::path::{BlendSettings, BlendedPath};
use proptest::prelude::*;

fn check(
    path: &mut BlendedPath,
    settings: &BlendSettings,
    character: &Character,
    draws: &[Draw],
    budgets: &[usize],
) {
    let moves = program(character, draws);
    if moves.is_empty() {
        return;
    }
    build(path, settings, &moves, budgets);
    let greatest = greatest_deviation_with_tolerance(path, &moves);
    assert!(greatest <= 1.0, "deviates by {greatest} P");
    check_touched(path, &moves);
    check_joints(path, &moves);
    let end = path.point(path.known_end()).position;
    assert_eq!(end, path.goal(), "ends where the program ends");

    let mut last = (0, f64::INFINITY);
    for k in 0..=2000 {
        let s = path.known_end() * f64::from(k) / 2000.0;
        let progress = path.progress(s).expect("moves");
        assert!(progress.serial >= last.0);
        assert!(progress.serial > last.0 || progress.distance_to_go <= last.1 + 1e-12);
        last = (progress.serial, progress.distance_to_go);
        let point = path.point(s);
        for value in [point.position, point.first, point.second, point.third] {
            assert!(value.iter().all(|x| x.is_finite()));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: None,
        max_shrink_iters: 300,
        ..ProptestConfig::default()
    })]

    #[test]
    fn keeps_the_tolerance_and_never_takes_back_what_is_final(
        character in character(),
        draws in draws(120),
        budgets in prop::collection::vec(1..5000usize, 1..8),
        jerk in prop_oneof![Just(20_000.0), Just(f64::INFINITY), 1e3..1e5],
        default_tolerance in prop_oneof![3 => Just(DEFAULT_TOLERANCE), 1 => Just(0.0)],
    ) {
        let settings = blend_settings(jerk, default_tolerance);
        with_path(move |path| check(path, &settings, &character, &draws, &budgets));
    }
}
