//! What `basic_sim.tcl` of LinuxCNC's HAL library does: kinematics, motion, joints that go where they are told, switches,
//! and a spindle. The same since LinuxCNC 2.9.0.
//!
//! Its commands are made here as lines of a HAL file, from the same keys of the INI file: nothing in Tcl is run.

use crate::machine::ini::Ini;

/// Keys without which it ends the start.
pub const KEYS: [(&str, &str); 5] = [
    ("KINS", "KINEMATICS"),
    ("KINS", "JOINTS"),
    ("TRAJ", "COORDINATES"),
    ("EMCMOT", "EMCMOT"),
    ("EMCMOT", "SERVO_PERIOD"),
];

/// LinuxCNC has no more joints.
const MOST_JOINTS: usize = 16;

/// Gains of a PID that hands its input on.
const PASS: [(&str, &str); 6] = [
    ("FF0", "1.0"),
    ("Pgain", "0"),
    ("Dgain", "0"),
    ("Igain", "0"),
    ("FF1", "0"),
    ("FF2", "0"),
];

/// Loops of the inputs and outputs, and what holds the joints while the machine is off.
const LOOPS: &str = "\
net estop:loop <= iocontrol.0.user-enable-out
net estop:loop => iocontrol.0.emc-enable-in
net tool:prep-loop <= iocontrol.0.tool-prepare
net tool:prep-loop => iocontrol.0.tool-prepared
net tool:change-loop <= iocontrol.0.tool-change
net tool:change-loop => iocontrol.0.tool-changed
net sample:enable <= motion.motion-enabled
";

const TOOL_CHANGE: &str = "\
loadusr -W hal_manualtoolchange
unlinkp iocontrol.0.tool-change
unlinkp iocontrol.0.tool-changed
delsig tool:change-loop
net tool:change <= iocontrol.0.tool-change
net tool:change => hal_manualtoolchange.change
net tool:changed <= hal_manualtoolchange.changed
net tool:changed => iocontrol.0.tool-changed
net tool:prep-number <= hal_manualtoolchange.number
net tool:prep-number => iocontrol.0.tool-prep-number
";

const SPINDLE: &str = "\
loadrt sim_spindle names=sim_spindle
setp sim_spindle.scale 0.01666667
loadrt limit2 names=limit_speed
loadrt lowpass names=spindle_mass
loadrt near names=near_speed
loadrt scale names=rpm_rps
setp rpm_rps.gain .0167
setp limit_speed.maxv 5000.0
net spindle-index-enable <=> spindle.0.index-enable
net spindle-index-enable <=> sim_spindle.index-enable
net spindle-pos <= sim_spindle.position-fb
net spindle-pos => spindle.0.revs
setp spindle_mass.gain .07
net spindle-speed-cmd <= spindle.0.speed-out
net spindle-speed-cmd => limit_speed.in
net spindle-speed-cmd => near_speed.in1
net spindle-speed-limited <= limit_speed.out
net spindle-speed-limited => sim_spindle.velocity-cmd
net spindle-speed-limited => spindle_mass.in
net spindle-rpm-filtered <= spindle_mass.out
net spindle-rpm-filtered rpm_rps.in
net spindle-rps-filtered rpm_rps.out spindle.0.speed-in
net spindle-rpm-filtered => near_speed.in2
setp near_speed.scale 1.1
setp near_speed.difference 10
net spindle-at-speed <= near_speed.out
net spindle-at-speed => spindle.0.at-speed
net spindle-orient <= spindle.0.orient
net spindle-orient <= spindle.0.is-oriented
addf limit_speed servo-thread
addf spindle_mass servo-thread
addf rpm_rps servo-thread
addf near_speed servo-thread
addf sim_spindle servo-thread
";

/// Its commands, in their order. `options` are those behind its name in the INI file; `[KINS]JOINTS` that is no number is 0.
pub fn lines(ini: &Ini, options: &[&str]) -> String {
    let joints = ini
        .text("KINS", "JOINTS")
        .and_then(|text| text.trim().parse().ok())
        .unwrap_or(0)
        .min(MOST_JOINTS);
    let takes = |option: &str| !options.iter().any(|word| word.eq_ignore_ascii_case(option));
    let mut text = motion(ini);
    text += &loops(joints);
    if takes("-no_make_ddts") {
        text += &rates(ini, joints);
    }
    if takes("-no_simulated_home") {
        text += &switches(ini, joints);
    }
    if takes("-no_use_hal_manualtoolchange") {
        text += TOOL_CHANGE;
    }
    if takes("-no_sim_spindle") {
        text += SPINDLE;
    }
    text
}

fn motion(ini: &Ini) -> String {
    let base = match ini.text("EMCMOT", "BASE_PERIOD") {
        Some(_) => "[EMCMOT]BASE_PERIOD",
        None => "0",
    };
    format!(
        "loadrt [KINS]KINEMATICS\n\
         loadrt [EMCMOT]EMCMOT base_period_nsec={base} servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS\n\
         addf motion-command-handler servo-thread\n\
         addf motion-controller servo-thread\n"
    )
}

/// `J0_pid,J1_pid`.
fn names(joints: usize, endings: &[&str]) -> Vec<String> {
    let of_joint = |joint| endings.iter().map(move |end| format!("J{joint}_{end}"));
    (0..joints).flat_map(of_joint).collect()
}

