//! Feed per turn with a spindle that becomes much faster than it was when the moves were queued.

use crate::common::lathe::{Lathe, SPINDLE, fast, feed_of, keeps_limits, z};
use crate::common::with_machine;
use framepath::moves::TerminationCondition;

/// Has the spindle and the feed override come to these values, and runs for so many periods: no faster than both ask for.
fn rise(lathe: &mut Lathe, speed: f64, scale: f64, periods: usize) -> f64 {
    lathe.commanded = speed;
    lathe.machine.inputs.feed_scale = scale;
    let mut fastest = 0.0_f64;
    for _ in 0..periods {
        let velocity = lathe.cycle().current_velocity;
        let asked = lathe.speed * scale;
        assert!(velocity < 1.005 * asked + 1e-6, "{velocity} of {asked}");
        fastest = fastest.max(velocity);
    }
    fastest
}

#[test]
fn feed_per_turn_follows_a_spindle_however_much_faster_it_becomes() {
    let exact = TerminationCondition::Exact;
    let blended = TerminationCondition::Continuous { tolerance: 0.05 };
    let one: &[f64] = &[250.0];
    let many: &[f64] = &[1.0, 3.0, 20.0, 40.0, 45.0, 90.0, 250.0];
    for (ends, condition) in [(one, exact), (many, exact), (many, blended)] {
        for (at_first, speed, scale) in [(1.0 / 60.0, 5.0, 1.0), (5.0, 30.0, 1.0), (5.0, 10.0, 2.0)]
        {
            with_machine(|machine| {
                let mut lathe = Lathe::new(machine, at_first);
                lathe.machine.planner.set_termination(condition);
                let planner = &mut lathe.machine.planner;
                planner.set_spindle_synchronisation(SPINDLE as i32, 1.0, true);
                for end in ends {
                    lathe.machine.line(z(*end), &fast()).expect("a line");
                }
                rise(&mut lathe, at_first, 1.0, 500);
                rise(&mut lathe, speed, scale, 3000);
                let case = format!("{at_first} {speed} {scale} {condition:?} {}", ends.len());
                let share = feed_of(&lathe) / (speed * scale);
                assert!((share - 1.0).abs() < 1e-3, "{case}: {share}");
                // And back again.
                lathe.commanded = 4.0;
                for _ in 0..2000 {
                    lathe.cycle();
                }
                let share = feed_of(&lathe) / (4.0 * scale);
                assert!((share - 1.0).abs() < 1e-3, "{case}: {share}");
                lathe.commanded = 40.0;
                lathe.run(40_000);
                assert_eq!(lathe.machine.planner.status().position, z(250.0));
                keeps_limits(lathe.machine);
            });
        }
    }
}

#[test]
fn corners_keep_the_limits_of_the_axes_however_much_faster_the_spindle_becomes() {
    with_machine(|machine| {
        let mut lathe = Lathe::new(machine, 1.0);
        let blended = TerminationCondition::Continuous { tolerance: 0.05 };
        lathe.machine.planner.set_termination(blended);
        let planner = &mut lathe.machine.planner;
        planner.set_spindle_synchronisation(SPINDLE as i32, 1.0, true);
        for n in 1..20 {
            let mut end = z(5.0 * f64::from(n));
            end[0] = f64::from(n % 3);
            lathe.machine.line(end, &fast()).expect("a line");
        }
        rise(&mut lathe, 1.0, 1.0, 500);
        let fastest = rise(&mut lathe, 40.0, 1.0, 8000);
        assert!(fastest > 0.99 * 40.0, "{fastest}");
        assert!(lathe.machine.planner.status().done);
        keeps_limits(lathe.machine);
    });
}
