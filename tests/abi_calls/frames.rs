//! Calls of the kinematics in the order and with the values that bytes say, and what holds after each of them.

use std::ffi::{CStr, CString, c_int};
use std::ptr::{null, null_mut};

use framepath::abi::kinematics::{
    framepath_frame_inputs, framepath_frame_outputs, framepath_kinematics_configure,
    framepath_kinematics_configure_text, framepath_kinematics_forward,
    framepath_kinematics_inverse, framepath_kinematics_linear_map, framepath_kinematics_switch,
    framepath_kinematics_tilt_axis, framepath_kinematics_update,
};
use framepath::abi::kinematics_jet::framepath_kinematics_tool_tilt_axis;
use framepath::abi::kinematics_words::framepath_kinematics_refusal_text;
use framepath::abi::linuxcnc::EmcPose;
use framepath::abi::switch_place::{
    framepath_kinematics_jumps_behind_switch, framepath_kinematics_take_offsets_off,
};

use super::choices::Choices;
use super::judge::coordinates;

const MOST_CALLS: usize = 3_000;

const JOINTS: usize = 16;

/// The greatest numbers of reasons that are documented.
const LAST_REFUSAL: c_int = 64;
const LAST_NORMAL_REFUSAL: c_int = 7;

/// What a joint may move by when kinematics are switched, over its position: rounding behind scales of up to a
/// thousand, forth and back.
const STILL: f64 = 1e-8;

/// framekins with HAL and motion around it.
struct Calls {
    pins: framepath_frame_inputs,
    shown: framepath_frame_outputs,
    joints: [f64; JOINTS],
    number: f64,
    /// The kinematics type that motion was asked for last.
    asked: f64,
    /// Whether motion.switchkins-type is linked.
    linked: bool,
    configured: bool,
}

/// Runs a case: no panic, and everything that is judged.
pub fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let mut calls = Calls::new(&mut choices);
    for _ in 0..MOST_CALLS {
        if choices.is_spent() {
            break;
        }
        calls.call(&mut choices);
    }
    calls.goes_on();
}

/// A text for a parameter: one of those there are, or any bytes.
fn text(choices: &mut Choices, known: &[&str]) -> CString {
    if choices.is_strange() {
        let length = choices.below(24);
        let bytes: Vec<u8> = (0..length).map(|_| choices.byte().max(1)).collect();
        return CString::new(bytes).expect("no zero in it");
    }
    let known = known[choices.below(known.len())];
    CString::new(known).expect("no zero in it")
}

impl Calls {
    fn new(choices: &mut Choices) -> Self {
        let mut calls = Self {
            // SAFETY: plain numbers.
            pins: unsafe { std::mem::zeroed() },
            // SAFETY: plain numbers.
            shown: unsafe { std::mem::zeroed() },
            joints: [0.0; JOINTS],
            number: 0.0,
            asked: 0.0,
            linked: true,
            configured: false,
        };
        calls.configure(c"", c"", c"");
        calls.choose_machine(choices);
        calls
    }

    fn configure(&mut self, coordinates: &CStr, machine: &CStr, tool_length: &CStr) -> c_int {
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
        assert!((0..=6).contains(&error));
        let length = coordinates.to_bytes().len();
        assert!((0..=length as c_int).contains(&letter));
        // SAFETY: a static string.
        let words = unsafe { CStr::from_ptr(framepath_kinematics_configure_text(error)) };
        assert!(!words.is_empty());
        if error == 0 {
            self.pins = neutral();
            self.joints = [0.0; JOINTS];
            self.asked = 0.0;
            self.number = 0.0;
            self.configured = true;
        }
        error
    }

    fn choose_machine(&mut self, choices: &mut Choices) {
        let coordinates = text(
            choices,
            &[
                "XYZ",
                "XYZAC",
                "XYZBC",
                "XYZABCUVW",
                "XZ",
                "XYYZ",
                "",
                "xyzq",
            ],
        );
        let machine = text(choices, &["", "identity", "xyzac", "xyzbc", "puma"]);
        let tool_length = text(choices, &["", "frame", "machine", "tool"]);
        if choices.rarely(3) {
            self.configure(&coordinates, &machine, &tool_length);
            return;
        }
        let (coordinates, machine) = match choices.below(4) {
            0 => (c"XYZ", c""),
            1 => (c"XYZABCUVW", c"identity"),
            2 => (c"XYZAC", c"xyzac"),
            _ => (c"XYZBC", c"xyzbc"),
        };
        assert_eq!(self.configure(coordinates, machine, c"frame"), 0);
    }

