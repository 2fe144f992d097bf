//! Which pins are recorded, and the lines of halcmd that take them to a sampler and away again.

use super::error::RecordError;
use super::state::State;

/// halsampler prints six decimals: positions go to it in millionths.
pub const SCALE: f64 = 1e6;

/// The signal that says that a recording is attached, and by which process. Those that follow begin with it.
pub const MARK: &str = "framepath-record";

/// A sampler has at most so many pins.
const MOST_PINS: usize = 21;

/// Positions at most: the line and the kind of motion have a pin each.
const MOST_POSITIONS: usize = MOST_PINS - 2;

/// All axes of LinuxCNC in the order of a recording.
const AXES: &str = "xyzabcuvw";

/// The pin of a program's state, which halui has.
const IDLE: &str = "halui.program.is-idle";

/// A component that multiplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaler {
    /// Its name.
    module: &'static str,
    /// The pin that it reads.
    input: &'static str,
    /// What it multiplies by.
    factor: &'static str,
}

/// A component can be loaded only once: the first that the machine has no use for.
const SCALERS: [Scaler; 3] = [
    Scaler {
        module: "scale",
        input: "in",
        factor: "gain",
    },
    Scaler {
        module: "sum2",
        input: "in0",
        factor: "gain0",
    },
    Scaler {
        module: "mult2",
        input: "in0",
        factor: "in1",
    },
];

/// What a row holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Numbers of the joints.
    pub joints: Vec<usize>,
    /// Letters of the axes.
    pub axes: Vec<char>,
    /// Whether the state of the program is known.
    pub idle: bool,
}

impl Columns {
    /// How many positions there are.
    pub fn positions(&self) -> usize {
        self.joints.len() + self.axes.len()
    }

    /// Whether the positions leave a pin for the state of the program.
    pub fn leave_room(&self) -> bool {
        self.positions() < MOST_POSITIONS
    }

    /// Those of the machine that runs, with these joints.
    ///
    /// # Errors
    /// More than a sampler takes.
    fn of(state: &State, joints: Vec<usize>) -> Result<Columns, RecordError> {
        let mut columns = Columns {
            joints,
            axes: axes_of(state),
            idle: false,
        };
        if columns.joints.is_empty() {
            return Err(RecordError::NoPin(joint_pin(0)));
        }
        if columns.positions() > MOST_POSITIONS {
            return Err(RecordError::TooMany {
                joints: columns.joints.len(),
                axes: columns.axes.len(),
                most: MOST_POSITIONS,
            });
        }
        // Positions are what a recording is for; the end of a program is noticed without halui, too.
        columns.idle = columns.leave_room() && state.pin(IDLE).is_some();
        Ok(columns)
    }

    /// The pins of the positions.
    fn position_pins(&self) -> Vec<String> {
        let joints = self.joints.iter().map(|joint| joint_pin(*joint));
        joints
            .chain(self.axes.iter().map(|axis| axis_pin(*axis)))
            .collect()
    }
}

/// The joints of the kinematics, and those beside them (num_extrajoints): one that belongs to a spindle or a tool changer
/// is no part of the path.
fn joints_of(state: &State) -> (Vec<usize>, Vec<usize>) {
    (0..)
        .take_while(|joint| state.pin(&joint_pin(*joint)).is_some())
        .partition(|joint| state.pin(&format!("joint.{joint}.posthome-cmd")).is_none())
}

/// There are pins for all axes that LinuxCNC has; only those of the machine have a velocity.
fn axes_of(state: &State) -> Vec<char> {
    let velocity = |axis: char| {
        state
            .pin(&format!("ini.{axis}.max_velocity"))?
            .value
            .parse()
            .ok()
    };
    let of_machine = |axis: &char| velocity(*axis).is_some_and(|velocity: f64| velocity > 0.0);
    let all = AXES
        .chars()
        .filter(|axis| state.pin(&axis_pin(*axis)).is_some());
    let all: Vec<char> = all.collect();
    let known: Vec<char> = all.iter().copied().filter(of_machine).collect();
    if known.is_empty() { all } else { known }
}

/// The commanded position of a joint: without the offset of its motor and its backlash.
fn joint_pin(joint: usize) -> String {
    format!("joint.{joint}.pos-cmd")
}

