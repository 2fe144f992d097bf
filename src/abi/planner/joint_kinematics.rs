//! The kinematics as limits of joints ask them: in the midst of planning, for how the joints of a place move.
//!
//! In memory of its own beside the planner's: the planner calls the jets that are here, while whoever called the planner
//! holds that.

use core::cell::UnsafeCell;

use libc::{c_double, c_int, c_ulong};

use super::kinematics_module::KinematicsModule;
use crate::axes::{AXIS_COUNT, Axes};
use crate::machine::JOINT_COUNT;
use crate::machine_map::JointJet;
use crate::numerical_jet::{numerical_estimate, numerical_jet};
use crate::planner::range::{JointSolver, Joints};

/// How the joints of a position move, in closed form: nine numbers of the position, three times nine derivatives of it, and
/// room for as many of the joints 0 to 8. Not 0 where that is not known.
pub(super) type ExactJet =
    Option<unsafe extern "C" fn(*const c_double, *const c_double, *mut c_double) -> c_int>;

const _: () = assert!(size_of::<Axes>() == AXIS_COUNT * size_of::<c_double>());

/// Calls of which the quickest says how long one takes.
const CALLS_TIMED: usize = 8;

/// Calls of the inverse kinematics that one numerical jet is reckoned with: five are enough mostly.
const CALLS_OF_A_JET: f64 = 7.0;

/// Places beside each other that tell how much answers differ by that should not: sixth differences of what is smooth are
/// next to nothing.
const PLACES: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];

/// What such a difference is greater by than the noise of one answer.
const GATHERED: f64 = 30.4;

/// How far these places are from each other, and what the joints are moved by from which every second answer begins: machine
/// units or degrees.
const BESIDE: f64 = 1e-4;

/// How far such places are from the next ones: at a singular place they would tell nothing.
const ELSEWHERE: f64 = 0.37;

/// From this disagreement on nothing is known of how joints move, see [`Estimate`](crate::numerical_jet::Estimate).
const UNSURE: f64 = 0.1;

/// What asking the kinematics is like.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Nanoseconds for one answer ..
    pub call: f64,
    /// .. and for how joints move at a place.
    pub jet: f64,
    /// What an answer may be wrong by, of each joint.
    pub noise: Joints,
    /// Whether they say in closed form how joints move.
    pub exact: bool,
}

/// The kinematics, and where the machine is.
#[derive(Debug)]
pub struct JointKinematics {
    module: KinematicsModule,
    exact: ExactJet,
    /// The joints that answers begin from, and the flags of their arm.
    near: Joints,
    flags: c_ulong,
    /// What was found when the machine last stood still.
    pub(super) measured: Option<Measured>,
}

/// Memory for the kinematics of the one planner of a module.
struct JointMemory(UnsafeCell<JointKinematics>);

// SAFETY: LinuxCNC calls the planner from one thread at a time, see [`super`].
unsafe impl Sync for JointMemory {}

static MEMORY: JointMemory =
    JointMemory(UnsafeCell::new(JointKinematics::of(KinematicsModule::NONE)));

/// The kinematics, to be changed. Not while the planner is at work.
pub(super) fn kinematics() -> &'static mut JointKinematics {
    // SAFETY: one thread at a time, and the jets, which read it, are called by the planner only.
    unsafe { &mut *MEMORY.0.get() }
}

/// The kinematics as the jets see them.
fn asked() -> &'static JointKinematics {
    // SAFETY: while the planner is at work nobody changes them, see [`kinematics`].
    unsafe { &*MEMORY.0.get() }
}

/// This is the module to ask from now on.
pub(super) fn ask(module: KinematicsModule) {
    let kinematics = kinematics();
    kinematics.module = module;
    kinematics.measured = None;
}

/// How joints move, in closed form or by numbers.
pub(super) fn jet(exact: bool) -> JointJet {
    if exact { exact_jet } else { jet_by_numbers }
}

fn exact_jet(position: &Axes, derivatives: &[Axes; 3], _: &[Axes; 3]) -> [Axes; 3] {
    asked()
        .in_closed_form(position, derivatives)
        .unwrap_or([Axes::repeat(f64::NAN); 3])
}

fn jet_by_numbers(position: &Axes, derivatives: &[Axes; 3], shares: &[Axes; 3]) -> [Axes; 3] {
    asked().by_numbers(position, derivatives, shares)
}

/// The joints that have a place among axes.
fn first_of(joints: &Joints) -> Axes {
    let mut first = Axes::zeros();
    for (axis, joint) in first.iter_mut().zip(joints) {
        *axis = *joint;
    }
    first
}

/// Nanoseconds of a clock that only goes on.
fn clock() -> f64 {
    let mut now = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: writes the structure that is handed over.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &mut now) };
    now.tv_sec as f64 * 1e9 + now.tv_nsec as f64
}

impl JointKinematics {
    /// This module, which has not been asked yet.
    pub const fn of(module: KinematicsModule) -> Self {
        Self {
            module,
            exact: None,
            near: [0.0; JOINT_COUNT],
            flags: 0,
            measured: None,
        }
    }

    /// Who says in closed form how joints move, if anyone does.
    pub(super) fn set_exact(&mut self, exact: ExactJet) {
        self.exact = exact;
        self.measured = None;
    }

