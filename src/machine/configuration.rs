//! The machine that the parameters of the module ask for.

use super::Machine;
use super::coordinates::{Coordinates, CoordinatesError};
use super::identity::Identity;
use super::table_tilting::{TableTilting, TiltAxis};

/// Why a machine cannot be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigurationError {
    /// `coordinates=` does not fit.
    Coordinates(CoordinatesError),
    /// `machine=` names none of the kinematics.
    UnknownMachine,
}

impl From<CoordinatesError> for ConfigurationError {
    fn from(error: CoordinatesError) -> Self {
        Self::Coordinates(error)
    }
}

impl Machine {
    /// The machine called `identity` (or nothing at all), `xyzac` or `xyzbc`, with joints as
    /// `coordinates` has them.
    ///
    /// # Errors
    ///
    /// [`ConfigurationError`]; the coordinates are looked at first.
    pub fn configured(name: &[u8], coordinates: &[u8]) -> Result<Self, ConfigurationError> {
        let coordinates = Coordinates::parse(coordinates)?;
        let table = |tilt| TableTilting::new(tilt, coordinates).map(Self::TableTilting);
        Ok(match name {
            b"" | b"identity" => Self::Identity(Identity::new(coordinates)),
            b"xyzac" => table(TiltAxis::A)?,
            b"xyzbc" => table(TiltAxis::B)?,
            _ => return Err(ConfigurationError::UnknownMachine),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_choose_the_kinematics() {
        let tilt = |name: &[u8], coordinates: &[u8]| match Machine::configured(name, coordinates) {
            Ok(Machine::TableTilting(table)) => Some(table.tilt_axis()),
            Ok(Machine::Identity(_)) => None,
            Err(error) => panic!("{error:?}"),
        };
        assert_eq!(tilt(b"", b"XZ"), None);
        assert_eq!(tilt(b"identity", b"XYZAC"), None);
        assert_eq!(tilt(b"xyzac", b"XYZAC"), Some(TiltAxis::A));
        assert_eq!(tilt(b"xyzbc", b"zyxcb"), Some(TiltAxis::B));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let refused =
            |name: &[u8], coordinates: &[u8]| Machine::configured(name, coordinates).err();
        assert_eq!(
            refused(b"xyzab", b"XYZAB"),
            Some(ConfigurationError::UnknownMachine)
        );
        assert_eq!(
            refused(b"xyzac", b"XYZBC"),
            Some(ConfigurationError::Coordinates(
                CoordinatesError::MissingAxis { axis: 3 }
            ))
        );
        assert_eq!(
            refused(b"nonsense", b""),
            Some(ConfigurationError::Coordinates(CoordinatesError::Empty))
        );
    }
}
