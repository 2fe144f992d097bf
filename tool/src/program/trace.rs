//! Following a program through space: the contour in machine coordinates.
//!
//! The path is that of the tip of the tool as it was programmed: cutter radius compensation is left
//! out, and so is the rounding of corners.

use super::arc::{ArcError, ArcTolerance, centre_from_radius, sweep};
use super::contour::{ContourMove, Shape};
use super::frame::Frame;
use super::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use super::{Action, FeedMode, Origin, Plane, Program};
use framepath::frame::{AffineMap, FrameError};
use nalgebra::{Matrix3, Vector3};

/// What the machine knows and the program does not.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Work offsets G54 to G59.3: from their coordinates to those of the machine.
    pub work_offsets: [AffineMap; 9],
    /// Which of them is active at the start, 0 for G54.
    pub active: usize,
    /// Where the tip of the tool is at the start, machine coordinates.
    pub start: [f64; 3],
}

impl Default for Setup {
    fn default() -> Self {
        Setup {
            work_offsets: [AffineMap::identity(); 9],
            active: 0,
            start: [0.0; 3],
        }
    }
}

/// Why the path cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TraceError {
    /// An arc whose start is known only now does not fit.
    Arc(Origin, ArcError),
    /// A frame that the core refuses.
    Frame(Origin, FrameError),
}

/// The contour of a program. Moves of the rotary axes and of U V W are left out; moves that go
/// nowhere too.
///
/// # Errors
///
/// See [`TraceError`]. `tolerance` is for arcs by their radius whose start the program left open.
pub fn contour(
    program: &Program,
    setup: &Setup,
    tolerance: &ArcTolerance,
) -> Result<Vec<ContourMove>, TraceError> {
    let mut tracer = Tracer {
        setup,
        tolerance,
        work_offset: setup.active,
        preset: Vector3::zeros(),
        frame: Frame::default(),
        plane: Plane::Xy,
        position: Vector3::from(setup.start),
        feed: 0.0,
        feed_mode: FeedMode::PerMinute,
        spindle_speed: 0.0,
        stretch: 1.0,
        contour: Vec::new(),
    };
    for block in &program.blocks {
        for action in &block.actions {
            tracer.action(action, block.origin)?;
        }
    }
    Ok(tracer.contour)
}

struct Tracer<'a> {
    setup: &'a Setup,
    tolerance: &'a ArcTolerance,
    work_offset: usize,
    /// Shift by G92, in coordinates of the work offset.
    preset: Vector3<f64>,
    frame: Frame,
    plane: Plane,
    position: Vector3<f64>,
    feed: f64,
    feed_mode: FeedMode,
    spindle_speed: f64,
    /// How much longer the move that is being made is than its block says, with its feed.
    stretch: f64,
    contour: Vec<ContourMove>,
}

