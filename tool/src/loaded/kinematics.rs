//! A kinematics module of LinuxCNC's in this process: loaded, given its parameters and what HAL sets its pins to, and asked
//! as LinuxCNC asks it.
//!
//! RTAPI and HAL are those of `stubs.c`: in the process that drives a planner module they are there, in others they are
//! loaded first.

use super::module::Module;
use super::stubs::{STUBS, Stubs};
use crate::memory_file::MemoryFile;
use framepath::abi::linuxcnc::{EmcPose, KINEMATICS_TYPE};
use framepath::abi::planner::joint_kinematics::JointKinematics;
use framepath::abi::planner::kinematics_module::KinematicsModule;
use framepath::abi::pose::{axes_of, pose_of};
use framepath::axes::Axes;
use framepath::kinematics::InnerKinematics;
use framepath::machine::JOINT_COUNT;
use serde::{Deserialize, Serialize};
use std::ffi::{CString, c_char, c_int, c_uint, c_ulong};
use std::path::PathBuf;
use std::sync::Mutex;

/// What is loaded, and how. The home of its joints in machine units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct KinematicsSettings {
    pub file: PathBuf,
    pub name: String,
    pub parameters: Vec<(String, String)>,
    /// Values of pins; those of other modules do not matter.
    pub pins: Vec<(String, f64)>,
    pub joints: usize,
    /// The type that it is switched to.
    pub kind: i32,
    /// `[JOINT_n]HOME`.
    pub home: Vec<f64>,
}

/// Why a kinematics module cannot be asked here.
#[derive(Debug, thiserror::Error)]
pub(crate) enum KinematicsError {
    #[error("{0}")]
    Load(String),
    #[error("it is no kinematics module: {0} is missing")]
    NoFunction(&'static str),
    #[error("it has no parameter {0}")]
    UnknownParameter(String),
    #[error("{0}={1} cannot be given to it here")]
    Parameter(String, String),
    #[error("it does not start: {0}")]
    Start(String),
    #[error("it has no position for the joints of [JOINT_n]HOME")]
    NoHome,
    #[error("it has no type {0}")]
    NoType(i32),
    #[error("{0} is loaded already, in another way")]
    Other(String),
}

type Inverse =
    unsafe extern "C" fn(*const EmcPose, *mut f64, *const c_ulong, *mut c_ulong) -> c_int;
type Forward =
    unsafe extern "C" fn(*const f64, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int;

/// The functions of a module, and where its machine stands at home.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadedKinematics {
    inverse: Inverse,
    forward: Forward,
    /// What `kinematicsType` says, which is asked once: matrixkins sets up anew each time.
    kind: c_uint,
    /// The joints of home, and the position.
    home: ([f64; JOINT_COUNT], Axes),
    /// Of the arm that the machine has there.
    flags: (c_ulong, c_ulong),
}

/// Modules have memory that is one for the process: one is loaded, once.
static LOADED: Mutex<Option<(KinematicsSettings, LoadedKinematics)>> = Mutex::new(None);

impl LoadedKinematics {
    /// The module as the settings say.
    ///
    /// # Errors
    /// See [`KinematicsError`].
    pub(crate) fn load(settings: &KinematicsSettings) -> Result<LoadedKinematics, KinematicsError> {
        let mut loaded = LOADED.lock().unwrap_or_else(|held| held.into_inner());
        match &*loaded {
            Some((known, kinematics)) if known == settings => return Ok(*kinematics),
            Some((known, _)) => return Err(KinematicsError::Other(known.name.clone())),
            None => {}
        }
        let kinematics = start(settings)?;
        *loaded = Some((settings.clone(), kinematics));
        Ok(kinematics)
    }

    /// Whether the joints are the axes.
    pub(crate) fn is_trivial(&self) -> bool {
        self.kind == KINEMATICS_TYPE::KINEMATICS_IDENTITY
    }

    /// The joints of home, and the position there, shape (9), machine units.
    pub(crate) fn home(&self) -> &([f64; JOINT_COUNT], Axes) {
        &self.home
    }

    /// Sets a pin, from here on.
    pub(crate) fn put(&self, pin: &str, value: f64) {
        if let Some(stubs) = Stubs::find() {
            stubs.put(pin, value);
        }
    }

    /// As the planner asks them, which has not measured them yet.
    pub(crate) fn as_asked(&self) -> JointKinematics {
        JointKinematics::of(self.as_module())
    }

    /// As the planner asks them on the way of a move.
    pub(crate) fn as_module(&self) -> KinematicsModule {
        KinematicsModule::new(Some(self.inverse), Some(self.forward), self.kind)
    }

    /// Where the machine stands with these joints, shape (9), machine units; axes that it does not have as in `near`.
    /// `None` where there is no such place.
    pub(crate) fn position(&self, joints: &[f64; JOINT_COUNT], near: &Axes) -> Option<Axes> {
        let mut calls = *self;
        let mut axes = *near;
        (calls.forward(joints, &mut axes) == 0).then_some(axes)
    }

    /// The joints for a position, from those of before; `None` where there are none.
    pub(crate) fn joints(
        &self,
        position: &Axes,
        near: &[f64; JOINT_COUNT],
    ) -> Option<[f64; JOINT_COUNT]> {
        let mut calls = *self;
        let mut joints = *near;
        let found = calls.inverse(position, &mut joints) == 0;
        (found && joints.iter().all(|joint| joint.is_finite())).then_some(joints)
    }
}

impl InnerKinematics for LoadedKinematics {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) -> i32 {
        let pose = pose_of(axes);
        let (read, written) = (&self.flags.1, &mut self.flags.0);
        // SAFETY: the module's own function, with as many joints as it may write.
        unsafe { (self.inverse)(&pose, joints.as_mut_ptr(), read, written) }
    }