fn loops(joints: usize) -> String {
    let (pids, holds) = (names(joints, &["pid"]), names(joints, &["mux"]));
    let mut text = format!(
        "loadrt pid names={}\nloadrt mux2 names={}\n",
        pids.join(","),
        holds.join(",")
    );
    for pid in &pids {
        text += &format!("addf {pid}.do-pid-calcs servo-thread\n");
        for (pin, value) in PASS {
            text += &format!("setp {pid}.{pin} {value}\n");
        }
    }
    for hold in &holds {
        text += &format!("addf {hold} servo-thread\n");
    }
    text += LOOPS;
    for joint in 0..joints {
        let of_joint = [
            format!("net sample:enable => J{joint}_mux.sel"),
            format!("net J{joint}:enable <= joint.{joint}.amp-enable-out"),
            format!("net J{joint}:enable => J{joint}_pid.enable"),
            format!("net J{joint}:pos-cmd <= joint.{joint}.motor-pos-cmd"),
            format!("net J{joint}:pos-cmd => J{joint}_pid.command"),
            format!("net J{joint}:on-pos <= J{joint}_pid.output"),
            format!("net J{joint}:on-pos => J{joint}_mux.in1"),
            format!("net J{joint}:pos-fb <= J{joint}_mux.out"),
            format!("net J{joint}:pos-fb => J{joint}_mux.in0"),
            format!("net J{joint}:pos-fb => joint.{joint}.motor-pos-fb"),
        ];
        text += &(of_joint.join("\n") + "\n");
    }
    text
}

/// The rates of the joints; those along the path where trivkins moves X, Y and Z.
fn rates(ini: &Ini, joints: usize) -> String {
    let all = names(joints, &["vel", "accel"]);
    let mut text = format!("loadrt ddt names={}\n", all.join(","));
    for name in &all {
        text += &format!("addf {name} servo-thread\n");
    }
    for joint in 0..joints {
        text += &format!(
            "net J{joint}:pos-fb => J{joint}_vel.in\nnet J{joint}:vel <= J{joint}_vel.out\n\
             net J{joint}:vel => J{joint}_accel.in\nnet J{joint}:acc <= J{joint}_accel.out\n"
        );
    }
    let kinematics = ini.text("KINS", "KINEMATICS").unwrap_or("");
    if kinematics.split_whitespace().next() != Some("trivkins") {
        return text;
    }
    let letters: String = ini
        .text("TRAJ", "COORDINATES")
        .unwrap_or("")
        .split_whitespace()
        .collect();
    let joint_of = |letter: char| letters.to_ascii_lowercase().rfind(letter);
    if let [Some(x), Some(y), Some(z)] = ['x', 'y', 'z'].map(joint_of) {
        text += "loadrt hypot names=hyp_xy,hyp_xyz\naddf hyp_xy servo-thread\naddf hyp_xyz servo-thread\n";
        for (input, joint) in [x, y].into_iter().enumerate() {
            text += &format!(
                "net J{joint}:vel <= J{joint}_vel.out\nnet J{joint}:vel => hyp_xy.in{input}\n\
                 net J{joint}:vel => hyp_xyz.in{input}\n"
            );
        }
        text += &format!(
            "net J{z}:vel <= J{z}_vel.out\nnet J{z}:vel => hyp_xyz.in2\n\
             net xy:vel => hyp_xy.out\nnet xyz:vel <= hyp_xyz.out\n"
        );
    }
    text
}

fn switches(ini: &Ini, joints: usize) -> String {
    let all = names(joints, &["switch"]);
    let mut text = format!("loadrt sim_home_switch names={}\n", all.join(","));
    for name in &all {
        text += &format!("addf {name} servo-thread\n");
    }
    let units = ini.text("TRAJ", "LINEAR_UNITS");
    let is_in_inches = units.is_some_and(|units| ["in", "inch", "imperial"].contains(&units));
    for joint in 0..joints {
        text += &format!(
            "net J{joint}:pos-fb => J{joint}_switch.cur-pos\nnet J{joint}:homesw <= J{joint}_switch.home-sw\n\
             net J{joint}:homesw => joint.{joint}.home-sw-in\n"
        );
        let section = format!("JOINT_{joint}");
        let is_linear = ini
            .text(&section, "TYPE")
            .is_some_and(|kind| kind != "ANGULAR");
        if is_linear && is_in_inches {
            text += &format!(
                "setp J{joint}_switch.hysteresis 0.05\nsetp J{joint}_switch.home-pos 0.10\n"
            );
        }
        let search = ini.number(&section, "HOME_SEARCH_VEL").ok().flatten();
        if is_linear && search.is_some_and(|velocity| velocity < 0.0) {
            // 1 is the value of the component.
            let place = if is_in_inches { "0.1" } else { "1" };
            text += &format!("setp J{joint}_switch.home-pos -{place}\n");
        }
        let index = ini.text(&section, "HOME_USE_INDEX").unwrap_or("0");
        if is_true(index) {
            text += &format!(
                "net J{joint}:index-enable <= joint.{joint}.index-enable\n\
                 net J{joint}:index-enable => J{joint}_switch.index-enable\n"
            );
        }
    }
    text
}

/// What Tcl takes for true.
fn is_true(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    let number = text.parse::<f64>();
    number.is_ok_and(|number| number != 0.0)
        || ["yes", "true", "on", "y", "t"].contains(&text.as_str())
}
