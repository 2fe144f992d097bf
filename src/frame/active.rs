//! The active frame: frame, work offset and tool in one map each way, for the servo thread.

use nalgebra::{Matrix3, Vector3};

use super::affine::AffineMap;
use super::error::FrameError;
use super::operation::check_translation;
use super::programmable::ProgrammableFrame;
use super::work_offset::{WorkOffset, linear_axes};
use crate::axes::Axes;

/// What rounding leaves between two maps that are the same; of a tool 1 m long that is 1 nm.
const ROUNDING: f64 = 1e-9;

/// What becomes of the tool's length offset in a turned frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToolLength {
    /// It follows the rotation of the frame: the tool stands normal to the tilted plane and nothing
    /// behind the frame knows of it.
    #[default]
    Frame,
    /// It stays along the machine's axes: the tool does not tilt, or kinematics behind the frame
    /// with the tool centre point on (table tilting) turn the length themselves.
    Machine,
}

/// A programmable frame in force. It takes the commanded world position `c`, as LinuxCNC has
/// computed it with the work offset W and tool offset T, to the machine:
///
/// ```text
/// machine = A (c - T) + L T        A = W F W^-1,  L: rotation of A, or 1 (ToolLength)
/// ```
///
/// A B C U V W pass through; those that are mirrored change sign about the zero of the work offset,
/// their tool offset does not. Immutable: a new frame is a new value, built outside of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveFrame {
    to_machine: AffineMap,
    to_world: AffineMap,
    /// A.
    tip: AffineMap,
    rotation: Matrix3<f64>,
    /// L.
    length: Matrix3<f64>,
    /// 1 or -1 for A B C U V W.
    sign: [f64; 6],
    /// Added after the sign.
    shift: [f64; 6],
}

impl ActiveFrame {
    /// No frame: machine and world are the same, to the last bit.
    pub fn identity() -> Self {
        Self {
            to_machine: AffineMap::identity(),
            to_world: AffineMap::identity(),
            tip: AffineMap::identity(),
            rotation: Matrix3::identity(),
            length: Matrix3::identity(),
            sign: [1.0; 6],
            shift: [0.0; 6],
        }
    }

    /// `mirrored`: which of A B C U V W are mirrored. `tool`: the tool offset in force, machine
    /// units and degrees, shape (9).
    ///
    /// # Errors
    ///
    /// [`FrameError::NotFinite`], [`FrameError::TranslationTooLarge`] (of tool or of the whole);
    /// singular and ill-conditioned frames were refused when `frame` was made.
    pub fn new(
        frame: &ProgrammableFrame,
        mirrored: [bool; 6],
        work: &WorkOffset,
        tool: &Axes,
        tool_length: ToolLength,
    ) -> Result<Self, FrameError> {
        check_translation(tool.iter())?;
        let mut active = Self::identity();
        active.mirror_passing_axes(mirrored, &(work.origin() + tool));
        check_translation([0.0; 3].iter().chain(&active.shift))?;
        // Joining W with its own inverse would leave rounding errors where nothing is to be done.
        if frame.is_identity() {
            return Ok(active);
        }
        let (out, back) = (work.map(), work.inverse_map());
        let linear_tool = linear_axes(tool);
        let tip = out.compose(frame.map()).compose(&back);
        active.rotation = out.linear() * (frame.rotation() * back.linear());
        active.length = match tool_length {
            ToolLength::Frame => active.rotation,
            ToolLength::Machine => Matrix3::identity(),
        };
        let shift = tip.apply(&-linear_tool) + active.turned_tool(&linear_tool);
        check_translation(shift.iter())?;
        active.to_machine = AffineMap::new(*tip.linear(), shift)?;
        active.to_world = active.to_machine.inverse()?;
        active.tip = tip;
        Ok(active)
    }