fn axis_pin(axis: char) -> String {
    format!("axis.{axis}.pos-cmd")
}

/// How the machine that runs is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Wiring {
    /// What a row holds.
    pub columns: Columns,
    /// Numbers of the joints that no row holds: they are none of the kinematics.
    pub extra_joints: Vec<usize>,
    /// Servo period, s.
    pub period: f64,
    /// The lines that load what is needed.
    pub load: Vec<String>,
    /// The lines that link it.
    pub link: Vec<String>,
    /// The lines that begin to sample.
    pub start: Vec<String>,
}

impl Wiring {
    /// For the machine that runs; `process` records it, and what it does not read waits for up to `buffer` seconds.
    ///
    /// # Errors
    /// What is missing, or taken.
    pub fn new(state: &State, process: u32, buffer: f64) -> Result<Wiring, RecordError> {
        if !state.has_component("motmod") {
            return Err(RecordError::NotRunning);
        }
        let thread = state
            .thread_of("motion-controller")
            .ok_or(RecordError::NoServoThread)?;
        if state.has_component("sampler") {
            return Err(RecordError::SamplerTaken);
        }
        let free = SCALERS
            .iter()
            .find(|scaler| !state.has_component(scaler.module));
        let scaler = free.ok_or_else(|| {
            RecordError::ScalersTaken(SCALERS.map(|scaler| scaler.module).join(", "))
        })?;
        let (joints, extra_joints) = joints_of(state);
        let columns = Columns::of(state, joints)?;
        let rows = (buffer / thread.period).ceil().max(4.0);
        Ok(Wiring {
            period: thread.period,
            load: load(&columns, scaler, process, rows),
            link: link(state, &columns, scaler)?,
            start: start(&columns, scaler, &thread.name),
            columns,
            extra_joints,
        })
    }
}

/// Marks first: what is found behind them is ours.
fn load(columns: &Columns, scaler: &Scaler, process: u32, rows: f64) -> Vec<String> {
    let positions = columns.positions();
    let idle = if columns.idle { "b" } else { "" };
    let Scaler { module, .. } = scaler;
    vec![
        format!("newsig {MARK} u32"),
        format!("sets {MARK} {process}"),
        format!("newsig {MARK}-loads-{module} bit"),
        format!(
            "loadrt sampler depth={rows} cfg={}ss{idle}",
            "f".repeat(positions)
        ),
        format!("loadrt {module} count={positions}"),
    ]
}

fn link(state: &State, columns: &Columns, scaler: &Scaler) -> Result<Vec<String>, RecordError> {
    let Scaler {
        module,
        input,
        factor,
    } = scaler;
    let mut lines = Vec::new();
    for (number, pin) in columns.position_pins().iter().enumerate() {
        lines.push(format!("setp {module}.{number}.{factor} {SCALE}"));
        lines.push(format!(
            "net {MARK}-scaled-{number} {module}.{number}.out => sampler.0.pin.{number}"
        ));
        lines.push(net(state, pin, &format!("{module}.{number}.{input}"))?);
    }
    let mut others = vec!["motion.program-line", "motion.motion-type"];
    others.extend(columns.idle.then_some(IDLE));
    for (number, pin) in others.iter().enumerate() {
        let number = columns.positions() + number;
        lines.push(net(state, pin, &format!("sampler.0.pin.{number}"))?);
    }
    Ok(lines)
}

/// Takes a pin to one of ours: by the signal that it has, else by one of ours.
fn net(state: &State, from: &str, to: &str) -> Result<String, RecordError> {
    let pin = state
        .pin(from)
        .ok_or_else(|| RecordError::NoPin(from.to_owned()))?;
    Ok(match &pin.signal {
        Some(signal) => format!("net {signal} => {to}"),
        None => format!("net {MARK}-{from} {from} => {to}"),
    })
}

/// At the end of the thread, the sampler last.
fn start(columns: &Columns, scaler: &Scaler, thread: &str) -> Vec<String> {
    let scalers =
        (0..columns.positions()).map(|number| format!("addf {}.{number} {thread}", scaler.module));
    let sampler = format!("addf sampler.0 {thread}");
    scalers.chain([sampler]).collect()
}

