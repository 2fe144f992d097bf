//! What is said of a spindle that moves are coupled to.

use framepath::abi::linuxcnc::EMCMOT_MOTION_ERROR_BIT;
use framepath::abi::planner::run::framepath_planner_spindle_error_text;

use crate::abi_calls::motion::Shared;
use crate::abi_calls::moves::tag;
use crate::abi_calls::words;
use crate::{Machine, machine};

/// A thread, with what the spindle does in each period.
fn thread(machine: &mut Machine, mut spindle: impl FnMut(&mut Shared, usize)) -> Option<String> {
    machine.shared.config().numSpindles = 1;
    machine.shared.status().spindle_status[0].at_speed = 1;
    machine.follow_spindle(0, 1.0, 0);
    assert_eq!(machine.line(20.0, 2, &tag()), 0);
    for cycle in 0..22_000 {
        spindle(&mut machine.shared, cycle);
        machine.cycle();
        let (mut asked, mut greatest) = (-1.0, -1.0);
        // SAFETY: a handle, and numbers.
        let text = unsafe {
            framepath_planner_spindle_error_text(machine.shared.handle, &mut asked, &mut greatest)
        };
        if !text.is_null() {
            let flag = u32::from(machine.shared.status().motionFlag);
            assert_ne!(flag & EMCMOT_MOTION_ERROR_BIT, 0);
            return Some(format!("{} {asked:.0} {greatest:.0}", words(text)));
        }
        assert_eq!((asked, greatest), (0.0, 0.0));
        if machine.shared.tp().done != 0 {
            return None;
        }
    }
    panic!("a thread does not end");
}

/// A spindle that turns `direction` times so many turns a second, with an index.
fn turning(shared: &mut Shared, turns_a_second: f64, cycle: usize) {
    let shown = &mut shared.status().spindle_status[0];
    shown.speed = turns_a_second * 60.0;
    shown.direction = if turns_a_second < 0.0 { -1 } else { 1 };
    shown.spindleSpeedIn = turns_a_second;
    shown.spindleRevs += turns_a_second * 1e-3;
    if shown.spindle_index_enable != 0 && cycle.is_multiple_of(100) {
        (shown.spindle_index_enable, shown.spindleRevs) = (0, 0.0);
    }
}

#[test]
fn a_thread_follows_the_spindle_either_way() {
    for turns_a_second in [10.0, -10.0] {
        let mut machine = machine();
        let mut synchronised = false;
        let error = thread(&mut machine, |shared, cycle| {
            synchronised |= shared.status().spindleSync != 0;
            turning(shared, turns_a_second, cycle);
        });
        assert_eq!(error, None);
        assert!(synchronised);
        assert_eq!(machine.shared.tp().currentPos.tran.x, 20.0);
    }
}

#[test]
fn a_thread_that_outruns_the_axes_is_stopped_with_the_numbers() {
    let mut machine = machine();
    let error = thread(&mut machine, |shared, cycle| turning(shared, 150.0, cycle));
    let error = error.expect("the axis goes 100 units a second at most");
    assert!(error.contains("too fast"), "{error}");
    let numbers: Vec<f64> = error
        .rsplit(' ')
        .take(2)
        .map(|n| n.parse().unwrap())
        .collect();
    assert!(numbers[1] > 100.0 && numbers[0] <= 100.0, "{error}");
}

#[test]
fn feed_per_turn_follows_a_spindle_however_much_faster_than_commanded() {
    let mut machine = machine();
    machine.shared.config().numSpindles = 1;
    let mut asked = Vec::new();
    let reached = [600.0, 1200.0, -1200.0].map(|commanded| {
        machine.shared.status().spindle_status[0].speed = commanded;
        machine.shared.status().spindle_status[0].spindleSpeedIn = 0.0;
        machine.cycle();
        machine.follow_spindle(0, 0.5, 1);
        let from = machine.shared.tp().currentPos.tran.x;
        assert_eq!(machine.line(from + 20.0, 2, &tag()), 0);
        machine.shared.status().spindle_status[0].spindleSpeedIn = 100.0 * commanded.signum();
        let mut fastest = 0.0_f64;
        while machine.shared.tp().done == 0 {
            machine.cycle();
            fastest = fastest.max(machine.shared.status().current_vel);
            asked.push(machine.shared.status().requested_vel);
        }
        fastest
    });
    // Half a unit a turn, at 100 turns a second for the 10 or 20 that are commanded.
    for fastest in reached {
        assert!((fastest / 50.0 - 1.0).abs() < 1e-3, "{reached:?}");
    }
    // What is asked for is what the spindle turns.
    assert!(asked.contains(&50.0), "{asked:?}");
}

#[test]
fn a_spindle_that_does_not_turn_is_named() {
    let mut machine = machine();
    let error = thread(&mut machine, |shared, _| turning(shared, 0.0, 1));
    assert!(error.expect("no index").contains("index"));
}
