//! A place in a file of the configuration.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// File, line and column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// As it was named or found.
    pub file: Arc<Path>,
    /// From 1; 0: the file as a whole.
    pub line: usize,
    /// From 1, in characters; 0: the line as a whole.
    pub column: usize,
}

impl Place {
    /// A place in `file`.
    pub fn new(file: &Arc<Path>, line: usize, column: usize) -> Place {
        Place {
            file: Arc::clone(file),
            line,
            column,
        }
    }

    /// The file as a whole.
    pub fn file(file: &Path) -> Place {
        Place::new(&Arc::from(file), 0, 0)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        for number in [self.line, self.column] {
            if number > 0 {
                write!(f, ":{number}")?;
            }
        }
        Ok(())
    }
}