/// The lines that take a recording out of HAL again: those that end the sampling, then those that remove what is left
/// when the threads have gone on. Empty if there is none.
pub fn unwire(state: &State) -> [Vec<String>; 2] {
    if state.signal(MARK).is_none() {
        return [Vec::new(), Vec::new()];
    }
    let loads = format!("{MARK}-loads-");
    let marked = state
        .signals
        .iter()
        .filter_map(|signal| signal.name.strip_prefix(&loads));
    let modules: Vec<&str> = std::iter::once("sampler")
        .chain(marked)
        .filter(|module| state.has_component(module))
        .collect();
    let mut stop = Vec::new();
    for thread in &state.threads {
        let ours = |function: &&String| {
            let module = function.split('.').next();
            module.is_some_and(|module| modules.contains(&module))
        };
        let functions = thread.functions.iter().filter(ours);
        stop.extend(functions.map(|function| format!("delf {function} {}", thread.name)));
    }
    let linked =
        |pin: &&super::state::Pin| pin.signal.is_some() && modules.contains(&pin.owner.as_str());
    let mut remove: Vec<String> = Vec::new();
    remove.extend(
        state
            .pins
            .iter()
            .filter(linked)
            .map(|pin| format!("unlinkp {}", pin.name)),
    );
    remove.extend(modules.iter().map(|module| format!("unloadrt {module}")));
    let ours = |name: &&str| *name != MARK && name.starts_with(&format!("{MARK}-"));
    let signals = state.signals.iter().map(|signal| signal.name.as_str());
    remove.extend(signals.filter(ours).map(|name| format!("delsig {name}")));
    remove.push(format!("delsig {MARK}"));
    [stop, remove]
}

#[cfg(test)]
mod tests {
    use super::super::state::tests::mill;
    use super::super::state::{Component, Pin, Signal};
    use super::*;

    fn with_component(mut state: State, name: &str) -> State {
        state.components.push(Component {
            name: name.to_owned(),
            process: None,
        });
        state
    }

    fn with_pin(mut state: State, name: &str, signal: Option<&str>) -> State {
        state.pins.push(Pin {
            owner: name.split('.').next().unwrap_or_default().to_owned(),
            name: name.to_owned(),
            value: "0".to_owned(),
            signal: signal.map(str::to_owned),
        });
        state
    }

    fn wiring(state: &State) -> Result<Wiring, RecordError> {
        Wiring::new(state, 77, 10.0)
    }

    #[test]
    fn the_axes_of_the_machine_are_recorded_and_linked_pins_by_their_signals() {
        let wired = wiring(&mill()).expect("a machine");
        assert_eq!(
            (wired.columns.joints, wired.columns.axes),
            (vec![0, 1], vec!['x', 'y'])
        );
        assert_eq!(
            wired.load,
            [
                "newsig framepath-record u32",
                "sets framepath-record 77",
                "newsig framepath-record-loads-scale bit",
                "loadrt sampler depth=10000 cfg=ffffss",
                "loadrt scale count=4",
            ]
        );
        let lines = wired.link.join("\n");
        for line in [
            "setp scale.0.gain 1000000",
            "net framepath-record-scaled-3 scale.3.out => sampler.0.pin.3",
            "net joint-0 => scale.0.in",
            "net framepath-record-joint.1.pos-cmd joint.1.pos-cmd => scale.1.in",
            "net framepath-record-motion.motion-type motion.motion-type => sampler.0.pin.5",
        ] {
            assert!(lines.contains(line), "{line} in {lines}");
        }
        assert_eq!(
            wired.start.last().map(String::as_str),
            Some("addf sampler.0 servo-thread")
        );
        assert_eq!(wired.start.len(), 5);
    }

    #[test]
    fn the_state_of_the_program_is_taken_from_halui_and_another_component_where_scale_is_used() {
        let state = with_pin(mill(), "halui.program.is-idle", Some("idle"));
        let wired = wiring(&with_component(state, "scale")).expect("a machine");
        assert!(wired.columns.idle);
        assert!(wired.load[3].ends_with("cfg=ffffssb"), "{:?}", wired.load);
        assert_eq!(wired.load[4], "loadrt sum2 count=4");
        let lines = wired.link.join("\n");
        assert!(lines.contains("setp sum2.0.gain0 1000000\n"), "{lines}");
        assert!(lines.ends_with("net idle => sampler.0.pin.6"), "{lines}");
    }

