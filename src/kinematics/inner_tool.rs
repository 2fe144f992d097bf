//! How the kinematics of another module turn the tool, found by asking them.
//!
//! They say joints for a tip and angles of A B C, and nothing of the tool. Where the linear joints are straight along X Y Z
//! that is enough:
//!
//! ```text
//! joints(tip, angles) = T (tip - c) + c' + L (h - z)
//! ```
//!
//! with T the turn of the table, h where the head has the tool, from the tip towards the spindle, and L from the tip to where
//! the head turns. Joints beside a tip give T. Where an angle changes them and not T, it belongs to the head, and since h and z
//! have the same length, the way d of the joints gives L: `d d + 2 L d z = 0`. The tool then has the direction T^-1 h on the
//! workpiece. What is found has to agree with further angles to the last digits. Of a head whose axes do not meet
//! [`head_circles`](super::head_circles) makes something; everything else (robots) is not known, unless a user says it.

use nalgebra::{Matrix3, Unit, Vector3};

use super::head_circles::chain_by_circles;
use super::inner::InnerKinematics;
use super::inner_normal::A;
use super::rotary_chain::{RotaryAxis, RotaryChain};
use super::tool_angles::RotaryAngles;
use super::tool_axes::ToolAxes;
use crate::axes::Axes;
use crate::machine::JOINT_COUNT;

/// How far the tip is moved to see how a machine is built, machine units: little, since it may be one of arms.
const NUDGE: f64 = 1e-3;
/// Of the derivatives that this gives.
const ROUGH: f64 = 1e-5;
/// Of what is found with whole machine units, and of directions.
const CLOSE: f64 = 1e-7;
/// How far, degrees, an axis that is not to turn the tool may be off: kinematics that iterate.
const UNTURNED: f64 = 1e-4;
/// Angles that are tried, degrees.
const TRIED: f64 = 20.0;
/// Angles of both axes at which what was found is compared once more, degrees.
const COMPARED: [[f64; 2]; 3] = [[35.0, -50.0], [-65.0, 25.0], [110.0, 15.0]];

/// What is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolTurning {
    /// The axes that turn the tool; `None` if none does.
    pub chain: Option<RotaryChain>,
    /// The joint that runs along Z; `None` of an arm.
    pub z_joint: Option<usize>,
}

impl ToolTurning {
    /// Whether an arm, of which the user says what turns the tool, has another axis where the tool may point elsewhere than these
    /// say. LinuxCNC's arms turn the tool by A, then B, then C: so A may stand half a turn from 0, where the tool hangs down, and
    /// B and C, which carry what the others have tilted, at 0 alone.
    pub fn is_turned_by_another(&self, axes: &Axes) -> bool {
        let Some(chain) = self.chain.filter(|_| self.z_joint.is_none()) else {
            return false;
        };
        let is_named = |letter: usize| {
            letter == chain.tilt.letter || chain.rotary.is_some_and(|it| it.letter == letter)
        };
        let off = |letter: usize, period: f64| {
            let periods = axes.get(A + letter).map_or(0.0, |angle| angle / period);
            period * (periods - periods.round()).abs()
        };
        [(0, 180.0), (1, 360.0), (2, 360.0)]
            .into_iter()
            .any(|(letter, period)| !is_named(letter) && off(letter, period) > UNTURNED)
    }
}

/// Which axes turn the tool and how. `axes` and `joints` are those of now, `said` is what the user says of it.
///
/// # Errors
///
/// [`Unknown`].
pub fn tool_turning(
    inner: &mut impl InnerKinematics,
    axes: &Axes,
    joints: &[f64; JOINT_COUNT],
    said: &ToolAxes,
) -> Result<ToolTurning, Unknown> {
    // The arm that the machine has with these joints.
    let mut here = *axes;
    inner.forward(joints, &mut here);
    let found = Asked::new(inner, axes, joints).and_then(|mut asked| {
        let [_, _, z_joint] = asked.linear;
        let by_reach = asked.find_reach().and_then(|()| asked.chain());
        let chain = match by_reach {
            Some(chain) => chain,
            None => Some(asked.chain_by_circles()?),
        };
        Some(ToolTurning {
            chain,
            z_joint: Some(z_joint),
        })
    });
    // Some remember where they were asked last.
    let mut back = *joints;
    inner.inverse(axes, &mut back);
    with_what_is_said(found, said)
}

