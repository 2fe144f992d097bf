//! Whatever was called before: with everything set anew the planner runs a program as if nothing had been.

use framepath::abi::planner::settings::framepath_planner_set_blending;

use super::judge::{Kind, coordinates};
use super::planner::{Calls, Target};

/// The program takes a quarter of a second.
const MOST_CYCLES: usize = 5_000;

/// An abort takes at most so many servo periods with limits that make sense.
const MOST_BRAKING: usize = 200_000;

/// An abort brings a machine with limits that make sense to rest, whatever it was doing.
pub fn abort_ends(calls: &mut Calls) {
    calls.command(Target::Abort);
    for _ in 0..MOST_BRAKING {
        if calls.shared.tp().done != 0 {
            return;
        }
        calls.cycle();
    }
    panic!("an abort does not end");
}

/// Everything is set as a configuration and a start of a program do it.
fn set_anew(calls: &mut Calls) {
    calls.shared.hand_over_functions(true);
    calls.shared.hand_over_data(true);
    calls.shared.hand_over_inverse(None);
    calls.shared.set_limits([[100.0; 9], [1000.0; 9]]);
    let status = calls.shared.status();
    (status.feed_scale, status.rapid_scale) = (1.0, 1.0);
    (status.stepping, status.enables_new) = (0, 0x0f);
    calls.shared.config().numSpindles = 0;
    calls.adaptive = 1.0;
    // What stopped for a fault waits for the operator.
    calls.command(Target::Abort);
    calls.command(Target::Clear);
    calls.place(&[0.0; 9]);
    assert_eq!(calls.set_cycle_time(1e-3), 0, "the period is refused");
    calls.set_jerk(&[20_000.0; 9]);
    calls.set_map(false, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    // SAFETY: a handle of the planner.
    assert_eq!(0, unsafe {
        framepath_planner_set_blending(calls.shared.handle, 1.0, 0.0, 0.02)
    });
    calls.set_velocity_limit(1e3);
    calls.set_termination(2, 0.1);
    calls.set_spindle(0, 0.0, 0);
    calls.set_id(1);
}

/// Runs a short program to its end.
pub fn goes_on(calls: &mut Calls) {
    set_anew(calls);
    let ends = [[2.0, 0.0], [2.0, 1.0], [-1.0, 0.5]].map(|[x, y]| {
        let mut end = [0.0; 9];
        (end[0], end[1]) = (x, y);
        end
    });
    for end in &ends {
        assert_eq!(calls.plain_line(end, 40.0), 0, "a move is refused");
    }
    for _ in 0..MOST_CYCLES {
        calls.cycle();
        if calls.shared.tp().done != 0 {
            let position = coordinates(&calls.shared.tp().currentPos);
            assert_eq!(position, ends[2], "the end of the program");
            calls.check(Kind::Cycle);
            return;
        }
    }
    panic!("a program of three lines does not end");
}