    fn forward(&mut self, joints: &[f64; JOINT_COUNT], axes: &mut Axes) -> i32 {
        let mut pose = pose_of(axes);
        let (read, written) = (&self.flags.0, &mut self.flags.1);
        // SAFETY: the module's own function, with as many joints as it may read.
        let result = unsafe { (self.forward)(joints.as_ptr(), &mut pose, read, written) };
        *axes = axes_of(&pose);
        result
    }
}

/// RTAPI and HAL for modules.
fn stubs() -> Result<Stubs, KinematicsError> {
    if let Some(stubs) = Stubs::find() {
        return Ok(stubs);
    }
    let unusable = |error: std::io::Error| KinematicsError::Load(error.to_string());
    let file = MemoryFile::holding("framepath-stubs", STUBS).map_err(unusable)?;
    Module::open(&file.path(), libc::RTLD_GLOBAL).map_err(KinematicsError::Load)?;
    Stubs::find().ok_or_else(|| KinematicsError::Load("the stubs are not loaded".to_owned()))
}

fn start(settings: &KinematicsSettings) -> Result<LoadedKinematics, KinematicsError> {
    let stubs = stubs()?;
    let file = settings.file.to_string_lossy();
    // Its own functions and not those of the same name in the stubs.
    let flags = libc::RTLD_LOCAL | libc::RTLD_DEEPBIND;
    let module = Module::open(&file, flags).map_err(KinematicsError::Load)?;
    let function = |name: &'static str| {
        let named = format!("{name}\0");
        module
            .symbol(&named)
            .ok_or(KinematicsError::NoFunction(name))
    };
    let (inverse, forward) = (
        function("kinematicsInverse")?,
        function("kinematicsForward")?,
    );
    let (kind, begin) = (function("kinematicsType")?, function("rtapi_app_main")?);
    for (name, value) in &settings.parameters {
        give(module, name, value)?;
    }
    // SAFETY: a module of RTAPI and of kinematics has these functions with these types.
    let (begin, kind) = unsafe {
        (
            std::mem::transmute::<*mut libc::c_void, unsafe extern "C" fn() -> c_int>(begin),
            std::mem::transmute::<*mut libc::c_void, unsafe extern "C" fn() -> c_uint>(kind),
        )
    };
    // SAFETY: called once, before all others.
    let result = unsafe { begin() };
    if result < 0 {
        let said = stubs.first_error();
        let said = if said.is_empty() {
            format!("rtapi_app_main returned {result}")
        } else {
            said
        };
        return Err(KinematicsError::Start(said));
    }
    // Those that halcompile made have their pins when this is asked for the first time.
    // SAFETY: as above.
    let kind = unsafe { kind() };
    for (pin, value) in &settings.pins {
        stubs.put(pin, *value);
    }
    if settings.kind != 0 {
        let switch = function("kinematicsSwitch")?;
        // SAFETY: as above.
        let result = unsafe {
            let switch = std::mem::transmute::<
                *mut libc::c_void,
                unsafe extern "C" fn(c_int) -> c_int,
            >(switch);
            switch(settings.kind)
        };
        if result != 0 {
            return Err(KinematicsError::NoType(settings.kind));
        }
    }
    // SAFETY: as above.
    let mut kinematics = unsafe {
        LoadedKinematics {
            inverse: std::mem::transmute::<*mut libc::c_void, Inverse>(inverse),
            forward: std::mem::transmute::<*mut libc::c_void, Forward>(forward),
            kind,
            home: ([0.0; JOINT_COUNT], Axes::zeros()),
            flags: (0, 0),
        }
    };
    let (mut joints, mut position) = kinematics.home;
    for (joint, home) in joints.iter_mut().zip(&settings.home) {
        *joint = *home;
    }
    if kinematics.forward(&joints, &mut position) != 0
        || !position.iter().all(|value| value.is_finite())
    {
        return Err(KinematicsError::NoHome);
    }
    kinematics.home = (joints, position);
    Ok(kinematics)
}

/// Gives a parameter a value, as `loadrt` does: the module has a text that says what it is, and says where the variable is.
fn give(module: Module, name: &str, value: &str) -> Result<(), KinematicsError> {
    let unknown = || KinematicsError::UnknownParameter(name.to_owned());
    let refused = || KinematicsError::Parameter(name.to_owned(), value.to_owned());
    let kind = module
        .symbol(&format!("rtapi_info_type_{name}\0"))
        .ok_or_else(unknown)?;
    let variable = module
        .symbol(&format!("rtapi_info_address_{name}\0"))
        .ok_or_else(unknown)?;
    // SAFETY: the address of a text that begins with a letter for the type; that of the variable.
    let (kind, variable) = unsafe {
        (
            kind.cast::<*const u8>().read_unaligned().read(),
            variable.cast::<*mut libc::c_void>().read_unaligned(),
        )
    };
    match kind {
        b's' => {
            let text = CString::new(value).map_err(|_| refused())?;
            // SAFETY: a variable of this type; the text is never freed, as the module keeps it.
            unsafe {
                variable
                    .cast::<*mut c_char>()
                    .write_unaligned(text.into_raw());
            }
        }
        b'i' | b'u' => {
            let number: c_int = value.parse().map_err(|_| refused())?;
            // SAFETY: a variable of this type.
            unsafe { variable.cast::<c_int>().write_unaligned(number) };
        }
        _ => return Err(refused()),
    }
    Ok(())
}