impl Tracer<'_> {
    fn action(&mut self, action: &Action, origin: Origin) -> Result<(), TraceError> {
        let frame_error = |error| TraceError::Frame(origin, error);
        match action {
            Action::Plane(plane) => self.plane = *plane,
            Action::WorkOffset(system) => self.work_offset = usize::from(*system).saturating_sub(1),
            Action::FeedMode(mode) => self.feed_mode = *mode,
            Action::Feed(feed) => self.feed = *feed,
            Action::SpindleSpeed(speed) => self.spindle_speed = *speed,
            Action::Frame(command) => {
                self.frame = self.frame.after(*command).map_err(frame_error)?;
            }
            Action::Preset(values) => {
                let offset = self.offset_map().map_err(frame_error)?;
                let inverse = offset.inverse().map_err(frame_error)?;
                let present = inverse.apply(&self.position);
                for axis in 0..3 {
                    if let Some(value) = values[axis] {
                        self.preset[axis] += present[axis] - value;
                    }
                }
            }
            Action::LocalOffset(values) => {
                for (preset, value) in self.preset.iter_mut().zip(values) {
                    *preset = value.unwrap_or(*preset);
                }
            }
            Action::PresetOff => self.preset = Vector3::zeros(),
            Action::Move(motion) => return self.motion(motion, origin),
            _ => {}
        }
        Ok(())
    }

    /// Work offset and G92.
    fn offset_map(&self) -> Result<AffineMap, FrameError> {
        let offset = self.setup.work_offsets.get(self.work_offset);
        let offset = offset.copied().unwrap_or(AffineMap::identity());
        Ok(offset.compose(&AffineMap::new(Matrix3::identity(), self.preset)?))
    }

    fn motion(&mut self, motion: &Move, origin: Origin) -> Result<(), TraceError> {
        if let MoveKind::Machine { rapid, .. } = motion.kind {
            let mut end = self.position;
            for axis in 0..3 {
                if let Coordinate::At(value) = motion.target[axis] {
                    end[axis] = value;
                }
            }
            self.add_line(end, rapid, origin);
            return Ok(());
        }
        let frame_error = |error| TraceError::Frame(origin, error);
        let map = self
            .offset_map()
            .map_err(frame_error)?
            .compose(self.frame.map());
        let block_map = self
            .offset_map()
            .map_err(frame_error)?
            .compose(self.frame.block_map());
        let inverse = map.inverse().map_err(frame_error)?;
        let start = inverse.apply(&self.position);
        let mut end = start;
        for axis in 0..3 {
            end[axis] = match motion.target[axis] {
                Coordinate::Keep => start[axis],
                Coordinate::At(value) => value,
                Coordinate::By(step) => start[axis] + step,
            };
        }
        match &motion.kind {
            MoveKind::Arc(arc) => {
                let shape = frame_arc(arc, start, end, self.plane, self.tolerance)
                    .map_err(|error| TraceError::Arc(origin, error))?;
                if self.frame.has_stretch() {
                    let [finished, block] =
                        [&map, &block_map].map(|map| arc_length(&mapped(&shape, map)));
                    self.stretch = finished / block;
                }
                self.add_arc(&shape, &map, map.apply(&end), origin);
            }
            _ => {
                if self.frame.has_stretch() && end != start {
                    let [finished, block] =
                        [&map, &block_map].map(|map| map.apply_to_vector(&(end - start)).norm());
                    self.stretch = finished / block;
                }
                let before = self.position;
                self.add_line(map.apply(&end), motion.kind == MoveKind::Rapid, origin);
                if let MoveKind::Tap { .. } = motion.kind {
                    self.add_line(before, false, origin);
                }
            }
        }
        self.stretch = 1.0;
        Ok(())
    }

    fn add_line(&mut self, end: Vector3<f64>, rapid: bool, origin: Origin) {
        let shape = Shape::Line {
            start: self.position.into(),
            end: end.into(),
        };
        let length = (end - self.position).norm();
        self.position = end;
        if length > 0.0 {
            self.add(shape, length, rapid, origin);
        }
    }

    fn add_arc(&mut self, arc: &FrameArc, map: &AffineMap, end: Vector3<f64>, origin: Origin) {
        let shape = mapped(arc, map);
        self.position = end;
        let length = arc_length(&shape);
        self.add(shape, length, false, origin);
    }

    fn add(&mut self, shape: Shape, length: f64, rapid: bool, origin: Origin) {
        let feed = match self.feed_mode {
            _ if rapid => 0.0,
            FeedMode::PerMinute => self.feed * self.stretch,
            FeedMode::PerRevolution => self.feed * self.stretch * self.spindle_speed,
            FeedMode::InverseTime => self.feed * length,
        };
        self.contour.push(ContourMove {
            line: origin.line,
            file: origin.file,
            rapid,
            feed,
            shape,
        });
    }
}

/// The image of an arc.
fn mapped(arc: &FrameArc, map: &AffineMap) -> Shape {
    Shape::Arc {
        centre: map.apply(&arc.centre).into(),
        u: map.apply_to_vector(&arc.u).into(),
        v: map.apply_to_vector(&arc.v).into(),
        sweep: arc.sweep,
        rise: map.apply_to_vector(&arc.rise).into(),
    }
}

/// An arc in coordinates of the frame; see [`Shape::Arc`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameArc {
    /// Centre at the height of the start.
    pub centre: Vector3<f64>,
    /// From the centre to the start.
    pub u: Vector3<f64>,
    /// After a quarter turn in the direction of motion.
    pub v: Vector3<f64>,
    /// Total angle, radians.
    pub sweep: f64,
    /// From start to end, what the rotation does not do: travel along the normal, and the little by
    /// which the end may be off the circle.
    pub rise: Vector3<f64>,
}

impl FrameArc {
    /// The point at `t`, 0 at the start and 1 at the end.
    pub fn point(&self, t: f64) -> Vector3<f64> {
        let (sin, cos) = (self.sweep * t).sin_cos();
        self.centre + self.u * cos + self.v * sin + self.rise * t
    }

    /// The direction of motion at the start, not normalised.
    pub fn start_direction(&self) -> Vector3<f64> {
        self.v * self.sweep + self.rise
    }

    /// The direction of motion at the end, not normalised.
    pub fn end_direction(&self) -> Vector3<f64> {
        let (sin, cos) = self.sweep.sin_cos();
        (self.v * cos - self.u * sin) * self.sweep + self.rise
    }
}

