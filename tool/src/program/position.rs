//! Where the axes are while a program is evaluated, as far as that is known ahead of time.
//!
//! Nothing is known at the start, after a tool or a work offset changes, and after a motion in
//! machine coordinates: the offsets are set at the machine. Another tool offset moves the axes that the tool table says.
//! A coordinate that is not known is
//! never guessed. The backends write it so that LinuxCNC works it out, or refuse.

use super::frame::Frame;
use framepath::frame::AffineMap;
use nalgebra::Vector3;

/// Coordinates in the current frame: X Y Z A B C U V W.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Position {
    coordinates: [Option<f64>; 9],
}

impl Position {
    /// All axes.
    pub fn coordinates(&self) -> [Option<f64>; 9] {
        self.coordinates
    }

    /// One axis.
    pub fn get(&self, axis: usize) -> Option<f64> {
        self.coordinates[axis]
    }

    /// Sets one axis.
    pub fn set(&mut self, axis: usize, value: Option<f64>) {
        self.coordinates[axis] = value;
    }

    /// Forgets all axes.
    pub fn forget(&mut self) {
        self.coordinates = [None; 9];
    }

    /// The same place, with its coordinates in another frame. The tool does not move when the frame
    /// changes; a coordinate is known in the new frame when all that it depends on was known.
    pub fn change_frame(&mut self, from: &Frame, to: &Frame) {
        let Ok(to_inverse) = to.map().inverse() else {
            self.forget();
            return;
        };
        let linear = [0, 1, 2].map(|axis| self.coordinates[axis]);
        let moved = apply_partly(&to_inverse, apply_partly(from.map(), linear));
        self.coordinates[..3].copy_from_slice(&moved);
    }
}

/// The axes whose coordinates in the frame change where these axes of the machine move: they themselves, and those that
/// the frame mixes with them.
pub fn displaced_in(frame: &Frame, axes: [bool; 9]) -> [bool; 9] {
    let mut displaced = axes;
    if frame.is_empty() {
        return displaced;
    }
    let stays = [0, 1, 2].map(|axis| (!axes[axis]).then_some(0.0));
    let in_frame = match frame.map().inverse() {
        Ok(inverse) => apply_partly(&inverse, stays),
        Err(_) => [None; 3],
    };
    for (axis, place) in in_frame.into_iter().enumerate() {
        displaced[axis] |= place.is_none();
    }
    displaced
}

/// The image of a point of which only some coordinates are known.
pub fn apply_partly(map: &AffineMap, point: [Option<f64>; 3]) -> [Option<f64>; 3] {
    // Entries that are zero but for rounding do not make a coordinate depend on another.
    const NOTHING: f64 = 1e-14;
    let largest = map.linear().amax();
    let filled = map.apply(&Vector3::from(point.map(|value| value.unwrap_or(0.0))));
    std::array::from_fn(|row| {
        let known = point.iter().enumerate().all(|(column, value)| {
            value.is_some() || map.linear()[(row, column)].abs() <= NOTHING * largest
        });
        known.then(|| filled[row])
    })
}
