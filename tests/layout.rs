//! The structures that motmod shares with us: the C compiler, our Rust types and the numbers written here agree.
//!
//! The numbers are those of LinuxCNC 2.9 (2.9.0~pre1, 2.9.4 and 2.9.10) and of 2.10.0~pre1. If this test fails after an
//! update of LinuxCNC, its headers have changed: read what changed, then write the new numbers.
#![allow(unsafe_code)]

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char};
use std::mem::{offset_of, size_of};

use framepath::abi::linuxcnc::{EmcPose, TP_STRUCT, emcmot_config_t, emcmot_status_t, state_tag_t};

#[repr(C)]
struct Entry {
    name: *const c_char,
    value: usize,
}

unsafe extern "C" {
    static framepath_layout: [Entry; 0];
    static framepath_layout_length: usize;
}

/// What the C compiler says (src/abi/layout.c).
fn in_c() -> BTreeMap<String, usize> {
    // SAFETY: layout.c defines the table with this length, of static strings, and never writes to it.
    let entries =
        unsafe { std::slice::from_raw_parts(framepath_layout.as_ptr(), framepath_layout_length) };
    entries
        .iter()
        .map(|entry| {
            // SAFETY: as above.
            let name = unsafe { CStr::from_ptr(entry.name) };
            (name.to_string_lossy().into_owned(), entry.value)
        })
        .collect()
}

macro_rules! size {
    ($name:literal, $type:ty, $written:expr) => {
        ($name, size_of::<$type>(), $written)
    };
}
macro_rules! offset {
    ($name:literal, $type:ty, $field:ident, $written:expr) => {
        ($name, offset_of!($type, $field), $written)
    };
}

/// Which of the two numbers counts, by what tells the series apart: in 2.10 the tag has a file name.
fn series() -> usize {
    match size_of::<state_tag_t>() {
        64 => 0,
        384 => 1,
        other => panic!("no LinuxCNC that is known has a state tag of {other} bytes"),
    }
}

#[test]
fn c_rust_and_the_written_numbers_agree() {
    let table = [
        size!("sizeof EmcPose", EmcPose, [72, 72]),
        offset!("EmcPose.tran", EmcPose, tran, [0, 0]),
        offset!("EmcPose.a", EmcPose, a, [24, 24]),
        offset!("EmcPose.u", EmcPose, u, [48, 48]),
        offset!("EmcPose.w", EmcPose, w, [64, 64]),
        size!("sizeof struct state_tag_t", state_tag_t, [64, 384]),
        offset!(
            "struct state_tag_t.fields_float",
            state_tag_t,
            fields_float,
            [0, 0]
        ),
        offset!("struct state_tag_t.fields", state_tag_t, fields, [20, 88]),
        offset!(
            "struct state_tag_t.packed_flags",
            state_tag_t,
            packed_flags,
            [56, 120]
        ),
        size!("sizeof TP_STRUCT", TP_STRUCT, [1024, 1352]),
        offset!("TP_STRUCT.queue", TP_STRUCT, queue, [0, 0]),
        offset!("TP_STRUCT.spindle", TP_STRUCT, spindle, [40, 40]),
        offset!("TP_STRUCT.currentPos", TP_STRUCT, currentPos, [72, 72]),
        offset!("TP_STRUCT.goalPos", TP_STRUCT, goalPos, [144, 144]),
        offset!("TP_STRUCT.queueSize", TP_STRUCT, queueSize, [216, 216]),
        offset!("TP_STRUCT.execId", TP_STRUCT, execId, [300, 308]),
        offset!("TP_STRUCT.done", TP_STRUCT, done, [372, 700]),
        offset!("TP_STRUCT.depth", TP_STRUCT, depth, [376, 704]),
        offset!("TP_STRUCT.activeDepth", TP_STRUCT, activeDepth, [380, 708]),
        offset!("TP_STRUCT.aborting", TP_STRUCT, aborting, [384, 712]),
        offset!("TP_STRUCT.pausing", TP_STRUCT, pausing, [388, 716]),
        offset!("TP_STRUCT.reverse_run", TP_STRUCT, reverse_run, [392, 720]),
        offset!("TP_STRUCT.motionType", TP_STRUCT, motionType, [396, 724]),
        size!("sizeof emcmot_status_t", emcmot_status_t, [5632, 6024]),
        offset!(
            "emcmot_status_t.feed_scale",
            emcmot_status_t,
            feed_scale,
            [16, 16]
        ),
        offset!(
            "emcmot_status_t.rapid_scale",
            emcmot_status_t,
            rapid_scale,
            [24, 24]
        ),
        offset!(
            "emcmot_status_t.net_feed_scale",
            emcmot_status_t,
            net_feed_scale,
            [40, 40]
        ),
        offset!(
            "emcmot_status_t.enables_queued",
            emcmot_status_t,
            enables_queued,
            [48, 48]
        ),
        offset!(
            "emcmot_status_t.spindleSync",
            emcmot_status_t,
            spindleSync,
            [2048, 2048]
        ),
        offset!(
            "emcmot_status_t.spindle_status",
            emcmot_status_t,
            spindle_status,
            [2056, 2056]
        ),
        offset!(
            "emcmot_status_t.distance_to_go",
            emcmot_status_t,
            distance_to_go,
            [5352, 5696]
        ),
        offset!("emcmot_status_t.dtg", emcmot_status_t, dtg, [5360, 5704]),
        offset!(
            "emcmot_status_t.current_vel",
            emcmot_status_t,
            current_vel,
            [5432, 5776]
        ),
        offset!(
            "emcmot_status_t.requested_vel",
            emcmot_status_t,
            requested_vel,
            [5440, 5784]
        ),
        offset!(
            "emcmot_status_t.tcqlen",
            emcmot_status_t,
            tcqlen,
            [5448, 5840]
        ),
        offset!(
            "emcmot_status_t.stepping",
            emcmot_status_t,
            stepping,
            [5620, 6012]
        ),
        size!("sizeof emcmot_config_t", emcmot_config_t, [128, 128]),
        offset!(
            "emcmot_config_t.numSpindles",
            emcmot_config_t,
            numSpindles,
            [16, 16]
        ),
        offset!("emcmot_config_t.numDIO", emcmot_config_t, numDIO, [24, 24]),
        offset!("emcmot_config_t.numAIO", emcmot_config_t, numAIO, [28, 28]),
        offset!(
            "emcmot_config_t.trajCycleTime",
            emcmot_config_t,
            trajCycleTime,
            [40, 40]
        ),
    ];
    let in_c = in_c();
    assert_eq!(
        in_c.len(),
        table.len(),
        "layout.c and this table list the same fields"
    );
    for (name, in_rust, written) in table {
        let compiler = in_c
            .get(name)
            .unwrap_or_else(|| panic!("layout.c has no {name}"));
        assert_eq!(*compiler, in_rust, "{name}: C compiler against Rust");
        assert_eq!(
            in_rust,
            written[series()],
            "{name}: LinuxCNC's headers against the number written here"
        );
    }
}
