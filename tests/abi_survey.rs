//! What the C interface of blendtp tells an operator.
#![allow(unsafe_code)]

mod abi_calls;

use abi_calls::motion::Shared;
use abi_calls::moves::{pose_of, tag};
use framepath::abi::planner::add::framepath_planner_add_line;
use framepath::abi::planner::run::framepath_planner_run_cycle;
use framepath::abi::planner::survey::{
    FRAMEPATH_LIMIT_AXIS_JERK, FRAMEPATH_LIMIT_AXIS_VELOCITY, FRAMEPATH_LIMIT_FEED,
    FRAMEPATH_LIMIT_HOLD, FRAMEPATH_LIMIT_NOTHING, FRAMEPATH_LIMIT_OVERRIDE, FramepathSurvey,
    framepath_planner_survey,
};

/// LinuxCNC's number of a move at feed.
const EMC_MOTION_TYPE_FEED: i32 = 2;

const NONE: FramepathSurvey = FramepathSurvey {
    limit: FRAMEPATH_LIMIT_NOTHING,
    axis: -1,
    joint: -1,
    moves_queued: 0,
    moves_ahead: 0,
    moves_done: 0,
    line: 0,
    stands: true,
    to_go: 0.0,
    seconds_ahead: 0.0,
    seconds_queued: 0.0,
};

fn survey(shared: &Shared) -> FramepathSurvey {
    let mut survey = NONE;
    // SAFETY: a handle, and room for what is answered.
    assert_eq!(0, unsafe {
        framepath_planner_survey(shared.handle, &mut survey)
    });
    survey
}

fn cycles(shared: &Shared, count: usize) -> FramepathSurvey {
    for _ in 0..count {
        // SAFETY: a handle and motmod's structure.
        unsafe { framepath_planner_run_cycle(shared.handle, shared.tp) };
    }
    survey(shared)
}

#[test]
fn a_move_from_its_start_to_its_end() {
    let mut shared = Shared::new();
    shared.make_ready();
    let before = survey(&shared).moves_done;
    let along_y = [0.0, 50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let end = pose_of(&along_y);
    // SAFETY: a handle, and structures.
    assert_eq!(0, unsafe {
        framepath_planner_add_line(
            shared.handle,
            shared.tp,
            &end,
            EMC_MOTION_TYPE_FEED,
            50.0,
            100.0,
            0.0,
            0xff,
            0,
            -1,
            &tag(),
        )
    });
    let at_feed = cycles(&shared, 300);
    assert_eq!((at_feed.limit, at_feed.axis), (FRAMEPATH_LIMIT_FEED, -1));
    assert_eq!((at_feed.moves_queued, at_feed.moves_ahead), (1, 1));
    assert_eq!(at_feed.moves_done, before);
    assert!(
        !at_feed.stands && at_feed.to_go > 30.0 && at_feed.to_go < 45.0,
        "{at_feed:?}"
    );
    // Half of the corner with the next move stays open as long as it may come in time.
    assert!(
        at_feed.seconds_ahead > 0.5 && at_feed.seconds_queued >= at_feed.seconds_ahead,
        "{at_feed:?}"
    );
    shared.status().feed_scale = 0.5;
    shared.status().net_feed_scale = 0.5;
    assert_eq!(cycles(&shared, 200).limit, FRAMEPATH_LIMIT_OVERRIDE);
    shared.status().net_feed_scale = 0.0;
    let held = cycles(&shared, 200);
    assert_eq!((held.limit, held.stands), (FRAMEPATH_LIMIT_HOLD, true));
    shared.status().feed_scale = 2.0;
    shared.status().net_feed_scale = 2.0;
    let seen: Vec<_> = (0..2000).map(|_| cycles(&shared, 1)).collect();
    let axis = |limit| {
        seen.iter()
            .find(|now| now.limit == limit)
            .map(|now| now.axis)
    };
    assert!(axis(FRAMEPATH_LIMIT_AXIS_VELOCITY).is_none_or(|axis| axis == 1));
    assert!(axis(FRAMEPATH_LIMIT_AXIS_JERK).is_none_or(|axis| axis == 1));
    let moves_done = before + 1;
    assert_eq!(seen.last(), Some(&FramepathSurvey { moves_done, ..NONE }));
    let mut out = NONE;
    // SAFETY: null is refused.
    unsafe {
        assert_eq!(framepath_planner_survey(std::ptr::null(), &mut out), -1);
        assert_eq!(
            framepath_planner_survey(shared.handle, std::ptr::null_mut()),
            -1
        );
    }
}