    fn call(&mut self, choices: &mut Choices) {
        match choices.below(64) {
            0..24 => self.choose_command(choices),
            24..36 => {
                for _ in 0..choices.one_of([1, 1, 2, 120]) {
                    self.period();
                }
            }
            36..42 => self.choose_joints(choices),
            42..46 => self.choose_pose(choices),
            46..50 => self.choose_offsets(choices),
            50..53 => self.choose_table(choices),
            53..55 => self.choose_map(choices),
            55..58 => self.choose_state(choices),
            58 => self.switch_to_any(choices),
            59 => self.switch_while_removing(choices),
            60 => self.pins.command = choices.or_strange(1e6),
            61 => self.choose_machine(choices),
            62 => self.linked = choices.rarely(2),
            _ => self.call_with_nothing(choices),
        }
    }

    // ---- a servo period ----

    /// framekins takes commands, and motion switches if it is asked and listens.
    fn period(&mut self) {
        // SAFETY: structures of the interface.
        unsafe { framepath_kinematics_update(&self.pins, &mut self.shown) };
        self.check_shown();
        if self.shown.switchkins_type != self.asked && self.linked {
            self.switch(self.shown.switchkins_type as c_int);
        }
    }

    fn check_shown(&self) {
        let shown = &self.shown;
        // Where motion asked for another type, that is what it remembers.
        assert_eq!(
            shown.switchkins_type,
            f64::from(shown.switchkins_type as c_int)
        );
        assert!((0..=2).contains(&shown.slot));
        for truth in [
            shown.active,
            shown.tool_centre_point,
            shown.parameters_pending,
            shown.tool_length_matters,
        ] {
            assert!((0..=1).contains(&truth));
        }
        assert!(shown.active == 0 || shown.slot != 0, "a frame in type 0");
        assert!(shown.operations >= 0);
        assert!((0..=LAST_REFUSAL).contains(&shown.refusal));
        assert!((0..=LAST_NORMAL_REFUSAL).contains(&shown.normal_refusal));
        assert!((0..=1).contains(&shown.retract_kind), "a table stands");
        for (name, value) in [
            ("acknowledged", shown.acknowledged),
            ("normal tilt", shown.normal_tilt),
            ("normal rotary", shown.normal_rotary),
            ("retract way X", shown.retract_way[0]),
            ("retract way Z", shown.retract_way[2]),
            ("retract Z", shown.retract_z),
            ("tool offset X", shown.tool_offset[0]),
            ("tool offset Y", shown.tool_offset[1]),
            ("tool offset Z", shown.tool_offset[2]),
        ] {
            assert!(value.is_finite(), "{name} is {value}");
        }
    }

    /// A switch that is refused changes nothing, one that is not moves no joint.
    fn switch(&mut self, slot: c_int) {
        self.asked = slot.into();
        let (before, framed) = linear_map();
        // Where the joints stand, motion asks for the pose.
        let standing = forward(&self.joints);
        // SAFETY: a structure of the interface.
        let refusal = unsafe { framepath_kinematics_switch(slot, &self.pins) };
        assert!(refusal >= 0 || !self.configured);
        // SAFETY: a static string.
        let words = unsafe { CStr::from_ptr(framepath_kinematics_refusal_text(refusal)) };
        assert!(!words.is_empty());
        if refusal != 0 {
            assert_eq!(linear_map(), (before, framed), "refused with {refusal}");
            assert_eq!(forward(&self.joints).is_some(), standing.is_some());
            return;
        }
        assert!((0..=2).contains(&slot));
        // With the machine off teleop is no obstacle to removing a frame.
        assert!(self.pins.teleop == 0 || self.pins.enabled == 0 && linear_map().1 == 0);
        assert_ne!(self.pins.in_position, 0);
        self.check_round_trip();
    }

    /// Back from the pose the joints are where they were.
    fn check_round_trip(&self) {
        let Some(world) = forward(&self.joints) else {
            return;
        };
        let mut joints = self.joints;
        // SAFETY: a pose and 16 numbers.
        if unsafe { framepath_kinematics_inverse(&world, joints.as_mut_ptr()) } != 0 {
            return;
        }
        let size = |size: f64, at: &f64| size.max(at.abs());
        let greatest = self.joints.iter().fold(1.0, size);
        let table = self.pins.rotation_point.iter().chain(&self.pins.offset);
        let pose = coordinates(&world);
        let greatest = table.chain(&pose).fold(greatest, size);
        let greatest = self.pins.map.iter().fold(greatest, size);
        if greatest > 1e6 {
            return;
        }
        for (joint, (now, before)) in joints.iter().zip(&self.joints).enumerate() {
            let difference = (now - before).abs();
            assert!(
                difference <= STILL * greatest,
                "joint {joint}: {before} becomes {now}"
            );
        }
    }

    // ---- values ----

