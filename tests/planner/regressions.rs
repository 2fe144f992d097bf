//! Programs that once failed, each a text in `regressions` as `program/reader.rs` reads it: a test of its own, with the
//! name of its file. What a random test prints when it fails becomes such a file as it is, with the sentence that says
//! what went wrong as a comment at its top, and its name goes into the list here.

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::with_room;
use crate::program::reader::read;
use crate::program::run::run;

/// A test for each file, and the names of all of them.
macro_rules! regressions {
    ($($name:ident)*) => {
        const LISTED: &[&str] = &[$(stringify!($name)),*];

        $(
            #[test]
            fn $name() {
                let file = concat!("regressions/", stringify!($name), ".txt");
                check(file, include_str!(concat!("regressions/", stringify!($name), ".txt")));
            }
        )*
    };
}

regressions! {
    a_corner_that_begins_within_another_keeps_the_jerk
    a_crowd_of_nanometre_corners_keeps_the_jerk
    a_first_move_of_nanometres_starves_nobody
    a_first_phase_within_a_corner_keeps_the_jerk
    a_hold_as_the_rate_comes_to_one_keeps_the_jerk
    a_hold_in_the_last_period_leads_to_the_end
    a_last_move_in_exact_stop_is_run_to_its_end
    a_last_move_in_seldom_exact_stop_is_run_to_its_end
    a_line_of_a_nanometre_between_arcs_starves_nobody
    a_move_that_is_held_as_it_begins_goes_on
    a_narrow_corner_behind_a_reversal_keeps_the_jerk
    a_short_arc_between_wide_easements_keeps_the_jerk
    a_short_narrow_arc_within_wide_corners_keeps_the_jerk
    a_shorter_arc_between_wider_easements_keeps_the_jerk
    a_plan_that_is_late_does_not_end_the_path
    a_plan_too_fast_for_a_slow_move_behind_it_is_left_earlier
    a_rest_within_a_corner_is_left_along_it
    a_slow_stretch_of_nanometres_is_left_again
    a_soft_machine_comes_to_no_rest_before_a_wide_slow_corner
    a_soft_machine_leaves_a_helix_at_its_limits
    a_wide_corner_of_two_arcs_keeps_the_acceleration
    a_wide_peaked_corner_keeps_the_jerk
    an_arc_among_corners_of_nanometres_keeps_the_jerk
    an_arc_at_rest_finer_than_the_path_distance_is_given_up
    an_arc_that_is_paused_as_it_is_raised_goes_on
    any_limit_of_jerk_gives_a_plan
    arcs_without_a_jerk_limit_keep_the_acceleration
    merged_lines_between_rests_keep_the_limits_when_their_feed_is_raised
    moves_of_micrometres_do_not_stop_the_line_before_them
    steps_of_the_feed_ask_for_no_rest
    the_velocity_is_kept_between_two_places
    tiny_circles_behind_coarse_chords_ask_for_no_rest
    turns_between_two_nodes_keep_the_acceleration
    two_corners_that_meet_keep_the_jerk
}

/// Runs the programs of a file.
fn check(file: &str, text: &str) {
    let programs = read(text).unwrap_or_else(|error| panic!("{file}: {error}"));
    let mut periods = BTreeSet::new();
    for program in &programs {
        let ran = with_room(|| run(program));
        let ran = ran.unwrap_or_else(|error| panic!("{file}: {error}:\n\n{program}"));
        periods.insert(ran.periods);
    }
    let same = programs.iter().all(|program| program.asked.same_periods);
    assert!(!same || periods.len() == 1, "{file}: {periods:?} periods");
}

/// The files of the folder by their names.
fn found() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/planner/regressions");
    std::fs::read_dir(folder)
        .expect("tests/planner/regressions is there")
        .map(|entry| {
            let name = entry.expect("a file").file_name();
            let name = name.to_string_lossy();
            let program = name.strip_suffix(".txt");
            program
                .unwrap_or_else(|| panic!("regressions/{name} is no .txt file"))
                .to_owned()
        })
        .collect()
}

#[test]
fn no_file_is_forgotten() {
    let listed = LISTED.iter().map(|name| (*name).to_owned()).collect();
    let forgotten: Vec<_> = found().difference(&listed).cloned().collect();
    assert!(
        forgotten.is_empty(),
        "not in the list of regressions.rs: {forgotten:?}"
    );
}

#[test]
fn each_file_says_what_once_went_wrong() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/planner/regressions");
    for name in LISTED {
        let text = std::fs::read_to_string(folder.join(name).with_extension("txt"));
        let text = text.expect("a file of the list");
        assert!(
            text.starts_with("# ") && text.contains("\nask "),
            "regressions/{name}.txt: begins with no comment, or asks nothing"
        );
    }
}