/// How the kinematics turn the tool is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// It cannot be found out, and nobody says it.
    NotFound,
    /// They turn it otherwise than the user says.
    NotAsSaid,
}

fn with_what_is_said(found: Option<ToolTurning>, said: &ToolAxes) -> Result<ToolTurning, Unknown> {
    let chain = match (found, said) {
        (Some(found), said) => {
            let is_so = match (found.chain, said) {
                (None, _) | (_, ToolAxes::Unsaid) => true,
                (Some(_), ToolAxes::Nothing) => false,
                (Some(chain), ToolAxes::Turning(other)) => is_alike(&chain, other),
            };
            return if is_so {
                Ok(found)
            } else {
                Err(Unknown::NotAsSaid)
            };
        }
        (None, ToolAxes::Unsaid) => return Err(Unknown::NotFound),
        (None, ToolAxes::Nothing) => None,
        (None, ToolAxes::Turning(chain)) => Some(*chain),
    };
    Ok(ToolTurning {
        chain,
        z_joint: None,
    })
}

/// Whether two chains turn the tool alike.
fn is_alike(one: &RotaryChain, other: &RotaryChain) -> bool {
    let direction = |chain: &RotaryChain, angles: [f64; 3]| {
        let angle = |axis: &RotaryAxis| angles.get(axis.letter).copied().unwrap_or(0.0);
        chain.direction(RotaryAngles {
            tilt: angle(&chain.tilt),
            rotary: chain.rotary.as_ref().map_or(0.0, angle),
        })
    };
    COMPARED.iter().all(|[one_angle, other_angle]| {
        let angles = [*one_angle, *other_angle, TRIED];
        (direction(one, angles) - direction(other, angles)).norm() < CLOSE
    })
}

/// Kinematics whose linear joints are straight, and what is known of them.
struct Asked<'a, K> {
    inner: &'a mut K,
    axes: Axes,
    joints: [f64; JOINT_COUNT],
    /// The joint of each of X Y Z.
    linear: [usize; 3],
    /// Which of A B C belong to the head.
    head: [bool; 3],
    /// From the tip to where the head turns, machine units; none without such a head.
    reach: Option<f64>,
}

impl<'a, K: InnerKinematics> Asked<'a, K> {
    fn new(inner: &'a mut K, axes: &Axes, joints: &[f64; JOINT_COUNT]) -> Option<Self> {
        let mut asked = Self {
            inner,
            axes: *axes,
            joints: *joints,
            linear: [0; 3],
            head: [false; 3],
            reach: None,
        };
        asked.find_linear_joints()?;
        asked.find_tables()?;
        Some(asked)
    }

    /// The joints for a tip beside that of now and angles of A B C.
    fn joints_at(&mut self, beside: Vector3<f64>, angles: [f64; 3]) -> Option<[f64; JOINT_COUNT]> {
        let [x, y, z, _, _, _, u, v, w]: [f64; 9] = self.axes.into();
        let [a, b, c] = angles;
        let axes = Axes::from([x + beside.x, y + beside.y, z + beside.z, a, b, c, u, v, w]);
        let mut joints = self.joints;
        let result = self.inner.inverse(&axes, &mut joints);
        (result == 0 && joints.iter().all(|joint| joint.is_finite())).then_some(joints)
    }

    /// How each joint changes with X Y Z: rows of three.
    fn rows(&mut self, angles: [f64; 3], nudge: f64) -> Option<[Vector3<f64>; JOINT_COUNT]> {
        let here = self.joints_at(Vector3::zeros(), angles)?;
        let x = self.joints_at(Vector3::x() * nudge, angles)?;
        let y = self.joints_at(Vector3::y() * nudge, angles)?;
        let z = self.joints_at(Vector3::z() * nudge, angles)?;
        let mut rows = [Vector3::zeros(); JOINT_COUNT];
        for (row, (here, (x, (y, z)))) in rows
            .iter_mut()
            .zip(here.iter().zip(x.iter().zip(y.iter().zip(&z))))
        {
            *row = Vector3::new(x - here, y - here, z - here) / nudge;
        }
        Some(rows)
    }