    pub(super) fn is_known(&self) -> bool {
        self.module.is_known()
    }

    /// Whether they say in closed form how joints move.
    pub(super) fn is_exact(&self) -> bool {
        self.measured.is_some_and(|measured| measured.exact)
    }

    pub(super) fn is_trivial(&self) -> bool {
        self.module.is_trivial()
    }

    /// The machine is at `position`, shape (9), with these joints.
    pub fn follow(&mut self, position: &Axes, joints: &Joints) {
        self.near = *joints;
        self.flags = self.module.arm(position, joints);
    }

    /// The joints for a position, shape (9), with the arm that the machine had last, from those of before; `None` if there are
    /// none.
    pub fn joints(&self, position: &Axes, near: &Joints) -> Option<Joints> {
        self.module.joints(position, near, self.flags)
    }

    fn in_closed_form(&self, position: &Axes, derivatives: &[Axes; 3]) -> Option<[Axes; 3]> {
        let exact = self.exact?;
        let mut joints = [Axes::zeros(); 3];
        // SAFETY: framekins's own function, with as many numbers as it reads and writes: those of axes lie side by side.
        let result = unsafe {
            exact(
                position.as_slice().as_ptr(),
                derivatives.as_ptr().cast(),
                joints.as_mut_ptr().cast(),
            )
        };
        (result == 0).then_some(joints)
    }

    /// How joints move at a position, see [`numerical_jet`]: not a number where there are no joints.
    pub fn by_numbers(
        &self,
        position: &Axes,
        derivatives: &[Axes; 3],
        shares: &[Axes; 3],
    ) -> [Axes; 3] {
        let joints = |position: &Axes| self.first_joints(position);
        numerical_jet(joints, position, derivatives, shares)
    }

    /// The joints for a position that have a place among axes, not a number if there are none.
    fn first_joints(&self, position: &Axes) -> Axes {
        match self.joints(position, &self.near) {
            Some(joints) => first_of(&joints),
            None => Axes::repeat(f64::NAN),
        }
    }

    /// Whether joints move without end at `position` for a small way along an axis X Y Z. `shares` as of a
    /// [`JointMap`](crate::machine_map::JointMap).
    pub fn is_singular(&self, position: &Axes, shares: &[Axes; 3]) -> bool {
        let still = Axes::zeros();
        let along = [Axes::x(), Axes::y(), Axes::z()];
        along.iter().any(|way| {
            let joints = |position: &Axes| self.first_joints(position);
            let found = numerical_estimate(joints, position, &[*way, still, still], shares);
            found.disagreement > UNSURE
        })
    }

    /// What asking them is like where the machine stands, with `count` joints. `None` if there are no joints for that
    /// place.
    pub fn measure(&mut self, position: &Axes, joints: &Joints, count: usize) -> Option<Measured> {
        self.measured = None;
        self.module.count = count;
        self.module.begin(position, joints);
        self.follow(position, joints);
        let along = [Axes::repeat(1.0), Axes::zeros(), Axes::zeros()];
        let exact = self.in_closed_form(position, &along).is_some();
        let call = quickest(|| self.joints(position, joints).is_some())?;
        let measured = if exact {
            Measured {
                call,
                jet: quickest(|| self.in_closed_form(position, &along).is_some())?,
                noise: [0.0; JOINT_COUNT],
                exact,
            }
        } else {
            Measured {
                call,
                jet: CALLS_OF_A_JET * call,
                noise: self.noise(position, joints)?,
                exact,
            }
        };
        // Some remember where they were asked last.
        self.joints(position, joints)?;
        self.measured = Some(measured);
        self.measured
    }

    /// What an answer may be wrong by: the least at some places that are not far away.
    fn noise(&self, position: &Axes, joints: &Joints) -> Option<Joints> {
        let mut least: Option<Joints> = None;
        for place in 0..3 {
            let start = position.add_scalar(f64::from(place) * ELSEWHERE);
            let Some(noise) = self.noise_at(&start, joints) else {
                continue;
            };
            least = Some(match least {
                None => noise,
                Some(mut least) => {
                    for (least, noise) in least.iter_mut().zip(noise) {
                        *least = least.min(noise);
                    }
                    least
                }
            });
        }
        least
    }

    fn noise_at(&self, start: &Axes, joints: &Joints) -> Option<Joints> {
        let mut difference = [0.0; JOINT_COUNT];
        for (place, weight) in PLACES.iter().enumerate() {
            let position = start.add_scalar(place as f64 * BESIDE);
            let nudge = if place % 2 == 1 { BESIDE } else { 0.0 };
            let near = joints.map(|joint| joint + nudge);
            let answer = self.joints(&position, &near)?;
            let answers = answer.iter().zip(&near).zip(joints);
            for (difference, ((answer, near), joint)) in difference.iter_mut().zip(answers) {
                // Joints that are left as they are do not count.
                if answer != near {
                    *difference += weight * (answer - joint);
                }
            }
        }
        Some(difference.map(|difference| difference.abs() / GATHERED))
    }
}

/// The least of some times, nanoseconds; `None` if nothing is answered.
fn quickest(answers: impl Fn() -> bool) -> Option<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..CALLS_TIMED {
        let begin = clock();
        if !answers() {
            return None;
        }
        least = least.min(clock() - begin);
    }
    Some(least)
}