    /// `origin`: where the axes, with the tool, have their zero.
    fn mirror_passing_axes(&mut self, mirrored: [bool; 6], origin: &Axes) {
        let settings = self.sign.iter_mut().zip(&mut self.shift);
        for ((sign, shift), (mirrored, origin)) in
            settings.zip(mirrored.iter().zip(origin.iter().skip(3)))
        {
            if *mirrored {
                *sign = -1.0;
                *shift = 2.0 * origin;
            }
        }
    }

    /// Machine position of a commanded world position; finite for positions up to 1e300.
    #[inline]
    pub fn to_machine(&self, world: &Axes) -> Axes {
        let [x, y, z, passing @ ..]: [f64; 9] = (*world).into();
        let tip = self.to_machine.apply(&Vector3::new(x, y, z));
        let [sign, shift] = [&self.sign, &self.shift];
        joined(
            &tip,
            passing,
            |value, sign, shift| value * sign + shift,
            sign,
            shift,
        )
    }

    /// A derivative of the machine position for one of the commanded world position.
    #[inline]
    pub fn derivative_to_machine(&self, world: &Axes) -> Axes {
        let [x, y, z, passing @ ..]: [f64; 9] = (*world).into();
        let tip = self.to_machine.linear() * Vector3::new(x, y, z);
        let [sign, shift] = [&self.sign, &self.shift];
        joined(&tip, passing, |value, sign, _| value * sign, sign, shift)
    }

    /// World position of a machine position: the inverse of [`Self::to_machine`], exact to 1e-9
    /// machine units on the machine for positions up to 1e3 (and in world coordinates for scales
    /// from 0.1 to 10, which do not magnify it).
    #[inline]
    pub fn to_world(&self, machine: &Axes) -> Axes {
        let [x, y, z, passing @ ..]: [f64; 9] = (*machine).into();
        let tip = self.to_world.apply(&Vector3::new(x, y, z));
        let [sign, shift] = [&self.sign, &self.shift];
        joined(
            &tip,
            passing,
            |value, sign, shift| (value - shift) * sign,
            sign,
            shift,
        )
    }

    /// The way in world coordinates that is this one of X Y Z on the machine.
    pub fn vector_to_world(&self, way: &Vector3<f64>) -> Vector3<f64> {
        self.to_world.apply_to_vector(way)
    }

    /// The map of X Y Z from world to machine, tool and work offset included.
    pub fn map(&self) -> &AffineMap {
        &self.to_machine
    }

    /// The map of the tool's tip, A: from where it would be without the frame to where it is, in
    /// the machine's X Y Z.
    pub fn tip_map(&self) -> &AffineMap {
        &self.tip
    }

    /// How a tool with this length offset stands in the machine, L T: from its tip to the position
    /// of the axes.
    pub fn turned_tool(&self, tool: &Vector3<f64>) -> Vector3<f64> {
        self.length * tool
    }

    /// Whether a tool offset that changes under this frame leads the tip elsewhere than the program says: what A does to the
    /// change is not what L does.
    pub fn tool_length_matters(&self) -> bool {
        (self.tip.linear() - self.length).amax() > ROUNDING
    }

    /// Direction of a tool that stands normal to the frame's XY plane, from its tip towards the
    /// spindle, in world coordinates; of length 1.
    pub fn tool_axis(&self) -> Vector3<f64> {
        let m = &self.rotation;
        Vector3::new(m.m13, m.m23, m.m33)
    }
}

#[inline]
fn joined(
    linear: &Vector3<f64>,
    [a, b, c, u, v, w]: [f64; 6],
    change: impl Fn(f64, f64, f64) -> f64,
    sign: &[f64; 6],
    shift: &[f64; 6],
) -> Axes {
    Axes::from([
        linear.x,
        linear.y,
        linear.z,
        change(a, sign[0], shift[0]),
        change(b, sign[1], shift[1]),
        change(c, sign[2], shift[2]),
        change(u, sign[3], shift[3]),
        change(v, sign[4], shift[4]),
        change(w, sign[5], shift[5]),
    ])
}