    /// The joints that X Y Z move with all angles at 0: each of them one, straight, in machine units; the first where several move
    /// alike. Arms are recognised without turning anything.
    fn find_linear_joints(&mut self) -> Option<()> {
        let [_, _, _, a, b, c, ..]: [f64; 9] = self.axes.into();
        let mut lines: [Option<Vector3<f64>>; 3] = [None; 3];
        for row in self.rows([a, b, c], NUDGE)? {
            let is_new = lines
                .iter()
                .flatten()
                .all(|line| (line - row).norm() > ROUGH);
            if row.norm() > ROUGH && is_new {
                *lines.iter_mut().find(|line| line.is_none())? = Some(row);
            }
        }
        let [Some(x), Some(y), Some(z)] = lines else {
            return None;
        };
        let lines = Matrix3::from_columns(&[x, y, z]);
        is_near(
            &(lines.transpose() * lines),
            &Matrix3::identity(),
            10.0 * ROUGH,
        )
        .then_some(())?;
        let rows = self.rows([0.0; 3], 1.0)?;
        let joint_along =
            |line: Vector3<f64>| rows.iter().position(|row| (row - line).norm() < CLOSE);
        self.linear = [
            joint_along(Vector3::x())?,
            joint_along(Vector3::y())?,
            joint_along(Vector3::z())?,
        ];
        Some(())
    }

    /// The linear joints at these angles.
    fn place(&mut self, angles: [f64; 3]) -> Option<Vector3<f64>> {
        let joints = self.joints_at(Vector3::zeros(), angles)?;
        let [x, y, z] = self.linear.map(|joint| joints.get(joint).copied());
        Some(Vector3::new(x?, y?, z?))
    }

    /// The turn of the table.
    fn table(&mut self, angles: [f64; 3]) -> Option<Matrix3<f64>> {
        let rows = self.rows(angles, 1.0)?;
        let [x, y, z] = self
            .linear
            .map(|joint| rows.get(joint).map(Vector3::transpose));
        Some(Matrix3::from_rows(&[x?, y?, z?]))
    }

    /// Which axes turn the workpiece; all others count for the head.
    fn find_tables(&mut self) -> Option<()> {
        let level = self.table([0.0; 3])?;
        let mut head = [false; 3];
        for (axis, is_head) in head.iter_mut().enumerate() {
            let turned = self.table(only(axis, TRIED))?;
            *is_head = is_near(&turned, &level, CLOSE);
        }
        self.head = head;
        Some(())
    }

    /// How far above the tip the head turns, where its axes meet.
    fn find_reach(&mut self) -> Option<()> {
        let angles = self.head.map(|is_head| if is_head { TRIED } else { 0.0 });
        let way = self.place(angles)? - self.place([0.0; 3])?;
        if way.norm() > CLOSE {
            let reach = -way.norm_squared() / (2.0 * way.z);
            self.reach = Some(reach).filter(|reach| reach.is_finite() && *reach > CLOSE);
            self.reach?;
        }
        Some(())
    }

    /// Where the tool points on the workpiece.
    fn tool(&mut self, angles: [f64; 3]) -> Option<Vector3<f64>> {
        let mut head = Vector3::z();
        if let Some(reach) = self.reach {
            let mut level = angles;
            for (angle, is_head) in level.iter_mut().zip(self.head) {
                *angle = if is_head { 0.0 } else { *angle };
            }
            head += (self.place(angles)? - self.place(level)?) / reach;
        }
        Some(self.table(angles)?.transpose() * head)
    }

    /// The axes of a head that do not meet, with a table that one axis turns or none.
    fn chain_by_circles(&mut self) -> Option<RotaryChain> {
        let is_of_head = self.head;
        let mut tables = (0..3).filter(|axis| !is_of_head.get(*axis).copied().unwrap_or(true));
        let table = match (tables.next(), tables.next()) {
            (None, _) => None,
            (Some(axis), None) => Some(self.table_axis(axis)?),
            (Some(_), Some(_)) => return None,
        };
        chain_by_circles(|angles| self.place(angles), is_of_head, table)
    }

    /// An axis of the table, as the workpiece sees it.
    fn table_axis(&mut self, letter: usize) -> Option<RotaryAxis> {
        let turn = self.table(only(letter, TRIED))?.transpose();
        let twist = Vector3::new(
            turn.m32 - turn.m23,
            turn.m13 - turn.m31,
            turn.m21 - turn.m12,
        );
        let axis = RotaryAxis {
            letter,
            line: Unit::try_new(twist, CLOSE)?,
            is_of_head: false,
        };
        let alike = [Vector3::x(), Vector3::y(), Vector3::z()]
            .iter()
            .all(|side| (axis.turned(TRIED, side) - turn * side).norm() < CLOSE);
        alike.then_some(axis)
    }

