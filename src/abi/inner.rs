//! The functions of the kinematics module behind the frame.

use libc::{c_double, c_int, c_ulong};

use super::linuxcnc::EmcPose;
use super::pose::{axes_of, pose_of};
use crate::axes::Axes;
use crate::frame::ActiveFrame;
use crate::kinematics::inner::{self, InnerKinematics};
use crate::machine::JOINT_COUNT;

/// LinuxCNC's `kinematicsInverse`.
pub(super) type Inverse = Option<
    unsafe extern "C" fn(*const EmcPose, *mut c_double, *const c_ulong, *mut c_ulong) -> c_int,
>;
/// LinuxCNC's `kinematicsForward`.
pub(super) type Forward = Option<
    unsafe extern "C" fn(*const c_double, *mut EmcPose, *const c_ulong, *mut c_ulong) -> c_int,
>;
/// LinuxCNC's `kinematicsSwitch`.
type Switch = Option<unsafe extern "C" fn(c_int) -> c_int>;

/// The functions of the other module; none before it is found.
#[derive(Clone, Copy)]
pub(super) struct InnerModule {
    pub(super) inverse: Inverse,
    pub(super) forward: Forward,
    pub(super) switch: Switch,
}

impl InnerModule {
    pub(super) const NONE: Self = Self {
        inverse: None,
        forward: None,
        switch: None,
    };

    /// Whether it has switched to this type.
    pub(super) fn switch(&self, kind: c_int) -> bool {
        // SAFETY: the module's own function.
        self.switch
            .is_some_and(|switch| unsafe { switch(kind) } == 0)
    }

    /// Which of X Y Z the machine cannot move; none where no other module is.
    pub(super) fn fixed_axes(&self, position: &[f64; 9], joints: &[f64; JOINT_COUNT]) -> [bool; 3] {
        if self.inverse.is_none() {
            return [false; 3];
        }
        let mut calls = Calls {
            module: *self,
            forward_flags: 0,
            inverse_flags: 0,
        };
        inner::fixed_axes(&mut calls, &Axes::from(*position), joints)
    }

    /// Whether it leads back from the place of these joints to others, by the frame that comes or without; never where no
    /// other module is.
    pub(super) fn other_joints(
        &self,
        coming: Option<&ActiveFrame>,
        position: &[f64; 9],
        joints: &[f64; JOINT_COUNT],
    ) -> bool {
        if self.inverse.is_none() {
            return false;
        }
        let mut calls = Calls {
            module: *self,
            forward_flags: 0,
            inverse_flags: 0,
        };
        inner::other_joints(&mut calls, coming, &Axes::from(*position), joints)
    }
}

/// Calls of the other module with the flags that LinuxCNC hands over.
pub(super) struct Calls {
    pub(super) module: InnerModule,
    pub(super) forward_flags: c_ulong,
    pub(super) inverse_flags: c_ulong,
}

impl InnerKinematics for Calls {
    fn inverse(&mut self, axes: &Axes, joints: &mut [f64; JOINT_COUNT]) -> i32 {
        let pose = pose_of(axes);
        let (read, written) = (&self.inverse_flags, &mut self.forward_flags);
        // SAFETY: the module's own function, with as many joints as it may write.
        self.module.inverse.map_or(-1, |inverse| unsafe {
            inverse(&pose, joints.as_mut_ptr(), read, written)
        })
    }

    fn forward(&mut self, joints: &[f64; JOINT_COUNT], axes: &mut Axes) -> i32 {
        let mut pose = pose_of(axes);
        let (read, written) = (&self.forward_flags, &mut self.inverse_flags);
        // SAFETY: the module's own function, with as many joints as it may read.
        let result = self.module.forward.map_or(-1, |forward| unsafe {
            forward(joints.as_ptr(), &mut pose, read, written)
        });
        *axes = axes_of(&pose);
        result
    }
}