    fn choose_command(&mut self, choices: &mut Choices) {
        let code = choices.one_of([
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 101, 102, 103, 104, 105, 106, 107, 108, 110,
            0, 14, 999, 500,
        ]);
        let code = choices.or_strange(f64::from(code));
        self.number += 1.0;
        self.pins.command = self.number * 1000.0 + code;
        let size = choices.one_of([1.0, 2.0, 50.0, 180.0, 1e3]);
        for value in &mut self.pins.value {
            *value = choices.one_of([0.0, 1.0, 2.0, size, -size]);
            *value = choices.or_strange(*value);
        }
        self.sign();
        if choices.rarely(30) {
            self.pins.check = choices.or_strange(1.0);
        }
        self.period();
    }

    /// The check that belongs to what is on the pins, as the subroutines send it.
    fn sign(&mut self) {
        let pins = &self.pins;
        let [a, b, c] = pins.value;
        let [x, y, z] = pins.work_offset;
        let sent = [pins.command, a, b, c, x, y, z, pins.work_rotation];
        let primes = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];
        let parts = primes.iter().zip(sent);
        self.pins.check = parts.map(|(prime, part)| prime.sqrt() * part).sum();
    }

    fn choose_joints(&mut self, choices: &mut Choices) {
        for joint in &mut self.joints[..9] {
            *joint = choices.between(-200.0, 200.0);
        }
        // Joints of the same axis stand at the same place, those of none anywhere.
        if let Some(world) = forward(&self.joints) {
            let mut joints = [0.0; JOINTS];
            // SAFETY: a pose and 16 numbers.
            if unsafe { framepath_kinematics_inverse(&world, joints.as_mut_ptr()) } == 0 {
                assert!(joints.iter().all(|joint| joint.is_finite()), "{joints:?}");
                self.joints = joints;
            }
            self.check_round_trip();
        } else {
            self.joints = [0.0; JOINTS];
        }
    }

    fn choose_pose(&mut self, choices: &mut Choices) {
        let [x, y, z, a, b, c] = [(); 6].map(|()| choices.between(-1e3, 1e3));
        // SAFETY: plain numbers.
        let mut world: EmcPose = unsafe { std::mem::zeroed() };
        (world.tran.x, world.tran.y, world.tran.z) = (x, y, z);
        (world.a, world.b, world.c) = (a, b, c);
        let mut joints = [0.0; JOINTS];
        // SAFETY: a pose and 16 numbers.
        let answer = unsafe { framepath_kinematics_inverse(&world, joints.as_mut_ptr()) };
        assert!(answer == 0 || answer == -1);
        if answer == 0 {
            assert!(joints.iter().all(|joint| joint.is_finite()), "{joints:?}");
        }
    }

    fn choose_offsets(&mut self, choices: &mut Choices) {
        for axis in 0..3 {
            self.pins.work_offset[axis] = choices.between(-500.0, 500.0);
            self.pins.tool_offset[axis] = choices.between(-100.0, 200.0);
        }
        self.pins.work_rotation = choices.one_of([0.0, 0.0, 30.0, 90.0]);
        self.pins.work_rotation = choices.or_strange(self.pins.work_rotation);
        self.pins.tool_length_machine = choices.integer(0);
    }

    fn choose_table(&mut self, choices: &mut Choices) {
        for axis in 0..3 {
            self.pins.rotation_point[axis] = choices.between(-100.0, 100.0);
            self.pins.offset[axis] = choices.between(-50.0, 50.0);
        }
        self.pins.table_tool_offset = choices.between(0.0, 200.0);
        self.pins.tool_centre_point = choices.flag().into();
        self.pins.conventional_directions = choices.flag().into();
        for range in [&mut self.pins.tilt_range, &mut self.pins.rotary_range] {
            *range = [choices.between(-120.0, 0.0), choices.between(0.0, 400.0)];
        }
    }

    fn choose_map(&mut self, choices: &mut Choices) {
        for (index, element) in self.pins.map.iter_mut().enumerate() {
            let diagonal = f64::from(index % 5 == 0);
            *element = choices.one_of([diagonal, diagonal, 0.0, 0.5, -1.0]);
            *element = choices.or_strange(*element);
        }
        for mirrored in &mut self.pins.mirror {
            *mirrored = choices.one_of([0, 0, 1, -7]);
        }
    }

    fn choose_state(&mut self, choices: &mut Choices) {
        self.pins.in_position = choices.one_of([1, 1, 0]);
        self.pins.teleop = choices.one_of([0, 0, 1]);
        self.pins.enabled = choices.one_of([1, 1, 1, 0]);
        self.pins.release_on_abort = choices.one_of([0, 1]);
        self.pins.release = choices.one_of([0, 0, 1]);
        self.pins.releases_seen = choices.one_of([self.shown.releases, 0, -1]);
        self.pins.heartbeat = u32::from(choices.byte());
        self.pins.period = choices.one_of([1e-3, 0.0, 0.5, f64::NAN]);
        self.pins.clock = i64::from(choices.byte()) * 10_000_000;
    }

    fn switch_to_any(&mut self, choices: &mut Choices) {
        let slot = choices.one_of([0, 1, 2, 3]);
        let slot = choices.integer(slot);
        self.switch(slot);
    }

    /// With the machine off the frame has to go, even in teleop; motion does not listen, and somebody switches by hand.
    fn switch_while_removing(&mut self, choices: &mut Choices) {
        let linked = std::mem::replace(&mut self.linked, false);
        (self.pins.enabled, self.pins.release_on_abort) = (0, 1);
        (self.pins.in_position, self.pins.teleop) = (1, choices.one_of([1, 1, 0]));
        for _ in 0..choices.one_of([6, 1, 4]) {
            self.period();
        }
        self.switch_to_any(choices);
        self.linked = linked;
    }

    fn call_with_nothing(&mut self, choices: &mut Choices) {
        let number = c_int::from(choices.byte()) - 128;
        let number = choices.integer(number);
        // SAFETY: null pointers are permitted, and the texts are static strings.
        unsafe {
            assert_eq!(framepath_kinematics_forward(null(), null_mut()), -1);
            assert_eq!(framepath_kinematics_inverse(null(), null_mut()), -1);
            assert_eq!(framepath_kinematics_switch(0, null()), -1);
            assert_eq!(framepath_kinematics_linear_map(null_mut()), 0);
            framepath_kinematics_take_offsets_off(null_mut(), null());
            assert_eq!(
                framepath_kinematics_jumps_behind_switch(null(), null_mut()),
                0
            );
            framepath_kinematics_update(&self.pins, null_mut());
            framepath_kinematics_update(null(), &mut self.shown);
            let texts = [
                framepath_kinematics_refusal_text(number),
                framepath_kinematics_configure_text(number),
            ];
            for text in texts {
                assert!(!CStr::from_ptr(text).is_empty());
            }
        }
        assert!((0..=2).contains(&framepath_kinematics_tilt_axis()));
        assert!([-1, 3, 4].contains(&framepath_kinematics_tool_tilt_axis()));
    }

    /// The guard of the frames lives.
    fn beat(&mut self) {
        self.pins.heartbeat = self.pins.heartbeat.wrapping_add(1).max(1);
        self.pins.clock += 1_000_000;
    }

    /// Whatever was called before: at rest, with pins that make sense, the frame is removed and a new one made.
    fn goes_on(&mut self) {
        if !self.configured {
            return;
        }
        self.pins = neutral();
        self.linked = true;
        self.joints = [0.0; JOINTS];
        // A command that motion never answered is given up.
        for _ in 0..120 {
            self.beat();
            self.period();
        }
        for (code, active) in [(9.0, 0), (1.0, 1)] {
            self.number = (self.shown.acknowledged + 1.0).max(self.number + 1.0);
            if self.number > 1e12 {
                self.number = 7.0;
            }
            self.pins.command = self.number * 1000.0 + code;
            self.pins.value = [0.0; 3];
            self.sign();
            self.beat();
            self.period();
            self.beat();
            self.period();
            let shown = &self.shown;
            assert_eq!((shown.refusal, shown.acknowledged), (0, self.number));
            assert_eq!(shown.active, active, "after the command {code}");
        }
    }
}

