//! Moves: queued, or refused with the reason.

use core::ffi::CStr;
use core::mem::MaybeUninit;

use libc::{c_char, c_double, c_int, c_uchar};
use nalgebra::Vector3;

use super::handle::Handle;
use crate::abi::linuxcnc::{
    EmcPose, PmCartesian, StateField, StateFieldFloat, StateFlag, TP_STRUCT, state_tag_t, tp_err_t,
};
use crate::abi::pose::axes_of;
use crate::axes::AXIS_COUNT;
use crate::moves::shape::{Circle, ShapeError};
use crate::moves::{
    FeedWord, INCHES, INVERSE_TIME, MotionType, STATE_TAG_SIZE, StateTag, UNITS_PER_MINUTE,
};
use crate::planner::{AddError, Added, LEAST_ACCELERATION, LEAST_VELOCITY, MoveRequest};

/// LinuxCNC's numbers of the codes that mean the machine itself: G28, G30, G53.
const MACHINE_CODES: [c_int; 3] = [280, 300, 530];

/// Whether a move was programmed in coordinates of the machine. A probing move (G38.2 to G38.5) never is: LinuxCNC takes none
/// of these codes with it, and hands it over with the tag of the move before.
fn means_the_machine(motion_type: MotionType, tag: &state_tag_t) -> bool {
    if motion_type == MotionType::Probing {
        return false;
    }
    let field = tag.fields.get(StateField::GM_FIELD_G_MODE_0 as usize);
    field.is_some_and(|code| MACHINE_CODES.contains(code))
}

impl Handle {
    /// What can be said against a move before its shape is known.
    fn objection(&self, motion_type: MotionType, tag: &state_tag_t) -> Option<&'static CStr> {
        if !self.usable_map {
            return Some(
                c"the frame in force scales by more than ten thousand or by what is no number, so that no limits can be kept: remove it first",
            );
        }
        (self.framed && means_the_machine(motion_type, tag)).then_some(
            c"G28, G30 and G53 mean the machine without its frame, which is in force: use o<machine_move> call, or remove the frame first",
        )
    }

    /// The planner keeps the limits of the axes as they are now.
    pub(super) fn renew_limits(&mut self) {
        let limits = self.limits();
        self.planner.set_limits(&limits);
    }

    /// The result of adding a move as LinuxCNC expects it; the words for a refusal are kept.
    fn answer(&mut self, result: Result<Added, AddError>) -> c_int {
        match result {
            Ok(Added::Queued) => {
                if let Some(answer) = self.answer_to_task() {
                    self.acknowledgement.hold(&answer);
                }
                tp_err_t::TP_ERR_OK
            }
            Ok(Added::ZeroLength) => tp_err_t::TP_ERR_ZERO_LENGTH,
            Err(error) => {
                self.refused = words(error);
                tp_err_t::TP_ERR_FAIL
            }
        }
    }
}

/// What is said of each axis that has no usable limits.
const WITHOUT_LIMITS: [&CStr; AXIS_COUNT] = {
    // The numbers in the words.
    assert!(LEAST_VELOCITY == 1e-9 && LEAST_ACCELERATION == 0.001);
    macro_rules! of {
        ($($letter:literal)*) => {
            [$(match CStr::from_bytes_with_nul(
                concat!("a move needs axis ", $letter, ", which has no usable limits: [AXIS_", $letter,
                        "]MAX_VELOCITY has to be 1e-9 at least, MAX_ACCELERATION .001\0").as_bytes(),
            ) {
                Ok(words) => words,
                Err(_) => panic!("a zero within"),
            }),*]
        };
    }
    of!("X" "Y" "Z" "A" "B" "C" "U" "V" "W")
};

