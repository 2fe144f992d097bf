//! What it gains that C may leave the program by more where it hardly turns the tool.

use crate::common::{equal_limits, feed_move, with_room};
use framepath::axes::Axes;
use framepath::moves::TerminationCondition;
use framepath::planner::{CycleInputs, Planner};

/// Seconds for 40 short moves with the tool tilted by `tilt` degrees, C going to and fro by 6 degrees.
fn time(tilt: f64, told: Option<usize>) -> f64 {
    with_room(|| {
        let mut planner = Planner::new();
        assert!(planner.set_cycle_time(1e-3));
        planner.set_limits(&equal_limits(20_000.0));
        planner.set_blending(1.0, 0.05, 0.02).expect("sound");
        planner.set_tilt_axis(told);
        planner.set_termination(TerminationCondition::Continuous { tolerance: 0.05 });
        let place = |k: i32, a: f64| {
            let c = 6.0 * f64::from(k % 2);
            Axes::from([f64::from(k), 0.0, 0.0, a, 0.0, c, 0.0, 0.0, 0.0])
        };
        planner.set_position(&place(0, tilt)).expect("finite");
        for k in 1..=40 {
            planner
                .add_line(&place(k, tilt), &feed_move(20.0))
                .expect("a line");
        }
        for cycle in 1..100_000 {
            let status = *planner.cycle(&CycleInputs::default());
            assert_eq!(status.fault, None);
            if status.done {
                return f64::from(cycle) * 1e-3;
            }
        }
        panic!("not done");
    })
}

#[test]
fn next_to_the_pole_it_is_faster_and_untold_as_before() {
    let (before, now) = (time(1.0, None), time(1.0, Some(3)));
    println!("A 1: {before} s -> {now} s");
    assert!(now < 0.9 * before, "{before} {now}");
    assert_eq!(time(90.0, Some(3)), time(90.0, None));
}