    /// The axes that tilt the tool by themselves, and those along it that turn what is tilted.
    fn chain(&mut self) -> Option<Option<RotaryChain>> {
        let mut found = [None; 3];
        for (axis, found) in found.iter_mut().enumerate() {
            *found = self.tilting(axis)?;
        }
        let Some(tilted) = found.iter().flatten().copied().next() else {
            return Some(None);
        };
        for (axis, found) in found.iter_mut().enumerate() {
            if found.is_none() {
                *found = self.along_tool(axis, &tilted)?;
            }
        }
        let mut turning = found.into_iter().flatten();
        let chain = match (turning.next(), turning.next(), turning.next()) {
            (Some(tilt), None, _) => RotaryChain { rotary: None, tilt },
            (Some(one), Some(other), None) => self.in_order(one, other)?,
            _ => return None,
        };
        self.agrees(&chain, &COMPARED)?.then_some(Some(chain))
    }

    /// `Some(None)` if the axis leaves the tool where it is.
    fn tilting(&mut self, axis: usize) -> Option<Option<RotaryAxis>> {
        let (there, back) = (
            self.tool(only(axis, TRIED))?,
            self.tool(only(axis, -TRIED))?,
        );
        let z = Vector3::z();
        if (there - z).norm() < CLOSE && (back - z).norm() < CLOSE {
            return Some(None);
        }
        let line = Unit::try_new((there - z).cross(&(back - z)), CLOSE * CLOSE)?;
        Some(Some(self.either_way(axis, line, &z, &there)?))
    }

    /// An axis along the tool; `Some(None)` if it turns nothing.
    fn along_tool(&mut self, axis: usize, tilted: &RotaryAxis) -> Option<Option<RotaryAxis>> {
        let before = self.tool(only(tilted.letter, TRIED))?;
        let after = self.tool(both((axis, TRIED), (tilted.letter, TRIED)))?;
        if (after - before).norm() < CLOSE {
            return Some(None);
        }
        let line = Vector3::z_axis();
        Some(Some(self.either_way(axis, line, &before, &after)?))
    }

    /// Which one carries the other.
    fn in_order(&mut self, one: RotaryAxis, other: RotaryAxis) -> Option<RotaryChain> {
        for (rotary, tilt) in [(one, other), (other, one)] {
            let chain = RotaryChain {
                rotary: Some(rotary),
                tilt,
            };
            let is_along_tool = (tilt.line.z.abs() - 1.0).abs() < CLOSE;
            if !is_along_tool && self.agrees(&chain, &COMPARED)? {
                return Some(chain);
            }
        }
        None
    }

    /// The axis about this line, or the other way round, that has turned one direction into another.
    fn either_way(
        &self,
        letter: usize,
        line: Unit<Vector3<f64>>,
        before: &Vector3<f64>,
        after: &Vector3<f64>,
    ) -> Option<RotaryAxis> {
        let is_of_head = self.head.get(letter).copied().unwrap_or(false);
        [line, -line]
            .map(|line| RotaryAxis {
                letter,
                line,
                is_of_head,
            })
            .into_iter()
            .find(|axis| (axis.turned(TRIED, before) - after).norm() < CLOSE)
    }

    fn agrees(&mut self, chain: &RotaryChain, compared: &[[f64; 2]]) -> Option<bool> {
        for [rotary, tilt] in compared {
            let tilted = (chain.tilt.letter, *tilt);
            let angles = chain.rotary.map_or(only(tilted.0, tilted.1), |axis| {
                both(tilted, (axis.letter, *rotary))
            });
            let expected = chain.direction(RotaryAngles {
                tilt: *tilt,
                rotary: *rotary,
            });
            if (self.tool(angles)? - expected).norm() > CLOSE {
                return Some(false);
            }
        }
        Some(true)
    }
}

/// One of A B C at an angle, the others at 0.
fn only(axis: usize, angle: f64) -> [f64; 3] {
    both((axis, angle), (axis, angle))
}

/// Two of A B C at angles, the third at 0.
fn both(one: (usize, f64), other: (usize, f64)) -> [f64; 3] {
    [0, 1, 2].map(|axis| match axis {
        _ if axis == one.0 => one.1,
        _ if axis == other.0 => other.1,
        _ => 0.0,
    })
}

fn is_near(found: &Matrix3<f64>, expected: &Matrix3<f64>, delta: f64) -> bool {
    (found - expected)
        .iter()
        .all(|element| element.abs() < delta)
}