/// Why a move was refused, for the operator.
fn words(error: AddError) -> &'static CStr {
    match error {
        AddError::Aborting => c"a move was sent while the machine comes to rest after an abort",
        AddError::QueueFull => c"a move was sent although the queue is full",
        AddError::NotConfigured => {
            c"a move was sent before the motion controller set its period and limits"
        }
        AddError::AxisLimits { axis } => WITHOUT_LIMITS
            .get(axis)
            .copied()
            .unwrap_or(c"a move needs an axis without limits"),
        AddError::Shape(ShapeError::ZeroLength) => c"a move of length zero",
        AddError::Shape(ShapeError::NotFinite) => {
            c"a move has a coordinate that is infinite or not a number"
        }
        AddError::Shape(ShapeError::TooFar) => {
            c"a move goes further than 1e7 units, or to a coordinate beyond 1e9: look at its coordinates and at the offsets in force"
        }
        AddError::Shape(ShapeError::NoNormal) => {
            c"an arc has no plane: the vector perpendicular to it is zero"
        }
        AddError::Shape(ShapeError::RadiusTooSmall) => c"an arc starts or ends at its own centre",
        AddError::Shape(ShapeError::TooManyRevolutions) => c"an arc has more turns than can be counted",
        AddError::Feed { .. } => {
            c"a move has no feed: F, or [TRAJ]MAX_LINEAR_VELOCITY and the [AXIS_L] limits, is below 1e-9 units per second or infinite"
        }
        AddError::PathJerk(_) => {
            c"the limit of jerk that LinuxCNC reckons for a move is negative, or less than a fifth of the acceleration: look at [AXIS_L]MAX_JERK and at ini.L.max_jerk"
        }
        AddError::Spindle { .. } => c"a move is to follow a spindle that does not exist",
        AddError::PerTurn(_) => {
            c"the feed per turn (F in G95) or the pitch (K) is negative or not a number"
        }
        AddError::ScaledPitch => {
            c"a thread (G33, G76) or a tap (G33.1) along an axis that the frame in force scales: its pitch would be scaled as well; remove the scale, and write the lengths that are meant"
        }
        AddError::RigidTap => c"a rigid tap (G33.1) has no spindle to follow, or I is not positive",
        AddError::Tripped => c"a move was sent after an error had stopped the motion; abort first",
    }
}

/// The F of the program.
fn feed_word_of(tag: &state_tag_t) -> Option<FeedWord> {
    const {
        assert!(INCHES == 1 << StateFlag::GM_FLAG_UNITS as u64);
        assert!(INVERSE_TIME == 1 << StateFlag::GM_FLAG_FEED_INVERSE_TIME as u64);
        assert!(UNITS_PER_MINUTE == 1 << StateFlag::GM_FLAG_FEED_UPM as u64);
    }
    let number = tag
        .fields_float
        .get(StateFieldFloat::GM_FIELD_FLOAT_FEED as usize)?;
    FeedWord::of_tag(f64::from(*number), tag.packed_flags)
}

fn tag_in(tag: &state_tag_t) -> StateTag {
    const { assert!(size_of::<state_tag_t>() == STATE_TAG_SIZE) };
    // SAFETY: of the same size; bytes that may be of no value, as those between the fields are, are valid whatever they are.
    StateTag(unsafe {
        core::mem::transmute_copy::<state_tag_t, [MaybeUninit<u8>; STATE_TAG_SIZE]>(tag)
    })
}

fn vector_of(cartesian: &PmCartesian) -> Vector3<f64> {
    Vector3::new(cartesian.x, cartesian.y, cartesian.z)
}

/// LinuxCNC's 0 says that it has no limit.
fn path_jerk_of(path_jerk: c_double) -> f64 {
    if path_jerk == 0.0 {
        f64::INFINITY
    } else {
        path_jerk
    }
}

#[allow(clippy::too_many_arguments)] // as above
fn request_of(
    motion_type: c_int,
    feed: c_double,
    max_velocity: c_double,
    path_jerk: c_double,
    enables: c_uchar,
    at_speed: c_char,
    indexer: c_int,
    tag: &state_tag_t,
) -> Option<MoveRequest> {
    Some(MoveRequest {
        motion_type: MotionType::from_number(motion_type)?,
        feed,
        max_velocity,
        path_jerk: path_jerk_of(path_jerk),
        enables,
        wait_for_spindle: at_speed != 0,
        indexer_joint: (indexer >= 0).then_some(indexer),
        tag: tag_in(tag),
    })
}

/// Queues a line. `path_jerk`: what LinuxCNC lets the jerk along the path be, units per second cubed, 0: not limited. Returns LinuxCNC's code: 0, 5 for a move of length zero, -1 for a refusal.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // LinuxCNC's tpAddLine has them
pub unsafe extern "C" fn framepath_planner_add_line(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    end: *const EmcPose,
    motion_type: c_int,
    feed: c_double,
    max_velocity: c_double,
    path_jerk: c_double,
    enables: c_uchar,
    at_speed: c_char,
    indexer: c_int,
    tag: *const state_tag_t,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp), Some(end), Some(tag)) =
        (unsafe { (handle.as_mut(), tp.as_mut(), end.as_ref(), tag.as_ref()) })
    else {
        return tp_err_t::TP_ERR_FAIL;
    };
    if handle.is_repeated() {
        return tp_err_t::TP_ERR_OK;
    }
    let Some(request) = request_of(
        motion_type,
        feed,
        max_velocity,
        path_jerk,
        enables,
        at_speed,
        indexer,
        tag,
    ) else {
        handle.refused = c"a line of a kind that is not known";
        return tp_err_t::TP_ERR_FAIL;
    };
    if let Some(objection) = handle.objection(request.motion_type, tag) {
        handle.refused = objection;
        return tp_err_t::TP_ERR_FAIL;
    }
    handle.renew_limits();
    handle.planner.set_feed_word(feed_word_of(tag));
    let result = handle.planner.add_line(&axes_of(end), &request);
    // Motion looks at the queue in the same period, before the planner runs.
    handle.report(tp);
    handle.answer(result)
}

