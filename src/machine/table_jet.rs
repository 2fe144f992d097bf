//! How the joints of a tilting rotary table move: see [`table_tilting`](super::table_tilting) for what is derived here.

use super::jet::Jet;
use super::table_tilting::{RotaryDirection, TableTilting, TiltAxis};
use crate::axes::Axes;

impl TableTilting {
    /// Three derivatives of what the joints of the axes are set to, shape (9), for a position and its derivatives by the
    /// same parameter.
    #[inline]
    pub fn derivatives(&self, position: &Axes, derivatives: &[Axes; 3]) -> [Axes; 3] {
        let parameters = self.parameters();
        if !parameters.tool_centre_point {
            return *derivatives;
        }
        let [first, second, third] = derivatives;
        let along = |axis: usize| Jet([position[axis], first[axis], second[axis], third[axis]]);
        let (r, d) = (parameters.rotation_point, self.pivot());
        let tilt = match self.tilt_axis() {
            TiltAxis::A => along(3),
            TiltAxis::B => along(4),
        };
        let turned = |angle: Jet| {
            let (sine, cosine) = angle.sin_cos();
            match parameters.direction {
                RotaryDirection::Table => (sine, cosine),
                RotaryDirection::Conventional => (Jet([0.0; 4]) - sine, cosine),
            }
        };
        let ((st, ct), (sr, cr)) = (turned(tilt), turned(along(5)));
        let (x, y) = (along(0) - r.x, along(1) - r.y);
        let on_table = [
            cr * x - sr * y - d.x,
            sr * x + cr * y - d.y,
            along(2) - r.z - d.z,
        ];
        let [x, y, z] = on_table;
        let joints = match self.tilt_axis() {
            TiltAxis::A => [x, ct * y - st * z, st * y + ct * z],
            TiltAxis::B => [ct * x + st * z, y, ct * z - st * x],
        };
        let mut moved = *derivatives;
        for (axis, Jet([_, of_first, of_second, of_third])) in joints.iter().enumerate() {
            moved[0][axis] = *of_first;
            moved[1][axis] = *of_second;
            moved[2][axis] = *of_third;
        }
        moved
    }
}