/// An arc from `start` to `end`, coordinates of the frame.
///
/// # Errors
///
/// Those of [`centre_from_radius`].
pub fn frame_arc(
    arc: &Arc,
    start: Vector3<f64>,
    end: Vector3<f64>,
    plane: Plane,
    tolerance: &ArcTolerance,
) -> Result<FrameArc, ArcError> {
    let [first, second, normal] = plane.axes();
    let chord = [end[first] - start[first], end[second] - start[second]];
    let offset = match arc.centre {
        Centre::Offset(offset) => offset,
        Centre::Radius(radius) => centre_from_radius(chord, radius, arc.clockwise, tolerance)?,
        Centre::Point(point) => {
            let offset = |axis: usize, coordinate| match coordinate {
                Coordinate::Keep => 0.0,
                Coordinate::By(step) => step,
                Coordinate::At(value) => value - start[axis],
            };
            [offset(first, point[0]), offset(second, point[1])]
        }
    };
    let in_plane = |a: f64, b: f64| {
        let mut vector = Vector3::zeros();
        vector[first] = a;
        vector[second] = b;
        vector
    };
    let turn = if arc.clockwise { -1.0 } else { 1.0 };
    let u = in_plane(-offset[0], -offset[1]);
    let v = in_plane(turn * offset[1], -turn * offset[0]);
    let from_centre = [chord[0] - offset[0], chord[1] - offset[1]];
    let sweep = sweep(
        [-offset[0], -offset[1]],
        from_centre,
        arc.clockwise,
        arc.extra_turns,
    );
    let centre = start - u;
    let (sin, cos) = sweep.sin_cos();
    let mut rise = end - (centre + u * cos + v * sin);
    // A circle that closes exactly must not keep what is left of rounding.
    for axis in [first, second] {
        if rise[axis].abs() < 1e-12 * u.norm() {
            rise[axis] = 0.0;
        }
    }
    rise[normal] = end[normal] - start[normal];
    Ok(FrameArc {
        centre,
        u,
        v,
        sweep,
        rise,
    })
}

/// Length of an arc, by Simpson's rule over the speed: exact for circles and helices, and good to a
/// millionth for the ellipses that frames can make of them.
fn arc_length(shape: &Shape) -> f64 {
    const INTERVALS: u32 = 128;
    let Shape::Arc {
        u, v, sweep, rise, ..
    } = shape
    else {
        return 0.0;
    };
    let (u, v, rise) = (Vector3::from(*u), Vector3::from(*v), Vector3::from(*rise));
    let speed = |t: f64| {
        let (sin, cos) = (sweep * t).sin_cos();
        ((v * cos - u * sin) * *sweep + rise).norm()
    };
    let step = 1.0 / f64::from(INTERVALS);
    let sum: f64 = (0..=INTERVALS)
        .map(|index| {
            let weight = match index {
                0 | INTERVALS => 1.0,
                _ if index % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * speed(f64::from(index) * step)
        })
        .sum();
    sum * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    const TOLERANCE: ArcTolerance = ArcTolerance {
        absolute: 0.01,
        relative: 0.0,
    };

    fn arc(clockwise: bool, centre: Centre) -> Arc {
        Arc {
            clockwise,
            centre,
            extra_turns: 0,
        }
    }

    #[test]
    fn arcs_end_where_they_should_in_every_plane() {
        for plane in [Plane::Xy, Plane::Zx, Plane::Yz] {
            let [first, second, normal] = plane.axes();
            let (mut start, mut end) = (Vector3::zeros(), Vector3::zeros());
            start[first] = 10.0;
            end[second] = 10.0;
            end[normal] = 3.0;
            let given = arc(false, Centre::Offset([-10.0, 0.0]));
            let shape = frame_arc(&given, start, end, plane, &TOLERANCE).unwrap();
            assert!((shape.sweep - FRAC_PI_2).abs() < 1e-12);
            assert!((shape.point(0.0) - start).norm() < 1e-12);
            assert!((shape.point(1.0) - end).norm() < 1e-12);
            assert!(shape.centre.norm() < 1e-12);
        }
    }

    #[test]
    fn a_full_circle_has_its_length() {
        let start = Vector3::zeros();
        let given = arc(true, Centre::Offset([5.0, 0.0]));
        let shape = frame_arc(&given, start, start, Plane::Xy, &TOLERANCE).unwrap();
        assert_eq!(shape.sweep, TAU);
        let length = arc_length(&Shape::Arc {
            centre: shape.centre.into(),
            u: shape.u.into(),
            v: shape.v.into(),
            sweep: shape.sweep,
            rise: shape.rise.into(),
        });
        assert!((length - 5.0 * TAU).abs() < 1e-9);
        // Clockwise from the west: north first.
        assert!(shape.point(0.25)[1] > 4.9);
    }
}