/// Queues an arc, helix or spiral, with `path_jerk` as for a line. Returns LinuxCNC's code: 0, 5 for a move of length zero, -1 for a refusal.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // LinuxCNC's tpAddCircle has them
pub unsafe extern "C" fn framepath_planner_add_circle(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    end: *const EmcPose,
    center: *const PmCartesian,
    normal: *const PmCartesian,
    turn: c_int,
    motion_type: c_int,
    feed: c_double,
    max_velocity: c_double,
    path_jerk: c_double,
    enables: c_uchar,
    at_speed: c_char,
    tag: *const state_tag_t,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp), Some(end), Some(center), Some(normal), Some(tag)) = (unsafe {
        (
            handle.as_mut(),
            tp.as_mut(),
            end.as_ref(),
            center.as_ref(),
            normal.as_ref(),
            tag.as_ref(),
        )
    }) else {
        return tp_err_t::TP_ERR_FAIL;
    };
    if handle.is_repeated() {
        return tp_err_t::TP_ERR_OK;
    }
    let Some(request) = request_of(
        motion_type,
        feed,
        max_velocity,
        path_jerk,
        enables,
        at_speed,
        -1,
        tag,
    ) else {
        handle.refused = c"an arc of a kind that is not known";
        return tp_err_t::TP_ERR_FAIL;
    };
    let circle = Circle {
        center: vector_of(center),
        normal: vector_of(normal),
        revolutions: turn,
    };
    if let Some(objection) = handle.objection(request.motion_type, tag) {
        handle.refused = objection;
        return tp_err_t::TP_ERR_FAIL;
    }
    handle.renew_limits();
    handle.planner.set_feed_word(feed_word_of(tag));
    let result = handle.planner.add_circle(&axes_of(end), &circle, &request);
    // Motion looks at the queue in the same period, before the planner runs.
    handle.report(tp);
    handle.answer(result)
}

/// Queues a rigid tap: to `end` with the spindle, back with it `reversal_scale` times as fast, with `path_jerk` as for a
/// line. Returns LinuxCNC's code as
/// for a line.
///
/// # Safety
/// `handle` from `framepath_planner_create`; the others point to LinuxCNC's structures.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // LinuxCNC's tpAddRigidTap has them
pub unsafe extern "C" fn framepath_planner_add_rigid_tap(
    handle: *mut Handle,
    tp: *mut TP_STRUCT,
    end: *const EmcPose,
    max_velocity: c_double,
    path_jerk: c_double,
    enables: c_uchar,
    reversal_scale: c_double,
    tag: *const state_tag_t,
) -> c_int {
    // SAFETY: see above.
    let (Some(handle), Some(tp), Some(end), Some(tag)) =
        (unsafe { (handle.as_mut(), tp.as_mut(), end.as_ref(), tag.as_ref()) })
    else {
        return tp_err_t::TP_ERR_FAIL;
    };
    if handle.is_repeated() {
        return tp_err_t::TP_ERR_OK;
    }
    if let Some(objection) = handle.objection(MotionType::Feed, tag) {
        handle.refused = objection;
        return tp_err_t::TP_ERR_FAIL;
    }
    handle.renew_limits();
    let request = MoveRequest {
        motion_type: MotionType::Feed,
        feed: max_velocity,
        max_velocity,
        path_jerk: path_jerk_of(path_jerk),
        enables,
        wait_for_spindle: true,
        indexer_joint: None,
        tag: tag_in(tag),
    };
    let result = handle
        .planner
        .add_rigid_tap(&axes_of(end), reversal_scale, &request);
    handle.report(tp);
    handle.answer(result)
}

/// Why the last move was refused.
///
/// # Safety
/// `handle` from `framepath_planner_create`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn framepath_planner_error_text(handle: *const Handle) -> *const c_char {
    // SAFETY: see above.
    unsafe { handle.as_ref() }.map_or(c"there is no planner".as_ptr(), |handle| {
        handle.refused.as_ptr()
    })
}
