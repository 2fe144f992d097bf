//! Which coordinates a shape can be made of.

/// Why a shape cannot be made of what the program gave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeError {
    /// Start and end are the same point: there is nothing to do. Not an error to LinuxCNC.
    ZeroLength,
    /// A coordinate is infinite or not a number.
    NotFinite,
    /// A coordinate is greater than [`GREATEST_COORDINATE`], or the way than [`GREATEST_LENGTH`].
    TooFar,
    /// The vector perpendicular to the plane of a circle has no direction.
    NoNormal,
    /// The start or the end of an arc lies on its axis, where it has no direction.
    RadiusTooSmall,
    /// More full circles than can be counted exactly.
    TooManyRevolutions,
}

/// Coordinates up to this are taken, machine units or degrees. From here on the last digit of a coordinate is more than
/// [`LEAST_DISTANCE`](super::measure::LEAST_DISTANCE).
pub const GREATEST_COORDINATE: f64 = 1e9;

/// A move goes no further than this in any axis, machine units or degrees: the distance along the path has to keep the digits
/// that corners of micrometres need.
pub const GREATEST_LENGTH: f64 = 1e7;

/// Refuses coordinates that nothing can be computed with.
pub(super) fn check_coordinates<'a>(
    coordinates: impl Iterator<Item = &'a f64>,
) -> Result<(), ShapeError> {
    let mut greatest = 0.0_f64;
    for coordinate in coordinates {
        if !coordinate.is_finite() {
            return Err(ShapeError::NotFinite);
        }
        greatest = greatest.max(coordinate.abs());
    }
    if greatest > GREATEST_COORDINATE {
        return Err(ShapeError::TooFar);
    }
    Ok(())
}
