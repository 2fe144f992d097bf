//! What the C interface of framekins answers to single calls: each code and each word.
#![allow(unsafe_code)]

mod abi_calls;

use std::ffi::CStr;

use abi_calls::words;
use framepath::abi::kinematics::{
    framepath_kinematics_configure, framepath_kinematics_configure_text,
    framepath_kinematics_tilt_axis,
};
use framepath::abi::kinematics_words::framepath_kinematics_refusal_text;

#[test]
fn parameters_of_the_kinematics_are_answered_one_by_one() {
    let configure = |coordinates: &CStr, machine: &CStr, tool_length: &CStr| {
        let mut letter = -1;
        // SAFETY: strings, and a number.
        let error = unsafe {
            framepath_kinematics_configure(
                coordinates.as_ptr(),
                machine.as_ptr(),
                tool_length.as_ptr(),
                &mut letter,
            )
        };
        (error, letter)
    };
    assert_eq!(framepath_kinematics_tilt_axis(), 0);
    for (coordinates, machine, tool_length, answer, says) in [
        (c"", c"", c"", (1, 0), "no axis is named"),
        (c"XYQ", c"", c"", (2, 3), "no axis letter"),
        (c"XXXXXXXXXXXXXXXXX", c"", c"", (3, 17), "16"),
        (c"XYZ", c"xyzac", c"", (4, 0), "X Y Z A C"),
        (c"XYZ", c"puma", c"", (5, 0), "machine=identity"),
        (c"XYZ", c"", c"long", (6, 0), "tool_length=frame"),
        (c"XYZ", c"identity", c"machine", (0, 0), "no error"),
    ] {
        assert_eq!(configure(coordinates, machine, tool_length), answer);
        assert!(words(framepath_kinematics_configure_text(answer.0)).contains(says));
    }
    assert_eq!(framepath_kinematics_tilt_axis(), 0);
    assert_eq!(configure(c"XYZAC", c"xyzac", c"frame"), (0, 0));
    assert_eq!(framepath_kinematics_tilt_axis(), 1);
    assert_eq!(configure(c"XYZBC", c"xyzbc", c""), (0, 0));
    assert_eq!(framepath_kinematics_tilt_axis(), 2);
    // A refusal leaves the machine as it is.
    assert_eq!(configure(c"XYZ", c"puma", c""), (5, 0));
    assert_eq!(framepath_kinematics_tilt_axis(), 2);
}

#[test]
fn each_refused_frame_has_its_words() {
    let text = |number| words(framepath_kinematics_refusal_text(number));
    for (number, says) in [
        (1, "no such command"),
        (2, "infinite"),
        (3, "scale factor is 0"),
        (4, "shift"),
        (5, "more operations"),
        (6, "no plane"),
        (7, "singular"),
        (8, "unequal"),
        (9, "thousandfold"),
        (10, "moves"),
        (11, "teleop"),
        (12, "switchkins-type"),
        (13, "0, 1 or 2"),
        (14, "does not have"),
        (15, "dimension"),
    ] {
        assert!(text(number).contains(says), "{number}: {}", text(number));
    }
    assert_eq!(text(0), "refused");
    assert_eq!(text(99), "refused");
}

/// Screens show 255 letters of a message; hal-component/framekins.c puts this before the words.
#[test]
fn the_words_of_a_refused_frame_are_shown_to_the_end() {
    for number in 0..100 {
        let text = words(framepath_kinematics_refusal_text(number));
        let message = format!("framekins: frame refused: {text}");
        assert!(message.len() <= 255, "{}: {message}", message.len());
    }
}