/// The pins of a machine at rest without offsets.
fn neutral() -> framepath_frame_inputs {
    // SAFETY: plain numbers.
    let mut pins: framepath_frame_inputs = unsafe { std::mem::zeroed() };
    pins.in_position = 1;
    pins.enabled = 1;
    pins.period = 1e-3;
    (pins.map[0], pins.map[5], pins.map[10]) = (1.0, 1.0, 1.0);
    (pins.tilt_range, pins.rotary_range) = ([-100.0, 100.0], [-360.0, 360.0]);
    pins
}

/// The pose of joints, `None` if there is none.
fn forward(joints: &[f64; JOINTS]) -> Option<EmcPose> {
    // SAFETY: plain numbers.
    let mut world: EmcPose = unsafe { std::mem::zeroed() };
    // SAFETY: 16 numbers and a pose.
    let answer = unsafe { framepath_kinematics_forward(joints.as_ptr(), &mut world) };
    assert!(answer == 0 || answer == -1);
    (answer == 0).then(|| {
        let pose = coordinates(&world);
        assert!(pose.iter().all(|value| value.is_finite()), "{pose:?}");
        world
    })
}

/// The linear part of the frame, and whether there is one.
fn linear_map() -> ([u64; 9], c_int) {
    let mut map = [0.0; 9];
    // SAFETY: room for nine numbers.
    let framed = unsafe { framepath_kinematics_linear_map(map.as_mut_ptr()) };
    assert!((0..=1).contains(&framed));
    assert!(map.iter().all(|element: &f64| element.is_finite()));
    (map.map(f64::to_bits), framed)
}
