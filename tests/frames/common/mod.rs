//! Motion, played for the kinematics: what motmod and the subroutines do.

use framepath::axes::Axes;
use framepath::frame::ToolLength;
use framepath::kinematics::check::check_sum;
use framepath::kinematics::control::{FrameControl, FrameInputs, FrameOutputs};
use framepath::kinematics::{Behind, FrameRefusal};
use framepath::machine::{Machine, TableTiltingParameters};

const IDENTITY: [f64; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// Motion as motmod does it: asks the kinematics when the number on its pin changes.
pub struct Motion {
    /// What is tested.
    pub control: FrameControl,
    /// What the pins say.
    pub inputs: FrameInputs,
    /// `motion.switchkins-type` is linked.
    pub linked: bool,
    /// The kinematics type that motion knows.
    pub type_seen: i32,
    /// What the module answered last.
    pub out: FrameOutputs,
    /// Number of the last command.
    pub number: f64,
    /// The guard lives.
    pub beating: bool,
    /// How many types inner kinematics have, and what they were switched to.
    pub types: i32,
    pub switched: Vec<i32>,
}

impl Motion {
    pub fn new(name: &str, coordinates: &str) -> Self {
        let machine = Machine::configured(name.as_bytes(), coordinates.as_bytes()).unwrap();
        Self::before(machine.into())
    }

    /// Behind the frame is this.
    pub fn before(behind: Behind) -> Self {
        let inputs = FrameInputs {
            command: 0.0,
            value: [0.0; 3],
            work_offset: [0.0; 3],
            work_rotation: 0.0,
            tool_offset: [0.0; 3],
            tool_length: ToolLength::Frame,
            map: IDENTITY,
            mirror: [false; 6],
            table: TableTiltingParameters::default(),
            inner_type: 0.0,
            fixed_axes: [false; 3],
            tool_jumped: false,
            other_joints: false,
            offsets_move: false,
            unknown_offset: false,
            in_position: true,
            teleop: false,
            check: 0.0,
            enabled: true,
            release_on_abort: true,
            release: false,
            releases_seen: 0,
            heartbeat: 1,
            period: 0.001,
            clock: 0,
        };
        let mut control = FrameControl::new(behind);
        let out = control.update(&inputs);
        Self {
            control,
            inputs,
            linked: true,
            type_seen: 0,
            out,
            number: 0.0,
            beating: true,
            types: 0,
            switched: Vec::new(),
        }
    }

    /// One servo period: motion first, then the module's function.
    pub fn period(&mut self) {
        if self.linked && self.out.switchkins_type != self.type_seen {
            self.type_seen = self.out.switchkins_type;
            let _ = self.switch(self.type_seen);
        }
        self.inputs.heartbeat += u32::from(self.beating);
        self.inputs.clock += (self.inputs.period * 1e9).round() as i64;
        self.out = self.control.update(&self.inputs);
    }

    /// Motion switches, whoever asks for it.
    pub fn switch(&mut self, number: i32) -> Result<(), FrameRefusal> {
        let (types, switched) = (self.types, &mut self.switched);
        self.control.switch(number, &self.inputs, |kind| {
            switched.push(kind);
            kind < types
        })
    }

    /// Puts a command on the pins as a program sends it.
    pub fn put(&mut self, code: i32, value: [f64; 3]) {
        self.number += 1.0;
        self.inputs.command = self.number * 1000.0 + f64::from(code);
        self.inputs.value = value;
        self.inputs.check = check_sum(&self.inputs);
    }

    /// Hands over a command and waits for the answer.
    pub fn send(&mut self, code: i32, value: [f64; 3]) -> Option<FrameRefusal> {
        self.put(code, value);
        for _ in 0..200 {
            self.period();
            if self.out.acknowledged == self.number {
                self.period();
                return self.out.refusal;
            }
        }
        panic!("command {code} was not answered");
    }

    /// Where a position of the program is on the machine.
    pub fn machine(&self, point: [f64; 3]) -> [f64; 3] {
        let world = Axes::from([point[0], point[1], point[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let axes = self
            .control
            .active()
            .map_or(world, |frame| frame.to_machine(&world));
        [axes[0], axes[1], axes[2]]
    }
}
