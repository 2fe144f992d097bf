//! LinuxCNC's pose and our nine axes.

use super::linuxcnc::{EmcPose, PmCartesian};
use crate::axes::Axes;

/// A pose as nine numbers.
pub fn axes_of(pose: &EmcPose) -> Axes {
    Axes::from([[
        pose.tran.x,
        pose.tran.y,
        pose.tran.z,
        pose.a,
        pose.b,
        pose.c,
        pose.u,
        pose.v,
        pose.w,
    ]])
}

/// Nine numbers as a pose.
pub fn pose_of(axes: &Axes) -> EmcPose {
    let [[x, y, z, a, b, c, u, v, w]] = axes.data.0;
    EmcPose {
        tran: PmCartesian { x, y, z },
        a,
        b,
        c,
        u,
        v,
        w,
    }
}