    #[test]
    fn a_joint_of_a_spindle_is_none_of_the_kinematics() {
        let state = with_pin(mill(), "joint.1.posthome-cmd", None);
        let wired = wiring(&state).expect("a machine");
        assert_eq!(
            (wired.columns.joints, wired.extra_joints),
            (vec![0], vec![1])
        );
    }

    #[test]
    fn what_is_missing_or_taken_is_refused_by_name() {
        let message = |state: &State| wiring(state).expect_err("refused").to_string();
        assert!(message(&State::default()).starts_with("no LinuxCNC is running"));
        let mut idle = mill();
        idle.threads[0].functions.clear();
        assert!(message(&idle).starts_with("no servo thread"));
        assert!(
            message(&with_component(mill(), "sampler"))
                .starts_with("the component sampler is in use")
        );
        let taken = ["scale", "sum2", "mult2"]
            .into_iter()
            .fold(mill(), with_component);
        assert!(message(&taken).contains("scale, sum2, mult2 are all in use"));
        let mut other = mill();
        other.pins.retain(|pin| pin.name != "motion.program-line");
        assert!(message(&other).contains("there is no pin motion.program-line"));
        let mut many = mill();
        for joint in 2..20 {
            many = with_pin(many, &joint_pin(joint), None);
        }
        assert_eq!(
            message(&many),
            "20 joints and 2 axes are more than a sampler takes (19 of both), and framepath record records all of them: \
             load sampler and halsampler by hand for those that matter, see man 9 sampler"
        );
    }

    #[test]
    fn where_positions_fill_a_sampler_the_state_of_the_program_has_no_place() {
        let gantry = |joints: std::ops::Range<usize>| {
            let idle = with_pin(mill(), "halui.program.is-idle", None);
            joints.fold(idle, |state, joint| {
                with_pin(state, &joint_pin(joint), None)
            })
        };
        let columns = wiring(&gantry(2..16)).expect("18 positions").columns;
        assert_eq!((columns.positions(), columns.idle), (18, true));
        let wired = wiring(&gantry(2..17)).expect("19 positions");
        assert_eq!((wired.columns.positions(), wired.columns.idle), (19, false));
        assert!(wired.load[3].ends_with("ffss"), "{:?}", wired.load);
    }

    /// The machine with all that a recording puts there.
    fn recorded() -> State {
        let mut state = with_component(with_component(mill(), "sampler"), "scale");
        for name in [
            MARK,
            "framepath-record-loads-scale",
            "framepath-record-scaled-0",
        ] {
            state.signals.push(Signal {
                name: name.to_owned(),
                value: "77".to_owned(),
            });
        }
        state = with_pin(state, "scale.0.in", Some("joint-0"));
        state = with_pin(state, "sampler.0.pin.0", Some("framepath-record-scaled-0"));
        state = with_pin(state, "sampler.0.enable", None);
        state.threads[0]
            .functions
            .extend(["scale.0", "sampler.0"].map(str::to_owned));
        state
    }

    #[test]
    fn all_of_it_is_taken_away_and_nothing_else() {
        let [stop, remove] = unwire(&recorded());
        assert_eq!(
            stop,
            ["delf scale.0 servo-thread", "delf sampler.0 servo-thread"]
        );
        assert_eq!(
            remove,
            [
                "unlinkp scale.0.in",
                "unlinkp sampler.0.pin.0",
                "unloadrt sampler",
                "unloadrt scale",
                "delsig framepath-record-loads-scale",
                "delsig framepath-record-scaled-0",
                "delsig framepath-record",
            ]
        );
    }

    #[test]
    fn what_others_have_loaded_stays() {
        // Without the mark nothing is ours; with it, only what was marked.
        let mut unmarked = recorded();
        unmarked.signals.retain(|signal| signal.name != MARK);
        assert_eq!(unwire(&unmarked), [Vec::<String>::new(), Vec::new()]);
        let mut others = recorded();
        others
            .signals
            .retain(|signal| signal.name != "framepath-record-loads-scale");
        let [stop, remove] = unwire(&others);
        assert_eq!(stop, ["delf sampler.0 servo-thread"]);
        assert!(
            !remove
                .iter()
                .any(|line| line.contains("scale.0") || line.contains("unloadrt scale"))
        );
    }
}
