//! Kinematics that are ready to be switched to: a frame with work offset and tool as they are now, and what is behind it.

use nalgebra::{Matrix3, Vector3};

use super::behind::Behind;
use super::command::Source;
use super::pins::FrameInputs;
use super::refusal::FrameRefusal;
use crate::axes::Axes;
use crate::frame::{ActiveFrame, AffineMap, ProgrammableFrame, ToolLength, WorkOffset};

/// How far, in machine units, an axis without a joint may be taken along, and how much of another
/// axis may reach it: rounding.
const STILL: f64 = 1e-9;

/// Kinematics that are ready to be switched to.
#[derive(Clone, Copy, Debug)]
pub struct Staged {
    /// What the frame is made of.
    pub source: Source,
    /// `None`: no frame.
    pub frame: Option<ActiveFrame>,
    /// What turns its positions into joints.
    pub behind: Behind,
    /// The tool offset it was made with.
    pub tool_offset: [f64; 3],
    /// The work offset it was made with.
    pub work_offset: [f64; 3],
    /// Its rotation about Z.
    pub work_rotation: f64,
}

impl Staged {
    /// What is behind alone, with what a frame was made of kept for later.
    pub fn without_frame(source: Source, behind: Behind, inputs: &FrameInputs) -> Self {
        Self {
            source,
            frame: None,
            behind,
            tool_offset: inputs.tool_offset,
            work_offset: inputs.work_offset,
            work_rotation: inputs.work_rotation,
        }
    }

    /// Inputs with the work offset of this: what is on the pins may have been sent with a command that was refused.
    pub fn with_its_work_offset(&self, inputs: &FrameInputs) -> FrameInputs {
        FrameInputs {
            work_offset: self.work_offset,
            work_rotation: self.work_rotation,
            ..*inputs
        }
    }

    /// The kinematics that this makes, with work offset and tool as they are now.
    ///
    /// # Errors
    ///
    /// What is wrong with the frame.
    pub fn new(source: Source, behind: Behind, inputs: &FrameInputs) -> Result<Self, FrameRefusal> {
        let programmed = match source.operations() {
            Some(list) if list.is_empty() => None,
            Some(list) => Some(list.fold()?),
            None => {
                let [xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z] = inputs.map;
                let linear = Matrix3::new(xx, xy, xz, yx, yy, yz, zx, zy, zz);
                let map = AffineMap::new(linear, Vector3::new(x, y, z))?;
                Some(ProgrammableFrame::from_map(map)?)
            }
        };
        let frame = match programmed {
            None => None,
            Some(programmed) => Some(joined(&programmed, &behind, inputs)?),
        };
        Ok(Self {
            frame,
            ..Self::without_frame(source, behind, inputs)
        })
    }

    /// This, once the inner kinematics have taken its type in place of the one before.
    ///
    /// # Errors
    ///
    /// [`FrameRefusal::UnknownInnerType`]: they have not.
    pub fn taken(
        self,
        before: i32,
        mut switch_inner: impl FnMut(i32) -> bool,
    ) -> Result<Self, FrameRefusal> {
        let wanted = self.behind.inner_type();
        if wanted != before && !switch_inner(wanted) {
            // Those of LinuxCNC 2.9 have taken what they refuse, and would answer nothing any more.
            switch_inner(before);
            return Err(FrameRefusal::UnknownInnerType);
        }
        Ok(self)
    }
}

/// A frame with work offset and tool as they are now.
fn joined(
    programmed: &ProgrammableFrame,
    behind: &Behind,
    inputs: &FrameInputs,
) -> Result<ActiveFrame, FrameRefusal> {
    let offset = spread(&inputs.work_offset);
    let work = WorkOffset::new(offset, Axes::zeros(), inputs.work_rotation)?;
    let tool = spread(&inputs.tool_offset);
    // With the tool centre point on, the kinematics behind the frame turn the tool's length.
    let tool_length = if behind.turns_tool() {
        ToolLength::Machine
    } else {
        inputs.tool_length
    };
    let frame = ActiveFrame::new(programmed, inputs.mirror, &work, &tool, tool_length)?;
    if moves_missing_axis(frame.map(), |axis| behind.lacks(axis, inputs)) {
        return Err(FrameRefusal::MissingAxis);
    }
    Ok(frame)
}

/// Whether an axis that the machine lacks would have to leave its zero for the program to be run.
fn moves_missing_axis(map: &AffineMap, lacks: impl Fn(usize) -> bool) -> bool {
    map.to_rows().iter().enumerate().any(|(axis, row)| {
        let [x, y, z, shift] = *row;
        let others = [x, y, z]
            .iter()
            .enumerate()
            .any(|(other, part)| other != axis && part.abs() > STILL);
        (others || shift.abs() > STILL) && lacks(axis)
    })
}

/// X Y Z of nine axes, the others 0.
fn spread([x, y, z]: &[f64; 3]) -> Axes {
    Axes::from([*x, *y, *z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}
